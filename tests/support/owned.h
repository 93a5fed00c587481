/* Objects and memory that are released where the block that declares them ends, the last declared first:
 * declare a system before what is made for it. A test that fails releases none. */
#pragma once

#include "hooke.h"

#include <stdlib.h>

#define owned_system      __attribute__((cleanup(release_system))) hooke_system
#define owned_scene       __attribute__((cleanup(release_scene))) hooke_scene
#define owned_options     __attribute__((cleanup(release_options))) hooke_options
#define owned_state       __attribute__((cleanup(release_state))) hooke_state
#define owned_integrator  __attribute__((cleanup(release_integrator))) hooke_integrator
#define owned_measurement __attribute__((cleanup(release_measurement))) hooke_measurement
#define owned_record      __attribute__((cleanup(release_record))) hooke_record
#define owned_text        __attribute__((cleanup(release_text))) char
#define owned_wholes      __attribute__((cleanup(release_wholes))) int64_t
#define owned_doubles     __attribute__((cleanup(release_doubles))) double
/* Any other kind, which this function releases by its address. */
#define owned(release) __attribute__((cleanup(release)))

static inline void release_system(hooke_system **system) {
  hooke_system_destroy(*system);
}

static inline void release_scene(hooke_scene **scene) {
  hooke_scene_destroy(*scene);
}

static inline void release_options(hooke_options **options) {
  hooke_options_destroy(*options);
}

static inline void release_state(hooke_state **state) {
  hooke_state_destroy(*state);
}

static inline void release_integrator(hooke_integrator **integrator) {
  hooke_integrator_destroy(*integrator);
}

static inline void release_measurement(hooke_measurement **measurement) {
  hooke_measurement_destroy(*measurement);
}

static inline void release_record(hooke_record **record) {
  hooke_record_close(*record);
}

static inline void release_text(char **text) {
  free(*text);
}

static inline void release_wholes(int64_t **numbers) {
  free(*numbers);
}

static inline void release_doubles(double **numbers) {
  free(*numbers);
}
