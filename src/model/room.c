/* Whether a system may grow: its numbers have 32 bits, and memory ends. Asked before anything is
 * allocated. */
#include "model/system.h"

#include "core/print.h"
#include "core/memory_limit.h"
#include "core/status.h"

#include <stdio.h>
#include <string.h>

/* Bytes at most while a scene is built, committed and given to an explicit method; tests hold them against
 * what is used. */
static const double PER_PARTICLE = 280.0, PER_SPRING = 50.0, PER_TRIPLE = 60.0, PER_TETRAHEDRON = 170.0,
                    PER_GROUP = 6000.0, PER_PART = 14000.0;

double hk_system_needed_bytes(const hooke_system *system, struct hk_more more) {
  const int64_t groups = system->group_count + system->bending_group_count + system->altitude_group_count;
  return PER_PARTICLE * ((double)system->particle_count + more.particles) +
         PER_SPRING * ((double)system->spring_total + more.springs) +
         PER_TRIPLE * ((double)system->triple_total + more.triples) +
         PER_TETRAHEDRON * ((double)system->tetrahedron_total + more.tetrahedra) +
         PER_GROUP * (double)groups + PER_PART * (double)system->part_count;
}

int32_t hk_system_check_room(const hooke_system *system, struct hk_more more, const char *what) {
  const struct {
    const char *name;
    double all;
  } counts[] = {{"particles", (double)system->particle_count + more.particles},
                {"springs", (double)system->spring_total + more.springs},
                {"triples", (double)system->triple_total + more.triples},
                {"tetrahedra", (double)system->tetrahedron_total + more.tetrahedra}};
  enum { COUNTS = sizeof counts / sizeof counts[0] };
  const double bytes = hk_system_needed_bytes(system, more);
  char list[160] = "", shown[HOOKE_BYTES_SHOWN];
  int fits = 1;
  for (size_t k = 0; k < COUNTS; k++) {
    const size_t used = strlen(list);
    fits = fits && counts[k].all <= INT32_MAX;
    if (counts[k].all > 0.0)
      hk_print(list + used, sizeof list - used, "%s%.10g %s", used ? ", " : "", counts[k].all,
               counts[k].name);
  }
  if (what == NULL) what = "this scene";
  if (fits) return hk_memory_require(system->memory_limit, bytes, what);
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "%s needs %s of memory for %s; allowed: up to 2147483647 of each in a system", what,
                 hk_show_bytes(bytes, shown), list);
}

int32_t hooke_system_limit_memory(hooke_system *system, double bytes) {
  if (!(bytes >= 0.0))
    return hk_fail(HOOKE_BAD_VALUE, "memory", "%g is not allowed; a number of bytes >= 0 is", bytes);
  system->memory_limit = bytes;
  return HOOKE_OK;
}
