/* One system over the ranks of a communicator. Every particle has an owner. A rank has a system of its own:
 * the particles that it owns, and ghosts, which are those that a step of its own depends on. Members of
 * forces keep their order in it, so the sums over owned particles have the bits of the whole system's. After
 * every step ghosts are overwritten by what their owners have. */
#ifndef SPLIT_H
#define SPLIT_H

#include <hooke.h>
#include <mpi.h>
#include <stddef.h>

struct split {
  MPI_Comm all;
  int rank, ranks;
  int64_t n;      /* particles of the whole system */
  int32_t *owner; /* n */

  hooke_system *system;           /* of this rank: */
  int64_t count, *global;         /* its particles, ascending, by their numbers in the whole system */
  int64_t own, *mine;             /* those that it owns, by their numbers in its system */
  int64_t gives, *give;           /* those that others have as ghosts, rank by rank, and in the same way */
  int64_t gets, *get;             /* its ghosts */
  double *given, *got;            /* their positions, and behind these their velocities: 6 gives, 6 gets */
  MPI_Comm near;                  /* the ranks that it trades with */
  int *out, *out_at, *in, *in_at; /* with each of them, in particles */
  MPI_Datatype row;               /* x y z */
  int *owned, *owned_at;          /* of every rank, and where they are in: */
  int64_t *order;                 /* all particles, owner by owner */
  double *rows;                   /* at rank 0: 3n; elsewhere NULL */
  double stepping, trading;       /* time spent by split_step() [s] */
};

/* Evaluations of forces in a step of its method that depend on each other; 0 if it does not run over ranks.
 */
int split_depth(const hooke_integrator *integrator);

/* Splits a committed system by recursive bisection of the positions q (3n) into parts of equally many
 * particles, or with `seed` > 0 at random. `depth`: evaluations of forces in a step that depend on each
 * other. On all ranks together; returns the status of this one. */
int32_t split_make(MPI_Comm all, const hooke_system *whole, const double *q, int depth, unsigned seed,
                   struct split *split);
void split_release(struct split *split);

/* Sends `given` to the ranks that have these ghosts, and fills `got`. */
void split_trade(struct split *split);
/* A step of the integrator of this rank's system, if `status` is HOOKE_OK, and the ghosts after it. A rank
 * whose status is another sends NaN, and goes on trading until all ranks agree that the run ends. */
int32_t split_step(struct split *split, hooke_integrator *integrator, int32_t status);
int split_is_finite(int64_t count, const double *value);
/* Brings rows of what each rank owns to rank 0, which has them by their numbers in the whole system in `rows`
 * (3n); NULL on the others. */
void split_collect(struct split *split, const double *own, double *rows);
/* The worst status of all ranks, an error before an outcome. The first rank that has one prints its message.
 */
int32_t split_agree(MPI_Comm all, int32_t status);

/* MPI_Allreduce() that leaves the core to others while it waits, as all of this does. */
void split_reduce(MPI_Comm all, const void *own, void *result, int count, MPI_Datatype type, MPI_Op op);

/* Zeros; ends the program on all ranks if there is no memory. */
void *split_zeros(int64_t count, size_t size);

#endif
