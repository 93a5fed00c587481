/* What systems do differently, besides files (core/os/os_file.h) and text (core/os/os_text.h): os_posix.c is
 * for POSIX, os_windows.c for Windows. Threads are those of POSIX on both. */
#pragma once

#include <pthread.h>
#include <stddef.h>
#include <stdint.h>

/* A block whose address is a multiple of `alignment`, of which `size` is a multiple; 0: as malloc() aligns.
 * NULL: no memory. */
void *hk_os_allocate(size_t alignment, size_t size);
void hk_os_free(void *block);

/* Starts a thread with all signals blocked, so that handlers run in the threads of the program. Returns 0 or
 * an errno. */
int hk_os_start_thread(pthread_t *thread, void *(*work)(void *), void *ctx);

/* Processors that this process may use, at least 1. */
int32_t hk_os_processors(void);

/* [bytes] INFINITY if the system does not tell, or sets no limit. */
double hk_os_physical_memory(void);
double hk_os_address_limit(void);

/* The file that this code was loaded from: the library or, if it is linked statically, the program. "" if the
 * system does not tell. */
void hk_os_own_file(char *path, size_t size);

/* A function of the libraries that are loaded with this code; NULL if none has it, or the system does not
 * tell. */
typedef void hk_os_function(void);
hk_os_function *hk_os_find_function(const char *name);

/* "" and 0 where the system does not tell. Returns 0, or ENOMEM. */
struct hk_os_machine {
  char processor[256], system[160]; /* the kernel with its architecture */
  int32_t cores;
};
int hk_os_describe_machine(struct hk_os_machine *machine);
