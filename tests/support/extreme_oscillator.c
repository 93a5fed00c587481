#include "extreme.h"

#include "check.h"
#include "small.h"
#include "oscillator.h"

#include <math.h>
#include <string.h>

/* The oscillator after all roundings of its construction. */
struct model {
  hooke_system *system;
  long double omega, zeta; /* [1/s], over critical */
  double rest, amplitude;  /* [m] */
  double kappa;            /* [N/m] */
  long double start[2];    /* in units of amplitude and 1/omega */
};

static void build(const struct extreme_oscillator *o, struct model *model) {
  const int strain = strcmp(o->law, "strain") == 0;
  const double reduced = o->partner != 0.0 ? o->mass * (o->partner / (o->mass + o->partner)) : o->mass;
  const double omega = sqrt(o->stiffness / reduced), brake = 2.0 * o->damping * omega * reduced;
  const double mass[] = {o->partner != 0.0 ? o->partner : o->mass, o->mass};
  const double amplitude = o->amplitude != 0.0 ? o->amplitude : strain ? 0.1 : 1.0;
  const double rest = strain ? 1.0 : o->rest_length;
  const double position[] = {o->distance, 0, 0, o->distance + (rest + amplitude), 0, 0};
  const double velocity[] = {0, 0, 0, 0.5 * amplitude * omega, 0, 0};
  const int64_t first = 0, ends[] = {0, 1};
  check_ok(hooke_system_create(&model->system));
  check_ok(hooke_system_add_particles(model->system, 2, position, velocity, 2, mass, NULL));
  if (o->partner == 0.0) check_ok(hooke_system_pin(model->system, 1, &first));
  hooke_options *options =
      options_with("springs", "law=%s stiffness=%.17g rest_length=%.17g", o->law, o->stiffness, rest);
  if (!o->drag) check_ok(hooke_options_set_number(options, "damping", brake));
  check_ok(hooke_system_add_springs(model->system, "spring", 1, ends, options));
  hooke_options_destroy(options);
  if (o->drag) check_ok(hooke_system_set_drag(model->system, brake));
  check_ok(hooke_system_commit(model->system));
  double gamma;
  check_ok(hooke_system_members(model->system, "springs", NULL, &model->kappa, &gamma, NULL));
  const double *inverse = hooke_system_inverse_mass(model->system);
  const long double w = (long double)inverse[0] + inverse[1];
  model->omega = sqrtl(model->kappa * w);
  model->zeta = (o->drag ? brake : gamma) * w / (2.0L * model->omega);
  model->rest = rest;
  model->amplitude = amplitude;
  model->start[0] = ((long double)position[3] - position[0] - rest) / amplitude;
  model->start[1] = velocity[3] / (model->omega * amplitude);
}

/* Distance of the end of the run from a point in phase space, in amplitudes. */
static double distance_to(const struct model *model, const struct extreme_outcome *outcome,
                          const long double place[2]) {
  const long double x = ((long double)outcome->q[3] - outcome->q[0] - model->rest) / model->amplitude;
  const long double v = ((long double)outcome->v[3] - outcome->v[0]) / (model->omega * model->amplitude);
  return (double)hypotl(x - place[0], v - place[1]);
}

static const char *judge_known(const struct extreme_oscillator *o, const struct model *model,
                               const struct extreme_outcome *outcome, const long double matrix[4]) {
  long double known[2];
  if (oscillator_diverges(matrix, o->steps, model->start) > 0)
    return extreme_not_ended(outcome, HOOKE_DIVERGED, "diverged");
  if (o->implicit_status != HOOKE_OK) return extreme_not_ended(outcome, o->implicit_status, "");
  oscillator_power(matrix, o->steps, model->start, known);
  return extreme_not_right(outcome, distance_to(model, outcome, known), 0.0,
                           o->rounding != 0.0 ? o->rounding : 1e-9);
}

/* The stated energy is that of the state, and the momentum of a free pair that of the start. */
static void check_sums(const struct model *model, const struct extreme_outcome *outcome) {
  const double *mass = hooke_system_mass(model->system), *w = hooke_system_inverse_mass(model->system);
  const long double x = (long double)outcome->q[3] - outcome->q[0] - model->rest;
  const long double u = w[0] != 0.0 ? outcome->v[0] : 0.0, v = outcome->v[3];
  const long double kinetic = 0.5L * (mass[0] * u * u + mass[1] * v * v);
  const double energy = (double)(kinetic + 0.5L * model->kappa * x * x);
  const double rounding = model->kappa * model->amplitude * (model->rest + model->amplitude) * 1e-15;
  check_close(outcome->energy, energy, 1e-14 * energy + rounding);
  if (w[0] == 0.0) return;
  const long double change = mass[0] * (u - outcome->v0[0]) + mass[1] * (v - outcome->v0[3]);
  check_close((double)change, 0.0, (double)(1e-11L * mass[1] * model->omega * model->amplitude));
}

static void check_method(const struct extreme_oscillator *o, const struct model *model, const char *method) {
  const double tolerance = o->tolerance != 0.0 ? o->tolerance : 1e-8;
  const double absolute = o->absolute != 0.0 ? o->absolute : 0.01 * tolerance;
  const double allowed = tolerance * (1.0 + o->distance / model->amplitude) + absolute;
  const double h = (double)(o->step / model->omega);
  owned_outcome outcome;
  extreme_run(model->system,
              (struct extreme_run){.method = method,
                                   .step = h,
                                   .steps = o->steps,
                                   .frame_steps = o->frame_steps,
                                   .start = o->start,
                                   .max_steps = o->max_steps,
                                   .rtol = tolerance,
                                   .atol = absolute * model->amplitude,
                                   .atol_velocity = (double)(absolute * model->amplitude * model->omega)},
              &outcome);
  long double solution[2], matrix[4];
  oscillator_solution(model->zeta, (long double)o->steps * h * model->omega, model->start, solution);
  const double error = distance_to(model, &outcome, solution);
  const char *complaint;
  if (hooke_method_is_adaptive(method) == 1 && o->adaptive_status != HOOKE_OK)
    complaint = extreme_not_ended(&outcome, o->adaptive_status, "");
  else if (outcome.status == HOOKE_STEP_LIMIT && o->may_run_out)
    complaint = extreme_unsound(&outcome);
  else if (hooke_method_is_adaptive(method) == 1)
    complaint = extreme_not_right(&outcome, error, 1e-5 * allowed, 1e4 * allowed);
  else if (oscillator_step(outcome.explicit_damping ? "verlet, explicit" : method, model->zeta,
                           h * model->omega, matrix))
    complaint = judge_known(o, model, &outcome, matrix);
  else
    complaint = outcome.status == HOOKE_OK
                    ? extreme_not_right(&outcome, error, 0.0, o->step * (double)o->steps)
                    : extreme_unsound(&outcome);
  extreme_demand(o->family, o->name, method, complaint, &outcome);
  check_sums(model, &outcome);
  extreme_record(o->family, o->name, method, &outcome, error);
}

void extreme_oscillate(const struct extreme_oscillator *oscillator) {
  struct model model;
  build(oscillator, &model);
  for (int64_t m = 0; m < hooke_method_count(); m++) {
    const char *method = hooke_method_name(m);
    if (hooke_method_is_built(method) == 1) check_method(oscillator, &model, method);
  }
  hooke_system_destroy(model.system);
}
