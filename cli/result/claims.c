#include "claims.h"

#include "print.h"

enum { LABEL = 16, WIDTH = 110 };

void cli_claims_print(const struct cli_arguments *arguments, const hooke_measurement *measurement,
                      const char *command) {
  int64_t count = hooke_measurement_row_count(measurement, "claims");
  if (arguments->quiet && count > 1) count = 1;
  for (int64_t row = 0; row < count; row++) {
    cli_print_fact(LABEL, WIDTH, hooke_measurement_text(measurement, "claims", row, "key"), "%s",
                   hooke_measurement_text(measurement, "claims", row, "text"));
    if (row == 0 && command) cli_say("%*s%s\n", LABEL, "", command);
  }
}

int32_t cli_claims_print_json(const struct cli_arguments *arguments, const char *key,
                              hooke_measurement *measurement) {
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, key, arguments->scene);
  cli_json_measured(&json, NULL, measurement, NULL, 0);
  return cli_json_end(&json);
}
