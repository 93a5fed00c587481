#include "model/sum/dampers.h"

#include "core/memory.h"
#include "model/force/force.h"
#include "model/force/spring.h"
#include "model/medium.h"

#include <string.h>

/* ---- colours ---- */

/* The colours of damped springs: of each the lowest that no damped spring before it has at either of its
 * ends. A spring that is not damped, or both ends of which are held, has none.
 * Class 2 c has the springs of colour c that push too, and 2 c + 1 those that only pull: `first` .. of the
 * next one, in ascending number. */
struct colours {
  int64_t springs, classes;
  int32_t pulling; /* 1: some only pull */
  int64_t *first;  /* classes + 1 */
  int32_t *head, *tail;
  int64_t *slot; /* of each spring, -1 of one without a colour; until all are made, if none follows time */
};

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
static int32_t sort(const hooke_system *system, struct colours *colours) {
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

/* HOOKE_NO_MEMORY leaves what release_colours() releases. */
static int32_t create_colours(const hooke_system *system, struct colours *colours) {
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

static void release_colours(struct colours *colours) {
  hk_free(colours->first);
  hk_free(colours->head);
  hk_free(colours->tail);
  hk_free(colours->slot);
}

/* ---- making ---- */

/* Springs of a colour that are worth several threads, and what they are shared by. */
enum { MANY = 4096, UNIT = 64 };

struct hk_dampers {
  const hooke_system *system;
  double h;
  struct colours colours;
  double *impulse_per_rate;    /* of each damped spring */
  double *kappa, *rest_length; /* of those that only pull, in place of each spring; NULL if there are none */
  double *drag;                /* n: 1 + z + z^2/2; NULL without drag */
  double *rows;                /* 3n: positions in rows, for elements of other forces; NULL without any */
  int64_t memory;
};

static double *new_numbers(struct hk_dampers *d, int64_t count, int32_t *status) {
  double *numbers = *status == HOOKE_OK ? hk_new(count, sizeof *numbers) : NULL;
  if (numbers == NULL) *status = HOOKE_NO_MEMORY;
  d->memory += count * (int64_t)sizeof *numbers;
  return numbers;
}

static void take_numbers(const hooke_system *system, double t, struct hk_dampers *d) {
  const struct colours *colours = &d->colours;
  struct hk_scaler scaler = {.t = t};
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const struct hk_run *run = &system->springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const int64_t at = colours->slot[run->first + k];
      if (at < 0) continue;
      const struct hk_spring spring = hk_run_spring_at(run, k, &scaler);
      const double w = system->inverse_mass[spring.head] + system->inverse_mass[spring.tail];
      d->impulse_per_rate[at] = hk_damper_part(d->h * spring.gamma * w) / w;
      if (colours->pulling) d->kappa[at] = spring.kappa, d->rest_length[at] = spring.rest_length;
    }
  }
}

static int32_t take_springs(const hooke_system *system, struct hk_dampers *d) {
  const struct colours *colours = &d->colours;
  int32_t status = HOOKE_OK;
  d->impulse_per_rate = new_numbers(d, colours->springs, &status);
  if (colours->pulling) {
    d->kappa = new_numbers(d, colours->springs, &status);
    d->rest_length = new_numbers(d, colours->springs, &status);
  }
  if (status == HOOKE_OK) take_numbers(system, 0.0, d);
  return status;
}

static int32_t take_others(const hooke_system *system, struct hk_dampers *d) {
  int32_t status = HOOKE_OK;
  if (hk_system_is_damped(system, HOOKE_OTHERS))
    d->rows = new_numbers(d, 3 * system->particle_count, &status);
  if (system->brake > 0.0) d->drag = new_numbers(d, system->particle_count, &status);
  for (int64_t p = 0; p < system->particle_count && d->drag; p++) {
    const double z = d->h * system->brake * system->inverse_mass[p];
    d->drag[p] = 1.0 + z * (1.0 + z / 2.0);
  }
  return status;
}

int32_t hk_dampers_create(const hooke_system *system, double h, struct hk_dampers **out) {
  struct hk_dampers *d = hk_new(1, sizeof *d);
  if (d == NULL) return HOOKE_NO_MEMORY;
  d->system = system;
  d->h = h;
  int32_t status = create_colours(system, &d->colours);
  if (status == HOOKE_OK) status = take_springs(system, d);
  if (status == HOOKE_OK) status = take_others(system, d);
  if (!system->springs->scaled) {
    hk_free(d->colours.slot);
    d->colours.slot = NULL;
  }
  d->memory += (int64_t)sizeof *d + (d->colours.classes + 1) * (int64_t)sizeof(int64_t) +
               2 * d->colours.springs * (int64_t)sizeof(int32_t) +
               (d->colours.slot ? system->springs->count * (int64_t)sizeof(int64_t) : 0);
  return HOOKE_HAND_OVER(status, d, out, hk_dampers_destroy);
}

void hk_dampers_destroy(struct hk_dampers *d) {
  if (d == NULL) return;
  release_colours(&d->colours);
  hk_free(d->impulse_per_rate);
  hk_free(d->kappa);
  hk_free(d->rest_length);
  hk_free(d->drag);
  hk_free(d->rows);
  hk_free(d);
}

int64_t hk_dampers_memory(const struct hk_dampers *dampers) {
  return dampers->memory;
}

/* ---- springs ---- */

struct sweep {
  const struct hk_dampers *dampers;
  struct hk_motion *motion;
  int32_t backwards;
};

static void damp_springs(const struct sweep *sweep, int64_t from, int64_t count, int pull) {
  const struct hk_dampers *d = sweep->dampers;
  struct hk_motion *m = sweep->motion;
  struct hk_damped_springs springs = {.head = d->colours.head + from,
                                      .tail = d->colours.tail + from,
                                      .impulse_per_rate = d->impulse_per_rate + from,
                                      .half = d->h};
  if (pull) springs.kappa = d->kappa + from, springs.rest_length = d->rest_length + from;
  const struct hk_damper_point at = {
      {m->q[0], m->q[1], m->q[2]}, d->system->inverse_mass, {m->v[0], m->v[1], m->v[2]}};
  hk_spring_set(0)->dampers(&springs, (ptrdiff_t)count, &at);
}

/* A class has springs of one colour that all push too, or all only pull. Small ones are for one thread. */
static void go_over(int32_t worker, int32_t workers, void *ctx) {
  const struct sweep *sweep = ctx;
  const struct colours *colours = &sweep->dampers->colours;
  int waiting = 0;
  for (int64_t c = 0; c < colours->classes; c++) {
    const int64_t class = sweep->backwards ? colours->classes - 1 - c : c, from = colours->first[class],
                  count = colours->first[class + 1] - from;
    const int pull = (int)(class % 2), many = workers > 1 && count >= MANY;
    const int64_t begin = many ? hk_pool_share(count, UNIT, worker, workers) : 0,
                  end = many ? hk_pool_share(count, UNIT, worker + 1, workers) : count;
    if (many && waiting) hk_pool_barrier(sweep->motion->pool);
    if (begin < end && (many || worker == 0)) damp_springs(sweep, from + begin, end - begin, pull);
    if (many) hk_pool_barrier(sweep->motion->pool);
    if (count > 0) waiting = !many;
  }
}

/* ---- other elements, and drag ---- */

static double part_of(double h, double strength, double w) {
  return hk_damper_part(h * strength * w) / w;
}

static void damp_element(const struct hk_dampers *d, const struct hk_element *e, const double *wind,
                         double *const v[3]) {
  const double *inverse_mass = d->system->inverse_mass;
  double w = 0.0, rate[3] = {0.0}, b[3];
  for (int j = 0; j < e->count; j++) {
    w += (e->weight[j] * e->weight[j]) * inverse_mass[e->particle[j]];
    for (int a = 0; a < 3; a++)
      rate[a] = j > 0 ? rate[a] + e->weight[j] * v[a][e->particle[j]] : e->weight[j] * v[a][e->particle[j]];
  }
  if (!(w > 0.0)) return;
  for (int a = 0; a < 3 && wind; a++) /* of drag, whose weights are 1 */
    rate[a] -= wind[a];
  const double along = (e->u[0] * rate[0] + e->u[1] * rate[1]) + e->u[2] * rate[2];
  double impulse = part_of(d->h, e->c_along / e->over, w) * along;
  if (e->pull_only) {
    const double least = -(d->h * e->elastic);
    if (impulse < least) impulse = least;
    if (!(e->elastic > 0.0)) impulse = 0.0;
  }
  for (int a = 0; a < 3; a++)
    b[a] = impulse * e->u[a];
  if (e->c_across > 0.0) {
    const double across = part_of(d->h, e->c_across / e->over, w);
    for (int a = 0; a < 3; a++)
      b[a] += across * (rate[a] - along * e->u[a]);
  }
  for (int j = 0; j < e->count; j++) {
    const double by = inverse_mass[e->particle[j]] * e->weight[j];
    for (int a = 0; a < 3; a++)
      v[a][e->particle[j]] -= by * b[a];
  }
}

static void damp_force(const struct hk_dampers *d, const struct hk_force_row *row, double t,
                       int32_t backwards, double *const v[3]) {
  double wind[3];
  hk_wind_at(d->system, t, wind);
  struct hk_element element[HOOKE_ELEMENTS];
  const int64_t count = hk_force_count(d->system, row);
  for (int64_t done = 0; done < count;) {
    const int64_t left = count - done, some = left < HOOKE_ELEMENTS ? left : HOOKE_ELEMENTS;
    const int64_t first = backwards ? left - some : done;
    memset(element, 0, sizeof element);
    row->elements(d->system, t, d->rows, NULL, first, some, element);
    /* an anchor of no length has no direction, and brakes nothing there */
    for (int64_t k = 0; k < some && row->members; k++)
      element[k].c_across = 0.0;
    for (int64_t k = 0; k < some; k++)
      damp_element(d, &element[backwards ? some - 1 - k : k], row->is_drag ? wind : NULL, v);
    done += some;
  }
}

static void damp_others(const struct hk_dampers *d, const struct hk_motion *motion, double t,
                        int32_t backwards) {
  if (d->rows == NULL) return;
  hk_rows_from_components(motion->n, motion->q, d->rows);
  for (int32_t k = 0; k < HOOKE_FORCES; k++) {
    const struct hk_force_row *row = hk_force_table(backwards ? HOOKE_FORCES - 1 - k : k);
    if (row->kind & HOOKE_OTHERS && hk_force_is_damped(d->system, row))
      damp_force(d, row, t, backwards, motion->v);
  }
}

static void drag(const struct hk_dampers *d, const struct hk_motion *motion) {
  for (int a = 0; a < 3 && d->drag; a++) {
    for (int64_t p = 0; p < motion->n; p++)
      motion->v[a][p] /= d->drag[p];
  }
}

void hk_dampers_sweep(struct hk_dampers *d, struct hk_motion *motion, double t, int32_t backwards) {
  if (d->system->springs->scaled) take_numbers(d->system, t, d);
  struct sweep sweep = {d, motion, backwards};
  if (backwards) {
    drag(d, motion);
    damp_others(d, motion, t, 1);
  }
  if (d->colours.springs > 0) hk_pool_run(motion->pool, go_over, &sweep);
  if (!backwards) {
    damp_others(d, motion, t, 0);
    drag(d, motion);
  }
}
