#include "report.h"
#include "print.h"

#include <stdarg.h>
#include <string.h>

enum { MESSAGE_SIZE = 4096, WORD_SIZE = 48, LIST_SIZE = 512 };

int hooke_exit_code(int32_t status) {
  switch (status) {
  case HOOKE_OK:
    return HOOKE_EXIT_DONE;
  case HOOKE_STOPPED:
    return HOOKE_EXIT_INTERRUPTED;
  case HOOKE_DIVERGED:
  case HOOKE_STEP_LIMIT:
  case HOOKE_SOLVER_FAILED:
    return HOOKE_EXIT_DIVERGED;
  case HOOKE_IO_FAILED:
    return HOOKE_EXIT_IO;
  case HOOKE_NOT_BUILT:
    return HOOKE_EXIT_NOT_BUILT;
  default:
    return HOOKE_EXIT_BAD_INPUT; /* a value, or a scene too large for the memory */
  }
}

int hooke_refusal(const struct hooke_arguments *arguments) {
  return arguments->verb->kind_options ? HOOKE_EXIT_BAD_INPUT : HOOKE_EXIT_USAGE;
}

static void say(const struct hooke_arguments *arguments, const char *message) {
  fprintf(stderr, "hooke %s: ", arguments->verb->name);
  hooke_print_text(stderr, message);
  fputc('\n', stderr);
}

int hooke_report(const struct hooke_arguments *arguments, int code, const char *format, ...) {
  char message[MESSAGE_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  say(arguments, message);
  if (arguments->json) {
    struct hooke_json json;
    hooke_json_begin(&json, stdout);
    hooke_json_open(&json, "error", '{');
    hooke_json_count(&json, "exit", code);
    hooke_json_text(&json, "message", message);
    hooke_json_end(&json);
  }
  return code;
}

int hooke_report_status(const struct hooke_arguments *arguments, int32_t status) {
  const char *message = hooke_last_error();
  return hooke_report(arguments, hooke_exit_code(status), "%s",
                      message[0] ? message : hooke_status_name(status));
}

void hooke_report_words(const struct hooke_arguments *arguments, const char *format, ...) {
  char message[MESSAGE_SIZE];
  va_list args;
  va_start(args, format);
  vsnprintf(message, sizeof message, format, args);
  va_end(args);
  say(arguments, message);
}

int hooke_report_missing_words(const struct hooke_arguments *arguments) {
  hooke_report_words(arguments, "out of memory: a command to type is left out");
  return hooke_exit_code(HOOKE_NO_MEMORY);
}

static int32_t is_set_by(const struct hooke_setting *settings, const char *name) {
  for (; settings->name; settings++) {
    if (settings->text && strcmp(settings->name, name) == 0) return 1;
  }
  return 0;
}

/* " --atol-velocity" for "atol_velocity". */
static void print_flag(FILE *file, const char *name) {
  fputs(" --", file);
  for (; *name; name++)
    fputc(*name == '_' ? '-' : *name, file);
}

void hooke_report_command(FILE *file, const struct hooke_arguments *arguments, const char *verb,
                          const struct hooke_setting *settings) {
  int32_t same = strcmp(verb, arguments->verb->name) == 0;
  fprintf(file, "hooke %s ", verb);
  hooke_print_quoted(file, arguments->scene);
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct hooke_argument *argument = &arguments->all[i];
    if (!argument->text || is_set_by(settings, argument->name)) continue;
    if (!same && argument->table != arguments->run) continue;
    /* what --want would choose is given */
    if (strcmp(argument->name, "want") == 0 && is_set_by(settings, "method")) continue;
    const char *instead = arguments->verb->for_scene;
    if (instead && strcmp(argument->name, instead) == 0) continue; /* it is there as the scene */
    print_flag(file, argument->name);
    if (argument->own && !argument->own->value) continue;
    fputc(' ', file);
    hooke_print_quoted(file, argument->text);
  }
  for (; settings->name; settings++) {
    if (!settings->text) continue;
    print_flag(file, settings->name);
    fputc(' ', file);
    hooke_print_quoted(file, settings->text);
  }
}

/* Letters to change, insert or drop to make one word of the other. */
static size_t distance(const char *a, const char *b) {
  size_t row[WORD_SIZE + 1];
  size_t width = strlen(b);
  for (size_t j = 0; j <= width; j++)
    row[j] = j;
  for (size_t i = 0; a[i]; i++) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < width; j++) {
      size_t change = diagonal + (a[i] != b[j]);
      size_t shorter = (row[j] < row[j + 1] ? row[j] : row[j + 1]) + 1;
      diagonal = row[j + 1];
      row[j + 1] = change < shorter ? change : shorter;
    }
  }
  return row[width];
}

const char *hooke_suggest(const char *word, const char *(*next)(int64_t i, const void *ctx),
                          const void *ctx) {
  const char *best = NULL;
  const char *candidate;
  size_t least = strlen(word) / 3 + 2; /* more changes than this is another word */
  if (strlen(word) > WORD_SIZE) return NULL;
  for (int64_t i = 0; (candidate = next(i, ctx)) != NULL; i++) {
    if (strlen(candidate) > WORD_SIZE) continue;
    size_t changes = distance(word, candidate);
    if (changes < least) {
      least = changes;
      best = candidate;
    }
  }
  return best;
}

static const char *next_method(int64_t i, const void *ctx) {
  (void)ctx;
  return hooke_method_name(i);
}

void hooke_report_methods(char *list, size_t size) {
  list[0] = '\0';
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    size_t used = strlen(list);
    snprintf(list + used, size - used, "%s%s", i ? ", " : "", hooke_method_name(i));
  }
}

int hooke_report_unknown_method(const struct hooke_arguments *arguments, const char *flag, const char *word,
                                size_t length) {
  char name[HOOKE_FLAG_SIZE], list[LIST_SIZE] = "";
  snprintf(name, sizeof name, "%.*s", (int)(length < sizeof name ? length : sizeof name - 1), word);
  hooke_report_methods(list, sizeof list);
  const char *near = hooke_suggest(name, next_method, NULL);
  return hooke_report(arguments, hooke_refusal(arguments), "--%s: there is no method '%s'%s%s%s; methods: %s",
                      flag, name, near ? ", did you mean " : "", near ? near : "", near ? "?" : "", list);
}
