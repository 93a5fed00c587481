#include "edit.h"

#include "random.h"

#include <math.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t most);

static struct edit decode(const uint8_t *at) {
  struct edit edit = {at[0] % EDIT_KINDS, at[1], at[2], at[3], 0};
  memcpy(&edit.value, at + 4, sizeof edit.value);
  return edit;
}

void edits_decode(const uint8_t *data, size_t size, struct edits *edits) {
  memset(edits, 0, sizeof *edits);
  memcpy(edits->head, data, size < EDIT_HEAD ? size : EDIT_HEAD);
  for (int part = 0; part <= 2; part++) {
    int32_t seen = 0;
    for (size_t at = EDIT_HEAD; at + EDIT_BYTES <= size && seen < MOST_EDITS; at += EDIT_BYTES, seen++) {
      const struct edit edit = decode(data + at);
      if ((edit.kind >= EDIT_STRUCTURES) + (edit.kind >= EDIT_CHECKS) == part)
        edits->edit[edits->count++] = edit;
    }
  }
}

static const double doubles[] = {
    0.0,    -0.0,         1.0,          -1.0,          0.01,
    0.02,   0.04,         1e-300,       5e-324,        1e300,
    -1e300, INFINITY,     -INFINITY,    NAN,           2.0,
    3.0,    4.0,          5.0,          0.5,           1e-9,
    1e9,    2147483647.0, 2147483648.0, -2147483649.0, 9007199254740993.0,
    9.3e18, 1e19,         0.03,         255.0,         65536.0,
};

double edit_double(uint64_t drawn) {
  return doubles[drawn % (sizeof doubles / sizeof doubles[0])];
}

/* ---- mutating ---- */

static uint64_t draw_value(struct random_source *state) {
  static const uint64_t whole[] = {0,
                                   1,
                                   2,
                                   3,
                                   4,
                                   5,
                                   6,
                                   7,
                                   12,
                                   100,
                                   255,
                                   1u << 20,
                                   UINT64_C(1) << 31,
                                   UINT64_C(1) << 32,
                                   UINT64_C(1) << 40,
                                   UINT64_C(1) << 61,
                                   INT64_MAX,
                                   UINT64_MAX};
  const uint64_t kind = random_bits(state) % 4;
  if (kind == 0) return random_bits(state);
  if (kind == 1) return whole[random_bits(state) % (sizeof whole / sizeof whole[0])];
  const double number = edit_double(random_bits(state));
  uint64_t bits;
  memcpy(&bits, &number, sizeof bits);
  return bits;
}

/* Structures need a new container, and extents a reopened file. */
static enum edit_kind draw_kind(uint64_t r) {
  if (r % 32 == 0) return (enum edit_kind)((r >> 8) % EDIT_STRUCTURES);
  if (r % 32 <= 2) return EDIT_EXTENT;
  return (r >> 9) % 3 ? EDIT_VALUE : EDIT_CHECK;
}

static void draw_edit(struct random_source *state, uint8_t *at) {
  const uint64_t value = draw_value(state), r = random_bits(state);
  at[0] = (uint8_t)draw_kind(r);
  at[1] = (uint8_t)(r >> 16);
  at[2] = (uint8_t)(r >> 24);
  at[3] = (uint8_t)(r >> 32);
  memcpy(at + 4, &value, sizeof value);
}

static void change_edit(struct random_source *state, uint8_t *at) {
  const uint64_t value = draw_value(state);
  switch (random_bits(state) % 6) {
  case 0:
    draw_edit(state, at);
    break;
  case 1:
    memcpy(at + 4, &value, sizeof value);
    break;
  case 2:
    LLVMFuzzerMutate(at + 4, 8, 8);
    break;
  default: /* mostly among the fields that keep the structure */
    at[at[0] % EDIT_KINDS >= EDIT_STRUCTURES ? 1 + random_bits(state) % 3 : 4 + random_bits(state) % 8] =
        (uint8_t)random_bits(state);
  }
}

/* Keeps a third of the structures that were drawn. */
static uint8_t *choose_edit(struct random_source *state, uint8_t *list, size_t count) {
  uint8_t *at = list;
  for (int k = 0; count > 0 && k < 3; k++) {
    at = list + random_bits(state) % count * EDIT_BYTES;
    if (at[0] % EDIT_KINDS >= EDIT_STRUCTURES) break;
  }
  return at;
}

size_t edits_mutate(uint8_t *data, size_t size, size_t most, unsigned seed) {
  struct random_source state = {seed};
  if (most < EDIT_HEAD) return 0;
  if (size < EDIT_HEAD) memset(data + size, 0, EDIT_HEAD - size);
  if (most > EDIT_HEAD + MOST_EDITS * EDIT_BYTES) most = EDIT_HEAD + MOST_EDITS * EDIT_BYTES;
  size_t count = size < EDIT_HEAD ? 0 : (size - EDIT_HEAD) / EDIT_BYTES;
  const size_t room = (most - EDIT_HEAD) / EDIT_BYTES;
  if (count > room) count = room;
  uint8_t *list = data + EDIT_HEAD;
  for (uint64_t times = 1 + random_bits(&state) % 3; times > 0; times--) {
    const uint64_t what = random_bits(&state) % 8;
    uint8_t *at = choose_edit(&state, list, count);
    if (what == 0) {
      data[random_bits(&state) % EDIT_HEAD] = (uint8_t)random_bits(&state);
    } else if ((what <= 2 || count == 0) && count < room) {
      draw_edit(&state, list + count++ * EDIT_BYTES);
    } else if (what == 3 && count > 0) {
      memmove(at, list + --count * EDIT_BYTES, EDIT_BYTES);
    } else if (count > 0) {
      change_edit(&state, at);
    }
  }
  return EDIT_HEAD + count * EDIT_BYTES;
}
