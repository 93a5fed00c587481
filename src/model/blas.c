#include "model/blas.h"

#include "core/os/os.h"

#include <stdio.h>
#include <string.h>

/* OpenBLAS alone: supernodal factors by BLIS take as long as simplicial ones, and the bits of MKL depend on
 * where memory is. */
void hk_blas_describe(char text[HOOKE_BLAS_SIZE]) {
  const char *(*config)(void) = NULL, *(*processor)(void) = NULL;
  int (*threads)(void) = NULL;
  text[0] = '\0';
  if (!HOOKE_HAVE_CHOLMOD) return;
  *(void **)&config = hk_os_find_symbol("openblas_get_config");
  *(void **)&processor = hk_os_find_symbol("openblas_get_corename");
  *(void **)&threads = hk_os_find_symbol("openblas_get_num_threads");
  if (!config || !processor || !threads) return;
  const char *words = config(); /* "OpenBLAS 0.3.21 NO_LAPACKE DYNAMIC_ARCH ..." */
  const size_t name = strcspn(words, " "), version = strspn(words + name, " ");
  snprintf(text, HOOKE_BLAS_SIZE, "%.*s %s, %d thread%s",
           (int)(name + version + strcspn(words + name + version, " ")), words, processor(), threads(),
           threads() == 1 ? "" : "s");
}
