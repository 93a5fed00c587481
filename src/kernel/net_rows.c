#include "kernel/net_loops.h"

void hooke_net_rows(ptrdiff_t count, const int32_t *order, const double *const q[3], const double *const v[3],
                    double *rows) {
  for (ptrdiff_t k = 0; k < count; k++) {
    const ptrdiff_t p = order ? order[k] : k;
    double *restrict row = rows + HOOKE_NET_ROW * k;
    row[0] = q[0][p];
    row[1] = q[1][p];
    row[2] = q[2][p];
    if (v == NULL) continue;
    row[3] = v[2][p];
    row[4] = v[0][p];
    row[5] = v[1][p];
  }
}
