/* The linear equations (1 - gamma J) (dq, dv) = (b_q, b_v) of an implicit method of SUNDIALS, solved through
 * the 3n equations of integrate/solve/reduced.h with exact products, by GMRES in the norm of the method's
 * error weights: by a solver "with the matrix embedded", which is called at every Newton iteration
 * and finds state and gamma by itself, so that its products are always current. S is kept as long as that
 * costs fewer iterations than a new factor. */
#if HOOKE_HAVE_SUNDIALS

#include "integrate/solve/sundials_problem.h"

#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/reduced.h"
#include "model/force/spring.h"

#include <math.h>
#include <string.h>
#include <sundials/sundials_linearsolver.h>
#include <sunlinsol/sunlinsol_spgmr.h>

/* Measured nanoseconds; only their ratios count: a product for each spring and each element of another force,
 * a vector operation for each number, a solve with a factor for each of its numbers, a factor for each of its
 * multiplications. */
static const double OF_SPRING = 3.0, OF_UNKNOWN = 0.3, OF_NUMBER = 0.7, OF_PRODUCT = 0.84, OF_ELEMENT = 150.0;
/* Vector operations of an iteration of GMRES, and for each vector of its space. */
static const double VECTORS = 10.0, VECTORS_OF_SPACE = 1.0;
/* Solves of a Newton correction with a current factor. */
static const double SOLVES_OF_FACTOR = 2.0;
/* The analysis waits for so many iterations by blocks. */
static const double MANY = 160.0;
/* With a factor the residual is the error, and the fraction that SUNDIALS allows suffices. */
static const double LOOSER = 5.0;
enum { MOST_ITERATIONS = 300 };

struct solver {
  hooke_integrator *integrator;
  int32_t by_blocks;         /* by the option */
  struct hk_reduced reduced; /* `direct` by it, too; neither: chosen by cost */
  N_Vector weight;
  double *numbers; /* the next five, for all particles: b_q, b_v or dv, right-hand side or z, weights of z */
  double *bq, *bv, *right, *z, *z_weight;
  int32_t direct, may_be_direct; /* S is factorised as a whole, or may be later */
  int64_t solves;                /* since the start, or since the last factor */
  double fresh, by_blocks_alone; /* iterations: with a new factor, and all of those by blocks */
  double excess;                 /* savings that a new factor would have made since then */
  int iterations;
};

static struct solver *solver_of(SUNLinearSolver linear) {
  return linear->content;
}

static const struct hk_unknowns *unknowns_of(const hooke_integrator *it) {
  return &((const struct hk_sundials *)it->own)->unknowns;
}

/* ---- choice of S ---- */

static void forget(struct solver *s) {
  hk_reduced_drop_factor(&s->reduced);
  s->direct = s->reduced.direct;
  s->may_be_direct = !s->by_blocks;
  s->solves = 0;
  s->fresh = s->excess = s->by_blocks_alone = 0.0;
}

/* Sets S at the current point, if due; if it is not positive, its blocks are used from now on. */
static int32_t renew(struct solver *s, int due) {
  if (!s->direct || !due) return HOOKE_OK;
  const int32_t positive = hk_reduced_factorise(&s->reduced);
  if (positive < 0) return positive;
  s->direct = s->may_be_direct = positive;
  s->solves = 0;
  s->excess = 0.0;
  return HOOKE_OK;
}

static double cost_by_blocks(const struct solver *s, double iterations) {
  const double vectors = VECTORS + VECTORS_OF_SPACE * fmin(iterations, HOOKE_MINIMAL_SPACE);
  return iterations * ((OF_SPRING * (double)s->integrator->system->springs->count +
                        OF_ELEMENT * (double)s->reduced.element_count) +
                       vectors * OF_UNKNOWN * (double)s->integrator->size);
}

static double cost_of_solve(const struct solver *s) {
  return OF_NUMBER * (double)hk_factor_numbers(s->reduced.whole);
}

/* The savings of a new factor would have reached its cost. This is decided after the fact, and so costs at
 * most twice the best choice. */
static int is_due(const struct solver *s) {
  return s->excess > OF_PRODUCT * hk_factor_products(s->reduced.whole);
}

/* Decides whether the next solves should use a new factor; by counts alone, so that runs repeat to the bit.
 */
static int32_t learn(struct solver *s, const struct hk_solution *solution) {
  const double iterations = (double)solution->iterations;
  s->solves++;
  if (s->direct) {
    if (s->solves == 1) s->fresh = iterations;
    s->excess += fmax(0.0, iterations - s->fresh) * cost_of_solve(s);
    return HOOKE_OK;
  }
  s->by_blocks_alone += iterations;
  if (!s->may_be_direct || (solution->converged && s->by_blocks_alone < MANY)) return HOOKE_OK;
  const int32_t status = hk_reduced_prepare_whole(&s->reduced);
  if (status != HOOKE_OK || s->reduced.whole == NULL) return status;
  s->excess += cost_by_blocks(s, iterations) - SOLVES_OF_FACTOR * cost_of_solve(s);
  s->excess = fmax(0.0, s->excess);
  s->direct = !solution->converged || is_due(s);
  if (s->direct) s->solves = 0;
  return HOOKE_OK;
}

/* ---- one solve ---- */

/* Copies b to vectors of all particles, and the weights of z: |(gamma z, z)| in the weights of q and v. Of an
 * overdamped system (M - gamma K) z = M b, with M its friction, and z is dq. */
static int32_t take(struct solver *s, N_Vector b, double gamma) {
  const struct hk_unknowns *u = unknowns_of(s->integrator);
  const hooke_system *system = s->integrator->system;
  const int64_t n = system->particle_count, m = u->free_count;
  const double *w = N_VGetArrayPointer(s->weight), *from = N_VGetArrayPointer(b);
  if (!u->has_v) {
    hk_unknowns_spread(u, from, s->right, n);
    hk_unknowns_spread(u, w, s->z_weight, n);
    for (int64_t k = 0; k < 3 * n; k++)
      s->right[k] *= system->constrained[k % n] ? 0.0 : system->inertia[k % n];
    return HOOKE_OK;
  }
  hk_unknowns_spread(u, from, s->bq, n);
  hk_unknowns_spread(u, from + 3 * m, s->bv, n);
  double *some = s->right; /* room for 3 m */
  for (int64_t k = 0; k < 3 * m; k++)
    some[k] = sqrt((gamma * w[k]) * (gamma * w[k]) + w[3 * m + k] * w[3 * m + k]);
  hk_unknowns_spread(u, some, s->z_weight, n);
  return hk_reduced_right(&s->reduced, s->bq, s->bv, s->right);
}

/* dq = gamma z, dv = z - b_q/gamma. */
static void give(struct solver *s, double gamma, N_Vector x) {
  const struct hk_unknowns *u = unknowns_of(s->integrator);
  const int64_t n = s->integrator->system->particle_count;
  double *to = N_VGetArrayPointer(x);
  for (int64_t k = 0; k < 3 * n && u->has_v; k++) {
    s->bv[k] = s->z[k] - s->bq[k] / gamma;
    s->z[k] *= gamma;
  }
  hk_unknowns_gather(u, s->z, n, to);
  if (u->has_v) hk_unknowns_gather(u, s->bv, n, to + 3 * u->free_count);
}

/* The largest ratio of a block of S to its mass. For soft directions the residual scaled by blocks is smaller
 * than the error by up to this factor; its root was found to compensate for that. */
static double stiffest(const struct solver *s) {
  const hooke_system *system = s->integrator->system;
  const int64_t n = system->particle_count;
  const double *block = s->reduced.block;
  double most = 1.0;
  for (int64_t p = 0; p < n; p++)
    most = fmax(most, (block[p] + block[n + p] + block[2 * n + p]) * system->inverse_mass[p]);
  return most;
}

static int32_t minimise(struct solver *s, double tolerance, struct hk_solution *solution) {
  const int32_t status = hk_reduced_minimise(&s->reduced, s->right, s->z_weight,
                                             s->direct ? LOOSER * tolerance : tolerance / sqrt(stiffest(s)),
                                             MOST_ITERATIONS, s->z, solution);
  s->iterations += (int)solution->iterations;
  return status == HOOKE_OK ? learn(s, solution) : status;
}

/* Repeats the solve with a new factor, if the current one is old or there was none. */
static int32_t find(struct solver *s, double tolerance, struct hk_solution *solution) {
  int32_t status = renew(s, s->direct && (s->solves == 0 || is_due(s)));
  if (status == HOOKE_OK) status = minimise(s, tolerance, solution);
  if (status != HOOKE_OK || solution->converged || !s->direct || s->solves == 1) return status;
  status = renew(s, 1);
  return status == HOOKE_OK ? minimise(s, tolerance, solution) : status;
}

/* The flag that the solver gets for a failure; it has one for all of them. */
static int failed(struct hk_sundials *own, int32_t status) {
  if (status == HOOKE_NO_MEMORY) own->no_memory = 1;
  return SUNLS_ATIMES_FAIL_UNREC;
}

static int solve(SUNLinearSolver linear, SUNMatrix matrix, N_Vector x, N_Vector b, sunrealtype tolerance) {
  (void)matrix;
  struct solver *s = solver_of(linear);
  hooke_integrator *it = s->integrator;
  struct hk_sundials *own = it->own;
  sunrealtype t, gamma;
  N_Vector y;
  s->iterations = 0;
  if (own->where(own->memory, &t, &gamma, &y) != 0) return SUNLS_ATIMES_FAIL_UNREC;
  int32_t status = hk_unknowns_place(it, &own->unknowns, t, N_VGetArrayPointer(y));
  if (status != HOOKE_OK) return failed(own, status);
  const int32_t has_v = own->unknowns.has_v;
  hk_reduced_set(&s->reduced, t, has_v ? gamma * gamma : gamma, has_v ? gamma : 0.0);
  struct hk_solution solution;
  status = take(s, b, gamma);
  if (status == HOOKE_OK) status = find(s, tolerance, &solution);
  if (status != HOOKE_OK) return failed(own, status);
  give(s, gamma, x);
  return solution.converged ? SUN_SUCCESS : SUNLS_CONV_FAIL;
}

/* ---- the object ---- */

static SUNLinearSolver_Type type_of(SUNLinearSolver linear) {
  (void)linear;
  return SUNLINEARSOLVER_MATRIX_EMBEDDED;
}

static int take_weights(SUNLinearSolver linear, N_Vector left, N_Vector right) {
  (void)right;
  solver_of(linear)->weight = left;
  return SUN_SUCCESS;
}

static int iterations_of(SUNLinearSolver linear) {
  return solver_of(linear)->iterations;
}

static int release(SUNLinearSolver linear) {
  struct solver *s = solver_of(linear);
  if (s) {
    hk_reduced_release(&s->reduced);
    hk_free(s->numbers);
    hk_free(s);
  }
  linear->content = NULL;
  SUNLinSolFreeEmpty(linear);
  return SUN_SUCCESS;
}

static int32_t fill(hooke_integrator *it, const char *word, struct solver *s) {
  const int64_t size = it->size;
  s->integrator = it;
  s->numbers = hk_new(5 * size, sizeof(double));
  if (s->numbers == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += 5 * size * (int64_t)sizeof(double);
  s->bq = s->numbers;
  s->bv = s->bq + size;
  s->right = s->bv + size;
  s->z = s->right + size;
  s->z_weight = s->z + size;
  for (int64_t k = 0; k < size; k++)
    s->z_weight[k] = 1.0;
  int32_t status = hk_reduced_create(it, HOOKE_REDUCED_MINIMAL, NULL, &s->reduced);
  s->by_blocks = strcmp(word, "blocks") == 0;
  it->may_factor = strcmp(word, "auto") == 0;
  forget(s);
  return status;
}

static int32_t create_own(hooke_integrator *it, const char *word, struct hk_sundials *own) {
  SUNLinearSolver linear = SUNLinSolNewEmpty(own->context);
  if (linear == NULL) return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for %s", it->method->name);
  own->linear = linear;
  linear->ops->gettype = type_of;
  linear->ops->setscalingvectors = take_weights;
  linear->ops->solve = solve;
  linear->ops->numiters = iterations_of;
  linear->ops->free = release;
  linear->content = hk_new(1, sizeof(struct solver));
  return linear->content ? fill(it, word, linear->content) : HOOKE_NO_MEMORY;
}

int32_t hk_sundials_linear_create(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  const char *word = hooke_options_text(it->options, "linear_solver");
  const int32_t status = hk_factor_require(it->options);
  if (status != HOOKE_OK) return status;
  /* a space that holds every unknown is exact without it */
  const int32_t few = 6 * own->unknowns.free_count <= HOOKE_KRYLOV_VECTORS;
  if (own->unknowns.rows && strcmp(word, "gmres") != 0 && !(few && strcmp(word, "auto") == 0))
    return create_own(it, word, own);
  own->linear = SUNLinSol_SPGMR(own->y, SUN_PREC_NONE, HOOKE_KRYLOV_VECTORS, own->context);
  it->own_memory += HOOKE_KRYLOV_VECTORS * own->unknowns.size * (int64_t)sizeof(double);
  if (own->linear) return HOOKE_OK;
  return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for %s", it->method->name);
}

int32_t hk_sundials_linear_is_own(const hooke_integrator *it) {
  const struct hk_sundials *own = it->own;
  return own->linear && own->linear->ops->solve == solve;
}

void hk_sundials_linear_begin(hooke_integrator *it) {
  const struct hk_sundials *own = it->own;
  if (hk_sundials_linear_is_own(it)) forget(solver_of(own->linear));
}

#else
typedef int hk_sundials_linear_is_not_built;
#endif
