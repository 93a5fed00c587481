/* What the methods of SUNDIALS share: vectors, tolerances, the problem as callbacks, GMRES, counts. */
#ifndef HOOKE_INTEGRATE_SOLVE_SUNDIALS_PROBLEM_H
#define HOOKE_INTEGRATE_SOLVE_SUNDIALS_PROBLEM_H

#include "integrate/solve/sundials_vector.h"
#include "integrate/solve/unknowns.h"

#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>

/* Krylov vectors kept; stiff scenes need more than the default of 5. */
enum { HOOKE_KRYLOV_VECTORS = 30 };

struct hk_order_choice;

struct hk_sundials {
  struct hk_unknowns unknowns;
  SUNContext context;
  void *memory; /* the solver's own; its method frees it */
  /* where a Newton iteration is: time, gamma and unknowns; a flag */
  int (*where)(void *memory, realtype *t, realtype *gamma, N_Vector *y);
  N_Vector y, tolerance;
  struct hk_sundials_spare spare;
  SUNLinearSolver linear;
  SUNNonlinearSolver nonlinear;
  struct hk_order_choice *choice; /* of cvode-bdf where it chooses its highest order, else NULL */
  int32_t no_memory;              /* a linear solve of this run was without, which the solver cannot tell */
  struct hk_counts before;        /* counts when the solver's own were last set to zero */
  char message[512];              /* the solver's last complaint */
};

/* Makes integrator->own with context, vectors and tolerances. `implicit`: with a linear solver and room for
 * products of the derivative; `vectors`: how many the solver keeps besides, for the count of memory.
 * HOOKE_NO_MEMORY. */
int32_t hk_sundials_create(hooke_integrator *integrator, int32_t implicit, int64_t vectors);
/* The status of what a solver was made with: `created`, or `no_room` as it said itself. HOOKE_NO_MEMORY,
 * HOOKE_SOLVER_FAILED. */
int32_t hk_sundials_created(const hooke_integrator *integrator, const char *solver, int32_t created,
                            int32_t no_room);
/* Before a run: made anew, if the run before came to be without memory inside the solver. HOOKE_NO_MEMORY. */
int32_t hk_sundials_renew(hooke_integrator *integrator);
/* All but `memory`, which goes first. */
void hk_sundials_release(hooke_integrator *integrator);

/* max_order of the options, `highest` if not given. HOOKE_BAD_VALUE. */
int32_t hk_sundials_order(const hooke_integrator *integrator, int lowest, int highest, int *order);
/* How far a linear solve goes, as a share of what Newton may leave. */
double hk_sundials_linear_share(const hooke_integrator *integrator);

/* Takes up a state for a solver that starts anew; adds the counts it has since; takes its new time, and fails
 * where that has not moved. `solver` is its name for messages. */
void hk_sundials_load(hooke_integrator *integrator, const hooke_state *state);
void hk_sundials_count(hooke_integrator *integrator, struct hk_counts since);
int32_t hk_sundials_advance(hooke_integrator *integrator, const char *solver, int flag, double reached);
/* A time ahead. Only the first step of a solver looks at it, for its direction and size. */
double hk_sundials_towards(const hooke_integrator *integrator);

/* Callbacks; the context is the integrator, that of the message its `own`. */
int hk_sundials_slope(realtype t, N_Vector y, N_Vector slope, void *ctx);
int hk_sundials_product_setup(realtype t, N_Vector y, N_Vector slope, void *ctx);
int hk_sundials_product(N_Vector direction, N_Vector product, realtype t, N_Vector y, N_Vector slope,
                        void *ctx, N_Vector scratch);
void hk_sundials_message(int code, const char *module, const char *function, char *message, void *ctx);

#endif
