/* Failures reported in words, as JSON (--json), and to the shell. */
#pragma once

#include "arguments.h"

#include <stddef.h>

/* Exit code for a status of the library. */
int cli_exit_code(int32_t status);

/* Exit code for a refused value of an option: wrong usage or, where the values make up a scene, bad input. */
int cli_refusal(const struct cli_arguments *arguments);

/* Prints "hooke VERB: message" on standard error and, with --json, {"error": {"exit", "message"}} on standard
 * output. Returns `code`. */
int cli_report(const struct cli_arguments *arguments, int code, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* The same with the library's message about `status`. */
int cli_report_status(const struct cli_arguments *arguments, int32_t status);

/* Prints "hooke VERB: message" on standard error only. */
void cli_report_words(const struct cli_arguments *arguments, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/* Warnings, a line each, until they are told. */
enum { HOOKE_WARNINGS_SIZE = 4096 };
/* Adds one of the library to such a text, as a hooke_warning. */
int32_t cli_warnings_hear(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                          int64_t particle, void *warnings);
/* Tells them as "warning: ...", and empties the text. */
void cli_warnings_tell(const struct cli_arguments *arguments, char *warnings);

/* Reports that memory was missing for a part of the output; the rest is printed. */
int cli_report_missing_words(const struct cli_arguments *arguments);

/* Writes the names of all methods, "a, b, c". */
void cli_report_methods(char *list, size_t size);

/* Reports a method that does not exist, given as `word` (its first `length` bytes) to the option `flag`. */
int cli_report_unknown_method(const struct cli_arguments *arguments, const char *flag, const char *word,
                              size_t length);

/* Keeps that the force of a library has ended some work; 1 if one has; and what has, if work was stopped:
 * that, or "interrupted". */
void cli_force_fail(const char *file, int32_t value);
int32_t cli_force_failed(void);
const char *cli_force_stop(void);
