/* Scenes of every kind, from files and from text. */
#include "scenarios.h"
#include "small.h"

#include "check.h"
#include "file_copy.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 512 };

struct scene {
  const char *file, *text;
};

/* Data sets are those of a trajectory that the first one is run into; midway.h5 is that file before the last
 * frame. */
static const struct scene scenes[] = {
    {"parts.json",
     "{\"hooke\": 1, \"title\": \"parts\", \"gravity\": [0, -9.81, 0], \"drag\": 0.01,\n"
     "\"parts\": [{\"kind\": \"rope\", \"name\": \"line\", \"from\": [0, 0, 0], \"to\": [1, 0, 0], "
     "\"segments\": 4, \"mass\": 0.1,\n"
     "  \"pinned\": [\"start\"], \"stretch\": {\"stiffness\": 20, \"damping\": 0.01}, \"bend\": "
     "{\"stiffness\": 1}},\n"
     " {\"kind\": \"cloth\", \"origin\": [0, 1, 0], \"edges\": [[1, 0, 0], [0, 0, 1]], \"size\": [3, 3], "
     "\"density\": 0.2,\n"
     "  \"pinned\": [\"top-corners\"], \"structural\": {\"stiffness\": 20}, \"shear\": {\"stiffness\": "
     "5}}],\n"
     "\"springs\": [{\"name\": \"link\", \"between\": [[[\"line\", 4], 5]], \"stiffness\": 3, "
     "\"rest_length\": \"initial\"}],\n"
     "\"run\": {\"method\": \"symplectic-euler\", \"step\": 1e-3, \"duration\": 0.004, \"every\": 1e-3}}\n"},
    {"springs.json",
     "{\"hooke\": 1, \"drag\": [1, 2, 3, 4, 5, 6],\n"
     "\"wind\": {\"time\": [0, 1], \"velocity\": [[0, 0, 0], [1, 0, 0]]}, \"particles\": {\"position\": "
     "[[0,0,0],[1,0,0.1],[2,0.2,0],[2,1.1,0.3],[0.7,1.2,0],[3,2,0.2]],\n"
     " \"velocity\": [[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0],[0,0,0]], \"mass\": "
     "[1,2,3,4,5,6], \"pinned\": [5]},\n"
     "\"springs\": [{\"name\": \"edges\", \"between\": "
     "[[0,1],[0,4],[1,2],[1,4],[2,3],[3,4],[3,5]], \"law\": \"strain\",\n"
     "  \"stiffness\": [100,90,80,70,60,50,40], \"damping\": 0.5, \"rest_length\": "
     "\"initial\", \"rest_scale\": {\"motion\": \"table\", \"time\": [0, 1], \"value\": [0.9, 1]}},\n"
     " {\"between\": [[0,2]], \"law\": \"length\", \"stiffness\": 5, \"rest_length\": [0.5], "
     "\"compression\": false}],\n"
     "\"driven\": [{\"particles\": [0], \"motion\": \"harmonic\", \"amplitude\": [0.1, 0, "
     "0], \"frequency\": 2},\n"
     " {\"particles\": [1], \"motion\": \"table\", \"time\": [0, 1], \"position\": [[0, 0, "
     "0], [0, 0.1, 0]]}],\n"
     "\"obstacles\": [{\"shape\": \"sphere\", \"center\": [2, 0, 0], \"radius\": 0.5, \"stiffness\": 9, "
     "\"particles\": [2, 3],\n"
     "  \"motion\": \"table\", \"time\": [0, 1], \"position\": [[0, 0, 0], [0, 0.1, 0]]}],\n"
     "\"run\": {\"method\": \"verlet\", \"step\": 1e-3, \"duration\": 1}}\n"},
    {"stiff.json",
     "{\"hooke\": 1, \"particles\": {\"position\": [[0,0,0],[1.1,0,0]], \"mass\": 1, \"pinned\": [0]},\n"
     "\"springs\": [{\"between\": [[0,1]], \"law\": \"length\", \"stiffness\": 1000, \"rest_length\": 1}],\n"
     "\"run\": {\"method\": \"symplectic-euler\", \"step\": 0.1, \"duration\": 100, \"every\": 1}}\n"},
    {"wrong.json", "{\"hooke\": 1, \"particles\": {\"position\": [[0,0,0],[1,0,0]], \"mass\": [1, -2]}}\n"},
    {"mesh.json", "{\"hooke\": 1, \"parts\": [{\"kind\": \"mesh\", \"file\": \"sheet.obj\", \"mass\": 0.05, "
                  "\"transform\": {\"scale\": 0.5,\n"
                  "  \"translate\": [0, 1, 0]}, \"pinned\": [0], \"structural\": {\"stiffness\": 20}, "
                  "\"bend\": {\"stiffness\": 5}}]}\n"},
    {"arrays.json", "{\"hooke\": 1, \"particles\": {\"mass\": {\"file\": \"arrays.h5\", \"dataset\": "
                    "\"/particles/all/mass\"},\n"
                    "  \"position\": {\"file\": \"arrays.h5\", \"dataset\": "
                    "\"/particles/all/position/value\", \"frame\": -1},\n"
                    "  \"velocity\": {\"file\": \"arrays.h5\", \"dataset\": "
                    "\"/particles/all/velocity/value\", \"frame\": 1}},\n"
                    "\"springs\": [{\"between\": {\"file\": \"arrays.h5\", \"dataset\": "
                    "\"/connectivity/springs\"}, \"stiffness\": 3}]}\n"},
    {"midway.json", "{\"hooke\": 1, \"particles\": {\"mass\": 1, \"position\": {\"file\": \"midway.h5\", "
                    "\"dataset\": \"/particles/all/position/value\", \"frame\": -1}}}\n"},
};

static const char obj[] =
    "# a sheet\nv 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nv 2 0 0\nv 2 0 1\nvt 0 0\nvn 0 1 0\n"
    "f 1/1/1 2/1/1 3/1/1 4/1/1\nf 2//1 5//1 6//1 3//1\n";

/* ---- files ---- */

static const char *name_file(const char *folder, const char *name) {
  static _Thread_local char path[PATH_SIZE];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  return path;
}

static void write_text(const char *folder, const char *name, const char *text) {
  FILE *file = fopen(name_file(folder, name), "w");
  assert_non_null(file);
  fputs(text, file);
  assert_int_equal(fclose(file), 0);
}

struct arrays {
  hooke_trajectory *trajectory;
  char path[PATH_SIZE], midway[PATH_SIZE];
};

static int32_t write_frame(int64_t step, const hooke_state *state, void *ctx) {
  const struct arrays *arrays = ctx;
  if (step == 4) copy_file(arrays->path, arrays->midway);
  return hooke_trajectory_write(arrays->trajectory, step, state);
}

static void write_arrays(const char *folder) {
  struct arrays arrays;
  hooke_scene *scene;
  hooke_integrator *integrator;
  hooke_state *state;
  check_ok(hooke_scene_load(name_file(folder, "parts.json"), NULL, &scene));
  check_ok(hooke_scene_commit(scene));
  check_ok(hooke_integrator_create(hooke_scene_system(scene), hooke_scene_run_options(scene), &integrator));
  check_ok(hooke_state_create(hooke_scene_system(scene), &state));
  snprintf(arrays.path, PATH_SIZE, "%s/arrays.h5", folder);
  snprintf(arrays.midway, PATH_SIZE, "%s/midway.h5", folder);
  check_ok(hooke_trajectory_create(arrays.path, hooke_scene_system(scene), integrator,
                                   hooke_scene_text(scene, "text"), &arrays.trajectory));
  check_ok(hooke_integrator_on_frame(integrator, write_frame, &arrays));
  check_ok(hooke_integrator_run(integrator, state));
  check_ok(hooke_trajectory_close(arrays.trajectory, HOOKE_OK));
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_scene_destroy(scene);
}

void prepare_scenes(const char *folder) {
  for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++)
    write_text(folder, scenes[k].file, scenes[k].text);
  write_text(folder, "sheet.obj", obj);
  if (hooke_build_fact("hdf5")[0]) write_arrays(folder);
}

/* ---- scenarios ---- */

static void take_scene(struct attempt *a, hooke_scene *scene) {
  hooke_state *state = NULL;
  TRY(a, hooke_scene_commit(scene));
  TRY(a, hooke_state_create(hooke_scene_system(scene), &state));
  take_state(a, state);
  attempt_text(a, hooke_scene_text(scene, "title"));
  attempt_text(a, hooke_options_text(hooke_scene_run_options(scene), "method"));
  attempt_number(a, hooke_system_energy(hooke_scene_system(scene), "total", hooke_state_position(state),
                                        hooke_state_velocity(state)));
end:
  hooke_state_destroy(state);
}

/* `with` is the name of the file. */
SCENARIO(load) {
  hooke_scene *scene = NULL;
  char path[PATH_SIZE];
  snprintf(path, sizeof path, "%s/%s", a->folder, (const char *)with);
  TRY(a, hooke_scene_load(path, NULL, &scene));
  take_scene(a, scene);
end:
  hooke_scene_destroy(scene);
}

SCENARIO(parse) {
  hooke_scene *scene = NULL;
  for (size_t k = 0; k < 2; k++) {
    TRY(a, hooke_scene_parse(scenes[k].text, (int64_t)strlen(scenes[k].text), "text", NULL, NULL, &scene));
    take_scene(a, scene);
    if (a->gave_up) goto end;
    hooke_scene_destroy(scene);
    scene = NULL;
  }
end:
  hooke_scene_destroy(scene);
}

/* Faulty scenes are refused as such, unless memory is missing to detect the fault. */
SCENARIO(refuse) {
  static const char *const wrong[] = {
      "{\"hooke\": 1, \"parts\": [{\"kind\": \"rope\", \"colour\": 3}]}",
      "{\"hooke\": 1, \"particles\": {\"position\": [[0,0,0],[1,0,0]], \"mass\": [1, -2]}}",
      "{\"hooke\": 1, \"particles\": {\"position\": [[0,0,0],[1,0,0]], \"mass\": 1}, \"springs\": "
      "[{\"between\": [[0,7]], "
      "\"stiffness\": 1}]}",
      "{\"hooke\": 1, \"particles\": {\"position\": [[0,0,0],[1,0,0]], }}",
  };
  hooke_scene *scene = NULL;
  for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; k++) {
    TRY_FOR(a, hooke_scene_parse(wrong[k], (int64_t)strlen(wrong[k]), "text", NULL, NULL, &scene),
            HOOKE_BAD_VALUE);
    attempt_text(a, hooke_last_error());
  }
end:
  hooke_scene_destroy(scene);
}

SCENARIO(read_mesh) {
  hooke_options *options = NULL;
  hooke_system *system = NULL;
  char path[PATH_SIZE];
  snprintf(path, sizeof path, "%s/sheet.obj", a->folder);
  TRY(a, hooke_options_create("mesh", &options));
  TRY(a, hooke_mesh_read(path, options));
  TRY(a, try_words(options, "mass=0.5"));
  TRY(a, hooke_system_create(&system));
  TRY(a, hooke_system_add_part(system, "mesh", NULL, options, NULL, NULL));
  TRY(a, hooke_system_commit(system));
  attempt_numbers(a, hooke_system_particle_count(system), hooke_system_mass(system));
end:
  hooke_system_destroy(system);
  hooke_options_destroy(options);
}

const struct scenario loading[] = {
    {"load, parts", load, "parts.json", 1, NULL, NULL},
    {"load, springs and drives", load, "springs.json", 1, NULL, NULL},
    {"load, mesh of a file", load, "mesh.json", 1, NULL, NULL},
    {"load, arrays of a file", load, "arrays.json", 1, "hdf5", NULL},
    {"load, last frame so far", load, "midway.json", 1, "hdf5", NULL},
    {"load, scene of a trajectory", load, "arrays.h5", 1, "hdf5", NULL},
    {"parse", parse, NULL, 1, NULL, NULL},
    {"refuse a wrong scene", refuse, NULL, 1, NULL, NULL},
    {"read a mesh", read_mesh, NULL, 1, NULL, NULL},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
