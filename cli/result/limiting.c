#include "limiting.h"

#include "table.h"

#include <math.h>

static void print_ends(struct cli_json *json, const hooke_measurement *m, int64_t row) {
  const double first = hooke_measurement_number(m, "blame", row, "first");
  if (isnan(first)) {
    cli_json_text(json, "spring", NULL);
    return;
  }
  cli_json_open(json, "spring", '[');
  cli_json_count(json, NULL, (int64_t)first);
  cli_json_count(json, NULL, (int64_t)hooke_measurement_number(m, "blame", row, "second"));
  cli_json_close(json);
}

void cli_limiting_json(struct cli_json *json, const hooke_measurement *m) {
  cli_json_open(json, "blame", '[');
  for (int64_t row = 0; row < hooke_measurement_row_count(m, "blame"); row++) {
    cli_json_open(json, NULL, '{');
    print_ends(json, m, row);
    cli_table_print_row(json, m, "blame", row);
    cli_json_close(json);
  }
  cli_json_close(json);
}
