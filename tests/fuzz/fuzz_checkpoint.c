/* Checkpoints: the file, and sometimes the one before it, are any bytes. Either the run continues from
 * numbers that are in the file, or a message says why not and nothing is changed.
 *
 * The first byte selects the calls, the rest is the file. Most inputs have a matching check value.
 *
 * Lines of: src/io/checkpoint/checkpoint.c
 * Longest input: 640 */
#include "fuzz.h"

#include "hooke.h"

#include "core/crc32.h"
#include "io/checkpoint/checkpoint_file.h"
#include "memory_folder.h"

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

/* Bits of the first byte. `BEFORE`: the previous file exists, and is valid; `ONLY_BEFORE`: it is the only
 * one. */
enum { OF_ANY_RUN = 1, BEFORE = 2, ONLY_BEFORE = 4, SHORT_METHOD = 8, GO_ON = 16 };

enum {
  PARTICLES = 3,
  NUMBERS = 3 * PARTICLES,
  WHOLE = HOOKE_CHECKPOINT_HEADER + 16 * NUMBERS + HOOKE_CHECKPOINT_END
};

static struct {
  char folder[64], path[80], previous[96], next[80];
  hooke_system *system;
  hooke_integrator *integrator[2]; /* of two methods */
  hooke_state *state;
  double begin[2 * NUMBERS];
  uint8_t file[WHOLE];
  int descriptor[2];
} own;

static void require_ok(int32_t status) {
  hooke_fuzz_require(status == HOOKE_OK, "what is there before an input");
}

/* ---- set-up ---- */

static hooke_system *new_system(void) {
  static const double q[NUMBERS] = {0, 0, 0, 1, 0, 0, 2, 0.5, 0}, mass = 1.0;
  static const int64_t ends[4] = {0, 1, 1, 2}, pinned = 0;
  hooke_system *system = NULL;
  owned_options *options = NULL;
  require_ok(hooke_system_create(&system));
  require_ok(hooke_system_add_particles(system, PARTICLES, q, NULL, 1, &mass, NULL));
  require_ok(hooke_system_pin(system, 1, &pinned));
  require_ok(hooke_options_create("springs", &options));
  require_ok(hooke_options_set_number(options, "stiffness", 10.0));
  require_ok(hooke_system_add_springs(system, NULL, 2, ends, options));
  require_ok(hooke_system_set_gravity(system, (const double[]){0.0, -9.81, 0.0}));
  require_ok(hooke_system_commit(system));
  return system;
}

static hooke_integrator *new_integrator(const char *method) {
  owned_options *options = NULL;
  hooke_integrator *integrator = NULL;
  require_ok(hooke_options_create("run", &options));
  require_ok(hooke_options_set_text(options, "method", method));
  require_ok(hooke_options_set_number(options, "step", 0.01));
  require_ok(hooke_options_set_number(options, "every", 0.02));
  require_ok(hooke_options_set_number(options, "duration", 0.08));
  require_ok(hooke_integrator_create(own.system, options, &integrator));
  return integrator;
}

static int32_t stop_half_way(int64_t step, const hooke_state *state, void *ctx) {
  (void)state, (void)ctx;
  return step == 4;
}

static void remove_folder(void) {
  unlink(own.path);
  unlink(own.previous);
  hk_checkpoint_remove(own.next);
  rmdir(own.folder);
}

static int open_file(const char *path) {
  const int descriptor = open(path, O_RDWR | O_CREAT, 0600);
  hooke_fuzz_require(descriptor >= 0, path);
  return descriptor;
}

static void begin(void) {
  snprintf(own.folder, sizeof own.folder, "%s/hooke-fuzz-XXXXXX", memory_folder());
  hooke_fuzz_require(mkdtemp(own.folder) != NULL, "a folder");
  atexit(remove_folder);
  snprintf(own.path, sizeof own.path, "%s/run.checkpoint", own.folder);
  snprintf(own.previous, sizeof own.previous, "%s.previous", own.path);
  snprintf(own.next, sizeof own.next, "%s/next.checkpoint", own.folder);
  own.system = new_system();
  own.integrator[0] = new_integrator("symplectic-euler");
  own.integrator[1] = new_integrator("verlet");
  require_ok(hooke_state_create(own.system, &own.state));
  require_ok(hooke_integrator_on_step(own.integrator[0], 1, stop_half_way, NULL));
  hooke_fuzz_require(hooke_integrator_run(own.integrator[0], own.state) == HOOKE_STOPPED, "a run that stops");
  require_ok(hooke_integrator_on_step(own.integrator[0], 1, NULL, NULL));
  require_ok(hooke_checkpoint_write(own.path, own.integrator[0], own.state, "this run"));
  memcpy(own.begin, hooke_state_position(own.state), NUMBERS * sizeof(double));
  memcpy(own.begin + NUMBERS, hooke_state_velocity(own.state), NUMBERS * sizeof(double));
  own.descriptor[0] = open_file(own.path);
  own.descriptor[1] = open_file(own.previous);
  hooke_fuzz_require(read(own.descriptor[0], own.file, WHOLE) == WHOLE, "a checkpoint");
}

/* ---- one input ---- */

static void put(int which, const uint8_t *bytes, size_t size) {
  hooke_fuzz_require(pwrite(own.descriptor[which], bytes, size, 0) == (ssize_t)size &&
                         ftruncate(own.descriptor[which], (off_t)size) == 0,
                     "a file");
}

/* The numbers returned are the last ones of the file, to the bit. */
static void check_numbers(const uint8_t *bytes, size_t size) {
  double found[2 * NUMBERS], expected[2 * NUMBERS];
  memcpy(found, hooke_state_position(own.state), NUMBERS * sizeof(double));
  memcpy(found + NUMBERS, hooke_state_velocity(own.state), NUMBERS * sizeof(double));
  hooke_fuzz_require(size == WHOLE, "a file of another length");
  memcpy(expected, bytes + HOOKE_CHECKPOINT_HEADER, sizeof expected);
  hooke_fuzz_require(memcmp(found, expected, sizeof found) == 0, "the numbers of the file");
  for (int k = 0; k < 2 * NUMBERS; k++)
    hooke_fuzz_require(isfinite(found[k]), "a number that is none");
}

/* A checkpoint that was read can be written and read again. */
static void go_around(hooke_integrator *integrator) {
  double read[2 * NUMBERS];
  memcpy(read, hooke_state_position(own.state), NUMBERS * sizeof(double));
  memcpy(read + NUMBERS, hooke_state_velocity(own.state), NUMBERS * sizeof(double));
  const double time = hooke_state_time(own.state);
  hooke_fuzz_require(hooke_checkpoint_write(own.next, integrator, own.state, "next") == HOOKE_OK,
                     "a checkpoint where a run stands");
  hooke_fuzz_require(hooke_checkpoint_read(own.next, "next", integrator, own.state) == HOOKE_OK,
                     "what was written can be read");
  hooke_fuzz_require(time == hooke_state_time(own.state) &&
                         memcmp(read, hooke_state_position(own.state), sizeof read / 2) == 0 &&
                         memcmp(read + NUMBERS, hooke_state_velocity(own.state), sizeof read / 2) == 0,
                     "written and read again");
}

static void go_on(hooke_integrator *integrator) {
  const int32_t status = hooke_integrator_resume(integrator, own.state);
  hooke_fuzz_require(status == HOOKE_OK || status == HOOKE_DIVERGED || status == HOOKE_SOLVER_FAILED,
                     "a run that goes on");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  hooke_fuzz_begin();
  if (own.system == NULL) begin();
  if (size == 0) return 0;
  const int what = data[0];
  const uint8_t *file = data + 1;
  size_t length = size - 1;
  put(0, file, what & ONLY_BEFORE ? 0 : length);
  put(1, what & BEFORE ? own.file : file, what & BEFORE ? WHOLE : what & ONLY_BEFORE ? length : 0);
  memcpy(hooke_state_position(own.state), own.begin, NUMBERS * sizeof(double));
  memcpy(hooke_state_velocity(own.state), own.begin + NUMBERS, NUMBERS * sizeof(double));
  hooke_state_set_time(own.state, -1.0);
  hooke_integrator *integrator = own.integrator[(what & SHORT_METHOD) != 0];
  const int32_t status =
      hooke_checkpoint_read(own.path, what & OF_ANY_RUN ? NULL : "this run", integrator, own.state);
  hooke_fuzz_require(status <= HOOKE_OK, "an outcome of a run");
  if (length > HOOKE_CHECKPOINT_HEADER && memcmp(file, own.file, 12) == 0) hooke_fuzz_is_past_syntax();
  if (status != HOOKE_OK) {
    hooke_fuzz_require_message();
    hooke_fuzz_require(hooke_state_time(own.state) == -1.0 &&
                           memcmp(own.begin, hooke_state_position(own.state), NUMBERS * sizeof(double)) == 0,
                       "a state besides a failure");
    return 0;
  }
  hooke_fuzz_is_accepted();
  const int taken_before =
      (what & BEFORE) && memcmp(hooke_state_position(own.state), own.begin, sizeof own.begin / 2) == 0;
  if (!taken_before) check_numbers(file, length);
  if (hooke_fuzz_is_chosen(data, size, 64)) go_around(integrator);
  if (what & GO_ON) go_on(integrator);
  return 0;
}

/* ---- mutating ---- */

static void put_check(uint8_t *file, size_t length) {
  if (length <= HOOKE_CHECKPOINT_END) return;
  const uint32_t check = hk_crc32(0, file, (int64_t)(length - HOOKE_CHECKPOINT_END));
  for (int k = 0; k < HOOKE_CHECKPOINT_END; k++)
    file[length - HOOKE_CHECKPOINT_END + (size_t)k] = (uint8_t)(check >> 8 * k);
}

/* A single field: those of the label have 4 or 8 bytes each, aligned to 4. */
static void change_field(uint8_t *file, size_t length, uint32_t drawn) {
  static const double number[] = {0.0, -0.0, 1.0, 0.04, 0.02, -1.0, 1e300, INFINITY, NAN, 5e-324, 0.08, 0.05};
  static const int64_t whole[] = {0, 1,  2,         3,         4,         5,     8,
                                  9, -1, INT64_MAX, INT64_MIN, INT32_MAX, WHOLE, NUMBERS};
  const size_t at = drawn / 64 % (length / 4) * 4;
  if (at + 8 > length) return;
  if (drawn % 3 == 0)
    memcpy(file + at, &number[drawn / 3 % (sizeof number / sizeof number[0])], 8);
  else if (drawn % 3 == 1)
    memcpy(file + at, &whole[drawn / 3 % (sizeof whole / sizeof whole[0])], 8);
  else
    LLVMFuzzerMutate(file + at, 8, 8);
}

/* Half of them start as the whole file; the check value fits, except for one in eight. */
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
  uint32_t drawn = seed * 2654435761u;
  if (own.system == NULL) begin();
  if ((size < 2 || drawn % 16 == 0) && most > WHOLE) {
    data[0] = (uint8_t)(drawn >> 8);
    memcpy(data + 1, own.file, WHOLE);
    size = WHOLE + 1;
  }
  for (uint32_t times = 1 + (drawn >> 20) % 3; times > 0 && size > 9;
       times--, drawn = drawn * 1664525u + 1013904223u) {
    if (drawn >> 24 < 16)
      data[0] = (uint8_t)(drawn >> 16);
    else if (drawn >> 24 < 32)
      size = 1 + LLVMFuzzerMutate(data + 1, size - 1, most - 1);
    else
      change_field(data + 1, size - 1, drawn >> 8);
  }
  if (size > 1 && drawn >> 29 != 0) put_check(data + 1, size - 1);
  return size;
}
