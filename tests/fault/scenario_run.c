/* Runs by every method, with one and several threads, with all kinds of observers. */
#include "scenarios.h"

#include <dirent.h>
#include <stdio.h>
#include <unistd.h>

struct with {
  const char *method;
  int32_t threads;
  const char *linear_solver, *newton; /* NULL: the default */
  double step;                        /* 0: a safe one */
};

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  attempt_number(ctx, (double)step);
  take_state(ctx, state);
  return 0;
}

static int32_t hear(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  (void)sentence, (void)t, (void)limit, (void)spring, (void)particle;
  attempt_text(ctx, kind);
  return 0;
}

/* From the start, whatever a previous attempt has left: its frames do not count. */
static int32_t run_from_start(struct attempt *a, hooke_integrator *integrator, const hooke_state *start,
                              hooke_state *state, uint64_t before) {
  a->hash = before;
  const int32_t status = hooke_state_copy(start, state);
  return status != HOOKE_OK ? status : hooke_integrator_run(integrator, state);
}

/* A system that is too small for two threads gets one. */
static void check_threads(struct attempt *a, int32_t wanted) {
  int64_t entries = 0;
  fault_pause();
  DIR *folder = opendir("/proc/self/task");
  while (folder && readdir(folder))
    entries++;
  if (folder) closedir(folder);
  fault_resume();
  if (folder && wanted > 1 && sysconf(_SC_NPROCESSORS_ONLN) > 1 && entries - 2 < wanted)
    attempt_wrong(a, "%d threads were asked for, and %lld are there", (int)wanted, (long long)entries - 2);
}

SCENARIO(run) {
  const struct with *w = with;
  struct made m = {.system = make_rope(a, w->threads > 1 ? 17500 : 6)};
  const double step = w->step > 0.0 ? w->step : w->threads > 1 ? 1e-7 : 1e-4;
  const double duration = w->threads > 1 ? 2.0 * step : 4.0 * step;
  m.run = make_options(a, "run", "method=%s step=%.17g duration=%.17g threads=%d rtol=1e-4", w->method, step,
                       duration, (int)w->threads);
  if (m.run == NULL) goto end;
  if (w->threads > 1) TRY(a, hooke_options_set_number(m.run, "every", duration));
  if (w->linear_solver) TRY(a, hooke_options_set_text(m.run, "linear_solver", w->linear_solver));
  if (w->newton) TRY(a, hooke_options_set_text(m.run, "newton", w->newton));
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  check_threads(a, w->threads);
  TRY(a, hooke_integrator_on_frame(m.integrator, see, a));
  TRY(a, hooke_integrator_on_step(m.integrator, 2, see, a));
  TRY(a, hooke_integrator_on_warning(m.integrator, hear, a));
  TRY(a, hooke_state_create(m.system, &m.other));
  TRY(a, hooke_state_create(m.system, &m.state));
  const uint64_t before = a->hash;
  TRY(a, run_from_start(a, m.integrator, m.other, m.state, before));
  TRY(a, hooke_integrator_step(m.integrator, m.state, 2));
  take_state(a, m.state);
  if (hooke_integrator_count(m.integrator, "recent") > 0)
    TRY(a, hooke_integrator_recent(m.integrator, 0, m.other));
  take_state(a, m.other);
  const int64_t second = 1;
  const double velocity[] = {0.1, 0.0, -0.1};
  TRY_ONCE(a, hooke_integrator_advance(m.integrator, 2));
  TRY_ONCE(a, hooke_integrator_put(m.integrator, 1, &second, NULL, velocity));
  TRY_ONCE(a, hooke_integrator_advance(m.integrator, 1));
  TRY(a, hooke_integrator_sync(m.integrator, m.state));
  take_state(a, m.state);
end:
  release(&m);
}

#define SHORT_RUN "method=%s step=1e-3 duration=4e-3 every=1e-3"

/* Three particles in a rigid body that another pulls at, or without inertia. */
static void run_four(struct attempt *a, const char *method, int32_t overdamped) {
  const double q[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 2, 2}, v[] = {0, 0, 1, 0, 0, 1, 0, 0, 2, 0, 0, 0},
               mass = 1.0;
  const int64_t ends[] = {0, 1, 2, 3}, body[] = {0, 1, 2};
  struct made m = {.run = make_options(a, "run", SHORT_RUN, method)};
  m.options = make_options(a, "springs", "stiffness=10");
  if (m.options == NULL) goto end;
  TRY(a, hooke_system_create(&m.system));
  TRY(a, hooke_system_add_particles(m.system, 4, q, overdamped ? NULL : v, 1, &mass, NULL));
  TRY(a, hooke_system_add_springs(m.system, "springs", 2, ends, m.options));
  if (overdamped) {
    TRY(a, hooke_system_set_drag(m.system, 2.0));
    TRY(a, hooke_system_set_dynamics(m.system, "overdamped"));
  } else {
    TRY(a, hooke_system_add_body(m.system, "body", 3, body, 1));
  }
  TRY(a, hooke_system_commit(m.system));
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_integrator_run(m.integrator, m.state));
  take_state(a, m.state);
end:
  release(&m);
}

SCENARIO(run_body) {
  run_four(a, with, 0);
}

SCENARIO(run_overdamped) {
  run_four(a, with, 1);
}

static int32_t decay(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)t, (void)ctx;
  for (int64_t k = 0; k < n; k++)
    rate[k] = -(double)(k + 1) * x[k];
  return 0;
}

SCENARIO(run_first_order) {
  struct made m = {.run = make_options(a, "run", SHORT_RUN, (const char *)with)};
  if (m.run == NULL) goto end;
  TRY(a, hooke_integrator_create_first_order(3, decay, NULL, m.run, &m.integrator));
  TRY(a, hooke_state_create_first_order(3, &m.state));
  TRY(a, hooke_system_create_first_order(decay, NULL, m.state, &m.system));
  for (int k = 0; k < 3; k++)
    hooke_state_position(m.state)[k] = 1.0;
  hooke_state_set_time(m.state, 0.0);
  TRY(a, hooke_integrator_run(m.integrator, m.state));
  take_state(a, m.state);
end:
  release(&m);
}

static int32_t pull_back(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)t, (void)v, (void)ctx;
  for (int64_t k = 0; k < n; k++)
    force[k] -= q[k];
  return 0;
}

SCENARIO(run_second_order) {
  const double weight[] = {1.0, 0.5, 2.0};
  struct made m = {.run = make_options(a, "run", SHORT_RUN, (const char *)with)};
  if (m.run == NULL) goto end;
  TRY(a, hooke_integrator_create_second_order(3, pull_back, NULL, NULL, 3, weight, m.run, &m.integrator));
  TRY(a, hooke_state_create_second_order(3, &m.state));
  TRY(a, hooke_state_create_second_order(3, &m.other));
  for (int k = 0; k < 3; k++)
    hooke_state_position(m.other)[k] = 1.0;
  const uint64_t before = a->hash;
  TRY(a, run_from_start(a, m.integrator, m.other, m.state, before));
  take_state(a, m.state);
end:
  release(&m);
}

#define RUN(m, ...)                                                                                          \
  &(const struct with) {                                                                                     \
    .method = m, __VA_ARGS__                                                                                 \
  }

const struct scenario running[] = {
    {"run, forward-euler", run, RUN("forward-euler", 1), 1, NULL, NULL},
    {"run, symplectic-euler", run, RUN("symplectic-euler", 1), 1, NULL, NULL},
    {"run, symplectic-euler, 2 threads", run, RUN("symplectic-euler", 2), 40, NULL, NULL},
    {"run, symplectic-euler, warned of", run, RUN("symplectic-euler", 1, .step = 0.02), 1, NULL, NULL},
    {"run, verlet", run, RUN("verlet", 1), 1, NULL, NULL},
    {"run, verlet, 2 threads", run, RUN("verlet", 2), 40, NULL, NULL},
    {"run, shardlow", run, RUN("shardlow", 1), 1, NULL, NULL},
    {"run, rk4", run, RUN("rk4", 1), 1, NULL, NULL},
    {"run, rk4, 2 threads", run, RUN("rk4", 2), 40, NULL, NULL},
    {"run, backward-euler", run, RUN("backward-euler", 1), 1, NULL, NULL},
    {"run, backward-euler, converged", run, RUN("backward-euler", 1, .newton = "converged"), 1, NULL, NULL},
    {"run, backward-euler, direct", run, RUN("backward-euler", 1, .linear_solver = "direct"), 1, "cholmod",
     NULL},
    {"run, backward-euler, 2 threads", run, RUN("backward-euler", 2), 40, NULL, NULL},
    {"run, cvode-bdf", run, RUN("cvode-bdf", 1), 1, "sundials", NULL},
    {"run, cvode-bdf, direct", run, RUN("cvode-bdf", 1, .linear_solver = "direct"), 1, "sundials cholmod",
     NULL},
    {"run, cvode-bdf, blocks", run, RUN("cvode-bdf", 1, .linear_solver = "blocks"), 1, "sundials", NULL},
    {"run, cvode-bdf, gmres", run, RUN("cvode-bdf", 1, .linear_solver = "gmres"), 1, "sundials", NULL},
    {"run, cvode-bdf, 2 threads", run, RUN("cvode-bdf", 2), 40, "sundials", NULL},
    {"run, cvode-adams", run, RUN("cvode-adams", 1), 1, "sundials", NULL},
    {"run, cvode-adams, 2 threads", run, RUN("cvode-adams", 2), 40, "sundials", NULL},
    {"run, arkode-esdirk", run, RUN("arkode-esdirk", 1), 1, "sundials", NULL},
    {"run, rk8pd", run, RUN("rk8pd", 1), 1, "gsl", NULL},
    {"run, rigid body, verlet", run_body, "verlet", 1, NULL, NULL},
    {"run, rigid body, rk4", run_body, "rk4", 1, NULL, NULL},
    {"run, rigid body, tr-bdf2", run_body, "tr-bdf2", 1, NULL, NULL},
    {"run, rigid body, cvode-bdf", run_body, "cvode-bdf", 1, "sundials", NULL},
    {"run, overdamped, rk4", run_overdamped, "rk4", 1, NULL, NULL},
    {"run, overdamped, backward-euler", run_overdamped, "backward-euler", 1, NULL, NULL},
    {"run, overdamped, cvode-bdf", run_overdamped, "cvode-bdf", 1, "sundials", NULL},
    {"run, second order, verlet", run_second_order, "verlet", 1, NULL, NULL},
    {"run, second order, tr-bdf2", run_second_order, "tr-bdf2", 1, NULL, NULL},
    {"run, first order, rk4", run_first_order, "rk4", 1, NULL, NULL},
    {"run, first order, cvode-bdf", run_first_order, "cvode-bdf", 1, "sundials", NULL},
    {"run, first order, rk8pd", run_first_order, "rk8pd", 1, "gsl", NULL},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
