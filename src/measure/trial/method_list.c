#include "measure/trial/method_list.h"

#include "core/status.h"
#include "integrate/method.h"

#include <string.h>

/* Number of the method in the table; the count of methods if there is none of that name. */
static int64_t find(const char *name, size_t length) {
  int64_t k = 0;
  while (k < hooke_method_count() &&
         (strlen(hooke_method_name(k)) != length || strncmp(hooke_method_name(k), name, length) != 0))
    k++;
  return k;
}

static int32_t add(const hooke_system *system, const char *name, const char **method, int32_t *count) {
  if (!hooke_method_is_built(name))
    return hk_fail(HOOKE_NOT_BUILT, "methods", "this build is without %s", name);
  if (*count == HOOKE_LISTED_METHODS)
    return hk_fail(HOOKE_BAD_VALUE, "methods", "more than %d methods", HOOKE_LISTED_METHODS);
  method[(*count)++] = name;
  return hk_method_require(hk_method_find(name), system);
}

int32_t hk_method_list_read(const hooke_system *system, const char *names,
                            int32_t (*suits)(const char *method), const char *method[HOOKE_LISTED_METHODS],
                            int32_t *count) {
  int32_t status = HOOKE_OK;
  *count = 0;
  for (int64_t k = 0; k < hooke_method_count() && names[0] == '\0' && status == HOOKE_OK; k++) {
    const char *name = hooke_method_name(k);
    if (suits(name) && hk_method_suits(name, system)) status = add(system, name, method, count);
  }
  while (status == HOOKE_OK && *names) {
    const size_t length = strcspn(names, ", ");
    const char *known = length > 0 ? hooke_method_name(find(names, length)) : NULL;
    if (known)
      status = add(system, known, method, count);
    else if (length > 0)
      return hk_fail(HOOKE_BAD_VALUE, "methods", "there is no method \"%.*s\"", (int)length, names);
    names += length + strspn(names + length, ", ");
  }
  return status;
}
