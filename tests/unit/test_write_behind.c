/* Frames written by a thread: the same bytes in the file but for the name of the run, the same number, and
 * failures reported. */
#include "check.h"
#include "file_copy.h"
#include "file_limit.h"
#include "core/memory.h"
#include "io/hdf5/array_h5.h"
#include "run.h"
#include "small.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { N = 3000, FRAMES = 9, PATH_SIZE = 256 };

/* A rope of n particles, and a folder of its own. */
struct fixture {
  hooke_system *system;
  hooke_integrator *integrator;
  hooke_state *state;
  char folder[PATH_SIZE / 2], path[PATH_SIZE], other[PATH_SIZE];
};

static void build(struct fixture *f, int n) {
  f->system = small_part(
      NULL, "rope", NULL,
      "from=0,0,0 to=1,0.1,0 segments=%d mass=0.5 stretch.stiffness=1e-3 stretch.damping=1e-6", n - 1);
  check_ok(hooke_system_set_gravity(f->system, (double[]){0, -9.81, 0}));
  check_ok(hooke_system_commit(f->system));
  f->integrator =
      start_with(f->system, .method = "symplectic-euler", .step = 1e-4, .duration = 8e-3, .every = 1e-3);
  f->state = start_state(f->system);
  snprintf(f->folder, sizeof f->folder, "%s/hooke-behind-XXXXXX", P_tmpdir);
  assert_non_null(mkdtemp(f->folder));
  snprintf(f->path, sizeof f->path, "%s/out.h5", f->folder);
  snprintf(f->other, sizeof f->other, "%s/other.h5", f->folder);
}

static void release(struct fixture *f) {
  hooke_state_destroy(f->state);
  hooke_integrator_destroy(f->integrator);
  hooke_system_destroy(f->system);
  unlink(f->path);
  unlink(f->other);
  assert_int_equal(rmdir(f->folder), 0); /* nothing is left behind */
}

#if HOOKE_HAVE_HDF5

static hooke_trajectory *create(const struct fixture *f, const char *path, int behind) {
  hooke_trajectory *trajectory;
  check_ok(hooke_trajectory_create(path, f->system, f->integrator, "{}", &trajectory));
  if (behind) check_ok(hooke_trajectory_write_behind(trajectory));
  return trajectory;
}

/* The state changes as soon as a frame is queued, as it does when steps continue. */
static int32_t write_frame(const struct fixture *f, hooke_trajectory *trajectory, int64_t frame) {
  double *q = hooke_state_position(f->state), *v = hooke_state_velocity(f->state);
  hooke_state_set_time(f->state, 0.25 * (double)frame);
  for (int64_t k = 0; k < hooke_state_size(f->state); k++) {
    q[k] = (double)(k % 97) + 1000.0 * (double)frame;
    v[k] = (double)(k % 89) - (double)frame;
  }
  const int32_t status = hooke_trajectory_write(trajectory, 10 * frame, f->state);
  memset(q, 0xff, (size_t)hooke_state_size(f->state) * sizeof *q);
  return status;
}

static void write_file(const struct fixture *f, const char *path, int behind, int64_t frames) {
  hooke_trajectory *trajectory = create(f, path, behind);
  for (int64_t k = 0; k < frames; k++)
    check_ok(write_frame(f, trajectory, k));
  if (frames == FRAMES) check_status(write_frame(f, trajectory, frames), HOOKE_BAD_CALL);
  check_ok(hooke_trajectory_close(trajectory, frames == FRAMES ? HOOKE_OK : HOOKE_STOPPED));
}

/* Overwrites the random identifier of the run, which differs between files. */
static void blank_run(const char *path, char *bytes, size_t count) {
  owned_record *record = NULL;
  int found = 0;
  check_ok(hooke_record_open(path, &record));
  const char *run = hooke_record_text(record, "run");
  const size_t length = strlen(run);
  assert_int_equal(length, 32);
  for (size_t k = 0; k + length <= count; k++) {
    if (memcmp(bytes + k, run, length) != 0) continue;
    memset(bytes + k, '0', length);
    found++;
  }
  assert_int_equal(found, 1);
}

TEST(the_file_is_the_same) {
  struct fixture f;
  build(&f, N);
  const int64_t frames[] = {FRAMES, 5, 1, 0};
  for (int k = 0; k < 4; k++) {
    size_t size, other_size;
    write_file(&f, f.path, 1, frames[k]);
    write_file(&f, f.other, 0, frames[k]);
    owned_text *bytes = bytes_of(f.path, &size), *other = bytes_of(f.other, &other_size);
    assert_int_equal(size, other_size);
    blank_run(f.path, bytes, size);
    blank_run(f.other, other, size);
    assert_true(size > (size_t)(48 * N * frames[k]));
    assert_memory_equal(bytes, other, size);
  }
  release(&f);
}

static int64_t frames_in(const char *path) {
  owned_record *record = NULL;
  check_ok(hooke_record_open(path, &record));
  return hooke_record_count(record, "frames");
}

TEST(small_frames_are_there_at_once) {
  struct fixture f;
  build(&f, 7);
  hooke_trajectory *trajectory = create(&f, f.path, 1);
  for (int64_t k = 0; k < FRAMES; k++) {
    owned_text *bytes = NULL;
    size_t size;
    check_ok(write_frame(&f, trajectory, k));
    bytes = bytes_of(f.path, &size); /* what a kill would leave */
    FILE *copy = fopen(f.other, "wb");
    assert_non_null(copy);
    assert_int_equal(fwrite(bytes, 1, size, copy), size);
    assert_int_equal(fclose(copy), 0);
    assert_int_equal(frames_in(f.other), k + 1);
  }
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  release(&f);
}

/* A failed frame is reported by the next call, and by all after it. */
TEST(a_failed_write_is_told) {
  struct fixture f;
  build(&f, N);
  for (int closes = 0; closes <= 1; closes++) {
    hooke_trajectory *trajectory = create(&f, f.path, 1);
    for (int64_t k = 0; k < 3; k++)
      check_ok(write_frame(&f, trajectory, k));
    while (frames_in(f.path) < 3)
      nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    limit_files(1000);
    check_ok(write_frame(&f, trajectory, 3));
    for (int again = 0; again < 2 && !closes; again++) {
      check_status(write_frame(&f, trajectory, 4), HOOKE_IO_FAILED);
      check_message("write frame 3: File too large");
    }
    check_status(hooke_trajectory_close(trajectory, HOOKE_OK), HOOKE_IO_FAILED);
    check_message("write frame 3: File too large");
    check_message(f.path);
    lift_file_limit();
    assert_int_equal(frames_in(f.path), 3);
  }
  release(&f);
}

#else

TEST(it_is_not_in_this_build) {
  struct fixture f;
  build(&f, N);
  check_status(hooke_trajectory_write_behind(NULL), HOOKE_BAD_CALL);
  release(&f);
}

#endif
