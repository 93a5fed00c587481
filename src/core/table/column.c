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

/* The member of a column, or what its row begins with; NULL: the row has no value. */
static const void *place(const struct hk_table *table, const struct hk_column *column, const void *object,
                         int64_t row) {
  const char *holder = table->row ? table->row(object, row) : object;
  if (table->row_size > 0) holder += table->rows;
  if (table->by_pointer) holder = *(const char *const *)(const void *)holder;
  return holder ? holder + (size_t)row * table->row_size + column->offset : NULL;
}

static double number_at(const struct hk_column *column, const void *at) {
  if (column->storage == HOOKE_STORED_DOUBLE) return *(const double *)at;
  const int64_t whole = column->storage == HOOKE_STORED_INT32 ? *(const int32_t *)at : *(const int64_t *)at;
  return whole < 0 ? NAN : (double)whole;
}

struct hk_value hk_table_value(const struct hk_table *table, const struct hk_column *column,
                               const void *object, int64_t row) {
  struct hk_value value = {NAN, NULL, {NULL, 0}};
  const int32_t is_there = column && row >= 0 && row < hk_table_count(table, object);
  const void *at = is_there ? place(table, column, object, row) : NULL;
  if (at == NULL) return value;
  if (column->type == HOOKE_COLUMN_TEXT)
    value.text = column->text                            ? column->text(object, row)
                 : column->storage == HOOKE_STORED_CHARS ? at
                                                         : *(const char *const *)at;
  else if (column->type == HOOKE_COLUMN_SERIES)
    value.series = (struct hk_series){column->series ? column->series(object, row) : *(double *const *)at,
                                      table->length(object)};
  else
    value.number = column->number ? column->number(object, row) : number_at(column, at);
  return value;
}
