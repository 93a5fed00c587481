/* Limits of the step: predictions from the spectrum compared with measurements, on random networks, and on
 * ropes, cloths and lattices with one odd particle or spring. */
#include "check.h"
#include "random.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_PARTICLES = 32, MOST_SPRINGS = 256 };

/* A limit of all methods in `methods` (NULL: all) at the initial state; skips the test in builds without
 * them. */
static hooke_measurement *find_limit(const hooke_system *system, const char *methods, double accuracy,
                                     int32_t predict, const hooke_options *run) {
  hooke_options *options = new_options("limit");
  if (methods) check_ok(hooke_options_set_text(options, "methods", methods));
  set_options(options, "accuracy=%.17g predict=%d nonlinear=%d budget=200", accuracy, predict, run != NULL);
  return limit_at_start(system, run, options);
}

static int agree(double measured, double predicted, double tolerance) {
  return fabs(measured / predicted - 1.0) <= tolerance;
}

/* ---- random networks ---- */

/* 8 particles, some of whose springs are stretched and some compressed; every third scene has springs that
 * only pull, every fourth a driven particle, every second drag. */
static hooke_system *random_network(uint64_t seed, double damping) {
  struct random_source source = {seed};
  enum { N = 8, SPRINGS = 14 };
  double position[3 * N], mass[N], stiffness[SPRINGS], damp[SPRINGS];
  int64_t ends[2 * SPRINGS];
  for (int k = 0; k < 3 * N; k++)
    position[k] = random_between(&source, -1.0, 1.0);
  for (int k = 0; k < N; k++)
    mass[k] = random_between(&source, 0.3, 3.0);
  for (int k = 0; k < SPRINGS; k++) {
    /* a tree, and some more springs */
    const int64_t tail = k < N - 1 ? k + 1 : random_whole(&source, 1, N - 1);
    ends[2 * k] =
        k < N - 1 ? random_whole(&source, 0, tail - 1) : (tail + random_whole(&source, 1, N - 1)) % N;
    ends[2 * k + 1] = tail;
    stiffness[k] = random_between(&source, 5.0, 50.0);
    damp[k] = damping * random_between(&source, 0.0, 2.0);
  }
  const int64_t pinned = 0, driven = 3;
  const double amplitude[3] = {0.1, 0.0, 0.0};
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, N, position, NULL, N, mass, NULL));
  check_ok(hooke_system_pin(system, 1, &pinned));
  if (seed % 4 == 0) check_ok(hooke_system_drive_harmonic(system, 1, &driven, amplitude, 1.0, 0.0));
  owned_options *options =
      options_with("springs", "law=length rest_scale=%.17g", random_between(&source, 0.8, 1.1));
  check_ok(hooke_options_set_numbers(options, "stiffness", SPRINGS, stiffness));
  check_ok(hooke_options_set_numbers(options, "damping", SPRINGS, damp));
  if (seed % 3 == 0) check_ok(hooke_options_set_number(options, "compression", 0.0));
  check_ok(hooke_system_add_springs(system, "network", SPRINGS, ends, options));
  if (seed % 2 == 0) check_ok(hooke_system_set_drag(system, 0.2 * damping));
  check_ok(hooke_system_commit(system));
  return system;
}

TEST(random_networks_run_up_to_the_prediction) {
  for (uint64_t seed = 1; seed <= 80; seed++) {
    if (left_out((int64_t)seed, 5)) continue;
    owned_system *system = random_network(seed, 1.0);
    owned_measurement *limit = find_limit(system, "symplectic-euler,verlet,rk4", 1e-3, 0, NULL);
    for (int64_t row = 0; row < 3; row++) {
      const double predicted = hooke_measurement_number(limit, "rows", row, "predicted");
      const double measured = hooke_measurement_number(limit, "rows", row, "measured");
      if (!agree(measured, predicted, 1e-3)) {
        check_failed("network %d, %s: measured %.8g, predicted %.8g (%s)", (int)seed,
                     hooke_measurement_text(limit, "rows", row, "method"), measured, predicted,
                     hooke_measurement_text(limit, "rows", row, "note"));
      }
      check_close(hooke_measurement_number(limit, "rows", row, "ratio"), measured / predicted, 1e-15);
      check_between(hooke_measurement_number(limit, "rows", row, "bound"), 0.2 * measured,
                    measured * (1.0 + 1e-3));
      check_between(hooke_measurement_number(limit, "rows", row, "steps_run"), 1000.0, 1e7);
    }
  }
}

/* The same comparison with the prediction for another damping must fail. */
TEST(another_damping_is_noticed) {
  int noticed = 0;
  for (uint64_t seed = 1; seed <= 5; seed++) {
    owned_system *system = random_network(seed, 1.0), *other = random_network(seed, 1.1);
    owned_measurement *limit = find_limit(system, "symplectic-euler", 1e-3, 0, NULL);
    owned_measurement *wrong = find_limit(other, "symplectic-euler", 1e-3, 1, NULL);
    const double measured = hooke_measurement_number(limit, "rows", 0, "measured");
    assert_true(agree(measured, hooke_measurement_number(limit, "rows", 0, "predicted"), 1e-3));
    noticed += !agree(measured, hooke_measurement_number(wrong, "rows", 0, "predicted"), 1e-3);
    assert_true(isnan(hooke_measurement_number(wrong, "rows", 0, "measured")));
  }
  assert_int_equal(noticed, 5);
}

/* ---- ropes, cloths and lattices ---- */

struct piece {
  const char *name;
  int64_t size[3]; /* particles along x, y, z, 0.1 m apart */
  int64_t reach;   /* springs join particles whose steps along the axes add up to that at most, diagonally */
  int64_t light, stiff; /* number of the odd particle, and of the odd spring */
};

static const struct piece pieces[] = {
    {"rope", {13, 1, 1}, 1, 6, 4},
    {"cloth", {5, 4, 1}, 2, 7, 20},
    {"lattice", {3, 3, 2}, 2, 7, 11},
};

enum odd { UNIFORM, LIGHT_PARTICLE, STIFF_SPRING };

static int64_t join(const struct piece *piece, int64_t n, int64_t *ends) {
  const int64_t *size = piece->size;
  int64_t count = 0;
  for (int64_t i = 0; i < n; i++) {
    for (int64_t j = i + 1; j < n; j++) {
      const int64_t dx = llabs(i % size[0] - j % size[0]),
                    dy = llabs(i / size[0] % size[1] - j / size[0] % size[1]);
      const int64_t dz = llabs(i / size[0] / size[1] - j / size[0] / size[1]);
      if (dx > 1 || dy > 1 || dz > 1 || dx + dy + dz > piece->reach) continue;
      ends[2 * count] = i;
      ends[2 * count++ + 1] = j;
    }
  }
  assert_true(count <= MOST_SPRINGS);
  return count;
}

/* Springs of 100 N/m with damping `beta` in proportion to stiffness, particles of 0.1 kg, the first one
 * pinned. */
static hooke_system *build_piece(const struct piece *piece, enum odd odd, double beta) {
  const int64_t *size = piece->size, n = size[0] * size[1] * size[2], pinned = 0;
  double position[3 * MOST_PARTICLES], mass[MOST_PARTICLES], stiffness[MOST_SPRINGS], damping[MOST_SPRINGS];
  int64_t ends[2 * MOST_SPRINGS];
  for (int64_t p = 0; p < n; p++) {
    position[3 * p] = 0.1 * (double)(p % size[0]);
    position[3 * p + 1] = 0.1 * (double)(p / size[0] % size[1]);
    position[3 * p + 2] = 0.1 * (double)(p / size[0] / size[1]);
    mass[p] = odd == LIGHT_PARTICLE && p == piece->light ? 0.1 / 50.0 : 0.1;
  }
  const int64_t count = join(piece, n, ends);
  for (int64_t k = 0; k < count; k++) {
    stiffness[k] = odd == STIFF_SPRING && k == piece->stiff ? 5000.0 : 100.0;
    damping[k] = beta * stiffness[k];
  }
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, n, position, NULL, n, mass, NULL));
  check_ok(hooke_system_pin(system, 1, &pinned));
  owned_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", count, stiffness));
  check_ok(hooke_options_set_numbers(options, "damping", count, damping));
  check_ok(hooke_system_add_springs(system, piece->name, count, ends, options));
  check_ok(hooke_system_commit(system));
  return system;
}

static void check_blame(const hooke_measurement *limit, const struct piece *piece, enum odd odd) {
  double sum = 0.0;
  const int64_t count = hooke_measurement_row_count(limit, "blame");
  assert_true(count > 0);
  /* damping is named rather than its springs, if most of the limit is damping */
  const int64_t first = hooke_measurement_text(limit, "blame", 0, "force") != NULL;
  if (first) assert_string_equal(hooke_measurement_text(limit, "blame", 0, "force"), "damping");
  if (first) check_between(hooke_measurement_number(limit, "blame", 0, "share"), 0.5, 1.0);
  for (int64_t k = first; k < count; k++) {
    const double share = hooke_measurement_number(limit, "blame", k, "share");
    check_between(share, 0.0, k > first ? hooke_measurement_number(limit, "blame", k - 1, "share") : 1.0);
    sum += share;
    assert_string_equal(hooke_measurement_text(limit, "blame", k, "group"), piece->name);
  }
  check_close(sum, 1.0, 1e-9); /* without drag, and with fewer than 100 springs that move */
  const char *kind = hooke_measurement_text(limit, "changes", 0, "kind");
  if (odd == STIFF_SPRING) {
    assert_true((int64_t)hooke_measurement_number(limit, "blame", first, "number") == piece->stiff);
    check_between(hooke_measurement_number(limit, "blame", first, "share"), 0.9, 1.0);
    assert_string_equal(kind, "soften");
    check_between(hooke_measurement_number(limit, "changes", 0, "springs"), 1.0, 1.0);
    check_between(hooke_measurement_number(limit, "changes", 0, "gain"), 1.5, 60.0);
  } else if (odd == LIGHT_PARTICLE) {
    assert_true((int64_t)hooke_measurement_number(limit, "participation", 0, "particle") == piece->light);
    check_close(hooke_measurement_number(limit, "participation", 0, "mass"), 0.1 / 50.0, 1e-15);
    check_between(hooke_measurement_number(limit, "participation", 0, "share"), 0.9, 1.0);
    assert_string_equal(kind, "heavier");
    check_between(hooke_measurement_number(limit, "changes", 0, "particles"), 1.0, 1.0);
    check_between(hooke_measurement_number(limit, "changes", 0, "gain"), 1.5, 60.0);
  }
}

static const double ACCURACY = 5e-3;

static void check_row(const hooke_measurement *limit, int64_t row, const char *scene) {
  const char *method = hooke_measurement_text(limit, "rows", row, "method");
  const double predicted = hooke_measurement_number(limit, "rows", row, "predicted");
  const double measured = hooke_measurement_number(limit, "rows", row, "measured");
  const double bound = hooke_measurement_number(limit, "rows", row, "bound");
  const int sharp = strcmp(method, "symplectic-euler") == 0 || strcmp(method, "verlet") == 0;
  int fine;
  if (isinf(predicted))
    fine = isinf(measured) && isinf(bound);
  else if (predicted == 0.0)
    fine = measured == 0.0 && bound == 0.0 &&
           hooke_measurement_number(limit, "rows", row, "never_stable") == 1.0;
  else
    fine = measured >= 0.98 * predicted && measured <= 1.02 * predicted &&
           bound <= measured * (1.0 + ACCURACY) && bound >= (sharp ? 0.5 : 0.2) * measured;
  if (fine) return;
  check_failed("%s, %s: measured %.8g, predicted %.8g, ratio %.5f, bound %.8g, %g steps (%s)", scene, method,
               measured, predicted, measured / predicted, bound,
               hooke_measurement_number(limit, "rows", row, "steps_run"),
               hooke_measurement_text(limit, "rows", row, "note"));
}

static void check_pieces(const struct piece *piece) {
  static const char *const names[] = {"uniform", "light particle", "stiff spring"};
  static const double ratios[] = {0.0, 0.1, 0.5, 1.0, 2.0, 5.0};
  for (int odd = UNIFORM; odd <= STIFF_SPRING; odd++) {
    double omega = 1.0;
    for (int z = 0; z < 6; z++) {
      if (z > 0 && left_out(odd + z, 3)) continue;
      char scene[100];
      snprintf(scene, sizeof scene, "%s, %s, damping ratio %g", piece->name, names[odd], ratios[z]);
      owned_system *system = build_piece(piece, (enum odd)odd, 2.0 * ratios[z] / omega);
      owned_measurement *limit = find_limit(system, NULL, ACCURACY, 0, NULL);
      if (z == 0) omega = hooke_measurement_number(limit, "limit", 0, "frequency_max");
      check_close(hooke_measurement_number(limit, "limit", 0, "frequency_max"), omega, 1e-6 * omega);
      assert_true(hooke_measurement_row_count(limit, "rows") >= 5);
      for (int64_t row = 0; row < hooke_measurement_row_count(limit, "rows"); row++)
        check_row(limit, row, scene);
      check_blame(limit, piece, (enum odd)odd);
    }
  }
}

TEST(ropes) {
  check_pieces(&pieces[0]);
}

TEST(cloths) {
  check_pieces(&pieces[1]);
}

TEST(lattices) {
  check_pieces(&pieces[2]);
}

/* ---- the scene itself ---- */

/* A spring of no length is linear at any stretch, so the whole run gives the same limit. */
TEST(linear_scene_runs_up_to_the_prediction) {
  owned_system *system = small_oscillator(7.0);
  owned_options *run =
      run_options((struct run){.method = "symplectic-euler", .step = 0.01, .duration = 300.0});
  owned_measurement *limit = find_limit(system, "symplectic-euler,verlet", 1e-2, 0, run);
  for (int64_t row = 0; row < 2; row++) {
    check_close(hooke_measurement_number(limit, "rows", row, "predicted"), 2.0 / 7.0, 1e-6);
    check_close(hooke_measurement_number(limit, "rows", row, "ratio"), 1.0, 1e-2);
  }
}

/* A spring that only pulls counts as taut in the linear twin; where it never becomes taut, the scene itself
 * is stable at any step. */
TEST(slack_scene_takes_any_step) {
  const double position[6] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, down[3] = {0.0, -1.0, 0.0};
  const int64_t ends[2] = {0, 1};
  for (int slack = 0; slack <= 1; slack++) {
    owned_system *system = small_system(2, position, NULL, 1.0, 1);
    small_springs(system, 1, ends, (struct springs){"length", 100.0, 0.0, slack ? 1e6 : 1.0, 1});
    check_ok(hooke_system_set_gravity(system, down));
    check_ok(hooke_system_commit(system));
    owned_options *run = run_options((struct run){.method = "verlet", .step = 0.01, .duration = 60.0});
    owned_measurement *limit = find_limit(system, "verlet", 1e-2, 0, run);
    const double measured = hooke_measurement_number(limit, "rows", 0, "measured");
    check_close(hooke_measurement_number(limit, "rows", 0, "predicted"), 0.2, 1e-6);
    if (slack)
      assert_true(isinf(measured));
    else
      check_between(measured, 0.1, 1.0);
  }
}

/* Just above its limit 2 zeta/omega, forward Euler multiplies the amplitude by 1 + 2 zeta^2 e in a step that
 * is a fraction e too large. Where a run cannot show that, nothing is run, or less accurately. */
TEST(growth_that_a_run_cannot_show) {
  static const struct { double zeta, apart; } table[] = {{0.1, 1e-3}, {0.02, 0.05}, {1e-3, NAN}};
  const double position[6] = {0.0, 0.0, 0.0, 1.0, 0.0, 0.0}, omega = 7.0;
  const int64_t ends[2] = {0, 1};
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++) {
    owned_system *system = small_system(2, position, NULL, 1.0, 1);
    small_springs(system, 1, ends,
                  (struct springs){"length", omega * omega, 2.0 * table[k].zeta * omega, 1.0, 0});
    check_ok(hooke_system_commit(system));
    owned_measurement *limit = find_limit(system, "forward-euler", 1e-3, 0, NULL);
    const double measured = hooke_measurement_number(limit, "rows", 0, "measured");
    const char *note = hooke_measurement_text(limit, "rows", 0, "note");
    check_close(hooke_measurement_number(limit, "rows", 0, "predicted"), 2.0 * table[k].zeta / omega, 1e-9);
    assert_int_equal(strstr(note, "too slow for a run to show it") != NULL, k > 0);
    if (k < 2) check_close(measured, 2.0 * table[k].zeta / omega, table[k].apart);
    if (k == 2)
      assert_true(isnan(measured) && hooke_measurement_number(limit, "rows", 0, "steps_run") == 0.0);
  }
}

/* A flat cloth whose shear alone is damped, with more particles than all eigenvalues are found of: by all of
 * them (NumPy's, of the dense matrix) heun is stable up to 6.56e-5 s. Growth above that is too slow for runs,
 * which see some from 1.9e-4 s on. */
TEST(unknown_modes_may_grow_unseen) {
  owned_system *cloth = small_part(new_system(), "cloth", NULL,
                                   "edges=1,0,0,0,0,1 size=14,14 mass=1 pinned=top-corners "
                                   "structural.stiffness=50 shear.stiffness=20 shear.damping=0.01");
  check_ok(hooke_system_commit(cloth));
  owned_measurement *limit = find_limit(cloth, "heun", 1e-3, 0, NULL);
  assert_true(hooke_measurement_number(limit, "rows", 0, "predicted") > 6.56e-5);
  assert_true(isnan(hooke_measurement_number(limit, "rows", 0, "measured")));
  assert_non_null(strstr(hooke_measurement_text(limit, "rows", 0, "note"), "too slow for a run to show it"));
}

static int32_t stop_at_once(double done, const char *what, void *ctx) {
  (void)what;
  check_between(done, 0.0, 1.0);
  return ++*(int *)ctx == 3;
}

TEST(progress_can_stop) {
  owned_system *system = random_network(5, 1.0);
  hooke_measurement *limit = find_limit(system, "rk4", 1e-3, 1, NULL);
  hooke_measurement_destroy(limit);
  check_ok(hooke_measurement_create("limit", system, NULL, NULL, &limit));
  int calls = 0;
  hooke_measurement_on_progress(limit, stop_at_once, &calls);
  owned_state *state = start_state(system);
  check_status(hooke_measurement_run(limit, state), HOOKE_STOPPED);
  assert_int_equal(calls, 3);
  hooke_measurement_destroy(limit);
}
