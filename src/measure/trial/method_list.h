/* Lists of methods in an option: names separated by commas or spaces. */
#ifndef HOOKE_MEASURE_TRIAL_METHOD_LIST_H
#define HOOKE_MEASURE_TRIAL_METHOD_LIST_H

#include "hooke/integrator.h"

/* Adds a method to `ctx`; returns a status. */
typedef int32_t hk_method_taker(const char *method, void *ctx);

/* Calls `take` for the methods in `names`, in their order; if `names` is empty, for every method of the table
 * that takes the system and for which `suits` is not 0. HOOKE_BAD_VALUE at "methods" for an unknown name, and
 * the failures of `take`. */
int32_t hk_method_list_read(const hooke_system *system, const char *names,
                            int32_t (*suits)(const char *method), hk_method_taker *take, void *ctx);

#endif
