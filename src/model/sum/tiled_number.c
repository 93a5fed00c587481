/* A working numbering in which neighbours are close (Cuthill and McKee 1969, without sorting by degree, which
 * costs more than it gains here). */
#include "model/sum/tiled.h"

#include "core/memory.h"

/* Particles are not ordered yet, so their data are prefetched this many ahead. */
enum { EARLY = 16 };

/* Neighbours of all particles, those of p at first[p] .. first[p + 1] - 1. */
struct graph {
  int64_t *first;
  int32_t *neighbour;
};

static int32_t graph_create(int64_t particles, int64_t springs, const int32_t *head, const int32_t *tail,
                            struct graph *graph) {
  graph->first = hk_new(particles + 2, sizeof(int64_t));
  graph->neighbour = hk_new(2 * springs, sizeof(int32_t));
  if (graph->first == NULL || graph->neighbour == NULL) return HOOKE_NO_MEMORY;
  int64_t *next = graph->first + 2; /* advances to first + 1 as the lists fill up */
  for (int64_t s = 0; s < springs; s++) {
    if (head[s] + 1 < particles) next[head[s]]++;
    if (tail[s] + 1 < particles) next[tail[s]]++;
  }
  for (int64_t p = 0; p < particles; p++)
    graph->first[p + 1] += graph->first[p];
  next = graph->first + 1;
  for (int64_t s = 0; s < springs; s++) {
    if (s + EARLY < springs) {
      __builtin_prefetch(next + head[s + EARLY], 1);
      __builtin_prefetch(next + tail[s + EARLY], 1);
    }
    graph->neighbour[next[head[s]]++] = tail[s];
    graph->neighbour[next[tail[s]]++] = head[s];
  }
  return HOOKE_OK;
}

static void ask_for_neighbours(const struct graph *graph, const int32_t *order, int64_t done, int64_t count) {
  if (done + EARLY < count) __builtin_prefetch(graph->first + order[done + EARLY]);
  if (done + EARLY / 2 < count) __builtin_prefetch(graph->neighbour + graph->first[order[done + EARLY / 2]]);
}

static int64_t add_piece(const struct graph *graph, int32_t start, int64_t count, int32_t *order,
                         int32_t *slot) {
  int64_t done = count;
  slot[start] = (int32_t)count;
  order[count++] = start;
  for (; done < count; done++) {
    const int32_t p = order[done];
    ask_for_neighbours(graph, order, done, count);
    for (int64_t k = graph->first[p]; k < graph->first[p + 1]; k++) {
      const int32_t other = graph->neighbour[k];
      if (slot[other] >= 0) continue;
      slot[other] = (int32_t)count;
      order[count++] = other;
    }
  }
  return count;
}

/* Searches each piece, in the order of their first particles: once from there to find an end, once more from
 * that end. */
static void number_pieces(const struct graph *graph, int64_t particles, int32_t *order, int32_t *slot) {
  for (int64_t p = 0; p < particles; p++)
    slot[p] = -1;
  int64_t count = 0;
  for (int64_t p = 0; p < particles; p++) {
    if (slot[p] >= 0) continue;
    const int64_t end = add_piece(graph, (int32_t)p, count, order, slot);
    const int32_t last = order[end - 1];
    for (int64_t k = count; k < end; k++)
      slot[order[k]] = -1;
    count = add_piece(graph, last, count, order, slot);
  }
}

int32_t hk_tiled_number(int64_t particles, int64_t springs, const int32_t *head, const int32_t *tail,
                        int32_t *order, int32_t *slot) {
  struct graph graph = {NULL, NULL};
  const int32_t status = graph_create(particles, springs, head, tail, &graph);
  if (status == HOOKE_OK) number_pieces(&graph, particles, order, slot);
  hk_free(graph.first);
  hk_free(graph.neighbour);
  return status;
}
