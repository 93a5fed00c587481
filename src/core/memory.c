#include "core/memory.h"
#include "core/keep_errno.h"
#include "core/os/os.h"
#include "core/status.h"

#include <string.h>

enum { ALIGNMENT = 64 };

static void no_memory(int64_t count, size_t size) {
  hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for %lld elements of %zu bytes", (long long)count, size);
}

static size_t whole_lines(int64_t count, size_t size) {
  return ((size_t)count * size + ALIGNMENT) / ALIGNMENT * ALIGNMENT;
}

void *hk_reserve(int64_t count, size_t size) {
  HOOKE_KEEP_ERRNO;
  if (count < 0 || (uint64_t)count > (PTRDIFF_MAX - ALIGNMENT) / size) {
    no_memory(count, size);
    return NULL;
  }
  void *block = hk_os_allocate(ALIGNMENT, whole_lines(count, size));
  if (block == NULL) no_memory(count, size);
  return block;
}

void *hk_new(int64_t count, size_t size) {
  void *block = hk_reserve(count, size);
  if (block) memset(block, 0, whole_lines(count, size));
  return block;
}

int32_t hk_grow(void **block, int64_t used, int64_t capacity, size_t size) {
  void *larger = hk_new(capacity, size);
  if (larger == NULL) return HOOKE_NO_MEMORY;
  if (used > 0) memcpy(larger, *block, (size_t)used * size);
  hk_free(*block);
  *block = larger;
  return HOOKE_OK;
}

int64_t hk_room_of(int64_t count) {
  int64_t room = count > 0 ? 8 : 0;
  while (room < count)
    room *= 2;
  return room;
}

int32_t hk_room(void **block, int64_t count, size_t size) {
  return count < hk_room_of(count) ? HOOKE_OK : hk_grow(block, count, hk_room_of(count + 1), size);
}

char *hk_copy_text(const char *text) {
  HOOKE_KEEP_ERRNO;
  if (text == NULL) text = "";
  const size_t size = strlen(text) + 1;
  char *copy = hk_os_allocate(0, size);
  if (copy == NULL) no_memory((int64_t)size, 1);
  return copy ? memcpy(copy, text, size) : NULL;
}

void hk_free(void *block) {
  hk_os_free(block);
}
