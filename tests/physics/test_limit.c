/* Predicted limits: compared with spectra computed independently to 13 digits, with the formulas of one mode,
 * and with the safe bounds, which they may never fall below. */
#include "check.h"
#include "random_scene.h"
#include "reference.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Limits of all methods at the initial state, without measuring. `accuracy` 0: the default. */
static hooke_measurement *limit_of(const hooke_system *system, double accuracy) {
  hooke_options *options = options_with("limit", "predict=1");
  if (accuracy > 0.0) check_ok(hooke_options_set_number(options, "accuracy", accuracy));
  return limit_at_start(system, NULL, options);
}

static int64_t row_of(const hooke_measurement *limit, const char *method) {
  for (int64_t k = 0; k < hooke_measurement_row_count(limit, "rows"); k++) {
    if (strcmp(hooke_measurement_text(limit, "rows", k, "method"), method) == 0) return k;
  }
  check_failed("there is no row %s", method);
  return -1;
}

static double number_of(const hooke_measurement *limit, const char *method, const char *what) {
  return hooke_measurement_number(limit, "rows", row_of(limit, method), what);
}

static double predicted(const hooke_measurement *limit, const char *method) {
  return number_of(limit, method, "predicted");
}

static void check_digits(double value, double expected, double relative) {
  check_close(value, expected, relative * fabs(expected));
}

/* ---- scenes ---- */

/* N x n particles of 0.01 kg, 0.1 m apart, springs of 50 N, hung by two corners. */
static hooke_system *build_cloth(int n, double damping, double drag) {
  const double side = 0.1 * (n - 1);
  hooke_system *system = new_system();
  small_part(system, "cloth", NULL,
             "edges=%.17g,0,0,0,0,%.17g size=%d,%d mass=%.17g pinned=top-corners "
             "structural.stiffness=50 structural.damping=%.17g shear.stiffness=50 shear.damping=%.17g "
             "bend.stiffness=50 bend.damping=%.17g",
             side, side, n, n, 0.01 * n * n, damping, damping, damping);
  check_ok(hooke_system_set_drag(system, drag));
  check_ok(hooke_system_commit(system));
  return system;
}

/* Copies of the net of six particles, disconnected: the limits are those of one. */
static hooke_system *build_nets(int64_t copies) {
  const struct reference *net = find_reference("six-particles");
  const int64_t n = net->particle_count;
  owned_doubles *position = new_doubles(3 * n * copies), *mass = new_doubles(n * copies);
  hooke_system *system = new_system();
  for (int64_t k = 0; k < n * copies; k++) {
    mass[k] = net->mass[net->mass_count > 1 ? k % n : 0];
    for (int a = 0; a < 3; a++)
      position[3 * k + a] = net->position[3 * (k % n) + a] + (a == 0 ? 4.0 * (double)(k / n) : 0.0);
  }
  check_ok(hooke_system_add_particles(system, n * copies, position, NULL, n * copies, mass, NULL));
  for (int64_t g = 0; g < net->group_count; g++) {
    const struct reference_group *group = &net->group[g];
    int64_t *ends = new_block(2 * group->count * copies, (int64_t)sizeof *ends);
    owned_doubles *rest = new_doubles(group->count * copies);
    for (int64_t k = 0; k < group->count * copies; k++) {
      double square = 0.0;
      for (int e = 0; e < 2; e++)
        ends[2 * k + e] = group->ends[2 * (k % group->count) + e] + n * (k / group->count);
      for (int a = 0; a < 3; a++) {
        const double d = net->position[3 * group->ends[2 * (k % group->count)] + a] -
                         net->position[3 * group->ends[2 * (k % group->count) + 1] + a];
        square += d * d;
      }
      rest[k] = group->rest_scale * (group->rest_length < 0.0 ? sqrt(square) : group->rest_length);
    }
    owned_options *options = new_options("springs");
    if (group->law) check_ok(hooke_options_set_text(options, "law", group->law));
    set_options(options, "stiffness=%.17g damping=%.17g", group->stiffness, group->damping);
    check_ok(hooke_options_set_numbers(options, "rest_length", group->count * copies, rest));
    check_ok(hooke_system_add_springs(system, group->name, group->count * copies, ends, options));
    free(ends);
  }
  for (int64_t c = 0; c < copies; c++) {
    for (int64_t k = 0; k < net->pinned_count; k++) {
      const int64_t pinned = net->pinned[k] + n * c;
      check_ok(hooke_system_pin(system, 1, &pinned));
    }
  }
  check_ok(hooke_system_commit(system));
  return system;
}

/* ---- spectra ---- */

/* Spectra of the linearised systems, computed independently with dense matrices in double precision. */
static const struct {
  double frequency, verlet, symplectic_euler, rk4, forward_euler;
} net6 = {14.658903548369766, 0.1364358523405676, 0.13162450213044632, 0.19724928576176828,
          1.7768476830321846e-05},
  cloth10 = {582.2601378383093, 0.0034348908160279894, 0.003058102791710135, 0.005078523465343316,
             0.0003999999999994838};

TEST(critical_steps_to_ten_digits) {
  hooke_system *system = build_reference(find_reference("six-particles"));
  hooke_measurement *limit = limit_of(system, 0.0);
  check_digits(hooke_measurement_number(limit, "limit", 0, "frequency_max"), net6.frequency, 1e-12);
  check_digits(predicted(limit, "verlet"), net6.verlet, 1e-12);
  check_digits(predicted(limit, "symplectic-euler"), net6.symplectic_euler, 1e-10);
  check_digits(predicted(limit, "rk4"), net6.rk4, 1e-10);
  check_digits(predicted(limit, "forward-euler"), net6.forward_euler, 1e-8);
  assert_true(isinf(predicted(limit, "backward-euler")));
  check_between(hooke_measurement_number(limit, "limit", 0, "mode_count"), 15,
                15); /* 15 unknowns, none of them free to drift */
  hooke_measurement_destroy(limit);
  hooke_system_destroy(system);

  system = build_cloth(10, 0.02, 0.0);
  limit = limit_of(system, 0.0);
  check_digits(hooke_measurement_number(limit, "limit", 0, "frequency_max"), cloth10.frequency, 1e-11);
  check_digits(predicted(limit, "verlet"), cloth10.verlet, 1e-11);
  check_digits(predicted(limit, "symplectic-euler"), cloth10.symplectic_euler, 1e-10);
  check_digits(predicted(limit, "rk4"), cloth10.rk4, 1e-10);
  check_digits(predicted(limit, "forward-euler"), cloth10.forward_euler, 1e-9);
  check_between(hooke_measurement_number(limit, "limit", 0, "mode_count"), 196,
                196); /* 294 unknowns; 98 zero modes across the sheet */
  check_between(hooke_measurement_number(limit, "limit", 0, "clamped"), 0, 0);
  hooke_measurement_destroy(limit);
  hooke_system_destroy(system);
}

/* x'' + 2 zeta omega x' + omega^2 x = 0: a mass on a spring at its rest length, which is free across. */
TEST(one_mode_follows_the_table) {
  const double omega = 7.0, mass = 2.0, position[] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[] = {0, 1};
  static const struct {
    double zeta, forward_euler, symplectic_euler, rk4;
  } table[] = {{0.0, 0.0, 2.0, 2.82843},     {0.05, 0.1, 1.90250, 2.90980}, {0.1, 0.2, 1.80998, 2.95085},
               {0.5, 1.0, 1.23607, 2.62254}, {1.0, 2.0, 0.82843, 2.78529},  {5.0, 0.20204, 0.19804, 0.28137}};
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++) {
    owned_system *system = small_system(2, position, NULL, mass, 1);
    small_springs(system, 1, ends,
                  (struct springs){.law = "length",
                                   .stiffness = mass * omega * omega,
                                   .damping = 2.0 * table[k].zeta * omega * mass,
                                   .rest_length = -1.0});
    check_ok(hooke_system_commit(system));
    owned_measurement *limit = limit_of(system, 0.0);
    check_close(omega * predicted(limit, "forward-euler"), table[k].forward_euler, 1e-5);
    check_close(omega * predicted(limit, "symplectic-euler"), table[k].symplectic_euler, 1e-5);
    check_close(omega * predicted(limit, "verlet"), 2.0, 1e-12);
    check_close(omega * predicted(limit, "rk4"), table[k].rk4, 1e-5);
    check_between(number_of(limit, "forward-euler", "never_stable"), k == 0, k == 0);
    check_close(hooke_measurement_number(limit, "limit", 0, "rate_max"), 2.0 * table[k].zeta * omega,
                1e-12 * omega);
  }
}

/* Copies of the same scene take another path: iterations for more unknowns, a partial spectrum beyond. */
TEST(many_copies_have_the_limits_of_one) {
  static const struct {
    int64_t copies; /* 15 unknowns each */
    int32_t exact;
    double digits;
  } scenes[] = {{20, 1, 1e-9}, {60, 0, 1e-9}, {800, 0, 1e-3}};
  for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
    owned_system *system = build_nets(scenes[k].copies);
    owned_measurement *limit = limit_of(system, 0.0);
    const double digits = scenes[k].digits;
    check_digits(predicted(limit, "verlet"), net6.verlet, digits);
    check_digits(predicted(limit, "symplectic-euler"), net6.symplectic_euler, digits);
    check_between(number_of(limit, "symplectic-euler", "exact"), 1, 1);
    check_between(number_of(limit, "rk4", "exact"), scenes[k].exact, scenes[k].exact);
    check_between(number_of(limit, "forward-euler", "exact"), scenes[k].exact, scenes[k].exact);
    if (scenes[k].exact) {
      check_digits(predicted(limit, "rk4"), net6.rk4, 1e-9);
      check_digits(predicted(limit, "forward-euler"), net6.forward_euler, 1e-6);
    } else {
      /* over the modes found: never below the limit, and here these include the ones that limit Runge-Kutta
       */
      check_between(predicted(limit, "rk4"), (1.0 - 2e-3) * net6.rk4, 1.02 * net6.rk4);
      check_between(predicted(limit, "forward-euler"), net6.forward_euler, INFINITY);
      assert_true(strstr(hooke_measurement_text(limit, "rows", row_of(limit, "rk4"), "note"),
                         "only the fastest") != NULL);
    }
  }
}

/* All eigenvalues by dense matrices, the largest by iterations: just below the maximum size of the former. */
TEST(iterations_agree_with_dense_matrices) {
  const int sizes[] = {11, 22}; /* 357 and 1446 unknowns */
  for (int k = 0; k < 2; k++) {
    owned_system *system = build_cloth(sizes[k], 0.0, 0.0);
    owned_measurement *limit = limit_of(system, 1e-6);
    const double omega = hooke_measurement_number(limit, "limit", 0, "frequency_max");
    double most = 0.0;
    for (int64_t j = 0; j < hooke_measurement_row_count(limit, "modes"); j++)
      most = fmax(most, hooke_measurement_number(limit, "modes", j, "imaginary"));
    check_digits(omega, most, 1e-9);
    check_digits(hooke_measurement_number(limit, "modes", 0, "imaginary"), most, 0.0);
    check_between(number_of(limit, "forward-euler", "never_stable"), 1, 1);
  }
}

/* To the given accuracy, and not much better, with less work. */
TEST(large_scenes_keep_the_accuracy) {
  owned_system *system = build_cloth(70, 0.02, 0.0);
  owned_measurement *rough = limit_of(system, 1e-3), *fine = limit_of(system, 1e-7);
  const char *methods[] = {"symplectic-euler", "verlet", "rk4", "forward-euler"};
  for (int m = 0; m < 4; m++) {
    check_digits(predicted(rough, methods[m]), predicted(fine, methods[m]), 1e-3);
    check_between(number_of(rough, methods[m], "exact"), 1, 1); /* proportional damping */
  }
  check_between(hooke_measurement_number(rough, "limit", 0, "products"), 10, 120);
  assert_true(hooke_measurement_number(fine, "limit", 0, "products") >
              2.0 * hooke_measurement_number(rough, "limit", 0, "products"));
}

/* ---- bounds ---- */

TEST(bounds_are_never_above_the_limit) {
  const int features[] = {SCENE_GRAVITY, SCENE_DRAG, SCENE_DAMPING, SCENE_PULL_ONLY, SCENE_PINNED};
  double lowest = INFINITY, highest = 0.0;
  enum { MOST_ROWS = 16 };
  int64_t limited[MOST_ROWS] = {0}, tried = 0;
  for (uint64_t seed = 1; seed <= 10000; seed++) {
    if (left_out((int64_t)seed, 11)) continue;
    tried++;
    owned_random_scene scene;
    struct random_scene_request request = {.seed = seed, .particles = 4 + (int64_t)(seed % 5)};
    request.springs = request.particles + (int64_t)(seed % 7);
    request.features = SCENE_DAMPING;
    request.triples = seed % 3 == 0 ? 1 + (int64_t)(seed % 6) : 0;
    for (int k = 0; k < 5; k++)
      request.features |= (seed >> k) & 1 ? features[k] : 0;
    random_scene_create(request, &scene);
    hooke_measurement *limit = limit_of(scene.system, 0.0);
    for (int64_t row = 0; row < hooke_measurement_row_count(limit, "rows"); row++) {
      const double bound = hooke_measurement_number(limit, "rows", row, "bound"),
                   h = hooke_measurement_number(limit, "rows", row, "predicted");
      if (!(bound <= h * (1.0 + 1e-9))) {
        check_failed("seed %llu, %s: the bound %.17g is above the limit %.17g", (unsigned long long)seed,
                     hooke_measurement_text(limit, "rows", row, "method"), bound, h);
      }
      const int implicit =
          strcmp(hooke_measurement_text(limit, "rows", row, "method"), "backward-euler") == 0;
      assert_true(!implicit || h == INFINITY);
      if (row >= MOST_ROWS) continue;
      limited[row] += implicit ? 10000 : h > 0.0 && h < INFINITY;
      if (row == row_of(limit, "symplectic-euler") && h < INFINITY) {
        lowest = fmin(lowest, bound / h);
        highest = fmax(highest, bound / h);
      }
    }
    hooke_measurement_destroy(limit);
  }
  /* a bound is useful, and not sharp */
  check_between(lowest, 0.4, 0.9);
  check_between(highest, 0.97, 1.0 + 1e-9);
  for (int row = 0; row < 7; row++)
    assert_true(limited[row] > tried / 10);
}

/* ---- along a run ---- */

struct smallest {
  hooke_measurement *limit;
  hooke_state *copy; /* of the state of a frame, which belongs to the run */
  double limit_met, time;
};

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  (void)step;
  struct smallest *s = ctx;
  check_ok(hooke_state_copy(state, s->copy));
  check_ok(hooke_measurement_run(s->limit, s->copy));
  const double h = predicted(s->limit, "symplectic-euler");
  if (h < s->limit_met) {
    s->limit_met = h;
    s->time = hooke_state_time(state);
  }
  return 0;
}

TEST(the_smallest_limit_of_a_run) {
  owned_system *system = build_reference(find_reference("six-particles"));
  owned_options *run =
      run_options((struct run){.method = "rk4", .step = 0.01, .duration = 1.0, .every = 0.1});
  struct smallest s = {limit_of(system, 0.0), start_state(system), INFINITY, NAN};
  const double first = predicted(s.limit, "symplectic-euler");
  hooke_integrator *integrator = NULL;
  hooke_state *state = start_state(system);
  check_ok(hooke_integrator_create(system, run, &integrator));
  check_ok(hooke_integrator_on_frame(integrator, see, &s));
  check_ok(hooke_integrator_run(integrator, state));
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);

  hooke_measurement *along = NULL;
  state = start_state(system);
  owned_options *options = options_with("limit", "along=1");
  check_ok(hooke_measurement_create("limit", system, run, options, &along));
  check_ok(hooke_measurement_run(along, state));
  check_digits(number_of(along, "symplectic-euler", "smallest"), s.limit_met, 1e-9);
  check_close(number_of(along, "symplectic-euler", "smallest_time"), s.time, 1e-12);
  check_close(hooke_state_time(state), 1.0, 1e-12);
  check_close(hooke_measurement_number(along, "limit", 0, "time"), 1.0, 1e-12);
  /* the net stretches, and the limit falls below that of the start */
  check_between(s.limit_met, 0.5 * first, 0.9999 * first);
  hooke_measurement_destroy(along);

  check_ok(hooke_measurement_create("limit", system, NULL, options, &along));
  check_status(hooke_measurement_run(along, state), HOOKE_BAD_VALUE);
  hooke_measurement_destroy(along);
  hooke_measurement_destroy(s.limit);
  hooke_state_destroy(s.copy);
  hooke_state_destroy(state);
}

/* ---- edge cases ---- */

TEST(nothing_limits) {
  const double position[] = {0, 0, 0, 1, 0, 0};
  const int64_t both[] = {0, 1};
  for (int scene = 0; scene < 3; scene++) {
    owned_system *system = small_system(scene == 2 ? 1 : 2, position, NULL, 1.0, 0);
    if (scene == 0) small_springs(system, 1, both, (struct springs){.stiffness = 5.0, .rest_length = -1.0});
    if (scene == 0) check_ok(hooke_system_pin(system, 2, both));
    check_ok(hooke_system_commit(system));
    owned_measurement *limit = limit_of(system, 0.0);
    for (int64_t row = 0; row < hooke_measurement_row_count(limit, "rows"); row++) {
      assert_true(isinf(hooke_measurement_number(limit, "rows", row, "predicted")));
      check_between(hooke_measurement_number(limit, "rows", row, "never_stable"), 0, 0);
      assert_true(hooke_measurement_text(limit, "rows", row, "note")[0] != '\0');
    }
    check_between(hooke_measurement_number(limit, "limit", 0, "mode_count"), 0, 0);
    check_between(hooke_measurement_number(limit, "limit", 0, "frequency_max"), 0, 0);
    assert_null(hooke_measurement_series(limit, "limit", 0, "shape", NULL));
    assert_true(hooke_measurement_row_count(limit, "blame") == 0);
  }
}

TEST(drag_alone) {
  const double place[3] = {0.0, 0.0, 0.0};
  owned_system *falling = small_system(1, place, NULL, 1.0, 0);
  check_ok(hooke_system_set_drag(falling, 0.25));
  check_ok(hooke_system_commit(falling));
  owned_measurement *limit = limit_of(falling, 0.0);
  check_digits(predicted(limit, "forward-euler"), 8.0, 1e-12);
  check_digits(predicted(limit, "symplectic-euler"), 8.0, 1e-12);
  check_digits(predicted(limit, "rk4"), 4.0 * 2.785293563405282, 1e-11);
  assert_true(isinf(predicted(limit, "verlet")));
  check_digits(hooke_measurement_number(limit, "limit", 0, "rate_max"), 0.25, 1e-14);
}

/* Of a cloth with so many particles that not all modes are computed: what drag limits, it is named for. */
TEST(drag_is_named_whatever_its_amount) {
  owned_options *run = run_options((struct run){.method = "heun"});
  for (double drag = 20.0; drag < 1e6; drag *= 100.0) {
    owned_system *cloth = build_cloth(14, 0.0, drag);
    hooke_options *options = options_with("limit", "predict=1");
    owned_measurement *limit = limit_at_start(cloth, run, options);
    check_digits(predicted(limit, "heun"), 2.0 * 0.01 / drag, 1e-3);
    const char *force = hooke_measurement_text(limit, "blame", 0, "force");
    if (force == NULL || strcmp(force, "drag") != 0) check_failed("drag of %g: blamed on %s", drag, force);
    check_between(hooke_measurement_number(limit, "blame", 0, "share"), 0.99, 1.0);
    assert_non_null(strstr(hooke_measurement_text(limit, "changes", 0, "sentence"), "drag limits the step"));
  }
}

/* A compressed spring pushes its ends apart sideways: that is no limit of a step, and it is counted. */
TEST(compression_is_left_out) {
  const double position[] = {0, 0, 0, 1, 0, 0};
  const int64_t ends[] = {0, 1};
  const double rest_lengths[] = {2.0, 0.5};
  for (int k = 0; k < 2; k++) {
    owned_system *system = small_system(2, position, NULL, 1.0, 1);
    small_springs(system, 1, ends,
                  (struct springs){.law = "length", .stiffness = 100.0, .rest_length = rest_lengths[k]});
    check_ok(hooke_system_commit(system));
    owned_measurement *limit = limit_of(system, 0.0);
    check_between(hooke_measurement_number(limit, "limit", 0, "clamped"), k == 0, k == 0);
    check_digits(predicted(limit, "verlet"), 0.2, 1e-12);
    /* stretched, it is stiff in three directions, and two frequencies are 10 sqrt(1/2) */
    check_between(hooke_measurement_number(limit, "limit", 0, "mode_count"), k == 0 ? 1 : 3, k == 0 ? 1 : 3);
    if (k == 1)
      check_digits(hooke_measurement_number(limit, "modes", 2, "imaginary"), 10.0 * sqrt(0.5), 1e-12);
  }
}

/* One spring of a rope is 50 times stiffer: it carries the mode, whose displacements have norm 1. */
TEST(the_odd_spring_is_named) {
  double position[36] = {0};
  int64_t ends[22];
  for (int k = 0; k < 12; k++)
    position[3 * k] = 0.1 * k;
  for (int k = 0; k < 11; k++)
    ends[2 * k] = k, ends[2 * k + 1] = k + 1;
  owned_system *system = small_system(12, position, NULL, 0.1, 1);
  small_springs(system, 5, ends, (struct springs){.stiffness = 10.0, .damping = 0.01, .rest_length = -1.0});
  small_springs(system, 1, ends + 10, (struct springs){.stiffness = 500.0, .rest_length = -1.0});
  small_springs(system, 5, ends + 12,
                (struct springs){.stiffness = 10.0, .damping = 0.01, .rest_length = -1.0});
  check_ok(hooke_system_commit(system));
  owned_measurement *limit = limit_of(system, 0.0);
  check_between(hooke_measurement_number(limit, "blame", 0, "number"), 5, 5);
  check_between(hooke_measurement_number(limit, "blame", 0, "share"), 0.9, 1.0);
  check_between(hooke_measurement_number(limit, "blame", 0, "first"), 5, 5);
  check_between(hooke_measurement_number(limit, "blame", 0, "second"), 6, 6);
  const double *shape = hooke_measurement_series(limit, "limit", 0, "shape", NULL);
  check_close(largest(36, shape), 1.0, 1e-12);
  check_close(shape[15] + shape[18], 0.0, 0.05); /* its ends move against each other */
  check_between(hooke_measurement_number(limit, "changes", 0, "gain"), 2.0, 8.0);
}

TEST(the_same_every_time) {
  owned_system *system = build_nets(30);
  owned_measurement *first = limit_of(system, 0.0), *second = limit_of(system, 0.0);
  for (int64_t row = 0; row < hooke_measurement_row_count(first, "rows"); row++) {
    const double one = hooke_measurement_number(first, "rows", row, "predicted"),
                 two = hooke_measurement_number(second, "rows", row, "predicted");
    check_same_bits(1, &one, &two);
  }
}

static int32_t stop(double done, const char *what, void *ctx) {
  (void)done, (void)what;
  return ++*(int *)ctx;
}

TEST(bad_input) {
  owned_system *system = small_oscillator(7.0), *other = build_nets(1), *open = NULL;
  hooke_measurement *limit = limit_of(system, 0.0);
  hooke_state *state = start_state(other);
  check_status(hooke_measurement_run(limit, state), HOOKE_BAD_VALUE);
  check_message("a state of 18 numbers does not fit a problem of 6");
  hooke_state_destroy(state);
  state = start_state(system);
  hooke_state_position(state)[3] = NAN;
  check_status(hooke_measurement_run(limit, state), HOOKE_BAD_VALUE);
  check_message("not finite");
  hooke_state_position(state)[3] = 1.0;
  int calls = 0;
  hooke_measurement_on_progress(limit, stop, &calls);
  check_status(hooke_measurement_run(limit, state), HOOKE_STOPPED);
  assert_int_equal(calls, 1);
  hooke_measurement_on_progress(limit, NULL, NULL);
  check_ok(hooke_measurement_run(limit, state));
  check_digits(predicted(limit, "verlet"), 2.0 / 7.0, 1e-12);
  assert_true(isnan(hooke_measurement_number(limit, "rows", 99, "bound")) &&
              isnan(hooke_measurement_number(limit, "rows", 0, "colour")));
  assert_true(isnan(hooke_measurement_number(limit, "limit", 0, "colour")));
  assert_null(hooke_measurement_text(limit, "rows", 99, "method"));
  assert_true(isnan(hooke_measurement_number(limit, "modes", -1, "real")));
  hooke_measurement_destroy(limit);
  hooke_measurement_destroy(NULL);

  owned_options *options = new_options("limit");
  check_status(hooke_options_set_number(options, "accuracy", 0.5), HOOKE_BAD_VALUE);
  check_ok(hooke_options_set_text(options, "methods", "verlet,no-such-method"));
  check_status(hooke_measurement_create("limit", system, NULL, options, &limit), HOOKE_BAD_VALUE);
  check_message("no-such-method");
  check_ok(hooke_system_create(&open));
  check_status(hooke_measurement_create("limit", open, NULL, NULL, &limit), HOOKE_BAD_CALL);
  hooke_state_destroy(state);
}
