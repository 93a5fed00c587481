/* Systems by hand and by parts, drives, commit, and queries that need scratch. */
#include "scenarios.h"
#include "small.h"

#include <string.h>

enum { COUNT = 9 };

static const double position[3 * COUNT] = {0, 0, 0, 1,   0, 0.1, 2, 0.2, 0, 2, 1.1, 0.3, 0.7, 1.2,
                                           0, 3, 2, 0.2, 1, 1,   2, 5,   5, 5, 6,   5,   5.25};
static const double velocity[3 * COUNT] = {0, 0, 0, 0.1, 0, 0, 0, 0.2};

static int32_t pull(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)v, (void)ctx;
  force[3] -= 0.5 * q[3];
  return 0;
}

static int32_t shake(int64_t count, double t, double *q, double *v, void *ctx) {
  (void)t, (void)ctx;
  memset(q, 0, (size_t)(3 * count) * sizeof *q);
  memset(v, 0, (size_t)(3 * count) * sizeof *v);
  return 0;
}

static void add_springs(struct attempt *a, hooke_system *system) {
  const int64_t ends[] = {0, 1, 0, 4, 1, 2, 1, 4, 2, 3, 3, 4, 3, 5, 5, 6, 5, 7, 7, 8};
  const double stiffness[] = {100, 90, 80, 70, 60, 50, 40, 30, 20, 10};
  const int64_t triples[] = {0, 1, 2, 1, 2, 3}, tetrahedra[] = {0, 1, 2, 6, 1, 2, 3, 6};
  const double coefficient = 0.5;
  hooke_options *springs = make_options(a, "springs", "damping=0.5 rest_length=initial"),
                *altitude = make_options(a, "altitude", "stiffness=5"),
                *anchors = make_options(a, "anchors", "stiffness=5"),
                *ratio = make_options(a, "springs", "stiffness=5 damping_ratio=0.1");
  if (ratio == NULL) goto end;
  TRY(a, hooke_options_set_numbers(springs, "stiffness", 10, stiffness));
  TRY(a, hooke_system_add_springs(system, "edges", 10, ends, springs));
  TRY(a, try_words(springs, "law=length stiffness=3 compression=false"));
  TRY(a, hooke_system_add_springs(system, "cables", 3, ends, springs));
  TRY(a, hooke_system_add_springs(system, "ratio", 4, ends, ratio));
  TRY(a, hooke_options_unset(springs, "stiffness"));
  TRY(a, try_words(springs, "curve.elongation=-1,0,2 curve.force=-2,0,7"));
  TRY(a, hooke_system_add_springs(system, "curved", 3, ends, springs));
  TRY(a, hooke_system_add_bending(system, "beam", 2, triples, 1, &coefficient));
  TRY(a, hooke_system_add_altitude(system, "volume", 2, tetrahedra, altitude));
  TRY(a, hooke_system_add_anchors(system, "wall", 3, triples, anchors));
end:
  hooke_options_destroy(springs);
  hooke_options_destroy(altitude);
  hooke_options_destroy(anchors);
  hooke_options_destroy(ratio);
}

static void add_loads(struct attempt *a, hooke_system *system) {
  const int64_t loaded[] = {1, 2};
  hooke_options *loads = make_options(a, "loads", "motion=table force=0,0,0;0,1,0 time=0,1"),
                *floor = make_options(a, "obstacles", "shape=plane point=0,-1,0 normal=0,1,0 stiffness=9");
  if (floor == NULL) goto end;
  TRY(a, hooke_system_add_loads(system, 2, loaded, loads));
  TRY(a, hooke_system_add_obstacle(system, -1, NULL, floor));
  TRY(a, try_words(floor, "motion=table time=0,1 position=0,0,0;0,0.1,0"));
  TRY(a, hooke_system_add_obstacle(system, 2, loaded, floor));
end:
  hooke_options_destroy(loads);
  hooke_options_destroy(floor);
}

static void add_drives(struct attempt *a, hooke_system *system) {
  const int64_t pinned[] = {0}, shaken[] = {5}, led[] = {7}, called[] = {8};
  const double time[] = {0, 1, 2}, path[] = {0, 0, 0, 0.1, 0, 0, 0, 0.1, 0};
  TRY(a, hooke_system_pin(system, 1, pinned));
  TRY(a, hooke_system_name_particle(system, "tip", 5));
  TRY(a, hooke_system_drive_harmonic(system, 1, shaken, (double[]){0, 0.1, 0}, 2.0, 0.3));
  TRY(a, hooke_system_drive_table(system, 1, led, 3, time, path));
  TRY(a, hooke_system_drive_callback(system, 1, called, shake, NULL));
  TRY(a, hooke_system_set_force(system, pull, NULL, NULL));
  TRY(a, hooke_system_set_drag(system, 0.01));
  TRY(a, hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
end:
  return;
}

/* Functions that allocate scratch. */
static void ask_everything(struct attempt *a, const hooke_system *system) {
  static _Thread_local double vectors[3 * COUNT], stiffness_blocks[9 * COUNT * COUNT],
      damping_blocks[9 * COUNT * COUNT], numbers[64], bound;
  static _Thread_local int64_t row_starts[COUNT * COUNT + COUNT + 1], columns[COUNT * COUNT + COUNT + 1],
      ends[64];
  int64_t blocks = 0;
  hooke_state *state = NULL, *other = NULL;
  TRY(a, hooke_state_create(system, &state));
  TRY(a, hooke_state_create(system, &other));
  TRY(a, hooke_state_copy(state, other));
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(other);
  TRY(a, hooke_system_force(system, 0.1, q, v, vectors));
  attempt_numbers(a, 3 * COUNT, vectors);
  TRY(a, hooke_system_acceleration(system, 0.1, q, v, vectors));
  attempt_numbers(a, 3 * COUNT, vectors);
  TRY(a, hooke_system_derivative_product(system, 0.1, q, v, q, v, vectors));
  attempt_numbers(a, 3 * COUNT, vectors);
  TRY(a, hooke_system_derivative_pattern(system, row_starts, columns));
  TRY(a, hooke_system_derivative_blocks(system, q, v, stiffness_blocks, damping_blocks));
  TRY(a, (blocks = hooke_system_count(system, "blocks")) < 0 ? HOOKE_NO_MEMORY : HOOKE_OK);
  attempt_numbers(a, 9 * blocks, stiffness_blocks);
  TRY(a, hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  TRY(a, hooke_system_members(system, "springs", NULL, numbers, NULL, numbers + 32));
  attempt_numbers(a, hooke_system_count(system, "springs"), numbers);
  TRY(a, hooke_system_members(system, "bending", ends, NULL, NULL, NULL));
  TRY(a, hooke_system_members(system, "bending", NULL, numbers, NULL, NULL));
  TRY(a, hooke_system_members(system, "altitude", ends, NULL, NULL, NULL));
  TRY(a, hooke_system_members(system, "altitude", NULL, numbers, NULL, numbers + 32));
  TRY(a, hooke_system_altitude_lengths(system, q, numbers));
  attempt_numbers(a, hooke_system_count(system, "altitude"), numbers);
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    TRY(a, hooke_step_bound(system, hooke_method_name(k), q, &bound));
    attempt_number(a, bound);
  }
  attempt_number(a, hooke_system_energy(system, "total", q, v));
  attempt_number(a, hooke_system_dissipated_power(system, q, v));
  hooke_system_momentum(system, v, numbers);
  hooke_system_angular_momentum(system, q, v, numbers);
  attempt_number(a, (double)hooke_system_coincident_springs(system, q));
end:
  hooke_state_destroy(state);
  hooke_state_destroy(other);
}

/* Holds its arrays until the next call, so that every step needs new ones. */
static int32_t hold(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const double **held = ctx;
  hooke_rows_hold(*held, -1);
  hooke_rows_hold(q, 1);
  *held = q;
  return pull(n, t, q, v, force, NULL);
}

static void lend_force(struct attempt *a, const hooke_system *system) {
  const double *held = NULL;
  struct made m = {.run = make_options(a, "run", "method=symplectic-euler step=1e-3")};
  if (m.run == NULL) goto end;
  TRY(a, hooke_system_with_force(system, hold, NULL, &held, &m.system));
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  TRY(a, hooke_state_create(m.system, &m.state));
  for (int k = 0; k < 3; k++)
    TRY(a, hooke_integrator_step(m.integrator, m.state, 1));
  attempt_numbers(a, 3 * COUNT, hooke_state_position(m.state));
end:
  release(&m);
  hooke_rows_hold(held, -1);
}

SCENARIO(by_hand) {
  const double mass[COUNT] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  hooke_system *system = NULL;
  TRY(a, hooke_system_create(&system));
  TRY(a, hooke_system_add_particles(system, COUNT - 1, position, velocity, COUNT - 1, mass, NULL));
  TRY(a, hooke_system_add_particles(system, 1, position + 3 * (COUNT - 1), NULL, 1, mass, NULL));
  add_springs(a, system);
  if (a->gave_up) goto end;
  add_drives(a, system);
  if (!a->gave_up) add_loads(a, system);
  if (a->gave_up) goto end;
  TRY(a, hooke_system_commit(system));
  ask_everything(a, system);
  if (!a->gave_up) lend_force(a, system);
end:
  hooke_system_destroy(system);
}

static const struct {
  const char *kind, *words;
} parts[] = {
    {"rope", "from=0,0,0 to=1,0,0 segments=5 density=0.1 stretch.stiffness=20 bend.stiffness=1 bending=0.01 "
             "pinned=start,end gravity_factor=0.3 fluid_drag.density=1 fluid_drag.diameter=0.1 "
             "fluid_drag.normal=1 fluid_drag.tangential=0.1"},
    {"cloth", "origin=0,1,0 edges=1,0,0,0,0,1 size=5,4 mass=0.3 structural.stiffness=20 shear.stiffness=5 "
              "bend.stiffness=1 pinned=top-corners"},
    {"lattice", "origin=0,2,0 edges=1,0,0,0,1,0,0,0,1 size=3,3,3 mass=0.3 structural.stiffness=20 "
                "shear.stiffness=5 bend.stiffness=1 pinned=bottom"},
    {"strand", "from=0,4,0 to=1,4,0 segments=4 mass=0.01 stretch.stiffness=20 bend.stiffness=5 "
               "twist.stiffness=1 altitude.stiffness=1 pinned=start"},
};

static void set_mesh(struct attempt *a, hooke_options *options) {
  const double vertices[] = {0, 6, 0, 1, 6, 0, 0, 7, 0, 1, 7, 0, 1, 6, 0};
  const int64_t triangles[] = {0, 1, 2, 4, 3, 2};
  TRY(a, hooke_mesh_set(options, 5, vertices, 2, triangles));
  TRY(a,
      try_words(options, "mass=0.1 weld=1e-6 structural.stiffness=10 bend.damping_ratio=0.1 bend.stiffness=1 "
                         "fluid_drag.density=1 fluid_drag.coefficient=1"));
end:
  return;
}

SCENARIO(by_parts) {
  hooke_system *system = NULL;
  hooke_options *options = NULL, *copy = NULL;
  hooke_state *state = NULL;
  TRY(a, hooke_system_create(&system));
  for (size_t p = 0; p < sizeof parts / sizeof parts[0]; p++) {
    options = make_options(a, parts[p].kind, "%s", parts[p].words);
    if (options == NULL) goto end;
    TRY(a, hooke_options_copy(options, &copy));
    TRY(a, hooke_system_add_part(system, parts[p].kind, p == 0 ? "line" : NULL, copy, NULL, NULL));
    TRY(a, hooke_options_unset(options, "mass"));
    hooke_options_destroy(options);
    hooke_options_destroy(copy);
    options = copy = NULL;
  }
  TRY(a, hooke_options_create("mesh", &options));
  set_mesh(a, options);
  if (a->gave_up) goto end;
  TRY(a, hooke_system_add_part(system, "mesh", "sheet", options, NULL, NULL));
  TRY(a, hooke_system_commit(system));
  TRY(a, hooke_state_create(system, &state));
  take_state(a, state);
  for (int64_t k = 0; k < hooke_system_group_count(system, "springs"); k++)
    attempt_text(a, hooke_system_group_name(system, "springs", k));
  attempt_number(a, hooke_system_energy(system, "potential", hooke_state_position(state), NULL));
end:
  hooke_state_destroy(state);
  hooke_options_destroy(options);
  hooke_options_destroy(copy);
  hooke_system_destroy(system);
}

const struct scenario creating[] = {
    {"create, by hand", by_hand, NULL, 1, NULL, NULL},
    {"create, by parts", by_parts, NULL, 1, NULL, NULL},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
