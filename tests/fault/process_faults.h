/* Allocations of the whole process that fail by plan, where the C library allows its functions to be
 * replaced: not under sanitizers. */
#pragma once

#include "sanitized.h"

#if defined(__GLIBC__) && !HOOKE_SANITIZED
#define FAULT_WHOLE_PROCESS 1
#else
#define FAULT_WHOLE_PROCESS 0
#endif

/* Place of the first allocation that failed. */
struct fault_trace {
  void *frame[24], *last[24]; /* of the first, and of the last */
  int depth, last_depth;
};

/* `trace` is recorded by the first failure. */
void process_faults_prepare(struct fault_trace *trace);

/* Library of that place: "hooke", or the name of its file. A request by the C library is attributed to its
 * caller. */
const char *process_fault_owner(const struct fault_trace *trace, int last);
