/* Sorts springs into runs by their numbers: consecutive springs whose ends advance by one have a constant
 * offset and need no index; a material equal to the bit along a run needs no parameters. */
#include "model/force/spring.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <string.h>

/* Counters of the first pass, filled in the second. */
struct sorter {
  struct hk_springs *springs;
  int64_t runs, indexed, mixed;
  int32_t fill;
};

static int same_bits(double a, double b) {
  return memcmp(&a, &b, sizeof a) == 0;
}

static int is_mixed(const struct hk_group *g, int64_t from, int64_t count) {
  for (int64_t k = from + 1; k < from + count; k++) {
    if (!same_bits(g->number[HOOKE_KAPPA][k], g->number[HOOKE_KAPPA][from]) ||
        !same_bits(g->number[HOOKE_GAMMA][k], g->number[HOOKE_GAMMA][from]) ||
        !same_bits(g->number[HOOKE_REST_LENGTH][k], g->number[HOOKE_REST_LENGTH][from])) {
      return 1;
    }
  }
  return 0;
}

static int is_damped(const struct hk_group *g, int64_t from, int64_t count) {
  for (int64_t k = from; k < from + count; k++) {
    if (g->number[HOOKE_GAMMA][k] != 0.0) return 1;
  }
  return 0;
}

static void copy_ends(struct sorter *sorter, struct hk_run *run, const struct hk_group *g, int64_t from) {
  int32_t *head = sorter->springs->head + sorter->indexed, *tail = sorter->springs->tail + sorter->indexed;
  memcpy(head, g->particle[0] + from, (size_t)run->count * sizeof *head);
  memcpy(tail, g->particle[1] + from, (size_t)run->count * sizeof *tail);
  run->head = head;
  run->tail = tail;
}

static void copy_material(struct sorter *sorter, struct hk_run *run, const struct hk_group *g, int64_t from) {
  struct hk_springs *springs = sorter->springs;
  const int64_t at = sorter->mixed;
  const size_t bytes = (size_t)run->count * sizeof(double);
  run->kappas = memcpy(springs->kappa + at, g->number[HOOKE_KAPPA] + from, bytes);
  run->gammas = memcpy(springs->gamma + at, g->number[HOOKE_GAMMA] + from, bytes);
  run->rest_lengths = memcpy(springs->rest_length + at, g->number[HOOKE_REST_LENGTH] + from, bytes);
}

static void add_run(void *ctx, const struct hk_group *g, int64_t from, int64_t count, int indexed) {
  struct sorter *sorter = ctx;
  const int mixed = is_mixed(g, from, count);
  if (sorter->fill) {
    struct hk_run *run = &sorter->springs->run[sorter->runs];
    run->first = sorter->springs->count;
    run->count = count;
    run->shape = (indexed ? HOOKE_RUN_INDEXED : 0) | (mixed ? HOOKE_RUN_MIXED : 0) |
                 (is_damped(g, from, count) ? HOOKE_RUN_DAMPED : 0) |
                 (g->pull_only ? HOOKE_RUN_PULL_ONLY : 0);
    run->start = g->particle[0][from];
    run->offset = g->particle[1][from] - g->particle[0][from];
    run->kappa = g->number[HOOKE_KAPPA][from];
    run->gamma = g->number[HOOKE_GAMMA][from];
    run->rest_length = g->number[HOOKE_REST_LENGTH][from];
    if (indexed) copy_ends(sorter, run, g, from);
    if (mixed) copy_material(sorter, run, g, from);
    run->loop = hk_spring_set(0)->loop[run->shape];
    run->undamped_loop = hk_spring_set(0)->loop[run->shape & ~HOOKE_RUN_DAMPED];
    sorter->springs->count += count;
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

int32_t hk_springs_commit(hooke_system *system, const struct hk_group *group, int64_t group_count) {
  struct hk_springs *springs = system->springs;
  memset(springs, 0, sizeof *springs);
  struct sorter sorter = {.springs = springs};
  sort_groups(&sorter, group, group_count);
  springs->run_count = sorter.runs;
  springs->indexed_count = sorter.indexed;
  springs->mixed_count = sorter.mixed;
  springs->run = hk_new(sorter.runs, sizeof *springs->run);
  springs->head = hk_new(sorter.indexed, sizeof(int32_t));
  springs->tail = hk_new(sorter.indexed, sizeof(int32_t));
  springs->kappa = hk_new(sorter.mixed, sizeof(double));
  springs->gamma = hk_new(sorter.mixed, sizeof(double));
  springs->rest_length = hk_new(sorter.mixed, sizeof(double));
  if (!springs->run || !springs->head || !springs->tail || !springs->kappa || !springs->gamma ||
      !springs->rest_length) {
    hk_springs_release(system);
    return HOOKE_NO_MEMORY;
  }
  sorter.fill = 1;
  sort_groups(&sorter, group, group_count);
  return HOOKE_OK;
}

void hk_springs_drop_material(struct hk_springs *springs) {
  hk_free(springs->kappa);
  hk_free(springs->gamma);
  hk_free(springs->rest_length);
  springs->kappa = springs->gamma = springs->rest_length = NULL;
  springs->mixed_count = 0;
}

void hk_springs_release(hooke_system *system) {
  struct hk_springs *springs = system->springs;
  hk_springs_drop_material(springs);
  hk_free(springs->run);
  hk_free(springs->head);
  hk_free(springs->tail);
  memset(springs, 0, sizeof *springs);
}

int64_t hk_springs_memory(const hooke_system *system) {
  const struct hk_springs *springs = system->springs;
  return springs->run_count * (int64_t)sizeof *springs->run +
         springs->indexed_count * (int64_t)(2 * sizeof(int32_t)) +
         springs->mixed_count * (int64_t)(3 * sizeof(double));
}
