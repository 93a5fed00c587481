/* Result tables, the counterpart of option tables: a column is described once, by its name, type, unit and
 * documentation, and by the member of a row that holds its values; rows are structs of the object itself. All
 * output of results (C, JSON, CSV, HDF5, pages, Python, Fortran, the reference) is made from the same tables.
 */
#pragma once

#include <stddef.h>
#include <stdint.h>

enum hk_column_type {
  HOOKE_COLUMN_NUMBER, /* NaN: not applicable or unknown */
  HOOKE_COLUMN_COUNT,  /* a whole number; NaN likewise */
  HOOKE_COLUMN_FLAG,   /* 0 or 1; NaN: unknown */
  HOOKE_COLUMN_TEXT,   /* NULL: none */
  HOOKE_COLUMN_SERIES  /* numbers over time */
};

/* A table may be a matrix: its rows are the pairs of an outer and an inner index. A column then varies along
 * one of them or both. */
enum hk_column_axis { HOOKE_AXIS_BOTH, HOOKE_AXIS_OUTER, HOOKE_AXIS_INNER };

/* How the member holds a value. An integer below 0 is unknown. */
enum hk_storage {
  HOOKE_STORED_DOUBLE,
  HOOKE_STORED_INT32,
  HOOKE_STORED_INT64,
  HOOKE_STORED_TEXT,  /* char * */
  HOOKE_STORED_CHARS, /* an array of char */
  HOOKE_STORED_SERIES /* double * */
};

/* Numbers over time, owned by the object that the table belongs to. */
struct hk_series {
  const double *value; /* NULL: none */
  int64_t count;
};

/* A value by the type of its column; the others are NaN and NULL. */
struct hk_value {
  double number;
  const char *text;
  struct hk_series series;
};

struct hk_column {
  const char *name;
  enum hk_column_type type;
  const char *unit, *doc;
  enum hk_column_axis axis;
  enum hk_storage storage;
  size_t offset; /* of the member in the row */
  /* what no member holds; NULL: the member does */
  double (*number)(const void *object, int64_t row);
  const char *(*text)(const void *object, int64_t row);
  const double *(*series)(const void *object, int64_t row);
};

enum { HOOKE_LISTS = 2, HOOKE_LIST_SIZE = 4 };

struct hk_table {
  const char *name, *doc;
  const char *group; /* name in HDF5, if other than `name`; tables may share one */
  int32_t record;    /* 1: one row at most, with numbers of the whole */
  /* In the JSON document of a measurement: */
  const char *inside; /* table in whose rows it stands, each with those of its inner indices; NULL: in none */
  const char *key;    /* its name there; NULL: `name` */
  const char *by;     /* column by whose texts its rows are an object; NULL: they are an array */
  const char *value;  /* column whose value alone is a row; NULL: a row is an object of all */
  const char *lists[HOOKE_LISTS][HOOKE_LIST_SIZE]; /* arrays of a row: the name, and its columns */
  int32_t series_in_json;                          /* 1: as arrays of numbers; 0: they are left out */
  int32_t empty_in_json;                           /* 1: without rows it is there, too, inside of another */
  const struct hk_column *columns;
  int32_t column_count;
  int64_t (*count)(const void *object); /* of rows; NULL: the member below, or 1 */
  size_t member, member_size;           /* of the object: int32_t or int64_t; of size 0: none */
  /* number of inner indices; NULL: the table is no matrix */
  int64_t (*inner)(const void *object);
  /* Rows of that size at a member of the object, or (by_pointer) from where it points to. Of size 0: what
   * `row` finds, or the object if that is NULL. A row that is NULL has no value. */
  size_t rows, row_size;
  int32_t by_pointer;
  const void *(*row)(const void *object, int64_t row);
  int64_t (*length)(const void *object); /* of every series */
};

/* A column for a member of the struct of a row, by the name of the member or by another. */
#define HOOKE_COLUMN(holder, member, kind, units, text)                                                      \
  HOOKE_COLUMN_AS(holder, member, member, kind, units, text)
#define HOOKE_COLUMN_AS(holder, member, title, kind, units, text)                                            \
  {                                                                                                          \
    .name = #title, .type = HOOKE_COLUMN_##kind, .unit = (units), .doc = (text),                             \
    .offset = offsetof(holder, member), .storage = HOOKE_STORAGE(((holder *)0)->member)                      \
  }
/* clang-format off */
#define HOOKE_STORAGE(member)                                                                                \
  _Generic((member),                                                                                         \
           double: HOOKE_STORED_DOUBLE, int32_t: HOOKE_STORED_INT32, int64_t: HOOKE_STORED_INT64,            \
           const char *: HOOKE_STORED_TEXT, double *: HOOKE_STORED_SERIES,                                   \
           char *: _Generic(&(member), char **: HOOKE_STORED_TEXT, default: HOOKE_STORED_CHARS))
/* clang-format on */

/* A column of what a reader finds, by its name or by another; in a matrix, along one index. */
#define HOOKE_COLUMN_BY(reader, kind, units, text) HOOKE_COLUMN_BY_AS(reader, reader, kind, units, text)
#define HOOKE_COLUMN_BY_AS(reader, title, kind, units, text)                                                 \
  HOOKE_COLUMN_ALONG(BOTH, reader, title, kind, units, text)
#define HOOKE_COLUMN_ALONG(index, reader, title, kind, units, text)                                          \
  {                                                                                                          \
    .name = #title, .type = HOOKE_COLUMN_##kind, .unit = (units), .doc = (text), .axis = HOOKE_AXIS_##index, \
    .HOOKE_READS_##kind = (reader)                                                                           \
  }
#define HOOKE_READS_NUMBER number
#define HOOKE_READS_COUNT  number
#define HOOKE_READS_FLAG   number
#define HOOKE_READS_TEXT   text
#define HOOKE_READS_SERIES series

/* A reader of a column, a row or a count: `value` of row `row` of the object `it`. */
#define HOOKE_READER(result, name, object, value)                                                            \
  static result name(const void *any, int64_t row) {                                                         \
    const object *it = any;                                                                                  \
    (void)row;                                                                                               \
    return (value);                                                                                          \
  }
#define HOOKE_COUNTER(name, object, value)                                                                   \
  static int64_t name(const void *any) {                                                                     \
    const object *it = any;                                                                                  \
    return (value);                                                                                          \
  }

#define HOOKE_TABLE_COLUMNS(...)                                                                             \
  .columns = (const struct hk_column[]){__VA_ARGS__},                                                        \
  .column_count = (int32_t)(sizeof((const struct hk_column[]){__VA_ARGS__}) / sizeof(struct hk_column))

/* The number of rows as a member of the object; the rows as another, an array (of more bytes than a pointer
 * has) or a pointer to the first; both; the one row as a member. */
#define HOOKE_TABLE_COUNT(object, name)                                                                      \
  .member = offsetof(object, name), .member_size = sizeof((const object *)0)->name
#define HOOKE_TABLE_AT(object, list)                                                                         \
  .rows = offsetof(object, list), .row_size = sizeof((const object *)0)->list[0],                            \
  .by_pointer = sizeof((const object *)0)->list == sizeof(void *)
#define HOOKE_TABLE_ROWS(object, list, count) HOOKE_TABLE_AT(object, list), HOOKE_TABLE_COUNT(object, count)
#define HOOKE_TABLE_IN(object, name)                                                                         \
  .rows = offsetof(object, name), .row_size = sizeof((const object *)0)->name

/* Column of that name; NULL if there is none. */
const struct hk_column *hk_table_find(const struct hk_table *table, const char *name);
int64_t hk_table_count(const struct hk_table *table, const void *object);

/* Value of a column in a row; none for a column that is NULL and for a row that is not there. */
struct hk_value hk_table_value(const struct hk_table *table, const struct hk_column *column,
                               const void *object, int64_t row);
