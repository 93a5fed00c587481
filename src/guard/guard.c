/* In a build with HOOKE_CHECK_HANDLES every public function stands here: it looks at the handles that it is given, and goes
 * on to the one in the library, which names.h calls hooke_unchecked_<name>. calls.inc lists them all. A handle that is no
 * more, never was, or is of another type is refused: with HOOKE_BAD_CALL, or where no status is returned with -1, NaN or
 * NULL, and with 0 of a function that answers yes or no. */
#include "core/handle.h"
#include "hooke/build.h"
#include "hooke/cost.h"
#include "hooke/checkpoint.h"
#include "hooke/estimate.h"
#include "hooke/io.h"
#include "hooke/verify.h"
#include "hooke/why.h"

#include <math.h>

#define IS(object, type, refused)                                                                            \
  if (!hooke_handle_is((object), #type, __func__, #object)) return refused;
#define MAY_BE(object, type, refused)                                                                        \
  if ((object) && !hooke_handle_is((object), #type, __func__, #object)) return refused;

#define CALL(result, name, parameters, arguments, checks)                                                    \
  extern result hooke_unchecked_##name parameters;                                                           \
  result hooke_##name parameters {                                                                           \
    checks return hooke_unchecked_##name arguments;                                                          \
  }
#define CALL_VOID(name, parameters, arguments, checks)                                                       \
  extern void hooke_unchecked_##name parameters;                                                             \
  void hooke_##name parameters {                                                                             \
    checks hooke_unchecked_##name arguments;                                                                 \
  }

#include "guard/calls.inc"
