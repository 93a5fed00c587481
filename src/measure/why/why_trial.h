/* Advice on trial: a change of the run is given only if a run with it was seen to get past the trouble. */
#ifndef HOOKE_MEASURE_WHY_WHY_TRIAL_H
#define HOOKE_MEASURE_WHY_WHY_TRIAL_H

#include "measure/why/why.h"

/* Work of one trial: particles and springs times evaluations, about a second. */
#define HOOKE_TRIAL_WORK 2e8

/* What there is to try with. */
struct hk_trials {
  struct hk_inquiry *inquiry;
  const hooke_state *first;     /* where trials begin */
  int32_t late;                 /* 1: not where the run began, since from there the trouble is too far */
  hooke_state *initial;         /* the system's own beginning, where the run's was not kept */
  double step, every, duration; /* of the run; NaN: free */
  double size;                  /* particles and springs: the work of an evaluation */
  int32_t count;
  int32_t backed; /* what is offered has a step below the limits that are known: it is advice untried, too */
};

/* HOOKE_NO_MEMORY, HOOKE_STOPPED; hk_trials_release() has to follow. */
int32_t hk_trials_begin(struct hk_inquiry *inquiry, struct hk_trials *trials);
void hk_trials_release(struct hk_trials *trials);

/* Changes of a run, with a word on them, before they are tried. */
struct hk_change {
  hooke_options *run;
  char words[240], option[32];
};

int32_t hk_change_begin(struct hk_change *change, const char *option);
void hk_change_say(struct hk_change *change, const char *format, ...) __attribute__((format(printf, 2, 3)));
void hk_change_drop(struct hk_change *change);

/* What a trial showed: how far it came, and what that proves, in words ("": nothing). */
struct hk_trial {
  int32_t tried, finished, diverged;
  int64_t steps;
  double reached;
  char proof[96];
};

/* Runs `system`, the trials' or one like it, with the change as far as the work allows, if there is time and
 * room. */
int32_t hk_trials_try(struct hk_trials *trials, const hooke_system *system, const struct hk_change *change,
                      struct hk_trial *trial);

/* Tries more and more damping of altitude springs, and makes what proves well the remedy. */
int32_t hk_trials_try_damping(struct hk_trials *trials);

/* Tries the change, and gives it as advice if it proves well; takes it over in any case. */
int32_t hk_trials_offer(struct hk_trials *trials, struct hk_change *change, int32_t *taken);
/* Gives it without a trial. */
void hk_trials_take(struct hk_trials *trials, struct hk_change *change, const char *proof);

/* Runs with the change as far as the work allows; `steps` is how many it took, -1 if it did not come to its
 * end. */
int32_t hk_trials_count_steps(struct hk_trials *trials, const struct hk_change *change, int64_t *steps);

#endif
