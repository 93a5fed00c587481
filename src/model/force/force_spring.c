/* Springs. Derivative of f = -T u with T = kappa (r - l0) + gamma v.u, u = x/r, P = I - u u^T:
 *   df/dx = -(u (kappa u + gamma P v / r)^T + (T/r) P)     df/dv = -gamma u u^T */

#include "core/memory.h"
#include "core/sum.h"
#include "kernel/spring/tangent_loops.h"
#include "model/sum/spring_batch.h"
#include "model/check_value.h"
#include "model/force/force.h"
#include "model/sum/tiled.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* ---- runs with a curve, one spring after the other ---- */

/* A spring from end 0 to end 1, of which x and u hold both; v NULL: u is not filled. */
HOOKE_INLINE struct hk_spring take_spring(const struct hk_run *run, int64_t k, const double *const q[3],
                                          const double *const v[3], double x[6], double u[6]) {
  struct hk_spring spring = hk_run_spring(run, k);
  for (int a = 0; a < 3; a++) {
    x[a] = q[a][spring.head];
    x[3 + a] = q[a][spring.tail];
    if (v) u[a] = v[a][spring.head];
    if (v) u[3 + a] = v[a][spring.tail];
  }
  spring.head = 0;
  spring.tail = 1;
  return spring;
}

HOOKE_INLINE int64_t add_curves(const struct hk_run *run, const struct hk_fields *fields, int damped) {
  int64_t lost = 0;
  for (int64_t k = 0; k < run->count; k++) {
    double x[6], u[6];
    struct hk_stretch s;
    const struct hk_spring spring = take_spring(run, k, fields->q, damped ? fields->v : NULL, x, u);
    const int64_t i = hk_run_head(run, k), j = hk_run_tail(run, k);
    hk_spring_stretch(&spring, x, damped ? u : NULL, &s);
    lost += hk_spring_shortness(s.length, spring.rest_length);
    const double over = s.tension * hk_spring_inverse_length(s.length);
    for (int a = 0; a < 3; a++) {
      const double b = over * (x[a] - x[3 + a]);
      fields->f[a][i] -= b;
      fields->f[a][j] += b;
    }
  }
  return lost;
}

static int64_t add_curved(const struct hk_run *run, const struct hk_fields *fields) {
  return add_curves(run, fields, (run->shape & HOOKE_RUN_DAMPED) != 0);
}

static int64_t add_curved_undamped(const struct hk_run *run, const struct hk_fields *fields) {
  return add_curves(run, fields, 0);
}

void hk_spring_fill_tangent(const struct hk_run *run, const struct hk_fields *fields, double alpha,
                            double beta, const struct hk_tangent *tangent) {
  for (int64_t k = 0; k < run->count; k++) {
    const int64_t at = run->first + k;
    double x[6], v[6];
    struct hk_spring_slope s = {.b = 0.0};
    const struct hk_spring spring = take_spring(run, k, fields->q, fields->v, x, v);
    const int there = hk_spring_slope_find(&spring, x, v, &s), turns = there && !s.isotropic;
    const double axial = sqrt(beta * s.gamma), across = there ? alpha * s.b : 0.0;
    for (int a = 0; a < 3; a++) {
      const double u = turns ? s.u[a] : 0.0;
      tangent->u[a][at] = tangent->b ? u : axial * u;
      if (tangent->b) tangent->e[a][at] = turns ? alpha * s.c[a] + (beta * s.gamma - across) * u : 0.0;
    }
    if (tangent->b) tangent->b[at] = across;
  }
}

/* ---- sums ---- */

static int32_t add(const hooke_system *system, struct hk_motion *motion, double t) {
  if (system->strided->count > 0 || system->tiled->particles > 0) {
    const struct hk_move keep = {
        .kind = HOOKE_MOVE_KEEP, .stride = hk_motion_stride(motion), .f = motion->f[0]};
    hk_motion_pass(system, motion, t, &keep);
    return HOOKE_OK;
  }
  struct hk_fields fields;
  for (int a = 0; a < 3; a++) {
    fields.q[a] = motion->q[a];
    fields.v[a] = motion->v[a];
    fields.f[a] = motion->f[a];
  }
  int64_t shortness = 0;
  struct hk_run_walk walk;
  hk_begin_runs(system->springs, t, &walk);
  for (const struct hk_run *run; (run = hk_next_run(&walk)) != NULL;)
    shortness += motion->zero ? run->undamped_loop(run, &fields) : run->loop(run, &fields);
  hk_motion_keep_short(motion, shortness);
  return 0;
}

static int64_t passed(const hooke_system *system, const double *before, const double *now, int64_t ends[2]) {
  struct hk_spring_batch batch;
  int64_t count = 0;
  for (hk_begin_batches(HOOKE_AS_GIVEN, &batch); hk_next_batch(system, &batch);) {
    for (int64_t k = 0; k < batch.count; k++) {
      const int64_t i = 3 * (int64_t)batch.head[k], j = 3 * (int64_t)batch.tail[k];
      if (!(batch.rest_length[k] > 0.0) || !hk_spring_turned(before + i, before + j, now + i, now + j))
        continue;
      if (count++ > 0) continue;
      ends[0] = batch.head[k];
      ends[1] = batch.tail[k];
    }
  }
  return count;
}

static double energy(const hooke_system *system, double t, const double *q) {
  struct hk_sum sum = {0.0, 0.0};
  double length[HOOKE_SPRING_BATCH], stored[HOOKE_SPRING_BATCH];
  struct hk_spring_batch batch;
  for (hk_begin_batches(t, &batch); hk_next_batch(system, &batch);) {
    const struct hk_some_springs springs = hk_batch_springs(&batch);
    hk_some_energies(&springs, q, length, stored);
    for (int64_t k = 0; k < batch.count && batch.curve; k++) {
      const struct hk_spring spring = hk_batch_spring(&batch, k);
      stored[k] = hk_spring_law(&spring, length[k]).energy;
    }
    for (int64_t k = 0; k < batch.count; k++) {
      if (batch.pull_only && length[k] <= batch.rest_length[k]) continue;
      hk_sum_add(&sum, stored[k]);
    }
  }
  return hk_sum_value(&sum);
}

/* A spring that only pulls brakes no more than its tension lets it. */
static void find_heat_of_cables(const struct hk_spring_batch *batch, const double *q, const double *v,
                                double *heat) {
  for (int64_t k = 0; k < batch->count; k++) {
    const struct hk_spring spring = hk_batch_spring(batch, k);
    struct hk_stretch s;
    hk_spring_stretch(&spring, q, v, &s);
    heat[k] = (s.tension - s.elastic) * s.rate;
  }
}

static double heat(const hooke_system *system, double t, const double *q, const double *v) {
  struct hk_sum sum = {0.0, 0.0};
  double lost[HOOKE_SPRING_BATCH];
  struct hk_spring_batch batch;
  for (hk_begin_batches(t, &batch); hk_next_batch(system, &batch);) {
    if (!batch.damped) continue;
    const struct hk_some_springs springs = hk_batch_springs(&batch);
    if (batch.pull_only)
      find_heat_of_cables(&batch, q, v, lost);
    else
      hk_some_heats(&springs, q, v, lost);
    for (int64_t k = 0; k < batch.count; k++)
      hk_sum_add(&sum, lost[k]);
  }
  return hk_sum_value(&sum);
}

static void add_curved_product(const struct hk_run *run, const struct hk_derivative_rows *rows) {
  for (int64_t k = 0; k < run->count; k++) {
    const struct hk_spring spring = hk_run_spring(run, k);
    const int64_t i = 3 * spring.head, j = 3 * spring.tail;
    struct hk_spring_slope s;
    double dx[3], dv[3], change[3];
    if (!hk_spring_slope_find(&spring, rows->q, rows->v, &s)) continue;
    for (int a = 0; a < 3; a++) {
      dx[a] = rows->dq[i + a] - rows->dq[j + a];
      dv[a] = rows->dv[i + a] - rows->dv[j + a];
    }
    hk_spring_slope_change(&s, dx, dv, change);
    for (int a = 0; a < 3; a++) {
      rows->out[i + a] -= change[a];
      rows->out[j + a] += change[a];
    }
  }
}

static int32_t does_work(const hooke_system *system) {
  return system->springs->scaled;
}

/* The derivative of the energy S W(r, l0) of a spring by time, with S and l0 of the actuators: with the
 * strain law, W = l0 w(r/l0), dW/dl0 = (W - T r)/l0; with the length law -T. */
static double power_of(const struct hk_run *run, int64_t k, const double *q, struct hk_scaler *scaler) {
  const struct hk_spring spring = hk_run_spring_at(run, k, scaler), given = hk_run_spring(run, k);
  struct hk_spring unscaled = spring;
  struct hk_stretch s;
  hk_spring_stretch(&spring, q, NULL, &s);
  if (s.slack) return 0.0;
  unscaled.scale = run->scale;
  unscaled.kappa = spring.kappa / scaler->force;
  const struct hk_law law = hk_spring_law(&spring, s.length);
  const double w = scaler->force > 0.0 ? hk_spring_law(&unscaled, s.length).energy : 0.0;
  const double by_length =
      run->scaling->strain ? (law.energy - law.tension * s.length) / spring.rest_length : -law.tension;
  return scaler->force_rate * w + by_length * (given.rest_length * scaler->rate.rest_length);
}

static double power(const hooke_system *system, double t, const double *q, const double *v) {
  struct hk_sum sum = {0.0, 0.0};
  struct hk_scaler scaler = {.t = t};
  (void)v;
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const struct hk_run *run = &system->springs->run[r];
    for (int64_t k = 0; k < run->count && run->scaling; k++)
      hk_sum_add(&sum, power_of(run, k, q, &scaler));
  }
  return hk_sum_value(&sum);
}

static int32_t add_product(const hooke_system *system, const struct hk_point *point, double *out) {
  const struct hk_derivative_rows rows = {point->q, point->v, point->dq, point->dv, out};
  struct hk_run_walk walk;
  hk_begin_runs(system->springs, point->t, &walk);
  for (const struct hk_run *run; (run = hk_next_run(&walk)) != NULL;)
    (run->curve ? add_curved_product : hk_spring_set(0)->derivative)(run, &rows);
  return 0;
}

/* Adds a block and its mirror images where ends i and j meet. */
static void add_pair(const struct hk_pattern *pattern, int64_t i, int64_t j, const double block[9],
                     double *blocks) {
  if (blocks == NULL) return;
  double *ii = blocks + 9 * hk_pattern_block(pattern, i, i),
         *ij = blocks + 9 * hk_pattern_block(pattern, i, j);
  double *ji = blocks + 9 * hk_pattern_block(pattern, j, i),
         *jj = blocks + 9 * hk_pattern_block(pattern, j, j);
  for (int a = 0; a < 9; a++) {
    ii[a] -= block[a];
    ij[a] += block[a];
    ji[a] += block[a];
    jj[a] -= block[a];
  }
}

static void add_blocks(const hooke_system *system, double t, const double *q, const double *v,
                       const struct hk_pattern *pattern, double *dfdq, double *dfdv) {
  struct hk_scaler scaler = {.t = t};
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const struct hk_run *run = &system->springs->run[r];
    for (int64_t n = 0; n < run->count; n++) {
      const struct hk_spring spring = hk_run_spring_at(run, n, &scaler);
      struct hk_spring_slope s;
      double stiff[9], damp[9];
      if (!hk_spring_slope_find(&spring, q, v, &s)) continue;
      for (int k = 0; k < 9; k++) {
        const int a = k / 3, b = k % 3;
        const double one = a == b ? 1.0 : 0.0;
        stiff[k] = s.isotropic ? s.b * one : s.u[a] * s.c[b] + s.b * (one - s.u[a] * s.u[b]);
        damp[k] = s.isotropic ? 0.0 : s.gamma * s.u[a] * s.u[b];
      }
      add_pair(pattern, spring.head, spring.tail, stiff, dfdq);
      add_pair(pattern, spring.head, spring.tail, damp, dfdv);
    }
  }
}

/* ---- elements ---- */

void hk_spring_element(const struct hk_spring *spring, const double *q, const double *v,
                       struct hk_element *out) {
  struct hk_stretch s;
  out->count = 2;
  out->particle[0] = (int32_t)spring->head;
  out->particle[1] = (int32_t)spring->tail;
  if (q == NULL) return;
  hk_spring_stretch(spring, q, v, &s);
  if (v == NULL && spring->pull_only && s.length <= spring->rest_length) {
    s.tension = spring->kappa * (s.length - spring->rest_length);
    s.slope = spring->kappa;
  }
  const double stiff = v ? s.slope : fmax(0.0, s.slope);
  const int isotropic = s.length == 0.0, acts = !v || (isotropic ? spring->rest_length == 0.0 : !s.slack);
  out->weight[0] = 1.0;
  out->weight[1] = -1.0;
  memcpy(out->u, s.direction, sizeof out->u);
  out->k_along = acts ? stiff : 0.0;
  out->k_across = !acts ? 0.0 : isotropic ? stiff : s.tension / s.length;
  out->c_along = acts ? spring->gamma : 0.0;
  out->c_across = isotropic && !v ? spring->gamma : 0.0;
  out->over = 1.0;
  out->pull_only = spring->pull_only;
  out->elastic = s.elastic;
}

static void elements(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                     int64_t wanted, struct hk_element *out) {
  struct hk_scaler scaler = {.t = t};
  const struct hk_run *run = &system->springs->run[hk_springs_run(system->springs, first)];
  for (int64_t k = 0; k < wanted; k++) {
    while (first + k >= run->first + run->count)
      run++;
    const struct hk_spring spring = hk_run_spring_at(run, first + k - run->first, &scaler);
    hk_spring_element(&spring, q, v, &out[k]);
  }
}

/* For a tiled batch in the order of its tiles. */
static int64_t stored_elements(struct hk_elements *at) {
  if (!at->system->tiled->stored) return -1;
  struct hk_spring_batch batch;
  hk_begin_batches(at->t, &batch);
  batch.row = at->place[0];
  batch.done = at->place[1];
  batch.at = at->place[2];
  if (!hk_next_batch(at->system, &batch)) return 0;
  for (int64_t k = 0; k < batch.count; k++) {
    const struct hk_spring spring = hk_batch_spring(&batch, k);
    hk_spring_element(&spring, at->q, at->v, &at->element[k]);
  }
  at->place[0] = batch.row;
  at->place[1] = batch.done;
  at->place[2] = batch.at + batch.count;
  return batch.count;
}

/* The largest stiffness of a spring at any length. */
static double stiffest(const struct hk_spring *spring) {
  if (!spring->curve) return spring->kappa;
  return spring->scale * hk_curve_stiffest(spring->curve, spring->rest_length);
}

struct hk_curved hk_springs_curved(const struct hk_springs *springs, double t, const double *q) {
  struct hk_curved sum = {0};
  for (int64_t s = 0; s < springs->count && springs->curved > 0; s++) {
    const struct hk_spring spring = hk_springs_find(springs, s, t);
    struct hk_stretch at;
    hk_spring_stretch(&spring, q, NULL, &at);
    sum.unbounded += isinf(stiffest(&spring));
    sum.fall += spring.curve && (spring.curve->falls || at.slope < 0.0);
    sum.falling += at.slope < 0.0;
    sum.tension += fabs(hk_spring_law(&spring, spring.rest_length).tension);
  }
  return sum;
}

const struct hk_element *hk_element_at_most(const struct hk_elements *at, const struct hk_element *e,
                                            struct hk_element *widened) {
  const struct hk_springs *springs = at->system->springs;
  if (springs->curved == 0 || at->force != &hk_force_springs) return e;
  const struct hk_spring spring = hk_springs_find(springs, hk_element_number(at), at->t);
  const double most = stiffest(&spring);
  *widened = *e;
  widened->k_along = fmax(isinf(most) ? 0.0 : most, e->k_along);
  return widened;
}

static void add_stiffness(const hooke_system *system, double *sum) {
  struct hk_spring_batch batch;
  for (hk_begin_batches(HOOKE_STIFFEST, &batch); hk_next_batch(system, &batch);) {
    for (int64_t k = 0; k < batch.count && batch.curve; k++) {
      const struct hk_spring spring = hk_batch_spring(&batch, k);
      const double most = stiffest(&spring);
      batch.kappa[k] = isinf(most) ? fabs(batch.kappa[k]) : most;
    }
    for (int64_t k = 0; k < batch.count; k++)
      *sum += batch.kappa[k];
  }
}

/* ---- from groups ---- */

static void add_run(hooke_system *system, const struct hk_piece *piece) {
  struct hk_springs *springs = system->springs;
  struct hk_run *run = &springs->run[springs->run_count++];
  int32_t *const *particle = piece->group->particle;
  double *const *number = piece->group->number;
  const int64_t from = piece->from;
  int damped = 0;
  for (int64_t k = from; k < from + piece->count && !damped; k++)
    damped = number[HOOKE_GAMMA][k] != 0.0;
  run->first = springs->count;
  run->count = piece->count;
  run->shape = (piece->indexed ? HOOKE_RUN_INDEXED : 0) | (piece->mixed ? HOOKE_RUN_MIXED : 0) |
               (damped ? HOOKE_RUN_DAMPED : 0) | (piece->group->pull_only ? HOOKE_RUN_PULL_ONLY : 0);
  run->start = particle[0][from];
  run->offset = particle[1][from] - run->start;
  run->kappa = number[HOOKE_KAPPA][from];
  run->gamma = number[HOOKE_GAMMA][from];
  run->rest_length = number[HOOKE_REST_LENGTH][from];
  run->head = piece->particle[0];
  run->tail = piece->particle[1];
  run->kappas = piece->number[HOOKE_KAPPA];
  run->gammas = piece->number[HOOKE_GAMMA];
  run->rest_lengths = piece->number[HOOKE_REST_LENGTH];
  run->curve = piece->group->curve;
  run->scaling = piece->group->scaling;
  springs->scaled |= run->scaling != NULL;
  run->scale = 1.0;
  run->loop = run->curve ? add_curved : hk_spring_set(0)->loop[run->shape];
  run->undamped_loop =
      run->curve ? add_curved_undamped : hk_spring_set(0)->loop[run->shape & ~HOOKE_RUN_DAMPED];
  springs->count += piece->count;
  springs->curved += run->curve ? piece->count : 0;
}

static int32_t commit(hooke_system *system, const struct hk_group *group, int64_t count) {
  struct hk_springs *springs = system->springs;
  memset(springs, 0, sizeof *springs);
  return hk_runs_commit(system, &hk_force_springs, group, count, &springs->stored, (void **)&springs->run,
                        sizeof *springs->run, add_run);
}

static void release(hooke_system *system) {
  hk_free(system->springs->run);
  hk_stored_release(&system->springs->stored);
  memset(system->springs, 0, sizeof *system->springs);
}

static int64_t memory(const hooke_system *system) {
  const struct hk_springs *springs = system->springs;
  return springs->run_count * (int64_t)sizeof *springs->run +
         hk_stored_memory(&hk_force_springs, &springs->stored);
}

static void check(const hooke_system *system, uint32_t *value) {
  struct hk_spring_batch batch;
  hk_check_whole(value, system->springs->count);
  for (hk_begin_batches(HOOKE_AS_GIVEN, &batch); hk_next_batch(system, &batch);) {
    hk_check_add(value, batch.head, batch.count, sizeof *batch.head);
    hk_check_add(value, batch.tail, batch.count, sizeof *batch.tail);
    hk_check_add(value, batch.kappa, batch.count, sizeof(double));
    hk_check_add(value, batch.gamma, batch.count, sizeof(double));
    hk_check_add(value, batch.rest_length, batch.count, sizeof(double));
    hk_check_whole(value, batch.pull_only);
    if (batch.curve) hk_curve_check(batch.curve, value);
  }
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    const struct hk_run *run = &system->springs->run[r];
    if (run->scaling == NULL) continue;
    hk_check_whole(value, run->first);
    hk_check_whole(value, run->count);
    hk_scaling_check(run->scaling, value);
  }
}

static void recall(const hooke_system *system, int64_t first, struct hk_group *to) {
  for (int64_t k = 0; k < to->count; k++) {
    const struct hk_spring spring = hk_springs_find(system->springs, first + k, HOOKE_AS_GIVEN);
    to->particle[0][k] = (int32_t)spring.head;
    to->particle[1][k] = (int32_t)spring.tail;
    to->number[HOOKE_KAPPA][k] = spring.kappa;
    to->number[HOOKE_GAMMA][k] = spring.gamma;
    to->number[HOOKE_REST_LENGTH][k] = spring.rest_length;
  }
}

const struct hk_force_row hk_force_springs = {.name = "springs",
                                              .kind = HOOKE_LOOPED,
                                              .in_scenes = 1,
                                              .members = "springs",
                                              .options = &hk_spring_options,
                                              .member = "spring",
                                              .place = "between",
                                              .width = {1, 1, 1},
                                              .member_particles = 2,
                                              HOOKE_FORCE_OF_GROUPS,
                                              .bytes = 50.0,
                                              .add = add,
                                              .passed = passed,
                                              .energy = energy,
                                              .heat = heat,
                                              .does_work = does_work,
                                              .power = power,
                                              .add_product = add_product,
                                              .add_blocks = add_blocks,
                                              .elements = elements,
                                              .stored_elements = stored_elements,
                                              .add_stiffness = add_stiffness};

void hk_springs_largest(const struct hk_springs *springs, double t, const double *q, double *tension,
                        double *strength) {
  struct hk_scaler scaler = {.t = t};
  *tension = *strength = 0.0;
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t k = 0; k < springs->run[r].count; k++) {
      const struct hk_spring spring = hk_run_spring_at(&springs->run[r], k, &scaler);
      struct hk_stretch s;
      hk_spring_stretch(&spring, q, NULL, &s);
      *tension = fmax(*tension, fabs(s.tension));
      *strength = fmax(*strength, fabs(s.slope) * s.length);
    }
  }
}

int32_t hooke_system_compression(const hooke_system *system, double *compression) {
  const int32_t status = hk_system_require_committed(system);
  for (int64_t k = 0; status == HOOKE_OK && k < system->springs->count; k++)
    compression[k] = !hk_springs_find(system->springs, k, 0.0).pull_only;
  return status;
}

int32_t hooke_system_tension(const hooke_system *system, double t, const double *q, const double *v,
                             double *tension) {
  const int32_t status = hk_system_require_committed(system);
  for (int64_t k = 0; status == HOOKE_OK && k < system->springs->count; k++) {
    const struct hk_spring spring = hk_springs_find(system->springs, k, t);
    struct hk_stretch s;
    hk_spring_stretch(&spring, q, v, &s);
    tension[k] = s.tension;
  }
  return status;
}
