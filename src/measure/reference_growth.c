/* How much small displacements of the start grow: the largest singular value of the map from positions and velocities at
 * the start, velocities times the duration, to positions at any frame. It is bounded by random displacements (Halko,
 * Martinsson and Tropp 2011, lemma 4.1): of k of them, whose components are normal, 10 sqrt(2/pi) times the largest
 * displacement seen is above it with probability 1 - 10^-k. */
#include "measure/reference_run.h"

#include "core/clock.h"
#include "core/random.h"

#include <math.h>
#include <stddef.h>

enum { DISPLACEMENTS = 3, FEWEST = 2 }; /* of which there are in a bound */
static const uint64_t SEED = 1;
static const double BOUND = 7.978845608028654; /* 10 sqrt(2/pi) */
static const double DISPLACEMENT = 1e-7;       /* of a component, as a share of the extent */
static const double SATURATED = 0.02;  /* of the extent: displacements that large are not small any more */
static const double TOLERANCE = 1e-10; /* of the runs, unless the reference's is looser and good enough */
static const double DROWNED = 1e-2;    /* agreement over displacement, from which on it is not */
static const double TIGHTER = 2.0;     /* what such a run may take, times that of the reference */

/* A displacement of the start. */
struct displacement {
  const hooke_system *system;
  uint64_t random;
  double length;   /* standard deviation of a component [m] */
  double duration; /* that of a velocity is `length` over it [s] */
  double square;   /* sum of the squares of all components over that of `length` */
};

static void displace(hooke_state *state, void *ctx) {
  struct displacement *d = ((struct hooke_reference_watch *)ctx)->displacement;
  const double *inverse_mass = hooke_system_inverse_mass(d->system);
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  d->square = 0.0;
  for (int64_t i = 0; i < hooke_state_size(state); i++) {
    if (!(inverse_mass[i / 3] > 0.0)) continue;
    const double x = hooke_random_normal(&d->random), y = hooke_random_normal(&d->random);
    q[i] += d->length * x;
    v[i] += d->length / d->duration * y;
    d->square += x * x + y * y;
  }
}

/* The largest displacement over the frames, in units of `length`. */
static double largest(const struct hooke_reference *base, const struct hooke_trial *trial, double length) {
  double most = 0.0; /* fmax leaves frames without one out */
  for (int64_t f = 0; f < base->frames.count; f++)
    most = fmax(most, trial->error_at[f]);
  return most * sqrt((double)base->frames.free_count) / length;
}

static int32_t displace_and_run(struct hooke_reference_watch *watch, struct hooke_reference *r,
                                const struct hooke_reference *base, double deadline,
                                struct hooke_trial *trial) {
  const double duration = hooke_options_number(watch->request->run, "duration");
  struct displacement d = {base->frames.system, SEED, DISPLACEMENT * r->extent, duration, 0.0};
  double most = 0.0;
  int32_t status = HOOKE_OK;
  watch->displacement = &d;
  for (int k = 0; k < DISPLACEMENTS && status == HOOKE_OK; k++) {
    watch->ahead = DISPLACEMENTS - 1 - k;
    struct hooke_listener listener = hooke_reference_listen(watch, deadline);
    listener.on_start = displace;
    status = hooke_reference_judge(watch, base, base->method, fmax(base->rtol, TOLERANCE), &listener, trial);
    if (status != HOOKE_OK || watch->expired) break;
    const double seen = largest(base, trial, d.length);
    most = fmax(most, seen);
    r->growth_seen = fmax(r->growth_seen, seen / sqrt(d.square));
    r->displacements = k + 1;
    r->growth_saturated |= trial->error > SATURATED * r->extent;
  }
  watch->displacement = NULL;
  if (r->displacements >= FEWEST && !r->growth_saturated) r->growth = BOUND * most;
  return status;
}

int32_t hooke_reference_measure_growth(struct hooke_reference_watch *watch, struct hooke_reference *r,
                                       struct hooke_trial *trial) {
  const double deadline = watch->begun + watch->request->budget;
  if (r->frames.free_count == 0) return HOOKE_OK;
  if (r->agreement <= DROWNED * DISPLACEMENT * r->extent)
    return displace_and_run(watch, r, r, deadline, trial);
  if (hooke_clock_seconds() + 2.0 * TIGHTER * r->run_seconds > deadline) return HOOKE_OK;
  struct hooke_reference base = *r;
  struct hooke_reference_cost cost;
  base.rtol = fmin(r->rtol, TOLERANCE);
  watch->ahead = DISPLACEMENTS;
  int32_t status = hooke_frames_create(r->frames.system, r->frames.count, &base.frames);
  if (status == HOOKE_OK) status = hooke_reference_make_frames(watch, &base, deadline, &cost);
  if (status == HOOKE_OK && base.frames.recorded > 1)
    status = displace_and_run(watch, r, &base, deadline, trial);
  hooke_frames_release(&base.frames);
  return status;
}
