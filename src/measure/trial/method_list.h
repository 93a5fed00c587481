/* Lists of methods in an option: names separated by commas or spaces. */
#pragma once

#include "hooke/integrator.h"

enum { HOOKE_LISTED_METHODS = 32 };

/* The methods in `names`, in their order; if `names` is empty, every method of the table that takes the
 * system and for which `suits` is not 0. At "methods", HOOKE_BAD_VALUE for an unknown name or too many, and
 * HOOKE_NOT_BUILT; HOOKE_UNSUITED for one that does not take the system. */
int32_t hk_method_list_read(const hooke_system *system, const char *names,
                            int32_t (*suits)(const char *method), const char *method[HOOKE_LISTED_METHODS],
                            int32_t *count);
