/* Building a system: particles, pins, gravity and the callback force. */
#include "model/system.h"

#include "core/handle.h"
#include "core/memory.h"
#include "core/status.h"
#include "model/derived.h"
#include "model/force/drive.h"
#include "model/generalized.h"
#include "model/part_record.h"

#include <math.h>
#include <string.h>

struct whole {
  hooke_system system;
  struct hk_system_rest rest;
};

int32_t hooke_system_create(hooke_system **system) {
  struct whole *made = hk_handle_new("hooke_system", sizeof *made);
  *system = made ? &made->system : NULL;
  if (made == NULL) return HOOKE_NO_MEMORY;
  made->system = (hooke_system){.springs = &made->rest.springs,
                                .strided = &made->rest.strided,
                                .tiled = &made->rest.tiled,
                                .altitudes = &made->rest.altitudes,
                                .bodies = &made->rest.bodies,
                                .medium = &made->rest.medium,
                                .rest = &made->rest};
  return HOOKE_OK;
}

static void release_model(hooke_system *system) {
  hk_system_undo(system);
  for (int64_t k = 0; k < system->group_count; k++)
    hk_group_release(&system->group[k]);
  for (int64_t k = 0; k < system->part_count; k++)
    hk_part_record_release(&system->part[k]);
  for (int64_t k = 0; k < system->drive_count; k++)
    hk_drive_release(&system->drive[k]);
  hk_obstacles_release(&system->rest->obstacles);
  hk_movers_release(system);
  hk_names_release(system);
  hk_medium_release(system->medium);
  hk_start_release(&system->rest->start);
  hk_system_drop_derived(system, 0);
  hk_generalized_destroy(system->generalized);
  void *const block[] = {system->position, system->velocity,   system->mass,           system->constrained,
                         system->group,    system->part,       system->gravity_factor, system->rest->derived,
                         system->drive,    system->rest->input};
  for (size_t k = 0; k < sizeof block / sizeof block[0]; k++)
    hk_free(block[k]);
  for (int k = 0; k < HOOKE_FORCE_TEXTS; k++)
    hk_free(system->rest->called_from[k]);
}

void hooke_system_destroy(hooke_system *system) {
  if (system == NULL) return;
  if (!system->borrows) release_model(system);
  hk_free(system->span);
  hk_free(system->pin);
  hk_free(system->force_row);
  hk_handle_free(system);
}

int32_t hk_system_resize(hooke_system *system, int64_t used, int64_t capacity) {
  int32_t status = hk_grow((void **)&system->position, 3 * used, 3 * capacity, sizeof(double));
  if (status == HOOKE_OK && (system->velocity || system->rest->particle_capacity == 0))
    status = hk_grow((void **)&system->velocity, 3 * used, 3 * capacity, sizeof(double));
  if (status == HOOKE_OK) status = hk_grow((void **)&system->mass, used, capacity, sizeof(double));
  if (status == HOOKE_OK) status = hk_grow((void **)&system->constrained, used, capacity, sizeof(uint8_t));
  if (status == HOOKE_OK && system->gravity_factor)
    status = hk_grow((void **)&system->gravity_factor, used, capacity + HOOKE_STRIDED_UNIT, sizeof(double));
  if (status == HOOKE_OK) system->rest->particle_capacity = capacity;
  return status;
}

/* Ensures capacity for `count` more particles. */
static int32_t reserve_particles(hooke_system *system, int64_t count) {
  const int64_t used = system->particle_count, needed = used + count;
  if (needed <= system->rest->particle_capacity) return HOOKE_OK;
  return hk_system_resize(system, used, used == 0 ? needed : needed + needed / 2);
}

static int32_t check_mass(const hooke_system *system, int64_t count, int64_t mass_count, const double *mass) {
  if (mass_count != 1 && mass_count != count && !(mass_count == 0 && system->overdamped)) {
    return hk_fail(HOOKE_BAD_VALUE, "mass", "%lld masses for %lld particles; allowed: one, or one for each",
                   (long long)mass_count, (long long)count);
  }
  for (int64_t k = 0; k < mass_count; k++) {
    /* the inverse has to be finite, too */
    if (mass[k] > 0.0 && isfinite(mass[k]) && isfinite(1.0 / mass[k])) continue;
    if (mass[k] == 0.0 && system->overdamped) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL,
            "%g is not allowed; a mass is a number > 0 (pin a particle to hold it still)", mass[k]);
    return mass_count == 1 ? hk_fail_within(HOOKE_BAD_VALUE, "mass")
                           : hk_fail_within(HOOKE_BAD_VALUE, "mass[%lld]", (long long)k);
  }
  return HOOKE_OK;
}

int32_t hooke_system_add_particles(hooke_system *system, int64_t count, const double *position,
                                   const double *velocity, int64_t mass_count, const double *mass,
                                   int64_t *first) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK && count < 0) {
    status =
        hk_fail(HOOKE_BAD_VALUE, "count", "%lld is not allowed; 0 or more particles are", (long long)count);
  }
  if (status == HOOKE_OK)
    status = hk_system_check_size(system, (struct hk_more){.particles = (double)count}, NULL);
  if (status == HOOKE_OK) status = hk_require_finite("position", count, 3, position);
  if (status == HOOKE_OK && velocity) status = hk_require_finite("velocity", count, 3, velocity);
  if (status == HOOKE_OK) status = check_mass(system, count, mass_count, mass);
  if (status == HOOKE_OK) status = reserve_particles(system, count);
  if (status != HOOKE_OK) return status;

  const int64_t n = system->particle_count;
  if (count > 0) {
    memcpy(system->position + 3 * n, position, (size_t)(3 * count) * sizeof(double));
    if (velocity) {
      memcpy(system->velocity + 3 * n, velocity, (size_t)(3 * count) * sizeof(double));
    } else {
      memset(system->velocity + 3 * n, 0, (size_t)(3 * count) * sizeof(double));
    }
    memset(system->constrained + n, 0, (size_t)count);
  }
  for (int64_t k = 0; k < count && system->gravity_factor; k++)
    system->gravity_factor[n + k] = 1.0;
  for (int64_t k = 0; k < count; k++)
    system->mass[n + k] = mass_count == 0 ? 0.0 : mass[mass_count == 1 ? 0 : k];
  system->particle_count = n + count;
  if (first) *first = n;
  return HOOKE_OK;
}

int32_t hooke_system_pin(hooke_system *system, int64_t count, const int64_t *particles) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK)
    status = hk_system_check_particles(system, "pinned", count, particles, HOOKE_IS_DRIVEN);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < count; k++)
    system->constrained[particles[k]] = HOOKE_IS_PINNED;
  return HOOKE_OK;
}

int32_t hooke_system_set_gravity(hooke_system *system, const double *gravity) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK) status = hk_require_finite("gravity", 3, 1, gravity);
  if (status != HOOKE_OK) return status;
  /* zero gravity is stored as +0, whatever the signs of the zeros */
  system->has_gravity = gravity[0] != 0.0 || gravity[1] != 0.0 || gravity[2] != 0.0;
  for (int k = 0; k < 3; k++)
    system->gravity[k] = system->has_gravity ? gravity[k] : 0.0;
  return HOOKE_OK;
}

/* Makes factors, all 1. */
static int32_t need_factors(hooke_system *system) {
  const int64_t n = system->particle_count, capacity = system->rest->particle_capacity;
  if (system->gravity_factor) return HOOKE_OK;
  system->gravity_factor = hk_new(capacity + HOOKE_STRIDED_UNIT, sizeof(double));
  for (int64_t p = 0; p < n && system->gravity_factor; p++)
    system->gravity_factor[p] = 1.0;
  return system->gravity_factor ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int32_t hooke_system_set_gravity_factor(hooke_system *system, int64_t first, int64_t count,
                                        int64_t factor_count, const double *factor) {
  int32_t status = hk_system_require_open(system), changes = 0;
  if (status == HOOKE_OK && (count < 0 || count > system->particle_count))
    status = hk_fail(HOOKE_BAD_VALUE, "count", "%lld particles of %lld", (long long)count,
                     (long long)system->particle_count);
  if (status == HOOKE_OK && (first < 0 || first > system->particle_count - count))
    status =
        hk_fail_index("first", "there is no particle", (double)first, system->particle_count - count + 1);
  if (status == HOOKE_OK && factor_count != 1 && factor_count != count)
    status = hk_fail(HOOKE_BAD_VALUE, "gravity_factor",
                     "%lld factors for %lld particles; allowed: one, or one for each",
                     (long long)factor_count, (long long)count);
  if (status == HOOKE_OK) status = hk_require_finite("gravity_factor", factor_count, 1, factor);
  for (int64_t k = 0; status == HOOKE_OK && k < factor_count; k++)
    changes |= factor[k] != 1.0;
  if (status == HOOKE_OK && changes) status = need_factors(system);
  for (int64_t k = 0; status == HOOKE_OK && k < count && system->gravity_factor; k++)
    system->gravity_factor[first + k] = factor[factor_count == 1 ? 0 : k];
  return status;
}

int32_t hk_set_gravity_factor(hooke_system *system, int64_t first, const hooke_options *options) {
  const int64_t given = hooke_options_number_count(options, "gravity_factor");
  if (given == 0) return HOOKE_OK;
  return hooke_system_set_gravity_factor(system, first, system->particle_count - first, given,
                                         hooke_options_numbers(options, "gravity_factor"));
}

int32_t hooke_system_set_force(hooke_system *system, hooke_force *force, hooke_force_product *product,
                               void *ctx) {
  int32_t status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;
  system->force = force;
  system->force_product = product;
  system->force_ctx = ctx;
  system->rest->named = NULL;
  return HOOKE_OK;
}

struct hk_system_mark hk_system_mark(const hooke_system *system) {
  return (struct hk_system_mark){system->particle_count, system->rest->derived_count, system->part_count};
}

void hk_system_roll_back(hooke_system *system, struct hk_system_mark mark) {
  hk_system_remove_groups(system, mark.part_count);
  hk_system_remove_bodies(system, mark.part_count);
  hk_system_drop_derived(system, mark.derived_count);
  system->particle_count = mark.particle_count;
  system->part_count = mark.part_count;
}
