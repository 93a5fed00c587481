#include "io/trajectory/frame_file.h"

#include "core/crc32.h"
#include "core/memory.h"
#include "hooke/integrator.h"
#include "io/file/bytes.h"
#include "model/state.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const struct hk_observable hk_observables[HOOKE_OBSERVABLE_COUNT] = {
    {"kinetic_energy", 1},   {"potential_energy", 1}, {"total_energy", 1},
    {"dissipated_power", 1}, {"momentum", 3},         {"angular_momentum", 3}};

static const int64_t BLOCK = 1 << 18;

int64_t hk_frame_numbers(int64_t particle_count, int array) {
  if (array == HOOKE_FRAME_POSITION || array == HOOKE_FRAME_VELOCITY) return 3 * particle_count;
  const int k = array - HOOKE_FRAME_OBSERVABLE;
  return k >= 0 && k < HOOKE_OBSERVABLE_COUNT ? hk_observables[k].columns : 1;
}

int64_t hk_frame_bytes(int64_t particle_count, int array) {
  const int64_t size = array == HOOKE_FRAME_CHECK ? (int64_t)sizeof(uint32_t) : (int64_t)sizeof(double);
  return size * hk_frame_numbers(particle_count, array);
}

double hk_frame_all_bytes(const struct hk_frame_file *file) {
  double bytes = 0.0;
  for (int k = 0; k < HOOKE_FRAME_ARRAY_COUNT; k++)
    bytes += (double)file->frame_count * (double)hk_frame_bytes(file->particle_count, k);
  return bytes;
}

void hk_frame_path(const char *group, int array, char path[HOOKE_FRAME_PATH]) {
  static const char *const moving[] = {"position/step", "position/time", "position/value", "velocity/value"};
  const int all = strcmp(group, "all") == 0;
  const char *slash = all ? "" : "/", *folder = all ? "" : group;
  if (array < HOOKE_FRAME_OBSERVABLE)
    snprintf(path, HOOKE_FRAME_PATH, "/particles/%s/%s", group, moving[array]);
  else if (array == HOOKE_FRAME_CHECK)
    snprintf(path, HOOKE_FRAME_PATH, "/hooke%s%s/frame_check", slash, folder);
  else
    snprintf(path, HOOKE_FRAME_PATH, "/observables%s%s/%s/value", slash, folder,
             hk_observables[array - HOOKE_FRAME_OBSERVABLE].name);
}

/* ---- writing ---- */

static void observe(const hooke_system *system, const hooke_state *state,
                    double value[HOOKE_OBSERVABLE_COUNT][3]) {
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const struct hk_energies energies = hk_state_energies(state, system);
  value[0][0] = energies.kinetic;
  value[1][0] = energies.potential;
  value[2][0] = value[0][0] + value[1][0];
  value[3][0] = hooke_system_dissipated_power_at(system, hooke_state_time(state), q, v);
  hooke_system_momentum(system, v, value[4]);
  hooke_system_angular_momentum(system, q, v, value[5]);
}

static int64_t place_of(const struct hk_frame_file *file, int array, int64_t frame) {
  return file->at[array] + frame * hk_frame_bytes(file->particle_count, array);
}

int hk_frame_write(const struct hk_frame_file *file, int64_t frame, int64_t step, const hooke_state *state) {
  static const int last[] = {HOOKE_FRAME_STEP, HOOKE_FRAME_CHECK, HOOKE_FRAME_TIME};
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const double t = hooke_state_time(state);
  double value[HOOKE_OBSERVABLE_COUNT][3];
  uint32_t check = 0;
  observe(file->system, state, value);
  const void *row[HOOKE_FRAME_ARRAY_COUNT] = {&step, &t, q, v};
  for (int k = 0; k < HOOKE_OBSERVABLE_COUNT; k++)
    row[HOOKE_FRAME_OBSERVABLE + k] = value[k];
  row[HOOKE_FRAME_CHECK] = &check;
  for (int k = 0; k < HOOKE_FRAME_CHECK; k++)
    check = hk_crc32(check, row[k], hk_frame_bytes(file->particle_count, k));
  int error = 0;
  for (int k = HOOKE_FRAME_POSITION; error == 0 && k < HOOKE_FRAME_CHECK + 3; k++) {
    const int array = k < HOOKE_FRAME_CHECK ? k : last[k - HOOKE_FRAME_CHECK];
    error = hk_bytes_write(file->descriptor, place_of(file, array, frame),
                           hk_frame_bytes(file->particle_count, array), row[array]);
  }
  return error;
}

/* ---- reading ---- */

static int add_row(const struct hk_frame_file *file, int array, int64_t frame, char *block, uint32_t *check) {
  const int64_t bytes = hk_frame_bytes(file->particle_count, array), at = place_of(file, array, frame);
  int error = 0;
  for (int64_t done = 0; error == 0 && done < bytes; done += BLOCK) {
    const int64_t part = bytes - done < BLOCK ? bytes - done : BLOCK;
    error = hk_bytes_read(file->descriptor, at + done, part, block);
    if (error == 0) *check = hk_crc32(*check, block, part);
  }
  return error;
}

int hk_frame_look(const struct hk_frame_file *file, int64_t frame, int32_t *whole) {
  uint32_t check = 0, stored = 0;
  double t;
  char *block = hk_reserve(BLOCK, 1);
  *whole = 0;
  if (block == NULL) return ENOMEM;
  int error = hk_bytes_read(file->descriptor, place_of(file, HOOKE_FRAME_TIME, frame), (int64_t)sizeof t, &t);
  const int32_t there = error == 0 && !isnan(t);
  for (int k = 0; there && error == 0 && k < HOOKE_FRAME_CHECK; k++)
    error = add_row(file, k, frame, block, &check);
  if (error == 0)
    error = hk_bytes_read(file->descriptor, place_of(file, HOOKE_FRAME_CHECK, frame), (int64_t)sizeof stored,
                          &stored);
  *whole = there && error == 0 && check == stored;
  hk_free(block);
  return error;
}

int hk_frame_copy(const struct hk_frame_file *from, const struct hk_frame_file *to, int64_t count) {
  char *block = hk_reserve(BLOCK, 1);
  int error = block ? 0 : ENOMEM;
  for (int k = 0; error == 0 && k < HOOKE_FRAME_ARRAY_COUNT; k++) {
    error = hk_bytes_copy(from->descriptor, from->at[k], to->descriptor, to->at[k],
                          count * hk_frame_bytes(from->particle_count, k), block, BLOCK);
  }
  hk_free(block);
  return error;
}
