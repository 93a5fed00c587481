/* Reading trajectories: for any container, the result is its contents or a message.
 *
 * Lines of: src/io/trajectory/record.c src/io/trajectory/record_h5.c
 *           src/io/hdf5/array_h5.c src/io/hdf5/dataset_h5.c
 *           src/io/trajectory/frame_check_h5.c src/io/trajectory/xdmf.c src/io/trajectory/trajectory_resume.c
 * Longest input: 148 */
#include "container.h"
#include "fuzz.h"

#include "hooke.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

static struct container container;

/* Bits of the second byte of an input, which selects the calls besides opening; of the first, which selects
 * frame and array. */
enum {
  ASK_FRAME = 1,
  ASK_ARRAY = 2,
  ASK_TWICE = 4,
  ASK_SCENE = 8,
  ASK_XDMF = 16,
  ASK_VIEW = 32,
  ASK_HDF5 = 64,
  ASK_RESUME = 128
};

/* A failure has a message. */
static int answered(int32_t status) {
  hooke_fuzz_require(status <= HOOKE_OK, "an outcome of a run");
  if (status != HOOKE_OK) hooke_fuzz_require_lines(HOOKE_FUZZ_FAULTS);
  return status == HOOKE_OK;
}

static void check_not_secret(int64_t count, const double *number) {
  for (int64_t k = 0; k < count; k++)
    hooke_fuzz_require(number[k] != SECRET_NUMBER, "a number of another file");
}

static int same_numbers(int64_t count, const double *a, const double *b) {
  for (int64_t k = 0; k < count; k++) {
    if (memcmp(a + k, b + k, sizeof *a) != 0 && !(isnan(a[k]) && isnan(b[k]))) return 0;
  }
  return 1;
}

/* The numbers as HDF5 itself reads them. A frame of an array of frames: `frame` >= 0. */
static void check_against_hdf5(const char *dataset, int64_t frame, int64_t count, const double *number) {
  int32_t rank;
  int64_t extent[4];
  owned_doubles *whole = container_read(&container, dataset, &rank, extent);
  if (whole == NULL) return;
  if (rank == 3) {
    hooke_fuzz_require(extent[1] * extent[2] == count && frame < extent[0], "the size of a frame");
    hooke_fuzz_require(same_numbers(count, number, whole + (frame >= 0 ? frame : 0) * count) || frame < 0,
                       "the numbers of a frame");
  } else {
    hooke_fuzz_require(rank >= 1 && rank <= 2 && extent[0] * (rank == 2 ? extent[1] : 1) == count,
                       "the size of an array");
    hooke_fuzz_require(same_numbers(count, number, whole), "the numbers of an array");
  }
}

/* ---- calls ---- */

/* For a system of the container's size, and another one. */
static struct {
  hooke_system *system;
  hooke_state *state;
} own[2];

static void make_state(int which) {
  const double mass = 1.0, q[12] = {0};
  hooke_fuzz_require(hooke_system_create(&own[which].system) == HOOKE_OK &&
                         hooke_system_add_particles(own[which].system, 4 - which, q, NULL, 1, &mass, NULL) ==
                             HOOKE_OK &&
                         hooke_system_commit(own[which].system) == HOOKE_OK &&
                         hooke_state_create(own[which].system, &own[which].state) == HOOKE_OK,
                     "a state to read into");
}

/* In a state before a frame is read into it. */
static const double MARK = 0x1.5a5a5a5a5a5a5p-7;

static void mark(hooke_state *state) {
  double *const array[] = {hooke_state_position(state), hooke_state_velocity(state)};
  for (int k = 0; k < 2; k++)
    for (int64_t i = 0; i < hooke_state_size(state); i++)
      array[k][i] = MARK;
  hooke_state_set_time(state, MARK);
}

static void require_marked(hooke_state *state) {
  const double *const array[] = {hooke_state_position(state), hooke_state_velocity(state)};
  int same = hooke_state_time(state) == MARK;
  for (int k = 0; k < 2; k++)
    for (int64_t i = 0; i < hooke_state_size(state); i++)
      same &= array[k][i] == MARK;
  hooke_fuzz_require(same, "a state as it was, after a failure");
}

static void ask_frame(const hooke_record *record, int wanted, int by_hdf5) {
  hooke_state *state = own[(wanted & 96) == 96].state;
  const int64_t frames = hooke_record_count(record, "frames"), frame = wanted % 16 - 8,
                size = hooke_state_size(state);
  mark(state);
  if (!answered(hooke_record_read(record, frame, state))) {
    require_marked(state);
    return;
  }
  const int64_t at = frame < 0 ? frames + frame : frame;
  hooke_fuzz_require(at >= 0 && at < frames, "a frame that is not there");
  hooke_fuzz_require(!isnan(hooke_state_time(state)), "a frame without a time");
  check_not_secret(size, hooke_state_position(state));
  check_not_secret(size, hooke_state_velocity(state));
  if (!by_hdf5) return;
  hooke_fuzz_require(hooke_record_check(record, frame) == HOOKE_OK, "a frame that is read is whole");
  check_against_hdf5("/particles/all/position/value", at, size, hooke_state_position(state));
  check_against_hdf5("/particles/all/velocity/value", at, size, hooke_state_velocity(state));
}

static void ask_array(hooke_record *record, int wanted, int twice, int by_hdf5) {
  static const struct {
    const char *name, *dataset;
  } array[] = {
      {"time", "/particles/all/position/time"},    {"step", "/particles/all/position/step"},
      {"springs", "/connectivity/springs"},        {"mass", "/particles/all/mass"},
      {"species", "/particles/all/species"},       {"kinetic_energy", "/observables/kinetic_energy/value"},
      {"momentum", "/observables/momentum/value"}, {"colour", ""}};
  int64_t rows = -1, columns = -1;
  if (!answered(hooke_record_size(record, array[wanted % 8].name, &rows, &columns))) {
    hooke_fuzz_require(rows == 0 && columns == 0, "a size besides a failure");
    return;
  }
  hooke_fuzz_require(rows >= 0 && columns >= 0 && rows * columns < INT64_C(1) << 27, "a size");
  owned_doubles *number = malloc((size_t)(rows * columns) * sizeof *number + 1);
  for (int k = 0; k <= twice; k++) {
    if (!answered(hooke_record_numbers(record, array[wanted % 8].name, number))) continue;
    check_not_secret(rows * columns, number);
    if (by_hdf5) check_against_hdf5(array[wanted % 8].dataset, -1, rows * columns, number);
  }
}

static int32_t write_frame(int64_t step, const hooke_state *state, void *ctx) {
  return hooke_trajectory_write(ctx, step, state) == HOOKE_OK ? 0 : 1;
}

static void go_on(const hooke_system *system, hooke_integrator *integrator) {
  owned_state *state = NULL;
  hooke_trajectory *trajectory = NULL;
  if (!answered(hooke_state_create(system, &state))) return;
  if (answered(hooke_trajectory_resume(container.path, system, integrator, state, &trajectory)) &&
      trajectory) {
    check_not_secret(hooke_state_size(state), hooke_state_position(state));
    check_not_secret(hooke_state_size(state), hooke_state_velocity(state));
    hooke_integrator_on_frame(integrator, write_frame, trajectory);
    const int32_t outcome = hooke_integrator_resume(integrator, state);
    answered(hooke_trajectory_checkpoint(trajectory, integrator, state));
    answered(hooke_trajectory_close(trajectory, outcome));
  } else {
    hooke_fuzz_require(trajectory == NULL, "a trajectory besides a failure, or of a run that finished");
  }
}

/* A run that takes very long is no finding. */
static int is_short(const hooke_options *run) {
  enum { MOST_STEPS = 1000 };
  const double step = hooke_options_number(run, "step"), every = hooke_options_number(run, "every"),
               duration = hooke_options_number(run, "duration");
  return duration / step < MOST_STEPS && !(duration / every > MOST_STEPS);
}

/* Continues the run, if that is possible. */
static void ask_resume(int64_t frames) {
  owned_scene *scene = NULL;
  owned_integrator *integrator = NULL;
  container_kill_after(frames);
  if (!answered(hooke_scene_load(container.path, NULL, &scene))) return;
  const hooke_options *run = hooke_scene_run_options(scene);
  if (is_short(run) && answered(hooke_scene_commit(scene)) &&
      answered(hooke_integrator_create(hooke_scene_system(scene), run, &integrator)))
    go_on(hooke_scene_system(scene), integrator);
}

static void ask_scene(void) {
  owned_scene *scene = NULL;
  if (!answered(hooke_scene_load(container.path, NULL, &scene))) {
    hooke_fuzz_require(scene == NULL, "a scene besides a failure");
    return;
  }
  hooke_integrator *integrator = NULL;
  if (answered(hooke_scene_commit(scene)) &&
      answered(
          hooke_integrator_create(hooke_scene_system(scene), hooke_scene_run_options(scene), &integrator)))
    hooke_integrator_destroy(integrator);
}

static void ask_xdmf(const hooke_record *record, int beside) {
  char path[96];
  snprintf(path, sizeof path, "%s/x.xdmf", container.folder);
  answered(hooke_record_write_xdmf(record, beside ? NULL : path));
}

static void ask_view(const hooke_record *record) {
  owned_measurement *view = NULL;
  if (!answered(hooke_view_create(record, NULL, &view))) return;
  const double frames = hooke_measurement_number(view, "view", 0, "frames");
  hooke_fuzz_require(frames >= 1 && frames <= (double)hooke_record_count(record, "frames"),
                     "frames of a view");
}

static void check_texts(const hooke_record *record) {
  hooke_fuzz_require(
      hooke_record_text(record, "status") != NULL && hooke_record_text(record, "colour") == NULL, "texts");
  hooke_fuzz_require(strstr(hooke_record_text(record, "status"), SECRET_TEXT) == NULL &&
                         strstr(hooke_record_text(record, "scene"), SECRET_TEXT) == NULL,
                     "a text of another file");
}

/* `often` 0: skips slow calls. */
static void ask(const uint8_t head[EDIT_HEAD], int often) {
  const int what = head[1] & (often ? ~0 : ~(ASK_HDF5 | ASK_RESUME | ASK_XDMF));
  owned_record *record = NULL;
  if (answered(hooke_record_open(container.path, &record))) {
    hooke_fuzz_is_accepted();
    check_texts(record);
    if (what & ASK_FRAME) ask_frame(record, head[0], what & ASK_HDF5);
    if (what & ASK_ARRAY) ask_array(record, head[0] >> 4, (what & ASK_TWICE) != 0, what & ASK_HDF5);
    if ((what & ASK_XDMF) && head[2] % 8 == 1) ask_xdmf(record, head[2] & 8);
    if ((what & ASK_VIEW) && head[2] % 16 == 2) ask_view(record);
  } else {
    hooke_fuzz_require(record == NULL, "a record besides a failure");
  }
  hooke_fuzz_require((what & ASK_HDF5) || !container_others_opened(), "another file was opened");
  if ((what & ASK_SCENE) && head[2] % 4 == 0) ask_scene();
  if ((what & ASK_RESUME) && head[2] % 8 == 3) ask_resume(head[0] % 8);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct edits edits;
  hooke_fuzz_begin();
  if (container.names == 0) {
    container_begin(&container);
    make_state(0);
    make_state(1);
  }
  edits_decode(data, size, &edits);
  container_edit(&container, &edits);
  hooke_fuzz_is_past_syntax(); /* the container is valid HDF5 */
  const int64_t open = container_open_objects();
  container_others_opened();
  ask(edits.head, size <= EDIT_HEAD || hooke_fuzz_is_chosen(data, size, 32));
  hooke_fuzz_require(container_open_objects() == open, "objects of HDF5 left open");
  return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
  return edits_mutate(data, size, most, seed);
}
