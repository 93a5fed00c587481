/* What the program tells of itself, from the rows of its verbs, kinds and options: help, the manual page, and
 * completion for shells. */
#pragma once

#include "arguments.h"

#include <stdio.h>

/* The whole program: its verbs, and the options that replace one. */
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

/* `hooke --help`, and of a verb (and kind), whose options need not be collected before a kind is known. */
void cli_usage_print(FILE *file, const struct cli_program *program);
void cli_usage_print_verb(FILE *file, const struct cli_arguments *arguments);

/* These return an exit code; failures are reported already. */
int cli_version_print(const struct cli_program *program, const char *value);

/* A script for the shell "bash", "zsh" or "fish" that asks `hooke --complete`; HOOKE_EXIT_USAGE for another
 * one. */
int cli_completion_print(const struct cli_program *program, const char *shell);

/* What may stand in place of the last of `count` words, which come after "hooke" and begin with the verb
 * (NULL: with none): a line "words", "list" (a comma may follow) or "files ENDINGS" (none: any), then lines
 * of a word, a tab and its description. */
int cli_complete(const struct cli_program *program, const struct cli_verb *verb, int count, char **words);

/* hooke(1) in the macros of man(7). Its date is that of SOURCE_DATE_EPOCH if set, else today. */
int cli_man_print(const struct cli_program *program, const char *value);
