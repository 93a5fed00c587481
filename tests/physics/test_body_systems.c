/* Systems with rigid bodies: what is refused, what is dropped, which bits agree, and the lattice whose limit
 * of great stiffness a body is. */
#include "check.h"
#include "order.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CUBE = 8, PAIRS = 28 };

/* What is said of a cube of side 1, turned so that no axis is special, before it is committed. */
struct cube {
  double stiffness; /* of springs between all corners; 0: none */
  int32_t rigid, anchored, turning, project;
  double drag, damping;
};

static const int64_t ALL[CUBE] = {0, 1, 2, 3, 4, 5, 6, 7};

static void place_corner(int p, double q[3]) {
  const double x = p & 1 ? 0.5 : -0.5, y = p & 2 ? 0.5 : -0.5, z = p & 4 ? 0.5 : -0.5;
  q[0] = (2.0 * x - 2.0 * y + z) / 3.0;
  q[1] = (2.0 * x + y - 2.0 * z) / 3.0;
  q[2] = (x + 2.0 * y + 2.0 * z) / 3.0;
}

static hooke_options *material(const char *kind, double stiffness, double damping) {
  hooke_options *options = options_with(kind, "stiffness=%.17g damping=%.17g", stiffness, damping);
  return options;
}

static void join(hooke_system *system, double stiffness) {
  int64_t ends[2 * PAIRS], count = 0;
  for (int i = 0; i < CUBE; i++) {
    for (int j = i + 1; j < CUBE; j++) {
      ends[2 * count] = i;
      ends[2 * count++ + 1] = j;
    }
  }
  owned_options *options = material("springs", stiffness, 0.0);
  check_ok(hooke_options_set_text(options, "law", "length"));
  check_ok(hooke_system_add_springs(system, "inside", count, ends, options));
}

static hooke_system *cube(struct cube how) {
  const double mass[CUBE] = {0.1, 0.12, 0.14, 0.16, 0.1, 0.12, 0.14, 0.12};
  double q[3 * CUBE], v[3 * CUBE] = {0.0};
  for (int p = 0; p < CUBE; p++) {
    place_corner(p, q + 3 * p);
    if (!how.turning) continue;
    v[3 * p] = -0.8 * q[3 * p + 1] + 0.3;
    v[3 * p + 1] = 0.8 * q[3 * p] - 0.5 * q[3 * p + 2];
    v[3 * p + 2] = 0.5 * q[3 * p + 1];
  }
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, CUBE, q, v, CUBE, mass, NULL));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -9.81, 1.0}));
  check_ok(hooke_system_set_drag(system, how.drag));
  if (how.stiffness > 0.0) join(system, how.stiffness);
  if (how.anchored) {
    const double points[9] = {0.1, 1.0, 0.3, -0.6, 1.2, 0.2, 0.5, 0.9, -0.5};
    owned_options *options = material("anchors", 20.0, how.damping);
    check_ok(hooke_options_set_numbers(options, "points", 9,
                                       points)); /* at its point an anchor has no direction */
    check_ok(hooke_system_add_anchors(system, "hung", 3, ALL + 1, options));
  }
  if (how.rigid) check_ok(hooke_system_add_body(system, "cube", CUBE, ALL, how.project));
  return system;
}

static hooke_system *committed_cube(struct cube how) {
  return committed(cube(how));
}

/* ---- orders with forces of every kind ---- */

static void end_of(const hooke_system *system, const char *method, double step, double q[3 * CUBE]) {
  end_of_run(q, NULL, system, .method = method, .step = step, .duration = 1.0, .every = 1.0);
}

TEST(hung_cube_has_the_order_of_its_method) {
  const struct {
    const char *name;
    double step, low, high;
  } methods[] = {{"forward-euler", 1.0 / 1024, 0.9, 1.15},
                 {"symplectic-euler", 1.0 / 256, 0.85, 1.15},
                 {"verlet", 1.0 / 64, 1.85, 2.15},
                 {"heun", 1.0 / 128, 1.85, 2.15},
                 {"rk4", 1.0 / 64, 3.8, 4.3},
                 {"backward-euler", 1.0 / 512, 0.85, 1.15},
                 {"tr-bdf2", 1.0 / 64, 1.85, 2.15},
                 {"implicit-midpoint", 1.0 / 64, 1.85, 2.15}};
  for (int damped = 0; damped < 2; damped++) {
    owned_system *system = committed_cube((struct cube){
        .rigid = 1, .anchored = 1, .turning = 1, .drag = damped ? 0.1 : 0.0, .damping = damped ? 0.5 : 0.0});
    double exact[3 * CUBE], q[3 * CUBE], error[4];
    end_of(system, "rk4", 1.0 / 2048, exact);
    for (size_t m = 0; m < sizeof methods / sizeof methods[0]; m++) {
      for (int k = 0; k < 4; k++) {
        end_of(system, methods[m].name, ldexp(methods[m].step, -k), q);
        error[k] = largest_difference(3 * CUBE, q, exact);
      }
      check_order(methods[m].name, 4, error, methods[m].low, methods[m].high);
    }
  }
}

/* The acceleration of the particles is the second derivative of their motion. */
TEST(acceleration_is_that_of_the_motion) {
  const double h = 2e-5;
  owned_system *system = committed_cube((struct cube){.rigid = 1, .anchored = 1, .turning = 1, .drag = 0.1});
  owned_state *state = start_state(system);
  double a[3 * CUBE], v[2][3 * CUBE];
  check_ok(
      hooke_system_acceleration(system, 0.0, hooke_state_position(state), hooke_state_velocity(state), a));
  for (int back = 0; back < 2; back++) {
    end_of_run(NULL, v[back], system, .method = "rk4", .step = 0.5 * h, .duration = (back + 1) * h,
               .every = (back + 1) * h);
  }
  for (int i = 0; i < 3 * CUBE; i++) { /* from the start, one step and two steps */
    const double slope = (4.0 * v[0][i] - v[1][i] - 3.0 * hooke_state_velocity(state)[i]) / (2.0 * h);
    check_close(slope, a[i], 1e-5);
  }
}

/* ---- the largest stable step ---- */

/* A bar with a heavy middle on four anchors at the corners: it rises and sways at sqrt(4 k/M), and turns
 * about its axes at sqrt(k (the sum of squared distances)/I) = sqrt(k/m), m the mass of a corner, which is
 * faster. verlet is stable up to 2 over that. */
TEST(bar_on_springs_has_its_limit) {
  const double k = 500.0, m = 0.2, mass[5] = {0.2, 0.2, 0.2, 0.2, 3.0};
  const double q[15] = {1, 0, 0.1, 1, 0, -0.1, -1, 0, 0.1, -1, 0, -0.1, 0, 0, 0};
  for (int above = 0; above < 2; above++) {
    double v[15];
    for (int p = 0; p < 5; p++) { /* turning about all axes, and rising */
      const double *x = q + 3 * p, w[3] = {1e-5, 2e-5, 3e-5};
      v[3 * p] = w[1] * x[2] - w[2] * x[1];
      v[3 * p + 1] = w[2] * x[0] - w[0] * x[2] + 1e-5;
      v[3 * p + 2] = w[0] * x[1] - w[1] * x[0];
    }
    owned_options *options = material("anchors", k, 0.0);
    owned_system *system = new_system();
    check_ok(hooke_system_add_particles(system, 5, q, v, 5, mass, NULL));
    check_ok(hooke_system_add_anchors(system, "feet", 4, ALL, options));
    check_ok(hooke_system_add_body(system, "bar", 5, ALL, 0));
    check_ok(hooke_system_commit(system));
    const double step = (above ? 1.01 : 0.99) * 2.0 * sqrt(m / k);
    owned_run(integrator, state, system, .method = "verlet", .step = step);
    check_status(hooke_integrator_step(integrator, state, 1000), above ? HOOKE_DIVERGED : HOOKE_OK);
  }
}

/* ---- the limit of stiffness ---- */

enum { FRAMES = 20 };
struct path {
  int64_t frames;
  double q[FRAMES + 1][3 * CUBE];
};

static int32_t keep(int64_t step, const hooke_state *state, void *ctx) {
  (void)step;
  struct path *path = ctx;
  memcpy(path->q[path->frames++], hooke_state_position(state), 3 * CUBE * sizeof(double));
  return 0;
}

static struct path path_of(struct cube how, double step) {
  struct path path = {.frames = 0};
  owned_system *system = committed_cube(how);
  owned_run(integrator, state, system, .method = "verlet", .step = step, .duration = 1.0,
            .every = 1.0 / FRAMES);
  check_ok(hooke_integrator_on_frame(integrator, keep, &path));
  check_ok(hooke_integrator_run(integrator, state));
  return path;
}

/* Its distance from the body falls as 1/stiffness over three decades. */
TEST(stiff_lattice_tends_to_the_body) {
  struct cube how = {.rigid = 1, .anchored = 1, .turning = 1};
  const struct path body = path_of(how, 1.0 / 4000);
  double apart[4];
  how.rigid = 0;
  for (int k = 0; k < 4; k++) {
    how.stiffness = pow(10.0, 3 + k);
    const struct path lattice = path_of(how, 1.0 / (2000.0 * ceil(pow(10.0, 0.5 * k))));
    apart[k] = 0.0;
    for (int f = 0; f <= FRAMES; f++)
      apart[k] = fmax(apart[k], largest_difference(3 * CUBE, lattice.q[f], body.q[f]));
  }
  check_between(log10(apart[3] / apart[0]) / 3.0, -1.1, -0.9);
}

/* ---- bits ---- */

/* Steps by other integrators, each from the state that the last one left, are those of one run. */
TEST(a_step_is_a_map_of_the_state) {
  const char *const methods[] = {"forward-euler", "symplectic-euler", "verlet",  "heun",
                                 "rk4",           "backward-euler",   "tr-bdf2", "implicit-midpoint"};
  for (int damped = 0; damped < 2; damped++) {
    owned_system *system = committed_cube((struct cube){
        .rigid = 1, .anchored = 1, .turning = 1, .damping = damped ? 0.3 : 0.0, .stiffness = 10.0});
    for (int m = 0; m < 8; m++) {
      const struct run run = {.method = methods[m], .step = 1.0 / 128, .duration = 0.25, .every = 0.25};
      double q[3 * CUBE], v[3 * CUBE];
      run_to_end(system, run, q, v);
      owned_state *state = start_state(system);
      for (int k = 0; k < 32; k++) {
        owned_integrator *integrator = start_run(system, run);
        check_ok(hooke_integrator_step(integrator, state, 1));
      }
      check_same_bits(3 * CUBE, hooke_state_position(state), q);
      check_same_bits(3 * CUBE, hooke_state_velocity(state), v);
    }
  }
}

/* A cloth with a rigid corner, large enough for two threads. */
TEST(threads_do_not_change_bits) {
  enum { SIDE = 100, N = SIDE * SIDE };
  const int64_t corner[] = {0, 1, 2, SIDE, SIDE + 1, SIDE + 2, 2 * SIDE, 2 * SIDE + 1};
  owned_options *options =
      options_with("cloth", "size=%d,%d edges=1,0,0,0,0.2,1 mass=1 pinned=top-corners", SIDE, SIDE);
  for (int k = 0; k < 3; k++) {
    const char *const family[] = {"structural.stiffness", "shear.stiffness", "bend.stiffness"};
    check_ok(hooke_options_set_number(options, family[k], 100.0));
  }
  owned_system *system = new_system();
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -9.81, 0.0}));
  check_ok(hooke_system_add_part(system, "cloth", NULL, options, NULL, NULL));
  check_ok(hooke_system_add_body(system, "frame", 8, corner, 0));
  check_ok(hooke_system_commit(system));
  double *q[2], *v[2];
  for (int k = 0; k < 2; k++) {
    q[k] = new_doubles(3 * N);
    v[k] = new_doubles(3 * N);
  }
  const struct run runs[] = {{.method = "verlet", .step = 1e-5, .duration = 20e-5, .every = 20e-5},
                             {.method = "tr-bdf2", .step = 1e-3, .duration = 2e-3, .every = 2e-3}};
  for (int m = 0; m < 2; m++) {
    for (int k = 0; k < 2; k++) {
      struct run run = runs[m];
      run.threads = 1 + 3 * k;
      run_to_end(system, run, q[k], v[k]);
    }
    check_same_bits(3 * N, q[1], q[0]);
    check_same_bits(3 * N, v[1], v[0]);
  }
  for (int k = 0; k < 2; k++) {
    free(q[k]);
    free(v[k]);
  }
}

/* ---- what is dropped, and sums over particles ---- */

TEST(inner_springs_are_dropped) {
  owned_system *system = committed_cube((struct cube){.rigid = 1, .anchored = 1, .stiffness = 10.0});
  assert_int_equal(hooke_system_count(system, "springs"), 0);
  assert_int_equal(hooke_system_count(system, "inside_bodies"), PAIRS);
  assert_int_equal(hooke_system_count(system, "dropped_springs"), 0);
  assert_int_equal(hooke_system_count(system, "anchors"), 3);
  assert_int_equal(hooke_system_count(system, "bodies"), 1);
  assert_string_equal(hooke_system_body_name(system, 0), "cube");
}

TEST(motion_adds_up_to_energy) {
  owned_system *system = committed_cube((struct cube){.rigid = 1, .turning = 1});
  owned_state *state = start_state(system);
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  double inertia[4], motion[13], momentum[3], energy = 0.0;
  check_ok(hooke_system_body_inertia(system, 0, inertia));
  check_ok(hooke_system_body_motion(system, 0, q, v, motion));
  hooke_system_momentum(system, v, momentum);
  check_close(inertia[0], 1.0, 1e-15);
  for (int a = 0; a < 3; a++)
    check_close(inertia[0] * motion[7 + a], momentum[a], 1e-15);
  for (int k = 0; k < 3; k++) { /* momentum about each axis of the body, by its quaternion */
    const double w = motion[3], x = motion[4], y = motion[5], z = motion[6];
    const double axis[3][3] = {{1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)},
                               {2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x)},
                               {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)}};
    const double *l = motion + 10, about = axis[k][0] * l[0] + axis[k][1] * l[1] + axis[k][2] * l[2];
    energy += 0.5 * about * about / inertia[1 + k];
    energy += 0.5 * inertia[0] * motion[7 + k] * motion[7 + k];
  }
  check_close(energy, hooke_system_energy(system, "kinetic", q, v), 1e-15);
}

/* ---- bad input ---- */

static void refuse(hooke_system *system, const char *words) {
  check_status(hooke_system_commit(system), HOOKE_BAD_VALUE);
  check_message(words);
  hooke_system_destroy(system);
}

TEST(bad_bodies_are_refused) {
  const double mass = 1.0, same[] = {1, 2, 3, 1, 2, 3}, uneven[] = {0, 0, 1, 0, 0, 0, 0, 0, 0},
               row[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  hooke_system *system = cube((struct cube){.rigid = 1});
  check_ok(hooke_system_add_body(system, "other", 2, (int64_t[]){7, 3}, 0));
  refuse(system, "bodies[1]: particle 3 is already in the body \"cube\"");
  system = cube((struct cube){.rigid = 0});
  check_ok(hooke_system_add_body(system, "twice", 2, (int64_t[]){3, 3}, 0));
  refuse(system, "bodies[0]: particle 3 is named twice");
  system = new_system();
  check_ok(hooke_system_add_particles(system, 2, same, NULL, 1, &mass, NULL));
  check_ok(hooke_system_add_body(system, NULL, 2, ALL, 0));
  refuse(system, "all at one position");
  system = cube((struct cube){.rigid = 1});
  check_ok(hooke_system_drive_harmonic(system, 1, ALL + 2, (double[]){0, 1, 0}, 1.0, 0.0));
  refuse(system, "particle 2 is driven and others of the body are not");
  system = new_system();
  check_ok(hooke_system_add_particles(system, 3, row, uneven, 1, &mass, NULL));
  check_ok(hooke_system_add_body(system, NULL, 2, ALL, 0));
  check_ok(hooke_system_commit(system)); /* 2 points can turn so */
  hooke_system_destroy(system);
  const double apart[9] = {0, 0, 0, 0.5, 0, 0, 0, 0, 0};
  for (int project = 0; project < 2; project++) {
    system = new_system();
    check_ok(hooke_system_add_particles(system, 3, row, apart, 1, &mass, NULL));
    check_ok(hooke_system_add_body(system, NULL, 3, ALL, project));
    if (!project) {
      refuse(system, "m/s from the nearest one; allowed: a rigid motion, or \"project\": true");
      continue;
    }
    check_ok(hooke_system_commit(system));
    owned_state *state = start_state(system);
    double momentum[3], spin[3];
    hooke_system_momentum(system, hooke_state_velocity(state), momentum);
    hooke_system_angular_momentum(system, row, hooke_state_velocity(state), spin);
    check_close(momentum[0], 0.5, 1e-15);
    check_close(largest(3, spin), 0.0, 1e-15);
    hooke_system_destroy(system);
  }
}

TEST(unknown_is_said) {
  owned_system *system = committed_cube((struct cube){.rigid = 1, .anchored = 1});
  owned_state *state = start_state(system);
  owned_options *options = run_options((struct run){.method = "shardlow", .step = 0.01, .duration = 1.0});
  owned_integrator *integrator = NULL;
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_UNSUITED);
  check_message("shardlow does not know rigid bodies yet");
  set_options(options, "method=tr-bdf2 linear_solver=direct");
  check_status(hooke_integrator_create(system, options, &integrator), HOOKE_UNSUITED);
  check_message("direct does not know rigid bodies yet; allowed with tr-bdf2: auto, blocks");
  double bound = 0.0;
  check_ok(hooke_step_bound(system, "verlet", hooke_state_position(state), &bound));
  assert_true(isnan(bound));
  hooke_state_velocity(state)[0] += 0.1;
  integrator = start_with(system, .method = "verlet", .step = 0.01);
  check_status(hooke_integrator_step(integrator, state, 1), HOOKE_BAD_VALUE);
  check_message("is rigid, and this particle is");
  hooke_state_velocity(state)[0] -= 0.1;
  check_ok(hooke_integrator_step(integrator, state, 1));
  check_status(hooke_integrator_put(integrator, 1, ALL, hooke_state_position(state), NULL), HOOKE_UNSUITED);
}

/* A driven body follows its drive. */
TEST(driven_bodies_follow) {
  owned_system *system = cube((struct cube){.rigid = 1});
  double q[3 * CUBE], corner[3];
  check_ok(hooke_system_drive_harmonic(system, CUBE, ALL, (double[]){0, 0.5, 0}, 1.0, 0.0));
  check_ok(hooke_system_commit(system));
  end_of_run(q, NULL, system, .method = "verlet", .step = 0.05, .duration = 0.25, .every = 0.25);
  for (int p = 0; p < CUBE; p++) {
    place_corner(p, corner);
    corner[1] += 0.5;
    check_close(largest_difference(3, q + 3 * p, corner), 0.0, 1e-15);
  }
}
