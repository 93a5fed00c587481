#include "model/check_value.h"

#include "core/crc32.h"
#include "model/force/force.h"

#include <stddef.h>

void hk_check_add(uint32_t *value, const void *bytes, int64_t count, size_t size) {
  *value = hk_crc32(*value, bytes, count * (int64_t)size);
}

void hk_check_whole(uint32_t *value, int64_t number) {
  hk_check_add(value, &number, 1, sizeof number);
}

static void add_particles(uint32_t *value, const hooke_system *system) {
  const int64_t n = system->particle_count;
  hk_check_whole(value, n);
  hk_check_add(value, system->position, 3 * n, sizeof(double));
  hk_check_whole(value, system->velocity != NULL);
  if (system->velocity) hk_check_add(value, system->velocity, 3 * n, sizeof(double));
  hk_check_add(value, system->mass, n, sizeof(double));
  hk_check_add(value, system->constrained, n, 1);
}

static void add_drives(uint32_t *value, const hooke_system *system) {
  hk_check_whole(value, system->drive_count);
  for (int64_t k = 0; k < system->drive_count; k++) {
    const struct hk_drive_group *drive = &system->drive[k];
    hk_check_whole(value, drive->kind);
    hk_check_whole(value, drive->count);
    hk_check_add(value, drive->particle, drive->count, sizeof *drive->particle);
    hk_check_add(value, drive->origin, 3 * drive->count, sizeof(double));
    hk_check_add(value, drive->amplitude, 3, sizeof(double));
    hk_check_add(value, &drive->frequency, 1, sizeof(double));
    hk_check_add(value, &drive->phase, 1, sizeof(double));
    hk_check_whole(value, drive->samples);
    hk_check_add(value, drive->time, drive->samples, sizeof(double));
    hk_check_add(value, drive->displacement, 3 * drive->samples, sizeof(double));
  }
}

static void add_bodies(uint32_t *value, const hooke_system *system) {
  for (int64_t k = 0; k < system->bodies.count; k++) {
    const struct hk_body *body = &system->bodies.body[k];
    hk_check_whole(value, body->count);
    hk_check_add(value, body->particle, body->count, sizeof *body->particle);
  }
}

uint32_t hk_system_check_value(const hooke_system *system) {
  uint32_t value = 0;
  add_particles(&value, system);
  for (int32_t k = 0; hk_force_table(k); k++) {
    if (hk_force_table(k)->check) hk_force_table(k)->check(system, &value);
  }
  hk_check_add(&value, system->gravity, 3, sizeof(double));
  hk_check_add(&value, &system->drag, 1, sizeof(double));
  if (system->friction > 0.0) {
    hk_check_add(&value, system->weight, system->particle_count, sizeof(double));
    hk_check_add(&value, system->pull, 3, sizeof(double));
  }
  hk_check_whole(&value, system->force != NULL);
  add_drives(&value, system);
  add_bodies(&value, system);
  return value;
}
