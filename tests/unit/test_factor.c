/* The sparse factor of S compared with S itself, computed column by column from its definition; and GMRES. */
#include "check.h"
#include "integrate/solve/factor_cholmod.h"
#include "integrate/solve/krylov.h"
#include "integrate/solve/reduced.h"
#include "random.h"
#include "random_scene.h"
#include "run.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

struct bench {
  struct random_scene scene;
  hooke_integrator *integrator;
  struct hk_reduced reduced;
  int64_t n;
};

static void set_up(struct random_scene_request request, double alpha, double beta, struct bench *bench) {
  random_scene_create(request, &bench->scene);
  const hooke_system *system = bench->scene.system;
  bench->n = hooke_system_particle_count(system);
  double *q = new_doubles(6 * bench->n), *v = q + 3 * bench->n;
  random_scene_shake(&bench->scene, 7, q, v);
  bench->integrator = start_with(system, .method = "verlet", .step = 1.0);
  hk_motion_load(system, bench->integrator->motion, q, v);
  check_ok(hk_reduced_create(bench->integrator, HOOKE_REDUCED_MINIMAL, NULL, &bench->reduced));
  hk_reduced_set(&bench->reduced, 0.25, alpha, beta);
  free(q);
}

static void tear_down(struct bench *bench) {
  hk_reduced_release(&bench->reduced);
  hooke_integrator_destroy(bench->integrator);
  random_scene_destroy(&bench->scene);
}

/* A K + b C of altitude springs along their directions, by definition. */
static void multiply_altitude(const struct bench *bench, const double *x, double *out) {
  const hooke_system *system = bench->scene.system;
  const int64_t n = bench->n;
  double *q = new_doubles(6 * n), *v = q + 3 * n;
  hk_motion_store(bench->integrator->motion, q, v);
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes->tetrahedron[k];
    struct hk_tautness s;
    double along = 0.0;
    if (!hk_tautness_find(t, q, v, &s) || s.slack) continue;
    for (int j = 0; j < 4; j++) {
      for (int a = 0; a < 3; a++)
        along += s.altitude.weight[j] * s.altitude.u[a] * x[a * n + t->particle[j]];
    }
    along *=
        (bench->reduced.alpha * t->stiffness + bench->reduced.beta * t->damping) / t->rest[s.altitude.choice];
    for (int j = 0; j < 4; j++) {
      for (int a = 0; a < 3; a++)
        out[a * n + t->particle[j]] += s.altitude.weight[j] * s.altitude.u[a] * along;
    }
  }
  free(q);
}

/* And of anchors, without the rotation term of a damped one. */
static void multiply_anchors(const struct bench *bench, const double *x, double *out) {
  const struct canonical *c = &bench->scene.canonical;
  const struct hk_motion *m = bench->integrator->motion;
  const double alpha = bench->reduced.alpha, beta = bench->reduced.beta;
  for (int64_t k = 0; k < c->anchor_count; k++) {
    const int64_t p = c->anchored[k], n = bench->n;
    double u[3], length = 0.0, rate = 0.0, along = 0.0;
    for (int a = 0; a < 3; a++) {
      u[a] = m->q[a][p] - c->anchor_point[3 * k + a];
      length += u[a] * u[a];
    }
    length = sqrt(length);
    for (int a = 0; a < 3; a++) {
      u[a] /= length;
      rate += u[a] * m->v[a][p];
      along += u[a] * x[a * n + p];
    }
    const double tension = c->anchor[0][k] * (length - c->anchor[2][k]) + c->anchor[1][k] * rate;
    const double across = fmax(0.0, alpha * tension / length);
    const double axial = alpha * c->anchor[0][k] + beta * c->anchor[1][k];
    for (int a = 0; a < 3; a++)
      out[a * n + p] += axial * along * u[a] + across * (x[a * n + p] - along * u[a]);
  }
}

/* out = S x over the free particles, spring by spring. */
static void multiply(const struct bench *bench, const double *x, double *out) {
  const hooke_system *system = bench->scene.system;
  const struct hk_motion *m = bench->integrator->motion;
  const double alpha = bench->reduced.alpha, beta = bench->reduced.beta;
  const int64_t n = bench->n;
  for (int64_t k = 0; k < 3 * n; k++)
    out[k] = (system->mass[k % n] + beta * system->drag) * x[k];
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const struct hk_run *run = &system->springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring s = hk_run_spring(run, k);
      double u[3], d[3], length = 0.0, rate = 0.0, along = 0.0;
      for (int a = 0; a < 3; a++) {
        u[a] = m->q[a][s.head] - m->q[a][s.tail];
        d[a] = x[a * n + s.head] - x[a * n + s.tail];
        length += u[a] * u[a];
      }
      length = sqrt(length);
      for (int a = 0; a < 3; a++) {
        if (length > 0.0) u[a] /= length;
        rate += u[a] * (m->v[a][s.head] - m->v[a][s.tail]);
        along += u[a] * d[a];
      }
      const double tension = s.kappa * (length - s.rest_length) + s.gamma * rate;
      if (s.pull_only && (length <= s.rest_length || tension < 0.0)) continue;
      double across = length > 0.0 ? fmax(0.0, alpha * tension / length) : 0.0,
             axial = alpha * s.kappa + beta * s.gamma;
      if (length == 0.0) axial = across = s.rest_length == 0.0 && !s.pull_only ? alpha * s.kappa : 0.0;
      for (int a = 0; a < 3; a++) {
        const double force = axial * along * u[a] + across * (d[a] - along * u[a]);
        out[a * n + s.head] += force;
        out[a * n + s.tail] -= force;
      }
    }
  }
  struct hk_triple t;
  for (struct hk_triples at = {&system->rest->bending, 0, 0}; hk_next_triple(&at, &t);) {
    for (int a = 0; a < 3; a++) {
      const double *c = x + a * n;
      const double bend = c[t.particle[0]] - 2.0 * c[t.particle[1]] + c[t.particle[2]];
      out[a * n + t.particle[0]] += alpha * t.coefficient * bend;
      out[a * n + t.particle[1]] -= 2.0 * alpha * t.coefficient * bend;
      out[a * n + t.particle[2]] += alpha * t.coefficient * bend;
    }
  }
  multiply_altitude(bench, x, out);
  multiply_anchors(bench, x, out);
}

static int is_built(void) {
  return hooke_build_fact("cholmod")[0] != '\0';
}

static void needs_factor(void) {
  if (!is_built()) skip();
}

TEST(solves_s) {
  needs_factor();
  static const double weights[][2] = {{1e-4, 1e-2}, {0.0, 0.3}, {1.0, 1.0}, {1e-8, 1e-4}};
  for (int k = 0; k < 24; k++) {
    owned(tear_down) struct bench b;
    set_up((struct random_scene_request){.seed = (uint64_t)(900 + k),
                                         .particles = 20 + 17 * k,
                                         .springs = 5 + 40 * k,
                                         .triples = k % 3 == 0 ? 9 : 0,
                                         .tetrahedra = k % 4 == 1 ? 3 * k : 0,
                                         .anchors = k % 3,
                                         .features = k * 53 & SCENE_EVERYTHING,
                                         .cloth = {k % 2 ? k + 3 : 0, 11},
                                         .rope = k % 5 ? 0 : 60},
           weights[k % 4][0], weights[k % 4][1], &b);
    const int64_t size = 3 * b.n;
    struct random_source source = {(uint64_t)k};
    double *x = new_doubles(4 * size), *s = x + size, *ordered = s + size, *found = ordered + size;
    for (int64_t j = 0; j < size; j++)
      x[j] = b.scene.system->constrained[j % b.n] ? 0.0 : random_between(&source, -1.0, 1.0);
    multiply(&b, x, s);
    check_ok(hk_reduced_prepare_whole(&b.reduced));
    assert_non_null(b.reduced.whole);
    for (int again = 0; again < 2; again++) { /* the second time on the data of the first */
      assert_int_equal(hk_reduced_factorise(&b.reduced), 1);
      hk_factor_forward(b.reduced.whole, s, ordered);
      memset(found, 0x7f, (size_t)size * sizeof(double));
      hk_factor_backward(b.reduced.whole, ordered, found);
      double worst = largest_difference(size, found, x);
      if (!(worst <= 1e-9)) check_failed("scene %d: error %g", k, worst);
    }
    assert_true(hk_factor_memory(b.reduced.whole) > 8 * hk_factor_numbers(b.reduced.whole));
    free(x);
  }
}

/* A matrix that is not positive is reported, and the blocks are used again. */
TEST(not_positive) {
  needs_factor();
  owned(tear_down) struct bench b;
  set_up((struct random_scene_request){.seed = 3, .particles = 60, .springs = 150, .features = SCENE_DAMPING},
         1e-4, 1e-2, &b);
  check_ok(hk_reduced_prepare_whole(&b.reduced));
  assert_int_equal(hk_reduced_factorise(&b.reduced), 1);
  assert_int_equal(b.reduced.whole_state, HOOKE_WHOLE_IN_USE);
  const double bad[] = {NAN, INFINITY, -1.0, 0.0};
  for (int k = 0; k < 4; k++) {
    const double kept = b.reduced.block[17];
    b.reduced.block[17] = bad[k];
    assert_int_equal(hk_reduced_factorise(&b.reduced), 0);
    assert_int_equal(b.reduced.whole_state, HOOKE_WHOLE_READY);
    b.reduced.block[17] = kept;
  }
  assert_int_equal(hk_reduced_factorise(&b.reduced), 1);
}

/* A chain has a small factor, and too large a factor is not computed. */
TEST(sizes) {
  needs_factor();
  owned(tear_down) struct bench b;
  struct hk_factor *factor = NULL;
  set_up((struct random_scene_request){.seed = 5, .particles = 2, .springs = 1, .rope = 2000}, 1e-4, 1e-2,
         &b);
  check_ok(hk_factor_create(b.scene.system, INT64_C(1) << 40, 1, &factor));
  const int64_t numbers = hk_factor_numbers(factor);
  check_between((double)numbers / 2000.0, 9.0, 200.0);
  hk_factor_destroy(factor);
  check_ok(hk_factor_create(b.scene.system, numbers / 2, 1, &factor));
  assert_null(factor);
}

/* Of a tree of particles, each coupled to the one above: the factor has no other blocks. */
enum { TREE = 31, BLOCKS = 2 * TREE - 1 };

static int32_t above(int32_t particle, int32_t first, int32_t size) {
  const int32_t half = (size - 1) / 2, root = first + size - 1;
  if (particle == first + half - 1 || particle == root - 1) return root;
  return above(particle, particle < first + half ? first : first + half, half);
}

static void fill_tree(const struct hk_columns *m) {
  int32_t count = 0;
  for (int32_t k = 0; k < 3 * TREE; k++) {
    m->start[k] = count;
    for (int32_t other = 0; other <= k / 3; other++) {
      const int32_t coupled = other == k / 3 || above(other, 0, TREE) == k / 3;
      for (int32_t row = 3 * other; coupled && row < 3 * other + 3 && row <= k; row++) {
        m->number[count] = row == k ? 9.0 + k : sin(1.0 + row + 5.0 * k);
        m->row[count++] = row;
      }
    }
  }
  m->start[3 * TREE] = count;
}

/* Supernodal factors are the simplicial ones with zeros between their nonzeros, particle by particle. */
TEST(supernodal) {
  needs_factor();
  int32_t start[3 * TREE + 1], row[9 * BLOCKS], zeros = 0, at[2] = {0, 0};
  double number[9 * BLOCKS];
  struct hk_cholmod *made[2];
  const struct hk_columns m = {3 * TREE, start, row, number};
  fill_tree(&m);
  for (int kind = HOOKE_FACTOR_SIMPLICIAL; kind <= HOOKE_FACTOR_SUPERNODAL; kind++) {
    assert_non_null(made[kind] = hk_cholmod->create(&m, kind));
    for (int again = 0; again < 2; again++)
      assert_int_equal(hk_cholmod->compute(made[kind], &m, 0.0), 1);
    assert_true(hk_cholmod->room(made[kind]) >= 8 * 9 * BLOCKS);
  }
  for (int32_t k = 0; k < 3 * TREE; k++) {
    const struct hk_factor_column one = hk_cholmod->column(made[0], k, at),
                                  two = hk_cholmod->column(made[1], k, at + 1);
    assert_int_equal(hk_cholmod->counts(made[0])[k], hk_cholmod->counts(made[1])[k]);
    assert_int_equal(one.count % 3, (3 - k % 3) % 3);
    assert_int_equal(two.count % 3, one.count % 3);
    int32_t j = 0;
    for (int32_t i = 0; i < two.count; i++) {
      const int same = j < one.count && one.row[j] == two.row[i];
      check_close(two.number[i], same ? one.number[j] : 0.0, same ? 1e-14 : 0.0);
      zeros += !same;
      j += same;
    }
    assert_int_equal(j, one.count);
  }
  assert_true(zeros > 0);
  hk_cholmod->destroy(made[0]);
  hk_cholmod->destroy(made[1]);
}

/* A build without factors reports none. */
TEST(not_built) {
  if (is_built()) skip();
  owned(tear_down) struct bench b;
  set_up((struct random_scene_request){.seed = 3, .particles = 60, .springs = 150}, 1e-4, 1e-2, &b);
  check_ok(hk_reduced_prepare_whole(&b.reduced));
  assert_null(b.reduced.whole);
  assert_int_equal(b.reduced.whole_state, HOOKE_WHOLE_NONE);
}

/* Dq - gamma dv = b_q and M dv - gamma (K dq + D dv) = M b_v, with the model's own derivative; by blocks and
 * by a factor. */
TEST(implicit_equation) {
  for (int k = 0; k < 12; k++) {
    owned(tear_down) struct bench b;
    const double gamma = k % 2 ? 1e-2 : 1e-3;
    set_up((struct random_scene_request){.seed = (uint64_t)(70 + k),
                                         .particles = 40,
                                         .springs = 90,
                                         .triples = k % 2 ? 12 : 0,
                                         .tetrahedra = k % 3 ? 12 : 0,
                                         .anchors = k % 2 ? 7 : 0,
                                         .with_product = 1,
                                         .features = SCENE_EVERYTHING & ~(k % 3 ? SCENE_CALLBACK : 0)},
           gamma * gamma, gamma, &b);
    const hooke_system *system = b.scene.system;
    const int64_t n = b.n, size = 3 * n;
    struct random_source source = {(uint64_t)(5 + k)};
    double *bq = new_doubles(10 * size), *bv = bq + size, *right = bv + size, *z = right + size,
           *weight = z + size, *q = weight + size, *v = q + size, *dq = v + size, *dv = dq + size,
           *out = dv + size;
    for (int64_t j = 0; j < size; j++) {
      weight[j] = random_between(&source, 0.5, 2.0);
      bq[j] = system->constrained[j % n] ? 0.0 : gamma * random_between(&source, -1.0, 1.0);
      bv[j] = system->constrained[j % n] ? 0.0 : random_between(&source, -1.0, 1.0);
    }
    hk_motion_store(b.integrator->motion, q, v);
    for (int whole = 0; whole <= is_built(); whole++) {
      struct hk_solution solution;
      if (whole) check_ok(hk_reduced_prepare_whole(&b.reduced));
      if (whole) assert_int_equal(hk_reduced_factorise(&b.reduced), 1);
      check_ok(hk_reduced_right(&b.reduced, bq, bv, right));
      check_ok(hk_reduced_minimise(&b.reduced, right, weight, 1e-12, 500, z, &solution));
      assert_int_equal(solution.converged, 1);
      for (int64_t j = 0; j < size; j++) { /* rows of x y z */
        const int64_t at = j % 3 * n + j / 3;
        dq[j] = gamma * z[at];
        dv[j] = z[at] - bq[at] / gamma;
      }
      check_ok(hooke_system_derivative_product(system, 0.25, q, v, dq, dv, out));
      for (int64_t j = 0; j < size; j++) {
        const int64_t at = j % 3 * n + j / 3;
        if (system->constrained[j / 3])
          check_close(z[at], 0.0, 0.0);
        else
          check_close(system->mass[j / 3] * dv[j] - gamma * out[j], system->mass[j / 3] * bv[at], 1e-9);
      }
    }
    free(bq);
  }
}

/* ---- GMRES ---- */

enum { SIZE = 75 };

static int32_t apply(void *ctx, const double *x, double *out) {
  const double *a = ctx;
  for (int i = 0; i < SIZE; i++) {
    out[i] = 0.0;
    for (int j = 0; j < SIZE; j++)
      out[i] += a[SIZE * i + j] * x[j];
  }
  return HOOKE_OK;
}

TEST(minimal) {
  struct random_source source = {41};
  double *a = new_doubles(SIZE * SIZE), *x = new_doubles(3 * SIZE), *b = x + SIZE, *found = b + SIZE;
  owned_doubles *scratch = new_doubles(HOOKE_MINIMAL_VECTORS * SIZE);
  const struct hk_operator operator= {SIZE, apply, a};
  for (int k = 0; k < SIZE * SIZE; k++)
    a[k] = random_between(&source, -0.19, 0.19) + (k % (SIZE + 1) == 0 ? 2.0 : 0.0);
  for (int k = 0; k < SIZE; k++)
    x[k] = random_between(&source, -1.0, 1.0);
  apply(a, x, b);
  struct hk_solution solution;
  check_ok(hk_solve_minimal(&operator, b, 1e-12, 500, scratch, found, &solution)); /* more than its space */
  assert_int_equal(solution.converged, 1);
  assert_true(solution.iterations > HOOKE_MINIMAL_SPACE);
  check_between(largest_difference(SIZE, found, x), 0.0, 1e-11);
  check_ok(hk_solve_minimal(&operator, b, 1e-3, 500, scratch, found, &solution));
  check_between(largest_difference(SIZE, found, x), 1e-6, 1e-2); /* absolute, and no further */
  check_ok(hk_solve_minimal(&operator, b, 1e-12, 3, scratch, found, &solution));
  assert_int_equal(solution.converged, 0);
  assert_int_equal(solution.iterations, 3);
  check_ok(hk_solve_minimal(&operator, b, 1e6, 3, scratch, found, &solution));
  assert_int_equal(solution.converged, 1);
  assert_int_equal(solution.iterations, 0);
  b[3] = NAN;
  check_ok(hk_solve_minimal(&operator, b, 1e-12, 500, scratch, found, &solution));
  assert_int_equal(solution.converged, 0);
  b[3] = 1.0;
  memset(a, 0, SIZE * SIZE * sizeof(double));
  check_ok(hk_solve_minimal(&operator, b, 1e-12, 500, scratch, found, &solution));
  assert_int_equal(solution.converged, 0);
  free(a);
  free(x);
}
