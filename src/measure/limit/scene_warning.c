/* Warns of what a scene may be, but is seldom meant to be. */
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "model/force/curve.h"
#include "model/part_record.h"
#include "model/system.h"
#include "model/vector3.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double ROUNDING = 1e-12;

struct looking {
  const hooke_system *system;
  hooke_warning *warning;
  void *ctx;
  int32_t stop;
  int64_t *ends, *pair; /* of all springs, two each; of those of a group, one each */
  double *stiffness;    /* of all springs */
  uint8_t *held;        /* parts with stiffness */
  double *motion;       /* velocity and acceleration of all particles, 6n */
};

__attribute__((format(printf, 5, 6))) static void tell(struct looking *l, const char *kind, int64_t spring,
                                                       int64_t particle, const char *format, ...) {
  char sentence[256];
  va_list args;
  va_start(args, format);
  hk_print_list(sentence, sizeof sentence, format, args);
  va_end(args);
  if (l->stop == 0) l->stop = l->warning(kind, sentence, 0.0, NAN, spring, particle, l->ctx);
}

static int compare(const void *one, const void *other) {
  const int64_t a = *(const int64_t *)one, b = *(const int64_t *)other;
  return (a > b) - (a < b);
}

/* A spring and a damper between two particles are common, three springs of one group are not. */
static void look_at_pairs(struct looking *l, int64_t first, int64_t count) {
  for (int64_t k = 0; k < count; k++) {
    const int64_t i = l->ends[2 * (first + k)], j = l->ends[2 * (first + k) + 1];
    l->pair[k] = (i < j ? i : j) << 32 | (i < j ? j : i);
  }
  qsort(l->pair, (size_t)count, sizeof *l->pair, compare);
  for (int64_t k = 2; k < count; k++) {
    if (l->pair[k] != l->pair[k - 2]) continue;
    const long long low = (long long)(l->pair[k] >> 32), high = (long long)(l->pair[k] & 0xffffffff);
    tell(l, "same-pair", -1, low, "the same pair of particles, %lld and %lld, has three springs in one group",
         low, high);
    return;
  }
}

/* A curve of springs that only pull, cut off where it is above 0. */
static void look_at_curve(struct looking *l, const struct hk_group *group, int64_t first, const char *shown) {
  const double tension = group->curve ? hk_curve_law(group->curve, 0.0, 1.0).tension : 0.0;
  if (group->pull_only && group->count > 0 && tension > 0.0)
    tell(
        l, "jump", first, -1,
        "the tension of group \"%s\" jumps to 0 N where a spring is no longer than its rest length; the curve "
        "has %.3g N there",
        shown, tension);
}

static void look_at_groups(struct looking *l) {
  int64_t first = 0;
  char shown[HOOKE_OPTION_SHOWN];
  for (int64_t k = 0; k < l->system->group_count; k++) {
    const struct hk_group *group = &l->system->group[k];
    const int springs = group->force->kind & HOOKE_LOOPED;
    int stiff = springs ? group->inside > 0 || group->curve : group->count > 0 && !group->force->is_drag;
    const int64_t count = springs ? group->count : 0;
    for (int64_t i = first; i < first + count; i++)
      stiff |= l->stiffness[i] > 0.0;
    hk_option_show(group->name, (int64_t)strlen(group->name), shown);
    look_at_curve(l, group, first, shown);
    if (group->from_part) {
      l->held[group->part] |= (uint8_t)stiff;
    } else {
      if (!stiff && group->count + group->dropped > 0)
        tell(l, "no-stiffness", -1, -1, "group \"%s\" has no stiffness: it holds nothing together", shown);
      look_at_pairs(l, first, count);
    }
    first += count;
  }
}

static void look_at_parts(struct looking *l) {
  char shown[HOOKE_OPTION_SHOWN];
  for (int64_t k = 0; k < l->system->part_count; k++) {
    const struct hk_part_record *part = &l->system->part[k];
    if (l->held[k] || hooke_options_number(part->options, "rigid") == 1.0) continue;
    hk_option_show(part->name, (int64_t)strlen(part->name), shown);
    tell(l, "no-stiffness", -1, part->first,
         "part \"%s\" has no stiffness: nothing holds these particles together", shown);
  }
}

/* Fluids beside which added mass counts [kg/m^3]: denser than any gas. */
static const double DENSE = 100.0;

/* A rope that is no heavier than what it displaces accelerates as much fluid as itself, which is left out. */
static void look_at_fluids(struct looking *l) {
  char shown[HOOKE_OPTION_SHOWN];
  for (int64_t k = 0; k < l->system->part_count; k++) {
    const struct hk_part_record *part = &l->system->part[k];
    const int in_fluid = hk_options_has_family(part->options, "fluid_drag") &&
                         hooke_options_number(part->options, "fluid_drag.density") > DENSE;
    if (!in_fluid || !hk_options_find(hk_options_table(part->options), "fluid_drag.diameter")) continue;
    const double *q = l->system->position + 3 * part->first, *m = l->system->mass + part->first;
    const double radius = 0.5 * hooke_options_number(part->options, "fluid_drag.diameter");
    double length = 0.0, mass = 0.0;
    for (int64_t p = 0; p < part->count; p++) {
      length += p > 0 ? hk_distance3(q + 3 * p, q + 3 * p - 3) : 0.0;
      mass += m[p];
    }
    const double displaced = 3.14159265358979323846 * radius * radius * length *
                             hooke_options_number(part->options, "fluid_drag.density");
    hk_option_show(part->name, (int64_t)strlen(part->name), shown);
    if (mass <= displaced)
      tell(l, "added-mass", -1, part->first,
           "part \"%s\" has %.3g kg and displaces %.3g kg of fluid, whose added mass is not in the scene",
           shown, mass, displaced);
  }
}

/* Of an acceleration that is rounding of the positions alone. */
static double largest_rounding(const hooke_system *system, const double *v) {
  struct hk_elements at;
  double stiffest = 0.0, lightest = 0.0;
  hk_begin_elements(system, system->moment, system->position, v, &at);
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    double far = 0.0;
    for (int j = 0; j < e->count; j++)
      for (int a = 0; a < 3; a++)
        far += fabs(e->weight[j] * system->position[3 * (int64_t)e->particle[j] + a]);
    stiffest = fmax(stiffest, e->k_along * far);
  }
  for (int64_t p = 0; p < system->particle_count; p++)
    lightest = fmax(lightest, system->inverse_mass[p]);
  return ROUNDING * stiffest * lightest;
}

static int32_t look_at_motion(struct looking *l) {
  const hooke_system *system = l->system;
  const int64_t n = 3 * system->particle_count;
  double *v = l->motion, *a = l->motion + n, largest = 0.0;
  if (n == 0 || hk_system_takes_work(system) || system->force) return HOOKE_OK;
  for (int64_t k = 0; system->velocity && k < n; k++)
    if (system->velocity[k] != 0.0) return HOOKE_OK;
  const int32_t status = hooke_system_acceleration(system, 0.0, system->position, v, a);
  for (int64_t k = 0; k < n; k++)
    largest = fmax(largest, fabs(a[k]));
  if (status == HOOKE_OK && largest <= largest_rounding(system, v))
    tell(l, "nothing-moves", -1, -1,
         "nothing moves: no particle has a velocity, and the forces are in balance");
  return status;
}

int32_t hooke_system_warnings(const hooke_system *system, hooke_warning *warning, void *ctx) {
  int32_t status = hk_system_require_committed(system);
  if (status != HOOKE_OK || warning == NULL) return status;
  const int64_t springs = hooke_system_count(system, "springs");
  struct looking l = {.system = system, .warning = warning, .ctx = ctx};
  l.ends = hk_new(3 * springs, sizeof *l.ends);
  l.stiffness = hk_new(springs, sizeof *l.stiffness);
  l.held = hk_new(system->part_count, sizeof *l.held);
  l.motion = hk_new(6 * system->particle_count, sizeof *l.motion);
  status = l.ends && l.stiffness && l.held && l.motion ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hooke_system_members(system, "springs", l.ends, l.stiffness, NULL, NULL);
  if (status == HOOKE_OK) {
    l.pair = l.ends + 2 * springs;
    look_at_groups(&l);
    look_at_parts(&l);
    look_at_fluids(&l);
    status = look_at_motion(&l);
  }
  hk_free(l.ends);
  hk_free(l.stiffness);
  hk_free(l.held);
  hk_free(l.motion);
  if (status == HOOKE_OK && l.stop)
    return hk_fail(HOOKE_STOPPED, NULL, "a warning callback returned %d", (int)l.stop);
  return status;
}
