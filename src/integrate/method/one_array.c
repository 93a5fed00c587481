#include "integrate/method/one_array.h"

#include "core/memory.h"
#include "kernel/step_loops.h"
#include "model/coordinates/coordinates.h"

int32_t hk_one_array_create(hooke_integrator *it) {
  struct hk_one_array *array = hk_new(1, sizeof *array);
  it->array = array;
  if (array == NULL || hk_unknowns_create(it, 0, &array->unknowns) != HOOKE_OK) return HOOKE_NO_MEMORY;
  if (it->motion && hk_integrator_keep_start(it) != HOOKE_OK) return HOOKE_NO_MEMORY;
  const int64_t size = array->unknowns.size, numbers = 4 * size;
  double *block = hk_new(numbers, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += numbers * (int64_t)sizeof(double);
  array->y = hk_part(&block, size);
  if (it->rate) it->x = array->y;
  array->start = hk_part(&block, size);
  array->slope = hk_part(&block, size);
  array->sum = block;
  return HOOKE_OK;
}

void hk_one_array_destroy(struct hk_one_array *array) {
  if (array == NULL) return;
  hk_unknowns_release(&array->unknowns);
  hk_free(array->y);
  hk_free(array);
}

void hk_one_array_begin(hooke_integrator *it) {
  if (it->motion) hk_unknowns_take(it, &it->array->unknowns, it->array->y);
}

/* Those of movers. */
static double *own_of(const struct hk_unknowns *u, double *y) {
  return y + 6 * u->free_count;
}

void hk_one_array_give(hooke_integrator *it, double *y) {
  const struct hk_unknowns *u = &it->array->unknowns;
  hk_movers_normalise(it->system, own_of(u, y));
  hk_unknowns_give(it, u, y);
}

int32_t hk_one_array_push(hooke_integrator *it, double t, int32_t kept) {
  const struct hk_unknowns *u = &it->array->unknowns;
  const int32_t status = kept ? HOOKE_OK : hk_integrator_forces(it, t);
  if (status != HOOKE_OK) return status;
  hk_movers_push(it->system, it->motion, own_of(u, it->array->y), u->push);
  hk_unknowns_accelerations(it, u, it->array->slope + 3 * u->free_count);
  return HOOKE_OK;
}

void hk_one_array_kick(hooke_integrator *it, double h, double *y) {
  const struct hk_unknowns *u = &it->array->unknowns;
  hk_advance(3 * u->free_count, h, it->array->slope + 3 * u->free_count, y + 3 * u->free_count);
  hk_movers_kick(it->system, h, u->push, own_of(u, y));
}

void hk_one_array_drift(hooke_integrator *it, double h) {
  const struct hk_unknowns *u = &it->array->unknowns;
  double *y = it->array->y;
  hk_advance(3 * u->free_count, h, y + 3 * u->free_count, y);
  hk_movers_drift(it->system, h, own_of(u, y));
}
