/* Obstacles: contact along the normal, friction across it, work and heat of both, and where nothing can be
 * said. */
#include "agree.h"
#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <string.h>

static void add(hooke_system *system, const char *words) {
  owned_options *options = new_options("obstacles");
  check_ok(try_words(options, words));
  check_ok(hooke_system_add_obstacle(system, -1, NULL, options));
}

/* One particle of 1 kg above an obstacle, in gravity. */
static hooke_system *falling(const double place[3], const double velocity[3], const double gravity[3],
                             const char *obstacle) {
  hooke_system *system = small_system(1, place, velocity, 1.0, 0);
  check_ok(hooke_system_set_gravity(system, gravity));
  add(system, obstacle);
  return committed(system);
}

static double energy_of(const hooke_system *system, double t, const double *q, const double *v) {
  return hooke_system_energy_at(system, "total", t, q, v);
}

/* Flights of v^2/(2 g) and half swings of sqrt(k/m), in closed form: after 10 s it is at 0.98854308 m. */
TEST(a_mass_bounces_on_a_stiff_floor) {
  const double place[3] = {0, 1, 0}, gravity[3] = {0, -9.8, 0};
  double q[3], v[3];
  owned_system *system = falling(place, NULL, gravity, "shape=plane point=0,0,0 normal=0,2,0 stiffness=1e5");
  end_of_run(q, v, system, .method = "verlet", .step = 2e-5, .duration = 10.0, .every = 10.0);
  check_close(q[1], 0.98854308, 2e-5);
  check_close(energy_of(system, 10.0, q, v), 9.8, 2e-5);
}

/* The same on a ball and on a cylinder, dropped along a line through the centre. */
TEST(all_shapes_push_alike_along_a_normal) {
  static const char *const obstacles[] = {
      "shape=sphere center=0,-2,0 radius=1.5 clearance=0.5 stiffness=1e5 damping=20",
      "shape=cylinder point=0,-2,7 axis=0,0,-3 radius=1.75 clearance=0.25 stiffness=1e5 damping=20"};
  const double place[3] = {0, 1, 0}, gravity[3] = {0, -9.8, 0};
  const struct run run = {.method = "rk4", .step = 2e-4, .duration = 2.0, .every = 2.0};
  double q[3], v[3], other[3];
  owned_system *floor =
      falling(place, NULL, gravity, "shape=plane point=5,0,0 normal=0,1,0 stiffness=1e5 damping=20");
  run_to_end(floor, run, q, v);
  for (int k = 0; k < 2; k++) {
    owned_system *system = falling(place, NULL, gravity, obstacles[k]);
    run_to_end(system, run, other, v);
    check_close(other[1], q[1], 1e-10);
    check_close(other[0], 0.0, 1e-12);
  }
}

/* Heat by the trapezoidal rule over the steps of a damped bounce, which is wrong by half a step of 240 W
 * where contact begins. */
TEST(what_is_lost_is_heat) {
  const double place[3] = {0, 0.2, 0}, velocity[3] = {1, 0, 0}, gravity[3] = {0, -9.8, 0}, h = 5e-6;
  owned_system *system = falling(place, velocity, gravity,
                                 "shape=plane point=0,0,0 normal=0,1,0 stiffness=2e4 damping=60 friction=0.3 "
                                 "friction_speed=0.05");
  owned_run(run, state, system, .method = "rk4", .step = h);
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const double before = energy_of(system, 0.0, q, v);
  double heat = 0.0, least = 0.0;
  for (int k = 0; k < 120000; k++) {
    const double power = hooke_system_dissipated_power(system, q, v);
    check_ok(hooke_integrator_step(run, state, 1));
    heat += 0.5 * h * (power + hooke_system_dissipated_power(system, q, v));
    least = fmin(least, power);
  }
  check_between(least, 0.0, 0.0);
  check_between(heat, 1.0, 2.5);
  check_close(before - energy_of(system, 0.6, q, v), heat, 1e-3);
}

/* A floor that moves gives what its force times its velocity is. */
TEST(a_moving_obstacle_does_work) {
  const double place[3] = {0, 0.01, 0}, gravity[3] = {0, -9.8, 0}, h = 2e-5;
  owned_system *system = falling(place, NULL, gravity,
                                 "shape=plane point=0,0,0 normal=0,1,0 stiffness=1e4 motion=harmonic "
                                 "amplitude=0,0.02,0 frequency=3");
  owned_run(run, state, system, .method = "rk4", .step = h);
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state), omega = 6.0 * acos(-1.0);
  const double before = energy_of(system, 0.0, q, v);
  double work = 0.0, last = 0.0;
  for (int k = 1; k <= 25000; k++) {
    double force[3];
    check_ok(hooke_integrator_step(run, state, 1));
    check_ok(hooke_system_force(system, k * h, q, v, force));
    const double power = (force[1] + 9.8) * 0.02 * omega * cos(omega * k * h);
    work += 0.5 * h * (last + power);
    last = power;
  }
  check_between(fabs(work), 0.05, 5.0);
  check_close(energy_of(system, 0.5, q, v) - before, work, 1e-3);
}

/* On a slope of tan a: below the angle of friction it creeps at s tan a/sqrt(mu^2 - tan^2 a), above it slides
 * with g (sin a - mu cos a), and what s makes of that. */
TEST(a_block_creeps_below_the_angle_of_friction_and_slides_above) {
  const double g = 9.81, s = 1e-3, mu = 0.4;
  for (int above = 0; above <= 1; above++) {
    const double angle = above ? 0.5 : 0.3, depth = g * cos(angle) / 1e5;
    const double place[3] = {0, -depth, 0}, down[3] = {g * sin(angle), -g * cos(angle), 0};
    owned_system *system = falling(place, NULL, down,
                                   "shape=plane point=0,0,0 normal=0,1,0 stiffness=1e5 damping=100 "
                                   "friction=0.4 friction_speed=1e-3");
    double q[3], v[3];
    end_of_run(q, v, system, .method = "rk4", .step = 1e-4, .duration = 1.0, .every = 1.0);
    const double creep = s * tan(angle) / sqrt(mu * mu - tan(angle) * tan(angle));
    const double right = above ? g * (sin(angle) - mu * cos(angle)) : creep;
    check_between(v[0], 0.99 * right, 1.01 * right);
  }
}

/* A rope through an obstacle of each shape, and steps of it. */
TEST(bits_are_those_of_the_plain_loop) {
  static const struct canonical_obstacle obstacles[] = {
      {0, {0.1, -0.2, 0.3}, {0, 1, 0}, 0, 300, 2, 0.3, 0.1, 0},
      {1, {-0.3, 0.2, 0.1}, {0}, 0.7, 500, 0, 0, 1, 0.05},
      {2, {0.2, 0.4, -0.1}, {0, 0, 1}, 0.5, 200, 1, 0.7, 0.2, 0}};
  static const char *const words[] = {
      "shape=plane point=0.1,-0.2,0.3 normal=0,2,0 stiffness=300 damping=2 friction=0.3 friction_speed=0.1",
      "shape=sphere center=-0.3,0.2,0.1 radius=0.7 clearance=0.05 stiffness=500",
      "shape=cylinder point=0.2,0.4,-0.1 axis=0,0,3 radius=0.5 stiffness=200 damping=1 friction=0.7 "
      "friction_speed=0.2"};
  owned_system *system =
      small_part(NULL, "rope", "line",
                 "from=-0.9,-0.31,0.17 to=0.83,0.91,-0.4 segments=29 mass=0.7 pinned=start "
                 "stretch.stiffness=60 stretch.damping=0.1");
  for (int k = 0; k < 3; k++)
    add(system, words[k]);
  check_ok(hooke_system_commit(system));
  owned_state *state = start_state(system);
  owned_canonical canonical;
  canonical_create(system, &canonical);
  canonical.obstacle_count = 3;
  canonical.obstacle = obstacles;
  check_agrees(system, &canonical, hooke_state_position(state), hooke_state_velocity(state));
}

/* A light rope over half a roller, from which 1 kg hangs, drawn much faster than the friction speed: tensions
 * at its ends are as exp(mu pi) (Euler 1769, Eytelwein 1808). */
enum { ARC = 60, TAIL = 20, ROPE = ARC + 1 + 2 * TAIL };

static void lay_over_roller(double radius, double speed, double piece, double *q, double *v) {
  for (int k = 0; k < ROPE; k++) {
    const double turn = acos(-1.0) * fmin(1.0, fmax(0.0, (k - TAIL) / (double)ARC));
    const double below = piece * fmax(0.0, fmax((double)TAIL - k, (double)k - TAIL - ARC));
    q[3 * k] = -radius * cos(turn);
    q[3 * k + 1] = radius * sin(turn) - below;
    v[3 * k] = speed * sin(turn);
    v[3 * k + 1] = speed * cos(turn);
    q[3 * k + 2] = v[3 * k + 2] = 0.0;
  }
}

static hooke_system *rope_over_roller(const double *q, const double *v, double piece, double speed) {
  double mass[ROPE];
  int64_t ends[2 * (ROPE - 1)];
  for (int64_t k = 0; k < ROPE; k++) {
    mass[k] = k == 0 ? 1.0 : 2e-4;
    if (k < ROPE - 1) ends[2 * k] = k, ends[2 * k + 1] = k + 1;
  }
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, ROPE, q, v, ROPE, mass, NULL));
  small_springs(system, ROPE - 1, ends,
                (struct springs){.stiffness = 2000.0, .damping = 0.02, .rest_length = piece});
  const double times[2] = {0.0, 10.0}, down[6] = {0, 0, 0, 0, -10.0 * speed, 0};
  const int64_t last = ROPE - 1;
  check_ok(hooke_system_drive_table(system, 1, &last, 2, times, down));
  add(system, "shape=cylinder point=0,0,0 axis=0,0,1 radius=0.1 stiffness=2e4 damping=0.5 friction=0.3 "
              "friction_speed=1e-3");
  return small_falling(system);
}

static double tension(const double *q, int k, double piece) {
  const double d[3] = {q[3 * k + 3] - q[3 * k], q[3 * k + 4] - q[3 * k + 1], q[3 * k + 5] - q[3 * k + 2]};
  return 2000.0 * (sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) / piece - 1.0);
}

TEST(a_rope_over_a_roller_holds_as_euler_and_eytelwein_say) {
  const double piece = acos(-1.0) * 0.1 / ARC, speed = 0.05, rest = piece / (1.0 + 9.81 / 2000.0);
  double q[3 * ROPE], v[3 * ROPE];
  lay_over_roller(0.1, speed, piece, q, v);
  owned_system *system = rope_over_roller(q, v, rest, speed);
  end_of_run(q, v, system, .method = "rk4", .step = 2e-5, .duration = 0.3, .every = 0.3);
  const double right = exp(0.3 * acos(-1.0));
  check_between(tension(q, ROPE - 2, rest) / tension(q, 0, rest), 0.98 * right, 1.02 * right);
}

/* A line of 10 m and 10 N/m from the ground to a point 8.8 m on and 3 m up, at rest: part of it lies. Irvine
 * (1981), without stretch: s hangs, with H = w (s^2 - h^2)/(2 h) and s + 8.8 - (H/w) asinh(w s/H) = 10. */
static double lying_line(double *touching) {
  enum { PIECES = 50 };
  const double span = sqrt(8.8 * 8.8 + 9.0), piece = 10.0 / PIECES;
  owned_system *line = small_part(NULL, "rope", "line",
                                  "from=0,0,0 to=8.8,3,0 segments=%d density=%.17g pinned=start,end "
                                  "stretch.stiffness=1e6 stretch.rest_scale=%.17g",
                                  PIECES, 10.0 / 9.81 * 10.0 / span, 10.0 / span);
  add(line, "shape=plane point=0,0,0 normal=0,1,0 stiffness=1e4");
  small_falling(line);
  owned_state *state = start_state(line);
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  for (double step = 0.05; step < 1e3; step *= 3.0) { /* without inertia, and ever longer */
    owned_integrator *run = start_with(line, .method = "backward-euler", .step = step);
    check_ok(hooke_integrator_step(run, state, 1));
    memset(v, 0, 3 * (PIECES + 1) * sizeof *v);
  }
  for (int k = 1; k <= PIECES; k++)
    *touching += q[3 * k + 1] < 1e-4 ? piece : 0.0;
  const double *a = q + 3 * PIECES, *b = a - 3, d[2] = {a[0] - b[0], a[1] - b[1]};
  return 1e6 * (sqrt(d[0] * d[0] + d[1] * d[1]) / piece - 1.0);
}

TEST(a_line_lies_on_the_ground_as_irvine_says) {
  double low = 3.001, high = 10.0, touching = 0.0;
  while (high - low > 1e-12) {
    const double s = 0.5 * (low + high), a = (s * s - 9.0) / 6.0;
    *(s + 8.8 - a * asinh(s / a) > 10.0 ? &low : &high) = s;
  }
  const double h = 10.0 * (low * low - 9.0) / 6.0, at_top = h + 10.0 * (3.0 - 0.5 * 0.2 * 3.0 / low);
  check_close(lying_line(&touching), at_top, 0.01 * at_top);
  check_close(touching, 10.0 - low, 0.2);
}

/* At the centre there is no direction, and no force; it is counted. */
TEST(at_a_centre_there_is_no_force) {
  const double place[3] = {1, 2, 3}, beside[3] = {1, 2, 3.1}, none[3] = {0, 0, 0};
  owned_system *system = falling(place, NULL, none, "shape=sphere center=1,2,3 radius=0.5 stiffness=100");
  double force[3];
  check_ok(hooke_system_force(system, 0.0, place, none, force));
  for (int a = 0; a < 3; a++)
    check_between(force[a], 0.0, 0.0);
  assert_int_equal(hooke_system_coincident_springs(system, place), 1);
  assert_int_equal(hooke_system_coincident_springs(system, beside), 0);
  owned_run(run, state, system, .method = "rk4", .step = 1e-3);
  check_ok(hooke_integrator_step(run, state, 1));
  assert_int_equal(hooke_integrator_count(run, "coincident_springs"), 1);
}

/* Where it is at a time, by sine; unit axis; none beyond the last. */
TEST(an_obstacle_has_a_place_at_every_time) {
  const double at_one[7] = {0, 1.5, 0, 0, 0, -1, 2}, at_zero[7] = {1, 2, 3, 0, 0, 0, 0.5};
  double place[7];
  owned_system *system = new_system();
  add(system, "shape=cylinder point=0,1,0 axis=0,0,-3 radius=2 stiffness=1 motion=harmonic amplitude=0,0.5,0 "
              "frequency=0.25");
  add(system, "shape=sphere center=1,2,3 radius=0.5 clearance=0.1 stiffness=100");
  check_ok(hooke_system_obstacle_place(system, 0, 1.0, place));
  for (int k = 0; k < 7; k++)
    check_close(place[k], at_one[k], 1e-15);
  check_ok(hooke_system_obstacle_place(system, 1, 7.0, place));
  for (int k = 0; k < 7; k++)
    check_close(place[k], at_zero[k], 0.0);
  assert_string_equal(hooke_system_obstacle_shape(system, 0), "cylinder");
  assert_string_equal(hooke_system_obstacle_shape(system, 1), "sphere");
  assert_null(hooke_system_obstacle_shape(system, 2));
  assert_null(hooke_system_obstacle_shape(system, -1));
  check_status(hooke_system_obstacle_place(system, 2, 0.0, place), HOOKE_BAD_VALUE);
  check_message("obstacle: there is no obstacle 2; the system has 2");
}

TEST(what_is_wrong_is_said) {
  static const char *const wrong[][2] = {
      {"shape=plane point=0,0,0 stiffness=1", "normal: is required with shape \"plane\" but missing"},
      {"shape=plane point=0,0,0 normal=0,0,0 stiffness=1", "normal: 0 0 0 has no direction"},
      {"shape=plane point=0,0,0 normal=0,1,0 stiffness=1 radius=2",
       "radius: belongs to shape \"sphere cylinder\""},
      {"shape=sphere center=0,0,0 radius=1 stiffness=1 friction=0.1",
       "friction_speed: is required with friction"},
      {"shape=sphere center=0,0,0 radius=1 stiffness=1 amplitude=1,0,0",
       "amplitude: belongs to motion \"harmonic\", which is missing"},
      {"shape=sphere center=0,0,0 radius=1 stiffness=1 motion=harmonic amplitude=1,0,0",
       "frequency: is required with motion \"harmonic\" but missing"},
      {"shape=sphere center=0,0,0 radius=1 stiffness=1 motion=table time=0,1 position=0,0,0,1,0,0,2,0,0",
       "position: 3 rows given; allowed: 2, one for each time"}};
  owned_system *system = new_system();
  for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
    owned_options *options = new_options("obstacles");
    check_ok(try_words(options, wrong[k][0]));
    check_status(hooke_system_add_obstacle(system, -1, NULL, options), HOOKE_BAD_VALUE);
    check_message(wrong[k][1]);
  }
}
