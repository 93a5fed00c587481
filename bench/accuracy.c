/* Time and error of methods on a damped cloth that hangs from two corners:
 *
 *   accuracy [--size N] [--stiffness N] [--damping "N s"] [--duration S] [--repeats N] REFERENCE RUN ...
 *
 * REFERENCE and RUN are a method with options of a run, as in cvode-bdf,rtol=1e-6,linear_solver=gmres. Errors
 * are the largest of a component at the end against REFERENCE, which is run once and first; its own error is
 * for the caller to judge. Runs take turns; times are processor times, the minimum of `repeats` (3). */
#include "hooke.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { MOST_RUNS = 32 };

struct request {
  int64_t size;
  double stiffness, damping, duration;
  int repeats, count;
  const char *run[MOST_RUNS];
};

struct outcome {
  int32_t status;
  double seconds;
  int64_t steps, evaluations, products, nonlinear, linear;
  double *q, *v;
};

static int32_t add_cloth(hooke_system *system, const struct request *request) {
  static const char *const family[] = {"structural", "shear", "bend"};
  const double edges[] = {1.0, 0.0, 0.0, 0.0, 0.0, 1.0}, origin[] = {0.0, 0.0, 0.0};
  const double sizes[] = {(double)request->size, (double)request->size};
  hooke_options *options = NULL;
  char name[64];
  int32_t status = hooke_options_create("cloth", &options);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "origin", 3, origin);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "edges", 6, edges);
  if (status == HOOKE_OK) status = hooke_options_set_numbers(options, "size", 2, sizes);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "mass", 1.0);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "pinned", "top-corners");
  for (int k = 0; k < 3 && status == HOOKE_OK; k++) {
    snprintf(name, sizeof name, "%s.stiffness", family[k]);
    status = hooke_options_set_number(options, name, request->stiffness);
    snprintf(name, sizeof name, "%s.damping", family[k]);
    if (status == HOOKE_OK) status = hooke_options_set_number(options, name, request->damping);
  }
  if (status == HOOKE_OK) status = hooke_system_add_part(system, "cloth", "cloth", options, NULL, NULL);
  hooke_options_destroy(options);
  return status;
}

static int32_t build(const struct request *request, hooke_system **system) {
  const double down[] = {0.0, -9.81, 0.0};
  int32_t status = hooke_system_create(system);
  if (status == HOOKE_OK) status = add_cloth(*system, request);
  if (status == HOOKE_OK) status = hooke_system_set_gravity(*system, down);
  return status == HOOKE_OK ? hooke_system_commit(*system) : status;
}

static int32_t set(hooke_options *options, const char *name, const char *value) {
  char *end;
  const double number = strtod(value, &end);
  return end > value && *end == '\0' ? hooke_options_set_number(options, name, number)
                                     : hooke_options_set_text(options, name, value);
}

/* The options of METHOD,KEY=VALUE,... */
static int32_t read_run(const char *run, double duration, hooke_options *options) {
  char text[256];
  snprintf(text, sizeof text, "%s", run);
  char *word = strtok(text, ",");
  int32_t status = hooke_options_set_text(options, "method", word);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "duration", duration);
  if (status == HOOKE_OK) status = hooke_options_set_number(options, "every", duration);
  while (status == HOOKE_OK && (word = strtok(NULL, ",")) != NULL) {
    char *value = strchr(word, '=');
    if (value) *value++ = '\0';
    status = set(options, word, value ? value : "");
  }
  return status;
}

static int32_t measure(const hooke_system *system, const struct request *request, const char *run,
                       struct outcome *found) {
  hooke_options *options = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int32_t status = hooke_options_create("run", &options);
  if (status == HOOKE_OK) status = read_run(run, request->duration, options);
  if (status == HOOKE_OK) status = hooke_integrator_create(system, options, &integrator);
  if (status == HOOKE_OK) status = hooke_state_create(system, &state);
  if (status == HOOKE_OK) {
    const clock_t begun = clock();
    status = hooke_integrator_run(integrator, state);
    const double seconds = (double)(clock() - begun) / CLOCKS_PER_SEC;
    if (!(found->seconds <= seconds)) found->seconds = seconds;
    found->steps = hooke_integrator_count(integrator, "steps");
    found->evaluations = hooke_integrator_count(integrator, "force_evaluations");
    found->products = hooke_integrator_count(integrator, "derivative_products");
    found->nonlinear = hooke_integrator_count(integrator, "nonlinear_iterations");
    found->linear = hooke_integrator_count(integrator, "linear_iterations");
    const size_t bytes = (size_t)hooke_state_size(state) * sizeof(double);
    memcpy(found->q, hooke_state_position(state), bytes);
    memcpy(found->v, hooke_state_velocity(state), bytes);
  }
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(options);
  return status;
}

static double largest_difference(int64_t size, const double *a, const double *b) {
  double most = 0.0;
  for (int64_t k = 0; k < size; k++)
    most = fmax(most, fabs(a[k] - b[k]));
  return most;
}

static void print_row(const struct request *request, int k, const struct outcome *o,
                      const struct outcome *exact) {
  const int64_t size = 3 * request->size * request->size;
  printf("%-58s %9.4f %8lld %8lld %8lld %8lld %8lld", request->run[k], o->seconds, (long long)o->steps,
         (long long)o->evaluations, (long long)o->nonlinear, (long long)o->linear, (long long)o->products);
  if (o->status != HOOKE_OK)
    printf("  status %d\n", o->status);
  else if (k == 0)
    printf("  reference\n");
  else
    printf(" %9.2e %9.2e\n", largest_difference(size, o->q, exact->q),
           largest_difference(size, o->v, exact->v));
}

static int read_arguments(int argc, char **argv, struct request *request) {
  for (int k = 1; k < argc; k++) {
    const char *value = k + 1 < argc ? argv[k + 1] : "";
    if (strncmp(argv[k], "--", 2) != 0) {
      if (request->count == MOST_RUNS) return 0;
      request->run[request->count++] = argv[k];
      continue;
    }
    k++;
    if (strcmp(argv[k - 1], "--size") == 0)
      request->size = strtoll(value, NULL, 10);
    else if (strcmp(argv[k - 1], "--stiffness") == 0)
      request->stiffness = strtod(value, NULL);
    else if (strcmp(argv[k - 1], "--damping") == 0)
      request->damping = strtod(value, NULL);
    else if (strcmp(argv[k - 1], "--duration") == 0)
      request->duration = strtod(value, NULL);
    else if (strcmp(argv[k - 1], "--repeats") == 0)
      request->repeats = (int)strtol(value, NULL, 10);
    else
      return 0;
  }
  return request->count > 1 && request->size > 1 && request->repeats > 0;
}

int main(int argc, char **argv) {
  struct request request = {.size = 32, .stiffness = 50.0, .damping = 0.01, .duration = 0.1, .repeats = 3};
  if (!read_arguments(argc, argv, &request)) {
    fprintf(stderr, "accuracy [--size N] [--stiffness N] [--damping \"N s\"] [--duration S] [--repeats N] "
                    "REFERENCE RUN ...\n");
    return 2;
  }
  hooke_system *system = NULL;
  struct outcome outcome[MOST_RUNS] = {0};
  const size_t size = (size_t)(3 * request.size * request.size);
  int32_t status = build(&request, &system);
  for (int k = 0; k < request.count && status == HOOKE_OK; k++) {
    outcome[k].seconds = INFINITY;
    outcome[k].q = calloc(2 * size, sizeof(double));
    if (outcome[k].q == NULL) status = HOOKE_NO_MEMORY;
    outcome[k].v = outcome[k].q + size;
  }
  for (int turn = 0; turn < request.repeats && status == HOOKE_OK; turn++) {
    for (int k = turn == 0 ? 0 : 1; k < request.count; k++)
      outcome[k].status = measure(system, &request, request.run[k], &outcome[k]);
  }
  printf("%-58s %9s %8s %8s %8s %8s %8s %9s %9s\n", "run", "seconds", "steps", "forces", "newton", "linear",
         "products", "error m", "error m/s");
  for (int k = 0; k < request.count && status == HOOKE_OK; k++)
    print_row(&request, k, &outcome[k], &outcome[0]);
  for (int k = 0; k < request.count; k++) {
    if (outcome[k].status != HOOKE_OK) status = outcome[k].status;
    free(outcome[k].q);
  }
  if (status != HOOKE_OK) fprintf(stderr, "%s\n", hooke_last_error());
  hooke_system_destroy(system);
  return status == HOOKE_OK ? 0 : 1;
}
