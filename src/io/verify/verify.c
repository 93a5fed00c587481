/* Checks that a trajectory reproduces from its scene: check values, bits, energy balance, error. */
#include "io/verify/verify.h"

#include "core/crc32.h"
#include "core/memory.h"
#include "core/status.h"
#include "integrate/method.h"
#include "io/trajectory/record.h"
#include "measure/limit/limit_predict.h"
#include "model/callbacks.h"
#include "model/particles.h"
#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Maximum number of refinements (halved step or tighter tolerances); the residual of the last one has to come
 * from the method, if a step is this fraction of the longest stable one. */
enum { MOST_REFINED = 4 };
static const double RESOLVED = 0.25, ESTIMATES = 4.0;

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("slice", HOOKE_OPTION_COUNTED(2, 2), NULL,
                 "what to run again, from and to; error-controlled methods are run from the start",
                 .unit = "s", .example = "0.1,0.2"),
    HOOKE_OPTION("all", .type = HOOKE_OPTION_FLAG, "false", "run all of it again"),
    HOOKE_OPTION("budget", HOOKE_OPTION_UP_TO("s", 1e9), "1",
                 "time to spend where neither is given: on a slice from the middle"),
    HOOKE_OPTION(
        "bits", .type = HOOKE_OPTION_FLAG, "false",
        "compare the bits alone, without balance of energy and estimate of the error, where they have to "
        "be the same"),
};

static const struct hk_option_table table = {"verification", HOOKE_OPTION_ROWS(rows)};

/* ---- creating ---- */

static int is_on(const struct hk_verify *verify, const char *name) {
  return hooke_options_number(verify->options, name) != 0.0;
}

static int32_t find_slice(struct hk_verify *verify) {
  const int64_t last = verify->record->good_count - 1;
  const double *slice = hooke_options_numbers(verify->options, "slice"), *time = verify->record->time;
  verify->by_budget = !slice && !is_on(verify, "all");
  verify->from = verify->by_budget ? last / 2 : 0;
  verify->to = last;
  while (slice && verify->from < last && time[verify->from + 1] <= slice[0])
    verify->from++;
  while (slice && verify->to > 0 && time[verify->to - 1] >= slice[1])
    verify->to--;
  if (verify->from >= verify->to && last > 0)
    return hk_fail(HOOKE_BAD_VALUE, "slice",
                   "no two frames are around %g to %g s; allowed: times from %g to %g s, ascending",
                   slice ? slice[0] : 0.0, slice ? slice[1] : 0.0, time[0], time[last]);
  if (!verify->fixed) verify->from = 0;
  return HOOKE_OK;
}

/* The bits of these methods depend on libraries, and through them on the processor. */
static int32_t find_makers(struct hk_verify *verify) {
  static const char *const facts[HOOKE_VERIFY_FACTS] = {"version",      "sundials", "cholmod",
                                                        "instructions", "machine",  "blas"};
  for (int k = 0; k < HOOKE_VERIFY_FACTS; k++) {
    verify->made_by[k] = hooke_record_text(verify->record, facts[k]);
    verify->here[k] = k == 0 ? hooke_version() : hooke_build_fact(facts[k]);
  }
  verify->here[HOOKE_VERIFY_FACTS - 1] = hk_blas_describe(verify->blas);
  const hooke_options *options = hooke_record_options(verify->record);
  const struct hk_method *method = hk_method_find(hooke_options_text(options, "method"));
  const int32_t factor = strcmp(hooke_options_text(options, "linear_solver"), "direct") == 0;
  if (verify->fixed && !(method->solved && factor)) return 0;
  for (int k = 1; k < HOOKE_VERIFY_FACTS - verify->fixed; k++) { /* whose factors call no BLAS */
    if (strcmp(verify->made_by[k], verify->here[k]) != 0) return 1;
  }
  return 0;
}

static int32_t open(struct hk_verify *verify) {
  int32_t status = hooke_record_open(verify->path, &verify->record);
  if (status == HOOKE_OK) status = hk_record_require_run(verify->record);
  if (status == HOOKE_OK && hooke_record_count(verify->record, "frames") == 0)
    status =
        hk_fail(HOOKE_BAD_VALUE, NULL, "%s: has no frames; allowed: a trajectory of one run", verify->path);
  if (status == HOOKE_OK && verify->system == NULL)
    status = hooke_scene_load(verify->path, verify->limits, &verify->scene);
  if (status == HOOKE_OK && verify->scene) status = hooke_scene_commit(verify->scene);
  if (status != HOOKE_OK) return status;
  const char *method = hooke_options_text(hooke_record_options(verify->record), "method");
  const char *text = hooke_record_text(verify->record, "scene");
  if (verify->scene) verify->system = hooke_scene_system(verify->scene);
  status = hk_callbacks_require(verify->system);
  if (status == HOOKE_OK) status = hk_force_check(verify->record->text + HOOKE_RECORD_FORCE, verify->system);
  if (status != HOOKE_OK) return hk_fail_before(status, "%s: ", verify->path);
  verify->fixed = hooke_method_is_adaptive(method) == 0;
  verify->check_scene = (double)hk_crc32(0, text, (int64_t)strlen(text));
  verify->may_differ = find_makers(verify);
  status = hooke_state_create(verify->system, &verify->first);
  return status == HOOKE_OK ? find_slice(verify) : status;
}

/* As before it runs. */
static void forget(struct hk_verify *verify) {
  verify->verdict = NULL;
  verify->parts = verify->record->is_covered ? "checked" : "not-covered";
  verify->balance = "not-checked";
  verify->difference[0] = '\0';
  verify->checked = 0;
  verify->time_from = verify->time_to = NAN;
  verify->steps = verify->limit = verify->energy_change = verify->work = verify->heat = verify->residual =
      NAN;
  verify->residual_refined = verify->bound = verify->error = verify->error_velocity = verify->check_last =
      NAN;
}

/* Takes the run options of the file. */
static int32_t create(hooke_measurement *m) {
  struct hk_verify *verify = m->object;
  verify->measurement = m;
  verify->options = m->options;
  int32_t status = open(verify);
  if (status == HOOKE_OK) forget(verify);
  verify->limits = NULL;
  if (status == HOOKE_OK) status = hooke_options_copy(hooke_record_options(verify->record), &m->run);
  m->system = verify->system;
  return status;
}

static void destroy(void *object) {
  struct hk_verify *verify = object;
  if (verify == NULL) return;
  hooke_state_destroy(verify->first);
  hooke_scene_destroy(verify->scene);
  hooke_record_close(verify->record);
  hk_free(verify->path);
  hk_free(verify);
}

static int32_t make(const char *path, const hooke_system *system, const hooke_options *options,
                    const hooke_options *limits, hooke_measurement **measurement) {
  *measurement = NULL;
  struct hk_verify *verify = hk_new(1, sizeof *verify);
  if (verify == NULL) return HOOKE_NO_MEMORY;
  verify->limits = limits;
  verify->system = system;
  verify->path = hk_copy_text(path);
  if (verify->path) return hk_measurement_create(&hk_verify_kind, verify, NULL, NULL, options, measurement);
  destroy(verify);
  return HOOKE_NO_MEMORY;
}

int32_t hooke_verify_create(const char *path, const hooke_options *options, const hooke_options *limits,
                            hooke_measurement **measurement) {
  return make(path, NULL, options, limits, measurement);
}

int32_t hooke_verify_create_with(const char *path, const hooke_system *system, const hooke_options *options,
                                 hooke_measurement **measurement) {
  *measurement = NULL;
  const int32_t status = hk_system_require_committed(system);
  return status == HOOKE_OK ? make(path, system, options, NULL, measurement) : status;
}

/* ---- running ---- */

static int32_t check_frames(struct hk_verify *verify) {
  const int64_t count = hooke_record_count(verify->record, "frames");
  int32_t status = hk_record_check_count(verify->record);
  for (verify->checked = 0; verify->checked < count && status == HOOKE_OK; verify->checked++) {
    status = hooke_record_check(verify->record, verify->checked);
    if (status == HOOKE_OK)
      status =
          hk_measurement_tell(verify->measurement, (double)verify->checked / (double)count, "check values");
    if (status != HOOKE_OK) break;
  }
  return status;
}

static void keep(struct hk_verify *verify, const struct hk_verify_pass *pass) {
  const struct hk_balance *balance = &pass->balance;
  verify->work = balance->work;
  verify->heat = balance->heat;
  verify->residual = pass->count > 0 ? pass->residual[pass->count - 1] : NAN;
  verify->energy_change = balance->residual + balance->work - balance->heat;
}

/* True if the step of a pass is short enough for its error to scale with a power of the step. */
static int is_resolved(const struct hk_verify *verify, const struct hk_verify_pass *pass) {
  const hooke_options *run = hooke_record_options(verify->record);
  double limit = NAN;
  if (hooke_system_group_count(verify->system, "altitude") > 0) return 0; /* their energy jumps */
  if (!verify->fixed) return fabs(pass->balance.residual) > 1e-6 * pass->balance.scale;
  const int32_t status = hk_limit_predict(verify->system, hooke_state_position(verify->first),
                                          hooke_state_velocity(verify->first),
                                          hk_method_of_euler(verify->system), 1e-2, NULL, NULL, &limit);
  return status == HOOKE_OK && ldexp(hooke_options_number(run, "step"), -pass->refined) <= RESOLVED * limit;
}

/* Refines until the residual of the balance scales like the error of the method. */
static int32_t find_balance(struct hk_verify *verify, struct hk_verify_pass *coarse) {
  int32_t status = HOOKE_OK, holds = 0;
  while (!holds && status == HOOKE_OK && coarse->refined < MOST_REFINED) {
    struct hk_verify_pass fine = {.refined = coarse->refined + 1, .own = coarse->own};
    status = hk_verify_pass(verify, &fine);
    if (status == HOOKE_OK && fine.count != coarse->count) status = HOOKE_DIVERGED;
    if (status == HOOKE_OK) {
      const double floor = fmax(hk_balance_floor(&coarse->balance), hk_balance_floor(&fine.balance));
      double largest, bound;
      holds = hk_balance_holds(fine.count, coarse->residual, fine.residual, floor, &largest, &bound);
      if (fine.refined == 1) {
        verify->error = 2.0 * fine.error[0];
        verify->error_velocity = 2.0 * fine.error[1];
        verify->residual_refined = fine.residual[fine.count - 1];
        verify->residual = largest;
        verify->bound = bound;
      }
      hk_verify_pass_release(coarse);
      *coarse = fine;
    } else {
      hk_verify_pass_release(&fine);
    }
  }
  verify->balance = holds ? "holds" : "unresolved";
  if (status > 0 && status != HOOKE_STOPPED) return HOOKE_OK; /* a refined run that does not finish */
  if (status == HOOKE_OK && !holds && is_resolved(verify, coarse)) {
    verify->balance = "does-not-hold";
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "%s: the balance of energy does not hold: %g J are "
                   "left over of %g J, and do not get less with the step",
                   verify->path, verify->residual, coarse->balance.scale);
  }
  return status;
}

static int32_t within_tolerance(struct hk_verify *verify, const double apart[2]) {
  verify->verdict = apart[0] == 0.0 && apart[1] == 0.0 ? "agrees" : "within-tolerance";
  if (strcmp(verify->verdict, "agrees") == 0 ||
      (apart[0] <= ESTIMATES * verify->error && apart[1] <= ESTIMATES * verify->error_velocity))
    return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "%s: is not what its scene gives: coordinates are up to %g m apart, "
                 "velocities %g m/s, and their errors about %g m and %g m/s; other "
                 "versions or another machine having made it explains %g times those",
                 verify->path, apart[0], apart[1], verify->error, verify->error_velocity, ESTIMATES);
}

static int32_t compare_slice(struct hk_verify *verify) {
  struct hk_verify_pass pass = {.refined = 0};
  if (verify->may_differ) {
    pass.own =
        hk_new(verify->to - verify->from + 1, (size_t)(6 * verify->system->particle_count) * sizeof(double));
    if (pass.own == NULL) return HOOKE_NO_MEMORY;
  }
  double *own = pass.own;
  int32_t status = hk_verify_pass(verify, &pass);
  const double apart[2] = {pass.apart[0], pass.apart[1]};
  verify->steps = pass.steps;
  const char *method = hooke_options_text(hooke_record_options(verify->record), "method");
  if (status == HOOKE_OK) {
    verify->verdict = "agrees";
    keep(verify, &pass);
    /* other failures leave the number unknown */
    if (hk_limit_predict(verify->system, hooke_state_position(verify->first),
                         hooke_state_velocity(verify->first), method, 1e-2, NULL, NULL,
                         &verify->limit) == HOOKE_NO_MEMORY)
      status = HOOKE_NO_MEMORY;
    if (status == HOOKE_OK && pass.count > 0 && (!is_on(verify, "bits") || verify->may_differ))
      status = find_balance(verify, &pass);
  } else if (status > 0 && status != HOOKE_STOPPED) {
    char why[256];
    snprintf(why, sizeof why, "%.255s", hk_fail_message());
    status = hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is not what its scene gives: %s", verify->path, why);
  }
  hk_verify_pass_release(&pass);
  hk_free(own);
  return status == HOOKE_OK && verify->may_differ ? within_tolerance(verify, apart) : status;
}

static int32_t run_all(struct hk_verify *verify) {
  int32_t status = check_frames(verify);
  if (status == HOOKE_OK) status = hooke_record_read(verify->record, 0, verify->first);
  if (status == HOOKE_OK) status = hk_verify_first(verify);
  if (status == HOOKE_OK) status = compare_slice(verify);
  /* of checked frames, as a damaged one may hold any numbers; the last one may be closer than it was */
  if (verify->from < verify->checked) verify->time_from = verify->record->time[verify->from];
  if (verify->to < verify->checked) verify->time_to = verify->record->time[verify->to];
  return status;
}

/* A file that does not reproduce is a failure, and the measurement has run all the same. */
static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_verify *verify = m->object;
  int32_t status = hk_measurement_require_fresh(m, state);
  if (status != HOOKE_OK) return status;
  forget(verify);
  status = run_all(verify);
  if (status == HOOKE_OK) return status;
  snprintf(verify->difference, sizeof verify->difference, "%s", hooke_last_error());
  verify->verdict = status == HOOKE_STOPPED ? "stopped" : status == HOOKE_BAD_VALUE ? "disagrees" : NULL;
  m->has_run = verify->verdict != NULL;
  m->outcome = status;
  return hk_measurement_claim(m) == HOOKE_OK ? status : HOOKE_NO_MEMORY;
}

const struct hk_measurement_kind hk_verify_kind = {.name = "verify",
                                                   .options = &table,
                                                   .made_by = "hooke_verify_create()",
                                                   .tables = hk_verify_tables,
                                                   .claim = hk_verify_claim,
                                                   .create = create,
                                                   .run = run,
                                                   .destroy = destroy};
