/* The counted work of a run: the time [s] that its counts take on one thread of the machine of the table of
 * costs (costs.c). It follows from the counts and the system alone, so that it is the same on any machine,
 * however busy, for any number of threads and any instruction set. Callbacks count as their calls: nobody
 * knows what is inside of them. */
#pragma once

#include "integrate/integrator.h"
#include "model/force/force.h"

/* What is counted. The first ones are of each force, by its number in the table of forces: members evaluated,
 * multiplied by their derivative, and put into a matrix. */
enum {
  HOOKE_WORKS_OF_FORCE = 3,
  HOOKE_WORK_STEP = HOOKE_WORKS_OF_FORCE * HOOKE_FORCES, /* steps */
  HOOKE_WORK_ADAPTIVE_STEP,                              /* of methods with error control */
  HOOKE_WORK_ADAPTIVE_PARTICLE,                          /* particles of these steps */
  HOOKE_WORK_EVALUATION,                                 /* evaluations of all forces */
  HOOKE_WORK_PARTICLE,                                   /* particles that these visit */
  HOOKE_WORK_FAR,                                        /* those of them that no cache holds */
  HOOKE_WORK_ADAPTIVE_EVALUATED,                         /* with error control */
  HOOKE_WORK_SCATTERED,        /* springs in no order, multiplied and in matrices as well */
  HOOKE_WORK_CURVED,           /* springs with curves, likewise */
  HOOKE_WORK_BODY,             /* bodies evaluated */
  HOOKE_WORK_BODY_PARTICLE,    /* their particles that a force acts on; all in products */
  HOOKE_WORK_DAMPER,           /* damped springs of steps of shardlow */
  HOOKE_WORK_PRODUCT,          /* products with the derivative */
  HOOKE_WORK_PRODUCT_PARTICLE, /* particles of these */
  HOOKE_WORK_ROWS,             /* elements of products in rows */
  HOOKE_WORK_MATRIX,           /* matrices */
  HOOKE_WORK_MATRIX_PARTICLE,  /* particles of these */
  HOOKE_WORK_VECTOR,           /* vectors that GMRES has made others orthogonal to */
  HOOKE_WORK_VECTOR_PARTICLE,  /* particles of these */
  HOOKE_WORK_FACTOR_PRODUCT,   /* multiplications to factorise */
  HOOKE_WORK_FACTOR_NUMBER,    /* numbers of a factor in a solution */
  HOOKE_WORKS
};

/* Nanoseconds of each. */
extern const double hk_costs[HOOKE_WORKS];

/* Work so far [s]; of a run from a checkpoint, without what its factors had taken before. */
double hk_work_of(const hooke_integrator *integrator);
/* How much of each that is. */
void hk_work_amounts(const hooke_integrator *integrator, double amount[HOOKE_WORKS]);
/* One evaluation of all forces of a committed system [s]. */
double hk_work_of_evaluation(const hooke_system *system);
/* One product with the derivative of all forces [s]. */
double hk_work_of_product(const hooke_system *system);
/* One pass over the elements of all forces, one by one, as bounds take it [s]. */
double hk_work_of_pass(const hooke_system *system);
/* So many steps of a method [s]; NaN if that depends on the steps, as with error control, or where equations
 * are solved. */
double hk_work_of_steps(const hooke_system *system, const char *method, int64_t steps);
/* The same, or what they take at least; 0 if nothing is known of that. */
double hk_work_at_least(const hooke_system *system, const char *method, int64_t steps);
