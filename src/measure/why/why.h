/* A diagnosis, and the inquiry that makes it: the last steps again, under observation; then the cause; then
 * advice that has been tried. */
#ifndef HOOKE_MEASURE_WHY_WHY_H
#define HOOKE_MEASURE_WHY_WHY_H

#include "integrate/integrator.h"
#include "measure/limit/limit_blame.h"
#include "measure/measurement.h"
#include "measure/spectrum/node_blocks.h"
#include "measure/trial/patience.h"
#include "measure/why/growing.h"

enum { HOOKE_WHY_MOST_BLAME = 100, HOOKE_WHY_MOST_ADVICE = 4 };

struct hk_why_blame {
  int64_t spring, first, second;
  double share;
  char group[96];
  const char *force; /* "" of a spring; else `spring` is -1 */
};

struct hk_why_advice {
  char change[720], option[32], value[48];
  hooke_options *run; /* of a run, with nothing set but what is to be changed; NULL: a change of the scene */
};

struct hk_why {
  const hooke_integrator *integrator; /* whose run ended early */
  hooke_integrator *own;              /* that one, where states were kept; NULL: it is the caller's */
  hooke_state *first, *last;          /* those states, until it has run on from the last one */
  const char *cause;                  /* NULL: not found yet */
  char sentence[1024], method[32], left_out[640];
  double time, noticed, step, limit, particle;
  int64_t blame_count, advice_count;
  struct hk_why_blame blame[HOOKE_WHY_MOST_BLAME];
  struct hk_why_advice advice[HOOKE_WHY_MOST_ADVICE];
};

/* What a callback did for the first time that it should not do, given finite numbers of a sensible size. */
struct hk_bad_value {
  int32_t found, of_drive;
  double time;
  int64_t particle;
};

/* Positions at which the step was above the limit. */
struct hk_violation {
  int32_t found, tries;
  int64_t pause; /* looks to let pass: between bound and limit nothing is gained by asking at every one */
  double time, *q;
  double limit,      /* NaN: only that it is */
      at_most;       /* at most that; infinity: that is not known */
  int64_t particle;  /* where the bound shows it */
  double bound;      /* that the step was seen above first; NaN: it never was */
  int32_t has_blame; /* of the motion that grows there */
  struct hk_blame blame;
};

struct hk_inquiry {
  const hooke_integrator *run;
  const hooke_system *system;
  struct hk_why *why;
  struct hk_patience patience;
  double memory_limit, memory_used; /* [bytes] that may be taken, and those that are */
  char no_time[200], no_room[200];  /* what was left out */
  double pass;                      /* [s] that one pass over the springs for bounds takes, by estimate */
  int32_t large;                    /* the spectrum is out of reach: what grows has to tell */
  struct hk_growing growing;

  hooke_state *last;  /* the last one within all bounds; NULL: the run's newest is */
  int64_t last_step;  /* steps before it */
  int32_t cut;        /* the steps again were not all taken */
  int32_t reproduced; /* the steps again went wrong again */
  double bad_time;
  int64_t bad_particle; /* the one that moves fastest then */
  int32_t sudden;       /* from a sensible size beyond all numbers within three steps */
  /* [s] of a step after which squares still have numbers, where they soon have none; else 0 */
  double squares;
  double size, bad_size; /* largest position or velocity, before and after */
  struct hk_bad_value bad_value;
  struct hk_violation violation;
  int64_t flips,
      flipped; /* times that a spring was turned round through zero length, and the spring last seen to */
  double flip_time;
  int32_t force;    /* that determines the limit: as hk_blame_force() says it; -1: springs */
  char remedy[640]; /* what it would buy to change the scene; "" if nothing is known */
};

/* Numbers up to this size (in SI units) are taken to be meant. */
#define HOOKE_SENSIBLE 1e60

/* Takes the last steps of the run again, or all of them where that is cheap, and notes what there is to see.
 * The statuses of hooke_integrator_create(); HOOKE_STOPPED if a callback asked for it. */
int32_t hk_inquiry_replay(struct hk_inquiry *inquiry);

/* Looks whether the step is above the limit at positions q of the time t, if it was not before. */
int32_t hk_inquiry_consider(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks, const double *q,
                            double t);

/* The same at the states that the run kept. */
int32_t hk_inquiry_survey(struct hk_inquiry *inquiry, struct hk_node_blocks *blocks);

/* The limit of `method` at q, if there is room and time for it; else the bound below it, and `known` is 0. */
int32_t hk_inquiry_limit(struct hk_inquiry *inquiry, const double *q, const char *method, double accuracy,
                         double *limit, int32_t *known);

/* 1 if the model gains energy by itself: at much smaller steps, too. */
int32_t hk_inquiry_gains(struct hk_inquiry *inquiry, int32_t *gains);

/* Finds the springs and the force to blame for a violation, and a remedy. */
int32_t hk_inquiry_blame(struct hk_inquiry *inquiry);
void hk_inquiry_blame_spring(struct hk_inquiry *inquiry, int64_t spring, double share);

/* The last state within all bounds. */
const hooke_state *hk_inquiry_last(const struct hk_inquiry *inquiry);

/* 1 if there is room for as many bytes more; if not, `what` is left out for that. */
int32_t hk_inquiry_has_room(struct hk_inquiry *inquiry, double bytes, const char *what);

/* Ends a part of which patience was lent; if that was spent, `what` is left out for want of time. */
void hk_inquiry_end_part(struct hk_inquiry *inquiry, const char *what);

/* Names cause, place and time. */
int32_t hk_inquiry_judge(struct hk_inquiry *inquiry);

/* Finds changes of the run and tries them. */
int32_t hk_inquiry_advise(struct hk_inquiry *inquiry);

enum { HOOKE_WHY_TABLES = 3 };
extern const struct hk_table *const hk_why_tables[HOOKE_WHY_TABLES];
extern const struct hk_measurement_kind hk_why_kind;

/* Sets what is set in `changes`. */
int32_t hk_why_apply(const hooke_options *changes, hooke_options *run);

/* The largest handy step (1, 2 or 5 times a power of ten, else a whole part) up to `limit` of which `every`
 * (NaN: free) and `duration` are whole multiples; `step` (NaN: none) is one that is. */
double hk_handy_step(double step, double limit, double every, double duration);

#endif
