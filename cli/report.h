/* Failures told to a person, to a program (--json) and to the shell. */
#ifndef HOOKE_CLI_REPORT_H
#define HOOKE_CLI_REPORT_H

#include "arguments.h"

#include <stdio.h>

/* Exit code of a status of the library. */
int hooke_exit_code(int32_t status);

/* Prints "hooke VERB: message" on standard error and, with --json, {"error": {"exit", "message"}} on standard
 * output. Returns `code`. */
int hooke_report(const struct hooke_arguments *arguments, int code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same with the library's message about `status`. */
int hooke_report_status(const struct hooke_arguments *arguments, int32_t status);

/* Prints "hooke VERB: message" on standard error alone. */
void hooke_report_words(const struct hooke_arguments *arguments, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Prints the command again, with `method` and `step` in place of its own where they are not NULL. */
void hooke_report_command(FILE *file, const struct hooke_arguments *arguments, const char *method,
                          const char *step);

/* Writes the names of all methods, "a, b, c". */
void hooke_report_methods(char *list, size_t size);

/* Reports a method that does not exist, given as `word` (its first `length` bytes) to the option `flag`. */
int hooke_report_unknown_method(const struct hooke_arguments *arguments, const char *flag, const char *word,
                                size_t length);

/* The candidate nearest to a mistyped word, NULL if none is near. `next` gives candidate i, NULL past the
 * last. */
const char *hooke_suggest(const char *word, const char *(*next)(int64_t i, const void *ctx), const void *ctx);

#endif
