#include "model/force/drive.h"

#include "core/memory.h"
#include "core/sine.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

void hk_drive_release(struct hk_drive_group *drive) {
  hk_free(drive->particle);
  hk_free(drive->origin);
  hk_free(drive->time);
  hk_free(drive->displacement);
  hk_free(drive->slope);
}

/* ---- motion ---- */

static void harmonic_displacement(const struct hk_drive_group *drive, double t, double *d, double *rate) {
  const double two_pi = 6.28318530717958647693;
  double sine, cosine;
  hk_sine_of_turns(drive->frequency * t + drive->phase / two_pi, &sine, &cosine);
  for (int a = 0; a < 3; a++) {
    d[a] = drive->amplitude[a] * sine;
    rate[a] = drive->amplitude[a] * (two_pi * drive->frequency) * cosine;
  }
}

static void table_displacement(const struct hk_drive_group *drive, double t, double *d, double *rate) {
  const double *time = drive->time;
  const int64_t last = drive->samples - 1;
  if (t <= time[0] || t >= time[last]) {
    memcpy(d, drive->displacement + (t <= time[0] ? 0 : 3 * last), 3 * sizeof(double));
    rate[0] = rate[1] = rate[2] = 0.0;
    return;
  }
  int64_t low = 0, high = last;
  while (high - low > 1) {
    int64_t middle = low + (high - low) / 2;
    if (time[middle] <= t)
      low = middle;
    else
      high = middle;
  }
  /* cubic Hermite on [time[low], time[high]] */
  const double width = time[high] - time[low], s = (t - time[low]) / width;
  for (int a = 0; a < 3; a++) {
    const double p0 = drive->displacement[3 * low + a], p1 = drive->displacement[3 * high + a];
    const double m0 = width * drive->slope[3 * low + a], m1 = width * drive->slope[3 * high + a];
    const double c2 = 3.0 * (p1 - p0) - 2.0 * m0 - m1, c3 = 2.0 * (p0 - p1) + m0 + m1;
    d[a] = p0 + s * (m0 + s * (c2 + s * c3));
    rate[a] = (m0 + s * (2.0 * c2 + s * (3.0 * c3))) / width;
  }
}

int32_t hk_drive_evaluate(const struct hk_drive_group *drive, double t, double *q, double *v) {
  if (drive->kind == HOOKE_DRIVE_CALLBACK) return drive->callback(drive->count, t, q, v, drive->ctx);
  double d[3], rate[3];
  if (drive->kind == HOOKE_DRIVE_HARMONIC)
    harmonic_displacement(drive, t, d, rate);
  else
    table_displacement(drive, t, d, rate);
  for (int64_t k = 0; k < drive->count; k++) {
    for (int a = 0; a < 3; a++) {
      q[3 * k + a] = drive->origin[3 * k + a] + d[a];
      v[3 * k + a] = rate[a];
    }
  }
  return 0;
}

/* ---- building ---- */

/* Slope at every sample of the parabola through it and its neighbours (at the ends: through the first or last
 * three). */
static void find_slopes(struct hk_drive_group *drive) {
  const int64_t m = drive->samples;
  for (int64_t k = 0; k < m; k++) {
    for (int a = 0; a < 3; a++) {
      const double *p = drive->displacement + a, *t = drive->time;
      int64_t i = k == 0 ? 1 : k == m - 1 ? m - 2 : k;
      if (m == 2) {
        drive->slope[3 * k + a] = (p[3] - p[0]) / (t[1] - t[0]);
        continue;
      }
      double h0 = t[i] - t[i - 1], h1 = t[i + 1] - t[i];
      double s0 = (p[3 * i] - p[3 * (i - 1)]) / h0, s1 = (p[3 * (i + 1)] - p[3 * i]) / h1;
      double curve = (s1 - s0) / (h0 + h1); /* half the second derivative */
      drive->slope[3 * k + a] = s0 + curve * (h0 + 2.0 * (t[k] - t[i]));
    }
  }
}

/* Appends a drive and marks its particles; on failure the system is unchanged. */
static int32_t append_drive(hooke_system *system, struct hk_drive_group drive, const int64_t *particles) {
  int32_t status = HOOKE_OK;
  if (system->drive_count == system->rest->drive_capacity) {
    int64_t capacity = 2 * system->rest->drive_capacity + 4;
    status = hk_grow((void **)&system->drive, system->drive_count, capacity, sizeof *system->drive);
    if (status == HOOKE_OK) system->rest->drive_capacity = capacity;
  }
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
  struct hk_drive_group drive = {
      .kind = HOOKE_DRIVE_HARMONIC, .count = count, .frequency = frequency, .phase = phase};
  memcpy(drive.amplitude, amplitude, sizeof drive.amplitude);
  return append_drive(system, drive, particles);
}

static int32_t check_table(int64_t samples, const double *time, const double *displacement) {
  if (samples < 2) {
    return hk_fail(HOOKE_BAD_VALUE, "time", "%lld samples; a table needs 2 or more", (long long)samples);
  }
  for (int64_t k = 0; k < samples; k++) {
    if (!isfinite(time[k]) || (k > 0 && !(time[k] > time[k - 1]))) {
      hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; times are finite and ascend", time[k]);
      return hk_fail_within(HOOKE_BAD_VALUE, "time[%lld]", (long long)k);
    }
  }
  return hk_require_finite("position", samples, 3, displacement);
}

int32_t hooke_system_drive_table(hooke_system *system, int64_t count, const int64_t *particles,
                                 int64_t samples, const double *time, const double *displacement) {
  int32_t status = check_driven(system, count, particles);
  if (status == HOOKE_OK) status = check_table(samples, time, displacement);
  if (status != HOOKE_OK) return status;
  struct hk_drive_group drive = {.kind = HOOKE_DRIVE_TABLE, .count = count, .samples = samples};
  drive.time = hk_new(samples, sizeof(double));
  drive.displacement = hk_new(3 * samples, sizeof(double));
  drive.slope = hk_new(3 * samples, sizeof(double));
  if (drive.time == NULL || drive.displacement == NULL || drive.slope == NULL) {
    hk_drive_release(&drive);
    return HOOKE_NO_MEMORY;
  }
  memcpy(drive.time, time, (size_t)samples * sizeof(double));
  memcpy(drive.displacement, displacement, (size_t)(3 * samples) * sizeof(double));
  find_slopes(&drive);
  return append_drive(system, drive, particles);
}

int32_t hooke_system_drive_callback(hooke_system *system, int64_t count, const int64_t *particles,
                                    hooke_drive *callback, void *ctx) {
  int32_t status = check_driven(system, count, particles);
  if (status != HOOKE_OK) return status;
  struct hk_drive_group drive = {
      .kind = HOOKE_DRIVE_CALLBACK, .count = count, .callback = callback, .ctx = ctx};
  return append_drive(system, drive, particles);
}
