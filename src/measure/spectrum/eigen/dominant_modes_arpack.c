/* ARPACK-NG: implicitly restarted Lanczos, fully orthogonalised (Lehoucq, Sorensen and Yang 1998). */
#include "measure/spectrum/eigen/dominant_mode.h"

#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_ARPACK

#include <arpack/arpack.h>
#include <math.h>
#include <pthread.h>
#include <string.h>

enum { MOST_RESTARTS = 300, SPARE_VECTORS = 20 };

/* ARPACK keeps its state in global variables between calls: a search excludes others from its first call to
 * its last. */
static pthread_mutex_t alone = PTHREAD_MUTEX_INITIALIZER;

struct search {
  struct hk_linearised *lin;
  a_int size, count, vectors, work_size;
  a_int parameter[11], pointer[14], info;
  double tolerance;
  double *residual, *basis, *work, *workspace, *value, *place, *product;
  a_int *select;
};

static int32_t make_space(struct hk_linearised *lin, int64_t count, struct search *s) {
  const int64_t n = lin->unknowns, vectors = 2 * count + SPARE_VECTORS < n ? 2 * count + SPARE_VECTORS : n;
  const int64_t work_size = vectors * (vectors + 8);
  s->lin = lin;
  s->size = (a_int)n;
  s->count = (a_int)count;
  s->vectors = (a_int)vectors;
  s->work_size = (a_int)work_size;
  double *block = hk_new(n * (vectors + 4) + work_size + count + 2 * lin->size, sizeof(double));
  s->select = hk_new(vectors, sizeof *s->select);
  if (block == NULL || s->select == NULL) {
    hk_free(block);
    return HOOKE_NO_MEMORY;
  }
  s->residual = hk_part(&block, n);
  s->basis = hk_part(&block, n * vectors);
  s->work = hk_part(&block, 3 * n);
  s->workspace = hk_part(&block, work_size);
  s->value = hk_part(&block, count);
  s->place = hk_part(&block, lin->size);
  s->product = hk_part(&block, lin->size);
  return HOOKE_OK;
}

static void release(struct search *s) {
  hk_free(s->residual);
  hk_free(s->select);
}

/* The symmetric form: on displacements times the root of the masses. */
static void multiply(struct search *s, const double *x, double *out) {
  hk_linearised_unpack(s->lin, x, s->place);
  hk_linearised_multiply(s->lin, s->place, s->product);
  hk_linearised_pack(s->lin, s->product, out);
}

static int32_t run(struct search *s) {
  s->parameter[0] = 1; /* exact shifts */
  s->parameter[2] = MOST_RESTARTS;
  s->parameter[6] = 1; /* the standard problem */
  s->info = 1;         /* the start is in `residual` */
  a_int wants = 0;
  do {
    if (hk_budget_ends(s->lin->budget, "eigenvalues")) return HOOKE_STOPPED;
    dsaupd_c(&wants, "I", s->size, "LA", s->count, s->tolerance, s->residual, s->vectors, s->basis, s->size,
             s->parameter, s->pointer, s->work, s->workspace, s->work_size, &s->info);
    if (wants == 1 || wants == -1) multiply(s, s->work + s->pointer[0] - 1, s->work + s->pointer[1] - 1);
  } while (wants == 1 || wants == -1);
  if (s->info != 0) return HOOKE_SOLVER_FAILED;
  dseupd_c(1, "A", s->select, s->value, s->basis, s->size, 0.0, "I", s->size, "LA", s->count, s->tolerance,
           s->residual, s->vectors, s->basis, s->size, s->parameter, s->pointer, s->work, s->workspace,
           s->work_size, &s->info);
  return s->info == 0 && s->parameter[4] >= s->count ? HOOKE_OK : HOOKE_SOLVER_FAILED;
}

int32_t hk_dominant_modes_arpack(struct hk_linearised *lin, int64_t count, double tolerance, double *value,
                                 double *mode) {
  struct search s = {.tolerance = tolerance};
  if (lin->unknowns <= count) return HOOKE_SOLVER_FAILED;
  int32_t status = make_space(lin, count, &s);
  if (status != HOOKE_OK) return status;
  hk_linearised_pack(lin, mode, s.residual);
  pthread_mutex_lock(&alone);
  status = run(&s);
  pthread_mutex_unlock(&alone);
  /* its values come in ascending order */
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++) {
    value[k] = s.value[count - 1 - k];
    hk_linearised_unpack(lin, s.basis + (count - 1 - k) * lin->unknowns, mode + k * lin->size);
  }
  release(&s);
  return status != HOOKE_SOLVER_FAILED
             ? status
             : hk_fail(status, NULL, "ARPACK found no eigenvalues (%d)", (int)s.info);
}

#else

int32_t hk_dominant_modes_arpack(struct hk_linearised *lin, int64_t count, double tolerance, double *value,
                                 double *mode) {
  (void)lin, (void)count, (void)tolerance, (void)value, (void)mode;
  return hk_fail(HOOKE_NOT_BUILT, NULL, "this build is without ARPACK");
}

#endif
