/* Every public function stands here: it looks at the texts that it is given, in a build with
 * HOOKE_CHECK_HANDLES at the handles, too, and goes on to the one in the library, which names.h calls
 * hooke_unchecked_<name>. calls.inc lists them all.
 *
 * A text that is NULL is refused with HOOKE_BAD_VALUE; where no status is returned it is a word that the
 * function does not know. A handle that is no more, never was, or is of another type is refused with
 * HOOKE_BAD_CALL, or where no status is returned with -1, NaN or NULL, and with 0 of a function that answers
 * yes or no. */
#include "core/handle.h"
#include "core/status.h"
#include "hooke/build.h"
#include "hooke/checkpoint.h"
#include "hooke/estimate.h"
#include "hooke/io.h"
#include "hooke/measurement.h"
#include "hooke/verify.h"

#include <math.h>

#define TEXT(text)                                                                                           \
  if ((text) == NULL)                                                                                        \
    return hk_fail(HOOKE_BAD_VALUE, NULL, "no %s given; %s() needs a text there", #text, __func__);
/* What a function that is refused a text would have made. */
#define MADE(object)                                                                                         \
  if (object) *(object) = NULL;
#define WORD(text)                                                                                           \
  if ((text) == NULL) (text) = "";

#if HOOKE_CHECK_HANDLES
#define IS(object, type, refused)                                                                            \
  if (!hk_handle_is((object), #type, __func__, #object)) return refused;
#define MAY_BE(object, type, refused)                                                                        \
  if ((object) && !hk_handle_is((object), #type, __func__, #object)) return refused;
#else
#define IS(object, type, refused)
#define MAY_BE(object, type, refused)
#endif

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
