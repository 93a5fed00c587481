/* Meshes from arrays: springs and masses, welded vertices, and refusals. */
#include "check.h"
#include "hooke.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct mesh {
  int64_t vertices, triangles;
  double vertex[3 * 128];
  int64_t triangle[3 * 256];
};

static void add_triangle(struct mesh *mesh, int64_t a, int64_t b, int64_t c) {
  int64_t *t = mesh->triangle + 3 * mesh->triangles++;
  t[0] = a;
  t[1] = b;
  t[2] = c;
}

/* A rectangle of nu x nv vertices, with two triangles in every cell. */
static struct mesh sheet(int64_t nu, int64_t nv) {
  struct mesh mesh = {.vertices = nu * nv};
  for (int64_t p = 0; p < nu * nv; p++) {
    mesh.vertex[3 * p] = 2.0 * (double)(p % nu) / (double)(nu - 1);
    mesh.vertex[3 * p + 2] = 3.0 * (double)(p / nu) / (double)(nv - 1);
  }
  for (int64_t r = 0; r + 1 < nv; r++) {
    for (int64_t c = 0; c + 1 < nu; c++) {
      add_triangle(&mesh, r * nu + c, r * nu + c + 1, (r + 1) * nu + c + 1);
      add_triangle(&mesh, (r + 1) * nu + c + 1, (r + 1) * nu + c, r * nu + c);
    }
  }
  return mesh;
}

static struct mesh icosahedron(void) {
  static const int64_t face[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                      {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                      {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                      {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
  const double g = 0.5 * (1.0 + sqrt(5.0));
  const double vertex[36] = {-1, g,  0,  1, g, 0,  -1, -g, 0,  1, -g, 0, 0,  -1, g,  0,  1, g,
                             0,  -1, -g, 0, 1, -g, g,  0,  -1, g, 0,  1, -g, 0,  -1, -g, 0, 1};
  struct mesh mesh = {.vertices = 12};
  memcpy(mesh.vertex, vertex, sizeof vertex);
  for (int k = 0; k < 20; k++)
    add_triangle(&mesh, face[k][0], face[k][1], face[k][2]);
  return mesh;
}

/* A torus of m x n vertices. */
static struct mesh torus(int64_t m, int64_t n) {
  struct mesh mesh = {.vertices = m * n};
  for (int64_t p = 0; p < m * n; p++) {
    const double a = 6.283185307179586 * (double)(p % m) / (double)m,
                 b = 6.283185307179586 * (double)(p / m) / (double)n;
    mesh.vertex[3 * p] = (2.0 + cos(b)) * cos(a);
    mesh.vertex[3 * p + 1] = (2.0 + cos(b)) * sin(a);
    mesh.vertex[3 * p + 2] = sin(b);
    const int64_t right = p / m * m + (p % m + 1) % m, up = (p + m) % (m * n), both = (right + m) % (m * n);
    add_triangle(&mesh, p, right, both);
    add_triangle(&mesh, both, up, p);
  }
  return mesh;
}

static hooke_options *options_of(const struct mesh *mesh) {
  hooke_options *options = new_options("mesh");
  check_ok(hooke_mesh_set(options, mesh->vertices, mesh->vertex, mesh->triangles, mesh->triangle));
  set_options(options, "structural.stiffness=30 bend.stiffness=4");
  return options;
}

static hooke_system *build(hooke_options *options) {
  hooke_system *system = new_system();
  check_ok(hooke_system_add_part(system, "mesh", "m", options, NULL, NULL));
  check_ok(hooke_system_commit(system));
  hooke_options_destroy(options);
  return system;
}

static hooke_system *build_with(const struct mesh *mesh, const char *option, double value) {
  hooke_options *options = options_of(mesh);
  check_ok(hooke_options_set_number(options, option, value));
  return build(options);
}

/* ---- springs ---- */

static void check_euler(struct mesh mesh, int64_t characteristic, int64_t border) {
  owned_system *system = build_with(&mesh, "mass", 1);
  const int64_t edges = hooke_system_group_size(system, "springs", 0);
  assert_int_equal(mesh.vertices - edges + mesh.triangles, characteristic);
  assert_int_equal(2 * edges, 3 * mesh.triangles + border);
  assert_int_equal(hooke_system_group_size(system, "springs", 1), edges - border);
}

TEST(edges_obey_euler) {
  check_euler(icosahedron(), 2, 0);
  check_euler(torus(7, 5), 0, 0);
  check_euler(sheet(5, 4), 1, 2 * (4 + 3));
  check_euler(sheet(2, 2), 1, 4);
}

TEST(springs_are_in_order) {
  struct mesh mesh = sheet(5, 4);
  owned_system *system = build_with(&mesh, "mass", 1);
  const int64_t count = hooke_system_count(system, "springs"),
                edges = hooke_system_group_size(system, "springs", 0);
  owned_wholes *ends = new_block(2 * count, sizeof *ends);
  owned_doubles *material = new_doubles(3 * count);
  check_ok(hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, material, material + count, material + 2 * count));
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "m.structural");
  assert_string_equal(hooke_system_group_name(system, "springs", 1), "m.bend");
  int64_t bends = edges;
  for (int64_t k = 0; k < edges; k++) {
    const int64_t *e = ends + 2 * k;
    assert_true(e[0] < e[1]);
    if (k > 0) assert_true(e[0] > e[-2] || (e[0] == e[-2] && e[1] > e[-1]));
    /* the vertices that form a triangle with both ends, in the order of the triangles */
    int64_t across[2] = {-1, -1};
    int faces = 0;
    for (int64_t t = 0; t < mesh.triangles; t++) {
      int64_t third = 0, on = 0;
      for (int c = 0; c < 3; c++) {
        const int64_t v = mesh.triangle[3 * t + c];
        if (v == e[0] || v == e[1])
          on++;
        else
          third = v;
      }
      if (on == 2) across[faces++] = third;
    }
    assert_in_range(faces, 1, 2);
    if (faces == 1) continue;
    assert_int_equal(ends[2 * bends], across[0] < across[1] ? across[0] : across[1]);
    assert_int_equal(ends[2 * bends + 1], across[0] < across[1] ? across[1] : across[0]);
    bends++;
  }
  assert_int_equal(bends, count);
  for (int64_t k = 0; k < count; k++) {
    const double *a = mesh.vertex + 3 * ends[2 * k], *b = mesh.vertex + 3 * ends[2 * k + 1];
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    check_close(material[2 * count + k], sqrt(x * x + y * y + z * z), 1e-15);
    check_close(material[k] * material[2 * count + k], k < edges ? 30.0 : 4.0, 1e-13);
  }
}

/* ---- masses ---- */

static double total_mass(const hooke_system *system) {
  double total = 0.0;
  for (int64_t p = 0; p < hooke_system_particle_count(system); p++)
    total += hooke_system_mass(system)[p];
  return total;
}

TEST(mass_is_shared_by_area) {
  struct mesh mesh = sheet(5, 4);
  hooke_system *system = build_with(&mesh, "mass", 0.6);
  const double *mass = hooke_system_mass(system), cell = 0.6 / 12.0;
  check_close(total_mass(system), 0.6, 1e-15);
  check_close(mass[0], 2 * cell / 6, 1e-16); /* two halves of a cell, a third of each */
  check_close(mass[4], 1 * cell / 6, 1e-16); /* one */
  check_close(mass[6], 6 * cell / 6, 1e-16); /* within: six */
  hooke_system_destroy(system);
  system = build_with(&mesh, "density", 0.1);
  check_close(total_mass(system), 0.1 * 6.0, 1e-15);
  hooke_system_destroy(system);

  mesh = icosahedron();
  system = build_with(&mesh, "density", 3);
  check_close(total_mass(system), 3 * 5 * sqrt(3.0) * 4.0, 1e-12); /* edges of length 2 */
  for (int p = 1; p < 12; p++)
    check_close(hooke_system_mass(system)[p], hooke_system_mass(system)[0], 1e-13);
  hooke_system_destroy(system);
}

/* The ratio refers to the critical damping of the two particles of the spring. */
TEST(damping_by_ratio_is_that_of_both_ends) {
  struct mesh mesh = sheet(5, 4);
  hooke_options *options = options_of(&mesh);
  set_options(options, "mass=0.6 structural.damping_ratio=0.3");
  owned_system *system = build(options);
  const int64_t count = hooke_system_count(system, "springs"),
                edges = hooke_system_group_size(system, "springs", 0);
  owned_wholes *ends = new_block(2 * count, sizeof *ends);
  owned_doubles *kappa = new_doubles(3 * count);
  check_ok(hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, kappa, kappa + count, kappa + 2 * count));
  for (int64_t k = 0; k < edges; k++) {
    const double a = hooke_system_mass(system)[ends[2 * k]], b = hooke_system_mass(system)[ends[2 * k + 1]];
    check_close(kappa[count + k], 2 * 0.3 * sqrt(kappa[k] / (1 / a + 1 / b)), 1e-14);
  }
}

/* ---- vertices ---- */

/* A mesh in which every triangle has its own vertices becomes the mesh with shared ones, in the order of
 * first appearance. */
TEST(vertices_at_one_place_are_one) {
  const struct mesh shared = icosahedron();
  struct mesh loose = {.vertices = 3 * shared.triangles, .triangles = shared.triangles};
  double expected[36];
  int64_t seen[12], kept = 0;
  for (int64_t k = 0; k < 60; k++) {
    const int64_t v = shared.triangle[k];
    memcpy(loose.vertex + 3 * k, shared.vertex + 3 * v, 3 * sizeof(double));
    for (int i = 0; i < 3; i++)
      if (loose.vertex[3 * k + i] == 0.0 && k % 2) loose.vertex[3 * k + i] = -0.0;
    loose.triangle[k] = k;
    int64_t s = 0;
    while (s < kept && seen[s] != v)
      s++;
    if (s == kept) memcpy(expected + 3 * kept, shared.vertex + 3 * v, 3 * sizeof(double));
    if (s == kept) seen[kept++] = v;
  }
  owned_system *system = build_with(&loose, "mass", 1);
  assert_int_equal(hooke_system_particle_count(system), 12);
  assert_int_equal(hooke_system_count(system, "springs"), 60);
  owned_state *state = start_state(system);
  for (int k = 0; k < 36; k++)
    check_close(hooke_state_position(state)[k], expected[k], 0.0);
  int told = 0;
  for (int64_t d = 0; d < hooke_system_count(system, "derived"); d++) {
    if (strcmp(hooke_system_derived_text(system, d, "name"), "vertices welded to others") != 0) continue;
    check_close(hooke_system_derived_value(system, d), 48, 0.0);
    told++;
  }
  assert_int_equal(told, 1);
}

static int64_t particles_with_weld(const struct mesh *mesh, double weld) {
  hooke_options *options = options_of(mesh);
  set_options(options, "mass=1 weld=%.17g", weld);
  owned_system *system = build(options);
  return hooke_system_particle_count(system);
}

TEST(a_distance_welds_what_is_within_it) {
  struct mesh loose = {.vertices = 0};
  const struct mesh shared = sheet(5, 4);
  for (int64_t k = 0; k < 3 * shared.triangles; k++) {
    for (int i = 0; i < 3; i++)
      loose.vertex[3 * k + i] =
          shared.vertex[3 * shared.triangle[k] + i] + 1e-4 * sin(0.7 * (double)(3 * k + i));
  }
  loose.vertices = 3 * shared.triangles;
  for (int64_t t = 0; t < shared.triangles; t++)
    add_triangle(&loose, 3 * t, 3 * t + 1, 3 * t + 2);
  assert_int_equal(particles_with_weld(&loose, 0.0), 72);
  assert_int_equal(particles_with_weld(&loose, 1e-6), 72);
  assert_int_equal(particles_with_weld(&loose, 4e-4), 20);
  assert_int_equal(particles_with_weld(&loose, 0.2), 20);
}

TEST(the_transform_scales_then_moves) {
  struct mesh mesh = icosahedron();
  hooke_options *options = options_of(&mesh);
  set_options(options, "mass=1 transform.scale=0.25 transform.translate=1,2,3");
  owned_system *system = build(options);
  owned_state *state = start_state(system);
  for (int k = 0; k < 36; k++)
    check_close(hooke_state_position(state)[k], 0.25 * mesh.vertex[k] + 1 + k % 3, 0.0);
}

/* ---- refusals ---- */

static void check_refused(struct mesh mesh, const char *message) {
  owned_options *options = options_of(&mesh);
  check_ok(hooke_options_set_number(options, "mass", 1));
  owned_system *system = new_system();
  check_status(hooke_system_add_part(system, "mesh", NULL, options, NULL, NULL), HOOKE_BAD_VALUE);
  check_message(message);
  assert_int_equal(hooke_system_particle_count(system), 0);
}

TEST(planted_faults_are_found) {
  struct mesh mesh = sheet(5, 4);
  mesh.triangle[17] = 20;
  check_refused(mesh, "triangles[5][2]: there is no vertex 20; allowed: 0 to 19, as numbers begin at 0");
  mesh = sheet(5, 4);
  mesh.triangle[17] = mesh.triangle[15];
  check_refused(mesh, "triangles[5]: vertex ");
  mesh = sheet(5, 4);
  memcpy(mesh.vertex + 3 * 7, mesh.vertex + 3 * 8, 3 * sizeof(double));
  check_refused(mesh, "triangles[5]: its corners 8 and 7 become one particle");
  mesh = sheet(5, 4);
  add_triangle(&mesh, 0, 1, 2);
  check_refused(mesh, "triangles[24]: the triangle of vertices 0, 1 and 2 has no area");
  mesh = sheet(5, 4);
  mesh.vertices++;
  mesh.vertex[3 * 20] = 9;
  check_refused(mesh, "vertices[20]: vertex 20 is in no face");
  mesh = sheet(5, 4);
  add_triangle(&mesh, 0, 6, 4);
  check_refused(
      mesh,
      "triangles[24]: the edge of vertices 0 and 6 has a third face here, after those of triangle 0 and "
      "triangle 1");
  mesh = sheet(2, 2);
  memcpy(mesh.triangle + 3, mesh.triangle, 3 * sizeof(int64_t));
  mesh.triangle[5] = mesh.triangle[0];
  mesh.triangle[3] = mesh.triangle[2];
  mesh.vertices = 4;
  check_refused(mesh, "vertices[2]: vertex 2 is in no face");
  add_triangle(&mesh, 0, 2, 3);
  check_refused(mesh, "triangles[1]: a second face on vertices 0, 1 and 3, after that of triangle 0");
}

TEST(a_mesh_needs_its_numbers) {
  owned_options *options, *rope;
  const struct mesh mesh = icosahedron();
  rope = new_options("rope");
  check_status(hooke_mesh_set(rope, 12, mesh.vertex, 20, mesh.triangle), HOOKE_BAD_VALUE);
  check_message("make them with hooke_options_create(\"mesh\", ...)");
  check_status(hooke_mesh_read("none.obj", rope), HOOKE_BAD_VALUE);
  check_message("make them with hooke_options_create(\"mesh\", ...)");
  options = new_options("mesh");
  check_status(hooke_mesh_set(options, 12, NULL, 20, mesh.triangle), HOOKE_BAD_VALUE);
  check_status(hooke_mesh_set(options, 12, mesh.vertex, -1, mesh.triangle), HOOKE_BAD_VALUE);
  check_status(hooke_mesh_set(options, 0, mesh.vertex, 20, mesh.triangle), HOOKE_BAD_VALUE);
  check_ok(hooke_options_set_text(options, "file", "ball.obj"));
  owned_system *system = new_system();
  check_status(hooke_system_add_part(system, "mesh", NULL, options, NULL, NULL), HOOKE_BAD_VALUE);
  check_message("hooke_mesh_read()");
}
