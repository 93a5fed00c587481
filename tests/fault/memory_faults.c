#include "memory_faults.h"

#include "plan.h"

#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>

void *__real_malloc(size_t size);
void *__real_calloc(size_t count, size_t size);
void *__real_realloc(void *block, size_t size);
void *__real_aligned_alloc(size_t alignment, size_t size);
void __real_free(void *block);
int __wrap_fsync(int descriptor);
char *__real_realpath(const char *path, char *resolved);
char *__real_strdup(const char *text);
char *__real_strndup(const char *text, size_t most);
FILE *__real_open_memstream(char **text, size_t *size);
FILE *__real_fopen(const char *path, const char *mode);
int __real_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*work)(void *),
                          void *ctx);

void *__wrap_malloc(size_t size);
void *__wrap_calloc(size_t count, size_t size);
void *__wrap_realloc(void *block, size_t size);
void *__wrap_aligned_alloc(size_t alignment, size_t size);
void __wrap_free(void *block);
char *__wrap_realpath(const char *path, char *resolved);
char *__wrap_strdup(const char *text);
char *__wrap_strndup(const char *text, size_t most);
FILE *__wrap_open_memstream(char **text, size_t *size);
FILE *__wrap_fopen(const char *path, const char *mode);
int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*work)(void *),
                          void *ctx);

static int32_t are_points = 1;
static atomic_llong blocks;

void memory_faults_are_points(int32_t are) {
  are_points = are;
}

int64_t memory_blocks(void) {
  return atomic_load(&blocks);
}

static int fails(void) {
  if (!are_points || !fault_strikes()) return 0;
  errno = ENOMEM;
  return 1;
}

static void *counted(void *block) {
  if (block) atomic_fetch_add(&blocks, 1);
  return block;
}

void *__wrap_malloc(size_t size) {
  return fails() ? NULL : counted(__real_malloc(size));
}

void *__wrap_calloc(size_t count, size_t size) {
  return fails() ? NULL : counted(__real_calloc(count, size));
}

void *__wrap_realloc(void *block, size_t size) {
  if (fails()) return NULL;
  void *larger = __real_realloc(block, size);
  return block ? larger : counted(larger);
}

void *__wrap_aligned_alloc(size_t alignment, size_t size) {
  return fails() ? NULL : counted(__real_aligned_alloc(alignment, size));
}

void __wrap_free(void *block) {
  if (block) atomic_fetch_sub(&blocks, 1);
  __real_free(block);
}

char *__wrap_realpath(const char *path, char *resolved) {
  if (fails()) return NULL;
  char *real = __real_realpath(path, resolved);
  if (resolved == NULL) counted(real);
  return real;
}

char *__wrap_strdup(const char *text) {
  return fails() ? NULL : counted(__real_strdup(text));
}

char *__wrap_strndup(const char *text, size_t most) {
  return fails() ? NULL : counted(__real_strndup(text, most));
}

/* The caller owns the text. */
FILE *__wrap_open_memstream(char **text, size_t *size) {
  FILE *stream = fails() ? NULL : __real_open_memstream(text, size);
  if (stream) atomic_fetch_add(&blocks, 1);
  return stream;
}

/* No power failures are simulated, and a disk may be slow. */
int __wrap_fsync(int descriptor) {
  (void)descriptor;
  return 0;
}

FILE *__wrap_fopen(const char *path, const char *mode) {
  return fails() ? NULL : __real_fopen(path, mode);
}

int __wrap_pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*work)(void *),
                          void *ctx) {
  return fault_strikes() ? EAGAIN : __real_pthread_create(thread, attributes, work, ctx);
}
