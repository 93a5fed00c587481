/* A scenario is a row of calls that ends in a hash of all that came out of them. Where a call fails for a
 * planned fault it is looked at and, if the fault was a single one, made again: the same objects then have to
 * give the same hash. If everything fails from then on the scenario gives up and releases what it has, which
 * must not fail. */
#ifndef FAULT_ATTEMPT_H
#define FAULT_ATTEMPT_H

#include "plan.h"

#include <stdint.h>

struct attempt {
  const char *folder, *out; /* with the files that it reads; for those that it writes */
  enum fault_reach reach;
  int32_t on_file; /* faults are those of files: HOOKE_IO_FAILED in place of HOOKE_NO_MEMORY */
  int32_t foreign; /* another library met the fault: it may hide the cause behind any failure */
  /* what happened */
  uint64_t hash;
  int64_t refused; /* calls that failed for a fault */
  int64_t seen;    /* failures planned that were met by a call so far */
  int32_t gave_up;
  int64_t planned, committed; /* frames that were reported as written */
  int32_t status;             /* of the first call that failed for a fault, and its message */
  char message[512];          /* of the first call that failed for a fault */
  char wrong[640];            /* what must not be; "" if nothing */
};

/* Makes a call of the library; leaves through `end:` if the scenario is over. */
#define TRY(a, call) TRY_FOR(a, call, 0)
/* The same where `expected`, an outcome or a refusal, is what it comes to. */
#define TRY_FOR(a, call, expected)                                                                           \
  do {                                                                                                       \
    if (attempt_failed((a), (call), (expected), #call) &&                                                    \
        ((a)->gave_up || attempt_failed((a), (call), (expected), #call)))                                    \
      goto end;                                                                                              \
  } while (0)

/* The same of what cannot be done again: a failure ends the scenario. */
#define TRY_ONCE(a, call)                                                                                    \
  do {                                                                                                       \
    if (attempt_failed((a), (call), 0, #call)) {                                                             \
      (a)->gave_up = 1;                                                                                      \
      goto end;                                                                                              \
    }                                                                                                        \
  } while (0)

/* 1 if the call did not come to what was expected; the first time for a fault it may be made again. */
int32_t attempt_failed(struct attempt *a, int32_t status, int32_t expected, const char *call);

/* The same of what says why in words of its own. */
int32_t attempt_failed_saying(struct attempt *a, int32_t status, int32_t expected, const char *call,
                              const char *message);

void attempt_wrong(struct attempt *a, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* What came out. */
void attempt_numbers(struct attempt *a, int64_t count, const double *numbers);
void attempt_number(struct attempt *a, double number);
void attempt_text(struct attempt *a, const char *text);

#endif
