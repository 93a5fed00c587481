/* Drag in a medium: of each particle, quadratic, by shape, and in a wind. */
#include "check.h"
#include "law_scene.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846;

static hooke_system *in_medium(hooke_system *system, const char *words) {
  owned_options *options = options_with("scene", "%s", words);
  check_ok(hooke_scene_options_apply(options, system));
  return system;
}

/* ---- derivatives, heat and the work of the wind ---- */

enum { MIXED = 6 + 9, MIXED_SIZE = 3 * MIXED };

/* A rope and a cloth; `medium` 0: without any drag. */
static hooke_system *mixed(int medium) {
  const char *fluid = medium ? " fluid_drag.density=3 fluid_drag.diameter=0.5 fluid_drag.normal=1.2 "
                               "fluid_drag.tangential=0.4"
                             : "",
             *surface = medium ? " fluid_drag.density=2 fluid_drag.coefficient=1.1" : "";
  hooke_system *system =
      small_part(NULL, "rope", "rope",
                 "from=0,0,0 to=2,0.3,0 segments=5 mass=1 stretch.stiffness=10 pinned=start%s", fluid);
  small_part(system, "cloth", "cloth",
             "origin=0,2,0 edges=1,0,0;0,0.2,1 size=3x3 mass=1 structural.stiffness=9%s", surface);
  if (!medium) {
    return committed(system);
  }
  double drag[MIXED], quadratic[MIXED];
  struct random_source source = {5};
  for (int p = 0; p < MIXED; p++) {
    drag[p] = random_between(&source, 0.1, 0.9);
    quadratic[p] = random_between(&source, 0.1, 0.9);
  }
  const double time[] = {0, 0.2, 0.7}, velocity[] = {0, 0, 0, 1.5, -0.5, 2, 2, 1, 1};
  owned_options *options = new_options("scene");
  check_ok(hooke_options_set_numbers(options, "drag", MIXED, drag));
  check_ok(hooke_options_set_numbers(options, "quadratic_drag", MIXED, quadratic));
  check_ok(hooke_options_set_numbers(options, "wind.time", 3, time));
  check_ok(hooke_options_set_numbers(options, "wind.velocity", 9, velocity));
  check_ok(hooke_scene_options_apply(options, system));
  return committed(system);
}

static void draw(uint64_t seed, double *q, double *v) {
  struct random_source source = {seed};
  for (int k = 0; k < MIXED_SIZE; k++) {
    q[k] = random_between(&source, -1.0, 1.0);
    v[k] = random_between(&source, -2.0, 2.0);
  }
}

struct line {
  const hooke_system *system;
  const double *q, *v, *dq, *dv;
};

static void force_along(double s, double *value, void *ctx) {
  const struct line *line = ctx;
  double q[MIXED_SIZE], v[MIXED_SIZE];
  for (int k = 0; k < MIXED_SIZE; k++) {
    q[k] = line->q[k] + s * line->dq[k];
    v[k] = line->v[k] + s * line->dv[k];
  }
  check_ok(hooke_system_force(line->system, 0.3, q, v, value));
}

TEST(products_are_differences) {
  owned_system *system = mixed(1);
  for (uint64_t seed = 1; seed <= 6; seed++) {
    double q[MIXED_SIZE], v[MIXED_SIZE], dq[MIXED_SIZE], dv[MIXED_SIZE], expected[MIXED_SIZE];
    double found[MIXED_SIZE];
    const double none[MIXED_SIZE] = {0.0};
    draw(seed, q, v);
    draw(seed + 100, dq, dv);
    const struct line lines[] = {{system, q, v, dq, none}, {system, q, v, none, dv}, {system, q, v, dq, dv}};
    for (int k = 0; k < 3; k++) {
      struct line line = lines[k];
      differentiate(MIXED_SIZE, force_along, 0.004, &line, expected);
      check_ok(hooke_system_derivative_product(system, 0.3, q, v, line.dq, line.dv, found));
      const double size = largest(MIXED_SIZE, expected);
      assert_true(size > 1.0);
      for (int i = 0; i < MIXED_SIZE; i++)
        check_close(found[i], expected[i], 1e-7 * size);
    }
  }
}

/* Blocks of df/dv have all of it. */
TEST(blocks_by_velocities_are_products) {
  owned_system *system = mixed(1);
  double q[MIXED_SIZE], v[MIXED_SIZE], dv[MIXED_SIZE], product[MIXED_SIZE], sum[MIXED_SIZE] = {0.0};
  const double none[MIXED_SIZE] = {0.0};
  draw(3, q, v);
  draw(4, dv, dv);
  const int64_t count = hooke_system_count(system, "blocks");
  owned_wholes *start = new_block(MIXED + 1, sizeof *start), *column = new_block(count, sizeof *column);
  owned_doubles *blocks = new_doubles(9 * count);
  check_ok(hooke_system_derivative_pattern(system, start, column));
  check_ok(hooke_system_derivative_blocks_at(system, 0.3, q, v, NULL, blocks));
  for (int64_t row = 0; row < MIXED; row++) {
    for (int64_t b = start[row]; b < start[row + 1]; b++) {
      for (int64_t k = 0; k < 9; k++)
        sum[3 * row + k / 3] += blocks[9 * b + k] * dv[3 * column[b] + k % 3];
    }
  }
  check_ok(hooke_system_derivative_product(system, 0.3, q, v, none, dv, product));
  for (int k = 0; k < MIXED_SIZE; k++)
    check_close(sum[k], product[k], 1e-12 * largest(MIXED_SIZE, product));
}

/* The heat of a drag F is -F.(v - u). */
TEST(heat_is_that_of_the_velocity_beside_the_wind) {
  owned_system *with = mixed(1), *bare = mixed(0);
  double q[MIXED_SIZE], v[MIXED_SIZE], f[MIXED_SIZE], elastic[MIXED_SIZE], heat = 0.0;
  draw(7, q, v);
  /* the wind at 0.3 s, by the drag of a single particle */
  owned_system *probe = small_system(1, (double[]){0, 0, 0}, NULL, 1.0, 0);
  const double time[] = {0, 0.2, 0.7}, velocity[] = {0, 0, 0, 1.5, -0.5, 2, 2, 1, 1};
  owned_options *options = options_with("scene", "drag=1");
  check_ok(hooke_options_set_numbers(options, "wind.time", 3, time));
  check_ok(hooke_options_set_numbers(options, "wind.velocity", 9, velocity));
  check_ok(hooke_scene_options_apply(options, probe));
  check_ok(hooke_system_commit(probe));
  double u[3];
  const double still[3] = {0.0};
  check_ok(hooke_system_force(probe, 0.3, still, still, u));
  check_ok(hooke_system_force(with, 0.3, q, v, f));
  check_ok(hooke_system_force(bare, 0.3, q, v, elastic));
  for (int k = 0; k < MIXED_SIZE; k++)
    heat -= (f[k] - elastic[k]) * (v[k] - u[k % 3]);
  assert_true(heat > 10.0);
  check_close(hooke_system_dissipated_power_at(with, 0.3, q, v), heat, 1e-11 * heat);
  check_close(hooke_system_dissipated_power_at(probe, 0.3, still, still),
              u[0] * u[0] + u[1] * u[1] + u[2] * u[2], 1e-12);
}

/* ---- motions with known ends ---- */

TEST(what_falls_reaches_its_terminal_speed) {
  const double place[9] = {0, 0, 0, 3, 0, 0, 6, 0, 0};
  for (int squared = 0; squared < 2; squared++) {
    owned_system *system = small_system(3, place, NULL, 2.0, 0);
    in_medium(system, squared ? "quadratic_drag=1,2,4 wind=1,2,-3" : "drag=1,2,4 wind=1,2,-3");
    small_falling(system);
    double v[9];
    end_of_run(NULL, v, system, .method = "rk4", .step = 0.02, .duration = 60);
    for (int p = 0; p < 3; p++) {
      const double c = (double)(1 << p), speed = squared ? sqrt(2.0 * 9.81 / c) : 2.0 * 9.81 / c;
      check_close(v[3 * p], 1.0, 1e-10);
      check_close(v[3 * p + 1], 2.0 - speed, 1e-10);
      check_close(v[3 * p + 2], -3.0, 1e-10);
    }
  }
}

/* v = -V tanh(g t/V): of order 2 for verlet, which predicts the velocity. */
TEST(verlet_falls_with_order_two) {
  const double speed = sqrt(9.81 / 0.5), exact = -speed * tanh(9.81 * 1.0 / speed);
  double error[2];
  for (int k = 0; k < 2; k++) {
    owned_system *system =
        in_medium(small_system(1, (double[]){0, 0, 0}, NULL, 1.0, 0), "quadratic_drag=0.5");
    double v[3];
    small_falling(system);
    end_of_run(NULL, v, system, .method = "verlet", .step = k ? 0.01 : 0.02, .duration = 1);
    error[k] = fabs(v[1] - exact);
  }
  check_between(error[0], 1e-6, 1e-2);
  check_between(log2(error[0] / error[1]), 1.8, 2.2);
}

/* 75 kg on 25 m of cord of 40 N/m from 80 m, with air in which the terminal speed is 60 m/s; by an explicit
 * Runge-Kutta method of order 8 at 1e-12 (Hairer, Norsett and Wanner), without this library. */
struct lowest {
  double y, t;
};

static int32_t keep_lowest(int64_t step, const hooke_state *state, void *ctx) {
  struct lowest *lowest = ctx;
  const double *q = hooke_state_position((hooke_state *)(uintptr_t)state);
  (void)step;
  if (q[4] < lowest->y) *lowest = (struct lowest){q[4], hooke_state_time(state)};
  return 0;
}

TEST(a_bungee_jump_with_air) {
  const double place[6] = {0, 80, 0, 0, 79.999999999, 0}, gravity[3] = {0, -9.8, 0};
  owned_system *system = small_system(2, place, NULL, 75.0, 1);
  small_group(system, "springs", "cord", 1, (int64_t[]){0, 1},
              "law=length stiffness=40 rest_length=25 compression=false");
  check_ok(hooke_system_set_gravity(system, gravity));
  in_medium(system, "quadratic_drag=0.20416666666666666");
  check_ok(hooke_system_commit(system));
  struct lowest lowest = {80.0, 0.0};
  owned_run(run, state, system, .method = "rk4", .step = 1e-3, .duration = 20);
  check_ok(hooke_integrator_on_step(run, 1, keep_lowest, &lowest));
  check_ok(hooke_integrator_run(run, state));
  check_close(lowest.y, 5.3964956, 1e-5);
  check_close(lowest.t, 5.18085, 1e-3);
  check_close(hooke_state_position(state)[4], 56.22036703, 2e-5);
}

/* 1 m^2 of 1 kg in air of 1.2 kg/m^3, C = 1.3: face-on, and edge-on. */
TEST(a_plate_falls_flat_or_like_a_knife) {
  for (int edge_on = 0; edge_on < 2; edge_on++) {
    owned_system *system = small_part(NULL, "cloth", "plate",
                                      "edges=1,0,0;%s size=3x3 mass=1 structural.stiffness=10 rigid=true "
                                      "fluid_drag.density=1.2 fluid_drag.coefficient=1.3",
                                      edge_on ? "0,1,0" : "0,0,1");
    double v[27];
    small_falling(system);
    end_of_run(NULL, v, system, .method = "rk4", .step = 0.01, .duration = 10);
    const double speed = edge_on ? 98.1 : sqrt(2.0 * 9.81 / (1.2 * 1.3));
    for (int p = 0; p < 9; p++) {
      check_close(v[3 * p], 0.0, 1e-9);
      check_close(v[3 * p + 1], -speed, 1e-9);
    }
  }
}

/* A cell of a cloth is cut like two triangles of a mesh. */
TEST(cells_are_cut_along_their_first_diagonal) {
  const double corners[12] = {0, 0, 0, 1, 0, 0, 0, 0.3, 1, 1, 0.3, 1},
               v[12] = {1, 2, 3, -1, 1, 0, 2, 2, 0, 1, -3, 1};
  const double q[12] = {0, 0, 0, 1, 0.2, 0, 0, 0.3, 1, 1, 0.9, 1.2};
  const int64_t triangles[6] = {0, 1, 3, 0, 3, 2};
  owned_system *cloth = small_part(NULL, "cloth", "c",
                                   "edges=1,0,0;0,0.3,1 size=2x2 mass=1 structural.stiffness=0 "
                                   "fluid_drag.density=1.2 fluid_drag.coefficient=1.3"),
               *mesh = new_system();
  owned_options *options = options_with("mesh", "mass=1 fluid_drag.density=1.2 fluid_drag.coefficient=1.3");
  check_ok(hooke_mesh_set(options, 4, corners, 2, triangles));
  check_ok(hooke_system_add_part(mesh, "mesh", "m", options, NULL, NULL));
  check_ok(hooke_system_commit(cloth));
  check_ok(hooke_system_commit(mesh));
  double one[12], other[12];
  check_ok(hooke_system_force(cloth, 0.0, q, v, one));
  check_ok(hooke_system_force(mesh, 0.0, q, v, other));
  assert_true(largest(12, one) > 0.1);
  for (int k = 0; k < 12; k++)
    check_close(other[k], one[k], 1e-14);
}

/* ---- a rope in a current ---- */

/* A rope hangs from the origin into a current along x with a weight at its lower end. Static, from the weight
 * up, by the classical Runge-Kutta method: tension T grows by what weighs and drags, x' = (1 + T/k) T/|T|. */
static const double WEIGHT = 3.0, DENSITY = 0.4, STIFFNESS = 400.0, CURRENT = 1.2, FLUID = 1000.0,
                    DIAMETER = 0.012, NORMAL = 1.3, TANGENTIAL = 0.02, LENGTH = 2.0;

static void rate_of(const double y[4], double rate[4]) {
  const double T = hypot(y[0], y[1]), t[2] = {y[0] / T, y[1] / T}, longer = 1.0 + T / STIFFNESS;
  const double along = CURRENT * t[0], across[2] = {CURRENT - along * t[0], -along * t[1]},
               speed = hypot(across[0], across[1]), half = 0.5 * FLUID * DIAMETER * longer;
  for (int a = 0; a < 2; a++) {
    const double drag = half * (NORMAL * speed * across[a] + PI * TANGENTIAL * fabs(along) * along * t[a]);
    rate[a] = -drag + (a ? DENSITY * 9.81 : 0.0);
    rate[2 + a] = longer * t[a];
  }
}

static void integrate(double *x, double *y) {
  double s[4] = {0.0, WEIGHT * 9.81, 0.0, 0.0}, k[4][4], at[4];
  enum { STEPS = 400 };
  const double h = LENGTH / STEPS, ahead[4] = {0.0, 0.5, 0.5, 1.0};
  for (int step = 0; step < STEPS; step++) {
    for (int stage = 0; stage < 4; stage++) {
      for (int i = 0; i < 4; i++)
        at[i] = s[i] + (stage ? h * ahead[stage] * k[stage - 1][i] : 0.0);
      rate_of(at, k[stage]);
    }
    for (int i = 0; i < 4; i++)
      s[i] += h / 6.0 * (k[0][i] + 2.0 * k[1][i] + 2.0 * k[2][i] + k[3][i]);
  }
  *x = -s[2];
  *y = -s[3];
}

/* The distance of its lower end from there. */
static double end_of_rope(int segments, double x, double y) {
  owned_system *system = new_system();
  const double place[3] = {0, -LENGTH, 0}, mass = WEIGHT, wind[3] = {CURRENT, 0, 0},
               gravity[3] = {0, -9.81, 0};
  check_ok(hooke_system_add_particles(system, 1, place, NULL, 1, &mass, NULL));
  small_part(
      system, "rope", "rope",
      "from=0,0,0 to=0,-2,0 segments=%d density=%g pinned=start stretch.stiffness=%g stretch.damping=20 "
      "fluid_drag.density=%g fluid_drag.diameter=%g fluid_drag.normal=%g fluid_drag.tangential=%g",
      segments, DENSITY, STIFFNESS, FLUID, DIAMETER, NORMAL, TANGENTIAL);
  small_group(system, "springs", "weight", 1, (int64_t[]){0, segments + 1},
              "law=length stiffness=1e4 rest_length=0 damping=10");
  owned_options *options = new_options("scene");
  check_ok(hooke_options_set_numbers(options, "wind", 3, wind));
  check_ok(hooke_options_set_numbers(options, "gravity", 3, gravity));
  check_ok(hooke_scene_options_apply(options, system));
  check_ok(hooke_system_commit(system));
  owned_doubles *q = new_doubles(3 * (segments + 2));
  end_of_run(q, NULL, system, .method = "backward-euler", .step = 0.5, .duration = 60);
  const double distance = hypot(q[3 * segments + 3] - x, q[3 * segments + 4] - y);
  check_close(q[3 * segments + 5], 0.0, 1e-9);
  return distance;
}

TEST(a_rope_hangs_in_a_current_as_statics_has_it) {
  double x, y;
  integrate(&x, &y);
  check_between(x, 0.3, 1.5); /* far from hanging down */
  const double coarse = end_of_rope(8, x, y), fine = end_of_rope(16, x, y);
  check_between(fine, 1e-6, 1e-3);
  check_between(log2(coarse / fine), 1.8, 2.2);
}

/* ---- limits, and what is refused ---- */

#if HOOKE_HAVE_LAPACK
TEST(limits_have_the_damping_of_the_state) {
  const double place[9] = {0, 0, 0, 1, 0, 0, 2, 0.1, 0}, velocity[9] = {0, 0, 0, 3, 1, -2, 5, 0, 1};
  owned_system *system = small_system(3, place, velocity, 0.1, 1);
  small_group(system, "springs", "", 2, (int64_t[]){0, 1, 1, 2}, "law=length stiffness=20 rest_length=1");
  in_medium(system, "quadratic_drag=0.4 drag=0.1,0.2,0.3 wind=-1,0,2");
  check_ok(hooke_system_commit(system));
  owned_measurement *limit = limits_of(system, "symplectic-euler,forward-euler,heun,rk4,verlet", 0);
  for (int64_t row = 0; row < 5; row++) {
    const double predicted = hooke_measurement_number(limit, "rows", row, "predicted");
    check_between(predicted, 0.01, 0.2); /* without drag 0.1 and more */
    check_close(hooke_measurement_number(limit, "rows", row, "measured"), predicted, 2e-3 * predicted);
    check_between(hooke_measurement_number(limit, "rows", row, "bound"), 0.0, predicted);
  }
}
#endif

TEST(a_step_is_bounded_where_velocities_are_known) {
  double bound;
  owned_system *system = mixed(1);
  owned_doubles *q = new_doubles(MIXED_SIZE);
  check_ok(hooke_step_bound(system, "verlet", q, &bound));
  assert_true(isnan(bound));
}

static void refuse(const char *words, int32_t pinned, const char *message) {
  const double place[6] = {0, 0, 0, 1, 0, 0};
  owned_system *system = small_system(2, place, NULL, 1.0, pinned);
  owned_options *options = options_with("scene", "%s", words);
  int32_t status = hooke_scene_options_apply(options, system);
  if (status == HOOKE_OK) status = hooke_system_commit(system);
  check_status(status, HOOKE_BAD_VALUE);
  check_message(message);
}

TEST(what_cannot_be_is_refused_in_its_place) {
  refuse("drag=1,2,3", 0, "drag: 3 numbers for 2 particles; allowed: one, or one for each");
  refuse("quadratic_drag=1,2,3", 0,
         "quadratic_drag: 3 numbers for 2 particles; allowed: one, or one for each");
  refuse("dynamics=overdamped drag=1 quadratic_drag=1", 0, "quadratic_drag: is not allowed");
  refuse("dynamics=overdamped drag=1,0", 0,
         "drag[1]: 0 is not allowed; an overdamped scene needs a drag > 0");
  refuse("wind.time=0,1 wind.velocity=1,0,0;2,0,0;3,0,0", 0, "wind: 2 times and 3 velocities given");
  refuse("wind.time=1,1 wind.velocity=1,0,0;2,0,0", 0, "wind.time[1]: 1 is not allowed");
  owned_system *open = in_medium(new_system(), "dynamics=overdamped drag=1");
  owned_options *rope =
      options_with("rope", "segments=2 from=0,0,0 to=1,0,0 stretch.stiffness=1 fluid_drag.density=1 "
                           "fluid_drag.diameter=1 fluid_drag.normal=1 fluid_drag.tangential=1");
  check_status(hooke_system_add_part(open, "rope", NULL, rope, NULL, NULL), HOOKE_BAD_VALUE);
  check_message("fluid_drag: is not allowed; in an overdamped scene drag is linear");
}

TEST(methods_that_need_linear_damping_are_refused) {
  owned_system *system = mixed(1);
  hooke_integrator *none;
  owned_options *run = run_options((struct run){.method = "shardlow", .step = 1e-3});
  check_status(hooke_integrator_create(system, run, &none), HOOKE_UNSUITED);
  check_message("shardlow takes dampers one by one, and some force is not linear in velocities");
  owned_options *implicit =
      run_options((struct run){.method = "verlet", .step = 1e-3, .verlet_damping = "implicit"});
  check_status(hooke_integrator_create(system, implicit, &none), HOOKE_UNSUITED);
  check_message("verlet_damping: implicit does not know forces that are not linear in velocities");
}

/* ---- an overdamped scene ---- */

/* gamma (x' - u) = f: all particles end in the wind's velocity, and their springs at rest. */
TEST(overdamped_particles_go_with_the_wind) {
  const double place[9] = {0, 0, 0, 1, 0, 0, 2.5, 0, 0};
  owned_system *system = new_system();
  in_medium(system, "dynamics=overdamped drag=1,2,4 wind=0.5,0.25,0");
  check_ok(hooke_system_add_particles(system, 3, place, NULL, 0, NULL, NULL));
  small_group(system, "springs", "", 2, (int64_t[]){0, 1, 1, 2}, "law=length stiffness=30 rest_length=1");
  check_ok(hooke_system_commit(system));
  double heat = 0.0, q[9], v[9], force[9];
  end_of_run(q, v, system, .method = "rk4", .step = 0.01, .duration = 4);
  for (int p = 0; p < 3; p++) {
    check_close(v[3 * p], 0.5, 1e-9);
    check_close(v[3 * p + 1], 0.25, 1e-9);
  }
  check_close(q[3] - q[0], 1.0, 1e-9);
  /* the middle of drag keeps its place beside the wind */
  check_close((q[0] + 2.0 * q[3] + 4.0 * q[6]) / 7.0, (0.0 + 2.0 + 10.0) / 7.0 + 2.0, 1e-9);
  check_close(hooke_system_dissipated_power(system, q, v), 0.0, 1e-9);
  check_ok(hooke_system_force(system, 0.0, place, v, force));
  for (int p = 0; p < 3; p++) {
    const double gamma = (double)(1 << p),
                 w[2] = {force[3 * p] / gamma - 0.5, force[3 * p + 1] / gamma - 0.25};
    heat += gamma * (w[0] * w[0] + w[1] * w[1]);
    v[3 * p] = force[3 * p] / gamma;
  }
  check_close(hooke_system_dissipated_power(system, place, v), heat, 1e-12 * heat);
}

/* ---- what is warned of ---- */

static int32_t note(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  (void)t, (void)limit, (void)spring;
  assert_string_equal(kind, "added-mass");
  assert_string_equal(sentence, "part \"rope\" has 0.3 kg and displaces 0.314 kg of fluid, whose added mass "
                                "is not in the scene");
  assert_int_equal(particle, 0);
  ++*(int *)ctx;
  return 0;
}

/* 1 m of 2 cm displaces 0.314 kg of water. */
TEST(added_mass_is_missed_in_water_alone) {
  const struct {
    double density, mass;
    int warned;
  } cases[] = {{1000, 0.3, 1}, {1000, 0.32, 0}, {99, 0.01, 0}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    int warned = 0;
    owned_system *system =
        small_part(NULL, "rope", "rope",
                   "from=0,0,0 to=0,-1,0 segments=4 mass=%g pinned=start stretch.stiffness=1e3 "
                   "fluid_drag.density=%g fluid_drag.diameter=0.02 fluid_drag.normal=1 "
                   "fluid_drag.tangential=0.01",
                   cases[k].mass, cases[k].density);
    small_falling(system);
    check_ok(hooke_system_warnings(system, note, &warned));
    assert_int_equal(warned, cases[k].warned);
  }
}
