/* The numbers of docs/lecture.md, a function each: `lecture NAME`, from the folder above `examples`. */
#include <hooke.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s: %s\n", hooke_status_name(status), hooke_last_error());
  exit(1);
}

/* ---- scenes ---- */

static hooke_scene *scene_of(const char *text) {
  hooke_scene *scene;
  check(hooke_scene_parse(text, (int64_t)strlen(text), NULL, NULL, NULL, &scene));
  check(hooke_scene_commit(scene));
  return scene;
}

static hooke_scene *example(const char *name) {
  char path[100];
  hooke_scene *scene;
  snprintf(path, sizeof path, "examples/scenes/%s.json", name);
  check(hooke_scene_load(path, NULL, &scene));
  check(hooke_scene_commit(scene));
  return scene;
}

static hooke_options *run_of(const char *method, double step) {
  hooke_options *run;
  check(hooke_options_create("run", &run));
  check(hooke_options_set_text(run, "method", method));
  check(hooke_options_set_number(run, "step", step));
  return run;
}

/* The state of an example after `time`, by its own method and step. */
static hooke_state *after(hooke_scene *scene, double time) {
  hooke_integrator *integrator;
  hooke_state *state;
  hooke_options *run = hooke_scene_run_options(scene);
  check(hooke_options_set_number(run, "duration", time));
  check(hooke_integrator_create(hooke_scene_system(scene), run, &integrator));
  check(hooke_state_create(hooke_scene_system(scene), &state));
  check(hooke_integrator_run(integrator, state));
  hooke_integrator_destroy(integrator);
  return state;
}

/* Prints numbers of a measurement, those of column `what` at `rows` of a table. */
static void measure(const hooke_system *system, hooke_state *state, const char *kind, const char *option,
                    const char *value, const char *table, const char *what, int count, const int64_t *rows) {
  hooke_measurement *measurement;
  hooke_options *options;
  check(hooke_options_create(kind, &options));
  check(hooke_options_set_text(options, option, value));
  check(hooke_measurement_create(kind, system, NULL, options, &measurement));
  check(hooke_measurement_run(measurement, state));
  for (int k = 0; k < count; k++)
    printf("%.17g ", hooke_measurement_number(measurement, table, rows[k], what));
  hooke_measurement_destroy(measurement);
  hooke_options_destroy(options);
}

static const char chain[] =
    "{\"hooke\": 1, \"particles\": {\"position\": [[0,0,0], [1.2,0,0], [2.1,0,0], [3.3,0,0]],"
    " \"velocity\": [[0,1,0], [0,0,0], [0,0,0], [0,-1,0]], \"mass\": [1, 2, 1, 3]},"
    " \"springs\": [{\"name\": \"chain\", \"between\": [[0,1], [1,2], [2,3]], \"stiffness\": 20, \"rest_length\": 1}]}";

static void order(void) {
  hooke_scene *scene = scene_of(chain);
  const hooke_system *system = hooke_scene_system(scene);
  const double *w = hooke_system_inverse_mass(system), h = 0.01;
  hooke_integrator *integrator;
  hooke_state *state[2];
  double f[12], mean[2] = {0, 0}, energy[2];
  for (int k = 0; k < 2; k++)
    check(hooke_state_create(system, &state[k]));
  double *q = hooke_state_position(state[0]), *v = hooke_state_velocity(state[0]);
  const double before = hooke_system_energy_at(system, "total", 0, q, v);
  for (int n = 0; n < 500; n++) {
    for (int i = 0; i < 4; i++) { /* in turn: the force on the next one comes from where this one has moved */
      check(hooke_system_force(system, 0, q, v, f));
      for (int k = 3 * i; k < 3 * i + 3; k++) {
        v[k] += h * w[i] * f[k];
        q[k] += h * v[k];
      }
    }
  }
  check(hooke_integrator_create(system, run_of("symplectic-euler", h), &integrator));
  check(hooke_integrator_step(integrator, state[1], 500));
  for (int k = 0; k < 2; k++)
    energy[k] = hooke_system_energy_at(system, "total", 0, hooke_state_position(state[k]),
                                       hooke_state_velocity(state[k])) -
                before;
  for (int i = 0; i < 4; i++) { /* 7 kg, whose centre began at (15.3/7, 0) and drifts by -2/7 m/s */
    mean[0] += q[3 * i] / w[i] / 7;
    mean[1] += q[3 * i + 1] / w[i] / 7;
  }
  printf("%.17g %.17g %.17g\n", hypot(mean[0] - 14.4 / 7, mean[1] + 2.0 / 7 * 5), energy[0], energy[1]);
}

/* ---- problems of a few numbers ---- */

static int32_t pendulum(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  force[0] += -9.81 * sin(q[0]);
  return (void)n, (void)t, (void)v, (void)ctx, 0;
}

static int32_t swing(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  force[0] += -q[0];
  return (void)n, (void)t, (void)v, (void)ctx, 0;
}

static void second_order(hooke_force *force, const char *method, double step, int64_t steps) {
  hooke_integrator *integrator;
  hooke_state *state;
  check(hooke_integrator_create_second_order(1, force, NULL, NULL, 1, (double[]){1}, run_of(method, step),
                                             &integrator));
  check(hooke_state_create_second_order(1, &state));
  hooke_state_position(state)[0] = 1;
  check(hooke_integrator_step(integrator, state, steps));
  printf("%.17g %.17g\n", hooke_state_position(state)[0], hooke_state_velocity(state)[0]);
}

static int32_t river(int64_t n, double t, const double *x, double *rate, void *ctx) {
  rate[0] = 1;
  rate[1] = cos(x[0]) - (x[1] - sin(x[0])) / 2;
  return (void)n, (void)t, (void)ctx, 0;
}

static int32_t linear(int64_t n, double t, const double *x, double *rate, void *ctx) {
  const double *a = ctx;
  rate[0] = a[0] * x[0] - a[1] * x[1];
  rate[1] = a[1] * x[0] + a[0] * x[1];
  return (void)n, (void)t, 0;
}

static int32_t van_der_pol(int64_t n, double t, const double *x, double *rate, void *ctx) {
  rate[0] = x[1];
  rate[1] = (1 - x[0] * x[0]) * x[1] - x[0];
  return (void)n, (void)t, (void)ctx, 0;
}

static void first_order(hooke_rate *rate, void *ctx, double step, int64_t steps, double x[2]) {
  hooke_integrator *integrator;
  hooke_state *state;
  check(hooke_integrator_create_first_order(2, rate, ctx, run_of("forward-euler", step), &integrator));
  check(hooke_state_create_first_order(2, &state));
  memcpy(hooke_state_position(state), x, 2 * sizeof *x);
  check(hooke_integrator_step(integrator, state, steps));
  memcpy(x, hooke_state_position(state), 2 * sizeof *x);
}

/* Distance from the leaf at time t. */
static double off(const double x[2], double t) {
  return hypot(x[0] - t, x[1] - sin(t) - exp(-t / 2));
}

/* ---- the steps of the lecture ---- */

static void phase(void) {
  second_order(pendulum, "forward-euler", 0.1, 40);
}

static void six(void) {
  const double *q = hooke_state_position(after(example("six-particles"), 0.4));
  printf("%.17g %.17g %.17g\n", q[0], q[1], q[2]);
}

static void pull(double x, double y, int energy) {
  const double q[6] = {0, 0, 0, x, y, 0}, v[6] = {0};
  double f[6];
  hooke_system *system = hooke_scene_system(scene_of(
      "{\"hooke\": 1, \"particles\": {\"position\": [[0,0,0], [1,0,0]], \"mass\": 1, \"pinned\": [0]},"
      " \"springs\": [{\"name\": \"spring\", \"between\": [[0,1]], \"stiffness\": 20, \"rest_length\": 1}]}"));
  check(hooke_system_force(system, 0, q, v, f));
  if (energy)
    printf("%.17g %.17g\n", hooke_system_energy_at(system, "springs", 0, q, v), f[3]);
  else
    printf("%.17g %.17g\n", f[3], f[4]);
}

static void spring(void) {
  pull(1.25, 0, 1);
}

static void space(void) {
  pull(1, 0.75, 0);
}

static void rope(void) {
  const hooke_system *system = hooke_scene_system(example("rope-resolution"));
  measure(system, NULL, "rest", "watch", "strain-8:8.y,13.y", "watched", "value", 2, (int64_t[]){0, 1});
}

static void ether(void) {
  const double *q = hooke_state_position(after(example("drag-or-damping"), 4));
  printf("%.17g %.17g\n", q[1], q[7]);
}

static void force(void) {
  hooke_scene *scene = example("six-particles");
  hooke_state *state = after(scene, 0.4);
  double f[18];
  check(hooke_system_force(hooke_scene_system(scene), 0.4, hooke_state_position(state),
                           hooke_state_velocity(state), f));
  printf("%.17g %.17g %.17g\n", f[0], f[1], f[2]);
}

static void cloths(void) {
  const double *q = hooke_state_position(after(example("three-cloths"), 0.5));
  for (int k = 0; k < 3; k++)
    printf("%.17g ", q[3 * (144 * k + 138) + 1]);
}

static void hair(void) {
  printf("%.17g\n", hooke_state_position(after(example("curl"), 0.3))[3 * 60 + 1]);
}

static void limit_of(hooke_scene *scene) {
  hooke_measurement *limit;
  hooke_options *options;
  check(hooke_options_create("limit", &options));
  check(hooke_options_set_text(options, "methods", "symplectic-euler"));
  check(hooke_options_set_text(options, "predict", "true"));
  check(hooke_measurement_create("limit", hooke_scene_system(scene), NULL, options, &limit));
  check(hooke_measurement_run(limit, NULL));
  printf("%.17g ", hooke_measurement_number(limit, "rows", 0, "predicted"));
}

static void blow(void) {
  limit_of(example("cloth-16"));
}

static void leaf(void) {
  double x[3][2] = {{0, 1}, {1, 0}, {0.5, 0}}, a[2] = {-0.2, 2};
  first_order(river, NULL, 0.5, 12, x[0]);
  first_order(linear, a, 0.5, 12, x[1]);
  first_order(van_der_pol, NULL, 0.5, 12, x[2]);
  for (int k = 0; k < 3; k++)
    printf("%.17g %.17g\n", x[k][0], x[k][1]);
}

static void errors(void) {
  double x[2] = {1.5, sin(1.5) + exp(-0.75)}, y[2] = {0, 1};
  first_order(river, NULL, 0.1, 1, x);
  first_order(river, NULL, 0.1, 60, y);
  printf("%.17g %.17g\n", off(x, 1.6), off(y, 6));
}

static void plane(void) {
  double a[2] = {-0.2, 0.7}, x[2] = {1, 0};
  first_order(linear, a, 1, 10, x);
  printf("%.17g %.17g\n", x[0], x[1]);
}

static void accuracy(void) {
  second_order(swing, "symplectic-euler", 1, 63);
}

static void rule(void) {
  const hooke_system *system = hooke_scene_system(example("stiff-spring"));
  measure(system, NULL, "modes", "count", "18", "rows", "omega", 2, (int64_t[]){17, 0});
}

/* The chain with its stiff spring at 2 %, its limit, and how far that moves a particle within a second. */
static void stiff(void) {
  hooke_scene *scene[2] = {example("stiff-spring")};
  hooke_integrator *integrator[2];
  hooke_state *state[2];
  double most = 0;
  char text[4000];
  snprintf(text, sizeof text, "%s", hooke_scene_text(scene[0], "text"));
  memcpy(strstr(text, "1e6"), "2e4", 3); /* N */
  scene[1] = scene_of(text);
  limit_of(scene[1]);
  for (int k = 0; k < 2; k++) {
    check(hooke_integrator_create(hooke_scene_system(scene[k]), run_of("rk4", 5e-4), &integrator[k]));
    check(hooke_state_create(hooke_scene_system(scene[k]), &state[k]));
  }
  for (int frame = 0; frame < 50; frame++) {
    for (int k = 0; k < 2; k++)
      check(hooke_integrator_step(integrator[k], state[k], 40));
    const double *p = hooke_state_position(state[0]), *q = hooke_state_position(state[1]);
    for (int i = 0; i < 24; i += 3)
      most = fmax(most, hypot(hypot(p[i] - q[i], p[i + 1] - q[i + 1]), p[i + 2] - q[i + 2]));
  }
  printf("%.17g\n", most);
}

int main(int count, char **words) {
  static const struct {
    const char *name;
    void (*tell)(void);
  } steps[] = {{"order", order},   {"phase", phase}, {"six", six},           {"spring", spring},
               {"space", space},   {"rope", rope},   {"ether", ether},       {"force", force},
               {"cloths", cloths}, {"hair", hair},   {"blow", blow},         {"river", leaf},
               {"errors", errors}, {"plane", plane}, {"accuracy", accuracy}, {"rule", rule},
               {"stiff", stiff}};
  for (size_t k = 0; count == 2 && k < sizeof steps / sizeof steps[0]; k++) {
    if (strcmp(words[1], steps[k].name) != 0) continue;
    steps[k].tell();
    return 0;
  }
  fprintf(stderr, "usage: lecture NAME, a step of docs/lecture.md\n");
  return 2;
}
