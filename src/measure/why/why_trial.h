/* Trials of suggestions: a change of the run is suggested only if a run with it got past the failure. */
#pragma once

#include "measure/why/why.h"

/* Work of one trial: particles and springs times evaluations, about a second. */
#define HOOKE_TRIAL_WORK 2e8

/* Data of all trials. */
struct hk_trials {
  struct hk_inquiry *inquiry;
  const hooke_state *first;     /* start of trials */
  int32_t late;                 /* 1: not the start of the run, from which the failure is too far */
  hooke_state *initial;         /* the system's own initial state, if the run's was not kept */
  double step, every, duration; /* of the run; NaN: free */
  double size;                  /* particles and springs: the work of an evaluation */
  int32_t count, status;        /* status: the first failure, after which nothing is tried */
  int32_t backed; /* all suggestions have a step below the known limits: they are given untried, too */
};

/* hk_trials_release() has to follow. */
void hk_trials_begin(struct hk_inquiry *inquiry, struct hk_trials *trials);
void hk_trials_release(struct hk_trials *trials);

/* Changes of a run, with a description, before they are tried. */
struct hk_change {
  int32_t *status;    /* of the trials */
  hooke_options *run; /* NULL: there is none */
  char words[240], option[32];
};

void hk_change_begin(struct hk_trials *trials, struct hk_change *change, const char *option);
void hk_change_method(struct hk_change *change, const char *method);
void hk_change_number(struct hk_change *change, const char *name, double value);
void hk_change_say(struct hk_change *change, const char *format, ...) __attribute__((format(printf, 2, 3)));
void hk_change_drop(struct hk_change *change);

/* Result of a trial: the time it reached, and its meaning in words ("": none). */
struct hk_trial {
  int32_t tried, finished, diverged, failed; /* failed: it ended before its end and its work */
  int64_t steps;
  double reached;
  char proof[96];
};

/* Runs `system`, that of the trials or a similar one, with the change as far as the work allows, if there is
 * time and memory. */
void hk_trials_try(struct hk_trials *trials, const hooke_system *system, const struct hk_change *change,
                   struct hk_trial *trial);

/* Tries increasing damping of altitude springs, and makes a successful one the suggestion. */
void hk_trials_try_damping(struct hk_trials *trials);

/* Tries the change, if it has a run, and adds it to the advice if it succeeds, 1; takes ownership of it in
 * any case. */
int32_t hk_trials_offer(struct hk_trials *trials, struct hk_change *change);
/* Adds it without a trial. */
void hk_trials_take(struct hk_trials *trials, struct hk_change *change, const char *proof);
