#include "measure/spectrum/limit_rules.h"

#include "core/memory.h"
#include "core/status.h"
#include "hooke/integrator.h"
#include "hooke/measurement.h"
#include "integrate/method.h"
#include "measure/spectrum/eigen/dominant_mode.h"

#include <math.h>
#include <string.h>

/* See limit_rules.h. */
static const double SLOW_SPIN = 1e-3;

static const char *const SPINS =
    "not known: a body spins so fast that gyroscopic and centrifugal forces count, which are left out";
static const char *const PART_KNOWN =
    "only the fastest modes are known: the limit lies between the bound and the prediction";

/* ---- symplectic Euler ---- */

enum { MOST_TURNS = 30 };
/* From a good start a value rises little in its first iterations, however far it is from converged. */
static const double WARM = 0.1;

/* The h of one mode of stiffness k and damping c: h^2 k + 2 h c = 4, written so that nothing cancels. */
static double symplectic_step(double k, double c) {
  return 4.0 / (c + sqrt(c * c + 4.0 * k));
}

/* x.Cx */
static int32_t damping_of(struct hk_linearised *lin, const double *x, double *work, double *c) {
  *c = 0.0;
  if (!lin->damped) return HOOKE_OK;
  hk_linearised_combine(lin, 0.0, 1.0);
  hk_linearised_multiply(lin, x, work);
  *c = hk_linearised_dot(lin, x, work);
  return HOOKE_OK;
}

/* H at which the largest eigenvalue of M^-1 (h^2 K + 2 h C) is 4. The mode of one h gives its own step, which
 * is the next h: the eigenvalue is stationary in the mode, so this is Newton's iteration, from above after
 * the first step. */
static int32_t symplectic_euler(struct hk_spectrum *s, struct hk_prediction *out) {
  struct hk_linearised *lin = s->linearised;
  hk_limit_take_mode(s, s->stiffest_mode, out);
  out->limit = symplectic_step(s->stiffest, s->beta * s->stiffest + s->delta);
  if (s->proportional) return HOOKE_OK;
  const double tolerance =
      lin->unknowns <= HOOKE_ARPACK_UNKNOWNS ? fmin(1e-7, 1e-2 * s->accuracy) : s->accuracy;
  double *work = hk_new(lin->size, sizeof(double)), c = 0.0, value = 0.0, change = INFINITY;
  if (work == NULL) return HOOKE_NO_MEMORY;
  int32_t status = damping_of(lin, out->mode, work, &c);
  double h = symplectic_step(s->stiffest, c);
  /* nothing stiff: the start is no mode at all */
  if (!(h < INFINITY)) {
    status = hk_dominant_mode(lin, 0.0, 1.0, NULL, s->accuracy, &c, out->mode);
    h = symplectic_step(0.0, c);
  }
  for (int k = 0; k < MOST_TURNS && status == HOOKE_OK && change > tolerance; k++) {
    memcpy(work, out->mode, (size_t)lin->size * sizeof(double));
    status = hk_dominant_mode(lin, h * h, 2.0 * h, work, WARM * s->accuracy, &value, out->mode);
    if (status == HOOKE_OK) status = damping_of(lin, out->mode, work, &c);
    const double next = symplectic_step(fmax(0.0, (value - 2.0 * h * c) / (h * h)), c);
    change = fabs(next - h) / next;
    h = next;
  }
  out->limit = h;
  hk_free(work);
  return status;
}

/* ---- the others ---- */

/* Damping is implicit: the limit is that of the undamped modes. */
static double verlet_step(double k) {
  return 2.0 / sqrt(k);
}

static void verlet(struct hk_spectrum *s, struct hk_prediction *out) {
  out->limit = verlet_step(s->stiffest);
  hk_limit_take_mode(s, s->stiffest_mode, out);
}

static const double HALF_DISC = 2.6; /* in the left half plane all of this is stable by degree 4 */

/* Largest stable step of an eigenvalue; infinity if that is certain to be above `best`. */
static double step_of(int32_t degree, double real, double imaginary, double best) {
  const double size = hypot(real, imaginary);
  if (degree == 1) return -2.0 * real / (real * real + imaginary * imaginary); /* |1 + h lambda| <= 1 */
  if (degree == 2) return hk_heun_reach(real, imaginary) / size;
  return best * size <= HALF_DISC ? (double)INFINITY : hk_rk4_reach(real, imaginary) / size;
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
  if (worst >= 0) hk_limit_take_mode(s, s->value[worst].mode, out);
  out->exact = s->decisive;
  if (!s->decisive) out->note = PART_KNOWN;
}

/* The imaginary axis is not stable. */
static void needs_damping(struct hk_spectrum *s, struct hk_prediction *out) {
  if (!s->linearised->damped && s->stiffest > 0.0) {
    out->limit = 0.0; /* for any set of known modes */
    out->exact = 1;
    hk_limit_take_mode(s, s->stiffest_mode, out);
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
    return symplectic_step(k, c);
  case HOOKE_STABLE_BY_PREDICTION:
    return hk_limit_predicted_step(k, c);
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
  out->limit =
      s->stiffest > 0.0 ? hk_real_reach(stability->degree) / s->stiffest / s->linearised->rate : INFINITY;
  hk_limit_take_mode(s, s->stiffest_mode, out);
}

static int32_t find_limit(struct hk_spectrum *s, const struct hk_stability *stability,
                          struct hk_prediction *out) {
  if (s->linearised->system->overdamped) {
    overdamped(s, stability, out);
    return HOOKE_OK;
  }
  switch (stability->kind) {
  case HOOKE_STABLE_BY_K:
    verlet(s, out);
    return HOOKE_OK;
  case HOOKE_STABLE_BY_K_AND_C:
    return symplectic_euler(s, out);
  case HOOKE_STABLE_BY_PREDICTION:
    return hk_limit_rule_predicted(s, out);
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
