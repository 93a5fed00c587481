/* The pages of modes and of a rest: the scene as a picture, on which modes play. */
#include "core/memory.h"
#include "core/status.h"
#include "io/page/picture.h"
#include "io/page/report.h"
#include "measure/rest/rest.h"

/* With tensions [N] of all springs, or NULL. */
static int32_t add_picture(struct hk_text *data, const hooke_system *system, const double *position,
                           const double *tension) {
  struct hk_picture p;
  int32_t status = hk_picture_create(system, &p);
  if (status == HOOKE_OK) {
    if (!hk_picture_take_families(&p, HOOKE_PICTURE_SPRINGS)) hk_picture_show_evenly(&p);
    hk_text_open(data, "rows", '[');
    hk_text_close(data, ']');
    hk_text_open(data, "picture", '{');
    hk_picture_add(data, &p);
    hk_picture_add_vectors(data, "position", position, p.list, p.shown_count);
    hk_text_open(data, "tension", '[');
    for (int64_t k = 0; k < p.spring_count && tension; k++)
      if (p.drawn[k]) hk_text_number(data, NULL, tension[k]);
    hk_text_close(data, ']');
    hk_text_close(data, '}');
  }
  hk_picture_release(&p);
  return status;
}

int32_t hk_modes_page_add(struct hk_text *data, const hooke_measurement *m) {
  return add_picture(data, m->system, ((const struct hk_modes *)m->object)->position, NULL);
}

int32_t hk_rest_page_add(struct hk_text *data, const hooke_measurement *m) {
  const struct hk_resting *r = m->object;
  const int64_t n = 3 * hooke_system_particle_count(m->system);
  double *still = hk_new(n, sizeof *still),
         *tension = hk_new(hooke_system_count(m->system, "springs"), sizeof *tension);
  int32_t status = still && tension ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && r->position == NULL)
    status = hk_fail(HOOKE_BAD_CALL, NULL, "there is nothing to report before the rest was looked for");
  if (status == HOOKE_OK) status = hooke_system_tension(m->system, r->time, r->position, still, tension);
  if (status == HOOKE_OK) status = add_picture(data, m->system, r->position, tension);
  hk_free(still);
  hk_free(tension);
  return status;
}
