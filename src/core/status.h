/* Failures: a status, the place it belongs to, and a message. One record per thread. */
#pragma once

#include "hooke/base.h"

/* Records a failure or outcome and returns `status`. `where` is a path within the caller's input, in the
 * terms of the scene format ("springs[2].stiffness[3]"), or NULL. hooke_last_error() then reads "place:
 * message". */
int32_t hk_fail(int32_t status, const char *where, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

/* Fails with HOOKE_BAD_VALUE for a number that is not one of 0 to count - 1; `none` says of what there is
 * none. */
int32_t hk_fail_index(const char *where, const char *none, double number, int64_t count);

/* Prefixes `outer` to the place of the last failure ("springs[2]" + "stiffness[3]" ->
 * "springs[2].stiffness[3]") and returns `status`, for a caller that knows more of the place. */
int32_t hk_fail_within(int32_t status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Prefixes text to the whole message ("scene.json:3:5: "). */
int32_t hk_fail_before(int32_t status, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Makes several messages, each whole with its place, the last failure: a line each. */
int32_t hk_fail_lines(int32_t status, int64_t count, char *const *lines);

#ifdef __clang_analyzer__ /* which cannot see that the returned status is the one given */
#define hk_fail(status, ...)        (hk_fail(status, __VA_ARGS__), (status))
#define hk_fail_within(status, ...) (hk_fail_within(status, __VA_ARGS__), (status))
#define hk_fail_before(status, ...) (hk_fail_before(status, __VA_ARGS__), (status))
#endif

/* Number of failures of this thread so far, and the status of the last, for callers that only know that
 * something failed. */
int64_t hk_fail_count(void);
int32_t hk_fail_status(void);

/* Place of the last failure, "" if it had none, and its message without the place. */
const char *hk_fail_where(void);
const char *hk_fail_message(void);
