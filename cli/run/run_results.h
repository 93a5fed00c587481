/* A run, and what it gave, printed for a person and for a program. */
#ifndef HOOKE_CLI_RUN_RESULTS_H
#define HOOKE_CLI_RUN_RESULTS_H

#include "print.h"
#include "setup.h"
#include "watch.h"

/* The counts that are told: those of work, and last the springs whose ends are at one place. */
enum { HOOKE_RUN_COUNTS = 8 };

/* A run and what is kept of it. */
struct cli_run {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_integrator *integrator; /* NULL once its error is being measured */
  hooke_options *options;       /* the integrator's */
  int64_t count[HOOKE_RUN_COUNTS];
  double wall_seconds;
  hooke_trajectory *trajectory; /* NULL without -o */
  const char *output;
  const char *resumed;    /* FILE of --resume, which is the output then; NULL: a run from the beginning */
  int32_t was_finished;   /* 1: there was nothing to go on with */
  int64_t finished_steps; /* that such a run took; -1: its file does not say */
  int32_t kept_place;     /* 1: of an interrupted run, a checkpoint or a frame to go on from */
  struct cli_watch watch;
  double duration;
  int32_t shown;         /* 1: the output is there to be shown and removed */
  int64_t frames;        /* reported so far */
  int64_t frames_beyond; /* those of them after it diverged */
  int32_t write_status;  /* HOOKE_OK, or why a frame or a checkpoint could not be written */
  int32_t outcome;
  hooke_measurement
      *why; /* of an outcome that wants explaining; NULL: there is nothing, or nothing to explain it with */
  hooke_estimate *estimate; /* of its error; NULL: none is asked for */
  char message[2048];       /* about the outcome, or the write that failed */
  double energy_before, energy_after;
  int64_t coincident_before; /* springs with both ends at one place at the start */
};

const char *cli_run_method(const struct cli_run *run);

/* Takes over what is told of the integrator, which may be destroyed then. */
void cli_run_take_counts(struct cli_run *run);
int64_t cli_run_coincident(const struct cli_run *run);

/* With --json, as JSON, with --final every particle, too; for a person those come by the second function. */
void cli_run_print(const struct cli_run *run);
void cli_run_print_final(const struct cli_run *run);

/* 1 if frames after divergence were asked for. */
int32_t cli_run_goes_beyond(const struct cli_run *run);

/* Runs the scene into a trajectory that is there to be shown, with --want or its own method (run.c); `outcome` as
 * hooke_integrator_run() has it. A failure is reported and gives the exit code. */
int cli_run_to_show(const struct cli_arguments *arguments, const char *output, int32_t *outcome);

#endif
