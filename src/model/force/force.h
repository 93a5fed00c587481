/* The table of forces: one row each. A new force is one file (force_*.c) and a name below. */
#pragma once

#include "model/force/element.h"
#include "model/group.h"
#include "model/sum/motion.h"
#include "model/sum/pattern.h"

/* The rows, in the order of summation at a particle. Gravity is last: a = w f + g. */
#define HOOKE_FORCE_ROWS(each)                                                                               \
  each(springs) each(bending) each(altitude) each(anchor) each(obstacles) each(fluid) each(linear)           \
      each(drag) each(medium) each(quadratic) each(wind) each(loads) each(callback) each(weight)             \
          each(gravity)
#define HOOKE_COUNT_ROW(name) +1
enum { HOOKE_FORCES = 0 HOOKE_FORCE_ROWS(HOOKE_COUNT_ROW) };

struct hk_variant_maker;

/* A state in rows of x y z, with a displacement of it for derivatives. */
struct hk_point {
  double t;
  const double *q, *v, *dq, *dv;
  int32_t *stop_value; /* receives the value of a callback that stopped */
  int32_t in_rows;     /* 1: q begins rows for a callback that have v, dq, dv and the product after it */
};

/* How a force is linearised and summed, to be combined in sets: by loops of its own, as springs are; by its
 * constant K and C (`multiply`); element by element; by one number at every particle, as drag is, which is
 * part of moves; by asking the caller. */
enum {
  HOOKE_LOOPED = 1,
  HOOKE_CONSTANT = 2,
  HOOKE_KEPT = 4,
  HOOKE_OTHERS = HOOKE_CONSTANT | HOOKE_KEPT,
  HOOKE_UNIFORM = 8,
  HOOKE_CALLED = 16
};

/* Of the forces on the particles of a member. */
struct hk_member_change {
  int32_t count, particle[HOOKE_MEMBER_PARTICLES];
  double force[HOOKE_MEMBER_PARTICLES][3];
};

/* Everything but `name`, `check` and `recall` or `copy` may be NULL, if the force has no such part.
 * A force with elements has its heat and its derivative from them, unless a function says better. */
struct hk_force_row {
  const char *name;
  int32_t kind;       /* one of these; 0 without elements */
  int32_t is_drag;    /* 1: brakes what moves in the medium, be it rigid */
  int32_t not_linear; /* 1: not linear in velocities, so that its damping is that of a state */
  int32_t in_scenes;  /* 1: scenes have a key for it */
  int32_t
      on_free; /* 1: its members are on free particles alone: others are refused, and left out of variants */
  /* for forces with groups: the name of its members, of one, and of the argument that lists them; particles
   * and numbers of each, by HOOKE_KAPPA and so on; the maximum bytes of one (see size_limit.c) */
  const char *members, *member, *place;
  int32_t member_particles, width[HOOKE_GROUP_NUMBERS];
  double bytes;
  const struct hk_option_table *options; /* of a group, by the name of the force */
  const char *title;                     /* for forces with elements: "the <title> of particle 3" */
  /* for forces with groups: takes over the groups at commit (HOOKE_NO_MEMORY leaves nothing); releases them;
   * their bytes; fills the columns of as many members as they have, from number `first` on, as they were */
  int32_t (*commit)(hooke_system *system, const struct hk_group *group, int64_t count);
  void (*release)(hooke_system *system);
  int64_t (*memory)(const hooke_system *system);
  void (*recall)(const hooke_system *system, int64_t first, struct hk_group *columns);
  /* adds all that the force depends on, where it is present, to a check value */
  void (*check)(const hooke_system *system, uint32_t *value);
  /* adds a force without groups to a variant that does not leave it out */
  int32_t (*copy)(const struct hk_variant_maker *maker);
  int32_t (*present)(const hooke_system *system); /* NULL: where it has elements */
  /* f += force, on the working copy; HOOKE_STOPPED if a callback asked for it */
  int32_t (*add)(const hooke_system *system, struct hk_motion *motion, double t);
  /* for forces with a rest length: members that passed through length zero between two positions; the ends of
   * the first of them, -1 for a point */
  int64_t (*passed)(const hooke_system *system, const double *before, const double *now, int64_t ends[2]);
  /* potential energy [J], and power dissipated as heat [W] */
  double (*energy)(const hooke_system *system, double t, const double *q);
  double (*heat)(const hooke_system *system, double t, const double *q, const double *v);
  /* for forces that may do work which is no change of their energy, as what is prescribed in time does: 1 if
   * they do; the power of it [W] */
  int32_t (*does_work)(const hooke_system *system);
  double (*power)(const hooke_system *system, double t, const double *q, const double *v);
  /* change of the forces of member `number` along dq and dv; 0 if there is none, which the particles still
   * say */
  int32_t (*change)(const hooke_system *system, int64_t number, const struct hk_point *point,
                    struct hk_member_change *out);
  /* adds df/dq and df/dv to 3x3 blocks, either of which may be NULL, quicker than from changes or elements */
  void (*add_blocks)(const hooke_system *system, double t, const double *q, const double *v,
                     const struct hk_pattern *pattern, double *dfdq, double *dfdv);
  /* out += (df/dq) dq + (df/dv) dv */
  int32_t (*add_product)(const hooke_system *system, const struct hk_point *point, double *out);
  /* number of elements (NULL: in a force with groups an element is a member), and those from number `first`
   * on: see element.h */
  int64_t (*count)(const hooke_system *system);
  void (*elements)(const hooke_system *system, double t, const double *q, const double *v, int64_t first,
                   int64_t count, struct hk_element *out);
  /* the next ones in a faster memory order, and their number; NULL or -1: that is the order of their numbers
   */
  int64_t (*stored_elements)(struct hk_elements *at);
  /* for a force with constant K and C: out += (a K + b C) x, with x, y and z apart */
  void (*multiply)(const hooke_system *system, double a, double b, const double *const x[3],
                   double *const out[3]);
  /* sum += the stiffness of every member along the direction in which it stores most, at its shortest [N/m]:
   * displacements of size d store half of it times d^2 (see integrate/loop/divergence.c) */
  void (*add_stiffness)(const hooke_system *system, double *sum);
  /* of constant forces with an energy and without elements: adds the magnitudes of their components [N], and
   * the sum of f.f/m over free particles, which move by themselves [N^2/kg] */
  void (*add_pull)(const hooke_system *system, double *force, double *kick);
  /* 1 if some element is damped; NULL: its groups know */
  int32_t (*damped)(const hooke_system *system);
};

/* What a force with groups has of them, each by its own name. */
#define HOOKE_FORCE_OF_GROUPS                                                                                \
  .recall = recall, .commit = commit, .release = release, .memory = memory, .check = check

#define HOOKE_DECLARE_ROW(name) extern const struct hk_force_row hk_force_##name;
HOOKE_FORCE_ROWS(HOOKE_DECLARE_ROW)

/* Rows for a callback, held once; hooke_rows_hold(rows, -1) releases them. NULL without memory. */
double *hk_rows_new(int64_t numbers);
/* Leaves rows that a callback holds to it; a copy takes their place. HOOKE_NO_MEMORY. */
int32_t hk_rows_renew(int64_t numbers, double **rows);

/* out = (df/dq) dq + (df/dv) dv of the forces of a committed system except those of the kinds `left_out` (0:
 * none). HOOKE_STOPPED, with the point's stop value, if a callback asked for it. */
int32_t hk_forces_product(const hooke_system *system, const struct hk_point *point, int32_t left_out,
                          double *out);

/* The same in rows for a callback: q, v, dq, dv and the product. */
int32_t hk_forces_product_in_rows(const hooke_system *system, double t, int32_t left_out, double **rows,
                                  int32_t *stop_value);

/* Releases everything that commit took over from groups. */
void hk_forces_release(hooke_system *system);

/* 1 if a force damps motion; and if some force of these kinds does: 0 asks for all but a callback, of which
 * nothing is known. */
int32_t hk_force_is_damped(const hooke_system *system, const struct hk_force_row *row);
int32_t hk_system_is_damped(const hooke_system *system, int32_t kinds);
/* 1 if something but drag is; and if a force of a committed system is not linear in velocities. */
int32_t hk_system_has_dampers(const hooke_system *system);
int32_t hk_system_is_not_linear(const hooke_system *system);
/* Sets touched[p] to 1 for every particle of a spring, a triple or a tetrahedron. */
void hk_system_mark_touched(const hooke_system *system, uint8_t *touched);
/* Number of elements of the forces of these kinds. */
int64_t hk_elements_of(const hooke_system *system, int32_t kinds);

/* 1 if work is done on a system from outside, by drives or by forces; if by forces; their power at a state
 * [W]. */
int32_t hk_system_takes_work(const hooke_system *system);
int32_t hk_forces_do_work(const hooke_system *system);
double hk_forces_power(const hooke_system *system, double t, const double *q, const double *v);

/* 1 if a committed system has the force; its elements. */
int32_t hk_force_is_present(const hooke_system *system, const struct hk_force_row *row);
int64_t hk_force_count(const hooke_system *system, const struct hk_force_row *row);

/* Row `k` of the table, NULL past the last; and the number of a row. */
const struct hk_force_row *hk_force_table(int32_t k);
/* Row of that name; NULL if there is none. */
const struct hk_force_row *hk_force_find(const char *name);
int32_t hk_force_number(const struct hk_force_row *row);
