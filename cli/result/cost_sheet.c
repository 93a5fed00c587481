#include "cost_sheet.h"

#include "report.h"
#include "rows.h"
#include "watch.h"

#include <inttypes.h>
#include <math.h>
#include <string.h>

enum { LEAST_WIDTH = 16 };

int cli_cost_sheet_find(const struct cli_arguments *arguments, const struct cli_setup *setup,
                        hooke_measurement **cost) {
  int32_t outcome;
  const int code = cli_watch_measure(arguments, "cost", setup, setup->state, cost, &outcome);
  if (outcome != HOOKE_STOPPED) return code;
  cli_report_words(arguments, "interrupted; kept: what was found so far");
  return HOOKE_EXIT_INTERRUPTED;
}

static const char *name_of(const hooke_measurement *cost, int64_t row) {
  const char *name = hooke_measurement_text(cost, "rows", row, "ingredient");
  return name[0] ? name : "(no name)";
}

static const char *time_format(double nanoseconds) {
  return nanoseconds < 100.0 ? "%.2g" : "%.0f";
}

/* A time below the resolution is printed as such. */
static void print_time(double nanoseconds, double resolution) {
  if (nanoseconds < resolution) {
    char format[8];
    snprintf(format, sizeof format, "<%s", time_format(resolution));
    cli_rows_print_as(12, resolution, format, NULL, NULL);
  } else {
    cli_rows_print_as(12, nanoseconds, time_format(nanoseconds), NULL, NULL);
  }
}

static void print_limit(double limit) {
  cli_rows_print_as(14, limit, "%.6g", "any", "no step");
  printf("\n");
}

static void print_name(int width, const char *name) {
  printf("  ");
  cli_print_padded(stdout, width, name);
}

/* A group that was skipped, or not reached before an interruption, is unknown. */
static int is_known(const hooke_measurement *cost, int64_t row) {
  return !isnan(hooke_measurement_number(cost, "rows", row, "memory_bytes"));
}

static void print_row(const hooke_measurement *cost, int64_t row, int width) {
  print_name(width, name_of(cost, row));
  cli_rows_print_as(10, hooke_measurement_number(cost, "rows", row, "springs"), "%.0f", NULL, NULL);
  print_time(hooke_measurement_number(cost, "rows", row, "nanoseconds"),
             cli_number(cost, "cost", "resolution"));
  cli_rows_print_as(12, hooke_measurement_number(cost, "rows", row, "memory_bytes"), "%.0f", NULL, NULL);
  print_limit(hooke_measurement_number(cost, "rows", row, "step_limit_without"));
}

static void print_whole(const hooke_measurement *cost, const hooke_system *system, int width) {
  print_name(width, "the whole scene");
  cli_rows_print_as(10, (double)hooke_system_count(system, "springs"), "%.0f", NULL, NULL);
  print_time(cli_number(cost, "cost", "nanoseconds"), 0.0);
  cli_rows_print_as(12, cli_number(cost, "cost", "memory_bytes"), "%.0f", NULL, NULL);
  print_limit(cli_number(cost, "cost", "step_limit"));
}

void cli_cost_sheet_print_left_out(const hooke_system *system) {
  const int64_t dropped = hooke_system_count(system, "dropped_springs"),
                idle = hooke_system_count(system, "idle");
  if (dropped > 0) {
    printf("dropped      %" PRId64 " %s neither stiffness nor damping\n", dropped,
           dropped == 1 ? "spring that has" : "springs that have");
  }
  if (idle > 0) {
    printf("idle         %" PRId64 " pinned %s that nothing touches\n", idle,
           idle == 1 ? "particle" : "particles");
  }
}

void cli_cost_sheet_print(const hooke_measurement *cost, const hooke_system *system) {
  char step[HOOKE_NUMBER_SIZE];
  const int32_t width = cli_rows_width(cost, "rows", "ingredient", LEAST_WIDTH);
  int64_t unknown = 0;
  if (isnan(cli_number(cost, "cost", "step"))) return; /* interrupted early */
  cli_say("cost of a step of %s, %s s, on this machine:\n", cli_text(cost, "cost", "method"),
          cli_format_rounded(cli_number(cost, "cost", "step"), step));
  printf("  %-*s %10s %12s %12s %14s\n", width, "", "springs", "time [ns]", "memory [B]", "stable to [s]");
  print_whole(cost, system, width);
  if (hooke_measurement_row_count(cost, "rows") > 0)
    printf("  %-*s %38s %12s\n", width, "of this", "", "without it");
  for (int64_t row = 0; row < hooke_measurement_row_count(cost, "rows"); row++) {
    if (is_known(cost, row))
      print_row(cost, row, width);
    else
      unknown++;
  }
  if (unknown > 0)
    printf("  and %" PRId64 " more that %s not looked at (--budget and --groups set how much is)\n", unknown,
           unknown == 1 ? "was" : "were");
}
