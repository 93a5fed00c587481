/* hooke run --resume: what may be given with it, and what is said of it. */
#ifndef HOOKE_CLI_RESUME_H
#define HOOKE_CLI_RESUME_H

#include "setup.h"

/* Reports options that --resume takes from the run itself, and --checkpoint without a file to write beside. */
int hooke_resume_check(const struct hooke_arguments *arguments);

/* How to go on with an interrupted run; `kept`: status of its last checkpoint. */
void hooke_resume_tell_how(const struct hooke_arguments *arguments, const char *output, int32_t kept);

/* Says that the run had finished, with the results that its file still has. Returns the exit code. */
int hooke_resume_tell_finished(const struct hooke_arguments *arguments, const struct hooke_setup *setup);

#endif
