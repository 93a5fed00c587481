/* Scenes with solutions to 15 digits, and the expected errors of fixed-step methods (data: tests/data). */
#pragma once

#include "run.h"

struct reference_group {
  const char *name, *law;
  int64_t count;
  const int64_t *ends;
  double stiffness, damping;
  double rest_length; /* -1: the initial length */
  double rest_scale;
};

struct reference_state {
  double time, kinetic_energy, gravity_energy, spring_energy;
  const double *position, *velocity;
};

struct reference {
  const char *name;
  int64_t particle_count, mass_count, pinned_count, group_count, state_count;
  const double *position, *mass, *gravity; /* gravity NULL: none */
  const int64_t *pinned;
  const struct reference_group *group;
  const struct reference_state *state;
};

enum { REFERENCE_COUNT = 4 };
extern const struct reference references[REFERENCE_COUNT];

/* The reference of that name; fails the test if there is none. */
const struct reference *find_reference(const char *name);

/* A committed system of the scene; the caller destroys it. */
hooke_system *build_reference(const struct reference *reference);

/* Root mean square distance of the free particles at the end of a run from the solution there [m]. */
double true_error(const struct reference_state *expected, const hooke_system *system, struct run run);

struct reference_errors {
  const char *method, *newton, *verlet_damping; /* NULL: the default */
  double allowed;                               /* of an error, relative */
  double error[5];                              /* steps 1/50, 1/100, 1/200, 1/400, 1/800 s */
};
enum { REFERENCE_ERROR_COUNT = 12 };
extern const struct reference_errors reference_errors[REFERENCE_ERROR_COUNT];
