#include "integrate/solve/reduced.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/vector_loops.h"
#include "model/force/spring.h"

#include <math.h>
#include <string.h>

/* Of S with its factor: what rounding leaves. */
static const double DIRECT_RESIDUAL = 1e-10;
/* Iterations that are allowed: what well-posed equations need by far, and not for ever. */
enum { SPARE_ITERATIONS = 1000, SIZE_SHARE = 4, MOST_ITERATIONS = 20000 };

/* Springs have loops of their own, drag is on the diagonal, and constant forces multiply by themselves. */
enum { OWN = HOOKE_LOOPED | HOOKE_CONSTANT | HOOKE_UNIFORM };

/* Allocates memory for the numbers of `whole` in advance, and counts it. HOOKE_NO_MEMORY. */
static int32_t reserve_whole(struct hk_reduced *reduced) {
  const int64_t before = hk_factor_memory(reduced->whole);
  const int32_t status = hk_factor_reserve(reduced->whole);
  reduced->integrator->own_memory += hk_factor_memory(reduced->whole) - before;
  return status;
}

/* The factor's memory, where it is used, ahead of all steps. */
static int32_t read_linear_solver(struct hk_reduced *reduced, int32_t kind) {
  const hooke_integrator *it = reduced->integrator;
  const char *word = hooke_options_text(it->options, "linear_solver");
  if (kind == HOOKE_REDUCED_GENERAL && strcmp(word, "gmres") == 0)
    return hk_fail(
        HOOKE_UNSUITED, "linear_solver",
        "%s has no plain gmres, which is for the methods of SUNDIALS; allowed: auto, blocks, direct",
        it->method->name);
  reduced->direct = strcmp(word, "direct") == 0;
  int32_t status = hk_factor_require(it->options);
  if (status == HOOKE_OK && reduced->direct) status = hk_reduced_prepare_whole(reduced);
  reduced->direct = reduced->whole != NULL;
  return status == HOOKE_OK && reduced->direct ? reserve_whole(reduced) : status;
}

int32_t hk_reduced_create(hooke_integrator *it, int32_t kind, const struct hk_more_unknowns *more,
                          struct hk_reduced *reduced) {
  static const int64_t vectors_of[] = {HOOKE_GENERAL_VECTORS, HOOKE_SYMMETRIC_VECTORS, HOOKE_MINIMAL_VECTORS};
  const hooke_system *system = it->system;
  const int32_t symmetric = kind == HOOKE_REDUCED_SYMMETRIC;
  const int64_t n = system->particle_count, m = system->springs->count, vectors = vectors_of[kind];
  const int64_t rows = !symmetric ? 15 * n : hk_elements_of(system, HOOKE_KEPT) > 0 ? 6 * n : 0;
  const int64_t size = 3 * n + (more ? more->count : 0);
  const int64_t numbers = (symmetric ? 3 : 7) * m + 13 * n + (4 + vectors) * size;
  double *block = hk_new(numbers, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  *reduced = (struct hk_reduced){.integrator = it, .symmetric = symmetric, .size = size};
  reduced->supernodal = kind == HOOKE_REDUCED_MINIMAL;
  if (more) reduced->more = *more;
  reduced->element_count = hk_elements_of(system, HOOKE_KEPT);
  reduced->element = hk_new(reduced->element_count, sizeof *reduced->element);
  if (rows > 0) reduced->rows = hk_rows_new(rows);
  reduced->diagonal = hk_part(&block, n);
  if (reduced->element == NULL || (rows > 0 && reduced->rows == NULL)) return HOOKE_NO_MEMORY;
  it->own_memory +=
      (numbers + rows) * (int64_t)sizeof(double) + reduced->element_count * (int64_t)sizeof *reduced->element;
  for (int32_t k = 0; k < system->force_row_count && !symmetric; k++) {
    const struct hk_force_row *row = system->force_row[k];
    reduced->rows_needed |= !(row->kind & OWN) && (row->add_product || row->elements);
  }
  for (int a = 0; a < 3; a++)
    reduced->tangent.u[a] = reduced->tangent.e[a] = hk_part(&block, m);
  for (int a = 0; a < 3 && !symmetric; a++)
    reduced->tangent.e[a] = hk_part(&block, m);
  if (!symmetric) reduced->tangent.b = hk_part(&block, m);
  reduced->block = hk_part(&block, 6 * n);
  reduced->factor = hk_part(&block, 6 * n);
  reduced->right = hk_part(&block, size);
  reduced->unknown = hk_part(&block, size);
  reduced->place = hk_part(&block, size);
  reduced->moved = hk_part(&block, size);
  reduced->krylov = hk_part(&block, size * vectors);
  return symmetric ? HOOKE_OK : read_linear_solver(reduced, kind);
}

void hk_reduced_release(struct hk_reduced *reduced) {
  hooke_rows_hold(reduced->rows, -1);
  hk_free(reduced->diagonal);
  hk_free(reduced->element);
  hk_factor_destroy(reduced->whole);
  memset(reduced, 0, sizeof *reduced);
}

/* ---- the point of the derivatives ---- */

/* Adds the diagonal blocks of an element of S. */
static void add_element(const struct hk_element *e, double alpha, double beta, double *const block[6]) {
  static const int row[6] = {0, 1, 2, 0, 0, 1}, column[6] = {0, 1, 2, 1, 2, 2};
  const struct hk_element_numbers s = hk_element_combine(e, alpha, beta);
  for (int j = 0; j < e->count; j++) {
    const double square = e->weight[j] * e->weight[j];
    const double axial = (s.along - s.across) * square, isotropic = s.across * square;
    for (int c = 0; c < 6; c++)
      block[c][e->particle[j]] += axial * e->u[row[c]] * e->u[column[c]] + (c < 3 ? isotropic : 0.0);
  }
}

static void add_others(const struct hk_reduced *reduced, double *const block[6]) {
  const hooke_system *system = reduced->integrator->system;
  struct hk_elements at;
  hk_begin_elements(system, 0.0, system->position, NULL, &at);
  at.kinds = HOOKE_CONSTANT;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;)
    add_element(e, reduced->alpha, reduced->beta, block);
  for (int64_t k = 0; k < reduced->element_count; k++)
    add_element(&reduced->element[k], reduced->alpha, reduced->beta, block);
}

static void fill_diagonal(struct hk_reduced *reduced) {
  const hooke_system *system = reduced->integrator->system;
  const int64_t n = system->particle_count;
  const double brake = reduced->beta * system->brake;
  double *const block[6] = {reduced->block,         reduced->block + n,     reduced->block + 2 * n,
                            reduced->block + 3 * n, reduced->block + 4 * n, reduced->block + 5 * n};
  for (int64_t p = 0; p < n; p++)
    reduced->diagonal[p] = system->inertia[p] + brake;
  for (int c = 0; c < 3; c++)
    memcpy(block[c], reduced->diagonal, (size_t)n * sizeof(double));
  memset(block[3], 0, (size_t)(3 * n) * sizeof(double));
  for (int64_t k = 0; k < system->springs->run_count; k++) {
    const struct hk_run *run = &system->springs->run[k];
    if (!reduced->symmetric || run->shape & HOOKE_RUN_DAMPED)
      hk_tangent_diagonal(run, &reduced->tangent, block);
  }
  add_others(reduced, block);
  memcpy(reduced->factor, reduced->block, (size_t)(6 * n) * sizeof(double));
  hk_factorise_blocks(n, reduced->factor);
  for (int64_t k = 0; k < system->constrained_count; k++) {
    for (int c = 0; c < 6; c++)
      reduced->factor[c * n + system->constrained_particle[k]] = 0.0;
  }
}

static void see_elements(struct hk_reduced *reduced) {
  const hooke_system *system = reduced->integrator->system;
  struct hk_element *kept = reduced->element;
  struct hk_elements at;
  if (reduced->element_count == 0) return;
  hk_begin_elements(system, reduced->t, reduced->rows, reduced->rows + 3 * system->particle_count, &at);
  at.kinds = HOOKE_KEPT;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    *kept = *e;
    kept++->k_across = fmax(0.0, e->k_across);
  }
}

void hk_reduced_set(struct hk_reduced *reduced, double t, double alpha, double beta) {
  const hooke_system *system = reduced->integrator->system;
  const struct hk_motion *motion = reduced->integrator->motion;
  reduced->integrator->count.matrices++;
  reduced->t = t;
  reduced->projected = 0;
  reduced->alpha = alpha;
  reduced->beta = beta;
  struct hk_fields fields;
  for (int a = 0; a < 3; a++) {
    fields.q[a] = motion->q[a];
    fields.v[a] = motion->v[a];
  }
  struct hk_run_walk walk;
  hk_begin_runs(system->springs, t, &walk);
  for (const struct hk_run *run; (run = hk_next_run(&walk)) != NULL;) {
    if (!reduced->symmetric || run->shape & HOOKE_RUN_DAMPED)
      (run->curve ? hk_spring_fill_tangent : hk_tangent_fill)(run, &fields, alpha, beta, &reduced->tangent);
  }
  if (reduced->rows) hk_motion_store(motion, reduced->rows, reduced->rows + 3 * motion->n);
  see_elements(reduced);
  fill_diagonal(reduced);
}

/* ---- products ---- */

/* The last rows = (df/dq) dq + (df/dv) dv of those before it, of all forces or of those without loops here.
 */
static int32_t multiply_rows(struct hk_reduced *reduced, int all) {
  hooke_integrator *it = reduced->integrator;
  int32_t stop_value = 0;
  const int32_t status =
      hk_forces_product_in_rows(it->system, reduced->t, all ? 0 : OWN, &reduced->rows, &stop_value);
  if (status == HOOKE_STOPPED) it->stop_value = stop_value;
  return status;
}

static void rows_from_vector(int64_t n, double factor, const double *x, double *rows) {
  for (int64_t p = 0; p < n; p++) {
    for (int a = 0; a < 3; a++)
      rows[3 * p + a] = factor * x[a * n + p];
  }
}

int32_t hk_reduced_change(struct hk_reduced *reduced, const double *dq, const double *dv, double *out) {
  hooke_integrator *it = reduced->integrator;
  const int64_t n = it->system->particle_count, size = it->size;
  rows_from_vector(n, 1.0, dq, reduced->rows + 2 * size);
  rows_from_vector(n, 1.0, dv, reduced->rows + 3 * size);
  it->count.derivative_products++;
  const int32_t status = multiply_rows(reduced, 1);
  double *const component[3] = {out, out + n, out + 2 * n};
  hk_components_from_rows(n, reduced->rows + 4 * size, component);
  return status;
}

/* y -= change of the other forces under alpha x, beta x. */
static int32_t subtract_others(struct hk_reduced *reduced, double alpha, double beta, const double *x,
                               double *y) {
  const int64_t n = reduced->integrator->system->particle_count, size = reduced->integrator->size;
  rows_from_vector(n, alpha, x, reduced->rows + 2 * size);
  rows_from_vector(n, beta, x, reduced->rows + 3 * size);
  const int32_t status = multiply_rows(reduced, 0);
  for (int64_t p = 0; p < n; p++) {
    for (int a = 0; a < 3; a++)
      y[a * n + p] -= reduced->rows[4 * size + 3 * p + a];
  }
  return status;
}

/* out += the matrix without its `diagonal`, times x, for free particles. */
static int32_t add_product(struct hk_reduced *reduced, const double *x, double *out) {
  const hooke_system *system = reduced->integrator->system;
  const int64_t n = system->particle_count;
  const int32_t status = hk_integrator_tell(reduced->integrator);
  if (status != HOOKE_OK) return status;
  reduced->integrator->count.derivative_products++;
  const double *const from[3] = {x, x + n, x + 2 * n};
  double *const to[3] = {out, out + n, out + 2 * n};
  for (int64_t k = 0; k < system->springs->run_count; k++) {
    const struct hk_run *run = &system->springs->run[k];
    if (!reduced->symmetric || run->shape & HOOKE_RUN_DAMPED)
      hk_tangent_product(run, &reduced->tangent, from, to);
  }
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->kind & HOOKE_CONSTANT) row->multiply(system, reduced->alpha, reduced->beta, from, to);
  }
  const int by_element = reduced->symmetric || reduced->projected;
  for (int64_t k = 0; k < reduced->element_count && by_element; k++) {
    const struct hk_element *e = &reduced->element[k];
    const struct hk_element_numbers s = hk_element_combine(e, reduced->alpha, reduced->beta);
    hk_element_multiply(e, s.along, s.across, 1, from, to);
  }
  return reduced->rows_needed && !by_element ? subtract_others(reduced, reduced->alpha, reduced->beta, x, out)
                                             : HOOKE_OK;
}

int32_t hk_reduced_multiply(struct hk_reduced *reduced, const double *x, double *out) {
  hk_apply_diagonal(reduced->integrator->system->particle_count, reduced->diagonal, x, out);
  return add_product(reduced, x, out);
}

/* x = L^-1 x, and out = L^-T x, by blocks. */
static void divide_blocks(const struct hk_reduced *reduced, double *x) {
  const int64_t n = reduced->integrator->system->particle_count;
  hk_apply_factor(n, reduced->factor, x);
  if (reduced->more.count > 0) reduced->more.divide(reduced->more.ctx, x + 3 * n);
}

static void divide_blocks_transposed(const struct hk_reduced *reduced, const double *x, double *out) {
  const int64_t n = reduced->integrator->system->particle_count, count = reduced->more.count;
  hk_apply_factor_transposed(n, reduced->factor, x, out);
  if (count == 0) return;
  memcpy(out + 3 * n, x + 3 * n, (size_t)count * sizeof(double));
  reduced->more.divide_transposed(reduced->more.ctx, out + 3 * n);
}

static int32_t apply(void *ctx, const double *unknown, double *out) {
  struct hk_reduced *reduced = ctx;
  int32_t status;
  if (reduced->more.count > 0) {
    divide_blocks_transposed(reduced, unknown, reduced->place);
    status = reduced->more.multiply(reduced->more.ctx, reduced->place, out);
  } else {
    hk_begin_product(reduced->size / 3, reduced->factor, reduced->diagonal, unknown, reduced->place, out);
    status = add_product(reduced, reduced->place, out);
  }
  divide_blocks(reduced, out);
  return status;
}

/* A power of two that scales numbers whose squares would overflow or underflow to about 1; 1 for all others.
 */
static double scale_of(int64_t size, const double *b) {
  static const double SAFE = 1e100;
  const double most = hk_largest(size, b);
  int exponent;
  if (!(most > 0.0 && most < INFINITY) || (most > 1.0 / SAFE && most < SAFE)) return 1.0;
  frexp(most, &exponent);
  return ldexp(1.0, exponent > -1000 ? -exponent : 1000);
}

static void multiply(int64_t size, double factor, double *x) {
  for (int64_t k = 0; k < size && factor != 1.0; k++)
    x[k] *= factor;
}

static int is_whole(const struct hk_reduced *reduced) {
  return reduced->whole_state == HOOKE_WHOLE_IN_USE;
}

/* out = L^-1 x and out = L^-T x, by all of S in its order where that is factorised, which counts, else by
 * blocks. */
static void forward(struct hk_reduced *reduced, const double *x, double *out) {
  if (is_whole(reduced)) {
    reduced->integrator->count.factor_numbers += hk_factor_numbers(reduced->whole);
    hk_factor_forward(reduced->whole, x, out);
  } else {
    memcpy(out, x, (size_t)reduced->size * sizeof(double));
    divide_blocks(reduced, out);
  }
}

static void backward(struct hk_reduced *reduced, const double *x, double *out) {
  if (is_whole(reduced)) {
    reduced->integrator->count.factor_numbers += hk_factor_numbers(reduced->whole);
    hk_factor_backward(reduced->whole, x, out);
  } else {
    divide_blocks_transposed(reduced, x, out);
  }
}

/* Multiplies by the factor on either side; `unknown` is in its order. */
static int32_t apply_whole(void *ctx, const double *unknown, double *out) {
  struct hk_reduced *reduced = ctx;
  backward(reduced, unknown, reduced->place);
  const int32_t status = hk_reduced_multiply(reduced, reduced->place, reduced->moved);
  forward(reduced, reduced->moved, out);
  return status;
}

static int64_t limit_of(const struct hk_reduced *reduced) {
  const int64_t fraction = reduced->integrator->size / SIZE_SHARE + SPARE_ITERATIONS;
  return fraction < MOST_ITERATIONS ? fraction : MOST_ITERATIONS;
}

/* To this residual or, where `absolute` is a number, to an error (hk_solve_positive). With the factor of S at
 * this place, if that is asked for and S proves positive. */
static int32_t solve(struct hk_reduced *reduced, const double *b, double tolerance, double absolute,
                     double *x, struct hk_solution *solution) {
  const hooke_system *system = reduced->integrator->system;
  const int64_t free_count = system->particle_count - system->constrained_count, limit = limit_of(reduced);
  const int32_t positive = reduced->direct && !is_whole(reduced) ? hk_reduced_factorise(reduced) : 0;
  if (positive < 0) return positive;
  const int whole = is_whole(reduced);
  const struct hk_operator a = {whole ? 3 * free_count : reduced->size, whole ? apply_whole : apply, reduced};
  forward(reduced, b, reduced->right);
  const double scale = scale_of(a.size, reduced->right);
  multiply(a.size, scale, reduced->right);
  const int32_t status =
      isnan(absolute) ? (reduced->symmetric ? hk_solve_symmetric : hk_solve_general)(
                            &a, reduced->right, tolerance, limit, reduced->krylov, reduced->unknown, solution)
                      : hk_solve_positive(&a, reduced->right, tolerance, scale * absolute, limit,
                                          reduced->krylov, reduced->unknown, solution);
  reduced->integrator->count.linear_iterations += solution->iterations;
  backward(reduced, reduced->unknown, x);
  multiply(reduced->size, 1.0 / scale, x);
  return status;
}

int32_t hk_reduced_solve(struct hk_reduced *reduced, const double *b, double tolerance, double *x,
                         struct hk_solution *solution) {
  return solve(reduced, b, tolerance, NAN, x, solution);
}

int32_t hk_reduced_correct(struct hk_reduced *reduced, double share, const double *b, double relative,
                           double absolute, double *x, struct hk_solution *solution) {
  hk_tangent_project(reduced->integrator->system->springs->count, share, &reduced->tangent);
  reduced->projected = 1;
  if (!reduced->direct || share > 0.0) return solve(reduced, b, relative, absolute, x, solution);
  const int32_t status = hk_reduced_solve(reduced, b, DIRECT_RESIDUAL, x, solution);
  solution->converged |= status == HOOKE_OK && solution->residual <= fmax(relative, DIRECT_RESIDUAL);
  return status;
}

double hk_reduced_square(struct hk_reduced *reduced, const double *b) {
  memcpy(reduced->right, b, (size_t)reduced->size * sizeof(double));
  divide_blocks(reduced, reduced->right);
  return hk_dot(reduced->size, reduced->right, reduced->right);
}

double hk_reduced_trace(const struct hk_reduced *reduced) {
  const hooke_system *system = reduced->integrator->system;
  const int64_t n = system->particle_count;
  double sum = 0.0;
  for (int a = 0; a < 3; a++)
    for (int64_t p = 0; p < n; p++)
      sum += system->constrained[p] ? 0.0 : reduced->block[a * n + p];
  return sum;
}

/* ---- all of S ---- */

int32_t hk_reduced_prepare_whole(struct hk_reduced *reduced) {
  if (reduced->whole_state != HOOKE_WHOLE_UNKNOWN) return HOOKE_OK;
  const int32_t status =
      hk_factor_create(reduced->integrator->system, HOOKE_MOST_NUMBERS, reduced->supernodal, &reduced->whole);
  if (status != HOOKE_OK) return status;
  reduced->whole_state = reduced->whole ? HOOKE_WHOLE_READY : HOOKE_WHOLE_NONE;
  if (reduced->whole) reduced->integrator->own_memory += hk_factor_memory(reduced->whole);
  return HOOKE_OK;
}

int32_t hk_reduced_factorise(struct hk_reduced *reduced) {
  const int32_t status = reserve_whole(reduced);
  if (status != HOOKE_OK) return status;
  const struct hk_factor_parts parts = {&reduced->tangent, reduced->element, reduced->alpha, reduced->beta};
  reduced->integrator->count.factor_products += (int64_t)hk_factor_products(reduced->whole);
  const int32_t positive = hk_factor_compute(reduced->whole, reduced->block, &parts);
  reduced->whole_state = positive == 1 ? HOOKE_WHOLE_IN_USE : HOOKE_WHOLE_READY;
  return positive;
}

void hk_reduced_drop_factor(struct hk_reduced *reduced) {
  if (reduced->whole_state == HOOKE_WHOLE_IN_USE) reduced->whole_state = HOOKE_WHOLE_READY;
}

/* ---- few iterations, for an error in a given norm ---- */

int32_t hk_reduced_right(struct hk_reduced *reduced, const double *bq, const double *bv, double *out) {
  const hooke_system *system = reduced->integrator->system;
  const int64_t n = system->particle_count, size = 3 * n;
  const double inverse = 1.0 / reduced->beta;
  for (int64_t k = 0; k < size; k++) {
    const int64_t p = k % n;
    out[k] = system->inertia[p] * (bv[k] + inverse * bq[k]) + system->brake * bq[k];
  }
  const double *const from[3] = {bq, bq + n, bq + 2 * n};
  double *const to[3] = {out, out + n, out + 2 * n};
  struct hk_run_walk walk;
  hk_begin_runs(system->springs, reduced->t, &walk);
  for (const struct hk_run *run; (run = hk_next_run(&walk)) != NULL;) {
    if (run->shape & HOOKE_RUN_DAMPED) hk_tangent_damping(run, &reduced->tangent, from, to);
  }
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->kind & HOOKE_CONSTANT) row->multiply(system, 0.0, 1.0, from, to);
  }
  if (!reduced->rows_needed) return HOOKE_OK;
  return subtract_others(reduced, 0.0, 1.0, bq, out);
}

/* x = S^-1 x, as far as S is factorised. */
static void divide(struct hk_reduced *reduced, double *x) {
  forward(reduced, x, reduced->unknown);
  backward(reduced, reduced->unknown, x);
}

static int32_t apply_weighed(void *ctx, const double *weighed, double *out) {
  struct hk_reduced *reduced = ctx;
  const int64_t size = reduced->integrator->size;
  hk_divide(size, weighed, reduced->weight, reduced->place);
  const int32_t status = hk_reduced_multiply(reduced, reduced->place, out);
  divide(reduced, out);
  hk_multiply(size, reduced->weight, out, out);
  return status;
}

int32_t hk_reduced_minimise(struct hk_reduced *reduced, const double *b, const double *weight,
                            double tolerance, int64_t limit, double *x, struct hk_solution *solution) {
  const int64_t size = reduced->integrator->size;
  const struct hk_operator a = {size, apply_weighed, reduced};
  reduced->weight = weight;
  memcpy(reduced->right, b, (size_t)size * sizeof(double));
  divide(reduced, reduced->right);
  hk_multiply(size, weight, reduced->right, reduced->right);
  const int32_t status = hk_solve_minimal(&a, reduced->right, tolerance, limit, reduced->krylov, x, solution);
  const int64_t spaces = solution->iterations / HOOKE_MINIMAL_SPACE,
                rest = solution->iterations % HOOKE_MINIMAL_SPACE;
  reduced->integrator->count.linear_iterations += solution->iterations;
  reduced->integrator->count.space +=
      (spaces * HOOKE_MINIMAL_SPACE * (HOOKE_MINIMAL_SPACE + 1) + rest * (rest + 1)) / 2;
  hk_divide(size, x, weight, x);
  return status;
}
