#include "measure/estimate/estimate.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "integrate/loop/run_loop.h"
#include "measure/counted_work/work.h"
#include "measure/limit/explicit_step.h"
#include "model/callbacks.h"
#include "model/generalized.h"

#include <math.h>
#include <stddef.h>

enum {
  KEPT = 100,
  MOST_KEPT = 1000,
  STEPS_APART = 4,
  MOST_SEEN = 128,
  MOST_REFINED = 4,
  LEAST_COMPARED = 25
};
static const double KEPT_BYTES = 1 << 26, FEW_BYTES = 1 << 22;
static const double BUDGET = 2.0;                        /* counted work for limits [s] */
static const double SLICE = 0.04, SLICE_ADAPTIVE = 0.03; /* of the duration, for a tenth of the time */
static const double AIM = 0.6, LEAST_GAIN = 0.7, LEAST_FACTOR = 1.0 / 16.0,
                    MOST_FACTOR = 0.7;             /* of refinement */
static const double SHORT = 2.0, MOST_RUNS = 10.0; /* most work of a refined run [s], or times the first */

static const struct hk_option_row rows[] = {
    HOOKE_OPTION(
        "want", HOOKE_OPTION_WANT, NULL,
        "error that no free particle may exceed at any frame; only estimates if not given" HOOKE_WANT_FORMS),
    HOOKE_OPTION("callbacks", .type = HOOKE_OPTION_FLAG, "false",
                 "repeats runs for the estimate even if they call callbacks of forces or drives"),
    HOOKE_OPTION(
        "watch", .type = HOOKE_OPTION_TEXT, NULL,
        "quantities whose value at the end is told, and whose smallest and largest: " HOOKE_WATCHED_FORMS),
    HOOKE_OPTION("error", .type = HOOKE_OPTION_FLAG, "true",
                 "estimates the error of the run; if not, there is what is watched alone"),
};

static const struct hk_option_table options = {"estimate", HOOKE_OPTION_ROWS(rows)};

static void clear(struct hk_estimate *e) {
  e->rms = e->known_until = e->last_error = e->last_from = NAN;
  for (int32_t n = 0; n < HOOKE_ERRORS; n++)
    e->error[n] = e->order[n] = NAN;
  e->by = NULL;
  e->reason[0] = '\0';
}

static int32_t create(hooke_measurement *m) {
  struct hk_estimate *e = m->object = hk_new(1, sizeof *e);
  if (e == NULL) return HOOKE_NO_MEMORY;
  e->measurement = m;
  e->system = m->system;
  e->callbacks = hooke_options_number(m->options, "callbacks") != 0.0;
  e->only_watches = hooke_options_number(m->options, "error") == 0.0;
  e->watched.system = m->system;
  e->first = e->rise = e->heat_excess = NAN;
  clear(e);
  const char *watch = hooke_options_text(m->options, "watch");
  const int32_t status = watch[0] ? hk_watched_read(&e->watched, "watch", watch) : HOOKE_OK;
  return status == HOOKE_OK ? hk_wants_read(&e->wants, &e->watched, m->options) : status;
}

static void forget_run(struct hk_estimate *e) {
  hooke_options_destroy(e->options);
  hk_frames_release(&e->kept);
  hk_watched_run_release(&e->course);
  hk_soundness_release(&e->soundness);
  hooke_state_destroy(e->start);
  hooke_state_destroy(e->late);
  e->options = NULL;
  e->start = e->late = NULL;
  e->rise = e->heat_excess = NAN;
  clear(e);
}

static void destroy(void *object) {
  struct hk_estimate *e = object;
  if (e == NULL) return;
  forget_run(e);
  hk_pick_release(&e->pick);
  hk_watched_release(&e->watched);
  hk_free(e);
}

/* ---- picking ---- */

/* Picks for what is wanted of the whole run, and sets the result in `run`. */
static int32_t pick(struct hk_estimate *e, hooke_options *run) {
  hk_pick_release(&e->pick);
  const double begun = hk_clock_seconds();
  int32_t status = hk_pick_run(&e->pick, e->system, run, &e->wants, e->wants.most, INFINITY, e->only != NULL,
                               &e->only, e->measurement->progress, e->measurement->progress_ctx);
  e->spent += hk_clock_seconds() - begun;
  if (status == HOOKE_OK && e->pick.best.method == NULL)
    status = hk_fail(HOOKE_UNSUITED, "method", "%s has no step that is stable here%s", e->only,
                     e->wants.list ? ", or its frames do not tell what is wanted" : "");
  if (status == HOOKE_OK) status = hk_trial_set_value(run, e->pick.best.method, e->pick.best.value);
  if (status == HOOKE_OK) status = hooke_step_settle(e->system, run);
  hk_pick_say_reversal(&e->pick, e->reversal, sizeof e->reversal);
  if (status != HOOKE_OK) hk_pick_release(&e->pick);
  e->picked = status == HOOKE_OK;
  return status;
}

int32_t hooke_estimate_pick(hooke_measurement *m, const char *method, hooke_options *run) {
  struct hk_estimate *e = m->object;
  int32_t status = hk_measurement_require(m, &hk_estimate_kind, "hooke_estimate_pick");
  const struct hk_method *only = NULL;
  if (status == HOOKE_OK) status = hk_run_options_require(run, "run");
  if (status != HOOKE_OK) return status;
  if (e->wants.count == 0) return hk_fail(HOOKE_BAD_CALL, NULL, "no error is wanted of this estimate");
  if (method && (status = hk_method_take(method, &only)) != HOOKE_OK) return status;
  e->only = only ? only->name : NULL;
  e->refined = 0;
  e->first = NAN;
  e->before = INFINITY;
  return pick(e, run);
}

/* ---- watching the run ---- */

/* Frames kept for the comparison with other runs: evenly spaced, and the end; as many as memory allows, and
 * more of small scenes, where those fit longer steps. */
static void choose_kept(struct hk_estimate *e, const hooke_integrator *it, int64_t *count) {
  const double intervals = (double)(it->schedule.frames - 1);
  const double steps = it->method->adaptive ? INFINITY : (double)it->schedule.steps;
  const double bytes = (double)(3 * hooke_system_particle_count(e->system) + 1) * sizeof(double);
  const double longer = e->wants.whole ? INFINITY : steps / STEPS_APART; /* a period needs all */
  const double many = fmin(fmin(MOST_KEPT, FEW_BYTES / bytes), longer);
  const double apart = ceil(intervals / fmax(1.0, fmax(many, fmin(KEPT, KEPT_BYTES / bytes))));
  e->apart = fmin(apart * e->every, e->duration);
  *count = hk_schedule_frames(e->duration, e->apart);
}

static int is_whole_reference(const struct hk_estimate *e) {
  return e->pick.fraction == 1.0;
}

/* No limit is needed: the method has none, nothing is wanted, or the pick examined the same frames. */
static int is_checked(const struct hk_estimate *e, const hooke_integrator *it) {
  return it->method->adaptive || e->wants.count == 0 || (e->picked && is_whole_reference(e));
}

static int32_t refuse_system(void) {
  return hk_fail(HOOKE_BAD_VALUE, "integrator", "is not one of the system that the estimate is for");
}

int32_t hooke_estimate_begin(hooke_measurement *m, const hooke_integrator *it, const hooke_state *state) {
  struct hk_estimate *e = m->object;
  int32_t status = hk_measurement_require(m, &hk_estimate_kind, "hooke_estimate_begin");
  if (status != HOOKE_OK) return status;
  if (it->system != e->system) return refuse_system();
  status = hk_run_check_whole(it, state);
  if (status != HOOKE_OK) return status;
  forget_run(e);
  status = hooke_options_copy(it->options, &e->options);
  if (status != HOOKE_OK) return status;
  int64_t count;
  const int64_t frames = hooke_integrator_count(it, "frames");
  e->integrator = it;
  e->work = e->steps = 0.0;
  e->resumed = it->phase == HOOKE_AT_CHECKPOINT;
  e->begin = hooke_state_time(state);
  e->duration = it->schedule.duration;
  e->every = it->schedule.every;
  e->frames = frames;
  e->frames_apart = 1 + (frames - 1) / MOST_SEEN;
  e->frames_seen = 0;
  e->late_after = e->begin + e->duration * (1.0 - (it->method->adaptive ? SLICE_ADAPTIVE : SLICE));
  status = hk_watched_run_begin(&e->watched, frames, &e->course);
  if (status != HOOKE_OK || e->only_watches) return status;
  choose_kept(e, it, &count);
  status = hk_frames_create(e->system, count, &e->kept);
  if (status == HOOKE_OK) status = hk_frames_watch(&e->kept, e->wants.list, &e->wants);
  if (status == HOOKE_OK) status = hooke_state_create(e->system, &e->start);
  if (status == HOOKE_OK) status = hooke_state_create(e->system, &e->late);
  if (status != HOOKE_OK) return status;
  hooke_state_copy(state, e->start);
  return hk_soundness_begin(&e->soundness, e->system, hk_step_limited_as(e->system, it->options),
                            is_checked(e, it) ? NAN : it->schedule.step, state, MOST_SEEN + 2);
}

/* States between frames may be shown, too, and were not checked. A run that goes on has the frames of the one
 * before. */
static int32_t is_frame(const struct hk_estimate *e, const hooke_state *state) {
  const double since = hooke_state_time(state) - e->integrator->t0, frame = since / e->every;
  return fabs(frame - round(frame)) <= 1e-9 * fmax(1.0, frame) ||
         fabs(since - e->duration) <= 1e-9 * e->duration;
}

static void keep(struct hk_estimate *e, const hooke_state *state) {
  const double t = hooke_state_time(state) - e->begin;
  if (fabs(t - (double)e->kept.recorded * e->apart) <= 1e-9 * e->duration) hk_frames_record(&e->kept, state);
  if (!(t + e->begin >= e->late_after) || t >= e->duration * (1.0 - 1e-9)) return;
  hooke_state_copy(state, e->late);
  e->late_after = NAN;
}

static int32_t see_motion(int64_t step, const hooke_state *state, void *estimate) {
  struct hk_estimate *e = ((const hooke_measurement *)estimate)->object;
  (void)step;
  e->course.follows = 1;
  hk_watched_run_see(&e->course, hooke_state_time(state), hooke_state_position(state),
                     hooke_state_velocity(state));
  return 0;
}

int32_t hooke_estimate_follow(hooke_measurement *m, hooke_integrator *it) {
  if (m == NULL) return hk_integrator_on_motion(it, NULL, NULL);
  const int32_t status = hk_measurement_require(m, &hk_estimate_kind, "hooke_estimate_follow");
  if (status != HOOKE_OK) return status;
  const struct hk_estimate *e = m->object;
  if (it->system != e->system) return refuse_system();
  return e->watched.count > 0 ? hk_integrator_on_motion(it, see_motion, m) : HOOKE_OK;
}

int32_t hooke_estimate_see(int64_t step, const hooke_state *state, void *estimate) {
  const hooke_measurement *m = estimate;
  struct hk_estimate *e = m->object;
  (void)step;
  if (m->kind != &hk_estimate_kind || e->options == NULL) return 0;
  const int32_t status = hk_state_check_system(state, e->system);
  if (status != HOOKE_OK) return status;
  if (is_frame(e, state))
    hk_watched_run_keep(&e->course, hooke_state_time(state), hooke_state_position(state),
                        hooke_state_velocity(state));
  if (e->only_watches) return 0;
  e->work = hk_work_of(e->integrator);
  e->steps = (double)e->integrator->count.steps;
  keep(e, state);
  const double frame = (hooke_state_time(state) - e->begin) / e->every;
  if (frame >= (double)e->frames_seen * (1.0 - 1e-12)) {
    hk_soundness_see(&e->soundness, state);
    e->frames_seen += e->frames_apart;
  }
  return 0;
}

/* ---- measuring ---- */

/* 1 if nobody can know that the want is met. */
static int is_out_of_reach(const struct hk_estimate *e) {
  return is_whole_reference(e) && !(e->pick.reference.wanted_agreement < e->wants.most);
}

/* Distances of the kept frames from trusted ones of the reference at the same times; returns how many there
 * are. */
static int64_t compare(const struct hk_estimate *e, struct hk_distance *from) {
  const struct hk_reference *r = &e->pick.reference;
  const double *time = r->frames.time, *kept = e->kept.time, near = 1e-9 * e->duration;
  int64_t count = 0;
  *from = (struct hk_distance){.rms = 0.0};
  for (int64_t f = 0, k = 0; f < e->kept.recorded; f++) {
    double far;
    while (k < r->trusted && time[k] - time[0] < kept[f] - kept[0] - near)
      k++;
    if (k == r->trusted) break;
    if (time[k] - time[0] > kept[f] - kept[0] + near) continue;
    from->rms = fmax(from->rms, hk_frames_distance(&r->frames, k, e->kept.position + f * e->kept.size, &far));
    hk_wants_spread(&e->wants, &e->kept.watched, f, &r->frames.watched, k, far, from->of);
    count++;
  }
  if (r->trusted < r->frames.count) hk_wants_forget_periods(&e->wants, from->of);
  return count;
}

static double agreement(const struct hk_estimate *e, int32_t n) {
  const struct hk_reference *r = &e->pick.reference;
  if (n == 0) return r->agreement;
  const double wanted = r->wanted_agreement * (e->bound[n - 1] / e->wants.most);
  return hk_want_is_place(&e->wants, n - 1) ? fmin(wanted, r->agreement) : wanted;
}

/* The want that is the farthest off, and by how many times what is wanted. */
static int32_t find_worst(const struct hk_estimate *e, double *most) {
  int32_t worst = 0;
  *most = 0.0;
  for (int32_t k = 0; k < e->wants.count; k++) {
    if (!(e->error[1 + k] / e->bound[k] > *most)) continue;
    *most = e->error[1 + k] / e->bound[k];
    worst = k;
  }
  return worst;
}

/* The pick saw other frames, and a displaced start: its error is that of the want that is the farthest off.
 */
static void raise_worst(struct hk_estimate *e, double error) {
  double most;
  const int32_t k = find_worst(e, &most);
  error *= e->bound[k] / e->wants.most;
  if (error > e->error[1 + k]) e->error[1 + k] = error;
  if (e->wants.want[k].width == 0) e->error[0] = fmax(e->error[0], e->error[1 + k]);
}

/* The picked run was compared with the reference at frames of the pick; 0 of another one that has few of
 * them. */
static int measure_by_reference(struct hk_estimate *e) {
  const struct hk_reference *r = &e->pick.reference;
  struct hk_distance from;
  const int64_t count = compare(e, &from);
  if (!e->picked && count < LEAST_COMPARED && count < e->kept.recorded) return 0;
  if (r->trusted > 1) {
    e->compared = count;
    for (int32_t n = 0; n <= e->wants.count; n++)
      hk_estimate_know(e, n, from.of[n] + agreement(e, n));
    if (e->picked) raise_worst(e, e->pick.best.error + r->wanted_agreement);
    if (e->picked) from.rms = fmax(from.rms, e->pick.best.rms);
    e->rms = fmin(e->error[0], from.rms + r->agreement);
    e->known_until = e->begin + hk_pick_trusted(&e->pick);
    e->by = "reference";
  }
  if (is_out_of_reach(e))
    hk_print(e->reason, sizeof e->reason, "the reference itself is known to %.3g%s alone",
             r->wanted_agreement, hk_wants_unit(&e->wants, e->system));
  if (r->trusted == r->frames.count) return 1;
  hk_print(e->reason, sizeof e->reason,
           "after %.6g s two references part by more than a fiftieth of the wanted error%s",
           e->begin + hk_pick_trusted(&e->pick),
           r->hurried ? ", for want of time"
                      : ", whatever their tolerance: the motion is chaotic, or rounding parts them");
  return 1;
}

static int32_t came_to_its_end(const struct hk_estimate *e, const hooke_state *state) {
  return fabs(hooke_state_time(state) - (e->begin + e->duration)) <= 1e-9 * e->duration;
}

/* Why nothing is run again; NULL: it is. */
static const char *find_obstacle(const struct hk_estimate *e, const hooke_state *state) {
  if (e->resumed) return "the run was continued, and how wrong it was before is not known here";
  if (!came_to_its_end(e, state) || e->kept.recorded < e->kept.count)
    return "the run did not come to its end";
  const int32_t calls = hk_system_calls_back(e->system);
  const int32_t unknown = hk_force_from(e->system) ? calls & HOOKE_CALLS_DRIVE : calls;
  return unknown && !e->callbacks ? "a callback takes part" : NULL;
}

static int32_t measure_again(struct hk_estimate *e) {
  if (is_whole_reference(e) && measure_by_reference(e)) return HOOKE_OK;
  int32_t status = hk_estimate_by_runs(e);
  if (status == HOOKE_OK && !isnan(e->error[0])) status = hk_estimate_by_other_method(e);
  /* a pick from the beginning alone: its error is over more frames */
  if (e->picked && e->pick.met) raise_worst(e, e->pick.best.error);
  if (status == HOOKE_OK && isnan(e->error[0])) status = hk_estimate_last_slice(e);
  return status;
}

static void explain_want(struct hk_estimate *e) {
  if (e->wants.count > 0 && !hk_soundness_holds(&e->soundness))
    hk_print(e->reason, sizeof e->reason,
             isinf(e->soundness.least_limit) ? "its energy grows by itself"
                                             : "its step is above 0.9 of the stable one");
  else if (e->soundness.unknown_limit && !e->reason[0])
    hk_print(e->reason, sizeof e->reason, "the stable step of its rigid bodies is not known at all times");
}

static void forget_overflow(struct hk_estimate *e) {
  if (!isinf(e->error[0] + e->rms)) return;
  clear(e);
  hk_print(e->reason, sizeof e->reason, "distances are beyond the range of numbers");
}

static void give_up(struct hk_estimate *e, int32_t status) {
  clear(e);
  hk_print(e->reason, sizeof e->reason,
           status == HOOKE_STOPPED ? "interrupted" : "memory was too short to find it out");
}

static int32_t measure(struct hk_estimate *e, const hooke_state *state) {
  if (e->kept.recorded == e->kept.count - 1) hk_frames_record(&e->kept, state);
  e->rise = hk_soundness_rise(&e->soundness);
  struct hk_budget budget = hk_budget_of_work(BUDGET, NULL, NULL);
  int32_t status = came_to_its_end(e, state) ? hk_soundness_find_limits(&e->soundness, &budget) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  if (isnan(e->first)) e->first = e->work;
  const char *obstacle = find_obstacle(e, state);
  if (obstacle) {
    hk_print(e->reason, sizeof e->reason, "%s", obstacle);
    return HOOKE_OK;
  }
  const double begun = hk_clock_seconds();
  hk_wants_bounds(&e->wants, &e->kept.watched, e->kept.recorded, e->bound);
  status = measure_again(e);
  forget_overflow(e);
  if (status == HOOKE_OK)
    status = hk_estimate_heat(e);
  else
    give_up(e, status);
  e->spent += hk_clock_seconds() - begun;
  if (status == HOOKE_OK) explain_want(e);
  return status;
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_estimate *e = m->object;
  if (state == NULL)
    return hk_fail(HOOKE_BAD_VALUE, "state", "is missing; an estimate needs the last one of the run");
  const int32_t status = hk_state_check_system(state, m->system);
  if (status != HOOKE_OK) return status;
  if (e->options == NULL)
    return hk_fail(HOOKE_BAD_CALL, NULL, "the estimate was not there when the run began");
  hk_watched_run_end(&e->course, hooke_state_time(state), hooke_state_position(state),
                     hooke_state_velocity(state));
  return e->only_watches ? HOOKE_OK : measure(e, state);
}

/* ---- refining ---- */

int32_t hk_estimate_knows_all(const struct hk_estimate *e) {
  return e->known_until >= e->begin + e->duration * (1.0 - 1e-9);
}

int32_t hk_estimate_saw_all(const struct hk_estimate *e) {
  const double near = 1e-9 * e->duration;
  return !e->resumed && e->course.follows && fabs(e->course.from - e->begin) <= near &&
         fabs(e->course.until - e->begin - e->duration) <= near;
}

double hk_estimate_meets(const struct hk_estimate *e, int32_t want) {
  const double error = e->error[1 + want], bound = e->bound[want];
  if (is_out_of_reach(e) && error - 2.0 * agreement(e, 1 + want) <= bound) return NAN;
  if (error > bound || (!isnan(error) && !hk_soundness_holds(&e->soundness))) return 0.0;
  if (e->soundness.unknown_limit) return NAN;
  return error <= bound && hk_estimate_knows_all(e) ? 1.0 : NAN;
}

double hk_estimate_met(const struct hk_estimate *e) {
  double met = e->wants.count > 0 ? 1.0 : NAN;
  for (int32_t k = 0; k < e->wants.count && met != 0.0; k++)
    if (hk_estimate_meets(e, k) != 1.0) met = hk_estimate_meets(e, k);
  return met;
}

/* Next finer step or tolerance of the same method. */
static double finer(const struct hk_estimate *e) {
  double most;
  const double value = hk_estimate_value(e->options), seen = e->order[1 + find_worst(e, &most)];
  double factor = pow(AIM / most, 1.0 / (isnan(seen) ? 1.0 : seen));
  factor = fmin(MOST_FACTOR, fmax(LEAST_FACTOR, factor));
  return fmin(value * factor, hk_soundness_limit_share * e->soundness.least_limit);
}

static int32_t set_finer(struct hk_estimate *e, hooke_options *run) {
  const char *method = hooke_options_text(e->options, "method");
  double value = finer(e), unit;
  if (hooke_method_is_adaptive(method)) return hk_trial_set_value(run, method, value);
  const int32_t status = hk_step_unit(e->duration, e->every, &unit);
  if (status != HOOKE_OK) return status;
  value = unit / ceil(unit / value * (1.0 - 1e-12));
  const double work = e->work * hk_estimate_value(e->options) / value;
  if (work > fmax(SHORT, MOST_RUNS * e->first))
    return hk_fail(HOOKE_UNSUITED, NULL, "a step of %g s would take about %.3g s", value, work);
  return hk_trial_set_value(run, method, value);
}

int32_t hooke_estimate_refine(hooke_measurement *m, hooke_options *run) {
  struct hk_estimate *e = m->object;
  int32_t status = hk_measurement_require(m, &hk_estimate_kind, "hooke_estimate_refine");
  if (status != HOOKE_OK) return status;
  double most;
  (void)find_worst(e, &most);
  const int32_t known = e->options != NULL && !is_out_of_reach(e) && !isnan(hk_estimate_met(e)) &&
                        most <= LEAST_GAIN * e->before;
  if (!known || e->refined == MOST_REFINED)
    return hk_fail(HOOKE_UNSUITED, NULL, "nothing finer is known to help: %s", e->reason);
  status = set_finer(e, run);
  e->refined++;
  e->before = most;
  e->picked = 0;
  return status;
}

const struct hk_measurement_kind hk_estimate_kind = {.name = "estimate",
                                                     .takes_problems = 1,
                                                     .options = &options,
                                                     .tables = hk_estimate_tables,
                                                     .claim = hk_estimate_claim,
                                                     .create = create,
                                                     .run = run,
                                                     .destroy = destroy};
