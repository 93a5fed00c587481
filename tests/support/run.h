/* Short forms for creating integrators. Every function fails the running test when the library refuses. */
#pragma once

#include "hooke.h"
#include "owned.h"

#define BY_DEFAULT (-1.0)

/* Options of a run; numbers that are 0 are left at their defaults. */
struct run {
  const char *method;
  double step, duration, every, checkpoint;
  double rtol, atol, atol_velocity;
  int32_t threads;
  const char *newton, *linear_solver, *verlet_damping; /* NULL: the default */
  /* 0: 1e-12, with which a step is its formula; BY_DEFAULT: that of the library */
  double newton_tolerance;
};

/* The caller destroys what these return. */
hooke_options *run_options(struct run run);
hooke_integrator *start_run(const hooke_system *system, struct run run);
/* The same by its members: start_with(system, .method = "rk4", .step = 1e-3). */
#define start_with(system, ...) start_run((system), (struct run){__VA_ARGS__})
hooke_integrator *start_first_order(int64_t size, hooke_rate *rate, void *ctx, struct run run);
hooke_state *start_state(const hooke_system *system);
/* Declares an integrator and the initial state of a system, which the block releases:
 * owned_run(integrator, state, system, .method = "rk4", .step = 1e-3); */
#define owned_run(integrator, state, system, ...)                                                            \
  owned_integrator *integrator = start_with((system), __VA_ARGS__);                                          \
  owned_state *state = start_state(system)

/* From the initial state to the end of the run; `q` and `v` (3n, or NULL) receive the final state. */
void run_to_end(const hooke_system *system, struct run run, double *q, double *v);
/* The same by the members of a run: end_of_run(q, v, system, .method = "rk4", .step = 1e-3). */
#define end_of_run(q, v, system, ...) run_to_end((system), (struct run){__VA_ARGS__}, (q), (v))

/* An estimate of the error of runs; `want` NaN: without a wanted error. The status of what fails first. */
int32_t estimate_of(const hooke_system *system, double want, hooke_measurement **estimate);

/* A limit with these options, which it destroys; a build without limits skips the test, and the system is
 * destroyed. `run` may be NULL. */
hooke_measurement *start_limit(const hooke_system *system, const hooke_options *run, hooke_options *options);
/* The same, run at the initial state. */
hooke_measurement *limit_at_start(const hooke_system *system, const hooke_options *run,
                                  hooke_options *options);

/* Limits of these methods at the initial state, measured to 1e-3, or only predicted. */
hooke_measurement *limits_of(const hooke_system *system, const char *methods, int32_t predict);
/* Each measured limit is that predicted, to 1e-3, and is not below its bound, nor far above it. Destroys the
 * system. */
void check_limits_met(hooke_system *system, const char *methods);

/* Explains why the last run ended early, for as long as that takes. The status of what fails first; then
 * there is no measurement. */
int32_t explain_run(const hooke_integrator *integrator, hooke_measurement **why);

/* 1 if this build has the method and it takes `step`. */
int32_t is_fixed_step(const char *method);
/* The method after this one, or the first, that is taken; NULL at the end:
 * for (const char *method = NULL; (method = next_method(method, is_fixed_step));) */
const char *next_method(const char *method, int32_t (*taken)(const char *method));
/* 1 if it solves nonlinear equations for each of its steps, in the ways of the option `newton`. */
int32_t is_implicit(const char *method);

/* The largest |a| of an array. */
double largest(int64_t count, const double *a);

/* hooke_step_bound() at the initial positions; a build without it skips the test, and the system is
 * destroyed. */
double bound_at_start(const hooke_system *system, const char *method);
