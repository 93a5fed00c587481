/* Result tables, the counterpart of option tables: a column is described once, by its name, type, unit and
 * documentation. All output of results (C, JSON, CSV, HDF5, pages, Python, Fortran, the reference) is made
 * from the same tables. */
#ifndef HOOKE_CORE_TABLE_COLUMN_H
#define HOOKE_CORE_TABLE_COLUMN_H

#include <stddef.h>
#include <stdint.h>

enum hk_column_type {
  HOOKE_COLUMN_NUMBER, /* a double; NaN: not applicable or unknown */
  HOOKE_COLUMN_COUNT,  /* a double with a whole value */
  HOOKE_COLUMN_FLAG,   /* a double, 0 or 1; NaN: unknown */
  HOOKE_COLUMN_TEXT,   /* const char *; NULL: none */
  HOOKE_COLUMN_SERIES  /* struct hk_series */
};

/* A table may be a matrix: its rows are the pairs of an outer and an inner index. A column then varies along
 * one of them or both. */
enum hk_column_axis { HOOKE_AXIS_BOTH, HOOKE_AXIS_OUTER, HOOKE_AXIS_INNER };

/* Numbers over time, owned by the object that the table belongs to. */
struct hk_series {
  const double *value; /* NULL: none */
  int64_t count;
};

/* A value is a member of the struct `line`, which the table fills for one row. */
struct hk_column {
  const char *name;
  enum hk_column_type type;
  const char *unit, *doc;
  size_t offset; /* in the struct */
  enum hk_column_axis axis;
};

struct hk_table {
  const char *name, *doc;
  const char *group; /* name in HDF5, if other than `name`; tables may share one */
  int32_t record;    /* 1: one row at most, with numbers of the whole */
  const struct hk_column *columns;
  int32_t column_count;
  size_t size;                          /* of the struct; at most sizeof(struct hk_line) */
  int64_t (*count)(const void *object); /* of rows; NULL: the member below, or 1 */
  size_t member, member_size;           /* of the object: int32_t or int64_t; of size 0: none */
  /* number of inner indices; NULL: the table is no matrix */
  int64_t (*inner)(const void *object);
  void (*read)(const void *object, int64_t row, void *line);
};

/* Storage for the struct of any table. */
struct hk_line {
  double words[48];
};

/* A column for a member of the struct `line`, and the columns of a table. */
#define HOOKE_COLUMN(line, member, kind, units, text)                                                        \
  {                                                                                                          \
    .name = #member, .type = HOOKE_COLUMN_##kind, .unit = (units), .doc = (text),                            \
    .offset = offsetof(line, member)                                                                         \
  }
#define HOOKE_COLUMN_ALONG(index, line, member, kind, units, text)                                           \
  {                                                                                                          \
    .name = #member, .type = HOOKE_COLUMN_##kind, .unit = (units), .doc = (text),                            \
    .offset = offsetof(line, member), .axis = HOOKE_AXIS_##index                                             \
  }
#define HOOKE_TABLE_COLUMNS(list, line)                                                                      \
  .columns = (list), .column_count = (int32_t)(sizeof(list) / sizeof((list)[0])),                            \
  .size = sizeof(char[sizeof(line) <= sizeof(struct hk_line) ? sizeof(line) : 0])

/* The number of rows as a member of the object. */
#define HOOKE_TABLE_COUNT(object, name)                                                                      \
  .member = offsetof(object, name), .member_size = sizeof((const object *)0)->name

/* Column of that name; NULL if there is none. */
const struct hk_column *hk_table_find(const struct hk_table *table, const char *name);
int64_t hk_table_count(const struct hk_table *table, const void *object);

/* Value of a column: NaN or NULL for a column of another type. */
double hk_column_number(const struct hk_column *column, const struct hk_line *line);
const char *hk_column_text(const struct hk_column *column, const struct hk_line *line);
struct hk_series hk_column_series(const struct hk_column *column, const struct hk_line *line);

/* "number", "count", "flag", "text" or "series". */
const char *hk_column_type_name(enum hk_column_type type);

#endif
