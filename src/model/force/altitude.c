/* Groups of tetrahedra: options, checks and queries. */
#include "model/force/altitude.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const struct hk_option_row rows[] = {
    {.name = "stiffness",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "N",
     .low = 0.0,
     .high = 1e300,
     .min_count = 1,
     .required = 1,
     .doc = "stiffness of the strain law, one number or one for each tetrahedron"},
    {.name = "damping",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "N s",
     .low = 0.0,
     .high = 1e300,
     .min_count = 1,
     .fallback = "0",
     .doc = "damping along the altitude, one number or one for each"},
    {.name = "rest_scale",
     .type = HOOKE_OPTION_NUMBER,
     .low = 0.0,
     .above_low = 1,
     .high = 1e300,
     .fallback = "1",
     .doc = "factor on the rest lengths, which are the altitudes as added"},
    {.name = "compression",
     .type = HOOKE_OPTION_FLAG,
     .fallback = "true",
     .doc = "false: the springs only pull"},
};

const struct hk_option_table hk_altitude_options = {"altitude springs", HOOKE_OPTION_ROWS(rows)};

int32_t hk_altitudes_create(const struct hk_group *group, int64_t group_count,
                            struct hk_altitudes *altitudes) {
  memset(altitudes, 0, sizeof *altitudes);
  for (int64_t g = 0; g < group_count; g++)
    altitudes->count += group[g].count;
  altitudes->tetrahedron = hk_new(altitudes->count, sizeof *altitudes->tetrahedron);
  if (altitudes->tetrahedron == NULL) {
    memset(altitudes, 0, sizeof *altitudes);
    return HOOKE_NO_MEMORY;
  }
  struct hk_tetrahedron *next = altitudes->tetrahedron;
  for (int64_t g = 0; g < group_count; g++) {
    const struct hk_tetrahedron *own = group[g].own;
    for (int64_t k = 0; k < group[g].count; k++) {
      *next = own[k];
      next->stiffness = group[g].number[HOOKE_KAPPA][k];
      next->damping = group[g].number[HOOKE_GAMMA][k];
      altitudes->damped |= next++->damping != 0.0;
    }
  }
  return HOOKE_OK;
}

void hk_altitudes_release(struct hk_altitudes *altitudes) {
  hk_free(altitudes->tetrahedron);
  memset(altitudes, 0, sizeof *altitudes);
}

int64_t hk_altitudes_memory(const struct hk_altitudes *altitudes) {
  return altitudes->count * (int64_t)sizeof *altitudes->tetrahedron;
}

/* ---- adding a group ---- */

/* An altitude below this fraction of the longest edge is rounding of positions. */
static const double FLAT = 1e-9;

int32_t hk_tetrahedron_rest(const double x[4][3], double scale, struct hk_tetrahedron *t) {
  double longest = 0.0, shortest = INFINITY;
  for (int k = 0; k < 4; k++) {
    for (int j = 0; j < k; j++) {
      const double d[3] = {x[k][0] - x[j][0], x[k][1] - x[j][1], x[k][2] - x[j][2]};
      longest = fmax(longest, sqrt((d[0] * d[0] + d[1] * d[1]) + d[2] * d[2]));
    }
  }
  t->side = 1.0;
  for (int32_t k = HOOKE_ALTITUDES - 1; k >= 0; k--) {
    struct hk_altitude altitude;
    struct hk_tetrahedron one = *t;
    one.choice = k;
    const double length = hk_altitude_find(&one, x, &altitude) ? altitude.length : 0.0;
    t->rest[k] = scale * fabs(length);
    shortest = fmin(shortest, fabs(length));
    if (length < 0.0 && k == 0) t->side = -1.0;
  }
  t->choice = HOOKE_ALTITUDE_SHORTEST;
  if (shortest > FLAT * longest && isfinite(longest)) return HOOKE_OK;
  return hk_fail(
      HOOKE_BAD_VALUE, NULL,
      "particles %d, %d, %d and %d lie in a plane at rest: their shortest altitude is %g m, and they "
      "are up to %g m apart; allowed: more than 1e-9 of that",
      (int)t->particle[0], (int)t->particle[1], (int)t->particle[2], (int)t->particle[3], shortest, longest);
}

/* The particles are known to exist. */
static int32_t check_particles(int64_t count, const struct hk_tetrahedron *tetrahedron) {
  for (int64_t k = 0; k < count; k++) {
    const int32_t *p = tetrahedron[k].particle;
    for (int e = 0; e < 4; e++) {
      for (int other = 0; other < e; other++) {
        if (p[e] != p[other]) continue;
        hk_fail(HOOKE_BAD_VALUE, NULL, "particles %d, %d, %d and %d; a tetrahedron has four different ones",
                (int)p[0], (int)p[1], (int)p[2], (int)p[3]);
        return hk_fail_within(HOOKE_BAD_VALUE, "tetrahedra[%lld]", (long long)k);
      }
    }
  }
  return HOOKE_OK;
}

int32_t hk_system_add_tetrahedra(hooke_system *system, const char *name, int32_t from_part, int64_t count,
                                 const struct hk_tetrahedron *tetrahedron) {
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK) status = hk_system_check_more(system, &hk_force_altitude, count);
  if (status == HOOKE_OK) status = check_particles(count, tetrahedron);
  if (status != HOOKE_OK) return status;
  struct hk_group group = {
      .force = &hk_force_altitude, .count = count, .from_part = from_part, .part = system->part_count - 1};
  status = hk_group_allocate(&group, name, 0, 2, sizeof *tetrahedron);
  if (status != HOOKE_OK) {
    hk_group_release(&group);
    return status;
  }
  if (count > 0) memcpy(group.own, tetrahedron, (size_t)count * sizeof *tetrahedron);
  for (int64_t k = 0; k < count; k++) {
    group.number[HOOKE_KAPPA][k] = tetrahedron[k].stiffness;
    group.number[HOOKE_GAMMA][k] = tetrahedron[k].damping;
  }
  return hk_system_add_group(system, &group);
}

static int32_t check_count(const hooke_options *options, const char *name, int64_t count) {
  const int64_t given = hooke_options_number_count(options, name);
  if (given <= 1 || given == count) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, name, "%lld values for %lld tetrahedra; allowed: one, or one for each",
                 (long long)given, (long long)count);
}

static int32_t check_call(const hooke_system *system, int64_t count, const int64_t *corners,
                          const hooke_options *options) {
  int32_t status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;
  if (options == NULL || hk_options_table(options) != &hk_altitude_options) {
    return hk_fail(HOOKE_BAD_VALUE, NULL,
                   "the options are not those of altitude springs; make them with "
                   "hooke_options_create(\"altitude\", ...)");
  }
  if (count < 0) {
    return hk_fail(HOOKE_BAD_VALUE, "tetrahedra", "%lld tetrahedra; 0 or more are allowed", (long long)count);
  }
  status = hk_system_check_more(system, &hk_force_altitude, count);
  if (status != HOOKE_OK) return hk_fail_within(status, "tetrahedra");
  status = hk_options_check_required(options);
  if (status == HOOKE_OK) status = check_count(options, "stiffness", count);
  if (status == HOOKE_OK) status = check_count(options, "damping", count);
  for (int64_t k = 0; k < 4 * count && status == HOOKE_OK; k++) {
    if (corners[k] >= 0 && corners[k] < system->particle_count) continue;
    status = hk_fail_index(NULL, "there is no particle", (double)corners[k], system->particle_count);
    status = hk_fail_within(status, "tetrahedra[%lld][%d]", (long long)(k / 4), (int)(k % 4));
  }
  return status;
}

static double value_of(const hooke_options *options, const char *name, int64_t k) {
  return hooke_options_numbers(options, name)[hooke_options_number_count(options, name) > 1 ? k : 0];
}

static int32_t fill(const hooke_system *system, int64_t count, const int64_t *corners,
                    const hooke_options *options, struct hk_tetrahedron *tetrahedron) {
  for (int64_t k = 0; k < count; k++) {
    struct hk_tetrahedron *t = &tetrahedron[k];
    double x[4][3];
    for (int e = 0; e < 4; e++) {
      t->particle[e] = (int32_t)corners[4 * k + e];
      memcpy(x[e], system->position + 3 * (int64_t)t->particle[e], sizeof x[e]);
    }
    t->pull_only = hooke_options_number(options, "compression") == 0.0;
    t->stiffness = value_of(options, "stiffness", k);
    t->damping = value_of(options, "damping", k);
  }
  int32_t status = check_particles(count, tetrahedron);
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++) {
    double x[4][3];
    for (int e = 0; e < 4; e++)
      memcpy(x[e], system->position + 3 * (int64_t)tetrahedron[k].particle[e], sizeof x[e]);
    status = hk_tetrahedron_rest((const double(*)[3])x, hooke_options_number(options, "rest_scale"),
                                 &tetrahedron[k]);
    if (status != HOOKE_OK) hk_fail_within(status, "tetrahedra[%lld]", (long long)k);
  }
  return status;
}

int32_t hooke_system_add_altitude(hooke_system *system, const char *name, int64_t count,
                                  const int64_t *tetrahedra, const hooke_options *options) {
  int32_t status = check_call(system, count, tetrahedra, options);
  if (status != HOOKE_OK) return status;
  struct hk_tetrahedron *tetrahedron = hk_new(count, sizeof *tetrahedron);
  if (tetrahedron == NULL) return HOOKE_NO_MEMORY;
  status = fill(system, count, tetrahedra, options, tetrahedron);
  if (status == HOOKE_OK) status = hk_system_add_tetrahedra(system, name, 0, count, tetrahedron);
  hk_free(tetrahedron);
  return status;
}

/* ---- queries ---- */

int32_t hooke_system_altitude_lengths(const hooke_system *system, const double *q, double *length) {
  const int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < system->altitudes->count; k++) {
    struct hk_tautness tautness;
    const int32_t found = hk_tautness_find(&system->altitudes->tetrahedron[k], q, NULL, &tautness);
    length[k] = found ? tautness.altitude.length : 0.0;
  }
  return HOOKE_OK;
}
