/* What the files that see SUNDIALS share. */
#ifndef HOOKE_INTEGRATE_CVODE_H
#define HOOKE_INTEGRATE_CVODE_H

#include "integrate/integrator.h"

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sundials/sundials_linearsolver.h>
#include <sundials/sundials_nonlinearsolver.h>

/* y = (q, v) of the free particles, in rows; or x of a first-order problem. */
struct hooke_cvode {
  SUNContext context;
  void *memory;
  N_Vector y, tolerance;
  SUNLinearSolver linear;
  SUNNonlinearSolver nonlinear;
  int64_t free_count;
  int32_t *free;              /* free particles, NULL if all are */
  double *rows;               /* q, v, dq, dv, out in rows of all particles, for products of the derivative */
  struct hooke_counts before; /* counts when CVODE's own were last set to zero */
  char message[512];          /* CVODE's last complaint */
};

/* Right-hand side, and products with its derivative, as CVODE calls them; the context is the integrator. */
int hooke_cvode_rhs(realtype t, N_Vector y, N_Vector slope, void *ctx);
int hooke_cvode_product_setup(realtype t, N_Vector y, N_Vector slope, void *ctx);
int hooke_cvode_product(N_Vector v, N_Vector product, realtype t, N_Vector y, N_Vector slope, void *ctx,
                        N_Vector scratch);

/* Between y and rows of all particles (3n each); held particles keep what the rows have. */
void hooke_cvode_pack(const hooke_integrator *it, const double *q, const double *v, double *y);
void hooke_cvode_unpack(const hooke_integrator *it, const double *y, double *q, double *v);

#endif
