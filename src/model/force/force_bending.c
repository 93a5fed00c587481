/* Bending: U = c/2 |d|^2 with d = x_a - 2 x_b + x_c for every triple; forces are linear in the positions. */

#include "core/memory.h"
#include "core/status.h"
#include "core/sum.h"
#include "kernel/spring/spring_loops.h"
#include "model/check_value.h"
#include "model/system.h"

#include <string.h>

/* ---- adding a group ---- */

static int32_t check_coefficients(int64_t count, int64_t coefficient_count, const double *coefficient) {
  if (coefficient_count != 1 && coefficient_count != count) {
    return hk_fail(HOOKE_BAD_VALUE, "coefficient",
                   "%lld values for %lld triples; allowed: one, or one for each",
                   (long long)coefficient_count, (long long)count);
  }
  for (int64_t k = 0; k < coefficient_count; k++) {
    if (coefficient[k] >= 0.0 && coefficient[k] <= 1e300) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "%g is not allowed; a number from 0 to 1e300 (N/m) is", coefficient[k]);
    return coefficient_count == 1 ? hk_fail_within(HOOKE_BAD_VALUE, "coefficient")
                                  : hk_fail_within(HOOKE_BAD_VALUE, "coefficient[%lld]", (long long)k);
  }
  return HOOKE_OK;
}

int32_t hk_system_add_bending(hooke_system *system, const struct hk_addition *added,
                              int64_t coefficient_count, const double *coefficient) {
  struct hk_group group;
  int32_t status = hk_group_begin(system, added, &group);
  if (status == HOOKE_OK) status = check_coefficients(added->count, coefficient_count, coefficient);
  for (int64_t k = 0; k < added->count && status == HOOKE_OK; k++)
    group.number[HOOKE_KAPPA][k] = coefficient[coefficient_count == 1 ? 0 : k];
  return hk_group_end(system, status, &group);
}

int32_t hooke_system_add_bending(hooke_system *system, const char *name, int64_t count,
                                 const int64_t *triples, int64_t coefficient_count,
                                 const double *coefficient) {
  const struct hk_addition added = {&hk_force_bending, name, count, triples, NULL, 0};
  return hk_system_add_bending(system, &added, coefficient_count, coefficient);
}

/* ---- the force ---- */

/* Starts at triple `number`. */
static struct hk_triples triples_from(const struct hk_bending *bending, int64_t number) {
  if (bending->run_count == 0) return (struct hk_triples){bending, 0, 0};
  const struct hk_bending_run *run = bending->run;
  const int64_t found = hk_runs_find(&run->first, bending->run_count, sizeof *run, number);
  return (struct hk_triples){bending, found, number - run[found].first};
}

/* f += factor times the forces at x; x, y and z apart. */
static void add_forces(const struct hk_bending *bending, double factor, const double *const x[3],
                       double *const f[3]) {
  for (int64_t k = 0; k < bending->run_count; k++)
    bending->run[k].loop(&bending->run[k], factor, x, f);
}

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  (void)t;
  if (system->strided->bent > 0) return HOOKE_OK; /* the pass over springs adds them */
  const double *const q[3] = {motion->q[0], motion->q[1], motion->q[2]};
  add_forces(&system->rest->bending, 1.0, q, motion->f);
  return HOOKE_OK;
}

/* x_0 - 2 x_1 + x_2 of rows of x y z. */
static void find_bend(const struct hk_triple *triple, const double *x, double bend[3]) {
  for (int a = 0; a < 3; a++) {
    bend[a] = (x[3 * triple->particle[0] + a] - 2.0 * x[3 * triple->particle[1] + a]) +
              x[3 * triple->particle[2] + a];
  }
}

static double energy(const hooke_system *system, double t, const double *q) {
  (void)t;
  struct hk_sum sum = {0.0, 0.0};
  struct hk_triple triple;
  for (struct hk_triples at = {&system->rest->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    double d[3];
    find_bend(&triple, q, d);
    hk_sum_add(&sum, 0.5 * triple.coefficient * ((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]));
  }
  return hk_sum_value(&sum);
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  (void)t, (void)q, (void)v;
  struct hk_triples at = triples_from(&system->rest->bending, first);
  struct hk_triple triple;
  for (int64_t k = 0; k < wanted && hk_next_triple(&at, &triple); k++) {
    const double c = triple.coefficient;
    out[k] =
        (struct hk_element){.count = 3, .weight = {1.0, -2.0, 1.0}, .k_along = c, .k_across = c, .over = 1.0};
    for (int e = 0; e < 3; e++)
      out[k].particle[e] = (int32_t)triple.particle[e];
  }
}

static void multiply(const hooke_system *system, double a, double b, const double *const x[3],
                     double *const out[3]) {
  (void)b;
  if (a != 0.0) add_forces(&system->rest->bending, -a, x, out);
}

static void add_stiffness(const hooke_system *system, double *sum) {
  struct hk_triple triple;
  for (struct hk_triples at = {&system->rest->bending, 0, 0}; hk_next_triple(&at, &triple);)
    *sum += 16.0 * triple.coefficient;
}

/* ---- from groups ---- */

static void add_run(hooke_system *system, const struct hk_piece *piece) {
  struct hk_bending *bending = &system->rest->bending;
  struct hk_bending_run *run = &bending->run[bending->run_count++];
  int32_t *const *particle = piece->group->particle;
  run->first = bending->count;
  run->count = piece->count;
  run->shape = (piece->indexed ? HOOKE_BENDING_INDEXED : 0) | (piece->mixed ? HOOKE_BENDING_MIXED : 0);
  run->start = particle[0][piece->from];
  run->offset = particle[1][piece->from] - run->start;
  run->coefficient = piece->group->number[HOOKE_KAPPA][piece->from];
  memcpy(run->particle, piece->particle, sizeof run->particle);
  run->coefficients = piece->number[HOOKE_KAPPA];
  run->loop = hk_spring_set(0)->bending;
  bending->count += piece->count;
}

static int32_t commit(hooke_system *system, const struct hk_group *group, int64_t count) {
  struct hk_bending *bending = &system->rest->bending;
  memset(bending, 0, sizeof *bending);
  return hk_runs_commit(system, &hk_force_bending, group, count, &bending->stored, (void **)&bending->run,
                        sizeof *bending->run, add_run);
}

static void release(hooke_system *system) {
  struct hk_bending *bending = &system->rest->bending;
  hk_free(bending->run);
  hk_stored_release(&bending->stored);
  memset(bending, 0, sizeof *bending);
}

static int64_t memory(const hooke_system *system) {
  const struct hk_bending *bending = &system->rest->bending;
  return bending->run_count * (int64_t)sizeof *bending->run +
         hk_stored_memory(&hk_force_bending, &bending->stored);
}

static void check(const hooke_system *system, uint32_t *value) {
  struct hk_triple triple;
  hk_check_whole(value, system->rest->bending.count);
  for (struct hk_triples at = {&system->rest->bending, 0, 0}; hk_next_triple(&at, &triple);) {
    hk_check_add(value, triple.particle, 3, sizeof *triple.particle);
    hk_check_add(value, &triple.coefficient, 1, sizeof(double));
  }
}

static void recall(const hooke_system *system, int64_t first, struct hk_group *to) {
  struct hk_triples at = triples_from(&system->rest->bending, first);
  struct hk_triple triple;
  for (int64_t k = 0; k < to->count && hk_next_triple(&at, &triple); k++) {
    for (int e = 0; e < 3; e++)
      to->particle[e][k] = (int32_t)triple.particle[e];
    to->number[HOOKE_KAPPA][k] = triple.coefficient;
  }
}

const struct hk_force_row hk_force_bending = {.name = "bending",
                                              .kind = HOOKE_CONSTANT,
                                              .in_scenes = 1,
                                              .title = "bending",
                                              .members = "triples",
                                              .member = "triple",
                                              .place = "triples",
                                              .width = {1},
                                              .member_particles = 3,
                                              HOOKE_FORCE_OF_GROUPS,
                                              .bytes = 60.0,
                                              .add = add,
                                              .energy = energy,
                                              .elements = elements,
                                              .multiply = multiply,
                                              .add_stiffness = add_stiffness};
