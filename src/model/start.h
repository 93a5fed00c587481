/* Where a motion starts, if not where its particles were given: with rest lengths, frames of bodies, clamps
 * and anchors of the given positions. */
#pragma once

#include <stdint.h>

struct hk_variant_maker;
struct hooke_system;

struct hk_start {
  int64_t count;               /* particles; 0: it starts where they were given */
  double *position, *velocity; /* 3 count; NULL velocities: those given. Before commit only */
  double *undeformed;          /* 3n from commit on: the given positions; NULL if it starts there */
};

/* For commit: HOOKE_BAD_VALUE unless there is one place for each particle, that of a pinned one its own;
 * takes the velocities over. Then, when nothing can fail any more, the positions. */
int32_t hk_start_check(struct hooke_system *system);
void hk_start_commit(struct hooke_system *system);
void hk_start_release(struct hk_start *start);

/* The positions at the start, and the given ones (3n). */
const double *hk_start_position(const struct hooke_system *system);
const double *hk_undeformed_position(const struct hooke_system *system);

/* Gives it to a variant. HOOKE_UNSUITED where that has particles between those of the system. */
int32_t hk_start_copy(const struct hk_variant_maker *maker);
