/* Cost of subnormal numbers: the time for one spring in one step of a cloth whose motion has decayed into
 * them, and that of the same cloth at ordinary speeds. Prints nanoseconds a spring-step, the minimum of
 * several turns.
 *
 *   denormals [side [turns]] */
#include "hooke.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void demand(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s\n", hooke_last_error());
  exit(1);
}

/* A flat cloth of `side` by `side` particles, at its rest lengths, with springs of rest length 0.1 m. */
static hooke_system *cloth(int64_t side) {
  const double origin[] = {0, 0, 0}, length = 0.125 * (double)(side - 1);
  const double edges[] = {length, 0, 0, 0, 0, length}, size[] = {(double)side, (double)side};
  const char *families[] = {"structural", "shear", "bend"};
  hooke_options *part = NULL;
  hooke_system *system = NULL;
  demand(hooke_options_create("cloth", &part));
  demand(hooke_options_set_numbers(part, "origin", 3, origin));
  demand(hooke_options_set_numbers(part, "edges", 6, edges));
  demand(hooke_options_set_numbers(part, "size", 2, size));
  demand(hooke_options_set_number(part, "mass", 0.01 * (double)(side * side)));
  for (int k = 0; k < 3; k++) {
    char name[64];
    snprintf(name, sizeof name, "%s.stiffness", families[k]);
    demand(hooke_options_set_number(part, name, 50.0));
    snprintf(name, sizeof name, "%s.damping", families[k]);
    demand(hooke_options_set_number(part, name, 0.02));
  }
  demand(hooke_system_create(&system));
  demand(hooke_system_add_part(system, "cloth", NULL, part, NULL, NULL));
  demand(hooke_system_commit(system));
  hooke_options_destroy(part);
  return system;
}

/* Random velocities of this size. */
static void shake(hooke_state *state, double size) {
  double *v = hooke_state_velocity(state);
  uint64_t seed = 1;
  for (int64_t k = 0; k < hooke_state_size(state); k++) {
    seed = seed * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    v[k] = size * ((double)(seed >> 11) * 0x1p-52 - 1.0);
  }
}

static double share_of_subnormal(hooke_state *state) {
  const int64_t size = hooke_state_size(state);
  const double *v = hooke_state_velocity(state);
  int64_t count = 0;
  for (int64_t k = 0; k < size; k++)
    count += fpclassify(v[k]) == FP_SUBNORMAL;
  return (double)count / (double)size;
}

/* `share`: fraction of velocities that are subnormal at the end. */
static double nanoseconds(const hooke_system *system, const hooke_options *run, double speed, int64_t steps,
                          double *share) {
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  demand(hooke_integrator_create(system, run, &integrator));
  demand(hooke_state_create(system, &state));
  shake(state, speed);
  demand(hooke_integrator_step(integrator, state, steps));
  const double seconds = hooke_integrator_number(integrator, "wall_seconds");
  *share = share_of_subnormal(state);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  return 1e9 * seconds / ((double)steps * (double)hooke_system_count(system, "springs"));
}

int main(int argc, char **argv) {
  const int64_t side = argc > 1 ? strtoll(argv[1], NULL, 10) : 64,
                turns = argc > 2 ? strtoll(argv[2], NULL, 10) : 15, steps = 200;
  const double speeds[] = {1e-3, 1e-300, 1e-310, 1e-318};
  const char *words[] = {"ordinary, 1e-3 m/s", "normal, but products are not, 1e-300 m/s",
                         "subnormal, 1e-310 m/s", "subnormal, 1e-318 m/s"};
  double least[] = {INFINITY, INFINITY, INFINITY, INFINITY}, share[4] = {0.0};
  hooke_options *run = NULL;
  hooke_system *system = cloth(side);
  demand(hooke_options_create("run", &run));
  demand(hooke_options_set_number(run, "step", 1e-4));
  for (int64_t turn = 0; turn < turns; turn++) { /* in turns, so that all see the same machine */
    for (int k = 0; k < 4; k++)
      least[k] = fmin(least[k], nanoseconds(system, run, speeds[k], steps, &share[k]));
  }
  printf("cloth %lld x %lld, %lld springs, symplectic-euler, %s\n", (long long)side, (long long)side,
         (long long)hooke_system_count(system, "springs"), hooke_build_fact("instructions"));
  for (int k = 0; k < 4; k++)
    printf("%-42s %7.3f ns  %5.2f times  %3.0f %% of velocities subnormal\n", words[k], least[k],
           least[k] / least[0], 100.0 * share[k]);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
  return 0;
}
