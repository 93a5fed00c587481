/* The program as a whole: its verbs, and the options that stand in place of one. */
#ifndef HOOKE_CLI_PROGRAM_H
#define HOOKE_CLI_PROGRAM_H

#include "verb.h"

struct cli_program;

struct cli_program_row {
  const char *name;
  char letter;       /* 0: none */
  const char *value; /* the word that has to follow; NULL: none */
  const char *doc;
  int (*print)(const struct cli_program *program); /* an exit code */
};

struct cli_program {
  const struct cli_verb *const *verbs; /* the end is NULL */
  const struct cli_program_row *rows;  /* the end has no name */
  const char *summary, *text;          /* what it does, in a line and in a paragraph */
};

#endif
