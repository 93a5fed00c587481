#include "measure/modes/stiffness.h"

#include "core/memory.h"
#include "core/status.h"
#include "model/force/force.h"
#include "model/vector3.h"

#include <math.h>
#include <string.h>

/* ---- sparse matrices ---- */

/* Stable, by a key of each entry below `size`. */
static void sort_entries(int64_t size, int64_t count, const struct hk_entry *from, struct hk_entry *to,
                         int64_t *place, int by_column) {
  memset(place, 0, (size_t)(size + 1) * sizeof *place);
  for (int64_t k = 0; k < count; k++)
    place[1 + (by_column ? from[k].column : from[k].row)]++;
  for (int64_t k = 0; k < size; k++)
    place[k + 1] += place[k];
  for (int64_t k = 0; k < count; k++)
    to[place[by_column ? from[k].column : from[k].row]++] = from[k];
}

/* Of sorted entries. */
static void merge(int64_t count, const struct hk_entry *entry, struct hk_columns *matrix) {
  int32_t used = 0;
  for (int64_t k = 0; k < count; k++) {
    const int again = k > 0 && entry[k].row == entry[k - 1].row && entry[k].column == entry[k - 1].column;
    if (again)
      matrix->number[used - 1] += entry[k].value;
    else
      matrix->row[used] = entry[k].row, matrix->number[used++] = entry[k].value;
    matrix->start[entry[k].column + 1] = used;
  }
  for (int32_t k = 0; k < matrix->size; k++) /* columns without entries */
    if (matrix->start[k + 1] == 0) matrix->start[k + 1] = matrix->start[k];
}

int32_t hk_columns_make(int64_t size, int64_t count, const struct hk_entry *entry,
                        struct hk_columns *matrix) {
  if (count > INT32_MAX)
    return hk_fail(HOOKE_NO_MEMORY, NULL, "a matrix with %lld entries is too large for modes",
                   (long long)count);
  struct hk_entry *own = hk_new(2 * count, sizeof *own);
  int64_t *place = hk_new(size + 1, sizeof *place);
  *matrix = (struct hk_columns){(int32_t)size, hk_new(size + 1, sizeof(int32_t)),
                                hk_new(count, sizeof(int32_t)), hk_new(count, sizeof(double))};
  const int fine = own && place && matrix->start && matrix->row && matrix->number;
  for (int64_t k = 0; k < count && fine; k++) {
    const int32_t i = entry[k].row, j = entry[k].column;
    own[k] = (struct hk_entry){i < j ? i : j, i < j ? j : i, entry[k].value};
  }
  if (fine) {
    sort_entries(size, count, own, own + count, place, 0);
    sort_entries(size, count, own + count, own, place, 1);
    merge(count, own, matrix);
  } else {
    hk_columns_release(matrix);
  }
  hk_free(own);
  hk_free(place);
  return fine ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void hk_columns_release(struct hk_columns *matrix) {
  hk_free(matrix->start);
  hk_free(matrix->row);
  hk_free(matrix->number);
  memset(matrix, 0, sizeof *matrix);
}

void hk_columns_multiply(const struct hk_columns *matrix, const double *y, double *out) {
  memset(out, 0, (size_t)matrix->size * sizeof(double));
  for (int32_t j = 0; j < matrix->size; j++) {
    for (int32_t k = matrix->start[j]; k < matrix->start[j + 1]; k++) {
      const int32_t i = matrix->row[k];
      out[i] += matrix->number[k] * y[j];
      if (i != j) out[j] += matrix->number[k] * y[i];
    }
  }
}

/* ---- unknowns ---- */

/* A mover's unknowns, and how its particles move by each. */
static void number_mover(struct hk_stiffness *s, const struct hk_body_tangent *t, double *x) {
  int64_t count;
  const int32_t *particle = t->mover->row->particles(t->mover->thing, &count);
  int32_t width = 0;
  for (int k = 0; k < HOOKE_PUSH; k++) {
    double y[HOOKE_PUSH] = {0.0};
    if (!t->mover->row->has(t->mover->thing, k)) continue;
    y[k] = 1.0;
    t->mover->row->spread(s->system, t, y, (double *const[3]){x, x + 1, x + 2}, 3);
    for (int64_t i = 0; i < 3 * count; i++)
      s->turned[18 * (int64_t)particle[i / 3] + i % 3 * 6 + width] = x[3 * (int64_t)particle[i / 3] + i % 3];
    width++;
  }
  for (int64_t i = 0; i < count; i++) {
    if (s->system->constrained[particle[i]]) continue;
    s->first[particle[i]] = s->count;
    s->width[particle[i]] = width;
  }
  s->count += width;
}

static int32_t number_unknowns(struct hk_stiffness *s, const double *q) {
  const hooke_system *system = s->system;
  const int64_t n = system->particle_count;
  s->first = hk_new(n, sizeof *s->first);
  s->width = hk_new(n, sizeof *s->width);
  s->turned = hk_new(system->mover_count > 0 ? 18 * n : 0, sizeof(double));
  double *x = hk_new(3 * n, sizeof(double));
  int32_t status = s->first && s->width && s->turned && x ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hk_body_tangents_create(system, q, &s->movers);
  for (int64_t p = 0; p < n && status == HOOKE_OK; p++) {
    const int alone = !system->constrained[p] && !hk_is_carried(system, p);
    s->first[p] = alone ? s->count : -1;
    s->width[p] = alone ? 3 : 0;
    s->count += s->width[p];
  }
  for (int64_t k = 0; k < s->movers.count && status == HOOKE_OK; k++)
    number_mover(s, &s->movers.body[k], x);
  hk_free(x);
  return status;
}

/* Displacement of a particle along an axis by the k-th of its unknowns. */
static double by_unknown(const struct hk_stiffness *s, int64_t p, int a, int k) {
  if (hk_is_carried(s->system, p)) return s->turned[18 * p + 6 * a + k];
  return a == k ? sqrt(s->system->inverse_mass[p]) : 0.0;
}

void hk_stiffness_displace(const struct hk_stiffness *s, int64_t p, const double *y, double x[3]) {
  for (int a = 0; a < 3; a++) {
    x[a] = 0.0;
    for (int k = 0; k < s->width[p]; k++)
      x[a] += by_unknown(s, p, a, k) * y[s->first[p] + k];
  }
}

void hk_stiffness_spread(const struct hk_stiffness *s, const double *y, double *x) {
  for (int64_t p = 0; p < s->system->particle_count; p++)
    hk_stiffness_displace(s, p, y, x + 3 * p);
}

/* ---- assembling ---- */

struct assembly {
  struct hk_entry *entry; /* NULL: they are only counted */
  int64_t count;
};

static void push(struct assembly *to, int64_t row, int64_t column, double value) {
  if (to->entry) to->entry[to->count] = (struct hk_entry){(int32_t)row, (int32_t)column, value};
  to->count++;
}

/* The block of particles p <= r, and its mirror image. */
static void push_block(const struct hk_stiffness *s, int64_t p, int64_t r, int64_t block,
                       struct assembly *to) {
  const double *one = s->block + 9 * block,
               *other = s->block + 9 * (to->entry ? hk_pattern_block(&s->pattern, r, p) : block);
  for (int i = 0; i < s->width[p]; i++) {
    for (int j = p == r ? i : 0; j < s->width[r]; j++) {
      double sum = 0.0;
      for (int k = 0; k < 9 && to->entry; k++)
        sum -= by_unknown(s, p, k / 3, i) * 0.5 * (one[k] + other[k % 3 * 3 + k / 3]) *
               by_unknown(s, r, k % 3, j);
      const int twice = p != r && s->first[p] + i == s->first[r] + j;
      push(to, s->first[p] + i, s->first[r] + j, twice ? 2.0 * sum : sum);
    }
  }
}

/* What the forces on a body do to its turning. */
static void push_body(const struct hk_stiffness *s, const struct hk_body_tangent *t, struct assembly *to) {
  int64_t first = -1;
  double axis[3][3];
  int place[3], width = 0;
  for (int k = 0; k < HOOKE_PUSH; k++) {
    if (k >= 3) place[k - 3] = t->mover->row->has(t->mover->thing, k) ? width : -1;
    width += t->mover->row->has(t->mover->thing, k) != 0;
  }
  for (int64_t i = 0; i < t->body->count && first < 0; i++)
    first = s->first[t->body->particle[i]];
  hk_body_unit_axes(t, axis);
  for (int i = 0; i < 3 && first >= 0; i++) {
    for (int j = i; j < 3; j++) {
      double sum = 0.0;
      if (place[i] < 0 || place[j] < 0) continue;
      for (int k = 0; k < 9; k++)
        sum +=
            axis[i][k / 3] * 0.5 * (t->geometric[k / 3][k % 3] + t->geometric[k % 3][k / 3]) * axis[j][k % 3];
      push(to, first + place[i], first + place[j], sum);
    }
  }
}

double hk_stiffness_of_turning(const struct hk_stiffness *s, const double *x) {
  double sum = 0.0;
  for (int64_t k = 0; k < s->movers.count; k++) {
    const struct hk_body_tangent *t = &s->movers.body[k];
    double y[HOOKE_PUSH], axis[3][3], turn[3] = {0.0, 0.0, 0.0};
    if (t->body == NULL) continue;
    t->mover->row->gather(s->system, t, s->system->mass, (const double *const[3]){x, x + 1, x + 2}, 3, y);
    hk_body_unit_axes(t, axis);
    for (int a = 0; a < 3; a++)
      hk_add3(y[3 + a], axis[a], turn);
    for (int a = 0; a < 3; a++)
      sum += turn[a] * hk_dot3(t->geometric[a], turn);
  }
  return sum;
}

static void push_all(const struct hk_stiffness *s, struct assembly *to) {
  to->count = 0;
  for (int64_t k = 0; k < s->count; k++)
    push(to, k, k, 0.0);
  for (int64_t p = 0; p < s->pattern.rows; p++) {
    for (int64_t e = s->pattern.row_start[p]; e < s->pattern.row_start[p + 1]; e++)
      if (s->pattern.column[e] >= p) push_block(s, p, s->pattern.column[e], e, to);
  }
  for (int64_t k = 0; k < s->movers.count; k++)
    if (s->movers.body[k].body) push_body(s, &s->movers.body[k], to);
}

/* The largest sum of a row; infinity if some number is not finite. */
static double bound_of(const struct hk_columns *matrix, double *sum) {
  double most = 0.0;
  for (int32_t j = 0; j < matrix->size; j++) {
    for (int32_t k = matrix->start[j]; k < matrix->start[j + 1]; k++) {
      sum[j] += fabs(matrix->number[k]);
      if (matrix->row[k] != j) sum[matrix->row[k]] += fabs(matrix->number[k]);
    }
  }
  for (int32_t j = 0; j < matrix->size; j++)
    most = isfinite(sum[j]) ? fmax(most, sum[j]) : INFINITY;
  return most;
}

static void find_skew(struct hk_stiffness *s) {
  double most = 0.0, apart = 0.0;
  for (int64_t p = 0; p < s->pattern.rows; p++) {
    for (int64_t e = s->pattern.row_start[p]; e < s->pattern.row_start[p + 1]; e++) {
      const int64_t r = s->pattern.column[e];
      if (r < p || s->first[p] < 0 || s->first[r] < 0) continue;
      const double *one = s->block + 9 * e, *other = s->block + 9 * hk_pattern_block(&s->pattern, r, p);
      for (int k = 0; k < 9; k++) {
        most = fmax(most, fabs(one[k]));
        apart = fmax(apart, fabs(one[k] - other[k % 3 * 3 + k / 3]));
      }
    }
  }
  s->skew = most > 0.0 ? apart / most : 0.0;
}

static int32_t assemble(struct hk_stiffness *s) {
  struct assembly to = {.entry = NULL};
  if (s->count > INT32_MAX / 4)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%lld unknowns are too many for modes", (long long)s->count);
  push_all(s, &to);
  double *sum = hk_new(s->count, sizeof(double));
  to.entry = hk_new(to.count, sizeof *to.entry);
  int32_t status = sum && to.entry ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) push_all(s, &to);
  if (status == HOOKE_OK) status = hk_columns_make(s->count, to.count, to.entry, &s->matrix);
  if (status == HOOKE_OK) s->bound = bound_of(&s->matrix, sum);
  hk_free(to.entry);
  hk_free(sum);
  if (status == HOOKE_OK && isinf(s->bound))
    return hk_fail(HOOKE_BAD_VALUE, "state", "the stiffness over the masses there is not a finite number");
  return status;
}

int32_t hk_stiffness_create(const hooke_system *system, const double *q, struct hk_stiffness *s) {
  const int64_t n = system->particle_count;
  *s = (struct hk_stiffness){.system = system};
  s->still = hk_new(6 * n, sizeof(double));
  int32_t status = s->still ? number_unknowns(s, q) : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hk_pattern_create(system, &s->pattern);
  if (status == HOOKE_OK) {
    s->force = s->still + 3 * n;
    s->block = hk_new(9 * s->pattern.count, sizeof(double));
    status = s->block ? HOOKE_OK : HOOKE_NO_MEMORY;
  }
  if (status == HOOKE_OK)
    status = hooke_system_derivative_blocks_at(system, system->moment, q, s->still, s->block, NULL);
  if (status == HOOKE_OK) status = hooke_system_force(system, system->moment, q, s->still, s->force);
  if (status == HOOKE_OK) {
    hk_body_tangents_stiffen(&s->movers, (const double *const[3]){s->force, s->force + 1, s->force + 2}, 3);
    status = assemble(s);
  }
  if (status == HOOKE_OK) find_skew(s);
  if (status != HOOKE_OK) hk_stiffness_release(s);
  return status;
}

void hk_stiffness_release(struct hk_stiffness *s) {
  hk_body_tangents_release(&s->movers);
  hk_pattern_release(&s->pattern);
  hk_columns_release(&s->matrix);
  hk_free(s->first);
  hk_free(s->width);
  hk_free(s->turned);
  hk_free(s->block);
  hk_free(s->still);
  memset(s, 0, sizeof *s);
}
