#include "io/frame_file.h"

#include "hooke/integrator.h"

#include <errno.h>
#include <unistd.h>

const struct hooke_observable hooke_observables[HOOKE_OBSERVABLE_COUNT] = {
    {"kinetic_energy", 1},   {"potential_energy", 1}, {"total_energy", 1},
    {"dissipated_power", 1}, {"momentum", 3},         {"angular_momentum", 3}};

static void observe(const hooke_system *system, const double *q, const double *v,
                    double value[HOOKE_OBSERVABLE_COUNT][3]) {
  value[0][0] = hooke_system_kinetic_energy(system, v);
  value[1][0] = hooke_system_potential_energy(system, q);
  value[2][0] = value[0][0] + value[1][0];
  value[3][0] = hooke_system_dissipated_power(system, q, v);
  hooke_system_momentum(system, v, value[4]);
  hooke_system_angular_momentum(system, q, v, value[5]);
}

static int write_bytes(int descriptor, int64_t at, int64_t bytes, const void *data) {
  const char *rest = data;
  while (bytes > 0) {
    const ssize_t done = pwrite(descriptor, rest, (size_t)bytes, (off_t)at);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return done < 0 ? errno : ENOSPC;
    rest += done;
    at += done;
    bytes -= done;
  }
  return 0;
}

/* Row `frame` of an array with `count` numbers in each. */
static int write_row(int descriptor, int64_t array, int64_t frame, int64_t count, const void *number) {
  const int64_t bytes = 8 * count;
  return write_bytes(descriptor, array + frame * bytes, bytes, number);
}

int hooke_frame_write(const struct hooke_frame_file *file, int64_t frame, int64_t step,
                      const hooke_state *state) {
  const double *q = hooke_state_position(state), *v = hooke_state_velocity(state);
  const double t = hooke_state_time(state);
  const int64_t numbers = hooke_state_size(state);
  const int to = file->descriptor;
  double value[HOOKE_OBSERVABLE_COUNT][3];
  observe(file->system, q, v, value);
  int error = write_row(to, file->position, frame, numbers, q);
  if (error == 0) error = write_row(to, file->velocity, frame, numbers, v);
  for (int k = 0; error == 0 && k < HOOKE_OBSERVABLE_COUNT; k++)
    error = write_row(to, file->observable[k], frame, hooke_observables[k].columns, value[k]);
  if (error == 0) error = write_row(to, file->step, frame, 1, &step);
  return error ? error : write_row(to, file->time, frame, 1, &t);
}
