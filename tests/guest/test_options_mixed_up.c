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

static int32_t add_springs(hooke_options *o) {
  hooke_system *system = open_system();
  const int32_t status = hooke_system_add_springs(system, NULL, 2, four, o);
  hooke_system_destroy(system);
  return status;
}

static int32_t add_altitude(hooke_options *o) {
  hooke_system *system = open_system();
  const int32_t status = hooke_system_add_altitude(system, NULL, 1, four, o);
  hooke_system_destroy(system);
  return status;
}

static int32_t add_part(const char *kind, hooke_options *o) {
  hooke_system *system = open_system();
  const int32_t status = hooke_system_add_part(system, kind, NULL, o, NULL, NULL);
  hooke_system_destroy(system);
  return status;
}
static int32_t add_rope(hooke_options *o) {
  return add_part("rope", o);
}
static int32_t add_cloth(hooke_options *o) {
  return add_part("cloth", o);
}
static int32_t add_lattice(hooke_options *o) {
  return add_part("lattice", o);
}
static int32_t add_mesh(hooke_options *o) {
  return add_part("mesh", o);
}
static int32_t add_strand(hooke_options *o) {
  return add_part("strand", o);
}

static int32_t set_mesh(hooke_options *o) {
  return hooke_mesh_set(o, 3, place, 1, four);
}

static int32_t apply_scene(hooke_options *o) {
  hooke_system *system = open_system();
  const int32_t status = hooke_scene_options_apply(o, system);
  hooke_system_destroy(system);
  return status;
}

static hooke_system *committed(void) {
  return small_oscillator(10.0);
}

static int32_t grow(int64_t n, double t, const double *x, double *rate, void *ctx) {
  (void)t, (void)ctx;
  memcpy(rate, x, (size_t)n * sizeof *x);
  return 0;
}

static int32_t create_first_order(hooke_options *o) {
  hooke_integrator *made = NULL;
  hooke_options_set_text(o, "method", "rk4");
  const int32_t status = hooke_integrator_create_first_order(1, grow, NULL, o, &made);
  hooke_integrator_destroy(made);
  return status;
}

#define TAKES(name, type, create, destroy)                                                                   \
  static int32_t name(hooke_options *o) {                                                                    \
    hooke_system *system = committed();                                                                      \
    type *made = NULL;                                                                                       \
    const int32_t status = create;                                                                           \
    if (status == HOOKE_OK) destroy(made);                                                                   \
    hooke_system_destroy(system);                                                                            \
    return status;                                                                                           \
  }
TAKES(create_integrator, hooke_integrator, hooke_integrator_create(system, o, &made),
      hooke_integrator_destroy)
TAKES(create_study_of_run, hooke_measurement, hooke_measurement_create("study", system, o, NULL, &made),
      hooke_measurement_destroy)
TAKES(create_limit_of_run, hooke_measurement, hooke_measurement_create("limit", system, o, NULL, &made),
      hooke_measurement_destroy)
TAKES(create_limit, hooke_measurement, hooke_measurement_create("limit", system, NULL, o, &made),
      hooke_measurement_destroy)
TAKES(create_cost_of_run, hooke_measurement, hooke_measurement_create("cost", system, o, NULL, &made),
      hooke_measurement_destroy)
TAKES(create_cost, hooke_measurement, hooke_measurement_create("cost", system, NULL, o, &made),
      hooke_measurement_destroy)
TAKES(create_check, hooke_measurement, hooke_measurement_create("check", system, NULL, o, &made),
      hooke_measurement_destroy)
TAKES(write_scene, hooke_scene, hooke_scene_of_system(system, NULL, o, "a", NULL, &made), hooke_scene_destroy)

static int32_t with_run(hooke_options *o,
                        int32_t (*create)(hooke_system *, hooke_options *, hooke_options *)) {
  hooke_system *system = committed();
  hooke_options *run = run_options((struct run){.method = "verlet", .step = 0.01, .duration = 0.1});
  const int32_t status = create(system, run, o);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
  return status;
}

static int32_t study_with(hooke_system *system, hooke_options *run, hooke_options *o) {
  hooke_measurement *made = NULL;
  const int32_t status = hooke_measurement_create("study", system, run, o, &made);
  if (status == HOOKE_OK) hooke_measurement_destroy(made);
  return status;
}
static int32_t create_study(hooke_options *o) {
  return with_run(o, study_with);
}

static int32_t needs_with(hooke_system *system, hooke_options *run, hooke_options *o) {
  hooke_measurement *made = NULL;
  if (o && hooke_options_row_count(o) == 3) hooke_options_set_text(o, "want", "0.1");
  const int32_t status = hooke_measurement_create("needs", system, run, o, &made);
  if (status == HOOKE_OK) hooke_measurement_destroy(made);
  return status;
}
static int32_t create_needs(hooke_options *o) {
  return with_run(o, needs_with);
}

static int32_t create_needs_of_run(hooke_options *o) {
  hooke_system *system = committed();
  hooke_measurement *made = NULL;
  hooke_options *options = options_with("needs", "want=0.1");
  hooke_options_set_number(o, "duration", 0.1);
  const int32_t status = hooke_measurement_create("needs", system, o, options, &made);
  if (status == HOOKE_OK) hooke_measurement_destroy(made);
  hooke_options_destroy(options);
  hooke_system_destroy(system);
  return status;
}

static int32_t pick(hooke_options *o) {
  hooke_system *system = committed();
  hooke_options_set_number(o, "duration", 0.1);
  hooke_measurement *estimate = NULL;
  int32_t status = estimate_of(system, 0.1, &estimate);
  if (status == HOOKE_OK) status = hooke_estimate_pick(estimate, NULL, o);
  hooke_measurement_destroy(estimate);
  hooke_system_destroy(system);
  return status;
}

static const struct {
  const char *name,
      *table; /* the table that it takes; NULL: some of its options are required, and are not set here */
  int32_t (*take)(hooke_options *options);
} functions[] = {{"add_springs", NULL, add_springs},
                 {"add_altitude", NULL, add_altitude},
                 {"add_part rope", NULL, add_rope},
                 {"add_part cloth", NULL, add_cloth},
                 {"add_part lattice", NULL, add_lattice},
                 {"add_part mesh", NULL, add_mesh},
                 {"add_part strand", NULL, add_strand},
                 {"mesh_set", "mesh", set_mesh},
                 {"scene_options_apply", "scene", apply_scene},
                 {"integrator_create", "run", create_integrator},
                 {"integrator_create_first_order", "run", create_first_order},
                 {"limit_create run", "run", create_limit_of_run},
                 {"limit_create", "limit", create_limit},
                 {"cost_create run", "run", create_cost_of_run},
                 {"cost_create", "cost", create_cost},
                 {"check_create", "check", create_check},
                 {"study_create run", NULL, create_study_of_run},
                 {"study_create", "study", create_study},
                 {"needs run", "run", create_needs_of_run},
                 {"needs", "needs", create_needs},
                 {"study_pick", "run", pick},
                 {"scene_of_system", "run", write_scene}};

TEST(test_other_options_are_refused) {
  int64_t taken = 0, bad = 0;
  for (size_t f = 0; f < sizeof functions / sizeof functions[0]; f++) {
    for (int t = 0; t < TABLES; t++) {
      owned_options *options = NULL;
      if (hooke_options_create(tables[t], &options) == HOOKE_NOT_BUILT) continue;
      hooke_options_set_number(options, "step", 0.01); /* of a run; others have none */
      const int32_t status = functions[f].take(options);
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
    const int32_t status = functions[f].take(NULL);
    if (status == HOOKE_NOT_BUILT || (may && status == HOOKE_OK)) continue;
    /* the defaults of needs lack a required one */
    const char *word = strcmp(functions[f].name, "needs") == 0 ? "want" : "hooke_";
    if (may || status != HOOKE_BAD_VALUE || strstr(hooke_last_error(), word) == NULL)
      check_failed("%s without options: %d: %s", functions[f].name, (int)status, hooke_last_error());
  }
}
