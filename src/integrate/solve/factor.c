#include "integrate/solve/factor.h"

#include "core/memory.h"
#include "core/status.h"
#include "integrate/solve/factor_cholmod.h"
#include "kernel/triangle_loops.h"
#include "model/force/spring.h"

#include <math.h>
#include <string.h>

/* Position of the block of two particles in the matrix: in the three columns of the later one, from number
 * `first` of each on; column -1 if an end is constrained. */
struct slot {
  int32_t column, first;
};

struct hk_factor {
  const hooke_system *system;
  int32_t free_count;
  int32_t *particle,
      *position; /* the free particles in order; the index of each in it, -1 for constrained ones */
  struct hk_columns matrix;   /* S, in order */
  struct slot *spring, *pair; /* of each spring; of the pairs 01, 02, 12, 03, 13, 23 of each other element */
  struct hk_cholmod *cholmod;
  struct hk_triangle triangle;
  double *vector;
  int32_t kind; /* HOOKE_FACTOR_* */
  double numbers, products;
  int64_t blocks, bytes; /* below the diagonal, of the pattern */
};

static int32_t no_memory(void) {
  return hk_fail(HOOKE_NO_MEMORY, NULL, "no memory for a sparse factor");
}

static void *take(struct hk_factor *x, int64_t count, size_t size) {
  x->bytes += count * (int64_t)size;
  return hk_new(count, size);
}

/* ---- once ---- */

static void number_free(struct hk_factor *x) {
  x->free_count = 0;
  for (int64_t p = 0; p < x->system->particle_count; p++) {
    x->position[p] = -1;
    if (x->system->constrained[p]) continue;
    x->particle[x->free_count] = (int32_t)p;
    x->position[p] = x->free_count++;
  }
}

/* The upper triangle of blocks in the current order: a row in each column for every earlier neighbour,
 * ascending, and for the particle itself. */
static void fill_blocks(const struct hk_factor *x, const struct hk_pattern *pattern,
                        const struct hk_columns *blocks) {
  int32_t count = 0;
  for (int32_t k = 0; k < x->free_count; k++) {
    const int32_t p = x->particle[k], first = count;
    blocks->start[k] = count;
    for (int64_t e = pattern->row_start[p]; e < pattern->row_start[p + 1]; e++) {
      const int32_t other = x->position[pattern->column[e]];
      if (other < 0 || other > k) continue;
      int32_t at = count++; /* neighbours are few */
      for (; at > first && blocks->row[at - 1] > other; at--)
        blocks->row[at] = blocks->row[at - 1];
      blocks->row[at] = other;
    }
  }
  blocks->start[x->free_count] = count;
}

static int reorder(struct hk_factor *x, const struct hk_columns *blocks) {
  int32_t *order = hk_new(x->free_count, sizeof *order);
  const int fine = order && hk_cholmod->order(blocks, order);
  for (int32_t k = 0; fine && k < x->free_count; k++)
    order[k] = x->particle[order[k]];
  for (int32_t k = 0; fine && k < x->free_count; k++) {
    x->particle[k] = order[k];
    x->position[order[k]] = k;
  }
  hk_free(order);
  return fine;
}

/* Three columns and rows of numbers for each block. */
static int make_matrix(struct hk_factor *x, const struct hk_columns *blocks) {
  struct hk_columns *m = &x->matrix;
  const int64_t numbers = 9 * (int64_t)blocks->start[x->free_count];
  m->size = 3 * x->free_count;
  m->start = take(x, (int64_t)m->size + 1, sizeof *m->start);
  m->row = take(x, numbers, sizeof *m->row);
  if (m->start == NULL || m->row == NULL) return 0;
  int32_t count = 0;
  for (int32_t k = 0; k < m->size; k++) {
    m->start[k] = count;
    for (int32_t b = blocks->start[k / 3]; b < blocks->start[k / 3 + 1]; b++) {
      for (int32_t row = 3 * blocks->row[b]; row < 3 * blocks->row[b] + 3 && row <= k; row++)
        m->row[count++] = row;
    }
  }
  m->start[m->size] = count;
  return 1;
}

static struct slot find_place(const struct hk_factor *x, int64_t one, int64_t other) {
  const int32_t a = x->position[one], b = x->position[other];
  if (a < 0 || b < 0) return (struct slot){-1, 0};
  const int32_t column = 3 * (a > b ? a : b), earlier = 3 * (a > b ? b : a);
  const int32_t start = x->matrix.start[column];
  int32_t low = start, high = x->matrix.start[column + 1];
  while (high - low > 1) {
    const int32_t middle = low + (high - low) / 2;
    if (x->matrix.row[middle] <= earlier)
      low = middle;
    else
      high = middle;
  }
  return (struct slot){column, low - start};
}

/* Pairs of particles in all other elements, counted where `slot` is NULL. */
static int64_t locate_others(const struct hk_factor *x, struct slot *slot) {
  struct hk_elements at;
  int64_t count = 0;
  hk_begin_elements(x->system, 0.0, NULL, NULL, &at);
  at.kinds = HOOKE_OTHERS;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    for (int j = 1; j < e->count; j++) {
      for (int k = 0; k < j; k++, count++)
        if (slot) slot[count] = find_place(x, e->particle[k], e->particle[j]);
    }
  }
  return count;
}

static int locate_blocks(struct hk_factor *x) {
  const struct hk_springs *springs = x->system->springs;
  x->spring = take(x, springs->count, sizeof *x->spring);
  x->pair = take(x, locate_others(x, NULL), sizeof *x->pair);
  if (x->spring == NULL || x->pair == NULL) return 0;
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring(run, k);
      x->spring[run->first + k] = find_place(x, spring.head, spring.tail);
    }
  }
  locate_others(x, x->pair);
  return 1;
}

static void count_numbers(struct hk_factor *x) {
  const int32_t *count = hk_cholmod->counts(x->cholmod);
  for (int32_t k = 0; k < x->matrix.size; k++) {
    x->numbers += count[k];
    x->products += 0.5 * count[k] * count[k];
  }
}

/* Columns of a particle have the same rows below the diagonal, those of other particles as a whole. */
static int begin_triangle(struct hk_factor *x) {
  const int32_t *count = hk_cholmod->counts(x->cholmod);
  x->triangle.count = x->free_count;
  x->triangle.begin = take(x, (int64_t)x->free_count + 1, sizeof *x->triangle.begin);
  for (int64_t k = 0; k < x->free_count; k++)
    x->blocks += (count[3 * k] - 3) / 3;
  return x->triangle.begin != NULL;
}

/* 1 with the factor if it is small enough, otherwise -1. */
static int analyse(struct hk_factor *x, const struct hk_pattern *pattern, int64_t most) {
  if (pattern->count > most / 9) return -1;
  struct hk_columns blocks = {.size = x->free_count,
                              .start = hk_new((int64_t)x->free_count + 1, sizeof *blocks.start),
                              .row = hk_new(pattern->count, sizeof *blocks.row)};
  int fine = blocks.start && blocks.row;
  if (fine) fill_blocks(x, pattern, &blocks);
  if (fine) fine = reorder(x, &blocks);
  if (fine) fill_blocks(x, pattern, &blocks);
  if (fine) fine = make_matrix(x, &blocks);
  hk_free(blocks.start);
  hk_free(blocks.row);
  if (fine) fine = (x->cholmod = hk_cholmod->create(&x->matrix, x->kind)) != NULL;
  if (!fine) return 0;
  x->bytes += hk_cholmod->memory(x->cholmod);
  count_numbers(x);
  return x->numbers <= (double)most ? 1 : -1;
}

int32_t hk_factor_require(const hooke_options *options) {
  if (hk_cholmod || strcmp(hooke_options_text(options, "linear_solver"), "direct") != 0) return HOOKE_OK;
  return hk_fail(HOOKE_NOT_BUILT, "linear_solver",
                 "direct needs CHOLMOD, which this build is without; take auto or blocks");
}

/* `found` becomes 1 if there may be one, -1 if it has too many numbers, or the build has none. */
static int32_t find(const hooke_system *system, int64_t most, int32_t supernodal, struct hk_factor **factor,
                    int *found) {
  struct hk_pattern pattern;
  *found = -1;
  *factor = NULL;
  if (hk_cholmod == NULL) return HOOKE_OK;
  struct hk_factor *x = *factor = hk_new(1, sizeof *x);
  if (x == NULL) return HOOKE_NO_MEMORY;
  x->system = system;
  x->kind = supernodal && hooke_build_fact("blas")[0] ? HOOKE_FACTOR_SUPERNODAL : HOOKE_FACTOR_SIMPLICIAL;
  x->particle = take(x, system->particle_count, sizeof *x->particle);
  x->position = take(x, system->particle_count, sizeof *x->position);
  int32_t status = x->particle && x->position ? hk_pattern_create(system, &pattern) : HOOKE_NO_MEMORY;
  if (status != HOOKE_OK) return status;
  number_free(x);
  *found = analyse(x, &pattern, most);
  hk_pattern_release(&pattern);
  if (*found > 0) *found = locate_blocks(x) && begin_triangle(x);
  return *found == 0 ? no_memory() : HOOKE_OK;
}

int32_t hk_factor_create(const hooke_system *system, int64_t most, int32_t supernodal,
                         struct hk_factor **factor) {
  int found;
  const int32_t status = find(system, most, supernodal, factor, &found);
  if (status == HOOKE_OK && found > 0) return HOOKE_OK;
  hk_factor_destroy(*factor);
  *factor = NULL;
  return status;
}

void hk_factor_destroy(struct hk_factor *x) {
  if (x == NULL) return;
  hk_cholmod->destroy(x->cholmod);
  void *const blocks[] = {x->particle, x->position, x->matrix.start,   x->matrix.row,  x->matrix.number,
                          x->spring,   x->pair,     x->triangle.begin, x->triangle.row};
  for (size_t k = 0; k < sizeof blocks / sizeof blocks[0]; k++)
    hk_free(blocks[k]);
  hk_free(x);
}

int64_t hk_factor_memory(const struct hk_factor *x) {
  return x->bytes;
}

/* Memory of the matrix, of the triangle with the vector, and of CHOLMOD. */
static int64_t bytes_of_numbers(const struct hk_factor *x) {
  const int64_t own = x->matrix.start[x->matrix.size], blocks = x->blocks;
  return (own + 9 * blocks + 9 * x->triangle.count) * (int64_t)sizeof(double) +
         blocks * (int64_t)sizeof(int32_t) + hk_cholmod->room(x->cholmod);
}

int32_t hk_factor_foretell(const hooke_system *system, int64_t most, int64_t *bytes) {
  struct hk_factor *x;
  int found;
  const int32_t status = find(system, most, 1, &x, &found);
  *bytes = x ? x->bytes + (found > 0 ? bytes_of_numbers(x) : 0) : 0;
  hk_factor_destroy(x);
  return status;
}

/* All numbers are in one block. */
int32_t hk_factor_reserve(struct hk_factor *x) {
  struct hk_triangle *l = &x->triangle;
  const int64_t own = x->matrix.start[x->matrix.size], blocks = x->blocks;
  if (l->row) return HOOKE_OK;
  double *numbers = hk_new(own + 9 * blocks + 9 * l->count + 2 * HOOKE_TRIANGLE_SPARE, sizeof *numbers);
  l->row = numbers ? hk_new(blocks, sizeof *l->row) : NULL;
  if (l->row == NULL) {
    hk_free(numbers);
    return no_memory();
  }
  x->matrix.number = numbers;
  l->block = numbers + own;
  l->corner = l->block + 9 * blocks + HOOKE_TRIANGLE_SPARE;
  x->vector = l->corner + 6 * l->count;
  x->bytes += bytes_of_numbers(x);
  return HOOKE_OK;
}

int64_t hk_factor_numbers(const struct hk_factor *x) {
  return (int64_t)x->numbers;
}

double hk_factor_products(const struct hk_factor *x) {
  return x->products;
}

/* ---- numbers ---- */

/* Column c of a block. */
static double *column_of(const struct hk_columns *matrix, struct slot slot, int c) {
  return matrix->number + matrix->start[slot.column + c] + slot.first;
}

static void add_diagonal(const struct hk_factor *x, const double *diagonal) {
  static const int component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  const int64_t n = x->system->particle_count;
  for (int32_t k = 0; k < x->matrix.size; k++) {
    const int c = k % 3;
    double *corner = x->matrix.number + x->matrix.start[k + 1] - 1; /* the last number of its column */
    for (int a = 0; a <= c; a++)
      corner[a - c] += diagonal[component[a][c] * n + x->particle[k / 3]];
  }
}

static void add_springs(const struct hk_factor *x, const struct hk_tangent *t) {
  for (int64_t s = 0; s < x->system->springs->count; s++) {
    if (x->spring[s].column < 0) continue;
    const double u[3] = {t->u[0][s], t->u[1][s], t->u[2][s]};
    const double across = t->b[s] > 0.0 ? t->b[s] : 0.0;
    const double whole = ((t->e[0][s] * u[0] + t->e[1][s] * u[1]) + t->e[2][s] * u[2]) + t->b[s] - across;
    const double along = whole > -across ? whole : -across;
    for (int c = 0; c < 3; c++) {
      double *to = column_of(&x->matrix, x->spring[s], c);
      for (int a = 0; a < 3; a++)
        to[a] -= along * u[a] * u[c] + (a == c ? across : 0.0);
    }
  }
}

/* Adds the off-diagonal blocks of an element; its own first. */
static const struct slot *add_element(const struct hk_factor *x, const struct hk_element *e,
                                      const struct hk_factor_parts *parts, const struct slot *slot) {
  const struct hk_element_numbers s = hk_element_combine(e, parts->alpha, parts->beta);
  for (int j = 1; j < e->count; j++) {
    for (int k = 0; k < j; k++, slot++) {
      const double product = e->weight[k] * e->weight[j];
      const double axial = (s.along - s.across) * product, isotropic = s.across * product;
      if (slot->column < 0) continue;
      for (int c = 0; c < 3; c++) {
        double *to = column_of(&x->matrix, *slot, c);
        for (int a = 0; a < 3; a++)
          to[a] += axial * e->u[a] * e->u[c] + (a == c ? isotropic : 0.0);
      }
    }
  }
  return slot;
}

/* In the order in which positions were found: by the table of forces, whose constant forces may be anywhere.
 */
static void add_others(const struct hk_factor *x, const struct hk_factor_parts *parts) {
  const struct slot *slot = x->pair;
  const struct hk_element *kept = parts->element;
  struct hk_elements at;
  for (int32_t k = 0; k < x->system->force_row_count; k++) {
    const struct hk_force_row *force = x->system->force_row[k];
    if (!(force->kind & HOOKE_OTHERS)) continue;
    if (force->kind & HOOKE_KEPT) {
      for (int64_t left = hk_force_count(x->system, force); left > 0; left--)
        slot = add_element(x, kept++, parts, slot);
      continue;
    }
    hk_begin_elements(x->system, 0.0, x->system->position, NULL, &at);
    at.only = force;
    for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;)
      slot = add_element(x, e, parts, slot);
  }
}

static int is_zero(const double block[9]) {
  int a = 0;
  while (a < 9 && block[a] == 0.0)
    a++;
  return a == 9;
}

/* Copies L block by block, but for zeros between nonzeros. 0 if a number is not finite on its diagonal, or
 * where it should be zero. */
static int32_t fill_triangle(struct hk_factor *x) {
  struct hk_triangle *to = &x->triangle;
  int64_t count = 0;
  int32_t supernode = 0;
  for (int32_t k = 0; k < (int32_t)to->count; k++) {
    const struct hk_factor_column l = hk_cholmod->column(x->cholmod, 3 * k, &supernode);
    const double *one = l.number, *two = hk_cholmod->column(x->cholmod, 3 * k + 1, &supernode).number,
                 *three = hk_cholmod->column(x->cholmod, 3 * k + 2, &supernode).number;
    const double corner[6] = {1.0 / one[0], one[1], one[2], 1.0 / two[0], two[1], 1.0 / three[0]};
    if (!(one[0] < INFINITY && two[0] < INFINITY && three[0] < INFINITY)) return 0;
    memcpy(to->corner + 6 * k, corner, sizeof corner);
    to->begin[k] = count;
    for (int32_t at = 3; at < l.count; at += 3) {
      double block[9];
      memcpy(block, one + at, 3 * sizeof(double));
      memcpy(block + 3, two + at - 1, 3 * sizeof(double));
      memcpy(block + 6, three + at - 2, 3 * sizeof(double));
      if (x->kind == HOOKE_FACTOR_SUPERNODAL && is_zero(block)) continue;
      if (count == x->blocks) return 0;
      to->row[count] = l.row[at];
      memcpy(to->block + 9 * count++, block, sizeof block);
    }
  }
  to->begin[to->count] = count;
  return 1;
}

int32_t hk_factor_compute(struct hk_factor *x, const double *diagonal, const struct hk_factor_parts *parts) {
  memset(x->matrix.number, 0, (size_t)x->matrix.start[x->matrix.size] * sizeof(double));
  add_diagonal(x, diagonal);
  add_springs(x, parts->tangent);
  add_others(x, parts);
  const int32_t positive = hk_cholmod->compute(x->cholmod, &x->matrix, 0.0);
  return positive == 1 ? fill_triangle(x) : positive;
}

/* ---- solutions ---- */

void hk_factor_forward(const struct hk_factor *factor, const double *all, double *ordered) {
  const int64_t n = factor->system->particle_count;
  for (int64_t k = 0; k < factor->free_count; k++) {
    for (int a = 0; a < 3; a++)
      ordered[3 * k + a] = all[a * n + factor->particle[k]];
  }
  hk_triangle_forward(&factor->triangle, ordered);
}

void hk_factor_backward(const struct hk_factor *factor, const double *ordered, double *all) {
  const int64_t n = factor->system->particle_count;
  memcpy(factor->vector, ordered, (size_t)factor->matrix.size * sizeof(double));
  hk_triangle_backward(&factor->triangle, factor->vector);
  for (int64_t k = 0; k < factor->system->constrained_count; k++) {
    for (int a = 0; a < 3; a++)
      all[a * n + factor->system->constrained_particle[k]] = 0.0;
  }
  for (int64_t k = 0; k < factor->free_count; k++) {
    for (int a = 0; a < 3; a++)
      all[a * n + factor->particle[k]] = factor->vector[3 * k + a];
  }
}
