#include "model/motion.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/force.h"
#include "model/lane.h"

#include <string.h>

static int64_t driven_count(const hooke_system *system) {
  int64_t count = 0;
  for (int64_t k = 0; k < system->drive_count; k++)
    count += system->drive[k].count;
  return count;
}

int32_t hooke_motion_create(const hooke_system *system, struct hooke_motion **out) {
  const int64_t n = system->particle_count;
  /* rounded up to a cache line, and not a power of two apart: equal low address bits would fight over cache
   * sets */
  const int64_t stride = (n + 7) / 8 * 8 + 24;
  const int64_t components = 9 * stride, rows = system->force ? 9 * n : 0;
  const int64_t still = 3 * system->held_count, driven = 6 * driven_count(system);
  struct hooke_motion *motion = hooke_new(1, sizeof *motion);
  double *block = hooke_new(components + rows + still + driven, sizeof(double));
  struct hooke_windows *windows = system->lanes.count ? hooke_windows_create(&system->lanes) : NULL;
  if (motion == NULL || block == NULL || (system->lanes.count && windows == NULL)) {
    hooke_windows_destroy(windows);
    hooke_free(motion);
    hooke_free(block);
    return HOOKE_NO_MEMORY;
  }
  motion->n = n;
  motion->windows = windows;
  motion->memory =
      (components + rows + still + driven) * (int64_t)sizeof(double) + hooke_windows_memory(windows);
  for (int a = 0; a < 3; a++) {
    motion->q[a] = block + a * stride;
    motion->v[a] = block + (3 + a) * stride;
    motion->f[a] = block + (6 + a) * stride;
  }
  motion->rows = rows ? block + components : NULL;
  motion->still = block + components + rows;
  motion->driven = motion->still + still;
  *out = motion;
  return HOOKE_OK;
}

void hooke_motion_destroy(struct hooke_motion *motion) {
  if (motion == NULL) return;
  hooke_windows_destroy(motion->windows);
  hooke_free(motion->q[0]);
  hooke_free(motion);
}

void hooke_rows_from_components(int64_t n, double *const component[3], double *rows) {
  const double *x = component[0], *y = component[1], *z = component[2];
  for (int64_t p = 0; p < n; p++) {
    rows[3 * p] = x[p];
    rows[3 * p + 1] = y[p];
    rows[3 * p + 2] = z[p];
  }
}

void hooke_components_from_rows(int64_t n, const double *rows, double *const component[3]) {
  double *x = component[0], *y = component[1], *z = component[2];
  for (int64_t p = 0; p < n; p++) {
    x[p] = rows[3 * p];
    y[p] = rows[3 * p + 1];
    z[p] = rows[3 * p + 2];
  }
}

void hooke_motion_load(const hooke_system *system, struct hooke_motion *motion, const double *q,
                       const double *v) {
  hooke_components_from_rows(motion->n, q, motion->q);
  hooke_components_from_rows(motion->n, v, motion->v);
  for (int64_t k = 0; k < system->held_count; k++) {
    memcpy(motion->still + 3 * k, q + 3 * (int64_t)system->held_particle[k], 3 * sizeof(double));
  }
  motion->stop_value = 0;
}

void hooke_motion_store(const struct hooke_motion *motion, double *q, double *v) {
  hooke_rows_from_components(motion->n, motion->q, q);
  hooke_rows_from_components(motion->n, motion->v, v);
}

void hooke_motion_save(const struct hooke_motion *motion, double *place) {
  const size_t bytes = (size_t)motion->n * sizeof(double);
  for (int a = 0; a < 3; a++) {
    memcpy(place + a * motion->n, motion->q[a], bytes);
    memcpy(place + (3 + a) * motion->n, motion->v[a], bytes);
  }
}

void hooke_motion_restore(struct hooke_motion *motion, const double *place) {
  const size_t bytes = (size_t)motion->n * sizeof(double);
  for (int a = 0; a < 3; a++) {
    memcpy(motion->q[a], place + a * motion->n, bytes);
    memcpy(motion->v[a], place + (3 + a) * motion->n, bytes);
  }
}

int32_t hooke_motion_forces(const hooke_system *system, struct hooke_motion *motion, double t) {
  return hooke_motion_forces_without(system, motion, t, NULL);
}

int32_t hooke_motion_forces_without(const hooke_system *system, struct hooke_motion *motion, double t,
                                    const struct hooke_force_row *left_out) {
  for (int a = 0; a < 3; a++)
    memset(motion->f[a], 0, (size_t)motion->n * sizeof(double));
  for (int32_t k = 0; k < system->force_row_count; k++) {
    const struct hooke_force_row *row = system->force_row[k];
    if (row->add == NULL || row == left_out) continue;
    const int32_t status = row->add(system, motion, t);
    if (status != HOOKE_OK) return status;
  }
  return HOOKE_OK;
}

int32_t hooke_motion_drive(const hooke_system *system, struct hooke_motion *motion, double t) {
  double *q = motion->driven;
  for (int64_t k = 0; k < system->drive_count; k++) {
    const struct hooke_drive_group *drive = &system->drive[k];
    const int32_t value = hooke_drive_evaluate(drive, t, q, q + 3 * drive->count);
    if (value != 0) {
      motion->stop_value = value;
      return hooke_fail(HOOKE_STOPPED, NULL, "a drive callback returned %d at t = %.17g s", (int)value, t);
    }
    q += 6 * drive->count;
  }
  return HOOKE_OK;
}

static void hold_driven(const struct hooke_drive_group *drive, const double *q, struct hooke_motion *motion) {
  const double *v = q + 3 * drive->count;
  for (int64_t k = 0; k < drive->count; k++) {
    const int32_t p = drive->particle[k];
    for (int a = 0; a < 3; a++) {
      motion->q[a][p] = q[3 * k + a];
      motion->v[a][p] = v[3 * k + a];
    }
  }
}

void hooke_motion_hold(const hooke_system *system, struct hooke_motion *motion) {
  for (int64_t k = 0; k < system->held_count; k++) {
    const int32_t p = system->held_particle[k];
    if (system->held[p] != HOOKE_HELD_PINNED) continue;
    for (int a = 0; a < 3; a++) {
      motion->q[a][p] = motion->still[3 * k + a];
      motion->v[a][p] = 0.0;
    }
  }
  const double *driven = motion->driven;
  for (int64_t k = 0; k < system->drive_count; k++) {
    hold_driven(&system->drive[k], driven, motion);
    driven += 6 * system->drive[k].count;
  }
}
