/* A scenario is a sequence of calls that ends in a hash of all their results. A call that fails for a planned
 * fault is checked and, if the fault was a single one, repeated: the same objects then have to give the same
 * hash. If everything fails from then on the scenario ends early and releases its objects, which must not
 * fail. */
#pragma once

#include "plan.h"

#include <stdint.h>

struct attempt {
  const char *folder, *out; /* folder of its input files; of its output files */
  enum fault_reach reach;
  int32_t on_file;                 /* faults are those of files: HOOKE_IO_FAILED instead of HOOKE_NO_MEMORY */
  int32_t foreign;                 /* another library had the fault: any failure may hide the cause */
  void (*after)(const char *call); /* after every call and before the next; NULL: nothing */
  /* results */
  uint64_t hash;
  int64_t refused; /* number of calls that failed for a fault */
  int64_t seen;    /* planned failures met by a call so far */
  int32_t gave_up;
  int64_t planned, committed; /* frames reported as written */
  int32_t status;             /* of the first call that failed for a fault, and its message */
  char message[512];          /* of the first call that failed for a fault */
  char wrong[640];            /* violation of a requirement; "" if none */
};

/* Calls the library; jumps to `end:` if the scenario is over. */
#define TRY(a, call) TRY_FOR(a, call, 0)
/* The same for a call that returns `expected`, an outcome or a refusal. */
#define TRY_FOR(a, call, expected)                                                                           \
  do {                                                                                                       \
    if (attempt_failed((a), (call), (expected), #call) &&                                                    \
        ((a)->gave_up || attempt_failed((a), (call), (expected), #call)))                                    \
      goto end;                                                                                              \
  } while (0)

/* The same for a call that cannot be repeated: a failure ends the scenario. */
#define TRY_ONCE(a, call)                                                                                    \
  do {                                                                                                       \
    if (attempt_failed((a), (call), 0, #call)) {                                                             \
      (a)->gave_up = 1;                                                                                      \
      goto end;                                                                                              \
    }                                                                                                        \
  } while (0)

/* 1 if the call did not return the expected status; after its first fault it may be repeated. */
int32_t attempt_failed(struct attempt *a, int32_t status, int32_t expected, const char *call);

/* The same for a call with a message of its own. */
int32_t attempt_failed_saying(struct attempt *a, int32_t status, int32_t expected, const char *call,
                              const char *message);

void attempt_wrong(struct attempt *a, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Adds a result to the hash. */
void attempt_numbers(struct attempt *a, int64_t count, const double *numbers);
void attempt_number(struct attempt *a, double number);
void attempt_text(struct attempt *a, const char *text);
