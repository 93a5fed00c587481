/* A mass on a spring, one step by hand and one by hooke: prints the version and returns 0 if the two agree.
 */
#include <hooke.h>

#include <math.h>
#include <stdio.h>

static int32_t make(hooke_system **system, hooke_state **state) {
  const double position[6] = {0, 0, 0, 1.5, 0, 0}, mass = 2;
  const int64_t ends[2] = {0, 1}, pinned = 0;
  hooke_options *spring = NULL;
  int32_t status = hooke_system_create(system);
  if (!status) status = hooke_system_add_particles(*system, 2, position, NULL, 1, &mass, NULL);
  if (!status) status = hooke_system_pin(*system, 1, &pinned);
  if (!status) status = hooke_options_create("springs", &spring);
  if (!status) status = hooke_options_set_number(spring, "stiffness", 8);
  if (!status) status = hooke_options_set_number(spring, "rest_length", 1);
  if (!status) status = hooke_system_add_springs(*system, NULL, 1, ends, spring);
  if (!status) status = hooke_system_commit(*system);
  if (!status) status = hooke_state_create(*system, state);
  hooke_options_destroy(spring);
  return status;
}

static int32_t step(const hooke_system *system, hooke_state *state) {
  hooke_options *run = NULL;
  hooke_integrator *integrator = NULL;
  int32_t status = hooke_options_create("run", &run);
  if (!status) status = hooke_options_set_text(run, "method", "symplectic-euler");
  if (!status) status = hooke_options_set_number(run, "step", 0.01);
  if (!status) status = hooke_integrator_create(system, run, &integrator);
  if (!status) status = hooke_integrator_step(integrator, state, 1);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(run);
  return status;
}

int main(void) {
  hooke_system *system = NULL;
  hooke_state *state = NULL;
  double x = 0;
  int32_t status = make(&system, &state);
  if (!status) status = step(system, state);
  if (status) fprintf(stderr, "%s\n", hooke_last_error());
  if (!status) x = hooke_state_position(state)[3];
  hooke_state_destroy(state);
  hooke_system_destroy(system);

  const double v = 0.01 * (-8 * 0.5) / 2, expected = 1.5 + 0.01 * v;
  printf("%s %.17g\n", hooke_version(), x);
  return status != 0 || hooke_abi() != HOOKE_ABI || fabs(x - expected) > 1e-14;
}
