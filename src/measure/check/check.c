/* Checks a scene: bounds on steps, memory of a run, and warnings. */
#include "measure/check/check.h"

#include "core/memory.h"
#include "core/table/option.h"
#include "integrate/integrator.h"
#include "measure/estimate/estimate.h"
#include "measure/limit/contact.h"
#include "measure/spectrum/step_bound.h"

#include <math.h>
#include <string.h>

static const struct hk_option_row check_rows[] = {
    HOOKE_OPTION(
        "process", HOOKE_OPTION_COUNTED(2, 2), NULL,
        "bytes of the process with the scene in it, and the most that it had so far; without, those of "
        "the scene alone count",
        .high = 9e15, .example = "2e7,3e7"),
};

static const struct hk_option_table check_table = {"check", HOOKE_OPTION_ROWS(check_rows)};

/* ---- creating ---- */

static void forget(struct hk_check *check) {
  hk_claims_release(&check->warnings);
  check->most = check->written = check->factor = check->counted = -1;
  for (int64_t k = 0; k < hooke_method_count(); k++)
    check->bound[k] = NAN;
}

static int32_t create(hooke_measurement *m) {
  const int32_t status = m->run ? HOOKE_OK : hk_options_create(&hk_run_options, &m->run);
  struct hk_check *check = m->object = status == HOOKE_OK ? hk_new(1, sizeof *check) : NULL;
  if (check == NULL) return HOOKE_NO_MEMORY;
  check->m = m;
  check->bound = hk_new(hooke_method_count(), sizeof *check->bound);
  if (check->bound == NULL) return HOOKE_NO_MEMORY;
  forget(check);
  return HOOKE_OK;
}

static void destroy(void *object) {
  struct hk_check *check = object;
  if (check == NULL) return;
  hk_claims_release(&check->warnings);
  hk_free(check->bound);
  hk_free(check);
}

/* ---- warnings ---- */

/* Of what a run still lacks, unless all of it is left to be given later. */
static void warn_of_lacks(struct hk_check *check, const char *method, double bound) {
  const int32_t step = hooke_method_is_adaptive(method) == 0 && !hooke_options_is_set(check->m->run, "step"),
                duration = !hooke_options_is_set(check->m->run, "duration");
  if (duration && !hooke_options_is_set(check->m->run, "method") &&
      !hooke_options_is_set(check->m->run, "step"))
    return;
  const char *before = duration ? "no duration and " : "";
  if (step && bound > 0.0 && isfinite(bound))
    hk_claim(&check->warnings, "no-step", HOOKE_OF_WHOLE, "bound",
             "the run has %sno step, which %s takes: it is certain to be stable up to %.6g s", before, method,
             bound);
  else if (step)
    hk_claim(&check->warnings, "no-step", HOOKE_OF_WHOLE, "run", "the run has %sno step, which %s takes",
             before, method);
  else if (duration)
    hk_claim(&check->warnings, "no-duration", HOOKE_OF_WHOLE, "run", "the run has no duration");
}

static void warn_of_method(struct hk_check *check, const char *method, double bound) {
  const double step = hooke_options_number(check->m->run, "step");
  if (!hooke_method_is_built(method))
    hk_claim(&check->warnings, "not-built", HOOKE_OF_WHOLE, "build",
             "%s, the method of the run, is not in this build of hooke", method);
  else if (bound == 0.0)
    hk_claim(&check->warnings, "never-stable", HOOKE_OF_WHOLE, "bound",
             "%s, the method of the run, is stable at no step: the scene has motion without damping, which "
             "it makes grow at any step",
             method);
  else if (step > bound)
    hk_claim(&check->warnings, "above-limit", HOOKE_OF_WHOLE, "bound",
             "the step of the run, %.6g s, is above %.6g s, up to which %s is certain to be stable", step,
             bound, method);
}

static void warn_of_coincident_springs(struct hk_check *check, const double *q) {
  const long long count = (long long)hooke_system_coincident_springs(check->m->system, q);
  if (count > 0)
    hk_claim(
        &check->warnings, "coincident-springs", HOOKE_OF_WHOLE, "scene",
        "%lld %s without a direction, and so without a force: both ends at the same place although the rest "
        "length is not zero, or a particle at the centre or on the axis of an obstacle",
        count, count == 1 ? "spring or contact starts" : "springs or contacts start");
}

/* Counts particles that no spring of any kind, no bending and no body holds. */
static int32_t warn_of_loose_particles(struct hk_check *check) {
  const hooke_system *system = check->m->system;
  long long count = 0, first = 0;
  uint8_t *held = hk_new(system->particle_count, sizeof *held);
  if (held == NULL) return HOOKE_NO_MEMORY;
  hk_system_mark_touched(system, held);
  for (int64_t p = system->particle_count - 1; p >= 0; p--) {
    if (held[p] || (system->bodies->of && system->bodies->of[p] >= 0)) continue;
    count++;
    first = (long long)p;
  }
  if (count == 1)
    hk_claim(&check->warnings, "loose", HOOKE_OF_WHOLE, "scene", "particle %lld has no spring", first);
  else if (count > 1)
    hk_claim(&check->warnings, "loose", HOOKE_OF_WHOLE, "scene",
             "%lld particles have no spring, the first of them particle %lld", count, first);
  hk_free(held);
  return HOOKE_OK;
}

static int32_t hear(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  (void)t, (void)limit, (void)spring, (void)particle;
  if (ctx) hk_claim(ctx, kind, HOOKE_OF_WHOLE, "scene", "%s", sentence);
  return 0;
}

static int32_t warn(struct hk_check *check, const double *q) {
  const char *method = hooke_options_text(check->m->run, "method");
  double bound = NAN;
  for (int64_t k = 0; k < hooke_method_count(); k++)
    if (strcmp(method, hooke_method_name(k)) == 0) bound = check->bound[k];
  warn_of_lacks(check, method, bound);
  warn_of_method(check, method, bound);
  warn_of_coincident_springs(check, q);
  hk_claim_callback(&check->warnings, check->m->system);
  hk_claim_contacts(&check->warnings, check->m->system, 0.0, q);
  int32_t status = warn_of_loose_particles(check);
  if (status == HOOKE_OK) status = hooke_system_warnings(check->m->system, hear, &check->warnings);
  return status == HOOKE_OK ? check->warnings.status : status;
}

/* ---- memory ---- */

/* Of the estimate of the error, whose other runs take that of the method after this one. */
static int32_t count_estimate(const struct hk_check *check, const hooke_integrator *integrator,
                              const hooke_state *state, int64_t *bytes) {
  hooke_measurement *estimate = NULL;
  int32_t status = hk_measurement_create(&hk_estimate_kind, NULL, check->m->system, NULL, NULL, &estimate);
  if (status == HOOKE_OK) status = hooke_estimate_begin(estimate, integrator, state);
  if (status == HOOKE_OK) *bytes = (int64_t)hooke_measurement_number(estimate, "estimate", 0, "memory_bytes");
  hooke_measurement_destroy(estimate);
  return status;
}

/* Of a run that observes warnings. */
static int32_t count_method(const struct hk_check *check, const hooke_state *state, int64_t *bytes,
                            int64_t *kept, int64_t *factor) {
  hooke_integrator *integrator = NULL;
  int32_t status = hooke_integrator_create(check->m->system, check->m->run, &integrator);
  if (status == HOOKE_OK) status = hooke_integrator_on_warning(integrator, hear, NULL);
  if (status == HOOKE_OK) *bytes = hooke_integrator_count(integrator, "memory_bytes");
  if (status == HOOKE_OK) *factor = hooke_integrator_count(integrator, "factor_bytes");
  if (*factor < 0) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && hooke_integrator_count(integrator, "frames") > 0)
    status = count_estimate(check, integrator, state, kept);
  hooke_integrator_destroy(integrator);
  return status;
}

/* Of output: the pages of libhdf5 and its buffers, and a queued frame, as measured on cloths [bytes]. */
enum { OUTPUT = 4800000, OUTPUT_OF_PARTICLE = 150 };

/* Leaves out a method that cannot run. */
static int32_t find_memory(struct hk_check *check, hooke_state *state) {
  const char *method = hooke_options_text(check->m->run, "method");
  const int32_t adaptive = hooke_method_is_adaptive(method);
  const int32_t can_run = !(adaptive >= 0 && !hooke_method_is_built(method)) &&
                          !(adaptive == 0 && !hooke_options_is_set(check->m->run, "step"));
  const int64_t model = hooke_system_count(check->m->system, "memory") +
                        (2 * hooke_state_size(state) + 1) * (int64_t)sizeof(double);
  const double *process = hooke_options_numbers(check->m->options, "process");
  int64_t of_method = 0, of_factor = 0, kept = 0;
  const int32_t status = can_run ? count_method(check, state, &of_method, &kept, &of_factor) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  const int64_t running = (process ? (int64_t)process[0] : model) + of_method + kept;
  check->most = process && process[1] > (double)running ? (int64_t)process[1] : running;
  check->written = check->most + OUTPUT + OUTPUT_OF_PARTICLE * check->m->system->particle_count;
  if (of_factor > 0) check->factor = running + of_factor > check->most ? running + of_factor : check->most;
  check->counted = model + of_method;
  return HOOKE_OK;
}

/* ---- running ---- */

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_check *check = m->object;
  forget(check);
  int32_t status = find_memory(check, state);
  hooke_system seen = *check->m->system;
  seen.explicit_damping = strcmp(hooke_options_text(check->m->run, "verlet_damping"), "explicit") == 0;
  if (status == HOOKE_OK)
    status =
        hk_step_bound_at(&seen, NULL, hooke_state_position(state), hooke_state_velocity(state), check->bound);
  return status == HOOKE_OK ? warn(check, hooke_state_position(state)) : status;
}

const struct hk_measurement_kind hk_check_kind = {.name = "check",
                                                  .options = &check_table,
                                                  .takes_state = 1,
                                                  .tables = hk_check_tables,
                                                  .claim = hk_check_claim,
                                                  .create = create,
                                                  .run = run,
                                                  .destroy = destroy};
