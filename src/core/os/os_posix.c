#define _GNU_SOURCE /* dladdr(), RTLD_DEFAULT, sched_getaffinity() */
#include "core/os/os.h"

#include "core/keep_errno.h"

#include <dlfcn.h>
#include <errno.h>
#include <math.h>
#include <sched.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/utsname.h>
#include <unistd.h>

void *hk_os_allocate(size_t alignment, size_t size) {
  return alignment > 0 ? aligned_alloc(alignment, size) : malloc(size);
}

void hk_os_free(void *block) {
  free(block);
}

int hk_os_start_thread(pthread_t *thread, void *(*work)(void *), void *ctx) {
  sigset_t all, kept;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &kept);
  const int error = pthread_create(thread, NULL, work, ctx);
  pthread_sigmask(SIG_SETMASK, &kept, NULL);
  return error;
}

int32_t hk_os_processors(void) {
  HOOKE_KEEP_ERRNO;
#if defined(__linux__)
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) == 0) return (int32_t)CPU_COUNT(&set);
#endif
  const long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count > 0 ? (int32_t)count : 1;
}

double hk_os_physical_memory(void) {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  return pages > 0 && page > 0 ? (double)pages * (double)page : (double)INFINITY;
}

double hk_os_address_limit(void) {
  struct rlimit space;
  const int limited = getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
  return limited ? (double)space.rlim_cur : (double)INFINITY;
}

void hk_os_own_file(char *path, size_t size) {
  static const char here = 0;
  Dl_info info;
  const char *file = dladdr(&here, &info) != 0 && info.dli_fname ? info.dli_fname : "";
  snprintf(path, size, "%s", file);
}

hk_os_function *hk_os_find_function(const char *name) {
  hk_os_function *found = NULL;
#if defined(__EMSCRIPTEN__)
  (void)name;
#else
  void *symbol = dlsym(RTLD_DEFAULT, name);
  memcpy(&found, &symbol, sizeof found); /* C has no cast from one to the other */
#endif
  return found;
}

/* Linux tells the name of the processor. */
static int find_processor(char *name, size_t size) {
  char line[256];
  name[0] = '\0';
  FILE *file = fopen("/proc/cpuinfo", "r");
  if (file == NULL) return errno == ENOMEM ? ENOMEM : 0;
  while (name[0] == '\0' && fgets(line, sizeof line, file)) {
    const char *colon = strchr(line, ':');
    if (strncmp(line, "model name", 10) != 0 || colon == NULL) continue;
    colon += 1 + strspn(colon + 1, " ");
    snprintf(name, size, "%.*s", (int)strcspn(colon, "\n"), colon);
  }
  fclose(file);
  return 0;
}

int hk_os_describe_machine(struct hk_os_machine *machine) {
  HOOKE_KEEP_ERRNO; /* sysconf() sets it where /sys is not mounted */
  struct utsname name;
  const int named = uname(&name) == 0;
  snprintf(machine->system, sizeof machine->system, "%.64s%s%.64s", named ? name.sysname : "",
           named ? ", " : "", named ? name.machine : "");
  const long cores = sysconf(_SC_NPROCESSORS_ONLN);
  machine->cores = cores > 0 ? (int32_t)cores : 0;
  return find_processor(machine->processor, sizeof machine->processor);
}
