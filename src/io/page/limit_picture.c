#include "io/page/limit_picture.h"

#include "core/memory.h"
#include "io/page/picture.h"

static const double MOVE_SCALE = 1e4; /* digits of displacements relative to the largest */

/* Samples the remaining springs evenly by number; `moves`, by particle: it moves in the mode. */
static void choose(struct hk_picture *p, const struct hk_limit *limit, const char *moves) {
  for (int64_t k = 0; k < limit->participation.spring_count; k++)
    hk_picture_take(p, limit->participation.spring[k].spring);
  for (int64_t k = 0; k < p->spring_count && p->drawn_count < HOOKE_PICTURE_SPRINGS / 2; k++) {
    if (moves[p->ends[2 * k]] || moves[p->ends[2 * k + 1]]) hk_picture_take(p, k);
  }
  hk_picture_take_evenly(p, 0, p->spring_count, HOOKE_PICTURE_SPRINGS - p->drawn_count);
}

static void add(struct hk_text *data, struct hk_picture *p, const struct hk_limit *limit) {
  hk_text_open(data, "picture", '{');
  hk_text_number(data, "springs", (double)p->spring_count);
  hk_text_number(data, "particles", (double)hooke_system_particle_count(p->system));
  hk_picture_add_springs(data, p);
  int64_t *list = hk_picture_list(p);
  if (list) {
    hk_picture_add_particles(data, p, list);
    hk_picture_add_vectors(data, "position", limit->q, list, p->shown_count,
                           hk_picture_scale(limit->q, list, p->shown_count));
    hk_picture_add_vectors(data, "move", hk_limit_limiting_row(limit) ? limit->shape : NULL, list,
                           p->shown_count, MOVE_SCALE);
  } else {
    data->status = HOOKE_NO_MEMORY;
  }
  hk_free(list);
  hk_text_close(data, '}');
}

void hk_limit_picture_add(struct hk_text *data, const struct hk_limit *limit) {
  struct hk_picture p;
  int32_t status = hk_picture_create(limit->system, &p);
  char *moves = hk_new(hooke_system_particle_count(limit->system), 1);
  if (status == HOOKE_OK && moves == NULL) status = HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < limit->participation.particle_count && status == HOOKE_OK; k++)
    moves[limit->participation.particle[k].particle] = 1;
  if (status == HOOKE_OK) {
    choose(&p, limit, moves);
    add(data, &p, limit);
  }
  if (status != HOOKE_OK && data->status == HOOKE_OK) data->status = status;
  hk_picture_release(&p);
  hk_free(moves);
}
