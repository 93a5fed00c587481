/* The object of a measurement of kind "verify", and the passes over its slice. */
#pragma once

#include "hooke/scene.h"
#include "hooke/trajectory.h"
#include "measure/measurement.h"
#include "measure/trial/balance.h"
#include "model/blas.h"

enum { HOOKE_VERIFY_FACTS = 6 };

struct hk_verify {
  const hooke_measurement *measurement;
  char *path;
  const hooke_options *limits;  /* the caller's, while the file is opened */
  const hooke_options *options; /* of the measurement */
  hooke_record *record;
  hooke_scene *scene;
  const hooke_system *system;
  hooke_state *first;       /* of the run, from the file */
  int64_t from, to;         /* frames of the slice; `to` decreases to where the budget ends */
  int32_t by_budget, fixed; /* fixed: a fixed step */
  int32_t may_differ;       /* 1: another version or machine wrote the file */

  const char *verdict, *balance, *parts;
  char difference[512];
  int64_t checked;
  double time_from, time_to; /* of the frames `from` and `to` */
  double steps, limit, energy_change, work, heat, residual, residual_refined, bound, error, error_velocity;
  double check_scene, check_last;
  /* version of hooke, SUNDIALS, CHOLMOD, instruction set, machine and BLAS that made the file, and here */
  const char *made_by[HOOKE_VERIFY_FACTS], *here[HOOKE_VERIFY_FACTS];
  char blas[HOOKE_BLAS_SIZE];
};

/* Results of a pass over the slice. */
struct hk_verify_pass {
  int32_t refined;  /* number of refinements */
  int64_t count;    /* frames after the first */
  double *residual; /* by frame */
  struct hk_balance balance;
  double steps;
  double apart[2]; /* largest difference of a coordinate [m] and a velocity [m/s] from the file */
  double error[2]; /* for a refined pass: the same from the first pass */
  /* q and v of each frame of the first pass, if they may differ from the file's; NULL: they are the file's */
  double *own;
};

/* Runs the slice. Without refinement frames are compared, and time limits the slice. HOOKE_DIVERGED and the
 * like occur in refined passes only. */
int32_t hk_verify_pass(struct hk_verify *verify, struct hk_verify_pass *pass);
void hk_verify_pass_release(struct hk_verify_pass *pass);

/* Compares frame 0 with the initial state of the scene, to the bit on any machine. */
int32_t hk_verify_first(const struct hk_verify *verify);

/* Says if the file agrees with its scene, and how far. */
void hk_verify_claim(const hooke_measurement *measurement, struct hk_claims *claims);

extern const struct hk_table hk_verify_tables[];

extern const struct hk_measurement_kind hk_verify_kind;
