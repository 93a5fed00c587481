/* The pass over tiles: fills windows, sums, hands the tile on. */
#include "model/lane.h"

#include "core/memory.h"
#include "kernel/spring_body.h"
#include "model/motion.h"

#include <string.h>

/* Between springs of one lane and material, a gap as small as this is computed as if it had springs and then cleared:
 * shorter than a vector of its own. */
enum { SMALL_GAP = 16, TILES_A_WINDOW = 4 };

/* Forces of the springs of one lane, b[a][at + l - from] for spring l of the tile that begins at particle `from`. */
struct window {
  double *b[3];
  int64_t reach, room, at; /* reach: the offset, in whole vectors */
  int64_t next;            /* first run that is not done with */
};

struct hooke_windows {
  struct window window[HOOKE_MOST_LANES];
  double *block, *f[3]; /* f: HOOKE_TILE each */
  const struct hooke_spring_set *set;
  int64_t memory;
};

static int64_t whole(int64_t count, int64_t unit) {
  return (count + unit - 1) / unit * unit;
}

struct hooke_windows *hooke_windows_create(const struct hooke_lanes *lanes) {
  struct hooke_windows *windows = hooke_new(1, sizeof *windows);
  if (windows == NULL) return NULL;
  int64_t numbers = 3 * HOOKE_TILE + 8;
  for (int32_t k = 0; k < lanes->count; k++) {
    struct window *window = &windows->window[k];
    window->reach = whole(lanes->lane[k].offset, 8);
    const int64_t tiles = whole(window->reach, HOOKE_TILE), least = TILES_A_WINDOW * HOOKE_TILE;
    window->room = window->reach + (tiles > least ? tiles : least);
    numbers += 3 * window->room;
  }
  windows->block = hooke_new(numbers, sizeof(double));
  if (windows->block == NULL) {
    hooke_free(windows);
    return NULL;
  }
  windows->set = hooke_spring_set(0);
  windows->memory = (int64_t)sizeof *windows + numbers * (int64_t)sizeof(double);
  double *next = windows->block + (8 - ((uintptr_t)windows->block / sizeof(double)) % 8) % 8;
  for (int a = 0; a < 3; a++, next += HOOKE_TILE)
    windows->f[a] = next;
  for (int32_t k = 0; k < lanes->count; k++) {
    for (int a = 0; a < 3; a++, next += windows->window[k].room)
      windows->window[k].b[a] = next;
  }
  return windows;
}

void hooke_windows_destroy(struct hooke_windows *windows) {
  if (windows == NULL) return;
  hooke_free(windows->block);
  hooke_free(windows);
}

int64_t hooke_windows_memory(const struct hooke_windows *windows) {
  return windows ? windows->memory : 0;
}

static void clear(struct window *window, int64_t from, int64_t to) {
  for (int a = 0; a < 3 && to > from; a++)
    memset(window->b[a] + from, 0, (size_t)(to - from) * sizeof(double));
}

/* Makes room for the tile after this one. */
static void advance(struct window *window, int64_t count) {
  window->at += count;
  if (window->at + HOOKE_TILE <= window->room) return;
  for (int a = 0; a < 3; a++) {
    memmove(window->b[a], window->b[a] + window->at - window->reach, (size_t)window->reach * sizeof(double));
  }
  window->at = window->reach;
}

static int may_join(const struct hooke_run *run, const struct hooke_run *next) {
  return run->shape == next->shape && !(run->shape & HOOKE_RUN_MIXED) &&
         hooke_run_low(next) - hooke_run_high(run) <= SMALL_GAP && run->kappa == next->kappa &&
         run->gamma == next->gamma && run->rest_length == next->rest_length;
}

/* Springs of one run within [from, to) that have a rest length but no direction. */
static int64_t count_lost(const struct hooke_run *run, const struct hooke_motion *m, int64_t from,
                          int64_t to) {
  const int64_t low = hooke_run_low(run) > from ? hooke_run_low(run) : from,
                high = hooke_run_high(run) < to ? hooke_run_high(run) : to;
  int64_t lost = 0;
  for (int64_t l = low; l < high; l++) {
    const struct hooke_spring s = hooke_run_spring(run, l - hooke_run_low(run));
    const double r = hooke_spring_length(m->q[0][s.head] - m->q[0][s.tail], m->q[1][s.head] - m->q[1][s.tail],
                                         m->q[2][s.head] - m->q[2][s.tail]);
    lost += r == 0.0 && s.rest_length != 0.0;
  }
  return lost;
}

/* Runs `first` .. `last` of a lane as one, from particle `from` to `to`. */
static int64_t fill(const struct hooke_lane *lane, int64_t first, int64_t last, struct window *window,
                    const struct hooke_motion *m, int64_t tile, int64_t from, int64_t to) {
  const struct hooke_run *run = lane->run[first];
  struct hooke_fields at;
  double *b[3];
  for (int a = 0; a < 3; a++) {
    at.q[a] = m->q[a] + from;
    at.v[a] = m->v[a] + from;
    b[a] = window->b[a] + window->at + (from - tile);
  }
  int64_t lost = m->windows->set->fill[run->shape](run, &at, from - hooke_run_low(run), to - from, b);
  if (first == last) return lost;
  for (int64_t r = first; r < last; r++) {
    const int64_t gap = hooke_run_high(lane->run[r]) > from ? hooke_run_high(lane->run[r]) : from;
    const int64_t end = hooke_run_low(lane->run[r + 1]) < to ? hooke_run_low(lane->run[r + 1]) : to;
    clear(window, window->at + gap - tile, window->at + end - tile);
  }
  if (lost == 0) return 0;
  lost = 0;
  for (int64_t r = first; r <= last; r++)
    lost += count_lost(lane->run[r], m, from, to);
  return lost;
}

/* The part of a lane that begins in the tile. */
static int64_t fill_tile(const struct hooke_lane *lane, struct window *window, const struct hooke_motion *m,
                         int64_t tile, int64_t end) {
  int64_t lost = 0, done = tile;
  while (window->next < lane->run_count && hooke_run_low(lane->run[window->next]) < end) {
    const int64_t first = window->next, low = hooke_run_low(lane->run[first]), from = low > tile ? low : tile;
    int64_t last = first;
    while (last + 1 < lane->run_count && hooke_run_low(lane->run[last + 1]) < end &&
           may_join(lane->run[last], lane->run[last + 1]))
      last++;
    const int64_t high = hooke_run_high(lane->run[last]), to = high < end ? high : end;
    clear(window, window->at + done - tile, window->at + from - tile);
    lost += fill(lane, first, last, window, m, tile, from, to);
    done = to;
    window->next = high <= end ? last + 1 : last;
    if (high > end) break;
  }
  clear(window, window->at + done - tile, window->at + end - tile);
  return lost;
}

/* The first tile from `from` on that a step goes over, m->n past the last; `span` moves on with the tiles. */
static int64_t next_stepped(const hooke_system *system, int64_t from, int64_t *span) {
  while (*span < system->span_count && system->span[*span].from + system->span[*span].count <= from)
    (*span)++;
  if (*span == system->span_count) return system->particle_count;
  return system->span[*span].from > from ? system->span[*span].from : from;
}

int64_t hooke_lanes_pass(const hooke_system *system, struct hooke_motion *m, hooke_tile *tile, void *ctx) {
  const struct hooke_lanes *lanes = &system->lanes;
  struct hooke_windows *windows = m->windows;
  int64_t lost = 0, span = 0, begun = 0;
  for (int32_t k = 0; k < lanes->count; k++)
    windows->window[k].next = windows->window[k].at = 0;
  for (int64_t from = 0; from < m->n; from += HOOKE_TILE) {
    const int64_t stepped = next_stepped(system, from, &span);
    if (stepped > from && (!begun || stepped == m->n))
      from = stepped; /* no spring reaches over what is left out */
    if (from >= m->n) break;
    const int64_t end = from + HOOKE_TILE < m->n ? from + HOOKE_TILE : m->n;
    const double *upper[3][HOOKE_MOST_LANES], *lower[3][HOOKE_MOST_LANES];
    int32_t active = 0;
    for (int32_t k = 0; k < lanes->count; k++) {
      const struct hooke_lane *lane = &lanes->lane[k];
      struct window *window = &windows->window[k];
      if (lane->first >= end || lane->last + lane->offset < from) continue;
      if (window->at == 0) {
        clear(window, 0, window->reach);
        window->at = window->reach;
        begun = 1;
      }
      lost += fill_tile(lane, window, m, from, end);
      for (int a = 0; a < 3; a++) {
        lower[a][active] = window->b[a] + window->at;
        upper[a][active] = lower[a][active] - lane->offset;
      }
      active++;
    }
    if (stepped <= from) {
      for (int a = 0; a < 3; a++)
        windows->set->sum(end - from, active, upper[a], lower[a], windows->f[a]);
      tile(from, end - from, windows->f, ctx);
    }
    for (int32_t k = 0; k < lanes->count; k++) {
      if (windows->window[k].at > 0) advance(&windows->window[k], end - from);
    }
  }
  return lost;
}
