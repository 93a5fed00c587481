#include "run_results.h"

#include "measured.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double ROUNDING = 1e-12;

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

/* ---- its error ---- */

enum { INDENT = 22 };

static int refuse_typed(const struct cli_arguments *arguments) {
  static const char *const chosen[] = {"step", "rtol", "atol", "atol_velocity"};
  char flag[HOOKE_FLAG_SIZE];
  for (size_t k = 0; k < sizeof chosen / sizeof chosen[0]; k++) {
    if (!cli_arguments_text(arguments, chosen[k])) continue;
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "--want picks the step or the tolerance; leave out --%s, or --want",
                      cli_arguments_flag(chosen[k], flag));
  }
  return HOOKE_EXIT_DONE;
}

static void tell_choice(const struct cli_run *run, const char *done, const char *want) {
  const hooke_options *options = run->setup.options;
  const char *method = hooke_options_text(options, "method");
  const int adaptive = hooke_method_is_adaptive(method);
  char number[HOOKE_NUMBER_SIZE];
  if (run->arguments->quiet) return;
  cli_report_words(run->arguments, "%s %s%s: %s, %s %s%s", done, want,
                   want[strspn(want, "+-.0123456789eE")] ? "" : " m", method, adaptive ? "rtol" : "step",
                   cli_format_rounded(hooke_options_number(options, adaptive ? "rtol" : "step"), number),
                   adaptive ? "" : " s");
}

int32_t cli_want_judges(const struct cli_run *run) {
  return cli_arguments_text(run->arguments, "want") || !cli_arguments_text(run->arguments, "no-estimate");
}

static int watches(const struct cli_run *run) {
  return cli_arguments_text(run->arguments, "watch") != NULL;
}

/* Errors are those of whole runs; what is watched is told of any. */
static int is_measured(const struct cli_run *run) {
  return run->estimate && !run->was_finished && (run->outcome == HOOKE_OK || watches(run));
}

/* `want`: NULL without one. */
static int create(struct cli_run *run, const char *want) {
  hooke_options *options = NULL;
  int32_t status = hooke_options_create("estimate", &options);
  if (status == HOOKE_OK && want) status = hooke_options_set_text(options, "want", want);
  const int32_t refused = status == HOOKE_BAD_VALUE;
  const char *watch = cli_arguments_text(run->arguments, "watch");
  if (status == HOOKE_OK && watch) status = hooke_options_set_text(options, "watch", watch);
  if (status == HOOKE_OK && !cli_want_judges(run)) status = hooke_options_set_text(options, "error", "false");
  if (status == HOOKE_OK)
    status = hooke_measurement_create("estimate", run->setup.system, NULL, options, &run->estimate);
  hooke_options_destroy(options);
  if (refused) return cli_report(run->arguments, HOOKE_EXIT_USAGE, "--want: %s", hooke_last_error());
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(run->arguments, status);
}

int cli_want_pick(struct cli_run *run) {
  const struct cli_arguments *arguments = run->arguments;
  const char *text = cli_arguments_text(arguments, "want");
  int code = text ? cli_setup_require(arguments, &run->setup, NULL) : HOOKE_EXIT_DONE;
  if (code == HOOKE_EXIT_DONE && text) code = refuse_typed(arguments);
  if (!cli_want_judges(run) && !watches(run)) return HOOKE_EXIT_DONE;
  if (code == HOOKE_EXIT_DONE) code = create(run, text);
  if (code != HOOKE_EXIT_DONE) return code;
  hooke_measurement_on_progress(run->estimate, cli_watch_progress, &run->watch);
  if (!text) return HOOKE_EXIT_DONE;
  cli_watch_start(&run->watch, arguments);
  const int32_t status =
      hooke_estimate_pick(run->estimate, cli_arguments_text(arguments, "method"), run->setup.options);
  cli_watch_end(&run->watch);
  if (status == HOOKE_STOPPED)
    return cli_report(arguments, cli_exit_code(status), "%s while a method was picked; nothing was run",
                      cli_force_stop());
  if (status == HOOKE_UNSUITED) return cli_report(arguments, HOOKE_EXIT_NOT_MET, "%s", hooke_last_error());
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  tell_choice(run, "picked for an error of", text);
  return HOOKE_EXIT_DONE;
}

int32_t cli_want_measure(struct cli_run *run) {
  if (!is_measured(run)) return HOOKE_OK;
  cli_watch_start(&run->watch, run->arguments);
  if (run->outcome == HOOKE_OK) {
    hooke_integrator_destroy(run->integrator); /* the following runs need as much memory */
    run->integrator = NULL;
  }
  const int32_t status = hooke_measurement_run(run->estimate, run->setup.state);
  cli_watch_end(&run->watch);
  return status;
}

static const char *text_of(const struct cli_run *run, const char *what) {
  return hooke_measurement_text(run->estimate, "estimate", 0, what);
}

static double number_of(const struct cli_run *run, const char *what) {
  return hooke_measurement_number(run->estimate, "estimate", 0, what);
}

static int is_wanted(const struct cli_run *run) {
  return run->estimate && !isnan(number_of(run, "wanted"));
}

int32_t cli_want_goes_on(struct cli_run *run) {
  if (!is_wanted(run) || run->outcome != HOOKE_OK || number_of(run, "met") == 1.0) return 0;
  if (cli_watch_interrupted() || hooke_estimate_refine(run->estimate, run->setup.options) != HOOKE_OK)
    return 0;
  if (!run->arguments->quiet) cli_report_words(run->arguments, "%s", cli_claim(run->estimate, "want"));
  tell_choice(run, "once more for", cli_arguments_text(run->arguments, "want"));
  return 1;
}

static void print_watched(const struct cli_run *run) {
  static const char *const heads[] = {"value", "minimum", "at t [s]", "maximum", "at t [s]"};
  static const char *const columns[] = {"value", "minimum", "at_minimum", "maximum", "at_maximum"};
  enum { COLUMNS = sizeof columns / sizeof columns[0], CELL = 12 };
  const int64_t rows = hooke_measurement_row_count(run->estimate, "watched");
  const int32_t width = cli_rows_width(run->estimate, "watched", "quantity", INDENT - 8) + 6;
  if (rows < 1) return;
  printf("\n%-*s", width, "watched");
  for (int k = 0; k < COLUMNS; k++)
    printf(" %*s", CELL, heads[k]);
  printf("\n");
  for (int64_t row = 0; row < rows; row++) {
    char head[HOOKE_HEAD_SIZE];
    cli_print_padded(stdout, width, cli_quantity(run->estimate, "watched", row, head));
    for (int k = 0; k < COLUMNS; k++)
      cli_rows_print_as(CELL, hooke_measurement_number(run->estimate, "watched", row, columns[k]), "%.6g",
                        NULL, NULL);
    printf("\n");
  }
}

void cli_want_print(const struct cli_run *run) {
  if (!is_measured(run)) return;
  cli_claims_print(run->arguments, run->estimate, INDENT, NULL);
  print_watched(run);
  if (run->outcome == HOOKE_OK && cli_want_judges(run) && !text_of(run, "by") && !run->arguments->quiet)
    cli_report_words(run->arguments, "'hooke study' on the same may tell how wrong it is");
  cli_print_flush();
}

static void print_json_error(const struct cli_run *run) {
  const char *by = text_of(run, "by"), *reason = text_of(run, "reason");
  const double piece = number_of(run, "last_piece");
  cli_print_json("'error': {'estimate': %g, 'rms': %g, 'known_until': %g, 'by': %s, 'energy_rise': %g, "
                 "'heat_excess': %g, 'reason': %s}, ",
                 number_of(run, "estimate"), number_of(run, "rms"), number_of(run, "known_until"), by,
                 number_of(run, "energy_rise"), number_of(run, "heat_excess"), reason[0] ? reason : NULL);
  if (!isnan(piece))
    cli_print_json("'last_piece': {'error': %g, 'from': %g, 'until': %g}, ", piece,
                   number_of(run, "last_from"), hooke_state_time(run->setup.state));
}

/* The keys "error", "watched" and "want", as JSON, each with a comma after it. */
static void print_json_want(const struct cli_run *run) {
  if (!run->estimate || run->was_finished) return;
  const double met = number_of(run, "met");
  if (run->outcome == HOOKE_OK && cli_want_judges(run)) print_json_error(run);
  const char *watched = watches(run) ? hooke_measurement_json(run->estimate, "watched", -1) : NULL;
  if (watched) printf("\"watched\": %s, ", watched);
  if (!is_wanted(run)) return;
  cli_print_json("'want': {'wanted': %g, 'met': ", number_of(run, "wanted"));
  cli_print_json(isnan(met) ? "null" : met == 1.0 ? "true" : "false");
  cli_print_json(", 'seconds': %g", number_of(run, "seconds"));
  const char *wants = hooke_measurement_json(run->estimate, "wants", -1);
  printf(", \"wants\": %s}, ", wants ? wants : "[]");
}

int cli_want_exit_code(const struct cli_run *run) {
  if (!is_wanted(run) || run->outcome != HOOKE_OK || number_of(run, "met") == 1.0) return HOOKE_EXIT_DONE;
  return cli_watch_interrupted() ? HOOKE_EXIT_INTERRUPTED : HOOKE_EXIT_NOT_MET;
}

/* ---- JSON ---- */

/* What is said of it, and where every particle is. */
static void print_json_end(const struct cli_run *run) {
  hooke_measurement *const says[] = {run->why, run->why && !watches(run) ? NULL : run->estimate};
  const char *before = "";
  cli_print_json("'claims': [");
  for (int k = 0; k < 2; k++) {
    if (!says[k] || hooke_measurement_row_count(says[k], "claims") < 1) continue;
    (void)cli_print_members(before, says[k], "claims", -1);
    before = ", ";
  }
  cli_print_json("]");
  if (cli_arguments_text(run->arguments, "final")) cli_print_final_json(run->setup.state);
  cli_print_json("}\n");
}

static void print_json(const struct cli_run *run) {
  const hooke_system *system = run->setup.system;
  const int32_t outcome = run->outcome;
  double momentum[3];
  hooke_system_momentum(system, velocity_of(run), momentum);
  cli_print_json("{");
  cli_print_json_set(run->arguments->limits);
  cli_print_json("'status': %s, 'method': %s, ",
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
  if (run->probes_file) cli_print_json("'probes': %s, ", run->probes_file);
  if (run->setup.force.function)
    cli_print_json("'force_file': %s, 'force_name': %s, 'force_sha256': %s, ", run->setup.force.file,
                   run->setup.force.name, run->setup.force.digest);
  cli_print_json("'output': %s, 'diagnosis': %s, ", run->output,
                 cli_exit_code(outcome) == HOOKE_EXIT_DIVERGED ? run->message : NULL);
  print_json_want(run);
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
  if (run->probes_file)
    cli_say("%-22s%s (%" PRId64 " line%s, until %.6g s)\n", "probes", run->probes_file, run->lines,
            run->lines == 1 ? "" : "s", run->last_line);
}

void cli_run_print(const struct cli_run *run) {
  if (run->arguments->json)
    print_json(run);
  else
    print_words(run);
  cli_print_flush();
}

void cli_run_print_final(const struct cli_run *run) {
  if (!run->arguments->json && cli_arguments_text(run->arguments, "final")) cli_print_final(run->setup.state);
}
