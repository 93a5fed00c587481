/* A step that fits `every` and the duration, see hooke_step_fit(). */
#ifndef HOOKE_CLI_FIT_H
#define HOOKE_CLI_FIT_H

#include "setup.h"

/* Chooses the step if none is given, and adjusts step, `every` and `duration` to fit one another; each change
 * is reported in a line. With --strict nothing is chosen or changed. That a step cannot be chosen is
 * reported, or with `may_lack` left to what comes. */
int cli_fit_run(const struct cli_arguments *arguments, struct cli_setup *setup, int32_t may_lack);

#endif
