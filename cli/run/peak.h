/* The memory of this process, and from it the peak of a run of the scene that it has loaded. */
#ifndef HOOKE_CLI_PEAK_H
#define HOOKE_CLI_PEAK_H

#include "setup.h"

struct cli_peak {
  int64_t now, most; /* resident, and the most that was so far [bytes]; 0: the system does not say */
};

/* To be asked for right after the scene was loaded, by what a run does as well. */
struct cli_peak cli_peak_look(void);

/* Bytes at the peak of 'hooke run' without -o: of loading, or of what is resident after it with all that the
 * method takes; and `counted`, the part that belongs to system, state and method. A method whose options do
 * not suffice is left out. Failures are reported and come back as exit code. */
int cli_peak_of_run(const struct cli_arguments *arguments, const struct cli_setup *setup,
                    struct cli_peak loaded, int64_t *bytes, int64_t *counted);

#endif
