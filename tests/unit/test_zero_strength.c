/* Members without strength are absent: a scene with them and one without choose the same loops, and run to
 * the same bits. */
#include "canonical.h"
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include "model/system.h"

#include <stdio.h>
#include <string.h>

/* ---- scenes ---- */

enum shape { CLOTH, ROPE, NETWORK, SHAPES };

enum ingredient {
  GROUPS,       /* two groups, whose springs would form runs and strided batches of their own */
  FAMILY,       /* a family of a part */
  SOME_SPRINGS, /* springs among others of a group */
  BENDING,
  DAMPING,
  DRAG,
  GRAVITY,
  ALL,
  INGREDIENTS
};

/* Everything but `what` has some strength if `full`; `what` is absent, or present with a strength of zero. */
struct scene {
  enum shape shape;
  enum ingredient what;
  int32_t full, zero;
};

enum { PARTICLES = 120, SPRINGS = 300, GROUP = 60 };
static const double REST = 0.5;

static int is_zero(const struct scene *scene, enum ingredient ingredient) {
  return scene->zero && (scene->what == ingredient || scene->what == ALL);
}

static int is_full(const struct scene *scene, enum ingredient ingredient) {
  return scene->full && scene->what != ingredient && scene->what != ALL;
}

static void set_damping(const struct scene *scene, hooke_options *options, const char *name) {
  if (is_zero(scene, DAMPING)) check_ok(hooke_options_set_number(options, name, 0.0));
  if (is_full(scene, DAMPING)) check_ok(hooke_options_set_number(options, name, 0.01));
}

static void add_part(const struct scene *scene, hooke_system *system) {
  static const double origin[] = {0, 0, 0}, edges[] = {1, 0.1, 0, 0, 0.2, 1}, size[] = {17, 13};
  static const double to[] = {2, 0.5, 0.1};
  const int cloth = scene->shape == CLOTH;
  owned_options *options = NULL;
  check_ok(hooke_options_create(cloth ? "cloth" : "rope", &options));
  check_ok(hooke_options_set_number(options, "mass", 1.0));
  if (cloth) {
    check_ok(hooke_options_set_numbers(options, "origin", 3, origin));
    check_ok(hooke_options_set_numbers(options, "edges", 6, edges));
    check_ok(hooke_options_set_numbers(options, "size", 2, size));
    check_ok(hooke_options_set_number(options, "shear.stiffness", 4.0));
  } else {
    check_ok(hooke_options_set_numbers(options, "from", 3, origin));
    check_ok(hooke_options_set_numbers(options, "to", 3, to));
    check_ok(hooke_options_set_number(options, "segments", 80));
  }
  check_ok(hooke_options_set_number(options, cloth ? "structural.stiffness" : "stretch.stiffness", 9.0));
  set_damping(scene, options, cloth ? "structural.damping" : "stretch.damping");
  if (is_zero(scene, FAMILY)) check_ok(hooke_options_set_number(options, "bend.stiffness", 0.0));
  if (is_full(scene, FAMILY)) check_ok(hooke_options_set_number(options, "bend.stiffness", 1.0));
  check_ok(hooke_system_add_part(system, cloth ? "cloth" : "rope", "part", options, NULL, NULL));
}

struct network {
  double position[3 * PARTICLES];
  int64_t count, ends[4 * SPRINGS];
  double stiffness[2 * SPRINGS], damping[2 * SPRINGS];
};

/* Unordered springs, every second one with neither stiffness nor damping, or left out. */
static void draw_network(int zeros, double damping, struct network *network) {
  struct random_source source = {77};
  network->count = 0;
  for (int k = 0; k < 3 * PARTICLES; k++)
    network->position[k] = random_between(&source, -1.0, 1.0);
  for (int k = 0; k < 2 * SPRINGS; k++) {
    const int64_t i = random_whole(&source, 0, PARTICLES - 1);
    const int64_t j = (i + random_whole(&source, 1, PARTICLES - 1)) % PARTICLES;
    const double stiffness = random_between(&source, 1.0, 5.0);
    if (k % 2 && !zeros) continue;
    network->ends[2 * network->count] = i;
    network->ends[2 * network->count + 1] = j;
    network->stiffness[network->count] = k % 2 ? 0.0 : stiffness;
    network->damping[network->count++] = k % 2 ? 0.0 : damping;
  }
}

static void add_network(const struct scene *scene, hooke_system *system) {
  const double mass = 0.1;
  struct network network;
  draw_network(is_zero(scene, SOME_SPRINGS), is_full(scene, DAMPING) ? 0.01 : 0.0, &network);
  check_ok(hooke_system_add_particles(system, PARTICLES, network.position, NULL, 1, &mass, NULL));
  owned_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", network.count, network.stiffness));
  if (is_full(scene, DAMPING) || is_zero(scene, DAMPING))
    check_ok(hooke_options_set_numbers(options, "damping", network.count, network.damping));
  check_ok(hooke_options_set_number(options, "rest_length", REST));
  check_ok(hooke_system_add_springs(system, "network", network.count, network.ends, options));
}

static void add_group(hooke_system *system, int64_t offset, double stiffness) {
  int64_t ends[2 * GROUP];
  for (int64_t k = 0; k < GROUP; k++)
    ends[2 * k] = k, ends[2 * k + 1] = k + offset;
  small_group(system, "springs", "group", GROUP, ends,
              "stiffness=%.17g rest_length=0.3 rest_scale=1.5 compression=false", stiffness);
}

static void add_bending(hooke_system *system, double coefficient) {
  int64_t triples[3 * GROUP];
  for (int64_t k = 0; k < GROUP; k++)
    triples[3 * k] = k, triples[3 * k + 1] = k + 1, triples[3 * k + 2] = k + 2;
  check_ok(hooke_system_add_bending(system, "bending", GROUP, triples, 1, &coefficient));
}

static hooke_system *build(struct scene scene) {
  static const double down[] = {0, 0, -9.81}, nothing[] = {0.0, -0.0, 0.0};
  static const int64_t pinned[] = {0, 16};
  hooke_system *system = new_system();
  if (scene.shape == NETWORK)
    add_network(&scene, system);
  else
    add_part(&scene, system);
  for (int64_t offset = 3; offset <= 5 && (is_zero(&scene, GROUPS) || is_full(&scene, GROUPS)); offset += 2)
    add_group(system, offset, is_zero(&scene, GROUPS) ? 0.0 : 0.5);
  if (is_zero(&scene, BENDING)) add_bending(system, 0.0);
  if (is_full(&scene, BENDING)) add_bending(system, 0.1);
  check_ok(hooke_system_pin(system, 2, pinned));
  if (is_zero(&scene, GRAVITY)) check_ok(hooke_system_set_gravity(system, nothing));
  if (is_full(&scene, GRAVITY)) check_ok(hooke_system_set_gravity(system, down));
  if (is_zero(&scene, DRAG)) check_ok(hooke_system_set_drag(system, -0.0));
  if (is_full(&scene, DRAG)) check_ok(hooke_system_set_drag(system, 0.02));
  return committed(system);
}

/* ---- the same instructions ---- */

static void check_same_forces(const hooke_system *found, const hooke_system *expected) {
  assert_int_equal(hooke_system_count(found, "forces"), hooke_system_count(expected, "forces"));
  for (int64_t k = 0; k < hooke_system_count(expected, "forces"); k++) {
    assert_string_equal(hooke_system_force_name(found, k), hooke_system_force_name(expected, k));
    assert_ptr_equal(found->force_row[k], expected->force_row[k]);
  }
  assert_int_equal(found->has_gravity, expected->has_gravity);
  assert_memory_equal(found->gravity, expected->gravity, sizeof found->gravity);
  assert_memory_equal(&found->drag, &expected->drag, sizeof found->drag);
}

static void check_same_runs(const struct hk_springs *found, const struct hk_springs *expected) {
  assert_int_equal(found->count, expected->count);
  assert_int_equal(found->run_count, expected->run_count);
  assert_int_equal(found->stored.indexed, expected->stored.indexed);
  assert_int_equal(found->stored.mixed, expected->stored.mixed);
  for (int64_t r = 0; r < expected->run_count; r++) {
    const struct hk_run *a = &found->run[r], *b = &expected->run[r];
    assert_true(a->loop == b->loop);
    assert_int_equal(a->shape, b->shape);
    assert_int_equal(a->first, b->first);
    assert_int_equal(a->count, b->count);
    for (int64_t k = 0; k < b->count; k++) {
      const struct hk_spring x = hk_run_spring(a, k), y = hk_run_spring(b, k);
      const double material[] = {x.kappa, x.gamma, x.rest_length},
                   wanted[] = {y.kappa, y.gamma, y.rest_length};
      assert_true(x.head == y.head && x.tail == y.tail);
      check_same_bits(3, material, wanted);
    }
  }
}

static void check_same_lanes(const hooke_system *found, const hooke_system *expected) {
  assert_int_equal(found->strided->count, expected->strided->count);
  for (int32_t k = 0; k < expected->strided->count; k++) {
    const struct hk_strided_batch *a = &found->strided->batch[k], *b = &expected->strided->batch[k];
    assert_true(a->offset == b->offset && a->first == b->first && a->last == b->last);
    assert_int_equal(a->shape, b->shape);
    const int64_t units = expected->particle_count / HOOKE_STRIDED_UNIT + 1;
    assert_memory_equal(a->present, b->present, (size_t)units);
  }
}

static void check_same_choice(const hooke_system *found, const hooke_system *expected) {
  check_same_forces(found, expected);
  check_same_runs(found->springs, expected->springs);
  assert_int_equal(found->rest->bending.count, expected->rest->bending.count);
  assert_int_equal(found->rest->bending.run_count, expected->rest->bending.run_count);
  check_same_lanes(found, expected);
  assert_int_equal(hooke_system_count(found, "springs"), hooke_system_count(expected, "springs"));
  assert_int_equal(hooke_system_count(found, "idle"), hooke_system_count(expected, "idle"));
}

/* ---- the same bits ---- */

static const char *const counts[] = {"steps", "force_evaluations", "derivative_products",
                                     "nonlinear_iterations", "linear_iterations"};
enum { COUNTS = sizeof counts / sizeof counts[0] };

static void run(const hooke_system *system, const char *method, hooke_state *state, int64_t count[COUNTS]) {
  owned_integrator *it = start_with(system, .method = method, .step = 1.0 / 1024, .duration = 10.0 / 1024);
  check_ok(hooke_integrator_run(it, state));
  for (int k = 0; k < COUNTS; k++)
    count[k] = hooke_integrator_count(it, counts[k]);
}

static void check_same_run(const hooke_system *found, const hooke_system *expected, const char *method) {
  int64_t a[COUNTS], b[COUNTS];
  owned_state *x = start_state(found), *y = start_state(expected);
  run(found, method, x, a);
  run(expected, method, y, b);
  check_same_bits(hooke_state_size(y), hooke_state_position(x), hooke_state_position(y));
  check_same_bits(hooke_state_size(y), hooke_state_velocity(x), hooke_state_velocity(y));
  assert_memory_equal(a, b, sizeof a);
}

static int64_t zeros_of(enum shape shape, enum ingredient what) {
  static const int64_t family[] = {15 * 13 + 17 * 11, 79,
                                   0}; /* every second particle along the lines of a part */
  int64_t count = 0;
  if (what == GROUPS || what == ALL) count += 2 * GROUP;
  if (what == FAMILY || what == ALL) count += family[shape];
  if ((what == SOME_SPRINGS || what == ALL) && shape == NETWORK) count += SPRINGS;
  return count;
}

static void check_scene(enum shape shape, enum ingredient what, int32_t full) {
  owned_system *with = build((struct scene){shape, what, full, 1});
  owned_system *without = build((struct scene){shape, what, full, 0});
  assert_int_equal(hooke_system_count(with, "dropped_springs"), zeros_of(shape, what));
  assert_int_equal(hooke_system_count(without, "dropped_springs"), 0);
  check_same_choice(with, without);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    if (hooke_method_is_built(hooke_method_name(m))) check_same_run(with, without, hooke_method_name(m));
  }
}

TEST(zero_strength_is_absence) {
  for (enum shape shape = CLOTH; shape < SHAPES; shape++) {
    for (enum ingredient what = GROUPS; what < INGREDIENTS; what++) {
      for (int32_t full = 0; full <= 1; full++)
        check_scene(shape, what, full);
    }
  }
}

/* The comparison can fail: with some strength, every ingredient affects the choice. */
TEST(strength_is_seen) {
  owned_system *full = build((struct scene){CLOTH, INGREDIENTS, 1, 0});
  for (enum ingredient what = GROUPS; what < ALL; what++) {
    if (what == SOME_SPRINGS) continue;
    owned_system *without = build((struct scene){CLOTH, what, 1, 0});
    int differs =
        full->springs->count != without->springs->count || full->force_row_count != without->force_row_count;
    for (int64_t r = 0; r < full->springs->run_count && r < without->springs->run_count; r++)
      differs |= full->springs->run[r].loop != without->springs->run[r].loop;
    assert_true(differs);
  }
  owned_system *cloth = build((struct scene){CLOTH, GROUPS, 0, 1});
  assert_in_range(cloth->strided->count, 1, HOOKE_MOST_STRIDED);
}

/* The canonical sum over all springs, including those without strength, has the bits of the sum without
 * these. */
TEST(canonical_sum_agrees) {
  struct network network;
  double found[3 * PARTICLES], expected[3 * PARTICLES], v[3 * PARTICLES] = {0.0};
  draw_network(1, 0.0, &network);
  owned_system *system = build((struct scene){NETWORK, SOME_SPRINGS, 0, 1});
  owned_canonical c;
  canonical_create(system, &c);
  struct canonical whole = c;
  whole.spring_count = network.count;
  whole.ends = network.ends;
  whole.kappa = network.stiffness;
  whole.gamma = network.damping;
  whole.rest_length = new_doubles(network.count);
  whole.pull_only = new_block(network.count, 1);
  whole.follows = new_block(network.count, 1);
  for (int64_t k = 0; k < network.count; k++)
    whole.rest_length[k] = REST;
  assert_int_equal(c.spring_count, SPRINGS);
  assert_int_equal(whole.spring_count, 2 * SPRINGS);
  check_ok(hooke_system_acceleration(system, 0.0, network.position, v, found));
  canonical_acceleration(&whole, 0.0, network.position, v, expected);
  check_same_bits(3 * PARTICLES, found, expected);
  free(whole.rest_length);
  free(whole.pull_only);
  free(whole.follows);
}

/* ---- numbers ---- */

/* Four particles in a row; a spring 0-1 without strength, a spring 1-2 with damping only, and a group without
 * members. */
TEST(numbers_are_of_what_is_there) {
  static const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0};
  static const int64_t ends[] = {0, 1, 1, 2}, last[] = {2, 3}, pinned[] = {0, 3};
  static const double stiffness[] = {0.0, 0.0}, damping[] = {0.0, 0.5};
  owned_system *system = small_system(4, q, NULL, 1.0, 0);
  int64_t found[2];
  double gamma;
  owned_options *options = new_options("springs");
  check_ok(hooke_options_set_numbers(options, "stiffness", 2, stiffness));
  check_ok(hooke_options_set_numbers(options, "damping", 2, damping));
  check_ok(hooke_system_add_springs(system, "some", 2, ends, options));
  check_ok(hooke_options_unset(options, "damping"));
  check_ok(hooke_options_set_number(options, "stiffness", 0.0));
  check_ok(hooke_system_add_springs(system, "none", 1, last, options));
  check_ok(hooke_system_pin(system, 2, pinned));
  assert_int_equal(hooke_system_count(system, "springs"), 3);
  assert_int_equal(hooke_system_count(system, "dropped_springs"), 0);
  assert_int_equal(hooke_system_count(system, "idle"), 0);
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "springs"), 1);
  assert_int_equal(hooke_system_count(system, "dropped_springs"), 2);
  assert_int_equal(hooke_system_group_count(system, "springs"), 2);
  assert_int_equal(hooke_system_group_size(system, "springs", 0), 1);
  assert_int_equal(hooke_system_group_size(system, "springs", 1), 0);
  assert_string_equal(hooke_system_group_name(system, "springs", 1), "none");
  check_ok(hooke_system_members(system, "springs", found, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, NULL, &gamma, NULL));
  assert_true(found[0] == 1 && found[1] == 2);
  check_close(gamma, 0.5, 0.0);
  assert_int_equal(hooke_system_count(system, "idle"), 2);
}

/* Not idle are: a pinned particle at the end of a spring, one of a triple with strength, one that a callback
 * may read, and a free one. */
TEST(idle_is_what_nothing_touches) {
  static const double q[] = {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0};
  static const int64_t ends[] = {0, 1}, pinned[] = {0, 2}, triple[] = {1, 2, 3};
  for (int k = 0; k < 4; k++) {
    const int callback = k == 1;
    const double bending = k == 2 ? 1.0 : 0.0;
    owned_system *system = small_system(4, q, NULL, 1.0, 0);
    springs_with(system, 1, ends, .stiffness = 5.0, .rest_length = -1.0);
    check_ok(hooke_system_pin(system, 2, pinned));
    if (k >= 2) check_ok(hooke_system_add_bending(system, NULL, 1, triple, 1, &bending));
    if (callback) check_ok(hooke_system_set_force(system, idle_force, NULL, NULL));
    check_ok(hooke_system_commit(system));
    assert_int_equal(hooke_system_count(system, "idle"), callback || bending > 0.0 ? 0 : 1);
  }
}
