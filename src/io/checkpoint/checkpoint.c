/* Checkpoints: written and read as a whole or not at all. */
#include "hooke/checkpoint.h"

#include "core/crc32.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "io/file/bytes.h"
#include "io/checkpoint/checkpoint_file.h"
#include "io/checkpoint/checkpoint_form.h"
#include "io/file/atomic_file.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

/* ---- writing ---- */

static int32_t find_place(const hooke_integrator *it, const hooke_state *state, struct hk_standing *standing,
                          const hooke_state **from) {
  if (it->phase == HOOKE_NOT_BEGUN)
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is no run to write a checkpoint of: it has not begun");
  if (it->method->adaptive && it->restart.state == NULL) {
    return hk_fail(HOOKE_UNSUITED, "checkpoint",
                   "is missing: %s goes on from the times of this option alone; give one [s]",
                   it->method->name);
  }
  *standing = it->method->adaptive ? it->restart.standing : it->standing;
  *from = it->method->adaptive ? it->restart.state : state;
  const double t = standing->t;
  const int32_t status = hk_integrator_check_state(it, *from);
  if (status != HOOKE_OK) return status;
  if (memcmp(&t, (*from)->t, sizeof t) != 0) {
    return hk_fail(HOOKE_BAD_VALUE, "state", "is not the one after the last step, at t = %.6g s", t);
  }
  if (hk_all_finite(((*from)->has_v ? 2 : 1) * (*from)->size, (*from)->q)) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "state", "is not finite; nobody can go on from there");
}

/* Returns 0 or an errno. */
static int write_all(int descriptor, const struct hk_checkpoint_header *header, const hooke_state *state) {
  const int64_t bytes = (state->has_v ? 16 : 8) * state->size;
  const uint32_t check = hk_crc32(hk_crc32(0, header, HOOKE_CHECKPOINT_HEADER), state->q, bytes);
  int error = hk_bytes_write(descriptor, 0, HOOKE_CHECKPOINT_HEADER, header);
  if (error == 0) error = hk_bytes_write(descriptor, HOOKE_CHECKPOINT_HEADER, bytes, state->q);
  return error ? error : hk_bytes_write(descriptor, HOOKE_CHECKPOINT_HEADER + bytes, sizeof check, &check);
}

int32_t hooke_checkpoint_write(const char *path, const hooke_integrator *it, const hooke_state *state,
                               const char *run) {
  HOOKE_KEEP_ERRNO;
  struct hk_standing standing;
  const hooke_state *from = NULL;
  int32_t status = find_place(it, state, &standing, &from);
  if (status == HOOKE_OK && run && strlen(run) >= HOOKE_CHECKPOINT_RUN)
    status = hk_fail(HOOKE_BAD_VALUE, "run", "is longer than %d bytes", HOOKE_CHECKPOINT_RUN - 1);
  if (status != HOOKE_OK) return status;
  struct hk_checkpoint_header header;
  hk_checkpoint_describe(it, &standing, run, &header);
  struct hk_atomic_file file;
  char *previous = NULL;
  status = hk_atomic_file_make(path, &file);
  if (status == HOOKE_OK) status = hk_file_beside(file.path, ".previous", &previous);
  const int error = status == HOOKE_OK ? write_all(file.descriptor, &header, from) : 0;
  if (error) status = hk_file_fail(path, "write", error);
  if (status == HOOKE_OK) status = hk_atomic_file_commit(&file, previous);
  hk_free(previous);
  hk_atomic_file_release(&file);
  return status;
}

/* ---- reading ---- */

/* A file that was read: its label, and a state of the right size with its numbers. */
struct found {
  struct hk_checkpoint_header header;
  hooke_state *state;
  enum hk_checkpoint_finding finding;
};

static int32_t damaged(const char *path, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: %s", path, what);
}

/* Nothing is allocated before the length of the file is known to match the size of the problem. */
static int32_t read_open(const char *path, int file, const hooke_integrator *it, struct found *found) {
  struct hk_os_file there;
  uint32_t stored = 0;
  if (hk_os_look_open(file, &there) != 0) return hk_file_fail(path, "read the file", errno);
  if (hk_bytes_read(file, 0, HOOKE_CHECKPOINT_HEADER, &found->header) != 0)
    return damaged(path, "is cut off");
  found->header.standing.count.zero_passages = -1;
  const char *damage = hk_checkpoint_damage(&found->header, there.bytes);
  if (damage) return damaged(path, damage);
  if (found->header.size != it->size || (int)(found->header.kind & 1) != (it->system != NULL)) {
    found->finding = HOOKE_CHECKPOINT_OTHER;
    return damaged(path, "is of another scene");
  }
  const int32_t status = hk_state_create_sized(hk_integrator_numbers(it), it->system != NULL, &found->state);
  if (status != HOOKE_OK) return status;
  const int64_t bytes = (found->state->has_v ? 16 : 8) * found->header.size;
  double *q = found->state->q;
  if (hk_bytes_read(file, HOOKE_CHECKPOINT_HEADER, bytes, q) != 0 ||
      hk_bytes_read(file, HOOKE_CHECKPOINT_HEADER + bytes, sizeof stored, &stored) != 0)
    return damaged(path, "is cut off");
  if (hk_crc32(hk_crc32(0, &found->header, HOOKE_CHECKPOINT_HEADER), q, bytes) != stored)
    return damaged(path, "is damaged: its check value is not that of its bytes");
  *found->state->t = found->header.standing.t;
  return HOOKE_OK;
}

static int32_t read_file(const char *path, const char *run, const hooke_integrator *it, struct found *found) {
  const int file = hk_file_open(path);
  found->finding = file < 0 && errno == ENOENT ? HOOKE_CHECKPOINT_ABSENT : HOOKE_CHECKPOINT_DAMAGED;
  if (file < 0)
    return errno == EINVAL || errno == EISDIR ? damaged(path, "is not a regular file")
                                              : hk_file_fail(path, "open the checkpoint", errno);
  int32_t status = read_open(path, file, it, found);
  close(file);
  if (status != HOOKE_OK) return status;
  if (run && strcmp(found->header.run, run) != 0) {
    found->finding = HOOKE_CHECKPOINT_OTHER_RUN;
    return damaged(path, "is of another run");
  }
  found->finding = HOOKE_CHECKPOINT_OTHER;
  status = hk_checkpoint_check(path, &found->header, it);
  if (status == HOOKE_OK) found->finding = HOOKE_CHECKPOINT_FOUND;
  return status;
}

static void drop(struct found *found) {
  hooke_state_destroy(found->state);
  found->state = NULL;
}

/* The newest one or, if that is missing or damaged, the previous one. */
static int32_t find(const char *path, const char *run, const hooke_integrator *it, struct found *found) {
  char *previous = NULL, first[512];
  int32_t status = read_file(path, run, it, found);
  const enum hk_checkpoint_finding newest = found->finding;
  if (newest == HOOKE_CHECKPOINT_FOUND || newest >= HOOKE_CHECKPOINT_OTHER_RUN || status == HOOKE_NO_MEMORY)
    return status;
  snprintf(first, sizeof first, "%s", hooke_last_error());
  drop(found);
  const int32_t second = hk_file_beside(path, ".previous", &previous);
  struct hk_os_file older;
  const int there = second == HOOKE_OK && hk_os_look(previous, &older) == 0;
  if (there) {
    status = read_file(previous, run, it, found);
    if (status != HOOKE_OK) hk_fail_before(status, "%s; ", first);
  } else {
    hk_fail(status, NULL, "%s", first);
  }
  hk_free(previous);
  return second == HOOKE_OK ? status : second;
}

int32_t hk_checkpoint_take(const char *path, const char *run, hooke_integrator *it, hooke_state *state,
                           enum hk_checkpoint_finding *finding) {
  HOOKE_KEEP_ERRNO;
  *finding = HOOKE_CHECKPOINT_OTHER;
  struct found found = {.state = NULL};
  int32_t status = hk_integrator_check_state(it, state);
  if (status != HOOKE_OK) return status;
  status = find(path, run, it, &found);
  *finding = found.finding;
  if (status == HOOKE_OK) {
    hk_recent_set_first(&it->recent, NULL);
    status = hk_integrator_stand(it, &found.header.standing, found.state);
    if (status != HOOKE_OK) hk_fail_before(status, "%s: ", path);
  }
  if (status == HOOKE_OK) {
    it->phase = HOOKE_AT_CHECKPOINT;
    hooke_state_copy(found.state, state);
  }
  drop(&found);
  return status;
}

int32_t hooke_checkpoint_read(const char *path, const char *run, hooke_integrator *it, hooke_state *state) {
  enum hk_checkpoint_finding finding;
  return hk_checkpoint_take(path, run, it, state, &finding);
}

void hk_checkpoint_remove(const char *path) {
  char *previous = NULL;
  hk_os_remove(path);
  if (hk_file_beside(path, ".previous", &previous) == HOOKE_OK) hk_os_remove(previous);
  hk_free(previous);
}
