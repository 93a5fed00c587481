#include "claims.h"

#include <math.h>

enum { WIDTH = 110, MOST_LIMITING = 5, LABEL = 12 };

void cli_claims_print(const struct cli_arguments *arguments, const hooke_measurement *measurement,
                      int32_t indent, const char *command) {
  int64_t count = hooke_measurement_row_count(measurement, "claims");
  if (arguments->quiet && count > 1) count = 1;
  for (int64_t row = 0; row < count; row++) {
    cli_print_fact(indent, WIDTH, hooke_measurement_text(measurement, "claims", row, "key"), "%s",
                   hooke_measurement_text(measurement, "claims", row, "text"));
    if (row == 0 && command) cli_say("%*s%s\n", indent, "", command);
  }
}

const char *cli_claim(const hooke_measurement *measurement, const char *key) {
  const int64_t row = hooke_measurement_find(measurement, "claims", "key", key);
  return hooke_measurement_text(measurement, "claims", row, "text");
}

int32_t cli_claims_print_json(const struct cli_arguments *arguments, const char *key,
                              hooke_measurement *measurement) {
  cli_print_json("{");
  if (key) cli_print_json("%s: %s", key, arguments->scene);
  const int32_t status = cli_print_members(key ? ", " : "", measurement, NULL, 0);
  cli_print_json("}\n");
  return status;
}

/* ---- limiting springs ---- */

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
  for (int64_t row = 0; row < count && row < MOST_LIMITING; row++)
    print_row(m, row);
  if (count > MOST_LIMITING) printf("%-*sand others with less\n", LABEL, "");
}
