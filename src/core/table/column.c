#include "core/table/column.h"

#include <math.h>
#include <string.h>

const struct hk_column *hk_table_find(const struct hk_table *table, const char *name) {
  for (int32_t k = 0; k < table->column_count; k++) {
    if (strcmp(table->columns[k].name, name) == 0) return &table->columns[k];
  }
  return NULL;
}

int64_t hk_table_count(const struct hk_table *table, const void *object) {
  const char *member = (const char *)object + table->member;
  if (table->count) return table->count(object);
  if (table->member_size == sizeof(int64_t)) return *(const int64_t *)(const void *)member;
  return table->member_size ? *(const int32_t *)(const void *)member : 1;
}

static const void *member(const struct hk_column *column, const struct hk_line *line) {
  return (const char *)line + column->offset;
}

double hk_column_number(const struct hk_column *column, const struct hk_line *line) {
  if (column->type == HOOKE_COLUMN_TEXT || column->type == HOOKE_COLUMN_SERIES) return NAN;
  return *(const double *)member(column, line);
}

const char *hk_column_text(const struct hk_column *column, const struct hk_line *line) {
  return column->type == HOOKE_COLUMN_TEXT ? *(const char *const *)member(column, line) : NULL;
}

struct hk_series hk_column_series(const struct hk_column *column, const struct hk_line *line) {
  if (column->type != HOOKE_COLUMN_SERIES) return (struct hk_series){NULL, 0};
  return *(const struct hk_series *)member(column, line);
}

const char *hk_column_type_name(enum hk_column_type type) {
  static const char *const name[] = {"number", "count", "flag", "text", "series"};
  return name[type];
}
