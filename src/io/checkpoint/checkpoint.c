/* Checkpoints: written and read as a whole or not at all. */
#include "io/checkpoint/checkpoint_file.h"

#include "core/crc32.h"
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "core/table/option.h"
#include "integrate/integrator.h"
#include "io/file/atomic_file.h"
#include "io/file/bytes.h"
#include "model/callbacks.h"
#include "model/check_value.h"
#include "model/generalized.h"

#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static const char MAGIC[8] = {'h', 'o', 'o', 'k', 'e', 'C', 'K', 'P'};
enum { VERSION = 1, METHOD_SIZE = 32, RUN_SIZE = 64 };

/* Its first HOOKE_CHECKPOINT_HEADER bytes are those of the file. */
struct header {
  char magic[8];
  uint32_t version, kind; /* without callbacks also where an older version wrote it */
  int64_t length, size;
  uint32_t system, options;
  char method[METHOD_SIZE], run[RUN_SIZE];
  struct hk_standing standing;
};
_Static_assert(offsetof(struct header, standing.count.zero_passages) == HOOKE_CHECKPOINT_HEADER,
               "members lie as in the file");

/* ---- identity of the problem ---- */

uint32_t hk_checkpoint_options(const hooke_options *options) {
  uint32_t value = 0;
  for (int64_t k = 0; k < hooke_options_row_count(options); k++) {
    const char *name = hooke_options_row(options, k, "name"), *text = hooke_options_text(options, name);
    const double number = hooke_options_number(options, name);
    if (strcmp(name, "threads") == 0 || (isnan(number) && text[0] == '\0')) continue;
    value = hk_crc32(value, name, (int64_t)strlen(name) + 1);
    if (isnan(number))
      value = hk_crc32(value, text, (int64_t)strlen(text) + 1);
    else
      value = hk_crc32(value, &number, sizeof number);
  }
  return value;
}

static int64_t length_of(int64_t size, uint32_t kind) {
  return HOOKE_CHECKPOINT_HEADER + (kind & 1 ? 16 : 8) * size + HOOKE_CHECKPOINT_END;
}

/* Header for the run of an integrator at `standing`. */
static void describe(const hooke_integrator *it, const struct hk_standing *standing, const char *run,
                     struct header *h) {
  memset(h, 0, sizeof *h);
  memcpy(h->magic, MAGIC, sizeof MAGIC);
  h->version = VERSION;
  if (it->system) h->kind = 1 | (uint32_t)hk_system_calls_back(it->system) << 1;
  h->size = it->size;
  h->length = length_of(h->size, h->kind);
  h->system = it->system ? hk_system_check_value(it->system) : 0;
  if (it->system && it->system->force_scale)
    h->system = hk_crc32(h->system, it->system->force_scale, hk_system_numbers(it->system) * 8);
  h->options = hk_checkpoint_options(it->options);
  snprintf(h->method, sizeof h->method, "%s", it->method->name);
  snprintf(h->run, sizeof h->run, "%s", run ? run : "");
  h->standing = *standing;
}

/* NULL, or the fault of a header of a file of `length` bytes. */
static const char *find_damage(const struct header *h, int64_t length) {
  if (memcmp(h->magic, MAGIC, sizeof MAGIC) != 0) return "is no checkpoint of hooke";
  if (h->version != VERSION) return "is of a version that this library does not read";
  if (h->length != length) return "is not as long as it was written";
  if (h->kind >> 1 > HOOKE_CALLS_ALL || h->size < 0 || h->size > length ||
      length_of(h->size, h->kind) != length || h->method[METHOD_SIZE - 1] != '\0' ||
      h->run[RUN_SIZE - 1] != '\0')
    return "is damaged";
  return NULL;
}

/* ---- checks ---- */

/* Well below the overflow of counts. */
static int are_counts(const struct hk_standing *s) {
  int64_t counts[9];
  int fit = 1;
  memcpy(counts, (const char *)s + offsetof(struct hk_standing, k), sizeof counts);
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++)
    fit &= counts[k] >= 0 && counts[k] <= INT64_C(1) << 62;
  return fit;
}

static int is_possible(const hooke_integrator *it, const struct hk_standing *s) {
  const struct hk_schedule *schedule = &it->schedule;
  const int planned = schedule->frames > 0;
  const double t = s->t0 + (double)s->k * schedule->step;
  if (!isfinite(s->t0) || !isfinite(s->t) || !are_counts(s) || !(s->wall_seconds >= 0.0)) return 0;
  if (planned && s->frames > schedule->frames) return 0;
  if (it->method->adaptive)
    return s->t >= s->t0 && (!planned || s->t <= s->t0 + schedule->duration) && (s->k > 0) == (s->t > s->t0);
  if (memcmp(&t, &s->t, sizeof t) != 0) return 0;
  if (!planned || s->frames == 0) return !planned || s->k == 0 || schedule->frame_steps > 0;
  /* one may be missing if the run was stopped just before it */
  const int64_t before = hk_schedule_frames_before(schedule, s->k);
  return s->k <= schedule->steps &&
         (s->frames == before || (s->frames == before + 1 && hk_schedule_has_frame(schedule, s->k)));
}

/* HOOKE_BAD_VALUE for one of another problem or other options, or with impossible numbers. */
static int32_t check_match(const char *path, const struct header *h, const hooke_integrator *it) {
  struct header own;
  describe(it, &h->standing, NULL, &own);
  const int32_t calls = (int32_t)(h->kind >> 1);
  const int32_t status = calls ? hk_callbacks_check(calls, (int32_t)(own.kind >> 1)) : HOOKE_OK;
  if (status != HOOKE_OK) return hk_fail_before(status, "%s: ", path);
  if (h->size != own.size || (h->kind & 1) != (own.kind & 1) || h->system != own.system)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of another scene", path);
  if (strcmp(h->method, own.method) != 0) {
    char shown[HOOKE_OPTION_SHOWN];
    hk_option_show(h->method, (int64_t)strlen(h->method), shown);
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of a run by %s, not by %s", path, shown, own.method);
  }
  if (h->options != own.options)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of a run with other options; only threads may be changed",
                   path);
  if (!is_possible(it, &h->standing))
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is damaged: it is at a place where no such run comes by",
                   path);
  return HOOKE_OK;
}

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
static int write_all(int descriptor, const struct header *header, const hooke_state *state) {
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
  if (status == HOOKE_OK && run && strlen(run) >= RUN_SIZE)
    status = hk_fail(HOOKE_BAD_VALUE, "run", "is longer than %d bytes", RUN_SIZE - 1);
  if (status != HOOKE_OK) return status;
  struct header header;
  describe(it, &standing, run, &header);
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
  struct header header;
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
  const char *damage = find_damage(&found->header, there.bytes);
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
  status = check_match(path, &found->header, it);
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
