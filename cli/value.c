#include "value.h"

#include "report.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int32_t has_rows(const struct cli_argument *argument) {
  return hooke_options_row_number(argument->table, argument->row, "columns") > 1.0;
}

int32_t cli_value_adds_up(const struct cli_argument *argument) {
  return has_rows(argument) || hooke_options_row_number(argument->table, argument->row, "word_lists") == 1.0;
}

int cli_value_read(const struct cli_arguments *arguments, struct cli_argument *argument) {
  const char *before = argument->value && cli_value_adds_up(argument) ? argument->value : "";
  const char *between = before[0] == '\0' ? "" : has_rows(argument) ? ";" : ",";
  const size_t size = strlen(before) + strlen(argument->text) + 2;
  char *value = malloc(size);
  if (value) snprintf(value, size, "%s%s%s", before, between, argument->text);
  free(argument->value);
  argument->value = value;
  return value ? HOOKE_EXIT_DONE : cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
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
  const char *example = hooke_options_row(argument->table, argument->row, "example");
  return cli_report(arguments, code, "--%s %s: %s%s%s", argument->flag, argument->text,
                    without_name(hooke_last_error(), argument->name), example[0] ? ", such as " : "",
                    example);
}
