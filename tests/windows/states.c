/* Takes steps of scenes by every method with a fixed step: `states STEPS SCENE...` prints a line "<scene>
 * <method> <bytes of the positions and velocities, as hexadecimal digits>" for each. */
#include "hooke.h"

#include <stdio.h>
#include <stdlib.h>

static void require(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s\n", hooke_last_error());
  exit(1);
}

static void print_bytes(const double *number, int64_t count) {
  const unsigned char *bytes = (const unsigned char *)number;
  for (int64_t k = 0; k < count * (int64_t)sizeof *number; k++)
    printf("%02x", bytes[k]);
}

static void run_method(const char *path, hooke_scene *scene, const char *method, int64_t steps) {
  const hooke_system *system = hooke_scene_system(scene);
  const int64_t numbers = 3 * hooke_system_particle_count(system);
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  require(hooke_options_create("run", &options));
  require(hooke_options_set_text(options, "method", method));
  require(hooke_options_set_number(options, "step",
                                   hooke_options_number(hooke_scene_run_options(scene), "step")));
  require(hooke_integrator_create(system, options, &integrator));
  require(hooke_state_create(system, &state));
  require(hooke_integrator_step(integrator, state, steps));
  printf("%s %s ", path, method);
  print_bytes(hooke_state_position(state), numbers);
  print_bytes(hooke_state_velocity(state), numbers);
  putchar('\n');
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
}

int main(int argc, char **argv) {
  const int64_t steps = argc > 1 ? atoi(argv[1]) : 0;
  for (int k = 2; k < argc; k++) {
    hooke_scene *scene = NULL;
    require(hooke_scene_load(argv[k], NULL, &scene));
    require(hooke_scene_commit(scene));
    for (int64_t m = 0; m < hooke_method_count(); m++) {
      if (!hooke_method_is_adaptive(hooke_method_name(m)))
        run_method(argv[k], scene, hooke_method_name(m), steps);
    }
    hooke_scene_destroy(scene);
  }
  return 0;
}
