/* Wavefront OBJ: what a surface needs of it. */
#ifndef HOOKE_IO_SCENE_OBJ_H
#define HOOKE_IO_SCENE_OBJ_H

#include "hooke/base.h"

struct hk_obj {
  int64_t vertex_count, triangle_count;
  int64_t vertex_capacity, triangle_capacity;
  double *vertex;                       /* 3 vertex_count */
  int64_t *triangle;                    /* 3 triangle_count, from 0 */
  int32_t *vertex_line, *triangle_line; /* lines that they begin on, from 1 */
};

/* Reads `length` bytes. On failure `line` is that of the trouble, and the message is without the name of the
 * file. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY; to be released in each case. */
int32_t hk_obj_parse(const char *text, int64_t length, struct hk_obj *obj, int64_t *line);
/* What reading `length` bytes of such a file into a mesh needs at most [bytes]. */
double hk_obj_bytes(const char *text, int64_t length);
void hk_obj_release(struct hk_obj *obj);

#endif
