/* Facts about this build. CMake passes the versions of the other libraries, "" for absent ones. */
#include "hooke/base.h"

#include "kernel/spring/spring_loops.h"
#include "model/blas.h"

#include <string.h>

const char *hooke_version(void) {
  return HOOKE_VERSION;
}

int32_t hooke_abi(void) {
  return HOOKE_ABI;
}

static const char *licence(void) {
  if (HOOKE_HAVE_GSL && HOOKE_HAVE_CHOLMOD)
    return "GPL-3.0-or-later, since it contains GSL and CHOLMOD; hooke itself is MIT";
  if (HOOKE_HAVE_GSL) return "GPL-3.0-or-later, since it contains GSL; hooke itself is MIT";
  if (HOOKE_HAVE_CHOLMOD) return "GPL-2.0-or-later, since it contains CHOLMOD; hooke itself is MIT";
  return "MIT";
}

static _Thread_local char blas[HOOKE_BLAS_SIZE];

/* Processor architecture of the build. */
static const char *machine(void) {
#if defined(__x86_64__)
  return "x86-64";
#elif defined(__aarch64__)
  return "aarch64";
#else
  return "other";
#endif
}

const char *hooke_build_fact(const char *what) {
  if (!what) return NULL;
  if (!strcmp(what, "sundials")) return HOOKE_SUNDIALS_VERSION;
  if (!strcmp(what, "cholmod")) return HOOKE_CHOLMOD_VERSION;
  if (!strcmp(what, "blas")) return hk_blas_describe(blas);
  if (!strcmp(what, "lapack")) return HOOKE_LAPACK_VERSION;
  if (!strcmp(what, "gsl")) return HOOKE_GSL_VERSION;
  if (!strcmp(what, "hdf5")) return HOOKE_HDF5_VERSION;
  if (!strcmp(what, "arpack") || !strcmp(what, "jansson")) return ""; /* were needed once */
  if (!strcmp(what, "chartjs")) return HOOKE_CHARTJS_VERSION;
  if (!strcmp(what, "threejs")) return HOOKE_THREEJS_VERSION;
  if (!strcmp(what, "instructions")) return hk_kernel_instructions();
  if (!strcmp(what, "licence")) return licence();
  if (!strcmp(what, "machine")) return machine();
  return NULL;
}
