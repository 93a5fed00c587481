/* Failures: a status, the place it belongs to, and a message for a person. One record per thread. */
#ifndef HOOKE_CORE_STATUS_H
#define HOOKE_CORE_STATUS_H

#include "hooke/base.h"

/* Records a failure or outcome and returns `status`. `place` is a path inside what the caller was given, in
 * the words of the scene format ("springs[2].stiffness[3]"), or NULL. hooke_last_error() then reads "place:
 * message". */
int32_t hk_fail(int32_t status, const char *place, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Puts `outer` before the place of the last failure ("springs[2]" + "stiffness[3]" ->
 * "springs[2].stiffness[3]") and returns `status`, for a caller who knows more of where it happened. */
int32_t hk_fail_within(int32_t status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Puts text before the whole message ("scene.json:3:5: "). */
int32_t hk_fail_before(int32_t status, const char *format, ...) __attribute__((format(printf, 2, 3)));

#ifdef __clang_analyzer__ /* which sees one file, and not that what comes back is the status that was given */
#define hk_fail(status, ...)        (hk_fail(status, __VA_ARGS__), (status))
#define hk_fail_within(status, ...) (hk_fail_within(status, __VA_ARGS__), (status))
#define hk_fail_before(status, ...) (hk_fail_before(status, __VA_ARGS__), (status))
#endif

/* How many failures this thread has met, and the status of the last: for who has only learned that something
 * failed. */
int64_t hk_fail_count(void);
int32_t hk_fail_status(void);

/* Place of the last failure, "" if it had none, and its message without the place. */
const char *hk_fail_place(void);
const char *hk_fail_message(void);

#endif
