#if HOOKE_HAVE_SUNDIALS

#include "integrate/solve/sundials_vector.h"

#include "core/memory.h"
#include "kernel/vector_loops.h"

#include <math.h>
#include <string.h>

/* Vectors are processed in blocks, which depend on the size alone: as many as there may be sums, and none so
 * small that many vectors would not stay in cache between two operations. Below LARGE waking the others takes
 * longer than it saves. */
enum { MOST_BLOCKS = 256, LEAST_BLOCK = 1024, LARGE = 65536 };

/* Begins like a serial vector, for code that takes it for one. */
struct content {
  struct _N_VectorContent_Serial serial;
  void *plain; /* the vector that it is a copy of */
  struct hk_pool *pool;
  struct hk_sundials_spare *spare; /* for clones; NULL: none */
  int32_t is_spare;
};

static double *numbers(N_Vector v) {
  return NV_DATA_S(v);
}

static int64_t size_of(N_Vector v) {
  return NV_LENGTH_S(v);
}

/* ---- block by block ---- */

struct job {
  /* elements from `at` on; sums go to `sum` */
  void (*some)(const struct job *job, int64_t at, int64_t count, double *sum);
  /* the loop of the kernel that it calls */
  void (*of_two)(int64_t count, const double *x, const double *y, double *z);
  void (*of_one)(int64_t count, const double *x, double *z);
  double (*sum_of)(int64_t count, const double *x, const double *y);
  double a, b;
  const double *x, *y;
  double *z;
  int vectors;
  const double *factor;
  N_Vector *from, *to;
  int64_t size, block;
  double sum[MOST_BLOCKS];
};

static void work(int32_t worker, int32_t workers, void *ctx) {
  struct job *job = ctx;
  const int64_t end = hk_pool_share(job->size, job->block, worker + 1, workers);
  for (int64_t at = hk_pool_share(job->size, job->block, worker, workers); at < end; at += job->block) {
    const int64_t left = job->size - at;
    job->some(job, at, left < job->block ? left : job->block, &job->sum[at / job->block]);
  }
}

static void run(N_Vector v, struct job *job) {
  const int64_t least = (size_of(v) + MOST_BLOCKS - 1) / MOST_BLOCKS;
  job->size = size_of(v);
  job->block = (least + LEAST_BLOCK - 1) / LEAST_BLOCK * LEAST_BLOCK;
  hk_pool_run(job->size < LARGE ? NULL : ((struct content *)v->content)->pool, work, job);
}

/* ---- one vector from one or two ---- */

static void some_set(const struct job *j, int64_t at, int64_t count, double *sum) {
  (void)sum;
  for (int64_t k = at; k < at + count; k++)
    j->z[k] = j->a;
}

static void set(sunrealtype a, N_Vector z) {
  run(z, &(struct job){.some = some_set, .a = a, .z = numbers(z)});
}

static void some_of_two(const struct job *j, int64_t at, int64_t count, double *sum) {
  (void)sum;
  j->of_two(count, j->x + at, j->y + at, j->z + at);
}

static void product(N_Vector x, N_Vector y, N_Vector z) {
  run(z,
      &(struct job){some_of_two, .of_two = hk_multiply, .x = numbers(x), .y = numbers(y), .z = numbers(z)});
}

static void quotient(N_Vector x, N_Vector y, N_Vector z) {
  run(z, &(struct job){some_of_two, .of_two = hk_divide, .x = numbers(x), .y = numbers(y), .z = numbers(z)});
}

static void some_of_one(const struct job *j, int64_t at, int64_t count, double *sum) {
  (void)sum;
  j->of_one(count, j->x + at, j->z + at);
}

static void absolute(N_Vector x, N_Vector z) {
  run(z, &(struct job){some_of_one, .of_one = hk_absolute, .x = numbers(x), .z = numbers(z)});
}

static void inverse(N_Vector x, N_Vector z) {
  run(z, &(struct job){some_of_one, .of_one = hk_invert, .x = numbers(x), .z = numbers(z)});
}

/* ---- numbers ---- */

static void some_sum(const struct job *j, int64_t at, int64_t count, double *sum) {
  *sum = j->sum_of(count, j->x + at, j->y + at);
}

/* The sums of the blocks are added in their order. */
static double sum_of(N_Vector x, N_Vector y, double (*loop)(int64_t, const double *, const double *)) {
  struct job job = {some_sum, .sum_of = loop, .x = numbers(x), .y = numbers(y)};
  double sum = 0.0;
  run(x, &job);
  for (int64_t k = 0; k * job.block < job.size; k++)
    sum += job.sum[k];
  return sum;
}

static sunrealtype dot(N_Vector x, N_Vector y) {
  return sum_of(x, y, hk_long_dot);
}

static void some_largest(const struct job *j, int64_t at, int64_t count, double *sum) {
  *sum = hk_largest(count, j->x + at);
}

static sunrealtype largest(N_Vector x) {
  struct job job = {.some = some_largest, .x = numbers(x)};
  double most = 0.0;
  run(x, &job);
  for (int64_t k = 0; k * job.block < job.size; k++)
    most = job.sum[k] > most ? job.sum[k] : most;
  return most;
}

static sunrealtype mean_square(N_Vector x, N_Vector weight) {
  return sqrt(sum_of(x, weight, hk_sum_of_squares) / (double)size_of(x));
}

/* ---- several vectors at once, or one as such ---- */

static void some_combination(const struct job *j, int64_t at, int64_t count, double *sum) {
  (void)sum;
  hk_scale(count, j->factor[0], numbers(j->from[0]) + at, j->z + at);
  for (int k = 1; k < j->vectors; k++)
    hk_add_multiple(count, j->factor[k], numbers(j->from[k]) + at, j->z + at);
}

/* Z may be the first of x. */
static int combination(int count, sunrealtype *c, N_Vector *x, N_Vector z) {
  run(z, &(struct job){.some = some_combination, .vectors = count, .factor = c, .from = x, .z = numbers(z)});
  return 0;
}

static void scale(sunrealtype a, N_Vector x, N_Vector z) {
  combination(1, &a, &x, z);
}

static void some_linear_sums(const struct job *j, int64_t at, int64_t count, double *sum) {
  (void)sum;
  for (int k = 0; k < j->vectors; k++)
    hk_linear_sum(count, j->factor[k], j->x + at, j->b, numbers(j->from[k]) + at, numbers(j->to[k]) + at);
}

static void linear_sum(sunrealtype a, N_Vector x, sunrealtype b, N_Vector y, N_Vector z) {
  run(z, &(struct job){some_linear_sums, .vectors = 1, .factor = &a, .x = numbers(x), .b = b, .from = &y,
                       .to = &z});
}

static int add_to_each(int count, sunrealtype *a, N_Vector x, N_Vector *y, N_Vector *z) {
  run(x, &(struct job){some_linear_sums, .vectors = count, .factor = a, .x = numbers(x), .b = 1.0, .from = y,
                       .to = z});
  return 0;
}

static int scale_each(int count, sunrealtype *c, N_Vector *x, N_Vector *z) {
  for (int k = 0; k < count; k++)
    scale(c[k], x[k], z[k]);
  return 0;
}

/* ---- the object ---- */

static void destroy(N_Vector v) {
  struct content *content = v->content;
  if (content->is_spare) return; /* others may still use it */
  v->content = content->plain;
  hk_free(content);
  N_VDestroy_Serial(v);
}

/* A serial vector with content of ours; NULL, and nothing left, without memory. */
static N_Vector wrap(N_Vector v, struct hk_pool *pool) {
  struct content *content = v ? hk_new(1, sizeof *content) : NULL;
  if (content) {
    content->serial = *(N_VectorContent_Serial)v->content;
    content->plain = v->content;
    content->pool = pool;
    v->content = content;
  } else if (v) {
    N_VDestroy_Serial(v);
  }
  return content ? v : NULL;
}

/* N_VClone() writes to its result without a check. */
static N_Vector clone(N_Vector v) {
  const struct content *content = v->content;
  struct hk_sundials_spare *spare = content->spare;
  N_Vector copy = wrap(N_VClone_Serial(v), content->pool);
  if (copy) ((struct content *)copy->content)->spare = spare;
  if (copy || spare == NULL) return copy;
  spare->taken = 1;
  return spare->vector;
}

int32_t hk_sundials_spare_create(N_Vector v, struct hk_sundials_spare *spare) {
  struct content *content = v->content;
  spare->vector = clone(v);
  if (spare->vector == NULL) return 0;
  ((struct content *)spare->vector->content)->is_spare = 1;
  content->spare = ((struct content *)spare->vector->content)->spare = spare;
  return 1;
}

void hk_sundials_spare_release(struct hk_sundials_spare *spare) {
  if (spare->vector == NULL) return;
  ((struct content *)spare->vector->content)->is_spare = 0;
  destroy(spare->vector);
  spare->vector = NULL;
}

N_Vector hk_sundials_vector(int64_t size, struct hk_pool *pool, SUNContext context) {
  const sunindextype length = (sunindextype)size; /* of 32 bits in some builds of SUNDIALS */
  N_Vector v = length == size ? wrap(N_VNew_Serial(length, context), pool) : NULL;
  if (v == NULL) return NULL;
  v->ops->nvclone = clone;
  v->ops->nvcloneempty = NULL;
  v->ops->nvdestroy = destroy;
  v->ops->nvlinearsum = linear_sum;
  v->ops->nvconst = set;
  v->ops->nvprod = product;
  v->ops->nvdiv = quotient;
  v->ops->nvscale = scale;
  v->ops->nvabs = absolute;
  v->ops->nvinv = inverse;
  v->ops->nvdotprod = v->ops->nvdotprodlocal = dot;
  v->ops->nvmaxnorm = v->ops->nvmaxnormlocal = largest;
  v->ops->nvwrmsnorm = mean_square;
  v->ops->nvlinearcombination = combination;
  v->ops->nvscaleaddmulti = add_to_each;
  v->ops->nvscalevectorarray = scale_each;
  return v;
}

#else
typedef int hk_sundials_vector_is_not_built;
#endif
