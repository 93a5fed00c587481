#include "results.h"

#include "output_file.h"
#include "watch.h"

#include <stdlib.h>

int cli_results_make(const struct cli_arguments *arguments, const char *kind,
                     int (*check)(const struct cli_arguments *arguments),
                     int (*ready)(struct cli_results *results), int (*tell)(struct cli_results *results)) {
  struct cli_results results = {.arguments = arguments};
  int code = check(arguments);
  if (code == HOOKE_EXIT_DONE) code = cli_output_file_check_report(arguments);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_load(arguments, &results.setup);
  if (code == HOOKE_EXIT_DONE) code = ready(&results);
  if (code == HOOKE_EXIT_DONE)
    code = cli_watch_measure(arguments, kind, &results.setup, results.from, &results.found, &results.outcome);
  if (code == HOOKE_EXIT_DONE) code = tell(&results);
  free(results.command);
  hooke_measurement_destroy(results.found);
  cli_setup_destroy(&results.setup);
  return code;
}
