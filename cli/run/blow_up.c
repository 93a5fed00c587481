#include "blow_up.h"

#include "measured.h"
#include "command.h"
#include "report.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- what happened ---- */

/* Which of several scenes, and the claim of the cause; of a message the clause before what to try. */
static void tell_what(const struct cli_run *run) {
  const char *what = run->why ? cli_claim(run->why, "cause") : run->message, *end = strstr(what, "; ");
  cli_report_words(run->arguments, run->arguments->more_count > 0 ? "%s: %.*s" : "%.0s%.*s",
                   run->arguments->scene, !run->why && end ? (int)(end - what) : (int)strlen(what), what);
}

/* ---- what to try ---- */

/* Without a diagnosis the message of the run has a suggestion. */
static void tell_suggestion(const char *message) {
  const char *suggestion = strstr(message, "try ");
  fputs("try: ", stderr);
  cli_print_text(stderr, suggestion ? suggestion + strlen("try ") : "a smaller step");
  fputc('\n', stderr);
}

static void tell_try(const struct cli_run *run) {
  if (!run->why) {
    tell_suggestion(run->message);
    return;
  }
  const char *change = hooke_measurement_text(run->why, "advice", 0, "change");
  const char *command = hooke_measurement_text(run->why, "advice", 0, "command");
  fprintf(stderr, "try: %s%s", command ? command : "", command ? "  # " : "");
  cli_print_text(stderr, change ? change : "another model: no run that was tried got any further");
  fputc('\n', stderr);
}

/* ---- where to see more ---- */

/* By the scene; what --want chose is named. */
static void add_scene(struct cli_string *text, const struct cli_run *run) {
  const double step = hooke_options_number(run->options, "step");
  hooke_options *chosen = NULL;
  int32_t status = HOOKE_OK;
  if (cli_arguments_text(run->arguments, "want")) {
    status = hooke_options_create("run", &chosen);
    if (status == HOOKE_OK) status = hooke_options_set_text(chosen, "method", cli_run_method(run));
    if (status == HOOKE_OK && !isnan(step)) status = hooke_options_set_number(chosen, "step", step);
  }
  if (status == HOOKE_OK)
    cli_command_add(text, run->arguments, "why", chosen);
  else
    text->status = status;
  hooke_options_destroy(chosen);
}

void cli_blow_up_add_why(struct cli_string *text, const struct cli_run *run) {
  if (!run->output || run->page) {
    add_scene(text, run);
  } else {
    cli_string_add(text, "hooke why ");
    cli_string_quote(text, run->output);
    const char *force = cli_arguments_text(run->arguments, "force");
    if (force) cli_string_add(text, " --force ");
    if (force) cli_string_quote(text, force);
  }
  if (hooke_build_fact("chartjs")[0]) cli_string_add(text, " --report why.html");
}

/* ---- what is kept ---- */

/* What the option past_divergence added. */
static void tell_beyond(const struct cli_run *run) {
  if (run->frames_beyond > 0)
    fprintf(stderr, ", and %" PRId64 " after it diverged, which are no physics", run->frames_beyond);
  else if (hooke_method_is_adaptive(cli_run_method(run)))
    fputs("; none after it diverged, where an error-controlled method ends", stderr);
  else
    fputs(
        "; none after it diverged, since numbers overflowed before the next one: a smaller --every shows how",
        stderr);
}

static void tell_kept(const struct cli_run *run) {
  const int64_t frames = run->frames - run->frames_beyond;
  char number[HOOKE_NUMBER_SIZE];
  if (!run->output) {
    fputs("kept: nothing; -o out.h5 keeps the frames up to there\n", stderr);
    return;
  }
  fprintf(stderr, "kept: %" PRId64 " frame%s ", frames, frames == 1 ? "" : "s");
  if (!isnan(run->last_frame))
    fprintf(stderr, "up to t = %s s ", cli_format_rounded(run->last_frame, number));
  fputs("in ", stderr);
  cli_print_text(stderr, run->page ? run->page : run->output);
  if (cli_run_goes_beyond(run)) tell_beyond(run);
  fputc('\n', stderr);
}

void cli_blow_up_tell(const struct cli_run *run) {
  tell_what(run);
  if (run->arguments->quiet) return;
  tell_try(run);
  struct cli_string why = {.bytes = NULL};
  cli_blow_up_add_why(&why, run);
  if (why.status == HOOKE_OK) fprintf(stderr, "see: %s\n", why.bytes);
  free(why.bytes);
  tell_kept(run);
}
