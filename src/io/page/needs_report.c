/* The page of needs: its contents as JSON. */
#include "core/memory.h"
#include "io/page/picture.h"
#include "io/page/report.h"
#include "measure/needs/needs.h"

/* Marks the watched particles. NULL: no memory. */
static char *find_watched(const struct hk_needs *needs) {
  char *watched = hk_new(hooke_system_particle_count(needs->system), 1);
  for (int64_t k = 0; k < needs->watch_count && watched; k++)
    watched[needs->watch[k]] = 1;
  return watched;
}

/* ---- springs ---- */

/* Returns the number of springs between watched particles. */
static int64_t choose(struct hk_picture *p, const char *watched) {
  int64_t open = 0;
  for (int64_t k = 0; k < p->spring_count; k++) {
    p->shut[k] = !watched[p->ends[2 * k]] || !watched[p->ends[2 * k + 1]];
    open += !p->shut[k];
  }
  hk_picture_take_families(p, HOOKE_PICTURE_SPRINGS);
  return open;
}

/* ---- positions ---- */

/* Positions at a frame of a path, as rows of all particles of the system; those not watched stay zero. */
static double *spread(const struct hk_needs *needs, const struct hk_needs_path *path, int64_t frame) {
  double *q = hk_new(3 * hooke_system_particle_count(needs->system), sizeof *q);
  for (int64_t k = 0; k < 3 * needs->watch_count && q; k++)
    q[3 * needs->watch[k / 3] + k % 3] = path->position[3 * needs->watch_count * frame + k];
  return q;
}

static int32_t add_positions(struct hk_text *data, const struct hk_needs *needs, const struct hk_picture *p,
                             int64_t frame) {
  int64_t *list = hk_picture_list(p);
  double *full = spread(needs, &needs->path, frame), *lean = spread(needs, &needs->lean.path, frame);
  const int32_t ready = list && full && lean;
  if (ready) {
    const double scale = hk_picture_scale(full, list, p->shown_count);
    hk_picture_add_particles(data, p, list);
    hk_picture_add_vectors(data, "position", full, list, p->shown_count, scale);
    hk_picture_add_vectors(data, "lean", lean, list, p->shown_count, scale);
  }
  hk_free(list);
  hk_free(full);
  hk_free(lean);
  return ready ? HOOKE_OK : HOOKE_NO_MEMORY;
}

/* ---- whole ---- */

/* The last judged frame that both paths have. */
static int64_t last_frame(const struct hk_needs *needs) {
  int64_t frames = needs->judged;
  if (needs->path.recorded < frames) frames = needs->path.recorded;
  return (needs->lean.path.recorded < frames ? needs->lean.path.recorded : frames) - 1;
}

static int32_t add_drawn(struct hk_text *data, const struct hk_needs *needs, struct hk_picture *p,
                         const char *watched) {
  const int64_t frame = last_frame(needs), springs = choose(p, watched);
  hk_text_open(data, "picture", '{');
  hk_text_number(data, "time", hk_needs_time(needs, frame));
  hk_text_number(data, "springs", (double)springs);
  hk_picture_add_springs(data, p);
  for (int64_t k = 0; k < needs->watch_count; k++) {
    if (p->drawn_count == 0) hk_picture_show(p, needs->watch[k]);
  }
  const int32_t status = add_positions(data, needs, p, frame);
  hk_text_close(data, '}');
  return status;
}

/* The watched particles in both systems, and the springs between them; nothing without a lean system. */
static void add_picture(struct hk_text *data, const struct hk_needs *needs) {
  struct hk_picture p;
  if (needs->lean.path.position == NULL) return;
  int32_t status = hk_picture_create(needs->system, &p);
  char *watched = find_watched(needs);
  if (status == HOOKE_OK) status = watched ? add_drawn(data, needs, &p, watched) : HOOKE_NO_MEMORY;
  if (status != HOOKE_OK && data->status == HOOKE_OK) data->status = status;
  hk_picture_release(&p);
  hk_free(watched);
}

void hk_needs_page_add(struct hk_text *data, const hooke_measurement *m) {
  hk_text_number(data, "particles", (double)hooke_system_particle_count(m->system));
  add_picture(data, m->object);
}
