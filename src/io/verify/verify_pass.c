/* Repeats a slice of the run and compares its frames with those of the file. */
#include "io/verify/verify.h"

#include "core/clock.h"
#include "core/crc32.h"
#include "core/memory.h"
#include "core/number.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "integrate/loop/run_loop.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { ENOUGH = 77 }; /* return value of the observer at the end of the slice */

struct run {
  struct hk_verify *verify;
  struct hk_verify_pass *pass;
  hooke_state *stored;
  int64_t frame; /* next frame */
  double until;  /* wall-clock time; 0: no limit */
  int32_t status;
  char message[512]; /* status of the observer, since stopping a run has a message of its own */
};

/* Return value of an observer. */
static int32_t answer(struct run *run, int32_t go_on) {
  if (run->status == HOOKE_OK) return go_on;
  snprintf(run->message, sizeof run->message, "%s", hooke_last_error());
  return 1;
}

static int32_t differ(struct hk_verify *verify, int64_t frame, int64_t k, double stored, double computed) {
  const int64_t size = 3 * hooke_system_particle_count(verify->system), at = k % size;
  char there[HOOKE_NUMBER_SIZE], here[HOOKE_NUMBER_SIZE];
  hk_number_print(stored, there);
  hk_number_print(computed, here);
  return hk_fail(
      HOOKE_BAD_VALUE, NULL,
      "%s: is not what its scene gives: frame %lld, particle %lld, %s %c: %s is stored, %s is computed",
      verify->path, (long long)frame, (long long)(at / 3), k < size ? "position" : "velocity",
      (int)"xyz"[at % 3], there, here);
}

static void widen(const struct hk_verify *verify, const hooke_state *computed, const double *q,
                  const double *v, double distance[2]) {
  const int64_t size = 3 * hooke_system_particle_count(verify->system);
  const double *here[2] = {hooke_state_position(computed), hooke_state_velocity(computed)};
  for (int64_t k = 0; k < size; k++) {
    distance[0] = fmax(distance[0], fabs(q[k] - here[0][k]));
    distance[1] = fmax(distance[1], fabs(v[k] - here[1][k]));
  }
}

/* Compares to the bit. */
static int32_t compare(struct hk_verify *verify, int64_t frame, const hooke_state *computed,
                       const hooke_state *stored) {
  const int64_t size = 3 * hooke_system_particle_count(verify->system);
  const double time[2] = {hooke_state_time(stored), hooke_state_time(computed)};
  if (memcmp(&time[0], &time[1], sizeof time[0]) != 0)
    return hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "%s: is not what its scene gives: frame %lld: the time %.17g s is stored, %.17g s is computed",
        verify->path, (long long)frame, time[0], time[1]);
  for (int half = 0; half < 2; half++) {
    double *(*const numbers)(const hooke_state *state) = half ? hooke_state_velocity : hooke_state_position;
    const double *there = numbers(stored), *here = numbers(computed);
    for (int64_t k = 0; k < size; k++) {
      if (memcmp(&there[k], &here[k], sizeof(double)) != 0)
        return differ(verify, frame, half * size + k, there[k], here[k]);
    }
  }
  return HOOKE_OK;
}

static double check_of(const struct hk_verify *verify, const hooke_state *state) {
  const int64_t bytes = 3 * hooke_system_particle_count(verify->system) * (int64_t)sizeof(double);
  const uint32_t half = hk_crc32(0, hooke_state_position(state), bytes);
  return (double)hk_crc32(half, hooke_state_velocity(state), bytes);
}

/* Distance from the file, and of a refined pass from the first pass. */
static void measure(struct run *run, int64_t frame, const hooke_state *state) {
  const struct hk_verify *verify = run->verify;
  struct hk_verify_pass *pass = run->pass;
  const int64_t size = 3 * hooke_system_particle_count(verify->system);
  const double *q = hooke_state_position(run->stored), *v = hooke_state_velocity(run->stored);
  widen(verify, state, q, v, pass->apart);
  double *own = pass->own ? pass->own + 2 * size * (frame - verify->from) : NULL;
  if (own && !pass->refined) {
    memcpy(own, hooke_state_position(state), (size_t)size * sizeof(double));
    memcpy(own + size, hooke_state_velocity(state), (size_t)size * sizeof(double));
  }
  if (pass->refined) widen(verify, state, own ? own : q, own ? own + size : v, pass->error);
}

static int32_t take_frame(struct run *run, const hooke_state *state) {
  struct hk_verify *verify = run->verify;
  struct hk_verify_pass *pass = run->pass;
  const int64_t frame = run->frame++;
  run->status = hooke_record_read(verify->record, frame, run->stored);
  if (run->status == HOOKE_OK && !pass->refined && !verify->may_differ)
    run->status = compare(verify, frame, state, run->stored);
  if (run->status != HOOKE_OK) return answer(run, 1);
  measure(run, frame, state);
  if (frame == verify->from) return frame == verify->to ? ENOUGH : 0;
  /* with error control a frame lies between two steps */
  run->status = hk_balance_step(&pass->balance, state);
  if (run->status != HOOKE_OK) return answer(run, 1);
  hk_balance_close(&pass->balance, state);
  pass->residual[pass->count++] = pass->balance.residual;
  if (!pass->refined && run->until > 0.0 && hk_clock_seconds() > run->until) verify->to = frame;
  if (frame < verify->to) return 0;
  if (!pass->refined) verify->check_last = check_of(verify, run->stored);
  return ENOUGH;
}

/* The first state of a slice from the start arrives as a frame; the balance begins there. */
static int32_t see_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  (void)step;
  if (run->frame == run->verify->from && run->pass->balance.system == NULL)
    run->status = hk_balance_begin(&run->pass->balance, run->verify->system, state);
  return run->status != HOOKE_OK ? answer(run, 1) : take_frame(run, state);
}

static int32_t see_step(int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  const struct hk_verify *verify = run->verify;
  const double part = (double)(run->frame - verify->from) / (double)(verify->to - verify->from + 1);
  (void)step;
  run->status = hk_balance_step(&run->pass->balance, state);
  if (run->status == HOOKE_OK)
    run->status =
        hk_measurement_tell(verify->measurement, part, run->pass->refined ? "the balance" : "the slice");
  return answer(run, 0);
}

/* The options of the run, refined. The number of threads is that of the run. */
static int32_t options_for(const struct hk_verify *verify, int32_t refined, hooke_options **options) {
  int32_t status = hooke_options_copy(hooke_record_options(verify->record), options);
  if (status != HOOKE_OK || refined == 0) return status;
  if (verify->fixed)
    return hooke_options_set_number(*options, "step",
                                    ldexp(hooke_options_number(*options, "step"), -refined));
  const char *const tolerances[] = {"rtol", "atol", "atol_velocity"};
  for (int k = 0; k < 3 && status == HOOKE_OK; k++)
    status = hooke_options_set_number(*options, tolerances[k],
                                      hooke_options_number(*options, tolerances[k]) * pow(0.01, refined));
  return status;
}

static int32_t run_slice(struct run *run, hooke_integrator *integrator, hooke_state *state) {
  struct hk_verify *verify = run->verify;
  int32_t status = hooke_integrator_on_frame(integrator, see_frame, run);
  if (status == HOOKE_OK) status = hooke_integrator_on_step(integrator, 1, see_step, run);
  if (status != HOOKE_OK) return status;
  if (verify->from == 0) {
    status = hooke_state_copy(verify->first, state);
    if (status == HOOKE_OK) status = hk_run_whole(integrator, state);
  } else {
    status = hooke_record_read(verify->record, verify->from, state);
    if (status == HOOKE_OK) status = hk_balance_begin(&run->pass->balance, verify->system, state);
    run->frame++;
    if (status == HOOKE_OK) status = hk_integrator_run_on(integrator, verify->first, state);
  }
  run->pass->steps = (double)hooke_integrator_count(integrator, "steps");
  if (run->status != HOOKE_OK) return hk_fail(run->status, NULL, "%s", run->message);
  if (status == HOOKE_STOPPED && hooke_integrator_count(integrator, "stop_value") == ENOUGH) return HOOKE_OK;
  if (status == HOOKE_OK && run->frame > verify->to) return HOOKE_OK;
  if (status == HOOKE_OK)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: the run that its scene gives ends before frame %lld",
                   verify->path, (long long)run->frame);
  return status;
}

int32_t hk_verify_pass(struct hk_verify *verify, struct hk_verify_pass *pass) {
  struct run run = {.verify = verify, .pass = pass, .frame = verify->from};
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  pass->count = 0;
  pass->steps = NAN;
  pass->apart[0] = pass->apart[1] = pass->error[0] = pass->error[1] = 0.0;
  pass->balance = (struct hk_balance){.system = NULL};
  if (verify->by_budget && !pass->refined)
    run.until = hk_clock_seconds() + hooke_options_number(verify->options, "budget") / 4.0;
  int32_t status = hooke_state_create(verify->system, &state);
  if (status == HOOKE_OK) status = hooke_state_create(verify->system, &run.stored);
  pass->residual = hk_new(verify->to - verify->from + 1, sizeof(double));
  if (pass->residual == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = options_for(verify, pass->refined, &options);
  if (status == HOOKE_OK) status = hooke_integrator_create(verify->system, options, &integrator);
  if (status == HOOKE_OK) status = run_slice(&run, integrator, state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  hooke_state_destroy(run.stored);
  hooke_state_destroy(state);
  return status;
}

void hk_verify_pass_release(struct hk_verify_pass *pass) {
  hk_balance_release(&pass->balance);
  hk_free(pass->residual);
  pass->residual = NULL;
}

int32_t hk_verify_first(const struct hk_verify *verify) {
  struct hk_verify start = *verify;
  struct hk_verify_pass pass = {.refined = 0};
  start.from = start.to = 0;
  start.by_budget = start.may_differ = 0;
  start.first = NULL;
  int32_t status = hooke_state_create(verify->system, &start.first);
  if (status == HOOKE_OK) status = hk_verify_pass(&start, &pass);
  hk_verify_pass_release(&pass);
  hooke_state_destroy(start.first);
  return status;
}
