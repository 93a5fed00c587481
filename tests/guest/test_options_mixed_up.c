/* Options of all tables have one C type: a function that is given those of another table says so, in every
 * build, and does not read missing options. */
#include "check.h"
#include "run.h"
#include "small.h"

#include <stdlib.h>
#include <string.h>

/* ---- every table of options ---- */

static const char *const tables[] = {"run",    "springs", "altitude",  "rope",   "cloth", "lattice", "mesh",
                                     "strand", "scene",   "particles", "driven", "needs", "verify",  "study",
                                     "limit",  "cost",    "why",       "view",   "check"};
enum { TABLES = sizeof tables / sizeof tables[0] };

/* ---- every function that takes options ---- */

static const double place[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const int64_t four[] = {0, 1, 2, 3};

static hooke_system *open_system(void) {
  return small_system(4, place, NULL, 1.0, 0);
}

/* Springs, altitude springs or a part of this kind. */
static int32_t add(const char *what, hooke_options *o) {
  owned_system *system = open_system();
  if (strcmp(what, "springs") == 0) return hooke_system_add_springs(system, NULL, 2, four, o);
  if (strcmp(what, "altitude") == 0) return hooke_system_add_altitude(system, NULL, 1, four, o);
  return hooke_system_add_part(system, what, NULL, o, NULL, NULL);
}

static int32_t set_mesh(const char *what, hooke_options *o) {
  (void)what;
  return hooke_mesh_set(o, 3, place, 1, four);
}

static int32_t apply_scene(const char *what, hooke_options *o) {
  (void)what;
  owned_system *system = open_system();
  return hooke_scene_options_apply(o, system);
}

static int32_t grow(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)t, (void)ctx;
  memcpy(rate, x, (size_t)n * sizeof *x);
  return 0;
}

static int32_t create_first_order(const char *what, hooke_options *o) {
  (void)what;
  owned_integrator *made = NULL;
  hooke_options_set_text(o, "method", "rk4");
  return hooke_integrator_create_first_order(1, grow, NULL, o, &made);
}

static int32_t create_integrator(const char *what, hooke_options *o) {
  (void)what;
  owned_system *system = small_oscillator(10.0);
  owned_integrator *made = NULL;
  return hooke_integrator_create(system, o, &made);
}

static int32_t write_scene(const char *what, hooke_options *o) {
  (void)what;
  owned_system *system = small_oscillator(10.0);
  owned_scene *made = NULL;
  return hooke_scene_of_system(system, NULL, o, "a", NULL, &made);
}

/* A measurement of this kind with these options of its own. */
static int32_t measure(const char *what, hooke_options *o) {
  owned_system *system = small_oscillator(10.0);
  owned_options *run = run_options((struct run){.method = "verlet", .step = 0.01, .duration = 0.1});
  owned_measurement *made = NULL;
  if (o && strcmp(what, "needs") == 0) hooke_options_set_text(o, "want", "0.1");
  return hooke_measurement_create(what, system, run, o, &made);
}

/* With these options of a run. */
static int32_t measure_run(const char *what, hooke_options *o) {
  owned_system *system = small_oscillator(10.0);
  owned_options *options = strcmp(what, "needs") == 0 ? options_with("needs", "want=0.1") : NULL;
  owned_measurement *made = NULL;
  if (o && options) hooke_options_set_number(o, "duration", 0.1);
  return hooke_measurement_create(what, system, o, options, &made);
}

static int32_t pick(const char *what, hooke_options *o) {
  (void)what;
  owned_system *system = small_oscillator(10.0);
  hooke_options_set_number(o, "duration", 0.1);
  owned_measurement *estimate = NULL;
  int32_t status = estimate_of(system, 0.1, &estimate);
  if (status == HOOKE_OK) status = hooke_estimate_pick(estimate, NULL, o);
  return status;
}

static const struct {
  const char *name,
      *table; /* the table that it takes; NULL: some of its options are required, and are not set here */
  int32_t (*take)(const char *what, hooke_options *options);
  const char *what;
} functions[] = {{"add_springs", NULL, add, "springs"},
                 {"add_altitude", NULL, add, "altitude"},
                 {"add_part rope", NULL, add, "rope"},
                 {"add_part cloth", NULL, add, "cloth"},
                 {"add_part lattice", NULL, add, "lattice"},
                 {"add_part mesh", NULL, add, "mesh"},
                 {"add_part strand", NULL, add, "strand"},
                 {"mesh_set", "mesh", set_mesh, NULL},
                 {"scene_options_apply", "scene", apply_scene, NULL},
                 {"integrator_create", "run", create_integrator, NULL},
                 {"integrator_create_first_order", "run", create_first_order, NULL},
                 {"limit_create run", "run", measure_run, "limit"},
                 {"limit_create", "limit", measure, "limit"},
                 {"cost_create run", "run", measure_run, "cost"},
                 {"cost_create", "cost", measure, "cost"},
                 {"check_create", "check", measure, "check"},
                 {"study_create run", NULL, measure_run, "study"},
                 {"study_create", "study", measure, "study"},
                 {"needs run", "run", measure_run, "needs"},
                 {"needs", "needs", measure, "needs"},
                 {"study_pick", "run", pick, NULL},
                 {"scene_of_system", "run", write_scene, NULL}};

TEST(test_other_options_are_refused) {
  int64_t taken = 0, bad = 0;
  for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
    for (int t = 0; t < TABLES; t++) {
      owned_options *options = NULL;
      if (hooke_options_create(tables[t], &options) == HOOKE_NOT_BUILT) continue;
      hooke_options_set_number(options, "step", 0.01); /* of a run; others have none */
      const int32_t status = functions[f].take(functions[f].what, options);
      const int right = functions[f].table && strcmp(functions[f].table, tables[t]) == 0;
      if (!right && status >= 0) {
        print_error("%s takes the options of %s\n", functions[f].name, tables[t]);
        bad++;
      }
      if (right && status != HOOKE_OK && status != HOOKE_NOT_BUILT) {
        print_error("%s refuses the options of %s: %s\n", functions[f].name, tables[t], hooke_last_error());
        bad++;
      }
      taken += right && status == HOOKE_OK;
    }
  }
  assert_int_equal(bad, 0);
  assert_true(taken >= 4);
}

/* NULL options are the defaults if the header says so; otherwise they are refused. */
TEST(test_missing_options_are_refused) {
  static const char *const may_be_missing[] = {"limit_create run", "limit_create", "cost_create run",
                                               "cost_create",      "study_create", "scene_of_system",
                                               "check_create"};
  for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
    int may = 0;
    for (size_t k = 0; k < sizeof may_be_missing / sizeof may_be_missing[0]; k++)
      may |= strcmp(functions[f].name, may_be_missing[k]) == 0;
    const int32_t status = functions[f].take(functions[f].what, NULL);
    if (status == HOOKE_NOT_BUILT || (may && status == HOOKE_OK)) continue;
    /* the defaults of needs lack a required one */
    const char *word = strcmp(functions[f].name, "needs") == 0 ? "want" : "hooke_";
    if (may || status != HOOKE_BAD_VALUE || strstr(hooke_last_error(), word) == NULL)
      check_failed("%s without options: %d: %s", functions[f].name, (int)status, hooke_last_error());
  }
}
