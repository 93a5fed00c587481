/* Energies that a run hands to its observers with a frame are those of its numbers, to the bit; frames that
 * were not checked have none, and neither has a state that is no frame. */
#include "check.h"
#include "run.h"
#include "small.h"

#include "model/state.h"

#include <math.h>

enum { SEGMENTS = 12, FRAMES = 9 };

static hooke_system *hanging_rope(int outside) {
  hooke_system *system = small_part(
      NULL, "rope", NULL,
      "from=0,0,0 to=1,0.1,0 segments=%d mass=0.5 stretch.stiffness=20 stretch.damping=0.01", SEGMENTS);
  check_ok(hooke_system_pin(system, 1, &(const int64_t){0}));
  check_ok(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  if (outside) check_ok(hooke_system_set_force(system, idle_force, NULL, NULL));
  return committed(system);
}

struct watch {
  const hooke_system *system;
  int32_t frames, known;
};

static int32_t on_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct watch *watch = ctx;
  (void)step;
  watch->frames++;
  if (state->known == NULL) return 0;
  watch->known++;
  hooke_state unknown = *state;
  unknown.known = NULL;
  const struct hk_energies known = hk_state_energies(state, watch->system),
                           found = hk_state_energies(&unknown, watch->system);
  assert_memory_equal(&known, &found, sizeof known);
  assert_true(known.potential == hooke_system_energy(watch->system, "potential", state->q, NULL));
  assert_true(known.kinetic == hooke_system_energy(watch->system, "kinetic", NULL, state->v));
  assert_true(known.gravity == hooke_system_energy(watch->system, "gravity", state->q, NULL));
  assert_true(fabs(known.elastic + known.gravity - known.potential) <= 1e-12 * fabs(known.gravity));
  return 0;
}

/* The frames of a run, and how many of them came with energies. */
static struct watch watch_run(const hooke_system *system, const char *method, double step, int32_t ends) {
  struct watch watch = {.system = system};
  owned_options *options = run_options(
      (struct run){.method = method, .step = step, .duration = (FRAMES - 1) * 0.02, .every = 0.02});
  owned_integrator *integrator = NULL;
  if (step > 0.0) check_ok(hooke_options_set_number(options, "past_divergence", 1));
  check_ok(hooke_integrator_create(system, options, &integrator));
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_on_frame(integrator, on_frame, &watch));
  check_status(hooke_integrator_run(integrator, state), ends);
  assert_null(state->known);
  return watch;
}

TEST(every_checked_frame_has_its_own) {
  owned_system *system = hanging_rope(0);
  const char *const methods[] = {"symplectic-euler", "rk4", "backward-euler"};
  for (int k = 0; k < 3; k++) {
    const struct watch watch = watch_run(system, methods[k], 1e-3, HOOKE_OK);
    assert_int_equal(watch.frames, FRAMES);
    assert_int_equal(watch.known, FRAMES);
  }
  if (hooke_method_is_built("cvode-adams"))
    assert_int_equal(watch_run(system, "cvode-adams", 0.0, HOOKE_OK).known, FRAMES);
}

TEST(frames_after_divergence_have_none) {
  owned_system *system = hanging_rope(0);
  const struct watch watch = watch_run(system, "symplectic-euler", 0.02, HOOKE_DIVERGED);
  assert_in_range(watch.known, 1, FRAMES - 2);
  assert_true(watch.frames > watch.known);
}

TEST(energy_from_outside_is_not_followed) {
  owned_system *system = hanging_rope(1);
  const struct watch watch = watch_run(system, "symplectic-euler", 1e-3, HOOKE_OK);
  assert_int_equal(watch.frames, FRAMES);
  assert_int_equal(watch.known, 0);
}
