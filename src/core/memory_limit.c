#include "core/memory_limit.h"

#include "core/os/os.h"
#include "core/print.h"
#include "core/status.h"

#include <math.h>
#include <stdio.h>

double hk_memory_limit(const char **which) {
  const double physical = hk_os_physical_memory(), allowed = hk_os_address_limit();
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
  const double available = limit > 0.0 ? limit : hk_memory_limit(&which);
  if (bytes <= available) return HOOKE_OK;
  char needed[HOOKE_BYTES_SHOWN], there[HOOKE_BYTES_SHOWN];
  return hk_fail(HOOKE_NO_MEMORY, NULL,
                 "%s needs %s of memory; there are %s (%s); allowed: "
                 "less than that, or a higher limit set by the caller",
                 what, hk_show_bytes(bytes, needed), hk_show_bytes(available, there), which);
}
