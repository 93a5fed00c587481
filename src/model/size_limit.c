/* Limits on the size of a system: its numbers have 32 bits, and memory is finite. Checked before anything is
 * allocated. */
#include "model/system.h"

#include "core/print.h"
#include "core/memory_limit.h"
#include "core/status.h"

/* Maximum bytes a particle, a group and a part while a scene is built, committed and given to an explicit
 * method; those of members of groups are in the table of forces, of bodies in that of coordinates. Tests
 * compare them with the memory used. */
static const double PER_PARTICLE = 280.0, PER_GROUP = 6000.0, PER_PART = 14000.0;

/* Number of members of a force, including those to come. */
static double members_of(const hooke_system *system, const struct hk_more *more, int32_t force) {
  double count = (double)system->rest->member_total[force];
  for (size_t k = 0; k < sizeof more->of / sizeof more->of[0]; k++)
    count += more->of[k].force == hk_force_table(force) ? more->of[k].count : 0.0;
  return count;
}

double hk_system_needed_bytes(const hooke_system *system, struct hk_more more) {
  double bytes = PER_PARTICLE * ((double)system->particle_count + more.particles);
  for (int32_t k = 0; hk_force_table(k); k++)
    bytes += hk_force_table(k)->bytes * members_of(system, &more, k);
  bytes += hk_movers_bytes(system);
  return bytes + PER_GROUP * (double)system->group_count + PER_PART * (double)system->part_count;
}

static void add_count(char *list, size_t size, double count, const char *name, int *fits) {
  *fits = *fits && count <= INT32_MAX;
  if (count > 0.0) hk_append(list, size, "%s%.10g %s", list[0] ? ", " : "", count, name);
}

int32_t hk_system_check_size(const hooke_system *system, struct hk_more more, const char *what) {
  const double bytes = hk_system_needed_bytes(system, more);
  char list[160] = "", shown[HOOKE_BYTES_SHOWN];
  int fits = 1;
  add_count(list, sizeof list, (double)system->particle_count + more.particles, "particles", &fits);
  for (int32_t k = 0; hk_force_table(k); k++)
    add_count(list, sizeof list, members_of(system, &more, k), hk_force_table(k)->members, &fits);
  if (what == NULL) what = "this scene";
  if (fits) return hk_memory_require(system->rest->memory_limit, bytes, what);
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "%s needs %s of memory for %s; allowed: up to 2147483647 of each in a system", what,
                 hk_show_bytes(bytes, shown), list);
}

int32_t hk_size_check(int64_t size, int32_t doubles) {
  const int64_t most = 3 * (int64_t)INT32_MAX; /* as many as systems have */
  if (size >= 1 && size <= most)
    return hk_memory_require(0.0, 8.0 * doubles * (double)size, "a problem of this size");
  return hk_fail(HOOKE_BAD_VALUE, "size", "%lld is not allowed; 1 to %lld are", (long long)size,
                 (long long)most);
}

int32_t hk_system_check_more(const hooke_system *system, const struct hk_force_row *force, int64_t count) {
  return hk_system_check_size(system, (struct hk_more){.of = {{force, (double)count}}}, NULL);
}

int32_t hooke_system_limit_memory(hooke_system *system, double bytes) {
  if (!(bytes >= 0.0))
    return hk_fail(HOOKE_BAD_VALUE, "memory", "%g is not allowed; a number of bytes >= 0 is", bytes);
  system->rest->memory_limit = bytes;
  return HOOKE_OK;
}
