/* The command line: parsed by getopt_long, with the options of a run, and of anything else that a verb
 * configures, taken from the library's option tables. */
#pragma once

#include "verb.h"

enum { HOOKE_FLAG_SIZE = 64 };

/* An option of a verb: its own, or a row of an option table. */
struct cli_argument {
  char flag[HOOKE_FLAG_SIZE];     /* as typed, without the dashes */
  const char *name;               /* "atol_velocity", "output" */
  const struct cli_verb_row *own; /* NULL: row `row` of `table` */
  hooke_options *table;
  int64_t row;
  const char *text; /* the given text, "" for a switch; NULL: not given */
  char *value;      /* the same in SI units, for a row of a table */
};

struct cli_arguments {
  const struct cli_verb *const *verbs; /* all of the program; NULL ends them */
  const struct cli_verb *verb;
  const char *scene;        /* or the kind, for a verb that takes one */
  char *const *more_scenes; /* beside it, for a verb that takes several */
  int32_t more_count;
  int32_t help, json, quiet; /* help 2: with every option described */
  hooke_options *run;        /* the option table of a run, with the given values */
  hooke_options *more;       /* that of the verb, likewise; NULL: none */
  hooke_options *limits;     /* that of loading a scene, likewise; NULL: the verb loads none */
  hooke_options *of_kind;    /* that of the kind, likewise; NULL: none */
  struct cli_argument *all;
  int32_t count;
};

/* Fills `arguments`, which is zeros, with every option of the verb (with this `kind`, NULL: none): those of
 * the kind, of its own table, its own, the common ones, those of a run. */
int cli_arguments_collect(const struct cli_verb *verb, const char *kind, struct cli_arguments *arguments);

/* Parses the words after the verb (argv[0] is the verb), one of all `verbs`; wrong usage is reported and
 * returns HOOKE_EXIT_USAGE. The caller destroys `arguments` in either case. */
int cli_arguments_parse(const struct cli_verb *const *verbs, const struct cli_verb *verb, int argc,
                        char **argv, struct cli_arguments *arguments);
void cli_arguments_destroy(struct cli_arguments *arguments);

/* 1 if `name` is among `words`, which blanks separate (NULL: none). */
int32_t cli_is_among(const char *words, const char *name);

/* An option's name on the command line, without the dashes: "atol-velocity". Returns `flag`. */
const char *cli_arguments_flag(const char *name, char flag[HOOKE_FLAG_SIZE]);

/* Text given for an option; NULL if it was not given. */
const char *cli_arguments_text(const struct cli_arguments *arguments, const char *name);

/* 1 if a flag of the verb's own table is set. */
int32_t cli_arguments_asks(const struct cli_arguments *arguments, const char *name);

/* 1 if an option of a run was given. */
int32_t cli_arguments_has_run(const struct cli_arguments *arguments);
/* Sets every option of a run that was given. */
int32_t cli_arguments_apply(const struct cli_arguments *arguments, hooke_options *options);

/* The argument of a verb: "SCENE", "KIND", "OUT.h5". */
const char *cli_arguments_operand(const struct cli_verb *verb);

/* 1 for a row of a table that is true or false: it stands alone, or with "=false". */
int32_t cli_argument_is_flag(const struct cli_argument *argument);
/* 1 if repeating the row of a table adds to the previous value: rows of numbers, lists of words and numbers.
 */
int32_t cli_argument_adds_up(const struct cli_argument *argument);
