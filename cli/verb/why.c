/* hooke why: explains a run that blew up, from its scene or from its output. */
#include "measured.h"
#include "command.h"
#include "print.h"
#include "report.h"
#include "setup.h"
#include "watch.h"

#include <math.h>
#include <string.h>

enum { LABEL = 12 };

struct why {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_record *record;   /* NULL: the scene is not an output */
  hooke_measurement *why; /* NULL: the run did not blow up */
  const char *status;     /* of the run, if any */
  double time;            /* reached, if any */
  double bound;           /* the safe step there [s]; NaN: not known */
  int code;               /* failures are reported already */
};

/* ---- diagnosing ---- */

static int32_t see_run(double done, const char *method, void *watch) {
  (void)method;
  return cli_watch_progress(done, "running it", watch);
}

/* By the state with its velocities, on which the damping of friction depends. */
static int32_t find_bound(struct why *why, hooke_state *state) {
  hooke_measurement *check = NULL;
  int32_t status = hooke_measurement_create("check", why->setup.system, why->setup.options, NULL, &check);
  if (status == HOOKE_OK) status = hooke_measurement_run(check, state);
  if (status == HOOKE_OK) {
    const int64_t row = hooke_measurement_find(check, "step_limit", "method",
                                               hooke_options_text(why->setup.options, "method"));
    why->bound = hooke_measurement_number(check, "step_limit", row, "seconds");
  }
  hooke_measurement_destroy(check);
  return status;
}

/* Runs the scene and finds why it ended early. */
static int32_t run_again(struct why *why) {
  hooke_integrator *integrator = NULL;
  struct cli_watch watch;
  int32_t status = hooke_step_settle(why->setup.system, why->setup.options);
  if (status == HOOKE_OK)
    status = hooke_integrator_create(why->setup.system, why->setup.options, &integrator);
  if (status != HOOKE_OK) return status;
  cli_watch_start(&watch, why->arguments);
  hooke_integrator_on_progress(integrator, HOOKE_BETWEEN_LOOKS, see_run, &watch);
  status = hooke_integrator_run(integrator, why->setup.state);
  cli_watch_end(&watch);
  why->time = hooke_state_time(why->setup.state);
  why->status = "finished";
  if (status == HOOKE_OK) status = find_bound(why, why->setup.state);
  if (cli_exit_code(status) == HOOKE_EXIT_DIVERGED) {
    status = hooke_why_create(integrator, why->arguments->more, &why->why);
    if (status == HOOKE_OK) status = cli_watch_run(why->arguments, why->why, NULL);
  }
  hooke_integrator_destroy(integrator);
  return status;
}

/* From the first and the last frame of the output. */
static int32_t read_output(struct why *why) {
  hooke_state *first = NULL, *last = NULL;
  int32_t status = hooke_state_create(why->setup.system, &first);
  if (status == HOOKE_OK) status = hooke_state_create(why->setup.system, &last);
  if (status == HOOKE_OK) status = hooke_record_read(why->record, 0, first);
  if (status == HOOKE_OK)
    status = hooke_record_read(why->record, hooke_record_count(why->record, "good_frames") - 1, last);
  if (status == HOOKE_OK) status = find_bound(why, last);
  if (status == HOOKE_OK) {
    why->time = hooke_state_time(last);
    if (cli_is_among("diverged solver-failed step-limit", why->status))
      status = hooke_why_create_kept(why->setup.system, why->setup.options, first, last, why->arguments->more,
                                     &why->why);
  }
  hooke_state_destroy(first);
  hooke_state_destroy(last);
  if (status == HOOKE_OK && why->why) status = cli_watch_run(why->arguments, why->why, NULL);
  if (status != HOOKE_BAD_CALL) return status;
  why->code = cli_report(why->arguments, HOOKE_EXIT_BAD_INPUT,
                         "%s: taken on from its last frame the run does not blow up; what made it is not in "
                         "the file, such as a callback",
                         why->arguments->scene);
  return status;
}

/* ---- results ---- */

/* For a run that did not blow up: a document of nothing but its method and the time that it reached. */
static void print_nothing(const struct why *why) {
  const char *name;
  cli_print_json("{'scene': %s", why->arguments->scene);
  for (int64_t k = 0; (name = hooke_measurement_column("why", "why", k, "name")); k++) {
    if (strcmp(name, "time") == 0)
      cli_print_json(", %s: %g", name, why->time);
    else
      cli_print_json(", %s: %s", name,
                     strcmp(name, "method") == 0 ? hooke_options_text(why->setup.options, name) : NULL);
  }
  for (int64_t k = 1; (name = hooke_measurement_table("why", k, "name")); k++)
    cli_print_json(", %s: []", name);
  cli_print_json("}\n");
}

static void print_number(const char *label, double value, const char *unit) {
  char text[HOOKE_NUMBER_SIZE];
  if (isnan(value)) return;
  printf("%-*s%s%s%s\n", LABEL, label, isinf(value) ? "none" : cli_format_rounded(value, text),
         unit[0] && !isinf(value) ? " " : "", isinf(value) ? "" : unit);
}

static void print_margin(const struct why *why) {
  const double step = hooke_options_number(why->setup.options, "step");
  printf("the run did not blow up\n");
  cli_say("%-*s%s\n", LABEL, "status", why->status);
  print_number("time", why->time, "s");
  if (!(step > 0.0 && isfinite(why->bound) && why->bound > 0.0)) return;
  print_number("step", step, "s");
  print_number("safe bound", why->bound, "s");
  printf("%-*s%.3g %% of the safe bound there\n", LABEL, "margin", 100.0 * step / why->bound);
}

static void print_words(const struct why *why) {
  static const char *const facts[][3] = {{"step", "step", "s"},
                                         {"limit", "limit", "s"},
                                         {"well until", "time", "s"},
                                         {"noticed", "noticed", "s"},
                                         {"particle", "particle", ""}};
  const hooke_measurement *found = why->why;
  cli_claims_print(why->arguments, found, LABEL, NULL);
  cli_say("%-*s%s\n", LABEL, "kind", cli_text(found, "why", "cause"));
  cli_say("%-*s%s\n", LABEL, "method", cli_text(found, "why", "method"));
  for (size_t k = 0; k < sizeof facts / sizeof facts[0]; k++)
    print_number(facts[k][0], cli_number(found, "why", facts[k][1]), facts[k][2]);
  cli_limiting_print(found);
  printf("\n");
  cli_advice_print(found);
}

/* HOOKE_NO_MEMORY if something is missing. */
static int32_t tell(const struct why *why) {
  int32_t status = HOOKE_OK;
  if (why->why) status = cli_advice_label(why->arguments, why->why);
  if (why->arguments->json && why->why) {
    const int32_t rest = cli_claims_print_json(why->arguments, "scene", why->why);
    return status == HOOKE_OK ? rest : status;
  }
  if (why->arguments->json)
    print_nothing(why);
  else if (why->why)
    print_words(why);
  else
    print_margin(why);
  return status;
}

/* The exit code so far, or that of a page that could not be written. */
static int write_report(const struct why *why, int code) {
  if (!cli_arguments_text(why->arguments, "report") || code != HOOKE_EXIT_DONE) return code;
  if (!why->why) {
    cli_report_words(why->arguments, "no page is written, since the run did not blow up");
    return code;
  }
  return cli_setup_write_report(why->arguments, &why->setup, why->why, code);
}

static int find_out(struct why *why) {
  const struct cli_arguments *arguments = why->arguments;
  int32_t status = hooke_record_open(arguments->scene, &why->record);
  if (status == HOOKE_NO_MEMORY) return cli_report_status(arguments, status);
  if (status == HOOKE_OK) why->status = hooke_record_text(why->record, "status");
  const int32_t added = why->record && why->setup.force.function &&
                        strcmp(hooke_record_text(why->record, "callbacks"), "none") == 0;
  if (why->record && !cli_arguments_has_run(arguments) && !added) {
    status = read_output(why);
  } else {
    int code = cli_setup_fit(arguments, &why->setup, 0);
    if (code == HOOKE_EXIT_DONE)
      code = cli_setup_require(arguments, &why->setup, hooke_options_text(why->setup.options, "method"));
    if (code != HOOKE_EXIT_DONE) return code;
    status = run_again(why);
  }
  if (why->code != HOOKE_EXIT_DONE) return why->code;
  if (status == HOOKE_STOPPED) return cli_report(arguments, cli_exit_code(status), "%s", cli_force_stop());
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  status = tell(why);
  cli_print_flush();
  return write_report(why, status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_missing_words(arguments));
}

static int do_why(const struct cli_arguments *arguments) {
  struct why why = {.arguments = arguments, .time = NAN, .bound = NAN};
  int code = cli_setup_check_report(arguments);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_load(arguments, &why.setup);
  if (code == HOOKE_EXIT_DONE) code = find_out(&why);
  hooke_measurement_destroy(why.why);
  hooke_record_close(why.record);
  cli_setup_destroy(&why.setup);
  return code;
}

static const struct cli_verb_row rows[] = {
    {"report", 0, "FILE.html",
     "writes the explanation as one page to read offline, replacing it: the steps around the trouble, played "
     "slowly, beside the advised run"},
    HOOKE_FORCE,
};

const struct cli_verb cli_verb_why = {
    .name = "why",
    .summary = "explains a run that blew up",
    .text = "Runs the scene, or reads an output of 'hooke run -o', and says why the run blew up: the cause, "
            "where and when, the springs that determine it, and what to do, as commands that have been "
            "tried. The exit code is 0 also if the run did not blow up.",
    HOOKE_VERB_ROWS(rows),
    .options = "why",
    .example = "hooke why cloth.json --step 50ms --every 50ms",
    .function = do_why,
};
