/* What parts worked out from their options: numbers for people, in a list that grows while a system is
 * built. */
#ifndef HOOKE_MODEL_DERIVED_H
#define HOOKE_MODEL_DERIVED_H

#include <stdint.h>

struct hk_derived {
  char *part;
  const char *family, *name, *unit; /* texts that live as long as the library; no family: NULL */
  double value;
};

#endif
