#include "measure/spectrum/linearised.h"

#include "core/memory.h"
#include "core/status.h"
#include "kernel/vector_loops.h"
#include "measure/counted_work/work.h"
#include "model/sum/spring_batch.h"
#include "model/sum/tiled.h"

#include <math.h>
#include <string.h>

/* ---- springs ---- */

static void see_spring(struct hk_linearised *lin, int64_t k, const struct hk_spring *spring, const double *q,
                       double scale) {
  struct hk_spring taut = *spring; /* one that only pulls may become so at any time */
  struct hk_stretch s;
  taut.pull_only = 0;
  hk_spring_stretch(&taut, q, NULL, &s);
  const double slight = HOOKE_STRETCH_ROUNDING * spring->kappa * s.length;
  for (int a = 0; a < 3; a++)
    lin->u[a][k] = s.direction[a];
  lin->kappa[k] = scale * spring->kappa;
  lin->gamma[k] = scale * spring->gamma;
  lin->across[k] = 0.0;
  if (s.length == 0.0) /* stiff and damped in all directions */
    lin->across[k] = scale * spring->kappa, lin->points_damped |= spring->gamma > 0.0;
  else if (s.tension > slight)
    lin->across[k] = scale * (s.tension / s.length);
  else if (s.tension < -slight)
    lin->clamped++;
}

/* Between constrained ends it has no effect. */
static int32_t moves(const hooke_system *system, const struct hk_spring *spring) {
  return !system->constrained[spring->head] || !system->constrained[spring->tail];
}

static void keep_element(struct hk_linearised *lin, const struct hk_element *e) {
  struct hk_element *kept = &lin->element[lin->element_count];
  if (e->k_along == 0.0 && !(e->k_across > 0.0) && e->c_along == 0.0 && e->c_across == 0.0) return;
  *kept = *e;
  kept->k_across = hk_element_across(e);
  lin->across_any |= kept->k_across > 0.0;
  lin->clamped += e->k_across < -HOOKE_STRETCH_ROUNDING * e->k_along;
  lin->element_count++;
}

/* Tension over length may be above the slope of a curve, and below that of a straight line alone. */
static void see_curved(struct hk_linearised *lin, const struct hk_spring *spring, const double *q,
                       double scale) {
  struct hk_element e = {.count = 0};
  hk_spring_element(spring, q, NULL, &e);
  e.k_along *= scale;
  e.k_across *= scale;
  e.c_along *= scale;
  e.c_across *= scale;
  keep_element(lin, &e);
}

static void see_runs(struct hk_linearised *lin, const double *q, const double *spring_scale) {
  struct hk_scaler scaler = {.t = lin->system->moment};
  for (int64_t r = 0; r < lin->run_count; r++) {
    const struct hk_run *run = &lin->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring_at(run, k, &scaler);
      const double scale = spring_scale ? spring_scale[run->first + k] : 1.0;
      if (!moves(lin->system, &spring)) continue;
      if (spring.curve)
        see_curved(lin, &spring, q, scale);
      else
        see_spring(lin, run->first + k, &spring, q, scale);
    }
  }
}

static void see_batches(struct hk_linearised *lin, const double *q) {
  int32_t *head = lin->ends, *tail = lin->ends + lin->own.count;
  int64_t slot = 0;
  struct hk_spring_batch batch;
  for (hk_begin_batches(lin->system->moment, &batch); hk_next_batch(lin->system, &batch);) {
    for (int64_t k = 0; k < batch.count; k++, slot++) {
      const struct hk_spring spring = hk_batch_spring(&batch, k);
      head[slot] = batch.head[k];
      tail[slot] = batch.tail[k];
      if (moves(lin->system, &spring)) see_spring(lin, slot, &spring, q, 1.0);
    }
  }
}

/* Unordered springs are many times faster in the order of their batches. */
static int32_t see_springs(struct hk_linearised *lin, const double *q, const double *spring_scale) {
  const struct hk_springs *springs = lin->system->springs;
  if (spring_scale || !lin->system->tiled->stored) {
    lin->run = springs->run;
    lin->run_count = springs->run_count;
    see_runs(lin, q, spring_scale);
    return HOOKE_OK;
  }
  lin->ends = hk_new(2 * springs->count, sizeof *lin->ends);
  if (lin->ends == NULL) return HOOKE_NO_MEMORY;
  lin->own = (struct hk_run){.count = springs->count,
                             .shape = HOOKE_RUN_INDEXED,
                             .head = lin->ends,
                             .tail = lin->ends + springs->count};
  lin->run = &lin->own;
  lin->run_count = 1;
  see_batches(lin, q);
  return HOOKE_OK;
}

/* ---- other forces ---- */

static int64_t most_elements(const hooke_system *system) {
  return hk_elements_of(system, HOOKE_KEPT) + system->springs->curved;
}

static int32_t new_elements(struct hk_linearised *lin) {
  const int64_t most = most_elements(lin->system);
  lin->element = hk_new(most, sizeof *lin->element);
  lin->along = hk_new(2 * most, sizeof(double));
  lin->beside = lin->along + most;
  return lin->element && lin->along ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void see_others(struct hk_linearised *lin, const double *q, const double *v) {
  struct hk_elements at;
  hk_begin_elements(lin->system, lin->system->moment, q, NULL, &at);
  at.kinds = HOOKE_OTHERS;
  at.flow = v;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    if (!hk_element_moves(lin->system->constrained, e)) continue;
    if (at.force->kind & HOOKE_CONSTANT)
      lin->bends = 1;
    else
      keep_element(lin, e);
  }
}

/* ---- units ---- */

static void add_row(const struct hk_linearised *lin, const struct hk_element *e, int damping, double *sum) {
  const double most = damping ? fmax(e->c_along, e->c_across) : fmax(e->k_along, e->k_across);
  for (int j = 0; j < e->count; j++)
    sum[e->particle[j]] += hk_element_row(lin->system->constrained, e, j) * most;
}

/* Adds the rows of the other elements at q, of their stiffness or of their damping. */
static void add_rows(const struct hk_linearised *lin, const double *q, int damping, double *sum) {
  struct hk_elements at;
  hk_begin_elements(lin->system, lin->system->moment, q, NULL, &at);
  at.kinds = HOOKE_CONSTANT;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;)
    add_row(lin, e, damping, sum);
  for (int64_t k = 0; k < lin->element_count; k++)
    add_row(lin, &lin->element[k], damping, sum);
}

/* The sum of the rows of a mover over the mass and inertia that resist it. */
static double row_of_mover(const hooke_system *system, const struct hk_body_tangent *t, const double *sum,
                           double drag) {
  double row = 0.0;
  int64_t count;
  const int32_t *particle = t->mover->row->particles(t->mover->thing, &count);
  for (int64_t i = 0; i < count; i++) {
    const int64_t p = particle[i];
    if (!system->constrained[p]) row += (sum[p] + drag) * t->mover->row->reach(t, i);
  }
  return row;
}

/* The largest row sum of 2 sum |B| over m, a bound on all eigenvalues. */
static double largest_row(const struct hk_linearised *lin, const double *q, int damping, double *sum) {
  const hooke_system *system = lin->system;
  const double *weight = damping ? lin->gamma : lin->kappa, drag = damping ? lin->drag : 0.0;
  double most = 0.0;
  memset(sum, 0, (size_t)system->particle_count * sizeof(double));
  for (int64_t r = 0; r < lin->run_count; r++) {
    const struct hk_run *run = &lin->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const int32_t indexed = run->shape & HOOKE_RUN_INDEXED;
      const int64_t i = indexed ? run->head[k] : run->start + k, j = indexed ? run->tail[k] : i + run->offset;
      sum[i] += 2.0 * weight[run->first + k];
      sum[j] += 2.0 * weight[run->first + k];
    }
  }
  add_rows(lin, q, damping, sum);
  for (int64_t p = 0; p < system->particle_count; p++)
    if (!hk_is_carried(system, p)) most = fmax(most, (sum[p] + drag) * lin->inverse[p]);
  for (int64_t k = 0; k < lin->rigid.tangents.count; k++)
    most = fmax(most, row_of_mover(system, &lin->rigid.tangents.body[k], sum, drag));
  return most;
}

static int32_t choose_rate(struct hk_linearised *lin, const double *q, double *sum) {
  const double stiffest = largest_row(lin, q, 0, sum) + lin->rigid.stiffest,
               quickest = largest_row(lin, q, 1, sum);
  lin->damped = quickest > 0.0;
  lin->slow_step = 1.0 / fmax(lin->system->overdamped ? stiffest : sqrt(stiffest), quickest);
  lin->rate = stiffest > 0.0 ? sqrt(stiffest) : quickest > 0.0 ? quickest : 1.0;
  const double k = 1.0 / lin->rate / lin->rate, c = 1.0 / lin->rate;
  if (!(stiffest < INFINITY) || !(quickest < INFINITY) || !(quickest * c < 1e150) || !(k < INFINITY)) {
    return hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "stiffness over mass is up to %g 1/s^2, damping over mass up to %g 1/s; limits can be found up to "
        "1e308, and where the second is below 1e150 times the root of the first",
        stiffest, quickest);
  }
  for (int64_t s = 0; s < lin->system->springs->count; s++) {
    lin->kappa[s] *= k;
    lin->across[s] *= k;
    lin->gamma[s] *= c;
    lin->across_any |= lin->across[s] > 0.0;
  }
  for (struct hk_element *e = lin->element; e < lin->element + lin->element_count; e++) {
    e->k_along *= k;
    e->k_across *= k;
    e->c_along *= c;
    e->c_across *= c;
  }
  lin->drag *= c;
  lin->spin *= c;
  lin->unit_k = k;
  lin->unit_c = c;
  return HOOKE_OK;
}

/* ---- creating ---- */

double hk_linearised_bytes(const hooke_system *system) {
  enum {
    OF_SPRINGS = 11,
    OF_PARTICLES = 3 + 3 * 20,
    OF_PARTICLES_WITH_BODIES = OF_PARTICLES + 18,
    OF_ELEMENTS = 2 + sizeof(struct hk_element) / sizeof(double)
  };
  const int of_particles = system->mover_count > 0 ? OF_PARTICLES_WITH_BODIES : OF_PARTICLES;
  return sizeof(double) *
         (OF_SPRINGS * (double)system->springs->count + of_particles * (double)system->particle_count +
          OF_ELEMENTS * (double)most_elements(system));
}

/* Squares of distances within it are finite [m]. */
static const double FARTHEST = 1e153;

/* Three of every free particle that moves by itself. */
static int is_alone(const hooke_system *system, int64_t particle) {
  return !system->constrained[particle] && !hk_is_carried(system, particle);
}

static int32_t check_places(int64_t n, const double *q) {
  for (int64_t k = 0; k < 3 * n; k++) {
    if (fabs(q[k]) <= FARTHEST) continue;
    if (!isfinite(q[k]))
      return hk_fail(HOOKE_BAD_VALUE, "state", "particle %lld is at a place that is not finite",
                     (long long)(k / 3));
    return hk_fail(
        HOOKE_BAD_VALUE, "state",
        "particle %lld is at %g m, where squares of distances may leave the range of numbers; limits "
        "can be found up to %g m from the origin",
        (long long)(k / 3), q[k], FARTHEST);
  }
  return HOOKE_OK;
}

int32_t hk_linearised_create(const hooke_system *system, const double *q, const double *v,
                             const double *spring_scale, const double *mass_scale,
                             struct hk_linearised *lin) {
  const int64_t n = system->particle_count, m = system->springs->count;
  *lin = (struct hk_linearised){.system = system, .size = 3 * n, .drag = system->brake};
  int32_t status = check_places(n, q);
  if (status != HOOKE_OK) return status;
  double *block = hk_new(10 * m + 3 * n, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  lin->mass = hk_part(&block, n);
  lin->inverse = hk_part(&block, n);
  double *sum = hk_part(&block, n);
  for (int a = 0; a < 3; a++) {
    lin->u[a] = hk_part(&block, m);
    lin->g[a] = hk_part(&block, m);
  }
  lin->kappa = hk_part(&block, m);
  lin->across = hk_part(&block, m);
  lin->gamma = hk_part(&block, m);
  lin->g_across = hk_part(&block, m);
  for (int64_t p = 0; p < n; p++) {
    lin->mass[p] = system->inertia[p] * (mass_scale ? mass_scale[p] : 1.0);
    lin->inverse[p] = system->constrained[p] ? 0.0 : 1.0 / lin->mass[p];
    lin->unknowns += is_alone(system, p) ? 3 : 0;
  }
  status = new_elements(lin);
  if (status == HOOKE_OK) status = see_springs(lin, q, spring_scale);
  if (status == HOOKE_OK) see_others(lin, q, v);
  if (status == HOOKE_OK) status = hk_rigid_create(system, q, spring_scale, &lin->rigid);
  lin->unknowns += hk_rigid_unknowns(&lin->rigid); /* none, as long as it is not made */
  if (v) lin->spin = hk_rigid_spin(&lin->rigid, v);
  if (status == HOOKE_OK) status = choose_rate(lin, q, sum);
  if (status != HOOKE_OK) hk_linearised_release(lin);
  return status;
}

void hk_linearised_release(struct hk_linearised *lin) {
  hk_rigid_release(&lin->rigid);
  hk_free(lin->mass);
  hk_free(lin->ends);
  hk_free(lin->element);
  hk_free(lin->along);
  memset(lin, 0, sizeof *lin);
}

/* ---- products ---- */

/* A spring without a direction is damped as it is stiff, in all directions. */
static double beside(const struct hk_linearised *lin, int64_t s, double a, double b) {
  const int points = lin->u[0][s] != 0.0 || lin->u[1][s] != 0.0 || lin->u[2][s] != 0.0;
  return a * lin->across[s] + (points ? 0.0 : b * lin->gamma[s]);
}

/* A spring is g g^T + b I with g = sqrt(along - across) u: tension over length is below kappa, so nothing is
 * negative. */
void hk_linearised_combine(struct hk_linearised *lin, double a, double b) {
  const int64_t m = lin->system->springs->count;
  for (int64_t s = 0; s < m; s++) {
    const double along = a * (lin->kappa[s] - lin->across[s]) + b * lin->gamma[s];
    const double size = sqrt(fmax(0.0, along));
    for (int k = 0; k < 3; k++)
      lin->g[k][s] = size * lin->u[k][s];
  }
  const int32_t across = (lin->across_any && a > 0.0) || (lin->points_damped && b > 0.0);
  for (int64_t s = 0; s < m && across; s++)
    lin->g_across[s] = beside(lin, s, a, b);
  for (int64_t t = 0; t < lin->element_count; t++) {
    const struct hk_element *e = &lin->element[t];
    lin->along[t] = a * e->k_along + b * e->c_along;
    lin->beside[t] = a * e->k_across + b * e->c_across;
  }
  lin->brake = b * lin->drag;
  lin->constant_k = a * lin->unit_k;
  lin->constant_c = b * lin->unit_c;
  lin->tangent = (struct hk_tangent){.u = {lin->g[0], lin->g[1], lin->g[2]},
                                     .e = {lin->g[0], lin->g[1], lin->g[2]},
                                     .b = across ? lin->g_across : NULL};
}

void hk_linearised_add_product(struct hk_linearised *lin, const double *x, double *out) {
  const int64_t n = lin->system->particle_count;
  const double *const from[3] = {x, x + n, x + 2 * n};
  double *const to[3] = {out, out + n, out + 2 * n};
  lin->products++;
  if (lin->budget) hk_budget_spend(lin->budget, hk_work_of_product(lin->system));
  for (int64_t k = 0; k < lin->run_count; k++)
    hk_tangent_product(&lin->run[k], &lin->tangent, from, to);
  for (int32_t k = 0; k < lin->system->force_row_count; k++) {
    const struct hk_force_row *force = lin->system->force_row[k];
    if (force->kind & HOOKE_CONSTANT)
      force->multiply(lin->system, lin->constant_k, lin->constant_c, from, to);
  }
  for (int64_t t = 0; t < lin->element_count; t++)
    hk_element_multiply(&lin->element[t], lin->along[t], lin->beside[t], 1, from, to);
  if (lin->brake > 0.0) hk_add_multiple(lin->size, lin->brake, x, out);
  hk_rigid_reduce(&lin->rigid, lin->constant_k, from, to, 1);
}

void hk_linearised_multiply(struct hk_linearised *lin, const double *x, double *out) {
  memset(out, 0, (size_t)lin->size * sizeof(double));
  hk_linearised_add_product(lin, x, out);
  const int64_t n = lin->system->particle_count;
  for (int a = 0; a < 3; a++) {
    for (int64_t p = 0; p < n; p++)
      out[a * n + p] *= lin->inverse[p];
  }
}

static double others_energy(const struct hk_linearised *lin, const double *x) {
  const int64_t n = lin->system->particle_count;
  const double *const from[3] = {x, x + n, x + 2 * n}, a = lin->constant_k, b = lin->constant_c;
  double sum = a > 0.0 ? a * hk_rigid_energy(&lin->rigid, from, 1) : 0.0;
  struct hk_elements at;
  hk_begin_elements(lin->system, lin->system->moment, lin->system->position, NULL, &at);
  at.kinds = HOOKE_CONSTANT;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;)
    sum += hk_element_energy(e, a * e->k_along + b * e->c_along, a * e->k_across + b * e->c_across, 1, from);
  for (int64_t t = 0; t < lin->element_count; t++)
    sum += hk_element_energy(&lin->element[t], lin->along[t], lin->beside[t], 1, from);
  return sum;
}

/* Squares, spring by spring: no stretch gives exactly 0, not the rounding of a difference. */
double hk_linearised_energy(const struct hk_linearised *lin, const double *x) {
  const int64_t n = lin->system->particle_count;
  double sum = others_energy(lin, x);
  for (int64_t r = 0; r < lin->run_count; r++) {
    const struct hk_run *run = &lin->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const int64_t i = hk_run_head(run, k), j = hk_run_tail(run, k), s = run->first + k;
      const double d[3] = {x[i] - x[j], x[n + i] - x[n + j], x[2 * n + i] - x[2 * n + j]};
      const double along = lin->g[0][s] * d[0] + lin->g[1][s] * d[1] + lin->g[2][s] * d[2];
      sum += along * along;
      if (lin->tangent.b) sum += lin->tangent.b[s] * (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    }
  }
  return lin->brake > 0.0 ? sum + lin->brake * hk_dot(lin->size, x, x) : sum;
}

/* ---- vectors ---- */

double hk_linearised_dot(const struct hk_linearised *lin, const double *x, const double *y) {
  return hk_dot_weighed(lin->system->particle_count, lin->mass, x, y);
}

void hk_linearised_start(const struct hk_linearised *lin, double *x) {
  uint64_t seed = 0x9e3779b97f4a7c15u;
  const int64_t n = lin->system->particle_count;
  for (int64_t k = 0; k < lin->size; k++) {
    /* xorshift64* (Vigna 2016) */
    seed ^= seed >> 12;
    seed ^= seed << 25;
    seed ^= seed >> 27;
    const double number = (double)((seed * 0x2545f4914f6cdd1du) >> 11) / 4503599627370496.0 - 1.0;
    x[k] = lin->system->constrained[k % n] ? 0.0 : number * sqrt(lin->inverse[k % n]);
  }
  hk_linearised_project(lin, x);
}

void hk_linearised_project(const struct hk_linearised *lin, double *x) {
  const int64_t n = lin->system->particle_count;
  hk_rigid_project(&lin->rigid, (double *const[3]){x, x + n, x + 2 * n}, 1);
}

void hk_linearised_pack(const struct hk_linearised *lin, const double *x, double *unknown) {
  const int64_t n = lin->system->particle_count;
  for (int64_t p = 0; p < n; p++) {
    for (int64_t a = 0; a < 3 && is_alone(lin->system, p); a++)
      *unknown++ = x[a * n + p] * sqrt(lin->mass[p]);
  }
  hk_rigid_pack(&lin->rigid, (const double *const[3]){x, x + n, x + 2 * n}, 1, unknown);
}

void hk_linearised_unpack(const struct hk_linearised *lin, const double *unknown, double *x) {
  const int64_t n = lin->system->particle_count;
  for (int64_t p = 0; p < n; p++) {
    const int alone = is_alone(lin->system, p);
    for (int64_t a = 0; a < 3; a++)
      x[a * n + p] = alone ? *unknown++ * sqrt(lin->inverse[p]) : 0.0;
  }
  hk_rigid_unpack(&lin->rigid, unknown, (double *const[3]){x, x + n, x + 2 * n}, 1);
}

int32_t hk_linearised_assemble(struct hk_linearised *lin, double *matrix) {
  const int64_t n = lin->unknowns;
  double *work = hk_new(2 * lin->size + n, sizeof(double));
  if (work == NULL) return HOOKE_NO_MEMORY;
  double *x = work, *out = x + lin->size, *one = out + lin->size;
  for (int64_t k = 0; k < n; k++) {
    one[k] = 1.0;
    hk_linearised_unpack(lin, one, x);
    hk_linearised_multiply(lin, x, out);
    hk_linearised_pack(lin, out, matrix + k * n);
    one[k] = 0.0;
  }
  /* to the bit */
  for (int64_t i = 0; i < n; i++) {
    for (int64_t j = 0; j < i; j++)
      matrix[i * n + j] = matrix[j * n + i] = 0.5 * (matrix[i * n + j] + matrix[j * n + i]);
  }
  hk_free(work);
  return HOOKE_OK;
}
