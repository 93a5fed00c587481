/* Damaged checkpoint files: every byte changed, every truncated length, impossible numbers, files of other
 * runs, and the previous file instead of the newest. What is read is what was written, or nothing. */
#include "check.h"
#include "memory_folder.h"
#include "random.h"
#include "run.h"
#include "small.h"

#include "core/crc32.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_BYTES = 1024, PARTICLES = 3, SIZE = 3 * PARTICLES, NUMBERS = 1 + 2 * SIZE, STOP = 5 };
static const struct run fixed = {.method = "rk4", .step = 0.01, .duration = 0.2, .every = 0.02};

struct bytes {
  unsigned char at[MOST_BYTES];
  int64_t count;
};

/* ---- files ---- */

static char folder[64], path[80], previous[96];

static int set_up(void **state) {
  (void)state;
  snprintf(folder, sizeof folder, "%s/hooke-checkpoint-XXXXXX", memory_folder());
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/checkpoint", folder);
  snprintf(previous, sizeof previous, "%s.previous", path);
  return 0;
}

/* Any leftover file keeps the folder. */
static int tear_down(void **state) {
  (void)state;
  remove(path);
  remove(previous);
  return rmdir(folder);
}

static struct bytes read_bytes(const char *name) {
  struct bytes bytes;
  FILE *file = fopen(name, "rb");
  assert_non_null(file);
  bytes.count = (int64_t)fread(bytes.at, 1, MOST_BYTES, file);
  assert_true(bytes.count < MOST_BYTES);
  fclose(file);
  return bytes;
}

static void write_bytes(const char *name, const struct bytes *bytes) {
  FILE *file = fopen(name, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(bytes->at, 1, (size_t)bytes->count, file), bytes->count);
  assert_int_equal(fclose(file), 0);
}

static int is_there(const char *name) {
  return access(name, F_OK) == 0;
}

/* ---- a run ---- */

struct change {
  double mass, stiffness, rest_length, drag, gravity, moved, frequency;
  int32_t pinned, more_springs;
};
static const struct change none = {1.0, 20.0, 0.9, 0.1, -9.81, 0.0, 3.0, 1, 0};

static hooke_system *system_with(struct change c) {
  const double position[] = {0, 0, 0, 1, c.moved, 0, 2, 0, 0}, gravity[] = {0, c.gravity, 0};
  const double amplitude[] = {0, 0.1, 0};
  const int64_t ends[] = {0, 1, 1, 2, 0, 2}, last = 2;
  hooke_system *system = small_system(PARTICLES, position, NULL, c.mass, c.pinned);
  small_springs(system, c.more_springs ? 3 : 2, ends,
                (struct springs){.stiffness = c.stiffness, .rest_length = c.rest_length});
  check_ok(hooke_system_set_gravity(system, gravity));
  check_ok(hooke_system_set_drag(system, c.drag));
  check_ok(hooke_system_drive_harmonic(system, 1, &last, amplitude, c.frequency, 0.5));
  return committed(system);
}

static int32_t stop_at(int64_t step, const hooke_state *state, void *ctx) {
  (void)state;
  return step == *(const int64_t *)ctx;
}

/* A run that was stopped after `stop` steps; the file is that of the run "first". */
static void write_stopped(const hooke_system *system, struct run run, int64_t stop, double *numbers) {
  owned_integrator *integrator = start_run(system, run);
  owned_state *state = start_state(system);
  check_ok(hooke_integrator_on_step(integrator, 1, stop_at, &stop));
  check_status(hooke_integrator_run(integrator, state), HOOKE_STOPPED);
  check_ok(hooke_checkpoint_write(path, integrator, state, "first"));
  numbers[0] = hooke_state_time(state);
  memcpy(numbers + 1, hooke_state_position(state), SIZE * sizeof(double));
  memcpy(numbers + 1 + SIZE, hooke_state_velocity(state), SIZE * sizeof(double));
}

struct reader {
  hooke_system *system;
  hooke_integrator *integrator;
  hooke_state *state;
  double start[NUMBERS];
};

static struct reader reader_of(struct change change, struct run run) {
  struct reader reader = {.system = system_with(change)};
  reader.integrator = start_run(reader.system, run);
  reader.state = start_state(reader.system);
  memcpy(reader.start + 1, hooke_state_position(reader.state), SIZE * sizeof(double));
  memcpy(reader.start + 1 + SIZE, hooke_state_velocity(reader.state), SIZE * sizeof(double));
  return reader;
}

static void drop(struct reader *reader) {
  hooke_state_destroy(reader->state);
  hooke_integrator_destroy(reader->integrator);
  hooke_system_destroy(reader->system);
}

static void check_numbers(const hooke_state *state, const double *numbers) {
  const double t = hooke_state_time(state);
  check_same_bits(1, &t, numbers);
  check_same_bits(SIZE, hooke_state_position(state), numbers + 1);
  check_same_bits(SIZE, hooke_state_velocity(state), numbers + 1 + SIZE);
}

/* Refused, with nothing changed. */
static void check_refused(const struct reader *reader, const char *run, const char *message) {
  check_status(hooke_checkpoint_read(path, run, reader->integrator, reader->state), HOOKE_BAD_VALUE);
  check_message(message);
  check_message(path);
  check_numbers(reader->state, reader->start);
}

/* ---- tests ---- */

TEST(every_byte_is_watched) {
  const int all = getenv("HOOKE_LONG") != NULL;
  double numbers[NUMBERS];
  owned(drop) struct reader reader = reader_of(none, fixed);
  write_stopped(reader.system, fixed, STOP, numbers);
  remove(previous);
  const struct bytes good = read_bytes(path);
  assert_int_equal(good.count, 264 + 8 * (NUMBERS - 1) + 4);
  for (int64_t k = 0; k < good.count; k++) {
    for (int change = 1; change < 256; change = all ? change + 1 : 2 * change) {
      struct bytes bad = good;
      bad.at[k] = (unsigned char)(bad.at[k] ^ change);
      write_bytes(path, &bad);
      check_refused(&reader, NULL, path);
    }
  }
  write_bytes(path, &good);
  check_ok(hooke_checkpoint_read(path, "first", reader.integrator, reader.state));
  check_numbers(reader.state, numbers);
}

TEST(every_length_is_watched) {
  double numbers[NUMBERS];
  struct reader reader = reader_of(none, fixed);
  write_stopped(reader.system, fixed, STOP, numbers);
  remove(previous);
  const struct bytes good = read_bytes(path);
  for (int64_t count = 0; count < good.count + 40; count++) {
    if (count == good.count) continue;
    struct bytes bad = good;
    memset(bad.at + good.count, 0, MOST_BYTES - (size_t)good.count);
    bad.count = count;
    write_bytes(path, &bad);
    check_refused(&reader, NULL, path);
  }
  drop(&reader);
}

static void put_check_value(struct bytes *bytes) {
  const uint32_t value = hk_crc32(0, bytes->at, bytes->count - 4);
  for (int k = 0; k < 4; k++)
    bytes->at[bytes->count - 4 + k] = (unsigned char)(value >> 8 * k);
}

TEST(impossible_numbers_are_refused) {
  struct random_source random = {7};
  double numbers[NUMBERS];
  owned(drop) struct reader reader = reader_of(none, fixed);
  write_stopped(reader.system, fixed, STOP, numbers);
  remove(previous);
  const struct bytes good = read_bytes(path);
  /* t0, t, k and frames must be consistent; sizes and check values must match the problem */
  const int64_t places[] = {8, 12, 16, 24, 32, 36, 144, 192, 200};
  for (size_t p = 0; p < sizeof places / sizeof places[0]; p++) {
    for (int tries = 0; tries < 50; tries++) {
      struct bytes bad = good;
      for (int k = 0; k < (places[p] < 16 || (places[p] >= 32 && places[p] < 40) ? 4 : 8); k++)
        bad.at[places[p] + k] = (unsigned char)(tries == 0 ? 0xff : random_whole(&random, 0, 255));
      put_check_value(&bad);
      write_bytes(path, &bad);
      check_refused(&reader, NULL, path);
    }
  }
  struct bytes bad = good;
  memset(bad.at + 264, 0xff, 8); /* NaN */
  put_check_value(&bad);
  write_bytes(path, &bad);
  check_refused(&reader, NULL, "position[0][0]");
}

TEST(other_problems_are_refused) {
  struct change other[] = {none, none, none, none, none, none, none, none, none};
  other[0].mass = 1.1;
  other[1].stiffness = 21.0;
  other[2].rest_length = 0.8;
  other[3].drag = 0.2;
  other[4].gravity = 9.81;
  other[5].moved = 0.1;
  other[6].frequency = 4.0;
  other[7].pinned = 0;
  other[8].more_springs = 1;
  double numbers[NUMBERS];
  owned(drop) struct reader writer = reader_of(none, fixed);
  write_stopped(writer.system, fixed, STOP, numbers);
  for (size_t k = 0; k < sizeof other / sizeof other[0]; k++) {
    owned(drop) struct reader reader = reader_of(other[k], fixed);
    check_status(hooke_checkpoint_read(path, NULL, reader.integrator, reader.state), HOOKE_BAD_VALUE);
    check_message("another scene");
  }
  struct run runs[] = {fixed, fixed, fixed, fixed};
  runs[0].step = 0.005;
  runs[1].duration = 0.4;
  runs[2].every = 0.04;
  runs[3].checkpoint = 0.1;
  for (size_t k = 0; k < sizeof runs / sizeof runs[0]; k++) {
    owned(drop) struct reader reader = reader_of(none, runs[k]);
    check_refused(&reader, NULL, "other options");
  }
  struct run verlet = fixed;
  verlet.method = "verlet";
  struct reader reader = reader_of(none, verlet);
  check_refused(&reader, NULL, "by rk4, not by verlet");
  drop(&reader);
  check_refused(&writer, "second", "another run");
  struct run threads = fixed;
  threads.threads = 2;
  reader = reader_of(none, threads);
  check_ok(hooke_checkpoint_read(path, "first", reader.integrator, reader.state));
  check_numbers(reader.state, numbers);
  drop(&reader);
}

TEST(the_one_before_stands_in) {
  double before[NUMBERS], newest[NUMBERS];
  owned(drop) struct reader reader = reader_of(none, fixed);
  remove(path);
  remove(previous);
  write_stopped(reader.system, fixed, STOP, before);
  assert_false(is_there(previous));
  write_stopped(reader.system, fixed, STOP + 2, newest);
  const struct bytes good = read_bytes(path);
  check_ok(hooke_checkpoint_read(path, "first", reader.integrator, reader.state));
  check_numbers(reader.state, newest);
  for (int64_t count = 0; count < good.count; count += 50) {
    struct bytes torn = good;
    torn.count = count;
    write_bytes(path, &torn);
    check_ok(hooke_checkpoint_read(path, "first", reader.integrator, reader.state));
    check_numbers(reader.state, before);
  }
  remove(path); /* between the two renames */
  check_ok(hooke_checkpoint_read(path, "first", reader.integrator, reader.state));
  check_numbers(reader.state, before);
  check_status(hooke_checkpoint_read(path, "second", reader.integrator, reader.state), HOOKE_BAD_VALUE);
  check_message("another run");
  /* an intact file of another run is not replaced by an older one */
  write_bytes(path, &good);
  check_status(hooke_checkpoint_read(path, "second", reader.integrator, reader.state), HOOKE_BAD_VALUE);
  struct bytes torn = good;
  torn.at[300] ^= 1;
  write_bytes(path, &torn);
  write_bytes(previous, &torn);
  check_status(hooke_checkpoint_read(path, "first", reader.integrator, reader.state), HOOKE_BAD_VALUE);
  check_message(previous);
  remove(path);
  remove(previous);
  check_status(hooke_checkpoint_read(path, "first", reader.integrator, reader.state), HOOKE_IO_FAILED);
  check_message("No such file");
}

TEST(only_a_place_of_the_run_is_written) {
  const struct run adaptive = {.method = "cvode-adams", .duration = 0.2};
  struct reader reader = reader_of(none, fixed);
  remove(path);
  check_status(hooke_checkpoint_write(path, reader.integrator, reader.state, NULL), HOOKE_BAD_CALL);
  check_status(hooke_integrator_resume(reader.integrator, reader.state), HOOKE_BAD_CALL);
  check_ok(hooke_integrator_run(reader.integrator, reader.state));
  check_ok(hooke_checkpoint_write(path, reader.integrator, reader.state, NULL));
  char longest[80];
  memset(longest, 'x', sizeof longest);
  longest[64] = '\0';
  check_status(hooke_checkpoint_write(path, reader.integrator, reader.state, longest), HOOKE_BAD_VALUE);
  longest[63] = '\0';
  check_ok(hooke_checkpoint_write(path, reader.integrator, reader.state, longest));
  check_ok(hooke_checkpoint_read(path, longest, reader.integrator, reader.state));
  hooke_state_set_time(reader.state, 0.1);
  check_status(hooke_checkpoint_write(path, reader.integrator, reader.state, NULL), HOOKE_BAD_VALUE);
  check_message("last step");
  check_status(hooke_integrator_resume(reader.integrator, reader.state), HOOKE_BAD_CALL);
  check_status(hooke_checkpoint_write("no/such/folder", reader.integrator, reader.state, NULL),
               HOOKE_BAD_VALUE);
  drop(&reader);
  if (!hooke_method_is_built(adaptive.method)) return;
  reader = reader_of(none, adaptive);
  check_ok(hooke_integrator_run(reader.integrator, reader.state));
  check_status(hooke_checkpoint_write(path, reader.integrator, reader.state, NULL), HOOKE_UNSUITED);
  drop(&reader);
}

/* The older file stays, and no other file is left. */
TEST(a_failed_write_harms_nothing) {
  double numbers[NUMBERS];
  owned(drop) struct reader writer = reader_of(none, fixed), reader = reader_of(none, fixed);
  write_stopped(writer.system, fixed, STOP, numbers);
  check_ok(hooke_integrator_run(writer.integrator, writer.state));
  check_status(hooke_checkpoint_write("no/such/folder", writer.integrator, writer.state, NULL),
               HOOKE_IO_FAILED);
  check_message("no/such/folder");
  remove(previous);
  assert_int_equal(mkdir(previous, 0700), 0); /* there the newest cannot be kept */
  check_status(hooke_checkpoint_write(path, writer.integrator, writer.state, NULL), HOOKE_IO_FAILED);
  check_message("keep the file");
  check_ok(hooke_checkpoint_read(path, "first", reader.integrator, reader.state));
  check_numbers(reader.state, numbers);
  remove(previous);
}

static atomic_int watched, missed;

static void *look_often(void *unused) {
  while (watched)
    missed += !is_there(path);
  return unused;
}

/* The name always exists while one file replaces the other. */
TEST(there_is_one_at_all_times) {
  double numbers[NUMBERS];
  pthread_t watcher;
  owned(drop) struct reader writer = reader_of(none, fixed);
  write_stopped(writer.system, fixed, STOP, numbers);
  check_ok(hooke_integrator_run(writer.integrator, writer.state));
  watched = 1;
  assert_int_equal(pthread_create(&watcher, NULL, look_often, NULL), 0);
  for (int k = 0; k < 2000; k++)
    check_ok(hooke_checkpoint_write(path, writer.integrator, writer.state, "first"));
  watched = 0;
  pthread_join(watcher, NULL);
  assert_int_equal(missed, 0);
  assert_true(is_there(previous));
}

TEST(a_pipe_is_not_waited_for) {
  owned(drop) struct reader reader = reader_of(none, fixed);
  remove(path);
  remove(previous);
  assert_int_equal(mkfifo(path, 0600), 0);
  check_refused(&reader, "first", "is not a regular file");
}

AROUND_ALL(set_up, tear_down)
