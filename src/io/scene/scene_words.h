/* Values of a scene as JSON. */
#ifndef HOOKE_IO_SCENE_SCENE_WORDS_H
#define HOOKE_IO_SCENE_SCENE_WORDS_H

#include "core/table/option.h"
#include "io/file/text.h"

/* An array of numbers, in rows of `columns` (0: flat). */
void hk_scene_add_numbers(struct hk_text *text, const char *key, int64_t count, int32_t columns,
                          const double *value);

/* Every option that is set, under its key, except `left_out` (may be NULL). */
void hk_scene_add_options(struct hk_text *text, const hooke_options *options, const char *left_out);

#endif
