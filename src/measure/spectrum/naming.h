/* Elements in words: "spring 12 (particles 3 and 7, group hem)", "the bending of particles 1, 2 and 3 (group
 * beam.bending)". */
#pragma once

#include "model/force/force.h"

/* A walk over elements by their numbers, with the group of each among those of the system; -1: none. */
struct hk_member_walk {
  struct hk_elements elements;
  const struct hk_force_row *force;
  int64_t group, in_group;
};
void hk_begin_members(const hooke_system *system, double t, const double *q, const double *v,
                      struct hk_member_walk *at);
const struct hk_element *hk_next_member(struct hk_member_walk *at);

/* Name of the group of an element of a force; "" if it has none. */
const char *hk_naming_group(const hooke_system *system, const struct hk_force_row *force, int64_t number);

/* Writes the words into `text` and returns it. */
enum { HOOKE_NAMING_SIZE = 160 };
const char *hk_naming_words(const hooke_system *system, const struct hk_force_row *force, int64_t number,
                            char text[HOOKE_NAMING_SIZE]);

/* The element of a group that contributes most at a particle in a step h, by g^2 (h^2 k + 2 h c) at the
 * scene's initial positions, of one force or of all (NULL); -1 if there is none. */
int64_t hk_naming_heaviest(const hooke_system *system, const struct hk_force_row *only, int64_t particle,
                           double h, const struct hk_force_row **force);

/* The same over all forces, in words ("" if there is none); returns the spring, -1 if it is none. */
int64_t hk_naming_heaviest_words(const hooke_system *system, int64_t particle, double h,
                                 char text[HOOKE_NAMING_SIZE]);
