#include "limiting.h"

#include "print.h"

#include <math.h>

enum { MOST = 5, LABEL = 12 };

static double number(const hooke_measurement *m, int64_t row, const char *what) {
  return hooke_measurement_number(m, "blame", row, what);
}

static void print_row(const hooke_measurement *m, int64_t row) {
  const char *force = hooke_measurement_text(m, "blame", row, "force");
  const char *group = hooke_measurement_text(m, "blame", row, "group");
  const double share = number(m, row, "share");
  printf("%-*s", LABEL, row ? "" : "blame");
  printf(isnan(share) ? "      -" : "%5.1f %%", 100.0 * share);
  if (force)
    printf("  %s", force);
  else
    printf("  spring %.0f, between particles %.0f and %.0f", number(m, row, "number"),
           number(m, row, "first"), number(m, row, "second"));
  cli_say("%s%s\n", group[0] ? ", group " : "", group);
}

void cli_limiting_print(const hooke_measurement *m) {
  const int64_t count = hooke_measurement_row_count(m, "blame");
  for (int64_t row = 0; row < count && row < MOST; row++)
    print_row(m, row);
  if (count > MOST) printf("%-*sand others with less\n", LABEL, "");
}
