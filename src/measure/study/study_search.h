/* Searches a method for its cheapest step or tolerance whose error is at most the wanted one. */
#ifndef HOOKE_MEASURE_STUDY_STUDY_SEARCH_H
#define HOOKE_MEASURE_STUDY_STUDY_SEARCH_H

#include "measure/study/study.h"

/* State of the search of a method: values that meet the want, and coarser ones that do not. */
struct hk_study_candidate {
  int32_t method;
  double most;         /* allowed error: the reference is known only to its agreement [m] */
  double meets, fails; /* the coarsest that meets it, the finest coarser one that does not; NaN: none */
  double error_at_meets, error_at_fails; /* largest distances [m]; NaN if a run did not finish */
  double finest;                         /* coarsest row that finished; if none did, the finest row */
  int32_t finished;                      /* 1: some row finished */
  double rate;      /* minimum time of a unit of work over all rows [s]; one row may have been disturbed */
  double predicted; /* predicted wall time of the result of a search [s]; infinite: none */
  struct hk_study_row best; /* the cheapest row that meets the want, or else the closest to it */
  int32_t owned;            /* 1: the trial of `best` belongs to the candidate */
};

/* Time of the best row [s]. */
double hk_study_candidate_cost(const struct hk_study_candidate *candidate);

/* Initialises it from the rows of the ladder. */
void hk_study_candidate_create(const struct hk_study *study, int32_t method, double want,
                               struct hk_study_candidate *candidate);
void hk_study_candidate_release(struct hk_study_candidate *candidate);

/* Narrows it by runs, until the deadline or until it cannot come below `cost` [wall seconds] any more. */
int32_t hk_study_candidate_search(struct hk_study *study, struct hk_study_candidate *candidate, double cost);

/* Does a run as fine as the reference, unless there is one. */
int32_t hk_study_candidate_try_finest(struct hk_study *study, struct hk_study_candidate *candidate);

#endif
