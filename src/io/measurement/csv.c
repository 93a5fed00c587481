/* The rows of a measurement as CSV, with the same bytes in every locale. A matrix with an outer row for each
 * of them adds a column for each inner index: the errors in watched quantities. */
#include "core/number.h"
#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/measurement/measurement_file.h"

#include <math.h>
#include <string.h>

struct sheet {
  const hooke_measurement *m;
  const struct hk_table *rows;
  const struct hk_table *matrix;          /* NULL: none */
  int64_t columns;                        /* of it */
  const struct hk_column *label, *number; /* of the matrix: column of the name, column of the value */
};

static void add_value(struct hk_text *text, const struct hk_table *table, const struct hk_column *column,
                      const void *object, int64_t row) {
  char number[HOOKE_NUMBER_SIZE] = "";
  const struct hk_value value = hk_table_value(table, column, object, row);
  if (isfinite(value.number)) hk_number_print(value.number, number);
  hk_text_say(text, number);
  hk_text_cell(text, value.text);
}

/* Line `row`; -1: the line of names. */
static void add_line(struct hk_text *text, const struct sheet *sheet, int64_t row) {
  const void *object = sheet->m->object;
  int32_t first = 1;
  for (int32_t k = 0; k < sheet->rows->column_count; k++) {
    const struct hk_column *column = &sheet->rows->columns[k];
    if (column->type == HOOKE_COLUMN_SERIES) continue;
    if (!first) hk_text_say(text, ",");
    first = 0;
    if (row < 0)
      hk_text_say(text, column->name);
    else
      add_value(text, sheet->rows, column, object, row);
  }
  for (int64_t k = 0; k < sheet->columns; k++) {
    hk_text_say(text, ",");
    if (row < 0)
      hk_text_quoted(text, hk_table_value(sheet->matrix, sheet->label, object, k).text);
    else
      add_value(text, sheet->matrix, sheet->number, object, row * sheet->columns + k);
  }
  hk_text_say(text, "\n");
}

/* A matrix whose outer index is the row number. */
static void find_matrix(struct sheet *sheet) {
  const struct hk_measurement_kind *kind = sheet->m->kind;
  for (const struct hk_table *table = kind->tables; table->name; table++) {
    if (table->inner == NULL || hk_table_find(table, "row") == NULL) continue;
    if (hk_table_count(table, sheet->m->object) > 0) sheet->matrix = table;
    if (sheet->matrix) sheet->columns = table->inner(sheet->m->object);
    for (int32_t c = 0; c < table->column_count; c++) {
      const struct hk_column *column = &table->columns[c];
      if (column->axis == HOOKE_AXIS_INNER) sheet->label = column;
      if (column->axis == HOOKE_AXIS_BOTH && column->type == HOOKE_COLUMN_NUMBER) sheet->number = column;
    }
  }
}

int32_t hk_measurement_write_csv(const hooke_measurement *m, const char *path) {
  struct sheet sheet = {.m = m, .rows = hk_measurement_table(m->kind, "rows")};
  struct hk_text text = {.bytes = NULL};
  if (sheet.rows == NULL)
    return hk_fail(HOOKE_BAD_VALUE, "path", "%s: a %s has no rows to write as CSV", path, m->kind->name);
  find_matrix(&sheet);
  for (int64_t row = -1; row < hk_table_count(sheet.rows, m->object); row++)
    add_line(&text, &sheet, row);
  const int32_t status = text.status == HOOKE_OK ? hk_file_write(path, text.bytes, text.length) : text.status;
  hk_text_release(&text);
  return status;
}
