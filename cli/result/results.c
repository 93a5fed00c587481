#include "results.h"

#include "report.h"
#include "watch.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* The method that `word` begins with, up to `length`; NULL if there is none. */
static const char *find_method(const char *word, size_t length) {
  char given[HOOKE_FLAG_SIZE];
  snprintf(given, sizeof given, "%.*s", (int)(length < sizeof given ? length : sizeof given - 1), word);
  const char *meant = hooke_method_meant(given);
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    if (strcmp(hooke_method_name(i), meant) == 0) return hooke_method_name(i);
  }
  return NULL;
}

static int add_method(struct cli_results *results, const char *name) {
  if (!hooke_method_is_built(name)) {
    return cli_report(results->arguments, HOOKE_EXIT_NOT_BUILT,
                      "%s is not in this build of hooke; 'hooke --version' says what it was built with",
                      name);
  }
  for (int32_t i = 0; i < results->method_count; i++) {
    if (results->method[i] == name)
      return cli_report(results->arguments, HOOKE_EXIT_USAGE, "--methods: %s is named twice", name);
  }
  if (results->method_count < HOOKE_MOST_METHODS) results->method[results->method_count++] = name;
  return HOOKE_EXIT_DONE;
}

static int choose_methods(struct cli_results *results) {
  const char *word = cli_arguments_text(results->arguments, "methods");
  int code = HOOKE_EXIT_DONE;
  for (int64_t i = 0; !word && i < hooke_method_count(); i++)
    if (hooke_method_is_built(hooke_method_name(i))) (void)add_method(results, hooke_method_name(i));
  for (size_t length; word && code == HOOKE_EXIT_DONE; word = word[length] ? word + length + 1 : NULL) {
    length = strcspn(word, ",");
    const char *name = find_method(word, length);
    code = name ? add_method(results, name)
                : cli_report_unknown_method(results->arguments, "methods", word, length);
  }
  return code;
}

int cli_results_make(const struct cli_arguments *arguments, const struct cli_verb *verb) {
  struct cli_results results = {.arguments = arguments};
  int code = choose_methods(&results);
  if (code == HOOKE_EXIT_DONE && cli_arguments_text(arguments, "at") &&
      cli_arguments_text(arguments, "from-rest"))
    code = cli_report(arguments, HOOKE_EXIT_USAGE, "--at and --from-rest are two states; leave out one");
  if (code == HOOKE_EXIT_DONE && verb->check) code = verb->check(arguments);
  if (code == HOOKE_EXIT_DONE)
    code = cli_setup_check_ending(arguments, "-o", cli_arguments_text(arguments, "output"));
  if (code == HOOKE_EXIT_DONE) code = cli_setup_check_report(arguments);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_load(arguments, &results.setup);
  if (code == HOOKE_EXIT_DONE) code = verb->ready(&results);
  if (code == HOOKE_EXIT_DONE)
    code = cli_watch_measure(arguments, verb->options, &results.setup, results.from, &results.found,
                             &results.outcome);
  if (code == HOOKE_EXIT_DONE) code = verb->tell(&results);
  free(results.command);
  hooke_measurement_destroy(results.found);
  cli_setup_destroy(&results.setup);
  return code;
}

int cli_results_at(struct cli_results *l) {
  const char *at = cli_arguments_text(l->arguments, "at");
  l->from = l->setup.state;
  if (at == NULL) return HOOKE_EXIT_DONE;
  const char *colon = strrchr(at, ':');
  char *end = NULL;
  errno = 0;
  const long long frame = colon ? strtoll(colon + 1, &end, 10) : -1;
  if (colon && (end == colon + 1 || *end || errno)) {
    return cli_report(l->arguments, HOOKE_EXIT_USAGE,
                      "--at %s: allowed: a trajectory and a frame of it, FILE:FRAME, counted from 0, or from "
                      "-1 backwards; the last one if not given",
                      at);
  }
  hooke_record *record = NULL;
  char *file = strdup(at);
  if (file && colon) file[colon - at] = '\0';
  if (!file) return cli_report(l->arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  const char *report = cli_arguments_text(l->arguments, "report");
  const int code = cli_setup_check_apart(l->arguments, file, "the trajectory of --at", report);
  int32_t status = code == HOOKE_EXIT_DONE ? hooke_record_open(file, &record) : HOOKE_OK;
  if (status == HOOKE_OK && record) status = hooke_record_read(record, frame, l->setup.state);
  free(file);
  hooke_record_close(record);
  if (code != HOOKE_EXIT_DONE) return code;
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(l->arguments, status);
}
