/* Arrays of numbers and of particles in a scene. */
#include "io/scene/scene_json.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "core/table/option_value.h"
#include "core/table/unit.h"
#include "io/file/inputs.h"
#include "io/hdf5/array_h5.h"
#include "io/scene/scene_file.h"
#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const struct hk_option_row source_rows[] = {
    HOOKE_OPTION("file", .type = HOOKE_OPTION_TEXT, NULL, "HDF5 file, relative to the scene", .required = 1),
    HOOKE_OPTION("dataset", .type = HOOKE_OPTION_TEXT, NULL, "path of the data set in the file",
                 .required = 1),
    HOOKE_OPTION("frame", .type = HOOKE_OPTION_NUMBER, NULL, "which frame of a trajectory; -1 is the last",
                 .whole = 1),
};

static const struct hk_option_table source_table = {"data set", HOOKE_OPTION_ROWS(source_rows)};

int32_t hk_scene_reader_file(const struct hk_scene_reader *reader, const char *file, char **path) {
  int32_t status = hk_scene_find_file(reader->folder, file, reader->scene->outside, path);
  if (status == HOOKE_OK) status = hk_inputs_note(reader->scene->system, *path, 0);
  if (status == HOOKE_OK) return status;
  hk_free(*path);
  *path = NULL;
  return status;
}

/* ---- data sets ---- */

static int32_t read_dataset(const struct hk_scene_reader *reader, const hooke_options *source,
                            double **numbers, int64_t *rows, int64_t *columns) {
  char *path = NULL;
  int32_t status = hk_scene_reader_file(reader, hooke_options_text(source, "file"), &path);
  if (status) return hk_fail_within(status, "file");
  int32_t has_frame = hooke_options_is_set(source, "frame");
  int64_t frame = has_frame ? (int64_t)hooke_options_number(source, "frame") : 0;
  status = hk_array_read_within(reader->scene->memory_limit, path, hooke_options_text(source, "dataset"),
                                frame, has_frame, numbers, rows, columns);
  hk_free(path);
  /* an unusable file that a scene names is a fault of the scene */
  if (status == HOOKE_IO_FAILED) return hk_fail(HOOKE_BAD_VALUE, "file", "%s", hk_fail_message());
  if (status == HOOKE_BAD_VALUE) return hk_fail(HOOKE_BAD_VALUE, "dataset", "%s", hk_fail_message());
  return status;
}

/* Applies the rules for numbers in the text to a data set. */
static int32_t check_dataset(const double *numbers, int64_t rows, int64_t columns, int32_t wanted,
                             int32_t whole) {
  if (wanted > 1 ? columns != wanted : (columns != 1 && rows != 1))
    return hk_fail(HOOKE_BAD_VALUE, "dataset", "%lld rows of %lld numbers; allowed: rows of %d",
                   (long long)rows, (long long)columns, wanted > 1 ? (int)wanted : 1);
  for (int64_t k = 0; k < rows * columns; k++) {
    if (isfinite(numbers[k]) && (!whole || numbers[k] == rint(numbers[k]))) continue;
    return hk_fail(HOOKE_BAD_VALUE, "dataset", "%g in row %lld, column %lld; allowed: %s numbers", numbers[k],
                   (long long)(k / columns), (long long)(k % columns), whole ? "whole" : "finite");
  }
  return HOOKE_OK;
}

static int32_t numbers_from_file(struct hk_scene_reader *reader, const char *value, int32_t wanted,
                                 int32_t whole, double **numbers, int64_t *count) {
  int64_t rows = 0, columns = 0;
  hooke_options *source = NULL;
  int32_t status = hk_options_create(&source_table, &source);
  reader->in_value = 1;
  if (status == HOOKE_OK) status = hk_scene_read_options(reader, value, NULL, source);
  reader->in_value = 0;
  if (status == HOOKE_OK) status = read_dataset(reader, source, numbers, &rows, &columns);
  hooke_options_destroy(source);
  if (status == HOOKE_OK) status = check_dataset(*numbers, rows, columns, wanted, whole);
  *count = rows * columns;
  return status;
}

/* ---- numbers ---- */

int32_t hk_scene_is_word(const char *value, const struct hk_option_row *row) {
  const char *word = hk_json_text(value);
  return word && hk_option_has_word(row->words, word, (int64_t)strlen(word));
}

int32_t hk_scene_is_quantity(const char *value, const struct hk_option_row *row) {
  const char *text = hk_json_text(value);
  if (text == NULL || row->unit == NULL) return 0;
  const int64_t length = (int64_t)strlen(text);
  const struct hk_quantity found = hk_unit_scan(row->unit, text, length);
  return found.whole > found.number && found.whole == length;
}

static int32_t read_number(const char *value, const struct hk_option_row *row, double *number,
                           const char **unit) {
  const int32_t whole = row->whole;
  const char *text = hk_json_text(value);
  if (hk_scene_is_quantity(value, row))
    return hk_option_parse_number(row, NULL, text, (int64_t)strlen(text), number, unit);
  if (whole ? hk_json_is_integer(value) : hk_json_is_number(value)) return hk_json_number(value, number);
  if (row->word_lists) return hk_scene_refuse_for_row(value, NULL, row);
  return hk_scene_refuse(value, NULL, whole ? "a whole number, without a point" : "a number");
}

/* ---- particles ---- */

/* Lists "rope0, cloth1", as far as there is space. */
static void list_parts(const hooke_system *system, char *names, size_t size) {
  names[0] = '\0';
  for (int64_t k = 0; k < system->part_count; k++) {
    char shown[HOOKE_OPTION_SHOWN];
    const size_t used = strlen(names);
    hk_option_show(system->part[k].name, (int64_t)strlen(system->part[k].name), shown);
    const int fits = used + strlen(shown) + strlen(", , ...") < size;
    snprintf(names + used, size - used, "%s%s", k ? ", " : "", fits ? shown : "...");
    if (!fits) return;
  }
}

static int compare_name(const void *name, const void *part) {
  return strcmp(name, (*(const struct hk_part_record *const *)part)->name);
}

int32_t hk_scene_require_part(const struct hk_scene_reader *reader, const char *where, const char *name,
                              const struct hk_part_record **part) {
  const hooke_system *system = reader->scene->system;
  const struct hk_part_record *const *found =
      bsearch(name, reader->part, (size_t)system->part_count, sizeof *reader->part, compare_name);
  char names[256], shown[HOOKE_OPTION_SHOWN];
  *part = found ? *found : NULL;
  if (found) return HOOKE_OK;
  hk_option_show(name, (int64_t)strlen(name), shown);
  list_parts(system, names, sizeof names);
  return hk_fail(HOOKE_BAD_VALUE, where, "there is no part \"%s\"; allowed: %s", shown,
                 names[0] ? names : "none, as this scene has no parts");
}

static int32_t find_in_part(const struct hk_scene_reader *reader, const char *name, int64_t index,
                            double *particle) {
  char missing[128], shown[HOOKE_OPTION_SHOWN];
  const struct hk_part_record *part;
  const int32_t status = hk_scene_require_part(reader, "[0]", name, &part);
  if (status != HOOKE_OK) return status;
  *particle = (double)(part->first + index);
  if (index >= 0 && index < part->count) return HOOKE_OK;
  hk_option_show(name, (int64_t)strlen(name), shown);
  snprintf(missing, sizeof missing, "part \"%s\" has no particle", shown);
  return hk_fail_index("[1]", missing, (double)index, part->count);
}

static int32_t read_number_of(const struct hk_scene_reader *reader, const char *value, const char *allowed,
                              double *particle) {
  if (hk_json_is(value, '[') && reader->part) {
    const char *name = hk_json_first(value), *index = name ? hk_json_next(name) : NULL;
    if (hk_json_count(value) == 2 && hk_json_is(name, '"') && hk_json_is_integer(index))
      return find_in_part(reader, hk_json_text(name), hk_json_integer(index), particle);
  }
  if (!hk_json_is_integer(value)) return hk_scene_refuse(value, NULL, allowed);
  const int64_t count = hooke_system_particle_count(reader->scene->system), number = hk_json_integer(value);
  *particle = (double)number;
  if (number >= 0 && (number < count || reader->part == NULL)) return HOOKE_OK;
  return hk_fail_index(NULL, "there is no particle", *particle, count);
}

/* Names are looked up in the text: explicit particles are pinned before there are parts. */
static int32_t read_particle(const struct hk_scene_reader *reader, const char *value, double *particle) {
  static const char allowed[] = "the number of a particle, its name, or [\"part\", index]";
  const char *name = hk_json_text(value), *found = name ? hk_json_get(reader->names, name) : value;
  char names[512] = "";
  if (found && reader->part == NULL) return read_number_of(reader, found, "one of `particles`", particle);
  if (found) return read_number_of(reader, found, allowed, particle);
  if (!hk_json_is(reader->names, '{')) return hk_scene_refuse(value, NULL, allowed);
  for (const char *at = hk_json_first(reader->names); at; at = hk_json_next(at))
    hk_append(names, sizeof names, "%s ", at + 1);
  return hk_option_unknown(NULL, names, NULL, "particle", name);
}

/* ---- arrays ---- */

/* What an array is made of: numbers of a row, or particles. */
struct items {
  struct hk_scene_reader *reader;
  const struct hk_option_row *row;
  const char **unit; /* the base of the units so far */
  int32_t particles;
};

static int32_t refuse_row(const struct items *items, const char *value) {
  char allowed[80];
  snprintf(allowed, sizeof allowed, "a row of %d %s", (int)items->row->columns,
           items->particles    ? "particles, numbers or [\"part\", index]"
           : items->row->whole ? "whole numbers"
                               : "numbers");
  return hk_scene_refuse(value, NULL, allowed);
}

/* Adds the numbers of an array, flat or in rows of `columns`, to `count` ones; words among them are left out.
 */
static int32_t read_items(const struct items *items, const char *value, int64_t columns, double *numbers,
                          int64_t *count) {
  int64_t k = 0;
  for (const char *item = hk_json_first(value); item; item = hk_json_next(item), k++) {
    int32_t status = HOOKE_OK;
    if (items->row->word_lists && hk_scene_is_word(item, items->row)) continue;
    if (columns > 1 && hk_json_is(item, '[') && hk_json_count(item) == columns)
      status = read_items(items, item, 1, numbers, count);
    else if (columns > 1)
      status = refuse_row(items, item);
    else
      status = items->particles || (items->row->particles && hk_json_is(item, '"'))
                   ? read_particle(items->reader, item, &numbers[(*count)++])
                   : read_number(item, items->row, &numbers[(*count)++], items->unit);
    if (status) return hk_fail_within(status, "[%lld]", (long long)k);
  }
  return HOOKE_OK;
}

static int32_t read_values(const struct items *items, const char *value, double **numbers, int64_t *count) {
  const char *first = hk_json_is(value, '[') ? hk_json_first(value) : NULL;
  const int flat = items->row->flat && first && *first != '[' && hk_json_count(value) == items->row->columns;
  const int64_t columns = items->row->columns > 1 && !flat ? items->row->columns : 1;
  int32_t status;
  *numbers = NULL;
  if (hk_json_is(value, '{')) {
    status = numbers_from_file(items->reader, value, items->row->columns, items->row->whole, numbers, count);
  } else {
    *count = hk_json_is(value, '[') ? 0 : 1;
    *numbers = hk_new(*count ? 1 : columns * hk_json_count(value), sizeof(double));
    if (*numbers == NULL) return HOOKE_NO_MEMORY;
    status = *count ? read_number(value, items->row, *numbers, items->unit)
                    : read_items(items, value, columns, *numbers, count);
  }
  if (status) {
    hk_free(*numbers);
    *numbers = NULL;
  }
  return status;
}

int32_t hk_scene_read_numbers(struct hk_scene_reader *reader, const char *value,
                              const struct hk_option_row *row, double **numbers, int64_t *count,
                              const char **unit) {
  const struct items items = {reader, row, unit, 0};
  return read_values(&items, value, numbers, count);
}

/* Numbers become particles in place: large scenes have no memory for both. */
int32_t hk_scene_read_particles(struct hk_scene_reader *reader, const char *value,
                                const struct hk_scene_list *list, int64_t **particles, int64_t *count) {
  _Static_assert(sizeof(int64_t) == sizeof(double), "one takes the place of the other");
  const struct hk_option_row row = {.columns = list->columns, .whole = 1};
  const struct items items = {reader, &row, NULL, 1};
  const int64_t particle_count = hooke_system_particle_count(reader->scene->system);
  double *numbers = NULL, number;
  if (!hk_json_is(value, '[') && !hk_json_is(value, '{')) return hk_scene_refuse(value, NULL, list->allowed);
  int32_t status = read_values(&items, value, &numbers, count);
  char *where = (char *)numbers;
  for (int64_t k = 0; status == HOOKE_OK && k < *count; k++, where += sizeof(double)) {
    memcpy(&number, where, sizeof number);
    if (number < 0 || number >= (double)particle_count)
      status = hk_fail_index("dataset", "there is no particle", number, particle_count);
    const int64_t particle = status == HOOKE_OK ? (int64_t)number : 0;
    memcpy(where, &particle, sizeof particle);
  }
  if (status) hk_free(numbers);
  *particles = status ? NULL : (void *)numbers;
  return status;
}

static int32_t add_name(struct hk_scene_reader *reader, const char *name, const char *value) {
  double particle;
  const int32_t status =
      read_number_of(reader, value, "the number of a particle, or [\"part\", index]", &particle);
  if (status != HOOKE_OK) return hk_fail_within(status, "%s", name);
  return hooke_system_name_particle(reader->scene->system, name, (int64_t)particle);
}

int32_t hk_scene_add_names(struct hk_scene_reader *reader) {
  strcpy(reader->within, "names");
  int32_t status = HOOKE_OK;
  if (reader->names && !hk_json_is(reader->names, '{'))
    return hk_scene_note(reader,
                         hk_scene_refuse(reader->names, NULL, "an object { \"name\": particle, ... }"));
  for (const char *at = hk_json_first(reader->names); at && status == HOOKE_OK; at = hk_json_next(at))
    status = hk_scene_note(reader, add_name(reader, at + 1, hk_json_member(at)));
  return status;
}
