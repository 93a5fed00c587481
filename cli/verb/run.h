/* The verb run, for a verb that shows a run. */
#ifndef HOOKE_CLI_RUN_H
#define HOOKE_CLI_RUN_H

#include "run_results.h"

/* Runs the scene, with --want or its own method, into a trajectory that is removed once `show` has written it
 * as `page`. `path` names it, for cli_os_make_file(). After a blow-up, up to `beyond` frames show how
 * it goes on. Everything is reported; returns the exit code. */
typedef int cli_show(const struct cli_run *run);
int cli_run_to_show(const struct cli_arguments *arguments, char *path, const char *page, double beyond,
                    cli_show *show);

#endif
