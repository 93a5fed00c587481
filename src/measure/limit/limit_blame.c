#include "measure/limit/limit_blame.h"

#include "core/memory.h"
#include "measure/spectrum/linear_twin.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* Puts an element where it belongs in a list of HOOKE_BLAME_MOST at most, the largest share first and equal
 * ones in the order in which they come. `share_at` is where an element has its share. */
static void keep(void *list, int64_t *count, size_t size, size_t share_at, const void *element) {
  unsigned char *place = list;
  double share, other;
  memcpy(&share, (const unsigned char *)element + share_at, sizeof share);
  if (!(share > 0.0)) return;
  int64_t k = *count;
  for (; k > 0; k--) {
    memcpy(&other, place + (size_t)(k - 1) * size + share_at, sizeof other);
    if (other >= share) break;
    if (k < HOOKE_BLAME_MOST) memcpy(place + (size_t)k * size, place + (size_t)(k - 1) * size, size);
  }
  if (k == HOOKE_BLAME_MOST) return;
  memcpy(place + (size_t)k * size, element, size);
  if (*count < HOOKE_BLAME_MOST) ++*count;
}

/* x.Kx and x.Cx of one spring; particles that are held do not move. */
static void weigh(const hooke_system *system, const struct hk_spring *spring, const double *q,
                  const double *mode, double *stiffness, double *damping) {
  const struct hk_twin_spring view = hk_twin_view(spring, q);
  double along = 0.0, square = 0.0;
  for (int a = 0; a < 3; a++) {
    const double d = (system->held[view.head] ? 0.0 : mode[3 * view.head + a]) -
                     (system->held[view.tail] ? 0.0 : mode[3 * view.tail + a]);
    along += view.u[a] * d;
    square += d * d;
  }
  *stiffness = view.across * square + (view.kappa - view.across) * along * along;
  *damping = view.gamma * along * along;
}

static double square_of(const double *x) {
  return (x[0] * x[0] + x[1] * x[1]) + x[2] * x[2];
}

/* The whole that springs have shares of, and its part of K; and that of particles. */
struct whole {
  double all, stiffness, kinetic;
};

static void find_springs(const hooke_system *system, const double *q, const double *mode, double h2, double h,
                         struct whole *whole, struct hk_blame *blame) {
  int64_t group = 0, in_group = 0;
  for (int64_t r = 0; r < system->springs.run_count; r++) {
    const struct hk_run *run = &system->springs.run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring(run, k);
      while (in_group == system->group[group].count)
        group++, in_group = 0;
      in_group++;
      double stiffness, damping;
      weigh(system, &spring, q, mode, &stiffness, &damping);
      const struct hk_blamed_spring blamed = {
          run->first + k, spring.head, spring.tail, group, h2 * stiffness + 2.0 * h * damping,
          h2 * stiffness};
      whole->all += blamed.share;
      blame->force_share[HOOKE_BLAME_DAMPING] += 2.0 * h * damping;
      whole->stiffness += blamed.stiffness_share;
      blame->group_share[group] += blamed.share;
      keep(blame->spring, &blame->spring_count, sizeof blamed, offsetof(struct hk_blamed_spring, share),
           &blamed);
    }
  }
}

/* Of particles that are held nothing moves. */
static void find_bending(const hooke_system *system, const double *mode, double h2, struct whole *whole,
                         struct hk_blame *blame) {
  struct hk_triples at = {&system->bending, 0, 0};
  struct hk_triple triple;
  for (int64_t g = 0; g < system->bending_group_count; g++) {
    for (int64_t k = 0; k < system->bending_group[g].count && hk_next_triple(&at, &triple); k++) {
      double d[3] = {0.0, 0.0, 0.0};
      for (int e = 0; e < 3; e++) {
        const int64_t p = triple.particle[e];
        for (int a = 0; a < 3 && !system->held[p]; a++)
          d[a] += hk_triple_factor(e) * mode[3 * p + a];
      }
      blame->group_share[system->group_count + g] += h2 * triple.coefficient * square_of(d);
    }
    whole->all += blame->group_share[system->group_count + g];
    blame->force_share[HOOKE_BLAME_BENDING] += blame->group_share[system->group_count + g];
    whole->stiffness += blame->group_share[system->group_count + g];
  }
}

static void find_altitude(const hooke_system *system, const double *q, const double *mode, double h2,
                          double h, struct whole *whole, struct hk_blame *blame) {
  const struct hk_tetrahedron *t = system->altitudes.tetrahedron;
  for (int64_t g = 0; g < system->altitude_group_count; g++) {
    double *share = &blame->group_share[system->group_count + system->bending_group_count + g];
    for (int64_t k = 0; k < system->altitude_group[g].count; k++, t++) {
      struct hk_altitude_view view;
      double along = 0.0;
      if (!hk_altitude_see(t, q, &view)) continue;
      for (int j = 0; j < 4; j++) {
        const int64_t p = t->particle[j];
        for (int a = 0; a < 3 && !system->held[p]; a++)
          along += view.tangent.weight[j] * view.tangent.u[a] * mode[3 * p + a];
      }
      *share += (h2 * view.kappa + 2.0 * h * view.gamma) * along * along;
      whole->stiffness += h2 * view.kappa * along * along;
      blame->force_share[HOOKE_BLAME_ALTITUDE] += h2 * view.kappa * along * along;
      blame->force_share[HOOKE_BLAME_DAMPING] += 2.0 * h * view.gamma * along * along;
    }
    whole->all += *share;
  }
}

static void find_particles(const hooke_system *system, const double *mode, double h, struct whole *whole,
                           struct hk_blame *blame) {
  for (int64_t p = 0; p < system->particle_count; p++) {
    if (system->held[p]) continue;
    const double square = square_of(mode + 3 * p);
    const struct hk_blamed_particle blamed = {p, system->mass[p] * square, system->mass[p]};
    whole->all += 2.0 * h * system->drag * square;
    blame->force_share[HOOKE_BLAME_DRAG] += 2.0 * h * system->drag * square;
    whole->kinetic += blamed.share;
    keep(blame->particle, &blame->particle_count, sizeof blamed, offsetof(struct hk_blamed_particle, share),
         &blamed);
  }
}

int32_t hk_blame_find(const hooke_system *system, const double *q, const double *mode, double h2, double h,
                      struct hk_blame *blame) {
  struct whole whole = {0.0, 0.0, 0.0};
  *blame = (struct hk_blame){.group_count = system->group_count + system->bending_group_count +
                                            system->altitude_group_count};
  blame->group_share = hk_new(blame->group_count, sizeof(double));
  if (blame->group_share == NULL) return HOOKE_NO_MEMORY;
  if (mode == NULL) return HOOKE_OK;
  find_springs(system, q, mode, h2, h, &whole, blame);
  find_bending(system, mode, h2, &whole, blame);
  find_altitude(system, q, mode, h2, h, &whole, blame);
  find_particles(system, mode, h, &whole, blame);
  for (int64_t k = 0; k < blame->spring_count; k++) {
    blame->spring[k].share /= whole.all;
    blame->spring[k].stiffness_share /= whole.all;
  }
  for (int64_t k = 0; k < blame->particle_count; k++)
    blame->particle[k].share /= whole.kinetic;
  for (int64_t k = 0; k < blame->group_count && whole.all > 0.0; k++)
    blame->group_share[k] /= whole.all;
  for (int k = 0; k < HOOKE_BLAME_FORCES && whole.all > 0.0; k++)
    blame->force_share[k] /= whole.all;
  blame->stiffness_share = whole.all > 0.0 ? whole.stiffness / whole.all : 0.0;
  return HOOKE_OK;
}

const char *hk_blame_group_name(const hooke_system *system, int64_t group) {
  const int64_t bending = group - system->group_count, altitude = bending - system->bending_group_count;
  const char *name = bending < 0    ? hooke_system_group_name(system, group)
                     : altitude < 0 ? hooke_system_bending_group_name(system, bending)
                                    : hooke_system_altitude_group_name(system, altitude);
  return name ? name : "";
}

int32_t hk_blame_force(const struct hk_blame *blame) {
  for (int32_t k = 0; k < HOOKE_BLAME_FORCES; k++) {
    if (blame->force_share[k] >= 0.5) return k;
  }
  return -1;
}

const char *hk_blame_force_name(int32_t force) {
  static const char *const names[HOOKE_BLAME_FORCES] = {"drag", "damping", "bending", "altitude"};
  return force < 0 ? "" : names[force];
}

void hk_blame_release(struct hk_blame *blame) {
  hk_free(blame->group_share);
  memset(blame, 0, sizeof *blame);
}
