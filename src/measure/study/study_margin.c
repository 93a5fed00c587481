/* Margin of a recommendation: its fraction of the stable limit, and whether it meets the wanted error with
 * slightly changed stiffness or start, each judged against a reference of its own. */
#include "measure/study/study.h"

#include "measure/limit/limit_predict.h"
#include "model/variant/variant.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Stiffness is multiplied by 1 + or - this; all free particles get this fraction of the largest speed of the
 * reference (root mean square between two frames) added along (1, 1, 1) and against it. */
static const double CHANGE = 0.1;
static const double RUNS = 2.0;      /* counted work of all, over that of the study's reference */
static const double WORK = 1.0;      /* and at least so much [s] */
static const double ACCURACY = 1e-3; /* of the limit, relative */

static int32_t tell_limit(double done, const char *what, void *study) {
  (void)what;
  return hk_study_tell(done, study);
}

static int32_t find_limit_share(struct hk_study *study, struct hk_study_recommendation *r) {
  const char *method = study->method[r->method];
  hooke_state *state = NULL;
  double limit = NAN;
  if (hk_study_is_adaptive(study, r->method)) return HOOKE_OK;
  int32_t status = hooke_state_create(study->m->system, &state);
  if (status != HOOKE_OK) return status;
  status = hk_limit_predict(study->m->system, hooke_state_position(state), hooke_state_velocity(state),
                            method, ACCURACY, tell_limit, study, &limit);
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
  const double want = study->recommendation.want, error = trial->error_max;
  if (strcmp(trial->status, "finished") != 0) return 0.0;
  if (r->trusted < 2 || error - r->agreement > want) return r->trusted < 2 ? NAN : 0.0;
  return r->trusted >= study->reference.trusted && error + r->agreement <= want ? 1.0 : NAN;
}

/* The recommended run on a slightly changed system; NaN if the work was too little for it or its reference.
 */
static int32_t try_change(struct hk_study *study, const hooke_system *changed, double work, double *holds,
                          double *error) {
  const struct hk_study_recommendation *best = &study->recommendation;
  const struct hk_listener listener = {.on_progress = hk_study_tell_row, .most_work = work, .ctx = study};
  const struct hk_reference_request request = {.run = study->m->run,
                                               .frame_count = study->reference.frames.count,
                                               .digits = best->want / 10.0,
                                               .enough = 1,
                                               .counted = 1,
                                               .budget = work,
                                               .listener = &listener};
  struct hk_reference reference;
  struct hk_trial trial = {.status = NULL};
  hooke_options *options = NULL;
  study->late = 0;
  study->row_deadline = study->deadline;
  int32_t status = hk_reference_create(changed, &request, &reference);
  if (status == HOOKE_STOPPED && study->late) return HOOKE_OK;
  if (status != HOOKE_OK) return status == HOOKE_NO_MEMORY || status == HOOKE_STOPPED ? status : HOOKE_OK;
  const int64_t judged = (int64_t)fmin((double)reference.trusted, (double)study->reference.trusted);
  status = hk_study_row_options(study, best->method, best->value, &options);
  if (status == HOOKE_OK) status = hk_trial_create(&reference.frames, &trial);
  if (status == HOOKE_OK) status = hk_trial_run(&trial, &reference.frames, judged, options, &listener);
  if (status == HOOKE_OK && strcmp(trial.status, "stopped") != 0) {
    *holds = judge(study, &reference, &trial);
    *error = trial.error_max;
  }
  hk_trial_release(&trial);
  hooke_options_destroy(options);
  hk_reference_release(&reference);
  return status == HOOKE_STOPPED && study->late ? HOOKE_OK : status;
}

static int32_t make_changed(const struct hk_study *study, enum hk_study_change change, double sign,
                            hooke_system **made) {
  struct hk_variant variant;
  struct hk_variant_map map;
  int32_t status = hk_variant_create(study->m->system, &variant);
  if (status != HOOKE_OK) return status;
  if (change == HOOKE_STUDY_STIFFNESS) {
    variant.stiffness = 1.0 + sign * CHANGE;
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

/* The want is met with a change if it is met in both directions. */
static int32_t find_change(struct hk_study *study, enum hk_study_change change, double work) {
  struct hk_study_margin *margin = &study->recommendation.margin;
  double holds[2] = {NAN, NAN}, error[2] = {NAN, NAN};
  int32_t status = HOOKE_OK;
  for (int k = 0; k < 2 && status == HOOKE_OK; k++) {
    hooke_system *changed = NULL;
    status = make_changed(study, change, k == 0 ? 1.0 : -1.0, &changed);
    if (status == HOOKE_OK) status = try_change(study, changed, work / 2.0, &holds[k], &error[k]);
    hooke_system_destroy(changed);
  }
  if (holds[0] == 0.0 || holds[1] == 0.0)
    margin->holds[change] = 0.0;
  else
    margin->holds[change] = holds[0] + holds[1] == 2.0 ? 1.0 : NAN;
  margin->error[change] = isnan(error[0]) || isnan(error[1]) ? NAN : fmax(error[0], error[1]);
  return status == HOOKE_UNSUITED || status == HOOKE_BAD_VALUE ? HOOKE_OK : status;
}

int32_t hk_study_find_margin(struct hk_study *study) {
  const double work = fmax(WORK, RUNS * study->reference.work) / HOOKE_STUDY_CHANGES;
  study->under_way = "margin";
  int32_t status = find_limit_share(study, &study->recommendation);
  for (int k = 0; k < HOOKE_STUDY_CHANGES && status == HOOKE_OK; k++)
    status = find_change(study, (enum hk_study_change)k, work);
  return status;
}
