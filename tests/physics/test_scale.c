/* Large scenes: their memory, and their last good state, of which they keep no copy. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <stdlib.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif

/* Above the size at which states are kept, in a memory of at most 16 MB. */
enum { SIDE = 420, PARTICLES = SIDE * SIDE, LONG_ROPE = 180000 };

/* Memory allocated; 0 if the allocator does not tell. */
static double bytes_in_use(void) {
#ifdef __GLIBC__
  const struct mallinfo2 all = mallinfo2();
  return (double)all.uordblks + (double)all.hblkhd;
#else
  return 0.0;
#endif
}

/* The stated memory equals that allocated since `before`. */
static double bytes_of_run(const hooke_system *system, const char *method, double before) {
  owned_run(integrator, made, system, .method = method, .step = 1e-6);
  const double taken = bytes_in_use() - before, size = (double)hooke_state_size(made);
  const double bytes = (double)hooke_system_count(system, "memory") + 8.0 * (2.0 * size + 1.0) +
                       (double)hooke_integrator_count(integrator, "memory_bytes");
  if (taken > 0.0) check_between(taken / bytes, 0.99, 1.02);
  return bytes;
}

static hooke_system *build_cloth(void) {
  hooke_system *system = new_system();
  small_part(system, "cloth", "cloth",
             "edges=1,0,0,0,0,1 size=%d,%d mass=1 structural.stiffness=50 "
             "structural.damping=0.01 shear.stiffness=50 bend.stiffness=50",
             (int)SIDE, (int)SIDE);
  return committed(system);
}

static int64_t *new_order(struct random_source *source, int64_t count) {
  int64_t *order = new_block(count, (int64_t)sizeof *order);
  for (int64_t k = 0; k < count; k++) {
    const int64_t other = random_whole(source, 0, k);
    order[k] = order[other];
    order[other] = k;
  }
  return order;
}

/* `kinds` springs from each particle of a sheet, all numbers in random order, every rest length different. */
static hooke_system *build_sheet(int kinds, int moving) {
  static const int step[6][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}};
  struct random_source source = {77};
  int64_t *number = new_order(&source, PARTICLES), *place = new_order(&source, (int64_t)kinds * PARTICLES);
  int64_t *ends = new_block(2 * kinds * PARTICLES, (int64_t)sizeof *ends), count = 0;
  owned_doubles *q = new_doubles(3 * PARTICLES), *v = new_doubles(3 * PARTICLES);
  for (int64_t k = 0; k < kinds * PARTICLES; k++) {
    const int64_t p = place[k] / kinds, row = p / SIDE + step[place[k] % kinds][0],
                  column = p % SIDE + step[place[k] % kinds][1];
    if (row >= SIDE || column < 0 || column >= SIDE) continue;
    ends[2 * count] = number[p];
    ends[2 * count++ + 1] = number[row * SIDE + column];
  }
  for (int64_t p = 0; p < PARTICLES; p++) {
    q[3 * number[p]] = (double)(p % SIDE) + random_between(&source, 0.0, 0.1);
    q[3 * number[p] + 2] = (double)(p / SIDE) + random_between(&source, 0.0, 0.1);
    v[3 * p] = moving ? random_between(&source, -1.0, 1.0) : 0.0;
  }
  const double mass = 1.0;
  hooke_system *system = small_system(PARTICLES, q, v, mass, 0);
  owned_options *options = options_with("springs", "stiffness=50 damping=0.01");
  check_ok(hooke_system_add_springs(system, "net", count, ends, options));
  check_ok(hooke_system_commit(system));
  free(number);
  free(place);
  free(ends);
  return system;
}

/* At least positions and velocities, twice. */
TEST(test_memory_of_a_cloth) {
  const double before = bytes_in_use();
  owned_system *system = build_cloth();
  check_between(bytes_of_run(system, "symplectic-euler", before) / PARTICLES, 96.0, 150.0);
  check_between(bytes_of_run(system, "forward-euler", before) / PARTICLES, 96.0, 150.0);
}

TEST(test_memory_without_order) {
  const int kinds[] = {3, 6, 3, 6};
  for (int k = 0; k < 4; k++) {
    const double before = bytes_in_use();
    owned_system *system = build_sheet(kinds[k], k >= 2);
    const double springs = (double)hooke_system_count(system, "springs");
    const double least = 96.0 * PARTICLES + 16.0 * springs, most = 200.0 * PARTICLES + 24.0 * springs;
    check_between(bytes_of_run(system, "symplectic-euler", before), least, most);
    check_between((double)hooke_system_count(system, "spring_memory") / springs, 16.0, 34.0);
  }
}

/* ---- the last good state ---- */

struct rope {
  hooke_system *system;
  int64_t stop_at; /* the drive stops at that call; 0: never */
  int64_t calls;
};

static int32_t drive(int64_t count, double t, double *q, double *v, void *ctx) {
  struct rope *rope = ctx;
  for (int64_t k = 0; k < 3 * count; k++)
    q[k] = v[k] = 0.0;
  q[0] = LONG_ROPE - 1;
  q[1] = t;
  return rope->stop_at > 0 && ++rope->calls == rope->stop_at ? 7 : 0;
}

static void build_rope(int driven, struct rope *rope) {
  struct random_source source = {3};
  owned_wholes *ends = new_block(2 * LONG_ROPE, (int64_t)sizeof *ends);
  owned_doubles *q = new_doubles(3 * LONG_ROPE);
  const double mass = 1.0;
  for (int64_t p = 0; p < LONG_ROPE; p++) {
    q[3 * p] = (double)p + random_between(&source, 0.0, 0.3);
    ends[2 * p] = p;
    ends[2 * p + 1] = p + 1;
  }
  check_ok(hooke_system_create(&rope->system));
  check_ok(hooke_system_add_particles(rope->system, LONG_ROPE, q, NULL, 1, &mass, NULL));
  owned_options *options = options_with("springs", "law=length stiffness=100 rest_length=1");
  check_ok(hooke_system_add_springs(rope->system, "rope", LONG_ROPE - 1, ends, options));
  const int64_t last = LONG_ROPE - 1;
  if (driven) check_ok(hooke_system_drive_callback(rope->system, 1, &last, drive, rope));
  check_ok(hooke_system_commit(rope->system));
}

static int32_t look(int64_t step, const hooke_state *state, void *ctx) {
  (void)step, (void)state, (void)ctx;
  return 0;
}

/* A run in two parts: some steps, then a continuation; the second keeps a copy of the last good state if
 * `watched`. */
struct outcome {
  hooke_integrator *integrator;
  hooke_state *state;
  int32_t first, second;
};

static void take(struct rope *rope, double step, int watched, struct outcome *outcome) {
  const struct run run = {.method = "symplectic-euler", .step = step};
  rope->calls = 0;
  outcome->state = start_state(rope->system);
  outcome->integrator = start_run(rope->system, run);
  if (watched == 1) check_ok(hooke_integrator_on_step(outcome->integrator, 1000, look, NULL));
  outcome->first = hooke_integrator_step(outcome->integrator, outcome->state, 5);
  if (watched == 2) check_ok(hooke_integrator_on_step(outcome->integrator, 1000, look, NULL));
  outcome->second = hooke_integrator_step(outcome->integrator, outcome->state, 100);
}

static void release(struct outcome *outcome) {
  hooke_integrator_destroy(outcome->integrator);
  hooke_state_destroy(outcome->state);
}

static void check_same(const struct outcome *found, const struct outcome *wanted) {
  const int64_t size = hooke_state_size(wanted->state);
  assert_int_equal(found->first, wanted->first);
  assert_int_equal(found->second, wanted->second);
  check_close(hooke_state_time(found->state), hooke_state_time(wanted->state), 0.0);
  check_same_bits(size, hooke_state_position(found->state), hooke_state_position(wanted->state));
  check_same_bits(size, hooke_state_velocity(found->state), hooke_state_velocity(wanted->state));
  assert_int_equal(hooke_integrator_count(found->integrator, "steps"),
                   hooke_integrator_count(wanted->integrator, "steps"));
}

static void check_recent(const struct rope *rope, const struct outcome *outcome) {
  owned_state *recent = start_state(rope->system);
  assert_int_equal(hooke_integrator_count(outcome->integrator, "recent"), 1);
  check_ok(hooke_integrator_recent(outcome->integrator, 0, recent));
  check_status(hooke_integrator_recent(outcome->integrator, 1, recent), HOOKE_BAD_VALUE);
  check_close(hooke_state_time(recent), hooke_state_time(outcome->state), 0.0);
  check_same_bits(hooke_state_size(recent), hooke_state_position(recent),
                  hooke_state_position(outcome->state));
  check_same_bits(hooke_state_size(recent), hooke_state_velocity(recent),
                  hooke_state_velocity(outcome->state));
}

static void compare(struct rope *rope, double step, int32_t status) {
  struct outcome plain, watched;
  take(rope, step, 1, &watched);
  assert_int_equal(watched.second, status);
  for (int late = 0; late <= 2; late += 2) {
    take(rope, step, late, &plain);
    check_same(&plain, &watched);
    if (status != HOOKE_STOPPED) check_recent(rope, &plain);
    if (status == HOOKE_DIVERGED) {
      check_close(hooke_integrator_number(plain.integrator, "diverged_at"),
                  hooke_integrator_number(watched.integrator, "diverged_at"), 0.0);
      assert_true(hooke_state_time(plain.state) < hooke_integrator_number(plain.integrator, "diverged_at"));
    }
    release(&plain);
  }
  release(&watched);
}

TEST(test_last_good_state) {
  struct rope rope = {NULL, 0, 0};
  build_rope(0, &rope);
  compare(&rope, 0.01, HOOKE_OK);
  compare(&rope, 10.0, HOOKE_DIVERGED); /* the limit is 0.1, and a step far above it soon overflows */
  hooke_system_destroy(rope.system);
}

TEST(test_stops) {
  struct rope rope = {NULL, 40, 0};
  build_rope(1, &rope);
  compare(&rope, 0.01, HOOKE_STOPPED);
  hooke_system_destroy(rope.system);
}
