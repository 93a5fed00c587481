#include "model/force/spring.h"
#include "model/sum/damper_colours.h"

#include "core/memory.h"
#include "core/status.h"

#include <string.h>

/* Colours at each particle: all below `low`, and those in `above`, from begin[p] on, `count` of them. */
struct palette {
  int64_t *begin;
  int32_t *low, *count, *above;
};

static int has_colour(const hooke_system *system, const struct hk_spring *spring) {
  return spring->gamma != 0.0 &&
         system->inverse_mass[spring->head] + system->inverse_mass[spring->tail] > 0.0;
}

/* The next damped spring at `at` (a run, a spring of it) or behind it; 0 if there is none. */
struct walk {
  int64_t run, k;
  struct hk_spring spring;
  int64_t number;
};

static int next_damped(const hooke_system *system, struct walk *at) {
  for (; at->run < system->springs->run_count; at->run++, at->k = 0) {
    const struct hk_run *run = &system->springs->run[at->run];
    while ((run->shape & HOOKE_RUN_DAMPED) && at->k < run->count) {
      at->number = run->first + at->k;
      at->spring = hk_run_spring(run, at->k++);
      if (has_colour(system, &at->spring)) return 1;
    }
  }
  return 0;
}

/* ---- colours ---- */

static int is_taken(const struct palette *palette, int64_t p, int32_t colour) {
  if (colour < palette->low[p]) return 1;
  const int32_t *above = palette->above + palette->begin[p];
  for (int32_t k = 0; k < palette->count[p]; k++) {
    if (above[k] == colour) return 1;
  }
  return 0;
}

/* Marks a colour; those that then follow on without a gap go below `low`. */
static void take(struct palette *palette, int64_t p, int32_t colour) {
  int32_t *above = palette->above + palette->begin[p], *count = &palette->count[p];
  above[(*count)++] = colour;
  for (int32_t k = 0; k < *count;) {
    if (above[k] == palette->low[p]) {
      above[k] = above[--*count];
      palette->low[p]++;
      k = 0;
    } else {
      k++;
    }
  }
}

static int32_t find_colour(const struct palette *palette, const struct hk_spring *spring) {
  const int64_t i = spring->head, j = spring->tail;
  int32_t colour = palette->low[i] > palette->low[j] ? palette->low[i] : palette->low[j];
  while (is_taken(palette, i, colour) || is_taken(palette, j, colour))
    colour++;
  return colour;
}

static void release_palette(struct palette *palette) {
  hk_free(palette->begin);
  hk_free(palette->low);
  hk_free(palette->count);
  hk_free(palette->above);
}

static int32_t create_palette(const hooke_system *system, int64_t damped, struct palette *palette) {
  const int64_t n = system->particle_count;
  *palette = (struct palette){.begin = hk_new(n + 1, sizeof(int64_t)),
                              .low = hk_new(n, sizeof(int32_t)),
                              .count = hk_new(n, sizeof(int32_t)),
                              .above = hk_new(2 * damped, sizeof(int32_t))};
  if (!palette->begin || !palette->low || !palette->count || !palette->above) return HOOKE_NO_MEMORY;
  for (struct walk at = {0}; next_damped(system, &at);) {
    palette->begin[at.spring.head + 1]++;
    palette->begin[at.spring.tail + 1]++;
  }
  for (int64_t p = 0; p < n; p++)
    palette->begin[p + 1] += palette->begin[p];
  return HOOKE_OK;
}

/* The class of each damped spring into `slot`, -1 of the others; returns how many classes there are. */
static int64_t classify(const hooke_system *system, struct palette *palette, int64_t *slot) {
  int64_t classes = 0;
  memset(slot, -1, (size_t)system->springs->count * sizeof *slot);
  for (struct walk at = {0}; next_damped(system, &at);) {
    const int32_t colour = find_colour(palette, &at.spring);
    take(palette, at.spring.head, colour);
    take(palette, at.spring.tail, colour);
    slot[at.number] = 2 * (int64_t)colour + at.spring.pull_only;
    if (2 * (int64_t)colour + 2 > classes) classes = 2 * (int64_t)colour + 2;
  }
  return classes;
}

/* ---- springs by class ---- */

/* From classes to places, ascending within each class. */
static int32_t sort(const hooke_system *system, struct hk_damper_colours *colours) {
  const int64_t classes = colours->classes;
  int64_t *next = hk_new(classes + 1, sizeof *next);
  colours->first = hk_new(classes + 1, sizeof *colours->first);
  colours->head = hk_new(colours->springs, sizeof *colours->head);
  colours->tail = hk_new(colours->springs, sizeof *colours->tail);
  const int there = next && colours->first && colours->head && colours->tail;
  for (struct walk at = {0}; there && next_damped(system, &at);)
    next[colours->slot[at.number] + 1]++;
  for (int64_t c = 0; there && c < classes; c++)
    next[c + 1] += next[c];
  if (there) memcpy(colours->first, next, (size_t)(classes + 1) * sizeof *next);
  for (struct walk at = {0}; there && next_damped(system, &at);) {
    const int64_t to = next[colours->slot[at.number]]++;
    colours->slot[at.number] = to;
    colours->head[to] = (int32_t)at.spring.head;
    colours->tail[to] = (int32_t)at.spring.tail;
  }
  hk_free(next);
  return there ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int32_t hk_damper_colours_create(const hooke_system *system, struct hk_damper_colours *colours) {
  memset(colours, 0, sizeof *colours);
  for (struct walk at = {0}; next_damped(system, &at);) {
    colours->springs++;
    colours->pulling |= at.spring.pull_only;
  }
  struct palette palette;
  int32_t status = create_palette(system, colours->springs, &palette);
  colours->slot = status == HOOKE_OK ? hk_new(system->springs->count, sizeof *colours->slot) : NULL;
  if (colours->slot == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) colours->classes = classify(system, &palette, colours->slot);
  release_palette(&palette);
  return status == HOOKE_OK ? sort(system, colours) : status;
}

void hk_damper_colours_drop_places(struct hk_damper_colours *colours) {
  hk_free(colours->slot);
  colours->slot = NULL;
}

void hk_damper_colours_release(struct hk_damper_colours *colours) {
  hk_free(colours->first);
  hk_free(colours->head);
  hk_free(colours->tail);
  hk_free(colours->slot);
}

int64_t hk_damper_colours_memory(const struct hk_damper_colours *colours) {
  return (colours->classes + 1) * (int64_t)sizeof *colours->first +
         2 * colours->springs * (int64_t)sizeof *colours->head;
}
