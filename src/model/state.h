/* A state: t, q and v in one block. */
#pragma once

#include "hooke/state.h"

/* Energies of a state in a system [J]: potential ones of all forces, elastic ones of those with elements. */
struct hk_energies {
  const hooke_system *system;
  double kinetic, potential, elastic, gravity;
};

struct hooke_state {
  int64_t size;    /* numbers in q */
  int64_t padding; /* of them, zeros at the end that nobody sees, of coordinates in rows of three */
  int32_t has_v;
  double *t, *q, *v;               /* one block; v is NULL for a first-order problem */
  const struct hk_energies *known; /* its energies, while a run shows it as a frame; otherwise NULL */
};

/* Creates a state of zeros with `numbers` in q, and as many in v if `has_v`: then in whole rows of three,
 * with padding. HOOKE_NO_MEMORY. */
int32_t hk_state_create_sized(int64_t numbers, int32_t has_v, hooke_state **state);

/* HOOKE_BAD_VALUE unless the state fits a problem of so many numbers, with velocities or without; and unless
 * it fits this system. */
int32_t hk_state_check(const hooke_state *state, int64_t numbers, int32_t has_v);
int32_t hk_state_check_system(const hooke_state *state, const hooke_system *system);

/* The known energies, or those computed now. */
struct hk_energies hk_state_energies(const hooke_state *state, const hooke_system *system);
