/* Commit: checks the system as a whole, drops springs that do nothing, sorts the others into runs, selects
 * the present forces, frees memory that only building needed. */

#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "model/generalized.h"
#include "model/sum/spring_batch.h"
#include "model/system.h"

#include <string.h>

static int32_t check_pinned_at_rest(const hooke_system *system) {
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p] != HOOKE_IS_PINNED) continue;
    for (int a = 0; a < 3; a++) {
      const double v = system->velocity[3 * p + a];
      if (v == 0.0) continue;
      hk_fail(HOOKE_BAD_VALUE, NULL,
              "particle %lld is pinned and has velocity %g; a pinned particle has velocity 0", (long long)p,
              v);
      return hk_fail_within(HOOKE_BAD_VALUE, "particles.velocity[%lld][%d]", (long long)p, a);
    }
  }
  return HOOKE_OK;
}

static int32_t take_groups_over(hooke_system *system) {
  const int64_t springs = hk_system_first_group(system, &hk_force_springs);
  int32_t status = HOOKE_OK;
  for (int64_t g = 0; g < system->group_count && status == HOOKE_OK; g++)
    status = hk_springs_find_damping(system, &system->group[g], g - springs);
  for (int64_t g = 0; g < system->group_count && status == HOOKE_OK; g++)
    hk_group_drop(&system->group[g], system);
  for (int32_t k = 0; hk_force_table(k) && status == HOOKE_OK; k++) {
    const struct hk_force_row *force = hk_force_table(k);
    const int64_t count = hk_system_groups_of(system, force); /* without any there may be no array */
    system->rest->member_count[k] = hk_system_members_of(system, force);
    const struct hk_group *first = count > 0 ? system->group + hk_system_first_group(system, force) : NULL;
    if (force->commit) status = force->commit(system, first, count);
  }
  return status;
}

static int is_at_rest(const hooke_system *system) {
  const double zero = 0.0;
  int rest = 1;
  for (int64_t k = 0; k < 3 * system->particle_count && rest; k++)
    rest = memcmp(&system->velocity[k], &zero, sizeof zero) == 0;
  return rest;
}

/* Releases capacity for particles that were not added, and velocities that are all zero, as far as this needs
 * no further memory. */
static void trim_particles(hooke_system *system) {
  const int64_t n = system->particle_count;
  if (is_at_rest(system)) {
    hk_free(system->velocity);
    system->velocity = NULL;
  }
  if (system->rest->particle_capacity == n) return;
  hk_system_resize(system, n, n);
  if (!system->overdamped) system->inertia = system->mass;
}

static int32_t fill_particles(hooke_system *system) {
  const int64_t n = system->particle_count;
  int64_t constrained = 0;
  for (int64_t p = 0; p < n; p++)
    constrained += system->constrained[p] != 0;
  system->inverse_mass = hk_new(n + HOOKE_STRIDED_UNIT, sizeof(double)); /* loops go by whole blocks */
  system->constrained_particle = hk_new(constrained, sizeof(int32_t));
  if (system->inverse_mass == NULL || system->constrained_particle == NULL) return HOOKE_NO_MEMORY;
  for (int64_t p = 0; p < n; p++) {
    if (system->constrained[p])
      system->constrained_particle[system->constrained_count++] = (int32_t)p;
    else
      system->inverse_mass[p] = 1.0 / system->inertia[p];
  }
  return HOOKE_OK;
}

void hk_system_mark_touched(const hooke_system *system, uint8_t *touched) {
  struct hk_elements at;
  hk_begin_elements(system, 0.0, NULL, NULL, &at);
  at.kinds = ~HOOKE_UNIFORM;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    for (int j = 0; j < e->count; j++)
      touched[e->particle[j]] = 1;
  }
}

/* Of all members of a force. */
static int32_t mark_members(const hooke_system *system, const struct hk_force_row *row, uint8_t *acted) {
  struct hk_group all = {.force = row, .count = system->rest->member_count[hk_force_number(row)]};
  const int32_t status = hk_group_allocate(&all, "");
  if (status == HOOKE_OK) row->recall(system, 0, &all);
  for (int32_t e = 0; e < row->member_particles && status == HOOKE_OK; e++)
    for (int64_t k = 0; k < all.count; k++)
      acted[all.particle[e][k]] = 1;
  hk_group_release(&all);
  return status;
}

/* For movers: forces without elements act on those of their members, or on all particles. */
static int32_t find_acted(hooke_system *system) {
  uint8_t *acted = hk_new(system->particle_count, sizeof *acted);
  if (acted == NULL) return HOOKE_NO_MEMORY;
  int32_t status = HOOKE_OK;
  hk_system_mark_touched(system, acted);
  for (int32_t k = 0; k < system->force_row_count && status == HOOKE_OK; k++) {
    const struct hk_force_row *row = system->force_row[k];
    if (row->elements == NULL && row->recall)
      status = mark_members(system, row, acted);
    else if (row->add && (row->elements == NULL || row->kind == HOOKE_UNIFORM))
      memset(acted, 1, (size_t)system->particle_count);
  }
  for (int32_t k = 0; hk_coordinates_table(k) && status == HOOKE_OK; k++)
    status = hk_coordinates_table(k)->find_acted(system, acted);
  hk_free(acted);
  return status;
}

/* A tiled batch renumbers particles and moves all of them. */
static int32_t is_stepped(const hooke_system *system, const uint8_t *idle, int64_t from, int64_t end) {
  const int by_tiles = system->tiled->particles > 0 && system->mover_count == 0;
  return by_tiles || memchr(idle + from, 0, (size_t)(end - from)) != NULL;
}

/* Spans, and the pinned particles in them, counted before the list exists. */
static void add_tile(hooke_system *system, int64_t from, int64_t end) {
  struct hk_span *last = &system->span[system->span_count - 1];
  if (system->span_count > 0 && last->from + last->count == from)
    last->count += end - from;
  else
    system->span[system->span_count++] = (struct hk_span){from, end - from};
  for (int64_t p = from; p < end; p++) {
    if (system->constrained[p] != HOOKE_IS_PINNED) continue;
    if (system->pin) system->pin[system->pin_count] = (int32_t)p;
    system->pin_count++;
  }
}

static void add_tiles(hooke_system *system, const uint8_t *idle) {
  const int64_t n = system->particle_count;
  system->span_count = system->pin_count = 0;
  for (int64_t from = 0; from < n; from += HOOKE_TILE) {
    const int64_t end = from + HOOKE_TILE < n ? from + HOOKE_TILE : n;
    if (is_stepped(system, idle, from, end)) add_tile(system, from, end);
  }
}

/* Finds the particles that no step needs to visit: tiles of pinned particles that nothing acts on, and of
 * carried ones, unless strided batches sum their springs. A callback force may read any. */
static int32_t find_stepped(hooke_system *system) {
  const int64_t n = system->particle_count;
  uint8_t *idle = hk_new(n, sizeof *idle);
  system->span = hk_new(n / HOOKE_TILE / 2 + 2, sizeof *system->span);
  int32_t status = idle && system->span ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    hk_system_mark_touched(system, idle);
    for (int64_t p = 0; p < n; p++) {
      const int touched = idle[p] || system->force;
      const int carried = hk_is_carried(system, p) && !(touched && system->strided->count > 0);
      idle[p] = !touched && system->constrained[p] == HOOKE_IS_PINNED;
      system->idle_count += idle[p];
      idle[p] = idle[p] || carried;
    }
    add_tiles(system, idle);
    system->pin = hk_new(system->pin_count, sizeof *system->pin);
    if (system->pin == NULL) status = HOOKE_NO_MEMORY;
  }
  if (status == HOOKE_OK) add_tiles(system, idle);
  hk_free(idle);
  return status;
}

static int32_t choose_forces(hooke_system *system) {
  system->force_row = hk_new(HOOKE_FORCES, sizeof(const struct hk_force_row *));
  if (system->force_row == NULL) return HOOKE_NO_MEMORY;
  for (int32_t k = 0; k < HOOKE_FORCES; k++) {
    const struct hk_force_row *row = hk_force_table(k);
    if (!hk_force_is_present(system, row)) continue;
    system->force_row[system->force_row_count++] = row;
    system->sums_after_drag |= row->add && k > hk_force_number(&hk_force_drag);
  }
  return HOOKE_OK;
}

/* Of what depends on the callback force, which two systems with one model do not share. */
static void forget_own(hooke_system *system) {
  system->force_row = NULL;
  system->span = NULL;
  system->pin = NULL;
  system->idle_count = system->span_count = system->pin_count = 0;
  system->force_row_count = system->sums_after_drag = 0;
}

void hk_system_undo(hooke_system *system) {
  hk_overdamped_undo(system);
  for (int64_t k = 0; k < system->group_count; k++)
    hk_group_take_back(&system->group[k]);
  hk_movers_undo(system);
  hk_strided_batches_release(system->strided);
  hk_tiled_release(system->tiled);
  hk_forces_release(system);
  hk_free(system->inverse_mass);
  hk_free(system->constrained_particle);
  system->inverse_mass = NULL;
  system->constrained_particle = NULL;
  system->constrained_count = 0;
  hk_free(system->force_row);
  hk_free(system->span);
  hk_free(system->pin);
  forget_own(system);
}

int32_t hooke_system_commit(hooke_system *system) {
  int32_t status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;
  status = hk_start_check(system);
  if (status == HOOKE_OK) status = check_pinned_at_rest(system);
  if (status == HOOKE_OK) status = hk_groups_check_free(system);
  if (status == HOOKE_OK) status = hk_names_check(system);
  if (status == HOOKE_OK) status = hk_medium_check(system);
  if (status == HOOKE_OK) status = hk_overdamped_check(system);
  if (status == HOOKE_OK) status = hk_movers_commit(system);
  if (status == HOOKE_OK) status = hk_overdamped_begin(system);
  if (status == HOOKE_OK) status = fill_particles(system);
  if (status == HOOKE_OK) status = take_groups_over(system);
  if (status == HOOKE_OK) status = hk_overdamped_check_forces(system);
  if (status == HOOKE_OK) {
    status = hk_strided_batches_create(system->springs, &system->rest->bending, system->particle_count,
                                       system->strided);
  }
  if (status == HOOKE_OK && system->strided->count == 0) {
    status = hk_tiled_create(system->springs, system->particle_count, system->inverse_mass, system->tiled);
  }
  if (status == HOOKE_OK) status = choose_forces(system);
  if (status == HOOKE_OK) status = find_stepped(system);
  if (status == HOOKE_OK && system->mover_count > 0) status = find_acted(system);
  if (status != HOOKE_OK) {
    hk_system_undo(system);
    return status;
  }
  for (int64_t g = 0; g < system->group_count; g++)
    hk_group_release_columns(&system->group[g]);
  trim_particles(system);
  hk_start_commit(system);
  system->rest->committed = 1;
  return HOOKE_OK;
}

int32_t hooke_system_with_force(const hooke_system *system, hooke_force *force, hooke_force_product *product,
                                void *ctx, hooke_system **with) {
  *with = NULL;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_system_require_scene(system, "system", "");
  if (status != HOOKE_OK) return status;
  hooke_system *made = hk_handle_new("hooke_system", sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  *made = *system;
  made->borrows = 1;
  made->force = force;
  made->force_product = product;
  made->force_ctx = ctx;
  forget_own(made);
  status = choose_forces(made);
  if (status == HOOKE_OK) status = find_stepped(made);
  return HOOKE_HAND_OVER(status, made, with, hooke_system_destroy);
}
