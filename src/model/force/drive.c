#include "model/force/drive.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

void hk_drive_release(struct hk_drive_group *drive) {
  hk_free(drive->particle);
  hk_free(drive->origin);
  hk_course_release(&drive->course);
}

int32_t hk_drive_evaluate(const struct hk_drive_group *drive, double t, double *q, double *v) {
  if (drive->callback) return drive->callback(drive->count, t, q, v, drive->ctx);
  double d[3], rate[3];
  hk_course_at(&drive->course, t, d, rate);
  for (int64_t k = 0; k < drive->count; k++) {
    for (int a = 0; a < 3; a++) {
      q[3 * k + a] = drive->origin[3 * k + a] + d[a];
      v[3 * k + a] = rate[a];
    }
  }
  return 0;
}

/* ---- building ---- */

/* Appends a drive and marks its particles; on failure the system is unchanged. */
static int32_t append_drive(hooke_system *system, struct hk_drive_group drive, const int64_t *particles) {
  const int32_t status = hk_room((void **)&system->drive, system->drive_count, sizeof *system->drive);
  drive.particle = hk_new(drive.count, sizeof *drive.particle);
  drive.origin = hk_new(3 * drive.count, sizeof(double));
  if (status != HOOKE_OK || drive.particle == NULL || drive.origin == NULL) {
    hk_drive_release(&drive);
    return HOOKE_NO_MEMORY;
  }
  for (int64_t k = 0; k < drive.count; k++) {
    drive.particle[k] = (int32_t)particles[k];
    memcpy(drive.origin + 3 * k, system->position + 3 * particles[k], 3 * sizeof(double));
    system->constrained[particles[k]] = HOOKE_IS_DRIVEN;
  }
  system->drive[system->drive_count++] = drive;
  return HOOKE_OK;
}

static int32_t check_driven(const hooke_system *system, int64_t count, const int64_t *particles) {
  int32_t status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;
  if (count < 0 || count > INT32_MAX)
    return hk_fail(HOOKE_BAD_VALUE, "particles", "%lld particles; allowed: 0 to 2147483647, each once",
                   (long long)count);
  /* if there are more than particles, one of the first is repeated */
  if (count > system->particle_count) count = system->particle_count + 1;
  status =
      hk_system_check_particles(system, "particles", count, particles, HOOKE_IS_PINNED | HOOKE_IS_DRIVEN);
  if (status != HOOKE_OK) return status;
  /* a particle repeated in one list */
  uint8_t *seen = hk_new(system->particle_count, 1);
  if (seen == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++) {
    if (seen[particles[k]]) {
      hk_fail(HOOKE_BAD_VALUE, NULL, "particle %lld is named twice; a particle is driven once",
              (long long)particles[k]);
      status = hk_fail_within(HOOKE_BAD_VALUE, "particles[%lld]", (long long)k);
    }
    seen[particles[k]] = 1;
  }
  hk_free(seen);
  return status;
}

int32_t hooke_system_drive_harmonic(hooke_system *system, int64_t count, const int64_t *particles,
                                    const double *amplitude, double frequency, double phase) {
  int32_t status = check_driven(system, count, particles);
  if (status == HOOKE_OK) status = hk_require_finite("amplitude", 3, 1, amplitude);
  if (status == HOOKE_OK) status = hk_require_finite("frequency", 1, 1, &frequency);
  if (status == HOOKE_OK) status = hk_require_finite("phase", 1, 1, &phase);
  if (status != HOOKE_OK) return status;
  struct hk_drive_group drive = {.count = count,
                                 .course = {.width = 3, .frequency = frequency, .phase = phase}};
  memcpy(drive.course.amplitude, amplitude, sizeof drive.course.amplitude);
  return append_drive(system, drive, particles);
}

int32_t hooke_system_drive_table(hooke_system *system, int64_t count, const int64_t *particles,
                                 int64_t samples, const double *time, const double *displacement) {
  int32_t status = check_driven(system, count, particles);
  if (status != HOOKE_OK) return status;
  struct hk_drive_group drive = {.count = count, .course = {.width = 3}};
  status = hk_course_set_table(&drive.course, "position", samples, time, displacement, hk_parabolic_slopes);
  if (status == HOOKE_OK) return append_drive(system, drive, particles);
  hk_drive_release(&drive);
  return status;
}

int32_t hooke_system_drive_callback(hooke_system *system, int64_t count, const int64_t *particles,
                                    hooke_drive *callback, void *ctx) {
  int32_t status = check_driven(system, count, particles);
  if (status != HOOKE_OK) return status;
  struct hk_drive_group drive = {.count = count, .callback = callback, .ctx = ctx};
  return append_drive(system, drive, particles);
}

/* ---- supports ---- */

void hk_support_reaction(const hooke_system *system, int64_t p, const double a[3], const double f[3],
                         double reaction[3]) {
  const int32_t inert = !system->overdamped || system->has_gravity;
  const double factor = system->gravity_factor ? system->gravity_factor[p] : 1.0;
  for (int k = 0; k < 3; k++)
    reaction[k] = (inert ? system->mass[p] * (a[k] - factor * system->gravity[k]) : 0.0) - f[k];
}

/* In place of the forces. */
static void add_driven(const hooke_system *system, const struct hk_drive_group *drive, double t,
                       double *reaction) {
  double a[3] = {0.0};
  if (drive->callback && !system->overdamped)
    a[0] = a[1] = a[2] = NAN;
  else if (!system->overdamped)
    hk_course_acceleration(&drive->course, t, a);
  for (int64_t k = 0; k < drive->count; k++) {
    double *at = reaction + 3 * (int64_t)drive->particle[k];
    hk_support_reaction(system, drive->particle[k], a, at, at);
  }
}

int32_t hooke_system_reaction(const hooke_system *system, double t, const double *q, const double *v,
                              double *reaction) {
  static const double rest[3];
  const int32_t status = hooke_system_force(system, t, q, v, reaction);
  if (status != HOOKE_OK) return status;
  for (int64_t d = 0; d < system->drive_count; d++)
    add_driven(system, &system->drive[d], t, reaction);
  for (int64_t p = 0; p < system->particle_count; p++) {
    double *at = reaction + 3 * p;
    const int32_t in_body = system->bodies->count > 0 && system->bodies->of[p] >= 0;
    if (system->constrained[p] == HOOKE_IS_PINNED) hk_support_reaction(system, p, rest, at, at);
    for (int k = 0; k < 3; k++)
      at[k] = !system->constrained[p] ? 0.0 : in_body ? (double)NAN : at[k];
  }
  return HOOKE_OK;
}
