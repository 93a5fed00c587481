#include "measure/why/growing.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/sum/spring_batch.h"

#include <math.h>
#include <string.h>

/* ---- products ---- */

/* A spring of a batch; one of no length is stiff in all directions, one that is compressed is not stiff
 * across. */
static void add_spring(const struct hk_spring_batch *batch, int64_t k, const double *q, double a, double b,
                       const double *x, double *out) {
  const int64_t i = 3 * (int64_t)batch->head[k], j = 3 * (int64_t)batch->tail[k];
  const double kappa = batch->kappa[k];
  const double d[3] = {q[i] - q[j], q[i + 1] - q[j + 1], q[i + 2] - q[j + 2]};
  const double e[3] = {x[i] - x[j], x[i + 1] - x[j + 1], x[i + 2] - x[j + 2]};
  const double r = sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]);
  const double over = r > 0.0 ? 1.0 / r : 0.0;
  const double tension = kappa * (r - batch->rest_length[k]);
  const double across = r > 0.0 ? (tension > 0.0 ? a * tension * over : 0.0) : a * kappa;
  const double along = ((d[0] * e[0] + d[1] * e[1]) + d[2] * e[2]) * over;
  const double axial = (a * kappa + b * batch->gamma[k] - across) * along * over;
  for (int c = 0; c < 3; c++) {
    const double f = axial * d[c] + across * e[c];
    out[i + c] += f;
    out[j + c] -= f;
  }
}

static void add_triple(const struct hk_triple *triple, double a, const double *x, double *out) {
  double d[3];
  hk_triple_bend(triple, x, d);
  for (int e = 0; e < 3; e++) {
    for (int k = 0; k < 3; k++)
      out[3 * triple->particle[e] + k] += a * triple->coefficient * hk_triple_factor(e) * d[k];
  }
}

static void add_tetrahedron(const struct hk_tetrahedron *t, const double *q, double a, double b,
                            const double *x, double *out) {
  struct hk_altitude_view view;
  if (!hk_altitude_see(t, q, &view)) return;
  const struct hk_altitude_tangent *g = &view.tangent;
  double along = 0.0;
  for (int j = 0; j < 4; j++) {
    for (int k = 0; k < 3; k++)
      along += g->weight[j] * g->u[k] * x[3 * g->particle[j] + k];
  }
  for (int j = 0; j < 4; j++) {
    for (int k = 0; k < 3; k++)
      out[3 * g->particle[j] + k] += (a * view.kappa + b * view.gamma) * along * g->weight[j] * g->u[k];
  }
}

/* out = (a K + b C) x, without what held particles feel; 0 if patience has an end. */
static int32_t multiply(struct hk_growing *g, const double *q, double a, double b) {
  const hooke_system *system = g->system;
  memset(g->out, 0, 3 * (size_t)system->particle_count * sizeof(double));
  struct hk_spring_batch batch;
  int64_t turns = 0;
  for (hk_begin_batches(&batch); hk_next_batch(system, &batch);) {
    if (++turns % HOOKE_BATCHES_PER_LOOK == 0 && hk_patience_ends(g->patience, "the motion that grows"))
      return 0;
    for (int64_t k = 0; k < batch.count; k++)
      add_spring(&batch, k, q, a, b, g->x, g->out);
  }
  struct hk_triple triple;
  for (struct hk_triples at = {&system->bending, 0, 0}; a > 0.0 && hk_next_triple(&at, &triple);)
    add_triple(&triple, a, g->x, g->out);
  for (int64_t k = 0; k < system->altitudes.count; k++)
    add_tetrahedron(&system->altitudes.tetrahedron[k], q, a, b, g->x, g->out);
  const double brake = b * system->drag;
  for (int64_t p = 0; p < system->particle_count; p++) {
    for (int64_t k = 3 * p; k < 3 * p + 3; k++)
      g->out[k] = system->held[p] ? 0.0 : g->out[k] + brake * g->x[k];
  }
  return 1;
}

/* ---- the direction ---- */

static double length_of(const struct hk_growing *g, const double *x) {
  double sum = 0.0;
  for (int64_t p = 0; p < g->system->particle_count; p++) {
    const double *a = x + 3 * p;
    if (!g->system->held[p]) sum += g->system->mass[p] * ((a[0] * a[0] + a[1] * a[1]) + a[2] * a[2]);
  }
  return sqrt(sum);
}

/* x = from / `length`, nothing where particles are held. */
static void take(struct hk_growing *g, const double *from, double length) {
  for (int64_t p = 0; p < g->system->particle_count; p++) {
    for (int64_t k = 3 * p; k < 3 * p + 3; k++)
      g->x[k] = g->system->held[p] ? 0.0 : from[k] / length;
  }
}

double hk_growing_bytes(const hooke_system *system) {
  return 6.0 * (double)system->particle_count * sizeof(double);
}

int32_t hk_growing_create(const hooke_system *system, const double *v, struct hk_patience *patience,
                          struct hk_growing *g) {
  const int64_t size = 3 * system->particle_count;
  *g = (struct hk_growing){.system = system, .patience = patience};
  g->x = hk_new(size, sizeof(double));
  g->out = hk_new(size, sizeof(double));
  if (g->x == NULL || g->out == NULL) {
    hk_growing_release(g);
    return HOOKE_NO_MEMORY;
  }
  double length = length_of(g, v);
  if (!(length > 0.0) || !isfinite(length)) {
    /* neighbours against each other, in all directions */
    for (int64_t k = 0; k < size; k++)
      g->out[k] = ((k / 3 + k % 3) % 2 ? 1.0 : -1.0) + 0.1 * (double)(k % 7);
    length = length_of(g, g->out);
    v = g->out;
  }
  if (length > 0.0) take(g, v, length);
  return HOOKE_OK;
}

void hk_growing_release(struct hk_growing *g) {
  hk_free(g->x);
  hk_free(g->out);
  g->x = g->out = NULL;
}

double hk_growing_quotient(struct hk_growing *g, const double *q, double a, double b) {
  double energy = 0.0, square = 0.0;
  if (!multiply(g, q, a, b)) return 0.0;
  for (int64_t p = 0; p < g->system->particle_count; p++) {
    const double *x = g->x + 3 * p, *out = g->out + 3 * p;
    energy += (x[0] * out[0] + x[1] * out[1]) + x[2] * out[2];
    square += g->system->mass[p] * ((x[0] * x[0] + x[1] * x[1]) + x[2] * x[2]);
  }
  return square > 0.0 ? energy / square : 0.0;
}

double hk_growing_turn(struct hk_growing *g, const double *q, double a, double b, double most, double rise,
                       int64_t turns) {
  double quotient = hk_growing_quotient(g, q, a, b), before = 0.0;
  for (int64_t k = 0; k < turns && !(quotient > most) && quotient > (1.0 + rise) * before; k++) {
    if (hk_patience_ends(g->patience, "the motion that grows")) break;
    before = quotient;
    for (int64_t p = 0; p < g->system->particle_count; p++) {
      for (int64_t i = 3 * p; i < 3 * p + 3; i++)
        g->out[i] *= g->system->inverse_mass[p];
    }
    const double length = length_of(g, g->out);
    if (!(length > 0.0) || !isfinite(length)) break;
    take(g, g->out, length);
    quotient = fmax(quotient, hk_growing_quotient(g, q, a, b));
  }
  return quotient;
}

/* ---- steps ---- */

static int is_damped(const hooke_system *system) {
  return system->drag > 0.0 || system->altitudes.damped || hk_springs_are_damped(&system->springs);
}

int32_t hk_growing_rule(const hooke_system *system, const char *method, double h, double *a, double *b,
                        double *most) {
  const int symplectic = strcmp(method, "symplectic-euler") == 0;
  *a = h * h;
  *b = symplectic ? 2.0 * h : 0.0;
  *most = 4.0;
  if (symplectic || strcmp(method, "verlet") == 0) return 1;
  /* on the imaginary axis up to the root of 8; with damping it is no matter of a quotient */
  *most = 8.0;
  return strcmp(method, "rk4") == 0 && !is_damped(system);
}
