#include "integrate/factor.h"

#include "core/memory.h"
#include "integrate/dissection.h"
#include "kernel/front_loops.h"

#include <stdlib.h>
#include <string.h>

/* One part of the order: its own particles, then those of later parts that it is joined to, in `row`. The panel has the
 * factor's columns of its own; what they leave of the rows is handed to the parent. */
struct front {
  int64_t first;
  int32_t own, rows, parent, child, sibling;
  int64_t row;          /* of the first of its rows in the lists */
  int64_t panel;        /* of its first number */
  int64_t rest, at_end; /* places of what it hands on: for the parent, and while it is computed */
};

struct hooke_factor {
  const hooke_system *system;
  struct hooke_dissection order;
  struct front *front;
  int64_t row_count;
  int32_t *row;    /* places in the order, ascending in each front */
  int32_t *local;  /* where the parent has them: its own first, then its rows */
  int64_t *block;  /* of each spring: first number of its block off the diagonal; -1 if an end is held */
  int32_t *height; /* and how far its columns are apart */
  int64_t *triple_block; /* of each triple of bending: those of its pairs 01, 12, 20 */
  int32_t *triple_height;
  int64_t *corner; /* of each place in the order: first number of its block on the diagonal */
  int64_t number_count, rest_count, most_rows, bytes;
  double *number, *rest, *vector;
  double products;
};

/* ---- once ---- */

static int by_number(const void *a, const void *b) {
  const int32_t x = *(const int32_t *)a, y = *(const int32_t *)b;
  return (x > y) - (x < y);
}

/* Appends the rows of front f: neighbours of its own particles, and rows of its children, beyond its own. `mark` tells what
 * is there already. */
static int32_t find_rows(struct hooke_factor *x, int32_t f, const struct hooke_pattern *pattern,
                         int32_t *mark, int64_t *capacity) {
  struct front *front = &x->front[f];
  const int64_t end = front->first + front->own;
  int64_t most = 0;
  for (int64_t k = front->first; k < end; k++) {
    const int32_t p = x->order.particle[k];
    most += pattern->row_start[p + 1] - pattern->row_start[p];
  }
  for (int32_t c = front->child; c >= 0; c = x->front[c].sibling)
    most += x->front[c].rows;
  if (x->row_count + most > *capacity) {
    const int64_t larger = 2 * (x->row_count + most);
    if (hooke_grow((void **)&x->row, x->row_count, larger, sizeof *x->row) != HOOKE_OK)
      return HOOKE_NO_MEMORY;
    *capacity = larger;
  }
  front->row = x->row_count;
  int32_t *row = x->row + front->row;
  for (int64_t k = front->first; k < end; k++) {
    const int32_t p = x->order.particle[k];
    for (int64_t e = pattern->row_start[p]; e < pattern->row_start[p + 1]; e++) {
      const int32_t place = x->order.place[pattern->column[e]];
      if (place < end || mark[place] == f + 1) continue;
      mark[place] = f + 1;
      row[front->rows++] = place;
    }
  }
  for (int32_t c = front->child; c >= 0; c = x->front[c].sibling) {
    for (int32_t k = 0; k < x->front[c].rows; k++) {
      const int32_t place = x->row[x->front[c].row + k];
      if (place < end || mark[place] == f + 1) continue;
      mark[place] = f + 1;
      row[front->rows++] = place;
    }
  }
  qsort(row, (size_t)front->rows, sizeof *row, by_number);
  x->row_count += front->rows;
  return HOOKE_OK;
}

/* Where front f has a place of the order. */
static int32_t local_of(const struct hooke_factor *x, const struct front *front, int32_t place) {
  if (place < front->first + front->own) return (int32_t)(place - front->first);
  const int32_t *row = x->row + front->row;
  const int32_t *found = bsearch(&place, row, (size_t)front->rows, sizeof *row, by_number);
  return front->own + (int32_t)(found - row);
}

static int32_t make_fronts(struct hooke_factor *x, const struct hooke_pattern *pattern) {
  int64_t capacity = 0;
  int32_t *mark = hooke_new(x->order.free_count + 1, sizeof *mark);
  int32_t status = mark ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int32_t f = 0; f < x->order.part_count; f++) {
    const struct hooke_part_of_order *part = &x->order.part[f];
    x->front[f] = (struct front){.first = part->first,
                                 .own = (int32_t)part->count,
                                 .parent = part->parent,
                                 .child = -1,
                                 .sibling = -1};
  }
  for (int32_t f = x->order.part_count - 1; f >= 0; f--) { /* so that the list of children ascends */
    struct front *front = &x->front[f];
    if (front->parent < 0) continue;
    front->sibling = x->front[front->parent].child;
    x->front[front->parent].child = f;
  }
  for (int32_t f = 0; f < x->order.part_count && status == HOOKE_OK; f++)
    status = find_rows(x, f, pattern, mark, &capacity);
  hooke_free(mark);
  return status;
}

static int64_t square(int64_t k) {
  return k * k;
}

/* Places of panels, and of what fronts hand on: a stack, with those of the children of a front on top of it. */
static void place_numbers(struct hooke_factor *x) {
  int64_t top = 0;
  for (int32_t f = 0; f < x->order.part_count; f++) {
    struct front *front = &x->front[f];
    const int64_t height = 3 * ((int64_t)front->own + front->rows), width = 3 * (int64_t)front->own;
    front->panel = x->number_count;
    x->number_count += height * width;
    for (int64_t j = 0; j < width; j++)
      x->products += 0.5 * (double)square(height - j);
    front->at_end = top;
    front->rest = front->child >= 0 ? x->front[front->child].rest : top;
    const int64_t size = square(3 * (int64_t)front->rows);
    if (front->at_end + size > x->rest_count) x->rest_count = front->at_end + size;
    top = front->rest + size;
    if (height > x->most_rows) x->most_rows = height;
  }
}

static int32_t locate_rows(struct hooke_factor *x) {
  x->local = hooke_new(x->row_count, sizeof *x->local);
  if (x->local == NULL) return HOOKE_NO_MEMORY;
  for (int32_t f = 0; f < x->order.part_count; f++) {
    const struct front *front = &x->front[f];
    for (int32_t k = 0; k < front->rows; k++)
      x->local[front->row + k] = local_of(x, &x->front[front->parent], x->row[front->row + k]);
  }
  return HOOKE_OK;
}

/* The first number of the block of two places of the order. */
static int64_t find_block(const struct hooke_factor *x, const int32_t *front_of, int32_t one, int32_t other,
                          int32_t *height) {
  const int32_t row = one > other ? one : other, column = one > other ? other : one;
  const struct front *front = &x->front[front_of[column]];
  *height = 3 * (front->own + front->rows);
  return front->panel + 3 * ((column - front->first) * *height + local_of(x, front, row));
}

static void locate_triples(struct hooke_factor *x, const int32_t *front_of) {
  struct hooke_triple triple;
  int64_t pair = 0;
  for (struct hooke_triples at = {&x->system->bending, 0, 0}; hooke_next_triple(&at, &triple);) {
    for (int e = 0; e < 3; e++, pair++) {
      const int32_t one = x->order.place[triple.particle[e]],
                    other = x->order.place[triple.particle[(e + 1) % 3]];
      x->triple_block[pair] =
          one < 0 || other < 0 ? -1 : find_block(x, front_of, one, other, &x->triple_height[pair]);
    }
  }
}

static int32_t locate_blocks(struct hooke_factor *x) {
  const struct hooke_springs *springs = &x->system->springs;
  const int64_t pairs = 3 * x->system->bending.count;
  int32_t *front_of = hooke_new(x->order.free_count, sizeof *front_of), height;
  x->block = hooke_new(springs->count, sizeof *x->block);
  x->height = hooke_new(springs->count, sizeof *x->height);
  x->corner = hooke_new(x->order.free_count, sizeof *x->corner);
  x->triple_block = hooke_new(pairs, sizeof *x->triple_block);
  x->triple_height = hooke_new(pairs, sizeof *x->triple_height);
  if (front_of == NULL || x->block == NULL || x->height == NULL || x->corner == NULL ||
      x->triple_block == NULL || x->triple_height == NULL) {
    hooke_free(front_of);
    return HOOKE_NO_MEMORY;
  }
  for (int32_t f = 0; f < x->order.part_count; f++) {
    for (int32_t k = 0; k < x->front[f].own; k++)
      front_of[x->front[f].first + k] = f;
  }
  for (int32_t k = 0; k < x->order.free_count; k++)
    x->corner[k] = find_block(x, front_of, k, k, &height);
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hooke_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hooke_spring spring = hooke_run_spring(run, k);
      const int32_t one = x->order.place[spring.head], other = x->order.place[spring.tail];
      const int64_t s = run->first + k;
      x->block[s] = one < 0 || other < 0 ? -1 : find_block(x, front_of, one, other, &x->height[s]);
    }
  }
  locate_triples(x, front_of);
  hooke_free(front_of);
  return HOOKE_OK;
}

static int32_t take_memory(struct hooke_factor *x) {
  x->number = hooke_new(x->number_count, sizeof(double));
  x->rest = hooke_new(x->rest_count, sizeof(double));
  x->vector = hooke_new(x->most_rows, sizeof(double));
  const int64_t doubles = x->number_count + x->rest_count + x->most_rows;
  x->bytes = (int64_t)sizeof *x + doubles * 8 + x->row_count * 8 + x->system->springs.count * 12 +
             x->system->bending.count * 36 + x->order.free_count * 12 + x->system->particle_count * 4 +
             x->order.part_count * (int64_t)sizeof *x->front;
  return x->number && x->rest && x->vector ? HOOKE_OK : HOOKE_NO_MEMORY;
}

int32_t hooke_factor_create(const hooke_system *system, int64_t most, struct hooke_factor **factor) {
  struct hooke_pattern pattern;
  struct hooke_factor *x = hooke_new(1, sizeof *x);
  *factor = NULL;
  if (x == NULL) return HOOKE_NO_MEMORY;
  x->system = system;
  int32_t status = hooke_pattern_create(system, &pattern);
  if (status == HOOKE_OK) {
    status = hooke_dissection_create(system, &pattern, &x->order);
    x->front = hooke_new(x->order.part_count, sizeof *x->front);
    if (x->front == NULL) status = HOOKE_NO_MEMORY;
    if (status == HOOKE_OK) status = make_fronts(x, &pattern);
    hooke_pattern_release(&pattern);
  }
  int fits = 0;
  if (status == HOOKE_OK) {
    place_numbers(x);
    fits = x->number_count + x->rest_count <= most;
  }
  if (fits) status = locate_rows(x);
  if (fits && status == HOOKE_OK) status = locate_blocks(x);
  if (fits && status == HOOKE_OK) status = take_memory(x);
  if (fits && status == HOOKE_OK)
    *factor = x;
  else
    hooke_factor_destroy(x);
  return status;
}

void hooke_factor_destroy(struct hooke_factor *x) {
  if (x == NULL) return;
  hooke_dissection_release(&x->order);
  void *const blocks[] = {x->front,  x->row,  x->local,  x->block,        x->height,       x->corner,
                          x->number, x->rest, x->vector, x->triple_block, x->triple_height};
  for (size_t k = 0; k < sizeof blocks / sizeof blocks[0]; k++)
    hooke_free(blocks[k]);
  hooke_free(x);
}

int64_t hooke_factor_memory(const struct hooke_factor *x) {
  return x->bytes;
}

int64_t hooke_factor_numbers(const struct hooke_factor *x) {
  return x->number_count;
}

double hooke_factor_products(const struct hooke_factor *x) {
  return x->products;
}

/* ---- numbers ---- */

static void add_diagonal(struct hooke_factor *x, const double *diagonal) {
  static const int component[3][3] = {{0, 3, 4}, {3, 1, 5}, {4, 5, 2}};
  const int64_t n = x->system->particle_count;
  for (int32_t f = 0; f < x->order.part_count; f++) {
    const struct front *front = &x->front[f];
    const int64_t height = 3 * ((int64_t)front->own + front->rows);
    for (int64_t k = front->first; k < front->first + front->own; k++) {
      double *to = x->number + x->corner[k];
      for (int a = 0; a < 3; a++) {
        for (int b = a; b < 3; b++)
          to[a * height + b] += diagonal[component[a][b] * n + x->order.particle[k]];
      }
    }
  }
}

static void add_springs(struct hooke_factor *x, const struct hooke_tangent *t) {
  for (int64_t s = 0; s < x->system->springs.count; s++) {
    if (x->block[s] < 0) continue;
    double *to = x->number + x->block[s];
    const double u[3] = {t->u[0][s], t->u[1][s], t->u[2][s]};
    const double across = t->b[s] > 0.0 ? t->b[s] : 0.0;
    const double along = ((t->e[0][s] * u[0] + t->e[1][s] * u[1]) + t->e[2][s] * u[2]) + t->b[s] - across;
    for (int a = 0; a < 3; a++, to += x->height[s]) {
      for (int b = 0; b < 3; b++)
        to[b] -= along * u[a] * u[b] + (a == b ? across : 0.0);
    }
  }
}

static void add_bending(struct hooke_factor *x, double alpha) {
  struct hooke_triple triple;
  int64_t pair = 0;
  for (struct hooke_triples at = {&x->system->bending, 0, 0}; hooke_next_triple(&at, &triple);) {
    for (int e = 0; e < 3; e++, pair++) {
      if (x->triple_block[pair] < 0) continue;
      double *to = x->number + x->triple_block[pair];
      for (int a = 0; a < 3; a++)
        to[a * ((int64_t)x->triple_height[pair] + 1)] +=
            alpha * triple.coefficient * (hooke_triple_factor(e) * hooke_triple_factor((e + 1) % 3));
    }
  }
}

/* Adds what a child hands on to its parent. */
static void add_child(struct hooke_factor *x, const struct front *child, const struct front *front) {
  const int32_t *local = x->local + child->row;
  const int64_t height = 3 * ((int64_t)front->own + front->rows), below = 3 * (int64_t)front->rows,
                from_height = 3 * (int64_t)child->rows;
  for (int32_t b = 0; b < child->rows; b++) {
    const int inside = local[b] < front->own;
    for (int c = 0; c < 3; c++) {
      const double *from = x->rest + child->rest + (3 * b + c) * from_height;
      double *to = inside ? x->number + front->panel + (3 * local[b] + c) * height
                          : x->rest + front->at_end + (3 * (int64_t)(local[b] - front->own) + c) * below -
                                3 * (int64_t)front->own;
      for (int32_t a = b; a < child->rows; a++) {
        for (int d = 0; d < 3; d++)
          to[3 * local[a] + d] += from[3 * a + d];
      }
    }
  }
}

int32_t hooke_factor_compute(struct hooke_factor *x, const double *diagonal,
                             const struct hooke_tangent *tangent, double alpha) {
  memset(x->number, 0, (size_t)x->number_count * sizeof(double));
  add_diagonal(x, diagonal);
  add_springs(x, tangent);
  add_bending(x, alpha);
  for (int32_t f = 0; f < x->order.part_count; f++) {
    const struct front *front = &x->front[f];
    const int64_t below = 3 * (int64_t)front->rows, width = 3 * (int64_t)front->own;
    double *panel = x->number + front->panel, *rest = x->rest + front->at_end;
    memset(rest, 0, (size_t)square(below) * sizeof(double));
    for (int32_t c = front->child; c >= 0; c = x->front[c].sibling)
      add_child(x, &x->front[c], front);
    if (!hooke_front_factorise(width + below, width, panel)) return 0;
    hooke_front_subtract(width + below, width, panel, rest);
    if (front->rest != front->at_end)
      memmove(x->rest + front->rest, rest, (size_t)square(below) * sizeof(double));
  }
  return 1;
}

/* ---- solutions ---- */

void hooke_factor_forward(struct hooke_factor *factor, double *x) {
  double *some = factor->vector;
  for (int32_t f = 0; f < factor->order.part_count; f++) {
    const struct front *front = &factor->front[f];
    const int64_t own = 3 * (int64_t)front->own, rows = 3 * (int64_t)front->rows;
    const int32_t *row = factor->row + front->row;
    double *first = x + 3 * front->first;
    memcpy(some, first, (size_t)own * sizeof(double));
    memset(some + own, 0, (size_t)rows * sizeof(double));
    hooke_front_forward(own + rows, own, factor->number + front->panel, some);
    memcpy(first, some, (size_t)own * sizeof(double));
    for (int32_t k = 0; k < front->rows; k++) {
      for (int a = 0; a < 3; a++)
        x[3 * (int64_t)row[k] + a] += some[own + 3 * k + a];
    }
  }
}

void hooke_factor_backward(struct hooke_factor *factor, double *x) {
  double *some = factor->vector;
  for (int32_t f = factor->order.part_count - 1; f >= 0; f--) {
    const struct front *front = &factor->front[f];
    const int64_t own = 3 * (int64_t)front->own;
    const int32_t *row = factor->row + front->row;
    double *first = x + 3 * front->first;
    memcpy(some, first, (size_t)own * sizeof(double));
    for (int32_t k = 0; k < front->rows; k++)
      memcpy(some + own + 3 * k, x + 3 * (int64_t)row[k], 3 * sizeof(double));
    hooke_front_backward(own + 3 * (int64_t)front->rows, own, factor->number + front->panel, some);
    memcpy(first, some, (size_t)own * sizeof(double));
  }
}

void hooke_factor_gather(const struct hooke_factor *factor, const double *all, double *ordered) {
  const int64_t n = factor->system->particle_count;
  for (int64_t k = 0; k < factor->order.free_count; k++) {
    for (int a = 0; a < 3; a++)
      ordered[3 * k + a] = all[a * n + factor->order.particle[k]];
  }
}

void hooke_factor_spread(const struct hooke_factor *factor, const double *ordered, double *all) {
  const int64_t n = factor->system->particle_count;
  for (int64_t k = 0; k < factor->system->held_count; k++) {
    for (int a = 0; a < 3; a++)
      all[a * n + factor->system->held_particle[k]] = 0.0;
  }
  for (int64_t k = 0; k < factor->order.free_count; k++) {
    for (int a = 0; a < 3; a++)
      all[a * n + factor->order.particle[k]] = ordered[3 * k + a];
  }
}
