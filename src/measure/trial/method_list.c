#include "measure/trial/method_list.h"

#include "core/status.h"
#include "integrate/method.h"

#include <string.h>

static int32_t take_named(const char *name, size_t length, hk_method_taker *take, void *ctx) {
  for (int64_t k = 0; k < hooke_method_count(); k++) {
    const char *known = hooke_method_name(k);
    if (strlen(known) == length && strncmp(known, name, length) == 0) return take(known, ctx);
  }
  return hk_fail(HOOKE_BAD_VALUE, "methods", "there is no method \"%.*s\"", (int)length, name);
}

int32_t hk_method_list_read(const hooke_system *system, const char *names,
                            int32_t (*suits)(const char *method), hk_method_taker *take, void *ctx) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < hooke_method_count() && names[0] == '\0' && status == HOOKE_OK; k++) {
    const char *name = hooke_method_name(k);
    if (suits(name) && hk_method_suits(name, system)) status = take(name, ctx);
  }
  while (status == HOOKE_OK && *names) {
    const size_t length = strcspn(names, ", ");
    if (length > 0) status = take_named(names, length, take, ctx);
    names += length + strspn(names + length, ", ");
  }
  return status;
}
