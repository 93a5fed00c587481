/* Options as text: tables set from words, numbers read and printed, units, and the words of a command line.
 *
 * The first byte selects the test, the second the table, the rest are lines. A line that begins with '=' is
 * used literally, as "name=value" or a word of a command line; in any other the first byte selects a row of
 * the table and the rest is its value. So most inputs get past the names.
 *
 * Lines of: src/core/table/option*.c src/core/table/unit.c src/core/number.c cli/arguments.c
 * Longest input: 1024, mostly 256 */
#include "fuzz.h"

#include "arguments.h"
#include "core/number.h"
#include "core/table/option.h"
#include "core/table/unit.h"
#include "describe.h"
#include "hooke.h"
#include "report.h"
#include "small.h"
#include "words.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_LINES = 24, LINE_SIZE = 1100 };

/* ---- tables ---- */

static int32_t create_table(uint8_t which, hooke_options **options) {
  switch (which % 12) {
  case 0:
    return hooke_options_create("springs", options);
  case 1:
    return hooke_options_create("altitude", options);
  case 2:
    return hooke_options_create("run", options);
  case 3:
    return hooke_options_create("view", options);
  case 4:
    return hooke_options_create("scene", options);
  case 5:
    return hooke_options_create("particles", options);
  case 6:
    return hooke_options_create("driven", options);
  default:
    return hooke_options_create(hooke_part_kind(which % 12 - 7, "name"), options);
  }
}

static const char *row_name(const hooke_options *options, char byte) {
  return hooke_options_row(options, (unsigned char)byte % hooke_options_row_count(options), "name");
}

/* ---- option tables ---- */

/* The value of an option, set again by numbers, is the same to the bit. */
static void set_again(hooke_options *options, const char *name) {
  const int64_t count = hooke_options_number_count(options, name);
  const double *numbers = hooke_options_numbers(options, name);
  if (count == 0 || hooke_options_text(options, name)[0]) return;
  owned_doubles *copy = malloc((size_t)count * sizeof *copy);
  if (copy == NULL) return;
  memcpy(copy, numbers, (size_t)count * sizeof *copy);
  hooke_fuzz_require(hooke_options_set_numbers(options, name, count, copy) == HOOKE_OK,
                     "numbers that were read as text can be set");
  hooke_fuzz_require(memcmp(copy, hooke_options_numbers(options, name), (size_t)count * sizeof *copy) == 0,
                     "numbers that were set are held");
}

static void set_one(hooke_options *options, const char *name, const char *value) {
  const int32_t was_set = hooke_options_is_set(options, name);
  const int32_t status = hooke_options_set_text(options, name, value);
  if (status == HOOKE_OK) {
    hooke_fuzz_is_past_syntax();
    hooke_fuzz_require(hooke_options_is_set(options, name), "what was set is set");
    set_again(options, name);
  } else {
    hooke_fuzz_require(status == HOOKE_BAD_VALUE, "a text that is refused is a bad value");
    hooke_fuzz_require_message();
    hooke_fuzz_require(hooke_options_is_set(options, name) == was_set,
                       "a failure leaves the option as it was");
  }
}

static void require_copy(const hooke_options *options) {
  owned_options *copy = NULL;
  hooke_fuzz_require(hooke_options_copy(options, &copy) == HOOKE_OK, "options can be copied");
  for (int64_t row = 0; row < hooke_options_row_count(options); row++) {
    const char *name = hooke_options_row(options, row, "name");
    const int64_t count = hooke_options_number_count(options, name);
    hooke_fuzz_require(hooke_options_is_set(copy, name) == hooke_options_is_set(options, name) &&
                           hooke_options_number_count(copy, name) == count &&
                           strcmp(hooke_options_text(copy, name), hooke_options_text(options, name)) == 0,
                       "a copy holds the same");
  }
}

/* Raw bytes, eight a number: any double. */
static void set_bytes(hooke_options *options, const char *name, const char *bytes) {
  double number[8] = {0};
  const size_t length = strlen(bytes), size = length < sizeof number ? length : sizeof number;
  memcpy(number, bytes, size);
  const int64_t count = (int64_t)(size + 7) / 8;
  if (hooke_options_set_numbers(options, name, count, number) == HOOKE_OK) {
    hooke_fuzz_is_past_syntax();
    for (int64_t k = 0; k < count; k++)
      hooke_fuzz_require(isfinite(hooke_options_numbers(options, name)[k]), "numbers of options are finite");
  } else {
    hooke_fuzz_require_message();
  }
}

/* The properties of a table. */
static void ask(const hooke_options *options) {
  static const char *const texts[] = {"name",    "type",  "unit",   "units",   "default", "doc",
                                      "allowed", "words", "family", "example", "?"};
  static const char *const numbers[] = {"low",       "high",      "above_low", "whole",      "required",
                                        "min_count", "max_count", "columns",   "word_lists", "?"};
  for (int64_t row = -1; row <= hooke_options_row_count(options); row++) {
    for (int k = 0; k < 10; k++) {
      hooke_options_row(options, row, texts[k]);
      hooke_options_row_number(options, row, numbers[k]);
    }
  }
}

/* A value of "!" resets the option, one of "?" queries its row, and "#" is followed by bytes of numbers. */
static void set_lines(hooke_options *options, char **line, int32_t count) {
  for (int32_t k = 0; k < count; k++) {
    char *value = line[k] + 1;
    const char *name = line[k][0] == '=' ? value : row_name(options, line[k][0]);
    if (line[k][0] == '=') {
      value = strchr(value, '=');
      if (value) *value++ = '\0';
    }
    if (value && strcmp(value, "!") == 0)
      hooke_options_unset(options, name);
    else if (value && strcmp(value, "?") == 0)
      ask(options);
    else if (value && value[0] == '#')
      set_bytes(options, name, value + 1);
    else if (value)
      set_one(options, name, value);
  }
  require_copy(options);
  if (hk_options_check_required(options) != HOOKE_OK) hooke_fuzz_require_message();
}

/* ---- numbers and units ---- */

/* strtod() in the C locale accepts every number accepted here, with the same bits. */
static void read_number(const char *text) {
  double value = 0, again = 0;
  if (hk_number_parse(text, (int64_t)strlen(text), &value) != HOOKE_NUMBER_FINE) return;
  hooke_fuzz_is_past_syntax();
  char *end, printed[HOOKE_NUMBER_SIZE];
  const double wanted = strtod(text, &end);
  hooke_fuzz_require(*end == '\0' && memcmp(&wanted, &value, sizeof value) == 0,
                     "a number is what strtod() reads");
  hk_number_print(value, printed);
  hooke_fuzz_require(hk_number_parse(printed, (int64_t)strlen(printed), &again) == HOOKE_NUMBER_FINE &&
                         memcmp(&again, &value, sizeof value) == 0,
                     "a number that is printed reads back to the same bits");
}

/* A number and its unit are within the text, of which nothing else is read, and give a finite number. */
static void read_units(const char *text, const char *bases, const char *name) {
  const struct hk_unit unit = hk_unit_find(bases, name, (int64_t)strlen(name));
  const size_t length = strlen(text);
  owned_text *alone = malloc(length + (length == 0)); /* without the zero at its end */
  if (alone == NULL) return;
  memcpy(alone, text, length);
  const struct hk_quantity found = hk_unit_scan(bases, alone, (int64_t)length);
  hooke_fuzz_require(unit.base && 0 <= found.number && found.number <= found.whole &&
                         found.whole <= (int64_t)length,
                     "a number and its unit are in the text");
  double value = 0.0;
  if (found.number > 0 && hk_unit_parse(alone, found.number, &unit, &value) == HOOKE_NUMBER_FINE)
    hooke_fuzz_require(isfinite(value), "a number in a unit is finite");
}

/* ---- the command line ---- */

static const struct cli_verb_row rows[] = {{"output", 'o', "FILE", "where to"},
                                           {"force", 'f', NULL, "even so"}};
static const struct cli_verb verbs[] = {
    {.name = "run", HOOKE_VERB_ROWS(rows)},
    {.name = "view", .input = "OUT.h5", HOOKE_VERB_ROWS(rows), .options = "view"},
    {.name = "study", HOOKE_VERB_ROWS(rows), .options = "view", .without = "method step"},
    {.name = "make", HOOKE_VERB_ROWS(rows), .takes_kind = 1},
};
static const struct cli_verb *const all_verbs[] = {&verbs[0], &verbs[1], &verbs[2], &verbs[3], NULL};

/* Output of the program is formatted and discarded. */
int cli_report(const struct cli_arguments *arguments, int code, const char *format, ...) {
  char message[4096];
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  hooke_fuzz_require(arguments->verb != NULL && message[0] != '\0' && code != HOOKE_EXIT_DONE,
                     "what is refused has a message and an exit code");
  return code;
}

int cli_report_status(const struct cli_arguments *arguments, int32_t status) {
  return cli_report(arguments, status == HOOKE_OK ? HOOKE_EXIT_DONE : HOOKE_EXIT_BAD_INPUT, "%s",
                    hooke_last_error());
}

int cli_report_unknown_method(const struct cli_arguments *arguments, const char *flag, const char *word,
                              size_t length) {
  return cli_report(arguments, HOOKE_EXIT_USAGE, "--%s %.*s", flag, (int)length, word);
}

int cli_refusal(const struct cli_arguments *arguments) {
  return arguments->verb->takes_kind ? HOOKE_EXIT_BAD_INPUT : HOOKE_EXIT_USAGE;
}

const char *cli_suggest(const char *word, const char *(*next)(int64_t i, const void *ctx), const void *ctx) {
  const char *candidate = NULL;
  for (int64_t i = 0; (candidate = next(i, ctx)); i++)
    if (candidate[0] == word[0]) break;
  return candidate;
}

static void parse_words(uint8_t which, const hooke_options *table, char **line, int32_t count) {
  static char word[MOST_LINES][LINE_SIZE], name[] = "verb", kind[] = "cloth";
  const struct cli_verb *verb = &verbs[which % 4];
  char *argv[MOST_LINES + 3] = {name};
  int argc = 1;
  if (verb->takes_kind && which < 128) argv[argc++] = kind;
  for (int32_t k = 0; k < count; k++) {
    char flag[HOOKE_FLAG_SIZE];
    if (line[k][0] == '=')
      snprintf(word[k], LINE_SIZE, "%s", line[k] + 1);
    else
      snprintf(word[k], LINE_SIZE, "--%s%s%s", cli_arguments_flag(row_name(table, line[k][0]), flag),
               line[k][1] ? "=" : "", line[k] + 1);
    argv[argc++] = word[k];
  }
  struct cli_arguments arguments;
  const int answer = cli_arguments_parse(all_verbs, verb, argc, argv, &arguments);
  if (answer == HOOKE_EXIT_DONE && !arguments.help) {
    hooke_fuzz_is_past_syntax();
    hooke_fuzz_is_accepted();
    owned_options *run = NULL;
    hooke_fuzz_require(hooke_options_create("run", &run) == HOOKE_OK &&
                           cli_arguments_apply(&arguments, run) == HOOKE_OK,
                       "what was read from the command line can be set");
  }
  cli_arguments_destroy(&arguments);
}

/* ---- one input ---- */

static void run_lines(uint8_t what, uint8_t which, char **line, int32_t count) {
  owned_options *options = NULL;
  if (what % 4 == 2) {
    for (int32_t k = 0; k < count; k++)
      read_number(line[k]);
    return;
  }
  if (what % 4 == 3) {
    for (int32_t k = 0; k < count; k++)
      read_units(line[k], which & 1 ? "m" : "N (strain law), N/m (length law)", which & 1 ? "mm" : "Pa m");
    return;
  }
  hooke_fuzz_require((what % 4 == 0 ? create_table(which, &options)
                                    : create_table(which % 4 == 3 ? 8 : 2, &options)) == HOOKE_OK,
                     "there is a table of options");
  if (what % 4 == 0)
    set_lines(options, line, count);
  else
    parse_words(which, options, line, count);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  hooke_fuzz_begin();
  if (size < 3 || size >= LINE_SIZE) return 0;
  char *text = malloc(size - 1), *line[MOST_LINES];
  if (text == NULL) return 0;
  memcpy(text, data + 2, size - 2);
  text[size - 2] = '\0';
  int32_t count = 0;
  for (char *at = text; at && *at && count < MOST_LINES; count++) {
    line[count] = at;
    at = strchr(at, '\n');
    if (at) *at++ = '\0';
  }
  run_lines(data[0], data[1], line, count);
  free(text);
  return 0;
}
