/* The memory of this process, and from it the peak of a run of the scene that it has loaded. */
#ifndef HOOKE_CLI_PEAK_H
#define HOOKE_CLI_PEAK_H

#include "setup.h"

struct cli_peak {
  int64_t now, most; /* resident, and the most that was so far [bytes]; 0: the system does not say */
};

/* To be asked for right after the scene was loaded, by what a run does as well. */
struct cli_peak cli_peak_look(void);

/* Bytes at the peak of a 'hooke run': */
struct cli_foretold {
  int64_t most;    /* of loading, or of what is resident after it with all that the method takes */
  int64_t written; /* with -o */
  int64_t factor;  /* with a factor, which an implicit method makes where that pays; 0: it makes none */
  int64_t counted; /* the part that belongs to system, state and method */
};

/* A method whose options do not suffice is left out. Failures are reported and come back as exit code. */
int cli_peak_of_run(const struct cli_arguments *arguments, const struct cli_setup *setup,
                    struct cli_peak loaded, struct cli_foretold *foretold);

#endif
