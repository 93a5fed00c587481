/* Elements: every force between particles, linearised, is a sum of them. An element has up to four particles
 * p_j with weights g_j and a unit direction u, and adds
 *   K = (g g^T) (x) (k_along u u^T + k_across (I - u u^T))
 *   C = (g g^T) (x) (c_along u u^T + c_across (I - u u^T))
 * The force changes by -K dq - C dv. A spring has g = (1, -1), kappa along and T/r across, and gamma along; a
 * triple of bending g = (1, -2, 1) and c in all directions; an altitude spring its four weights, without the
 * effect of its tension; drag g = (1) and c in all directions. The unsymmetric derivative from the rotation
 * of a damped spring is left out. */
#pragma once

#include <math.h>
#include <stdint.h>

struct hk_force_row;
struct hooke_system;

/* Threshold of tension: a smaller fraction of the stiffness along an element is rounding of positions. */
#define HOOKE_STRETCH_ROUNDING 1e-9

struct hk_element {
  int32_t count, particle[4];
  double weight[4], u[3]; /* 0 if the element has no direction: it is isotropic */
  double k_along, k_across, c_along, c_across;
  double over; /* the four numbers are to be divided by this one, which is 1 unless velocities are given */
  int32_t pull_only; /* 1: only pulls, with this tension where nothing moves [N]; given q and no v */
  double elastic;
};

/* A walk over elements: for (hk_begin_elements(system, t, q, v, &at); (e = hk_next_element(&at)) != NULL;)
 * With positions q and velocities v (rows), elements are those of the forces there; slack ones are 0. Without
 * v (NULL) they are those of small displacements from rest: springs that only pull count as taut, and a
 * spring of no length is stiff and damped in all directions. k_across is negative where a spring is
 * compressed. Without q and v only particles are set. Forces are those of time t. Where only `flow` is set,
 * what is not linear in velocities is linearised at these. */
enum { HOOKE_ELEMENTS = 64 };
struct hk_elements {
  const struct hooke_system *system;
  double t;
  const double *q, *v, *flow;
  int32_t kinds;                   /* of forces (see force.h); 0: all */
  const struct hk_force_row *only; /* NULL: the same; otherwise this force alone */
  int32_t by_number;               /* 1: in the order of their numbers; 0: in memory order, without `first` */
  int32_t next;                    /* row of the table of forces */
  const struct hk_force_row *force; /* of the current ones */
  int64_t batches;                  /* so far */
  int64_t done;                     /* elements of the force before the current ones */
  int64_t first, count, k;          /* number of the first of the current ones */
  int64_t place[3];                 /* of a force with another memory order */
  struct hk_element element[HOOKE_ELEMENTS];
};
void hk_begin_elements(const struct hooke_system *system, double t, const double *q, const double *v,
                       struct hk_elements *at);
int32_t hk_fill_elements(struct hk_elements *at);

static inline const struct hk_element *hk_next_element(struct hk_elements *at) {
  if (at->k == at->count && !hk_fill_elements(at)) return 0;
  return &at->element[at->k++];
}

/* Number of the last element, in a walk by number. */
static inline int64_t hk_element_number(const struct hk_elements *at) {
  return at->first + at->k - 1;
}

/* The last element as stiff as it is at any positions, along or across, where it is a spring with a curve, as
 * far as that has a bound; `widened` holds it then. */
const struct hk_element *hk_element_at_most(const struct hk_elements *at, const struct hk_element *e,
                                            struct hk_element *widened);

/* Transverse stiffness by tension, beyond rounding; 0 under compression. */
static inline double hk_element_across(const struct hk_element *element) {
  return element->k_across > HOOKE_STRETCH_ROUNDING * element->k_along ? element->k_across : 0.0;
}

/* Its coefficients in a K + b C. */
struct hk_element_numbers {
  double along, across;
};
static inline struct hk_element_numbers hk_element_combine(const struct hk_element *e, double a, double b) {
  return (struct hk_element_numbers){(a * e->k_along + b * e->c_along) / e->over,
                                     (a * e->k_across + b * e->c_across) / e->over};
}

/* 1 if some particle is free; `constrained` is that of the system. */
static inline int32_t hk_element_moves(const uint8_t *constrained, const struct hk_element *element) {
  int32_t moves = 0;
  for (int j = 0; j < element->count; j++)
    moves |= !constrained[element->particle[j]];
  return moves;
}

/* Particle j's row of g g^T, summed in absolute value over the free particles: the diagonal matrix of these
 * bounds g g^T from above. */
static inline double hk_element_row(const uint8_t *constrained, const struct hk_element *element, int j) {
  double sum = 0.0;
  for (int k = 0; k < element->count; k++)
    sum += constrained[element->particle[k]] ? 0.0 : fabs(element->weight[k]);
  return fabs(element->weight[j]) * sum;
}

/* out += the matrix with coefficients `along` and `across` times x. x, y and z of particle p are at p *
 * stride of three arrays: separate arrays with stride 1, rows with stride 3. */
void hk_element_multiply(const struct hk_element *element, double along, double across, int64_t stride,
                         const double *const x[3], double *const out[3]);
/* The sum of g_j x_j; most elements are pairs. */
static inline void hk_element_sum(const struct hk_element *e, int64_t stride, const double *const x[3],
                                  double sum[3]) {
  const int64_t first = stride * e->particle[0], second = e->count > 1 ? stride * e->particle[1] : first;
  const double other = e->count > 1 ? e->weight[1] : 0.0;
  for (int a = 0; a < 3; a++)
    sum[a] = e->weight[0] * x[a][first] + other * x[a][second];
  for (int j = 2; j < e->count; j++) {
    for (int a = 0; a < 3; a++)
      sum[a] += e->weight[j] * x[a][stride * e->particle[j]];
  }
}

/* x times that matrix times x. A sum of squares: directions without stretch give exactly 0. */
static inline double hk_element_energy(const struct hk_element *e, double along, double across,
                                       int64_t stride, const double *const x[3]) {
  double sum[3];
  hk_element_sum(e, stride, x, sum);
  const double stretch = (e->u[0] * sum[0] + e->u[1] * sum[1]) + e->u[2] * sum[2];
  return across * ((sum[0] * sum[0] + sum[1] * sum[1]) + sum[2] * sum[2]) +
         (along - across) * stretch * stretch;
}
