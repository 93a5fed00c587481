/* Everything that is written and read back: trajectories, comparisons, studies, tables, reports, pages,
 * scenes. */
#include "scenarios.h"

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 512, FRAMES = 5 };

/* A scene that names a file, replaced by the numbers of the system. */
static const char of_files[] =
    "{ \"hooke\": 1, \"title\": \"a rope\", \"particles\": { \"position\": { \"file\": \"rope.h5\" } } }";

/* ---- trajectories ---- */

struct course {
  double segments;
  int64_t frames; /* number of planned frames to write */
  int32_t behind; /* by a thread */
};

/* States that are not those of a run: only writing matters here. */
static void put(hooke_state *state, int64_t frame) {
  double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  hooke_state_set_time(state, 1e-3 * (double)frame);
  for (int64_t k = 0; k < hooke_state_size(state); k++) {
    q[k] = (double)(frame + 1) + 1e-3 * (double)k;
    v[k] = (double)(frame + 1) - 1e-3 * (double)k;
  }
}

static void trajectory(struct attempt *a, const void *with) {
  const struct course *course = with;
  char path[PATH_SIZE];
  hooke_system *system = make_rope(a, course->segments);
  hooke_options *run = system ? make_run(a, "symplectic-euler", 1e-3, 1e-3 * (FRAMES - 1), 1e-3) : NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  hooke_trajectory *trajectory = NULL;
  snprintf(path, sizeof path, "%s", path_of(a, "out.h5"));
  if (run == NULL) goto end;
  a->planned = FRAMES;
  TRY(a, hooke_integrator_create(system, run, &integrator));
  TRY(a, hooke_state_create(system, &state));
  TRY(a, hooke_trajectory_create(path, system, integrator, of_files, &trajectory));
  if (course->behind) TRY(a, hooke_trajectory_write_behind(trajectory));
  for (int64_t k = 0; k < course->frames; k++) {
    put(state, k);
    TRY_ONCE(a, hooke_trajectory_write(trajectory, k, state));
    if (k == 1) TRY_ONCE(a, hooke_trajectory_sync(trajectory));
    if (!course->behind) a->committed = k + 1;
  }
  {
    hooke_trajectory *closing = trajectory;
    trajectory = NULL;
    TRY_ONCE(a, hooke_trajectory_close(closing, course->frames < FRAMES ? HOOKE_STOPPED : HOOKE_OK));
  }
  read_back(a, path, system, course->frames);
end:
  hooke_trajectory_close(trajectory, HOOKE_STOPPED);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

/* Output made from a trajectory: page and companion. */
static void shown(struct attempt *a, const void *with) {
  hooke_record *record = NULL;
  hooke_measurement *view = NULL;
  const int32_t page = with != NULL;
  TRY(a, hooke_record_open(path_of(a, "arrays.h5"), &record));
  if (page) {
    TRY(a, hooke_view_create(record, NULL, &view));
    attempt_number(a, hooke_measurement_number(view, "view", 0, "strain"));
    TRY(a, hooke_measurement_write(view, path_of(a, "out.html")));
  } else {
    TRY(a, hooke_record_write_xdmf(record, path_of(a, "out.xdmf")));
  }
end:
  hooke_measurement_destroy(view);
  hooke_record_close(record);
}

/* ---- comparisons ---- */

static void comparison(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 3);
  hooke_options *run = system ? make_run(a, NULL, 1e-3, 0.004, 0.002) : NULL;
  hooke_measurement *comparison = make_comparison(a, system, run, "verlet");
  (void)with;
  if (comparison == NULL) goto end;
  TRY(a, hooke_measurement_run(comparison, NULL));
  TRY(a, hooke_measurement_label(comparison, "scene", of_files));
  TRY(a, hooke_measurement_write(comparison, path_of(a, "out.h5")));
  attempt_number(a, hooke_measurement_number(comparison, "rows", 0, "error"));
end:
  hooke_measurement_destroy(comparison);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

/* ---- studies, limits and needs ---- */

enum kind { STUDY_H5, STUDY_CSV, STUDY_REPORT };

static void study(struct attempt *a, const void *with) {
  const enum kind kind = *(const enum kind *)with;
  hooke_system *system = make_rope(a, 1);
  hooke_options *run = system ? make_run(a, NULL, 0.0, 0.004, 0.002) : NULL;
  hooke_measurement *study = make_study(a, system, run, "symplectic-euler");
  if (study == NULL) goto end;
  TRY(a, hooke_measurement_run(study, NULL));
  if (kind == STUDY_H5) {
    TRY(a, hooke_measurement_label(study, "scene", of_files));
    TRY(a, hooke_measurement_write(study, path_of(a, "out.h5")));
  }
  if (kind == STUDY_CSV) TRY(a, hooke_measurement_write(study, path_of(a, "out.csv")));
  if (kind == STUDY_REPORT) {
    TRY(a, hooke_measurement_label(study, "title", "rope"));
    TRY(a, hooke_measurement_label(study, "command", "hooke"));
    TRY(a, hooke_measurement_write(study, path_of(a, "out.html")));
  }
end:
  hooke_measurement_destroy(study);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static void limit_report(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 3);
  hooke_measurement *limit = make_limit(a, system, NULL, "predict");
  hooke_state *state = NULL;
  (void)with;
  if (limit == NULL) goto end;
  TRY(a, hooke_state_create(system, &state));
  TRY(a, hooke_measurement_run(limit, state));
  TRY(a, hooke_measurement_label(limit, "title", "rope"));
  TRY(a, hooke_measurement_write(limit, path_of(a, "out.html")));
end:
  hooke_state_destroy(state);
  hooke_measurement_destroy(limit);
  hooke_system_destroy(system);
}

static void needs_report(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 2);
  hooke_options *run = system ? make_run(a, "symplectic-euler", 1e-3, 0.1, 0.02) : NULL;
  hooke_measurement *needs = make_needs(a, system, run, 0);
  (void)with;
  if (needs == NULL) goto end;
  TRY(a, hooke_measurement_run(needs, NULL));
  TRY(a, hooke_measurement_label(needs, "title", "rope"));
  TRY(a, hooke_measurement_label(needs, "command", "hooke run"));
  TRY(a, hooke_measurement_write(needs, path_of(a, "out.html")));
end:
  hooke_measurement_destroy(needs);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

/* ---- scenes ---- */

static void scene(struct attempt *a, const void *with) {
  hooke_system *system = make_rope(a, 4);
  hooke_options *run = system ? make_run(a, "verlet", 1e-3, 0.1, 0.01) : NULL;
  hooke_scene *again = NULL;
  (void)with;
  if (run == NULL) goto end;
  TRY(a, hooke_scene_write(path_of(a, "out.json"), system, "a rope", run));
  TRY(a, hooke_scene_load(path_of(a, "out.json"), NULL, &again));
  attempt_text(a, hooke_scene_text(again, "text"));
  hooke_scene_destroy(again);
  again = NULL;
  TRY(a, hooke_scene_of_system(system, "a rope", run, "rope", NULL, &again));
  attempt_text(a, hooke_scene_text(again, "text"));
end:
  hooke_scene_destroy(again);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
}

static const struct course whole = {6, FRAMES, 0}, cut = {6, 3, 0}, behind = {1500, FRAMES, 1};
static const enum kind h5 = STUDY_H5, csv = STUDY_CSV, report = STUDY_REPORT;

const struct scenario writing[] = {
    {"write, trajectory", trajectory, &whole, 1, "hdf5", "out.h5"},
    {"write, trajectory cut short", trajectory, &cut, 4, "hdf5", "out.h5"},
    {"write, trajectory by a thread", trajectory, &behind, 12, "hdf5", "out.h5"},
    {"write, comparison", comparison, NULL, 7, "hdf5 sundials", "out.h5"},
    {"write, study in HDF5", study, &h5, 200, "hdf5 sundials gsl", "out.h5"},
    {"write, study as CSV", study, &csv, 200, "sundials gsl", "out.csv"},
    {"write, study as report", study, &report, 200, "sundials gsl chartjs", "out.html"},
    {"write, limits as report", limit_report, NULL, 10, "lapack chartjs", "out.html"},
    {"write, needs as report", needs_report, NULL, 200, "chartjs", "out.html"},
    {"write, page", shown, "", 25, "hdf5 chartjs threejs", "out.html"},
    {"write, XDMF", shown, NULL, 1, "hdf5", "out.xdmf"},
    {"write, scene", scene, NULL, 1, NULL, "out.json"},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
