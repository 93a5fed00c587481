#include "integrate/dissection.h"

#include "core/memory.h"

#include <stdlib.h>
#include <string.h>

/* Parts that are not cut, and keys by which others may be: x, y, z, distance. */
enum { SMALL = 8, KEYS = 4 };

struct work {
  const hooke_system *system;
  const struct hooke_pattern *pattern;
  struct hooke_dissection *d;
  int32_t *segment; /* free particles; each part has a stretch of them */
  int32_t *best;    /* the same stretch as it was best cut */
  int32_t *mark;    /* which half of which part a particle is in */
  int32_t next_mark;
  double *key; /* of each particle */
  int32_t *queue;
};

static int before(const struct work *w, int32_t a, int32_t b) {
  return w->key[a] < w->key[b] || (w->key[a] == w->key[b] && a < b);
}

/* Puts the `half` particles of the lowest keys first. */
static void select_lowest(const struct work *w, int32_t *p, int64_t count, int64_t half) {
  int64_t low = 0, high = count - 1;
  while (low < high) {
    const int32_t pivot = p[low + (high - low) / 2];
    int64_t i = low, j = high;
    while (i <= j) {
      while (before(w, p[i], pivot))
        i++;
      while (before(w, pivot, p[j]))
        j--;
      if (i <= j) {
        const int32_t kept = p[i];
        p[i++] = p[j];
        p[j--] = kept;
      }
    }
    if (half <= j)
      high = j;
    else if (half >= i)
      low = i;
    else
      return;
  }
}

/* Springs between the particles of a part, from the first on; the key is the distance. Returns the last that is reached. */
static int32_t walk(struct work *w, const int32_t *p, int64_t count, int32_t first) {
  const int32_t in = w->next_mark++, seen = w->next_mark++;
  int64_t head = 0, tail = 0, next = 0;
  double distance = 0.0;
  for (int64_t k = 0; k < count; k++)
    w->mark[p[k]] = in;
  for (int32_t start = first; tail < count; start = p[next]) {
    if (w->mark[start] == seen) {
      next++;
      continue;
    }
    w->mark[start] = seen;
    w->key[start] = distance;
    w->queue[tail++] = start;
    for (; head < tail; head++) {
      const int32_t at = w->queue[head];
      distance = w->key[at] + 1.0;
      for (int64_t e = w->pattern->row_start[at]; e < w->pattern->row_start[at + 1]; e++) {
        const int64_t other = w->pattern->column[e];
        if (w->mark[other] != in) continue;
        w->mark[other] = seen;
        w->key[other] = distance;
        w->queue[tail++] = (int32_t)other;
      }
    }
  }
  return w->queue[count - 1];
}

static int touches(const struct work *w, int32_t p, int32_t mark) {
  for (int64_t e = w->pattern->row_start[p]; e < w->pattern->row_start[p + 1]; e++) {
    if (w->mark[w->pattern->column[e]] == mark) return 1;
  }
  return 0;
}

/* Moves those of p that touch the other half behind the rest; returns how many. */
static int64_t move_boundary(const struct work *w, int32_t *p, int64_t count, int32_t other) {
  int64_t kept = 0, moved = 0;
  for (int64_t k = 0; k < count; k++) {
    if (touches(w, p[k], other))
      w->queue[moved++] = p[k];
    else
      p[kept++] = p[k];
  }
  memcpy(p + kept, w->queue, (size_t)moved * sizeof *p);
  return moved;
}

static int64_t boundary(const struct work *w, const int32_t *p, int64_t count, int32_t other) {
  int64_t found = 0;
  for (int64_t k = 0; k < count; k++)
    found += touches(w, p[k], other);
  return found;
}

static void mark_halves(struct work *w, const int32_t *p, int64_t count, int64_t half) {
  for (int64_t k = 0; k < count; k++)
    w->mark[p[k]] = w->next_mark + (k >= half);
  w->next_mark += 2;
}

/* Cuts a part so that few particles are at the cut: `low` and `high` of them in the halves, the rest between, in the order
 * low half, high half, cut. */
static void cut(struct work *w, int32_t *p, int64_t count, int64_t *low, int64_t *high) {
  const int64_t half = count / 2;
  int64_t least = count + 1;
  int lower = 0;
  int32_t *best = w->best + (p - w->segment);
  for (int key = 0; key < KEYS; key++) {
    if (key == KEYS - 1)
      walk(w, p, count, walk(w, p, count, p[0]));
    else
      for (int64_t k = 0; k < count; k++)
        w->key[p[k]] = w->system->position[3 * (int64_t)p[k] + key];
    select_lowest(w, p, count, half);
    mark_halves(w, p, count, half);
    const int64_t first = boundary(w, p, half, w->next_mark - 1),
                  second = boundary(w, p + half, count - half, w->next_mark - 2);
    const int64_t fewer = first < second ? first : second;
    if (fewer >= least) continue;
    least = fewer;
    lower = first <= second;
    memcpy(best, p, (size_t)count * sizeof *p);
  }
  memcpy(p, best, (size_t)count * sizeof *p);
  mark_halves(w, p, count, half);
  if (lower) { /* the cut is taken from the low half, and comes last */
    const int64_t moved = move_boundary(w, p, half, w->next_mark - 1);
    *low = half - moved;
    *high = count - half;
    memcpy(w->queue, p + *low, (size_t)moved * sizeof *p);
    memmove(p + *low, p + half, (size_t)*high * sizeof *p);
    memcpy(p + *low + *high, w->queue, (size_t)moved * sizeof *p);
  } else {
    *low = half;
    *high = count - half - move_boundary(w, p + half, count - half, w->next_mark - 2);
  }
}

static int by_number(const void *a, const void *b) {
  const int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
  return (x > y) - (x < y);
}

/* The parts of a stretch of the segment, which is then in order; returns the last, that of the cut. */
static int32_t dissect(struct work *w, int64_t from, int64_t count) {
  int32_t *p = w->segment + from, child[2] = {-1, -1};
  int64_t low = 0, high = 0;
  if (count > SMALL) {
    cut(w, p, count, &low, &high);
    if (low > 0) child[0] = dissect(w, from, low);
    if (high > 0) child[1] = dissect(w, from + low, high);
  }
  const int64_t own = low + high;
  qsort(p + own, (size_t)(count - own), sizeof *p, by_number);
  const int32_t number = w->d->part_count++;
  w->d->part[number] = (struct hooke_part_of_order){from + own, count - own, -1};
  for (int k = 0; k < 2; k++) {
    if (child[k] >= 0) w->d->part[child[k]].parent = number;
  }
  return number;
}

int32_t hooke_dissection_create(const hooke_system *system, const struct hooke_pattern *pattern,
                                struct hooke_dissection *d) {
  const int64_t n = system->particle_count, m = n - system->held_count;
  *d = (struct hooke_dissection){.free_count = m};
  struct work w = {.system = system, .pattern = pattern, .d = d, .next_mark = 1};
  d->part = hooke_new(2 * m + 1, sizeof *d->part);
  d->place = hooke_new(n + 1, sizeof *d->place);
  w.segment = d->particle = hooke_new(m + 1, sizeof *d->particle);
  w.best = hooke_new(m + 1, sizeof *w.best);
  w.mark = hooke_new(n + 1, sizeof *w.mark);
  w.key = hooke_new(n + 1, sizeof *w.key);
  w.queue = hooke_new(m + 1, sizeof *w.queue);
  const int32_t status =
      d->part && d->place && d->particle && w.best && w.mark && w.key && w.queue ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    for (int64_t p = 0, k = 0; p < n; p++) {
      d->place[p] = -1;
      if (!system->held[p]) d->particle[k++] = (int32_t)p;
    }
    if (m > 0) dissect(&w, 0, m);
    for (int64_t k = 0; k < m; k++)
      d->place[d->particle[k]] = (int32_t)k;
  }
  hooke_free(w.best);
  hooke_free(w.mark);
  hooke_free(w.key);
  hooke_free(w.queue);
  if (status != HOOKE_OK) hooke_dissection_release(d);
  return status;
}

void hooke_dissection_release(struct hooke_dissection *d) {
  hooke_free(d->part);
  hooke_free(d->place);
  hooke_free(d->particle);
  memset(d, 0, sizeof *d);
}
