/* Elements: what every force between particles is made of, linearised. An element is of up to four
 * particles p_j with weights g_j and a unit direction u, and adds
 *   K = (g g^T) (x) (k_along u u^T + k_across (I - u u^T))
 *   C = (g g^T) (x) (c_along u u^T + c_across (I - u u^T))
 * so that the force changes by -K dq - C dv. A spring has g = (1, -1), kappa along and T/r across, and
 * gamma along; a triple of bending g = (1, -2, 1) and c in all directions; an altitude spring its four
 * weights, and what its tension does is left out; drag g = (1) and c in all directions. The turning of a
 * damped spring, whose derivative is not symmetric, is left out. */
#ifndef HOOKE_MODEL_FORCE_ELEMENT_H
#define HOOKE_MODEL_FORCE_ELEMENT_H

#include <math.h>
#include <stdint.h>

struct hk_force_row;
struct hooke_system;

/* What counts as tension: a smaller part of the stiffness along an element is rounding of positions. */
#define HOOKE_STRETCH_ROUNDING 1e-9

struct hk_element {
  int32_t count, particle[4];
  double weight[4], u[3]; /* u is 0 where the element has no direction: it is alike in all of them */
  double k_along, k_across, c_along, c_across;
  double over; /* the four numbers are to be divided by this one, which is 1 unless velocities are given */
};

/* A walk over elements: for (hk_begin_elements(system, q, v, &at); (e = hk_next_element(&at)) != NULL;) At
 * positions q and velocities v (rows): those that act there; slack ones are 0. Without v (NULL), at rest
 * and as small displacements see them: those that only pull count as taut, and a spring of no length as
 * stiff in all directions. k_across is below 0 where a spring is compressed. Without q and v their
 * particles alone. */
enum { HOOKE_ELEMENTS = 64 };
struct hk_elements {
  const struct hooke_system *system;
  const double *q, *v;
  int (*wanted)(const struct hk_force_row *force); /* NULL: all forces */
  const struct hk_force_row *only;                 /* NULL: the same; else of this force alone */
  int32_t
      by_number; /* 1: in the order of their numbers; else as memory has them, and `first` means nothing */
  int32_t next;  /* row of the table of forces */
  const struct hk_force_row *force; /* of the present ones */
  int64_t batches;                  /* so far */
  int64_t done;                     /* elements of the force before the present ones */
  int64_t first, count, k;          /* number of the first of the present ones */
  int64_t place[3];                 /* of a force whose memory has another order */
  struct hk_element element[HOOKE_ELEMENTS];
};
void hk_begin_elements(const struct hooke_system *system, const double *q, const double *v,
                       struct hk_elements *at);
int32_t hk_fill_elements(struct hk_elements *at);

static inline const struct hk_element *hk_next_element(struct hk_elements *at) {
  if (at->k == at->count && !hk_fill_elements(at)) return 0;
  return &at->element[at->k++];
}

/* The number of the element that came last, by number. */
static inline int64_t hk_element_number(const struct hk_elements *at) {
  return at->first + at->k - 1;
}

/* Stiffness across that is tension and not rounding, 0 where it is compression. */
static inline double hk_element_across(const struct hk_element *element) {
  return element->k_across > HOOKE_STRETCH_ROUNDING * element->k_along ? element->k_across : 0.0;
}

/* Its numbers in a K + b C. */
struct hk_element_numbers {
  double along, across;
};
static inline struct hk_element_numbers hk_element_combine(const struct hk_element *e, double a, double b) {
  return (struct hk_element_numbers){(a * e->k_along + b * e->c_along) / e->over,
                                     (a * e->k_across + b * e->c_across) / e->over};
}

/* 1 if a particle is free; `constrained` is that of the system. */
static inline int32_t hk_element_moves(const uint8_t *constrained, const struct hk_element *element) {
  int32_t moves = 0;
  for (int j = 0; j < element->count; j++)
    moves |= !constrained[element->particle[j]];
  return moves;
}

/* Particle j's row of g g^T, summed in size over the particles that are free: the diagonal matrix of
 * these is at least g g^T. */
static inline double hk_element_row(const uint8_t *constrained, const struct hk_element *element, int j) {
  double sum = 0.0;
  for (int k = 0; k < element->count; k++)
    sum += constrained[element->particle[k]] ? 0.0 : fabs(element->weight[k]);
  return fabs(element->weight[j]) * sum;
}

/* out += the matrix with numbers `along` and `across` times x. x, y and z of particle p are at p * stride of
 * each of three arrays: apart with stride 1, and rows with stride 3. */
void hk_element_multiply(const struct hk_element *element, double along, double across, int64_t stride,
                         const double *const x[3], double *const out[3]);
/* The sum of g_j x_j; pairs are what most elements are. */
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

/* x times that. Squares: what does not stretch comes out as 0. */
static inline double hk_element_energy(const struct hk_element *e, double along, double across,
                                       int64_t stride, const double *const x[3]) {
  double sum[3];
  hk_element_sum(e, stride, x, sum);
  const double stretch = (e->u[0] * sum[0] + e->u[1] * sum[1]) + e->u[2] * sum[2];
  return across * ((sum[0] * sum[0] + sum[1] * sum[1]) + sum[2] * sum[2]) +
         (along - across) * stretch * stretch;
}

#endif
