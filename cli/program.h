/* The whole program: its verbs, and the options that replace one. */
#ifndef HOOKE_CLI_PROGRAM_H
#define HOOKE_CLI_PROGRAM_H

#include "verb.h"

struct cli_program;

struct cli_program_row {
  struct cli_verb_row is; /* its value is the word that has to follow */
  const char *words;      /* which it may be, separated by blanks */
  /* returns an exit code, HOOKE_EXIT_USAGE for another word than these */
  int (*print)(const struct cli_program *program, const char *value);
};

struct cli_program {
  const struct cli_verb *const *verbs; /* ends with NULL */
  const struct cli_program_row *rows;  /* ends without a name */
  const char *summary, *text;          /* description, in one line and in a paragraph */
};

#endif
