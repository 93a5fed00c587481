/* The system: particles, spring groups and forces, and the structures that commit derives from them. */
#ifndef HOOKE_MODEL_SYSTEM_H
#define HOOKE_MODEL_SYSTEM_H

#include "hooke/system.h"
#include "model/body.h"
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
struct hk_os_file;

/* Maximum number of rows of the table of forces. */
enum { HOOKE_FORCES = 9 };

enum { HOOKE_IS_PINNED = 1, HOOKE_IS_DRIVEN = 2 };

/* A span of whole tiles of particles (HOOKE_TILE); the last tile is cut at the end. */
struct hk_span {
  int64_t from, count;
};

/* Constant elements about a place (3n), both owned by the caller. */
struct hk_linear {
  int64_t count;
  const struct hk_element *element;
  const double *place;
};

struct hooke_system {
  int32_t committed;
  int32_t borrows; /* 1: by hooke_system_with_force(), all but what depends on its force is another's */
  _Atomic int32_t is_copied_whole; /* 1: a variant that leaves out nothing was found to equal it */

  /* particles, 3 or 1 doubles each */
  int64_t particle_count, particle_capacity;
  double *position, *velocity, *mass; /* velocity NULL from commit on if all are zero */
  uint8_t *constrained;               /* HOOKE_IS_* */
  double *inverse_mass;               /* from commit on */

  int64_t constrained_count; /* from commit on: pinned and driven particles, ascending */
  int32_t *constrained_particle;
  int64_t idle_count; /* from commit on: pinned particles that nothing acts on */
  int64_t span_count; /* from commit on: spans that are stepped, ascending */
  struct hk_span *span;
  /* from commit on: pinned particles in these spans, restored after a step; ascending */
  int64_t anchor_count;
  int32_t *anchor;

  int64_t group_count, group_capacity;
  struct hk_group *group;
  int64_t member_total[HOOKE_FORCES]; /* of the groups of each force, as added */
  int64_t part_count;
  struct hk_part_record *part;       /* part_count, in the order of adding */
  struct hk_springs springs;         /* from commit on */
  struct hk_strided_batches strided; /* from commit on, for all springs or none */
  struct hk_tiled tiled;             /* the same, without strided batches */

  struct hk_bending bending;     /* from commit on */
  struct hk_altitudes altitudes; /* from commit on */
  struct hk_linear linear;
  void *own[HOOKE_FORCES]; /* from commit on: data of a force without a member of its own here */

  int64_t derived_count, derived_capacity;
  struct hk_derived *derived;

  struct hk_os_file *input; /* files that it was read from */
  int64_t input_count;
  int32_t has_scene;   /* 1: the last of them is its scene */
  double memory_limit; /* [bytes] maximum memory; 0: the machine's */

  double gravity[3];
  int32_t has_gravity;
  double drag; /* 0: none */
  /* An overdamped system, gamma x' = f. From commit on `mass` is gamma for every particle and drag and
   * gravity are 0, so that everything that divides a force or a stiffness by `mass` has a rate; gamma, the
   * masses and the gravity as given are here. */
  int32_t overdamped;
  double friction, *weight, pull[3]; /* friction is 0 before, and in any other system */
  hooke_force *force;
  hooke_force_product *force_product;
  void *force_ctx;
  const double *force_scale; /* factors of the callback's force, 3 a particle; NULL: 1 */
  int32_t called;            /* callbacks of the run whose file the system is from (model/callbacks.h) */

  struct hk_bodies bodies;

  int64_t drive_count, drive_capacity;
  struct hk_drive_group *drive;

  int32_t force_row_count; /* from commit on: the present forces */
  const struct hk_force_row **force_row;
};

/* Masses (0: not given), drag and gravity as they were given. */
const double *hk_system_masses(const hooke_system *system);
double hk_system_drag(const hooke_system *system);
const double *hk_system_gravity(const hooke_system *system);
int32_t hk_system_has_gravity(const hooke_system *system);

/* For commit: checks what an overdamped system may have, and what another one must; makes `mass` gamma
 * (HOOKE_NO_MEMORY), and takes that back. */
int32_t hk_overdamped_check(const hooke_system *system);
int32_t hk_overdamped_check_forces(const hooke_system *system);
int32_t hk_overdamped_begin(hooke_system *system);
void hk_overdamped_undo(hooke_system *system);

/* HOOKE_BAD_CALL unless the system is still open (the second: committed). */
int32_t hk_system_require_open(const hooke_system *system);
int32_t hk_system_require_committed(const hooke_system *system);

/* HOOKE_BAD_VALUE, with "<place>[k]", for the first particle that does not exist or has the constraint
 * `refused`. */
int32_t hk_system_check_particles(const hooke_system *system, const char *place, int64_t count,
                                  const int64_t *particles, int32_t refused);

/* Maximum memory [bytes] of a system with more of each, and a check that this fits, in 32-bit numbers and in
 * memory; `what` names the addition ("a cloth of 3 x 4 particles", NULL: the scene). HOOKE_BAD_VALUE,
 * HOOKE_NO_MEMORY. */
struct hk_more {
  double particles; /* as double, which cannot overflow */
  struct {
    const struct hk_force_row *force; /* NULL: none */
    double count;
  } of[3];
};
double hk_system_needed_bytes(const hooke_system *system, struct hk_more more);
int32_t hk_system_check_size(const hooke_system *system, struct hk_more more, const char *what);
/* The same for a problem of `size` numbers without particles, with so many doubles for each of them. */
int32_t hk_size_check(int64_t size, int32_t doubles);
int32_t hk_system_check_more(const hooke_system *system, const struct hk_force_row *force, int64_t count);

/* Sets touched[p] to 1 for every particle of a spring, a triple or a tetrahedron. */
void hk_system_mark_touched(const hooke_system *system, uint8_t *touched);

/* Adds linear forces; elements and place must outlive the system. */
void hk_system_set_linear(hooke_system *system, int64_t count, const struct hk_element *element,
                          const double *place);

/* For builders. A part's springs follow those of all explicit groups, whenever they are added; otherwise the
 * same as hooke_system_add_springs(), and likewise for triples. hk_system_next_part() counts parts: it
 * returns 0, 1, ... */
int32_t hk_system_add_part_springs(hooke_system *system, const char *name, int64_t count, const int64_t *ends,
                                   const hooke_options *options);
int32_t hk_system_add_part_bending(hooke_system *system, const char *name, int64_t count,
                                   const int64_t *triples, int64_t coefficient_count,
                                   const double *coefficient);
/* `family` (NULL: none), `name` and `unit` must be static. HOOKE_NO_MEMORY, HOOKE_BAD_CALL. */
int32_t hk_system_add_derived(hooke_system *system, const char *part, const char *family, const char *name,
                              const char *unit, double value);
/* Keeps only the first `kept` of them. */
void hk_system_drop_derived(hooke_system *system, int64_t kept);
int64_t hk_system_next_part(hooke_system *system);

/* A builder that fails midway removes everything that it added since the mark. */
struct hk_system_mark {
  int64_t particle_count, derived_count, part_count;
};
struct hk_system_mark hk_system_mark(const hooke_system *system);
void hk_system_roll_back(hooke_system *system, struct hk_system_mark mark);

#endif
