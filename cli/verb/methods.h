/* The methods of --methods a,b,c. */
#ifndef HOOKE_CLI_METHODS_H
#define HOOKE_CLI_METHODS_H

#include "arguments.h"

enum { HOOKE_MOST_METHODS = 32 };

struct cli_methods {
  const char *name[HOOKE_MOST_METHODS]; /* the library's own copies, all different */
  int32_t count;
};

/* The requested methods, or every method of this build. A method that does not exist, is not in this build or
 * is named twice is reported and returned as exit code. */
int cli_methods_choose(const struct cli_arguments *arguments, struct cli_methods *methods);

#endif
