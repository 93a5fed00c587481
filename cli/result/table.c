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

void cli_table_print_row_but(struct cli_json *json, const hooke_measurement *m, const char *table,
                             int64_t row, const char *without) {
  const char *kind = hooke_measurement_kind(m), *name;
  for (int64_t k = 0; (name = hooke_measurement_column(kind, table, k, "name")); k++) {
    if (without && strcmp(name, without) == 0) continue;
    print_value(json, m, table, row, name, hooke_measurement_column(kind, table, k, "type"));
  }
}

void cli_table_print_row(struct cli_json *json, const hooke_measurement *m, const char *table, int64_t row) {
  cli_table_print_row_but(json, m, table, row, NULL);
}

static int is_record(const hooke_measurement *m, const char *table) {
  const char *kind = hooke_measurement_kind(m), *name;
  for (int64_t k = 0; (name = hooke_measurement_table(kind, k, "name")); k++) {
    if (strcmp(name, table) == 0) return strcmp(hooke_measurement_table(kind, k, "shape"), "record") == 0;
  }
  return 0;
}

void cli_table_print(struct cli_json *json, const char *key, const hooke_measurement *m, const char *table) {
  const int64_t count = hooke_measurement_row_count(m, table);
  const int record = is_record(m, table);
  if (record && count == 0) {
    cli_json_text(json, key, NULL);
    return;
  }
  cli_json_open(json, key, record ? '{' : '[');
  for (int64_t row = 0; row < count; row++) {
    if (!record) cli_json_open(json, NULL, '{');
    cli_table_print_row(json, m, table, row);
    if (!record) cli_json_close(json);
  }
  cli_json_close(json);
}
