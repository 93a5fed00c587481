/* An order of elimination for the equations of a network: nested dissection (George 1973). A part of the network is cut in
 * two along one of its axes, or along the distance from one of its ends; particles at the cut come after both halves. */
#ifndef HOOKE_INTEGRATE_DISSECTION_H
#define HOOKE_INTEGRATE_DISSECTION_H

#include "model/pattern.h"
#include "model/system.h"

/* Particles that are eliminated together, `count` from `first` on in the order; parts come after their halves. */
struct hooke_part_of_order {
  int64_t first, count;
  int32_t parent; /* -1: none */
};

struct hooke_dissection {
  int64_t free_count;
  int32_t part_count;
  struct hooke_part_of_order *part;
  int32_t *particle,
      *place; /* the free particles in order; where each is in it, -1 for those that are held */
};

/* HOOKE_NO_MEMORY. What comes out depends on the system's numbers alone. */
int32_t hooke_dissection_create(const hooke_system *system, const struct hooke_pattern *pattern,
                                struct hooke_dissection *dissection);
void hooke_dissection_release(struct hooke_dissection *dissection);

#endif
