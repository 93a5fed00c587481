/* Ensembles: where small differences grow too much for a motion to be computed to its end, means and spreads
 * over many indistinguishable starts still can be. */
#include "measure/study/study.h"

#include "core/clock.h"
#include "core/memory.h"
#include "core/random.h"
#include "core/status.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

static const double NOISE = 0.1;  /* of the wanted error, or */
static const double SHARE = 1e-6; /* of the extent, without one */
/* For the reference's method; its effect on energies must be small against that of the noise. */
static const double TOLERANCE = 1e-10;

/* ---- sources ---- */

/* So that the results of a method depend on the seed alone. */
static uint64_t seed_of(uint64_t seed, const char *method) {
  uint64_t random = seed;
  for (const char *at = method; *at; at++)
    random = hk_random_next(&random) ^ (uint64_t)(unsigned char)*at;
  return random;
}

static int32_t add_source(const struct hk_study *study, struct hk_ensemble *ensemble, int32_t method,
                          double value) {
  struct hk_ensemble_source *source = &ensemble->source[ensemble->source_count];
  const uint64_t seed = (uint64_t)hooke_options_number(study->m->options, "seed");
  *source = (struct hk_ensemble_source){.method = method, .value = value};
  source->random = seed_of(seed, method < 0 ? "reference" : study->method[method]);
  source->statistic = hk_new(ensemble->quantities.count, sizeof *source->statistic);
  if (source->statistic == NULL) return HOOKE_NO_MEMORY;
  ensemble->source_count++;
  return HOOKE_OK;
}

/* 1 if `row` is preferred to `other` of the same method: of those that meet the want the cheaper, otherwise
 * the finer. */
static int is_better(const struct hk_study_row *row, const struct hk_study_row *other, double want) {
  const int meets = row->trial.wanted <= want;
  if (other == NULL || meets != (other->trial.wanted <= want)) return other == NULL || meets;
  return meets ? row->trial.wall_seconds < other->trial.wall_seconds : row->value < other->value;
}

/* The recommended value; otherwise, of the rows that finished, the cheapest that meets the want, or the
 * finest; NaN without one. */
static double choose_value(const struct hk_study *study, int32_t method) {
  const struct hk_study_recommendation *r = &study->recommendation;
  const double want = study->wants.most;
  const struct hk_study_row *best = NULL;
  if (r->made && r->met && r->method == method) return r->value;
  for (int64_t k = 0; k < study->row_count; k++) {
    const struct hk_study_row *row = &study->row[k];
    if (row->method != method || strcmp(row->trial.status, "finished") != 0) continue;
    if (is_better(row, best, want)) best = row;
  }
  return best ? best->value : NAN;
}

static int32_t find_quantities(const struct hk_study *study, struct hk_watched_list *list) {
  list->system = study->m->system;
  const char *watched = hooke_options_text(study->m->options, "watch");
  int32_t status = hk_watched_read(list, "watch", "kinetic,potential,energy");
  if (status == HOOKE_OK && watched[0]) status = hk_watched_read(list, "watch", watched);
  return status;
}

static int32_t create(const struct hk_study *study, struct hk_ensemble *ensemble) {
  const double want = study->wants.most * study->wants.length;
  const struct hk_reference *r = &study->reference;
  ensemble->members = (int64_t)hooke_options_number(study->m->options, "ensemble");
  ensemble->noise = isnan(want) ? SHARE * r->extent : NOISE * want;
  ensemble->from = ensemble->until = NAN;
  ensemble->source = hk_new(study->method_count + 1, sizeof *ensemble->source);
  if (ensemble->source == NULL) return HOOKE_NO_MEMORY;
  int32_t status = find_quantities(study, &ensemble->quantities);
  if (status == HOOKE_OK)
    status = add_source(study, ensemble, -1, hk_reference_setting(r, r->method, TOLERANCE));
  for (int32_t m = 0; m < study->method_count && status == HOOKE_OK; m++) {
    const double value = choose_value(study, m);
    if (!isnan(value)) status = add_source(study, ensemble, m, value);
  }
  return status;
}

void hk_ensemble_release(struct hk_ensemble *ensemble) {
  if (ensemble == NULL) return;
  for (int64_t k = 0; k < ensemble->source_count; k++)
    hk_free(ensemble->source[k].statistic);
  hk_free(ensemble->source);
  hk_watched_release(&ensemble->quantities);
  hk_free(ensemble);
}

/* ---- a member ---- */

/* A running member. */
struct member {
  struct hk_study *study;
  struct hk_ensemble *ensemble;
  struct hk_ensemble_source *source;
  int64_t first, count;             /* first untrusted frame, and number of untrusted frames so far */
  double *time;                     /* of these frames */
  struct hk_watched_series *series; /* at these frames */
};

static int32_t tell(double fraction, void *ctx) {
  return hk_study_tell_row(fraction, ((struct member *)ctx)->study);
}

static void displace(hooke_state *state, void *ctx) {
  struct member *member = ctx;
  hk_displace(state, member->study->m->system, member->ensemble->noise / sqrt(3.0), &member->source->random);
}

static int32_t see_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  struct member *member = ctx;
  (void)step;
  if (frame < member->first || member->count >= member->series->frames) return 0;
  member->time[member->count] = hooke_state_time(state);
  hk_watched_series_keep(member->series, member->count++, hooke_state_time(state),
                         hooke_state_position(state), hooke_state_velocity(state));
  return 0;
}

/* Means over the frames, and periods, into a running mean and sum of squares (Welford 1962). */
static void keep_member(const struct member *member) {
  struct hk_ensemble *ensemble = member->ensemble;
  for (int64_t k = 0; k < ensemble->quantities.count; k++) {
    const double *at = hk_watched_series_of(member->series, k);
    struct hk_statistic *statistic = &member->source->statistic[k];
    double sum = 0.0;
    for (int64_t f = 0; f < member->count; f++)
      sum += at[f];
    const double value = ensemble->quantities.item[k].is_period
                             ? hk_watched_period(member->count, member->time, at)
                             : sum / (double)member->count;
    if (isnan(value)) continue;
    const double from_mean = value - statistic->mean;
    statistic->mean += from_mean / (double)++statistic->members;
    statistic->squares += from_mean * (value - statistic->mean);
  }
  ensemble->from = member->time[0];
  ensemble->until = member->time[member->count - 1];
}

static int32_t source_options(const struct hk_study *study, const struct hk_ensemble_source *source,
                              hooke_options **options) {
  const struct hk_reference *r = &study->reference;
  if (source->method >= 0) return hk_study_row_options(study, source->method, source->value, options);
  return hk_reference_options(study->m->run, r->method, TOLERANCE, r, options);
}

/* A member that does not finish, and a source that has one, count as failed. */
static int32_t run_member(struct member *member) {
  const struct hk_listener listener = {
      .on_progress = tell, .on_frame = see_frame, .on_start = displace, .ctx = member};
  const struct hk_study *study = member->study;
  struct hk_frames none = {.system = study->m->system};
  hooke_options *options = NULL;
  member->count = 0;
  hk_watched_series_clear(member->series);
  int32_t status = source_options(study, member->source, &options);
  if (status == HOOKE_OK) status = hk_frames_run(&none, options, &listener, NULL);
  hooke_options_destroy(options);
  if (status == HOOKE_OK && member->count > 0) keep_member(member);
  if (!hk_trial_gave_up(status)) return status;
  member->source->failed++;
  return HOOKE_OK;
}

/* ---- all members ---- */

/* All sources in turn, so that when time runs out each has as many members. */
static int32_t run_members(struct member *member) {
  struct hk_study *study = member->study;
  struct hk_ensemble *ensemble = member->ensemble;
  const double begun = hk_clock_seconds(), all = (double)(ensemble->members * ensemble->source_count);
  double done = 0.0;
  study->under_way = "ensemble";
  study->work_ahead = 0.0;
  study->late = 0;
  study->row_deadline = study->deadline;
  for (int64_t k = 0; k < ensemble->members; k++) {
    for (int64_t s = 0; s < ensemble->source_count; s++) {
      member->source = &ensemble->source[s];
      const int32_t status = member->source->failed ? HOOKE_OK : run_member(member);
      if (status == HOOKE_STOPPED && study->late) {
        study->budget_spent = 1;
        return HOOKE_OK;
      }
      if (status != HOOKE_OK) return status;
      done += 1.0;
      study->work_ahead = (hk_clock_seconds() - begun) / done * (all - done);
    }
  }
  return HOOKE_OK;
}

int32_t hk_ensemble_run(struct hk_study *study) {
  const struct hk_reference *r = &study->reference;
  const int64_t first = r->trusted, frames = r->frames.count - first;
  if (hooke_options_number(study->m->options, "ensemble") < 1.0 || frames < 1) return HOOKE_OK;
  struct hk_ensemble *ensemble = hk_new(1, sizeof *ensemble);
  if (ensemble == NULL) return HOOKE_NO_MEMORY;
  study->ensemble = ensemble;
  struct hk_watched_series series = {.list = NULL};
  struct member member = {.study = study, .ensemble = ensemble, .first = first, .series = &series};
  member.time = hk_new(frames, sizeof(double));
  int32_t status = member.time ? create(study, ensemble) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hk_watched_series_create(&ensemble->quantities, frames, &series);
  if (status == HOOKE_OK) status = run_members(&member);
  hk_watched_series_release(&series);
  hk_free(member.time);
  return status;
}
