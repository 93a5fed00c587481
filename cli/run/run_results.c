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

static void print_json_motion(struct cli_json *json, const struct cli_run *run) {
  double momentum[3];
  cli_json_open(json, "energy", '{');
  cli_json_number(json, "initial", run->energy_before);
  cli_json_number(json, "final", run->energy_after);
  cli_json_close(json);
  hooke_system_momentum(run->setup.system, velocity_of(run), momentum);
  cli_json_open(json, "momentum", '[');
  for (int i = 0; i < 3; i++)
    cli_json_number(json, NULL, momentum[i]);
  cli_json_close(json);
}

static void print_json(const struct cli_run *run, int32_t with_final) {
  const hooke_system *system = run->setup.system;
  const int32_t outcome = run->outcome;
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "status",
                outcome == HOOKE_OK         ? "finished"
                : outcome == HOOKE_DIVERGED ? "diverged"
                                            : "stopped");
  cli_json_text(&json, "method", cli_run_method(run));
  if (is_adaptive(run)) {
    cli_json_number(&json, "rtol", option_of(run, "rtol"));
    cli_json_number(&json, "atol", option_of(run, "atol"));
  } else {
    cli_json_number(&json, "step", option_of(run, "step"));
  }
  cli_json_number(&json, "time", hooke_state_time(run->setup.state));
  cli_json_count(&json, counts[0][0], count_of(run, 0));
  cli_json_count(&json, counts[1][0], count_of(run, 1));
  cli_json_number(&json, "wall_seconds", run->was_finished ? NAN : run->wall_seconds);
  cli_json_count(&json, "particles", hooke_system_particle_count(system));
  cli_json_count(&json, "springs", hooke_system_count(system, "springs"));
  cli_json_count(&json, counts[HOOKE_RUN_COUNTS - 2][0], count_of(run, HOOKE_RUN_COUNTS - 2));
  print_json_motion(&json, run);
  if (cli_run_goes_beyond(run)) cli_json_count(&json, "frames_beyond", run->frames_beyond);
  cli_json_text(&json, "output", run->output);
  cli_json_text(&json, "diagnosis", cli_exit_code(outcome) == HOOKE_EXIT_DIVERGED ? run->message : NULL);
  cli_want_print_json(run, &json);
  cli_claims_add_json(&json, run->why ? run->why : run->estimate);
  if (with_final) {
    const int64_t particles = hooke_system_particle_count(system);
    cli_json_open(&json, "final", '{');
    cli_json_vectors(&json, "position", particles, position_of(run));
    cli_json_vectors(&json, "velocity", particles, velocity_of(run));
  }
  cli_json_end(&json);
}

/* ---- words ---- */

static void print_row(const char *label) {
  printf("%-22s", label);
}

static void print_quantity(double value, const char *unit) {
  printf("%.6g %s", value, unit);
}

static void print_count(const struct cli_run *run, int k) {
  const int64_t count = count_of(run, k);
  if (count <= 0 || counts[k][1] == NULL) return;
  print_row(counts[k][1]);
  printf("%" PRId64 "\n", count);
}

static void print_work(const struct cli_run *run) {
  const int64_t springs = hooke_system_count(run->setup.system, "springs");
  const int64_t steps = count_of(run, 0);
  const double seconds = run->wall_seconds;
  for (int k = 0; k < HOOKE_RUN_COUNTS; k++)
    print_count(run, k);
  if (run->was_finished) return;
  print_row("wall time");
  print_quantity(seconds, "s");
  if (springs > 0 && steps > 0) {
    printf(", %.3g ns per spring-step", 1e9 * seconds / (double)springs / (double)steps);
  }
  printf("\n");
}

static void print_method(const struct cli_run *run) {
  cli_say("%-22s%s, ", "method", cli_run_method(run));
  if (is_adaptive(run))
    printf("rtol %.6g, atol %.6g m\n", option_of(run, "rtol"), option_of(run, "atol"));
  else
    printf("step %.6g s\n", option_of(run, "step"));
}

/* A sum that has overflowed, or a difference of two of those, is not known. */
static void print_known(double value, const char *unit) {
  if (isfinite(value))
    print_quantity(value, unit);
  else
    printf("not known");
}

/* 0 for what is rounding alone, beside the energies that the scene has. */
static double energy_shown(const struct cli_run *run, double energy) {
  return fabs(energy) < ROUNDING * run->energy_scale ? 0.0 : energy;
}

static void print_motion(const struct cli_run *run) {
  const double before = energy_shown(run, run->energy_before), after = energy_shown(run, run->energy_after);
  double momentum[3];
  const double change = run->energy_after - run->energy_before;
  print_row("energy");
  print_known(before, "J");
  printf(" before, ");
  print_known(after, "J");
  printf(" after");
  if (isfinite(change)) printf(" (change %+.6g J)", energy_shown(run, change));
  printf("\n");
  hooke_system_momentum(run->setup.system, velocity_of(run), momentum);
  print_row("momentum");
  for (int i = 0; i < 3; i++) {
    print_known(momentum[i], "");
    printf("%s", isfinite(momentum[i]) ? "" : " ");
  }
  printf("kg m/s\n");
}

static void print_words(const struct cli_run *run) {
  const hooke_system *system = run->setup.system;
  const char *title = hooke_scene_text(run->setup.scene, "title");
  const int64_t particles = hooke_system_particle_count(system);
  if (title && title[0]) cli_say("%-22s%s\n", "scene", title);
  print_row("particles");
  printf("%" PRId64 " (%" PRId64 " pinned or driven), springs %" PRId64 "\n", particles,
         particles - hooke_system_count(system, "free"), hooke_system_count(system, "springs"));
  print_method(run);
  print_row("time reached");
  print_quantity(hooke_state_time(run->setup.state), "s of ");
  print_quantity(run->duration, "s");
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

static void print_final(const struct cli_run *run) {
  const double *q = position_of(run), *v = velocity_of(run);
  char text[HOOKE_NUMBER_SIZE];
  printf("\nparticle x y z [m] vx vy vz [m/s]\n");
  for (int64_t i = 0; i < hooke_system_particle_count(run->setup.system); i++) {
    printf("%" PRId64, i);
    for (int64_t k = 0; k < 3; k++)
      printf(" %s", cli_format_number(q[3 * i + k], text));
    for (int64_t k = 0; k < 3; k++)
      printf(" %s", cli_format_number(v[3 * i + k], text));
    printf("\n");
  }
}

void cli_run_print(const struct cli_run *run) {
  if (run->arguments->json)
    print_json(run, cli_arguments_text(run->arguments, "final") != NULL);
  else
    print_words(run);
  cli_print_flush();
}

void cli_run_print_final(const struct cli_run *run) {
  if (run->arguments->json || !cli_arguments_text(run->arguments, "final")) return;
  print_final(run);
  cli_print_flush();
}
