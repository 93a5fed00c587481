/* hooke run --resume: what may be given with it, and what is said of it. */
#ifndef HOOKE_CLI_RESUME_H
#define HOOKE_CLI_RESUME_H

#include "setup.h"

/* Reports options that --resume takes from the run itself, and --checkpoint without a file to write
 * beside. */
int cli_resume_check(const struct cli_arguments *arguments);

/* How to go on with an interrupted run; `kept`: status of its last checkpoint. */
void cli_resume_tell_how(const struct cli_arguments *arguments, const char *output, int32_t kept);

/* Of a run that had finished: the last frame, how many there are, and the steps that it took, -1 if the file
 * does not say. */
int32_t cli_resume_read_finished(const char *output, hooke_state *state, int64_t *frames, int64_t *steps);

#endif
