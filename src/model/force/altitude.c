/* Groups of tetrahedra: options, checks and queries. */
#include "model/force/altitude.h"

#include "core/status.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("stiffness", HOOKE_OPTION_EACH("N"), NULL,
                 "stiffness of the strain law, one number or one for each tetrahedron", .required = 1),
    HOOKE_OPTION("damping", HOOKE_OPTION_EACH("N s"), "0",
                 "damping along the altitude, one number or one for each"),
    HOOKE_OPTION("rest_scale", HOOKE_OPTION_POSITIVE(NULL), "1",
                 "factor on the rest lengths, which are the altitudes as added"),
    HOOKE_OPTION("compression", .type = HOOKE_OPTION_FLAG, "true", "false: the springs only pull"),
};

const struct hk_option_table hk_altitude_options = {"altitude springs", HOOKE_OPTION_ROWS(rows)};

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

/* As columns have them, with the sign of the side. */
static void put_rest(const struct hk_tetrahedron *t, double *rest) {
  for (int a = 0; a < HOOKE_ALTITUDES; a++)
    rest[a] = t->side * t->rest[a];
}

int32_t hk_system_add_tetrahedra(hooke_system *system, const char *name, int64_t count, int64_t first,
                                 const struct hk_tetrahedron kind[2]) {
  struct hk_group group = {.force = &hk_force_altitude,
                           .count = count,
                           .from_part = 1,
                           .pull_only = kind->pull_only,
                           .part = (int32_t)system->part_count - 1};
  int32_t status = hk_system_check_more(system, &hk_force_altitude, count);
  if (status == HOOKE_OK) status = hk_group_allocate(&group, name);
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++) {
    for (int e = 0; e < 4; e++)
      group.particle[e][k] = (int32_t)(first + k + e);
    group.number[HOOKE_KAPPA][k] = kind[k % 2].stiffness;
    group.number[HOOKE_GAMMA][k] = kind[k % 2].damping;
    put_rest(&kind[k % 2], group.number[HOOKE_REST_LENGTH] + HOOKE_ALTITUDES * k);
  }
  return hk_group_end(system, status, &group);
}

static int32_t find_rest(const hooke_system *system, double scale, struct hk_group *group, int64_t k) {
  struct hk_tetrahedron t;
  double x[4][3];
  for (int e = 0; e < 4; e++) {
    t.particle[e] = group->particle[e][k];
    memcpy(x[e], system->position + 3 * (int64_t)t.particle[e], sizeof x[e]);
  }
  const int32_t status = hk_tetrahedron_rest((const double(*)[3])x, scale, &t);
  if (status != HOOKE_OK) return hk_fail_within(status, "tetrahedra[%lld]", (long long)k);
  put_rest(&t, group->number[HOOKE_REST_LENGTH] + HOOKE_ALTITUDES * k);
  return HOOKE_OK;
}

int32_t hooke_system_add_altitude(hooke_system *system, const char *name, int64_t count,
                                  const int64_t *tetrahedra, const hooke_options *options) {
  const struct hk_addition added = {&hk_force_altitude, name, count, tetrahedra, options, 0};
  struct hk_group group;
  int32_t status = hk_group_begin(system, &added, &group);
  if (status == HOOKE_OK) hk_group_fill(&group, options);
  if (status == HOOKE_OK) group.pull_only = hooke_options_number(options, "compression") == 0.0;
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++)
    status = find_rest(system, hooke_options_number(options, "rest_scale"), &group, k);
  return hk_group_end(system, status, &group);
}
