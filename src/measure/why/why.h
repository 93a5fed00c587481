/* A diagnosis: repeats the last steps under observation, finds the cause, and tries suggestions. */
#pragma once

#include "integrate/integrator.h"
#include "measure/limit/limit_participation.h"
#include "measure/measurement.h"
#include "measure/spectrum/node_blocks.h"
#include "measure/trial/budget.h"
#include "measure/why/growing.h"
#include "measure/why/why_walk.h"

enum { HOOKE_WHY_MOST_ADVICE = 4 };

struct hk_why_advice {
  char change[720], option[32], value[48];
  double want; /* where a change of the scene has an error that is not known: to ask `needs` with [m] */
  hooke_options *run; /* of a run, with only the changed ones set; NULL: a change of the scene */
};

struct hk_why {
  const hooke_measurement *measurement;
  const hooke_system *system;
  const hooke_integrator *integrator; /* whose run ended early */
  hooke_integrator *own;              /* that one, where states were kept; NULL: it is the caller's */
  hooke_state *first, *last;          /* those states, until it has run on from the last one */
  struct hk_why_start start;          /* to take the steps again from, for a page */
  const char *cause;                  /* NULL: not found yet */
  char sentence[1024], method[32], left_out[640];
  int32_t cause_length; /* part of the sentence that tells the cause; the rest is how it went on */
  double time, noticed, step, limit, particle;
  struct hk_limiting_list limiting;
  int64_t advice_count;
  struct hk_why_advice advice[HOOKE_WHY_MOST_ADVICE];
};

/* The first bad value of a callback, at finite arguments of sensible size. */
struct hk_bad_value {
  int32_t found, of_drive;
  double time;
  int64_t particle;
};

/* Positions at which the step exceeded the limit. */
struct hk_violation {
  int32_t found, tries;
  int64_t pause; /* checks to skip: between bound and limit repeated checks gain nothing */
  double time, *q;
  double limit,              /* NaN: it is only known to be exceeded */
      at_most;               /* upper bound of it; infinity: unknown */
  int64_t particle;          /* where the bound shows it */
  double bound;              /* first bound that the step exceeded; NaN: none */
  int32_t has_participation; /* of the growing motion there */
  struct hk_participation participation;
};

struct hk_inquiry {
  const hooke_integrator *run;
  const hooke_system *system;
  struct hk_why *why;
  struct hk_budget budget;
  double memory_limit, memory_used; /* [bytes] allowed, and in use */
  char no_time[200], no_space[200]; /* skipped work */
  int32_t large;                    /* the spectrum is out of reach: growing motion is used instead */
  struct hk_growing growing;

  hooke_state *last;  /* the last one within all bounds; NULL: the run's newest is */
  int64_t last_step;  /* steps before it */
  int32_t cut;        /* not all steps were repeated */
  int32_t reproduced; /* the repeated steps failed again */
  double bad_time;
  int64_t bad_particle; /* the one that moves fastest then */
  int32_t sudden;       /* from a sensible size to overflow within three steps */
  /* [s] time of a step after which squares are finite, but soon overflow; else 0 */
  double squares;
  double size, bad_size; /* largest position or velocity, before and after */
  struct hk_bad_value bad_value;
  struct hk_violation violation;
  int64_t flips, flipped; /* number of reversals of a spring through zero length, and the last such spring */
  double flip_time;
  int32_t force; /* force that determines the limit, by hk_participation_force(); -1: springs */
  /* what has the largest shares of the motion that grows, if they are known */
  struct hk_limiting_element heaviest;
  int64_t group;
  double group_share;
  hooke_measurement *limit; /* that it is of; may be NULL */
  char suggestion[640];     /* gain of a change of the scene; "" if unknown */
};

/* Numbers up to this size (in SI units) count as intended. */
#define HOOKE_SENSIBLE 1e60

/* Repeats the last steps of the run, or all of them if that is cheap, and records observations. The statuses
 * of hooke_integrator_create(); HOOKE_STOPPED if a callback asked for it. */
int32_t hk_inquiry_replay(struct hk_inquiry *inquiry);

/* Checks if the step exceeds the limit at a state, unless it was found to before. */
int32_t hk_inquiry_consider(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks,
                            const hooke_state *state);

/* The same at the states that the run kept. */
int32_t hk_inquiry_survey(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks);

/* 1 if the model itself gains energy: at much smaller steps, too. */
int32_t hk_inquiry_gains(struct hk_inquiry *inquiry, int32_t *gains);

/* The last state within all bounds. */
const hooke_state *hk_inquiry_last(const struct hk_inquiry *inquiry);

/* 1 if that many more bytes fit; otherwise `what` is recorded as skipped. */
int32_t hk_inquiry_has_memory(struct hk_inquiry *inquiry, double bytes, const char *what);

/* Counted work of a run so far [s], in which every evaluation with a callback stands for as much as a script
 * may take; and the spending of what it did since `before`, which follows. */
double hk_why_work_of(const hooke_integrator *run);
void hk_inquiry_spend(struct hk_inquiry *inquiry, const hooke_integrator *run, double *before);

/* Ends a part with limited budget; if that was spent, `what` is recorded as skipped for lack of time. */
void hk_inquiry_end_part(struct hk_inquiry *inquiry, const char *what);

/* Determines cause, place and time. */
int32_t hk_inquiry_judge(struct hk_inquiry *inquiry);

/* Finds changes of the run and tries them. */
int32_t hk_inquiry_advise(struct hk_inquiry *inquiry);

/* What it says of its results (why_cause.c). */
void hk_why_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_table hk_why_tables[];
extern const struct hk_measurement_kind hk_why_kind;

/* The largest round step (1, 2 or 5 times a power of ten, else an integer fraction) up to `limit` of which
 * `every` (NaN: free) and `duration` are whole multiples; `step` (NaN: none) is one that fits. */
double hk_handy_step(double step, double limit, double every, double duration);
