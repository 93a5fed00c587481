/* cvode_ranks.c: runs a scene over MPI ranks by CVODE (BDF, GMRES), with one result for any number of ranks.
 *
 *   mpirun -n 4 cvode_ranks SCENE [--duration TIME] [--rtol NUMBER] [--atol LENGTH] [--sum stock] [--owners
 * SEED]
 *
 * The vectors are SUNDIALS' own parallel ones; forces and their derivative are hooke's. The stock sum of a
 * dot product depends on how many ranks add up, and CVODE chooses steps by it, so that every number of ranks
 * has another result. Here it is replaced by one in whole numbers, which has no order; --sum stock keeps
 * SUNDIALS'. It prints what CVODE did, and a check value of the final positions and velocities. */
#include "split.h"

#include <cvode/cvode.h>
#include <math.h>
#include <nvector/nvector_parallel.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sunlinsol/sunlinsol_spgmr.h>

struct problem {
  struct split split;
  const double *inverse_mass;
  double *q, *v, *dq, *dv, *out; /* of the particles of this rank, ghosts included */
};

/* ---- a sum without order ---- */

/* Each product is split at three scales into whole numbers, which add up alike in any order. What is below
 * the last one, 2^-78 of the largest product, is left out of each product by itself. */
enum { SCALES = 3, BITS = 26 };

static MPI_Comm sum_over;

static void split_up(double product, int exponent, int64_t whole[SCALES]) {
  for (int l = 0; l < SCALES; l++) {
    const int bits = BITS * (l + 1) - exponent;
    const double part = rint(ldexp(product, bits));
    whole[l] += (int64_t)part;
    product -= ldexp(part, -bits);
  }
}

/* The sum of x y, or of its squares. */
static double sum_of(N_Vector x, N_Vector y, int squares) {
  const double *a = N_VGetArrayPointer(x), *b = N_VGetArrayPointer(y);
  const int64_t count = NV_LOCLENGTH_P(x);
  int64_t own[SCALES] = {0}, whole[SCALES];
  double largest = 0.0, most, sum = 0.0;
  int exponent;
  for (int64_t k = 0; k < count; k++) {
    const double product = fabs(a[k] * b[k]), term = squares ? product * product : product;
    if (!(term <= largest)) largest = term; /* NaN, too */
  }
  if (!(largest < INFINITY)) largest = INFINITY;
  split_reduce(sum_over, &largest, &most, 1, MPI_DOUBLE, MPI_MAX);
  if (!(most > 0.0 && most < INFINITY)) return most;
  frexp(most, &exponent);
  for (int64_t k = 0; k < count; k++) {
    const double product = a[k] * b[k];
    split_up(squares ? product * product : product, exponent, own);
  }
  split_reduce(sum_over, own, whole, SCALES, MPI_INT64_T, MPI_SUM);
  for (int l = SCALES; l-- > 0;)
    sum += ldexp((double)whole[l], exponent - BITS * (l + 1));
  return sum;
}

static double dot(N_Vector x, N_Vector y) {
  return sum_of(x, y, 0);
}

static double weighted_norm(N_Vector x, N_Vector weight) {
  return sqrt(sum_of(x, weight, 1) / (double)NV_GLOBLENGTH_P(x));
}

/* Vectors that CVODE makes from this one have its functions. */
static void replace_sums(N_Vector y) {
  y->ops->nvdotprod = dot;
  y->ops->nvwrmsnorm = weighted_norm;
  y->ops->nvdotprodlocal = NULL;
  y->ops->nvwsqrsumlocal = NULL;
  y->ops->nvdotprodmulti = NULL;
  y->ops->nvdotprodmultilocal = NULL;
}

/* ---- the equations: y has the positions of what the rank owns, then the velocities ---- */

static void spread(struct split *s, const double *y, double *q, double *v) {
  double *to[] = {q, v};
  const size_t row = 3 * sizeof(double);
  for (int a = 0; a < 2; a++) {
    for (int64_t k = 0; k < s->own; k++)
      memcpy(to[a] + 3 * s->mine[k], y + 3 * (a * s->own + k), row);
    for (int64_t k = 0; k < s->gives; k++)
      memcpy(s->given + 3 * (a * s->gives + k), to[a] + 3 * s->give[k], row);
  }
  split_trade(s);
  for (int a = 0; a < 2; a++)
    for (int64_t k = 0; k < s->gets; k++)
      memcpy(to[a] + 3 * s->get[k], s->got + 3 * (a * s->gets + k), row);
}

/* Rates of positions are `v`, of velocities `factor` times `out`. */
static void gather(const struct problem *p, const double *v, int is_force, double *rate) {
  const struct split *s = &p->split;
  for (int64_t k = 0; k < 3 * s->own; k++) {
    const int64_t at = 3 * s->mine[k / 3] + k % 3;
    const double w = p->inverse_mass[s->mine[k / 3]];
    rate[k] = w == 0.0 ? 0.0 : v[at];
    rate[3 * s->own + k] = is_force ? w * p->out[at] : p->out[at];
  }
}

static int rate(double t, N_Vector y, N_Vector dot_y, void *ctx) {
  struct problem *p = ctx;
  spread(&p->split, N_VGetArrayPointer(y), p->q, p->v);
  if (hooke_system_acceleration(p->split.system, t, p->q, p->v, p->out) != HOOKE_OK) return -1;
  gather(p, p->v, 0, N_VGetArrayPointer(dot_y));
  return 0;
}

static int product(N_Vector x, N_Vector jx, double t, N_Vector y, N_Vector fy, void *ctx, N_Vector scratch) {
  struct problem *p = ctx;
  (void)fy, (void)scratch;
  spread(&p->split, N_VGetArrayPointer(y), p->q, p->v);
  spread(&p->split, N_VGetArrayPointer(x), p->dq, p->dv);
  if (hooke_system_derivative_product(p->split.system, t, p->q, p->v, p->dq, p->dv, p->out) != HOOKE_OK)
    return -1;
  gather(p, p->dv, 1, N_VGetArrayPointer(jx));
  return 0;
}

/* ---- the run ---- */

/* The same for any order of the numbers, each of which is mixed with its place. */
static uint64_t check_value(const struct split *s, const double *y) {
  uint64_t value = 0, all = 0;
  for (int64_t k = 0; k < 6 * s->own; k++) {
    uint64_t bits,
        place = (uint64_t)(3 * s->global[s->mine[k / 3 % s->own]] + k % 3 + k / (3 * s->own) * 3 * s->n);
    memcpy(&bits, y + k, sizeof bits);
    bits = (bits ^ place * 0x9E3779B97F4A7C15u) * 0xD6E8FEB86659FD93u;
    value ^= (bits ^ bits >> 32) * 0xD6E8FEB86659FD93u;
  }
  MPI_Allreduce(&value, &all, 1, MPI_UINT64_T, MPI_BXOR, s->all);
  return all;
}

static N_Vector initial_vector(const struct problem *p, const hooke_state *state, SUNContext context) {
  const struct split *s = &p->split;
  N_Vector y = N_VNew_Parallel(s->all, 6 * s->own, 6 * s->n, context);
  for (int64_t k = 0; k < 3 * s->own && y; k++) {
    const int64_t at = 3 * s->global[s->mine[k / 3]] + k % 3;
    N_VGetArrayPointer(y)[k] = hooke_state_position((hooke_state *)state)[at];
    N_VGetArrayPointer(y)[3 * s->own + k] = hooke_state_velocity((hooke_state *)state)[at];
  }
  return y;
}

static int solve(struct problem *p, const hooke_state *state, const hooke_options *options, int stock) {
  SUNContext context;
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_Create(p->split.all, &context);
#else
  SUNContext_Create(&p->split.all, &context);
#endif
  N_Vector y = initial_vector(p, state, context);
  if (!stock) replace_sums(y);
  SUNLinearSolver solver = SUNLinSol_SPGMR(y, SUN_PREC_NONE, 30, context);
  void *cvode = CVodeCreate(CV_BDF, context);
  double t;
  long steps = 0, products = 0;
  CVodeInit(cvode, rate, 0.0, y);
  CVodeSetUserData(cvode, p);
  CVodeSStolerances(cvode, hooke_options_number(options, "rtol"), hooke_options_number(options, "atol"));
  CVodeSetLinearSolver(cvode, solver, NULL);
  CVodeSetJacTimes(cvode, NULL, product);
  CVodeSetMaxNumSteps(cvode, 1000000);
  const int flag = CVode(cvode, hooke_options_number(options, "duration"), y, &t, CV_NORMAL);
  CVodeGetNumSteps(cvode, &steps);
  CVodeGetNumJtimesEvals(cvode, &products);
  const uint64_t value = check_value(&p->split, N_VGetArrayPointer(y));
  if (p->split.rank == 0)
    printf(
        "%d ranks, %s sum: CVODE returned %d at t = %g s after %ld steps and %ld derivative products; check value "
        "%016llx\n",
        p->split.ranks, stock ? "stock" : "exact", flag, t, steps, products, (unsigned long long)value);
  CVodeFree(&cvode);
  SUNLinSolFree(solver);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return flag;
}

/* Held particles stay where they are: a motion of theirs would need its velocity in `rate`. */
static int32_t check_scene(const hooke_scene *scene, const hooke_system *system) {
  const int driven = strstr(hooke_scene_text(scene, "text"), "\"driven\"") != NULL;
  if (!driven && strcmp(hooke_system_dynamics(system), "inertial") == 0) return HOOKE_OK;
  fprintf(stderr, "%s: this program takes scenes with inertia, and without driven particles\n",
          hooke_scene_text(scene, "title"));
  return HOOKE_UNSUITED;
}

int main(int argc, char **argv) {
  MPI_Init(&argc, &argv);
  int stock = 0, flag = 0;
  unsigned seed = 0;
  struct problem p = {.q = NULL};
  hooke_scene *scene = NULL;
  hooke_state *state = NULL;
  hooke_integrator *serial = NULL; /* fills in options */
  int32_t status = hooke_scene_load(argc > 1 ? argv[1] : "", NULL, &scene);
  hooke_options *run = status == HOOKE_OK ? hooke_scene_run_options(scene) : NULL;
  if (status == HOOKE_OK) status = hooke_options_set_text(run, "method", "cvode-bdf");
  for (int k = 2; k + 1 < argc && status == HOOKE_OK; k += 2) {
    if (strcmp(argv[k], "--sum") == 0)
      stock = strcmp(argv[k + 1], "stock") == 0;
    else if (strcmp(argv[k], "--owners") == 0)
      seed = (unsigned)atoi(argv[k + 1]);
    else
      status = hooke_options_set_text(run, argv[k] + 2, argv[k + 1]);
  }
  if (status == HOOKE_OK) status = hooke_scene_commit(scene);
  hooke_system *whole = status == HOOKE_OK ? hooke_scene_system(scene) : NULL;
  if (status == HOOKE_OK) status = hooke_state_create(whole, &state);
  if (status == HOOKE_OK) status = hooke_integrator_create(whole, run, &serial);
  if (status == HOOKE_OK) status = check_scene(scene, whole);
  if ((status = split_agree(MPI_COMM_WORLD, status)) == HOOKE_OK)
    status = split_agree(MPI_COMM_WORLD,
                         split_make(MPI_COMM_WORLD, whole, hooke_state_position(state), 1, seed, &p.split));
  if (status == HOOKE_OK) {
    double *rows = split_zeros(15 * p.split.count, sizeof *rows), **of[] = {&p.q, &p.v, &p.dq, &p.dv, &p.out};
    for (int k = 0; k < 5; k++)
      *of[k] = rows + 3 * k * p.split.count;
    p.inverse_mass = hooke_system_inverse_mass(p.split.system);
    sum_over = p.split.all;
    flag = solve(&p, state, hooke_integrator_options(serial), stock);
    free(rows);
    split_release(&p.split);
  }
  MPI_Finalize();
  return status != HOOKE_OK ? 3 : flag < 0 ? 4 : 0;
}
