/* Mechanisms of rigid bodies, pins and stiff springs: the nutating top, the flyball governor, a linkage of
 * two bars, and a frame that hangs in a cloth. */
#include "check.h"
#include "gsl_motion.h"
#include "order.h"
#include "run.h"
#include "small.h"

#include <gsl/gsl_sf_ellint.h>
#include <gsl/gsl_sf_elljac.h>
#include <math.h>
#include <string.h>

static const double PI = 3.14159265358979323846, G = 9.81;

/* ---- the heavy symmetric top, let go while it spins ---- */

enum { RIM = 8, TOP = RIM + 1 };
static const double AXLE = 0.5, RADIUS = 0.3, SPIN = 20.0, TILT = 1.0; /* m, m, rad/s, rad */

/* A wheel of 1 kg on an axle that is pinned at its end and inclined by TILT from the vertical. */
static hooke_system *spinning_top(void) {
  const double e[3] = {sin(TILT), 0.0, cos(TILT)}, f[3] = {cos(TILT), 0.0, -sin(TILT)}, mass = 1.0 / RIM;
  double q[3 * TOP] = {0.0}, v[3 * TOP] = {0.0};
  int64_t all[TOP];
  for (int p = 0; p < TOP; p++) {
    const double c = RADIUS * cos(2.0 * PI * p / RIM), s = RADIUS * sin(2.0 * PI * p / RIM);
    const double across[3] = {0.0, 1.0, 0.0}; /* e x f */
    all[p] = p;
    for (int a = 0; a < 3 && p < RIM; a++) {
      q[3 * p + a] = AXLE * e[a] + c * f[a] + s * across[a];
      v[3 * p + a] = SPIN * (c * across[a] - s * f[a]);
    }
  }
  hooke_system *system = small_system(TOP, q, v, mass, 0);
  check_ok(hooke_system_pin(system, 1, all + RIM));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, 0.0, -G}));
  check_ok(hooke_system_add_body(system, "top", TOP, all, 0));
  return committed(system);
}

/* The height u = cos(inclination) after t: u'^2 = (u0 - u) (b (1 - u^2) - a^2 (u0 - u)), a cubic whose roots
 * u1 < u0 < u3 make u an elliptic function (Goldstein 1980, section 5-7). Returns the period. */
static double nutation(double t, double *u) {
  const double own = RADIUS * RADIUS, other = AXLE * AXLE + 0.5 * own, u0 = cos(TILT);
  const double a = own * SPIN / other, b = 2.0 * G * AXLE / other, aa = a * a;
  const double root = sqrt(aa * aa - 4.0 * b * (aa * u0 - b));
  const double u1 = (aa - root) / (2.0 * b), u3 = (aa + root) / (2.0 * b);
  const double k = sqrt((u0 - u1) / (u3 - u1)), rate = 0.5 * sqrt(b * (u3 - u1));
  const double quarter = gsl_sf_ellint_Kcomp(k, GSL_PREC_DOUBLE);
  double sn, cn, dn;
  gsl_sf_elljac_e(quarter + rate * t, k * k, &sn, &cn, &dn);
  *u = u1 + (u0 - u1) * sn * sn;
  return 2.0 * quarter / rate;
}

static double error_of_height(const hooke_system *system, struct run run) {
  double q[3 * TOP], height = 0.0, expected;
  run_to_end(system, run, q, NULL);
  for (int p = 0; p < RIM; p++)
    height += q[3 * p + 2] / (RIM * AXLE);
  nutation(run.duration, &expected);
  return fabs(height - expected);
}

TEST(top_nutates) {
  owned_system *system = spinning_top();
  double unused_height;
  const double period = nutation(0.0, &unused_height), time = 3.3 * period;
  check_between(period, 0.1, 2.0);
  const char *const methods[] = {"symplectic-euler", "verlet", "rk4"};
  const double low[] = {0.9, 1.9, 3.8}, high[] = {1.1, 2.1, 4.3}, steps[] = {4000.0, 500.0, 1000.0};
  for (int m = 0; m < 3; m++) {
    double error[4];
    for (int k = 0; k < 4; k++)
      error[k] = error_of_height(system, (struct run){.method = methods[m],
                                                      .step = time / ldexp(steps[m], k),
                                                      .duration = time,
                                                      .every = time});
    check_order(methods[m], 4, error, low[m], high[m]);
  }
  if (hooke_method_is_built("rk8pd"))
    check_between(error_of_height(system, (struct run){.method = "rk8pd",
                                                       .duration = 10.3 * period,
                                                       .every = 10.3 * period,
                                                       .rtol = 1e-13,
                                                       .atol = 1e-13}),
                  0.0, 1e-10);
}

/* ---- bars, and the motions of their angles, by GSL ---- */

/* Three particles of Simpson's weights have the mass, centre and moments of a thin bar of 1 m. */
enum { ROD = 3 };
static void fill_rod(const double start[3], const double along[3], double mass, double *q, double *m) {
  const double share[ROD] = {1.0 / 6, 4.0 / 6, 1.0 / 6};
  for (int p = 0; p < ROD; p++) {
    for (int a = 0; a < 3; a++)
      q[3 * p + a] = start[a] + 0.5 * p * along[a];
    m[p] = share[p] * mass;
  }
}

/* ---- IFToMM's benchmark A05, the stiff flyball governor ----
 *
 * Two rods of 1 x 0.01 x 0.01 m and 3000 kg/m^3, each with 5 kg at its end, hang from one point and turn
 * at 2 pi rad/s. Springs of 8e5 N/m with 4e4 N s/m and 0.5 m lead from their middles to a slider of 0.1^3
 * m^3 on the axis, 0.5 m below the point; the rods begin 30 degrees below the horizontal. Here each rod is
 * a body that swings about a pin, without the shaft, whose moment of inertia is a millionth of that of the
 * rods, and the slider is a point that stays on the axis by symmetry. */

static const double ROD_MASS = 0.3, BALL = 5.0, SLIDER = 3.0, LINK = 0.5;
enum { GOVERNOR = 2 * ROD + 1 };

static hooke_system *governor(double stiffness) {
  const double origin[3] = {0.0, 0.0, 0.0}, below[3] = {0.0, 0.0, -LINK};
  const double c = cos(PI / 6), s = sin(PI / 6);
  double q[3 * GOVERNOR], v[3 * GOVERNOR] = {0.0}, mass[GOVERNOR];
  for (int k = 0; k < 2; k++) {
    const double along[3] = {k ? -c : c, 0.0, -s};
    fill_rod(origin, along, ROD_MASS, q + 9 * k, mass + 3 * k);
    mass[3 * k + 2] += BALL;
    for (int p = 0; p < ROD; p++)
      v[9 * k + 3 * p + 1] = 2.0 * PI * q[9 * k + 3 * p];
  }
  memcpy(q + 6 * ROD, below, sizeof below);
  mass[2 * ROD] = SLIDER;
  owned_options *link = options_with("springs", "law=length stiffness=%.17g damping=%.17g rest_length=%.17g",
                                     stiffness, 0.05 * stiffness, LINK);
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, GOVERNOR, q, v, GOVERNOR, mass, NULL));
  check_ok(hooke_system_pin(system, 2, (int64_t[]){0, ROD}));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, 0.0, -G}));
  check_ok(hooke_system_add_body(system, "left", ROD, (int64_t[]){0, 1, 2}, 0));
  check_ok(hooke_system_add_body(system, "right", ROD, (int64_t[]){3, 4, 5}, 0));
  check_ok(hooke_system_add_springs(system, "links", 2, (int64_t[]){1, 2 * ROD, ROD + 1, 2 * ROD}, link));
  return committed(system);
}

/* With rigid links the angle x of the rods from the vertical is all: the slider is 2 l cos x below the
 * point, each rod turns about the vertical with the momentum p = J sin^2 x w that it began with, and
 * Lagrange's equation is
 *
 *     (2 J + 4 l^2 M sin^2 x) x'' + 4 l^2 M sin x cos x x'^2 = 2 p^2 cos x/(J sin^3 x) - 2 (S + l M) g sin x
 *
 * with the moment of inertia J and the static moment S of a rod with its ball. */
static int32_t turn_governor(int64_t n, double t, const double *angle, const double *rate,
                             double *acceleration, void *ctx) {
  (void)n, (void)t, (void)ctx;
  const double j = ROD_MASS / 3.0 + BALL, moment = ROD_MASS / 2.0 + BALL, p = j * 0.75 * 2.0 * PI;
  const double s = sin(*angle), c = cos(*angle), slider = 4.0 * LINK * LINK * SLIDER;
  *acceleration = (2.0 * p * p * c / (j * s * s * s) - 2.0 * (moment + LINK * SLIDER) * G * s -
                   slider * s * c * *rate * *rate) /
                  (2.0 * j + slider * s * s);
  return 0;
}

/* The angles of a motion that the frames of a run, FRAME apart, are compared with. */
static const double FRAME = 0.02;
struct followed {
  struct gsl_motion motion;
  double (*distance)(const double *q, const double *angle);
  double angle[4]; /* and their rates */
  int frames;
  double off; /* largest distance so far */
};

static int32_t follow_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct followed *f = ctx;
  (void)step;
  if (f->frames++ > 0) gsl_move(&f->motion, 0.0, FRAME, f->angle);
  f->off = fmax(f->off, f->distance(hooke_state_position(state), f->angle));
  return 0;
}

/* Consumes the system. */
static double follow(hooke_system *system, struct run run, struct followed followed) {
  run.every = FRAME;
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_on_frame(integrator, follow_frame, &followed));
  check_ok(hooke_integrator_run(integrator, state));
  hooke_system_destroy(system);
  return followed.off;
}

static double slider_off(const double *q, const double *angle) {
  return fabs(q[6 * ROD + 2] + 2.0 * LINK * cos(*angle));
}

static double slider_risen(const double *q, const double *angle) {
  (void)angle;
  return fabs(q[6 * ROD + 2] + LINK);
}

/* The links give by force over stiffness. */
TEST(governor_follows_its_angle) {
  const struct run rk4 = {.method = "rk4", .step = 1e-4, .duration = 2.0};
  struct followed governed = {{1, turn_governor, 1.0, NULL}, slider_off, {PI / 3}, 0, 0.0};
  double off[3];
  for (int k = 0; k < 3; k++)
    off[k] = follow(governor(ldexp(8e5, k - 2)), rk4, governed);
  check_order("stiffness", 3, off, 0.9, 1.1);
  check_between(off[2], 1e-6, 1e-3);
  if (hooke_method_is_built("cvode-bdf")) {
    const struct run bdf = {.method = "cvode-bdf", .duration = 2.0, .rtol = 1e-9, .atol = 1e-9};
    check_close(follow(governor(8e5), bdf, governed), off[2], 1e-6);
  }
  governed.distance = slider_risen;
  check_between(follow(governor(8e5), rk4, governed), 0.05, 1.0);
}

/* ---- a linkage of two bars through a stiff spring of no length ---- */

enum { LINKAGE = 2 * ROD };
static const double BAR[2] = {1.0, 0.6}, START[2] = {0.8, 0.3}; /* kg, rad */

static hooke_system *linkage(double stiffness) {
  double q[3 * LINKAGE], mass[LINKAGE], start[3] = {0.0, 0.0, 0.0};
  for (int k = 0; k < 2; k++) {
    const double along[3] = {sin(START[k]), -cos(START[k]), 0.0};
    fill_rod(start, along, BAR[k], q + 9 * k, mass + ROD * k);
    memcpy(start, along, sizeof along); /* the end of the first */
  }
  owned_options *joint = options_with("springs", "law=length stiffness=%.17g rest_length=0", stiffness);
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, LINKAGE, q, NULL, LINKAGE, mass, NULL));
  check_ok(hooke_system_pin(system, 1, (int64_t[]){0}));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -G, 0.0}));
  check_ok(hooke_system_add_body(system, "upper", ROD, (int64_t[]){0, 1, 2}, 0));
  check_ok(hooke_system_add_body(system, "lower", ROD, (int64_t[]){3, 4, 5}, 0));
  check_ok(hooke_system_add_springs(system, "joint", 1, (int64_t[]){2, 3}, joint));
  return committed(system);
}

/* The double pendulum of two bars of 1 m, by Lagrange's equations in the angles from the vertical. */
static int32_t turn_linkage(int64_t n, double t, const double *angle, const double *rate,
                            double *acceleration, void *ctx) {
  (void)n, (void)t, (void)ctx;
  const double c = 0.5 * BAR[1] * cos(angle[0] - angle[1]), s = 0.5 * BAR[1] * sin(angle[0] - angle[1]);
  const double j[2] = {BAR[0] / 3.0 + BAR[1], BAR[1] / 3.0};
  const double f[2] = {-s * rate[1] * rate[1] - (0.5 * BAR[0] + BAR[1]) * G * sin(angle[0]),
                       s * rate[0] * rate[0] - 0.5 * BAR[1] * G * sin(angle[1])};
  const double all = j[0] * j[1] - c * c;
  acceleration[0] = (j[1] * f[0] - c * f[1]) / all;
  acceleration[1] = (j[0] * f[1] - c * f[0]) / all;
  return 0;
}

/* Of the free end. */
static double end_off(const double *q, const double *angle) {
  const double *end = q + 3 * (LINKAGE - 1);
  return hypot(end[0] - sin(angle[0]) - sin(angle[1]), end[1] + cos(angle[0]) + cos(angle[1]));
}

TEST(linkage_follows_its_angles) {
  const struct followed swinging = {{2, turn_linkage, 1.0, NULL}, end_off, {START[0], START[1]}, 0, 0.0};
  double off[4];
  for (int k = 0; k < 4; k++)
    off[k] = follow(linkage(ldexp(1e4, 2 * k)),
                    (struct run){.method = "verlet", .step = ldexp(2e-4, -k), .duration = 1.5}, swinging);
  check_order("stiffness", 4, off, 1.8, 2.2); /* of four times the stiffness */
  check_between(off[3], 1e-7, 1e-4);
}

/* ---- a frame in a cloth ---- */

enum { CLOTH = 9, FRAME_SIDE = 5, FRAME_COUNT = 4 * (FRAME_SIDE - 1) };

/* The square ring of particles in the middle. */
static void list_frame(int64_t particle[FRAME_COUNT]) {
  const int64_t low = (CLOTH - FRAME_SIDE) / 2, high = low + FRAME_SIDE - 1;
  int count = 0;
  for (int64_t y = low; y <= high; y++)
    for (int64_t x = low; x <= high; x++)
      if (x == low || x == high || y == low || y == high) particle[count++] = CLOTH * y + x;
  assert_int_equal(count, FRAME_COUNT);
}

static hooke_system *framed_cloth(double drag) {
  int64_t frame[FRAME_COUNT];
  list_frame(frame);
  owned_options *cloth = options_with("cloth",
                                      "size=%d,%d edges=1,0,0,0,0.3,1 mass=0.5 pinned=top-corners "
                                      "structural.stiffness=20 shear.stiffness=5",
                                      CLOTH, CLOTH);
  hooke_system *system = new_system();
  check_ok(hooke_system_add_part(system, "cloth", "cloth", cloth, NULL, NULL));
  check_ok(hooke_system_add_body(system, "frame", FRAME_COUNT, frame, 0));
  check_ok(hooke_system_set_gravity(system, (double[]){0.0, -G, 0.0}));
  check_ok(hooke_system_set_drag(system, drag));
  return committed(system);
}

/* Largest change of a distance between two particles of the frame. */
static double bent(const double *from, const double *to) {
  int64_t frame[FRAME_COUNT];
  double most = 0.0;
  list_frame(frame);
  for (int i = 0; i < FRAME_COUNT; i++) {
    for (int j = 0; j < i; j++) {
      double before = 0.0, now = 0.0;
      for (int a = 0; a < 3; a++) {
        before = hypot(before, from[3 * frame[i] + a] - from[3 * frame[j] + a]);
        now = hypot(now, to[3 * frame[i] + a] - to[3 * frame[j] + a]);
      }
      most = fmax(most, fabs(now - before));
    }
  }
  return most;
}

TEST(framed_cloth_keeps_its_energy) {
  enum { N = CLOTH * CLOTH };
  owned_system *system = framed_cloth(0.0);
  owned_state *start = start_state(system);
  const double *q0 = hooke_state_position(start);
  const double before = hooke_system_energy(system, "total", q0, hooke_state_velocity(start));
  double error[4], q[3 * N], v[3 * N];
  for (int k = 0; k < 4; k++) {
    end_of_run(q, v, system, .method = "verlet", .step = ldexp(1e-3, -k), .duration = 0.4);
    error[k] = fabs(hooke_system_energy(system, "total", q, v) - before);
    check_between(bent(q0, q), 0.0, 1e-13);
  }
  check_order("verlet", 4, error, 1.8, 2.2);
  check_between(hooke_system_energy(system, "kinetic", q, v), 0.05, 5.0);
}

/* Once it has come to rest, what acts on the frame adds up to no force and no torque; on its particles it
 * does not. */
TEST(frame_hangs_in_balance) {
  enum { N = CLOTH * CLOTH };
  owned_system *system = framed_cloth(0.03);
  double q[3 * N], v[3 * N], f[3 * N], force[3] = {0.0}, torque[3] = {0.0}, most = 0.0;
  int64_t frame[FRAME_COUNT];
  list_frame(frame);
  end_of_run(q, v, system, .method = "rk4", .step = 1e-3, .duration = 40.0);
  check_between(largest(3 * N, v), 0.0, 1e-8);
  check_ok(hooke_system_force(system, 0.0, q, v, f));
  for (int k = 0; k < FRAME_COUNT; k++) {
    const double *x = q + 3 * frame[k], *on = f + 3 * frame[k];
    for (int a = 0; a < 3; a++) {
      const int b = (a + 1) % 3, c = (a + 2) % 3;
      force[a] += on[a];
      torque[a] += x[b] * on[c] - x[c] * on[b];
      most = fmax(most, fabs(on[a]));
    }
  }
  check_between(most, 0.05, 10.0);
  check_between(largest(3, force), 0.0, 1e-8);
  check_between(largest(3, torque), 0.0, 1e-8);
}
