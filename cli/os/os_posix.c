#include "os.h"

#include <inttypes.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#if __has_include(<dlfcn.h>) && !defined(__EMSCRIPTEN__)
#include <dlfcn.h>
#define HOOKE_HAS_LOADER
#endif

extern char **environ;

void cli_os_begin(void) {
#ifdef SIGXFSZ
  signal(SIGXFSZ, SIG_IGN); /* a limit on file sizes is reported like every failed write */
#endif
}

static void catch_signal(int number, void (*interrupt)(int)) {
  struct sigaction action = {.sa_handler = interrupt, .sa_flags = SA_RESTART}; /* writing continues */
  struct sigaction old;
  sigemptyset(&action.sa_mask);
  /* a program started with the signal ignored (nohup, a background job) keeps ignoring it */
  if (sigaction(number, NULL, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(number, &action, NULL);
}

void cli_os_catch_interrupts(void (*interrupt)(int number)) {
  catch_signal(SIGINT, interrupt);
  catch_signal(SIGTERM, interrupt);
  catch_signal(SIGHUP, interrupt);
}

int32_t cli_os_processors(void) {
  const long count = sysconf(_SC_NPROCESSORS_ONLN);
  return count > 0 ? (int32_t)count : 1;
}

/* From /proc/self/status, which counts from the start of this program; getrusage() includes the caller's
 * memory before it. */
void cli_os_memory(int64_t *now, int64_t *most) {
  char line[256];
  int64_t kilobytes;
  FILE *file = fopen("/proc/self/status", "r");
  while (file && fgets(line, sizeof line, file)) {
    if (sscanf(line, "VmHWM: %" SCNd64, &kilobytes) == 1) *most = 1024 * kilobytes;
    if (sscanf(line, "VmRSS: %" SCNd64, &kilobytes) == 1) *now = 1024 * kilobytes;
  }
  if (file) fclose(file);
}

void cli_os_give_back_memory(void) {
#ifdef __GLIBC__
  malloc_trim(0);
#endif
}

const char *cli_os_load(const char *path, const char *const name[2], void *symbol[2]) {
#ifdef HOOKE_HAS_LOADER
  void *library = dlopen(path, RTLD_NOW | RTLD_LOCAL);
  for (int k = 0; library && k < 2; k++)
    symbol[k] = dlsym(library, name[k]);
  return library ? NULL : dlerror();
#else
  (void)path, (void)name, (void)symbol;
  return "";
#endif
}

/* ---- files ---- */

const char *cli_os_last_slash(const char *path) {
  return strrchr(path, '/');
}

int32_t cli_os_is_same_file(const char *one, const char *other) {
  struct stat first, second;
  return stat(one, &first) == 0 && stat(other, &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino;
}

int cli_os_make_file(char *path) {
  const int descriptor = mkstemp(path);
  return descriptor < 0 ? -1 : close(descriptor);
}

int32_t cli_os_show_page(const char *page) {
  const char *own = getenv("BROWSER");
  const char *const programs[] = {own && own[0] ? own : "xdg-open", "xdg-open", "open"};
  pid_t child;
  for (size_t k = 0; k < sizeof programs / sizeof programs[0]; k++) {
    char *words[] = {(char *)(uintptr_t)programs[k], (char *)(uintptr_t)page, NULL};
    if (posix_spawnp(&child, programs[k], NULL, NULL, words, environ) == 0) return 1;
  }
  return 0;
}
