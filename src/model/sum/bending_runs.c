/* Sorts triples into runs by their numbers, as spring_runs.c does with springs. */
#include "model/force/bending.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/spring/spring_loops.h"
#include "model/system.h"

#include <string.h>

/* Counters of the first pass, filled in the second. */
struct sorter {
  struct hk_bending *bending;
  int64_t runs, indexed, mixed;
  int32_t fill;
};

static int is_mixed(const struct hk_group *g, int64_t from, int64_t count) {
  for (int64_t k = from + 1; k < from + count; k++) {
    if (memcmp(&g->number[HOOKE_KAPPA][k], &g->number[HOOKE_KAPPA][from], sizeof g->number[HOOKE_KAPPA][k]) !=
        0)
      return 1;
  }
  return 0;
}

static void add_run(void *ctx, const struct hk_group *g, int64_t from, int64_t count, int indexed) {
  struct sorter *sorter = ctx;
  const int mixed = is_mixed(g, from, count);
  struct hk_bending *bending = sorter->bending;
  if (sorter->fill) {
    struct hk_bending_run *run = &bending->run[sorter->runs];
    run->first = bending->count;
    run->count = count;
    run->shape = (indexed ? HOOKE_BENDING_INDEXED : 0) | (mixed ? HOOKE_BENDING_MIXED : 0);
    run->start = g->particle[0][from];
    run->offset = g->particle[1][from] - g->particle[0][from];
    run->coefficient = g->number[HOOKE_KAPPA][from];
    for (int e = 0; e < 3 && indexed; e++) {
      run->particle[e] = memcpy(bending->particle[e] + sorter->indexed, g->particle[e] + from,
                                (size_t)count * sizeof(int32_t));
    }
    if (mixed) {
      run->coefficients = memcpy(bending->coefficient + sorter->mixed, g->number[HOOKE_KAPPA] + from,
                                 (size_t)count * sizeof(double));
    }
    run->loop = hk_spring_set(0)->bending[run->shape];
    bending->count += count;
  }
  sorter->runs++;
  if (indexed) sorter->indexed += count;
  if (mixed) sorter->mixed += count;
}

static void sort_groups(struct sorter *sorter, const struct hk_group *group, int64_t group_count) {
  sorter->runs = sorter->indexed = sorter->mixed = 0;
  for (int64_t k = 0; k < group_count; k++)
    hk_group_cut(&group[k], add_run, sorter);
}

int32_t hk_bending_commit(hooke_system *system, const struct hk_group *group, int64_t group_count) {
  struct hk_bending *bending = &system->rest->bending;
  memset(bending, 0, sizeof *bending);
  struct sorter sorter = {.bending = bending};
  sort_groups(&sorter, group, group_count);
  bending->run_count = sorter.runs;
  bending->indexed_count = sorter.indexed;
  bending->mixed_count = sorter.mixed;
  int there = (bending->run = hk_new(sorter.runs, sizeof *bending->run)) != NULL;
  for (int e = 0; e < 3; e++)
    there &= (bending->particle[e] = hk_new(sorter.indexed, sizeof(int32_t))) != NULL;
  there &= (bending->coefficient = hk_new(sorter.mixed, sizeof(double))) != NULL;
  if (!there) {
    hk_bending_release(system);
    return HOOKE_NO_MEMORY;
  }
  sorter.fill = 1;
  sort_groups(&sorter, group, group_count);
  return HOOKE_OK;
}

void hk_bending_release(hooke_system *system) {
  struct hk_bending *bending = &system->rest->bending;
  hk_free(bending->run);
  for (int e = 0; e < 3; e++)
    hk_free(bending->particle[e]);
  hk_free(bending->coefficient);
  memset(bending, 0, sizeof *bending);
}

int64_t hk_bending_memory(const hooke_system *system) {
  const struct hk_bending *bending = &system->rest->bending;
  return bending->run_count * (int64_t)sizeof *bending->run +
         bending->indexed_count * (int64_t)(3 * sizeof(int32_t)) +
         bending->mixed_count * (int64_t)sizeof(double);
}
