#include "measure/rest/rest.h"

#include "core/memory.h"
#include "measure/modes/lowest.h"
#include "measure/modes/stiffness.h"
#include "model/state.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

static const struct hk_option_row rest_rows[] = {
    HOOKE_OPTION("watch", .type = HOOKE_OPTION_TEXT, "",
                 "quantities to tell at rest, separated by commas, such as 57.y, line.stretch:3.tension or "
                 "potential"),
    HOOKE_OPTION("count", HOOKE_OPTION_WHOLE(1, 1e6), "6",
                 "modes at rest, the lowest ones, beside those without stiffness"),
    HOOKE_OPTION("budget", HOOKE_OPTION_POSITIVE("s"), NULL,
                 "time that the search may take; no limit if not given"),
};

static const struct hk_option_table rest_table = {"rest", HOOKE_OPTION_ROWS(rest_rows)};

/* ---- creating ---- */

static void forget(struct hk_resting *r) {
  hk_free(r->position);
  r->position = NULL;
  r->rest = (struct hk_rest){.residual = NAN, .largest_force = NAN};
  r->minimum = -1;
  hk_modes_release(&r->modes);
  r->modes = (struct hk_modes){.system = r->m->system, .zero_modes = -1};
}

static int32_t create(hooke_measurement *m) {
  struct hk_resting *r = m->object = hk_new(1, sizeof *r);
  if (r == NULL) return HOOKE_NO_MEMORY;
  r->m = m;
  r->watched.system = m->system;
  const struct hk_obstacles *obstacles = &m->system->rest->obstacles;
  for (int64_t k = 0; k < obstacles->count; k++)
    r->had_friction |= obstacles->obstacle[k].friction > 0.0;
  forget(r);
  const char *text = hooke_options_text(m->options, "watch");
  const int32_t status = text[0] ? hk_watched_read(&r->watched, "watch", text) : HOOKE_OK;
  if (status != HOOKE_OK) return status;
  r->value = hk_new(r->watched.count, sizeof *r->value);
  r->number = hk_new(r->watched.count, sizeof *r->number);
  return r->value && r->number ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static void destroy(void *object) {
  struct hk_resting *r = object;
  if (r == NULL) return;
  hk_watched_release(&r->watched);
  hk_free(r->value);
  hk_free(r->number);
  hk_free(r->position);
  hk_modes_release(&r->modes);
  hk_free(r);
}

/* ---- running ---- */

static void see_watched(struct hk_resting *r, double t, const double *zeros) {
  const int32_t rests = r->rest.lack == HOOKE_RESTS;
  if (rests) hk_watched_values(&r->watched, t, r->position, zeros, r->number);
  for (int64_t k = 0; k < r->watched.count; k++) {
    const struct hk_watched *watched = &r->watched.item[k];
    const double value = rests && !watched->is_period ? r->number[k] : NAN;
    r->value[k] = (struct hk_rest_watched){watched->text, hk_watched_unit(watched), value};
  }
}

int32_t hk_rest_is_large(const struct hk_resting *r) {
  return r->m->system->particle_count - r->m->system->constrained_count > HOOKE_REST_PARTICLES;
}

/* Without the libraries for it, or where they give up, nothing is known. */
static int32_t find_modes(struct hk_resting *r, double t, const double *zeros, struct hk_budget *budget) {
  const int64_t count = (int64_t)hooke_options_number(r->m->options, "count");
  int32_t status = hk_modes_find(r->m->system, t, r->position, zeros, count, budget, &r->modes);
  if (status == HOOKE_NOT_BUILT || status == HOOKE_SOLVER_FAILED) {
    hk_modes_release(&r->modes);
    r->modes = (struct hk_modes){.system = r->m->system, .zero_modes = -1};
    return HOOKE_OK;
  }
  if (status == HOOKE_OK && r->rest.has_energy && (r->modes.unstable > 0 || r->modes.zero_modes >= 0))
    r->minimum = r->modes.unstable == 0;
  return status;
}

/* Of a large scene. */
static int32_t find_sign(struct hk_resting *r, double t, struct hk_budget *budget) {
  const hooke_system at = hk_system_at(r->m->system, t);
  struct hk_stiffness stiffness;
  int32_t sign = 0, status = hk_stiffness_create(&at, r->position, &stiffness);
  if (status != HOOKE_OK) return status;
  status = hk_lowest_sign(&stiffness.matrix, stiffness.bound, budget, &sign);
  if (r->rest.has_energy && sign != 0) r->minimum = sign > 0;
  hk_stiffness_release(&stiffness);
  return status;
}

static int32_t run(hooke_measurement *m, hooke_state *state) {
  struct hk_resting *r = m->object;
  const int64_t numbers = 3 * m->system->particle_count;
  const double seconds = hooke_options_number(m->options, "budget"), t = hooke_state_time(state);
  struct hk_budget budget = hk_budget_of(isnan(seconds) ? INFINITY : seconds, m->progress, m->progress_ctx);
  forget(r);
  r->time = t;
  double *zeros = hk_new(numbers, sizeof(double));
  r->position = hk_new(numbers, sizeof(double));
  int32_t status = zeros && r->position ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    memcpy(r->position, hooke_state_position(state), (size_t)numbers * sizeof(double));
    status = hk_rest_find(m->system, t, r->position, &budget, &r->rest);
  }
  if (status == HOOKE_OK || status == HOOKE_STOPPED) see_watched(r, t, zeros);
  if (status == HOOKE_OK && r->rest.lack == HOOKE_RESTS)
    status = hk_rest_is_large(r) ? find_sign(r, t, &budget) : find_modes(r, t, zeros, &budget);
  hk_free(zeros);
  return status;
}

const struct hk_measurement_kind hk_rest_kind = {.name = "rest",
                                                 .options = &rest_table,
                                                 .takes_state = 1,
                                                 .tables = hk_rest_tables,
                                                 .more = &hk_modes_tables[1],
                                                 .claim = hk_rest_claim,
                                                 .create = create,
                                                 .run = run,
                                                 .destroy = destroy};
