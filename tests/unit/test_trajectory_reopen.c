/* Continuing the file of a run that was killed or ended early: the same frames as without interruption; other
 * files are refused. */
#include "check.h"
#include "file_copy.h"
#include "file_limit.h"
#include "integrate/integrator.h"
#include "io/trajectory/trajectory.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

enum { N = 7, FRAMES = 11, PATH_SIZE = 256 };

/* `brace`: one more spring, from the first particle to the third. */
static hooke_system *braced_rope(int particles, double mass, int brace) {
  const int64_t ends[] = {0, 2};
  hooke_system *system = small_part(
      NULL, "rope", NULL, "from=0,0,0 to=1,0.1,0 segments=%d mass=%.17g stretch.stiffness=30 pinned=start",
      particles - 1, mass);
  if (brace) springs_with(system, 1, ends, .stiffness = 1.0, .rest_length = 0.5);
  return small_falling(system);
}

static hooke_system *rope(int particles) {
  return braced_rope(particles, 0.5, 0);
}

static hooke_integrator *integrator_of(hooke_system *system, double duration) {
  return start_with(system, .method = "symplectic-euler", .step = 1e-3, .duration = duration, .every = 0.01);
}

#if HOOKE_HAVE_HDF5

struct fixture {
  hooke_system *system;
  hooke_integrator *integrator;
  hooke_state *frame[FRAMES]; /* of the uninterrupted run */
  char folder[PATH_SIZE / 2], path[PATH_SIZE], other[PATH_SIZE];
};

static int set_up(void **state) {
  struct fixture *f = new_block(1, sizeof *f);
  f->system = rope(N);
  f->integrator = integrator_of(f->system, 0.1);
  for (int k = 0; k < FRAMES; k++) {
    f->frame[k] = start_state(f->system);
    if (k == 0) continue;
    hooke_state_copy(f->frame[k - 1], f->frame[k]);
    check_ok(hooke_integrator_step(f->integrator, f->frame[k], 10));
  }
  snprintf(f->folder, sizeof f->folder, "%s/hooke-reopen-XXXXXX", P_tmpdir);
  assert_non_null(mkdtemp(f->folder));
  snprintf(f->path, sizeof f->path, "%s/out.h5", f->folder);
  snprintf(f->other, sizeof f->other, "%s/other.h5", f->folder);
  *state = f;
  return 0;
}

static int tear_down(void **state) {
  struct fixture *f = *state;
  for (int k = 0; k < FRAMES; k++)
    hooke_state_destroy(f->frame[k]);
  hooke_integrator_destroy(f->integrator);
  hooke_system_destroy(f->system);
  unlink(f->path);
  unlink(f->other);
  const int result = rmdir(f->folder); /* nothing is left behind */
  free(f);
  return result;
}

static hooke_trajectory *create(const struct fixture *f, const char *path) {
  hooke_trajectory *trajectory;
  check_ok(hooke_trajectory_create(path, f->system, f->integrator, "{}", &trajectory));
  return trajectory;
}

static hooke_trajectory *reopen(const struct fixture *f, int64_t kept) {
  hooke_trajectory *trajectory;
  check_ok(hk_trajectory_reopen(f->path, f->system, f->integrator, kept, &trajectory));
  return trajectory;
}

static void write_frames(const struct fixture *f, hooke_trajectory *trajectory, int64_t first, int64_t end) {
  for (int64_t k = first; k < end; k++)
    check_ok(hooke_trajectory_write(trajectory, 10 * k, f->frame[k]));
}

/* A process that writes so many frames and is killed. */
static void be_killed(const struct fixture *f, int64_t frames, int64_t kept) {
  const pid_t child = fork();
  if (child == 0) {
    hooke_trajectory *trajectory = kept < 0 ? create(f, f->path) : reopen(f, kept);
    write_frames(f, trajectory, kept < 0 ? 0 : kept, frames);
    raise(SIGKILL);
  }
  int status;
  assert_int_equal(waitpid(child, &status, 0), child);
  assert_true(WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL);
}

static void end_early(const struct fixture *f, int64_t frames) {
  hooke_trajectory *trajectory = create(f, f->path);
  write_frames(f, trajectory, 0, frames);
  check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
}

/* Exactly these frames, each to the bit. */
static void check_frames(const struct fixture *f, int64_t count, const char *status) {
  owned_record *record = NULL;
  owned_state *state = start_state(f->system);
  check_ok(hooke_record_open(f->path, &record));
  assert_int_equal(hooke_record_count(record, "frames"), count);
  assert_string_equal(hooke_record_text(record, "status"), status);
  for (int64_t k = 0; k < count; k++) {
    check_ok(hooke_record_read(record, k, state));
    check_same_bits(3 * N, hooke_state_position(state), hooke_state_position(f->frame[k]));
    check_same_bits(3 * N, hooke_state_velocity(state), hooke_state_velocity(f->frame[k]));
    assert_true(hooke_state_time(state) == hooke_state_time(f->frame[k]));
  }
}

static int64_t planned(const struct fixture *f) {
  owned_record *record = NULL;
  int64_t rows, columns;
  check_ok(hooke_record_open(f->path, &record));
  check_ok(hooke_record_size(record, "time", &rows, &columns));
  return rows;
}

static void read_run(const struct fixture *f, char run[64]) {
  owned_record *record = NULL;
  check_ok(hooke_record_open(f->path, &record));
  snprintf(run, 64, "%s", hooke_record_text(record, "run"));
}

/* Changes byte number `at` of a byte string in the file. */
static void damage(const char *path, const void *found, size_t length, int64_t at) {
  size_t count;
  owned_text *bytes = bytes_of(path, &count);
  FILE *file = fopen(path, "r+b");
  size_t k = 0;
  while (k + length <= count && memcmp(bytes + k, found, length) != 0)
    k++;
  assert_true(k + length <= count);
  assert_int_equal(fseek(file, (long)(k + (size_t)at), SEEK_SET), 0);
  fputc(bytes[k + (size_t)at] ^ 1, file);
  assert_int_equal(fclose(file), 0);
}

TEST(a_killed_run_ends_as_if_it_never_was) {
  const struct fixture *f = *prepared;
  const int64_t killed_after[] = {0, 1, 4, 10, FRAMES};
  for (int k = 0; k < 5; k++) {
    const int64_t killed = killed_after[k];
    for (int64_t kept = killed > 2 ? killed - 2 : 0; kept <= killed; kept++) {
      char run[64];
      be_killed(f, killed, -1);
      read_run(f, run);
      be_killed(f, kept < FRAMES ? kept + 1 : kept, kept); /* again, soon after it continued */
      check_frames(f, killed > kept ? killed : kept < FRAMES ? kept + 1 : kept, "running");
      hooke_trajectory *trajectory = reopen(f, kept);
      assert_string_equal(hooke_trajectory_text(trajectory, "run"), run);
      write_frames(f, trajectory, kept, FRAMES);
      check_status(hooke_trajectory_write(trajectory, 0, f->frame[0]), HOOKE_BAD_CALL);
      check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
      check_frames(f, FRAMES, "finished");

      size_t size, whole_size;
      trajectory = create(f, f->other);
      write_frames(f, trajectory, 0, FRAMES);
      memcpy(run, hooke_trajectory_text(trajectory, "run"), 33);
      check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
      owned_text *bytes = bytes_of(f->path, &size), *whole = bytes_of(f->other, &whole_size);
      assert_int_equal(size, whole_size);
      int64_t different = 0;
      for (size_t at = 0; at < size; at++)
        different += bytes[at] != whole[at];
      assert_true(different <= 32); /* the name of the run */
    }
  }
}

TEST(a_run_that_ended_early_goes_on) {
  const struct fixture *f = *prepared;
  for (int64_t kept = 0; kept <= 6; kept += 3) {
    char run[64], now[64];
    end_early(f, 6);
    assert_int_equal(planned(f), 6);
    read_run(f, run);
    hooke_trajectory *trajectory = reopen(f, kept);
    assert_string_equal(hooke_trajectory_text(trajectory, "run"), run);
    assert_int_equal(planned(f), FRAMES);
    check_frames(f, 6, "running");
    write_frames(f, trajectory, kept, FRAMES);
    check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
    check_frames(f, FRAMES, "finished");
    read_run(f, now);
    assert_string_equal(run, now);
  }
}

/* A reported frame stays, also if the second run does not get as far as the first. */
TEST(no_frame_is_lost) {
  const struct fixture *f = *prepared;
  be_killed(f, 8, -1);
  hooke_trajectory *trajectory = reopen(f, 2);
  write_frames(f, trajectory, 2, 5);
  check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
  check_frames(f, 8, "stopped");
  assert_int_equal(planned(f), 8);
  trajectory = reopen(f, 5);
  check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
  check_frames(f, 8, "stopped");
}

static void check_refused(const struct fixture *f, int64_t kept, const char *message) {
  size_t before_size, size;
  hooke_trajectory *trajectory;
  owned_text *before = bytes_of(f->path, &before_size);
  check_status(hk_trajectory_reopen(f->path, f->system, f->integrator, kept, &trajectory), HOOKE_BAD_VALUE);
  check_message(message);
  assert_null(trajectory);
  owned_text *bytes = bytes_of(f->path, &size);
  assert_int_equal(before_size, size);
  assert_memory_equal(before, bytes, size);
}

TEST(a_damaged_frame_is_refused_by_name) {
  const struct fixture *f = *prepared;
  be_killed(f, 8, -1);
  damage(f->path, hooke_state_velocity(f->frame[3]), 3 * N * sizeof(double), 100);
  check_refused(f, 8, "frame 3 of ");
  check_refused(f, 4, "frame 3 of ");
  /* a damaged frame that will be written again is harmless; those after it are not known to be whole */
  hooke_trajectory *trajectory = reopen(f, 3);
  write_frames(f, trajectory, 3, FRAMES);
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  check_frames(f, FRAMES, "finished");
}

TEST(frames_that_were_never_there_are_missed) {
  const struct fixture *f = *prepared;
  be_killed(f, 5, -1);
  check_refused(f, 6, "frame 5 of ");
  end_early(f, 5);
  check_refused(f, 6, "it has fewer frames than the run had written");
}

static void check_other(struct fixture *f, int particles, double duration, const char *message) {
  hooke_system *system = f->system;
  hooke_integrator *integrator = f->integrator;
  f->system = rope(particles);
  f->integrator = integrator_of(f->system, duration);
  check_refused(f, 2, message);
  hooke_integrator_destroy(f->integrator);
  hooke_system_destroy(f->system);
  f->system = system;
  f->integrator = integrator;
}

TEST(other_files_are_refused) {
  struct fixture *f = *prepared;
  hooke_trajectory *trajectory;
  be_killed(f, 5, -1);
  check_other(f, N + 1, 0.1, "is not there as a run of this system makes it");
  check_other(f, N, 0.05, "it was made for more frames");
  FILE *file = fopen(f->other, "w");
  fputs("no HDF5", file);
  fclose(file);
  const char *const path[] = {f->other, "/dev/null", f->folder, "/no/such/file.h5"};
  for (int k = 0; k < 4; k++) {
    check_status(hk_trajectory_reopen(path[k], f->system, f->integrator, 0, &trajectory), HOOKE_IO_FAILED);
    check_message(path[k]);
    assert_null(trajectory);
  }
}

TEST(without_room_the_short_file_stays) {
  const struct fixture *f = *prepared;
  hooke_trajectory *trajectory;
  end_early(f, 6);
  for (int64_t size = 0; size < 30000; size += 1500) {
    limit_files(size);
    const int32_t status = hk_trajectory_reopen(f->path, f->system, f->integrator, 6, &trajectory);
    lift_file_limit();
    if (status == HOOKE_OK) {
      assert_true(size > 5000);
      check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
      break;
    }
    assert_int_equal(status, HOOKE_IO_FAILED);
    check_message("File too large");
    check_frames(f, 6, "stopped");
  }
  check_frames(f, 6, "stopped");
}

/* ---- sync ---- */

TEST(sync_brings_frames_to_the_disk) {
  const struct fixture *f = *prepared;
  hooke_trajectory *trajectory = create(f, f->path);
  check_ok(hooke_trajectory_sync(trajectory));
  write_frames(f, trajectory, 0, 4);
  check_ok(hooke_trajectory_sync(trajectory));
  check_frames(f, 4, "running");
  limit_files(1000);
  check_status(hooke_trajectory_write(trajectory, 40, f->frame[4]), HOOKE_IO_FAILED);
  lift_file_limit();
  check_status(hooke_trajectory_sync(trajectory), HOOKE_IO_FAILED);
  check_message("write frame 4: File too large");
  check_status(hooke_trajectory_close(trajectory, HOOKE_OK), HOOKE_IO_FAILED);
  check_frames(f, 4, "failed");
}

/* If another file takes the name during a run, it is neither written to nor replaced, and the run does not
 * report its frames as written. */
TEST(another_file_of_the_name_is_left_alone) {
  const struct fixture *f = *prepared;
  for (int early = 0; early <= 1; early++) {
    for (int gone = 0; gone <= 1; gone++) {
      hooke_trajectory *trajectory = create(f, f->path), *second = NULL;
      write_frames(f, trajectory, 0, early ? 4 : FRAMES);
      unlink(f->path);
      if (!gone) {
        second = create(f, f->path);
        write_frames(f, second, 0, 2);
      }
      check_status(hooke_trajectory_close(trajectory, early ? HOOKE_STOPPED : HOOKE_OK), HOOKE_IO_FAILED);
      check_message(f->path);
      if (gone) continue;
      check_message("another file has taken this name");
      check_frames(f, 2, "running");
      check_ok(hooke_trajectory_close(second, HOOKE_STOPPED));
      check_frames(f, 2, "stopped");
    }
  }
}

/* ---- continuing the run, too ---- */

static int32_t write_frame(int64_t step, const hooke_state *state, void *ctx) {
  return hooke_trajectory_write(ctx, step, state);
}

/* To the end of the run, which then equals an uninterrupted one. */
static void check_goes_on(const struct fixture *f, const char *origin) {
  owned_integrator *integrator = integrator_of(f->system, 0.1);
  owned_state *state = start_state(f->system);
  hooke_trajectory *trajectory = NULL;
  check_ok(hooke_trajectory_resume(f->path, f->system, integrator, state, &trajectory));
  assert_non_null(trajectory);
  if (strncmp(hooke_trajectory_text(trajectory, "origin"), origin, strlen(origin)) != 0 ||
      strstr(hooke_trajectory_text(trajectory, "origin"), "there is no checkpoint") == NULL)
    check_failed("it goes on from %s", hooke_trajectory_text(trajectory, "origin"));
  check_ok(hooke_integrator_on_frame(integrator, write_frame, trajectory));
  check_ok(hooke_integrator_resume(integrator, state));
  check_same_bits(3 * N, hooke_state_position(state), hooke_state_position(f->frame[FRAMES - 1]));
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  check_frames(f, FRAMES, "finished");
  /* and nothing is left to do */
  check_ok(hooke_trajectory_resume(f->path, f->system, integrator, state, &trajectory));
  assert_null(trajectory);
}

TEST(a_run_goes_on_where_its_file_ends) {
  const struct fixture *f = *prepared;
  be_killed(f, 0, -1);
  check_goes_on(f, "the beginning, at t = 0 s");
  be_killed(f, 1, -1);
  check_goes_on(f, "the beginning, at t = 0 s");
  be_killed(f, 2, -1);
  check_goes_on(f, "the last whole frame, at t = 0.01 s");
  end_early(f, 5);
  check_goes_on(f, "the last whole frame, at t = 0.04");
  be_killed(f, 4, -1);
  damage(f->path, hooke_state_position(f->frame[0]), 3 * N * sizeof(double), 60);
  check_goes_on(f, "the beginning, at t = 0 s"); /* from the scene's initial state, which is whole */
}

/* Opens the file for the rest of its run, and closes it again. Returns what gravity gave so far, by the
 * frames. */
static double swing_so_far(const struct fixture *f) {
  owned_integrator *integrator = integrator_of(f->system, 0.1);
  owned_state *state = start_state(f->system);
  hooke_trajectory *trajectory = NULL;
  check_ok(hooke_trajectory_resume(f->path, f->system, integrator, state, &trajectory));
  const double swing = integrator->gravity_swing;
  check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
  return swing;
}

/* Whether the file is written in place or made again, where its arrays lie elsewhere. */
TEST(a_run_goes_on_with_the_energies_of_its_frames) {
  const struct fixture *f = *prepared;
  be_killed(f, 5, -1);
  const double in_place = swing_so_far(f);
  assert_true(in_place > 0.0);
  end_early(f, 5);
  assert_true(swing_so_far(f) == in_place);
}

static void check_not_resumed(const struct fixture *f, const hooke_system *system,
                              hooke_integrator *integrator, int32_t status, const char *message) {
  hooke_trajectory *trajectory = NULL;
  owned_state *state = start_state(system), *before = start_state(system);
  check_status(hooke_trajectory_resume(f->path, system, integrator, state, &trajectory), status);
  check_message(message);
  assert_null(trajectory);
  check_same_bits(hooke_state_size(state), hooke_state_position(state), hooke_state_position(before));
}

TEST(other_runs_do_not_go_on) {
  const struct fixture *f = *prepared;
  struct run run = {.method = "symplectic-euler", .step = 1e-3, .duration = 0.1, .every = 0.01};
  be_killed(f, 5, -1);
  hooke_system *const systems[] = {rope(N + 1), braced_rope(N, 0.6, 0), braced_rope(N, 0.5, 1)};
  const char *const words[] = {"other mass", "other mass", "other springs"};
  for (int k = 0; k < 3; k++) {
    hooke_integrator *integrator = start_run(systems[k], run);
    check_not_resumed(f, systems[k], integrator, HOOKE_BAD_VALUE, words[k]);
    check_message(f->path);
    check_not_resumed(f, f->system, integrator, HOOKE_BAD_CALL, "not one of this system");
    hooke_integrator_destroy(integrator);
    hooke_system_destroy(systems[k]);
  }
  const struct run others[] = {{.method = "verlet", .step = 1e-3, .duration = 0.1, .every = 0.01},
                               {.method = "symplectic-euler", .step = 5e-4, .duration = 0.1, .every = 0.01},
                               {.method = "symplectic-euler", .step = 1e-3, .duration = 0.2, .every = 0.01},
                               {.method = "symplectic-euler", .step = 1e-3, .duration = 0.1, .every = 0.02}};
  for (int k = 0; k < 4; k++) {
    owned_integrator *integrator = start_run(f->system, others[k]);
    check_not_resumed(f, f->system, integrator, HOOKE_BAD_VALUE, "only threads may be changed");
  }
  run.duration = 0.0;
  owned_integrator *endless = start_run(f->system, run);
  check_not_resumed(f, f->system, endless, HOOKE_BAD_VALUE, "duration");
  check_goes_on(f, "the last whole frame, at t = 0.04");
}

/* An outcome each, in the file's own words. */
TEST(files_say_how_the_run_ended) {
  const struct fixture *f = *prepared;
  const struct {
    int32_t outcome;
    const char *word;
  } rows[] = {{HOOKE_STOPPED, "stopped"},
              {HOOKE_DIVERGED, "diverged"},
              {HOOKE_STEP_LIMIT, "step-limit"},
              {HOOKE_SOLVER_FAILED, "solver-failed"}};
  for (int k = 0; k < 4; k++) {
    hooke_trajectory *trajectory = create(f, f->path);
    write_frames(f, trajectory, 0, 3);
    check_ok(hooke_trajectory_close(trajectory, rows[k].outcome));
    check_frames(f, 3, rows[k].word);
  }
}

TEST(nothing_to_verify) {
  const struct fixture *f = *prepared;
  hooke_measurement *verify = NULL;
  be_killed(f, 0, -1);
  check_status(hooke_verify_create(f->path, NULL, NULL, &verify), HOOKE_BAD_VALUE);
  check_message("has no frames");
  assert_null(verify);
  check_status(hooke_verify_create(NULL, NULL, NULL, &verify), HOOKE_BAD_VALUE);
  check_message("no path given");
}

AROUND_EACH(set_up, tear_down)

#else

TEST(it_is_not_in_this_build) {
  owned_system *system = rope(N);
  owned_integrator *integrator = integrator_of(system, 0.1);
  owned_state *state = start_state(system);
  hooke_trajectory *trajectory;
  check_status(hooke_trajectory_resume("out.h5", system, integrator, state, &trajectory), HOOKE_NOT_BUILT);
  assert_null(trajectory);
  check_status(hooke_trajectory_sync(NULL), HOOKE_BAD_CALL);
  check_status(hooke_record_check(NULL, 0), HOOKE_BAD_CALL);
  assert_null(hooke_trajectory_text(NULL, "run"));
}

#endif
