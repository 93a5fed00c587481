/* hooke/options.h - named options, with their types, units, bounds and defaults.
 *
 * One table describes each configurable object (a spring group, a part, a run). An options object holds
 * values for one such table. Scene keys, command-line flags, Python keywords and the printed reference all
 * read the same tables.
 *
 * A nested table (the family of springs of a part) is reached with a dot: "structural.stiffness".
 * An options object belongs to one thread at a time. */
#ifndef HOOKE_OPTIONS_H
#define HOOKE_OPTIONS_H

#include "base.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_options hooke_options;

/* Creates options of the table `name`, which the caller sets and destroys: "run", "springs", "altitude",
 * "anchors" and "loads" (of a group), a kind of part ("cloth", ...), a kind of measurement ("study", ...),
 * "limits" on loading, or "scene", "particles", "driven" and "bending", the remaining keys of a scene. The
 * message of HOOKE_BAD_VALUE lists them all; HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_options_create(const char *name, hooke_options **options);

/* A copy of `options` with all values; the caller owns it. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_options_copy(const hooke_options *options, hooke_options **copy);

/* Releases `options`; NULL is allowed. */
HOOKE_API void hooke_options_destroy(hooke_options *options);

/* Sets the option `name` to one number, to `count` numbers (copied), or to the value of `text`: "0.5",
 * "1e-3", "0,-9.81,0", rows "1,0,0;0,0,1", a size "64x64", "5ms", "0.5 cm", "true", or one of the words that
 * the option accepts. A number without a unit is in that of the row; 3um is 3e-6 to the bit. A flag is the
 * number 0 or 1. Setting a family name ("structural") to "" makes it present with its defaults.
 * HOOKE_BAD_VALUE for an unknown name, a wrong type or count, a non-finite value or one out of bounds; the
 * option then keeps its old value. HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_options_set_number(hooke_options *options, const char *name, double value);
HOOKE_API int32_t hooke_options_set_numbers(hooke_options *options, const char *name, int64_t count,
                                            const double *values);
HOOKE_API int32_t hooke_options_set_text(hooke_options *options, const char *name, const char *text);

/* Resets an option to its default. HOOKE_BAD_VALUE for an unknown name. */
HOOKE_API int32_t hooke_options_unset(hooke_options *options, const char *name);

/* 1 if the option was set; 0 if it has its default or no value, or does not exist. */
HOOKE_API int32_t hooke_options_is_set(const hooke_options *options, const char *name);

/* Number of numbers that the option holds, defaults included; 0 if it holds a word or nothing. */
HOOKE_API int64_t hooke_options_number_count(const hooke_options *options, const char *name);

/* The numbers, valid until the option is set again or the object destroyed; NULL if there are none. */
HOOKE_API const double *hooke_options_numbers(const hooke_options *options, const char *name);

/* The first number; NaN if there is none. */
HOOKE_API double hooke_options_number(const hooke_options *options, const char *name);

/* The word or text of the option, "" if none; valid until the option is set again. */
HOOKE_API const char *hooke_options_text(const hooke_options *options, const char *name);

/* Rows of the table. The rows of a nested table follow their family, with dotted names. */
HOOKE_API int64_t hooke_options_row_count(const hooke_options *options);

/* A property of row `row` as text, "" where it has none, NULL if there is no such row or property, or no
 * memory to put "allowed" or "units" into words. Lives as long as `options`.
 *   "name", "unit", "default", "doc"
 *   "type"     "number", "numbers", "flag", "choice", "text" or "family"
 *   "allowed"  in words: "a number >= 0"
 *   "words"    the choices, or the words accepted in place of numbers, separated by blanks
 *   "family"   the family of the row
 *   "only"     the word of the table's first row, a choice, with which it may be given
 *   "units"    the units that a text may name, separated by commas: "s, ms, us, ns, ps, fs, min, h"
 *   "example"  a value for a first try, in the syntax of hooke_options_set_text() */
HOOKE_API const char *hooke_options_row(const hooke_options *options, int64_t row, const char *property);

/* A property of row `row` as a number, NaN where it has none.
 *   "low", "high"           bounds of every number, inclusive unless "above_low" is 1
 *   "above_low", "whole"    1 if low is not allowed; if only whole numbers are
 *   "required"              1 if it has to be given; for a member of a family, where the family is given, and
 * with "only", where that is chosen "min_count", "max_count" of the type "numbers"; NaN: any count "columns"
 * numbers come in rows of this many in a scene, "flat" 1 if one row may do without its brackets "word_lists"
 * 1 if several words and numbers may be mixed; of a text: it may have several lines */
HOOKE_API double hooke_options_row_number(const hooke_options *options, int64_t row, const char *property);

#ifdef __cplusplus
}
#endif
#endif
