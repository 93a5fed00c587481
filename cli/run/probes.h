/* Quantities of a run, written while it goes: --probe, --probe-every and --probes. */
#pragma once

#include "run_results.h"

/* Reads the three options, of which the first and the last come together, and refuses the output as file.
 * Does nothing without them, as all here. */
int cli_probes_read(struct cli_run *run);

/* Begins to write them over the run of its integrator, and ends that. */
int32_t cli_probes_begin(struct cli_run *run);
int32_t cli_probes_end(struct cli_run *run);
