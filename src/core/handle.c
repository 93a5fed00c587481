#include "core/handle.h"

#if HOOKE_CHECK_HANDLES

#include "core/status.h"

#include <pthread.h>
#include <string.h>

/* Header in front of every object, in the same block, so that the list needs no memory of its own. */
struct entry {
  _Alignas(64) struct entry *next;
  const char *type;
};

/* Global table of live handles, only in builds with HOOKE_CHECK_HANDLES. Lists by address. */
enum { LISTS = 4096 };
static struct entry *alive[LISTS];
static pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;

static struct entry **list_of(const struct entry *entry) {
  const uintptr_t block = (uintptr_t)entry / 64;
  return &alive[(block ^ block / LISTS) % LISTS];
}

/* Link to the entry, or to NULL if it is not in the list. Reads live entries only. */
static struct entry **find(const struct entry *entry) {
  struct entry **link = list_of(entry);
  while (*link && *link != entry)
    link = &(*link)->next;
  return link;
}

void *hk_handle_new(const char *type, size_t size) {
  struct entry *entry = hk_new(1, sizeof *entry + size);
  if (entry == NULL) return NULL;
  entry->type = type;
  pthread_mutex_lock(&mutex);
  struct entry **list = list_of(entry);
  entry->next = *list;
  *list = entry;
  pthread_mutex_unlock(&mutex);
  return entry + 1;
}

void hk_handle_free(void *object) {
  if (object == NULL) return;
  struct entry *entry = (struct entry *)object - 1;
  pthread_mutex_lock(&mutex);
  struct entry **link = find(entry);
  if (*link) *link = entry->next;
  pthread_mutex_unlock(&mutex);
  hk_free(entry);
}

int32_t hk_handle_is(const void *object, const char *type, const char *function, const char *argument) {
  const char *found = NULL;
  if (object) {
    const uintptr_t before = (uintptr_t)object - sizeof(struct entry);
    pthread_mutex_lock(&mutex);
    const struct entry *entry = *find((const struct entry *)before);
    if (entry) found = entry->type;
    pthread_mutex_unlock(&mutex);
  }
  if (found && strcmp(found, type) == 0) return 1;
  if (object == NULL)
    hk_fail(HOOKE_BAD_CALL, argument, "is NULL; %s() needs a %s", function, type);
  else if (found)
    hk_fail(HOOKE_BAD_CALL, argument, "is a %s; %s() needs a %s", found, function, type);
  else
    hk_fail(HOOKE_BAD_CALL, argument, "is no %s: it was destroyed, or never made; in a call of %s()", type,
            function);
  return 0;
}

#else

typedef int hk_handle_nothing; /* a C file must not be empty */

#endif
