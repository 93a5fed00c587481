#if HOOKE_HAVE_SUNDIALS

#include "integrate/sundials_vector.h"

#include "kernel/vector_loops.h"

#include <math.h>
#include <string.h>

/* Numbers of each vector that are worked on at a time where there are many vectors. */
enum { BLOCK = 1024 };

static double *numbers(N_Vector v) {
  return NV_DATA_S(v);
}

static int64_t size_of(N_Vector v) {
  return NV_LENGTH_S(v);
}

static void linear_sum(realtype a, N_Vector x, realtype b, N_Vector y, N_Vector z) {
  hooke_linear_sum(size_of(z), a, numbers(x), b, numbers(y), numbers(z));
}

static void set(realtype a, N_Vector z) {
  double *to = numbers(z);
  if (a == 0.0) memset(to, 0, (size_t)size_of(z) * sizeof(double));
  for (int64_t k = 0; k < size_of(z) && a != 0.0; k++)
    to[k] = a;
}

static void product(N_Vector x, N_Vector y, N_Vector z) {
  hooke_multiply(size_of(z), numbers(x), numbers(y), numbers(z));
}

static void quotient(N_Vector x, N_Vector y, N_Vector z) {
  hooke_divide(size_of(z), numbers(x), numbers(y), numbers(z));
}

static void scale(realtype a, N_Vector x, N_Vector z) {
  hooke_scale(size_of(z), a, numbers(x), numbers(z));
}

static void absolute(N_Vector x, N_Vector z) {
  hooke_absolute(size_of(z), numbers(x), numbers(z));
}

static void inverse(N_Vector x, N_Vector z) {
  hooke_invert(size_of(z), numbers(x), numbers(z));
}

static void add_number(N_Vector x, realtype a, N_Vector z) {
  hooke_add_number(size_of(z), a, numbers(x), numbers(z));
}

static realtype dot(N_Vector x, N_Vector y) {
  return hooke_long_dot(size_of(x), numbers(x), numbers(y));
}

static realtype largest(N_Vector x) {
  return hooke_largest(size_of(x), numbers(x));
}

static realtype mean_square(N_Vector x, N_Vector weight) {
  return sqrt(hooke_sum_of_squares(size_of(x), numbers(x), numbers(weight)) / (double)size_of(x));
}

static realtype norm(N_Vector x, N_Vector weight) {
  return sqrt(hooke_sum_of_squares(size_of(x), numbers(x), numbers(weight)));
}

/* ---- several vectors at once ---- */

/* z may be the first of x. */
static int combination(int count, realtype *c, N_Vector *x, N_Vector z) {
  const int64_t size = size_of(z);
  for (int64_t done = 0; done < size; done += BLOCK) {
    const int64_t some = size - done < BLOCK ? size - done : BLOCK;
    double *to = numbers(z) + done;
    hooke_scale(some, c[0], numbers(x[0]) + done, to);
    for (int k = 1; k < count; k++)
      hooke_add_multiple(some, c[k], numbers(x[k]) + done, to);
  }
  return 0;
}

static int add_to_each(int count, realtype *a, N_Vector x, N_Vector *y, N_Vector *z) {
  const int64_t size = size_of(x);
  for (int64_t done = 0; done < size; done += BLOCK) {
    const int64_t some = size - done < BLOCK ? size - done : BLOCK;
    for (int k = 0; k < count; k++)
      hooke_linear_sum(some, a[k], numbers(x) + done, 1.0, numbers(y[k]) + done, numbers(z[k]) + done);
  }
  return 0;
}

static int dot_each(int count, N_Vector x, N_Vector *y, realtype *products) {
  for (int k = 0; k < count; k++)
    products[k] = dot(x, y[k]);
  return 0;
}

static int scale_each(int count, realtype *c, N_Vector *x, N_Vector *z) {
  for (int k = 0; k < count; k++)
    scale(c[k], x[k], z[k]);
  return 0;
}

N_Vector hooke_sundials_vector(int64_t size, SUNContext context) {
  N_Vector v = N_VNew_Serial(size, context);
  if (v == NULL) return NULL;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvconst = set;
  v->ops->nvprod = product;
  v->ops->nvdiv = quotient;
  v->ops->nvscale = scale;
  v->ops->nvabs = absolute;
  v->ops->nvinv = inverse;
  v->ops->nvaddconst = add_number;
  v->ops->nvdotprod = v->ops->nvdotprodlocal = dot;
  v->ops->nvmaxnorm = v->ops->nvmaxnormlocal = largest;
  v->ops->nvwrmsnorm = mean_square;
  v->ops->nvwl2norm = norm;
  v->ops->nvlinearcombination = combination;
  v->ops->nvscaleaddmulti = add_to_each;
  v->ops->nvdotprodmulti = v->ops->nvdotprodmultilocal = dot_each;
  v->ops->nvscalevectorarray = scale_each;
  return v;
}

#else
typedef int hooke_sundials_vector_is_not_built;
#endif
