/* Internal interface of the files that read a scene from its JSON. */
#pragma once

#include "core/table/option.h"
#include "io/scene/json.h"
#include "io/scene/scene.h"
#include "io/scene/scene_file.h"
#include "model/part_record.h"

enum { HOOKE_SCENE_MOST_FAULTS = 20 };

struct hk_scene_reader {
  hooke_scene *scene;
  const char *folder;                 /* NULL: no files */
  int32_t at_key;                     /* 1 if the last failure concerns a key rather than its value */
  const struct hk_part_record **part; /* by their names; NULL before they are all added */
  const char *names;                  /* names of particles, an object; NULL: none */
  char within[64];                    /* path of the object that is read */
  int32_t
      in_value; /* 1: an object that is a value of it is read, whose failure is noted as that of the value */
  char *fault[HOOKE_SCENE_MOST_FAULTS];
  int64_t faults;
  int32_t noted; /* 1 if the last failure is among them */
};

/* Notes a failure whose place is in the object that is read, and returns HOOKE_OK, so that reading goes on
 * and finds all faults of a scene; returns `status` if it is no fault of the scene, or if there are too many.
 */
int32_t hk_scene_note(struct hk_scene_reader *reader, int32_t status);

/* ---- scene_json_values.c ---- */

/* Sets `options` from the keys of an object, row by row of their table; keys in `others` (words separated by
 * blanks) are left to the caller. Then checks that nothing required is missing. */
int32_t hk_scene_read_options(struct hk_scene_reader *reader, const char *object, const char *others,
                              hooke_options *options);
/* Fails unless `value` begins with `first`, one of { [ and "; `where` may be NULL. */
int32_t hk_scene_require(const char *value, char first, const char *where, const char *allowed);

/* "3 is not allowed; allowed: ..." */
int32_t hk_scene_refuse(const char *value, const char *where, const char *allowed);
int32_t hk_scene_refuse_for_row(const char *value, const char *where, const struct hk_option_row *row);

/* After a failure about number k of a list `name`: changes its place to the k-th element of the array that is
 * not a word. Returns `status`. */
int32_t hk_scene_place_number(int32_t status, const char *array, const char *name);

/* ---- scene_json_array.c ---- */

/* Path of a file that the scene names, which the caller frees. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. */
int32_t hk_scene_reader_file(const struct hk_scene_reader *reader, const char *file, char **path);

/* 1 for a text that is a word of the row. */
int32_t hk_scene_is_word(const char *value, const struct hk_option_row *row);

/* 1 for a text that is a number with one unit: "5 mm". Whether the unit fits is for the parser to say. */
int32_t hk_scene_is_quantity(const char *value, const struct hk_option_row *row);

/* Numbers for a row of type NUMBERS, from a number, an array, or an object that names a data set; the caller
 * frees `numbers`; words among them are left out. `unit` is set to the base of their units if any has one. */
int32_t hk_scene_read_numbers(struct hk_scene_reader *reader, const char *value,
                              const struct hk_option_row *row, double **numbers, int64_t *count,
                              const char **unit);

/* The part of a name. HOOKE_BAD_VALUE. */
int32_t hk_scene_require_part(const struct hk_scene_reader *reader, const char *where, const char *name,
                              const struct hk_part_record **part);

/* Names the particles of the scene's `names`, each a number or ["part", index]. */
int32_t hk_scene_add_names(struct hk_scene_reader *reader);

/* The particles of a list, each a number, a name or ["part", index], which the caller frees. */
int32_t hk_scene_read_particles(struct hk_scene_reader *reader, const char *value,
                                const struct hk_scene_list *list, int64_t **particles, int64_t *count);

/* ---- scene_json_pieces.c: add to the system what is under keys of the scene ---- */

int32_t hk_scene_add_parts(struct hk_scene_reader *reader, const char *root);
int32_t hk_scene_add_list(struct hk_scene_reader *reader, const char *value,
                          const struct hk_scene_list *list);
