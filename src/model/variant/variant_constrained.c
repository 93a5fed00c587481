/* Pinned and driven particles of a variant. */
#include "model/force/drive.h"
#include "model/variant/variant.h"

#include "core/memory.h"
#include "core/status.h"

#include <string.h>

enum { FREE = 0, PINNED = 1, DRIVEN = 2 }; /* DRIVEN + k: by drive k */

/* Constraint of each particle of the system; NULL without memory. */
static int64_t *how_held(const hooke_system *system) {
  int64_t *how = hk_new(system->particle_count, sizeof *how);
  if (how == NULL) return NULL;
  for (int64_t k = 0; k < system->constrained_count; k++)
    how[system->constrained_particle[k]] = PINNED;
  for (int64_t d = 0; d < system->drive_count; d++) {
    for (int64_t k = 0; k < system->drive[d].count; k++)
      how[system->drive[d].particle[k]] = DRIVEN + d;
  }
  return how;
}

/* The common constraint of all particles that a particle of a part at another resolution lies between. */
static int64_t held_between(const struct hk_variant_part *part, const int64_t *how, int64_t offset) {
  struct hk_variant_part back = *part;
  int64_t corner[8];
  double weight[8];
  memcpy(back.cells, part->made, sizeof back.cells);
  memcpy(back.made, part->cells, sizeof back.made);
  const int32_t count = hk_variant_corners(&back, offset, corner, weight);
  for (int32_t c = 1; c < count; c++) {
    if (how[corner[c]] != how[corner[0]]) return FREE;
  }
  return how[corner[0]];
}

static void carry_over(const struct hk_variant_maker *maker, const int64_t *how, int64_t *made) {
  const hooke_system *from = maker->from;
  for (int64_t k = 0; k < from->part_count; k++) {
    const struct hk_variant_part *part = &maker->map->part[k];
    if (part->first < 0 || part->axes == 0) continue;
    for (int64_t p = 0; p < part->count; p++)
      made[part->first + p] = held_between(part, how + from->part[k].first, p);
  }
  for (int64_t p = 0; p < from->particle_count; p++) {
    if (how[p] != FREE && maker->map->to[p] >= 0) made[maker->map->to[p]] = how[p];
  }
}

static int32_t add_drive(hooke_system *made, const struct hk_drive_group *drive, int64_t count,
                         const int64_t *particle) {
  const struct hk_course *course = &drive->course;
  if (!drive->callback && course->samples > 0)
    return hooke_system_drive_table(made, count, particle, course->samples, course->time, course->value);
  if (!drive->callback)
    return hooke_system_drive_harmonic(made, count, particle, course->amplitude, course->frequency,
                                       course->phase);
  if (count != drive->count) {
    return hk_fail(HOOKE_UNSUITED, NULL, "a drive callback moves %lld particles, which would become %lld",
                   (long long)drive->count, (long long)count);
  }
  return hooke_system_drive_callback(made, count, particle, drive->callback, drive->ctx);
}

/* In the order of the drive, on which its callback depends, and then those between them, which no callback
 * knows; takes them out of `how`. */
static int64_t list_driven(const struct hk_variant_maker *maker, int64_t d, int64_t *how, int64_t *list) {
  const struct hk_drive_group *drive = &maker->from->drive[d];
  int64_t count = 0;
  for (int64_t k = 0; k < drive->count; k++) {
    const int64_t to = maker->map->to[drive->particle[k]];
    if (to < 0 || how[to] != DRIVEN + d) continue;
    list[count++] = to;
    how[to] = FREE;
  }
  for (int64_t p = 0; p < maker->made->particle_count && !drive->callback; p++) {
    if (how[p] == DRIVEN + d) list[count++] = p;
  }
  return count;
}

int32_t hk_variant_constrain(struct hk_variant_maker *maker) {
  const int64_t n = maker->made->particle_count;
  int64_t most = n;
  for (int64_t d = 0; d < maker->from->drive_count; d++)
    most = maker->from->drive[d].count > most ? maker->from->drive[d].count : most;
  int64_t *how = how_held(maker->from), *made = hk_new(n, sizeof *made), *list = hk_new(most, sizeof *list);
  int32_t status = how && made && list ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    carry_over(maker, how, made);
    int64_t count = 0;
    for (int64_t p = 0; p < n; p++) {
      if (made[p] == PINNED) list[count++] = p;
    }
    status = hooke_system_pin(maker->made, count, list);
  }
  for (int64_t d = 0; d < maker->from->drive_count && status == HOOKE_OK; d++) {
    const int64_t count = list_driven(maker, d, made, list);
    if (count > 0) status = add_drive(maker->made, &maker->from->drive[d], count, list);
  }
  hk_free(how);
  hk_free(made);
  hk_free(list);
  return status;
}
