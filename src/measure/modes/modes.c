#include "measure/modes/modes.h"

#include "core/memory.h"
#include "core/status.h"
#include "core/table/option.h"
#include "measure/modes/lowest.h"
#include "measure/modes/stiffness.h"
#include "measure/spectrum/naming.h"
#include "model/group.h"
#include "model/state.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* ---- the state ---- */

/* The largest force on a particle that moves by itself; of a body the whole of it, or its torque over the
 * largest arm. */
static double residual_of(const struct hk_stiffness *s) {
  double most = 0.0;
  for (int64_t p = 0; p < s->system->particle_count; p++) {
    if (s->first[p] >= 0 && !hk_is_carried(s->system, p)) most = fmax(most, hk_length3(s->force + 3 * p));
  }
  for (int64_t k = 0; k < s->movers.count; k++) {
    const struct hk_body_tangent *t = &s->movers.body[k];
    double sum[3], moment[3], arm = 0.0;
    if (t->body == NULL) continue;
    hk_body_gather(s->system, t, NULL, (const double *const[3]){s->force, s->force + 1, s->force + 2}, 3, sum,
                   moment);
    for (int64_t i = 0; i < t->body->count; i++)
      arm = fmax(arm, hk_length3(t->arm + 3 * i));
    if (t->body->inverse_mass > 0.0) most = fmax(most, hk_length3(sum));
    for (int a = 0; a < 3; a++) { /* about its axes that turn */
      const double axis[3] = {t->axes[0][a], t->axes[1][a], t->axes[2][a]};
      if (t->body->inertia[a] > 0.0) most = fmax(most, fabs(hk_dot3(axis, moment)) / arm);
    }
  }
  return most;
}

/* Parts of the largest forces that are rounding, or nothing to speak of: of springs and weights, and of what
 * springs would bear at twice their length. */
static const double AT_REST = 1e-6, STRETCHED = 1e-12;

static void judge_rest(struct hk_modes *modes, const struct hk_stiffness *s, const double *q) {
  const hooke_system *system = modes->system;
  double weight = 0.0, strength;
  modes->residual = residual_of(s);
  hk_springs_largest(system->springs, system->moment, q, &modes->largest_force, &strength);
  for (int64_t p = 0; p < system->particle_count && system->has_gravity; p++)
    weight = fmax(weight, system->constrained[p] ? 0.0 : system->mass[p] * hk_length3(system->gravity));
  modes->at_rest = modes->residual <= AT_REST * fmax(weight, modes->largest_force) + STRETCHED * strength;
}

/* ---- parts of the stiffness ---- */

static int has_own_part(const hooke_system *system, const struct hk_force_row *row) {
  return row->elements && !row->members && !row->is_drag && hk_force_is_present(system, row);
}

static int32_t list_parts(struct hk_modes *modes) {
  const hooke_system *system = modes->system;
  modes->part = hk_new(system->group_count + HOOKE_FORCES + 1, sizeof *modes->part);
  if (modes->part == NULL) return HOOKE_NO_MEMORY;
  for (int64_t g = 0; g < system->group_count; g++) {
    const char *name = system->group[g].name;
    modes->part[modes->part_count++].name = name && name[0] ? name : system->group[g].force->name;
  }
  for (int32_t k = 0; k < HOOKE_FORCES; k++)
    if (has_own_part(system, hk_force_table(k)))
      modes->part[modes->part_count++].name = hk_force_table(k)->name;
  if (system->bodies->count > 0) modes->part[modes->part_count++].name = "turning of bodies";
  return HOOKE_OK;
}

/* Of a force without groups. */
static int64_t part_of(const hooke_system *system, const struct hk_force_row *force) {
  int64_t part = system->group_count;
  for (int32_t k = 0; hk_force_table(k) != force; k++)
    part += has_own_part(system, hk_force_table(k));
  return part;
}

/* x.Kx by parts, of all modes in one walk; the elements are those of the forces as they are. */
static void find_shares(struct hk_modes *modes, const struct hk_stiffness *s, const double *q) {
  struct hk_member_walk at;
  hk_begin_members(modes->system, modes->system->moment, q, s->still, &at);
  for (const struct hk_element *e; (e = hk_next_member(&at)) != NULL;) {
    const double along = e->k_along / e->over, across = e->k_across / e->over;
    if (at.group < 0 && !has_own_part(modes->system, at.elements.force)) continue;
    const int64_t part = at.group >= 0 ? at.group : part_of(modes->system, at.elements.force);
    for (int64_t k = 0; k < modes->count; k++) {
      const double *x = modes->mode[k].shape;
      modes->mode[k].share[part] +=
          hk_element_energy(e, along, across, 3, (const double *const[3]){x, x + 1, x + 2});
    }
  }
  for (int64_t k = 0; k < modes->count && modes->system->bodies->count > 0; k++)
    modes->mode[k].share[modes->part_count - 1] = hk_stiffness_of_turning(s, modes->mode[k].shape);
  for (int64_t k = 0; k < modes->count; k++) {
    double sum = 0.0;
    for (int64_t part = 0; part < modes->part_count; part++)
      sum += fabs(modes->mode[k].share[part]);
    for (int64_t part = 0; part < modes->part_count && sum > 0.0; part++)
      modes->mode[k].share[part] /= sum;
  }
}

/* ---- modes ---- */

/* x.Cx of a motion with x.Mx = 1. */
static int32_t damping_of(const struct hk_stiffness *s, const double *q, const double *v, const double *x,
                          double *out, double *damping) {
  const struct hk_point point = {.t = s->system->moment, .q = q, .v = v, .dq = s->still, .dv = x};
  const int32_t status = hk_forces_product(s->system, &point, HOOKE_CALLED, out);
  *damping = 0.0;
  for (int64_t k = 0; k < 3 * s->system->particle_count && status == HOOKE_OK; k++)
    *damping -= s->system->constrained[k / 3] ? 0.0 : x[k] * out[k];
  return status;
}

/* Of the root of all masses. */
static const double ROUNDING = 1e-12;

static void find_masses(const hooke_system *system, struct hk_mode *mode) {
  double along[3] = {0.0, 0.0, 0.0}, all = 0.0;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->constrained[p]) continue;
    hk_add3(system->mass[p], mode->shape + 3 * p, along);
    all += system->mass[p];
  }
  for (int a = 0; a < 3; a++)
    mode->mass[a] = system->overdamped                      ? NAN
                    : fabs(along[a]) < ROUNDING * sqrt(all) ? 0.0
                                                            : along[a] * along[a];
}

/* The largest displacement becomes 1 long, and its largest component positive. */
static void scale(int64_t n, double *shape) {
  double longest = 0.0, sign = 1.0;
  for (int64_t p = 0; p < n; p++) {
    const double length = hk_length3(shape + 3 * p);
    if (!(length > longest * (1.0 + 1e-9))) continue;
    longest = length;
    int most = 0;
    for (int a = 1; a < 3; a++)
      if (fabs(shape[3 * p + a]) > fabs(shape[3 * p + most]) * (1.0 + 1e-9)) most = a;
    sign = shape[3 * p + most] < 0.0 ? -1.0 : 1.0;
  }
  for (int64_t k = 0; k < 3 * n && longest > 0.0; k++)
    shape[k] *= sign / longest;
}

static void name_numbers(const hooke_system *system, double value, double damping, struct hk_mode *mode) {
  mode->omega = mode->frequency = mode->growth = mode->damping_ratio = NAN;
  if (system->overdamped) {
    mode->growth = -value;
  } else if (value < 0.0) {
    mode->growth = sqrt(-value);
  } else {
    mode->omega = sqrt(value);
    mode->frequency = mode->omega / 6.283185307179586;
    mode->damping_ratio = damping / (2.0 * mode->omega);
  }
}

static int32_t take_modes(struct hk_modes *modes, const struct hk_stiffness *s, const double *q,
                          const double *v, const struct hk_lowest *lowest) {
  const int64_t size = 3 * modes->system->particle_count, each = size + modes->part_count;
  modes->mode = hk_new(lowest->count, sizeof *modes->mode);
  double *block = modes->block = hk_new(lowest->count * each + 2 * size, sizeof(double)),
         *out = block ? block + lowest->count * each : NULL, damping;
  int32_t status = modes->mode && block ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < lowest->count && status == HOOKE_OK; k++) {
    struct hk_mode *mode = &modes->mode[k];
    mode->shape = hk_part(&block, size);
    mode->share = hk_part(&block, modes->part_count);
    hk_stiffness_spread(s, lowest->vector + k * s->count, mode->shape);
    status = damping_of(s, q, v, mode->shape, out, &damping);
    name_numbers(modes->system, lowest->value[k], damping, mode);
    find_masses(modes->system, mode);
    modes->unstable += mode->growth > 0.0;
    modes->count++;
  }
  if (status == HOOKE_OK) modes->position = memcpy(out + size, q, (size_t)size * sizeof(double));
  if (status == HOOKE_OK) find_shares(modes, s, q);
  for (int64_t k = 0; k < modes->count && status == HOOKE_OK; k++)
    scale(modes->system->particle_count, modes->mode[k].shape);
  return status;
}

static int32_t find(struct hk_modes *modes, const double *q, const double *v, int64_t count,
                    struct hk_budget *budget, struct hk_stiffness *s, struct hk_lowest *lowest) {
  int32_t status = hk_stiffness_create(modes->system, q, s);
  if (status != HOOKE_OK) return status;
  judge_rest(modes, s, q);
  modes->skew = s->skew;
  modes->unknowns = s->count;
  status = hk_lowest_find(&s->matrix, s->bound, count, budget, lowest);
  if (status != HOOKE_OK) return status;
  status = hk_stiffness_name_zeros(s, q, lowest->zero_count, lowest->zero, &modes->translations,
                                   &modes->rotations);
  modes->zeros_found = lowest->zero_count;
  modes->zero_modes = lowest->complete ? lowest->zero_count : -1;
  modes->mechanisms = lowest->zero_count - modes->translations - modes->rotations;
  if (status == HOOKE_OK) status = list_parts(modes);
  return status == HOOKE_OK ? take_modes(modes, s, q, v, lowest) : status;
}

int32_t hk_modes_find(const hooke_system *system, double t, const double *q, const double *v, int64_t count,
                      struct hk_budget *budget, struct hk_modes *modes) {
  struct hk_stiffness stiffness = {.count = 0};
  struct hk_lowest lowest = {.count = 0};
  *modes = (struct hk_modes){.at = hk_system_at(system, t), .time = t, .zero_modes = -1};
  modes->system = &modes->at;
  for (int64_t k = 0; k < 3 * system->particle_count; k++)
    modes->moves |= v[k] != 0.0;
  const int32_t status = find(modes, q, v, count, budget, &stiffness, &lowest);
  hk_stiffness_release(&stiffness);
  hk_lowest_release(&lowest);
  return status;
}

void hk_modes_release(struct hk_modes *modes) {
  hk_free(modes->mode);
  hk_free(modes->part);
  hk_free(modes->block);
  memset(modes, 0, sizeof *modes);
}

/* ---- the measurement ---- */

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("count", HOOKE_OPTION_WHOLE(1, 1e6), "6",
                 "modes, the lowest ones, beside those without stiffness"),
};
static const struct hk_option_table options = {"modes", HOOKE_OPTION_ROWS(rows)};

static int32_t create(hooke_measurement *m) {
  if (!HOOKE_HAVE_LAPACK)
    return hk_fail(HOOKE_NOT_BUILT, NULL, "modes need LAPACK, which this build is without");
  struct hk_modes *modes = m->object = hk_new(1, sizeof *modes);
  if (modes == NULL) return HOOKE_NO_MEMORY;
  *modes = (struct hk_modes){.time = NAN, .residual = NAN, .largest_force = NAN, .zero_modes = -1};
  modes->system = m->system;
  return HOOKE_OK;
}

static int32_t tell(double done, const char *what, void *m) {
  return hk_measurement_tell(m, done, what);
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_budget budget = hk_budget_of(INFINITY, tell, m);
  hk_modes_release(m->object);
  return hk_modes_find(m->system, *state->t, state->q, state->v,
                       (int64_t)hooke_options_number(m->options, "count"), &budget, m->object);
}

static void destroy(void *object) {
  if (object) hk_modes_release(object);
  hk_free(object);
}

const struct hk_measurement_kind hk_modes_kind = {.name = "modes",
                                                  .options = &options,
                                                  .takes_state = 1,
                                                  .tables = hk_modes_tables,
                                                  .claim = hk_modes_claim,
                                                  .create = create,
                                                  .run = run,
                                                  .destroy = destroy};
