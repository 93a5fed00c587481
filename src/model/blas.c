#include "model/blas.h"

#include "core/os/os.h"

#include <stdio.h>
#include <string.h>

/* OpenBLAS alone: BLIS is no faster than the reference BLAS at such small matrices, and the bits of MKL
 * depend on where memory is. */
const char *hk_blas_describe(char text[HOOKE_BLAS_SIZE]) {
  typedef const char *word(void);
  typedef int count(void);
  text[0] = '\0';
  if (!HOOKE_HAVE_CHOLMOD) return text;
  word *config = (word *)hk_os_find_function("openblas_get_config");
  word *processor = (word *)hk_os_find_function("openblas_get_corename");
  count *threads = (count *)hk_os_find_function("openblas_get_num_threads");
  if (!config || !processor || !threads) return text;
  const char *words = config(); /* "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH ..." */
  const size_t name = strcspn(words, " "), version = strspn(words + name, " ");
  snprintf(text, HOOKE_BLAS_SIZE, "%.*s %s, %d thread%s",
           (int)(name + version + strcspn(words + name + version, " ")), words, processor(), threads(),
           threads() == 1 ? "" : "s");
  return text;
}
