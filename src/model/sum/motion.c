#include "model/sum/motion.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/vector_loops.h"
#include "model/coordinates/coordinates.h"
#include "model/force/drive.h"
#include "model/force/force.h"
#include "model/sum/tiled.h"

#include <string.h>

/* Minimum number of springs for each worker, so that its work takes some ten times as long as the barriers;
 * and fractions of the work of all workers at their borders. */
enum { SPRINGS_A_MEMBER = 8192, BORDERS_A_MEMBER = 8 };

int32_t hk_motion_members(const hooke_system *system, int32_t most) {
  const int64_t border =
      system->tiled->particles > 0 ? system->tiled->ring : system->strided->count * system->strided->reach;
  int64_t workers = 1;
  if (system->tiled->particles > 0 || system->strided->count > 0)
    workers = system->springs->count / (SPRINGS_A_MEMBER + BORDERS_A_MEMBER * border);
  if (workers > most) workers = most;
  if (workers > hk_pool_processors()) workers = hk_pool_processors();
  return workers > 1 ? (int32_t)workers : 1;
}

static int64_t driven_count(const hooke_system *system) {
  int64_t count = 0;
  for (int64_t k = 0; k < system->drive_count; k++)
    count += system->drive[k].count;
  return count;
}

int32_t hk_goes_by_tiles(const hooke_system *system) {
  int by_tiles = system->strided->count > 0 || system->tiled->particles > 0;
  by_tiles &= !(system->falls && system->gravity_factor); /* which their moves do not know */
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    by_tiles &= row->add == NULL || row->kind & (HOOKE_LOOPED | HOOKE_UNIFORM) ||
                (row == &hk_force_bending && system->strided->bent > 0);
  }
  return by_tiles;
}

struct arrays {
  double *block;
  int64_t n, count, stride, rest; /* `count` arrays of n particles, and `rest` numbers after them */
};

/* Each worker clears its own part, so that it is placed near it; the last one clears the rest. */
static void clear(int32_t worker, int32_t workers, void *ctx) {
  const struct arrays *arrays = ctx;
  const int last = worker + 1 == workers;
  const int64_t from = hk_pool_share(arrays->n, HOOKE_TILE, worker, workers),
                to = last ? arrays->stride : hk_pool_share(arrays->n, HOOKE_TILE, worker + 1, workers);
  for (int64_t k = 0; k < arrays->count; k++)
    memset(arrays->block + k * arrays->stride + from, 0, (size_t)(to - from) * sizeof(double));
  if (last) memset(arrays->block + arrays->count * arrays->stride, 0, (size_t)arrays->rest * sizeof(double));
}

/* Arrays of n numbers each, and other data of that size. */
static int32_t new_arrays(const hooke_system *system, int32_t how, struct hk_motion *motion) {
  const int64_t n = system->particle_count;
  /* rounded up to a cache line, and not a power of two apart: equal low address bits would conflict in cache
   * sets. Loops over strided batches read past the last particle. */
  const int64_t beyond = system->strided->count > 0 ? system->strided->reach + HOOKE_STRIDED_UNIT : 0;
  const int64_t stride = (n + beyond + 7) / 8 * 8 + 24, arrays = how == HOOKE_MOTION_BY_TILES ? 6 : 9;
  const int64_t components = arrays * stride, rows = system->force ? 9 * n : 0; /* in their own block */
  const int64_t numbers = components + 3 * system->pin_count;
  double *block = hk_reserve(numbers, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  struct arrays cleared = {block, n, arrays, stride, numbers - components};
  hk_pool_run(motion->pool, clear, &cleared);
  motion->n = n;
  motion->memory += (numbers + rows + 6 * driven_count(system)) * (int64_t)sizeof(double);
  for (int a = 0; a < 3; a++) {
    motion->q[a] = block + a * stride;
    motion->v[a] = block + (3 + a) * stride;
    if (arrays == 9) motion->f[a] = block + (6 + a) * stride;
  }
  motion->rows = system->force ? hk_rows_new(rows) : NULL;
  motion->still = block + components;
  motion->driven = hk_new(system->drive_count, sizeof *motion->driven);
  if (motion->driven == NULL) return HOOKE_NO_MEMORY;
  for (; motion->drive_count < system->drive_count; motion->drive_count++) {
    double **driven = &motion->driven[motion->drive_count];
    *driven = hk_rows_new(6 * system->drive[motion->drive_count].count);
    if (*driven == NULL) return HOOKE_NO_MEMORY;
  }
  return system->force && motion->rows == NULL ? HOOKE_NO_MEMORY : HOOKE_OK;
}

/* Working numbers of anchored and driven particles. `slot` (NULL: the caller's numbers) is indexed by the
 * caller's. */
static void number_held(const hooke_system *system, const int32_t *slot, struct hk_motion *motion) {
  int32_t *moved = motion->moved;
  for (int64_t k = 0; k < system->pin_count; k++)
    motion->pin[k] = slot ? slot[system->pin[k]] : system->pin[k];
  for (int64_t d = 0; d < system->drive_count; d++) {
    for (int64_t k = 0; k < system->drive[d].count; k++) {
      const int32_t p = system->drive[d].particle[k];
      *moved++ = slot ? slot[p] : p;
    }
  }
}

/* Working numbers by the caller's; NULL without memory. */
static int32_t *invert_order(const struct hk_motion *motion) {
  int32_t *number = hk_new(motion->n, sizeof *number);
  for (int64_t p = 0; number && p < motion->n; p++)
    number[motion->order[p]] = (int32_t)p;
  return number;
}

static int32_t new_numbers(const hooke_system *system, struct hk_motion *motion) {
  const int64_t count = system->pin_count + driven_count(system);
  motion->pin = hk_new(count, sizeof *motion->pin);
  if (motion->pin == NULL) return HOOKE_NO_MEMORY;
  motion->moved = motion->pin + system->pin_count;
  motion->memory += count * (int64_t)sizeof *motion->pin;
  int32_t *slot = NULL;
  if (motion->order && count > 0) {
    slot = invert_order(motion);
    if (slot == NULL) return HOOKE_NO_MEMORY;
  }
  number_held(system, slot, motion);
  hk_free(slot);
  return HOOKE_OK;
}

static int32_t new_scratch(const hooke_system *system, struct hk_motion *motion) {
  if (system->strided->count > 0) {
    motion->rings = hk_rings_create(system->strided, hk_pool_members(motion->pool));
    if (motion->rings == NULL) return HOOKE_NO_MEMORY;
  }
  if (system->tiled->particles > 0) {
    motion->tiled = hk_tiled_scratch_create(system->tiled, hk_pool_members(motion->pool));
    if (motion->tiled == NULL) return HOOKE_NO_MEMORY;
  }
  motion->memory += hk_rings_memory(motion->rings) + hk_tiled_scratch_memory(motion->tiled);
  return HOOKE_OK;
}

int32_t hk_motion_create(const hooke_system *system, int32_t how, struct hk_pool *pool,
                         struct hk_motion **out) {
  struct hk_motion *motion = hk_new(1, sizeof *motion);
  if (motion == NULL) return HOOKE_NO_MEMORY;
  motion->pool = pool;
  motion->order = how & HOOKE_MOTION_BY_TILES ? system->tiled->order : NULL;
  motion->w = motion->order ? system->tiled->inverse_mass : system->inverse_mass;
  int32_t status = new_arrays(system, how, motion);
  if (status == HOOKE_OK) status = new_numbers(system, motion);
  if (status == HOOKE_OK) status = new_scratch(system, motion);
  return HOOKE_HAND_OVER(status, motion, out, hk_motion_destroy);
}

void hk_motion_destroy(struct hk_motion *motion) {
  if (motion == NULL) return;
  hk_rings_destroy(motion->rings);
  hk_tiled_scratch_destroy(motion->tiled);
  hk_free(motion->pin);
  hk_free(motion->number);
  hooke_rows_hold(motion->rows, -1);
  for (int64_t k = 0; k < motion->drive_count; k++)
    hooke_rows_hold(motion->driven[k], -1);
  hk_free(motion->driven);
  hk_free(motion->q[0]);
  hk_free(motion);
}

void hk_rows_from_components(int64_t n, double *const component[3], double *rows) {
  hk_join_rows(n, component[0], component[1], component[2], rows);
}

void hk_components_from_rows(int64_t n, const double *rows, double *const component[3]) {
  double *x = component[0], *y = component[1], *z = component[2];
  for (int64_t p = 0; p < n; p++) {
    x[p] = rows[3 * p];
    y[p] = rows[3 * p + 1];
    z[p] = rows[3 * p + 2];
  }
}

/* Rows in the caller's numbering. */
static void load_rows(const struct hk_motion *motion, const double *rows, double *const component[3]) {
  for (int64_t p = 0; p < motion->n; p++) {
    const double *row = rows + 3 * (motion->order ? (int64_t)motion->order[p] : p);
    for (int a = 0; a < 3; a++)
      component[a][p] = row[a];
  }
}

static void store_rows(const struct hk_motion *motion, double *const component[3], double *rows) {
  if (motion->order == NULL) {
    hk_rows_from_components(motion->n, component, rows);
    return;
  }
  for (int64_t p = 0; p < motion->n; p++) {
    double *row = rows + 3 * (int64_t)motion->order[p];
    for (int a = 0; a < 3; a++)
      row[a] = component[a][p];
  }
}

void hk_motion_load(const hooke_system *system, struct hk_motion *motion, const double *q, const double *v) {
  load_rows(motion, q, motion->q);
  load_rows(motion, v, motion->v);
  for (int64_t k = 0; k < system->pin_count; k++)
    memcpy(motion->still + 3 * k, q + 3 * (int64_t)system->pin[k], 3 * sizeof(double));
  motion->stop_value = 0;
}

void hk_motion_store(const struct hk_motion *motion, double *q, double *v) {
  store_rows(motion, motion->q, q);
  store_rows(motion, motion->v, v);
}

static void exchange_rows(const struct hk_motion *motion, double *const component[3], double *rows) {
  for (int64_t p = 0; p < motion->n; p++) {
    double *row = rows + 3 * (motion->order ? (int64_t)motion->order[p] : p);
    for (int a = 0; a < 3; a++) {
      const double kept = row[a];
      row[a] = component[a][p];
      component[a][p] = kept;
    }
  }
}

void hk_motion_exchange(struct hk_motion *motion, double *q, double *v) {
  exchange_rows(motion, motion->q, q);
  exchange_rows(motion, motion->v, v);
}

/* 1 if a row differs in a bit. */
static int differs(const double *row, double x, double y, double z) {
  return memcmp(&row[0], &x, sizeof x) || memcmp(&row[1], &y, sizeof y) || memcmp(&row[2], &z, sizeof z);
}

static int same_rows(const struct hk_motion *motion, double *const component[3], const double *rows) {
  const double *x = component[0], *y = component[1], *z = component[2];
  if (motion->order == NULL) return hk_differing_bits(motion->n, x, y, z, rows) == 0;
  for (int64_t p = 0; p < motion->n; p++) {
    if (differs(rows + 3 * (int64_t)motion->order[p], x[p], y[p], z[p])) return 0;
  }
  return 1;
}

int32_t hk_motion_is_at(const struct hk_motion *motion, const double *q, const double *v) {
  return same_rows(motion, motion->q, q) && same_rows(motion, motion->v, v);
}

int32_t hk_motion_know_numbers(struct hk_motion *motion) {
  if (motion->order == NULL || motion->number) return HOOKE_OK;
  motion->number = invert_order(motion);
  if (motion->number == NULL) return HOOKE_NO_MEMORY;
  motion->memory += motion->n * (int64_t)sizeof *motion->number;
  return HOOKE_OK;
}

int64_t hk_motion_number(const struct hk_motion *motion, int64_t particle) {
  return motion->order ? motion->number[particle] : particle;
}

/* Index of a particle among the anchored ones, which ascend; for another particle that of one before it, or
 * 0. */
static int64_t find_pin(const hooke_system *system, int64_t particle) {
  int64_t low = 0, high = system->pin_count;
  while (high - low > 1) {
    const int64_t middle = low + (high - low) / 2;
    if (system->pin[middle] > particle)
      high = middle;
    else
      low = middle;
  }
  return low;
}

void hk_motion_place(const hooke_system *system, struct hk_motion *motion, int64_t particle, const double *q,
                     const double *v) {
  const int64_t p = hk_motion_number(motion, particle);
  for (int a = 0; a < 3; a++) {
    if (q) motion->q[a][p] = q[a];
    if (v) motion->v[a][p] = v[a];
  }
  const int64_t k = find_pin(system, particle);
  if (q && k < system->pin_count && system->pin[k] == particle)
    memcpy(motion->still + 3 * k, q, 3 * sizeof(double));
}

struct copying {
  const struct hk_motion *motion;
  double *slot;
  int32_t back;
};

static void copy_share(int32_t worker, int32_t workers, void *ctx) {
  const struct copying *copying = ctx;
  const struct hk_motion *m = copying->motion;
  const int64_t from = hk_pool_share(m->n, HOOKE_TILE, worker, workers),
                count = hk_pool_share(m->n, HOOKE_TILE, worker + 1, workers) - from;
  for (int a = 0; a < 6; a++) {
    double *here = (a < 3 ? m->q[a] : m->v[a - 3]) + from, *there = copying->slot + a * m->n + from;
    memcpy(copying->back ? here : there, copying->back ? there : here, (size_t)count * sizeof(double));
  }
}

void hk_motion_save(const struct hk_motion *motion, double *slot) {
  hk_pool_run(motion->pool, copy_share, &(struct copying){motion, slot, 0});
}

void hk_motion_restore(struct hk_motion *motion, double *slot) {
  hk_pool_run(motion->pool, copy_share, &(struct copying){motion, slot, 1});
}

static void clear_forces(int32_t worker, int32_t workers, void *ctx) {
  const struct hk_motion *m = ctx;
  const int64_t from = hk_pool_share(m->n, HOOKE_TILE, worker, workers),
                count = hk_pool_share(m->n, HOOKE_TILE, worker + 1, workers) - from;
  for (int a = 0; a < 3; a++)
    memset(m->f[a] + from, 0, (size_t)count * sizeof(double));
}

/* With movers: of what is stepped by itself, and where forces may act on movers. */
static void clear_stepped(const hooke_system *system, struct hk_motion *motion) {
  for (int64_t s = 0; s < system->span_count; s++) {
    for (int a = 0; a < 3; a++)
      memset(motion->f[a] + system->span[s].from, 0, (size_t)system->span[s].count * sizeof(double));
  }
  for (int64_t k = 0; k < system->mover_count; k++)
    system->mover[k].row->clear(system->mover[k].thing, motion->f);
}

int32_t hk_motion_forces(const hooke_system *system, struct hk_motion *motion, double t) {
  return hk_motion_forces_without(system, motion, t, 0);
}

int32_t hk_motion_forces_without(const hooke_system *system, struct hk_motion *motion, double t,
                                 int32_t left_out) {
  if (system->mover_count > 0 && system->force == NULL)
    clear_stepped(system, motion);
  else
    hk_pool_run(motion->pool, clear_forces, motion);
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->add == NULL || row->kind & left_out) continue;
    const int32_t status = row->add(system, motion, t);
    if (status != HOOKE_OK) return status;
  }
  return HOOKE_OK;
}

/* ---- one pass over memory: sums of springs, and their use ---- */

struct tile_move {
  const struct hooke_system *system;
  struct hk_motion *motion;
  const struct hk_move *move;
};

/* Forces are zero before springs are added, so sums are the forces. */
static void keep_tile(int64_t from, int64_t count, double *const f[3], void *ctx) {
  const struct tile_move *to = ctx;
  const int32_t *order = to->motion->order ? NULL : to->system->tiled->order;
  for (int a = 0; a < 3; a++) {
    double *kept = to->motion->f[a];
    if (order == NULL) memcpy(kept + from, f[a], (size_t)count * sizeof(double));
    for (int64_t k = 0; k < count && order; k++)
      kept[order[from + k]] = f[a][k];
  }
}

static void move_tile(int64_t from, int64_t count, double *const f[3], void *ctx) {
  const struct tile_move *to = ctx;
  const struct hk_moved moved = hk_motion_moved(to->motion);
  const double *const force[3] = {f[0], f[1], f[2]};
  hk_spring_set(0)->move(to->move, &moved, (ptrdiff_t)from, (ptrdiff_t)count, force);
}

struct hk_moved hk_motion_moved(const struct hk_motion *motion) {
  return (struct hk_moved){motion->w, motion->q[0], motion->v[0], hk_motion_stride(motion)};
}

void hk_motion_pass(const hooke_system *system, struct hk_motion *motion, double t,
                    const struct hk_move *move) {
  struct tile_move to = {system, motion, move};
  const int64_t shortness = system->strided->count > 0
                                ? hk_strided_batches_pass(system, motion, t, move)
                                : hk_tiled_pass(system->tiled, motion, t,
                                                move->kind == HOOKE_MOVE_KEEP ? keep_tile : move_tile, &to);
  hk_motion_keep_short(motion, shortness);
}

/* ---- held particles ---- */

int32_t hk_motion_drive(const hooke_system *system, struct hk_motion *motion, double t) {
  for (int64_t k = 0; k < system->drive_count; k++) {
    const struct hk_drive_group *drive = &system->drive[k];
    if (hk_rows_renew(6 * drive->count, &motion->driven[k]) != HOOKE_OK) return HOOKE_NO_MEMORY;
    double *q = motion->driven[k];
    const int32_t value = hk_drive_evaluate(drive, t, q, q + 3 * drive->count);
    if (value != 0) {
      motion->stop_value = value;
      return hk_fail(HOOKE_STOPPED, NULL, "a drive callback returned %d at t = %.6g s", (int)value, t);
    }
  }
  return HOOKE_OK;
}

/* `count` particles with the numbers `moved`. */
static void hold_driven(int64_t count, const int32_t *moved, const double *q, struct hk_motion *motion) {
  const double *v = q + 3 * count;
  for (int64_t k = 0; k < count; k++) {
    const int32_t p = moved[k];
    for (int a = 0; a < 3; a++) {
      motion->q[a][p] = q[3 * k + a];
      motion->v[a][p] = v[3 * k + a];
    }
  }
}

void hk_motion_hold(const hooke_system *system, struct hk_motion *motion) {
  for (int64_t k = 0; k < system->pin_count; k++) {
    const int32_t p = motion->pin[k];
    for (int a = 0; a < 3; a++) {
      motion->q[a][p] = motion->still[3 * k + a];
      motion->v[a][p] = 0.0;
    }
  }
  const int32_t *moved = motion->moved;
  for (int64_t k = 0; k < system->drive_count; k++) {
    const int64_t count = system->drive[k].count;
    hold_driven(count, moved, motion->driven[k], motion);
    moved += count;
  }
}
