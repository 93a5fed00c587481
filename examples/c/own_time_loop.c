/* A time loop of one's own: a cloth falls on the floor. hooke takes the steps; between two of them the
 * program looks at the particles and bounces those that are below the floor, by writing into the state. */
#include <hooke.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s: %s\n", hooke_status_name(status), hooke_last_error());
  exit(1);
}

static hooke_system *falling_cloth(void) {
  hooke_system *system;
  hooke_options *cloth;
  check(hooke_system_create(&system));
  check(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  check(hooke_options_create("cloth", &cloth));
  check(hooke_options_set_text(cloth, "origin", "0,0.3,0"));
  check(hooke_options_set_numbers(cloth, "edges", 6, (double[]){1, 0, 0, 0, 0.5, 1})); /* m, aslant */
  check(hooke_options_set_text(cloth, "size", "16,16"));
  check(hooke_options_set_number(cloth, "mass", 0.5));                 /* kg */
  check(hooke_options_set_number(cloth, "structural.stiffness", 100)); /* N */
  check(hooke_options_set_number(cloth, "structural.damping", 0.05));  /* N s */
  check(hooke_options_set_number(cloth, "shear.stiffness", 50));
  check(hooke_options_set_number(cloth, "shear.damping", 0.05));
  check(hooke_system_add_part(system, "cloth", "cloth", cloth, NULL, NULL));
  check(hooke_system_commit(system));
  hooke_options_destroy(cloth);
  return system;
}

/* Returns how many particles were below the floor y = 0. */
static int bounce(hooke_state *state) {
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  int below = 0;
  for (int64_t k = 0; k < hooke_state_size(state); k += 3) {
    if (q[k + 1] >= 0) continue;
    q[k + 1] = 0;
    if (v[k + 1] < 0) v[k + 1] *= -0.2;
    v[k] *= 0.9; /* friction */
    v[k + 2] *= 0.9;
    below++;
  }
  return below;
}

int main(void) {
  const double step = 1e-4; /* s; at a quarter of it the printed digits are the same */
  const int tenth = (int)round(0.1 / step);
  hooke_system *system = falling_cloth();
  hooke_options *run;
  hooke_integrator *integrator;
  hooke_state *state;
  check(hooke_options_create("run", &run));
  check(hooke_options_set_text(run, "method", "symplectic-euler"));
  check(hooke_options_set_number(run, "step", step));
  check(hooke_integrator_create(system, run, &integrator));
  check(hooke_state_create(system, &state));

  for (int k = 1; k <= 6 * tenth; k++) {
    check(hooke_integrator_step(integrator, state, 1));
    const int below = bounce(state);
    if (k % tenth == 0)
      printf("t = %.1f s: %.1f J of motion, particles on the floor: %s\n", hooke_state_time(state),
             hooke_system_energy(system, "kinetic", NULL, hooke_state_velocity(state)),
             below > 0 ? "yes" : "no");
  }

  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
  return 0;
}
