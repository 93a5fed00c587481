/* Searching a method for its cheapest step or tolerance whose error is at most what is wanted. */
#ifndef HOOKE_MEASURE_STUDY_STUDY_SEARCH_H
#define HOOKE_MEASURE_STUDY_STUDY_SEARCH_H

#include "measure/study/study.h"

/* What is known of a method: values that meet the want, and coarser ones that do not. */
struct hk_study_candidate {
  int32_t method;
  double most;         /* error that is allowed: the reference is only known to its agreement [m] */
  double meets, fails; /* the coarsest that does, the finest coarser one that does not; NaN: none */
  double error_at_meets, error_at_fails; /* [m]; NaN where a run did not finish */
  double finest;                         /* row that came to its end, at first; where none has, the finest */
  int32_t finished;                      /* 1: one has */
  double rate; /* least seconds for a unit of work in any row: a row's own time may have met a busy machine */
  double predicted;         /* wall time of what a search is going to find [s]; infinite: it will not */
  struct hk_study_row best; /* the cheapest row that meets the want, or else the closest to it */
  int32_t owned;            /* 1: the trial of `best` is the candidate's own */
};

/* Seconds that the best row takes. */
double hk_study_candidate_cost(const struct hk_study_candidate *candidate);

/* From the rows of the ladder. */
void hk_study_candidate_create(const struct hk_study *study, int32_t method, double want,
                               struct hk_study_candidate *candidate);
void hk_study_candidate_release(struct hk_study_candidate *candidate);

/* Narrows it down by runs, until the deadline or until it cannot come below `cost` any more [wall
 * seconds]. */
int32_t hk_study_candidate_search(struct hk_study *study, struct hk_study_candidate *candidate, double cost);

/* Runs what is as fine as the reference, if no run of it as fine has been. */
int32_t hk_study_candidate_try_finest(struct hk_study *study, struct hk_study_candidate *candidate);

#endif
