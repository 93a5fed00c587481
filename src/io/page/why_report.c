/* The page of an explanation, with the steps around the trouble. */
#include "core/memory.h"
#include "core/status.h"
#include "core/table/option.h"
#include "io/page/picture.h"
#include "io/page/report.h"
#include "io/page/view/view.h"
#include "measure/limit/limit.h"
#include "measure/spectrum/mode_growth.h"
#include "measure/why/why.h"
#include "model/state.h"

#include <math.h>
#include <string.h>

/* Steps before and after the trouble whose energy is told, and frames to play. */
enum { ENERGY_BEFORE = 1000, ENERGY_AFTER = 60, BEFORE = 48, AFTER = 40, LEAST_AFTER = 10, LOOKS = 24 };
/* Particles and springs times steps that the energies, and the advised run, may take. */
static const double ENERGY_WORK = 3e8, ADVISED_WORK = 2e9;
/* Frames end when the scene is so much wider than at first; the mode grows about so much before the trouble.
 * */
static const double WIDEST = 1e5, GROWN = 1e4;
/* Counted work at eigenvalues [s], of so many particles. */
static const double LOOK_WORK = 3.0, MOST_LOOKED_AT = 2e4;

struct frames {
  struct hk_text *data;
  const struct hk_why *why;
  const hooke_system *system;
  double h, t0;
  int64_t last; /* step within all bounds */
  struct hk_picture picture;
  double extent; /* of the first frame */
  int64_t shown, after;

  double energy[ENERGY_BEFORE + ENERGY_AFTER + 1];
  int64_t energies, first_energy;

  hooke_measurement *limit;
  struct hk_budget budget;
  struct hk_text limits, mode; /* JSON, beside the frames: limits along the way, and the mode to draw */
  int32_t looks;
};

/* ---- energies ---- */

/* Kinetic and of springs: never negative, unlike that of gravity and of loads. [J] */
static double energy_of(const hooke_system *system, const hooke_state *state) {
  const struct hk_energies at = hk_state_energies(state, system);
  return at.kinetic + at.elastic;
}

static int32_t see_energy(int64_t k, const hooke_state *state, void *ctx) {
  struct frames *f = ctx;
  f->energy[k] = energy_of(f->system, state);
  f->energies = k + 1;
  return 0;
}

static double time_of(const struct frames *f, int64_t step) {
  return f->t0 + (double)step * f->h;
}

static double work_of(const hooke_system *system) {
  return (double)(hooke_system_particle_count(system) + hooke_system_count(system, "springs") + 1);
}

static int32_t find_energies(struct frames *f, const hooke_options *run) {
  double time[ENERGY_BEFORE + ENERGY_AFTER + 1];
  const int64_t fit = (int64_t)(ENERGY_WORK / work_of(f->system)),
                back = fit < ENERGY_BEFORE ? fit : ENERGY_BEFORE;
  const int64_t begun = f->why->start.standing.k;
  f->first_energy = f->last - back > begun ? f->last - back : begun;
  const int64_t count = f->last - f->first_energy + ENERGY_AFTER + 1;
  for (int64_t k = 0; k < count; k++)
    time[k] = time_of(f, f->first_energy + k);
  return hk_why_walk(f->system, &f->why->start, run, count, time, see_energy, f);
}

static void add_energies(struct frames *f) {
  hk_text_open(f->data, "energy", '{');
  hk_text_number(f->data, "last", (double)(f->last - f->first_energy));
  hk_text_numbers(f->data, "value", f->energies, f->energy);
  hk_text_close(f->data, '}');
}

/* Steps between frames, so that those before the trouble show the mode from small on. */
static int64_t stride_of(const struct frames *f) {
  const int64_t end = f->last - f->first_energy, back = end < 50 ? end : 50;
  const double rise = back > 0 && end < f->energies ? log(f->energy[end] / f->energy[end - back]) : NAN;
  const double steps = 2.0 * log(GROWN) * (double)back / rise / BEFORE;
  const double most = 1.0 + (double)end / BEFORE;
  return isfinite(steps) && steps > 1.0 ? (int64_t)ceil(fmin(steps, most)) : 1;
}

/* ---- limits along the way ---- */

static int32_t begin_limits(struct frames *f, const hooke_options *run) {
  hooke_options *options = NULL;
  if ((double)hooke_system_particle_count(f->system) > MOST_LOOKED_AT) return HOOKE_OK;
  int32_t status = hk_options_create(hk_limit_kind.options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "methods", f->why->method);
  if (status == HOOKE_OK)
    status = hk_measurement_create(&hk_limit_kind, NULL, f->system, run, options, &f->limit);
  hooke_options_destroy(options);
  f->budget = hk_budget_of_work(LOOK_WORK, NULL, NULL);
  return status;
}

struct mode {
  double frequency, decay, growth; /* growth: in a step */
};

static int32_t find_mode(const struct frames *f, const struct hk_limit *limit, const struct hk_limit_row *row,
                         struct mode *found) {
  const struct hk_stability *stability = hk_method_stability_in(row->method, f->system);
  struct hk_growing g;
  struct hk_rigid rigid;
  int32_t status = hk_rigid_create(f->system, limit->q, NULL, &rigid);
  if (status != HOOKE_OK) return status;
  /* modes have the length 1 by masses */
  const double *const mode[3] = {row->mode, row->mode + 1, row->mode + 2};
  const double geometric = hk_rigid_energy(&rigid, mode, 3);
  hk_rigid_release(&rigid);
  status = hk_growing_create(f->system, row->mode, NULL, &g);
  if (status != HOOKE_OK) return status;
  const double stiffness = fmax(0.0, hk_growing_quotient(&g, limit->q, 1.0, 0.0) + geometric);
  *found = (struct mode){0.0, stiffness, hk_eigenvalue_growth(stability, f->h, -stiffness, 0.0)};
  if (!f->system->overdamped) {
    found->frequency = sqrt(stiffness);
    found->decay = 0.5 * hk_growing_quotient(&g, limit->q, 0.0, 1.0);
    found->growth = hk_mode_growth(stability, f->h, found->frequency, found->decay);
  }
  hk_growing_release(&g);
  return HOOKE_OK;
}

static void add_listed(struct hk_text *data, const char *key, const double *vectors,
                       const struct hk_picture *picture) {
  hk_picture_add_vectors(data, key, vectors, picture->list, picture->shown_count);
}

/* The mode that grows, at the positions where it was found: the first above the limit, or else the last. */
static void add_mode(struct frames *f, const struct hk_limit *limit, double growth) {
  hk_text_number(&f->mode, "time", limit->time);
  hk_text_number(&f->mode, "growth", growth);
  add_listed(&f->mode, "position", limit->q, &f->picture);
  add_listed(&f->mode, "move", limit->shape, &f->picture);
}

static int32_t look(struct frames *f, const hooke_state *state, int64_t step) {
  if (f->limit == NULL || f->looks > LOOKS) return HOOKE_OK;
  if (step != f->last && hk_budget_ends(&f->budget, NULL)) return HOOKE_OK;
  struct hk_limit *limit = f->limit->object;
  limit->budget = step == f->last ? &limit->endless : &f->budget;
  const double *q = hooke_state_position((hooke_state *)state);
  int32_t status = hk_limit_look(limit, q, state->v, hooke_state_time(state));
  if (status != HOOKE_OK)
    return status == HOOKE_NO_MEMORY ? status : HOOKE_OK; /* then it is not known there */
  const struct hk_limit_row *row = hk_limit_limiting_row(limit);
  struct mode mode = {NAN, NAN, NAN};
  if (row) status = find_mode(f, limit, row, &mode);
  if (status != HOOKE_OK) return status;
  f->looks++;
  hk_text_open(&f->limits, NULL, '{');
  hk_text_number(&f->limits, "time", hooke_state_time(state));
  if (isinf(limit->row[0].predicted))
    hk_text_word(&f->limits, "limit", "none");
  else
    hk_text_number(&f->limits, "limit", limit->row[0].predicted);
  hk_text_number(&f->limits, "frequency", mode.frequency);
  hk_text_number(&f->limits, "decay", mode.decay);
  hk_text_number(&f->limits, "growth", mode.growth);
  hk_text_close(&f->limits, '}');
  if (row && f->mode.length == 0 && (row->predicted < f->h || step == f->last))
    add_mode(f, limit, mode.growth);
  return f->limits.status != HOOKE_OK ? f->limits.status : f->mode.status;
}

/* ---- frames ---- */

static int32_t add_picture(struct frames *f) {
  int32_t status = hk_picture_create(f->system, &f->picture);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < f->why->limiting.count; k++) {
    if (f->why->limiting.row[k].spring >= 0) hk_picture_take(&f->picture, f->why->limiting.row[k].spring);
  }
  if (!hk_picture_take_families(&f->picture, HOOKE_FILM_SPRINGS)) hk_picture_show_evenly(&f->picture);
  hk_text_open(f->data, "picture", '{');
  hk_picture_add(f->data, &f->picture);
  hk_view_add_bodies(f->data, f->system);
  hk_text_close(f->data, '}');
  return HOOKE_OK;
}

static void add_frame(struct frames *f, const hooke_state *state) {
  const double *q = hooke_state_position((hooke_state *)state);
  hk_text_open(f->data, NULL, '{');
  hk_text_number(f->data, "time", hooke_state_time(state));
  hk_text_number(f->data, "energy", energy_of(f->system, state));
  add_listed(f->data, "position", q, &f->picture);
  hk_text_close(f->data, '}');
}

/* One of the run as it was: its number tells the step. */
static int32_t see_frame(int64_t k, const hooke_state *state, void *ctx) {
  struct frames *f = ctx;
  const int64_t step = llround((hooke_state_time(state) - f->t0) / f->h);
  const double extent =
      hk_picture_extent(hooke_state_position((hooke_state *)state), f->picture.list, f->picture.shown_count);
  if (k == 0) f->extent = extent;
  f->after += step > f->last;
  if (f->after > LEAST_AFTER && f->extent > 0.0 && extent > WIDEST * f->extent) return 1;
  add_frame(f, state);
  f->shown++;
  return step <= f->last && (k % 2 == 0 || step == f->last) ? look(f, state, step) : HOOKE_OK;
}

static int32_t see_advised(int64_t k, const hooke_state *state, void *ctx) {
  (void)k;
  add_frame(ctx, state);
  return 0;
}

/* ---- the advised run ---- */

static int32_t is_within_reach(const struct frames *f, const hooke_options *run, double until) {
  const double steps = (until - f->why->start.standing.t) / hooke_options_number(run, "step");
  return !hooke_method_is_adaptive(hooke_options_text(run, "method")) &&
         steps * work_of(f->system) < ADVISED_WORK;
}

/* The first advice that is another run with a fixed step, within the work; `advised` is NULL where there is
 * none. */
static int32_t find_advice(const struct frames *f, const hooke_options *run, double until,
                           hooke_options **advised) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < f->why->advice_count && *advised == NULL && status == HOOKE_OK; k++) {
    const struct hk_why_advice *advice = &f->why->advice[k];
    if (advice->run == NULL || strcmp(advice->option, "duration") == 0) continue;
    status = hooke_options_copy(run, advised);
    if (status == HOOKE_OK) status = hk_options_set_from(*advised, advice->run);
    if (status == HOOKE_OK && is_within_reach(f, *advised, until)) break;
    hooke_options_destroy(*advised);
    *advised = NULL;
  }
  return status;
}

static int32_t add_advised(struct frames *f, const hooke_options *run, const double *time) {
  hooke_options *advised = NULL;
  int32_t status = f->shown > 0 ? find_advice(f, run, time[f->shown - 1], &advised) : HOOKE_OK;
  hk_text_open(f->data, "advised", '{');
  if (advised) {
    hk_text_word(f->data, "method", hooke_options_text(advised, "method"));
    hk_text_number(f->data, "step", hooke_options_number(advised, "step"));
    hk_text_open(f->data, "frames", '[');
    status = hk_why_walk(f->system, &f->why->start, advised, f->shown, time, see_advised, f);
    hk_text_close(f->data, ']');
  }
  hk_text_close(f->data, '}');
  hooke_options_destroy(advised);
  return status;
}

/* ---- all of it ---- */

static int32_t add(struct frames *f, const hooke_options *run) {
  double time[BEFORE + AFTER + 1];
  int32_t status = find_energies(f, run);
  if (status != HOOKE_OK) return status;
  add_energies(f);
  const int64_t stride = stride_of(f), back = (f->last - f->first_energy) / stride;
  const int64_t before = back < BEFORE ? back : BEFORE;
  for (int64_t k = 0; k <= before + AFTER; k++)
    time[k] = time_of(f, f->last + (k - before) * stride);
  hk_text_number(f->data, "stride", (double)stride);
  hk_text_number(f->data, "last", (double)before);
  status = add_picture(f);
  if (status == HOOKE_OK) status = begin_limits(f, run);
  if (status != HOOKE_OK) return status;
  hk_text_open(f->data, "frames", '[');
  status = hk_why_walk(f->system, &f->why->start, run, before + AFTER + 1, time, see_frame, f);
  hk_text_close(f->data, ']');
  if (status == HOOKE_OK) status = add_advised(f, run, time);
  hk_text_open(f->data, "limits", '[');
  if (f->limits.length > 0) hk_text_add(f->data, f->limits.bytes, f->limits.length);
  hk_text_close(f->data, ']');
  if (f->mode.length == 0) return status;
  hk_text_open(f->data, "mode", '{');
  hk_text_add(f->data, f->mode.bytes, f->mode.length);
  hk_text_close(f->data, '}');
  return status;
}

/* Adds, where steps can be taken again, "energy" (of every step around the trouble), "picture" (springs, and
 * the mode that grows), "frames" (steps to play), "advised" (the same by the first advice with a fixed step)
 * and "limits" (of the method, along the way). */
static int32_t add_frames(struct hk_text *data, const struct hk_why *why, const hooke_options *run) {
  struct frames *f = hk_new(1, sizeof *f);
  if (f == NULL) return HOOKE_NO_MEMORY;
  *f = (struct frames){
      .data = data, .why = why, .h = why->step, .t0 = why->start.standing.t0, .system = why->system};
  f->last = llround((why->time - f->t0) / f->h);
  const int32_t status = add(f, run);
  hk_picture_release(&f->picture);
  hk_text_release(&f->limits);
  hk_text_release(&f->mode);
  hooke_measurement_destroy(f->limit);
  hk_free(f);
  return status;
}

int32_t hk_why_page_add(struct hk_text *data, const hooke_measurement *m) {
  const struct hk_why *why = m->object;
  if (why->cause == NULL)
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is nothing to report: no explanation was found");
  hk_text_open(data, "rows", '[');
  hk_text_open(data, NULL, '{');
  hk_text_word(data, "method", why->method);
  hk_limit_page_add_reach(data, why->system, why->method);
  hk_text_close(data, '}');
  hk_text_close(data, ']');
  return why->start.state && !isnan(why->step) ? add_frames(data, why, m->run) : HOOKE_OK;
}
