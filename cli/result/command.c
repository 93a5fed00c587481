#include "command.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Options that show a run that diverges: one that is advised does not. */
static const char SHOW_DIVERGENCE[] = "past_divergence frames_after";

/* The row of `changes`, if it is set. */
static void add_change(struct cli_string *text, const hooke_options *changes, const char *name) {
  char flag[HOOKE_FLAG_SIZE], number[HOOKE_NUMBER_SIZE];
  if (!hooke_options_is_set(changes, name)) return;
  cli_string_add(text, " --%s ", cli_arguments_flag(name, flag));
  cli_string_quote(text, hooke_options_number_count(changes, name) > 0
                             ? cli_format_number(hooke_options_number(changes, name), number)
                             : hooke_options_text(changes, name));
}

/* Every line that was set, as an option. */
static void add_sets(struct cli_string *text, const char *lines) {
  for (size_t length; *lines; lines += length + (lines[length] == '\n')) {
    struct cli_string line = {0};
    length = strcspn(lines, "\n");
    cli_string_add(&line, "%.*s", (int)length, lines);
    cli_string_add(text, " --set ");
    cli_string_quote(text, line.bytes ? line.bytes : "");
    free(line.bytes);
  }
}

void cli_command_add(struct cli_string *text, const struct cli_arguments *arguments, const char *verb,
                     const hooke_options *changes) {
  const int32_t same = strcmp(verb, arguments->verb->name) == 0;
  cli_string_add(text, "hooke %s ", verb);
  cli_string_quote(text, arguments->scene);
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    if (!argument->text || cli_is_among(SHOW_DIVERGENCE, argument->name)) continue;
    if (changes && hooke_options_is_set(changes, argument->name)) continue;
    if (!same && argument->table != arguments->run && !cli_is_among("from-rest force set", argument->name))
      continue;
    if (!same && strcmp(verb, "needs") == 0 && cli_is_among("step checkpoint", argument->name)) continue;
    /* the options that --want would choose are given */
    if (strcmp(argument->name, "want") == 0 && changes && hooke_options_is_set(changes, "method")) continue;
    const char *instead = arguments->verb->for_scene;
    if (instead && strcmp(argument->name, instead) == 0) continue; /* replaced by the scene */
    if (strcmp(argument->name, "set") == 0) {
      add_sets(text, argument->value);
      continue;
    }
    cli_string_add(text, " --%s", argument->flag);
    if (argument->own && !argument->own->value) continue;
    cli_string_add(text, cli_argument_is_flag(argument) ? "=" : " ");
    cli_string_quote(text, argument->text);
  }
  for (int64_t row = 0; changes && row < hooke_options_row_count(changes); row++)
    add_change(text, changes, hooke_options_row(changes, row, "name"));
}

/* ---- suggestions ---- */

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

int32_t cli_command_ask_needs(const struct cli_arguments *arguments, double want,
                              struct cli_string *command) {
  hooke_options *options = NULL;
  int32_t status = isnan(want) ? HOOKE_OK : hooke_options_create("needs", &options);
  if (options) status = hooke_options_set_number(options, "want", want);
  if (options && status == HOOKE_OK) cli_command_add(command, arguments, "needs", options);
  hooke_options_destroy(options);
  return status == HOOKE_OK ? command->status : status;
}

/* Command of the run with the changes of advice `place`; of `needs`, or none, if the scene has to change.
 * HOOKE_NO_MEMORY */
static int32_t make_command(const struct cli_arguments *arguments, const hooke_measurement *why,
                            int64_t place, struct cli_string *command) {
  hooke_options *changes = NULL;
  int32_t status = hooke_options_create("run", &changes);
  if (status == HOOKE_OK) status = hooke_why_advice_apply(why, place, changes);
  const int32_t was_picked = cli_arguments_text(arguments, "want") != NULL;
  const int32_t any = status == HOOKE_OK && hooke_measurement_text(why, "advice", place, "option")[0];
  if (any && was_picked) status = add_chosen(why, changes);
  if (status == HOOKE_OK && any) cli_command_add(command, arguments, "run", changes);
  if (status == HOOKE_OK && !any)
    status =
        cli_command_ask_needs(arguments, hooke_measurement_number(why, "advice", place, "want"), command);
  hooke_options_destroy(changes);
  return status == HOOKE_NO_MEMORY ? status : command->status;
}

int32_t cli_advice_label(const struct cli_arguments *arguments, hooke_measurement *why) {
  static const char *const labels[] = {"command", "command 1", "command 2", "command 3"};
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < hooke_measurement_row_count(why, "advice") && status == HOOKE_OK; k++) {
    struct cli_string command = {.bytes = NULL};
    status = make_command(arguments, why, k, &command);
    if (status == HOOKE_OK) status = hooke_measurement_label(why, labels[k], command.bytes);
    free(command.bytes);
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
