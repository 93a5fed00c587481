/* The linear equations of implicit steps compared with products of the model's own derivative. */
#include "check.h"
#include "integrate/solve/reduced.h"
#include "law_scene.h"
#include "random.h"
#include "random_scene.h"
#include "run.h"

#include <math.h>
#include <string.h>

/* Rows of x y z and x, y, z apart. */
static void apart(int64_t n, const double *rows, double *vector) {
  for (int64_t k = 0; k < 3 * n; k++)
    vector[k % 3 * n + k / 3] = rows[k];
}

static void rows_of(int64_t n, const double *vector, double *rows) {
  for (int64_t k = 0; k < 3 * n; k++)
    rows[k] = vector[k % 3 * n + k / 3];
}

/* The defect of x in (M - beta df/dv - alpha df/dq) x = b over the free particles, over the largest of b. */
static double defect(const hooke_system *system, const double *q, const double *v, double alpha, double beta,
                     const double *b, const double *x) {
  const int64_t n = hooke_system_particle_count(system), size = 3 * n;
  const double *mass = hooke_system_mass(system), *w = hooke_system_inverse_mass(system);
  double *dq = new_doubles(size), *dv = new_doubles(size), *out = new_doubles(size), worst = 0.0;
  rows_of(n, x, dq);
  for (int64_t k = 0; k < size; k++) {
    dv[k] = beta * dq[k];
    dq[k] *= alpha;
  }
  check_ok(hooke_system_derivative_product(system, 0.25, q, v, dq, dv, out));
  for (int64_t k = 0; k < size; k++) {
    const int64_t j = k % 3 * n + k / 3;
    if (w[k / 3] == 0.0)
      assert_true(x[j] == 0.0);
    else
      worst = fmax(worst, fabs(mass[k / 3] * x[j] - out[k] - b[j]));
  }
  free(dq);
  free(dv);
  free(out);
  return worst / largest(size, b);
}

static void check_solution(const hooke_system *system, const double *q, const double *v, double alpha,
                           double beta, double rounding) {
  const int64_t n = hooke_system_particle_count(system), size = 3 * n;
  struct random_source source = {17};
  owned_doubles *b = new_doubles(size), *x = new_doubles(size);
  owned_integrator *integrator = start_with(system, .method = "verlet", .step = 1.0);
  struct hk_reduced reduced;
  struct hk_solution solution;
  for (int64_t k = 0; k < size; k++)
    b[k] = system->constrained[k % n] ? 0.0 : random_between(&source, -1.0, 1.0);
  hk_motion_load(system, integrator->motion, q, v);
  const int32_t symmetric = alpha == 0.0 && system->force == NULL && !hk_system_is_not_linear(system);
  check_ok(hk_reduced_create(integrator, symmetric ? HOOKE_REDUCED_SYMMETRIC : HOOKE_REDUCED_GENERAL, NULL,
                             &reduced));
  hk_reduced_set(&reduced, 0.25, alpha, beta);
  check_ok(hk_reduced_solve(&reduced, b, 1e-13, x, &solution));
  assert_true(solution.converged);
  const double wrong = defect(system, q, v, alpha, beta, b, x);
  if (!(wrong <= rounding)) check_failed("alpha %g, beta %g: defect %g", alpha, beta, wrong);
  assert_int_equal(hooke_integrator_count(integrator, "linear_iterations"), solution.iterations);
  assert_true(hooke_integrator_count(integrator, "derivative_products") >= solution.iterations);
  /* the change by the derivatives along two directions at once */
  double *dq = new_doubles(2 * size), *dv = dq + size, *found = new_doubles(3 * size),
         *expected = found + size;
  double *rows = expected + size;
  if (!reduced.symmetric) {
    check_ok(hk_reduced_change(&reduced, b, x, found));
    rows_of(n, b, dq);
    rows_of(n, x, dv);
    check_ok(hooke_system_derivative_product(system, 0.25, q, v, dq, dv, rows));
    apart(n, rows, expected);
    check_between(largest_difference(size, found, expected), 0.0, 1e-14 * largest(size, expected));
  }
  free(dq);
  free(found);
  hk_reduced_release(&reduced);
}

static const double weights[][2] = {{0.0, 0.01},  {0.0, 0.5},  {1e-4, 1e-2},
                                    {4e-4, 2e-2}, {1e-3, 0.0}, {0.0, 0.0}};
enum { WEIGHTS = sizeof weights / sizeof weights[0] };

TEST(every_law) {
  for (int l = 0; l < LAW_COUNT; l++) {
    struct law_scene scene;
    if (laws[l].obstacles && laws[l].damped) continue; /* friction by N is not symmetric */
    law_scene_create(&laws[l], 31, &scene);
    /* difference quotients replace a callback's derivative: accurate to 1e-9 or so */
    const double rounding = laws[l].callback == 1 ? 1e-7 : 1e-11;
    for (int k = 0; k < WEIGHTS; k++)
      check_solution(scene.system, scene.q, scene.v, weights[k][0], weights[k][1], rounding);
    law_scene_destroy(&scene);
  }
}

TEST(random_scenes) {
  for (int32_t k = 0; k < 40; k++) {
    owned_random_scene scene;
    random_scene_with(&scene, .seed = (uint64_t)(500 + k), .particles = 20 + 13 * k, .springs = 60 + 20 * k,
                      .triples = k % 3 * 40, .tetrahedra = k % 4 * 10, .anchors = k % 3 * 4,
                      .features = k * 37 & SCENE_EVERYTHING, .cloth = {k % 9 + 2, 9}, .with_product = 1);
    const int64_t size = 3 * hooke_system_particle_count(scene.system);
    owned_doubles *q = new_doubles(size), *v = new_doubles(size);
    random_scene_shake(&scene, 7, q, v);
    check_solution(scene.system, q, v, 0.0, 5e-4, 1e-10);
    check_solution(scene.system, q, v, 1e-6, 1e-3, 1e-10);
  }
}
