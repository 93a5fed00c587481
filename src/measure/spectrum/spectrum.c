#include "measure/spectrum/spectrum.h"

#include "core/memory.h"
#include "kernel/vector_loops.h"
#include "measure/spectrum/eigen/dense.h"
#include "measure/spectrum/eigen/dominant_mode.h"
#include "model/force/spring.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Damping is proportional if at most this fraction of it is not. */
static const double OUT_OF_PROPORTION = 1e-12;
/* Smaller eigenvalues belong to free motion. */
static const double STILL = 1e-13;
/* Damping of a mode below this fraction of the largest is rounding. */
static const double UNDAMPED = 1e-18;
/* Stiffness over the square of drag, below which drag alone says how motion decays, to a billionth. */
static const double SOFT = 1e-9;

void hk_spectrum_release(struct hk_spectrum *s) {
  hk_free(s->stiffest_mode);
  hk_free(s->value);
  hk_free(s->block);
  memset(s, 0, sizeof *s);
}

static int32_t make_space(struct hk_spectrum *s, int64_t count, int64_t modes) {
  s->value = hk_new(count, sizeof *s->value);
  s->block = hk_new(modes * s->linearised->size, sizeof(double));
  return s->value && s->block ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void add(struct hk_spectrum *s, double real, double imaginary, double k, const double *mode) {
  if (hypot(real, imaginary) <= STILL) return;
  s->value[s->count] = (struct hk_eigenvalue){real, imaginary, k, mode, s->count};
  s->count++;
}

void hk_spectrum_roots(double c, double k, double real[2], double imaginary[2]) {
  const double half = 0.5 * c, square = half * half - k;
  if (square < 0.0) {
    real[0] = real[1] = -half;
    imaginary[0] = imaginary[1] = sqrt(-square);
    return;
  }
  real[0] = -(half + sqrt(square));
  real[1] = real[0] < 0.0 ? k / real[0] : 0.0; /* the product of the roots is k */
  imaginary[0] = imaginary[1] = 0.0;
}

static void add_both(struct hk_spectrum *s, double c, double k, const double *mode) {
  double real[2], imaginary[2];
  k = fmax(0.0, k);
  hk_spectrum_roots(c, k, real, imaginary);
  add(s, real[0], imaginary[0], k, mode);
  if (imaginary[0] == 0.0) add(s, real[1], 0.0, k, mode);
}

/* ---- proportional damping ---- */

/* C = beta K + delta M: every element is damped along in proportion to its stiffness and has no transverse
 * damping, and all masses with drag are equal. */
static int32_t find_proportion(struct hk_spectrum *s) {
  const struct hk_linearised *lin = s->linearised;
  const hooke_system *system = lin->system;
  double mass = 0.0;
  for (int64_t k = 0; k < system->springs->count && s->beta == 0.0; k++) {
    if (lin->kappa[k] > 0.0) s->beta = lin->gamma[k] / lin->kappa[k];
  }
  for (int64_t k = 0; k < lin->element_count && s->beta == 0.0; k++) {
    if (lin->element[k].k_along > 0.0) s->beta = lin->element[k].c_along / lin->element[k].k_along;
  }
  for (int64_t k = 0; k < system->springs->count; k++) {
    if (fabs(lin->gamma[k] - s->beta * lin->kappa[k]) > OUT_OF_PROPORTION * lin->gamma[k]) return 0;
  }
  for (const struct hk_element *e = lin->element; e < lin->element + lin->element_count; e++) {
    if (fabs(e->c_along - s->beta * e->k_along) > OUT_OF_PROPORTION * e->c_along || e->c_across > 0.0)
      return 0;
  }
  for (int64_t p = 0; p < system->particle_count && lin->drag > 0.0; p++) {
    if (system->constrained[p]) continue;
    if (mass > 0.0 && lin->mass[p] != mass) return 0;
    mass = lin->mass[p];
  }
  s->delta = lin->drag > 0.0 ? lin->drag / mass : 0.0;
  return s->beta == 0.0 ||
         (!lin->across_any && !lin->points_damped && !lin->bends && lin->rigid.stiffest == 0.0);
}

/* The softest mode, in the block. */
static int32_t find_softest(struct hk_spectrum *s, double *matrix) {
  struct hk_linearised *lin = s->linearised;
  double *vector = hk_new(lin->unknowns, sizeof(double));
  int32_t status = vector ? hk_linearised_assemble(lin, matrix) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hk_dense_softest(lin->unknowns, matrix, vector);
  if (status == HOOKE_OK) hk_linearised_unpack(lin, vector, s->block);
  hk_free(vector);
  return status;
}

/* Where not all modes are known, the stiffest is, and with drag the softest, also of all that is as soft
 * beside drag: one of the two limits every method. */
static const double *end_of(const struct hk_spectrum *s, int64_t j, double k) {
  const int soft = j == s->linearised->unknowns - 1 || k <= SOFT * s->delta * s->delta;
  return j == 0 ? s->stiffest_mode : s->delta > 0.0 && soft ? s->block : NULL;
}

/* All eigenvalues of K; with their modes if there are few. */
static int32_t solve_proportional(struct hk_spectrum *s) {
  struct hk_linearised *lin = s->linearised;
  const int64_t n = lin->unknowns, modes = n <= HOOKE_SPECTRUM_DAMPED ? n : 0;
  double *matrix = hk_new((modes ? 2 : 1) * n * n + n, sizeof(double));
  if (matrix == NULL) return HOOKE_NO_MEMORY;
  double *value = matrix + n * n, *vector = modes ? value + n : NULL;
  int32_t status = make_space(s, 2 * n, modes ? modes : s->delta > 0.0);
  hk_linearised_combine(lin, 1.0, 0.0);
  if (status == HOOKE_OK) status = hk_linearised_assemble(lin, matrix);
  if (status == HOOKE_OK) status = hk_dense_symmetric(n, matrix, value, vector);
  if (status == HOOKE_OK && !modes && s->delta > 0.0) status = find_softest(s, matrix);
  for (int64_t j = 0; j < n && status == HOOKE_OK; j++) {
    const double k = value[j] > (double)n * 1e-15 * value[0] ? value[j] : 0.0;
    double *mode = modes ? s->block + j * lin->size : NULL;
    if (modes) hk_linearised_unpack(lin, vector + j * n, mode);
    add_both(s, s->beta * k + s->delta, k, mode ? mode : end_of(s, j, k));
  }
  s->decisive = 1;
  hk_free(matrix);
  return status;
}

/* ---- any damping ---- */

/* k = u.Ku and c = u.Cu for u.Mu = 1: sums of squares, which keep their digits for weakly damped modes. */
struct refined {
  double k, c;
};

static struct refined refine(struct hk_linearised *lin, const double *re, const double *im) {
  const double size = hk_linearised_dot(lin, re, re) + hk_linearised_dot(lin, im, im);
  struct refined r = {0.0, 0.0};
  hk_linearised_combine(lin, 1.0, 0.0);
  r.k = (hk_linearised_energy(lin, re) + hk_linearised_energy(lin, im)) / size;
  hk_linearised_combine(lin, 0.0, 1.0);
  r.c = (hk_linearised_energy(lin, re) + hk_linearised_energy(lin, im)) / size;
  return r;
}

/* mode = the real part of u, rotated so that it is as large as possible. */
static void turn(const struct hk_linearised *lin, double *re, const double *im) {
  const double a = hk_linearised_dot(lin, re, re), b = hk_linearised_dot(lin, im, im);
  const double angle = 0.5 * atan2(-2.0 * hk_linearised_dot(lin, re, im), a - b);
  for (int64_t k = 0; k < lin->size; k++)
    re[k] = cos(angle) * re[k] - sin(angle) * im[k];
}

/* x = the combination of modes of the basis, or of unknowns. */
static void expand(const struct hk_linearised *lin, int64_t r, const double *basis, const double *fraction,
                   double *x) {
  if (basis == NULL) {
    hk_linearised_unpack(lin, fraction, x);
    return;
  }
  memset(x, 0, (size_t)lin->size * sizeof(double));
  for (int64_t j = 0; j < r; j++)
    hk_add_multiple(lin->size, fraction[j], basis + j * lin->size, x);
}

/* All modes are refined. Those of a partial spectrum are no better than the subspace. */
static int32_t take_modes(struct hk_spectrum *s, int64_t r, const double *basis,
                          const struct hk_damped_modes *found) {
  struct hk_linearised *lin = s->linearised;
  double *im = hk_new(lin->size, sizeof(double));
  int32_t status = im ? make_space(s, found->count, found->count) : HOOKE_NO_MEMORY;
  for (int64_t j = 0; j < found->count && status == HOOKE_OK; j++) {
    double *re = s->block + j * lin->size, real[2], imaginary[2];
    expand(lin, r, basis, found->vector_real + j * r, re);
    expand(lin, r, basis, found->vector_imaginary + j * r, im);
    if (basis) {
      const double size = hypot(found->real[j], found->imaginary[j]);
      const double k = found->imaginary[j] != 0.0 ? size * size : refine(lin, re, im).k;
      turn(lin, re, im);
      add(s, fmin(0.0, found->real[j]), found->imaginary[j], k, re);
      continue;
    }
    const struct refined mode = refine(lin, re, im);
    hk_spectrum_roots(mode.c <= UNDAMPED * s->fastest_decay ? 0.0 : mode.c, mode.k, real, imaginary);
    const double first = hypot(real[0] - found->real[j], imaginary[0] - found->imaginary[j]);
    const double second = hypot(real[1] - found->real[j], imaginary[1] - found->imaginary[j]);
    turn(lin, re, im);
    add(s, real[first <= second ? 0 : 1], imaginary[first <= second ? 0 : 1], mode.k, re);
  }
  hk_free(im);
  return status;
}

/* Matrix of K or C between r modes. */
static int32_t project(struct hk_linearised *lin, int64_t r, const double *basis, double *matrix) {
  double *out = hk_new(lin->size, sizeof(double));
  if (out == NULL) return HOOKE_NO_MEMORY;
  for (int64_t i = 0; i < r; i++) {
    hk_linearised_multiply(lin, basis + i * lin->size, out);
    for (int64_t j = 0; j < r; j++)
      matrix[i * r + j] = hk_linearised_dot(lin, out, basis + j * lin->size);
  }
  hk_free(out);
  return HOOKE_OK;
}

/* Between r modes, or of all r unknowns (NULL). */
static int32_t solve_damped(struct hk_spectrum *s, int64_t r, const double *basis) {
  struct hk_linearised *lin = s->linearised;
  double *matrix = hk_new(2 * r * r, sizeof(double));
  struct hk_damped_modes found = {.count = 0};
  int32_t status = matrix ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int k = 0; k < 2 && status == HOOKE_OK; k++) {
    double *of = matrix + k * r * r;
    hk_linearised_combine(lin, k == 0, k == 1);
    status = basis ? project(lin, r, basis, of) : hk_linearised_assemble(lin, of);
  }
  if (status == HOOKE_OK) status = hk_dense_damped(r, matrix, matrix + r * r, &found);
  if (status == HOOKE_OK) status = take_modes(s, r, basis, &found);
  s->decisive = basis == NULL;
  hk_damped_modes_release(&found);
  hk_free(matrix);
  return status;
}

/* ---- partial spectrum ---- */

/* Adds the component of x that is new to `count` orthonormal modes. */
static void extend(const struct hk_linearised *lin, const double *x, double *basis, int64_t *count) {
  double *new_one = basis + *count * lin->size;
  memcpy(new_one, x, (size_t)lin->size * sizeof(double));
  double length = sqrt(hk_linearised_dot(lin, x, x));
  for (int pass = 0; pass < 2; pass++) {
    for (int64_t j = 0; j < *count; j++) {
      const double *other = basis + j * lin->size;
      hk_add_multiple(lin->size, -hk_linearised_dot(lin, other, new_one), other, new_one);
    }
  }
  const double left = sqrt(hk_linearised_dot(lin, new_one, new_one));
  if (!(left > 1e-6 * length)) return;
  for (int64_t k = 0; k < lin->size; k++)
    new_one[k] /= left;
  ++*count;
}

static int32_t solve_part(struct hk_spectrum *s, const double *decaying) {
  struct hk_linearised *lin = s->linearised;
  int64_t r = 0;
  double *basis = hk_new(2 * lin->size, sizeof(double));
  if (basis == NULL) return HOOKE_NO_MEMORY;
  extend(lin, s->stiffest_mode, basis, &r);
  extend(lin, decaying, basis, &r);
  const int32_t status = solve_damped(s, r, basis);
  hk_free(basis);
  return status;
}

/* The stiffest mode only. With C = beta K it limits every method: it has the largest eigenvalues, and of
 * Runge-Kutta the stable distance along a ray changes less than they do. With drag a softer one may limit,
 * which only drag damps. */
static int32_t solve_stiffest(struct hk_spectrum *s) {
  const int32_t status = make_space(s, 4, 0);
  if (status == HOOKE_OK) add_both(s, s->beta * s->stiffest + s->delta, s->stiffest, s->stiffest_mode);
  s->decisive = s->delta == 0.0;
  return status;
}

/* ---- order ---- */

static int compare(const void *a, const void *b) {
  const struct hk_eigenvalue *x = a, *y = b;
  const double one = hypot(x->real, x->imaginary), other = hypot(y->real, y->imaginary);
  if (one != other) return (one < other) - (one > other);
  return (x->number > y->number) - (x->number < y->number);
}

/* ---- creating ---- */

/* Dense solves cannot be interrupted: maximum time [s] as a multiple of the cube of the unknowns. */
static const double SECONDS_PROPORTIONAL = 2e-10, SECONDS_DAMPED = 2.5e-8;

static int32_t has_time_for_all(const struct hk_spectrum *s) {
  const double n = (double)s->linearised->unknowns;
  if (n > (s->proportional ? HOOKE_SPECTRUM_PROPORTIONAL : HOOKE_SPECTRUM_DAMPED)) return 1;
  const double seconds = (s->proportional ? SECONDS_PROPORTIONAL : SECONDS_DAMPED) * n * n * n;
  if (!hk_budget_has(s->linearised->budget, seconds)) return 0;
  if (s->linearised->budget) hk_budget_spend(s->linearised->budget, seconds);
  return 1;
}

static int32_t find_fastest_decay(struct hk_spectrum *s, double *decaying) {
  struct hk_linearised *lin = s->linearised;
  s->fastest_decay = s->beta * s->stiffest + s->delta;
  if (s->proportional) return HOOKE_OK;
  /* in large scenes only its value is used, and a part of a partial spectrum */
  const double accuracy = lin->unknowns <= HOOKE_FEW_UNKNOWNS ? s->accuracy : 4.0 * s->accuracy;
  return hk_dominant_mode(lin, 0.0, 1.0, s->stiffest_mode, accuracy, &s->fastest_decay, decaying);
}

static int32_t solve(struct hk_spectrum *s, enum hk_spectrum_extent extent, double *decaying) {
  const int64_t unknowns = s->linearised->unknowns;
  if (extent == HOOKE_SPECTRUM_ALL && !has_time_for_all(s)) return HOOKE_STOPPED;
  const int32_t status = find_fastest_decay(s, decaying);
  if (status != HOOKE_OK) return status;
  if (extent == HOOKE_SPECTRUM_EXTREMES)
    return s->proportional && s->delta == 0.0 ? solve_stiffest(s) : HOOKE_OK;
  if (s->proportional)
    return unknowns <= HOOKE_SPECTRUM_PROPORTIONAL ? solve_proportional(s) : solve_stiffest(s);
  return unknowns <= HOOKE_SPECTRUM_DAMPED ? solve_damped(s, unknowns, NULL) : solve_part(s, decaying);
}

int32_t hk_spectrum_create(struct hk_linearised *lin, double accuracy, enum hk_spectrum_extent extent,
                           const double *start, struct hk_spectrum *s) {
  *s = (struct hk_spectrum){.linearised = lin, .accuracy = accuracy, .decisive = lin->unknowns == 0};
  s->stiffest_mode = hk_new(lin->size, sizeof(double));
  double *decaying = hk_new(lin->size, sizeof(double));
  int32_t status = s->stiffest_mode && decaying ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK)
    status = hk_dominant_mode(lin, 1.0, 0.0, start, accuracy, &s->stiffest, s->stiffest_mode);
  s->proportional = status == HOOKE_OK && find_proportion(s);
  if (!s->proportional) s->beta = s->delta = 0.0;
  if (status == HOOKE_OK && lin->unknowns > 0 && extent != HOOKE_SPECTRUM_STIFFEST)
    status = solve(s, extent, decaying);
  if (status == HOOKE_OK && s->count > 0) qsort(s->value, (size_t)s->count, sizeof *s->value, compare);
  hk_free(decaying);
  if (status != HOOKE_OK) hk_spectrum_release(s);
  return status;
}
