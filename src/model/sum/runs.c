#include "model/sum/runs.h"

#include "core/memory.h"
#include "model/force/force.h"

#include <string.h>

/* ---- stored columns ---- */

static int32_t new_columns(const struct hk_force_row *force, struct hk_stored *stored) {
  int there = 1;
  for (int32_t e = 0; e < force->member_particles; e++)
    there &= (stored->particle[e] = hk_new(stored->indexed, sizeof(int32_t))) != NULL;
  for (int k = 0; k < HOOKE_GROUP_NUMBERS; k++)
    if (force->width[k] > 0) there &= (stored->number[k] = hk_new(stored->mixed, sizeof(double))) != NULL;
  return there ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void hk_stored_drop_numbers(struct hk_stored *stored) {
  for (int k = 0; k < HOOKE_GROUP_NUMBERS; k++)
    hk_free(stored->number[k]);
  memset(stored->number, 0, sizeof stored->number);
  stored->mixed = 0;
}

void hk_stored_release(struct hk_stored *stored) {
  hk_stored_drop_numbers(stored);
  for (int e = 0; e < HOOKE_MEMBER_PARTICLES; e++)
    hk_free(stored->particle[e]);
  memset(stored, 0, sizeof *stored);
}

int64_t hk_stored_memory(const struct hk_force_row *force, const struct hk_stored *stored) {
  int64_t numbers = 0;
  for (int k = 0; k < HOOKE_GROUP_NUMBERS; k++)
    numbers += force->width[k] * stored->mixed;
  return numbers * (int64_t)sizeof(double) +
         force->member_particles * stored->indexed * (int64_t)sizeof(int32_t);
}

/* ---- cutting groups into runs ---- */

/* A shorter stretch is not worth a loop of its own. */
enum { SHORTEST_RUN = 8 };

/* 1 if the particles of member k are so far apart as a run has them: any two, or three at equal distances. */
static int is_even(const struct hk_group *g, int64_t k) {
  int even = 1;
  for (int e = 2; e < g->force->member_particles; e++) {
    const int32_t offset = g->particle[e][k] - g->particle[e - 1][k];
    even &= offset > 0 && offset == g->particle[1][k] - g->particle[0][k];
  }
  return even;
}

/* Number of members from k on whose particles advance by one. */
static int64_t stretch_at(const struct hk_group *g, int64_t k) {
  int64_t end = k + 1;
  for (int advances = is_even(g, k); advances && end < g->count; end += advances) {
    for (int e = 0; e < g->force->member_particles; e++)
      advances &= g->particle[e][end] == g->particle[e][end - 1] + 1;
  }
  return end - k;
}

static int is_mixed(const struct hk_group *g, int64_t from, int64_t count) {
  for (int64_t k = from + 1; k < from + count; k++) {
    for (int j = 0; j < HOOKE_GROUP_NUMBERS; j++)
      if (g->number[j] && memcmp(&g->number[j][k], &g->number[j][from], sizeof(double)) != 0) return 1;
  }
  return 0;
}

/* The first pass counts what is stored, the second has `add`, and fills it. */
struct sorter {
  hooke_system *system;
  const struct hk_stored *stored;
  hk_run_add *add;
  int64_t runs, indexed, mixed; /* so far */
};

static void add_piece(struct sorter *sorter, const struct hk_group *g, int64_t from, int64_t count,
                      int indexed) {
  struct hk_piece piece = {.group = g, .from = from, .count = count, .indexed = indexed};
  piece.mixed = is_mixed(g, from, count);
  for (int e = 0; e < g->force->member_particles && indexed && sorter->add; e++)
    piece.particle[e] = memcpy(sorter->stored->particle[e] + sorter->indexed, g->particle[e] + from,
                               (size_t)count * sizeof(int32_t));
  for (int k = 0; k < HOOKE_GROUP_NUMBERS && piece.mixed && sorter->add; k++)
    if (g->number[k])
      piece.number[k] = memcpy(sorter->stored->number[k] + sorter->mixed, g->number[k] + from,
                               (size_t)count * sizeof(double));
  if (sorter->add) sorter->add(sorter->system, &piece);
  sorter->runs++;
  sorter->indexed += indexed ? count : 0;
  sorter->mixed += piece.mixed ? count : 0;
}

/* What is between long stretches along which all particles advance by one is looked up. */
static void cut(struct sorter *sorter, const struct hk_group *g) {
  int64_t pending = 0; /* first member not yet in a run */
  for (int64_t k = 0, length; k < g->count; k += length) {
    length = stretch_at(g, k);
    if (length < SHORTEST_RUN) continue;
    if (k > pending) add_piece(sorter, g, pending, k - pending, 1);
    add_piece(sorter, g, k, length, 0);
    pending = k + length;
  }
  if (g->count > pending) add_piece(sorter, g, pending, g->count - pending, 1);
}

int32_t hk_runs_commit(hooke_system *system, const struct hk_force_row *force, const struct hk_group *group,
                       int64_t count, struct hk_stored *stored, void **run, size_t size, hk_run_add *add) {
  struct sorter sorter = {.system = system, .stored = stored};
  for (int64_t g = 0; g < count; g++)
    cut(&sorter, &group[g]);
  *stored = (struct hk_stored){.indexed = sorter.indexed, .mixed = sorter.mixed};
  *run = hk_new(sorter.runs, size);
  if (new_columns(force, stored) != HOOKE_OK || *run == NULL) {
    force->release(system);
    return HOOKE_NO_MEMORY;
  }
  sorter = (struct sorter){.system = system, .stored = stored, .add = add};
  for (int64_t g = 0; g < count; g++)
    cut(&sorter, &group[g]);
  return HOOKE_OK;
}

int64_t hk_runs_find(const int64_t *first, int64_t count, size_t size, int64_t number) {
  int64_t low = 0, high = count - 1;
  while (low < high) {
    const int64_t middle = low + (high - low + 1) / 2;
    if (*(const int64_t *)(const void *)((const char *)first + (size_t)middle * size) <= number)
      low = middle;
    else
      high = middle - 1;
  }
  return low;
}
