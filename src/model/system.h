/* The system: particles, spring groups and forces, and what commit makes of them. */
#ifndef HOOKE_MODEL_SYSTEM_H
#define HOOKE_MODEL_SYSTEM_H

#include "hooke/system.h"
#include "model/group.h"
#include "model/force/altitude.h"
#include "model/force/bending.h"
#include "model/derived.h"
#include "model/force/drive.h"
#include "model/force/element.h"
#include "model/sum/strided.h"
#include "model/sum/tiled.h"
#include "model/part_record.h"
#include "model/force/spring.h"

struct hk_force_row;

/* Rows that the table of forces may have. */
enum { HOOKE_FORCES = 8 };

enum { HOOKE_IS_PINNED = 1, HOOKE_IS_DRIVEN = 2 };

/* Whole tiles of particles (HOOKE_TILE), the last one cut at the end. */
struct hk_span {
  int64_t from, count;
};

/* Elements that stay as they are about a place (3n), which belong to someone else. */
struct hk_linear {
  int64_t count;
  const struct hk_element *element;
  const double *place;
};

struct hooke_system {
  int32_t committed;

  /* particles, 3 or 1 doubles each */
  int64_t particle_count, particle_capacity;
  double *position, *velocity, *mass; /* velocity NULL from commit on if all are zero */
  uint8_t *constrained;               /* HOOKE_IS_* */
  double *inverse_mass;               /* from commit on */

  int64_t constrained_count; /* from commit on: pinned and driven particles, ascending */
  int32_t *constrained_particle;
  int64_t idle_count; /* from commit on: pinned particles that nothing touches */
  int64_t span_count; /* from commit on: what is stepped, ascending */
  struct hk_span *span;
  /* from commit on: pinned particles in there, which are put back after a step; ascending */
  int64_t anchor_count;
  int32_t *anchor;

  int64_t group_count, group_capacity;
  struct hk_group *group;
  int64_t member_total[HOOKE_FORCES]; /* of the groups of each force, as added */
  int64_t part_count;
  struct hk_part_record *part;       /* part_count, in the order of adding */
  struct hk_springs springs;         /* from commit on */
  struct hk_strided_batches strided; /* from commit on, of all springs or of none */
  struct hk_tiled tiled;             /* the same, where there are no strided batches */

  struct hk_bending bending;     /* from commit on */
  struct hk_altitudes altitudes; /* from commit on */
  struct hk_linear linear;
  void *own[HOOKE_FORCES]; /* from commit on: what a force without a member of its own here has */

  int64_t derived_count, derived_capacity;
  struct hk_derived *derived;

  double memory_limit; /* [bytes] that it may need; 0: what the machine has */

  double gravity[3];
  int32_t has_gravity;
  double drag; /* 0: none */
  hooke_force *force;
  hooke_force_product *force_product;
  void *force_ctx;

  int64_t drive_count, drive_capacity;
  struct hk_drive_group *drive;

  int32_t force_row_count; /* from commit on: the forces that are there */
  const struct hk_force_row **force_row;
};

/* HOOKE_BAD_CALL unless the system is still open (or, the second, committed). */
int32_t hk_system_require_open(const hooke_system *system);
int32_t hk_system_require_committed(const hooke_system *system);

/* HOOKE_BAD_VALUE, with "<place>[k]", for the first particle that does not exist or is constrained in the way
 * `refused` says. */
int32_t hk_system_check_particles(const hooke_system *system, const char *place, int64_t count,
                                  const int64_t *particles, int32_t refused);

/* What a system needs at most with more of each [bytes], and whether there is room, in 32-bit numbers and in
 * memory; `what` is what they are ("a cloth of 3 x 4 particles", NULL: the scene). HOOKE_BAD_VALUE,
 * HOOKE_NO_MEMORY. */
struct hk_more {
  double particles; /* which cannot overflow */
  struct {
    const struct hk_force_row *force; /* NULL: none */
    double count;
  } of[3];
};
double hk_system_needed_bytes(const hooke_system *system, struct hk_more more);
int32_t hk_system_check_room(const hooke_system *system, struct hk_more more, const char *what);
int32_t hk_system_check_more(const hooke_system *system, const struct hk_force_row *force, int64_t count);

/* Sets touched[p] to 1 for every particle that a spring, a triple or a tetrahedron is at. */
void hk_system_mark_touched(const hooke_system *system, uint8_t *touched);

/* Adds linear forces; elements and place have to outlive the system. */
void hk_system_set_linear(hooke_system *system, int64_t count, const struct hk_element *element,
                          const double *place);

/* For builders. A part's springs come after those of all explicit groups, whenever they are added; otherwise
 * the same as hooke_system_add_springs(), and so with triples. hk_system_next_part() counts parts: it returns
 * 0, 1, ... */
int32_t hk_system_add_part_springs(hooke_system *system, const char *name, int64_t count, const int64_t *ends,
                                   const hooke_options *options);
int32_t hk_system_add_part_bending(hooke_system *system, const char *name, int64_t count,
                                   const int64_t *triples, int64_t coefficient_count,
                                   const double *coefficient);
/* `family` (NULL: none), `name` and `unit` have to live as long as the library. HOOKE_NO_MEMORY,
 * HOOKE_BAD_CALL. */
int32_t hk_system_add_derived(hooke_system *system, const char *part, const char *family, const char *name,
                              const char *unit, double value);
/* Drops all but the first `kept` of them. */
void hk_system_drop_derived(hooke_system *system, int64_t kept);
int64_t hk_system_next_part(hooke_system *system);

/* A builder that fails half-way takes back what it added since the mark. */
struct hk_system_mark {
  int64_t particle_count, derived_count, part_count;
};
struct hk_system_mark hk_system_mark(const hooke_system *system);
void hk_system_roll_back(hooke_system *system, struct hk_system_mark mark);

/* Energy of the forces that have elements [J], which is never below 0. */
double hk_elastic_energy(const hooke_system *system, const double *q);

#endif
