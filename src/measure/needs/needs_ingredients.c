/* The ingredients of a scene, as rows that may be left out. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "measure/spectrum/naming.h"
#include "model/coordinates/body.h"
#include "model/force/spring.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* The last row, made from the words. */
static int32_t add_row(struct hk_needs *needs, const char *kind, struct hk_needs_row **row,
                       const char *format, ...) __attribute__((format(printf, 4, 5)));
static int32_t add_row(struct hk_needs *needs, const char *kind, struct hk_needs_row **row,
                       const char *format, ...) {
  if (needs->row_count == needs->row_capacity) {
    const int64_t capacity = 2 * needs->row_capacity + 8;
    const int32_t status = hk_grow((void **)&needs->row, needs->row_count, capacity, sizeof *needs->row);
    if (status != HOOKE_OK) return status;
    needs->row_capacity = capacity;
  }
  struct hk_needs_row *made = &needs->row[needs->row_count];
  *made = (struct hk_needs_row){.kind = kind, .needed = 1, .cost = hk_needs_no_cost};
  va_list args;
  va_start(args, format);
  hk_print_list(made->without, sizeof made->without, format, args);
  va_end(args);
  const int32_t status = hk_variant_create(needs->system, &made->variant);
  if (status != HOOKE_OK) return status;
  needs->row_count++;
  *row = made;
  return HOOKE_OK;
}

/* A group may have the name of another ingredient. */
static int32_t is_taken(const char *name) {
  const struct hk_force_row *force = hk_force_find(name);
  return strcmp(name, "damping") == 0 || (force && force->copy);
}

static int32_t list_groups(struct hk_needs *needs) {
  const hooke_system *system = needs->system;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    const char *kind = group->force->name;
    const int64_t number = g - hk_system_first_group(system, group->force);
    struct hk_needs_row *row;
    if (group->count == 0) continue;
    const int32_t status = group->name[0]
                               ? add_row(needs, kind, &row, "%s%s%s", is_taken(group->name) ? kind : "",
                                         is_taken(group->name) ? " " : "", group->name)
                               : add_row(needs, kind, &row, "%s[%lld]", kind, (long long)number);
    if (status != HOOKE_OK) return status;
    row->variant.group[g] = 1;
  }
  return HOOKE_OK;
}

static int32_t resists_compression(const hooke_system *system) {
  int32_t resists = 0;
  for (int64_t g = 0; g < system->group_count; g++)
    resists |= system->group[g].count > 0 && hk_group_resists(&system->group[g]);
  return resists;
}

static int32_t list_whole_forces(struct hk_needs *needs) {
  const hooke_system *system = needs->system;
  struct hk_needs_row *row;
  int32_t status = HOOKE_OK;
  if (hk_system_is_damped(system, ~HOOKE_UNIFORM)) {
    status = add_row(needs, "damping", &row, "damping");
    if (status == HOOKE_OK) row->variant.damping = 1;
  }
  for (int32_t k = 0; hk_force_table(k) && status == HOOKE_OK; k++) {
    const struct hk_force_row *force = hk_force_table(k);
    if (!force->copy || !hk_force_is_present(system, force)) continue;
    status = add_row(needs, force->name, &row, "%s", force->name);
    if (status == HOOKE_OK) row->variant.without[k] = 1;
  }
  if (status == HOOKE_OK && resists_compression(system)) {
    status = add_row(needs, "compression", &row, "resistance to compression");
    if (status == HOOKE_OK) row->variant.compression = 1;
  }
  return status;
}

static int32_t list_loose(struct hk_needs *needs, const uint8_t *watched) {
  const hooke_system *system = needs->system;
  uint8_t *touched = hk_new(system->particle_count, 1);
  if (touched == NULL) return HOOKE_NO_MEMORY;
  hk_system_mark_touched(system, touched);
  /* particles of parts go with these, and those of bodies have mass in them */
  for (int64_t k = 0; k < system->part_count; k++)
    memset(touched + system->part[k].first, 1, (size_t)system->part[k].count);
  for (int64_t p = 0; p < system->particle_count && system->bodies->of; p++)
    touched[p] |= system->bodies->of[p] >= 0;
  int64_t loose = 0;
  for (int64_t p = 0; p < system->particle_count; p++)
    loose += !touched[p] && !watched[p];
  struct hk_needs_row *row;
  int32_t status = HOOKE_OK;
  if (loose > 0) {
    status = loose == 1
                 ? add_row(needs, "loose", &row, "a particle that touches nothing")
                 : add_row(needs, "loose", &row, "%lld particles that touch nothing", (long long)loose);
    for (int64_t p = 0; p < system->particle_count && status == HOOKE_OK; p++)
      row->variant.particle[p] = !touched[p] && !watched[p];
  }
  hk_free(touched);
  return status;
}

static int32_t list_parts(struct hk_needs *needs, const uint8_t *watched) {
  const hooke_system *system = needs->system;
  for (int64_t k = 0; k < system->part_count; k++) {
    const struct hk_part_record *part = &system->part[k];
    struct hk_needs_row *row;
    if (memchr(watched + part->first, 1, (size_t)part->count)) continue;
    const int32_t status = add_row(needs, "part", &row, "%s", part->name);
    if (status != HOOKE_OK) return status;
    row->variant.part[k] = 1;
  }
  return HOOKE_OK;
}

static int32_t list_resolutions(struct hk_needs *needs) {
  const hooke_system *system = needs->system;
  for (int64_t k = 0; k < system->part_count; k++) {
    int64_t cells[3], made[3];
    struct hk_needs_row *row;
    const int32_t axes = hk_variant_cells(&system->part[k], 0.5, cells, made);
    if (axes == 0 || memcmp(cells, made, (size_t)axes * sizeof *cells) == 0) continue;
    const int32_t status =
        add_row(needs, "resolution", &row, "half the resolution of %s", system->part[k].name);
    if (status != HOOKE_OK) return status;
    row->variant.scale[k] = 0.5;
  }
  return HOOKE_OK;
}

/* 1 if a part has forces inside, and may be one body: it is none, nor in one, and nothing drives it. */
static int32_t may_be_rigid(const hooke_system *system, int64_t part) {
  const struct hk_part_record *record = &system->part[part];
  int64_t inside = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    if (group->from_part && group->part == part) inside += group->count;
  }
  for (int64_t p = record->first; p < record->first + record->count && inside > 0; p++) {
    const int32_t driven = system->constrained[p] == HOOKE_IS_DRIVEN;
    if (driven || (system->bodies->of && system->bodies->of[p] >= 0)) inside = 0;
  }
  return inside > 0 && !system->overdamped;
}

static int32_t list_bodies(struct hk_needs *needs) {
  const hooke_system *system = needs->system;
  for (int64_t k = 0; k < system->part_count; k++) {
    struct hk_needs_row *row;
    if (!may_be_rigid(system, k)) continue;
    const int32_t status = add_row(needs, "rigid", &row, "deformation of %s", system->part[k].name);
    if (status != HOOKE_OK) return status;
    row->variant.rigid[k] = 1;
  }
  return HOOKE_OK;
}

int32_t hk_needs_list(struct hk_needs *needs) {
  uint8_t *watched = hk_new(needs->system->particle_count, 1);
  if (watched == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < needs->watch_count; k++)
    watched[needs->watch[k]] = 1;
  int32_t status = list_groups(needs);
  if (status == HOOKE_OK) status = list_whole_forces(needs);
  struct hk_needs_row *row;
  if (status == HOOKE_OK && needs->system->springs->count > 0) {
    status = add_row(needs, "idle", &row, "springs whose force stays small");
  }
  if (status == HOOKE_OK) status = list_loose(needs, watched);
  if (status == HOOKE_OK) status = list_parts(needs, watched);
  if (status == HOOKE_OK) status = list_bodies(needs);
  if (status == HOOKE_OK) status = list_resolutions(needs);
  hk_free(watched);
  return status;
}

int64_t hk_needs_mark_idle(const struct hk_needs *needs, double force, struct hk_needs_row *row) {
  int64_t count = 0;
  for (int64_t s = 0; s < needs->system->springs->count; s++) {
    row->variant.spring[s] = needs->largest_force[s] <= force;
    count += row->variant.spring[s];
  }
  return count;
}
