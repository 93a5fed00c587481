#include "command.h"
#include "os.h"
#include "print.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_SETTINGS = 16 };

static int32_t is_set_by(const struct cli_setting *settings, const char *name) {
  for (; settings->name; settings++) {
    if (settings->text && strcmp(settings->name, name) == 0) return 1;
  }
  return 0;
}

/* Options that show a run that diverges: one that is advised does not. */
static int32_t shows_divergence(const char *name) {
  return strcmp(name, "past_divergence") == 0 || strcmp(name, "frames_after") == 0;
}

void cli_command_print(FILE *file, const struct cli_arguments *arguments, const char *verb,
                       const struct cli_setting *settings) {
  int32_t same = strcmp(verb, arguments->verb->name) == 0;
  char flag[HOOKE_FLAG_SIZE];
  fprintf(file, "hooke %s ", verb);
  cli_print_quoted(file, arguments->scene);
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    if (!argument->text || is_set_by(settings, argument->name) || shows_divergence(argument->name)) continue;
    if (!same && argument->table != arguments->run) continue;
    /* the options that --want would choose are given */
    if (strcmp(argument->name, "want") == 0 && is_set_by(settings, "method")) continue;
    const char *instead = arguments->verb->for_scene;
    if (instead && strcmp(argument->name, instead) == 0) continue; /* replaced by the scene */
    fprintf(file, " --%s", cli_arguments_flag(argument->name, flag));
    if (argument->own && !argument->own->value) continue;
    fputc(cli_argument_is_flag(argument) ? '=' : ' ', file);
    cli_print_quoted(file, argument->text);
  }
  for (; settings->name; settings++) {
    if (!settings->text) continue;
    fprintf(file, " --%s ", cli_arguments_flag(settings->name, flag));
    cli_print_quoted(file, settings->text);
  }
}

int32_t cli_command_make(const struct cli_arguments *arguments, const struct cli_setting *settings,
                         char **command) {
  size_t size;
  FILE *stream = cli_os_open_text(command, &size);
  if (stream) cli_command_print(stream, arguments, "run", settings);
  return cli_print_end(stream, command);
}

/* ---- suggestions ---- */

static int32_t changes_any(const hooke_options *changes) {
  int32_t any = 0;
  for (int64_t row = 0; row < hooke_options_row_count(changes); row++)
    any |= hooke_options_is_set(changes, hooke_options_row(changes, row, "name"));
  return any;
}

/* A command without --want has to state what --want had chosen. */
static int32_t add_chosen(const hooke_measurement *why, hooke_options *changes) {
  const char *method = hooke_measurement_text(why, "why", 0, "method");
  const double step = hooke_measurement_number(why, "why", 0, "step");
  int32_t status = HOOKE_OK;
  if (!hooke_options_is_set(changes, "method")) status = hooke_options_set_text(changes, "method", method);
  if (status == HOOKE_OK && !hooke_options_is_set(changes, "step") && step > 0.0 &&
      hooke_method_is_adaptive(hooke_options_text(changes, "method")) == 0)
    status = hooke_options_set_number(changes, "step", step);
  return status;
}

/* The set options, as settings whose numbers are in `text`; returns their number. */
static int32_t collect(const hooke_options *changes, struct cli_setting *settings,
                       char text[][HOOKE_NUMBER_SIZE]) {
  int32_t count = 0;
  for (int64_t row = 0; row < hooke_options_row_count(changes) && count + 1 < MOST_SETTINGS; row++) {
    const char *name = hooke_options_row(changes, row, "name");
    if (!hooke_options_is_set(changes, name)) continue;
    const int32_t is_number = hooke_options_number_count(changes, name) > 0;
    const char *value = is_number ? cli_format_number(hooke_options_number(changes, name), text[count])
                                  : hooke_options_text(changes, name);
    settings[count++] = (struct cli_setting){name, value};
  }
  settings[count] = (struct cli_setting){NULL, NULL};
  return count;
}

/* Command of the run with the changes of advice `place`; NULL if the scene has to change. HOOKE_NO_MEMORY */
static int32_t make_command(const struct cli_arguments *arguments, const hooke_measurement *why,
                            int64_t place, char **command) {
  struct cli_setting settings[MOST_SETTINGS];
  char text[MOST_SETTINGS][HOOKE_NUMBER_SIZE];
  hooke_options *changes = NULL;
  *command = NULL;
  int32_t status = hooke_options_create("run", &changes);
  if (status == HOOKE_OK) status = hooke_why_advice_apply(why, place, changes);
  const int32_t was_picked = cli_arguments_text(arguments, "want") != NULL;
  if (status == HOOKE_OK && was_picked && changes_any(changes)) status = add_chosen(why, changes);
  if (status == HOOKE_OK && collect(changes, settings, text) > 0)
    status = cli_command_make(arguments, settings, command);
  hooke_options_destroy(changes);
  return status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
}

int32_t cli_advice_label(const struct cli_arguments *arguments, hooke_measurement *why) {
  static const char *const labels[] = {"command", "command 1", "command 2", "command 3"};
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < hooke_measurement_row_count(why, "advice") && status == HOOKE_OK; k++) {
    char *command;
    status = make_command(arguments, why, k, &command);
    if (status == HOOKE_OK) status = hooke_measurement_label(why, labels[k], command);
    free(command);
  }
  return status;
}

void cli_advice_print(const hooke_measurement *why) {
  for (int64_t k = 0; k < hooke_measurement_row_count(why, "advice"); k++) {
    const char *command = hooke_measurement_text(why, "advice", k, "command");
    cli_say("%s %s\n", k == 0 ? "what to do:" : "or:", hooke_measurement_text(why, "advice", k, "change"));
    if (command) printf("  %s\n", command);
  }
}
