#include "run_results.h"

#include "claims.h"
#include "report.h"
#include "want.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const double ROUNDING = 1e-12;

static const double *position_of(const struct cli_run *run) {
  return hooke_state_position(run->setup.state);
}

static const double *velocity_of(const struct cli_run *run) {
  return hooke_state_velocity(run->setup.state);
}

const char *cli_run_method(const struct cli_run *run) {
  return hooke_options_text(run->options, "method");
}

static double option_of(const struct cli_run *run, const char *name) {
  return hooke_options_number(run->options, name);
}

int32_t cli_run_goes_beyond(const struct cli_run *run) {
  return option_of(run, "past_divergence") == 1.0 || option_of(run, "frames_after") > 0.0;
}

static int is_adaptive(const struct cli_run *run) {
  return hooke_method_is_adaptive(cli_run_method(run)) != 0;
}

static const char *const counts[HOOKE_RUN_COUNTS][2] = {
    {"steps", "steps"},
    {"force_evaluations", "force evaluations"},
    {"derivative_products", "derivative products"},
    {"nonlinear_iterations", "nonlinear iterations"},
    {"nonlinear_failures", "nonlinear failures"},
    {"linear_iterations", "linear iterations"},
    {"error_test_failures", "error test failures"},
    {"zero_passages", NULL},
    {"coincident_springs", NULL},
};

void cli_run_take_counts(struct cli_run *run) {
  for (int k = 0; k < HOOKE_RUN_COUNTS; k++)
    run->count[k] = hooke_integrator_count(run->integrator, counts[k][0]);
  snprintf(run->passages, sizeof run->passages, "%s",
           hooke_integrator_text(run->integrator, "zero_passages"));
  run->wall_seconds = hooke_integrator_number(run->integrator, "wall_seconds");
}

int64_t cli_run_coincident(const struct cli_run *run) {
  return run->count[HOOKE_RUN_COUNTS - 1];
}

/* -1: unknown, as a file keeps only the count of steps */
static int64_t count_of(const struct cli_run *run, int k) {
  if (!run->was_finished) return run->count[k];
  return k == 0 ? run->finished_steps : -1;
}

/* ---- JSON ---- */

static void print_vectors(const char *key, int64_t rows, const double *xyz) {
  cli_print_json("%s: [", key);
  for (int64_t row = 0; row < rows; row++, xyz += 3)
    cli_print_json(row ? ", [%g, %g, %g]" : "[%g, %g, %g]", xyz[0], xyz[1], xyz[2]);
  cli_print_json("]");
}

/* What is said of it, and where every particle is. */
static void print_json_end(const struct cli_run *run) {
  const int64_t particles = hooke_system_particle_count(run->setup.system);
  hooke_measurement *says = run->why ? run->why : run->estimate;
  cli_print_json("'claims': [");
  if (says && hooke_measurement_row_count(says, "claims") >= 0)
    (void)cli_print_members("", says, "claims", -1);
  cli_print_json("]");
  if (cli_arguments_text(run->arguments, "final")) {
    cli_print_json(", 'final': {");
    print_vectors("position", particles, position_of(run));
    cli_print_json(", ");
    print_vectors("velocity", particles, velocity_of(run));
    cli_print_json("}");
  }
  cli_print_json("}\n");
}

static void print_json(const struct cli_run *run) {
  const hooke_system *system = run->setup.system;
  const int32_t outcome = run->outcome;
  double momentum[3];
  hooke_system_momentum(system, velocity_of(run), momentum);
  cli_print_json("{'status': %s, 'method': %s, ",
                 outcome == HOOKE_OK         ? "finished"
                 : outcome == HOOKE_DIVERGED ? "diverged"
                                             : "stopped",
                 cli_run_method(run));
  if (is_adaptive(run))
    cli_print_json("'rtol': %g, 'atol': %g, ", option_of(run, "rtol"), option_of(run, "atol"));
  else
    cli_print_json("'step': %g, ", option_of(run, "step"));
  cli_print_json("'time': %g, 'steps': %" PRId64 ", 'force_evaluations': %" PRId64 ", 'wall_seconds': %g, ",
                 hooke_state_time(run->setup.state), count_of(run, 0), count_of(run, 1),
                 run->was_finished ? NAN : run->wall_seconds);
  cli_print_json("'particles': %" PRId64 ", 'springs': %" PRId64 ", 'zero_passages': %" PRId64 ", ",
                 hooke_system_particle_count(system), hooke_system_count(system, "springs"),
                 count_of(run, HOOKE_RUN_COUNTS - 2));
  cli_print_json("'energy': {'initial': %g, 'final': %g}, 'momentum': [%g, %g, %g], ", run->energy_before,
                 run->energy_after, momentum[0], momentum[1], momentum[2]);
  if (cli_run_goes_beyond(run)) cli_print_json("'frames_beyond': %" PRId64 ", ", run->frames_beyond);
  cli_print_json("'output': %s, 'diagnosis': %s, ", run->output,
                 cli_exit_code(outcome) == HOOKE_EXIT_DIVERGED ? run->message : NULL);
  cli_want_print_json(run);
  print_json_end(run);
}

/* ---- words ---- */

static void print_work(const struct cli_run *run) {
  const int64_t springs = hooke_system_count(run->setup.system, "springs");
  for (int k = 0; k < HOOKE_RUN_COUNTS; k++)
    if (counts[k][1] && count_of(run, k) > 0) printf("%-22s%" PRId64 "\n", counts[k][1], count_of(run, k));
  if (run->was_finished) return;
  printf("%-22s%.6g s", "wall time", run->wall_seconds);
  if (springs > 0 && run->count[0] > 0)
    printf(", %.3g ns per spring-step", 1e9 * run->wall_seconds / (double)springs / (double)run->count[0]);
  printf("\n");
}

/* A sum that has overflowed, or a difference of two of those, is not known. */
static const char *known(double value, const char *unit, char text[HOOKE_NUMBER_SIZE]) {
  snprintf(text, HOOKE_NUMBER_SIZE, isfinite(value) ? "%.6g%s" : "not known", value, unit);
  return text;
}

/* 0 for what is rounding alone, beside the energies that the scene has. */
static double energy_shown(const struct cli_run *run, double energy) {
  return fabs(energy) < ROUNDING * run->energy_scale ? 0.0 : energy;
}

static void print_motion(const struct cli_run *run) {
  const double change = run->energy_after - run->energy_before;
  char text[3][HOOKE_NUMBER_SIZE];
  double momentum[3];
  printf("%-22s%s before, %s after", "energy", known(energy_shown(run, run->energy_before), " J", text[0]),
         known(energy_shown(run, run->energy_after), " J", text[1]));
  if (isfinite(change)) printf(" (change %+.6g J)", energy_shown(run, change));
  hooke_system_momentum(run->setup.system, velocity_of(run), momentum);
  printf("\n%-22s%s %s %s kg m/s\n", "momentum", known(momentum[0], "", text[0]),
         known(momentum[1], "", text[1]), known(momentum[2], "", text[2]));
}

static void print_words(const struct cli_run *run) {
  const hooke_system *system = run->setup.system;
  const char *title = hooke_scene_text(run->setup.scene, "title");
  const int64_t particles = hooke_system_particle_count(system);
  if (title && title[0]) cli_say("%-22s%s\n", "scene", title);
  printf("%-22s%" PRId64 " (%" PRId64 " pinned or driven), springs %" PRId64 "\n", "particles", particles,
         particles - hooke_system_count(system, "free"), hooke_system_count(system, "springs"));
  cli_say("%-22s%s, ", "method", cli_run_method(run));
  if (is_adaptive(run))
    printf("rtol %.6g, atol %.6g m\n", option_of(run, "rtol"), option_of(run, "atol"));
  else
    printf("step %.6g s\n", option_of(run, "step"));
  printf("%-22s%.6g s of %.6g s", "time reached", hooke_state_time(run->setup.state), run->duration);
  const double diverged =
      run->outcome == HOOKE_DIVERGED ? hooke_integrator_number(run->integrator, "diverged_at") : NAN;
  if (!isnan(diverged)) printf("; diverged at %.6g s, what follows is of the last good state", diverged);
  printf("\n");
  print_work(run);
  print_motion(run);
  if (run->output)
    cli_say("%-22s%s (%" PRId64 " frame%s)\n", "output", run->output, run->frames,
            run->frames == 1 ? "" : "s");
}

void cli_run_print(const struct cli_run *run) {
  if (run->arguments->json)
    print_json(run);
  else
    print_words(run);
  cli_print_flush();
}

void cli_run_print_final(const struct cli_run *run) {
  const double *q = position_of(run), *v = velocity_of(run);
  char text[HOOKE_NUMBER_SIZE];
  if (run->arguments->json || !cli_arguments_text(run->arguments, "final")) return;
  printf("\nparticle x y z [m] vx vy vz [m/s]\n");
  for (int64_t i = 0; i < hooke_system_particle_count(run->setup.system); i++) {
    printf("%" PRId64, i);
    for (int64_t k = 0; k < 6; k++)
      printf(" %s", cli_format_number(k < 3 ? q[3 * i + k] : v[3 * i + k - 3], text));
    printf("\n");
  }
  cli_print_flush();
}
