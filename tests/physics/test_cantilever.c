/* A beam and a sheet that bend under their own weight give the same deflection at every resolution.
 *
 * Two pinned particles clamp a beam in the middle between them, so a rope of N pieces l = L/(N - 1/2) begins
 * half a piece before the wall. Its tip deflection, for small deflections and masses by density, is
 *   m g l^3/(2 B) sum of s^3, s = 1 .. N - 1,   m = rho l,
 * which converges to w L^4/(8 B), w = rho g, like 1/N^2. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double LENGTH = 1.0, DENSITY = 0.1, GRAVITY = 9.81, SAG = 1e-3;

/* For a strip of 1 m width, or a rope: the deflection is 1e-3 of its length. */
static double stiffness(void) {
  return DENSITY * GRAVITY * pow(LENGTH, 4.0) / (8.0 * SAG * LENGTH);
}

static void pin_first(hooke_system *system, int64_t count) {
  for (int64_t p = 0; p < count; p++)
    check_ok(hooke_system_pin(system, 1, &p));
}

static hooke_system *commit(hooke_system *system) {
  const double down[3] = {0.0, 0.0, -GRAVITY};
  check_ok(hooke_system_set_gravity(system, down));
  return committed(system);
}

static hooke_system *new_rope(int segments, const char *of_mass, double mass, double piece) {
  hooke_system *system = new_system();
  small_part(system, "rope", "beam",
             "from=%.17g,0,0 to=%.17g,0,0 segments=%d %s=%.17g bending=%.17g stretch.stiffness=1e5",
             -0.5 * piece, (segments - 0.5) * piece, segments, of_mass, mass, stiffness());
  pin_first(system, 2);
  return commit(system);
}

/* `along` pieces from the wall, `across` particles over 0.5 m. */
static hooke_system *new_sheet(int along, int across) {
  const double piece = LENGTH / (along - 0.5);
  hooke_system *system = new_system();
  small_part(system, "cloth", "sheet",
             "origin=%.17g,0,0 edges=0,0.5,0,%.17g,0,0 size=%d,%d density=%.17g bending=%.17g "
             "structural.stiffness=1e5",
             -0.5 * piece, along * piece, across, along + 1, DENSITY, stiffness());
  pin_first(system, 2 * across);
  return commit(system);
}

/* ---- equilibrium: Newton on the library's own forces and blocks ---- */

/* -df/dq of the particles from `held` on, as a lower band of `width` numbers a column, the diagonal first. */
static void fill_band(const hooke_system *system, const double *q, const double *v, int64_t held,
                      int64_t width, double *band) {
  const int64_t n = hooke_system_particle_count(system), count = hooke_system_count(system, "blocks");
  owned_wholes *row_start = new_block(n + 1, (int64_t)sizeof(int64_t)),
               *column = new_block(count, (int64_t)sizeof(int64_t));
  owned_doubles *blocks = new_doubles(9 * count);
  check_ok(hooke_system_derivative_pattern(system, row_start, column));
  check_ok(hooke_system_derivative_blocks(system, q, v, blocks, NULL));
  memset(band, 0, (size_t)(3 * (n - held) * width) * sizeof *band);
  for (int64_t p = held; p < n; p++) {
    for (int64_t b = row_start[p]; b < row_start[p + 1]; b++) {
      for (int k = 0; k < 9 && column[b] >= held; k++) {
        const int64_t i = 3 * (p - held) + k / 3, j = 3 * (column[b] - held) + k % 3;
        if (j > i) continue;
        assert_true(i - j < width);
        band[j * width + i - j] = -blocks[9 * b + k];
      }
    }
  }
}

/* x = A^-1 x by Cholesky, in place of the band. */
static void solve(int64_t size, int64_t width, double *band, double *x) {
  gsl_matrix_view matrix = gsl_matrix_view_array(band, (size_t)size, (size_t)width);
  gsl_vector_view vector = gsl_vector_view_array(x, (size_t)size);
  gsl_linalg_cholesky_band_decomp(&matrix.matrix); /* ends the program where there is none */
  gsl_linalg_cholesky_band_svx(&matrix.matrix, &vector.vector);
}

/* Deflection of the last particle; the system is destroyed. `across` particles are in a row, `rows` rows are
 * pinned. */
static double sag_below(hooke_system *system, int64_t across, int64_t rows) {
  const int64_t n = hooke_system_particle_count(system), held = rows * across, width = 3 * (2 * across + 1);
  const int64_t size = 3 * (n - held);
  owned_state *state = start_state(system);
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  double *band = new_doubles(size * width), *force = new_doubles(3 * n), moved = 1.0;
  for (int turn = 0; turn < 20 && moved > 1e-13; turn++) {
    check_ok(hooke_system_force(system, 0.0, q, v, force));
    fill_band(system, q, v, held, width, band);
    solve(size, width, band, force + 3 * held);
    moved = largest(size, force + 3 * held);
    for (int64_t k = 3 * held; k < 3 * n; k++)
      q[k] += force[k];
  }
  check_between(moved, 0.0, 1e-12);
  const double sag = -q[3 * n - 1];
  free(band);
  free(force);
  hooke_system_destroy(system);
  return sag;
}

static double sag_of(hooke_system *system, int64_t across) {
  return sag_below(system, across, 2);
}

/* ---- ropes ---- */

static double tip_of(int segments) {
  return sag_of(new_rope(segments, "density", DENSITY, LENGTH / (segments - 0.5)), 1);
}

TEST(tips_sink_as_beams_do) {
  const int segments[4] = {16, 32, 64, 128};
  double tip[4];
  for (int k = 0; k < 4; k++) {
    const double l = LENGTH / (segments[k] - 0.5), half = 0.5 * segments[k] * (segments[k] - 1.0);
    tip[k] = tip_of(segments[k]);
    print_message("%3d pieces: the tip sinks by %.6f of w L^4/(8 B)\n", segments[k], tip[k] / (SAG * LENGTH));
    check_close(tip[k], DENSITY * l * GRAVITY * l * l * l / (2.0 * stiffness()) * half * half, 1e-4 * tip[k]);
    check_between(tip[k] / (SAG * LENGTH), 0.98, 1.02);
  }
  check_between(tip[3] / tip[0], 0.98, 1.02);
  /* the error scales with the square of a piece */
  check_between((SAG * LENGTH - tip[0]) / (SAG * LENGTH - tip[1]), 3.5, 4.8);
}

/* Clamped at the first particle, and in the direction there: under its own weight or, without gravity, under
 * a force at its tip. Both make beams sink by SAG: w L^4/(8 B), P L^3/(3 B). */
static hooke_system *clamped_rope(int segments, int by_tip) {
  const double pull = 3.0 * stiffness() * SAG / (LENGTH * LENGTH);
  hooke_system *rope = small_part(
      NULL, "rope", "beam",
      "from=0,0,0 to=%.17g,0,0 segments=%d density=%.17g bending=%.17g stretch.stiffness=1e5 clamped=start",
      LENGTH, segments, DENSITY, stiffness());
  if (!by_tip) return commit(rope);
  owned_options *load = options_with("loads", "force=0,0,%.17g", -pull);
  const int64_t tip = segments;
  check_ok(hooke_system_add_loads(rope, 1, &tip, load));
  return committed(rope);
}

/* With an error that scales with the square of a piece. */
TEST(clamped_tips_sink_as_beams_do) {
  for (int by_tip = 0; by_tip <= 1; by_tip++) {
    double off[3];
    for (int k = 0; k < 3; k++)
      off[k] = sag_below(clamped_rope(16 << k, by_tip), 1, 1) / (SAG * LENGTH) - 1.0;
    check_between(off[0], 1e-3, 5e-3);
    check_between(log2(off[0] / off[1]), 1.8, 2.2);
    check_between(log2(off[1] / off[2]), 1.8, 2.2);
  }
}

/* What needs tells of such a beam at rest: the order, and how far it is off, which a formula says as well. */
TEST(needs_refines_clamped_beams_at_order_two) {
  for (int by_tip = 0; by_tip <= 1; by_tip++) {
    owned_system *rope = clamped_rope(8, by_tip);
    owned_options *run = run_options(
                      (struct run){.method = "backward-euler", .step = 0.5, .duration = 5.0, .every = 5.0}),
                  *options = options_with("needs", "want=1e-5 refine=true");
    owned_measurement *needs;
    check_ok(hooke_measurement_create("needs", rope, run, options, &needs));
    check_ok(hooke_measurement_run(needs, NULL));
    const double off = sag_below(clamped_rope(8, by_tip), 1, 1) - SAG * LENGTH;
    check_between(hooke_measurement_number(needs, "parts", 0, "order"), 1.8, 2.2);
    check_close(hooke_measurement_number(needs, "parts", 0, "error"), off, 0.05 * off);
  }
}

/* A strip clamped along any of its sides is such a beam over its width, an edge having half of a line's
 * share. */
TEST(clamped_sheets_sink_as_ropes_do) {
  static const char *const sides[] = {"origin=0,0,0 edges=0,0.5,0,1,0,0 size=4,13 clamped=top",
                                      "origin=0,0,0 edges=1,0,0,0,0.5,0 size=13,4 clamped=left",
                                      "origin=1,0,0 edges=0,0.5,0,-1,0,0 size=4,13 clamped=bottom",
                                      "origin=1,0,0 edges=-1,0,0,0,0.5,0 size=13,4 clamped=right"};
  const double tip = sag_below(clamped_rope(12, 0), 1, 1);
  for (int side = 0; side < 4; side++) {
    owned_system *sheet =
        commit(small_part(NULL, "cloth", "sheet", "%s density=%.17g bending=%.17g structural.stiffness=1e5",
                          sides[side], DENSITY, stiffness()));
    double q[3 * 4 * 13], lowest = 0.0, beyond = 0.0; /* where the sheet is lowest */
    end_of_run(q, NULL, sheet, .method = "backward-euler", .step = 0.5, .duration = 5.0, .every = 5.0);
    for (int p = 0; p < 4 * 13; p++)
      if (q[3 * p + 2] < lowest) lowest = q[3 * p + 2], beyond = q[3 * p];
    check_between(beyond, 0.99, 1.0);
    check_close(-lowest, tip, 1e-6 * tip);
  }
}

/* Equal masses give the tip twice its proper mass; with a wall at the first particle the length is off by
 * half a piece. */
TEST(other_masses_and_walls_are_noticed) {
  const double piece = LENGTH / 15.5, other = LENGTH / 16.0, unit = SAG * LENGTH;
  const double shared = sag_of(new_rope(16, "mass", DENSITY * 16.0 * piece, piece), 1) / unit;
  const double wall = sag_of(new_rope(16, "density", DENSITY, other), 1) / unit;
  const double both = sag_of(new_rope(16, "mass", DENSITY * LENGTH, other), 1) / unit;
  print_message("16 pieces: equal shares %.4f, the wall at the first particle %.4f, both %.4f\n", shared,
                wall, both);
  check_between(shared, 1.015, 1.025);
  check_between(wall, 0.875, 0.885);
  check_between(both, 0.895, 0.905);
}

/* The library's own way to equilibrium: backward Euler, which damps modes that it does not resolve. */
TEST(backward_euler_comes_to_rest_there) {
  const double expected = tip_of(16);
  owned_system *system = new_rope(16, "density", DENSITY, LENGTH / 15.5);
  double q[3 * 17];
  end_of_run(q, NULL, system, .method = "backward-euler", .step = 0.5, .duration = 5.0, .every = 5.0);
  check_close(-q[3 * 17 - 1], expected, 1e-6 * expected);
}

/* ---- sheets ---- */

TEST(sheets_sink_as_beams_do) {
  const int along[3] = {16, 64, 128}, across[3] = {2, 5, 9};
  for (int k = 0; k < 3; k++) {
    double first = 0.0;
    for (int m = 0; m < 3; m++) {
      const double sag = sag_of(new_sheet(along[m], across[k]), across[k]) / (SAG * LENGTH);
      print_message("%3d pieces, %d across: the free edge sinks by %.6f of w L^4/(8 B)\n", along[m],
                    across[k], sag);
      check_between(sag, 0.98, 1.02);
      if (m == 0) first = sag;
      check_between(sag / first, 0.98, 1.02);
    }
  }
}
