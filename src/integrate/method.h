/* The table of methods. A new method is one file and one row in method.c. */
#pragma once

#include "hooke/integrator.h"

#include <stddef.h>

/* The kinds of stability of a step h, which determine bounds, limits and regions (measure/spectrum). K and C
 * are stiffness and damping over mass; lambda are the eigenvalues of the motion. */
enum {
  HOOKE_STABILITY_UNKNOWN,
  HOOKE_STABLE_ALWAYS,
  HOOKE_STABLE_BY_K,          /* where h^2 K <= 4: damping is implicit */
  HOOKE_STABLE_BY_K_AND_C,    /* where h^2 K + 2 h C <= 4 */
  HOOKE_STABLE_BY_POLYNOMIAL, /* where |R(h lambda)| <= 1, R(z) = 1 + z + ... + z^degree/degree! */
  HOOKE_STABLE_BY_PREDICTION  /* where h^2 K + 2 h C - h^2 C^2 <= 4 and h C <= 2: damping is at predicted v */
};

struct hk_stability {
  int32_t kind;
  int32_t damps_implicitly; /* 1: the method treats damping implicitly, */
  int32_t damps_apart;      /* and 1: for half a step before and after one without it */
  int32_t degree;           /* 1, 2 or 4 */
  double axis;      /* square of |h lambda| up to which all of the imaginary axis is stable; 0: none */
  double half_disc; /* |h lambda| up to which all of the left half plane is stable; 0: none */
  const char *note; /* NULL: nothing */
};

/* The tableau of an explicit Runge-Kutta method in whole numbers (Butcher 1964): stage k + 1 is 1/over[k] of
 * a step ahead, where the rate of stage k alone leads to from the start. The last number divides the sum of
 * all rates, of which those between the first and the last count twice (kernel/move_loops.h). */
struct hk_stages {
  int32_t count, over[4];
};

/* One step of an implicit method, or a part of it, from the motion at time t to `end`, by stages
 * (integrate/solve/stage.h). */
struct hk_span_of_time {
  double t, h, end;
};
typedef int32_t hk_stages_of_step(hooke_integrator *integrator, struct hk_span_of_time span);

/* How a method is run. `create`, `destroy` and `forget` may be NULL. All return a status. */
struct hk_steps {
  int32_t (*create)(hooke_integrator *integrator);
  void (*destroy)(hooke_integrator *integrator);
  /* discards its memory of a motion that was changed by hand; an adaptive method restarts instead. */
  void (*forget)(hooke_integrator *integrator);
  /* loads t, q and v */
  int32_t (*begin)(hooke_integrator *integrator, const hooke_state *state);
  /* one step; an adaptive method advances integrator->t, for a fixed-step one the loop does */
  int32_t (*step)(hooke_integrator *integrator);
  /* writes the solution at time t, which lies within the last step */
  int32_t (*store)(hooke_integrator *integrator, double t, hooke_state *state);
};

/* Those of explicit Runge-Kutta methods, by their `stages`, and of implicit ones, by what is `solved`. */
extern const struct hk_steps hk_explicit_steps, hk_implicit_steps;

/* Problems beside q' = v, v' = W f: systems in which bodies move, overdamped ones, and x' = phi(t, x). */
enum {
  HOOKE_TAKES_BODIES = 2,
  HOOKE_TAKES_OVERDAMPED = 4,
  HOOKE_TAKES_FIRST_ORDER = 8,
  HOOKE_TAKES_ALL = 14
};

/* What a row says of itself. */
struct hk_method {
  const char *name, *summary;
  const char *needs;    /* required library, NULL: none */
  int32_t reference;    /* 1: for checking references only, not listed; found by name */
  int32_t adaptive;     /* 1: chooses its steps from tolerances; 0: takes `step` */
  int32_t interpolates; /* 1: its solution is known within the last step as well as at the end */
  int32_t order;        /* of a fixed-step method, on smooth forces */
  const char *judge; /* of its runs: a method of higher order, or of another kind; NULL: none of its cost */
  const char *checked_by;       /* the method that the beginning of its runs is held against; NULL: rk4 */
  int32_t takes;                /* HOOKE_TAKES_* */
  const struct hk_steps *steps; /* NULL: this build lacks the library */
  struct hk_stages stages;
  hk_stages_of_step *solved; /* takes a step by solving nonlinear equations, with the option `newton` */
  int32_t states;            /* that it keeps beside the stage; */
  int32_t swings;            /* 1: a step that raises energy is taken in quarters at least: more swing on */
  int32_t by_tiles;          /* 1: steps by hk_integrator_move() alone, if `choose` says nothing else */
  /* the second where bodies move or damping is not linear, unless it is of unknown kind */
  struct hk_stability stability, with_bodies;
  /* the largest step [s] at which it solves nothing, where larger ones do: 0 if all do, infinite if none
   * does; and the one that damping alone allows, in any direction. NULL: steps of all sizes cost the same */
  int32_t (*explicit_step)(const hooke_system *system, double *step, double *damped);
  /* before there is a motion: what depends on the system and the options, `by_tiles` among it; or NULL */
  int32_t (*choose)(hooke_integrator *integrator);
};

extern const struct hk_method hk_forward_euler, hk_symplectic_euler, hk_verlet, hk_shardlow, hk_heun, hk_rk4,
    hk_backward_euler, hk_tr_bdf2, hk_implicit_midpoint, hk_cvode_bdf, hk_cvode_adams, hk_rk8pd,
    hk_arkode_esdirk;

/* Row of this name. HOOKE_BAD_VALUE, with those that there are; HOOKE_NOT_BUILT. */
int32_t hk_method_take(const char *name, const struct hk_method **method);
/* Row of this name, or NULL; its stability, of unknown kind if there is no such method. */
const struct hk_method *hk_method_find(const char *name);
const struct hk_stability *hk_method_stability(const char *name);
/* The same for steps of this committed system. */
const struct hk_stability *hk_method_stability_in(const char *name, const hooke_system *system);

/* 1 if the method takes this committed system. */
int32_t hk_method_suits(const char *name, const hooke_system *system);
/* The names of all methods with commas between them, for messages. */
void hk_method_list(char *list, size_t size);
/* HOOKE_UNSUITED if it does not, with those that do; NULL: a problem x' = phi(t, x). */
int32_t hk_method_require(const struct hk_method *method, const hooke_system *system);

/* The explicit method of Euler that this committed system takes. */
const char *hk_method_of_euler(const hooke_system *system);

/* 1 if no step is stable without damping. */
int32_t hk_method_needs_damping(const char *name);
