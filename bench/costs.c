/* Measures the table of costs (src/measure/counted_work/costs.c): runs scenes by every method, holds the time
 * that they took against their counted work, fits the costs to that, and prints the table as the source has
 * it.
 *
 *   costs [--seconds S]
 *
 * S seconds (0.1) for each scene and method, of processor time; what runs beside it disturbs caches alone. */
#include "machine.h"
#include "scenes.h"

#include "measure/counted_work/work.h"
#include "model/force/force.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

/* Particles of scenes that are run by all methods. */
static const double MOST_DIRECT = 5000.0, MOST_SOLVED = 20000.0;
enum { MOST_ROWS = 800, ROUNDS = 40000, TURNS = 5, FIRST_STEPS = 4, MOST_STEPS = 100000 };
static const double LEAST = 0.1, SHARE = 0.3; /* of a cost [ns]; of its way, taken in a round */
static const double LONG_STEP = 20.0; /* of methods that solve for their steps, in safe ones of the others */

struct row {
  const char *scene, *method, *solver;
  double amount[HOOKE_WORKS], seconds;
};
static struct row row[MOST_ROWS];
static int rows;

/* ---- scenes ---- */

#define CLOTH(size, damping, more)                                                                           \
  "'parts':[{'kind':'cloth','name':'c','edges':[[1,0,0],[0,0,1]],'size':[" size "],'mass':1,"                \
  "'pinned':'top-corners','structural':{'stiffness':50,'damping':" damping "}" more "}]"
#define ROPE(segments, more)                                                                                 \
  "'parts':[{'kind':'rope','name':'r','from':[0,0,0],'to':[1,0,0],'segments':" segments ",'mass':0.25,"      \
  "'pinned':'start','stretch':{'stiffness':200,'damping':0.05}" more "}]"
#define STRAND(segments)                                                                                     \
  "'parts':[{'kind':'strand','name':'h','from':[0,0,0],'to':[0,-0.2,0],'segments':" segments                 \
  ",'curl':0.02,'turns':5,'mass':0.002,'pinned':[0,1,2],'stretch':{'stiffness':100,'damping':1e-4},"         \
  "'bend':{'stiffness':10},'twist':{'stiffness':5},'altitude':{'stiffness':1,'damping':1e-6}}]"
#define BLOCK(size, more)                                                                                    \
  "{'kind':'lattice','name':'b','edges':[[1,0,0],[0,1,0],[0,0,1]],'size':[" size "],'mass':1,"               \
  "'origin':[1,0,0],'structural':{'stiffness':50,'damping':0.01},'shear':{'stiffness':50}" more "}"

/* With ' for ". */
static const struct {
  const char *name, *text;
} small[] = {
    {"rope-12", ROPE("11", ",'bend':{'stiffness':2}")},
    {"rope-100", ROPE("99", ",'bend':{'stiffness':2}")},
    {"rope-1000", ROPE("999", "")},
    {"rope-12, drag", "'drag':0.1," ROPE("11", "")},
    {"beam-16", ROPE("16", ",'bending':13.6")},
    {"beam-1000", ROPE("1000", ",'bending':0.1")},
    {"cloth-64, bending", CLOTH("64,64", "0.01", ",'bending':0.001")},
    {"cloth-64, drag", "'drag':0.001," CLOTH("64,64", "0.01", "")},
    {"lattice-5", "'parts':[" BLOCK("5,5,9", "") "]"},
    {"lattice-12", "'parts':[" BLOCK("12,12,12", "") "]"},
    {"strand-60", STRAND("60")},
    {"strand-2000", STRAND("2000")},
    {"tissue-32", "'dynamics':'overdamped','drag':0.1," CLOTH("32,32", "0", "")},
    {"tissue-8", "'dynamics':'overdamped','drag':0.1," CLOTH("8,8", "0", "")},
    {"body", "'parts':[" BLOCK(
                 "5,3,5", ",'rigid':true") "],'springs':[{'name':'s','stiffness':50,'between':[[0,['b',0]],"
                                           "[0,['b',4]]]}],'particles':{'position':[[0,0,0]],'mass':1}"},
    {"bodies in a rope",
     "'particles':{'position':[[0,0,0]],'mass':1}," ROPE(
         "99", "") ","
                   "'bodies':[{'name':'x','particles':[['r',10],['r',11],['r',12],['r',13]]},"
                   "{'name':'y','particles':[['r',30],['r',31],['r',32],['r',33]]},"
                   "{'name':'z','particles':[['r',60],['r',61],['r',62],['r',63]]}]"},
    {"anchors-64",
     CLOTH("8,8", "0.01", "") ",'anchors':[{'name':'a','particles':[['c',9],['c',10],['c',11],['c',12]],"
                              "'points':[[0,1,0],[0,2,0],[1,1,0],[1,2,0]],'stiffness':5}]"},
};
enum { SMALL = sizeof small / sizeof small[0] };

static const struct {
  const char *name, *solver;
} methods[] = {
    {"forward-euler", "auto"},
    {"symplectic-euler", "auto"},
    {"verlet", "auto"},
    {"verlet", "implicit"},
    {"shardlow", "auto"},
    {"heun", "auto"},
    {"rk4", "auto"},
    {"backward-euler", "auto"},
    {"backward-euler", "direct"},
    {"tr-bdf2", "auto"},
    {"tr-bdf2", "direct"},
    {"implicit-midpoint", "auto"},
    {"cvode-bdf", "auto"},
    {"cvode-bdf", "direct"},
    {"cvode-bdf", "blocks"},
    {"cvode-adams", "auto"},
    {"rk8pd", "auto"},
    {"arkode-esdirk", "auto"},
};
enum { METHODS = sizeof methods / sizeof methods[0] };

/* ---- runs ---- */

static int32_t run_options(const hooke_system *system, int m, hooke_options **options) {
  const char *name = methods[m].name;
  const int implicit_damping = strcmp(methods[m].solver, "implicit") == 0;
  hooke_state *state = NULL;
  double bound = NAN;
  int32_t status = hooke_state_create(system, &state);
  if (status == HOOKE_OK)
    hooke_step_bound(system, hk_method_of_euler(system), hooke_state_position(state), &bound);
  if (hk_method_find(name)->solved) bound *= LONG_STEP;
  if (status == HOOKE_OK) status = hooke_options_create("run", options);
  if (status == HOOKE_OK) status = hooke_options_set_text(*options, "method", name);
  if (status == HOOKE_OK && !hk_method_find(name)->adaptive)
    status = hooke_options_set_number(*options, "step", isfinite(bound) ? 0.5 * bound : 1e-3);
  if (status == HOOKE_OK && strcmp(methods[m].solver, "auto") != 0)
    status = hooke_options_set_text(*options, implicit_damping ? "verlet_damping" : "linear_solver",
                                    methods[m].solver);
  hooke_state_destroy(state);
  return status;
}

static double processor_seconds(void) {
  struct timespec now;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* A whole run of so many steps; the least time of it and its amounts. */
static int32_t time_steps(const hooke_system *system, const hooke_options *options, int64_t steps,
                          struct row *to) {
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int32_t status = hooke_integrator_create(system, options, &integrator);
  if (status == HOOKE_OK) status = hooke_state_create(system, &state);
  const double begun = processor_seconds();
  if (status == HOOKE_OK) status = hooke_integrator_step(integrator, state, steps);
  if (status == HOOKE_OK) {
    to->seconds = fmin(to->seconds, processor_seconds() - begun);
    hk_work_amounts(integrator, to->amount);
  }
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  return status;
}

static void measure_method(const char *scene, const hooke_system *system, int m, double seconds) {
  hooke_options *options = NULL;
  struct row *to = &row[rows];
  *to = (struct row){scene, methods[m].name, methods[m].solver, .seconds = INFINITY};
  int32_t status = rows < MOST_ROWS ? run_options(system, m, &options) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = time_steps(system, options, FIRST_STEPS, to);
  const double each = to->seconds / FIRST_STEPS, steps = fmax(seconds / TURNS / each, FIRST_STEPS);
  const int turns = each * FIRST_STEPS > seconds ? 0 : TURNS; /* the first ones took long enough */
  if (turns > 0) to->seconds = INFINITY;
  for (int turn = 0; turn < turns && status == HOOKE_OK; turn++)
    status = time_steps(system, options, (int64_t)fmin(steps, MOST_STEPS), to);
  hooke_options_destroy(options);
  rows += status == HOOKE_OK; /* others: the method does not take the scene, or is not stable on it */
}

static void measure(const char *scene, const hooke_system *system, double seconds) {
  for (int m = 0; m < METHODS; m++) {
    const double particles = (double)hooke_system_particle_count(system),
                 most = strcmp(methods[m].solver, "direct") == 0 ? MOST_DIRECT : MOST_SOLVED;
    if (particles <= most || hk_work_of_steps(system, methods[m].name, 1) > 0.0)
      measure_method(scene, system, m, seconds);
  }
}

static void measure_small(int k, double seconds) {
  char text[4096];
  hooke_scene *scene = NULL;
  snprintf(text, sizeof text, "{'hooke':1,'gravity':[0,-9.81,0],%s}", small[k].text);
  for (char *at = text; *at; at++)
    *at = *at == '\'' ? '"' : *at;
  int32_t status = hooke_scene_parse(text, (int64_t)strlen(text), small[k].name, NULL, NULL, &scene);
  if (status == HOOKE_OK) status = hooke_scene_commit(scene);
  if (status == HOOKE_OK)
    measure(small[k].name, hooke_scene_system(scene), seconds);
  else
    fprintf(stderr, "%s: %s\n", small[k].name, hooke_last_error());
  hooke_scene_destroy(scene);
}

static void measure_bench(int64_t k, double seconds) {
  hooke_system *system = NULL;
  if (bench_scene_create(bench_scene(k), &system) == HOOKE_OK) measure(bench_scene(k)->name, system, seconds);
  hooke_system_destroy(system);
}

/* ---- the fit ---- */

static double nanoseconds(const double *cost, const struct row *of) {
  double sum = 0.0;
  for (int k = 0; k < HOOKE_WORKS; k++)
    sum += cost[k] * of->amount[k];
  return sum;
}

/* Least squares of the logarithms of counted over measured time, by descent along the logarithms of the
 * costs: each changes by the mean over all rows, weighed by its share of a row. So all stay above 0, and one
 * that no row has stays as it is. */
static void fit(double *cost) {
  for (int round = 0; round < ROUNDS; round++) {
    double weight[HOOKE_WORKS] = {0}, moment[HOOKE_WORKS] = {0};
    for (int i = 0; i < rows; i++) {
      const double whole = nanoseconds(cost, &row[i]), off = log(whole / (1e9 * row[i].seconds));
      for (int k = 0; k < HOOKE_WORKS; k++) {
        const double share = cost[k] * row[i].amount[k] / whole;
        weight[k] += share;
        moment[k] += share * off;
      }
    }
    for (int k = 0; k < HOOKE_WORKS; k++)
      if (weight[k] > 0.0) cost[k] = fmax(LEAST, cost[k] * exp(-SHARE * moment[k] / weight[k]));
  }
}

static const char *const names[] = {"STEP",
                                    "ADAPTIVE_STEP",
                                    "ADAPTIVE_PARTICLE",
                                    "EVALUATION",
                                    "PARTICLE",
                                    "FAR",
                                    "ADAPTIVE_EVALUATED",

                                    "SCATTERED",
                                    "CURVED",
                                    "BODY",
                                    "BODY_PARTICLE",
                                    "DAMPER",
                                    "PRODUCT",
                                    "PRODUCT_PARTICLE",
                                    "ROWS",
                                    "MATRIX",
                                    "MATRIX_PARTICLE",
                                    "VECTOR",
                                    "VECTOR_PARTICLE",
                                    "FACTOR_PRODUCT",
                                    "FACTOR_NUMBER"};
_Static_assert(sizeof names / sizeof names[0] == HOOKE_WORKS - HOOKE_WORK_STEP, "a name for each");

static void print_table(const double *cost) {
  struct machine machine;
  machine_read(&machine);
  printf("\n/* On %.10s, %s. */\nconst double hk_costs[HOOKE_WORKS] = {\n", machine.date, machine.cpu);
  for (int32_t k = 0; hk_force_table(k); k++)
    printf("    %.3g, %.3g, %.3g, /* %s */\n", cost[3 * k], cost[3 * k + 1], cost[3 * k + 2],
           hk_force_table(k)->name);
  for (int k = HOOKE_WORK_STEP; k < HOOKE_WORKS; k++)
    printf("    [HOOKE_WORK_%s] = %.3g,\n", names[k - HOOKE_WORK_STEP], cost[k]);
  printf("};\n");
}

int main(int argc, char **argv) {
  const double seconds = argc > 2 && strcmp(argv[1], "--seconds") == 0 ? strtod(argv[2], NULL) : 0.1;
  double cost[HOOKE_WORKS];
  memcpy(cost, hk_costs, sizeof cost);
  for (int k = 0; k < SMALL; k++)
    measure_small(k, seconds);
  for (int64_t k = 0; bench_scene(k); k++)
    measure_bench(k, seconds);
  fit(cost);
  printf("%-20s %-18s %-9s %12s %8s %8s\n", "scene", "method", "solver", "seconds", "counted", "fitted");
  for (int i = 0; i < rows; i++) {
    const double wall = 1e9 * row[i].seconds;
    printf("%-20s %-18s %-9s %12.6f %8.2f %8.2f\n", row[i].scene, row[i].method, row[i].solver,
           row[i].seconds, nanoseconds(hk_costs, &row[i]) / wall, nanoseconds(cost, &row[i]) / wall);
  }
  print_table(cost);
  return 0;
}
