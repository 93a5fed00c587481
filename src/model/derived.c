#include "model/derived.h"

#include "core/memory.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

int32_t hk_system_add_derived(hooke_system *system, const char *part, const char *family, const char *name,
                              const char *unit, double value) {
  struct hk_system_rest *rest = system->rest;
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK)
    status = hk_room((void **)&rest->derived, rest->derived_count, sizeof *rest->derived);
  char *copy = status == HOOKE_OK ? hk_copy_text(part) : NULL;
  if (copy == NULL) return status == HOOKE_OK ? HOOKE_NO_MEMORY : status;
  rest->derived[rest->derived_count++] = (struct hk_derived){copy, family, name, unit, value};
  return HOOKE_OK;
}

void hk_system_drop_derived(hooke_system *system, int64_t kept) {
  while (system->rest->derived_count > kept)
    hk_free(system->rest->derived[--system->rest->derived_count].part);
}

static const struct hk_derived *find(const hooke_system *system, int64_t number) {
  return number >= 0 && number < system->rest->derived_count ? &system->rest->derived[number] : NULL;
}

const char *hooke_system_derived_text(const hooke_system *system, int64_t number, const char *what) {
  const struct hk_derived *row = find(system, number);
  if (row == NULL) return NULL;
  if (strcmp(what, "part") == 0) return row->part;
  if (strcmp(what, "family") == 0) return row->family;
  if (strcmp(what, "name") == 0) return row->name;
  return strcmp(what, "unit") == 0 ? row->unit : NULL;
}

double hooke_system_derived_value(const hooke_system *system, int64_t number) {
  const struct hk_derived *row = find(system, number);
  return row ? row->value : (double)NAN;
}
