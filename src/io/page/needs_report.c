/* The page of needs: its contents as JSON. */
#include "io/page/picture.h"
#include "io/page/report.h"
#include "measure/needs/needs.h"

/* Lists the watched particles, and draws the springs between them. */
static void choose(struct hk_picture *p, const struct hk_needs *needs) {
  for (int64_t k = 0; k < needs->watch_count; k++)
    hk_picture_show(p, needs->watch[k]);
  for (int64_t k = 0; k < p->spring_count; k++)
    p->shut[k] = !p->slot[p->ends[2 * k]] || !p->slot[p->ends[2 * k + 1]];
  hk_picture_take_families(p, HOOKE_PICTURE_SPRINGS);
}

/* The last judged frame that both paths have. */
static int64_t last_frame(const struct hk_needs *needs) {
  int64_t frames = needs->judged;
  if (needs->path.recorded < frames) frames = needs->path.recorded;
  return (needs->lean.path.recorded < frames ? needs->lean.path.recorded : frames) - 1;
}

/* Paths have the watched particles alone, as the picture lists them. */
static void add_picture(struct hk_text *data, const struct hk_needs *needs, struct hk_picture *p) {
  const int64_t frame = last_frame(needs), from = 3 * needs->watch_count * frame;
  choose(p, needs);
  hk_text_open(data, "picture", '{');
  hk_text_number(data, "time", hk_needs_time(needs, frame));
  hk_picture_add(data, p);
  hk_picture_add_vectors(data, "position", needs->path.position + from, NULL, p->shown_count);
  hk_picture_add_vectors(data, "lean", needs->lean.path.position + from, NULL, p->shown_count);
  hk_text_close(data, '}');
}

/* With the watched particles in both systems; without them if there is no lean system. */
int32_t hk_needs_page_add(struct hk_text *data, const hooke_measurement *m) {
  const struct hk_needs *needs = m->object;
  struct hk_picture p;
  hk_text_number(data, "particles", (double)hooke_system_particle_count(m->system));
  if (needs->lean.path.position == NULL) return HOOKE_OK;
  const int32_t status = hk_picture_create(m->system, &p);
  if (status == HOOKE_OK) add_picture(data, needs, &p);
  hk_picture_release(&p);
  return status;
}
