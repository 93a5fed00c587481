/* The search for the smallest step that fails: a bracket about a guess, widened until both sides are known,
 * then halved. */
#pragma once

#include <stdint.h>

enum hk_trial_end {
  HOOKE_TRIAL_FAILS,
  HOOKE_TRIAL_HOLDS,
  HOOKE_TRIAL_UNKNOWN /* the search ends without an answer */
};

struct hk_bracket {
  /* Result of a trial at `step`: a status. */
  int32_t (*try_step)(void *ctx, double step, enum hk_trial_end *end);
  void *ctx;
  double accuracy;    /* of the limit, relative */
  int32_t sharp;      /* 1: the guess is much better than that, and trials begin at a quarter of it */
  double least, most; /* steps beyond which nobody looks */
  double holds,
      fails; /* the bracket: largest step known to hold, smallest known to fail; 0 and infinity at first */
  int32_t unknown; /* a trial had no answer: the bracket is as far as the search got */
};

/* Narrows the bracket from `guess` on until it is as wide as half of the accuracy, or a side lies beyond
 * `least` or `most`, or a trial has no answer. */
int32_t hk_bracket_search(struct hk_bracket *bracket, double guess);
