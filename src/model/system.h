/* The system: particles, spring groups and forces, and what commit makes of them. */
#ifndef HOOKE_MODEL_SYSTEM_H
#define HOOKE_MODEL_SYSTEM_H

#include "hooke/system.h"
#include "model/drive.h"
#include "model/lane.h"
#include "model/net.h"
#include "model/spring.h"

struct hooke_force_row;

enum { HOOKE_HELD_PINNED = 1, HOOKE_HELD_DRIVEN = 2 };

struct hooke_system {
  int32_t committed;

  /* particles, 3 or 1 doubles each */
  int64_t particle_count, particle_capacity;
  double *position, *velocity, *mass; /* velocity NULL from commit on if all are zero */
  uint8_t *held;                      /* HOOKE_HELD_* */
  double *inverse_mass;               /* from commit on */

  int64_t held_count; /* from commit on: pinned and driven particles, ascending */
  int32_t *held_particle;

  /* spring groups; from commit on in spring order */
  int64_t group_count, group_capacity;
  struct hooke_group *group;
  int64_t part_count;
  struct hooke_springs springs; /* from commit on */
  struct hooke_lanes lanes;     /* from commit on, of all springs or of none */
  struct hooke_net net;         /* the same, where there are no lanes */

  double gravity[3];
  int32_t has_gravity;
  double drag; /* 0: none */
  hooke_force *force;
  hooke_force_product *force_product;
  void *force_ctx;

  int64_t drive_count, drive_capacity;
  struct hooke_drive_group *drive;

  int32_t force_row_count; /* from commit on: the forces that are there */
  const struct hooke_force_row **force_row;
};

/* HOOKE_BAD_CALL unless the system is still open (or, the second, committed). */
int32_t hooke_system_require_open(const hooke_system *system);
int32_t hooke_system_require_committed(const hooke_system *system);

/* HOOKE_BAD_VALUE, with "<place>[k]", for the first particle that does not exist or is held in the way
 * `refused` says. */
int32_t hooke_system_check_particles(const hooke_system *system, const char *place, int64_t count,
                                     const int64_t *particles, int32_t refused);

/* For builders. A part's springs come after those of all explicit groups, whenever they are added; otherwise
 * the same as hooke_system_add_springs(). hooke_system_next_part() counts parts: it returns 0, 1, ... */
int32_t hooke_system_add_part_springs(hooke_system *system, const char *name, int64_t count,
                                      const int64_t *ends, const hooke_options *options);
int64_t hooke_system_next_part(hooke_system *system);

/* A builder that fails half-way takes back what it added since the mark. */
struct hooke_system_mark {
  int64_t particle_count, group_count, part_count;
};
struct hooke_system_mark hooke_system_mark(const hooke_system *system);
void hooke_system_roll_back(hooke_system *system, struct hooke_system_mark mark);

#endif
