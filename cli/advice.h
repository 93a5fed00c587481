/* What to do about a run that ended early: a command to type. */
#ifndef HOOKE_CLI_ADVICE_H
#define HOOKE_CLI_ADVICE_H

#include "arguments.h"
#include "setup.h"

#include <stdio.h>

void hooke_advice_print(FILE *file, const struct hooke_arguments *arguments, const struct hooke_setup *setup,
                        const hooke_integrator *integrator, int32_t outcome);

/* The largest handy step (1, 2 or 5 times a power of ten, else a whole part of `step`) up to `limit` that
 * fits whole into `every` (NaN: not asked for) and `duration`, as `step` does. */
double hooke_advice_step(double step, double limit, double every, double duration);

#endif
