/* Wavefront OBJ: the subset that a surface needs. */
#pragma once

#include "hooke/base.h"

struct hk_obj {
  int64_t vertex_count, triangle_count;
  int64_t vertex_capacity, triangle_capacity;
  double *vertex;                       /* 3 vertex_count */
  int64_t *triangle;                    /* 3 triangle_count, from 0 */
  int32_t *vertex_line, *triangle_line; /* their first lines, from 1 */
};

/* Reads `length` bytes. On failure `line` is the line of the fault, and the message does not name the file.
 * HOOKE_BAD_VALUE, HOOKE_NO_MEMORY; must be released in each case. */
int32_t hk_obj_parse(const char *text, int64_t length, struct hk_obj *obj, int64_t *line);
/* Maximum memory [bytes] for reading `length` bytes of such a file into a mesh. */
double hk_obj_bytes(const char *text, int64_t length);
void hk_obj_release(struct hk_obj *obj);
