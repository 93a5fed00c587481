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

SCENARIO(trajectory) {
  const struct course *course = with;
  char path[PATH_SIZE];
  struct made m = {.system = make_rope(a, course->segments)};
  hooke_trajectory *trajectory = NULL, *closing;
  m.run =
      make_options(a, "run", "method=symplectic-euler step=1e-3 duration=4e-3 every=1e-3"); /* FRAMES - 1 */
  snprintf(path, sizeof path, "%s", path_of(a, "out.h5"));
  if (m.run == NULL) goto end;
  a->planned = FRAMES;
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_trajectory_create(path, m.system, m.integrator, of_files, &trajectory));
  if (course->behind) TRY(a, hooke_trajectory_write_behind(trajectory));
  for (int64_t k = 0; k < course->frames; k++) {
    put(m.state, k);
    TRY_ONCE(a, hooke_trajectory_write(trajectory, k, m.state));
    if (k == 1) TRY_ONCE(a, hooke_trajectory_sync(trajectory));
    if (!course->behind) a->committed = k + 1;
  }
  closing = trajectory;
  trajectory = NULL;
  TRY_ONCE(a, hooke_trajectory_close(closing, course->frames < FRAMES ? HOOKE_STOPPED : HOOKE_OK));
  read_back(a, path, m.system, course->frames);
end:
  hooke_trajectory_close(trajectory, HOOKE_STOPPED);
  release(&m);
}

/* ---- probes ---- */

static int32_t stop_at(int64_t step, const hooke_state *state, void *ctx) {
  (void)state, (void)ctx;
  return step == 3;
}

/* Of a run that is stopped before its end; one that a failed write stops has its reason from closing. */
SCENARIO(probes) {
  char path[PATH_SIZE];
  struct made m = {.system = make_rope(a, 4)};
  hooke_options *options = make_options(a, "probes", "probe=2.y,energy probe_every=1e-3");
  hooke_probes *written = NULL, *closing;
  m.run = make_options(a, "run", "method=symplectic-euler step=1e-3 duration=5e-3 every=1e-3");
  snprintf(path, sizeof path, "%s", path_of(a, with));
  if (m.run == NULL || options == NULL) goto end;
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_probes_create(m.integrator, options, path, &written));
  hooke_integrator_on_frame(m.integrator, stop_at, NULL);
  const int32_t outcome = hooke_integrator_run(m.integrator, m.state);
  closing = written;
  written = NULL;
  TRY_ONCE(a, hooke_probes_close(closing));
  attempt_number(a, outcome == HOOKE_STOPPED ? 1.0 : 0.0);
end:
  hooke_probes_close(written);
  hooke_options_destroy(options);
  release(&m);
}

/* Output made from a trajectory: page and companion. */
SCENARIO(shown) {
  hooke_record *record = NULL;
  struct made m = {0};
  TRY(a, hooke_record_open(path_of(a, "arrays.h5"), &record));
  if (with != NULL) {
    TRY(a, hooke_view_create(record, NULL, &m.measurement));
    attempt_number(a, hooke_measurement_number(m.measurement, "view", 0, "strain"));
    TRY(a, hooke_measurement_write(m.measurement, path_of(a, "out.html")));
  } else {
    TRY(a, hooke_record_write_xdmf(record, path_of(a, "out.xdmf")));
  }
end:
  release(&m);
  hooke_record_close(record);
}

/* ---- comparisons ---- */

SCENARIO(comparison) {
  struct made m = {.system = make_rope(a, 3)};
  m.run = make_options(a, "run", "step=1e-3 duration=0.004 every=0.002");
  m.measurement = make_measurement(a, "study", m.system, m.run, "methods=verlet once=1");
  if (m.measurement == NULL) goto end;
  TRY(a, hooke_measurement_run(m.measurement, NULL));
  TRY(a, hooke_measurement_label(m.measurement, "scene", of_files));
  TRY(a, hooke_measurement_write(m.measurement, path_of(a, "out.h5")));
  attempt_number(a, hooke_measurement_number(m.measurement, "rows", 0, "error"));
end:
  release(&m);
}

/* ---- studies, limits and needs ---- */

/* What is run of a rope, and then written. */
struct written {
  double segments;
  const char *kind, *words, *run; /* `run` NULL: without options of a run, from the initial state */
  const char *label, *text;       /* NULL: none */
  int32_t command;
  const char *file;
};

SCENARIO(measurement) {
  const struct written *w = with;
  struct made m = {.system = make_rope(a, w->segments)};
  if (w->run) m.run = make_options(a, "run", "%s", w->run);
  m.measurement = make_measurement(a, w->kind, m.system, m.run, w->words);
  if (m.measurement == NULL) goto end;
  if (w->run == NULL) TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_measurement_run(m.measurement, m.state));
  if (w->label != NULL) TRY(a, hooke_measurement_label(m.measurement, w->label, w->text));
  if (w->command) TRY(a, hooke_measurement_label(m.measurement, "command", "hooke"));
  TRY(a, hooke_measurement_write(m.measurement, path_of(a, w->file)));
end:
  release(&m);
}

/* ---- scenes ---- */

SCENARIO(scene) {
  struct made m = {.system = make_rope(a, 4)};
  hooke_scene *again = NULL;
  m.run = make_options(a, "run", "method=verlet step=1e-3 duration=0.1 every=0.01");
  if (m.run == NULL) goto end;
  TRY(a, hooke_scene_write(path_of(a, "out.json"), m.system, "a rope", m.run));
  TRY(a, hooke_scene_load(path_of(a, "out.json"), NULL, &again));
  attempt_text(a, hooke_scene_text(again, "text"));
  hooke_scene_destroy(again);
  again = NULL;
  TRY(a, hooke_scene_of_system(m.system, "a rope", m.run, "rope", NULL, &again));
  attempt_text(a, hooke_scene_text(again, "text"));
end:
  hooke_scene_destroy(again);
  release(&m);
}

static const struct course whole = {6, FRAMES, 0}, cut = {6, 3, 0}, behind = {1500, FRAMES, 1};
#define STUDY 1, "study", "methods=symplectic-euler points=6", "duration=0.004 every=0.002"
static const struct written h5 = {STUDY, "scene", of_files, 0, "out.h5"},
                            csv = {STUDY, NULL, NULL, 0, "out.csv"},
                            report = {STUDY, "title", "rope", 1, "out.html"},
                            limits = {3,    "limit",   "predict=1 accuracy=0.1 methods=symplectic-euler,rk4",
                                      NULL, "title",   "rope",
                                      0,    "out.html"},
                            needs = {2,
                                     "needs",
                                     "want=1e-2 refine=0",
                                     "method=symplectic-euler step=1e-3 duration=0.1 every=0.02",
                                     "title",
                                     "rope",
                                     1,
                                     "out.html"};

const struct scenario writing[] = {
    {"write, trajectory", trajectory, &whole, 1, "hdf5", "out.h5"},
    {"write, trajectory cut short", trajectory, &cut, 4, "hdf5", "out.h5"},
    {"write, trajectory by a thread", trajectory, &behind, 12, "hdf5", "out.h5"},
    {"write, probes as CSV", probes, "out.csv", 1, NULL, "out.csv"},
    {"write, probes in HDF5", probes, "out.h5", 2, "hdf5", "out.h5"},
    {"write, comparison", comparison, NULL, 7, "hdf5 sundials", "out.h5"},
    {"write, study in HDF5", measurement, &h5, 200, "hdf5 sundials gsl", "out.h5"},
    {"write, study as CSV", measurement, &csv, 200, "sundials gsl", "out.csv"},
    {"write, study as report", measurement, &report, 200, "sundials gsl chartjs", "out.html"},
    {"write, limits as report", measurement, &limits, 10, "lapack chartjs", "out.html"},
    {"write, needs as report", measurement, &needs, 200, "chartjs", "out.html"},
    {"write, page", shown, "", 25, "hdf5 chartjs threejs", "out.html"},
    {"write, XDMF", shown, NULL, 1, "hdf5", "out.xdmf"},
    {"write, scene", scene, NULL, 1, NULL, "out.json"},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
