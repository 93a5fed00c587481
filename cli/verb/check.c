/* hooke check: validates a scene and reports its size, memory and step limits, without running it. */
#include "cost_sheet.h"
#include "derived.h"
#include "fit.h"
#include "peak.h"
#include "print.h"
#include "report.h"
#include "setup.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct check {
  const struct cli_arguments *arguments;
  struct cli_setup setup;
  hooke_measurement *cost; /* NULL: not requested */
  double *bound;           /* bound on the step of each method at the initial state [s]; NaN if unknown */
  struct cli_foretold memory;
  char warnings[HOOKE_WARNINGS_SIZE];
};

static double bound_of(const struct check *check, const char *method) {
  for (int64_t k = 0; k < hooke_method_count(); k++)
    if (strcmp(method, hooke_method_name(k)) == 0) return check->bound[k];
  return NAN;
}

/* HOOKE_NO_MEMORY */
static int32_t find_bounds(struct check *check) {
  check->bound = malloc((size_t)hooke_method_count() * sizeof *check->bound);
  if (check->bound == NULL) return HOOKE_NO_MEMORY;
  return hooke_step_bound(check->setup.system, NULL, hooke_state_position(check->setup.state), check->bound);
}

/* ---- warnings ---- */

static void warn_of_method(struct check *check) {
  const char *method = hooke_options_text(check->setup.options, "method");
  char limit[HOOKE_NUMBER_SIZE], taken[HOOKE_NUMBER_SIZE];
  if (!hooke_method_is_built(method)) {
    cli_append(check->warnings, HOOKE_WARNINGS_SIZE,
               "%s, the method of the run, is not in this build of hooke\n", method);
    return;
  }
  double bound = bound_of(check, method);
  double step = hooke_options_number(check->setup.options, "step");
  if (bound == 0.0) {
    cli_append(check->warnings, HOOKE_WARNINGS_SIZE,
               "%s, the method of the run, is stable at no step: the scene has motion without damping, which "
               "it makes grow at any step\n",
               method);
  } else if (step > bound) {
    cli_append(check->warnings, HOOKE_WARNINGS_SIZE,
               "the step of the run, %s s, is above %s s, up to which %s is certain to be stable\n",
               cli_format_rounded(step, taken), cli_format_rounded(bound, limit), method);
  }
}

static void warn_of_coincident_springs(struct check *check) {
  int64_t count =
      hooke_system_coincident_springs(check->setup.system, hooke_state_position(check->setup.state));
  if (count == 0) return;
  cli_append(check->warnings, HOOKE_WARNINGS_SIZE,
             "%" PRId64 " %s with both ends at the same place although the rest length is not zero: without "
             "a direction, and so without a force\n",
             count, count == 1 ? "spring starts" : "springs start");
}

/* Marks the particles of all members of a force, or (NULL) of a rigid body, which may be free as a whole. */
static int32_t mark(const hooke_system *system, const char *force, int64_t body, char *held) {
  const int64_t count = force ? hooke_member_particles(force) * hooke_system_count(system, force)
                              : hooke_system_body_particles(system, body, NULL);
  int64_t *named = malloc((size_t)(count + 1) * sizeof *named);
  int32_t status = named ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (named && force) status = hooke_system_members(system, force, named, NULL, NULL, NULL);
  if (named && !force) hooke_system_body_particles(system, body, named);
  for (int64_t i = 0; status == HOOKE_OK && i < count; i++)
    held[named[i]] = 1;
  free(named);
  return status;
}

/* Counts particles that no spring of any kind, no bending and no body holds. */
static int32_t warn_of_loose_particles(struct check *check) {
  const hooke_system *system = check->setup.system;
  const int64_t particles = hooke_system_particle_count(system);
  int64_t count = 0, first = 0;
  char *held = calloc((size_t)particles + 1, 1);
  int32_t status = held ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t k = 0; status == HOOKE_OK && hooke_system_force_name(system, k); k++) {
    const char *force = hooke_system_force_name(system, k);
    if (hooke_member_particles(force) > 0) status = mark(system, force, -1, held);
  }
  for (int64_t k = 0; status == HOOKE_OK && k < hooke_system_count(system, "bodies"); k++)
    status = mark(system, NULL, k, held);
  for (int64_t i = particles - 1; status == HOOKE_OK && i >= 0; i--) {
    if (held[i]) continue;
    count++;
    first = i;
  }
  if (count == 1)
    cli_append(check->warnings, HOOKE_WARNINGS_SIZE, "particle %" PRId64 " has no spring\n", first);
  if (count > 1) {
    cli_append(check->warnings, HOOKE_WARNINGS_SIZE,
               "%" PRId64 " particles have no spring, the first of them particle %" PRId64 "\n", count,
               first);
  }
  free(held);
  return status;
}

/* ---- the numbers ---- */

/* The memory that grows with the number of springs, for each; and the rest, for each particle. */
static double bytes_per_spring(const struct check *check) {
  return (double)hooke_system_count(check->setup.system, "spring_memory") /
         (double)hooke_system_count(check->setup.system, "springs");
}

static double bytes_per_particle(const struct check *check) {
  return (double)(check->memory.counted - hooke_system_count(check->setup.system, "spring_memory")) /
         (double)hooke_system_particle_count(check->setup.system);
}

static void print_memory(const struct check *check) {
  const double most = 1e-6 * (double)check->memory.most;
  printf("memory       %.3g MB at the peak of a run, %.3g MB with -o", most,
         1e-6 * (double)check->memory.written);
  if (check->memory.factor > 0)
    printf("; %.3g MB more where its method finds that a factor of its equations pays",
           1e-6 * (double)check->memory.factor - most);
  if (hooke_system_particle_count(check->setup.system) > 0)
    printf("; the model takes %.1f bytes a particle", bytes_per_particle(check));
  if (hooke_system_count(check->setup.system, "springs") > 0)
    printf(" and %.1f a spring", bytes_per_spring(check));
  printf("\n");
}

static void print_json_memory(struct cli_json *json, const struct cli_foretold *memory) {
  cli_json_count(json, "memory_bytes", memory->most);
  cli_json_count(json, "memory_bytes_output", memory->written);
  cli_json_count(json, "memory_bytes_factor", memory->factor > 0 ? memory->factor : -1);
}

/* HOOKE_NO_MEMORY if something is missing. */
static int32_t print_json(struct check *check) {
  const hooke_system *system = check->setup.system;
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_count(&json, "particles", hooke_system_particle_count(system));
  cli_derived_json(&json, system);
  cli_json_open(&json, "forces", '[');
  for (int64_t i = 0; i < hooke_system_count(system, "forces"); i++) {
    cli_json_text(&json, NULL, hooke_system_force_name(system, i));
  }
  cli_json_close(&json);
  print_json_memory(&json, &check->memory);
  cli_json_number(&json, "bytes_per_particle", bytes_per_particle(check));
  cli_json_number(&json, "bytes_per_spring", bytes_per_spring(check));
  cli_json_open(&json, "step_limit", '{');
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    cli_json_number(&json, hooke_method_name(i), check->bound[i]);
  }
  cli_json_close(&json);
  cli_json_open(&json, "warnings", '[');
  for (const char *line = strtok(check->warnings, "\n"); line; line = strtok(NULL, "\n"))
    cli_json_text(&json, NULL, line);
  cli_json_close(&json);
  cli_json_count(&json, "bodies", hooke_system_count(system, "bodies"));
  cli_json_count(&json, "inside_bodies", hooke_system_count(system, "inside_bodies"));
  cli_json_count(&json, "dropped_springs", hooke_system_count(system, "dropped_springs"));
  cli_json_count(&json, "idle_particles", hooke_system_count(system, "idle"));
  if (check->cost) cli_json_measured(&json, "cost", check->cost, NULL, 0);
  return cli_json_end(&json);
}

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

/* HOOKE_NO_MEMORY if the stiffnesses are missing. */
static int32_t print_groups(const hooke_system *system) {
  const int64_t count = hooke_system_count(system, "springs");
  double *stiffness = malloc((size_t)(2 * count + 1) * sizeof *stiffness), *length = stiffness + count,
         *at = stiffness;
  int32_t status =
      stiffness ? hooke_system_members(system, "springs", NULL, stiffness, NULL, length) : HOOKE_NO_MEMORY;
  printf("springs      %" PRId64 "\n", count);
  for (int64_t i = 0; i < hooke_system_group_count(system, "springs"); i++) {
    const char *name = hooke_system_group_name(system, "springs", i);
    const int64_t size = hooke_system_group_size(system, "springs", i);
    cli_say("  %10" PRId64 " %s", size, name[0] ? name : "(no name)");
    if (status == HOOKE_OK) print_stiffness(at, at + count, size);
    printf("\n");
    at += status == HOOKE_OK ? size : 0;
  }
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

static void print_limits(const struct check *check) {
  const int overdamped = strcmp(hooke_system_dynamics(check->setup.system), "overdamped") == 0;
  char text[HOOKE_NUMBER_SIZE];
  printf("largest step certain to be stable, at the start:\n");
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    const char *name = hooke_method_name(i);
    const double bound = check->bound[i];
    printf("  %-18s ", name);
    if (!hooke_method_is_built(name)) {
      printf("(not in this build)\n");
    } else if (hooke_method_is_adaptive(name) != 0) {
      printf("chooses its own\n");
    } else if (isnan(bound)) {
      printf("%s\n", overdamped ? "takes no overdamped scene" : "not known");
    } else if (isinf(bound)) {
      printf("any\n");
    } else if (bound == 0.0) {
      printf("none: stable at no step\n");
    } else {
      printf("%s s\n", cli_format_rounded(bound, text));
    }
  }
}

static void print_cost(const struct check *check) {
  const hooke_options *options = check->setup.options;
  const char *method = hooke_options_text(options, "method");
  double steps = round(hooke_options_number(options, "duration") / hooke_options_number(options, "step"));
  if (hooke_method_is_adaptive(method) != 0 || isnan(steps)) return;
  printf("cost         %s: %.0f steps, %.3g spring-steps\n", method, steps,
         steps * (double)hooke_system_count(check->setup.system, "springs"));
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
  const int32_t status = print_groups(system);
  cli_derived_words(system);
  printf("forces       ");
  for (int64_t i = 0; i < hooke_system_count(system, "forces"); i++) {
    printf("%s%s", i ? ", " : "", hooke_system_force_name(system, i));
  }
  printf("%s\n", hooke_system_count(system, "forces") == 0 ? "none" : "");
  print_memory(check);
  print_cost(check);
  print_limits(check);
  cli_cost_sheet_print_left_out(system);
  if (check->cost) cli_cost_sheet_print(check->cost, system);
  cli_print_flush();
  cli_warnings_tell(check->arguments, check->warnings);
  return status;
}

static int check_and_tell(struct check *check, struct cli_peak loaded) {
  int code = cli_peak_of_run(check->arguments, &check->setup, loaded, &check->memory);
  if (code != HOOKE_EXIT_DONE) return code;
  int32_t status = find_bounds(check);
  if (status == HOOKE_OK) warn_of_method(check);
  warn_of_coincident_springs(check);
  if (status == HOOKE_OK) status = warn_of_loose_particles(check);
  if (status == HOOKE_OK)
    status = hooke_system_warnings(check->setup.system, cli_warnings_hear, check->warnings);
  if (status != HOOKE_OK) return cli_report(check->arguments, cli_exit_code(status), "out of memory");
  if (cli_arguments_text(check->arguments, "cost"))
    code = cli_cost_sheet_find(check->arguments, &check->setup, &check->cost);
  if (code != HOOKE_EXIT_DONE && code != HOOKE_EXIT_INTERRUPTED) return code;
  status = check->arguments->json ? print_json(check) : print_words(check);
  return status == HOOKE_OK ? code : cli_report(check->arguments, cli_exit_code(status), "out of memory");
}

/* As `run` does; a scene may leave all of it to the command line. */
static int choose_times(struct check *check) {
  const hooke_options *run = check->setup.options;
  char doubt[HOOKE_DOC_SIZE] = "";
  const int code = cli_fit_run(check->arguments, &check->setup, doubt);
  const int some = hooke_options_is_set(run, "method") || hooke_options_is_set(run, "step");
  const int refused = doubt[0] != '\0';
  if (refused || (some && cli_setup_missing(&check->setup, hooke_options_text(run, "method"), doubt)))
    cli_append(check->warnings, HOOKE_WARNINGS_SIZE, "%s\n", doubt);
  return code;
}

static int do_check(const struct cli_arguments *arguments) {
  struct check check = {.arguments = arguments};
  int code = cli_setup_load(arguments, &check.setup);
  if (code == HOOKE_EXIT_DONE) code = choose_times(&check);
  if (code == HOOKE_EXIT_DONE) code = check_and_tell(&check, cli_peak_look());
  hooke_measurement_destroy(check.cost);
  free(check.bound);
  cli_setup_destroy(&check.setup);
  return code;
}

static const struct cli_verb_row rows[] = {
    {"cost", 0, NULL, "what each ingredient costs, too: time, memory, and the largest step without it"},
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
