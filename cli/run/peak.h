/* Memory of this process, and from it the peak of a run of the loaded scene. */
#ifndef HOOKE_CLI_PEAK_H
#define HOOKE_CLI_PEAK_H

#include "setup.h"

struct cli_peak {
  int64_t now, most; /* resident memory, and its maximum so far [bytes]; 0: unknown */
};

/* Call right after loading the scene, as a run does. */
struct cli_peak cli_peak_look(void);

/* Peak memory of a 'hooke run' [bytes]: */
struct cli_foretold {
  int64_t most;    /* of loading, or of the resident memory after it with that of the method */
  int64_t written; /* with -o */
  int64_t factor;  /* with a factor, which an implicit method computes where that pays; 0: none */
  int64_t counted; /* the part of system, state and method */
};

/* A method whose options are insufficient is skipped. Failures are reported and returned as exit code. */
int cli_peak_of_run(const struct cli_arguments *arguments, const struct cli_setup *setup,
                    struct cli_peak loaded, struct cli_foretold *foretold);

#endif
