/* A program with its own idea of every type and number, which later versions of the library have to run: two
 * strands of three particles by one call each of what the first version had, checked against what a mass on a
 * spring has to do. */
#include "hooke.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define CHECK(what)                                                                                          \
  do {                                                                                                       \
    if (!(what)) {                                                                                           \
      fprintf(stderr, "line %d: %s: %s\n", __LINE__, #what, hooke_last_error());                             \
      return 1;                                                                                              \
    }                                                                                                        \
  } while (0)

static int32_t pull(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)q, (void)v;
  force[3 * (n - 1)] += *(const double *)ctx;
  return t > 1e9;
}

static int32_t watch(int64_t step, const hooke_state *state, void *ctx) {
  int64_t *frames = ctx;
  ++*frames;
  return hooke_state_time(state) < 0 || step < 0;
}

static int build(hooke_system **system, double *newtons) {
  hooke_options *spring = NULL, *rope = NULL;
  int64_t first = -1, count = -1;
  CHECK(hooke_system_create(system) == 0);
  CHECK(hooke_system_add_particles(*system, 3, (double[]){0, 0, 0, 1, 0, 0, 2, 0, 0}, NULL, 1, (double[]){2},
                                   &first) == 0);
  CHECK(first == 0);
  CHECK(hooke_system_pin(*system, 2, (int64_t[]){0, 1}) == 0);
  CHECK(hooke_options_create("springs", &spring) == 0);
  CHECK(hooke_options_set_number(spring, "stiffness", 8) == 0);
  CHECK(hooke_options_set_text(spring, "law", "length") == 0);
  CHECK(hooke_system_add_springs(*system, "chain", 2, (int64_t[]){0, 1, 1, 2}, spring) == 0);
  CHECK(hooke_options_create("rope", &rope) == 0);
  CHECK(hooke_options_set_numbers(rope, "from", 3, (double[]){0, 0, 5}) == 0);
  CHECK(hooke_options_set_text(rope, "to", "1,0,5") == 0);
  CHECK(hooke_options_set_number(rope, "segments", 2) == 0);
  CHECK(hooke_options_set_number(rope, "mass", 3) == 0);
  CHECK(hooke_options_set_number(rope, "stretch.stiffness", 10) == 0);
  CHECK(hooke_system_add_part(*system, "rope", "line", rope, &first, &count) == 0);
  CHECK(first == 3 && count == 3);
  CHECK(hooke_system_set_force(*system, pull, NULL, newtons) == 0);
  CHECK(hooke_system_commit(*system) == 0);
  CHECK(hooke_system_particle_count(*system) == 6 && hooke_system_count(*system, "springs") == 4);
  hooke_options_destroy(spring);
  hooke_options_destroy(rope);
  return 0;
}

static int run(const hooke_system *system, double newtons) {
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int64_t frames = 0;
  double momentum[3];
  CHECK(hooke_options_create("run", &options) == 0);
  CHECK(hooke_options_set_number(options, "step", -1) == HOOKE_BAD_VALUE &&
        strstr(hooke_last_error(), "step"));
  CHECK(hooke_options_set_text(options, "method", "symplectic-euler") == 0);
  CHECK(hooke_options_set_number(options, "step", 0.25) == 0);
  CHECK(hooke_options_set_number(options, "duration", 1) == 0);
  CHECK(hooke_options_set_number(options, "every", 0.5) == 0);
  CHECK(hooke_integrator_create(system, options, &integrator) == 0);
  CHECK(hooke_integrator_on_frame(integrator, watch, &frames) == 0);
  CHECK(hooke_state_create(system, &state) == 0);
  CHECK(hooke_integrator_count(integrator, "frames") == 3);
  CHECK(hooke_integrator_run(integrator, state) == HOOKE_OK);
  CHECK(frames == 3 && hooke_integrator_count(integrator, "steps") == 4);
  CHECK(hooke_state_time(state) == 1.0 && hooke_state_size(state) == 18);
  /* the rope is free: what was pulled for a second is its momentum, and the chain, at rest, stays */
  CHECK(hooke_state_position(state)[6] == 2.0 && hooke_state_velocity(state)[6] == 0.0);
  hooke_system_momentum(system, hooke_state_velocity(state), momentum);
  CHECK(fabs(momentum[0] - newtons) < 1e-12);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  return 0;
}

int main(void) {
  hooke_system *system = NULL;
  double newtons = 0.75;
  CHECK(hooke_abi() == HOOKE_ABI);
  CHECK(strcmp(hooke_status_name(HOOKE_DIVERGED), hooke_status_name(HOOKE_OK)) != 0);
  if (build(&system, &newtons) || run(system, newtons)) return 1;
  hooke_system_destroy(system);
  printf("compiled with %s, runs with %s\n", HOOKE_VERSION, hooke_version());
  return 0;
}
