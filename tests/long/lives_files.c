/* Lives of trajectories: written, read, continued, verified, viewed. */
#include "check.h"
#include "hash.h"
#include "lives.h"
#include "run.h"

#include <fcntl.h>
#include <unistd.h>

/* ---- written ---- */

struct writer {
  hooke_scene *scene;
  hooke_integrator *integrator;
  hooke_state *state;
  hooke_trajectory *trajectory;
  double stop; /* s; no frame is written after */
};

static int32_t write_frame(int64_t step, const hooke_state *state, void *ctx) {
  const struct writer *writer = ctx;
  check_ok(hooke_trajectory_write(writer->trajectory, step, state));
  return hooke_state_time(state) >= writer->stop;
}

static struct writer begin(double stop, int32_t segments) {
  struct writer writer = {.scene = life_scene(segments), .stop = stop};
  hooke_system *system = hooke_scene_system(writer.scene);
  check_ok(hooke_integrator_create(system, hooke_scene_run_options(writer.scene), &writer.integrator));
  writer.state = start_state(system);
  return writer;
}

static void create(struct writer *writer) {
  check_ok(hooke_trajectory_create(life_files.trajectory, hooke_scene_system(writer->scene),
                                   writer->integrator, hooke_scene_text(writer->scene, "text"),
                                   &writer->trajectory));
}

static void end(struct writer *writer) {
  hooke_state_destroy(writer->state);
  hooke_integrator_destroy(writer->integrator);
  hooke_scene_destroy(writer->scene);
}

static void write_all(double stop, int32_t segments, int32_t checkpoint) {
  struct writer writer = begin(stop, segments);
  create(&writer);
  if (segments == MANY) check_ok(hooke_trajectory_write_behind(writer.trajectory));
  check_ok(hooke_integrator_on_frame(writer.integrator, write_frame, &writer));
  const int32_t outcome = hooke_integrator_run(writer.integrator, writer.state);
  check_status(outcome, stop < 0.02 ? HOOKE_STOPPED : HOOKE_OK);
  if (checkpoint) check_ok(hooke_trajectory_checkpoint(writer.trajectory, writer.integrator, writer.state));
  check_ok(hooke_trajectory_close(writer.trajectory, outcome));
  end(&writer);
}

/* ---- read ---- */

/* Every frame, the texts of the file, and an array of it. */
static uint64_t read_all(int32_t segments) {
  owned_scene *scene = life_scene(segments);
  owned_state *state = start_state(hooke_scene_system(scene));
  hooke_record *record = NULL;
  int64_t rows = 0, columns = 0;
  check_ok(hooke_record_open(life_files.trajectory, &record));
  assert_string_equal(hooke_record_text(record, "scene"), hooke_scene_text(scene, "text"));
  assert_string_equal(hooke_record_text(record, "status"), "finished");
  uint64_t hash = HASH_START;
  for (int64_t k = 0; k < hooke_record_count(record, "frames"); k++) {
    check_ok(hooke_record_check(record, k));
    check_ok(hooke_record_read(record, k, state));
    hash = life_hash(state, hash);
  }
  check_status(hooke_record_read(record, hooke_record_count(record, "frames"), state), HOOKE_BAD_VALUE);
  check_ok(hooke_record_size(record, "total_energy", &rows, &columns));
  owned_doubles *numbers = new_doubles(rows * columns);
  check_ok(hooke_record_numbers(record, "total_energy", numbers));
  hash = hash_doubles(rows * columns, numbers, hash);
  check_ok(hooke_record_write_xdmf(record, life_files.page));
  hooke_record_close(record);
  return hash;
}

static uint64_t live_trajectory(const char *detail) {
  const int32_t segments = detail != NULL ? MANY : SEGMENTS;
  write_all(1.0, segments, 0);
  return read_all(segments);
}

/* One file for all lives. */
static void write_once(void) {
  if (access(life_files.trajectory, F_OK) != 0) write_all(1.0, SEGMENTS, 0);
}

static uint64_t live_record(const char *detail) {
  (void)detail;
  write_once();
  return read_all(SEGMENTS);
}

/* ---- continued ---- */

/* From the checkpoint beside the file or, without one, from its last frame. */
static uint64_t live_resume(const char *detail) {
  write_all(0.01, SEGMENTS, detail != NULL);
  struct writer writer = begin(1.0, SEGMENTS);
  check_ok(hooke_trajectory_resume(life_files.trajectory, hooke_scene_system(writer.scene), writer.integrator,
                                   writer.state, &writer.trajectory));
  assert_non_null(writer.trajectory);
  check_ok(hooke_integrator_on_frame(writer.integrator, write_frame, &writer));
  check_ok(hooke_integrator_resume(writer.integrator, writer.state));
  check_ok(hooke_trajectory_close(writer.trajectory, HOOKE_OK));
  end(&writer);
  return read_all(SEGMENTS);
}

/* ---- verified ---- */

static void damage(void) {
  hooke_record *record = NULL;
  unsigned char byte = 0;
  check_ok(hooke_record_open(life_files.trajectory, &record));
  const int64_t place = hooke_record_place(record, "position");
  hooke_record_close(record);
  const int file = open(life_files.trajectory, O_RDWR);
  assert_true(place > 0 && file >= 0 && pread(file, &byte, 1, place) == 1);
  byte ^= 1;
  assert_int_equal(pwrite(file, &byte, 1, place), 1);
  assert_int_equal(close(file), 0);
}

/* The file as it is, or with a bit of its first frame changed. */
static uint64_t live_verify(const char *detail) {
  if (access(life_files.trajectory, F_OK) != 0) {
    write_once();
    if (detail != NULL) damage();
  }
  owned_measurement *verify = NULL;
  check_ok(hooke_verify_create(life_files.trajectory, NULL, NULL, &verify));
  check_status(hooke_measurement_run(verify, NULL), detail == NULL ? HOOKE_OK : HOOKE_BAD_VALUE);
  assert_string_equal(hooke_measurement_text(verify, "verify", 0, "verdict"),
                      detail == NULL ? "agrees" : "disagrees");
  const double found[] = {hooke_measurement_number(verify, "verify", 0, "frames_checked"),
                          hooke_measurement_number(verify, "verify", 0, "check_last"),
                          hooke_measurement_number(verify, "verify", 0, "residual")};
  return hash_doubles(3, found, HASH_START);
}

/* ---- viewed ---- */

static uint64_t live_view(const char *detail) {
  (void)detail;
  write_once();
  hooke_record *record = NULL;
  hooke_measurement *view = NULL;
  check_ok(hooke_record_open(life_files.trajectory, &record));
  check_ok(hooke_view_create(record, NULL, &view));
  check_ok(hooke_measurement_label(view, "title", "life"));
  check_ok(hooke_measurement_write(view, life_files.page));
  const double found[] = {hooke_measurement_number(view, "view", 0, "frames"),
                          hooke_measurement_number(view, "view", 0, "bytes")};
  hooke_measurement_destroy(view);
  hooke_record_close(record);
  return hash_doubles(2, found, HASH_START);
}

const struct life file_lives[] = {
    {"trajectory", NULL, live_trajectory, HDF5_KEEPS},
    {"write-behind", "behind", live_trajectory, HDF5_KEEPS},
    {"record", NULL, live_record, HDF5_KEEPS},
    {"resume", "checkpoint", live_resume, HDF5_KEEPS},
    {"resume-frame", NULL, live_resume, HDF5_KEEPS},
    {"verify", NULL, live_verify, HDF5_KEEPS},
    {"verify-damaged", "damaged", live_verify, HDF5_KEEPS},
    {"view", NULL, live_view, HDF5_KEEPS},
    {NULL, NULL, NULL, 0},
};
