#include "model/check_value.h"

#include "core/crc32.h"
#include "model/sum/spring_batch.h"

#include <stddef.h>

static void add(uint32_t *value, const void *bytes, int64_t count, size_t size) {
  *value = hk_crc32(*value, bytes, count * (int64_t)size);
}

static void add_whole(uint32_t *value, int64_t number) {
  add(value, &number, 1, sizeof number);
}

static void add_particles(uint32_t *value, const hooke_system *system) {
  const int64_t n = system->particle_count;
  add_whole(value, n);
  add(value, system->position, 3 * n, sizeof(double));
  add_whole(value, system->velocity != NULL);
  if (system->velocity) add(value, system->velocity, 3 * n, sizeof(double));
  add(value, system->mass, n, sizeof(double));
  add(value, system->held, n, 1);
}

static void add_springs(uint32_t *value, const hooke_system *system) {
  struct hk_spring_batch batch;
  add_whole(value, system->springs.count);
  for (hk_begin_batches(&batch); hk_next_batch(system, &batch);) {
    add(value, batch.head, batch.count, sizeof *batch.head);
    add(value, batch.tail, batch.count, sizeof *batch.tail);
    add(value, batch.kappa, batch.count, sizeof(double));
    add(value, batch.gamma, batch.count, sizeof(double));
    add(value, batch.rest_length, batch.count, sizeof(double));
    add_whole(value, batch.pull_only);
  }
}

static void add_bending(uint32_t *value, const hooke_system *system) {
  struct hk_triple triple;
  add_whole(value, system->bending.count);
  for (struct hk_triples at = {&system->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    add(value, triple.particle, 3, sizeof *triple.particle);
    add(value, &triple.coefficient, 1, sizeof(double));
  }
}

static void add_altitudes(uint32_t *value, const hooke_system *system) {
  add_whole(value, system->altitudes.count);
  for (int64_t k = 0; k < system->altitudes.count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes.tetrahedron[k];
    add(value, t->particle, 4, sizeof *t->particle);
    add_whole(value, t->choice);
    add_whole(value, t->pull_only);
    add(value, &t->side, 1, sizeof(double));
    add(value, &t->stiffness, 1, sizeof(double));
    add(value, &t->damping, 1, sizeof(double));
    add(value, t->rest, HOOKE_ALTITUDES, sizeof(double));
  }
}

static void add_drives(uint32_t *value, const hooke_system *system) {
  add_whole(value, system->drive_count);
  for (int64_t k = 0; k < system->drive_count; k++) {
    const struct hk_drive_group *drive = &system->drive[k];
    add_whole(value, drive->kind);
    add_whole(value, drive->count);
    add(value, drive->particle, drive->count, sizeof *drive->particle);
    add(value, drive->origin, 3 * drive->count, sizeof(double));
    add(value, drive->amplitude, 3, sizeof(double));
    add(value, &drive->frequency, 1, sizeof(double));
    add(value, &drive->phase, 1, sizeof(double));
    add_whole(value, drive->samples);
    add(value, drive->time, drive->samples, sizeof(double));
    add(value, drive->displacement, 3 * drive->samples, sizeof(double));
  }
}

uint32_t hk_system_check_value(const hooke_system *system) {
  uint32_t value = 0;
  add_particles(&value, system);
  add_springs(&value, system);
  add_bending(&value, system);
  add_altitudes(&value, system);
  add(&value, system->gravity, 3, sizeof(double));
  add(&value, &system->drag, 1, sizeof(double));
  add_whole(&value, system->force != NULL);
  add_drives(&value, system);
  return value;
}
