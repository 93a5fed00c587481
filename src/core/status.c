#include "core/status.h"

#include "core/print.h"
#include "core/utf8.h"

#undef hk_fail
#undef hk_fail_within
#undef hk_fail_before

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

enum { PLACE_SIZE = 256, MESSAGE_SIZE = 1024, LINE_SIZE = 4096, MORE_SIZE = 32 };

static _Thread_local struct {
  char before[PLACE_SIZE];
  char where[PLACE_SIZE];
  char message[MESSAGE_SIZE];
  char line[LINE_SIZE];
  int64_t count;
  int32_t status;
} last;

static void compose(void) {
  snprintf(last.line, sizeof last.line, "%s%s%s%s", last.before, last.where, last.where[0] ? ": " : "",
           last.message);
}

int32_t hk_fail(int32_t status, const char *where, const char *format, ...) {
  /* the arguments may point into the record itself */
  char message[MESSAGE_SIZE];
  va_list args;
  va_start(args, format);
  hk_print_list(message, sizeof message, format, args);
  va_end(args);
  snprintf(last.where, sizeof last.where, "%s", where ? where : "");
  memcpy(last.message, message, sizeof message);
  hk_utf8_make_plain(last.where); /* messages of libraries may repeat input, and long text is truncated */
  hk_utf8_make_plain(last.message);
  last.before[0] = '\0';
  last.count++;
  last.status = status;
  compose();
  return status;
}

int32_t hk_fail_index(const char *where, const char *none, double number, int64_t count) {
  if (count == 0)
    return hk_fail(HOOKE_BAD_VALUE, where, "%s %.17g; there are no particles yet", none, number);
  return hk_fail(HOOKE_BAD_VALUE, where, "%s %.17g; allowed: 0 to %lld, as numbers begin at 0", none, number,
                 (long long)count - 1);
}

int32_t hk_fail_within(int32_t status, const char *format, ...) {
  char outer[PLACE_SIZE];
  char where[2 * PLACE_SIZE];
  va_list args;
  va_start(args, format);
  hk_print_list(outer, sizeof outer, format, args);
  va_end(args);
  const char *joint = last.where[0] && last.where[0] != '[' ? "." : "";
  snprintf(where, sizeof where, "%s%s%s", outer, joint, last.where);
  snprintf(last.where, sizeof last.where, "%.*s", PLACE_SIZE - 1, where);
  hk_utf8_make_plain(last.where);
  compose();
  return status;
}

int32_t hk_fail_before(int32_t status, const char *format, ...) {
  va_list args;
  va_start(args, format);
  hk_print_list(last.before, sizeof last.before, format, args);
  va_end(args);
  hk_utf8_make_plain(last.before);
  compose();
  return status;
}

int32_t hk_fail_lines(int32_t status, int64_t count, char *const *lines) {
  size_t used = 0;
  last.line[0] = '\0';
  for (int64_t k = 0; k < count; k++) {
    const size_t length = strlen(lines[k]);
    if (used + length + MORE_SIZE > sizeof last.line) {
      snprintf(last.line + used, sizeof last.line - used, "\nand %lld more", (long long)(count - k));
      break;
    }
    used += (size_t)snprintf(last.line + used, sizeof last.line - used, "%s%s", k ? "\n" : "", lines[k]);
  }
  last.before[0] = last.where[0] = '\0';
  snprintf(last.message, sizeof last.message, "%.*s", MESSAGE_SIZE - 1, lines[0]);
  last.count++;
  return last.status = status;
}

int64_t hk_fail_count(void) {
  return last.count;
}

int32_t hk_fail_status(void) {
  return last.status;
}

const char *hk_fail_where(void) {
  return last.where;
}

const char *hk_fail_message(void) {
  return last.message;
}

const char *hooke_last_error(void) {
  return last.line;
}

const char *hooke_status_name(int32_t status) {
  static const struct {
    int32_t status;
    const char *name;
  } names[] = {{HOOKE_OK, "ok"},
               {HOOKE_STOPPED, "stopped"},
               {HOOKE_DIVERGED, "diverged"},
               {HOOKE_STEP_LIMIT, "step limit reached"},
               {HOOKE_NO_MEMORY, "out of memory"},
               {HOOKE_BAD_VALUE, "bad value"},
               {HOOKE_BAD_CALL, "call out of order"},
               {HOOKE_IO_FAILED, "could not read or write"},
               {HOOKE_NOT_BUILT, "not in this build"},
               {HOOKE_UNSUITED, "method does not take this problem"},
               {HOOKE_SOLVER_FAILED, "solver failed"},
               {HOOKE_INTERNAL, "defect of hooke"}};
  for (size_t k = 0; k < sizeof names / sizeof names[0]; k++)
    if (names[k].status == status) return names[k].name;
  return "unknown status";
}
