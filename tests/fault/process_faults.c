#define _GNU_SOURCE /* dladdr() */
/* Every allocation of the process, in any library: these functions replace the system's. */
#include "process_faults.h"

#include "plan.h"

#if FAULT_WHOLE_PROCESS

#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <stdlib.h>
#include <string.h>

void *__libc_malloc(size_t size);
void *__libc_calloc(size_t count, size_t size);
void *__libc_realloc(void *block, size_t size);
void *__libc_memalign(size_t alignment, size_t size);

static struct fault_trace *kept;

/* The first failure records its place. */
static int fails(void) {
  if (!fault_strikes()) return 0;
  if (kept) {
    fault_pause();
    kept->last_depth = backtrace(kept->last, sizeof kept->last / sizeof kept->last[0]);
    if (kept->depth == 0) {
      memcpy(kept->frame, kept->last, sizeof kept->frame);
      kept->depth = kept->last_depth;
    }
    fault_resume();
  }
  errno = ENOMEM;
  return 1;
}

const char *process_fault_owner(const struct fault_trace *trace, int last) {
  void *const *frame = last ? trace->last : trace->frame;
  const int depth = last ? trace->last_depth : trace->depth;
  Dl_info info;
  for (int k = 1; k < depth; k++) {
    if (dladdr(frame[k], &info) == 0 || info.dli_fname == NULL) continue;
    const char *slash = strrchr(info.dli_fname, '/'), *name = slash ? slash + 1 : info.dli_fname;
    if (strncmp(name, "lib", 3) != 0) {
      if (k > 2) return "hooke"; /* the frames before it belong to this file */
      continue;
    }
    if (strncmp(name, "libc.", 5) == 0 || strncmp(name, "libgomp", 7) == 0) continue;
    return name;
  }
  return "hooke";
}

void process_faults_prepare(struct fault_trace *trace) {
  void *some[2];
  kept = trace;
  backtrace(some, 2); /* loads its library */
}

void *malloc(size_t size) {
  return fails() ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
  return fails() ? NULL : __libc_calloc(count, size);
}

void *realloc(void *block, size_t size) {
  return fails() ? NULL : __libc_realloc(block, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
  return fails() ? NULL : __libc_memalign(alignment, size);
}

void *memalign(size_t alignment, size_t size);

void *memalign(size_t alignment, size_t size) {
  return fails() ? NULL : __libc_memalign(alignment, size);
}

int posix_memalign(void **block, size_t alignment, size_t size) {
  void *made = fails() ? NULL : __libc_memalign(alignment, size);
  if (made) *block = made;
  return made ? 0 : ENOMEM;
}

#endif
