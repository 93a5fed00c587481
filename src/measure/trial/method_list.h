/* Methods by their names in an option: separated by commas or spaces. */
#ifndef HOOKE_MEASURE_TRIAL_METHOD_LIST_H
#define HOOKE_MEASURE_TRIAL_METHOD_LIST_H

#include "hooke/integrator.h"

/* Adds a method to what `ctx` holds; a status. */
typedef int32_t hk_method_taker(const char *method, void *ctx);

/* Hands the methods of `names` to `take`, in their order; of an empty `names` every method of the table for
 * which `suits` is not 0. HOOKE_BAD_VALUE at "methods" for an unknown name, else what `take` says. */
int32_t hk_method_list_read(const char *names, int32_t (*suits)(const char *method), hk_method_taker *take,
                            void *ctx);

#endif
