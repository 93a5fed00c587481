/* Creating an integrator, and querying its counts. */
#include "integrate/integrator.h"

#include "core/clock.h"
#include "core/handle.h"
#include "core/memory.h"
#include "core/named_number.h"
#include "core/status.h"
#include "integrate/solve/reduced.h"
#include "model/callbacks.h"
#include "model/coordinates/coordinates.h"
#include "model/force/force.h"
#include "model/generalized.h"
#include "model/particles.h"
#include "model/size_limit.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

/* ---- creating ---- */

/* An integrator with method, options and schedule, but no problem yet. */
static int32_t create(const hooke_options *options, hooke_integrator **out) {
  int32_t status = hk_run_options_require(options, "options");
  if (status != HOOKE_OK) return status;
  const struct hk_method *method;
  status = hk_method_take(hooke_options_text(options, "method"), &method);
  if (status != HOOKE_OK) return status;
  hooke_integrator *it = hk_handle_new("hooke_integrator", sizeof *it);
  if (it == NULL) return HOOKE_NO_MEMORY;
  it->method = method;
  it->diverged_at = NAN;
  status = hooke_options_copy(options, &it->options);
  if (status == HOOKE_OK) status = hk_schedule_read(method, it->options, &it->schedule);
  return HOOKE_HAND_OVER(status, it, out, hooke_integrator_destroy);
}

/* Of explicit steps. */
static int32_t create_numbers(hooke_integrator *it) {
  const int64_t count = it->rate ? it->size : it->system->own_count;
  const int64_t pushes = it->rate ? 0 : HOOKE_PUSH * it->system->mover_count;
  if (count == 0 || it->method->adaptive || it->method->solved) return HOOKE_OK;
  double *block = hk_new(4 * count + pushes, sizeof(double));
  if (block == NULL) return HOOKE_NO_MEMORY;
  it->own_memory += (4 * count + pushes) * (int64_t)sizeof(double);
  it->numbers = (struct hk_numbers){
      count, block, block + count, block + 2 * count, block + 3 * count, block + 4 * count};
  return HOOKE_OK;
}

static int32_t finish(hooke_integrator *it, int32_t status, hooke_integrator **out) {
  if (status == HOOKE_OK) status = create_numbers(it);
  if (status == HOOKE_OK && it->method->steps->create) status = it->method->steps->create(it);
  return HOOKE_HAND_OVER(status, it, out, hooke_integrator_destroy);
}

static int32_t start_threads(hooke_integrator *it) {
  const int32_t workers =
      hk_motion_members(it->system, (int32_t)hooke_options_number(it->options, "threads"));
  if (workers > 1) it->pool = hk_pool_create(workers);
  return workers > 1 && it->pool == NULL ? HOOKE_NO_MEMORY : HOOKE_OK;
}

/* `it` is the integrator from here on, with its problem still missing. */
static int32_t take_system(hooke_integrator *it, const hooke_system *system, hooke_integrator **out) {
  int32_t status = hk_method_require(it->method, system);
  if (status == HOOKE_OK) status = hk_run_fill_tolerances(system, it->options);
  it->system = system;
  it->size = 3 * system->particle_count;
  if (it->method->by_tiles && system->mover_count == 0 && !system->overdamped && hk_goes_by_tiles(system))
    it->by_tiles = HOOKE_MOTION_BY_TILES;
  if (status == HOOKE_OK && it->method->choose) status = it->method->choose(it);
  if (status == HOOKE_OK) status = start_threads(it);
  if (status == HOOKE_OK) status = hk_motion_create(system, it->by_tiles, it->pool, &it->motion);
  if (status == HOOKE_OK) status = hk_recent_create(hk_integrator_numbers(it), 1, !it->by_tiles, &it->recent);
  return finish(it, status, out);
}

int32_t hooke_integrator_create(const hooke_system *system, const hooke_options *options,
                                hooke_integrator **out) {
  hooke_integrator *it = NULL;
  int32_t status = hk_system_require_committed(system);
  if (status == HOOKE_OK) status = hk_callbacks_require(system);
  if (status == HOOKE_OK) status = create(options, &it);
  return it == NULL ? status : take_system(it, system, out);
}

int32_t hooke_integrator_create_second_order(int64_t size, hooke_force *force, hooke_force_product *product,
                                             void *ctx, int64_t mass_count, const double *inverse_mass,
                                             const hooke_options *options, hooke_integrator **out) {
  hooke_integrator *it = NULL;
  hooke_system *system = NULL;
  int32_t status = hk_generalized_create(size, force, product, ctx, mass_count, inverse_mass, NULL, &system);
  if (status == HOOKE_OK) status = create(options, &it);
  if (it == NULL) {
    hooke_system_destroy(system);
    return status;
  }
  it->problem = system;
  return take_system(it, system, out);
}

int32_t hooke_integrator_create_first_order(int64_t size, hooke_rate *rate, void *ctx,
                                            const hooke_options *options, hooke_integrator **out) {
  hooke_integrator *it = NULL;
  int32_t status = hk_size_check(size, 9); /* with its slope, copies of both, a copy, and four stages */
  if (status == HOOKE_OK) status = create(options, &it);
  if (it == NULL) return status;
  it->rate = rate;
  it->rate_ctx = ctx;
  it->size = size;
  status = hk_method_require(it->method, NULL);
  if (status == HOOKE_OK) status = hk_run_fill_tolerances(NULL, it->options);
  if (status == HOOKE_OK) status = hk_recent_create(size, 0, 1, &it->recent);
  if (status == HOOKE_OK && (it->rows = hk_rows_new(2 * size)) == NULL) status = HOOKE_NO_MEMORY;
  return finish(it, status, out);
}

void hooke_integrator_destroy(hooke_integrator *it) {
  if (it == NULL) return;
  if (it->own || it->around) it->method->steps->destroy(it);
  hk_motion_destroy(it->motion);
  hk_pool_destroy(it->pool);
  hk_recent_release(&it->recent);
  hooke_state_destroy(it->restart.state);
  hooke_state_destroy(it->shown);
  hooke_state_destroy(it->passages.before);
  hooke_state_destroy(it->passages.now);
  if (it->checker.release) it->checker.release(it->checker.own);
  hooke_options_destroy(it->options);
  hooke_system_destroy(it->problem);
  hk_free(it->numbers.x);
  hk_free(it->start);
  hooke_rows_hold(it->rows, -1);
  hk_handle_free(it);
}

int32_t hk_integrator_check_state(const hooke_integrator *it, const hooke_state *state) {
  return hk_state_check(state, hk_integrator_numbers(it), it->system != NULL);
}

int32_t hk_integrator_require_particles(const hooke_integrator *it, const char *place, const char *instead) {
  if (it->system && it->system->generalized == NULL) return HOOKE_OK;
  const int32_t second = it->system && !hk_is_first_order(it->system);
  return hk_fail(HOOKE_UNSUITED, place, "a %s problem %s", second ? "second-order" : "first-order", instead);
}

const hooke_options *hooke_integrator_options(const hooke_integrator *integrator) {
  return integrator->options;
}

int32_t hooke_integrator_on_frame(hooke_integrator *integrator, hooke_observer *observer, void *ctx) {
  integrator->on_frame = (struct hk_watch){observer, ctx, 1};
  return HOOKE_OK;
}

int32_t hooke_integrator_on_checkpoint(hooke_integrator *integrator, hooke_observer *observer, void *ctx) {
  integrator->on_checkpoint = (struct hk_watch){observer, ctx, 1};
  return HOOKE_OK;
}

/* For states that are stored between checks. */
static int32_t keep_good(hooke_integrator *integrator) {
  return integrator->recent.capacity == 0 ? hk_divergence_keep(integrator) : HOOKE_OK;
}

int32_t hk_integrator_on_sample(hooke_integrator *it, double every, hooke_observer *observer, void *ctx) {
  struct hk_schedule sampling = it->schedule;
  int32_t status = hk_schedule_every(it->method->adaptive, every, &sampling);
  if (status == HOOKE_OK) status = keep_good(it);
  if (status != HOOKE_OK) return status;
  it->sampling = sampling;
  it->on_sample = (struct hk_watch){observer, ctx, 1};
  return HOOKE_OK;
}

int32_t hk_integrator_on_motion(hooke_integrator *integrator, hooke_observer *observer, void *ctx) {
  const int32_t status = keep_good(integrator);
  if (status == HOOKE_OK) integrator->on_motion = (struct hk_watch){observer, ctx, 1};
  return status;
}

int32_t hooke_integrator_on_step(hooke_integrator *integrator, int64_t stride, hooke_observer *observer,
                                 void *ctx) {
  if (stride < 1) {
    return hk_fail(HOOKE_BAD_VALUE, "stride", "%lld is not allowed; 1 step or more is", (long long)stride);
  }
  const int32_t status = keep_good(integrator);
  if (status != HOOKE_OK) return status;
  integrator->on_step = (struct hk_watch){observer, ctx, stride};
  return HOOKE_OK;
}

int32_t hooke_integrator_on_progress(hooke_integrator *integrator, double seconds, hooke_progress *progress,
                                     void *ctx) {
  if (!(seconds >= 0.0))
    return hk_fail(HOOKE_BAD_VALUE, "seconds", "%g is not allowed; 0 or more are", seconds);
  const double now = hk_clock_seconds();
  integrator->teller = (struct hk_teller){progress, ctx, seconds, now, now, 1, 1};
  return HOOKE_OK;
}

void hk_integrator_set_checker(hooke_integrator *it, struct hk_checker checker) {
  if (it->checker.release) it->checker.release(it->checker.own);
  it->checker = checker;
}

static int64_t recent_count(const hooke_integrator *it) {
  const struct hk_recent *recent = &it->recent;
  return recent->count + (it->good.unkept && recent->count < recent->capacity);
}

int32_t hooke_integrator_recent(const hooke_integrator *it, int64_t place, hooke_state *state) {
  const int64_t count = recent_count(it);
  const hooke_state *kept =
      place < count ? hk_recent_state(&it->recent, place - it->good.unkept, NULL) : NULL;
  const int32_t status = hk_integrator_check_state(it, state);
  if (status != HOOKE_OK) return status;
  if (kept) return hooke_state_copy(kept, state);
  if (place == 0 && count > 0) {
    hk_store_good(it, state);
    return HOOKE_OK;
  }
  return hk_fail(HOOKE_BAD_VALUE, "place", "there is no recent state %lld; kept are %lld", (long long)place,
                 (long long)count);
}

static int64_t memory_of(const hooke_integrator *it) {
  const int64_t own = it->system ? 0 : 2 * it->size; /* x and its rate, for the callback */
  const int64_t copies = (it->restart.state != NULL) + (it->shown != NULL) + (it->passages.before != NULL) +
                         (it->passages.now != NULL);
  const int64_t copied = copies * (1 + (it->system ? 2 : 1) * it->size);
  return (int64_t)sizeof *it + it->own_memory + it->checker.memory + (it->motion ? it->motion->memory : 0) +
         (own + copied) * (int64_t)sizeof(double) + hk_recent_memory(&it->recent);
}

static int64_t factor_of(const hooke_integrator *it) {
  int64_t bytes = 0;
  if (!it->may_factor) return 0;
  return hk_factor_foretell(it->system, HOOKE_MOST_NUMBERS, &bytes) == HOOKE_OK ? bytes : -1;
}

int64_t hooke_integrator_count(const hooke_integrator *it, const char *what) {
  if (strcmp(what, "factor_bytes") == 0) return factor_of(it);
  const struct hk_counts *c = &it->count;
  const struct {
    const char *name;
    int64_t value;
  } counts[] = {
      {"steps", c->steps},
      {"force_evaluations", c->force_evaluations},
      {"derivative_products", c->derivative_products},
      {"nonlinear_iterations", c->nonlinear_iterations},
      {"nonlinear_failures", c->nonlinear_failures},
      {"linear_iterations", c->linear_iterations},
      {"error_test_failures", c->error_test_failures},
      {"explicit_damping", it->explicit_damping},
      {"zero_passages", c->zero_passages},
      {"coincident_springs", it->motion ? it->motion->coincident : 0},
      {"memory_bytes", memory_of(it)},
      {"frames", it->schedule.frames},
      {"recent", recent_count(it)},
      {"stop_value", it->stop_value},
  };
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
    if (strcmp(counts[k].name, what) == 0) return counts[k].value;
  }
  return -1;
}

double hooke_integrator_number(const hooke_integrator *it, const char *what) {
  const struct hk_named_number numbers[] = {{"wall_seconds", it->wall_seconds},
                                            {"diverged_at", it->diverged_at}};
  return HOOKE_NAMED_NUMBER(numbers, what);
}

const char *hooke_integrator_text(const hooke_integrator *it, const char *what) {
  return strcmp(what, "zero_passages") == 0 ? it->passages.told : NULL;
}
