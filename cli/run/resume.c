#include "resume.h"

#include "print.h"
#include "report.h"

#include <stdio.h>
#include <stdlib.h>

static const double MOST_STEPS = 9007199254740992.0; /* 2^53, up to which doubles hold every integer */
static const char MAY_BE_GIVEN[] = "resume threads final no-why json quiet help";

int cli_resume_check(const struct cli_arguments *arguments) {
  const char *file = cli_arguments_text(arguments, "resume");
  if (!file && cli_arguments_text(arguments, "checkpoint") && !cli_arguments_text(arguments, "output")) {
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "--checkpoint keeps places to go on from beside the output; give one with -o OUT.h5");
  }
  for (int32_t i = 0; file && i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    if (!argument->text || cli_is_among(MAY_BE_GIVEN, argument->name)) continue;
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "--resume goes on with the scene and the options of %s, so that the bits are those of "
                      "a run that never stopped; leave out --%s",
                      file, argument->flag);
  }
  return HOOKE_EXIT_DONE;
}

void cli_resume_tell_how(const struct cli_arguments *arguments, const char *output, int32_t kept) {
  if (kept == HOOKE_UNSUITED)
    cli_report_words(
        arguments,
        "this method goes on from checkpoints alone, and --checkpoint DT was not given: it begins again");
  fputs("to go on:\n  hooke run --resume ", stderr);
  cli_print_quoted(stderr, output);
  fputc('\n', stderr);
}

/* Number of the step after which the last of `frames` was written; -1 if the file does not say. */
static int32_t read_steps(hooke_record *record, int64_t frames, int64_t *steps) {
  int64_t rows = 0, columns = 0;
  *steps = -1;
  int32_t status = hooke_record_size(record, "step", &rows, &columns);
  if (status != HOOKE_OK || frames < 1 || rows < frames || columns != 1) return status;
  double *all = malloc((size_t)rows * sizeof *all);
  if (all == NULL) return HOOKE_NO_MEMORY;
  status = hooke_record_numbers(record, "step", all);
  if (status == HOOKE_OK && all[frames - 1] >= 0.0 && all[frames - 1] <= MOST_STEPS)
    *steps = (int64_t)all[frames - 1];
  free(all);
  return status;
}

int32_t cli_resume_read_finished(const char *output, hooke_state *state, int64_t *frames, int64_t *steps) {
  hooke_record *record = NULL;
  int32_t status = hooke_record_open(output, &record);
  if (status == HOOKE_OK) status = hooke_record_read(record, -1, state);
  if (status == HOOKE_OK) *frames = hooke_record_count(record, "frames");
  if (status == HOOKE_OK) status = read_steps(record, *frames, steps);
  hooke_record_close(record);
  return status;
}
