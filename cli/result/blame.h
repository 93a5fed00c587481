/* What a limit hangs on, for a program. */
#ifndef HOOKE_CLI_BLAME_H
#define HOOKE_CLI_BLAME_H

#include "print.h"

/* One entry: a spring between `first` and `second`, or, where `force` is not "", that force. */
void cli_blame_json(struct cli_json *json, const char *force, double first, double second, const char *group,
                    double share);

#endif
