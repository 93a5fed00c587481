/* Forms of what is known about the program, filled in by one walk over its verbs, kinds and options: help,
 * the manual page, and completion for shells. */
#ifndef HOOKE_CLI_FORM_H
#define HOOKE_CLI_FORM_H

#include "arguments.h"
#include "program.h"

#include <stdio.h>

/* A text with <field>, with <field:text> for where the field is not empty, <!field:text> for where it is, and
 * <loop:text> once for each item; form.c has the fields and the loops. In <field/characters> these have a
 * backslash before them. <tab/20> goes on to that column; so does <to/28>, where a column of text begins. */
struct cli_form {
  const char *text;
  const char *const *escapes; /* of fields: a character, then what stands for it; ends with NULL */
  int32_t is_roff;            /* all lines are broken, and no field begins a request */
};

/* Prints the form, of one verb (and kind) if there are arguments, else of the program. These functions return
 * an exit code; failures are reported already. */
int cli_form_print(FILE *file, const struct cli_form *form, const struct cli_program *program,
                   const struct cli_arguments *arguments);

/* `hooke --help`, `hooke VERB --help`, and `hooke --version`. */
int cli_usage_print(FILE *file, const struct cli_program *program);
int cli_usage_print_verb(FILE *file, const struct cli_arguments *arguments);
int cli_version_print(const struct cli_program *program, const char *value);

/* A script that completes verbs, kinds, options, their words and files in the shell "bash", "zsh" or "fish";
 * HOOKE_EXIT_USAGE for another one. */
int cli_completion_print(const struct cli_program *program, const char *shell);

/* hooke(1) in the macros of man(7). Its date is that of SOURCE_DATE_EPOCH if set, else today. */
int cli_man_print(const struct cli_program *program, const char *value);

#endif
