/* Cost of each ingredient of a scene, for hooke check. */
#ifndef HOOKE_CLI_COST_SHEET_H
#define HOOKE_CLI_COST_SHEET_H

#include "setup.h"

/* Measures the costs at the initial state, with progress; the caller destroys `cost` in either case. Failures
 * are reported and returned as exit code, HOOKE_EXIT_INTERRUPTED with the rows so far. */
int cli_cost_sheet_find(const struct cli_arguments *arguments, const struct cli_setup *setup,
                        hooke_measurement **cost);

/* Prints the table on standard output. */
void cli_cost_sheet_print(const hooke_measurement *cost, const hooke_system *system);
/* Prints the members that commit dropped on standard output. */
void cli_cost_sheet_print_left_out(const hooke_system *system);

#endif
