/* Growth of small displacements of the start: the largest singular value of the map from positions and
 * velocities at the start, velocities times the duration, to positions at any frame. A small scene is
 * displaced in every coordinate, and the singular values are those of the differences. For larger scenes
 * random displacements bound them (Halko, Martinsson and Tropp 2011, lemma 4.1): of k of them, whose
 * components are normal, 10 sqrt(2/pi) times the largest displacement seen is above with probability 1 -
 * 10^-k. */
#include "measure/trial/reference_run.h"

#include "core/memory.h"
#include "core/random.h"
#include "kernel/vector_loops.h"
#include "model/coordinates/coordinates.h"

#include <math.h>
#include <stddef.h>

enum { RANDOM = 3, FEWEST = 2 };     /* random displacements, and of those in a bound */
enum { MOST_COORDINATES = 36 };      /* maximum number of coordinates displaced one by one */
static const int64_t ROOM = 1000000; /* maximum numbers stored for that */
static const double COORDINATES_WORK = 0.5,
                    COORDINATES_SHARE = 1.0; /* least work [s], and as a multiple of the reference's */
static const uint64_t SEED = 1;
static const double BOUND = 7.978845608028654; /* 10 sqrt(2/pi) */
static const double DISPLACEMENT = 1e-7;       /* displacement of a component, as a fraction of the extent */
static const double SATURATED = 0.02;  /* of the extent: larger displacements are not small any more */
static const double TOLERANCE = 1e-10; /* of the runs, unless the reference's is looser and sufficient */
static const double DROWNED = 1e-2;    /* limit of agreement over displacement */
static const double TIGHTER = 2.0;     /* maximum time of such a run, as a multiple of the reference's */
enum { MOST_TURNS = 200 };             /* of the iteration for a singular value */

/* A displacement of the start, and its result. */
struct displacement {
  const struct hk_reference *base;
  int64_t coordinate; /* displaced coordinate, positions before velocities; -1: all, at random */
  uint64_t random;
  double length;   /* standard deviation of a component [m] */
  double duration; /* that of a velocity is `length` over it [s] */
  double square;   /* sum of the squares of all components over that of `length` */
  double *kept;    /* free coordinates at frames, minus those of `base`, over `length`; NULL: not stored */
};

static void displace(hooke_state *state, void *ctx) {
  struct displacement *d = ((struct hk_reference_watch *)ctx)->displacement;
  const struct hk_frames *frames = &d->base->frames;
  const int64_t w = frames->width, size = w * frames->free_count;
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  d->square = 0.0;
  for (int64_t k = 0; k < size; k++) {
    const int64_t i = w * frames->free_place[k / w] + k % w;
    const int all = d->coordinate < 0;
    const double x = all ? hk_random_normal(&d->random) : (double)(k == d->coordinate);
    const double y = all ? hk_random_normal(&d->random) : (double)(k + size == d->coordinate);
    q[i] += d->length * x;
    v[i] += d->length / d->duration * y;
    d->square += x * x + y * y;
  }
  hk_movers_renew(frames->system, q, v); /* the map from there is part of the one that is measured */
}

static int32_t keep_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  const struct displacement *d = ((struct hk_reference_watch *)ctx)->displacement;
  const struct hk_frames *frames = &d->base->frames;
  const int64_t w = frames->width, size = w * frames->free_count;
  (void)step;
  if (d->kept == NULL || frame >= frames->recorded) return 0;
  for (int64_t k = 0; k < size; k++) {
    const int64_t i = w * frames->free_place[k / w] + k % w;
    d->kept[frame * size + k] =
        (hooke_state_position(state)[i] - frames->position[frame * frames->size + i]) / d->length;
  }
  return 0;
}

/* One run; `seen` is the largest displacement over the frames, in units of `length`, or NaN if time was too
 * short. */
static int32_t run_displaced(struct hk_reference_watch *watch, struct hk_reference *r, struct displacement *d,
                             double deadline, struct hk_trial *trial, double *seen) {
  const struct hk_reference *base = d->base;
  struct hk_listener listener = hk_reference_listen(watch, deadline);
  listener.on_start = displace;
  listener.on_frame = keep_frame;
  watch->displacement = d;
  /* rk4 in other steps would have another error, which is no growth */
  const double rtol = hk_reference_is_halved(base) ? base->rtol : fmax(base->rtol, TOLERANCE);
  const int32_t status = hk_reference_judge(watch, base, base->method, rtol, &listener, trial);
  watch->displacement = NULL;
  *seen = NAN;
  if (status != HOOKE_OK || watch->expired) return status;
  *seen = trial->error * sqrt((double)base->frames.free_count) / d->length;
  r->growth_seen = fmax(r->growth_seen, *seen / sqrt(d->square));
  r->growth_saturated |= trial->error > SATURATED * r->extent;
  r->displacements++;
  return HOOKE_OK;
}

/* ---- random displacements ---- */

static int32_t displace_at_random(struct hk_reference_watch *watch, struct hk_reference *r,
                                  struct displacement *d, double deadline, struct hk_trial *trial) {
  double most = 0.0;
  d->coordinate = -1;
  for (int k = 0; k < RANDOM; k++) {
    double seen;
    watch->ahead = RANDOM - 1 - k;
    const int32_t status = run_displaced(watch, r, d, deadline, trial, &seen);
    if (status != HOOKE_OK) return status;
    if (isnan(seen)) break;
    most = fmax(most, seen);
  }
  if (r->displacements < FEWEST || r->growth_saturated) return HOOKE_OK;
  r->growth = BOUND * most;
  r->growth_probability = 1.0 - pow(10.0, -r->displacements);
  return HOOKE_OK;
}

/* ---- every coordinate ---- */

/* x = A^T A x for the columns of A, `rows` numbers each, `stride` apart. */
static void apply(int64_t rows, int64_t columns, int64_t stride, const double *column,
                  double x[MOST_COORDINATES]) {
  double y[MOST_COORDINATES / 2] = {0.0};
  for (int64_t j = 0; j < columns; j++)
    hk_add_multiple(rows, x[j], column + j * stride, y);
  for (int64_t j = 0; j < columns; j++)
    x[j] = hk_dot(rows, column + j * stride, y);
}

/* The largest singular value, by power iteration from x, which becomes its vector. */
static double singular_value(int64_t rows, int64_t columns, int64_t stride, const double *column,
                             double x[MOST_COORDINATES]) {
  double value = 0.0;
  for (int turn = 0; turn < MOST_TURNS; turn++) {
    const double length = sqrt(hk_dot(columns, x, x)), before = value;
    if (!(length > 0.0)) return 0.0;
    for (int64_t j = 0; j < columns; j++)
      x[j] /= length;
    apply(rows, columns, stride, column, x);
    value = sqrt(sqrt(hk_dot(columns, x, x)));
    if (fabs(value - before) <= 1e-6 * value) break;
  }
  return value;
}

static double largest_singular_value(const struct hk_frames *frames, const double *kept) {
  const int64_t rows = frames->width * frames->free_count, columns = 2 * rows,
                stride = frames->recorded * rows;
  uint64_t random = SEED;
  double largest = 0.0;
  for (int64_t f = 0; f < frames->recorded; f++) {
    double x[MOST_COORDINATES];
    for (int64_t j = 0; j < columns; j++)
      x[j] = hk_random_normal(&random);
    largest = fmax(largest, singular_value(rows, columns, stride, kept + f * rows, x));
  }
  return largest;
}

static int32_t displace_all(struct hk_reference_watch *watch, struct hk_reference *r, struct displacement *d,
                            double deadline, struct hk_trial *trial) {
  const struct hk_frames *frames = &d->base->frames;
  const int64_t columns = 2 * frames->width * frames->free_count, stride = frames->recorded * columns / 2;
  double *kept = hk_new(columns * stride, sizeof *kept);
  int32_t status = kept ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (d->coordinate = 0; d->coordinate < columns && status == HOOKE_OK; d->coordinate++) {
    double seen;
    d->kept = kept + d->coordinate * stride;
    watch->ahead = (double)(columns - 1 - d->coordinate);
    status = run_displaced(watch, r, d, deadline, trial, &seen);
    if (isnan(seen)) break;
  }
  if (status == HOOKE_OK && r->displacements == columns && !r->growth_saturated) {
    r->growth = largest_singular_value(frames, kept);
    r->growth_probability = 1.0;
  }
  hk_free(kept);
  return status;
}

/* ---- choice between the two ---- */

static int takes_all(const struct hk_reference_watch *watch, const struct hk_reference *base,
                     double deadline) {
  const int64_t columns = 2 * base->frames.width * base->frames.free_count;
  if (columns > MOST_COORDINATES || columns * columns / 2 * base->frames.recorded > ROOM) return 0;
  const double left = deadline - hk_reference_now(watch), work = (double)columns * base->run_work;
  return work <= fmin(0.5 * left, fmax(COORDINATES_WORK, COORDINATES_SHARE * watch->work));
}

static int32_t displace_and_run(struct hk_reference_watch *watch, struct hk_reference *r,
                                const struct hk_reference *base, double deadline, struct hk_trial *trial) {
  struct displacement d = {.base = base,
                           .random = SEED,
                           .length = DISPLACEMENT * r->extent,
                           .duration = hooke_options_number(watch->request->run, "duration")};
  return takes_all(watch, base, deadline) ? displace_all(watch, r, &d, deadline, trial)
                                          : displace_at_random(watch, r, &d, deadline, trial);
}

int32_t hk_reference_measure_growth(struct hk_reference_watch *watch, struct hk_reference *r,
                                    struct hk_trial *trial) {
  const double deadline = watch->start + watch->request->budget;
  const double rounding = r->frames.rounding[r->frames.recorded - 1];
  if (r->frames.free_count == 0 || rounding > DISPLACEMENT * r->extent) return HOOKE_OK;
  if (r->agreement <= DROWNED * DISPLACEMENT * r->extent)
    return displace_and_run(watch, r, r, deadline, trial);
  struct hk_reference base = *r;
  if (r->rtol <= TOLERANCE * (1.0 + 1e-9) &&
      r->frames.recorded == r->frames.count) { /* it is as tight already */
    base.extent = r->run_extent;
    return displace_and_run(watch, r, &base, deadline, trial);
  }
  if (hk_reference_now(watch) + 2.0 * TIGHTER * r->run_work > deadline) return HOOKE_OK;
  struct hk_run_cost cost;
  base.rtol = fmin(r->rtol, TOLERANCE);
  watch->ahead = RANDOM;
  int32_t status = hk_frames_create(r->frames.system, r->frames.count, &base.frames);
  if (status == HOOKE_OK) status = hk_reference_make_frames(watch, &base, deadline, &cost);
  if (status == HOOKE_OK && base.frames.recorded > 1)
    status = displace_and_run(watch, r, &base, deadline, trial);
  hk_frames_release(&base.frames);
  return status;
}
