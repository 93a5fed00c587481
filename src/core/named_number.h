/* Numbers looked up by name. */
#pragma once

#include <math.h>
#include <string.h>

struct hk_named_number {
  const char *name;
  double value;
};

/* Value of that name among `count`; NaN if there is none. */
static inline double hk_named_number_find(const struct hk_named_number *number, size_t count,
                                          const char *name) {
  for (size_t k = 0; k < count; k++) {
    if (strcmp(number[k].name, name) == 0) return number[k].value;
  }
  return NAN;
}

/* The same for an array. */
#define HOOKE_NAMED_NUMBER(numbers, name)                                                                    \
  hk_named_number_find((numbers), sizeof(numbers) / sizeof((numbers)[0]), (name))
