/* The texts of --help and --version. */
#ifndef HOOKE_CLI_USAGE_H
#define HOOKE_CLI_USAGE_H

#include "arguments.h"
#include "program.h"

#include <stdio.h>

/* `hooke --help`. */
void cli_usage_print_all(FILE *file, const struct cli_program *program);

/* `hooke VERB --help`. Returns an exit code. */
int cli_usage_print_verb(FILE *file, const struct cli_arguments *arguments);

/* `hooke --version`. */
void cli_usage_print_version(FILE *file);

#endif
