#include "integrate/loop/recent.h"

#include <string.h>

static const int64_t MOST_BYTES = 16000000; /* for all states together, unless one alone needs more */

static int64_t state_bytes(int64_t size, int32_t has_v) {
  return (1 + (has_v ? 2 : 1) * size) * (int64_t)sizeof(double);
}

int32_t hk_recent_create(int64_t size, int32_t has_v, int32_t least, struct hk_recent *recent) {
  const int64_t fit = MOST_BYTES / state_bytes(size, has_v);
  *recent = (struct hk_recent){.capacity = fit > HOOKE_MOST_RECENT ? HOOKE_MOST_RECENT
                                           : fit > 2               ? (int32_t)(fit - 1)
                                                                   : least};
  int32_t status = fit >= 2 ? hk_state_create_sized(size, has_v, &recent->first_kept) : HOOKE_OK;
  for (int32_t k = 0; k < recent->capacity && status == HOOKE_OK; k++)
    status = hk_state_create_sized(size, has_v, &recent->state[k]);
  if (status != HOOKE_OK) hk_recent_release(recent);
  return status;
}

int32_t hk_recent_extend(int64_t size, int32_t has_v, struct hk_recent *recent) {
  const int32_t status = hk_state_create_sized(size, has_v, &recent->state[0]);
  if (status == HOOKE_OK) recent->capacity = 1;
  return status;
}

void hk_recent_release(struct hk_recent *recent) {
  for (int32_t k = 0; k < HOOKE_MOST_RECENT; k++)
    hooke_state_destroy(recent->state[k]);
  hooke_state_destroy(recent->first_kept);
  memset(recent, 0, sizeof *recent);
}

int64_t hk_recent_memory(const struct hk_recent *recent) {
  const hooke_state *one = recent->state[0];
  return one ? (recent->capacity + (recent->first_kept != NULL)) * state_bytes(one->size, one->has_v) : 0;
}

void hk_recent_set_first(struct hk_recent *recent, const hooke_state *first) {
  recent->first = first ? recent->first_kept : NULL;
  if (recent->first) hooke_state_copy(first, recent->first);
}

hooke_state *hk_recent_next(struct hk_recent *recent, int64_t step) {
  const int32_t again = recent->count > 0 && recent->step[recent->newest] == step;
  if (!again) {
    const int32_t capacity = recent->capacity > 0 ? recent->capacity : 1;
    recent->newest = recent->count == 0 ? 0 : (recent->newest + 1) % capacity;
    if (recent->count < capacity) recent->count++;
  }
  recent->step[recent->newest] = step;
  return recent->capacity > 0 ? recent->state[recent->newest] : NULL;
}

void hk_recent_keep(struct hk_recent *recent, const hooke_state *state, int64_t step) {
  hooke_state *to = hk_recent_next(recent, step);
  if (to) hooke_state_copy(state, to);
}

const hooke_state *hk_recent_state(const struct hk_recent *recent, int64_t back, int64_t *step) {
  if (back < 0 || back >= recent->count) return NULL;
  const int32_t at = recent->newest >= back ? recent->newest - (int32_t)back
                                            : recent->newest - (int32_t)back + recent->capacity;
  if (step) *step = recent->step[at];
  return recent->state[at];
}
