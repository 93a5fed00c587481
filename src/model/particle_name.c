/* Names of particles, which take the place of their numbers. */
#include "core/memory.h"
#include "core/number.h"
#include "core/status.h"
#include "model/part_record.h"
#include "model/system.h"

#include <string.h>

int64_t hooke_system_named_particle(const hooke_system *system, const char *name) {
  for (int64_t k = 0; k < system->rest->name_count; k++)
    if (strcmp(system->rest->name[k].text, name) == 0) return system->rest->name[k].particle;
  return -1;
}

static int32_t check_name(const hooke_system *system, const char *name, int64_t particle) {
  int64_t mantissa;
  const int64_t named = hooke_system_named_particle(system, name), length = (int64_t)strlen(name);
  if (length == 0 || strpbrk(name, ".: \t\r\n") || hk_number_scan(name, length, &mantissa) == length)
    return hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "\"%.64s\" names no particle; allowed: a text that is no number, without '.', ':' and blanks", name);
  if (named >= 0)
    return hk_fail(HOOKE_BAD_VALUE, name, "is the name of particle %lld already; allowed: each name once",
                   (long long)named);
  if (particle >= 0 && particle < system->particle_count) return HOOKE_OK;
  return hk_fail_index(name, "there is no particle", (double)particle, system->particle_count);
}

int32_t hooke_system_name_particle(hooke_system *system, const char *name, int64_t particle) {
  struct hk_system_rest *rest = system->rest;
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK) status = check_name(system, name, particle);
  if (status == HOOKE_OK) status = hk_room((void **)&rest->name, rest->name_count, sizeof *rest->name);
  char *text = status == HOOKE_OK ? hk_copy_text(name) : NULL;
  if (text == NULL) return status == HOOKE_OK ? HOOKE_NO_MEMORY : status;
  rest->name[rest->name_count++] = (struct hk_particle_name){text, particle};
  return HOOKE_OK;
}

int32_t hk_names_check(const hooke_system *system) {
  for (int64_t k = 0; k < system->rest->name_count; k++) {
    const char *name = system->rest->name[k].text, *other = NULL;
    for (int64_t p = 0; p < system->part_count; p++)
      if (strcmp(system->part[p].name, name) == 0) other = "part";
    for (int64_t g = 0; g < system->group_count; g++)
      if (strcmp(system->group[g].name, name) == 0) other = "group";
    if (other == NULL) continue;
    hk_fail(HOOKE_BAD_VALUE, name, "is the name of a %s; allowed: another name for the particle", other);
    return hk_fail_within(HOOKE_BAD_VALUE, "names");
  }
  return HOOKE_OK;
}

void hk_names_release(hooke_system *system) {
  while (system->rest->name_count > 0)
    hk_free(system->rest->name[--system->rest->name_count].text);
  hk_free(system->rest->name);
}
