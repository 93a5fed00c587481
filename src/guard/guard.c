/* Wrappers of all public functions: each checks that its arguments are there, in a build with
 * HOOKE_CHECK_HANDLES that handles are live, too, and calls the function of the library, which names.h
 * renames to hooke_unchecked_<name>. calls.inc lists them all; both files are generated in the build tree.
 *
 * A NULL text, array, callback or place for a result is refused with HOOKE_BAD_VALUE; a function without a
 * status treats a text as an unknown word. A handle that is NULL, was destroyed, never made, or is of another
 * type is refused with HOOKE_BAD_CALL. A function without a status returns -1, NaN or NULL, and 0 if it
 * answers yes or no. */
#include "core/handle.h"
#include "core/status.h"

#include <math.h>

#define TEXT(text)                                                                                           \
  if ((text) == NULL)                                                                                        \
    return hk_fail(HOOKE_BAD_VALUE, NULL, "no %s given; %s() needs a text there", #text, __func__);
/* Clears the outputs, so that they are NULL after a failure. */
#define MADE(object)                                                                                         \
  if (object) *(object) = NULL;
#define WORD(text)                                                                                           \
  if ((text) == NULL) (text) = "";

/* `count`: 0 where nothing is to be there. */
#define GIVEN(array, count, refused)                                                                         \
  if ((array) == NULL && (count) != 0) {                                                                     \
    hk_fail(HOOKE_BAD_VALUE, #array, "is missing; %s() needs it", __func__);                                 \
    return refused;                                                                                          \
  }

#if HOOKE_CHECK_HANDLES
#define IS(object, type, refused)                                                                            \
  if (!hk_handle_is((object), #type, __func__, #object)) return refused;
#define MAY_BE(object, type, refused)                                                                        \
  if ((object) && !hk_handle_is((object), #type, __func__, #object)) return refused;
#else
#define IS(object, type, refused)                                                                            \
  if ((object) == NULL) {                                                                                    \
    hk_fail(HOOKE_BAD_CALL, #object, "is NULL; %s() needs a %s", __func__, #type);                           \
    return refused;                                                                                          \
  }
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
