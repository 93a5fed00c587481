/* hooke run --resume: allowed options, and messages. */
#ifndef HOOKE_CLI_RESUME_H
#define HOOKE_CLI_RESUME_H

#include "setup.h"

/* Reports options that --resume takes from the run itself, and --checkpoint without a file to write it
 * beside. */
int cli_resume_check(const struct cli_arguments *arguments);

/* Says how to continue an interrupted run; `kept`: status of its last checkpoint. */
void cli_resume_tell_how(const struct cli_arguments *arguments, const char *output, int32_t kept);

/* For a run that had finished: the last frame, the number of frames, and of steps, -1 if the file does not
 * say. */
int32_t cli_resume_read_finished(const char *output, hooke_state *state, int64_t *frames, int64_t *steps);

#endif
