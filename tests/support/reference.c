#include "reference.h"

#include "check.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

const struct reference references[REFERENCE_COUNT] = {
    {
#include "../data/oscillator.inc"
    },
    {
#include "../data/six_particles.inc"
    },
    {
#include "../data/elastic_pendulum.inc"
    },
    {
#include "../data/rope_12.inc"
    },
};

const struct reference_errors reference_errors[REFERENCE_ERROR_COUNT] = {
#include "../data/fixed_step_errors.inc"
};

const struct reference *find_reference(const char *name) {
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    if (strcmp(references[k].name, name) == 0) return &references[k];
  }
  check_failed("there is no reference %s", name);
  return NULL;
}

static void add_group(hooke_system *system, const struct reference_group *group) {
  owned_options *options = options_with("springs", "law=%s stiffness=%.17g damping=%.17g rest_scale=%.17g",
                                        group->law, group->stiffness, group->damping, group->rest_scale);
  if (group->rest_length < 0.0)
    check_ok(hooke_options_set_text(options, "rest_length", "initial"));
  else
    check_ok(hooke_options_set_number(options, "rest_length", group->rest_length));
  check_ok(hooke_system_add_springs(system, group->name, group->count, group->ends, options));
}

hooke_system *build_reference(const struct reference *reference) {
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, reference->particle_count, reference->position, NULL,
                                      reference->mass_count, reference->mass, NULL));
  check_ok(hooke_system_pin(system, reference->pinned_count, reference->pinned));
  for (int64_t g = 0; g < reference->group_count; g++)
    add_group(system, &reference->group[g]);
  if (reference->gravity != NULL) check_ok(hooke_system_set_gravity(system, reference->gravity));
  return committed(system);
}

double true_error(const struct reference_state *expected, const hooke_system *system, struct run run) {
  const int64_t n = hooke_system_particle_count(system);
  double *q = new_doubles(3 * n), sum = 0.0, count = 0.0;
  run_to_end(system, run, q, NULL);
  for (int64_t p = 0; p < n; p++) {
    if (hooke_system_inverse_mass(system)[p] == 0.0) continue;
    for (int a = 0; a < 3; a++)
      sum += pow(q[3 * p + a] - expected->position[3 * p + a], 2.0);
    count += 1.0;
  }
  free(q);
  return sqrt(sum / count);
}
