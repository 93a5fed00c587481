#include "measure/spectrum/limit_rules.h"

#include "core/memory.h"
#include "core/status.h"
#include "hooke/integrator.h"
#include "hooke/measurement.h"
#include "integrate/method.h"
#include "kernel/vector_loops.h"
#include "measure/spectrum/eigen/dense.h"
#include "measure/spectrum/eigen/dominant_mode.h"

#include <math.h>
#include <string.h>

/* See limit_rules.h. */
static const double SLOW_SPIN = 1e-3;

static const char *const SPINS =
    "not known: a body spins so fast that gyroscopic and centrifugal forces count, which are left out";
static const char *const TOO_LARGE =
    "not known: damping out of proportion is at predicted velocities, and the "
    "scene too large to solve for all motion at once";
static const char *const NOT_ALL =
    "with damping out of proportion it is not proved that no motion grows below the prediction";
static const char *const PART_KNOWN =
    "only the fastest modes are known: the limit lies between the bound and the prediction";

static void take_mode(const struct hk_spectrum *s, const double *mode, struct hk_prediction *out) {
  out->has_mode = mode != NULL;
  if (mode) memcpy(out->mode, mode, (size_t)s->linearised->size * sizeof(double));
}

/* h^2 (k - d) + 2 h c = 4, written so that nothing cancels; infinity if it is met nowhere. */
static double reach(double k, double c, double d) {
  const double square = c * c + 4.0 * (k - d);
  return square < 0.0 ? INFINITY : 4.0 / (c + sqrt(square));
}

/* ---- symplectic Euler ---- */

enum { MOST_TURNS = 30 };
/* From a good start a value rises little in its first iterations, however far it is from converged. */
static const double WARM = 0.1;
static const double TOLERANCE = 1e-10; /* of dense ones */

/* x.Cx */
static double damping_of(struct hk_linearised *lin, const double *x, double *work) {
  if (!lin->damped) return 0.0;
  hk_linearised_combine(lin, 0.0, 1.0);
  hk_linearised_multiply(lin, x, work);
  return hk_linearised_dot(lin, x, work);
}

/* H at which the largest eigenvalue of M^-1 (h^2 K + 2 h C) is 4. The mode of one h gives its own step, which
 * is the next h: the eigenvalue is stationary in the mode, so this is Newton's iteration, from above after
 * the first step. */
static int32_t symplectic_euler(struct hk_spectrum *s, struct hk_prediction *out) {
  struct hk_linearised *lin = s->linearised;
  take_mode(s, s->stiffest_mode, out);
  out->limit = reach(s->stiffest, s->beta * s->stiffest + s->delta, 0.0);
  if (s->proportional) return HOOKE_OK;
  const double tolerance = lin->unknowns <= HOOKE_FEW_UNKNOWNS ? fmin(1e-7, 1e-2 * s->accuracy) : s->accuracy;
  double *work = hk_new(lin->size, sizeof(double)), value = 0.0, change = INFINITY;
  if (work == NULL) return HOOKE_NO_MEMORY;
  int32_t status = HOOKE_OK;
  double c = damping_of(lin, out->mode, work), h = reach(s->stiffest, c, 0.0);
  /* nothing stiff: the start is no mode at all */
  if (!(h < INFINITY)) {
    status = hk_dominant_mode(lin, 0.0, 1.0, NULL, s->accuracy, &c, out->mode);
    h = reach(0.0, c, 0.0);
  }
  for (int k = 0; k < MOST_TURNS && status == HOOKE_OK && change > tolerance; k++) {
    memcpy(work, out->mode, (size_t)lin->size * sizeof(double));
    status = hk_dominant_mode(lin, h * h, 2.0 * h, work, WARM * s->accuracy, &value, out->mode);
    if (status != HOOKE_OK) break;
    c = damping_of(lin, out->mode, work);
    const double next = reach(fmax(0.0, (value - 2.0 * h * c) / (h * h)), c, 0.0);
    change = fabs(next - h) / next;
    h = next;
  }
  out->limit = h;
  hk_free(work);
  return status;
}

/* ---- verlet of bodies ---- */

/* It takes damping at a predicted velocity: stable where h^2 K + 2 h C - h^2 C^2 < 4 and h C < 2, over the
 * masses. An eigenvalue of its step is -1 or 1 where one of these is met, whatever K and C are; of one mode
 * its eigenvalues leave the unit circle nowhere else. */
static double by_damping(double c) {
  return c > 0.0 ? 2.0 / c : INFINITY;
}

static double predicted_step(double k, double c) {
  return fmin(reach(k, c, c * c), by_damping(c));
}

struct search {
  int64_t n;
  double *k, *c, *sum, *value, *vector, *product; /* n x n: k, c, sum, vector */
};

/* out = m x */
static void multiply(int64_t n, const double *m, const double *x, double *out) {
  for (int64_t i = 0; i < n; i++)
    out[i] = hk_dot(n, m + i * n, x);
}

/* sum = h^2 K + 2 h C - h^2 C^2; C is symmetric. */
static void combine(struct search *z, double h) {
  for (int64_t i = 0; i < z->n; i++) {
    multiply(z->n, z->c, z->c + i * z->n, z->product);
    for (int64_t j = 0; j < z->n; j++) {
      const int64_t at = i * z->n + j;
      z->sum[at] = h * h * (z->k[at] - z->product[j]) + 2.0 * h * z->c[at];
    }
  }
}

/* The value of a vector is that of the matrix at least, so the h that it gives is at most too large; Newton's
 * iteration from above. */
static int32_t search(struct search *z, double *h) {
  double change = INFINITY;
  int32_t status = HOOKE_OK;
  for (int turn = 0; turn < MOST_TURNS && status == HOOKE_OK && change > TOLERANCE; turn++) {
    combine(z, *h);
    status = hk_dense_symmetric(z->n, z->sum, z->value, z->vector);
    if (status != HOOKE_OK) break;
    multiply(z->n, z->k, z->vector, z->product);
    const double k = hk_dot(z->n, z->vector, z->product);
    multiply(z->n, z->c, z->vector, z->product);
    const double c = hk_dot(z->n, z->vector, z->product), d = hk_dot(z->n, z->product, z->product);
    const double next = reach(k, c, d);
    change = fabs(next - *h) / next;
    *h = next;
  }
  return status;
}

static int32_t out_of_proportion(struct hk_spectrum *s, struct hk_prediction *out) {
  struct hk_linearised *lin = s->linearised;
  const int64_t n = lin->unknowns;
  double *block = hk_new(4 * n * n + 2 * n, sizeof(double));
  struct search z = {.n = n, .k = block};
  if (block == NULL) return HOOKE_NO_MEMORY;
  z.c = z.k + n * n;
  z.sum = z.c + n * n;
  z.vector = z.sum + n * n;
  z.value = z.vector + n * n;
  z.product = z.value + n;
  int32_t status = HOOKE_OK;
  for (int j = 0; j < 2 && status == HOOKE_OK; j++) {
    hk_linearised_combine(lin, j == 0, j == 1);
    status = hk_linearised_assemble(lin, j == 0 ? z.k : z.c);
  }
  out->limit = reach(s->stiffest, s->fastest_decay, 0.0); /* too small: the mode of a first turn */
  if (status == HOOKE_OK) status = search(&z, &out->limit);
  if (status == HOOKE_OK) hk_linearised_unpack(lin, z.vector, out->mode);
  out->has_mode = status == HOOKE_OK;
  hk_free(block);
  return status;
}

static int32_t predicted(struct hk_spectrum *s, struct hk_prediction *out) {
  if (s->proportional) { /* the stiffest mode meets both first */
    out->limit = predicted_step(s->stiffest, s->beta * s->stiffest + s->delta);
    take_mode(s, s->stiffest_mode, out);
    return HOOKE_OK;
  }
  if (s->linearised->unknowns > HOOKE_SPECTRUM_DAMPED) {
    out->limit = NAN;
    out->exact = 0;
    out->note = TOO_LARGE;
    return HOOKE_OK;
  }
  const int32_t status = out_of_proportion(s, out);
  out->limit = fmin(out->limit, by_damping(s->fastest_decay));
  out->exact = 0;
  out->note = NOT_ALL;
  return status;
}

/* ---- the others ---- */

/* Damping is implicit: the limit is that of the undamped modes. */
static double verlet_step(double k) {
  return 2.0 / sqrt(k);
}

static const double HALF_DISC = 2.6; /* in the left half plane all of this is stable by degree 4 */

/* Largest stable step of an eigenvalue; infinity if that is certain to be above `best`. */
static double step_of(int32_t degree, double real, double imaginary, double best) {
  const double size = hypot(real, imaginary);
  const int certain = degree == 4 && best * size <= HALF_DISC;
  return certain ? (double)INFINITY : hk_ray_reach(degree, real, imaginary) / size;
}

/* The smallest step over the known eigenvalues. */
static void smallest(const struct hk_spectrum *s, int32_t degree, struct hk_prediction *out) {
  int64_t worst = -1;
  out->limit = INFINITY;
  for (int64_t k = 0; k < s->count; k++) {
    const double h = step_of(degree, s->value[k].real, s->value[k].imaginary, out->limit);
    if (!(h < out->limit)) continue;
    out->limit = h;
    worst = k;
  }
  if (worst >= 0) take_mode(s, s->value[worst].mode, out);
  out->exact = s->decisive;
  if (!s->decisive) out->note = PART_KNOWN;
}

/* The imaginary axis is not stable. */
static void needs_damping(struct hk_spectrum *s, struct hk_prediction *out) {
  if (!s->linearised->damped && s->stiffest > 0.0) {
    out->limit = 0.0; /* for any set of known modes */
    out->exact = 1;
    take_mode(s, s->stiffest_mode, out);
  }
  if (out->limit <= 0.0) {
    out->limit = 0.0;
    out->exact = out->never_stable = 1;
    out->note = !s->linearised->damped
                    ? "nothing damps the motion, and every step makes it grow"
                    : "some motion is not damped, and every step makes it grow; damping along a "
                      "spring does not damp motion across it";
  } else if (s->decisive && s->stiffest > 0.0 && out->limit < 0.02 / sqrt(s->stiffest)) {
    out->note =
        "damping along a spring hardly damps motion across it; just above the limit that motion grows too "
        "slowly to be seen in a short run";
  }
}

/* An eigenvalue is at most omega where it oscillates, and at most c where it does not. */
static void polynomial(struct hk_spectrum *s, const struct hk_stability *stability,
                       struct hk_prediction *out) {
  smallest(s, stability->degree, out);
  if (stability->axis == 0.0)
    needs_damping(s, out);
  else if (!out->exact)
    out->sure = HALF_DISC / fmax(sqrt(s->stiffest), s->fastest_decay);
}

/* ---- of one mode, x'' + c x' + k x = 0: the smaller one of the two steps of its roots ---- */

static double polynomial_mode(int32_t degree, double k, double c) {
  double real[2], imaginary[2], h = INFINITY;
  hk_spectrum_roots(c, k, real, imaginary);
  for (int j = 0; j < 2; j++) {
    if (real[j] != 0.0 || imaginary[j] != 0.0) h = fmin(h, step_of(degree, real[j], imaginary[j], INFINITY));
  }
  return h;
}

static double mode_step(const struct hk_stability *stability, double k, double c) {
  switch (stability->kind) {
  case HOOKE_STABLE_ALWAYS:
    return INFINITY;
  case HOOKE_STABLE_BY_K:
    return verlet_step(k);
  case HOOKE_STABLE_BY_K_AND_C:
    return reach(k, c, 0.0);
  case HOOKE_STABLE_BY_PREDICTION:
    return predicted_step(k, c);
  default:
    return stability->degree > 0 ? polynomial_mode(stability->degree, k, c) : (double)NAN;
  }
}

static double limit_of_mode(const struct hk_stability *stability, double frequency, double decay) {
  if (!(frequency >= 0.0) || !(decay >= 0.0)) return NAN;
  return mode_step(stability, frequency * frequency, 2.0 * decay);
}

double hooke_limit_of_mode(const char *method, double frequency, double decay) {
  return limit_of_mode(hk_method_stability(method), frequency, decay);
}

double hk_limit_of_mode_in(const hooke_system *system, const char *method, double frequency, double decay) {
  return limit_of_mode(hk_method_stability_in(method, system), frequency, decay);
}

/* ---- by kinds of stability ---- */

int32_t hk_limit_rule_needs_all(const char *method) {
  return hk_method_stability(method)->kind == HOOKE_STABLE_BY_POLYNOMIAL;
}

/* An overdamped system has the eigenvalues -k/gamma alone, which are those of M^-1 K here. */
static void overdamped(struct hk_spectrum *s, const struct hk_stability *stability,
                       struct hk_prediction *out) {
  out->limit = s->stiffest > 0.0
                   ? hk_ray_reach(stability->degree, -1.0, 0.0) / s->stiffest / s->linearised->rate
                   : INFINITY;
  take_mode(s, s->stiffest_mode, out);
}

static int32_t find_limit(struct hk_spectrum *s, const struct hk_stability *stability,
                          struct hk_prediction *out) {
  if (s->linearised->system->overdamped) {
    overdamped(s, stability, out);
    return HOOKE_OK;
  }
  switch (stability->kind) {
  case HOOKE_STABLE_BY_K:
    out->limit = verlet_step(s->stiffest);
    take_mode(s, s->stiffest_mode, out);
    return HOOKE_OK;
  case HOOKE_STABLE_BY_K_AND_C:
    return symplectic_euler(s, out);
  case HOOKE_STABLE_BY_PREDICTION:
    return predicted(s, out);
  default:
    polynomial(s, stability, out);
    return HOOKE_OK;
  }
}

/* Of the limiting mode, by its energies: the larger root of lambda^2 + c lambda + k. */
static double pace_of(const struct hk_spectrum *s, const struct hk_prediction *p) {
  struct hk_linearised *lin = s->linearised;
  double real[2], imaginary[2];
  if (!p->has_mode) return 1.0 / p->limit;
  hk_linearised_combine(lin, 1.0, 0.0);
  const double k = hk_linearised_energy(lin, p->mode);
  hk_linearised_combine(lin, 0.0, 1.0);
  hk_spectrum_roots(hk_linearised_energy(lin, p->mode), k, real, imaginary);
  return hypot(real[0], imaginary[0]);
}

static int spins(const struct hk_spectrum *s, const struct hk_prediction *p) {
  return s->linearised->spin > 0.0 && p->limit > 0.0 && s->linearised->spin > SLOW_SPIN * pace_of(s, p);
}

int32_t hk_limit_rule(struct hk_spectrum *s, const char *method, struct hk_prediction *out) {
  const int32_t adaptive = hooke_method_is_adaptive(method);
  if (adaptive < 0) return hk_fail(HOOKE_BAD_VALUE, "method", "there is no method \"%s\"", method);
  out->limit = adaptive ? INFINITY : NAN;
  out->exact = 1;
  out->sure = NAN;
  out->never_stable = out->has_mode = out->spins = 0;
  out->note = adaptive ? "chooses its steps; error control limits them" : "no rule is known for this method";
  const struct hk_stability *stability = hk_method_stability_in(method, s->linearised->system);
  if (stability->kind == HOOKE_STABILITY_UNKNOWN) return HOOKE_OK;
  out->note = stability->note ? stability->note : "";
  if (stability->kind == HOOKE_STABLE_ALWAYS) {
    out->limit = out->sure = INFINITY;
    return HOOKE_OK;
  }
  const int32_t status = find_limit(s, stability, out);
  if (status != HOOKE_OK) return status;
  out->spins = spins(s, out);
  if (out->spins) {
    out->limit = out->sure = NAN;
    out->exact = out->has_mode = 0;
    out->note = SPINS;
  }
  out->limit /= s->linearised->rate;
  out->sure = out->exact ? out->limit : out->sure / s->linearised->rate;
  if (out->limit == INFINITY) {
    out->has_mode = 0;
    out->note = "nothing limits the step: there is no stiffness, and no damping that is explicit";
  }
  return HOOKE_OK;
}
