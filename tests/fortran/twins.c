/* The computations of the Fortran tests, in C. */
#include <hooke.h>

#include <stddef.h>
#include <string.h>

int32_t twin_rope(const char *method, double *q, double *v);
int32_t twin_status(int32_t place);
int32_t twin_version(const char *text);

static int32_t make_rope(hooke_system *system) {
  hooke_options *rope = NULL;
  int32_t status = hooke_options_create("rope", &rope);
  if (!status) status = hooke_options_set_text(rope, "from", "0,0,0");
  if (!status) status = hooke_options_set_text(rope, "to", "1,0,0.25");
  if (!status) status = hooke_options_set_number(rope, "segments", 8);
  if (!status) status = hooke_options_set_number(rope, "mass", 0.25);
  if (!status) status = hooke_options_set_text(rope, "pinned", "start");
  if (!status) status = hooke_options_set_number(rope, "stretch.stiffness", 200);
  if (!status) status = hooke_options_set_number(rope, "stretch.damping", 0.05);
  if (!status) status = hooke_options_set_number(rope, "bending", 1e-4);
  if (!status) status = hooke_system_set_gravity(system, (double[]){0, -9.81, 0});
  if (!status) status = hooke_system_set_drag(system, 1e-3);
  if (!status) status = hooke_system_add_part(system, "rope", "rope", rope, NULL, NULL);
  if (!status) status = hooke_system_commit(system);
  hooke_options_destroy(rope);
  return status;
}

static int32_t run_rope(const hooke_system *system, const char *method, double *q, double *v) {
  hooke_options *run = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int32_t status = hooke_options_create("run", &run);
  if (!status) status = hooke_options_set_text(run, "method", method);
  if (!status) status = hooke_options_set_number(run, "step", 5e-4);
  if (!status) status = hooke_options_set_number(run, "duration", 0.2);
  if (!status) status = hooke_integrator_create(system, run, &integrator);
  if (!status) status = hooke_state_create(system, &state);
  if (!status) status = hooke_integrator_run(integrator, state);
  if (!status) {
    memcpy(q, hooke_state_position(state), sizeof(double) * (size_t)hooke_state_size(state));
    memcpy(v, hooke_state_velocity(state), sizeof(double) * (size_t)hooke_state_size(state));
  }
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(run);
  return status;
}

int32_t twin_rope(const char *method, double *q, double *v) {
  hooke_system *system = NULL;
  int32_t status = hooke_system_create(&system);
  if (!status) status = make_rope(system);
  if (!status) status = run_rope(system, method, q, v);
  hooke_system_destroy(system);
  return status;
}

int32_t twin_status(int32_t place) {
  const int32_t all[] = {HOOKE_OK,        HOOKE_STOPPED,   HOOKE_DIVERGED,      HOOKE_STEP_LIMIT,
                         HOOKE_NO_MEMORY, HOOKE_BAD_VALUE, HOOKE_BAD_CALL,      HOOKE_IO_FAILED,
                         HOOKE_NOT_BUILT, HOOKE_UNSUITED,  HOOKE_SOLVER_FAILED, HOOKE_INTERNAL};
  return place >= 1 && place <= (int32_t)(sizeof all / sizeof *all) ? all[place - 1] : 99;
}

int32_t twin_version(const char *text) {
  return strcmp(text, HOOKE_VERSION) == 0;
}
