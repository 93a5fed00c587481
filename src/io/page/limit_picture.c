#include "io/page/limit_picture.h"

#include "core/memory.h"
#include "io/page/picture.h"
#include "measure/limit/limit.h"

static const double MOVE_SCALE = 1e4; /* digits of displacements against the largest */

/* What is left is taken evenly by number; `moves`: of each particle, it is among the movers. */
static void choose(struct hooke_picture *p, const hooke_limit *limit, const char *moves) {
  for (int64_t k = 0; k < hooke_limit_blame_count(limit); k++) {
    if (!hooke_limit_blame_text(limit, k, "force")[0])
      hooke_picture_take(p, (int64_t)hooke_limit_blame_number(limit, k, "spring"));
  }
  for (int64_t k = 0; k < p->spring_count && p->drawn_count < HOOKE_PICTURE_SPRINGS / 2; k++) {
    if (moves[p->ends[2 * k]] || moves[p->ends[2 * k + 1]]) hooke_picture_take(p, k);
  }
  hooke_picture_take_evenly(p, 0, p->spring_count, HOOKE_PICTURE_SPRINGS - p->drawn_count);
}

static void add(struct hooke_text *data, struct hooke_picture *p, const hooke_limit *limit, const double *q) {
  hooke_text_open(data, "picture", '{');
  hooke_text_number(data, "springs", (double)p->spring_count);
  hooke_text_number(data, "particles", (double)hooke_system_particle_count(p->system));
  hooke_picture_add_springs(data, p);
  int64_t *list = hooke_picture_list(p);
  if (list) {
    hooke_picture_add_particles(data, p, list);
    hooke_picture_add_vectors(data, "position", q, list, p->shown_count,
                              hooke_picture_scale(q, list, p->shown_count));
    hooke_picture_add_vectors(data, "move", hooke_limit_shape(limit), list, p->shown_count, MOVE_SCALE);
  } else {
    data->status = HOOKE_NO_MEMORY;
  }
  hooke_free(list);
  hooke_text_close(data, '}');
}

void hooke_limit_picture_add(struct hooke_text *data, const hooke_limit *limit, const double *q) {
  struct hooke_picture p;
  int32_t status = hooke_picture_create(limit->system, &p);
  char *moves = hooke_new(hooke_system_particle_count(limit->system), 1);
  if (status == HOOKE_OK && moves == NULL) status = HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < hooke_limit_mover_count(limit) && status == HOOKE_OK; k++)
    moves[(int64_t)hooke_limit_mover_number(limit, k, "particle")] = 1;
  if (status == HOOKE_OK) {
    choose(&p, limit, moves);
    add(data, &p, limit, q);
  }
  if (status != HOOKE_OK && data->status == HOOKE_OK) data->status = status;
  hooke_picture_release(&p);
  hooke_free(moves);
}
