/* Files that a verb is to write, looked at before any work, so that a long one is not lost to a wrong
 * name. */
#ifndef HOOKE_CLI_OUTPUT_FILE_H
#define HOOKE_CLI_OUTPUT_FILE_H

#include "arguments.h"

/* `file`, given to `flag`, can be written, and is not the scene. Returns the exit code. */
int cli_output_file_check(const struct cli_arguments *arguments, const char *flag, const char *file);

/* The same for --report, whose build must have what draws it; NULL is allowed. */
int cli_output_file_check_report(const struct cli_arguments *arguments, const char *report);

#endif
