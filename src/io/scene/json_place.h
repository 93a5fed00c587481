/* Finds a path such as "springs[2].stiffness[3]" in a JSON text. The parser keeps no positions, so the text
 * is searched again; used for messages only. */
#ifndef HOOKE_IO_SCENE_JSON_PLACE_H
#define HOOKE_IO_SCENE_JSON_PLACE_H

#include "hooke/base.h"

/* Position of the value at `path`, or of the longest prefix of `path` that exists; with `key` not 0, of its
 * key. `text` is valid JSON. */
const char *hk_json_find(const char *text, int64_t length, const char *path, int32_t key);

/* Line and column (from 1, in characters) of a position in the text. */
void hk_json_line(const char *text, const char *at, int64_t *line, int64_t *column);

#endif
