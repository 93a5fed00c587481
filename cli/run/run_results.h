/* A run and its results, printed in words and as JSON. */
#pragma once

#include "print.h"
#include "report.h"
#include "setup.h"
#include "watch.h"

/* The printed counts: those of work, and last those of springs through zero, and at zero at the end. */
enum { HOOKE_RUN_COUNTS = 9 };

/* A run and the data kept from it. */
struct cli_run {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_integrator *integrator; /* NULL while its error is being measured */
  hooke_options *options;       /* the integrator's */
  int64_t count[HOOKE_RUN_COUNTS];
  double wall_seconds;
  hooke_trajectory *trajectory; /* NULL without -o */
  const char *output;
  const char *resumed;    /* FILE of --resume, which is then the output; NULL: a new run */
  int32_t was_finished;   /* 1: the run was finished already */
  int64_t finished_steps; /* number of steps of such a run; -1: its file does not say */
  int32_t kept_place;     /* 1: an interrupted run has a checkpoint or a frame to continue from */
  struct cli_watch watch;
  double duration;
  const char *page;                   /* where the output is shown before it is removed; NULL: it stays */
  int64_t frames;                     /* reported so far */
  int64_t frames_beyond;              /* those of them after it diverged */
  double last_frame;                  /* time of the last one before that [s]; NaN: none was reported */
  char passages[640];                 /* of springs through length zero, in a sentence */
  char warnings[HOOKE_WARNINGS_SIZE]; /* held back for a second of work */
  int32_t write_status;               /* HOOKE_OK, or why a frame or a checkpoint could not be written */
  int32_t outcome;
  hooke_options *probe_options; /* NULL without --probe */
  const char *probes_file;
  hooke_probes *probes; /* NULL while there is no run */
  int64_t lines;        /* that it has, and the time of the last one [s] */
  double last_line;
  hooke_measurement *why;      /* diagnosis of the outcome; NULL: there is none, or it could not be made */
  hooke_measurement *estimate; /* of its error; NULL: none was requested */
  char message[2048];          /* about the outcome, or the failed write */
  double energy_before, energy_after, energy_scale;
  int64_t coincident_before; /* coincident springs at the start */
};

const char *cli_run_method(const struct cli_run *run);

/* Copies everything that is printed from the integrator, which may then be destroyed. */
void cli_run_take_counts(struct cli_run *run);
int64_t cli_run_coincident(const struct cli_run *run);

/* As JSON with --json, with --final every particle, too; in words the second function prints those. */
void cli_run_print(const struct cli_run *run);
void cli_run_print_final(const struct cli_run *run);

/* Runs the scene, with --want or its own method, into a trajectory that is removed once `show` has written it
 * as `page`. `path` names it, for cli_os_make_file(). After a blow-up, up to `beyond` frames show how
 * it goes on. Everything is reported; returns the exit code. */
typedef int cli_show(const struct cli_run *run, void *context);
int cli_run_to_show(const struct cli_arguments *arguments, char *path, const char *page, double beyond,
                    cli_show *show, void *context);

/* 1 if frames after divergence were asked for. */
int32_t cli_run_goes_beyond(const struct cli_run *run);

/* ---- its error: the wanted one (--want), and the estimated one ---- */

/* Reads --want, refuses it beside a step or a tolerance on the command line, and picks a method and its step
 * or tolerance, which it reports. Does nothing without --want. */
int cli_want_pick(struct cli_run *run);

/* 1 if the error is looked into: not without --want under --no-estimate. */
int32_t cli_want_judges(const struct cli_run *run);

/* Estimates the error of the finished run, if that is looked into, and of any run tells what is watched. */
int32_t cli_want_measure(struct cli_run *run);

/* 1 if the wanted error was not met and something finer is set in the options of the run. */
int32_t cli_want_goes_on(struct cli_run *run);

/* What the estimate says of the run, and what is watched. */
void cli_want_print(const struct cli_run *run);

/* Exit code of a finished run. */
int cli_want_exit_code(const struct cli_run *run);
