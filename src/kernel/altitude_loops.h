/* Altitude springs of tetrahedra, on raw arrays (Selle, Lentine and Fedkiw 2008). A tetrahedron of particles
 * 0 to 3 has seven altitudes: 0 to 3 from that particle to the face of the others, 4 to 6 between the edges
 * 01 and 23, 02 and 13, 03 and 12. All of them have the volume over the size of a cross product, so the
 * shortest is that of the largest cross product; it alone acts, as a spring between a particle and a point of
 * the face, or between points of the edges. Lengths have a sign, which changes when the tetrahedron is
 * inverted: the force pushes it back.
 *
 * To the parenthesis, with the particles i0 .. i3 of altitude k from hk_altitude_role[k]:
 *   e = x_i1 - x_i0     r = x_i3 - x_i0 (k < 4) or x_i2 - x_i0     f = x_i2 - x_i0 (k < 4) or x_i3 - x_i2
 *   n = e x f, each component a*b - c*d        A = n.n, and a.b is always (a0*b0 + a1*b1) + a2*b2
 * k is the first with the largest A; without one above 0 there is no force. Then, `side` being 1 or -1,
 *   c = side * (1/sqrt(A))     u = c n      h = u.r      a = ((r x f).n)/A      b = ((r x e).n)/A
 *   weights  k < 4: (a - b) - 1, -a, b, 1      else: a - 1, -a, 1 - b, b      of i0 .. i3
 *   w = ((g0*v_0 + g1*v_1) + g2*v_2) + g3*v_3 with the weights g of particles 0 .. 3
 *   T = (stiffness*(h - l) + damping*(u.w))/l          f_j -= (T*g_j) u          l the rest length of
 * altitude k and T = 0 for a spring that only pulls where h <= l or T < 0. At the shortest altitude weights
 * are from -1 to 1: its ends lie in the tetrahedron. The weighted sum of positions is h u, so h is
 * differentiated by (dh) = u.(sum of g_j dx_j) exactly. */
#pragma once

#include <stdint.h>

enum { HOOKE_ALTITUDES = 7, HOOKE_ALTITUDE_SHORTEST = -1 };

/* Particles ordered such that n.r is six times the signed volume, for every altitude. */
#define HOOKE_ALTITUDE_ROLES                                                                                 \
  {                                                                                                          \
    {1, 3, 2, 0}, {0, 2, 3, 1}, {0, 3, 1, 2}, {0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 1, 3}, {                    \
      0, 3, 2, 1                                                                                             \
    }                                                                                                        \
  }
extern const int8_t hk_altitude_role[HOOKE_ALTITUDES][4];

struct hk_tetrahedron {
  int32_t particle[4];
  int32_t choice; /* the altitude that acts; HOOKE_ALTITUDE_SHORTEST: the currently shortest */
  int32_t pull_only;
  double side;               /* 1 or -1: the sign of the volume at rest */
  double stiffness, damping; /* [N], [N s] */
  double rest[HOOKE_ALTITUDES];
};

/* One altitude at given positions. */
struct hk_altitude {
  int32_t choice;
  double length, u[3], weight[4]; /* weights of particles 0 to 3 */
};

/* The altitude that acts at positions x of the four particles; 0 if there is none. */
int32_t hk_altitude_find(const struct hk_tetrahedron *tetrahedron, const double x[4][3],
                         struct hk_altitude *altitude);

/* W above. */
void hk_altitude_weigh(const struct hk_altitude *altitude, const double v[4][3], double w[3]);

/* T above for u.w = rate; `slack` (may be NULL) is set if it only pulls and is slack. */
double hk_altitude_tension(const struct hk_tetrahedron *tetrahedron, const struct hk_altitude *altitude,
                           double rate, int32_t *slack);

/* f += the forces at q and v; x, y and z apart. Compiled once for each instruction set. */
typedef void hk_tetrahedron_loop(int64_t count, const struct hk_tetrahedron *tetrahedron,
                                 const double *const q[3], const double *const v[3], double *const f[3]);
