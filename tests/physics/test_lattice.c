/* Lattices: the number of springs of each family, their forces, and that the part equals its springs added
 * one by one. */
#include "check.h"
#include "hooke.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double EDGES[9] = {1.2, 0, 0, 0, 0.6, 0, 0, 0, 0.9};

static hooke_options *lattice_options(const double *size, const double *edges) {
  hooke_options *options = options_with("lattice", "origin=0.1,-0.2,0.3");
  check_ok(hooke_options_set_numbers(options, "edges", 9, edges));
  check_ok(hooke_options_set_numbers(options, "size", 3, size));
  return options;
}

static void set_springs(hooke_options *options) {
  set_options(options, "structural.stiffness=50 shear.stiffness=20 shear.damping=0.01 bend.stiffness=5");
}

static hooke_system *build(hooke_options *options) {
  hooke_system *system = new_system();
  check_ok(hooke_system_add_part(system, "lattice", "block", options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  hooke_options_destroy(options);
  return system;
}

static hooke_system *full(int nx, int ny, int nz) {
  hooke_options *options = lattice_options((double[]){nx, ny, nz}, EDGES);
  check_ok(hooke_options_set_number(options, "mass", 2));
  set_springs(options);
  return build(options);
}

/* ---- counts and order ---- */

TEST(families_have_the_springs_of_the_formula) {
  for (int64_t nx = 2; nx <= 5; nx++) {
    for (int64_t ny = 2; ny <= 4; ny++) {
      for (int64_t nz = 2; nz <= 4; nz++) {
        owned_system *system = full((int)nx, (int)ny, (int)nz);
        const int64_t n = nx * ny * nz, cells = (nx - 1) * (ny - 1) * (nz - 1);
        const int64_t faces = (nx - 1) * (ny - 1) * nz + (nx - 1) * ny * (nz - 1) + nx * (ny - 1) * (nz - 1);
        const int64_t apart = (nx - 2) * ny * nz + nx * (ny - 2) * nz + nx * ny * (nz - 2);
        assert_int_equal(hooke_system_particle_count(system), n);
        assert_int_equal(hooke_system_group_size(system, "springs", 0), 3 * n - ny * nz - nx * nz - nx * ny);
        assert_int_equal(hooke_system_group_size(system, "springs", 1), 2 * faces + 4 * cells);
        assert_int_equal(hooke_system_count(system, "springs"),
                         hooke_system_group_size(system, "springs", 0) +
                             hooke_system_group_size(system, "springs", 1) + apart);
      }
    }
  }
}

/* Direction by direction, as steps along x, y and z; in each x fastest, then y, then z. */
TEST(springs_are_in_order) {
  enum { NX = 4, NY = 3, NZ = 5 };
  static const int step[16][3] = {{1, 0, 0},   {0, 1, 0}, {0, 0, 1},  {1, 1, 0}, {-1, 1, 0}, {1, 0, 1},
                                  {-1, 0, 1},  {0, 1, 1}, {0, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {1, -1, 1},
                                  {-1, -1, 1}, {2, 0, 0}, {0, 2, 0},  {0, 0, 2}};
  static const int size[3] = {NX, NY, NZ};
  owned_system *system = full(NX, NY, NZ);
  const int64_t count = hooke_system_count(system, "springs");
  int64_t *ends = new_block(2 * count, sizeof *ends), k = 0;
  double *material = new_doubles(3 * count), *rest = material + 2 * count;
  check_ok(hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, material, material + count, rest));
  owned_state *state = start_state(system);
  const double *q = hooke_state_position(state);
  for (int d = 0; d < 16; d++) {
    const int64_t begin = k;
    for (int p = 0; p < NX * NY * NZ; p++) {
      /* p is the corner of the cell where the spring starts: its lower end goes back along negative steps */
      const int at[3] = {p % NX, p / NX % NY, p / NX / NY};
      int low[3], high[3], fits = 1;
      for (int a = 0; a < 3; a++) {
        low[a] = at[a] + (step[d][a] < 0 ? -step[d][a] : 0);
        high[a] = low[a] + step[d][a];
        fits &= low[a] < size[a] && high[a] >= 0 && high[a] < size[a];
      }
      if (!fits) continue;
      assert_in_range(k, 0, count - 1);
      assert_int_equal(ends[2 * k], (low[2] * NY + low[1]) * NX + low[0]);
      assert_int_equal(ends[2 * k + 1], (high[2] * NY + high[1]) * NX + high[0]);
      assert_true(ends[2 * k] < ends[2 * k + 1]);
      check_same_bits(1, &rest[k], &rest[begin]);
      const double *a = q + 3 * ends[2 * k], *b = q + 3 * ends[2 * k + 1];
      const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
      check_close(rest[k], sqrt(x * x + y * y + z * z), 1e-14);
      k++;
    }
  }
  assert_int_equal(k, count);
  check_close(q[3 * (NX * NY * NZ - 1)], 1.3, 1e-15);
  check_close(q[3 * (NX * NY * NZ - 1) + 1], 0.4, 1e-15);
  check_close(q[3 * (NX * NY * NZ - 1) + 2], 1.2, 1e-15);
  free(material);
  free(ends);
}

/* ---- the same to the bit as springs one by one ---- */

static hooke_system *one_by_one(const hooke_system *part) {
  static const double stiffness[] = {50, 20, 5}, damping[] = {0, 0.01, 0};
  const int64_t n = hooke_system_particle_count(part), count = hooke_system_count(part, "springs");
  int64_t *ends = new_block(2 * count, sizeof *ends), first = 0;
  owned_doubles *material = new_doubles(3 * count);
  owned_state *state = start_state(part);
  check_ok(hooke_system_members(part, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(part, "springs", NULL, material, material + count, material + 2 * count));
  hooke_system *system = new_system();
  check_ok(hooke_system_add_particles(system, n, hooke_state_position(state), NULL, n,
                                      hooke_system_mass(part), NULL));
  for (int g = 0; g < 3; g++) {
    const int64_t size = hooke_system_group_size(part, "springs", g);
    owned_options *options =
        options_with("springs", "stiffness=%.17g damping=%.17g", stiffness[g], damping[g]);
    check_ok(hooke_options_set_numbers(options, "rest_length", size, material + 2 * count + first));
    check_ok(hooke_system_add_springs(system, NULL, size, ends + 2 * first, options));
    first += size;
  }
  check_ok(hooke_system_commit(system));
  free(ends);
  return system;
}

TEST(a_part_runs_as_its_springs_do) {
  enum { N = 6 * 5 * 7 };
  owned_system *part = full(6, 5, 7), *plain = one_by_one(part);
  double q[3 * N], v[3 * N], other_q[3 * N], other_v[3 * N];
  const hooke_system *systems[2] = {part, plain};
  double *ends[2][2] = {{q, v}, {other_q, other_v}};
  for (int s = 0; s < 2; s++) {
    owned_state *state = start_state(systems[s]);
    for (int p = 0; p < N; p++)
      hooke_state_velocity(state)[3 * p + p % 3] = sin(1.0 + p);
    owned_integrator *run =
        start_run(systems[s], (struct run){.method = "symplectic-euler", .step = 1e-3, .duration = 0.1});
    check_ok(hooke_integrator_run(run, state));
    memcpy(ends[s][0], hooke_state_position(state), sizeof q);
    memcpy(ends[s][1], hooke_state_velocity(state), sizeof v);
  }
  check_same_bits(3 * N, other_q, q);
  check_same_bits(3 * N, other_v, v);
  check_between(fabs(q[0] - 0.1), 1e-4, 1.0); /* it has moved */
}

/* ---- mechanics ---- */

/* The pull along z of `count` springs of stiffness ks over the rest vector (x, y, z), z stretched. */
static double pull(double count, double ks, double x, double y, double z, double stretch) {
  const double rest = sqrt(x * x + y * y + z * z), along = z * stretch;
  const double length = sqrt(x * x + y * y + along * along);
  return count * ks * (length / rest - 1.0) * along / length;
}

TEST(a_stretched_block_pulls_with_the_sum_of_its_springs) {
  enum { NX = 5, NY = 4, NZ = 6, LAYER = NX * NY };
  owned_system *system = full(NX, NY, NZ);
  const int64_t n = hooke_system_particle_count(system);
  owned_state *state = start_state(system);
  double *q = hooke_state_position(state), *force = new_doubles(3 * n);
  const double stretch = 1.07, x = 1.2 / (NX - 1), y = 0.6 / (NY - 1), z = 0.9 / (NZ - 1);
  for (int64_t p = 0; p < n; p++)
    q[3 * p + 2] = 0.3 + stretch * (q[3 * p + 2] - 0.3);
  check_ok(hooke_system_force(system, 0.0, q, hooke_state_velocity(state), force));
  double top = 0.0, inside = 0.0, aside = 0.0;
  for (int64_t p = 0; p < n; p++) {
    if (p >= n - LAYER) top += force[3 * p + 2];
    if (p >= 2 * LAYER && p < n - 2 * LAYER) inside += fabs(force[3 * p + 2]);
    aside += force[3 * p];
  }
  const double expected =
      pull(NX * NY, 50, 0, 0, z, stretch) + pull(2 * (NX - 1) * NY, 20, x, 0, z, stretch) +
      pull(2 * NX * (NY - 1), 20, 0, y, z, stretch) + pull(4 * (NX - 1) * (NY - 1), 20, x, y, z, stretch) +
      pull(NX * NY, 5, 0, 0, 2 * z, stretch);
  check_close(-top, expected, 1e-11 * expected);
  check_between(expected, 1.0, 1e3);
  check_close(inside, 0.0, 1e-10); /* the upward pull equals the downward one */
  check_close(aside, 0.0, 1e-10);
  free(force);
}

TEST(density_makes_the_mass_of_the_volume) {
  static const double skew[9] = {1, 0.2, 0, 0.3, 2, 0.1, 0.5, 0, 3};
  const double volume = fabs(1 * (2 * 3 - 0.1 * 0) - 0.2 * (0.3 * 3 - 0.1 * 0.5) + 0 * (0.3 * 0 - 2 * 0.5));
  for (int n = 2; n <= 4; n++) {
    hooke_options *options = lattice_options((double[]){n, 3, n + 1}, skew);
    check_ok(hooke_options_set_number(options, "density", 7));
    owned_system *system = build(options);
    const double *mass = hooke_system_mass(system);
    double total = 0.0;
    for (int64_t p = 0; p < hooke_system_particle_count(system); p++)
      total += mass[p];
    check_close(total, 7 * volume, 1e-12);
    const double piece = 7 * volume / ((n - 1) * 2.0 * n);
    check_close(mass[0], piece / 8, 1e-14);
    check_close(mass[n], piece / 4, 1e-14); /* y in the middle, x and z at an end */
    check_same_bits(1, &mass[n * 3 * (n + 1) - 1], &mass[0]);
  }
}

static void check_size_refused(double nx, double ny, double nz, int32_t status, const char *message) {
  owned_options *options = lattice_options((double[]){nx, ny, nz}, EDGES);
  check_ok(hooke_options_set_number(options, "mass", 1));
  set_springs(options);
  owned_system *system = new_system();
  check_status(hooke_system_add_part(system, "lattice", NULL, options, NULL, NULL), status);
  check_message(message);
  assert_int_equal(hooke_system_particle_count(system), 0);
}

TEST(impossible_sizes_are_refused_before_anything_is_allocated) {
  check_size_refused(2147483647, 2147483647, 2147483647, HOOKE_BAD_VALUE,
                     "2147483647 x 2147483647 x 2147483647 needs");
  /* 1e9 particles, but more springs than can be numbered */
  check_size_refused(
      1000, 1000, 1000, HOOKE_BAD_VALUE,
      "size: a lattice of 1000 x 1000 x 1000 needs 1.08 TB of memory for 1000000000 particles, 1.5967018e+10 "
      "springs; allowed: up to 2147483647");
}

static void check_held(const char *pinned, int64_t from, int64_t to) {
  hooke_options *options = lattice_options((double[]){3, 2, 4}, EDGES);
  set_options(options, "mass=1 pinned=%s", pinned);
  owned_system *system = build(options);
  for (int64_t p = 0; p < 24; p++)
    assert_int_equal(hooke_system_inverse_mass(system)[p] == 0.0, p >= from && p < to);
}

TEST(pinned_layers_have_names) {
  check_held("bottom", 0, 6);
  check_held("top", 18, 24);
  check_held("7", 7, 8);
}

/* A driven layer moves the block. */
TEST(a_layer_can_be_driven) {
  enum { LAYER = 9, N = 27 };
  owned_options *options = lattice_options((double[]){3, 3, 3}, EDGES);
  int64_t layer[LAYER];
  double q[3 * N];
  for (int k = 0; k < LAYER; k++)
    layer[k] = N - LAYER + k;
  check_ok(hooke_options_set_number(options, "mass", 1));
  set_springs(options);
  check_ok(hooke_options_set_text(options, "pinned", "bottom"));
  owned_system *system = new_system();
  check_ok(hooke_system_add_part(system, "lattice", NULL, options, NULL, NULL));
  check_ok(hooke_system_drive_harmonic(system, LAYER, layer, (double[]){0.1, 0, 0}, 0.5, 0.0));
  check_ok(hooke_system_commit(system));
  assert_int_equal(hooke_system_count(system, "free"), LAYER);
  end_of_run(q, NULL, system, .method = "symplectic-euler", .step = 1e-3, .duration = 0.5);
  for (int k = 0; k < LAYER; k++) {
    const double x = 0.1 + 0.6 * (k % 3);
    check_close(q[3 * k], x, 0.0);
    check_close(q[3 * (N - LAYER + k)], x + 0.1, 1e-15); /* a quarter of its oscillation */
    check_between(q[3 * (LAYER + k)], x + 0.001, x + 0.15);
  }
}
