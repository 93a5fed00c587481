/* Numbers that parts derive from their options, for display, in a list that grows while a system is built. */
#ifndef HOOKE_MODEL_DERIVED_H
#define HOOKE_MODEL_DERIVED_H

#include <stdint.h>

struct hk_derived {
  char *part;
  const char *family, *name, *unit; /* static texts; no family: NULL */
  double value;
};

#endif
