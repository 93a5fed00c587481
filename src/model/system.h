/* The rest of a system: what only building, committing and copying it read, and what it points to. */
#pragma once

#include "model/callbacks.h"
#include "model/coordinates/body.h"
#include "model/force/altitude.h"
#include "model/force/bending.h"
#include "model/force/force.h"
#include "model/force/obstacle.h"
#include "model/force/spring.h"
#include "model/medium.h"
#include "model/size_limit.h"
#include "model/start.h"
#include "model/sum/strided.h"
#include "model/sum/tiled.h"

struct hk_os_file;

/* Constant elements about an origin (3n), both owned by the caller. */
struct hk_linear {
  int64_t count;
  const struct hk_element *element;
  const double *origin;
  int32_t of_velocities; /* 1: they are of forces that are not linear in velocities */
};

struct hk_system_rest {
  int32_t committed;
  _Atomic int32_t is_copied_whole; /* 1: a variant that leaves out nothing was found to equal it */
  int64_t particle_capacity;
  int64_t member_total[HOOKE_FORCES]; /* of the groups of each force, as added */
  int64_t member_count[HOOKE_FORCES]; /* the same, from commit on: those that act */

  /* the system points to these */
  struct hk_springs springs;
  struct hk_strided_batches strided;
  struct hk_tiled tiled;
  struct hk_altitudes altitudes;
  struct hk_bodies bodies;
  struct hk_medium medium;

  struct hk_bending bending; /* from commit on */
  struct hk_linear linear;
  struct hk_obstacles obstacles;
  struct hk_start start;
  void *own[HOOKE_FORCES]; /* from commit on: data of a force without a member of its own here */

  int64_t name_count;
  struct hk_particle_name {
    char *text;
    int64_t particle;
  } * name;

  int64_t derived_count;
  struct hk_derived *derived;

  struct hk_os_file *input; /* files that it was read from */
  int64_t input_count;
  int32_t has_scene;   /* 1: the last of them is its scene */
  double memory_limit; /* [bytes] maximum memory; 0: the machine's */

  int32_t called; /* callbacks of the run whose file the system is from (model/callbacks.h) */
  char *called_from[HOOKE_FORCE_TEXTS]; /* its force, NULL or "" if it does not say */
  char *named_from[HOOKE_FORCE_TEXTS];  /* the force callback `named`, by texts of its owner */
  hooke_force *named;                   /* NULL: none */
};

/* For commit: checks what an overdamped system may have, and what another one must; sets what motions divide
 * by and fall with (HOOKE_NO_MEMORY), and takes that back. */
int32_t hk_overdamped_check(const hooke_system *system);
int32_t hk_overdamped_check_forces(const hooke_system *system);
int32_t hk_overdamped_begin(hooke_system *system);
void hk_overdamped_undo(hooke_system *system);

/* For commit: HOOKE_BAD_VALUE if a particle has the name of a part or of a group. */
int32_t hk_names_check(const hooke_system *system);
void hk_names_release(hooke_system *system);

/* Reopens a system after a failure of commit midway: releases all that commit makes. */
void hk_system_undo(hooke_system *system);

/* The option `gravity_factor` of what has just added the particles from `first` on. */
int32_t hk_set_gravity_factor(hooke_system *system, int64_t first, const hooke_options *options);

/* Memory for so many particles, of which `used` are kept; there may be no velocities any more.
 * HOOKE_NO_MEMORY. */
int32_t hk_system_resize(hooke_system *system, int64_t used, int64_t capacity);

/* Diagonal of the box that holds some positions [m]; 0 for none. */
double hk_diagonal(int64_t count, const double *position);

/* HOOKE_BAD_CALL unless the system is still open (the second: committed). */
int32_t hk_system_require_open(const hooke_system *system);
int32_t hk_system_require_committed(const hooke_system *system);

/* HOOKE_BAD_VALUE for the first number that is not finite: at "<where>[k][a]" of rows of several columns, at
 * "<where>[k]" of several numbers, or at "<where>". */
int32_t hk_require_finite(const char *where, int64_t rows, int32_t columns, const double *value);

/* HOOKE_BAD_VALUE, with "<where>[k]", for the first particle that does not exist or has the constraint
 * `refused`. */
int32_t hk_system_check_particles(const hooke_system *system, const char *where, int64_t count,
                                  const int64_t *particles, int32_t refused);

/* Adds linear forces; elements and origin must outlive the system. */
void hk_system_set_linear(hooke_system *system, int64_t count, const struct hk_element *element,
                          const double *origin);

/* A builder that fails midway removes everything that it added since the mark. */
struct hk_system_mark {
  int64_t particle_count, derived_count, part_count;
};
struct hk_system_mark hk_system_mark(const hooke_system *system);
void hk_system_roll_back(hooke_system *system, struct hk_system_mark mark);
