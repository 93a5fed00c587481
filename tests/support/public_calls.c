#include "public_calls.h"

#include "check.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "public_calls.inc"

const struct function *const public_functions = functions;
const int32_t public_function_count = sizeof functions / sizeof functions[0];

/* ---- callbacks: they stop if they are given a context ---- */

static int32_t force(int64_t n, double t, const double *q, const double *v, double *f, void *ctx) {
  (void)n, (void)t, (void)q, (void)v, (void)f;
  return ctx != NULL;
}

static int32_t product(int64_t n, double t, const double *q, const double *v, const double *dq,
                       const double *dv, double *out, void *ctx) {
  (void)n, (void)t, (void)q, (void)v, (void)dq, (void)dv, (void)out;
  return ctx != NULL;
}

static int32_t drive(int64_t count, double t, double *q, double *v, void *ctx) {
  (void)t;
  memset(q, 0, (size_t)(3 * count) * sizeof *q);
  memset(v, 0, (size_t)(3 * count) * sizeof *v);
  return ctx != NULL;
}

static int32_t rate(int64_t n, double t, const double *x, double *slope, void *ctx) {
  (void)t;
  memcpy(slope, x, (size_t)n * sizeof *x);
  return ctx != NULL;
}

static int32_t observer(int64_t step, const hooke_state *state, void *ctx) {
  (void)step, (void)state;
  return ctx != NULL;
}

static int32_t progress(double done, const char *what, void *ctx) {
  (void)done, (void)what;
  return ctx != NULL;
}

static int32_t warning(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                       int64_t particle, void *ctx) {
  (void)kind, (void)sentence, (void)t, (void)limit, (void)spring, (void)particle;
  return ctx != NULL;
}

/* So that no run takes long. */
static int32_t stop_soon(double done, const char *what, void *ctx) {
  static int64_t calls;
  (void)done, (void)what, (void)ctx;
  return ++calls % 4 == 0;
}

#define CALL_BACK(function)                                                                                  \
  { "hooke_" #function, (void (*)(void))(function) }
static const struct {
  const char *type;
  void (*function)(void);
} callbacks[] = {{"hooke_force_product", (void (*)(void))product},
                 CALL_BACK(force),
                 CALL_BACK(drive),
                 CALL_BACK(rate),
                 CALL_BACK(observer),
                 CALL_BACK(progress),
                 CALL_BACK(warning)};

/* ---- the pool ---- */

static const double places[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
static const int64_t numbers[] = {0, 1, 2, 3};

int32_t pool_add(struct pool *pool, const char *type, const char *suits, void *address) {
  if (address == NULL || pool->count == MOST_OBJECTS) return 0;
  if (strcmp(type, "hooke_integrator") == 0) hooke_integrator_on_progress(address, 0.0, stop_soon, NULL);
  if (strcmp(type, "hooke_measurement") == 0) hooke_measurement_on_progress(address, stop_soon, NULL);
  pool->object[pool->count++] = (struct object){type, suits, address};
  return 1;
}

static int suits(const struct object *object, const char *function, const char *parameter) {
  char list[128];
  snprintf(list, sizeof list, "%s", object->suits ? object->suits : "");
  for (char *word = strtok(list, " "); word; word = strtok(NULL, " "))
    if (strstr(function, word) || strstr(parameter, word)) return 1;
  return 0;
}

static const struct object *object_of(const struct pool *pool, const char *type, int32_t place) {
  for (int32_t k = 0; k < pool->count; k++)
    if (strcmp(pool->object[k].type, type) == 0 && place-- == 0) return &pool->object[k];
  return NULL;
}

static void *good_object(const struct pool *pool, const char *function, const struct parameter *p) {
  const struct object *object, *best = object_of(pool, p->type, 0);
  for (int32_t k = 0; (object = object_of(pool, p->type, k)); k++)
    if (suits(object, function, p->name)) best = object;
  return best ? best->address : NULL;
}

static hooke_options *options_of(const char *table, const char *name, const char *text) {
  hooke_options *options = NULL;
  hooke_options_create(table, &options);
  if (name && options) check_ok(hooke_options_set_text(options, name, text));
  return options;
}

static hooke_system *net(int committed) {
  hooke_system *system = small_system(4, places, NULL, 1.0, 0);
  springs_with(system, 2, numbers, NULL, 10.0, 0.1, -1.0, 0);
  if (committed) check_ok(hooke_system_commit(system));
  return system;
}

static hooke_system *whole_net(void) {
  hooke_system *system = net(0);
  hooke_options *options = options_of("altitude", "stiffness", "5");
  check_ok(hooke_system_add_bending(system, "bend", 1, numbers, 1, &(double){1.0}));
  check_ok(hooke_system_add_altitude(system, "tetrahedron", 1, numbers, options));
  hooke_options_destroy(options);
  options = options_of("anchors", "stiffness", "5");
  check_ok(hooke_system_add_anchors(system, NULL, 1, numbers, options));
  hooke_options_destroy(options);
  options = options_of("loads", "force", "5,0,0");
  check_ok(hooke_system_add_loads(system, 1, numbers, options));
  hooke_options_destroy(options);
  return committed(system);
}

static void add_systems(struct pool *pool) {
  hooke_system *empty = committed(small_system(0, NULL, NULL, 1.0, 0)), *body = net(0);
  check_ok(hooke_system_add_body(body, "body", 3, numbers, 0));
  check_ok(hooke_system_commit(body));
  pool_add(pool, "hooke_system", NULL, whole_net());
  pool_add(pool, "hooke_system", "_add_ _set_ _drive_ _pin _commit _limit_memory _apply", net(0));
  pool_add(pool, "hooke_system", "_body_", body);
  pool_add(pool, "hooke_system", NULL, empty);
}

static void add_options(struct pool *pool) {
  static const char *const tables[] = {"springs", "altitude", "anchors", "loads", "mesh",
                                       "scene",   "study",    "limits",  "view"};
  pool_add(pool, "hooke_options", "run",
           run_options((struct run){.method = "rk4", .step = 0.1, .duration = 0.5}));
  for (size_t k = 0; k < sizeof tables / sizeof tables[0]; k++)
    pool_add(pool, "hooke_options", tables[k], options_of(tables[k], NULL, NULL));
  pool_add(pool, "hooke_options", "add_part", options_of("rope", "segments", "3"));
  pool_add(pool, "hooke_options", "add_springs", options_of("springs", "stiffness", "5"));
}

/* States after the first are of other sizes and kinds than that. */
static void add_states(struct pool *pool, const hooke_system *system) {
  hooke_state *state = start_state(system), *small = NULL, *large = NULL, *scalar = NULL, *first = NULL;
  check_ok(hooke_state_create_second_order(11, &small));
  check_ok(hooke_state_create_second_order(300, &large));
  check_ok(hooke_state_create_second_order(1, &scalar));
  check_ok(hooke_state_create_first_order(12, &first));
  pool_add(pool, "hooke_state", NULL, state);
  pool_add(pool, "hooke_state", "misfit", small);
  pool_add(pool, "hooke_state", "misfit", large);
  pool_add(pool, "hooke_state", "misfit", scalar);
  pool_add(pool, "hooke_state", "misfit", first);
}

static void add_integrators(struct pool *pool, const hooke_system *system, hooke_state *state) {
  hooke_integrator *integrator = start_with(system, .method = "rk4", .step = 0.1, .duration = 0.5), *other;
  owned_options *run = run_options((struct run){.method = "rk4", .step = 0.1, .duration = 0.5});
  owned_state *start = start_state(system);
  check_ok(hooke_integrator_run(integrator, state));
  pool_add(pool, "hooke_integrator", NULL, integrator);
  pool_add(pool, "hooke_integrator", NULL, start_with(system, .method = "verlet", .step = 0.1));
  pool_add(pool, "hooke_integrator", NULL,
           start_first_order(12, rate, NULL, (struct run){.method = "rk4", .step = 0.1, .duration = 0.5}));
  check_ok(hooke_integrator_create_second_order(11, force, NULL, NULL, 1, &(double){1.0}, run, &other));
  pool_add(pool, "hooke_integrator", NULL, other);
  other = start_with(system, .method = "forward-euler", .step = 10.0, .duration = 5000.0);
  check_status(hooke_integrator_run(other, start), HOOKE_DIVERGED);
  pool_add(pool, "hooke_integrator", "why", other);
  if (hooke_method_is_built("cvode-bdf"))
    pool_add(pool, "hooke_integrator", NULL,
             start_with(system, .method = "cvode-bdf", .duration = 0.5, .checkpoint = 0.1));
}

static void add_measurements(struct pool *pool, const hooke_system *system,
                             const hooke_integrator *integrator, const hooke_state *state) {
  static const char *const kinds[] = {"limit", "cost", "needs", "study", "check"};
  owned_options *run = run_options((struct run){.step = 0.1, .duration = 0.5}),
                *wanted = options_of("needs", "want", "0.1");
  hooke_measurement *made = NULL;
  for (size_t k = 0; k < sizeof kinds / sizeof kinds[0]; k++, made = NULL) {
    hooke_measurement_create(kinds[k], system, run, strcmp(kinds[k], "needs") == 0 ? wanted : NULL, &made);
    pool_add(pool, "hooke_measurement", kinds[k], made);
  }
  check_ok(estimate_of(system, NAN, &made));
  check_ok(hooke_estimate_begin(made, integrator, state));
  pool_add(pool, "hooke_measurement", "estimate", made);
}

#if HOOKE_HAVE_HDF5
static void add_files(struct pool *pool, const hooke_system *system, const hooke_integrator *integrator,
                      const hooke_state *state) {
  hooke_trajectory *trajectory = NULL;
  hooke_record *record = NULL;
  hooke_measurement *view = NULL;
  check_ok(hooke_trajectory_create("record.h5", system, integrator, NULL, &trajectory));
  for (int64_t frame = 0; frame < 2; frame++)
    check_ok(hooke_trajectory_write(trajectory, frame, state));
  check_ok(hooke_trajectory_close(trajectory, HOOKE_STOPPED));
  check_ok(hooke_record_open("record.h5", &record));
  hooke_view_create(record, NULL, &view);
  pool_add(pool, "hooke_record", NULL, record);
  pool_add(pool, "hooke_measurement", "view", view);
}
#endif

void pool_add_trajectory(struct pool *pool) {
  const struct parameter integrator = {HANDLE, 0, "hooke_integrator", ""};
  hooke_trajectory *trajectory = NULL;
  if (hooke_trajectory_create("trajectory.h5", pool->object[0].address, good_object(pool, "", &integrator),
                              NULL, &trajectory) == HOOKE_OK)
    pool_add(pool, "hooke_trajectory", NULL, trajectory);
}

void pool_begin(struct pool *pool) {
  static const char scene_text[] = "{\"hooke\": 1, \"particles\": {\"mass\": 1, \"position\": [[0, 0, 0]]}}";
  hooke_scene *scene = NULL;
  pool->count = 0;
  add_systems(pool);
  const hooke_system *system = pool->object[0].address;
  add_options(pool);
  const int32_t states = pool->count;
  add_states(pool, system);
  hooke_state *state = pool->object[states].address;
  const int32_t integrators = pool->count;
  add_integrators(pool, system, state);
  const hooke_integrator *integrator = pool->object[integrators].address;
  add_measurements(pool, system, integrator, state);
#if HOOKE_HAVE_HDF5
  add_files(pool, system, integrator, state);
#endif
  hooke_scene_parse(scene_text, (int64_t)strlen(scene_text), NULL, NULL, NULL, &scene);
  pool_add(pool, "hooke_scene", NULL, scene);
}

void destroy_object(const char *type, void *address) {
  for (int32_t k = 0; k < public_function_count; k++) {
    const char *name = functions[k].name, *end = strrchr(name, '_');
    const size_t length = strlen(type);
    if (strncmp(name, type, length) != 0 || name + length != end) continue;
    if (strcmp(end, "_destroy") == 0 || strcmp(end, "_close") == 0)
      functions[k].call((union value[MOST_PARAMETERS]){{.address = address}, {.whole = 0}},
                        &(union value){0});
  }
}

void pool_end(struct pool *pool) {
  static const char *const order[] = {"hooke_measurement", "hooke_trajectory", "hooke_record",
                                      "hooke_integrator",  "hooke_state",      "hooke_options",
                                      "hooke_scene",       "hooke_system"};
  for (size_t t = 0; t < sizeof order / sizeof order[0]; t++) {
    for (int32_t k = 0; k < pool->count; k++)
      if (strcmp(pool->object[k].type, order[t]) == 0) destroy_object(order[t], pool->object[k].address);
  }
  pool->count = 0;
}

/* ---- good arguments ---- */

enum { LENGTH = 64, ROOM = 4096 };

/* The first word of the list whose name ends the parameter's; NULL if there is none. */
struct good {
  const char *name;
  union value value;
};

static const struct good texts[] = {
    {"path", {.constant = "out.json"}}, {"kind", {.constant = "limit"}},
    {"name", {.constant = "step"}},     {"method", {.constant = "rk4"}},
    {"table", {.constant = "rows"}},    {"column", {.constant = "method"}},
    {"force", {.constant = "springs"}}, {"dynamics", {.constant = "inertial"}},
    {"property", {.constant = "name"}}, {"text", {.constant = "0.5"}},
    {"what", {.constant = "frames"}},   {"word", {.constant = "euler"}}};
static const char *const words[] = {
    "",      "no such word", "run",      "rope",    "record.h5", "no/such/file", "title",    "springs",
    "steps", "vertices",     "estimate", "out.csv", "out.h5",    "out.html",     "position", "good_frames",
    "total", "kinetic",      "time",     "error",   "cvode-bdf", "structural",   "study",    "overdamped"};
static const struct good wholes[] = {{"vertex_count", {.whole = 3}}, {"count", {.whole = 1}},
                                     {"samples", {.whole = 2}},      {"size", {.whole = 12}},
                                     {"length", {.whole = 3}},       {"steps", {.whole = 2}}};
static const int64_t odd_wholes[] = {
    0, -1, 1, 2, 7, INT32_MAX, INT64_C(1) << 31, INT64_C(1) << 62, INT64_MAX, INT64_MIN};
static const double odd_numbers[] = {NAN, INFINITY, -INFINITY, -1.0, 0.0, 1e308, -1e308, 5e-324, 1.0};
enum { WORDS = sizeof words / sizeof words[0], WHOLE_COUNT = sizeof odd_wholes / sizeof odd_wholes[0] };
enum { NUMBER_COUNT = sizeof odd_numbers / sizeof odd_numbers[0], TEXTS = WORDS + 2 };

static const union value *find_good(const struct good *list, size_t count, const char *name) {
  for (size_t k = 0; k < count; k++) {
    const size_t length = strlen(list[k].name), whole = strlen(name);
    if (whole >= length && strcmp(name + whole - length, list[k].name) == 0) return &list[k].value;
  }
  return NULL;
}
#define GOOD(list, name) find_good(list, sizeof list / sizeof list[0], name)

/* ---- choices ---- */

/* Bad in builds that check handles alone: of another type, and never made. */
static char no_object[256];
enum { NULL_OBJECT = 1, BAD_OBJECTS = HOOKE_CHECK_HANDLES ? 2 : 0, FIRST_OBJECT = 2 + BAD_OBJECTS };

int32_t is_bad_handle(const struct parameter *p, int32_t choice) {
  return p->kind == HANDLE && choice > 0 && choice < FIRST_OBJECT &&
         (choice > NULL_OBJECT || !p->may_be_null);
}

int32_t choices_of(const struct pool *pool, const struct parameter *p) {
  static const int32_t choices[] = {[SHORT] = 1 + WHOLE_COUNT,
                                    [WHOLE] = 1 + WHOLE_COUNT,
                                    [NUMBER] = 1 + NUMBER_COUNT,
                                    [TEXT] = 1 + TEXTS,
                                    [NUMBERS] = 3,
                                    [WHOLES] = 3,
                                    [OUT_NUMBERS] = 2,
                                    [OUT_WHOLES] = 2,
                                    [ADDRESS] = 2,
                                    [CALLBACK] = 2,
                                    [MADE] = 2};
  if (p->kind != HANDLE) return choices[p->kind];
  int32_t count = FIRST_OBJECT;
  while (object_of(pool, p->type, count - FIRST_OBJECT))
    count++;
  return count;
}

int32_t is_misfit(const struct pool *pool, const struct parameter *p, int32_t choice) {
  const struct object *object = p->kind == HANDLE ? object_of(pool, p->type, choice - FIRST_OBJECT) : NULL;
  return choice >= FIRST_OBJECT && object && object->suits && strcmp(object->suits, "misfit") == 0;
}

/* Arrays have blocks of their own, so that a sanitizer sees their ends. The last number of an array that is
 * read is one that no function accepts: a count beyond the array ends there. */
static double *array(int32_t odd) {
  static double *good, *bad;
  if (good == NULL) {
    good = new_doubles(LENGTH);
    bad = new_doubles(LENGTH);
    for (int k = 0; k < LENGTH; k++)
      good[k] = 1.0 + k, bad[k] = NAN;
    good[LENGTH - 1] = NAN;
  }
  return odd ? bad : good;
}

static int64_t *particles(int32_t odd) {
  static int64_t *good, *bad;
  if (good == NULL) {
    good = new_block(LENGTH, sizeof *good);
    bad = new_block(LENGTH, sizeof *bad);
    for (int k = 0; k < LENGTH; k++)
      good[k] = k % 4, bad[k] = k % 2 ? INT64_MAX : -1;
    good[LENGTH - 1] = -1;
  }
  return odd ? bad : good;
}

static const char *text_of(const char *name, int32_t choice) {
  static char long_text[5000];
  const union value *good = GOOD(texts, name);
  memset(long_text, 'x', sizeof long_text - 1);
  if (choice <= 1) return choice ? NULL : good ? good->constant : "word";
  return choice == TEXTS ? long_text : words[choice - 2];
}

static void *object_at(const struct pool *pool, const char *function, const struct parameter *p,
                       int32_t choice) {
  if (choice == 0) return good_object(pool, function, p);
  if (choice == NULL_OBJECT) return NULL;
  if (choice < FIRST_OBJECT) {
    const int other = strcmp(p->type, "hooke_system") == 0;
    return choice == 2 ? no_object + 64
                       : object_of(pool, other ? "hooke_options" : "hooke_system", 0)->address;
  }
  const struct object *object = object_of(pool, p->type, choice - FIRST_OBJECT);
  return object ? object->address : NULL;
}

void choose(const struct pool *pool, const struct function *f, int32_t place, int32_t choice, void **made,
            union value *argument) {
  static double *room;
  const struct parameter *p = &f->parameter[place];
  const union value *good = p->kind == WHOLE ? GOOD(wholes, p->name) : NULL;
  if (room == NULL) room = new_doubles(ROOM);
  *argument = (union value){.whole = 0};
  switch (p->kind) {
  case SHORT:
  case WHOLE:
    argument->whole = choice ? odd_wholes[choice - 1] : good ? good->whole : 0;
    if (p->kind == SHORT) argument->whole = (int32_t)argument->whole;
    return;
  case NUMBER:
    argument->number = choice ? odd_numbers[choice - 1] : 0.5;
    return;
  case TEXT:
    argument->constant = text_of(p->name, choice);
    return;
  case NUMBERS:
    argument->address = choice == 1 ? NULL : array(choice == 2);
    return;
  case WHOLES:
    argument->address = choice == 1 ? NULL : particles(choice == 2);
    return;
  case OUT_NUMBERS:
  case OUT_WHOLES:
    argument->address = choice ? NULL : room;
    return;
  case ADDRESS:
    argument->address = choice ? &room : NULL;
    return;
  case CALLBACK:
    for (size_t k = 0; choice == 0 && k < sizeof callbacks / sizeof callbacks[0]; k++)
      if (strcmp(callbacks[k].type, p->type) == 0) argument->callback = callbacks[k].function;
    return;
  case HANDLE:
    argument->address = object_at(pool, f->name, p, choice);
    return;
  default:
    argument->address = choice ? NULL : made;
  }
}
