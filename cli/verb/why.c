/* hooke why: explains a run that blew up, from its scene or from its output. */
#include "advice.h"
#include "blame.h"
#include "print.h"
#include "report.h"
#include "setup.h"
#include "watch.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SPRINGS_SHOWN = 8 };

struct why {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_record *record; /* NULL: the scene is not an output */
  hooke_why *why;       /* NULL: the run did not blow up */
  const char *status;   /* of the run, then */
  double time;          /* reached, then */
  int code;             /* of what was reported already */
  double budget;        /* [s] */
};

static const double SMALLEST_SHARE = 1e-3; /* that words are made of */
static const double USUAL_BUDGET = 30.0;   /* [s] */

/* ---- finding out ---- */

static int32_t see_run(double done, const char *method, void *watch) {
  (void)method;
  return cli_watch_tell(watch, done, "running it");
}

/* Runs the scene and asks why it ended early. */
static int32_t run_again(struct why *why) {
  hooke_integrator *integrator = NULL;
  struct cli_watch watch;
  int32_t status = hooke_integrator_create(why->setup.system, why->setup.options, &integrator);
  if (status != HOOKE_OK) return status;
  cli_watch_start(&watch, why->arguments);
  hooke_integrator_on_progress(integrator, HOOKE_BETWEEN_LOOKS, see_run, &watch);
  status = hooke_integrator_run(integrator, why->setup.state);
  why->time = hooke_state_time(why->setup.state);
  why->status = "finished";
  if (cli_exit_code(status) == HOOKE_EXIT_DIVERGED)
    status = hooke_why_create(integrator, why->budget, cli_watch_progress, &watch, &why->why);
  cli_watch_end(&watch);
  hooke_integrator_destroy(integrator);
  return status;
}

static int32_t blew_up(const char *status) {
  return strcmp(status, "diverged") == 0 || strcmp(status, "solver-failed") == 0 ||
         strcmp(status, "step-limit") == 0;
}

static int32_t explain_kept(struct why *why, const hooke_state *first, const hooke_state *last) {
  struct cli_watch watch;
  cli_watch_start(&watch, why->arguments);
  const int32_t status = hooke_why_create_kept(why->setup.system, why->setup.options, first, last,
                                               why->budget, cli_watch_progress, &watch, &why->why);
  cli_watch_end(&watch);
  return status;
}

/* From the first and the last frame of the output. */
static int32_t read_output(struct why *why) {
  hooke_state *first = NULL, *last = NULL;
  int32_t status = hooke_state_create(why->setup.system, &first);
  if (status == HOOKE_OK) status = hooke_state_create(why->setup.system, &last);
  if (status == HOOKE_OK) status = hooke_record_read(why->record, 0, first);
  if (status == HOOKE_OK) status = hooke_record_read(why->record, -1, last);
  if (status == HOOKE_OK) {
    why->time = hooke_state_time(last);
    if (blew_up(why->status)) status = explain_kept(why, first, last);
  }
  hooke_state_destroy(first);
  hooke_state_destroy(last);
  if (status != HOOKE_BAD_CALL) return status;
  why->code = cli_report(
      why->arguments, HOOKE_EXIT_BAD_INPUT,
      "%s: taken on from its last frame the run does not blow up; what made it is not in the file, "
      "such as a callback",
      why->arguments->scene);
  return status;
}

/* ---- telling ---- */

/* HOOKE_NO_MEMORY if a command is missing. */
static int32_t print_json(const struct why *why) {
  const hooke_why *found = why->why;
  struct cli_json json;
  int32_t status = HOOKE_OK;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "cause", found ? hooke_why_text(found, "cause") : NULL);
  cli_json_number(&json, "time", found ? hooke_why_number(found, "time") : why->time);
  cli_json_text(&json, "method", hooke_options_text(why->setup.options, "method"));
  cli_json_number(&json, "step", found ? hooke_why_number(found, "step") : (double)NAN);
  cli_json_number(&json, "limit", found ? hooke_why_number(found, "limit") : (double)NAN);
  cli_json_open(&json, "blame", '[');
  for (int64_t k = 0; found && k < hooke_why_blame_count(found); k++) {
    cli_blame_json(&json, hooke_why_blame_text(found, k, "force"), hooke_why_blame_number(found, k, "first"),
                   hooke_why_blame_number(found, k, "second"), hooke_why_blame_text(found, k, "group"),
                   hooke_why_blame_number(found, k, "share"));
  }
  cli_json_close(&json);
  cli_json_open(&json, "advice", '[');
  for (int64_t k = 0; found && k < hooke_why_advice_count(found); k++) {
    char *command;
    if (cli_advice_command(why->arguments, found, k, &command) != HOOKE_OK) status = HOOKE_NO_MEMORY;
    cli_json_open(&json, NULL, '{');
    cli_json_text(&json, "change", hooke_why_advice_text(found, k, "change"));
    cli_json_text(&json, "command", command);
    cli_json_close(&json);
    free(command);
  }
  cli_json_close(&json);
  const char *left_out = found ? hooke_why_text(found, "left_out") : "";
  cli_json_text(&json, "left_out", left_out[0] ? left_out : NULL);
  cli_json_end(&json);
  return status;
}

static void print_number(const char *label, double value, const char *unit) {
  char text[HOOKE_NUMBER_SIZE];
  if (isnan(value)) return;
  if (isinf(value))
    printf("%-12snone\n", label);
  else
    printf("%-12s%s %s\n", label, cli_format_rounded(value, text), unit);
}

static void print_springs(const hooke_why *found) {
  const int64_t count = hooke_why_blame_count(found);
  int64_t forces = 0;
  for (int64_t k = 0; k < count && k < MOST_SPRINGS_SHOWN; k++) {
    const char *group = hooke_why_blame_text(found, k, "group");
    const double share = hooke_why_blame_number(found, k, "share");
    if (k > 0 && share < SMALLEST_SHARE) return;
    if (hooke_why_blame_text(found, k, "force")[0]) {
      printf("%-12s%s, share %.3g\n", "force", hooke_why_blame_text(found, k, "force"), share);
      forces++;
      continue;
    }
    printf("%-12s%.0f, between particles %.0f and %.0f", k == forces ? "springs" : "",
           hooke_why_blame_number(found, k, "spring"), hooke_why_blame_number(found, k, "first"),
           hooke_why_blame_number(found, k, "second"));
    if (group[0]) {
      printf(", group ");
      cli_print_text(stdout, group);
    }
    if (!isnan(share)) printf(", share %.3g", share);
    printf("\n");
  }
  if (count > MOST_SPRINGS_SHOWN) printf("%-12sand %" PRId64 " more\n", "", count - MOST_SPRINGS_SHOWN);
}

/* HOOKE_NO_MEMORY if a command is missing. */
static int32_t print_words(const struct why *why) {
  const hooke_why *found = why->why;
  char text[HOOKE_NUMBER_SIZE];
  if (!found) {
    printf("the run did not blow up: it is '");
    cli_print_text(stdout, why->status);
    printf("' at t = %s s\n", cli_format_rounded(why->time, text));
    return HOOKE_OK;
  }
  printf("%-12s%s\n", "cause", hooke_why_text(found, "cause"));
  printf("%-12s", "what");
  cli_print_wrapped(stdout, 12, 12, 100, hooke_why_text(found, "sentence"));
  printf("\n%-12s%s\n", "method", hooke_why_text(found, "method"));
  print_number("step", hooke_why_number(found, "step"), "s");
  print_number("limit", hooke_why_number(found, "limit"), "s");
  print_number("well until", hooke_why_number(found, "time"), "s");
  print_number("noticed", hooke_why_number(found, "noticed"), "s");
  if (!isnan(hooke_why_number(found, "particle")))
    printf("%-12s%.0f\n", "particle", hooke_why_number(found, "particle"));
  print_springs(found);
  if (hooke_why_text(found, "left_out")[0]) {
    printf("%-12s", "left out");
    cli_print_wrapped(stdout, 12, 12, 100, hooke_why_text(found, "left_out"));
    printf("\n");
  }
  printf("\n");
  return cli_advice_print(stdout, why->arguments, found, INT64_MAX);
}

/* 1 if an option of a run was given: then it is another run than that of the output. */
static int32_t is_another_run(const struct cli_arguments *arguments) {
  for (int32_t k = 0; k < arguments->count; k++) {
    if (arguments->all[k].table == arguments->run && arguments->all[k].text) return 1;
  }
  return 0;
}

static int find_out(struct why *why) {
  const struct cli_arguments *arguments = why->arguments;
  int32_t status = hooke_record_open(arguments->scene, &why->record);
  if (status == HOOKE_NO_MEMORY) return cli_report_status(arguments, status);
  if (status == HOOKE_OK) why->status = hooke_record_text(why->record, "status");
  if (why->record && !is_another_run(arguments)) {
    status = read_output(why);
  } else {
    int code = cli_setup_require(arguments, &why->setup, hooke_options_text(why->setup.options, "method"));
    if (code != HOOKE_EXIT_DONE) return code;
    status = run_again(why);
  }
  if (why->code != HOOKE_EXIT_DONE) return why->code;
  if (status == HOOKE_STOPPED) return cli_report(arguments, HOOKE_EXIT_INTERRUPTED, "interrupted");
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  status = arguments->json ? print_json(why) : print_words(why);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_missing_words(arguments);
}

static int do_why(const struct cli_arguments *arguments) {
  struct why why = {.arguments = arguments, .time = NAN, .budget = USUAL_BUDGET};
  int code = cli_setup_read_study(arguments, "budget", "s", &why.budget);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_load(arguments, &why.setup);
  if (code == HOOKE_EXIT_DONE) code = find_out(&why);
  hooke_why_destroy(why.why);
  hooke_record_close(why.record);
  cli_setup_destroy(&why.setup);
  return code;
}

static const struct cli_verb_row rows[] = {
    {"budget", 0, "SECONDS",
     "time that the explanation may take after the run, such as 5s or 2min; 30 s if not given"},
};

const struct cli_verb cli_verb_why = {
    .name = "why",
    .summary = "explains a run that blew up",
    .text = "Runs the scene, or reads an output of 'hooke run -o', and says why the run blew up: the cause, "
            "where and when, "
            "the springs to blame, and what to do, as commands that have been tried. The exit code is 0 also "
            "if the run did "
            "not blow up.",
    HOOKE_VERB_ROWS(rows),
    .example = "hooke why cloth.json --step 50ms --every 50ms",
    .function = do_why,
};
