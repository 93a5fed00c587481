/* Limits of random scenes of all kinds of forces, anchors at their own places and coinciding particles among
 * them, against amplification matrices of the test's own: K and C are assembled by their formulas, a step of
 * a method is applied to every unit vector, and powers of the matrix grow or not. HOOKE_LONG=1 takes more
 * scenes (tests/long/soak.py). */
#include "check.h"
#include "random.h"
#include "run.h"
#include "sanitized.h"
#include "small.h"

#include <gsl/gsl_blas.h>
#include <gsl/gsl_linalg.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { N = 5, DOF = 3 * N, SPRINGS = 7, ANCHORS = 2, TRIPLES = 2, MOST = 2 * DOF };
static const double WITHIN = 0.01;

/* Full matrices; `held` particles are left out of the steps. */
struct scene {
  hooke_system *system;
  double q[DOF], mass[N], k[DOF][DOF], c[DOF][DOF], drag;
  int held[N], overdamped;
};

/* ---- K and C ---- */

/* matrix += (g g^T) (x) (along u u^T + across (I - u u^T)) */
static void add(double matrix[DOF][DOF], int count, const int64_t *p, const double *g, const double u[3],
                double along, double across) {
  for (int i = 0; i < 3 * count; i++) {
    for (int j = 0; j < 3 * count; j++) {
      const int a = i % 3, b = j % 3;
      matrix[3 * p[i / 3] + a][3 * p[j / 3] + b] +=
          g[i / 3] * g[j / 3] * ((along - across) * u[a] * u[b] + (a == b ? across : 0.0));
    }
  }
}

/* A spring from p[0] to p[1], or an anchor of p[0], along d: without a direction it is isotropic. */
static void add_spring(struct scene *s, int count, const int64_t *p, const double d[3], double kappa,
                       double gamma, double rest) {
  static const double g[2] = {1.0, -1.0};
  const double r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]), over = r > 0.0 ? r : 1.0;
  const double u[3] = {d[0] / over, d[1] / over, d[2] / over};
  const double pull = r > 0.0 ? kappa * (r - rest) / r : kappa;
  add(s->k, count, p, g, u, kappa, pull > 1e-9 * kappa ? pull : 0.0);
  add(s->c, count, p, g, u, gamma, r > 0.0 ? 0.0 : gamma);
}

/* ---- drawing ---- */

static double between(struct random_source *source, double low, double high) {
  return random_between(source, low, high);
}

/* Damping from none to far above critical; a third of all is none. */
static double some_damping(struct random_source *source) {
  const double scale[] = {0.0, 0.0, 0.3, 3.0, 30.0, 300.0};
  return scale[random_whole(source, 0, 5)] * between(source, 0.5, 2.0);
}

static void draw_particles(struct random_source *source, struct scene *s) {
  for (int k = 0; k < DOF; k++)
    s->q[k] = between(source, -1.0, 1.0);
  if (random_whole(source, 0, 1)) memcpy(s->q + 3 * 4, s->q + 3 * 3, 3 * sizeof(double));
  for (int p = 0; p < N; p++)
    s->mass[p] = between(source, 0.3, 3.0) * (p == 2 ? between(source, 0.01, 1.0) : 1.0);
  check_ok(hooke_system_create(&s->system));
  check_ok(hooke_system_add_particles(s->system, N, s->q, NULL, N, s->mass, NULL));
  const int64_t pinned = 0, driven = 1;
  const double amplitude[3] = {0.1, 0.0, 0.0};
  s->held[0] = (int)random_whole(source, 0, 1);
  s->held[1] = random_whole(source, 0, 3) == 0;
  if (s->held[0]) check_ok(hooke_system_pin(s->system, 1, &pinned));
  if (s->held[1]) check_ok(hooke_system_drive_harmonic(s->system, 1, &driven, amplitude, 1.0, 0.0));
}

static void draw_springs(struct random_source *source, struct scene *s) {
  int64_t ends[2 * SPRINGS];
  double kappa[SPRINGS], gamma[SPRINGS], rest[SPRINGS];
  const double damping = some_damping(source), scale = between(source, 0.7, 1.2);
  for (int k = 0; k < SPRINGS; k++) {
    int64_t *pair = ends + 2 * k;
    pair[0] = k == 0 ? 3 : random_whole(source, 0, N - 1);
    pair[1] = k == 0 ? 4 : (pair[0] + random_whole(source, 1, N - 1)) % N;
    const double *a = s->q + 3 * pair[0], *b = s->q + 3 * pair[1];
    const double d[3] = {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
    kappa[k] = between(source, 5.0, 50.0) * (random_whole(source, 0, 9) ? 1.0 : 100.0);
    gamma[k] = s->overdamped || !random_whole(source, 0, 4) ? 0.0 : damping * between(source, 0.2, 1.0);
    rest[k] = scale * sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    if (rest[k] == 0.0) rest[k] = random_whole(source, 0, 1) ? 0.3 : 0.0;
    add_spring(s, 2, pair, d, kappa[k], gamma[k], rest[k]);
  }
  owned_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", SPRINGS, kappa));
  check_ok(hooke_options_set_numbers(options, "damping", SPRINGS, gamma));
  check_ok(hooke_options_set_numbers(options, "rest_length", SPRINGS, rest));
  if (random_whole(source, 0, 2) == 0) check_ok(hooke_options_set_number(options, "compression", 0.0));
  check_ok(hooke_system_add_springs(s->system, "springs", SPRINGS, ends, options));
}

/* At their own places by default, or tied to points elsewhere. */
static void draw_anchors(struct random_source *source, struct scene *s) {
  int64_t tied[ANCHORS];
  double point[3 * ANCHORS], kappa[ANCHORS], gamma[ANCHORS], rest[ANCHORS];
  const int elsewhere = (int)random_whole(source, 0, 1);
  for (int k = 0; k < ANCHORS; k++) {
    tied[k] = random_whole(source, 0, N - 1);
    const double *x = s->q + 3 * tied[k];
    for (int a = 0; a < 3; a++)
      point[3 * k + a] = x[a] + (elsewhere ? between(source, -1.0, 1.0) : 0.0);
    kappa[k] = random_whole(source, 0, 3) ? between(source, 1.0, 90.0) : 0.0;
    gamma[k] = s->overdamped ? 0.0 : some_damping(source);
    rest[k] = random_whole(source, 0, 1) ? 0.2 : 0.0;
    const double d[3] = {x[0] - point[3 * k], x[1] - point[3 * k + 1], x[2] - point[3 * k + 2]};
    add_spring(s, 1, tied + k, d, kappa[k], gamma[k], rest[k]);
  }
  owned_options *options = new_options("anchors");
  if (elsewhere) check_ok(hooke_options_set_numbers(options, "points", 3 * ANCHORS, point));
  check_ok(hooke_options_set_numbers(options, "stiffness", ANCHORS, kappa));
  check_ok(hooke_options_set_numbers(options, "damping", ANCHORS, gamma));
  check_ok(hooke_options_set_numbers(options, "rest_length", ANCHORS, rest));
  check_ok(hooke_system_add_anchors(s->system, "anchors", ANCHORS, tied, options));
}

static void draw_triples(struct random_source *source, struct scene *s) {
  static const double g[3] = {1.0, -2.0, 1.0}, none[3] = {0.0, 0.0, 0.0};
  int64_t triples[3 * TRIPLES];
  double c[TRIPLES];
  for (int k = 0; k < TRIPLES; k++) {
    const int64_t first = random_whole(source, 0, N - 1);
    for (int e = 0; e < 3; e++)
      triples[3 * k + e] = (first + e) % N;
    c[k] = between(source, 1.0, 20.0);
    add(s->k, 3, triples + 3 * k, g, none, c[k], c[k]);
  }
  check_ok(hooke_system_add_bending(s->system, "bends", TRIPLES, triples, TRIPLES, c));
}

static hooke_options *altitude_options(double stiffness, double damping) {
  hooke_options *options = options_with("altitude", "stiffness=%.17g damping=%.17g", stiffness, damping);
  return options;
}

/* The weights and the direction of an altitude show in the force of its damper alone, which is linear. */
static void draw_tetrahedron(struct random_source *source, struct scene *s) {
  const int64_t corners[4] = {0, 1, 2, 3};
  const double stiffness = between(source, 5.0, 50.0), damping = s->overdamped ? 0.0 : some_damping(source);
  hooke_options *options = altitude_options(0.0, 1.0);
  double v[DOF] = {0.0}, force[DOF];
  owned_system *damper = new_system();
  check_ok(hooke_system_add_particles(damper, N, s->q, NULL, N, s->mass, NULL));
  check_ok(hooke_system_add_altitude(damper, NULL, 1, corners, options));
  hooke_options_destroy(options);
  check_ok(hooke_system_commit(damper));
  for (int j = 0; j < DOF; j++) {
    v[j] = 1.0;
    check_ok(hooke_system_force(damper, 0.0, s->q, v, force));
    v[j] = 0.0;
    for (int i = 0; i < DOF; i++)
      s->k[i][j] -= stiffness * force[i], s->c[i][j] -= damping * force[i];
  }
  options = altitude_options(stiffness, damping);
  check_ok(hooke_system_add_altitude(s->system, "altitude", 1, corners, options));
  hooke_options_destroy(options);
}

static void draw(uint64_t seed, struct scene *s) {
  struct random_source source = {seed};
  memset(s, 0, sizeof *s);
  s->overdamped = seed % 8 == 0;
  draw_particles(&source, s);
  draw_springs(&source, s);
  if (random_whole(&source, 0, 2)) draw_anchors(&source, s);
  if (random_whole(&source, 0, 2) == 0) draw_triples(&source, s);
  if (random_whole(&source, 0, 2) == 0) draw_tetrahedron(&source, s);
  s->drag = s->overdamped ? 5.0 : random_whole(&source, 0, 1) ? some_damping(&source) : 0.0;
  if (s->overdamped) check_ok(hooke_system_set_dynamics(s->system, "overdamped"));
  check_ok(hooke_system_set_drag(s->system, s->drag));
  check_ok(hooke_system_commit(s->system));
  for (int p = 0; p < N && !s->overdamped; p++) {
    for (int a = 3 * p; a < 3 * p + 3; a++)
      s->c[a][a] += s->drag;
  }
}

/* ---- steps ---- */

struct motion {
  double x[DOF], v[DOF];
};

/* M^-1 (C v) or M^-1 (K x); in an overdamped scene over the drag. */
static void divide(const struct scene *s, const double matrix[DOF][DOF], const double *x, double *out) {
  for (int i = 0; i < DOF; i++) {
    out[i] = 0.0;
    for (int j = 0; j < DOF && !s->held[i / 3]; j++)
      out[i] += matrix[i][j] * x[j] / (s->overdamped ? s->drag : s->mass[i / 3]);
  }
}

static struct motion rate(const struct scene *s, const struct motion *at) {
  struct motion out = {.x = {0.0}};
  double stiff[DOF], damp[DOF];
  divide(s, s->k, at->x, stiff);
  divide(s, s->c, at->v, damp);
  for (int k = 0; k < DOF; k++) {
    out.x[k] = s->overdamped ? -stiff[k] : at->v[k];
    out.v[k] = s->overdamped ? 0.0 : -stiff[k] - damp[k];
  }
  return out;
}

static struct motion plus(const struct motion *a, double h, const struct motion *b) {
  struct motion out;
  for (int k = 0; k < DOF; k++)
    out.x[k] = a->x[k] + h * b->x[k], out.v[k] = a->v[k] + h * b->v[k];
  return out;
}

/* The sum of h^k A^k/k! up to a degree, which Runge-Kutta methods of that order are for linear rates. */
static struct motion exponential(const struct scene *s, int degree, double h, const struct motion *start) {
  struct motion sum = *start;
  for (int k = degree; k > 0; k--) {
    const struct motion slope = rate(s, &sum);
    sum = plus(start, h / k, &slope);
  }
  return sum;
}

/* v = (I + h/2 M^-1 C)^-1 v = (M + h/2 C)^-1 M v by Cholesky. */
static void damp_implicitly(const struct scene *s, double h, double *v) {
  double a[DOF][DOF];
  for (int i = 0; i < DOF; i++) {
    for (int j = 0; j < DOF; j++)
      a[i][j] =
          (i == j ? s->mass[i / 3] : 0.0) + (s->held[i / 3] || s->held[j / 3] ? 0.0 : 0.5 * h * s->c[i][j]);
    v[i] *= s->mass[i / 3];
  }
  gsl_matrix_view matrix = gsl_matrix_view_array(*a, DOF, DOF);
  gsl_vector_view vector = gsl_vector_view_array(v, DOF);
  gsl_linalg_cholesky_decomp1(&matrix.matrix);
  gsl_linalg_cholesky_svx(&matrix.matrix, &vector.vector);
}

/* Kick, drift, kick; damping is explicit in the first kick and implicit in the second, or left out. */
static struct motion verlet(const struct scene *s, int damped, double h, const struct motion *start) {
  struct motion m = *start, still = *start, a;
  if (!damped) memset(still.v, 0, sizeof still.v);
  a = rate(s, &still);
  for (int k = 0; k < DOF; k++)
    m.v[k] += 0.5 * h * a.v[k], m.x[k] += h * m.v[k];
  memcpy(still.x, m.x, sizeof still.x);
  memset(still.v, 0, sizeof still.v);
  a = rate(s, &still);
  for (int k = 0; k < DOF; k++)
    m.v[k] += 0.5 * h * a.v[k];
  if (damped) damp_implicitly(s, h, m.v);
  return m;
}

/* With all damping at once, (I + h/2 M^-1 C)^-1, where the library goes over the dampers one by one: the
 * limit is that without damping whatever takes energy away. */
static struct motion split(const struct scene *s, double h, const struct motion *start) {
  struct motion m = *start;
  damp_implicitly(s, h, m.v);
  m = verlet(s, 0, h, &m);
  damp_implicitly(s, h, m.v);
  return m;
}

static struct motion take(const struct scene *s, const char *method, double h, const struct motion *m) {
  if (strcmp(method, "forward-euler") == 0) return exponential(s, 1, h, m);
  if (strcmp(method, "heun") == 0) return exponential(s, 2, h, m);
  if (strcmp(method, "rk4") == 0) return exponential(s, 4, h, m);
  if (strcmp(method, "verlet") == 0) return verlet(s, 1, h, m);
  if (strcmp(method, "shardlow") == 0) return split(s, h, m);
  struct motion a = rate(s, m), out = *m;
  for (int k = 0; k < DOF; k++)
    out.v[k] += h * a.v[k], out.x[k] += h * out.v[k];
  return out;
}

/* ---- powers ---- */

/* The matrix of a step over what moves, and its size; velocities count h times. */
static int find_matrix(const struct scene *s, const char *method, double h, double *matrix) {
  int place[MOST], size = 0;
  for (int k = 0; k < (s->overdamped ? DOF : MOST); k++) {
    if (!s->held[k % DOF / 3]) place[size++] = k;
  }
  for (int j = 0; j < size; j++) {
    struct motion m = {.x = {0.0}};
    *(place[j] < DOF ? &m.x[place[j]] : &m.v[place[j] - DOF]) = place[j] < DOF ? 1.0 : 1.0 / h;
    m = take(s, method, h, &m);
    for (int i = 0; i < size; i++)
      matrix[i * size + j] = place[i] < DOF ? m.x[place[i]] : h * m.v[place[i] - DOF];
  }
  return size;
}

/* a = a a over its largest number; the logarithm of that. */
static double square(int n, double *a) {
  static double out[MOST * MOST];
  gsl_matrix_const_view from = gsl_matrix_const_view_array(a, (size_t)n, (size_t)n);
  gsl_matrix_view to = gsl_matrix_view_array(out, (size_t)n, (size_t)n);
  gsl_blas_dgemm(CblasNoTrans, CblasNoTrans, 1.0, &from.matrix, &from.matrix, 0.0, &to.matrix);
  const double most = largest(n * n, out);
  for (int k = 0; k < n * n; k++)
    a[k] = most > 0.0 ? out[k] / most : 0.0;
  return log(most);
}

/* 1 if 2^squares steps grow by more than powers of the number of steps and the largest jumps do. SURE: by
 * 2e-7 a step; rounding makes free motion grow by the root of 1e-16. FINE: by 2e-10. */
enum { SURE = 28, FINE = 38 };
static int grows(const struct scene *s, const char *method, double h, int squares) {
  static const double CLEAR = 60.0;
  static double matrix[MOST * MOST];
  const int size = find_matrix(s, method, h, matrix);
  double size_of_all = 0.0;
  for (int k = 0; k < squares && fabs(size_of_all) < CLEAR; k++)
    size_of_all = 2.0 * size_of_all + square(size, matrix);
  return size_of_all > CLEAR;
}

/* ---- limits ---- */

static hooke_measurement *scene_limits(const struct scene *s, const char *methods, int predict) {
  hooke_options *options = new_options("limit");
  if (methods) check_ok(hooke_options_set_text(options, "methods", methods));
  set_options(options, "predict=%d budget=200", predict);
  return limit_at_start(s->system, NULL, options);
}

static int needs_damping(const char *method) {
  return strcmp(method, "heun") == 0 || strcmp(method, "forward-euler") == 0;
}

static double verlet_bound(const struct scene *s) {
  double bound = 0.0;
  check_ok(hooke_step_bound(s->system, "verlet", s->q, &bound));
  return bound;
}

/* Methods that need damping are unstable so slowly at far smaller steps than the others take that rounding
 * hides it. */
static int is_seen(const struct scene *s, const char *method, double limit) {
  if (s->overdamped || !needs_damping(method)) return 1;
  return limit > (strcmp(method, "heun") == 0 ? 0.3 : 0.05) * verlet_bound(s);
}

static void check_limit(const struct scene *s, uint64_t seed, const char *method, const char *what,
                        double limit) {
  const int finite = limit > 0.0 && isfinite(limit);
  const double below = finite         ? (1.0 - WITHIN) * limit
                       : isinf(limit) ? 1e3
                                      : NAN,
               above = finite && is_seen(s, method, limit) ? (1.0 + WITHIN) * limit
                       : limit == 0.0                      ? verlet_bound(s)
                                                           : NAN;
  if (isnan(limit)) check_failed("scene %d, %s: %s is not known", (int)seed, method, what);
  if (!isnan(below) && grows(s, method, below, SURE))
    check_failed("scene %d, %s: %s %.8g s, and %.8g s grows", (int)seed, method, what, limit, below);
  if (!isnan(above) && !grows(s, method, above, needs_damping(method) ? FINE : SURE))
    check_failed("scene %d, %s: %s %.8g s, and %.8g s is stable", (int)seed, method, what, limit, above);
}

static void check_scene(uint64_t seed) {
  static const char *const methods[] = {
      "forward-euler", "symplectic-euler", "verlet", "shardlow", "heun", "rk4"};
  struct scene s;
  draw(seed, &s);
  hooke_measurement *predicted = scene_limits(&s, NULL, 1);
  for (int m = 0; m < 6; m++) {
    const int64_t row = hooke_measurement_find(predicted, "rows", "method", methods[m]);
    if (row < 0) continue;
    const double limit = hooke_measurement_number(predicted, "rows", row, "predicted"),
                 bound = hooke_measurement_number(predicted, "rows", row, "bound");
    check_limit(&s, seed, methods[m], "predicted", limit);
    check_between(bound, 0.0, limit);
    if (bound > 0.0 && isfinite(bound) && grows(&s, methods[m], (1.0 - 1e-6) * bound, SURE))
      check_failed("scene %d, %s: grows below the bound %.8g s", (int)seed, methods[m], bound);
    /* what grows at every step is slow to measure */
    if (!(limit > 0.0) || (needs_damping(methods[m]) && !getenv("HOOKE_LONG"))) continue;
    owned_measurement *measured = scene_limits(&s, methods[m], 0);
    const double found = hooke_measurement_number(measured, "rows", 0, "measured");
    /* or growth is too slow to be seen, which a note says */
    if (!isnan(found) || !needs_damping(methods[m]) || !hooke_measurement_text(measured, "rows", 0, "note"))
      check_limit(&s, seed, methods[m], "measured", found);
  }
  hooke_measurement_destroy(predicted);
  hooke_system_destroy(s.system);
}

TEST(limits_are_those_of_the_matrices) {
  const uint64_t count = getenv("HOOKE_LONG") ? 2000 : 24;
  for (uint64_t seed = 1; seed <= count; seed++) {
    if (!left_out((int64_t)seed, 4)) check_scene(seed);
  }
}

/* With the damping of springs and anchors of no length left out, scenes would be found wrong. */
TEST(damping_left_out_is_noticed) {
  int noticed = 0;
  for (uint64_t seed = 1; seed <= 24; seed++) {
    struct scene s;
    draw(seed, &s);
    double limit;
    check_ok(hooke_step_bound(s.system, "symplectic-euler", s.q, &limit));
    const int before = grows(&s, "symplectic-euler", limit, SURE);
    memset(s.c, 0, sizeof s.c);
    noticed += !before && !grows(&s, "symplectic-euler", 1.5 * limit, SURE);
    hooke_system_destroy(s.system);
  }
  check_between(noticed, 6, 24);
}
