#include "reference.h"

#include "check.h"
#include "small.h"

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
    {
#include "../data/chain_16.inc"
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
  hooke_options *options = options_with("springs", "law=%s stiffness=%.17g damping=%.17g rest_scale=%.17g",
                                        group->law, group->stiffness, group->damping, group->rest_scale);
  if (group->rest_length < 0.0)
    check_ok(hooke_options_set_text(options, "rest_length", "initial"));
  else
    check_ok(hooke_options_set_number(options, "rest_length", group->rest_length));
  check_ok(hooke_system_add_springs(system, group->name, group->count, group->ends, options));
  hooke_options_destroy(options);
}

hooke_system *build_reference(const struct reference *reference) {
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, reference->particle_count, reference->position, NULL,
                                      reference->mass_count, reference->mass, NULL));
  check_ok(hooke_system_pin(system, reference->pinned_count, reference->pinned));
  for (int64_t g = 0; g < reference->group_count; g++)
    add_group(system, &reference->group[g]);
  if (reference->gravity != NULL) check_ok(hooke_system_set_gravity(system, reference->gravity));
  check_ok(hooke_system_commit(system));
  return system;
}
