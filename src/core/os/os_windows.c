#include "core/os/os.h"

#include <malloc.h>
#include <math.h>
#include <windows.h>

void *hk_os_allocate(size_t alignment, size_t size) {
  return _aligned_malloc(size, alignment > 0 ? alignment : 16);
}

void hk_os_free(void *block) {
  _aligned_free(block);
}

/* There are no signals to block. */
int hk_os_start_thread(pthread_t *thread, void *(*work)(void *), void *ctx) {
  return pthread_create(thread, NULL, work, ctx);
}

int32_t hk_os_processors(void) {
  DWORD_PTR own = 0, all = 0;
  if (!GetProcessAffinityMask(GetCurrentProcess(), &own, &all) || own == 0) return 1;
  return (int32_t)__builtin_popcountll(own);
}

double hk_os_physical_memory(void) {
  MEMORYSTATUSEX memory = {.dwLength = sizeof memory};
  return GlobalMemoryStatusEx(&memory) ? (double)memory.ullTotalPhys : (double)INFINITY;
}

double hk_os_address_limit(void) {
  return (double)INFINITY;
}

void hk_os_own_file(char *path, size_t size) {
  static const char here = 0;
  enum { LONGEST = 32768 };
  const DWORD flags = GET_MODULE_HANDLE_EX_FLAG_FROM_ADDRESS | GET_MODULE_HANDLE_EX_FLAG_UNCHANGED_REFCOUNT;
  HMODULE module = NULL;
  wchar_t *wide = hk_os_allocate(0, LONGEST * sizeof *wide);
  path[0] = '\0';
  if (wide && GetModuleHandleExW(flags, (const wchar_t *)(const void *)&here, &module) &&
      GetModuleFileNameW(module, wide, LONGEST) > 0 &&
      WideCharToMultiByte(CP_UTF8, 0, wide, -1, path, (int)size, NULL, NULL) == 0)
    path[0] = '\0';
  hk_os_free(wide);
}

hk_os_function *hk_os_find_function(const char *name) {
  (void)name;
  return NULL;
}

/* The registry has the name of the processor. */
int hk_os_describe_machine(struct hk_os_machine *machine) {
  static const char key[] = "HARDWARE\\DESCRIPTION\\System\\CentralProcessor\\0";
  DWORD size = sizeof machine->processor;
  *machine = (struct hk_os_machine){.system = "Windows, x86_64", .cores = hk_os_processors()};
  if (RegGetValueA(HKEY_LOCAL_MACHINE, key, "ProcessorNameString", RRF_RT_REG_SZ, NULL, machine->processor,
                   &size) != ERROR_SUCCESS)
    machine->processor[0] = '\0';
  return 0;
}
