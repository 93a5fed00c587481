/* Trajectories as pages: selection of the contents. */
#include "io/page/view/view.h"

#include "core/memory.h"
#include "core/table/option.h"
#include "core/status.h"
#include "io/trajectory/record.h"
#include "io/page/form.h"
#include "model/vector3.h"

#include <math.h>
#include <stdio.h>

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("frames", HOOKE_OPTION_WHOLE(2, 1e6), NULL,
                 "frames that the page has at most, evenly; as many as its size allows if not given"),
    HOOKE_OPTION("springs", HOOKE_OPTION_WHOLE(1, 1e7), "100000",
                 "springs that the page draws at most: of more, every second, third, ..."),
    HOOKE_OPTION("size", HOOKE_OPTION_UP_TO("MB", 2000), "50",
                 "size of the page at most, of several runs on it of each, which frames are left out for"),
    HOOKE_OPTION("beyond", HOOKE_OPTION_WHOLE(0, 1e9), "30",
                 "frames after the run diverged that are shown at most; of a scene, so many are run"),
    HOOKE_OPTION(
        "watch", .type = HOOKE_OPTION_TEXT, NULL,
        "quantities to draw over the frames below the picture, such as 57.y,line.stretch:0.tension,energy",
        .example = "57.y"),
};
static const struct hk_option_table view_options = {"view", HOOKE_OPTION_ROWS(rows)};

const char *const hk_view_energy[HOOKE_VIEW_ENERGIES] = {"kinetic", "potential", "total"};

/* ---- reading ---- */

static int32_t refuse(const struct hk_view *view, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: %s", hk_record_path(view->record), what);
}

/* The springs of the file, with existing ends. */
static int32_t read_ends(struct hk_view *view, double **ends) {
  view->springs_there = -1;
  int32_t status = hk_view_read(view, "/connectivity/springs", -1, &view->springs_there, 2, ends);
  for (int64_t k = 0; k < 2 * view->springs_there && status == HOOKE_OK; k++) {
    if (!((*ends)[k] >= 0.0) || (*ends)[k] >= (double)view->particles_there)
      status = refuse(view, "dataset /connectivity/springs names a particle that is not there");
  }
  return status;
}

static int32_t read_energies(struct hk_view *view) {
  int32_t status = HOOKE_OK;
  for (int k = 0; k < HOOKE_VIEW_ENERGIES && status == HOOKE_OK; k++) {
    char name[64];
    snprintf(name, sizeof name, "/observables/%s_energy/value", hk_view_energy[k]);
    status = hk_view_read(view, name, -1, &view->frames_there, 1, &view->energy[k]);
  }
  return status;
}

/* Old files without rest lengths get those of their first frame. */
static int32_t read_rest_lengths(struct hk_view *view, const double *ends) {
  int32_t status = hk_view_read(view, "/hooke/rest_length", -1, &view->springs_there, 1, &view->rest_length);
  if (status == HOOKE_OK || status == HOOKE_NO_MEMORY) return status;
  double *q = NULL;
  status = hk_view_read(view, "/particles/all/position/value", 0, &view->particles_there, 3, &q);
  view->rest_length = hk_new(view->springs_there, sizeof(double));
  if (status == HOOKE_OK && view->rest_length == NULL) status = HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < view->springs_there && status == HOOKE_OK; k++) {
    const double *a = q + 3 * (int64_t)ends[2 * k], *b = q + 3 * (int64_t)ends[2 * k + 1];
    view->rest_length[k] = hk_distance3(a, b);
  }
  view->by_first_frame = 1;
  hk_free(q);
  return status;
}

/* ---- selection ---- */

/* Smallest stride that reduces `count` items to at most `most`. */
static int64_t stride_for(int64_t count, int64_t most) {
  return count > most ? 1 + (count - 1) / most : 1;
}

/* Particles in order: the ends of the springs shown, constrained ones, and those without any spring. */
static int32_t choose_particles(struct hk_view *view, const double *ends, const double *species) {
  const int64_t all = view->particles_there, most = (int64_t)hooke_options_number(view->options, "springs");
  char *tied = hk_new(all, 1);
  int64_t *slot = hk_new(all, sizeof *slot), loose = 0;
  view->particle = hk_new(all, sizeof *view->particle);
  view->mark = hk_new(all, 1);
  int32_t status = tied && slot && view->particle && view->mark ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < 2 * view->springs_there && status == HOOKE_OK; k++)
    tied[(int64_t)ends[k]] |= (k / 2 % view->spring_stride == 0) ? 2 : 1;
  for (int64_t k = 0; k < all && status == HOOKE_OK; k++)
    view->loose_there += tied[k] == 0 && species[k] == 0.0;
  view->loose_stride = stride_for(view->loose_there, most);
  for (int64_t k = 0; k < all && status == HOOKE_OK; k++) {
    const int is_loose = tied[k] == 0 && species[k] == 0.0;
    if (species[k] == 0.0 && !(tied[k] & 2) && !(is_loose && loose++ % view->loose_stride == 0)) continue;
    view->mark[view->particles] = species[k] == 1.0   ? HOOKE_VIEW_PINNED
                                  : species[k] == 2.0 ? HOOKE_VIEW_DRIVEN
                                  : is_loose          ? HOOKE_VIEW_LOOSE
                                                      : HOOKE_VIEW_FREE;
    slot[k] = view->particles;
    view->particle[view->particles++] = k;
  }
  for (int64_t k = 0; k < 2 * view->springs && status == HOOKE_OK; k++)
    view->end[k] = slot[(int64_t)ends[2 * (k / 2) * view->spring_stride + k % 2]];
  hk_free(slot);
  hk_free(tied);
  return status;
}

static int32_t choose_springs(struct hk_view *view) {
  const int64_t most = (int64_t)hooke_options_number(view->options, "springs");
  view->spring_stride = stride_for(view->springs_there, most);
  view->springs = (view->springs_there + view->spring_stride - 1) / view->spring_stride;
  view->end = hk_new(2 * view->springs, sizeof *view->end);
  return view->end ? HOOKE_OK : HOOKE_NO_MEMORY;
}

/* Size of the page without its frames, including words. */
static int32_t measure_page(const struct hk_view *view, double *bytes) {
  struct hk_text text = {.bytes = NULL};
  const int32_t status = hk_form_fill("view.html", NULL, NULL, &text);
  *bytes = (double)(text.length + hk_base64_length(16 * view->springs + view->particles)) + 20e3;
  hk_text_release(&text);
  return status;
}

/* Frames of which some are shown: those before the run diverged, and so many after that; at least one. */
static int64_t frames_open(const struct hk_view *view) {
  const double most = (double)view->good_frames + hooke_options_number(view->options, "beyond");
  return most < (double)view->frames_there ? (int64_t)fmax(most, 1.0) : view->frames_there;
}

/* All frames, or as few as the option says and the size allows: every k-th and the last. */
static int32_t choose_frames(struct hk_view *view) {
  enum { NUMBERS_OF_FRAME = 300, NUMBER = 25 }; /* bytes, as text */
  double fixed;
  const int32_t status = measure_page(view, &fixed);
  if (status != HOOKE_OK) return status;
  const double size = 1e6 * hooke_options_number(view->options, "size");
  const double each =
      (double)(hk_base64_length(hk_view_frame_bytes(view)) + NUMBERS_OF_FRAME + NUMBER * view->watched.count);
  const int64_t open = frames_open(view), gaps = open - 1, least = open < 2 ? 1 : 2;
  double most = floor((size - fixed) / each);
  if (most < (double)least) {
    return hk_fail(
        HOOKE_BAD_VALUE, "size",
        "%g MB are too few for this trajectory: its page takes %.3g MB and %.3g MB for each frame; allow "
        "%.3g MB or more, or draw fewer springs",
        size / 1e6, fixed / 1e6, each / 1e6, ceil((fixed + (double)least * each) / 1e5) / 10.0);
  }
  if (hooke_options_is_set(view->options, "frames"))
    most = fmin(most, hooke_options_number(view->options, "frames"));
  view->frame_stride = most > (double)gaps ? 1 : stride_for(gaps, (int64_t)most - 1);
  view->frames = 1 + (gaps + view->frame_stride - 1) / view->frame_stride;
  view->frame = hk_new(view->frames, sizeof *view->frame);
  for (int64_t k = 0; k < view->frames && view->frame; k++)
    view->frame[k] = k * view->frame_stride < gaps ? k * view->frame_stride : gaps;
  return view->frame ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static int32_t choose(struct hk_view *view) {
  double *ends = NULL, *species = NULL;
  view->particles_there = -1;
  view->frames_there = hooke_record_count(view->record, "frames");
  view->good_frames = hooke_record_count(view->record, "good_frames");
  int32_t status = hk_view_read(view, "/particles/all/species", -1, &view->particles_there, 1, &species);
  if (status == HOOKE_OK) status = read_ends(view, &ends);
  if (status == HOOKE_OK) status = read_energies(view);
  if (status == HOOKE_OK) status = read_rest_lengths(view, ends);
  if (status == HOOKE_OK) status = choose_springs(view);
  if (status == HOOKE_OK) status = choose_particles(view, ends, species);
  if (status == HOOKE_OK) status = choose_frames(view);
  hk_free(species);
  hk_free(ends);
  return status;
}

/* ---- a view ---- */

static double time_of(const struct hk_view *view, int64_t frame) {
  const double time = view->record->time[frame];
  return isfinite(time) ? time : (double)NAN;
}

HOOKE_READER(double, time_first, struct hk_view, time_of(it, 0))
HOOKE_READER(double, time_last, struct hk_view, time_of(it, it->frame[it->frames - 1]))

HOOKE_COUNTER(count_watched, struct hk_view, it->watched.count)
HOOKE_COUNTER(shown, struct hk_view, it->frames)
HOOKE_READER(const char *, unit, struct hk_view, hk_watched_unit(&it->watched.item[row]))
HOOKE_READER(const double *, value, struct hk_view, hk_watched_series_of(&it->course, row))

static const struct hk_table tables[] = {
    {.name = "watched",
     .doc = "the watched quantities",
     .count = count_watched,
     HOOKE_TABLE_AT(struct hk_view, watched.item),
     .length = shown,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_AS(struct hk_watched, text, quantity, TEXT, "", "quantity, as it was written"),
         HOOKE_COLUMN_BY(unit, TEXT, "", "its unit"),
         HOOKE_COLUMN_BY(value, SERIES, "of the quantity", "its values at the frames shown"))},
    {.name = "view",
     .doc = "what the page shows of the trajectory",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_view, bytes, COUNT, "", "length of the page, once it is written"),
         HOOKE_COLUMN(struct hk_view, frames, COUNT, "", "frames shown"),
         HOOKE_COLUMN(struct hk_view, frames_there, COUNT, "", "frames of the trajectory"),
         HOOKE_COLUMN(struct hk_view, frame_stride, COUNT, "", "k, where every k-th frame is shown"),
         HOOKE_COLUMN(struct hk_view, springs, COUNT, "", "springs shown"),
         HOOKE_COLUMN(struct hk_view, springs_there, COUNT, "", "springs of the trajectory"),
         HOOKE_COLUMN(struct hk_view, spring_stride, COUNT, "", "k, where every k-th spring is shown"),
         HOOKE_COLUMN(struct hk_view, particles, COUNT, "", "particles shown"),
         HOOKE_COLUMN(struct hk_view, particles_there, COUNT, "", "particles of the trajectory"),
         HOOKE_COLUMN(struct hk_view, damaged, COUNT, "", "damaged frames, which are skipped"),
         HOOKE_COLUMN_BY(time_first, NUMBER, "s", "time of the first frame"),
         HOOKE_COLUMN_BY(time_last, NUMBER, "s", "time of the last frame shown"),
         HOOKE_COLUMN(struct hk_view, strain, NUMBER, "", "strain at the ends of the scale of colours"),
         HOOKE_COLUMN(struct hk_view, strain_low, NUMBER, "", "lowest strain"),
         HOOKE_COLUMN(struct hk_view, strain_high, NUMBER, "", "highest strain"))},
    {.name = NULL}};

static int32_t check_built(void) {
  if (hooke_build_fact("threejs")[0] && hooke_build_fact("chartjs")[0]) return HOOKE_OK;
  return hk_fail(
      HOOKE_NOT_BUILT, NULL,
      "pages that play a trajectory need three.js and Chart.js (on Debian: apt-get install libjs-three "
      "libjs-chart.js, then configure again), and this build of the library is without");
}

static int32_t check_record(const struct hk_view *view) {
  if (!view->record->is_run) {
    return refuse(view,
                  "holds several runs, and a view shows one; write the one to look at with 'hooke run -o'");
  }
  return hooke_record_count(view->record, "frames") > 0 ? HOOKE_OK : refuse(view, "has no frames yet");
}

/* Everything is selected here, so that a page too large is refused at once. */
static int32_t create(hooke_measurement *m) {
  struct hk_view *view = m->object;
  view->options = m->options;
  view->bytes = NAN;
  int32_t status = check_record(view);
  if (status == HOOKE_OK) status = hk_view_watch(view);
  if (status == HOOKE_OK) status = choose(view);
  if (status == HOOKE_OK) status = hk_view_find_strain(view);
  if (status == HOOKE_OK) status = hk_view_find_watched(view);
  m->has_run = status == HOOKE_OK;
  return status;
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  return state ? hk_measurement_require_fresh(m, state) : HOOKE_OK;
}

static void destroy(void *object) {
  struct hk_view *view = object;
  if (view == NULL) return;
  hk_free(view->rest_length);
  hk_free(view->end);
  hk_free(view->particle);
  hk_free(view->mark);
  hk_free(view->frame);
  hk_free(view->box);
  hk_watched_series_release(&view->course);
  hk_watched_release(&view->watched);
  hooke_scene_destroy(view->scene);
  for (int k = 0; k < HOOKE_VIEW_ENERGIES; k++)
    hk_free(view->energy[k]);
  hk_free(view);
}

int32_t hooke_view_create(const hooke_record *record, const hooke_options *options, hooke_measurement **out) {
  *out = NULL;
  const int32_t status = check_built();
  if (status != HOOKE_OK) return status;
  struct hk_view *view = hk_new(1, sizeof *view);
  if (view == NULL) return HOOKE_NO_MEMORY;
  view->record = record;
  return hk_measurement_create(&hk_view_kind, view, NULL, NULL, options, out);
}

const struct hk_measurement_kind hk_view_kind = {.name = "view",
                                                 .options = &view_options,
                                                 .made_by = "hooke_view_create()",
                                                 .tables = tables,
                                                 .create = create,
                                                 .run = run,
                                                 .write = hk_view_write,
                                                 .destroy = destroy};
