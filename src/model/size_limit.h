/* Sizes that systems and states may have. */
#pragma once

#include "hooke/system.h"

struct hk_force_row;

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
