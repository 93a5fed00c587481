/* Groups of members of a force: springs, triples of bending, tetrahedra of altitude springs. A system has one
 * table of them, in the order of the table of forces; within a force, groups of parts follow the others. */
#pragma once

#include "core/table/option.h"

#include <stddef.h>

struct hk_force_row;
struct hk_scaling;
struct hooke_system;

/* Numbers of a member while a system is built; a force says in its row how many it has of each. Bending has a
 * coefficient, which is its kappa. */
enum { HOOKE_KAPPA, HOOKE_GAMMA, HOOKE_REST_LENGTH, HOOKE_POINT, HOOKE_GROUP_NUMBERS };
enum { HOOKE_MEMBER_PARTICLES = 4 };

/* The options of groups that hold these numbers. */
extern const char *const hk_group_names[HOOKE_GROUP_NUMBERS];

struct hk_group {
  const struct hk_force_row *force;
  char *name;
  int32_t from_part; /* 1: added by a part */
  int32_t pull_only;
  int32_t damped;         /* from commit on: 1: some member is */
  int32_t part;           /* for groups of parts: number of the part */
  int64_t count;          /* from commit on excludes members that have neither stiffness nor damping, */
  int64_t dropped;        /* which are counted here, with those inside a rigid body, */
  int64_t inside;         /* which are counted here as well */
  struct hk_curve *curve; /* of springs: NULL: they are linear */
  hooke_options *options; /* as given, if they hold for all springs; else NULL */
  /* of springs that follow time; else NULL */
  struct hk_scaling *scaling;
  /* until commit, of each member; NULL if the force has no such number */
  int32_t *particle[HOOKE_MEMBER_PARTICLES];
  double *number[HOOKE_GROUP_NUMBERS];
  double *ratio; /* of springs, damping ratios, from which commit finds gamma; NULL: none */
};

/* Allocates the columns of its force and count, and copies the name. HOOKE_NO_MEMORY. */
int32_t hk_group_allocate(struct hk_group *group, const char *name);
void hk_group_release(struct hk_group *group);
/* Releases the columns alone. */
void hk_group_release_columns(struct hk_group *group);

void hk_group_swap(struct hk_group *group, int64_t a, int64_t b);
/* 1 if its members may pull only, and do not. */
int32_t hk_group_resists(const struct hk_group *group);

/* Moves members that have neither stiffness nor damping, and those inside a body, behind the others, in
 * stable order, and excludes them from the count; and the reverse. */
void hk_group_drop(struct hk_group *group, const struct hooke_system *system);
void hk_group_take_back(struct hk_group *group);

/* What a call adds (group_add.c): `particles` of every member, and options unless the force has none. */
struct hk_addition {
  const struct hk_force_row *force;
  const char *name;
  int64_t count;
  const int64_t *particles;
  const hooke_options *options;
  int32_t from_part;
};
/* Checks what is to be added, and makes the group with its particles. HOOKE_BAD_VALUE, HOOKE_BAD_CALL. After
 * a failure, too, hk_group_end() releases it. */
int32_t hk_group_begin(const struct hooke_system *system, const struct hk_addition *added,
                       struct hk_group *group);
/* Stiffness, damping and rest length of every member, as far as the options have them. */
void hk_group_fill(struct hk_group *group, const hooke_options *options);
/* Adds the group, or releases it after a failure; returns that. */
int32_t hk_group_end(struct hooke_system *system, int32_t status, struct hk_group *group);

/* HOOKE_BAD_VALUE, with the place, for the first member that is to be on a free particle and is not. */
int32_t hk_groups_check_free(const struct hooke_system *system);

/* Takes ownership of the group and adds it to the table, or releases it: HOOKE_NO_MEMORY. */
int32_t hk_system_add_group(struct hooke_system *system, struct hk_group *group);
/* Removes the groups of parts from number `part` on. */
void hk_system_remove_groups(struct hooke_system *system, int64_t part);

/* Number of groups of a force, its group `k` (NULL if there is none), and the number of members of all of
 * them, or of all forces for NULL. */
int64_t hk_system_groups_of(const struct hooke_system *system, const struct hk_force_row *force);
const struct hk_group *hk_system_group(const struct hooke_system *system, const struct hk_force_row *force,
                                       int64_t k);
int64_t hk_system_members_of(const struct hooke_system *system, const struct hk_force_row *force);
/* The group that a part added last. */
const struct hk_group *hk_system_last_group(const struct hooke_system *system,
                                            const struct hk_force_row *force);
/* Number of the first group of a force in the table, or where it would be. */
int64_t hk_system_first_group(const struct hooke_system *system, const struct hk_force_row *force);
