/* The manual page. */
#ifndef HOOKE_CLI_MAN_H
#define HOOKE_CLI_MAN_H

#include "program.h"

/* Prints hooke(1) in the macros of man(7). Its date is that of SOURCE_DATE_EPOCH if set, else today. Returns
 * the exit code; failures are reported already. */
int cli_man_print(const struct cli_program *program, const char *value);

#endif
