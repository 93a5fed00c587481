#include "attempt.h"

#include "hash.h"
#include "hooke.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void attempt_wrong(struct attempt *a, const char *format, ...) {
  va_list arguments;
  if (a->wrong[0]) return;
  va_start(arguments, format);
  vsnprintf(a->wrong, sizeof a->wrong, format, arguments);
  va_end(arguments);
  a->gave_up = 1;
}

static int32_t is_apt(const struct attempt *a, int32_t status) {
  if (status >= 0) return 0;
  if (a->foreign) return 1;
  return status == (a->on_file ? HOOKE_IO_FAILED : HOOKE_NO_MEMORY);
}

int32_t attempt_failed_saying(struct attempt *a, int32_t status, int32_t expected, const char *call,
                              const char *message) {
  const int64_t failures = fault_failures(), new_ones = failures - a->seen;
  if (a->after) a->after(call);
  /* a failed write of a thread is reported later */
  if (status != expected || !a->on_file) a->seen = failures;
  if (status == expected) return 0;
  if (new_ones == 0 || !is_apt(a, status)) {
    attempt_wrong(a, "%s%.200s returned %d (%s), message: %.300s", new_ones ? "after a fault " : "", call,
                  status, hooke_status_name(status), message);
    return 1;
  }
  if (message[0] == '\0') attempt_wrong(a, "%.200s failed without a message", call);
  if (a->refused == 0) a->status = status;
  if (a->refused++ == 0) snprintf(a->message, sizeof a->message, "%s", message);
  if (a->reach == FAULT_FROM_THEN_ON) a->gave_up = 1;
  return 1;
}

int32_t attempt_failed(struct attempt *a, int32_t status, int32_t expected, const char *call) {
  return attempt_failed_saying(a, status, expected, call, hooke_last_error());
}

void attempt_numbers(struct attempt *a, int64_t count, const double *numbers) {
  a->hash = hash_doubles(count, numbers, a->hash);
}

void attempt_number(struct attempt *a, double number) {
  attempt_numbers(a, 1, &number);
}

void attempt_text(struct attempt *a, const char *text) {
  for (; text && *text; text++)
    attempt_number(a, (double)(unsigned char)*text);
}
