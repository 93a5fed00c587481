/* Queries of a system. */
#include "core/memory.h"
#include "model/derived.h"
#include "model/force/drive.h"
#include "model/force/obstacle.h"
#include "model/sum/spring_batch.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

int32_t hooke_system_is_committed(const hooke_system *system) {
  return system->rest->committed;
}

int64_t hooke_system_particle_count(const hooke_system *system) {
  return system->particle_count;
}

const double *hooke_system_mass(const hooke_system *system) {
  return system->rest->committed ? system->mass : NULL;
}

const double *hooke_system_inverse_mass(const hooke_system *system) {
  return system->inverse_mass;
}

double hk_diagonal(int64_t count, const double *position) {
  double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY}, longest = 0.0;
  for (int64_t k = 0; k < 3 * count; k++) {
    low[k % 3] = fmin(low[k % 3], position[k]);
    high[k % 3] = fmax(high[k % 3], position[k]);
  }
  for (int a = 0; a < 3 && count > 0; a++)
    longest = fmax(longest, high[a] - low[a]);
  return count > 0 ? fmax(longest, hk_distance3(high, low)) : 0.0; /* squares of tiny sides are 0 */
}

int64_t hooke_system_coincident_springs(const hooke_system *system, const double *q) {
  int64_t count = hk_obstacles_without_direction(system, system->moment, q);
  double length[HOOKE_SPRING_BATCH];
  struct hk_spring_batch batch;
  for (hk_begin_batches(HOOKE_AS_GIVEN, &batch); hk_next_batch(system, &batch);) {
    const struct hk_some_springs springs = hk_batch_springs(&batch);
    hk_some_lengths(&springs, q, length);
    for (int64_t k = 0; k < batch.count; k++)
      count += length[k] == 0.0 && batch.rest_length[k] != 0.0;
  }
  return count;
}

const char *hooke_system_force_name(const hooke_system *system, int64_t force) {
  return force >= 0 && force < system->force_row_count ? system->force_row[force]->name : NULL;
}

/* ---- counts ---- */

static int64_t free_count(const hooke_system *system) {
  int64_t count = 0;
  for (int64_t p = 0; p < system->particle_count; p++)
    count += system->constrained[p] == 0;
  return count;
}

static int64_t dropped_springs(const hooke_system *system) {
  int64_t count = 0;
  for (int64_t k = 0; k < hk_system_groups_of(system, &hk_force_springs); k++)
    count += system->group[k].dropped - system->group[k].inside;
  return count;
}

static int64_t inside_bodies(const hooke_system *system) {
  int64_t count = 0;
  for (int64_t k = 0; k < system->group_count; k++)
    count += system->group[k].inside;
  return count;
}

static int64_t spring_memory(const hooke_system *system) {
  return hk_force_springs.memory(system) + hk_tiled_spring_memory(system->tiled);
}

static int64_t memory(const hooke_system *system) {
  int64_t bytes = (int64_t)(sizeof *system + sizeof *system->rest) + system->strided->memory +
                  hk_tiled_memory(system->tiled);
  for (int32_t k = 0; hk_force_table(k); k++)
    bytes += hk_force_table(k)->memory ? hk_force_table(k)->memory(system) : 0;
  bytes += system->rest->particle_capacity * (int64_t)((system->velocity ? 7 : 4) * sizeof(double) + 1) +
           (system->overdamped ? 2 : 1) * system->particle_count * (int64_t)sizeof(double) +
           (system->constrained_count + system->pin_count) * (int64_t)sizeof(int32_t);
  if (system->gravity_factor)
    bytes += (system->rest->particle_capacity + HOOKE_STRIDED_UNIT) * (int64_t)sizeof(double);
  if (system->rest->start.undeformed) bytes += 3 * system->particle_count * (int64_t)sizeof(double);
  bytes += hk_movers_memory(system);
  bytes += system->group_count * (int64_t)sizeof *system->group +
           hk_room_of(system->rest->derived_count) * (int64_t)sizeof *system->rest->derived +
           system->drive_count * (int64_t)sizeof *system->drive;
  for (int64_t g = 0; g < system->group_count; g++)
    bytes += hk_scaling_memory(system->group[g].scaling);
  for (int64_t k = 0; k < system->drive_count; k++) {
    bytes += system->drive[k].count * 28 + system->drive[k].course.samples * 56;
  }
  return bytes;
}

int64_t hooke_system_count(const hooke_system *system, const char *what) {
  static const struct {
    const char *name;
    int64_t (*count)(const hooke_system *system);
  } counts[] = {{"free", free_count}, {"dropped_springs", dropped_springs}, {"blocks", hk_system_block_count},
                {"memory", memory},   {"spring_memory", spring_memory},     {"inside_bodies", inside_bodies}};
  const struct {
    const char *name;
    int64_t count;
  } known[] = {{"idle", system->idle_count},
               {"forces", system->force_row_count},
               {"derived", system->rest->derived_count},
               {"bodies", system->bodies->count}};
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++)
    if (strcmp(counts[k].name, what) == 0) return counts[k].count(system);
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
    if (strcmp(known[k].name, what) == 0) return known[k].count;
  const struct hk_force_row *force = hk_force_find(what);
  return force && force->member_particles > 0 ? hk_system_members_of(system, force) : -1;
}
