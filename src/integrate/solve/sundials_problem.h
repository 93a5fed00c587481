/* Common parts of the methods of SUNDIALS: vectors, tolerances, the problem as callbacks, GMRES, counts. */
#pragma once

#include "integrate/solve/sundials_names.h"
#include "integrate/solve/sundials_vector.h"
#include "integrate/solve/unknowns.h"

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>

/* Krylov vectors kept; stiff scenes need more than the default of 5. */
enum { HOOKE_KRYLOV_VECTORS = 30 };

struct hk_order_choice;

/* What is asked of a solver's memory, and its name for messages. */
struct hk_sundials_solver {
  const char *name;
  void (*free)(void **memory);
  int (*steps)(void *memory, long *count), (*error_test_failures)(void *memory, long *count);
  int (*nonlinear)(void *memory, long *iterations, long *failures), (*linear)(void *memory, long *iterations);
};

struct hk_sundials {
  const struct hk_sundials_solver *solver;
  struct hk_unknowns unknowns;
  SUNContext context;
  void *memory; /* the solver's own */
  /* point of a Newton iteration: time, gamma and unknowns; a flag */
  int (*where)(void *memory, sunrealtype *t, sunrealtype *gamma, N_Vector *y);
  N_Vector y, tolerance;
  struct hk_sundials_spare spare;
  SUNLinearSolver linear;
  SUNNonlinearSolver nonlinear;
  struct hk_order_choice *choice; /* for cvode-bdf if it chooses its highest order, else NULL */
  int32_t no_memory;              /* a linear solve of this run lacked memory; the solver cannot tell */
  struct hk_counts before;        /* counts when the solver's own were last set to zero */
  char message[512];              /* the solver's last complaint */
};

/* Creates integrator->own with context, vectors and tolerances. `implicit`: with a linear solver and space
 * for products of the derivative; `vectors`: number of vectors that the solver keeps in addition, for the
 * count of memory. HOOKE_NO_MEMORY. */
int32_t hk_sundials_create(hooke_integrator *integrator, const struct hk_sundials_solver *solver,
                           int32_t implicit, int64_t vectors);
/* The first of two flags of SUNDIALS that is no success: its setters refuse what was not set up before. */
static inline int hk_first_flag(int flag, int next) {
  return flag != SUN_SUCCESS ? flag : next;
}
/* Status of creating a solver: `created`, or `no_room` as it reported itself. HOOKE_NO_MEMORY,
 * HOOKE_SOLVER_FAILED. */
int32_t hk_sundials_created(const hooke_integrator *integrator, int32_t created, int32_t no_space);
/* Before a run: recreates the solver if the previous run lacked memory inside it. HOOKE_NO_MEMORY. */
int32_t hk_sundials_renew(hooke_integrator *integrator);
void hk_sundials_release(hooke_integrator *integrator);

/* Max_order of the options, `highest` if not given. HOOKE_BAD_VALUE. */
int32_t hk_sundials_order(const hooke_integrator *integrator, int lowest, int highest, int *order);
/* Accuracy of a linear solve, as a fraction of Newton's tolerance. */
double hk_sundials_linear_share(const hooke_integrator *integrator);

/* Loads a state for a solver that restarts; adds its counts, reads its new time, and fails if that has not
 * advanced. */
void hk_sundials_load(hooke_integrator *integrator, const hooke_state *state);
int32_t hk_sundials_advance(hooke_integrator *integrator, int flag, double reached);
/* A time ahead. Only the first step of a solver uses it, for its direction and size. */
double hk_sundials_towards(const hooke_integrator *integrator);

/* ---- sundials_linear.c ---- */

/* Creates own->linear as the option linear_solver says: GMRES of SUNDIALS on all unknowns for `gmres`, for
 * first-order problems and if nothing is free. HOOKE_NO_MEMORY. */
int32_t hk_sundials_linear_create(hooke_integrator *integrator);

/* Forgets adaptations of earlier solves: a run restarts. */
void hk_sundials_linear_begin(hooke_integrator *integrator);

/* 1 if own->linear brings its own products. */
int32_t hk_sundials_linear_is_own(const hooke_integrator *integrator);

/* ---- callbacks; the context is the integrator ---- */

int hk_sundials_slope(sunrealtype t, N_Vector y, N_Vector slope, void *ctx);
int hk_sundials_product_setup(sunrealtype t, N_Vector y, N_Vector slope, void *ctx);
int hk_sundials_product(N_Vector direction, N_Vector product, sunrealtype t, N_Vector y, N_Vector slope,
                        void *ctx, N_Vector scratch);
