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

struct list {
  struct hk_needs *needs;
  uint8_t *watched; /* by particle */
  int32_t status;   /* the first failure, after which no row is added */
};

/* Adds a row with these words; returns what it leaves out, NULL after a failure. */
static struct hk_variant *add_row(struct list *list, const char *kind, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static struct hk_variant *add_row(struct list *list, const char *kind, const char *format, ...) {
  struct hk_needs *needs = list->needs;
  if (list->status == HOOKE_OK)
    list->status = hk_room((void **)&needs->row, needs->row_count, sizeof *needs->row);
  if (list->status != HOOKE_OK) return NULL;
  struct hk_needs_row *made = &needs->row[needs->row_count];
  *made = (struct hk_needs_row){.kind = kind, .needed = 1, .cost = hk_needs_no_cost};
  va_list args;
  va_start(args, format);
  hk_print_list(made->without, sizeof made->without, format, args);
  va_end(args);
  list->status = hk_variant_create(needs->m->system, &made->variant);
  if (list->status != HOOKE_OK) return NULL;
  needs->row_count++;
  return &made->variant;
}

/* A group may have the name of another ingredient. */
static int32_t is_taken(const char *name) {
  const struct hk_force_row *force = hk_force_find(name);
  return strcmp(name, "damping") == 0 || (force && force->copy);
}

static void list_groups(struct list *list) {
  const hooke_system *system = list->needs->m->system;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    const char *kind = group->force->name;
    const int64_t number = g - hk_system_first_group(system, group->force);
    const int32_t taken = is_taken(group->name);
    if (group->count == 0) continue;
    struct hk_variant *variant =
        group->name[0] ? add_row(list, kind, "%s%s%s", taken ? kind : "", taken ? " " : "", group->name)
                       : add_row(list, kind, "%s[%lld]", kind, (long long)number);
    if (variant) variant->group[g] = 1;
  }
}

static int32_t resists_compression(const hooke_system *system) {
  int32_t resists = 0;
  for (int64_t g = 0; g < system->group_count; g++)
    resists |= system->group[g].count > 0 && hk_group_resists(&system->group[g]);
  return resists;
}

static void list_whole_forces(struct list *list) {
  const hooke_system *system = list->needs->m->system;
  struct hk_variant *variant;
  if (hk_system_has_dampers(system)) {
    variant = add_row(list, "damping", "damping");
    if (variant) variant->damping = 1;
  }
  for (int32_t k = 0; hk_force_table(k); k++) {
    const struct hk_force_row *force = hk_force_table(k);
    if (!force->copy || !hk_force_is_present(system, force)) continue;
    variant = add_row(list, force->name, "%s", force->name);
    if (variant) variant->without[k] = 1;
  }
  if (resists_compression(system)) {
    variant = add_row(list, "compression", "resistance to compression");
    if (variant) variant->compression = 1;
  }
}

static void list_loose(struct list *list) {
  const hooke_system *system = list->needs->m->system;
  uint8_t *touched = hk_new(system->particle_count, 1);
  if (touched == NULL) {
    list->status = HOOKE_NO_MEMORY;
    return;
  }
  hk_system_mark_touched(system, touched);
  /* particles of parts go with these, and those of bodies have mass in them */
  for (int64_t k = 0; k < system->part_count; k++)
    memset(touched + system->part[k].first, 1, (size_t)system->part[k].count);
  for (int64_t p = 0; p < system->particle_count && system->bodies->of; p++)
    touched[p] |= system->bodies->of[p] >= 0;
  int64_t loose = 0;
  for (int64_t p = 0; p < system->particle_count; p++)
    loose += !touched[p] && !list->watched[p];
  if (loose > 0) {
    struct hk_variant *variant =
        loose == 1 ? add_row(list, "loose", "a particle that touches nothing")
                   : add_row(list, "loose", "%lld particles that touch nothing", (long long)loose);
    for (int64_t p = 0; p < system->particle_count && variant; p++)
      variant->particle[p] = !touched[p] && !list->watched[p];
  }
  hk_free(touched);
}

static void list_parts(struct list *list) {
  const hooke_system *system = list->needs->m->system;
  for (int64_t k = 0; k < system->part_count; k++) {
    const struct hk_part_record *part = &system->part[k];
    if (memchr(list->watched + part->first, 1, (size_t)part->count)) continue;
    struct hk_variant *variant = add_row(list, "part", "%s", part->name);
    if (variant) variant->part[k] = 1;
  }
}

static void list_resolutions(struct list *list) {
  const hooke_system *system = list->needs->m->system;
  for (int64_t k = 0; k < system->part_count; k++) {
    int64_t cells[3], made[3];
    const int32_t axes = hk_variant_cells(&system->part[k], 0.5, cells, made);
    if (axes == 0 || memcmp(cells, made, (size_t)axes * sizeof *cells) == 0) continue;
    struct hk_variant *variant =
        add_row(list, "resolution", "half the resolution of %s", system->part[k].name);
    if (variant) variant->scale[k] = 0.5;
  }
}

/* 1 if a part has forces inside, and may be one body: it is none, nor in one, and nothing drives it. */
static int32_t may_be_rigid(const hooke_system *system, int64_t part) {
  const struct hk_part_record *record = &system->part[part];
  int64_t inside = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    if (group->from_part && group->part == part && !group->force->is_drag) inside += group->count;
  }
  for (int64_t p = record->first; p < record->first + record->count && inside > 0; p++) {
    const int32_t driven = system->constrained[p] == HOOKE_IS_DRIVEN;
    if (driven || (system->bodies->of && system->bodies->of[p] >= 0)) inside = 0;
  }
  return inside > 0 && !system->overdamped;
}

static void list_bodies(struct list *list) {
  const hooke_system *system = list->needs->m->system;
  for (int64_t k = 0; k < system->part_count; k++) {
    struct hk_variant *variant =
        may_be_rigid(system, k) ? add_row(list, "rigid", "deformation of %s", system->part[k].name) : NULL;
    if (variant) variant->rigid[k] = 1;
  }
}

int32_t hk_needs_drops(const struct hk_needs *needs, const struct hk_variant *variant, int64_t group) {
  const struct hk_group *of = &needs->m->system->group[group];
  return variant->group[group] || (of->from_part && (variant->part[of->part] || variant->rigid[of->part]));
}

/* 1 if the variant leaves out, changes or makes anew a group that is kept. */
static int32_t touches_kept(const struct hk_needs *needs, const struct hk_variant *variant) {
  const hooke_system *system = needs->m->system;
  int32_t touches = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    if (!needs->kept[g]) continue;
    touches |= hk_needs_drops(needs, variant, g) || (variant->damping && group->damped) ||
               (variant->compression && hk_group_resists(group)) ||
               (group->from_part && variant->scale[group->part] != 1.0);
  }
  return touches;
}

int32_t hk_needs_list(struct hk_needs *needs) {
  struct list list = {.needs = needs, .watched = hk_new(needs->m->system->particle_count, 1)};
  if (list.watched == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < needs->watch_count; k++)
    list.watched[needs->watch[k]] = 1;
  list_groups(&list);
  list_whole_forces(&list);
  if (needs->m->system->springs->count > 0) add_row(&list, "idle", "springs whose force stays small");
  list_loose(&list);
  list_parts(&list);
  list_bodies(&list);
  list_resolutions(&list);
  hk_free(list.watched);
  for (int64_t k = needs->row_count - 1; k >= 0; k--)
    if (touches_kept(needs, &needs->row[k].variant)) hk_needs_drop_row(needs, k);
  return list.status;
}
