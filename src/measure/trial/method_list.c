#include "measure/trial/method_list.h"

#include "core/status.h"
#include "integrate/method.h"

#include <stdio.h>
#include <string.h>

/* The method that a word of so many bytes means; NULL if there is none, or one for references alone. */
static const struct hk_method *find(const char *word, size_t length) {
  char given[64]; /* no name is as long */
  snprintf(given, sizeof given, "%.*s", (int)(length < sizeof given ? length : sizeof given - 1), word);
  const struct hk_method *method = hk_method_find(hooke_method_meant(given));
  return method && !method->reference ? method : NULL;
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
    const struct hk_method *known = length > 0 ? find(names, length) : NULL;
    if (known)
      status = add(system, known->name, method, count);
    else if (length > 0)
      return hk_fail(HOOKE_BAD_VALUE, "methods", "there is no method \"%.*s\"", (int)length, names);
    names += length + strspn(names + length, ", ");
  }
  return status;
}
