/* Idle pinned particles are not stepped, without any effect: the moving particles have the same bits without
 * them, and idle ones stay where they are. */
#include "check.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <string.h>

enum { MARKS = 700 }; /* more than two tiles, before the cloth and after it */

static void add_marks(hooke_system *system, int64_t count) {
  const double mass = 1.0;
  for (int64_t k = 0; k < count; k++) {
    const double at[3] = {0.01 * (double)k, 3.0, -1.0};
    int64_t p;
    check_ok(hooke_system_add_particles(system, 1, at, NULL, 1, &mass, &p));
    check_ok(hooke_system_pin(system, 1, &p));
  }
}

/* A cloth that hangs from its upper corners, with `before` and `after` idle particles. */
static hooke_system *new_scene(int64_t before, int64_t after, double damping) {
  const double gravity[3] = {0, -9.81, 0};
  hooke_system *system = new_system();
  add_marks(system, before);
  small_part(system, "cloth", "cloth",
             "edges=1,0,0,0,0,1 size=12,11 mass=1 pinned=top-corners "
             "structural.stiffness=50 structural.damping=%.17g shear.stiffness=20",
             damping);
  add_marks(system, after);
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, 0.01));
  return committed(system);
}

static void check_method(const char *method, int64_t before, int64_t after, double damping) {
  owned_system *alone = new_scene(0, 0, damping), *among = new_scene(before, after, damping);
  const int64_t n = hooke_system_particle_count(alone), all = hooke_system_particle_count(among);
  const struct run run = {.method = method,
                          .step = 1e-3,
                          .duration = 0.05,
                          .every = 0.01,
                          .atol = 1e-9, /* in one scale: the extents of the two differ */
                          .atol_velocity = 1e-9};
  owned_doubles *q = new_doubles(3 * n), *v = new_doubles(3 * n), *q2 = new_doubles(3 * all),
                *v2 = new_doubles(3 * all);
  assert_int_equal(all, n + before + after);
  assert_int_equal(hooke_system_count(among, "idle"), before + after);
  assert_int_equal(hooke_system_count(alone, "idle"), 0);
  run_to_end(alone, run, q, v);
  run_to_end(among, run, q2, v2);
  /* where something is solved for, sums over all unknowns come in other blocks */
  const int solves =
      !is_fixed_step(method) || is_implicit(method) || (strcmp(method, "verlet") == 0 && damping > 0.0);
  if (!solves) {
    check_same_bits(3 * n, q2 + 3 * before, q);
    check_same_bits(3 * n, v2 + 3 * before, v);
  } else {
    check_between(largest_difference(3 * n, q2 + 3 * before, q), 0.0, is_fixed_step(method) ? 1e-13 : 1e-7);
  }
  owned_state *state = start_state(among);
  const double *at = hooke_state_position(state);
  check_same_bits(3 * before, q2, at);
  check_same_bits(3 * after, q2 + 3 * (before + n), at + 3 * (before + n));
  for (int64_t k = 0; k < 3 * all; k++) {
    if (k < 3 * before || k >= 3 * (before + n)) assert_true(v2[k] == 0.0);
  }
}

TEST(marks_change_nothing) {
  enum { COUNTS = 4 };
  static const int64_t count[COUNTS][2] = {{MARKS, 0}, {0, MARKS}, {MARKS + 3, MARKS - 100}, {5, 1}};
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    const char *method = hooke_method_name(k);
    if (!hooke_method_is_built(method)) continue;
    for (int64_t c = 0; c < 2 * COUNTS; c++) { /* without damping, then with it */
      if (!left_out(k + c, 3))
        check_method(method, count[c % COUNTS][0], count[c % COUNTS][1], 0.01 * (c >= COUNTS));
    }
  }
}
