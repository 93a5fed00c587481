#include "report.h"
#include "print.h"
#include "words.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define BOLD  "1" /* styles of terminals */
#define RED   "1;31"
#define GREEN "1;32"

enum { MESSAGE_SIZE = 4096, WORD_SIZE = 48, LIST_SIZE = 512 };
enum { WIDTH = 90, LEFT = 60, LONGEST_CHARACTER = 4 }; /* of an excerpt */

static char failure[512]; /* of the force of this program, which has one at most */

void cli_force_fail(const char *file, int32_t value) {
  snprintf(failure, sizeof failure, "the force of %s returned %d", file, (int)value);
}

int32_t cli_force_failed(void) {
  return failure[0] != '\0';
}

const char *cli_force_stop(void) {
  return failure[0] ? failure : "interrupted";
}

/* Others are bad input: a value, a scene too large for the memory, or a force that ends the work. */
int cli_exit_code(int32_t status) {
  static const int32_t codes[][2] = {
      {HOOKE_OK, HOOKE_EXIT_DONE},           {HOOKE_STOPPED, HOOKE_EXIT_INTERRUPTED},
      {HOOKE_DIVERGED, HOOKE_EXIT_DIVERGED}, {HOOKE_STEP_LIMIT, HOOKE_EXIT_DIVERGED},
      {HOOKE_IO_FAILED, HOOKE_EXIT_IO},      {HOOKE_SOLVER_FAILED, HOOKE_EXIT_DIVERGED},
      {HOOKE_INTERNAL, HOOKE_EXIT_INTERNAL}, {HOOKE_NOT_BUILT, HOOKE_EXIT_NOT_BUILT},
  };
  for (size_t k = 0; k < sizeof codes / sizeof codes[0]; k++)
    if (codes[k][0] == status && !(status == HOOKE_STOPPED && cli_force_failed())) return codes[k][1];
  return HOOKE_EXIT_BAD_INPUT;
}

int cli_refusal(const struct cli_arguments *arguments) {
  return arguments->verb->takes_kind ? HOOKE_EXIT_BAD_INPUT : HOOKE_EXIT_USAGE;
}

/* https://no-color.org */
static int has_colour(void) {
  const char *refused = getenv("NO_COLOR"), *terminal = getenv("TERM");
  return isatty(STDERR_FILENO) && !(refused && refused[0]) && terminal && strcmp(terminal, "dumb") != 0;
}

static void print_styled(const char *style, const char *text) {
  if (has_colour())
    fprintf(stderr, "\033[%sm%s\033[0m", style, text);
  else
    fputs(text, stderr);
}

/* ---- the line of a scene that a message is about ---- */

/* The numbers after the path; 0 if they are not there. */
static int find_place(const char *path, const char *message, long *line, long *column) {
  const size_t length = strlen(path);
  char end;
  return strncmp(message, path, length) == 0 &&
         sscanf(message + length, ":%ld:%ld%c", line, column, &end) == 3 && end == ':' && *line > 0 &&
         *column > 0;
}

static int is_continuation(int byte) {
  return (byte & 0xc0) == 0x80; /* of a character of UTF-8 */
}

static void skip_lines(FILE *from, long count) {
  for (int byte; count > 0 && (byte = getc(from)) != EOF;)
    count -= byte == '\n';
}

/* The characters `first` (from 1) to first + WIDTH - 1 of a line. */
static void read_line(FILE *from, long first, char *text) {
  long character = 0;
  for (int byte; (byte = getc(from)) != EOF && byte != '\n' && byte != '\r' && byte != '\0';) {
    character += !is_continuation(byte);
    if (character >= first + WIDTH) break;
    if (character >= first) *text++ = (char)(byte == '\t' ? ' ' : byte);
  }
  *text = '\0';
}

/* Of a trajectory, the text of its scene. */
static FILE *open_source(const char *path) {
  hooke_record *record;
  if (hooke_record_open(path, &record) != HOOKE_OK) return fopen(path, "rb");
  FILE *file = tmpfile();
  if (file) fputs(hooke_record_text(record, "scene"), file);
  if (file) rewind(file);
  hooke_record_close(record);
  return file;
}

/* For a message that begins with "PATH:LINE:COLUMN: ", with that path, prints the line, shortened, and a
 * caret under its column (in characters). Of a trajectory it is the line of its scene. Prints nothing for
 * another message or an unreadable file. Changes the library's last error. */
static void print_excerpt(const char *path, const char *message) {
  char text[LONGEST_CHARACTER * WIDTH + 1];
  long line, column;
  if (!find_place(path, message, &line, &column)) return;
  FILE *from = open_source(path);
  if (!from) return;
  const long first = column > LEFT ? column - LEFT : 1;
  skip_lines(from, line - 1);
  read_line(from, first, text);
  fclose(from);
  fprintf(stderr, "%6ld | ", line);
  cli_print_text(stderr, text);
  fprintf(stderr, "\n       | %*s", (int)(column - first), "");
  print_styled(GREEN, "^");
  fputc('\n', stderr);
}

/* ---- messages ---- */

/* With the place of the scene that a message names below it. */
static void say(const struct cli_arguments *arguments, const char *style, const char *message) {
  char begin[WORD_SIZE];
  snprintf(begin, sizeof begin, "hooke %s:", arguments->verb->name);
  print_styled(style, begin);
  fputc(' ', stderr);
  cli_print_text(stderr, message);
  fputc('\n', stderr);
  if (arguments->scene) print_excerpt(arguments->scene, message);
}

static int report_json(const struct cli_arguments *arguments, int code, const char *message) {
  if (arguments->json) {
    cli_print_json("{");
    cli_print_json_set(arguments->limits);
    cli_print_json("'error': {'exit': %d, 'message': %s}}\n", code, message);
  }
  return code;
}

int cli_report(const struct cli_arguments *arguments, int code, const char *format, ...) {
  char message[MESSAGE_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  say(arguments, RED, message);
  return report_json(arguments, code, message);
}

/* The library's message has a line for each fault of a scene; in other ones a line end is foreign text. */
int cli_report_status(const struct cli_arguments *arguments, int32_t status) {
  const char *near = arguments->scene && !arguments->of_kind ? cli_suggest_file(arguments->scene) : NULL;
  char message[MESSAGE_SIZE], line[MESSAGE_SIZE]; /* an excerpt may change the last error */
  snprintf(message, sizeof message, "%s%s%s%s",
           hooke_last_error()[0] ? hooke_last_error() : hooke_status_name(status), near ? "; " : "",
           near ? near : "", near ? " is there" : "");
  for (const char *at = message; *at; at += strspn(at, "\n")) {
    const size_t length = strcspn(at, "\n");
    snprintf(line, sizeof line, "%.*s", (int)length, at);
    say(arguments, RED, line);
    at += length;
  }
  return report_json(arguments, cli_exit_code(status), message);
}

void cli_report_words(const struct cli_arguments *arguments, const char *format, ...) {
  char message[MESSAGE_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  say(arguments, BOLD, message);
}

int32_t cli_warnings_hear(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                          int64_t particle, void *warnings) {
  (void)kind, (void)t, (void)limit, (void)spring, (void)particle;
  cli_append(warnings, HOOKE_WARNINGS_SIZE, "%s\n", sentence);
  return 0;
}

void cli_warnings_tell(const struct cli_arguments *arguments, char *warnings) {
  for (char *line = warnings, *end; (end = strchr(line, '\n')) != NULL; line = end + 1)
    cli_report_words(arguments, "warning: %.*s", (int)(end - line), line);
  warnings[0] = '\0';
}

int cli_report_missing_words(const struct cli_arguments *arguments) {
  cli_report_words(arguments, "out of memory: a part of the results is left out");
  return cli_exit_code(HOOKE_NO_MEMORY);
}

static const char *next_method(int64_t i, const void *ctx) {
  (void)ctx;
  return hooke_method_name(i);
}

void cli_report_methods(char *list, size_t size) {
  list[0] = '\0';
  for (int64_t i = 0; i < hooke_method_count(); i++)
    cli_append(list, size, "%s%s", i ? ", " : "", hooke_method_name(i));
}

int cli_report_unknown_method(const struct cli_arguments *arguments, const char *flag, const char *word,
                              size_t length) {
  char name[HOOKE_FLAG_SIZE], list[LIST_SIZE] = "";
  snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), word);
  cli_report_methods(list, sizeof list);
  const char *meant = hooke_method_meant(name), *near = cli_suggest(name, next_method, NULL);
  const int several = strchr(meant, ' ') != NULL;
  char among[LIST_SIZE] = "";
  for (size_t used = 0; several && *meant && used + 3 < sizeof among; meant++)
    used += (size_t)snprintf(among + used, 3, *meant == ' ' ? ", " : "%c", *meant);
  if (several) near = among;
  return cli_report(arguments, cli_refusal(arguments), "--%s: there is no method '%s'%s%s%s%s; methods: %s",
                    flag, name, near ? ", did you mean " : "", several ? "one of " : "", near ? near : "",
                    near ? "?" : "", list);
}
