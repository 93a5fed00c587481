#include "blow_up.h"

#include "claims.h"
#include "command.h"
#include "report.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

static const char report_name[] = "why.html";

/* ---- what happened ---- */

/* The claim of the cause; of a message its first clause, since the rest suggests what to try. */
static void tell_what(const struct cli_run *run) {
  const char *what = run->why ? cli_claim(run->why, "cause") : run->message, *end = strstr(what, "; ");
  cli_report_words(run->arguments, "%.*s", !run->why && end ? (int)(end - what) : (int)strlen(what), what);
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

void cli_blow_up_print_why(FILE *file, const struct cli_run *run) {
  char number[HOOKE_NUMBER_SIZE];
  const int chosen = cli_arguments_text(run->arguments, "want") != NULL;
  const double step = hooke_options_number(run->options, "step");
  const char *report = hooke_build_fact("chartjs")[0] ? report_name : NULL;
  const struct cli_setting settings[] = {
      {"method", chosen ? cli_run_method(run) : NULL},
      {"step", chosen && !isnan(step) ? cli_format_number(step, number) : NULL},
      {"report", report},
      {NULL, NULL}};
  if (!run->output || run->page) {
    cli_command_print(file, run->arguments, "why", settings);
    return;
  }
  fputs("hooke why ", file);
  cli_print_quoted(file, run->output);
  if (report) fprintf(file, " --report %s", report);
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
  fputs("see: ", stderr);
  cli_blow_up_print_why(stderr, run);
  fputc('\n', stderr);
  tell_kept(run);
}
