#include "measure/trial/frames.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

int32_t hk_frames_create(const hooke_system *system, int64_t count, struct hk_frames *frames) {
  const int64_t size = 3 * hooke_system_particle_count(system);
  *frames = (struct hk_frames){.system = system, .count = count, .size = size};
  double *block = hk_new(count, (size_t)(size + 3) * sizeof(double));
  frames->time = block;
  frames->free_particle = hk_new(hooke_system_count(system, "free"), sizeof(int64_t));
  if (block == NULL || frames->free_particle == NULL) {
    hk_frames_release(frames);
    return HOOKE_NO_MEMORY;
  }
  frames->time = hk_part(&block, count);
  frames->energy = hk_part(&block, count);
  frames->rounding = hk_part(&block, count);
  frames->position = block;
  for (int64_t p = 0; p < system->particle_count; p++)
    if (system->inverse_mass[p] > 0.0) frames->free_particle[frames->free_count++] = p;
  return HOOKE_OK;
}

void hk_frames_release(struct hk_frames *frames) {
  hk_free(frames->time);
  hk_free(frames->free_particle);
  hk_watched_series_release(&frames->watched);
  memset(frames, 0, sizeof *frames);
}

void hk_frames_record(struct hk_frames *frames, const hooke_state *state) {
  if (frames->recorded >= frames->count) return;
  const int64_t f = frames->recorded++;
  const double *q = hooke_state_position(state);
  frames->time[f] = hooke_state_time(state);
  frames->energy[f] =
      hooke_system_energy_at(frames->system, "total", frames->time[f], q, hooke_state_velocity(state));
  hk_watched_series_keep(&frames->watched, f, frames->time[f], q, hooke_state_velocity(state));
  if (frames->size > 0) memcpy(frames->position + f * frames->size, q, (size_t)frames->size * sizeof(double));
}

double hk_frames_distance(const struct hk_frames *frames, int64_t f, const double *q, double *largest) {
  const double *reference = frames->position + f * frames->size;
  double sum = 0.0, most = 0.0;
  for (int64_t k = 0; k < frames->free_count; k++) {
    const int64_t i = 3 * frames->free_particle[k];
    const double dx = q[i] - reference[i], dy = q[i + 1] - reference[i + 1], dz = q[i + 2] - reference[i + 2];
    const double square = (dx * dx + dy * dy) + dz * dz;
    sum += square;
    most = fmax(most, square);
  }
  if (largest) *largest = sqrt(most);
  return frames->free_count > 0 ? sqrt(sum / (double)frames->free_count) : 0.0;
}

double hk_frames_resolution(const struct hk_frames *frames, const double *q) {
  double most = 0.0;
  for (int64_t k = 0; k < frames->free_count; k++)
    for (const double *x = q + 3 * frames->free_particle[k], *end = x + 3; x < end; x++)
      most = fmax(most, fabs(*x));
  return 0.5 * (nextafter(most, INFINITY) - most);
}
