#include "core/memory_limit.h"

#include "core/print.h"
#include "core/status.h"

#include <math.h>
#include <stdio.h>
#include <sys/resource.h>
#include <unistd.h>

double hk_memory_limit(const char **which) {
  const long pages = sysconf(_SC_PHYS_PAGES), page = sysconf(_SC_PAGESIZE);
  const double physical = pages > 0 && page > 0 ? (double)pages * (double)page : (double)INFINITY;
  struct rlimit space;
  const int limited = getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY;
  const double allowed = limited ? (double)space.rlim_cur : (double)INFINITY;
  if (which) *which = allowed < physical ? "the limit on the address space" : "physical memory";
  return fmin(physical, allowed);
}

const char *hk_show_bytes(double bytes, char shown[HOOKE_BYTES_SHOWN]) {
  static const char *const units[] = {"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  size_t unit = 0;
  while (bytes >= 999.5 && unit + 1 < sizeof units / sizeof units[0]) {
    bytes /= 1000.0;
    unit++;
  }
  hk_print(shown, HOOKE_BYTES_SHOWN, bytes < 1e6 ? "%.3g %s" : "%.2g %s", bytes, units[unit]);
  return shown;
}

int32_t hk_memory_require(double limit, double bytes, const char *what) {
  const char *which = "the limit that was set";
  const double room = limit > 0.0 ? limit : hk_memory_limit(&which);
  if (bytes <= room) return HOOKE_OK;
  char needed[HOOKE_BYTES_SHOWN], there[HOOKE_BYTES_SHOWN];
  return hk_fail(HOOKE_NO_MEMORY, NULL,
                 "%s needs %s of memory; there are %s (%s); allowed: less than that, or a higher limit "
                 "set by the caller",
                 what, hk_show_bytes(bytes, needed), hk_show_bytes(room, there), which);
}
