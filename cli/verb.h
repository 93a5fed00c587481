/* A verb of the command line: its name, its own options, and its function. */
#pragma once

#include "hooke.h"

/* Exit codes of the program. */
enum cli_exit {
  HOOKE_EXIT_DONE = 0,
  HOOKE_EXIT_USAGE = 2,
  HOOKE_EXIT_BAD_INPUT = 3,
  HOOKE_EXIT_DIVERGED = 4,
  HOOKE_EXIT_IO = 5,
  HOOKE_EXIT_NOT_BUILT = 6,
  HOOKE_EXIT_NOT_MET = 7, /* the wanted error was not met, or cannot be judged */
  HOOKE_EXIT_INTERNAL = 8,
  HOOKE_EXIT_INTERRUPTED = 130
};

struct cli_arguments;
struct cli_results;

/* An option of a verb; `value` names its argument, NULL for a switch. */
struct cli_verb_row {
  const char *name;
  char letter; /* 0: none */
  const char *value;
  const char *doc;
};

struct cli_verb {
  const char *name;
  const char *input; /* its argument, such as "OUT.h5", without options of a run; NULL: a scene, with them */
  int several;       /* 1: it takes more than one */
  const char *summary; /* one line */
  const char *text;    /* a paragraph for --help */
  const char
      *example; /* an example for the manual page, run after those of the verbs before it; may be NULL */
  const struct cli_verb_row *rows;
  int32_t row_count;
  const char *options;   /* name of the table of its own options, for hooke_options_create(); NULL: none */
  const char *hidden;    /* those of that table that it does not take, separated by blanks; NULL: none */
  int takes_kind;        /* 1: takes a kind of part instead of a scene, and its options */
  const char *for_scene; /* its option that replaces the scene; NULL: none */
  int takes_no_run;      /* 1: none of the options of a run */
  const char *without;   /* options of a run that it does not take, separated by blanks; NULL: none */
  int (*function)(const struct cli_arguments *arguments);
  /* Instead, of one that makes the measurement that its options are of (cli_results_make()): checks the
   * arguments (NULL: nothing to check), makes the scene ready, and tells what was found. */
  int (*check)(const struct cli_arguments *arguments);
  int (*ready)(struct cli_results *results);
  int (*tell)(struct cli_results *results);
};

/* Of verbs that look at a state (cli_results_at()), and of those that may begin at rest (setup.h). */
#define HOOKE_AT                                                                                             \
  {                                                                                                          \
    "at", 0, "FILE:FRAME",                                                                                   \
        "at a frame of a trajectory, the last one if FRAME is left out; else at the start"                   \
  }
#define HOOKE_FROM_REST                                                                                      \
  {                                                                                                          \
    "from-rest", 0, NULL,                                                                                    \
        "starts the scene at its position of rest, as 'hooke rest' finds it, and not moving"                 \
  }

/* Of verbs that may take a force of the user's own (force.h). */
#define HOOKE_FORCE                                                                                          \
  {                                                                                                          \
    "force", 0, "FILE:NAME",                                                                                 \
        "adds the force of a shared library: its function NAME, hooke_own_force if left out, beside "        \
        "hooke_own_force_abi"                                                                                \
  }

#define HOOKE_VERB_ROWS(list) .rows = (list), .row_count = (int32_t)(sizeof(list) / sizeof((list)[0]))

extern const struct cli_verb cli_verb_run;
extern const struct cli_verb cli_verb_check;
extern const struct cli_verb cli_verb_compare;
extern const struct cli_verb cli_verb_study;
extern const struct cli_verb cli_verb_limit;
extern const struct cli_verb cli_verb_why;
extern const struct cli_verb cli_verb_needs;
extern const struct cli_verb cli_verb_rest;
extern const struct cli_verb cli_verb_make;
extern const struct cli_verb cli_verb_view;
extern const struct cli_verb cli_verb_verify;
extern const struct cli_verb cli_verb_modes;
