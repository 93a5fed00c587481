/* Output files of a verb, checked before any work, so that a wrong name does not waste a long run. */
#ifndef HOOKE_CLI_OUTPUT_FILE_H
#define HOOKE_CLI_OUTPUT_FILE_H

#include "setup.h"

/* Refuses `file` (NULL: none), given to `flag`, if it ends like another kind than the option writes, and says
 * what writes that kind; with the scene it is known whether it can be written. Returns the exit code. */
int cli_output_file_check(const struct cli_arguments *arguments, const char *flag, const char *file);

/* The same for --report, which also needs the drawing library in this build; NULL is allowed. */
int cli_output_file_check_report(const struct cli_arguments *arguments);

/* Writes the page of --report, if it was given, with the title of the scene.
 * Returns `code`, or that of a page that could not be written. */
int cli_output_file_write_report(const struct cli_arguments *arguments, const struct cli_setup *setup,
                                 hooke_measurement *measurement, int code);

#endif
