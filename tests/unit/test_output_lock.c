/* The output of a run belongs to that run: a second one is refused at its start, by any function, until the
 * first has ended or died. Readers are not affected, and a fork changes nothing. */
#include "check.h"
#include "core/memory.h"
#include "io/hdf5/array_h5.h"
#include "memory_folder.h"
#include "run.h"
#include "small.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>
#include <sys/file.h>
#include <sys/wait.h>
#include <unistd.h>

/* A file system where flock() conflicts with the library's locks: a reader is refused. */
static int one_kind_of_lock;
int __real_flock(int descriptor, int how);
int __wrap_flock(int descriptor, int how);

int __wrap_flock(int descriptor, int how) {
  errno = EWOULDBLOCK;
  return one_kind_of_lock ? -1 : __real_flock(descriptor, how);
}

#if HOOKE_HAVE_HDF5

enum { PATH_SIZE = 256, FRAMES = 11, CHILDREN = 6, SIDE = 40 };
static const struct run fixed = {.method = "symplectic-euler", .step = 1e-3, .duration = 0.1, .every = 0.01};
static const char words[] = "out.h5: another run is writing this file";

static char folder[PATH_SIZE / 4], path[PATH_SIZE];
static hooke_system *cloth;
static hooke_integrator *integrator;
static hooke_state *at;

static int set_up(void **state) {
  (void)state;
  cloth = small_crumpling_cloth(SIDE); /* large enough for a thread to write */
  integrator = start_run(cloth, fixed);
  at = start_state(cloth);
  snprintf(folder, sizeof folder, "%s/hooke-output-XXXXXX", memory_folder());
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/out.h5", folder);
  return 0;
}

/* Any leftover file keeps the folder. */
static int tear_down(void **state) {
  (void)state;
  hooke_state_destroy(at);
  hooke_integrator_destroy(integrator);
  hooke_system_destroy(cloth);
  unlink(path);
  return rmdir(folder);
}

static hooke_trajectory *create(void) {
  hooke_trajectory *trajectory;
  check_ok(hooke_trajectory_create(path, cloth, integrator, "{ \"hooke\": 1 }", &trajectory));
  return trajectory;
}

static void check_taken(const char *by) {
  hooke_trajectory *trajectory;
  check_status(hooke_trajectory_create(by, cloth, integrator, NULL, &trajectory), HOOKE_IO_FAILED);
  check_message(words);
  assert_null(trajectory);
}

static void write_frames(hooke_trajectory *trajectory, int64_t from, int64_t to) {
  for (int64_t k = from; k < to; k++) {
    hooke_state_set_time(at, 0.01 * (double)k);
    check_ok(hooke_trajectory_write(trajectory, 10 * k, at));
  }
}

static void check_frames(int64_t count) {
  owned_record *record = NULL;
  check_ok(hooke_record_open(path, &record));
  assert_int_equal(hooke_record_count(record, "frames"), count);
  for (int64_t k = 0; k < count; k++)
    check_ok(hooke_record_check(record, k));
}

/* ---- during a run ---- */

TEST(nothing_else_takes_its_place) {
  char link[PATH_SIZE];
  hooke_trajectory *first = create();
  snprintf(link, sizeof link, "%s/link.h5", folder);
  assert_int_equal(symlink(path, link), 0);
  check_taken(path);
  check_taken(link);
  check_status(hooke_scene_write(path, cloth, NULL, NULL), HOOKE_IO_FAILED);
  check_message(words);
  write_frames(first, 0, FRAMES);
  check_taken(path);
  check_ok(hooke_trajectory_close(first, HOOKE_OK));
  check_frames(FRAMES);
  first = create();
  write_frames(first, 0, 3);
  check_ok(hooke_trajectory_close(first, HOOKE_STOPPED)); /* created again, shorter */
  check_frames(3);
  check_ok(hooke_scene_write(path, cloth, NULL, NULL));
  assert_int_equal(unlink(link), 0);
}

TEST(readers_come_and_go) {
  hooke_trajectory *first = create();
  write_frames(first, 0, 2);
  const int reader = open(path, O_RDONLY);
  assert_int_equal(flock(reader, LOCK_SH | LOCK_NB), 0); /* like HDF5 */
  check_frames(2);
  write_frames(first, 2, FRAMES);
  close(reader);
  check_taken(path);
  check_ok(hooke_trajectory_close(first, HOOKE_OK));
}

TEST(one_alone_goes_on_with_it) {
  owned_integrator *other = start_run(cloth, fixed), *third = start_run(cloth, fixed);
  owned_state *standing = start_state(cloth);
  hooke_trajectory *first = create(), *second = NULL, *none;
  write_frames(first, 0, 3);
  check_status(hooke_trajectory_resume(path, cloth, other, standing, &none), HOOKE_IO_FAILED);
  check_message(words);
  check_ok(hooke_trajectory_close(first, HOOKE_STOPPED));
  check_ok(hooke_trajectory_resume(path, cloth, other, standing, &second));
  check_status(hooke_trajectory_resume(path, cloth, third, standing, &none), HOOKE_IO_FAILED);
  check_message(words);
  check_taken(path);
  check_ok(hooke_trajectory_close(second, HOOKE_STOPPED));
  check_frames(3);
}

/* ---- processes ---- */

/* Starts a run when the pipe `go` is closed and reports by `out` whether it has the output; ends when `end`
 * is closed. */
static pid_t start_other(const int go[2], const int end[2], int out) {
  const pid_t child = fork();
  if (child != 0) return child;
  char unused;
  hooke_trajectory *trajectory;
  close(go[1]);
  close(end[1]);
  ssize_t got = read(go[0], &unused, 1);
  const char has = hooke_trajectory_create(path, cloth, integrator, NULL, &trajectory) == HOOKE_OK;
  got += write(out, &has, 1);
  got += read(end[0], &unused, 1);
  _exit(got == 1 ? 0 : 1);
}

static void race(void) {
  int go[2], end[2], told[2];
  pid_t child[CHILDREN];
  assert_int_equal(pipe(go) | pipe(end) | pipe(told), 0);
  for (int k = 0; k < CHILDREN; k++)
    assert_true((child[k] = start_other(go, end, told[1])) > 0);
  close(go[0]);
  close(go[1]);
  int winners = 0;
  for (int k = 0; k < CHILDREN; k++) {
    char has = 0;
    assert_int_equal(read(told[0], &has, 1), 1);
    winners += has;
  }
  assert_int_equal(winners, 1);
  check_taken(path);
  close(end[0]);
  close(end[1]);
  for (int k = 0; k < CHILDREN; k++) {
    int how;
    assert_int_equal(waitpid(child[k], &how, 0), child[k]);
    assert_int_equal(how, 0);
  }
  close(told[0]);
  close(told[1]);
}

/* Without a file, and with an older one. */
TEST(of_many_at_once_one_begins) {
  for (int k = 0; k < 4; k++) {
    if (k % 2 == 0) unlink(path);
    race();
  }
}

TEST(a_lock_dies_with_its_process) {
  int told[2];
  char unused;
  assert_int_equal(pipe(told), 0);
  const pid_t child = fork();
  if (child == 0) {
    hooke_trajectory *trajectory;
    const int has = hooke_trajectory_create(path, cloth, integrator, NULL, &trajectory) == HOOKE_OK;
    if (has && write(told[1], "", 1) == 1) pause();
    _exit(1);
  }
  close(told[1]);
  assert_int_equal(read(told[0], &unused, 1), 1);
  close(told[0]);
  check_taken(path);
  assert_int_equal(kill(child, SIGKILL), 0);
  assert_int_equal(waitpid(child, NULL, 0), child);
  check_ok(hooke_trajectory_close(create(), HOOKE_STOPPED));
}

static int is_refused_in_a_fork(hooke_trajectory *trajectory) {
  const int writes = hooke_trajectory_write(trajectory, 50, at) == HOOKE_BAD_CALL,
            syncs = hooke_trajectory_sync(trajectory) == HOOKE_BAD_CALL;
  return writes && syncs && hooke_trajectory_close(trajectory, HOOKE_OK) == HOOKE_BAD_CALL &&
         strstr(hooke_last_error(), "forked") != NULL;
}

/* The child exits through functions that would close the file, whose writing thread is its parent's, and
 * lives longer. */
TEST(a_fork_leaves_the_file_alone) {
  int end[2], told[2], how;
  char refused = 0;
  hooke_trajectory *trajectory = create();
  check_ok(hooke_trajectory_write_behind(trajectory));
  write_frames(trajectory, 0, 5);
  assert_int_equal(pipe(end) | pipe(told), 0);
  const pid_t child = fork();
  if (child == 0) {
    close(end[1]);
    refused = (char)is_refused_in_a_fork(trajectory);
    _exit(write(told[1], &refused, 1) == 1 && read(end[0], &refused, 1) == 0 ? 0 : 1);
  }
  assert_int_equal(read(told[0], &refused, 1), 1);
  assert_true(refused);
  check_taken(path);
  write_frames(trajectory, 5, FRAMES);
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  check_frames(FRAMES);
  check_ok(hooke_trajectory_close(create(), HOOKE_STOPPED)); /* although the child still lives */
  close(end[0]);
  close(end[1]);
  close(told[0]);
  close(told[1]);
  assert_int_equal(waitpid(child, &how, 0), child);
  assert_int_equal(how, 0);
}

/* ---- locks that would keep readers out ---- */

TEST(readers_come_first) {
  one_kind_of_lock = 1;
  hooke_trajectory *first = create();
  hooke_trajectory *second = create();
  one_kind_of_lock = 0;
  check_ok(hooke_trajectory_close(second, HOOKE_STOPPED));
  check_status(hooke_trajectory_close(first, HOOKE_STOPPED), HOOKE_IO_FAILED);
  check_message("another file has taken this name");
}

AROUND_ALL(set_up, tear_down)

#else

/* Without HDF5 there is no such output. */
int main(void) {
  return 0;
}

#endif
