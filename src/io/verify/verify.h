/* The object of a measurement of the kind "verify", and the passes over its slice. */
#ifndef HOOKE_IO_VERIFY_VERIFY_H
#define HOOKE_IO_VERIFY_VERIFY_H

#include "hooke/scene.h"
#include "hooke/trajectory.h"
#include "measure/measurement.h"
#include "measure/trial/balance.h"

struct hk_verify {
  const hooke_measurement *measurement;
  char *path;
  const hooke_options *limits;  /* of the caller, while the file is opened */
  const hooke_options *options; /* of the measurement */
  hooke_record *record;
  hooke_scene *scene;
  const hooke_system *system;
  hooke_state *first;       /* of the run, as the file has it */
  int64_t from, to;         /* frames of the slice; `to` shrinks to where the budget ends */
  int32_t by_budget, fixed; /* fixed: a fixed step */
  int32_t may_differ;       /* in bits, other versions or another machine having made it */

  const char *verdict, *balance;
  char difference[512];
  int64_t checked;
  double time_from, time_to; /* of the frames `from` and `to` */
  double steps, limit, energy_change, work, heat, residual, residual_refined, bound, error, error_velocity;
  double check_scene, check_last;
};

/* What a pass over the slice found. */
struct hk_verify_pass {
  int32_t refined;  /* how often the step was halved, or tolerances tightened */
  int64_t count;    /* frames after the first */
  double *residual; /* one a frame */
  struct hk_balance balance;
  double steps;
  double apart[2]; /* the largest distance of a coordinate [m] and a velocity [m/s] from the file's */
  double error[2]; /* of a refined pass, the same from the first pass */
  /* q and v of each frame of the first pass, where the file's may be others; NULL: they are the file's */
  double *own;
};

/* Runs the slice. Without refinement frames are compared, and time limits the slice. HOOKE_DIVERGED and the
 * like only of refined passes. */
int32_t hk_verify_pass(struct hk_verify *verify, struct hk_verify_pass *pass);
void hk_verify_pass_release(struct hk_verify_pass *pass);

/* Frame 0 against the scene's own beginning. */
int32_t hk_verify_first(struct hk_verify *verify);

enum { HOOKE_VERIFY_TABLES = 1 };
extern const struct hk_table *const hk_verify_tables[HOOKE_VERIFY_TABLES];

extern const struct hk_measurement_kind hk_verify_kind;

#endif
