/* Compiled once per instruction set, with HOOKE_ISA naming it. The tetrahedra of a block are laid out
 * component by component and computed side by side; their forces are added in their order. */
#include "kernel/altitude_loops.h"

#include "kernel/instruction_set.h"
#include "kernel/vector_unit.h"

typedef hk_vector vec;
typedef hk_vector_mask mask;

enum { BLOCK = 32 };

struct block {
  _Alignas(64) double x[4][3][BLOCK], v[4][3][BLOCK], y[4][3][BLOCK]; /* y: of the particles i0 .. i3 */
  double side[BLOCK], stiffness[BLOCK], damping[BLOCK], rest[BLOCK];
  int64_t choice[BLOCK], pull_only[BLOCK]; /* choice: first the given one */
  double u[3][BLOCK], length[BLOCK], weight[4][BLOCK], tension[BLOCK];
};

static const int8_t role_of[HOOKE_ALTITUDES][4] = HOOKE_ALTITUDE_ROLES;

HOOKE_INLINE vec choose(mask where, vec a, vec b) {
  return (vec)(((mask)a & where) | ((mask)b & ~where));
}

HOOKE_INLINE vec dot(const vec a[3], const vec b[3]) {
  return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

HOOKE_INLINE void cross(const vec a[3], const vec b[3], vec n[3]) {
  n[0] = a[1] * b[2] - a[2] * b[1];
  n[1] = a[2] * b[0] - a[0] * b[2];
  n[2] = a[0] * b[1] - a[1] * b[0];
}

/* Tetrahedra past the last repeat it, and move nothing. */
static void gather(const struct hk_tetrahedron *tetrahedron, ptrdiff_t count, const double *const q[3],
                   const double *const v[3], struct block *b) {
  const ptrdiff_t whole = (count + HOOKE_WIDTH - 1) / HOOKE_WIDTH * HOOKE_WIDTH;
  for (ptrdiff_t i = 0; i < whole; i++) {
    const struct hk_tetrahedron *t = &tetrahedron[i < count ? i : count - 1];
    for (int j = 0; j < 4; j++) {
      const ptrdiff_t p = t->particle[j];
      for (int a = 0; a < 3; a++) {
        b->x[j][a][i] = q[a][p];
        b->v[j][a][i] = v[a][p];
      }
    }
    b->side[i] = t->side;
    b->stiffness[i] = t->stiffness;
    b->damping[i] = t->damping;
    b->choice[i] = t->choice;
    b->pull_only[i] = t->pull_only ? -1 : 0;
  }
}

HOOKE_INLINE vec difference(const double *a, const double *b) {
  return hk_load(a) - hk_load(b);
}

/* The square of the cross product of altitude k, a constant. */
HOOKE_INLINE vec square_of(const struct block *b, ptrdiff_t i, const int k) {
  vec e[3], f[3], n[3];
  const int8_t *role = role_of[k];
  for (int a = 0; a < 3; a++) {
    e[a] = difference(&b->x[role[1]][a][i], &b->x[role[0]][a][i]);
    f[a] = k < 4 ? difference(&b->x[role[2]][a][i], &b->x[role[0]][a][i])
                 : difference(&b->x[role[3]][a][i], &b->x[role[2]][a][i]);
  }
  cross(e, f, n);
  return dot(n, n);
}

/* The first with the largest cross product, or the given one; -1 where there is none. */
static void choose_altitudes(struct block *b, ptrdiff_t count) {
  for (ptrdiff_t i = 0; i < count; i += HOOKE_WIDTH) {
    const mask given = *(const mask *)&b->choice[i], none = given - given - 1;
    const mask free = (mask)(given == none);
    mask choice = none;
    vec most = {0};
#define CONSIDER(k)                                                                                          \
  {                                                                                                          \
    const vec square = square_of(b, i, k);                                                                   \
    const mask larger = (mask)(square > most) & (free | (mask)(given == (k)));                               \
    most = choose(larger, square, most);                                                                     \
    choice = ((none + ((k) + 1)) & larger) | (choice & ~larger);                                             \
  }
    CONSIDER(0)
    CONSIDER(1)
    CONSIDER(2)
    CONSIDER(3)
    CONSIDER(4)
    CONSIDER(5)
    CONSIDER(6)
    *(mask *)&b->choice[i] = choice;
  }
}

/* Rest lengths, and positions by role; those of altitude 0 where none acts. */
static void gather_roles(const struct hk_tetrahedron *tetrahedron, ptrdiff_t count, struct block *b) {
  const ptrdiff_t whole = (count + HOOKE_WIDTH - 1) / HOOKE_WIDTH * HOOKE_WIDTH;
  for (ptrdiff_t i = 0; i < whole; i++) {
    const int64_t choice = b->choice[i] < 0 ? 0 : b->choice[i];
    const int8_t *role = role_of[choice];
    b->rest[i] = tetrahedron[i < count ? i : count - 1].rest[choice];
    for (int m = 0; m < 4; m++) {
      for (int a = 0; a < 3; a++)
        b->y[m][a][i] = b->x[role[m]][a][i];
    }
  }
}

/* Weights of the particles i0 .. i3 to those of particles 0 .. 3. */
HOOKE_INLINE void store_weights(struct block *b, ptrdiff_t i, mask choice, const vec weight[4]) {
  vec g[4] = {{0}};
  for (int k = 0; k < HOOKE_ALTITUDES; k++) {
    const mask here = (mask)(choice == k);
    for (int m = 0; m < 4; m++)
      g[role_of[k][m]] = choose(here, weight[m], g[role_of[k][m]]);
  }
  for (int j = 0; j < 4; j++)
    hk_store(&b->weight[j][i], g[j]);
}

static void find_altitudes(struct block *b, ptrdiff_t count) {
  for (ptrdiff_t i = 0; i < count; i += HOOKE_WIDTH) {
    vec e[3], f[3], r[3], n[3], u[3], rf[3], re[3];
    const mask choice = *(const mask *)&b->choice[i], face = (mask)(choice < 4);
    for (int a = 0; a < 3; a++) {
      const vec y0 = hk_load(&b->y[0][a][i]), y1 = hk_load(&b->y[1][a][i]), y2 = hk_load(&b->y[2][a][i]),
                y3 = hk_load(&b->y[3][a][i]);
      e[a] = y1 - y0;
      f[a] = choose(face, y2 - y0, y3 - y2);
      r[a] = choose(face, y3 - y0, y2 - y0);
    }
    cross(e, f, n);
    const vec square = dot(n, n), c = hk_load(&b->side[i]) * (1.0 / hk_vector_sqrt(square));
    for (int k = 0; k < 3; k++) {
      u[k] = c * n[k];
      hk_store(&b->u[k][i], u[k]);
    }
    hk_store(&b->length[i], dot(u, r));
    cross(r, f, rf);
    cross(r, e, re);
    const vec along = dot(rf, n) / square, across = dot(re, n) / square, one = hk_all(1.0);
    const vec weight[4] = {choose(face, (along - across) - 1.0, along - 1.0), -along,
                           choose(face, across, 1.0 - across), choose(face, one, across)};
    store_weights(b, i, choice, weight);
  }
}

static void find_tensions(struct block *b, ptrdiff_t count) {
  for (ptrdiff_t i = 0; i < count; i += HOOKE_WIDTH) {
    vec w[3], u[3];
    for (int a = 0; a < 3; a++) {
      w[a] = hk_load(&b->weight[0][i]) * hk_load(&b->v[0][a][i]);
      for (int j = 1; j < 4; j++)
        w[a] = w[a] + hk_load(&b->weight[j][i]) * hk_load(&b->v[j][a][i]);
      u[a] = hk_load(&b->u[a][i]);
    }
    const vec rest = hk_load(&b->rest[i]), length = hk_load(&b->length[i]);
    const vec tension =
        (hk_load(&b->stiffness[i]) * (length - rest) + hk_load(&b->damping[i]) * dot(u, w)) / rest;
    const mask slack = *(const mask *)&b->pull_only[i] & ((mask)(length <= rest) | (mask)(tension < 0.0));
    hk_store(&b->tension[i], (vec)((mask)tension & ~slack));
  }
}

static void scatter(const struct hk_tetrahedron *tetrahedron, ptrdiff_t count, const struct block *b,
                    double *const f[3]) {
  double *x = f[0], *y = f[1], *z = f[2];
  for (ptrdiff_t i = 0; i < count; i++) {
    const int32_t *particle = tetrahedron[i].particle;
    const double ux = b->u[0][i], uy = b->u[1][i], uz = b->u[2][i], tension = b->tension[i];
    if (b->choice[i] == HOOKE_ALTITUDE_SHORTEST) continue;
    for (int j = 0; j < 4; j++) {
      const double s = tension * b->weight[j][i];
      x[particle[j]] -= s * ux;
      y[particle[j]] -= s * uy;
      z[particle[j]] -= s * uz;
    }
  }
}

void HOOKE_TETRAHEDRON_LOOP(int64_t count, const struct hk_tetrahedron *tetrahedron, const double *const q[3],
                            const double *const v[3], double *const f[3]) {
  struct block b;
  for (int64_t done = 0; done < count; done += BLOCK, tetrahedron += BLOCK) {
    const ptrdiff_t some = count - done < BLOCK ? (ptrdiff_t)(count - done) : BLOCK;
    gather(tetrahedron, some, q, v, &b);
    choose_altitudes(&b, some);
    gather_roles(tetrahedron, some, &b);
    find_altitudes(&b, some);
    find_tensions(&b, some);
    scatter(tetrahedron, some, &b, f);
  }
}
