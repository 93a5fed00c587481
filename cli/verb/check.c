/* hooke check: validates a scene and reports its size, memory and step limits, without running it. */
#include "measured.h"
#include "os.h"
#include "print.h"
#include "report.h"
#include "setup.h"
#include "watch.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { INDENT = 13, WIDTH = 110, LEAST_WIDTH = 16 };

struct check {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_measurement *found, *cost; /* cost: NULL if not requested */
};

/* ---- the numbers ---- */

/* Stiffness and rest length of the softest and the stiffest of `count` springs. */
static void print_stiffness(const double *stiffness, const double *length, int64_t count) {
  int64_t least = 0, most = 0;
  for (int64_t k = 1; k < count; k++) {
    if (stiffness[k] < stiffness[least]) least = k;
    if (stiffness[k] > stiffness[most]) most = k;
  }
  if (count == 0) return;
  printf(", %.6g N/m at %.6g m (law strain: %.6g N)", stiffness[least], length[least],
         stiffness[least] * length[least]);
  if (stiffness[most] > stiffness[least])
    printf(" to %.6g N/m at %.6g m (%.6g N)", stiffness[most], length[most], stiffness[most] * length[most]);
}

/* A line for each group of a force, with the stiffnesses and rest lengths of all its springs, unless NULL. */
static void print_members(const hooke_measurement *found, const char *table, const char *members,
                          const double *stiffness, const double *length) {
  printf("%-12s %.0f\n", members, cli_number(found, "check", members));
  for (int64_t row = 0; row < hooke_measurement_row_count(found, table); row++) {
    const char *name = hooke_measurement_text(found, table, row, "name");
    const int64_t count = (int64_t)hooke_measurement_number(found, table, row, members);
    cli_say("  %10" PRId64 " %s", count, name[0] ? name : "(no name)");
    if (stiffness) print_stiffness(stiffness, length, count);
    printf("\n");
    if (stiffness) stiffness += count, length += count;
  }
}

/* HOOKE_NO_MEMORY if the stiffnesses are missing. */
static int32_t print_groups(const struct check *check) {
  const hooke_system *system = check->setup.system;
  const int64_t count = hooke_system_count(system, "springs");
  double *stiffness = malloc((size_t)(2 * count + 1) * sizeof *stiffness), *length = stiffness + count;
  const int32_t status =
      stiffness ? hooke_system_members(system, "springs", NULL, stiffness, NULL, length) : HOOKE_NO_MEMORY;
  print_members(check->found, "groups", "springs", status == HOOKE_OK ? stiffness : NULL, length);
  if (hooke_system_group_count(system, "bending") > 0)
    print_members(check->found, "bending_groups", "triples", NULL, NULL);
  if (hooke_system_group_count(system, "altitude") > 0)
    print_members(check->found, "altitude_groups", "tetrahedra", NULL, NULL);
  free(stiffness);
  return status;
}

static void print_bodies(const hooke_system *system) {
  const int64_t bodies = hooke_system_count(system, "bodies"),
                inside = hooke_system_count(system, "inside_bodies");
  if (bodies == 0) return;
  printf("bodies       %" PRId64 " rigid; %" PRId64 " %s inside them dropped\n", bodies, inside,
         inside == 1 ? "spring or other member of a force" : "springs and other members of forces");
  for (int64_t k = 0; k < bodies; k++) {
    const char *name = hooke_system_body_name(system, k);
    cli_say("  %10" PRId64 " %s\n", hooke_system_body_particles(system, k, NULL),
            name[0] ? name : "(no name)");
  }
}

static void print_derived(const hooke_measurement *found) {
  const int64_t count = hooke_measurement_row_count(found, "derived");
  if (count > 0) printf("derived from the options of parts:\n");
  for (int64_t row = 0; row < count; row++) {
    const char *family = hooke_measurement_text(found, "derived", row, "family"),
               *unit = hooke_measurement_text(found, "derived", row, "unit");
    cli_say("  %s%s%s: %s %.6g%s%s\n", hooke_measurement_text(found, "derived", row, "part"),
            family ? "." : "", family ? family : "", hooke_measurement_text(found, "derived", row, "name"),
            hooke_measurement_number(found, "derived", row, "value"), unit[0] ? " " : "", unit);
  }
}

static void print_limits(const struct check *check) {
  const int overdamped = strcmp(hooke_system_dynamics(check->setup.system), "overdamped") == 0;
  char text[HOOKE_NUMBER_SIZE];
  printf("largest step certain to be stable, at the start:\n");
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    const char *name = hooke_method_name(i);
    const double bound = hooke_measurement_number(check->found, "step_limit", i, "seconds");
    const char *words = !hooke_method_is_built(name)          ? "(not in this build)"
                        : hooke_method_is_adaptive(name) != 0 ? "chooses its own"
                        : isnan(bound) ? overdamped ? "takes no overdamped scene" : "not known"
                        : isinf(bound) ? "any"
                        : bound == 0.0 ? "none: stable at no step"
                                       : NULL;
    printf("  %-18s %s%s\n", name, words ? words : cli_format_rounded(bound, text), words ? "" : " s");
  }
}

/* ---- the cost of each ingredient ---- */

/* Measures at the initial state; failures are reported and returned as exit code, HOOKE_EXIT_INTERRUPTED with
 * the rows so far. */
static int find_cost(struct check *check) {
  int32_t outcome;
  const int code =
      cli_watch_measure(check->arguments, "cost", &check->setup, check->setup.state, &check->cost, &outcome);
  if (outcome != HOOKE_STOPPED) return code;
  cli_report_words(check->arguments, "%s; kept: what was found so far", cli_force_stop());
  return cli_exit_code(HOOKE_STOPPED);
}

/* A time below the resolution is printed as such. */
static void print_time(double nanoseconds, double resolution) {
  const double shown = nanoseconds < resolution ? resolution : nanoseconds;
  char format[8];
  snprintf(format, sizeof format, "%s%s", nanoseconds < resolution ? "<" : "",
           shown < 100.0 ? "%.2g" : "%.0f");
  cli_rows_print_as(12, shown, format, NULL, NULL);
}

/* A row of a table, with the number of its springs and its limit; nothing of one that was not looked at. */
static void print_ingredient(const hooke_measurement *cost, const char *table, int64_t row, int width,
                             const char *name, double springs, const char *limit) {
  const double bytes = hooke_measurement_number(cost, table, row, "memory_bytes");
  if (isnan(bytes)) return;
  printf("  ");
  cli_print_padded(stdout, width, name[0] ? name : "(no name)");
  cli_rows_print_as(10, springs, "%.0f", NULL, NULL);
  print_time(hooke_measurement_number(cost, table, row, "nanoseconds"),
             strcmp(table, "rows") == 0 ? cli_number(cost, "cost", "resolution") : 0.0);
  cli_rows_print_as(12, bytes, "%.0f", NULL, NULL);
  cli_rows_print_as(14, hooke_measurement_number(cost, table, row, limit), "%.6g", "any", "no step");
  printf("\n");
}

static void print_cost(const struct check *check) {
  const hooke_measurement *cost = check->cost;
  const int32_t width = cli_rows_width(cost, "rows", "ingredient", LEAST_WIDTH);
  if (isnan(cli_number(cost, "cost", "step"))) return; /* interrupted early */
  cli_claims_print(check->arguments, cost, INDENT, NULL);
  printf("  %-*s %10s %12s %12s %14s\n", width, "", "springs", "time [ns]", "memory [B]", "stable to [s]");
  print_ingredient(cost, "cost", 0, width, "the whole scene", cli_number(check->found, "check", "springs"),
                   "step_limit");
  if (hooke_measurement_row_count(cost, "rows") > 0)
    printf("  %-*s %38s %12s\n", width, "of this", "", "without it");
  for (int64_t row = 0; row < hooke_measurement_row_count(cost, "rows"); row++)
    print_ingredient(cost, "rows", row, width, hooke_measurement_text(cost, "rows", row, "ingredient"),
                     hooke_measurement_number(cost, "rows", row, "springs"), "step_limit_without");
}

/* HOOKE_NO_MEMORY if something is missing. */
static int32_t print_words(struct check *check) {
  const hooke_system *system = check->setup.system;
  const char *title = hooke_scene_text(check->setup.scene, "title");
  int64_t particles = hooke_system_particle_count(system);
  if (title && title[0]) cli_say("scene        %s\n", title);
  printf("particles    %" PRId64 " (%" PRId64 " pinned or driven)\n", particles,
         particles - hooke_system_count(system, "free"));
  print_bodies(system);
  const int32_t status = print_groups(check);
  print_derived(check->found);
  printf("forces       ");
  for (int64_t i = 0; i < hooke_system_count(system, "forces"); i++) {
    printf("%s%s", i ? ", " : "", hooke_system_force_name(system, i));
  }
  printf("%s\n", hooke_system_count(system, "forces") == 0 ? "none" : "");
  const int64_t warnings = hooke_measurement_row_count(check->found, "warnings");
  for (int64_t row = warnings; row < hooke_measurement_row_count(check->found, "claims"); row++)
    cli_print_fact(INDENT, WIDTH, hooke_measurement_text(check->found, "claims", row, "key"), "%s",
                   hooke_measurement_text(check->found, "claims", row, "text"));
  print_limits(check);
  if (check->cost) print_cost(check);
  cli_print_flush();
  for (int64_t row = 0; row < warnings; row++)
    cli_report_words(check->arguments, "warning: %s",
                     hooke_measurement_text(check->found, "warnings", row, "text"));
  return status;
}

/* HOOKE_NO_MEMORY if something is missing. */
static int32_t print_json(struct check *check) {
  cli_print_json("{");
  int32_t status = cli_print_members("", check->found, NULL, 0);
  if (check->cost && status == HOOKE_OK) {
    status = cli_print_members(", \"cost\": {", check->cost, NULL, 0);
    cli_print_json(status == HOOKE_OK ? "}" : "");
  }
  cli_print_json("}\n");
  return status;
}

/* Measures with the memory that the process has right after loading. */
static int32_t find(struct check *check) {
  int64_t now = 0, most = 0;
  cli_os_memory(&now, &most);
  hooke_options *options = NULL;
  int32_t status = hooke_options_create("check", &options);
  if (status == HOOKE_OK && now > 0) /* known */
    status = hooke_options_set_numbers(options, "process", 2, (const double[]){(double)now, (double)most});
  if (status == HOOKE_OK)
    status =
        hooke_measurement_create("check", check->setup.system, check->setup.options, options, &check->found);
  if (status == HOOKE_OK) status = hooke_measurement_run(check->found, check->setup.state);
  hooke_options_destroy(options);
  return status;
}

static int check_and_tell(struct check *check) {
  int32_t status = find(check);
  if (status != HOOKE_OK) return cli_report_status(check->arguments, status);
  int code = HOOKE_EXIT_DONE;
  if (cli_arguments_text(check->arguments, "cost")) code = find_cost(check);
  if (code != HOOKE_EXIT_DONE && code != cli_exit_code(HOOKE_STOPPED)) return code;
  status = check->arguments->json ? print_json(check) : print_words(check);
  return status == HOOKE_OK ? code : cli_report(check->arguments, cli_exit_code(status), "out of memory");
}

/* Times are chosen as `run` does. */
static int do_check(const struct cli_arguments *arguments) {
  struct check check = {.arguments = arguments};
  int code = cli_setup_load(arguments, &check.setup);
  if (code == HOOKE_EXIT_DONE) code = cli_setup_fit(arguments, &check.setup, 1);
  if (code == HOOKE_EXIT_DONE) code = check_and_tell(&check);
  hooke_measurement_destroy(check.found);
  hooke_measurement_destroy(check.cost);
  cli_setup_destroy(&check.setup);
  return code;
}

static const struct cli_verb_row rows[] = {
    {"cost", 0, NULL, "what each ingredient costs, too: time, memory, and the largest step without it"},
    HOOKE_FORCE,
};

const struct cli_verb cli_verb_check = {
    .name = "check",
    .summary = "validates a scene and tells its size, its memory and its step limits, without running it",
    .text = "Validates the scene and tells its size, the memory at the peak of a run, with -o and without, "
            "and for each method the largest step that is certain to be stable at the start, in the time of "
            "loading it. With --cost also what each ingredient costs: time of a step on this machine, unless "
            "--predict leaves it out, memory, and the largest stable step without it. Warns of what is "
            "allowed but seldom meant.",
    .example = "hooke check cloth.json",
    HOOKE_VERB_ROWS(rows),
    .options = "cost",
    .without = "checkpoint",
    .function = do_check,
};
