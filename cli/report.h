/* Failures told to a person, to a program (--json) and to the shell. */
#ifndef HOOKE_CLI_REPORT_H
#define HOOKE_CLI_REPORT_H

#include "arguments.h"

#include <stdio.h>

/* Exit code of a status of the library. */
int cli_exit_code(int32_t status);

/* Exit code of a value of an option that is refused: wrong usage, or, where the values make up a scene, bad
 * input. */
int cli_refusal(const struct cli_arguments *arguments);

/* Prints "hooke VERB: message" on standard error and, with --json, {"error": {"exit", "message"}} on standard
 * output. Returns `code`. */
int cli_report(const struct cli_arguments *arguments, int code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same with the library's message about `status`. */
int cli_report_status(const struct cli_arguments *arguments, int32_t status);

/* Prints "hooke VERB: message" on standard error alone. */
void cli_report_words(const struct cli_arguments *arguments, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* There was no memory for a part of what is printed; the rest is. */
int cli_report_missing_words(const struct cli_arguments *arguments);

/* An option of a run that a command is to have. */
struct cli_setting {
  const char *name, *text; /* text NULL: not wanted after all */
};

/* Prints the command again as one of `verb`, with `settings`, whose end is a NULL name, in place of its own;
 * for another verb than its own, of what was given only the options of a run. */
void cli_report_command(FILE *file, const struct cli_arguments *arguments, const char *verb,
                        const struct cli_setting *settings);

/* Writes the names of all methods, "a, b, c". */
void cli_report_methods(char *list, size_t size);

/* Reports a method that does not exist, given as `word` (its first `length` bytes) to the option `flag`. */
int cli_report_unknown_method(const struct cli_arguments *arguments, const char *flag, const char *word,
                              size_t length);

/* The candidate nearest to a mistyped word, NULL if none is near. `next` gives candidate i, NULL past the
 * last. */
const char *cli_suggest(const char *word, const char *(*next)(int64_t i, const void *ctx), const void *ctx);

#endif
