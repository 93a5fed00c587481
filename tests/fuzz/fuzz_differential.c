/* Small scenes, computed twice: by the library with the loops of every instruction set of the machine, by
 * strided batches, tiled batches and runs, and by the plain loop of tests/support/canonical.c: the bits must
 * agree. Energies and derivatives are compared with difference quotients.
 *
 * Lines of: src/kernel/altitude_loops.c src/kernel/bending_loops.c src/kernel/spring/strided_loops.c
 *           src/kernel/spring/tiled_loops.c src/kernel/spring/spring_[cl]*.c src/kernel/move_loops.c
 *           src/kernel/tetrahedron_loops.c src/kernel/spring/tangent_loops.c src/model/force/[a-z]*.c
 *           src/model/sum/[a-z]*.c src/integrate/method/forward_euler.c
 *           src/integrate/method/symplectic_euler.c src/integrate/method/rk4.c
 *           src/integrate/method/stages.c src/integrate/method/verlet.c
 * Longest input: 104 */
#include "fuzz.h"
#include "small_scene.h"

#include "kernel/spring/spring_loops.h"
#include "model/sum/motion.h"
#include "model/sum/tiled.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
  return small_scene_mutate(data, size, most, seed);
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *one, size_t one_size, const uint8_t *two, size_t two_size,
                                 uint8_t *out, size_t most, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *one, size_t one_size, const uint8_t *two, size_t two_size,
                                 uint8_t *out, size_t most, unsigned seed) {
  return small_scene_cross(one, one_size, two, two_size, out, most, seed);
}

/* The linker replaces the first by the second everywhere else. */
const struct hk_spring_set *__real_hk_spring_set(int32_t set);
const struct hk_spring_set *__wrap_hk_spring_set(int32_t set);

static int32_t first_set;

const struct hk_spring_set *__wrap_hk_spring_set(int32_t set) {
  return __real_hk_spring_set(first_set + set);
}

/* The sign of a NaN is irrelevant. Where a NaN is expected, or anywhere if `lost`, the value of `left_out`,
 * if it is not NULL, is also accepted: the result of the plain loop without dampings of zero. */
static void require_same(int64_t count, const double *found, const double *expected, const double *left_out,
                         int lost, const char *what) {
  for (int64_t k = 0; k < count; k++) {
    if (memcmp(found + k, expected + k, sizeof *found) == 0 || (isnan(found[k]) && isnan(expected[k])))
      continue;
    if (left_out && (lost || isnan(expected[k])) && memcmp(found + k, left_out + k, sizeof *found) == 0)
      continue;
    fprintf(stderr, "%s, loops for %s: number %lld is %a, expected %a\n", what, __wrap_hk_spring_set(0)->name,
            (long long)k, found[k], expected[k]);
    hooke_fuzz_require(0, what);
  }
}

static int some_nan(int64_t count, const double *x) {
  for (int64_t k = 0; k < count; k++) {
    if (isnan(x[k])) return 1;
  }
  return 0;
}

static int all_finite(int64_t count, const double *x) {
  for (int64_t k = 0; k < count; k++) {
    if (!isfinite(x[k])) return 0;
  }
  return 1;
}

static double largest(int64_t count, const double *x) {
  double most = 0.0;
  for (int64_t k = 0; k < count; k++)
    most = fmax(most, fabs(x[k]));
  return most;
}

/* A damping of zero times an infinite rate is NaN; the library may leave it out. */
static int leaves_damping_out(const struct small_scene *scene) {
  const struct canonical *c = &scene->canonical;
  int some = 0;
  for (int64_t s = 0; s < c->spring_count; s++)
    some |= c->gamma[s] == 0.0;
  return some && scene->extreme;
}

/* ---- sums ---- */

struct stepping {
  const char *method;
  double step;
  int64_t steps;
  int32_t result;
  double q[3 * MOST_PARTICLES], v[3 * MOST_PARTICLES];
};

/* By the plain loop. */
struct expected {
  double acceleration[3 * MOST_PARTICLES];
  struct stepping by;
};

static struct canonical plain_loop(const struct small_scene *scene, int leaves_out) {
  struct canonical canonical = scene->canonical;
  canonical.leaves_out = leaves_out;
  return canonical;
}

/* `expected`: as it is, and without dampings of zero if the library may leave them out. */
static void check_acceleration(const struct small_scene *scene, int first, struct expected expected[2]) {
  const int left_out = leaves_damping_out(scene);
  double found[3 * MOST_PARTICLES];
  const int64_t size = 3 * scene->particles;
  hooke_fuzz_require(hooke_system_acceleration(scene->system, 0.125, scene->q, scene->v, found) == HOOKE_OK,
                     "accelerations");
  for (int k = 0; first && k <= left_out; k++) {
    const struct canonical canonical = plain_loop(scene, k);
    canonical_acceleration(&canonical, 0.125, scene->q, scene->v, expected[k].acceleration);
  }
  require_same(size, found, expected[0].acceleration, left_out ? expected[1].acceleration : NULL, 0,
               "accelerations");
}

/* Forces by three threads, which the library would not use for a scene this small, and by one. */
static void check_members(const struct small_scene *scene) {
  static struct hk_pool *pool;
  const hooke_system *system = scene->system;
  if (system->strided->count == 0 && system->tiled->particles == 0) return;
  if (pool == NULL) pool = hk_pool_create(3);
  hooke_fuzz_require(pool != NULL, "a thread pool");
  double found[2][3 * MOST_PARTICLES];
  for (int k = 0; k < 2; k++) {
    struct hk_motion *motion = NULL;
    hooke_fuzz_require(hk_motion_create(system, 0, k ? pool : NULL, &motion) == HOOKE_OK, "a motion");
    hk_motion_load(system, motion, scene->q, scene->v);
    hooke_fuzz_require(hk_motion_forces(system, motion, 0.0) == HOOKE_OK, "forces");
    hk_rows_from_components(scene->particles, motion->f, found[k]);
    hk_motion_destroy(motion);
  }
  require_same(3 * scene->particles, found[1], found[0], NULL, 0, "forces by three threads");
}

/* ---- steps ---- */

/* `split`: how often parts of a step were taken in place of the whole, whose equations they do not solve. */
static int32_t take_steps(const struct small_scene *scene, const struct stepping *by, hooke_state *state,
                          int64_t *split) {
  owned_options *options = NULL;
  owned_integrator *integrator = NULL;
  int32_t status = hooke_options_create("run", &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "method", by->method);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "step", by->step);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "newton_tolerance", 1e-12);
  if (status == HOOKE_OK) status = hooke_integrator_create(scene->system, options, &integrator);
  if (status == HOOKE_OK) status = hooke_integrator_step(integrator, state, by->steps);
  *split = status == HOOKE_OK ? hooke_integrator_count(integrator, "nonlinear_failures") : 0;
  return status;
}

static void step_plainly(const struct canonical *canonical, struct stepping *by) {
  by->result = CANONICAL_STEPPED;
  for (int64_t k = 0; k < by->steps && by->result == CANONICAL_STEPPED; k++) {
    by->result = canonical_step(canonical, by->method, (double)k * by->step, (double)(k + 1) * by->step,
                                by->step, by->q, by->v);
  }
  hooke_fuzz_require(by->result != CANONICAL_UNKNOWN, "a step that has no definition");
}

/* An implicit step: one step from its start. If springs that only pull are damped there may be no solution.
 */
static void check_solved(const struct small_scene *scene, const struct stepping *by, const double *q,
                         const double *v) {
  const double defect =
      canonical_defect(&scene->canonical, by->method, 0.0, by->step, by->step, by->q, by->v, q, v);
  if (!(defect <= 1.0)) fprintf(stderr, "%s: %g times what is allowed\n", by->method, defect);
  hooke_fuzz_require(defect <= 1.0, "a step that solves its equations");
}

static void check_steps(const struct small_scene *scene, int first, struct expected expected[2]) {
  struct stepping *by = &expected[0].by, *without = &expected[1].by;
  const int left_out = leaves_damping_out(scene);
  const int64_t size = 3 * scene->particles;
  owned_state *state = NULL;
  hooke_fuzz_require(hooke_state_create(scene->system, &state) == HOOKE_OK, "a state");
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  for (int k = 0; first && k <= left_out; k++) {
    const struct canonical canonical = plain_loop(scene, k);
    memcpy(expected[k].by.q, q, (size_t)size * sizeof *q);
    memcpy(expected[k].by.v, v, (size_t)size * sizeof *v);
    step_plainly(&canonical, &expected[k].by);
    if (expected[k].by.result == CANONICAL_SOLVED) expected[k].by.steps = 1;
  }
  const int solved = by->result == CANONICAL_SOLVED;
  int64_t split;
  const int32_t status = take_steps(scene, by, state, &split);
  const int finite = solved || (all_finite(size, by->q) && all_finite(size, by->v));
  if (status == HOOKE_OK && solved) {
    if (!scene->extreme && split == 0) check_solved(scene, by, q, v);
  } else if (status == HOOKE_OK) {
    /* springs that only pull are slack where positions are NaN, so that others continue with finite numbers
     */
    const int lost = some_nan(size, by->q) || some_nan(size, by->v);
    require_same(size, q, by->q, left_out ? without->q : NULL, lost, "positions after some steps");
    require_same(size, v, by->v, left_out ? without->v : NULL, lost, "velocities after some steps");
  } else {
    const int allowed = status == HOOKE_DIVERGED || (solved && status == HOOKE_SOLVER_FAILED);
    if (!allowed) fprintf(stderr, "%s: %s: %s\n", by->method, hooke_status_name(status), hooke_last_error());
    hooke_fuzz_require(allowed, "steps that end");
    hooke_fuzz_require(!finite || scene->extreme || solved || by->step > 0.01, "steps that did not diverge");
    hooke_fuzz_require(all_finite(size, q) && all_finite(size, v), "the last good state");
  }
}

/* ---- energies and derivatives ---- */

static double dot(int64_t count, const double *a, const double *b) {
  double sum = 0.0;
  for (int64_t k = 0; k < count; k++)
    sum += a[k] * b[k];
  return sum;
}

static void move(int64_t size, const double *from, double by, const double *along, double *to) {
  for (int64_t k = 0; k < size; k++)
    to[k] = from[k] + by * along[k];
}

/* A force has no derivative where a spring has no length; likewise tetrahedra at which two altitudes are
 * nearly as short. */
static int is_smooth(const struct small_scene *scene) {
  const struct canonical *c = &scene->canonical;
  if (scene->pulls || scene->extreme) return 0;
  for (int64_t s = 0; s < c->spring_count; s++) {
    const double *a = scene->q + 3 * c->ends[2 * s], *b = scene->q + 3 * c->ends[2 * s + 1];
    if (hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]) < 0.1) return 0;
  }
  for (int64_t t = 0; t < c->tetrahedron_count; t++) {
    const double *x[4];
    double square[7], first = 0.0, second = 0.0;
    for (int e = 0; e < 4; e++)
      x[e] = scene->q + 3 * c->corners[4 * t + e];
    canonical_altitudes(x, square);
    for (int k = 0; k < 7; k++) {
      second = fmax(second, fmin(first, square[k]));
      first = fmax(first, square[k]);
    }
    if (!(second < 0.9 * first) || first < 0.01) return 0;
  }
  return 1;
}

/* The power of the forces at q is the loss of potential energy, and that of damping is heat. A difference
 * quotient of half the step gives the error of the other. */
static void check_energy(const struct small_scene *scene) {
  const int64_t size = 3 * scene->particles;
  const double *q = scene->q, *v = scene->v, far = 1e-3;
  double at[3 * MOST_PARTICLES], still[3 * MOST_PARTICLES] = {0}, force[3 * MOST_PARTICLES], slope[2],
                                           v_free[3 * MOST_PARTICLES];
  const double *w = scene->canonical.inverse_mass;
  for (int64_t k = 0; k < size; k++)
    v_free[k] = w[k / 3] != 0.0 ? v[k] : 0.0;
  double scale = 0.0;
  for (int k = 0; k < 2; k++) {
    const double by = far / (1 << k);
    move(size, q, by, v_free, at);
    const double ahead = hooke_system_energy(scene->system, "potential", at, NULL);
    move(size, q, -by, v_free, at);
    const double behind = hooke_system_energy(scene->system, "potential", at, NULL);
    slope[k] = (ahead - behind) / (2.0 * by);
    scale = fmax(scale, fmax(fabs(ahead), fabs(behind)));
  }
  hooke_fuzz_require(hooke_system_force(scene->system, 0.0, q, still, force) == HOOKE_OK, "forces");
  const double power = dot(size, force, v_free);
  const double allowed = 4.0 * fabs(slope[1] - slope[0]) + 1e-11 * scale / far +
                         1e-9 * (fabs(power) + largest(size, force) * largest(size, v) * (double)size);
  if (!(fabs(power + slope[1]) <= allowed))
    fprintf(stderr, "power %.17g, slope of the potential energy %.17g, allowed %.3g\n", power, slope[1],
            allowed);
  hooke_fuzz_require(fabs(power + slope[1]) <= allowed, "forces are the slope of the potential energy");

  hooke_fuzz_require(hooke_system_force(scene->system, 0.0, q, v_free, at) == HOOKE_OK, "forces");
  const double lost = power - dot(size, at, v_free),
               heat = hooke_system_dissipated_power(scene->system, q, v_free);
  const double room =
      1e-11 * (double)size * fmax(largest(size, at), largest(size, force)) * largest(size, v) + 1e-300;
  if (!(fabs(lost - heat) <= room)) fprintf(stderr, "lost %.17g, heat %.17g\n", lost, heat);
  hooke_fuzz_require(heat >= 0.0 && fabs(lost - heat) <= room, "what damping takes is heat");
}

/* From -1 to 1, without a pattern along the particles. */
static double drawn_from(int64_t k) {
  return (double)((k * 7919 + 104729) % 2003) / 1001.0 - 1.0;
}

/* The blocks times dq and dv equal the product. */
static void check_blocks(const struct small_scene *scene, const double *dq, const double *dv,
                         const double *product) {
  enum { MOST_BLOCKS = 16384 };
  static double dfdq[9 * MOST_BLOCKS], dfdv[9 * MOST_BLOCKS];
  static int64_t column[MOST_BLOCKS], row[MOST_PARTICLES + 1];
  const int64_t size = 3 * scene->particles, count = hooke_system_count(scene->system, "blocks");
  double sum, most;
  hooke_fuzz_require(count >= scene->particles && count <= MOST_BLOCKS, "a number of blocks");
  hooke_fuzz_require(hooke_system_derivative_pattern(scene->system, row, column) == HOOKE_OK &&
                         hooke_system_derivative_blocks(scene->system, scene->q, scene->v, dfdq, dfdv) ==
                             HOOKE_OK,
                     "derivatives");
  for (int64_t p = 0; p < size; p++) {
    sum = most = 0.0;
    for (int64_t k = row[p / 3]; k < row[p / 3 + 1]; k++) {
      for (int64_t b = 0; b < 3; b++) {
        const int64_t at = 9 * k + 3 * (p % 3) + b, to = 3 * column[k] + b;
        sum += dfdq[at] * dq[to] + dfdv[at] * dv[to];
        most += fabs(dfdq[at] * dq[to]) + fabs(dfdv[at] * dv[to]);
      }
    }
    if (!(fabs(sum - product[p]) <= 1e-12 * most))
      fprintf(stderr, "number %lld: %.17g by blocks, %.17g by the product\n", (long long)p, sum, product[p]);
    hooke_fuzz_require(fabs(sum - product[p]) <= 1e-12 * most, "the blocks are the derivative's");
  }
}

/* Effect of rounding of q on a force. */
static double force_rounding(const struct small_scene *scene) {
  const struct canonical *c = &scene->canonical;
  const double stiffness = largest(c->spring_count, c->kappa) +
                           4.0 * largest(c->triple_count, c->coefficient) +
                           largest(c->tetrahedron_count, c->altitude[0]);
  const int64_t terms = c->spring_count + 3 * c->triple_count + 4 * c->tetrahedron_count;
  return DBL_EPSILON * (double)terms * stiffness * (1.0 + largest(3 * scene->particles, scene->q));
}

static void check_derivative(const struct small_scene *scene) {
  const int64_t size = 3 * scene->particles;
  double dq[3 * MOST_PARTICLES], dv[3 * MOST_PARTICLES], product[3 * MOST_PARTICLES];
  double ahead[3 * MOST_PARTICLES], behind[3 * MOST_PARTICLES], at_q[3 * MOST_PARTICLES],
      at_v[3 * MOST_PARTICLES];
  double slope[2][3 * MOST_PARTICLES];
  const double far = 1e-3;
  for (int64_t k = 0; k < size; k++) {
    dq[k] = drawn_from(k);
    dv[k] = drawn_from(k + size);
  }
  double scale = 0.0;
  for (int k = 0; k < 2; k++) {
    const double by = far / (1 << k);
    move(size, scene->q, by, dq, at_q), move(size, scene->v, by, dv, at_v);
    hooke_fuzz_require(hooke_system_force(scene->system, 0.0, at_q, at_v, ahead) == HOOKE_OK, "forces");
    move(size, scene->q, -by, dq, at_q), move(size, scene->v, -by, dv, at_v);
    hooke_fuzz_require(hooke_system_force(scene->system, 0.0, at_q, at_v, behind) == HOOKE_OK, "forces");
    scale = fmax(scale, fmax(largest(size, ahead), largest(size, behind)));
    for (int64_t p = 0; p < size; p++)
      slope[k][p] = (ahead[p] - behind[p]) / (2.0 * by);
  }
  hooke_fuzz_require(
      hooke_system_derivative_product(scene->system, 0.0, scene->q, scene->v, dq, dv, product) == HOOKE_OK,
      "a product");
  const double whole = largest(size, product);
  for (int64_t p = 0; p < size; p++) {
    const double allowed =
        4.0 * fabs(slope[1][p] - slope[0][p]) + (1e-10 * scale + force_rounding(scene)) / far + 1e-6 * whole;
    if (!(fabs(product[p] - slope[1][p]) <= allowed))
      fprintf(stderr, "number %lld: %.17g, difference %.17g, allowed %.3g\n", (long long)p, product[p],
              slope[1][p], allowed);
    hooke_fuzz_require(fabs(product[p] - slope[1][p]) <= allowed, "derivatives are what differences say");
  }
  check_blocks(scene, dq, dv, product);
}

static void check_momentum(const struct small_scene *scene) {
  const double *q = scene->q, *v = scene->v, *w = scene->canonical.inverse_mass;
  double found[6], expected[6] = {0}, scale = 0.0;
  for (int64_t p = 0; p < scene->particles; p++) {
    if (w[p] == 0.0) continue;
    for (int a = 0; a < 3; a++) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      expected[a] += scene->mass[p] * v[3 * p + a];
      expected[3 + a] += scene->mass[p] * (q[3 * p + b] * v[3 * p + c] - q[3 * p + c] * v[3 * p + b]);
      scale += scene->mass[p] * fabs(v[3 * p + a]) * (1.0 + fabs(q[3 * p + b]) + fabs(q[3 * p + c]));
    }
  }
  hooke_system_momentum(scene->system, v, found);
  hooke_system_angular_momentum(scene->system, q, v, found + 3);
  for (int k = 0; k < 6; k++)
    hooke_fuzz_require(fabs(found[k] - expected[k]) <= 1e-13 * scale, "momentum and angular momentum");
  const double whole = hooke_system_energy(scene->system, "total", q, v),
               parts = hooke_system_energy(scene->system, "kinetic", NULL, v) +
                       hooke_system_energy(scene->system, "potential", q, NULL);
  hooke_fuzz_require(whole == parts, "energy is kinetic and potential");
}

/* ---- one input ---- */

static const char *const methods[] = {"symplectic-euler", "forward-euler", "verlet", "rk4"};

/* A backward Euler step without solution takes as long as thousands of others, and a campaign keeps the
 * slowest inputs. */
static struct stepping choose_steps(uint8_t code, int may_be_long) {
  struct stepping by = {.method = code % 64 == 63 && may_be_long ? "backward-euler" : methods[code % 4],
                        .steps = 1 + code / 4 % 3};
  by.step = code & 64 ? 0.0009765 : code & 128 ? 0.05 : 1e-5;
  return by;
}

static uint64_t hash_of(const uint8_t *data, size_t size) {
  uint64_t hash = UINT64_C(0xcbf29ce484222325);
  for (size_t k = 0; k < size; k++)
    hash = (hash ^ data[k]) * UINT64_C(0x100000001b3);
  return hash ^ hash >> 29;
}

static int32_t set_count(void) {
  int32_t count = 0;
  while (__real_hk_spring_set(count))
    count++;
  return count;
}

/* With the loops of one instruction set. */
static void check_with(const uint8_t *data, size_t size, int first, int differences,
                       struct expected expected[2]) {
  struct small_scene scene; /* runs take their loops when a system is committed */
  if (!small_scene_create(data, size, &scene)) return;
  if (first) hooke_fuzz_is_past_syntax();
  check_acceleration(&scene, first, expected);
  if (differences) check_members(&scene);
  /* an implicit step is slow where there is no solution, and is not compared between loops */
  if (first || expected->by.result != CANONICAL_SOLVED) check_steps(&scene, first, expected);
  if (first && differences && is_smooth(&scene)) {
    hooke_fuzz_is_accepted();
    check_energy(&scene);
    check_derivative(&scene);
    check_momentum(&scene);
  }
  small_scene_destroy(&scene);
}

/* The first inputs, those that are kept, go through all checks. The variable HOOKE_FUZZ_WHOLE sets their
 * number; a campaign has thousands of its own. */
static int is_whole(void) {
  static int64_t left = -1;
  if (left < 0) {
    const char *told = getenv("HOOKE_FUZZ_WHOLE");
    left = told ? strtoll(told, NULL, 10) : 500;
  }
  return left > 0 && left-- > 0;
}

/* Others, one of millions, go through a part chosen by their bytes. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static int32_t sets;
  hooke_fuzz_begin();
  if (sets == 0) sets = set_count();
  const int whole = is_whole();
  const uint64_t hash = hash_of(data, size);
  struct expected expected[2];
  expected[0].by = expected[1].by = choose_steps(size > 2 ? data[2] : 0, whole);
  const int32_t from = whole ? 0 : (int32_t)(hash % (uint64_t)sets), to = whole ? sets - 1 : from;
  for (first_set = from; first_set <= to; first_set++)
    check_with(data, size, first_set == from, whole || hash / 16 % 8 == 0, expected);
  first_set = 0;
  return 0;
}
