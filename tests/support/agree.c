#include "agree.h"

#include "check.h"
#include "run.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int64_t lost_springs(const struct canonical *c, const double *q) {
  int64_t lost = 0;
  for (int64_t s = 0; s < c->spring_count; s++) {
    const double *i = q + 3 * c->ends[2 * s], *j = q + 3 * c->ends[2 * s + 1];
    lost += c->rest_length[s] != 0.0 && i[0] == j[0] && i[1] == j[1] && i[2] == j[2];
  }
  return lost;
}

static void check_steps(const hooke_system *system, const struct canonical *c, const char *method,
                        const double *q0, const double *v0) {
  const int64_t size = 3 * c->particle_count;
  const double h = 0.0009765;
  owned_doubles *q = new_doubles(size), *v = new_doubles(size);
  memcpy(q, q0, (size_t)size * sizeof *q);
  memcpy(v, v0, (size_t)size * sizeof *v);
  owned_run(integrator, state, system, .method = method, .step = h);
  int64_t lost = 0;
  for (int k = 0; k < 3; k++) {
    lost = lost_springs(c, q);
    assert_int_equal(canonical_step(c, method, k * h, (k + 1) * h, h, q, v), CANONICAL_STEPPED);
  }
  check_ok(hooke_integrator_step(integrator, state, 3));
  check_same_bits(size, hooke_state_position(state), q);
  check_same_bits(size, hooke_state_velocity(state), v);
  if (strcmp(method, "rk4") != 0) {
    assert_int_equal(hooke_integrator_count(integrator, "coincident_springs"), lost);
    assert_int_equal(hooke_integrator_count(integrator, "force_evaluations"), 3);
  }
}

/* Energy and, where no spring only pulls, heat, spring by spring. */
static void check_sums(const hooke_system *system, const struct canonical *c, const double *q,
                       const double *v) {
  long double energy = 0.0L, heat = 0.0L;
  int pulls = 0;
  for (int64_t s = 0; s < c->spring_count; s++) {
    const double *i = q + 3 * c->ends[2 * s], *j = q + 3 * c->ends[2 * s + 1];
    const double *vi = v + 3 * c->ends[2 * s], *vj = v + 3 * c->ends[2 * s + 1];
    const double d[3] = {i[0] - j[0], i[1] - j[1], i[2] - j[2]},
                 r = sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
    const double along = (vi[0] - vj[0]) * d[0] + (vi[1] - vj[1]) * d[1] + (vi[2] - vj[2]) * d[2];
    const double rate = r > 0.0 ? along / r : 0.0, stretch = r - c->rest_length[s];
    if (!(c->pull_only[s] && stretch < 0.0)) energy += 0.5L * c->kappa[s] * stretch * stretch;
    heat += (long double)c->gamma[s] * rate * rate;
    pulls |= c->pull_only[s];
  }
  check_close(hooke_system_energy(system, "springs", q, NULL), (double)energy, 1e-12 * (double)energy);
  for (int64_t p = 0; p < 3 * c->particle_count; p++)
    heat += (long double)c->drag * v[p] * v[p];
  if (!pulls) check_close(hooke_system_dissipated_power(system, q, v), (double)heat, 1e-12 * (double)heat);
}

void check_agrees(const hooke_system *system, const struct canonical *c, const double *q, const double *v) {
  const int64_t size = 3 * c->particle_count;
  owned_doubles *found = new_doubles(size), *expected = new_doubles(size);
  check_ok(hooke_system_acceleration(system, 0.0, q, v, found));
  canonical_acceleration(c, 0.0, q, v, expected);
  check_same_bits(size, found, expected);
  check_sums(system, c, q, v);
  check_steps(system, c, "symplectic-euler", q, v);
  check_steps(system, c, "forward-euler", q, v);
  check_steps(system, c, "rk4", q, v);
}
