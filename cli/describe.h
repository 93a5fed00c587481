/* Descriptions of verbs, options, kinds and exit codes, for --help, the manual page and completion. */
#pragma once

#include "arguments.h"

enum { HOOKE_DOC_SIZE = 1024 };

/* An option as a row: its flag, argument and text. */
struct cli_description {
  struct cli_verb_row is;
  char value[HOOKE_FLAG_SIZE], doc[HOOKE_DOC_SIZE]; /* of a row of a table */
};
const struct cli_verb_row *cli_describe(const struct cli_argument *argument,
                                        struct cli_description *description);

/* The family of an option, and its description; "": none. */
const char *cli_describe_family(const struct cli_argument *argument, const char **doc);

/* A complete command that makes a part of the current kind, from the examples of its table. */
const char *cli_describe_example(const struct cli_arguments *arguments, char command[HOOKE_DOC_SIZE]);

/* The words that may follow an option, separated by blanks: methods, choices; "" if it takes anything. `many`
 * is 1 if it takes several, separated by commas. */
const char *cli_describe_words(const struct cli_argument *argument, char words[HOOKE_DOC_SIZE],
                               int32_t *many);

/* Ending of the files that an option takes, "" for any; NULL if it takes no file. */
const char *cli_describe_file(const struct cli_argument *argument);

/* Exit codes; one without a meaning ends them. */
extern const struct cli_exit_row {
  int32_t code;
  const char *meaning;
} cli_exits[];
