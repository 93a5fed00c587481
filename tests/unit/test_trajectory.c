/* Trajectory files: reading returns what was written, nothing else counts as a frame, failures are reported.
 */
#include "check.h"
#include "file_copy.h"
#include "file_limit.h"
#include "core/memory.h"
#include "io/hdf5/array_h5.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static hooke_system *new_rope(void) {
  return small_falling(small_part(
      NULL, "rope", NULL, "from=0,0,0 to=1,0.1,0 segments=6 mass=0.5 stretch.stiffness=30 pinned=start"));
}

#if HOOKE_HAVE_HDF5

enum { N = 7, FRAMES = 11, PATH_SIZE = 256 };

/* A rope, an integrator that reports 11 frames, and a folder of its own. */
struct fixture {
  hooke_system *system;
  hooke_integrator *integrator;
  hooke_state *state;
  hooke_trajectory *trajectory;
  char folder[PATH_SIZE / 2], path[PATH_SIZE], copy[PATH_SIZE];
  double q[FRAMES][3 * N], v[FRAMES][3 * N];
  int64_t seen, stop_after; /* frames */
  int32_t status;           /* of the last write */
};

static int set_up(void **state) {
  struct fixture *f = new_block(1, sizeof *f);
  f->system = new_rope();
  f->integrator =
      start_with(f->system, .method = "symplectic-euler", .step = 1e-3, .duration = 0.1, .every = 0.01);
  f->state = start_state(f->system);
  f->stop_after = FRAMES + 1;
  assert_int_equal(hooke_integrator_count(f->integrator, "frames"), FRAMES);
  snprintf(f->folder, sizeof f->folder, "%s/hooke-trajectory-XXXXXX", P_tmpdir);
  assert_non_null(mkdtemp(f->folder));
  snprintf(f->path, sizeof f->path, "%s/out.h5", f->folder);
  snprintf(f->copy, sizeof f->copy, "%s/copy.h5", f->folder);
  *state = f;
  return 0;
}

static int tear_down(void **state) {
  struct fixture *f = *state;
  hooke_trajectory_close(f->trajectory, HOOKE_OK);
  hooke_state_destroy(f->state);
  hooke_integrator_destroy(f->integrator);
  hooke_system_destroy(f->system);
  unlink(f->path);
  unlink(f->copy);
  /* any leftover file, such as a temporary one, keeps the folder */
  int result = rmdir(f->folder);
  free(f);
  return result;
}

static void create(struct fixture *f) {
  check_ok(hooke_trajectory_create(f->path, f->system, f->integrator, "{ \"hooke\": 1 }", &f->trajectory));
}

static int32_t on_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct fixture *f = ctx;
  memcpy(f->q[f->seen], hooke_state_position(state), sizeof f->q[0]);
  memcpy(f->v[f->seen], hooke_state_velocity(state), sizeof f->v[0]);
  f->status = hooke_trajectory_write(f->trajectory, step, state);
  if (f->status == HOOKE_OK) f->seen++;
  return f->status != HOOKE_OK || f->seen == f->stop_after;
}

static void run(struct fixture *f, int32_t outcome) {
  check_ok(hooke_integrator_on_frame(f->integrator, on_frame, f));
  check_status(hooke_integrator_run(f->integrator, f->state), outcome);
}

static int32_t close_file(struct fixture *f, int32_t outcome) {
  hooke_trajectory *trajectory = f->trajectory;
  f->trajectory = NULL;
  return hooke_trajectory_close(trajectory, outcome);
}

static void check_frame(const char *path, const char *dataset, int64_t frame, const double *expected) {
  double *values;
  int64_t rows, columns;
  check_ok(hk_array_read(path, dataset, frame, 1, &values, &rows, &columns));
  assert_int_equal(rows, N);
  assert_int_equal(columns, 3);
  check_same_bits(3 * N, values, expected);
  hk_free(values);
}

static void check_no_frame(const char *path, int64_t frame, const char *message) {
  double *values;
  int64_t rows, columns;
  check_status(hk_array_read(path, "/particles/all/position/value", frame, 1, &values, &rows, &columns),
               HOOKE_BAD_VALUE);
  check_message(message);
  assert_null(values);
}

/* Frames 0..count-1 are in the file, bit for bit, and no other. */
static void check_file(const struct fixture *f, const char *path, int64_t count) {
  for (int64_t k = 0; k < count; k++) {
    check_frame(path, "/particles/all/position/value", k, f->q[k]);
    check_frame(path, "/particles/all/velocity/value", k - count, f->v[k]);
  }
  check_no_frame(path, count, "has no frame ");
  check_no_frame(path, -count - 1, "has no frame ");
}

/* The number of values in a column of the file, and the values. */
static double *column(const char *path, const char *dataset, int64_t count) {
  double *values;
  int64_t rows, columns;
  check_ok(hk_array_read(path, dataset, 0, 0, &values, &rows, &columns));
  assert_int_equal(rows, count);
  assert_int_equal(columns, 1);
  return values;
}

static void write_file(const char *path, const char *text) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs(text, file);
  assert_int_equal(fclose(file), 0);
}

static void check_text(const char *path, const char *expected) {
  char text[64] = "";
  FILE *file = fopen(path, "r");
  assert_non_null(file);
  size_t length = fread(text, 1, sizeof text - 1, file);
  fclose(file);
  assert_int_equal(length, strlen(expected));
  assert_string_equal(text, expected);
}

TEST(all_frames_come_back) {
  struct fixture *f = *prepared;
  create(f);
  run(f, HOOKE_OK);
  check_status(hooke_trajectory_write(f->trajectory, 101, f->state), HOOKE_BAD_CALL);
  check_message("all 11 frames");
  check_ok(close_file(f, HOOKE_OK));
  check_file(f, f->path, FRAMES);

  double *time = column(f->path, "/particles/all/position/time", FRAMES);
  double *step = column(f->path, "/observables/momentum/step", FRAMES);
  double *kinetic = column(f->path, "/observables/kinetic_energy/value", FRAMES);
  double *mass = column(f->path, "/particles/all/mass", N);
  double *species = column(f->path, "/particles/all/species", N);
  for (int k = 0; k < FRAMES; k++) {
    check_close(time[k], 0.01 * k, 1e-16);
    check_close(step[k], 10.0 * k, 0.0);
    const double energy = hooke_system_energy(f->system, "kinetic", NULL, f->v[k]);
    check_same_bits(1, &kinetic[k], &energy);
  }
  check_same_bits(N, mass, hooke_system_mass(f->system));
  for (int k = 0; k < N; k++)
    check_close(species[k], k == 0 ? 1 : 0, 0.0);
  hk_free(time);
  hk_free(step);
  hk_free(kinetic);
  hk_free(mass);
  hk_free(species);

  double *ends;
  int64_t rows, columns;
  check_ok(hk_array_read(f->path, "/connectivity/springs", 0, 0, &ends, &rows, &columns));
  assert_int_equal(rows, 6);
  assert_int_equal(columns, 2);
  for (int k = 0; k < 12; k++)
    check_close(ends[k], (k + 1) / 2, 0.0);
  hk_free(ends);
}

/* After each frame the bytes on the disk hold exactly the frames so far: nothing is cached in memory. */
/* HDF5 fills texts beyond 1 MiB from beyond its buffer, which fails where the memory ends soon after. */
TEST(scenes_of_any_length_come_back) {
  struct fixture *f = *prepared;
  static const int64_t lengths[] = {0,       1,       (1 << 20) - 1, 1 << 20, (1 << 20) + 1,
                                    1180000, 2300000, 3271701,       9000000};
  for (size_t k = 0; k < sizeof lengths / sizeof lengths[0]; k++) {
    owned_record *record = NULL;
    owned_text *text = new_block(lengths[k] + 1, 1);
    for (int64_t i = 0; i < lengths[k]; i++)
      text[i] = (char)('a' + (i * 7 + i / 1000) % 26);
    check_ok(hooke_trajectory_create(f->path, f->system, f->integrator, text, &f->trajectory));
    check_ok(close_file(f, HOOKE_STOPPED));
    check_ok(hooke_record_open(f->path, &record));
    assert_string_equal(hooke_record_text(record, "scene"), text);
  }
}

TEST(every_frame_is_in_the_file_at_once) {
  struct fixture *f = *prepared;
  create(f);
  for (int64_t k = 0; k < FRAMES; k++) {
    copy_file(f->path, f->copy);
    if (k == 0) check_no_frame(f->copy, 0, "has no frames yet");
    if (k > 0) check_file(f, f->copy, k);
    for (int i = 0; i < 3 * N; i++) {
      f->q[k][i] = hooke_state_position(f->state)[i] = sin(1.0 + (double)k + 0.1 * i);
      f->v[k][i] = hooke_state_velocity(f->state)[i] = cos(1.0 + (double)k + 0.1 * i);
    }
    hooke_state_set_time(f->state, 0.5 * (double)k);
    check_ok(hooke_trajectory_write(f->trajectory, 3 * k, f->state));
  }
  copy_file(f->path, f->copy);
  check_file(f, f->copy, FRAMES);
}

TEST(an_early_end_leaves_no_empty_frames) {
  struct fixture *f = *prepared;
  create(f);
  f->stop_after = 4;
  run(f, HOOKE_STOPPED);
  copy_file(f->path, f->copy);
  check_ok(close_file(f, HOOKE_STOPPED));
  check_file(f, f->path, 4);
  hk_free(column(f->path, "/observables/total_energy/value", 4));
  /* before, it had the planned length, and read as the written frames */
  check_file(f, f->copy, 4);
  hk_free(column(f->copy, "/observables/total_energy/value", FRAMES));
}

TEST(a_run_without_a_frame_closes) {
  struct fixture *f = *prepared;
  create(f);
  check_ok(close_file(f, HOOKE_SOLVER_FAILED));
  check_no_frame(f->path, -1, "has no frames yet");
}

TEST(wrong_states_are_refused_and_do_no_harm) {
  struct fixture *f = *prepared;
  owned_state *other = NULL;
  check_ok(hooke_state_create_first_order(4, &other));
  create(f);
  check_status(hooke_trajectory_write(f->trajectory, 0, other), HOOKE_BAD_VALUE);
  run(f, HOOKE_OK);
  check_ok(close_file(f, HOOKE_OK));
  check_file(f, f->path, FRAMES);
  check_ok(hooke_trajectory_close(NULL, HOOKE_OK));
}

static void check_not_created(struct fixture *f, const char *path, const char *message) {
  check_status(hooke_trajectory_create(path, f->system, f->integrator, NULL, &f->trajectory),
               HOOKE_IO_FAILED);
  check_message(path);
  check_message(message);
  assert_null(f->trajectory);
}

TEST(only_regular_files_are_replaced) {
  struct fixture *f = *prepared;
  struct stat device;
  check_not_created(f, "/dev/null", "is not a regular file");
  assert_int_equal(stat("/dev/null", &device), 0);
  assert_true(S_ISCHR(device.st_mode));
  check_not_created(f, f->folder, "is not a regular file");
  check_not_created(f, "/no/such/folder/out.h5", "No such file or directory");
}

TEST(a_link_stays_a_link) {
  struct fixture *f = *prepared;
  struct stat there;
  write_file(f->copy, "old");
  assert_int_equal(symlink(f->copy, f->path), 0);
  create(f);
  run(f, HOOKE_OK);
  check_ok(close_file(f, HOOKE_OK));
  assert_int_equal(lstat(f->path, &there), 0);
  assert_true(S_ISLNK(there.st_mode));
  check_file(f, f->copy, FRAMES);
}

TEST(an_old_file_stays_until_there_is_room) {
  struct fixture *f = *prepared;
  write_file(f->path, "precious");
  for (int64_t size = 0; size < 60000; size += 1500) {
    limit_files(size);
    int32_t status = hooke_trajectory_create(f->path, f->system, f->integrator, NULL, &f->trajectory);
    lift_file_limit();
    if (status == HOOKE_OK) {
      assert_true(size > 5000);
      return;
    }
    assert_int_equal(status, HOOKE_IO_FAILED);
    check_message(f->path);
    check_text(f->path, "precious");
  }
  check_failed("a file of 60000 bytes is room enough");
}

TEST(a_failed_write_is_never_success) {
  struct fixture *f = *prepared;
  create(f);
  f->stop_after = 3;
  run(f, HOOKE_STOPPED);
  limit_files(1000);
  check_status(hooke_trajectory_write(f->trajectory, 30, f->state), HOOKE_IO_FAILED);
  check_message(f->path);
  check_message("write frame 3: File too large");
  lift_file_limit();
  check_status(hooke_trajectory_write(f->trajectory, 30, f->state), HOOKE_IO_FAILED);
  check_message("write frame 3: File too large");
  check_status(close_file(f, HOOKE_OK), HOOKE_IO_FAILED);
  check_message("write frame 3: File too large");
  check_file(f, f->path, 3);
}

TEST(a_failed_shortening_keeps_the_long_file) {
  struct fixture *f = *prepared;
  create(f);
  f->stop_after = 5;
  run(f, HOOKE_STOPPED);
  limit_files(3000);
  const int32_t status = close_file(f, HOOKE_STOPPED);
  lift_file_limit();
  assert_int_equal(status, HOOKE_IO_FAILED);
  check_message("File too large");
  check_file(f, f->path, 5);
}

TEST(arrays_are_refused_in_words) {
  struct fixture *f = *prepared;
  double *values;
  int64_t rows, columns;
  create(f);
  run(f, HOOKE_OK);
  check_ok(close_file(f, HOOKE_OK));
  check_status(hk_array_read(f->path, "/particles/all/mass", 0, 1, &values, &rows, &columns),
               HOOKE_BAD_VALUE);
  check_message("has no frames");
  check_status(hk_array_read(f->path, "/hooke/status", 0, 0, &values, &rows, &columns), HOOKE_BAD_VALUE);
  check_message("/hooke/status");
  check_status(hk_array_read(f->path, "/nothing/here", 0, 0, &values, &rows, &columns), HOOKE_IO_FAILED);
  check_message("find the dataset /nothing/here");
  check_status(hk_array_read(f->path, "/particles", 0, 0, &values, &rows, &columns), HOOKE_BAD_VALUE);
  check_message("/particles is not an array of numbers");
  check_status(hk_array_read(f->folder, "/a", 0, 0, &values, &rows, &columns), HOOKE_IO_FAILED);
  check_status(hk_array_read(f->copy, "/a", 0, 0, &values, &rows, &columns), HOOKE_IO_FAILED);
  check_message("No such file or directory");
  write_file(f->copy, "this is not HDF5");
  check_status(hk_array_read(f->copy, "/a", 0, 0, &values, &rows, &columns), HOOKE_IO_FAILED);
  check_message(f->copy);
  assert_null(values);
}

AROUND_EACH(set_up, tear_down)

#else

/* Without HDF5 every call says so. */
TEST(trajectories_are_not_in_this_build) {
  owned_system *system = new_rope();
  owned_integrator *integrator =
      start_with(system, .method = "symplectic-euler", .step = 1e-3, .duration = 0.1, .every = 0.01);
  hooke_trajectory *trajectory;
  double *values;
  int64_t rows, columns;
  check_status(hooke_trajectory_create("out.h5", system, integrator, NULL, &trajectory), HOOKE_NOT_BUILT);
  assert_null(trajectory);
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  check_status(hk_array_read("out.h5", "/a", 0, 0, &values, &rows, &columns), HOOKE_NOT_BUILT);
  check_message("HDF5");
}

#endif
