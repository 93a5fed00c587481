#include "model/check_value.h"

#include "core/crc32.h"
#include "model/coordinates/coordinates.h"
#include "model/force/drive.h"
#include "model/force/force.h"
#include "model/start.h"

void hk_check_add(uint32_t *value, const void *bytes, int64_t count, size_t size) {
  *value = hk_crc32(*value, bytes, count * (int64_t)size);
}

void hk_check_whole(uint32_t *value, int64_t number) {
  hk_check_add(value, &number, 1, sizeof number);
}

static void add_particles(const hooke_system *system, uint32_t *value) {
  const int64_t n = system->particle_count;
  hk_check_whole(value, n);
  hk_check_add(value, system->position, 3 * n, sizeof(double));
  hk_check_whole(value, system->velocity != NULL);
  if (system->velocity) hk_check_add(value, system->velocity, 3 * n, sizeof(double));
  const double *undeformed = hk_undeformed_position(system);
  hk_check_whole(value, undeformed != system->position);
  if (undeformed != system->position) hk_check_add(value, undeformed, 3 * n, sizeof(double));
  hk_check_add(value, system->inertia, n, sizeof(double));
  if (system->overdamped) hk_check_add(value, system->mass, n, sizeof(double));
  hk_check_add(value, system->constrained, n, 1);
}

static void add_drives(const hooke_system *system, uint32_t *value) {
  hk_check_whole(value, system->drive_count);
  for (int64_t k = 0; k < system->drive_count; k++) {
    const struct hk_drive_group *drive = &system->drive[k];
    hk_check_whole(value, drive->callback != NULL);
    hk_check_whole(value, drive->count);
    hk_check_add(value, drive->particle, drive->count, sizeof *drive->particle);
    hk_check_add(value, drive->origin, 3 * drive->count, sizeof(double));
    hk_course_check(&drive->course, value);
  }
}

static const struct {
  const char *name;
  void (*add)(const hooke_system *system, uint32_t *value);
} pieces[] = {{"particles", add_particles}, {"driven", add_drives}};

enum { PIECES = sizeof pieces / sizeof pieces[0] };

/* Adds one of these, a kind of coordinates or a force; returns its name, NULL past the last. A force that
 * does not say what it depends on equals no other. */
static const char *add_piece(const hooke_system *system, int32_t k, uint32_t *value) {
  if (k < PIECES) {
    pieces[k].add(system, value);
    return pieces[k].name;
  }
  const struct hk_coordinates_row *coordinates = hk_coordinates_table(k - PIECES);
  if (coordinates) {
    coordinates->check(system, value);
    return coordinates->name;
  }
  const struct hk_force_row *row = hk_force_table(k - PIECES - HOOKE_COORDINATES);
  if (row == NULL) return NULL;
  const int32_t present = hk_force_is_present(system, row);
  hk_check_whole(value, present);
  if (present && row->check)
    row->check(system, value);
  else if (present)
    hk_check_add(value, &system, 1, sizeof system);
  return row->name;
}

uint32_t hk_system_check_value(const hooke_system *system) {
  uint32_t value = 0;
  for (int32_t k = 0; add_piece(system, k, &value); k++)
    continue;
  return value;
}

const char *hk_system_difference(const hooke_system *one, const hooke_system *other) {
  const char *name;
  uint32_t value = 0, expected = 0;
  for (int32_t k = 0; (name = add_piece(one, k, &value)) != NULL; k++) {
    add_piece(other, k, &expected);
    if (value != expected) return name;
  }
  return NULL;
}
