/* Option tables: one row per option. The rows are the only place where a name, a type, a unit, a bound, a
 * default or a line of documentation is written down. */
#pragma once

#include "hooke/options.h"

enum hk_option_type {
  HOOKE_OPTION_NUMBER,  /* one number */
  HOOKE_OPTION_NUMBERS, /* min_count to max_count numbers */
  HOOKE_OPTION_FLAG,    /* true or false, held as 1 or 0 */
  HOOKE_OPTION_CHOICE,  /* one of `words` */
  HOOKE_OPTION_TEXT,    /* any text */
  HOOKE_OPTION_FAMILY   /* a nested table */
};

struct hk_option_table;

struct hk_option_row {
  const char *name;
  enum hk_option_type type;
  const char *unit;
  const char *fallback; /* as text; NULL: none */
  double low, high;     /* bounds of every number, inclusive; equal: no bounds */
  int32_t above_low;    /* 1: `low` itself is not allowed */
  int32_t whole;        /* 1: whole numbers only */
  int32_t particles;    /* 1: numbers of particles, which a scene may also name */
  int32_t wants;        /* 1: of a number: a text with a "=" is taken as a list, for its reader */
  int32_t required;
  int64_t min_count, max_count; /* of HOOKE_OPTION_NUMBERS; max_count 0: any, -1: words alone */
  int32_t columns;              /* in a scene numbers come in rows of this many ([[x,y,z],...]); 0: flat */
  int32_t flat;                 /* 1: a single row may also be flat ([x,y,z]) */
  const char *words; /* separated by blanks: the words allowed instead of numbers, or the choices */
  /* 1: several words and numbers may be mixed ("start, 3"); the text is then "word word" */
  int32_t word_lists;
  const char *only;                     /* the words of a choice that it belongs to; NULL: all */
  const char *by;                       /* that choice; NULL: the first row of the table */
  const struct hk_option_table *family; /* also of numbers: in their place */
  const char *doc;
  const char *example; /* as text: an example value */
};

struct hk_option_table {
  const char *name; /* name of the table: "rope", "run" */
  const struct hk_option_row *rows;
  int32_t row_count;
};

/* A row: its key, what it is, its default as text (NULL: none) and one line of text, then what few rows have.
 */
#define HOOKE_OPTION(key, kind, otherwise, ...)                                                              \
  { .name = (key), kind, .fallback = (otherwise), .doc = __VA_ARGS__ }
/* What rows often are: a number >= 0, > 0 or between two others, a whole number, several of them, a vector,
 * rows of x y z, numbers that are one or one for each, one word of several. */
#define HOOKE_OPTION_BETWEEN(least, most) .type = HOOKE_OPTION_NUMBER, .low = (least), .high = (most)
#define HOOKE_OPTION_NOT_NEGATIVE(units)  HOOKE_OPTION_BETWEEN(0.0, 1e300), .unit = (units)
#define HOOKE_OPTION_UP_TO(units, most)   HOOKE_OPTION_BETWEEN(0.0, most), .unit = (units), .above_low = 1
#define HOOKE_OPTION_POSITIVE(units)      HOOKE_OPTION_UP_TO(units, 1e300)
#define HOOKE_OPTION_WHOLE(least, most)   HOOKE_OPTION_BETWEEN(least, most), .whole = 1
#define HOOKE_OPTION_COUNTED(fewest, largest)                                                                \
  .type = HOOKE_OPTION_NUMBERS, .min_count = (fewest), .max_count = (largest)
#define HOOKE_OPTION_WHOLES(least, most, fewest, largest)                                                    \
  HOOKE_OPTION_COUNTED(fewest, largest), .low = (least), .high = (most), .whole = 1
#define HOOKE_OPTION_VECTOR(units) HOOKE_OPTION_COUNTED(3, 3), .unit = (units)
#define HOOKE_OPTION_VECTORS(units, fewest, largest)                                                         \
  HOOKE_OPTION_COUNTED(3 * (fewest), 3 * (largest)), .unit = (units), .columns = 3
#define HOOKE_OPTION_EACH(units)          HOOKE_OPTION_COUNTED(1, 0), .unit = (units), .high = 1e300
#define HOOKE_OPTION_EACH_POSITIVE(units) HOOKE_OPTION_EACH(units), .above_low = 1
#define HOOKE_OPTION_ONE_OF(choices)      .type = HOOKE_OPTION_CHOICE, .words = (choices)

#define HOOKE_OPTION_ROWS(rows) (rows), (int32_t)(sizeof(rows) / sizeof((rows)[0]))

int32_t hk_options_create(const struct hk_option_table *table, hooke_options **options);

const struct hk_option_table *hk_options_table(const hooke_options *options);

/* HOOKE_BAD_VALUE for the argument `where` unless these are options of that table, which
 * hooke_options_create() creates by this name. NULL is refused. */
int32_t hk_options_require(const hooke_options *options, const struct hk_option_table *table,
                           const char *where, const char *name);

/* Row of a dotted name; NULL if there is none. */
const struct hk_option_row *hk_options_find(const struct hk_option_table *table, const char *name);

/* Base of the units in which the option was given, "N" for the text "2kN"; NULL for plain numbers. */
const char *hk_options_unit_given(const hooke_options *options, const char *name);

/* Sets an option to numbers that were given in units of base `unit` (NULL: plain) and converted to it. */
int32_t hk_options_set_in_unit(hooke_options *options, const char *name, int64_t count, const double *values,
                               const char *unit);

/* Sets what is set in options of the same table. HOOKE_NO_MEMORY. */
int32_t hk_options_set_from(hooke_options *options, const hooke_options *from);

/* Sets an option and its members to those of another one that has the same row, if they are set.
 * HOOKE_NO_MEMORY. */
int32_t hk_options_set_value(hooke_options *options, const char *name, const hooke_options *from,
                             const char *named);

/* 1 if the family `name` is present. */
int32_t hk_options_has_family(const hooke_options *options, const char *name);

/* Adds a word to the option's list of words (for a row with word_lists), keeping its numbers. */
int32_t hk_options_add_word(hooke_options *options, const char *name, const char *word);

/* HOOKE_BAD_VALUE, with the place, if a required option of this table has no value, or one is set that
 * belongs to another choice. */
int32_t hk_options_check_required(const hooke_options *options);

/* Next word of a list separated by blanks, which is advanced; NULL at the end. */
const char *hk_option_next_word(const char **rest, int64_t *length);
/* 1 if `word` is one of `words`, separated by blanks (NULL: none). */
int32_t hk_option_has_word(const char *words, const char *word, int64_t length);

/* Allowed values of a row, for messages: "a number > 0", "3 numbers". */
void hk_option_describe(const struct hk_option_row *row, char *text, int64_t size);
/* The same with the unit, "a number > 0 [s]"; returns `text`. */
enum { HOOKE_OPTION_ALLOWED = 512 };
const char *hk_option_allowed(const struct hk_option_row *row, char text[HOOKE_OPTION_ALLOWED]);

/* A caller's text made safe for a message: shortened, without control characters, HOOKE_OPTION_SHOWN bytes at
 * most. */
enum { HOOKE_OPTION_SHOWN = 64 };
void hk_option_show(const char *text, int64_t length, char *shown);

/* Fails with HOOKE_BAD_VALUE: `name` is neither one of `others` (words, may be NULL) nor a row of `table`
 * (may be NULL). The message lists the known names and the closest match. `what` is "option" or "key". */
int32_t hk_option_unknown(const struct hk_option_table *table, const char *others, const char *where,
                          const char *what, const char *name);
