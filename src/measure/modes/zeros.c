/* Motions without stiffness by name: those of connected pieces as rigid bodies. */
#include "core/memory.h"
#include "kernel/vector_loops.h"
#include "measure/modes/stiffness.h"
#include "measure/spectrum/eigen/dense.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* Part of a motion's square that may be missing among the motions without stiffness; and the square, against
 * the largest, below which a motion is none: a point does not turn, and a line not about itself. */
static const double MISSING = 1e-6, NO_MOTION = 1e-10;

/* ---- pieces ---- */

static int64_t root_of(int64_t *parent, int64_t p) {
  while (parent[p] != p)
    p = parent[p] = parent[parent[p]];
  return p;
}

static void join(int64_t *parent, int64_t p, int64_t r) {
  const int64_t one = root_of(parent, p), other = root_of(parent, r);
  parent[one > other ? one : other] = one > other ? other : one;
}

/* By stiffness, and by movers; not across particles that are held. */
static void find_pieces(const struct hk_stiffness *s, int64_t *parent, int64_t *owner) {
  const int64_t n = s->system->particle_count;
  for (int64_t p = 0; p < n; p++)
    parent[p] = p;
  for (int64_t k = 0; k < s->count; k++)
    owner[k] = -1;
  for (int64_t p = 0; p < n; p++) {
    if (s->first[p] < 0) continue;
    if (owner[s->first[p]] >= 0) join(parent, p, owner[s->first[p]]);
    owner[s->first[p]] = p;
    for (int64_t e = s->pattern.row_start[p]; e < s->pattern.row_start[p + 1]; e++) {
      double acts = 0.0;
      for (int k = 0; k < 9; k++)
        acts += fabs(s->block[9 * e + k]);
      if (acts > 0.0 && s->first[s->pattern.column[e]] >= 0) join(parent, p, s->pattern.column[e]);
    }
  }
}

/* ---- one piece ---- */

struct piece {
  const struct hk_stiffness *s;
  const double *q;
  int64_t count, *particle; /* of free particles */
  double centre[3], radius;
};

static void measure(struct piece *piece) {
  double weight = 0.0, sum[3] = {0.0, 0.0, 0.0};
  for (int64_t k = 0; k < piece->count; k++) {
    hk_add3(piece->s->system->inertia[piece->particle[k]], piece->q + 3 * piece->particle[k], sum);
    weight += piece->s->system->inertia[piece->particle[k]];
  }
  hk_scale3(1.0 / weight, sum, piece->centre);
  piece->radius = 0.0;
  for (int64_t k = 0; k < piece->count; k++)
    piece->radius = fmax(piece->radius, hk_distance3(piece->q + 3 * piece->particle[k], piece->centre));
}

/* Displacement of a particle by the translation or rotation k < 6. */
static void displace(const struct piece *piece, int64_t p, int k, double x[3]) {
  double axis[3] = {k % 3 == 0, k % 3 == 1, k % 3 == 2}, arm[3];
  if (k >= 3 && piece->radius > 0.0) {
    hk_scale3(1.0 / piece->radius, piece->q + 3 * p, arm);
    hk_add3(-1.0 / piece->radius, piece->centre, arm);
    hk_cross3(axis, arm, x);
  } else {
    hk_scale3(k < 3 ? 1.0 : 0.0, axis, x);
  }
}

/* square[6][6] = X^T M X of the six motions; along[6][count] = Z^T of them, of the motions without stiffness.
 * J^T M x of a particle goes to its unknowns. */
static void project(const struct piece *piece, int64_t count, const double *zero, double square[36],
                    double *along) {
  const struct hk_stiffness *s = piece->s;
  memset(square, 0, 36 * sizeof(double));
  memset(along, 0, (size_t)(6 * count) * sizeof(double));
  for (int64_t i = 0; i < piece->count; i++) {
    const int64_t p = piece->particle[i];
    double x[6][3];
    for (int k = 0; k < 6; k++)
      displace(piece, p, k, x[k]);
    for (int k = 0; k < 36; k++)
      square[k] += s->system->inertia[p] * hk_dot3(x[k / 6], x[k % 6]);
    for (int64_t z = 0; z < count; z++) {
      double moved[3];
      hk_stiffness_displace(s, p, zero + z * s->count, moved);
      for (int k = 0; k < 6; k++)
        along[k * count + z] += s->system->inertia[p] * hk_dot3(x[k], moved);
    }
  }
}

/* How many motions that the first `size` span are within the span of those without stiffness. */
static int32_t count_within(int size, int64_t count, const double square[36], const double *along,
                            int64_t *within) {
  double matrix[36], value[6], vector[36], inner[36];
  int rank = 0;
  for (int k = 0; k < size * size; k++) {
    const int i = k / size, j = k % size;
    matrix[k] = square[6 * i + j];
    inner[k] = hk_dot(count, along + i * count, along + j * count);
  }
  int32_t status = hk_dense_symmetric(size, matrix, value, vector);
  while (status == HOOKE_OK && rank < size && value[rank] > NO_MOTION * value[0])
    rank++;
  for (int k = 0; k < rank * rank; k++) {
    double sum = 0.0;
    for (int e = 0; e < size * size; e++)
      sum += vector[k / rank * size + e / size] * inner[e] * vector[k % rank * size + e % size];
    matrix[k] = sum / sqrt(value[k / rank] * value[k % rank]);
  }
  if (status == HOOKE_OK) status = hk_dense_symmetric(rank, matrix, value, vector);
  for (*within = 0; status == HOOKE_OK && *within < rank && value[*within] > 1.0 - MISSING;)
    ++*within;
  return status;
}

static int32_t name_piece(struct piece *piece, int64_t count, const double *zero, double *along,
                          int64_t *translations, int64_t *rotations) {
  double square[36];
  int64_t moved = 0, all = 0;
  measure(piece);
  project(piece, count, zero, square, along);
  int32_t status = count_within(3, count, square, along, &moved);
  if (status == HOOKE_OK) status = count_within(6, count, square, along, &all);
  *translations += moved;
  *rotations += all - moved;
  return status;
}

/* Free particles piece by piece: those of root p are from start[p + 1] to start[p + 2]. */
static void list_pieces(const struct hk_stiffness *s, int64_t *parent, int64_t *start, int64_t *list) {
  const int64_t n = s->system->particle_count;
  for (int64_t p = 0; p < n; p++)
    start[root_of(parent, p) + 1] += s->first[p] >= 0;
  for (int64_t p = 0; p < n; p++)
    start[p + 1] += start[p];
  start[n + 1] = start[n];
  for (int64_t p = n - 1; p >= 0; p--)
    if (s->first[p] >= 0) list[--start[root_of(parent, p) + 1]] = p;
}

int32_t hk_stiffness_name_zeros(const struct hk_stiffness *s, const double *q, int64_t count,
                                const double *zero, int64_t *translations, int64_t *rotations) {
  const int64_t n = s->system->particle_count;
  *translations = *rotations = 0;
  if (count == 0) return HOOKE_OK;
  int64_t *parent = hk_new(n, sizeof *parent), *list = hk_new(n, sizeof *list),
          *start = hk_new((n > s->count ? n : s->count) + 2, sizeof *start);
  double *along = hk_new(6 * count, sizeof(double));
  int32_t status = parent && list && start && along ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) {
    find_pieces(s, parent, start);
    memset(start, 0, (size_t)(n + 2) * sizeof *start);
    list_pieces(s, parent, start, list);
  }
  for (int64_t p = 0; p < n && status == HOOKE_OK; p++) {
    struct piece piece = {
        .s = s, .q = q, .count = start[p + 2] - start[p + 1], .particle = list + start[p + 1]};
    if (piece.count > 0) status = name_piece(&piece, count, zero, along, translations, rotations);
  }
  hk_free(parent);
  hk_free(list);
  hk_free(start);
  hk_free(along);
  return status;
}
