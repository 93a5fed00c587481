/* Allocations of the whole process that fail by plan, where the C library lets its functions be replaced: not
 * under sanitizers. */
#ifndef FAULT_PROCESS_FAULTS_H
#define FAULT_PROCESS_FAULTS_H

#include "sanitized.h"

#if defined(__GLIBC__) && !HOOKE_SANITIZED
#define FAULT_WHOLE_PROCESS 1
#else
#define FAULT_WHOLE_PROCESS 0
#endif

/* Where the first allocation that failed was asked for. */
struct fault_trace {
  void *frame[24], *last[24]; /* of the first, and of the last */
  int depth, last_depth;
};

/* `trace` is kept by the first failure. */
void process_faults_prepare(struct fault_trace *trace);

/* Which library that was: "hooke", or the name of its file. What the C library was asked for is its
 * caller's. */
const char *process_fault_owner(const struct fault_trace *trace, int last);

#endif
