/* The recommendation: what 'run --want' picks (measure/recommend), held against the reference of the study,
 * and its margin. */
#include "measure/study/study.h"

#include "core/clock.h"
#include "core/print.h"
#include "core/status.h"
#include "measure/limit/explicit_step.h"
#include "measure/limit/limit_predict.h"
#include "measure/recommend/pick.h"
#include "measure/trial/side_by_side.h"
#include "model/generalized.h"
#include "model/particles.h"
#include "model/variant/variant.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

enum { MOST_PICKS = 3 };
static const double AIM = 0.6; /* of the want, where a pick of the beginning was too coarse for the run */

/* ---- the margin: the fraction of the stable limit, and whether the wanted error is met with slightly
 * changed stiffness or start, each judged against a reference of its own ---- */

/* Stiffness is multiplied by 1 + or - this; all free particles get this fraction of the largest speed of the
 * reference (root mean square between two frames) added along (1, 1, 1) and against it. */
static const double CHANGE = 0.1;
static const double RUNS = 2.0;      /* counted work of all, over that of the study's reference */
static const double WORK = 1.0;      /* and at least so much [s] */
static const double ACCURACY = 1e-3; /* of the limit, relative */

static int32_t tell_limit(double done, const char *what, void *study) {
  (void)what;
  return hk_stage_tell(done, &((struct hk_study *)study)->stage);
}

static int32_t find_limit_share(struct hk_study *study, struct hk_study_recommendation *r) {
  hooke_state *state = NULL;
  hooke_options *options = NULL;
  double limit = NAN;
  if (hk_study_is_adaptive(study, r->method)) return HOOKE_OK;
  int32_t status = hk_study_row_options(study, r->method, r->value, &options);
  if (status == HOOKE_OK) status = hooke_step_settle(study->m->system, options);
  if (status == HOOKE_OK) status = hooke_state_create(study->m->system, &state);
  if (status == HOOKE_OK)
    status =
        hk_limit_predict(study->m->system, hooke_state_position(state), hooke_state_velocity(state),
                         hk_step_limited_as(study->m->system, options), ACCURACY, tell_limit, study, &limit);
  hooke_options_destroy(options);
  hooke_state_destroy(state);
  if (status == HOOKE_NO_MEMORY || status == HOOKE_STOPPED) return status;
  if (status == HOOKE_OK) r->margin.limit_share = r->value / limit;
  return HOOKE_OK;
}

/* Largest root mean square speed between two frames of the reference [m/s]. */
static double largest_speed(const struct hk_frames *frames) {
  double largest = 0.0, unused;
  for (int64_t f = 1; f < frames->recorded; f++) {
    const double *before = frames->position + (f - 1) * frames->size;
    const double way = hk_frames_distance(frames, f, before, &unused);
    largest = fmax(largest, way / (frames->time[f] - frames->time[f - 1]));
  }
  return largest;
}

/* 1, 0 or NaN, from a trial against a reference that is known to its agreement. */
static double judge(const struct hk_study *study, const struct hk_reference *r,
                    const struct hk_trial *trial) {
  const double want = study->recommendation.want, error = trial->wanted;
  if (strcmp(trial->status, "finished") != 0) return 0.0;
  if (r->trusted < 2 || error - r->wanted_agreement > want) return r->trusted < 2 ? NAN : 0.0;
  return r->trusted >= study->reference.trusted && error + r->wanted_agreement <= want ? 1.0 : NAN;
}

enum { CHANGED = 2 * HOOKE_STUDY_CHANGES }; /* each in both directions */

/* What is found with changed systems. */
struct margins {
  struct hk_study *study;
  double work; /* that each may take, counted [s] */
  double holds[CHANGED], error[CHANGED];
};

/* The recommended run on a slightly changed system; NaN if the work was too little for it or its reference.
 */
static int32_t try_change(const struct hk_study *study, const hooke_system *changed, double work,
                          struct hk_turn *turn, double *holds, double *error) {
  const struct hk_study_recommendation *best = &study->recommendation;
  const struct hk_listener listener = {
      .on_progress = hk_turn_tell, .most_work = work, .serial = turn->serial, .ctx = turn};
  struct hk_watched_list list = study->watched;
  struct hk_wants wants = study->wants;
  const struct hk_reference_request request = {.run = study->m->run,
                                               .frame_count = study->reference.frames.count,
                                               .digits = best->want * wants.length / 10.0,
                                               .wants = &wants,
                                               .watched = &list,
                                               .enough = 1,
                                               .counted = 1,
                                               .budget = work,
                                               .alike = &study->reference,
                                               .listener = &listener};
  struct hk_reference reference;
  struct hk_trial trial = {.status = NULL};
  hooke_options *options = NULL;
  list.system = changed; /* which has the same numbers and names */
  if (wants.list) wants.list = &list;
  int32_t status = hk_reference_create(changed, &request, &reference);
  if (status != HOOKE_OK) return status == HOOKE_NO_MEMORY || status == HOOKE_STOPPED ? status : HOOKE_OK;
  const int64_t judged = (int64_t)fmin((double)reference.trusted, (double)study->reference.trusted);
  status = hk_study_row_options(study, best->method, best->value, &options);
  if (status == HOOKE_OK) status = hk_trial_run(&trial, &reference.frames, judged, options, &listener);
  if (status == HOOKE_OK && strcmp(trial.status, "stopped") != 0) {
    *holds = judge(study, &reference, &trial);
    *error = trial.wanted;
  }
  hk_trial_release(&trial);
  hooke_options_destroy(options);
  hk_reference_release(&reference);
  return status;
}

static int32_t make_changed(const struct hk_study *study, enum hk_study_change change, double sign,
                            hooke_system **made) {
  struct hk_variant variant;
  struct hk_variant_map map;
  int32_t status = hk_variant_create(study->m->system, &variant);
  if (status != HOOKE_OK) return status;
  if (change == HOOKE_STUDY_STIFFNESS) {
    for (int64_t g = 0; g < study->m->system->group_count; g++)
      variant.factor[HOOKE_KAPPA][g] = 1.0 + sign * CHANGE;
  } else {
    const double speed = CHANGE * largest_speed(&study->reference.frames);
    for (int a = 0; a < 3; a++)
      variant.velocity[a] = sign * speed / sqrt(3.0);
  }
  status = hk_variant_make(study->m->system, &variant, made, &map);
  if (status == HOOKE_OK) hk_variant_map_release(&map);
  hk_variant_release(&variant);
  return status;
}

static int32_t find_changed(struct hk_turn *turn, void *ctx) {
  struct margins *margins = ctx;
  const enum hk_study_change change = (enum hk_study_change)(turn->number / 2);
  const int64_t k = turn->number;
  hooke_system *changed = NULL;
  int32_t status = make_changed(margins->study, change, k % 2 ? -1.0 : 1.0, &changed);
  if (status == HOOKE_OK)
    status = try_change(margins->study, changed, margins->work, turn, &margins->holds[k], &margins->error[k]);
  hooke_system_destroy(changed);
  return status == HOOKE_UNSUITED || status == HOOKE_BAD_VALUE ? HOOKE_OK : status;
}

/* The want is met with a change if it is met in both directions. */
static void keep_change(const struct margins *margins, enum hk_study_change change) {
  struct hk_study_margin *margin = &margins->study->recommendation.margin;
  const double *holds = margins->holds + 2 * change, *error = margins->error + 2 * change;
  if (holds[0] == 0.0 || holds[1] == 0.0)
    margin->holds[change] = 0.0;
  else
    margin->holds[change] = holds[0] + holds[1] == 2.0 ? 1.0 : NAN;
  margin->error[change] = isnan(error[0]) || isnan(error[1]) ? NAN : fmax(error[0], error[1]);
}

static int32_t find_margin(struct hk_study *study) {
  struct margins margins = {.study = study, .work = fmax(WORK, RUNS * study->reference.work) / CHANGED};
  for (int k = 0; k < CHANGED; k++)
    margins.holds[k] = margins.error[k] = NAN;
  hk_stage_begin(&study->stage, "margin", 1.0);
  if (study->m->system->generalized) return HOOKE_OK; /* no limit, stiffness or direction is known of it */
  int32_t status = find_limit_share(study, &study->recommendation);
  if (status != HOOKE_OK) return status;
  study->late = 0;
  status = hk_run_side_by_side(study->m, 0, CHANGED, find_changed, &margins, hk_study_tell_row, study);
  for (int k = 0; k < HOOKE_STUDY_CHANGES; k++)
    keep_change(&margins, (enum hk_study_change)k);
  return status == HOOKE_STOPPED && study->late ? HOOKE_OK : status;
}

/* ---- the recommendation ---- */

static int32_t tell_pick(double fraction, const char *what, void *ctx) {
  struct hk_study *study = ctx;
  study->stage.what = what;
  return hk_study_tell_row(fraction, study);
}

static int32_t method_number(const struct hk_study *study, const char *name) {
  for (int32_t m = 0; m < study->method_count; m++)
    if (strcmp(study->method[m], name) == 0) return m;
  return -1;
}

/* The first of the trusted frames, up to a time. */
static int64_t frames_until(const struct hk_reference *r, double until) {
  int64_t count = r->trusted;
  while (count > 1 && r->frames.time[count - 1] > until * (1.0 + 1e-9))
    count--;
  return count;
}

/* Its error over the first `frames`. */
static void keep(struct hk_study *study, const struct hk_study_row *row, int64_t frames) {
  struct hk_study_recommendation *r = &study->recommendation;
  const int finished = row->trial.wanted >= 0.0;
  r->error = finished ? 0.0 : NAN;
  double far = r->error;
  for (int64_t f = 0; f < frames && finished; f++) {
    r->error = fmax(r->error, row->trial.wanted_at[f]);
    far = fmax(far, row->trial.error_max_at[f]);
  }
  hk_wants_find(&study->wants, &row->trial.watched, &study->reference.frames.watched,
                study->reference.frames.recorded, frames, far, 0.0, r->found);
  r->until = hk_reference_time(&study->reference, frames, study->duration);
  r->method = row->method;
  r->value = row->value;
  r->atol = row->trial.atol;
  r->atol_velocity = row->trial.atol_velocity;
  r->wall_seconds = row->trial.wall_seconds;
  r->wall_median = row->wall_median;
  r->force_evaluations = row->trial.force_evaluations;
}

/* ---- when nothing meets the wanted error ---- */

static void explain_no_rows(struct hk_study *study) {
  struct hk_study_recommendation *r = &study->recommendation;
  const struct hk_study_row *finest = NULL;
  for (int64_t k = 0; k < study->row_count; k++)
    if (finest == NULL || study->row[k].value < finest->value) finest = &study->row[k];
  const int adaptive = finest && hk_study_is_adaptive(study, finest->method);
  if (finest == NULL)
    snprintf(r->note, sizeof r->note, "there are no runs to choose from");
  else
    hk_print(
        r->note, sizeof r->note,
        "no run finished, so none comes close: %s %s even at %s %.3g%s; give smaller steps or other methods",
        study->method[finest->method], finest->trial.status, adaptive ? "rtol" : "a step of", finest->value,
        adaptive ? "" : " s");
}

/* Where nothing is picked, the row that comes closest. */
static void keep_closest_row(struct hk_study *study) {
  const struct hk_study_row *closest = NULL;
  for (int64_t k = 0; k < study->row_count; k++) {
    const struct hk_study_row *row = &study->row[k];
    if (row->trial.wanted >= 0.0 && (closest == NULL || row->trial.wanted < closest->trial.wanted))
      closest = row;
  }
  if (closest) keep(study, closest, study->reference.trusted);
}

static void explain(struct hk_study *study) {
  struct hk_study_recommendation *r = &study->recommendation;
  const int picked = r->method >= 0;
  const char *m = hk_wants_unit(&study->wants, study->m->system);
  if (!picked) keep_closest_row(study);
  if (study->budget_spent && (r->method < 0 || (!picked && study->late))) {
    hk_print(r->note, sizeof r->note, "the budget of %g s ended before a run was found; give a larger one",
             study->budget);
  } else if (r->method < 0) {
    explain_no_rows(study);
  } else if (r->want <= study->reference.wanted_agreement) {
    hk_print(r->note, sizeof r->note,
             "%.3g%s is below %.3g%s, to which the reference itself is known; want more than that", r->want,
             m, study->reference.wanted_agreement, m);
  } else if (!picked) {
    hk_print(r->note, sizeof r->note,
             "no run of these methods is clear of its stability limit; the closest row is %.3g%s off",
             r->error, m);
  } else {
    hk_print(r->note, sizeof r->note, "no run comes within %.3g%s; the closest is %.3g%s off; %s", r->want, m,
             r->error, m,
             study->budget_spent ? "a larger budget would try finer steps"
                                 : "finer steps or tighter tolerances, or other methods, might");
  }
}

/* 1 if nothing but the start is trusted, where every run is right. */
static int is_untrusted(struct hk_study *study) {
  const struct hk_reference *reference = &study->reference;
  if (reference->trusted > 1) return 0;
  hk_print(study->recommendation.note, sizeof study->recommendation.note,
           "the two references part before %g s, the first frame after the start, so no error is known",
           reference->frames.time[1]);
  return 1;
}

/* ---- picking ---- */

/* Measures the picked run as rows are, up to the time that the references of both can be trusted; to the end
 * where that of the pick was short of work alone. */
static int32_t measure(struct hk_study *study, const struct hk_pick *pick) {
  struct hk_study_recommendation *r = &study->recommendation;
  const double until = pick->fraction < 1.0 ? INFINITY : hk_pick_trusted(pick);
  const int32_t method = pick->best.method ? method_number(study, pick->best.method) : -1;
  struct hk_study_row row;
  if (method < 0) return HOOKE_OK;
  const int32_t status = hk_study_measure(study, method, pick->best.value, &row);
  if (status == HOOKE_OK && row.trial.status) {
    keep(study, &row, frames_until(&study->reference, study->reference.frames.time[0] + until));
    r->met = pick->met && r->error <= r->want;
    if (r->met) hk_pick_say_reversal(pick, r->note, sizeof r->note);
  }
  hk_trial_release(&row.trial);
  return status;
}

/* Picks for `want`, by one pick. */
static int32_t pick_once(struct hk_study *study, double want, int32_t *met) {
  struct hk_pick pick;
  study->late = 0;
  int32_t status = hk_pick_run(&pick, study->m->system, study->m->run, &study->wants, want, INFINITY,
                               study->method_count, study->method, tell_pick, study);
  if (status == HOOKE_STOPPED && study->late) {
    study->budget_spent = 1;
    status = HOOKE_OK;
  }
  if (status == HOOKE_OK) status = measure(study, &pick);
  *met = pick.met;
  hk_pick_release(&pick);
  return status;
}

static void clear(struct hk_study *study, double want) {
  study->recommendation = (struct hk_study_recommendation){.made = 1,
                                                           .method = -1,
                                                           .want = want,
                                                           .value = NAN,
                                                           .atol = NAN,
                                                           .atol_velocity = NAN,
                                                           .error = NAN,
                                                           .until = NAN,
                                                           .wall_seconds = NAN,
                                                           .wall_median = NAN,
                                                           .force_evaluations = NAN,
                                                           .margin = {NAN, {NAN, NAN}, {NAN, NAN}}};
}

int32_t hk_study_find_cheapest(struct hk_study *study, double want) {
  struct hk_study_recommendation *r = &study->recommendation;
  double aim = want;
  int32_t status = HOOKE_OK, met = 1;
  clear(study, want);
  hk_stage_begin(&study->stage, "search", HOOKE_STUDY_SEARCH);
  if (is_untrusted(study)) return HOOKE_OK;
  for (int k = 0; k < MOST_PICKS && met && !r->met && status == HOOKE_OK; k++) {
    if (r->error > want) aim *= AIM * want / r->error;
    status = pick_once(study, aim, &met);
  }
  if (status == HOOKE_BAD_VALUE && study->wants.list) { /* no run tells whether it is met */
    hk_print(r->note, sizeof r->note, "%s", hooke_last_error());
    return HOOKE_OK;
  }
  if (status != HOOKE_OK) return status;
  if (r->met) return find_margin(study);
  explain(study);
  return HOOKE_OK;
}

int32_t hooke_study_recommend(hooke_measurement *m, double want) {
  int32_t status = hk_measurement_require(m, &hk_study_kind, "hooke_study_recommend");
  if (status != HOOKE_OK) return status;
  struct hk_study *study = m->object;
  if (study->reference.frames.count == 0)
    return hk_fail(HOOKE_BAD_CALL, NULL,
                   "the study has not been run yet; call hooke_measurement_run() first");
  if (!(want > 0.0)) return hk_fail(HOOKE_BAD_VALUE, "want", "%g is not allowed; a number > 0 is", want);
  /* the budget starts anew */
  study->begun = hk_clock_seconds();
  study->deadline = study->begun + study->budget;
  study->stage.told = study->stage.until = 0.0;
  status = hk_study_find_cheapest(study, want);
  return status == HOOKE_OK ? hk_measurement_claim(m) : status;
}
