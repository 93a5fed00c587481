#include "integrate/method.h"

#include <stddef.h>
#include <string.h>

static const struct hk_method *const table[] = {
    &hk_forward_euler, &hk_symplectic_euler, &hk_verlet, &hk_rk4,           &hk_backward_euler,
    &hk_cvode_bdf,     &hk_cvode_adams,      &hk_rk8pd,  &hk_arkode_esdirk,
};

enum { ROWS = sizeof table / sizeof table[0] };

int64_t hooke_method_count(void) {
  int64_t count = 0;
  for (int64_t k = 0; k < ROWS; k++)
    count += !table[k]->reference;
  return count;
}

const char *hooke_method_name(int64_t method) {
  if (method < 0) return NULL;
  for (int64_t k = 0; k < ROWS; k++) {
    if (!table[k]->reference && method-- == 0) return table[k]->name;
  }
  return NULL;
}

const struct hk_method *hk_method_find(const char *name) {
  for (int64_t k = 0; k < ROWS; k++) {
    if (strcmp(table[k]->name, name) == 0) return table[k];
  }
  return NULL;
}

const char *hooke_method_summary(const char *name) {
  const struct hk_method *method = hk_method_find(name);
  return method ? method->summary : NULL;
}

int32_t hooke_method_is_adaptive(const char *name) {
  const struct hk_method *method = hk_method_find(name);
  return method ? method->adaptive : -1;
}

int32_t hooke_method_is_built(const char *name) {
  const struct hk_method *method = hk_method_find(name);
  return method ? method->built : 0;
}
