/* Overdamped systems, gamma x' = f: what they may have, and their numbers. */
#include "model/system.h"

#include "core/memory.h"
#include "core/status.h"

#include <math.h>
#include <string.h>

int32_t hooke_system_set_dynamics(hooke_system *system, const char *dynamics) {
  const int32_t status = hk_system_require_open(system);
  if (status != HOOKE_OK) return status;
  const int32_t overdamped = strcmp(dynamics, "overdamped") == 0;
  if (!overdamped && strcmp(dynamics, "inertial") != 0)
    return hk_fail(HOOKE_BAD_VALUE, "dynamics", "\"%s\" is not allowed; inertial and overdamped are",
                   dynamics);
  system->overdamped = overdamped;
  return HOOKE_OK;
}

const char *hooke_system_dynamics(const hooke_system *system) {
  return system->overdamped ? "overdamped" : "inertial";
}

/* ---- checks ---- */

static int32_t check_masses(const hooke_system *system) {
  if (system->overdamped && !system->has_gravity) return HOOKE_OK;
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->mass[p] > 0.0) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL, "is missing; %s needs the mass of every particle, > 0 [kg]",
            system->overdamped ? "gravity" : "a motion with inertia");
    return hk_fail_within(HOOKE_BAD_VALUE, "particles.mass[%lld]", (long long)p);
  }
  return HOOKE_OK;
}

static int32_t check_velocities(const hooke_system *system) {
  for (int64_t k = 0; k < 3 * system->particle_count; k++) {
    if (system->velocity[k] == 0.0) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL,
            "%g is not allowed; an overdamped scene has no velocities of its own: they are force over drag",
            system->velocity[k]);
    return hk_fail_within(HOOKE_BAD_VALUE, "particles.velocity[%lld][%d]", (long long)(k / 3), (int)(k % 3));
  }
  return HOOKE_OK;
}

static int32_t check_drag(const hooke_system *system) {
  const struct hk_each *drag = &system->medium->drag;
  if (system->medium->quadratic_drag.most > 0.0)
    return hk_fail(HOOKE_BAD_VALUE, "quadratic_drag",
                   "is not allowed; in an overdamped scene drag is linear");
  for (int64_t p = 0; p < (drag->value ? drag->count : 1); p++) {
    const double gamma = hk_each_at(drag, p);
    if (gamma > 0.0 && 1.0 / gamma < INFINITY) continue;
    hk_fail(HOOKE_BAD_VALUE, NULL,
            "%g is not allowed; an overdamped scene needs a drag > 0 [N s/m] on its particles", gamma);
    return drag->value ? hk_fail_within(HOOKE_BAD_VALUE, "drag[%lld]", (long long)p)
                       : hk_fail_within(HOOKE_BAD_VALUE, "drag");
  }
  return HOOKE_OK;
}

int32_t hk_overdamped_check(const hooke_system *system) {
  int32_t status = check_masses(system);
  if (status != HOOKE_OK || !system->overdamped) return status;
  if (system->bodies->count > 0)
    return hk_fail(HOOKE_BAD_VALUE, "bodies", "rigid bodies have inertia; an overdamped scene takes none");
  status = check_velocities(system);
  return status == HOOKE_OK ? check_drag(system) : status;
}

int32_t hk_overdamped_check_forces(const hooke_system *system) {
  if (!system->overdamped || !hk_system_is_damped(system, ~HOOKE_UNIFORM)) return HOOKE_OK;
  struct hk_elements at;
  hk_begin_elements(system, 0.0, system->position, NULL, &at);
  at.kinds = ~HOOKE_UNIFORM;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    if (e->c_along == 0.0 && e->c_across == 0.0) continue;
    return hk_fail(HOOKE_BAD_VALUE, "damping",
                   "the %s of particle %d is damped; in an overdamped "
                   "scene drag is the only friction, and damping is 0",
                   at.force->title ? at.force->title : "spring", (int)e->particle[0]);
  }
  return hk_fail(HOOKE_BAD_VALUE, "damping",
                 "is not allowed; in an overdamped scene drag is the only friction");
}

/* ---- numbers ---- */

int32_t hk_overdamped_begin(hooke_system *system) {
  system->inertia = system->mass;
  system->brake = system->overdamped || system->medium->blows ? 0.0 : system->drag;
  system->falls = !system->overdamped && system->has_gravity;
  for (int a = 0; a < 3; a++)
    system->fall[a] = system->falls ? system->gravity[a] : 0.0;
  if (!system->overdamped) return HOOKE_OK;
  double *gamma = hk_new(system->particle_count, sizeof(double));
  system->inertia = gamma;
  for (int64_t p = 0; p < system->particle_count && gamma; p++)
    gamma[p] = hk_each_at(&system->medium->drag, p);
  return gamma ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void hk_overdamped_undo(hooke_system *system) {
  if (system->inertia != system->mass) hk_free(system->inertia);
  system->inertia = NULL;
}
