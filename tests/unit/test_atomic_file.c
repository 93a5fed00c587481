/* Creation of files: several writers at once, the longest names, links, and replacement of files with a mode
 * and an owner of their own. */
#include "check.h"
#include "memory_folder.h"
#include "small.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { PATH_SIZE = 512, THREADS = 4, SAVES = 200, LONGEST_NAME = 255 };

static char folder[PATH_SIZE / 4], path[PATH_SIZE];
static hooke_system *cloth;

static int set_up(void **state) {
  (void)state;
  snprintf(folder, sizeof folder, "%s/hooke-place-XXXXXX", memory_folder());
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/scene.json", folder);
  cloth = small_crumpling_cloth(10);
  return 0;
}

/* Any leftover file keeps the folder. */
static int tear_down(void **state) {
  (void)state;
  unlink(path);
  hooke_system_destroy(cloth);
  return rmdir(folder);
}

static int32_t save(const char *to) {
  return hooke_scene_write(to, cloth, "a cloth", NULL);
}

/* Bytes of the file, and whether they are a whole scene; -1 if it does not exist. */
static int64_t look(const char *at, int *whole) {
  char text[65536];
  FILE *file = fopen(at, "r");
  if (file == NULL) return -1;
  const size_t count = fread(text, 1, sizeof text, file);
  fclose(file);
  *whole = count > 2 && text[0] == '{' && memcmp(text + count - 2, "}\n", 2) == 0;
  return (int64_t)count;
}

static void check_saved(const char *at) {
  int whole = 0;
  check_ok(save(at));
  const int64_t bytes = look(at, &whole);
  assert_true(bytes > 0 && whole);
}

/* ---- several at once ---- */

static atomic_int writing, failed, broken;
static pthread_barrier_t together;

static void *save_often(void *unused) {
  (void)unused;
  pthread_barrier_wait(&together);
  for (int k = 0; k < SAVES; k++)
    failed += save(path) != HOOKE_OK;
  writing--;
  return NULL;
}

static void *look_often(void *unused) {
  int whole = 0;
  while (writing > 0)
    broken += look(path, &whole) < 0 || !whole;
  return unused;
}

TEST(one_name_takes_many_writers) {
  pthread_t thread[THREADS], reader;
  check_saved(path);
  writing = THREADS;
  assert_int_equal(pthread_barrier_init(&together, NULL, THREADS), 0);
  for (int k = 0; k < THREADS; k++)
    assert_int_equal(pthread_create(&thread[k], NULL, save_often, NULL), 0);
  assert_int_equal(pthread_create(&reader, NULL, look_often, NULL), 0);
  for (int k = 0; k < THREADS; k++)
    pthread_join(thread[k], NULL);
  pthread_join(reader, NULL);
  pthread_barrier_destroy(&together);
  assert_int_equal(failed, 0);
  assert_int_equal(broken, 0);
}

/* ---- names ---- */

TEST(the_longest_name_will_do) {
  char at[PATH_SIZE];
  const int length = snprintf(at, sizeof at, "%s/", folder);
  memset(at + length, 'x', LONGEST_NAME);
  at[length + LONGEST_NAME] = '\0';
  check_saved(at);
  check_saved(at);
  assert_int_equal(unlink(at), 0);
  at[length + LONGEST_NAME] = 'x';
  at[length + LONGEST_NAME + 1] = '\0';
  check_status(save(at), HOOKE_IO_FAILED);
  check_message("File name too long");
}

/* ---- mode and owner ---- */

static struct stat facts(const char *at) {
  struct stat there;
  assert_int_equal(stat(at, &there), 0);
  return there;
}

TEST(a_replaced_file_keeps_its_mode) {
  static const mode_t modes[] = {0600, 0640, 0444, 0666, 0755};
  for (size_t k = 0; k < sizeof modes / sizeof modes[0]; k++) {
    check_saved(path);
    assert_int_equal(chmod(path, modes[k]), 0);
    check_saved(path);
    assert_int_equal(facts(path).st_mode & 07777, modes[k]);
  }
}

TEST(a_new_file_follows_the_mask) {
  static const mode_t masks[] = {0, 022, 027, 077};
  for (size_t k = 0; k < sizeof masks / sizeof masks[0]; k++) {
    unlink(path);
    const mode_t before = umask(masks[k]);
    const int32_t status = save(path);
    assert_int_equal(umask(before), masks[k]);
    check_ok(status);
    assert_int_equal(facts(path).st_mode & 07777, 0666 & ~masks[k]);
  }
}

TEST(a_replaced_file_keeps_its_owner) {
  check_saved(path);
  if (geteuid() != 0) skip(); /* only root may give files away */
  assert_int_equal(chown(path, 1234, 5678), 0);
  assert_int_equal(chmod(path, 0640), 0);
  check_saved(path);
  const struct stat there = facts(path);
  assert_int_equal(there.st_uid, 1234);
  assert_int_equal(there.st_gid, 5678);
  assert_int_equal(there.st_mode & 07777, 0640);
}

/* ---- links ---- */

/* A link remains one, also if its target does not exist yet. */
TEST(a_link_is_written_through) {
  char link[PATH_SIZE], second[PATH_SIZE];
  struct stat there;
  snprintf(link, sizeof link, "%s/link", folder);
  snprintf(second, sizeof second, "%s/second", folder);
  unlink(path);
  assert_int_equal(symlink("scene.json", link), 0);
  assert_int_equal(symlink(link, second), 0);
  for (int k = 0; k < 2; k++) {
    check_saved(second);
    assert_true(lstat(second, &there) == 0 && S_ISLNK(there.st_mode));
    assert_true(lstat(link, &there) == 0 && S_ISLNK(there.st_mode));
    assert_true(lstat(path, &there) == 0 && S_ISREG(there.st_mode));
  }
  assert_int_equal(unlink(link), 0);
  assert_int_equal(symlink("second", link), 0); /* in a ring */
  check_status(save(link), HOOKE_IO_FAILED);
  check_message("follow the path");
  assert_int_equal(unlink(link), 0);
  assert_int_equal(unlink(second), 0);
}

AROUND_ALL(set_up, tear_down)
