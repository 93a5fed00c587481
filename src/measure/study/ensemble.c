/* Ensembles: where small differences grow too much for a motion to be computed to its end, means and spreads
 * over many indistinguishable starts still can be. */
#include "measure/study/study.h"

#include "core/memory.h"
#include "core/random.h"
#include "measure/trial/side_by_side.h"

#include <math.h>
#include <stdatomic.h>
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
  source->seed = seed_of(seed, method < 0 ? "reference" : study->method[method]);
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
  return meets ? row->trial.work < other->trial.work : row->value < other->value;
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

/* All members of all sources, which take turns, so that each has as many when time runs out. */
struct members {
  struct hk_study *study;
  struct hk_ensemble *ensemble;
  int64_t first, frames; /* first untrusted frame, and how many there are */
  int64_t count;
  atomic_int *ends; /* how each ended, a status; HOOKE_BAD_CALL: not at all */
  double *value;    /* of each, of each quantity: mean over the frames, or period */
};

/* A running member. */
struct member {
  const struct members *all;
  struct hk_turn *turn;
  uint64_t random;                 /* of its start */
  int64_t count;                   /* untrusted frames so far */
  double *time;                    /* of these frames */
  struct hk_watched_series series; /* at these frames */
};

static struct hk_ensemble_source *source_of(const struct members *all, int64_t number) {
  return &all->ensemble->source[number % all->ensemble->source_count];
}

static int32_t tell_member(double fraction, void *ctx) {
  return hk_turn_tell(fraction, ((struct member *)ctx)->turn);
}

static void displace(hooke_state *state, void *ctx) {
  struct member *member = ctx;
  const struct members *all = member->all;
  hk_displace(state, all->study->m->system, all->ensemble->noise / sqrt(3.0), &member->random);
}

static int32_t see_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  struct member *member = ctx;
  (void)step;
  if (frame < member->all->first || member->count >= member->all->frames) return 0;
  member->time[member->count] = hooke_state_time(state);
  hk_watched_series_keep(&member->series, member->count++, hooke_state_time(state),
                         hooke_state_position(state), hooke_state_velocity(state));
  return 0;
}

/* Means over the frames, and periods. */
static void find_values(const struct member *member, double *value) {
  const struct hk_watched_list *quantities = &member->all->ensemble->quantities;
  for (int64_t k = 0; k < quantities->count; k++) {
    const double *at = hk_watched_series_of(&member->series, k);
    double sum = 0.0;
    for (int64_t f = 0; f < member->count; f++)
      sum += at[f];
    value[k] = quantities->item[k].is_period ? hk_watched_period(member->count, member->time, at)
                                             : sum / (double)member->count;
  }
}

static int32_t source_options(const struct hk_study *study, const struct hk_ensemble_source *source,
                              hooke_options **options) {
  const struct hk_reference *r = &study->reference;
  if (source->method >= 0) return hk_study_row_options(study, source->method, source->value, options);
  return hk_reference_options(study->m->run, r->method, TOLERANCE, r, options);
}

static int32_t run_member(struct member *member) {
  const struct members *all = member->all;
  const struct hk_listener listener = {.on_progress = tell_member,
                                       .on_frame = see_frame,
                                       .on_start = displace,
                                       .serial = member->turn->serial,
                                       .ctx = member};
  struct hk_frames none = {.system = all->study->m->system};
  hooke_options *options = NULL;
  const struct hk_ensemble_source *source = source_of(all, member->turn->number);
  /* each member has a seed of its own */
  member->random = source->seed ^ (uint64_t)(member->turn->number / all->ensemble->source_count);
  member->random = hk_random_next(&member->random);
  member->time = hk_new(all->frames, sizeof(double));
  if (member->time == NULL) return HOOKE_NO_MEMORY;
  int32_t status = hk_watched_series_create(&all->ensemble->quantities, all->frames, &member->series);
  if (status == HOOKE_OK) status = source_options(all->study, source, &options);
  if (status == HOOKE_OK) status = hk_frames_run(&none, options, &listener, NULL);
  hooke_options_destroy(options);
  return status;
}

/* What follows a member that failed is not kept. */
static int32_t try_member(struct hk_turn *turn, void *ctx) {
  const struct members *all = ctx;
  struct member member = {.all = all, .turn = turn};
  const int64_t before = turn->number - all->ensemble->source_count;
  int32_t status = before < 0 ? HOOKE_OK : atomic_load(&all->ends[before]);
  if (!hk_trial_gave_up(status)) status = run_member(&member);
  if (status == HOOKE_OK) find_values(&member, all->value + turn->number * all->ensemble->quantities.count);
  atomic_store(&all->ends[turn->number], status);
  hk_watched_series_release(&member.series);
  hk_free(member.time);
  return hk_trial_gave_up(status) ? HOOKE_OK : status;
}

/* ---- all members ---- */

/* Into a running mean and sum of squares (Welford 1962). A member that does not finish, and a source that has
 * one, count as failed. */
static void keep_member(const struct members *all, int64_t number) {
  struct hk_ensemble_source *source = source_of(all, number);
  const int64_t quantities = all->ensemble->quantities.count;
  if (source->failed) return;
  source->failed += hk_trial_gave_up(all->ends[number]);
  if (all->ends[number] != HOOKE_OK) return;
  const double start = all->study->reference.frames.time[0];
  all->ensemble->from = start + (double)all->first * all->study->every;
  all->ensemble->until = start + all->study->duration;
  for (int64_t k = 0; k < quantities; k++) {
    const double value = all->value[number * quantities + k];
    struct hk_statistic *statistic = &source->statistic[k];
    if (isnan(value)) continue;
    const double from_mean = value - statistic->mean;
    statistic->mean += from_mean / (double)++statistic->members;
    statistic->squares += from_mean * (value - statistic->mean);
  }
}

static int32_t run_members(struct members *all) {
  struct hk_study *study = all->study;
  hk_stage_begin(&study->stage, "ensemble", 1.0);
  study->late = 0;
  for (int64_t k = 0; k < all->count; k++)
    atomic_init(&all->ends[k], HOOKE_BAD_CALL);
  const int32_t status =
      hk_run_side_by_side(study->m, 0, all->count, try_member, all, hk_study_tell_row, study);
  for (int64_t k = 0; k < all->count; k++)
    keep_member(all, k);
  if (status != HOOKE_STOPPED || !study->late) return status;
  study->budget_spent = 1;
  return HOOKE_OK;
}

int32_t hk_ensemble_run(struct hk_study *study) {
  const struct hk_reference *r = &study->reference;
  struct members all = {.study = study, .first = r->trusted, .frames = r->frames.count - r->trusted};
  if (hooke_options_number(study->m->options, "ensemble") < 1.0 || all.frames < 1) return HOOKE_OK;
  all.ensemble = study->ensemble = hk_new(1, sizeof *study->ensemble);
  int32_t status = all.ensemble ? create(study, all.ensemble) : HOOKE_NO_MEMORY;
  if (status != HOOKE_OK) return status;
  all.count = all.ensemble->members * all.ensemble->source_count;
  all.ends = hk_new(all.count, sizeof *all.ends);
  all.value = hk_new(all.count * all.ensemble->quantities.count, sizeof *all.value);
  status = all.ends && all.value ? run_members(&all) : HOOKE_NO_MEMORY;
  hk_free(all.ends);
  hk_free(all.value);
  return status;
}
