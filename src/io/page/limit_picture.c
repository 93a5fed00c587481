#include "io/page/limit_picture.h"

#include "core/memory.h"
#include "io/page/picture.h"

static const double MOVE_SCALE = 1e4; /* digits of displacements relative to the largest */

static void choose(struct hk_picture *p, const struct hk_limit *limit) {
  for (int64_t k = 0; k < limit->participation.spring_count; k++)
    hk_picture_take(p, limit->participation.spring[k].spring);
  if (hk_picture_take_families(p, HOOKE_PICTURE_SPRINGS)) return;
  for (int64_t k = 0; k < limit->participation.particle_count; k++)
    hk_picture_show(p, limit->participation.particle[k].particle);
  hk_picture_show_evenly(p);
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
  const int32_t status = hk_picture_create(limit->system, &p);
  if (status == HOOKE_OK) {
    choose(&p, limit);
    add(data, &p, limit);
  }
  if (status != HOOKE_OK && data->status == HOOKE_OK) data->status = status;
  hk_picture_release(&p);
}
