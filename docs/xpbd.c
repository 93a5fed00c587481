/* Extended position-based dynamics with one iteration a substep, for make_graphics.py: Macklin et al. 2019,
 * "Small steps in physics simulation", algorithm 1 without damping. Springs come sorted by colour, so that
 * those of one colour share no particle and the compiler may do several at once. */
#include <math.h>
#include <stdint.h>

struct cloth {
  int64_t particles, colours;
  const int64_t *colour_end; /* springs of colour c end before colour_end[c] */
  const int32_t *a, *b;
  const double *rest, *compliance; /* [m], 1/(k h^2) [1/kg] */
  const double *w;                 /* inverse masses [1/kg] */
};

static void project(const struct cloth *c, int64_t from, int64_t to, double *restrict x) {
#pragma GCC ivdep
  for (int64_t s = from; s < to; s++) {
    double *xa = x + 3 * c->a[s], *xb = x + 3 * c->b[s];
    const double d0 = xa[0] - xb[0], d1 = xa[1] - xb[1], d2 = xa[2] - xb[2];
    const double wa = c->w[c->a[s]], wb = c->w[c->b[s]];
    const double length = sqrt(d0 * d0 + d1 * d1 + d2 * d2);
    const double push = (c->rest[s] - length) / ((wa + wb + c->compliance[s]) * length);
    xa[0] += wa * push * d0, xa[1] += wa * push * d1, xa[2] += wa * push * d2;
    xb[0] -= wb * push * d0, xb[1] -= wb * push * d1, xb[2] -= wb * push * d2;
  }
}

/* q, v and the work array x have 3 doubles a particle. */
void advance(const struct cloth *c, int64_t steps, double h, const double *gravity, double *q, double *v,
             double *x) {
  for (int64_t k = 0; k < steps; k++) {
    for (int64_t i = 0; i < 3 * c->particles; i++)
      x[i] = q[i] + (c->w[i / 3] > 0.0 ? h * (v[i] + h * gravity[i % 3]) : 0.0);
    for (int64_t colour = 0, from = 0; colour < c->colours; from = c->colour_end[colour++])
      project(c, from, c->colour_end[colour], x);
    for (int64_t i = 0; i < 3 * c->particles; i++) {
      v[i] = (x[i] - q[i]) / h;
      q[i] = x[i];
    }
  }
}
