/* The functions of loops that are compiled for each instruction set: those of the best that this machine
 * has. */
#include "kernel/energy_loops.h"
#include "kernel/spring/spring_loops.h"
#include "kernel/spring/tangent_loops.h"
#include "kernel/triangle_loops.h"
#include "kernel/vector_loops.h"

double hk_dot(int64_t size, const double *x, const double *y) {
  return hk_spring_set(0)->vector->dot(size, x, y);
}

void hk_add_multiple(int64_t size, double a, const double *x, double *y) {
  hk_spring_set(0)->vector->add_multiple(size, a, x, y);
}

void hk_scale_and_add(int64_t size, double b, const double *x, double *y) {
  hk_spring_set(0)->vector->scale_and_add(size, b, x, y);
}

double hk_dot_weighed(int64_t n, const double *weight, const double *x, const double *y) {
  return hk_spring_set(0)->vector->dot_weighed(n, weight, x, y);
}

double hk_lanczos_begin(int64_t n, const double *mass, const double *inverse, double a, double b,
                        const double *before, const double *x, double *out) {
  return hk_spring_set(0)->vector->lanczos_begin(n, mass, inverse, a, b, before, x, out);
}

double hk_lanczos_end(int64_t n, const double *mass, double c, const double *x, double *out) {
  return hk_spring_set(0)->vector->lanczos_end(n, mass, c, x, out);
}

double hk_descend(int64_t size, double a, const double *p, const double *ap, double *x, double *r) {
  return hk_spring_set(0)->vector->descend(size, a, p, ap, x, r);
}

void hk_factorise_blocks(int64_t n, double *block) {
  hk_spring_set(0)->vector->factorise_blocks(n, block);
}

void hk_apply_factor_transposed(int64_t n, const double *w, const double *x, double *y) {
  hk_spring_set(0)->vector->apply_factor_transposed(n, w, x, y);
}

void hk_apply_factor(int64_t n, const double *w, double *x) {
  hk_spring_set(0)->vector->apply_factor(n, w, x);
}

void hk_apply_diagonal(int64_t n, const double *d, const double *x, double *y) {
  hk_spring_set(0)->vector->apply_diagonal(n, d, x, y);
}

void hk_begin_product(int64_t n, const double *w, const double *d, const double *x, double *y, double *out) {
  hk_spring_set(0)->vector->begin_product(n, w, d, x, y, out);
}

void hk_linear_sum(int64_t size, double a, const double *x, double b, const double *y, double *z) {
  hk_spring_set(0)->vector->linear_sum(size, a, x, b, y, z);
}

void hk_scale(int64_t size, double a, const double *x, double *z) {
  hk_spring_set(0)->vector->scale(size, a, x, z);
}

void hk_multiply(int64_t size, const double *x, const double *y, double *z) {
  hk_spring_set(0)->vector->multiply(size, x, y, z);
}

void hk_divide(int64_t size, const double *x, const double *y, double *z) {
  hk_spring_set(0)->vector->divide(size, x, y, z);
}

void hk_invert(int64_t size, const double *x, double *z) {
  hk_spring_set(0)->vector->invert(size, x, z);
}

void hk_absolute(int64_t size, const double *x, double *z) {
  hk_spring_set(0)->vector->absolute(size, x, z);
}

double hk_sum_of_squares(int64_t size, const double *x, const double *y) {
  return hk_spring_set(0)->vector->sum_of_squares(size, x, y);
}

double hk_long_dot(int64_t size, const double *x, const double *y) {
  return hk_spring_set(0)->vector->long_dot(size, x, y);
}

double hk_largest(int64_t size, const double *x) {
  return hk_spring_set(0)->vector->largest(size, x);
}

void hk_join_rows(int64_t n, const double *x, const double *y, const double *z, double *rows) {
  hk_spring_set(0)->vector->join_rows(n, x, y, z, rows);
}

uint64_t hk_differing_bits(int64_t n, const double *x, const double *y, const double *z, const double *rows) {
  return hk_spring_set(0)->vector->differing_bits(n, x, y, z, rows);
}

void hk_some_lengths(const struct hk_some_springs *springs, const double *q, double *length) {
  hk_spring_set(0)->energy->some_lengths(springs, q, length);
}

void hk_some_energies(const struct hk_some_springs *springs, const double *q, double *length,
                      double *energy) {
  hk_spring_set(0)->energy->some_energies(springs, q, length, energy);
}

void hk_some_heats(const struct hk_some_springs *springs, const double *q, const double *v, double *heat) {
  hk_spring_set(0)->energy->some_heats(springs, q, v, heat);
}

void hk_tangent_fill(const struct hk_run *run, const struct hk_fields *fields, double alpha, double beta,
                     const struct hk_tangent *tangent) {
  hk_spring_set(0)->tangent->tangent_fill(run, fields, alpha, beta, tangent);
}

void hk_tangent_product(const struct hk_run *run, const struct hk_tangent *tangent, const double *const x[3],
                        double *const out[3]) {
  hk_spring_set(0)->tangent->tangent_product(run, tangent, x, out);
}

void hk_tangent_diagonal(const struct hk_run *run, const struct hk_tangent *tangent, double *const block[6]) {
  hk_spring_set(0)->tangent->tangent_diagonal(run, tangent, block);
}

void hk_tangent_project(int64_t count, double share, const struct hk_tangent *tangent) {
  hk_spring_set(0)->tangent->tangent_project(count, share, tangent);
}

void hk_tangent_damping(const struct hk_run *run, const struct hk_tangent *tangent, const double *const x[3],
                        double *const out[3]) {
  hk_spring_set(0)->tangent->tangent_damping(run, tangent, x, out);
}

void hk_triangle_forward(const struct hk_triangle *l, double *x) {
  hk_spring_set(0)->triangle->triangle_forward(l, x);
}

void hk_triangle_backward(const struct hk_triangle *l, double *x) {
  hk_spring_set(0)->triangle->triangle_backward(l, x);
}
