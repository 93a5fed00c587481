/* Measurements as JSON. */
#include "io/file/atomic_file.h"
#include "io/measurement/measurement_file.h"
#include "model/callbacks.h"

#include <math.h>
#include <stddef.h>

static void add_row(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table,
                    int64_t row) {
  for (int32_t k = 0; k < table->column_count; k++) {
    const struct hk_column *column = &table->columns[k];
    const double number = hk_table_number(table, column, m->object, row);
    if (column->type == HOOKE_COLUMN_TEXT)
      hk_text_word(text, column->name, hk_table_text(table, column, m->object, row));
    else if (column->type == HOOKE_COLUMN_FLAG && !isnan(number))
      hk_text_flag(text, column->name, number != 0.0);
    else if (column->type != HOOKE_COLUMN_SERIES)
      hk_text_number(text, column->name, number);
  }
}

static void add_table(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table) {
  const int64_t count = hk_table_count(table, m->object);
  if (table->record && count == 0) {
    hk_text_word(text, table->name, NULL);
    return;
  }
  hk_text_open(text, table->name, table->record ? '{' : '[');
  for (int64_t row = 0; row < count; row++) {
    if (!table->record) hk_text_open(text, NULL, '{');
    add_row(text, m, table, row);
    if (!table->record) hk_text_close(text, '}');
  }
  hk_text_close(text, table->record ? '}' : ']');
}

void hk_measurement_add_row(struct hk_text *text, const hooke_measurement *m, const char *table,
                            int64_t row) {
  add_row(text, m, hk_measurement_table(m->kind, table), row);
}

void hk_measurement_add_table(struct hk_text *text, const hooke_measurement *m, const char *table) {
  add_table(text, m, hk_measurement_table(m->kind, table));
}

void hk_measurement_add_tables(struct hk_text *text, const hooke_measurement *m) {
  for (const struct hk_table *table = m->kind->tables; table->name; table++)
    add_table(text, m, table);
}

int32_t hk_measurement_write_json(const hooke_measurement *m, const char *path) {
  struct hk_text text = {.bytes = NULL}, laid = {.bytes = NULL};
  const int32_t calls = m->system ? hk_system_calls_back(m->system) : 0;
  hk_text_open(&text, NULL, '{');
  if (calls) hk_text_word(&text, "callbacks", hk_callbacks_text(calls));
  hk_measurement_add_tables(&text, m);
  hk_text_close(&text, '}');
  if (text.status == HOOKE_OK) hk_text_lay_out(&text, &laid);
  int32_t status = text.status == HOOKE_OK ? laid.status : text.status;
  if (status == HOOKE_OK) status = hk_file_write(path, laid.bytes, laid.length);
  hk_text_release(&laid);
  hk_text_release(&text);
  return status;
}
