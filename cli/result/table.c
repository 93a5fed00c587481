#include "table.h"

#include <math.h>
#include <string.h>

static void print_value(struct cli_json *json, const hooke_measurement *m, const char *table, int64_t row,
                        const char *name, const char *type) {
  const double number = hooke_measurement_number(m, table, row, name);
  if (strcmp(type, "text") == 0)
    cli_json_text(json, name, hooke_measurement_text(m, table, row, name));
  else if (strcmp(type, "flag") == 0 && !isnan(number))
    cli_json_flag(json, name, number != 0.0);
  else if (strcmp(type, "series") != 0)
    cli_json_number(json, name, number);
}

void cli_table_print_row(struct cli_json *json, const hooke_measurement *m, const char *table, int64_t row) {
  const char *kind = hooke_measurement_kind(m), *name;
  for (int64_t k = 0; (name = hooke_measurement_column(kind, table, k, "name")); k++)
    print_value(json, m, table, row, name, hooke_measurement_column(kind, table, k, "type"));
}
