/* Numbers that parts derive from their options, for display, in a list that grows while a system is built. */
#pragma once

#include "hooke/system.h"

struct hk_derived {
  char *part;
  const char *family, *name, *unit; /* static texts; no family: NULL */
  double value;
};

/* `family` (NULL: none), `name` and `unit` must be static. HOOKE_NO_MEMORY, HOOKE_BAD_CALL. */
int32_t hk_system_add_derived(hooke_system *system, const char *part, const char *family, const char *name,
                              const char *unit, double value);
/* Keeps only the first `kept` of them. */
void hk_system_drop_derived(hooke_system *system, int64_t kept);
