/* Running a slice again, and holding its frames against those of the file. */
#include "io/verify.h"

#include "core/clock.h"
#include "core/crc32.h"
#include "core/memory.h"
#include "core/number.h"
#include "core/status.h"
#include "integrate/integrator.h"

#include <math.h>
#include <string.h>

enum { ENOUGH = 77 }; /* what the observer returns at the end of the slice */

struct run {
  struct hooke_verify *verify;
  struct hooke_verify_pass *pass;
  hooke_state *stored;
  int64_t frame; /* the next */
  double until;  /* by the clock; 0: no limit */
  int32_t status;
};

static int32_t differ(struct hooke_verify *verify, int64_t frame, int64_t k, double stored, double computed) {
  const int64_t size = 3 * hooke_system_particle_count(verify->system), at = k % size;
  char there[HOOKE_NUMBER_SIZE], here[HOOKE_NUMBER_SIZE];
  hooke_number_print(stored, there);
  hooke_number_print(computed, here);
  return hooke_fail(
      HOOKE_BAD_VALUE, NULL,
      "%s: is not what its scene gives: frame %lld, particle %lld, %s %c: %s is stored, %s is computed",
      verify->path, (long long)frame, (long long)(at / 3), k < size ? "position" : "velocity",
      (int)"xyz"[at % 3], there, here);
}

/* To the bit, or only how far apart where bits may differ. */
static int32_t compare(struct hooke_verify *verify, int64_t frame, const hooke_state *computed,
                       const hooke_state *stored, int32_t bits, double *apart) {
  const int64_t size = 3 * hooke_system_particle_count(verify->system);
  const double *there = hooke_state_position((hooke_state *)stored),
               *here = hooke_state_position((hooke_state *)computed);
  for (int64_t k = 0; k < size; k++)
    *apart = fmax(*apart, fabs(there[k] - here[k]));
  if (!bits) return HOOKE_OK;
  const double time[2] = {hooke_state_time(stored), hooke_state_time(computed)};
  if (memcmp(&time[0], &time[1], sizeof time[0]) != 0)
    return hooke_fail(
        HOOKE_BAD_VALUE, NULL,
        "%s: is not what its scene gives: frame %lld: the time %.17g s is stored, %.17g s is computed",
        verify->path, (long long)frame, time[0], time[1]);
  for (int half = 0; half < 2; half++) {
    if (half == 1) {
      there = hooke_state_velocity((hooke_state *)stored);
      here = hooke_state_velocity((hooke_state *)computed);
    }
    if (memcmp(there, here, (size_t)size * sizeof(double)) == 0) continue;
    for (int64_t k = 0; k < size; k++) {
      if (memcmp(&there[k], &here[k], sizeof(double)) != 0)
        return differ(verify, frame, half * size + k, there[k], here[k]);
    }
  }
  return HOOKE_OK;
}

static double check_of(const struct hooke_verify *verify, const hooke_state *state) {
  const int64_t bytes = 3 * hooke_system_particle_count(verify->system) * (int64_t)sizeof(double);
  const uint32_t half = hooke_crc32(0, hooke_state_position((hooke_state *)state), bytes);
  return (double)hooke_crc32(half, hooke_state_velocity((hooke_state *)state), bytes);
}

static int32_t take_frame(struct run *run, const hooke_state *state) {
  struct hooke_verify *verify = run->verify;
  struct hooke_verify_pass *pass = run->pass;
  const int64_t frame = run->frame++;
  run->status = hooke_record_read(verify->record, frame, run->stored);
  if (run->status == HOOKE_OK)
    run->status =
        compare(verify, frame, state, run->stored, !pass->refined && !verify->may_differ, &pass->apart);
  if (run->status != HOOKE_OK) return 1;
  if (frame == verify->from) return frame == verify->to ? ENOUGH : 0;
  /* with error control a frame lies between two steps */
  run->status = hooke_balance_step(&pass->balance, state);
  if (run->status != HOOKE_OK) return 1;
  hooke_balance_close(&pass->balance, state);
  pass->residual[pass->count++] = pass->balance.residual;
  if (!pass->refined && run->until > 0.0 && hooke_clock_seconds() > run->until) verify->to = frame;
  if (frame < verify->to) return 0;
  if (!pass->refined) verify->check_last = check_of(verify, run->stored);
  return ENOUGH;
}

/* The first state of a slice from the start comes as a frame; the balance begins there. */
static int32_t see_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  (void)step;
  if (run->frame == run->verify->from && run->pass->balance.system == NULL)
    run->status = hooke_balance_begin(&run->pass->balance, run->verify->system, state);
  return run->status != HOOKE_OK ? 1 : take_frame(run, state);
}

static int32_t see_step(int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  const struct hooke_verify *verify = run->verify;
  const double part = (double)(run->frame - verify->from) / (double)(verify->to - verify->from + 1);
  (void)step;
  run->status = hooke_balance_step(&run->pass->balance, state);
  if (run->status == HOOKE_OK)
    run->status = hooke_verify_tell(verify, part, run->pass->refined ? "the balance" : "the slice");
  return run->status != HOOKE_OK;
}

/* The options of the run, refined. Threads are as many as it had. */
static int32_t options_for(const struct hooke_verify *verify, int32_t refined, hooke_options **options) {
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
  struct hooke_verify *verify = run->verify;
  int32_t status = hooke_integrator_on_frame(integrator, see_frame, run);
  if (status == HOOKE_OK) status = hooke_integrator_on_step(integrator, 1, see_step, run);
  if (status != HOOKE_OK) return status;
  if (verify->from == 0) {
    status = hooke_state_copy(verify->first, state);
    if (status == HOOKE_OK) status = hooke_integrator_run(integrator, state);
  } else {
    status = hooke_record_read(verify->record, verify->from, state);
    if (status == HOOKE_OK) status = hooke_balance_begin(&run->pass->balance, verify->system, state);
    run->frame++;
    if (status == HOOKE_OK) status = hooke_integrator_run_on(integrator, verify->first, state);
  }
  run->pass->steps = (double)hooke_integrator_count(integrator, "steps");
  if (run->status != HOOKE_OK) return run->status;
  if (status == HOOKE_STOPPED && hooke_integrator_stop_value(integrator) == ENOUGH) return HOOKE_OK;
  if (status == HOOKE_OK && run->frame > verify->to) return HOOKE_OK;
  if (status == HOOKE_OK)
    return hooke_fail(HOOKE_BAD_VALUE, NULL, "%s: the run that its scene gives ends before frame %lld",
                      verify->path, (long long)run->frame);
  return status;
}

int32_t hooke_verify_pass(struct hooke_verify *verify, struct hooke_verify_pass *pass) {
  struct run run = {.verify = verify, .pass = pass, .frame = verify->from};
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  pass->count = 0;
  pass->apart = 0.0;
  pass->balance = (struct hooke_balance){.system = NULL};
  if (verify->by_budget && !pass->refined)
    run.until = hooke_clock_seconds() + hooke_options_number(verify->options, "budget") / 4.0;
  int32_t status = hooke_state_create(verify->system, &state);
  if (status == HOOKE_OK) status = hooke_state_create(verify->system, &run.stored);
  pass->residual = hooke_new(verify->to - verify->from + 1, sizeof(double));
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

void hooke_verify_pass_release(struct hooke_verify_pass *pass) {
  hooke_balance_release(&pass->balance);
  hooke_free(pass->residual);
  pass->residual = NULL;
}

static int32_t see_first(int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  double apart = 0.0;
  (void)step;
  run->status = compare(run->verify, 0, state, run->verify->first, 1, &apart);
  return run->status == HOOKE_OK ? ENOUGH : 1;
}

int32_t hooke_verify_first(struct hooke_verify *verify) {
  struct run run = {.verify = verify};
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int32_t status = hooke_state_create(verify->system, &state);
  if (status == HOOKE_OK)
    status = hooke_integrator_create(verify->system, hooke_record_options(verify->record), &integrator);
  if (status == HOOKE_OK) status = hooke_integrator_on_frame(integrator, see_first, &run);
  if (status == HOOKE_OK) status = hooke_integrator_run(integrator, state);
  if (integrator && hooke_integrator_stop_value(integrator) == ENOUGH) status = HOOKE_OK;
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  return run.status != HOOKE_OK ? run.status : status;
}
