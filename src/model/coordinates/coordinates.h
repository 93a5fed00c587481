/* The table of coordinates, twin of the table of forces: things whose particles move by coordinates of their
 * own in place of each by itself. A new kind is one file and one row. A state is (t, q, v) with such things
 * as without: their own coordinates are a function of the rows of their particles. Components of x, y and z
 * are `stride` apart. */
#pragma once

#include <stdint.h>

struct hooke_state;
struct hooke_system;
struct hk_motion;
struct hk_body_tangent;
struct hk_variant_maker;

/* Most own coordinates of one thing, and most numbers of a push on it. */
enum { HOOKE_MOST_OWN = 13, HOOKE_PUSH = 6 };

struct hk_coordinates_row {
  const char *name;
  int32_t numbers; /* own coordinates of one thing: of position, then of velocity */
  int32_t solved;  /* 1: implicit methods know it (integrate/solve/body_stage.h) */
  int32_t turns;   /* 1: it is a rigid body (model/coordinates/body_tangent.h) */

  /* While a system is built and committed; these have its list. Commit returns HOOKE_BAD_VALUE and
   * HOOKE_NO_MEMORY, and adds what moves by hk_mover_add(); undoing leaves the list. The
   * forces are known later: `acted` is 1 for each particle that one may act on (HOOKE_NO_MEMORY). */
  int64_t (*count)(const struct hooke_system *system);
  int32_t (*commit)(struct hooke_system *system);
  int32_t (*find_acted)(struct hooke_system *system, const uint8_t *acted);
  void (*undo)(struct hooke_system *system);
  void (*release)(struct hooke_system *system);
  double (*bytes)(const struct hooke_system *system); /* needed at most */
  int64_t (*memory)(const struct hooke_system *system);
  void (*check)(const struct hooke_system *system, uint32_t *value);
  int32_t (*copy)(const struct hk_variant_maker *maker); /* into a variant */
  int32_t (*copy_one)(const void *thing, struct hooke_system *to);
  int32_t (*check_state)(const struct hooke_system *system, const struct hooke_state *state);

  /* Motion of one thing. `push` has its acceleration, gravity included, and what turns it, by the forces of
   * the working copy, which `clear` makes 0 where any may act; `own` += h push; free motion over h; d own/dt;
   * accelerations of its particles, 3 each of all. */
  const int32_t *(*particles)(const void *thing, int64_t *count);
  int64_t (*acted)(const struct hooke_system *system, const void *thing); /* particles that `push` reads */
  void (*read)(const void *thing, const double *const q[3], const double *const v[3], int64_t stride,
               double *own);
  void (*write)(const struct hooke_system *system, const void *thing, const double *own, double *const q[3],
                double *const v[3], int64_t stride, int32_t only_acted); /* of free particles */
  void (*push)(const struct hooke_system *system, const void *thing, const struct hk_motion *motion,
               const double *own, double *push);
  void (*clear)(const void *thing, double *const f[3]);
  void (*kick)(const void *thing, double h, const double *push, double *own);
  void (*drift)(const void *thing, double h, double *own);
  void (*slope)(const void *thing, const double *own, const double *push, double *slope);
  void (*accelerate)(const struct hooke_system *system, const void *thing, const double *own,
                     const double *push, double *out);
  void (*normalise)(double *own); /* NULL: nothing to do */
  /* of each own coordinate, which allows its particles these errors of position and velocity */
  void (*tolerance)(const void *thing, double position, double velocity, double *tolerance);

  /* Small motions x = J y of its particles, with J^T M J = I (measure/spectrum/rigid.h): J y, J^T times the
   * weights (NULL: 1) times x, whether it has unknown k < HOOKE_PUSH, and an upper bound on the square of J's
   * row of one. */
  void (*spread)(const struct hooke_system *system, const struct hk_body_tangent *tangent, const double *y,
                 double *const x[3], int64_t stride);
  void (*gather)(const struct hooke_system *system, const struct hk_body_tangent *tangent,
                 const double *weight, const double *const x[3], int64_t stride, double *y);
  int32_t (*has)(const void *thing, int k);
  double (*reach)(const struct hk_body_tangent *tangent, int64_t particle);
};

/* A thing of a committed system that moves by itself. */
struct hk_mover {
  const struct hk_coordinates_row *row;
  const void *thing;
  int64_t at; /* of its own coordinates among those of all */
};

enum { HOOKE_COORDINATES = 1 }; /* rows */
extern const struct hk_coordinates_row hk_coordinates_of_bodies;

/* Row k, NULL past the last. */
const struct hk_coordinates_row *hk_coordinates_table(int32_t k);

/* By all rows: see there. Committing finds the movers, and which particles they carry. */
int32_t hk_movers_commit(struct hooke_system *system);
void hk_mover_add(struct hooke_system *system, const struct hk_coordinates_row *row, const void *thing);
void hk_movers_undo(struct hooke_system *system);
void hk_movers_release(struct hooke_system *system);
double hk_movers_bytes(const struct hooke_system *system);
int64_t hk_movers_memory(const struct hooke_system *system);
int32_t hk_movers_check_state(const struct hooke_system *system, const struct hooke_state *state);
/* 1 if every mover's kind is `solved`. */
int32_t hk_movers_are_solved(const struct hooke_system *system);

/* Own coordinates of all movers from the working copy and to it, or only to what forces and reading them
 * again need. `push` has HOOKE_PUSH numbers for each. */
void hk_movers_read(const struct hooke_system *system, const struct hk_motion *motion, double *own);
void hk_movers_write(const struct hooke_system *system, struct hk_motion *motion, const double *own,
                     int32_t only_acted);
void hk_movers_push(const struct hooke_system *system, const struct hk_motion *motion, const double *own,
                    double *push);
void hk_movers_normalise(const struct hooke_system *system, double *own);
void hk_movers_tolerance(const struct hooke_system *system, double position, double velocity,
                         double *tolerance);
void hk_movers_slope(const struct hooke_system *system, const double *own, const double *push, double *slope);
/* Accelerations of the particles of all movers at the forces and rows of the working copy. */
void hk_movers_accelerate(const struct hooke_system *system, const struct hk_motion *motion, double *out);
/* Writes the rows (3n) of the particles of all movers anew, from their own coordinates. */
void hk_movers_renew(const struct hooke_system *system, double *q, double *v);
