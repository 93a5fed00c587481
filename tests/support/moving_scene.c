#include "moving_scene.h"

#include "check.h"
#include "random_scene.h"
#include "small.h"

#include <math.h>
#include <string.h>

#define CLOTH "edges=0.9,0,0,0,0,0.9 mass=2 pinned=0,1 structural.stiffness=20 "

const struct moving_scene moving_scenes[] = {
    {"cloth", "cloth", "size=6,6 " CLOTH "shear.stiffness=30 bend.stiffness=10", 1e-3, 1, 0, 0, 0},
    {"damped cloth", "cloth",
     "size=5,4 " CLOTH "structural.damping=0.02 shear.stiffness=30 shear.damping=0.02", 1e-3, 1, 1, 0, 0},
    {"driven rope", "rope", "from=0,0,0 to=1,0,0 segments=9 mass=1 pinned=start stretch.stiffness=80", 2e-3,
     1, 0, 1, 0},
    {"driven rope with damping", "rope",
     "from=0,0,0 to=1,0,0 segments=7 mass=1 stretch.stiffness=80 stretch.damping=0.05", 1e-3, 1, 0, 2, 0},
    {"bending rope", "rope",
     "from=0,0,0 to=1,0.2,0 segments=8 mass=1 pinned=start stretch.stiffness=80 bending=0.4", 1e-3, 1, 1, 3,
     0},
    {"strand", "strand",
     "from=0,0,0 to=0,-0.2,0 segments=12 curl=0.02 turns=2 mass=0.02 pinned=0,1,2 stretch.stiffness=20 "
     "stretch.damping=1e-3 altitude.stiffness=1 altitude.damping=1e-4",
     2e-4, 1, 1, 0, 0},
    {"mesh", "mesh", "mass=0.1 pinned=0 structural.stiffness=20 bend.stiffness=2", 1e-3, 1, 0, 0, 0},
    {"rope and another force", "rope",
     "from=0,0,0 to=1,0,0 segments=5 mass=1 pinned=start stretch.stiffness=80", 1e-3, 1, 0, 0, 1},
    {"large cloth", "cloth", "size=64,64 " CLOTH "shear.stiffness=30 bend.stiffness=10", 2e-4, 1, 0, 0, 0},
};

static int32_t wave(int64_t count, double t, double *q, double *v, void *ctx) {
  (void)ctx;
  for (int64_t k = 0; k < 3 * count; k++) {
    q[k] = k == 0 ? 1.0 + t * t : k == 1 ? 0.2 - 0.5 * t : 0.1 * t;
    v[k] = k == 0 ? 2.0 * t : k == 1 ? -0.5 : 0.1;
  }
  return 0;
}

static void drive(const struct moving_scene *scene, hooke_system *system) {
  const int64_t last = hooke_system_particle_count(system) - 1;
  const double amplitude[] = {0.0, 0.1, 0.05}, time[] = {0.0, 0.011, 0.03, 0.2};
  const double displacement[] = {0, 0, 0, 0.01, 0.02, -0.01, 0.015, -0.01, 0.0, 0.03, 0.01, 0.02};
  if (scene->driven == 1) check_ok(hooke_system_drive_harmonic(system, 1, &last, amplitude, 7.0, 0.3));
  if (scene->driven == 2) check_ok(hooke_system_drive_table(system, 1, &last, 4, time, displacement));
  if (scene->driven == 3) check_ok(hooke_system_drive_callback(system, 1, &last, wave, NULL));
}

static void set_mesh(hooke_options *options) {
  const double a = 0.5, b = 0.3;
  const double vertex[] = {0, a, 0, -b, 0, -b, b, 0, -b, b, 0, b, -b, 0, b, 0, -a, 0};
  const int64_t triangle[] = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1, 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 4};
  check_ok(hooke_mesh_set(options, 6, vertex, 8, triangle));
}

hooke_system *moving_system(const struct moving_scene *scene) {
  const double gravity[] = {0.1, -9.81, 0.3};
  hooke_system *system = new_system();
  owned_options *options = options_with(scene->kind, "%s", scene->options);
  if (strcmp(scene->kind, "mesh") == 0) set_mesh(options);
  check_ok(hooke_system_add_part(system, scene->kind, NULL, options, NULL, NULL));
  if (scene->gravity) check_ok(hooke_system_set_gravity(system, gravity));
  if (scene->drag) check_ok(hooke_system_set_drag(system, 1e-3));
  if (scene->callback)
    check_ok(hooke_system_set_force(system, random_scene_force, random_scene_force_product, NULL));
  drive(scene, system);
  return committed(system);
}
