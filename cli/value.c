#include "value.h"

#include "report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Numbers in a row of a table whose numbers come in rows; 0: flat. */
static int64_t columns_of(const hooke_options *table, int64_t row) {
  const double columns = hooke_options_row_number(table, row, "columns");
  return columns > 1.0 ? (int64_t)columns : 0;
}

static int32_t is_size(const hooke_options *table, int64_t row) {
  return strcmp(hooke_options_row(table, row, "type"), "numbers") == 0 &&
         hooke_options_row_number(table, row, "whole") == 1.0 &&
         hooke_options_row(table, row, "words")[0] == '\0';
}

int32_t cli_value_adds_up(const struct cli_argument *argument) {
  return columns_of(argument->table, argument->row) > 0 ||
         hooke_options_row_number(argument->table, argument->row, "word_lists") == 1.0;
}

/* ---- reading ---- */

static int64_t count_pieces(const char *text, size_t length) {
  int64_t count = 1;
  for (size_t k = 0; k < length; k++)
    count += text[k] == ',';
  return count;
}

/* A semicolon ends a row, so that rows of a wrong length are reported as such. */
static int check_rows(const struct cli_arguments *arguments, const struct cli_argument *argument) {
  const int64_t columns = columns_of(argument->table, argument->row);
  int64_t row = 0;
  for (const char *at = argument->text; columns > 0 && strchr(argument->text, ';'); row++) {
    const size_t length = strcspn(at, ";");
    const int64_t count = length ? count_pieces(at, length) : 0;
    if (count != columns) {
      return cli_report(arguments, cli_refusal(arguments),
                        "--%s %s: row [%lld] has %lld number%s; allowed: %s", argument->flag, argument->text,
                        (long long)row, (long long)count, count == 1 ? "" : "s",
                        hooke_options_row(argument->table, argument->row, "allowed"));
    }
    at += length;
    if (*at++ == '\0') break;
  }
  return HOOKE_EXIT_DONE;
}

/* A copy of the text, with commas between all numbers. */
static char *with_commas(const struct cli_argument *argument) {
  char *text = strdup(argument->text);
  const int32_t rows = columns_of(argument->table, argument->row) > 0;
  const int32_t size = is_size(argument->table, argument->row);
  for (char *at = text; at && *at; at++) {
    if ((rows && *at == ';') || (size && *at == 'x')) *at = ',';
  }
  return text;
}

static int out_of_memory(const struct cli_arguments *arguments) {
  return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
}

static int add_up(const struct cli_arguments *arguments, struct cli_argument *argument, char *more) {
  if (!argument->value || !cli_value_adds_up(argument)) {
    free(argument->value);
    argument->value = more;
    return HOOKE_EXIT_DONE;
  }
  const size_t size = strlen(argument->value) + strlen(more) + 2;
  char *both = malloc(size);
  if (both) snprintf(both, size, "%s,%s", argument->value, more);
  free(argument->value);
  free(more);
  argument->value = both;
  return both ? HOOKE_EXIT_DONE : out_of_memory(arguments);
}

int cli_value_read(const struct cli_arguments *arguments, struct cli_argument *argument) {
  const int answer = check_rows(arguments, argument);
  if (answer != HOOKE_EXIT_DONE) return answer;
  char *text = with_commas(argument);
  if (!text) return out_of_memory(arguments);
  return add_up(arguments, argument, text);
}

/* The message without the leading name of the option, which the report has already. */
static const char *without_name(const char *message, const char *name) {
  const size_t length = strlen(name);
  return strncmp(message, name, length) == 0 && strncmp(message + length, ": ", 2) == 0 ? message + length + 2
                                                                                        : message;
}

int cli_value_set(const struct cli_arguments *arguments, const struct cli_argument *argument) {
  const int32_t status = hooke_options_set_text(argument->table, argument->name, argument->value);
  if (status == HOOKE_OK) return HOOKE_EXIT_DONE;
  const int code = status == HOOKE_NO_MEMORY ? HOOKE_EXIT_BAD_INPUT : cli_refusal(arguments);
  char example[HOOKE_EXAMPLE_SIZE];
  cli_value_example(argument->table, argument->row, example);
  return cli_report(arguments, code, "--%s %s: %s%s%s", argument->flag, argument->text,
                    without_name(hooke_last_error(), argument->name), example[0] ? ", such as " : "",
                    example);
}

/* ---- examples ---- */

const char *cli_value_example(const hooke_options *table, int64_t row, char text[HOOKE_EXAMPLE_SIZE]) {
  const int64_t columns = columns_of(table, row);
  int64_t commas = 0;
  snprintf(text, HOOKE_EXAMPLE_SIZE, "%s", hooke_options_row(table, row, "example"));
  for (char *at = text; *at; at++) {
    if (*at != ',') continue;
    commas++;
    if (columns > 0 && commas % columns == 0) *at = ';';
    if (is_size(table, row)) *at = 'x';
  }
  return text;
}
