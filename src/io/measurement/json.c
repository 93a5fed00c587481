/* Measurements as JSON: every column of every table, series only where a table says so. Some tables stand
 * inside of others, and rows have arrays of what columns say one by one. */
#include "core/memory.h"
#include "io/file/atomic_file.h"
#include "io/measurement/measurement_file.h"
#include "measure/needs/needs.h"
#include "measure/study/study.h"
#include "model/callbacks.h"

#include <math.h>
#include <string.h>

static void add_table(struct hk_text *text, const hooke_measurement *m, const char *key,
                      const struct hk_table *table, int64_t of);
static void add_quantities(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table);

static int is_named(const char *name, const char *other) {
  return name && other && strcmp(name, other) == 0;
}

static const char *key_of(const struct hk_table *table) {
  return table->key ? table->key : table->name;
}

/* ---- values ---- */

/* A want that is met as far as errors are known is not known to be met to the end. */
static struct hk_value value_of(const hooke_measurement *m, const struct hk_table *table,
                                const struct hk_column *column, int64_t row) {
  struct hk_value value = hk_measured_value(m, table, column, row);
  if (m->kind == &hk_study_kind && is_named("met", column->name) && !hk_study_knows_met(m->object))
    value.number = NAN;
  return value;
}

static void add_value(struct hk_text *text, const char *key, enum hk_column_type type,
                      struct hk_value value) {
  if (type == HOOKE_COLUMN_TEXT)
    hk_text_word(text, key, value.text);
  else if (type == HOOKE_COLUMN_FLAG && !isnan(value.number))
    hk_text_flag(text, key, value.number != 0.0);
  else
    hk_text_number(text, key, value.number);
}

static int is_known(struct hk_value value) {
  return value.text || !isnan(value.number);
}

/* An array that is named like its first column stands in place of all of them. */
static int replaces(const char *const *list) {
  return is_named(list[0], list[1]);
}

/* Of the known values; null where the first is not known, if the columns say so as well. */
static void add_list(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table,
                     const char *const *list, int64_t row) {
  if (!replaces(list) && !is_known(value_of(m, table, hk_table_find(table, list[1]), row))) {
    hk_text_word(text, list[0], NULL);
    return;
  }
  hk_text_open(text, list[0], '[');
  for (int k = 1; k < HOOKE_LIST_SIZE && list[k]; k++) {
    const struct hk_column *column = hk_table_find(table, list[k]);
    const struct hk_value value = value_of(m, table, column, row);
    if (is_known(value)) add_value(text, NULL, column->type, value);
  }
  hk_text_close(text, ']');
}

/* 1 if the key of the row or an array stands for the column. */
static int is_said(const struct hk_table *table, const char *column) {
  int said = is_named(table->by, column);
  for (int k = 0; k < HOOKE_LISTS * HOOKE_LIST_SIZE; k++) {
    const char *const *list = table->lists[k / HOOKE_LIST_SIZE];
    said |= replaces(list) && is_named(list[k % HOOKE_LIST_SIZE], column);
  }
  return said;
}

/* ---- rows ---- */

/* What the lean system is without. */
static void add_left_out(struct hk_text *text, const hooke_measurement *m) {
  const struct hk_needs *needs = m->object;
  hk_text_open(text, "without", '[');
  for (int64_t row = 0; row < hk_needs_known_rows(needs); row++)
    if (needs->row[row].left_out) hk_text_word(text, NULL, needs->row[row].without);
  hk_text_close(text, ']');
}

static void add_row(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table,
                    int64_t row) {
  for (int k = 0; k < HOOKE_LISTS && table->lists[k][0]; k++)
    add_list(text, m, table, table->lists[k], row);
  for (int32_t k = 0; k < table->column_count; k++) {
    const struct hk_column *column = &table->columns[k];
    if (is_said(table, column->name)) continue;
    const struct hk_value value = value_of(m, table, column, row);
    if (column->type != HOOKE_COLUMN_SERIES)
      add_value(text, column->name, column->type, value);
    else if (table->series_in_json)
      hk_text_numbers(text, column->name, value.series.value ? value.series.count : 0, value.series.value);
  }
  if (table == hk_measurement_table(&hk_needs_kind, "lean")) add_left_out(text, m);
  const struct hk_table *other;
  for (int64_t k = 0; (other = hk_measurement_table_at(m->kind, k)) != NULL; k++) {
    if (!is_named(other->inside, table->name)) continue;
    if (is_named(other->key, "quantities"))
      add_quantities(text, m, other);
    else if (other->record || hk_measured_rows(m, other) > 0 || other->empty_in_json)
      add_table(text, m, key_of(other), other, row);
  }
}

/* ---- tables ---- */

static void add_object(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table,
                       int64_t row, const char *key) {
  hk_text_open(text, key, '{');
  add_row(text, m, table, row);
  hk_text_close(text, '}');
}

/* A row of a table, as an object or a value. */
static void add_member(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table,
                       int64_t row, const char *key) {
  const struct hk_column *value = table->value ? hk_table_find(table, table->value) : NULL;
  if (value)
    add_value(text, key, value->type, value_of(m, table, value, row));
  else
    add_object(text, m, table, row, key);
}

static const char *text_of(const hooke_measurement *m, const struct hk_table *table, int64_t row,
                           const char *column) {
  return hk_measured_value(m, table, hk_table_find(table, column), row).text;
}

/* The statistics of each quantity: of the reference, and by method. */
static void add_quantities(struct hk_text *text, const hooke_measurement *m, const struct hk_table *table) {
  const int64_t count = hk_measured_rows(m, table), inner = table->inner(m->object);
  hk_text_open(text, "quantities", '[');
  for (int64_t k = 0; k < inner; k++) {
    hk_text_open(text, NULL, '{');
    hk_text_word(text, "quantity", text_of(m, table, k, "quantity"));
    hk_text_word(text, "unit", text_of(m, table, k, "unit"));
    add_object(text, m, table, k, "reference");
    hk_text_open(text, "methods", '{');
    for (int64_t row = k + inner; row < count; row += inner)
      add_object(text, m, table, row, text_of(m, table, row, "method"));
    hk_text_close(text, '}');
    hk_text_close(text, '}');
  }
  hk_text_close(text, ']');
}

/* 1 unless the row is one of a table by name, and says nothing but the name. */
static int is_there(const hooke_measurement *m, const struct hk_table *table, int64_t row) {
  int there = table->by == NULL;
  for (int32_t k = 0; k < table->column_count; k++)
    there |= !isnan(hk_measured_value(m, table, &table->columns[k], row).number);
  return there;
}

/* `of`: row of the table that it stands inside of. */
static void add_table(struct hk_text *text, const hooke_measurement *m, const char *key,
                      const struct hk_table *table, int64_t of) {
  const char *by = table->by;
  int64_t count = hk_measured_rows(m, table), first = 0;
  if (table->inside && table->inner) {
    count = table->inner(m->object);
    first = of * count;
  }
  if (table->record && count > 0) add_object(text, m, table, 0, key);
  if (table->record && count == 0) hk_text_word(text, key, NULL);
  if (table->record) return;
  hk_text_open(text, key, by ? '{' : '[');
  for (int64_t row = first; row < first + count; row++)
    if (!by || table->value || is_there(m, table, row))
      add_member(text, m, table, row, by ? text_of(m, table, row, by) : NULL);
  hk_text_close(text, by ? '}' : ']');
}

void hk_measurement_add_row(struct hk_text *text, const hooke_measurement *m, const char *table,
                            int64_t row) {
  add_row(text, m, hk_measurement_table(m->kind, table), row);
}

/* ---- documents ---- */

void hk_measurement_add_all(struct hk_text *text, const hooke_measurement *m, const char *except) {
  const int32_t calls = m->system ? hk_system_calls_back(m->system) : 0;
  char *const *from = calls ? hk_force_from(m->system) : NULL;
  if (calls) hk_text_word(text, "callbacks", hk_callbacks_text(calls));
  for (int k = 0; from && k < HOOKE_FORCE_TEXTS; k++)
    hk_text_word(text, hk_force_texts[k], from[k]);
  const struct hk_table *table;
  for (int64_t k = 0; (table = hk_measurement_table_at(m->kind, k)) != NULL; k++) {
    if (is_named(table->name, m->kind->name))
      add_row(text, m, table, 0);
    else if (!table->inside && !is_named(table->name, except))
      add_table(text, m, key_of(table), table, 0);
  }
}

static void add_document(struct hk_text *text, const hooke_measurement *m) {
  hk_text_open(text, NULL, '{');
  hk_measurement_add_all(text, m, NULL);
  hk_text_close(text, '}');
}

int32_t hk_measurement_write_json(const hooke_measurement *m, const char *path) {
  struct hk_text text = {.bytes = NULL}, laid = {.bytes = NULL};
  add_document(&text, m);
  if (text.status == HOOKE_OK) hk_text_lay_out(&text, &laid);
  int32_t status = text.status == HOOKE_OK ? laid.status : text.status;
  if (status == HOOKE_OK) status = hk_file_write(path, laid.bytes, laid.length);
  hk_text_release(&laid);
  hk_text_release(&text);
  return status;
}

const char *hooke_measurement_json(hooke_measurement *m, const char *table, int64_t row) {
  const struct hk_table *t = table ? hk_measurement_table(m->kind, table) : NULL;
  struct hk_text text = {.is_spaced = 1};
  if (table && (!t || row < -1 || row >= hk_measured_rows(m, t))) return NULL;
  if (t && row < 0) add_table(&text, m, NULL, t, 0);
  if (t && row >= 0) add_object(&text, m, t, row, NULL);
  if (!t) add_document(&text, m);
  hk_text_add(&text, "", 1);
  hk_free(m->json);
  m->json = text.status == HOOKE_OK ? text.bytes : NULL;
  if (!m->json) hk_text_release(&text);
  return m->json;
}
