/* Particles and springs are numbered by 32 bits, and offsets in memory are not: the loops give the same bits
 * as for small numbers where particle, byte and triple of coordinates pass 2^31 and 2^32, up to the last
 * possible particle. Only a window of arrays this long is mapped; an access outside ends the test. */
#define _DEFAULT_SOURCE
#include "check.h"
#include "random.h"

#include "kernel/altitude_loops.h"
#include "kernel/spring/spring_loops.h"
#include "kernel/spring/tangent_loops.h"

#include <math.h>
#include <string.h>
#include <sys/mman.h>

enum {
  WINDOW = 1024,
  BESIDE = 512,
  COUNT = 300,
  FIELDS = 9,
  BLOCKS = 6,
  TANGENT = 7,
  ARRAYS = FIELDS + BLOCKS + TANGENT
};
static const int64_t MOST = INT32_MAX; /* particles, numbered from 0; springs likewise */

/* Windows end before these; the last at the end of all numbers, the others reach past theirs. */
static const int64_t edges[] = {(INT64_C(1) << 28) + BESIDE, (INT64_C(1) << 29) + BESIDE, MOST / 3 + BESIDE,
                                (INT64_C(1) << 30) + BESIDE, 2 * (MOST / 3) + BESIDE,     MOST};
enum { EDGES = sizeof edges / sizeof edges[0] };

/* Arrays of MOST doubles, of which numbers low .. low + WINDOW - 1 are mapped, with unmapped pages on either
 * side. */
struct world {
  char *reserved[ARRAYS];
  double *array[ARRAYS];
  int64_t low;
};

enum { PAGE = 65536, NOTHING = 16 * PAGE, LENGTH = 2 * NOTHING + PAGE };

static void open_world(int64_t low, struct world *world) {
  *world = (struct world){.low = low};
  for (int k = 0; k < ARRAYS; k++) {
    char *at = mmap(NULL, LENGTH, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    assert_true(at != MAP_FAILED);
    assert_int_equal(mprotect(at + NOTHING, PAGE, PROT_READ | PROT_WRITE), 0);
    world->reserved[k] = at;
    /* the window ends with the page */
    const uintptr_t window = (uintptr_t)(at + NOTHING + PAGE) - WINDOW * sizeof(double);
    world->array[k] = (double *)(window - (uintptr_t)low * sizeof(double));
  }
}

static void close_world(struct world *world) {
  for (int k = 0; k < ARRAYS; k++)
    munmap(world->reserved[k], LENGTH);
}

/* ---- springs, triples and tetrahedra, numbered within the window ---- */

struct draw {
  double fields[FIELDS][WINDOW];
  int32_t ends[4][COUNT];
  double kappas[COUNT], gammas[COUNT], rest_lengths[COUNT];
};
static struct draw drawn;

static void draw(struct draw *d) {
  struct random_source source = {17};
  for (int k = 0; k < FIELDS; k++) {
    for (int p = 0; p < WINDOW; p++)
      d->fields[k][p] = random_between(&source, -1.0, 1.0);
  }
  for (int k = 0; k < COUNT; k++) {
    const int32_t first = k == 0 ? WINDOW - 1 : (int32_t)random_whole(&source, 0, WINDOW - 1);
    for (int e = 0; e < 4; e++) /* four that differ */
      d->ends[e][k] = (int32_t)((first + e * random_whole(&source, 1, WINDOW / 4 - 1)) % WINDOW);
    d->kappas[k] = random_between(&source, 1.0, 100.0);
    d->gammas[k] = random_between(&source, 0.1, 10.0);
    d->rest_lengths[k] = random_between(&source, 0.1, 2.0);
  }
}

static void fill(struct world *world, int64_t first_spring) {
  for (int k = 0; k < FIELDS; k++)
    memcpy(world->array[k] + world->low, drawn.fields[k], sizeof drawn.fields[k]);
  for (int k = 0; k < BLOCKS; k++)
    memset(world->array[FIELDS + k] + world->low, 0, WINDOW * sizeof(double));
  for (int k = 0; k < TANGENT; k++)
    memset(world->array[FIELDS + BLOCKS + k] + first_spring, 0, COUNT * sizeof(double));
}

static void shift(int64_t low, int64_t count, const int32_t *from, int32_t *to) {
  for (int64_t k = 0; k < count; k++)
    to[k] = (int32_t)(low + from[k]);
}

static struct hk_fields fields_of(const struct world *world) {
  double *const *a = world->array;
  return (struct hk_fields){{a[0], a[1], a[2]}, {a[3], a[4], a[5]}, {a[6], a[7], a[8]}};
}

/* ---- results of the loops ---- */

/* Forces, and all products of a tangent, of a run whose springs have the last numbers of the window. */
static void add_springs(struct world *world, const struct hk_spring_set *set, int32_t shape, int32_t offset) {
  int32_t head[COUNT], tail[COUNT];
  const int64_t first_spring = world->low + WINDOW - COUNT;
  fill(world, first_spring);
  shift(world->low, COUNT, drawn.ends[0], head);
  shift(world->low, COUNT, drawn.ends[1], tail);
  const int64_t start = world->low + WINDOW - COUNT - (offset > 0 ? offset : 0);
  const struct hk_run run = {.first = first_spring,
                             .count = COUNT,
                             .shape = shape,
                             .start = (int32_t)start,
                             .offset = offset,
                             .head = head,
                             .tail = tail,
                             .kappa = 20.0,
                             .gamma = 0.5,
                             .rest_length = 0.7,
                             .kappas = drawn.kappas,
                             .gammas = drawn.gammas,
                             .rest_lengths = drawn.rest_lengths};
  const struct hk_fields fields = fields_of(world);
  double *const *t = world->array + FIELDS + BLOCKS;
  const struct hk_tangent tangent = {{t[0], t[1], t[2]}, {t[3], t[4], t[5]}, t[6]};
  set->loop[shape](&run, &fields);
  set->tangent->tangent_fill(&run, &fields, 0.3, 0.2, &tangent);
  set->tangent->tangent_product(&run, &tangent, fields.v, fields.f);
  set->tangent->tangent_damping(&run, &tangent, fields.v, fields.f);
  set->tangent->tangent_diagonal(&run, &tangent, world->array + FIELDS);
}

static void add_triples(struct world *world, const struct hk_spring_set *set, int32_t shape) {
  int32_t particle[3][COUNT];
  fill(world, world->low);
  for (int e = 0; e < 3; e++)
    shift(world->low, COUNT, drawn.ends[e], particle[e]);
  const struct hk_bending_run run = {.first = world->low,
                                     .count = COUNT,
                                     .shape = shape,
                                     .start = (int32_t)(world->low + WINDOW - COUNT - 14),
                                     .offset = 7,
                                     .particle = {particle[0], particle[1], particle[2]},
                                     .coefficient = 3.0,
                                     .coefficients = drawn.kappas};
  const struct hk_fields fields = fields_of(world);
  set->bending(&run, 0.9, fields.q, fields.f);
}

static void add_tetrahedra(struct world *world, const struct hk_spring_set *set) {
  struct hk_tetrahedron tetrahedra[COUNT];
  fill(world, world->low);
  for (int k = 0; k < COUNT; k++) {
    tetrahedra[k] = (struct hk_tetrahedron){
        .choice = HOOKE_ALTITUDE_SHORTEST, .side = 1.0, .stiffness = 5.0, .damping = 0.1};
    for (int e = 0; e < 4; e++)
      shift(world->low, 1, &drawn.ends[e][k], &tetrahedra[k].particle[e]);
    for (int a = 0; a < HOOKE_ALTITUDES; a++)
      tetrahedra[k].rest[a] = drawn.rest_lengths[k];
  }
  const struct hk_fields fields = fields_of(world);
  set->tetrahedra(COUNT, tetrahedra, fields.q, fields.v, fields.f);
}

/* ---- the same at small numbers ---- */

/* Also checks that the last particles have forces, except for springs that only pull, not all of which are
 * taut. */
static void check_same(const struct world *found, const struct world *expected, int32_t last) {
  double force = 0.0;
  for (int k = 0; k < ARRAYS; k++) {
    check_same_bits(WINDOW, found->array[k] + found->low, expected->array[k] + expected->low);
    for (int p = WINDOW - last; p < WINDOW && k >= 6 && k < FIELDS; p++)
      force += fabs(found->array[k][found->low + p] - drawn.fields[k][p]);
  }
  assert_true(force > 0.0);
}

static void at_edge(struct world *found, struct world *expected) {
  const struct hk_spring_set *set;
  for (int32_t s = 0; (set = hk_spring_set(s)) != NULL; s++) {
    for (int32_t shape = 0; shape < HOOKE_RUN_SHAPES; shape++) {
      for (int32_t offset = -5; offset <= 200; offset += 205) {
        const int indexed = shape & HOOKE_RUN_INDEXED;
        add_springs(found, set, shape, indexed ? 0 : offset);
        add_springs(expected, set, shape, indexed ? 0 : offset);
        check_same(found, expected, shape & HOOKE_RUN_PULL_ONLY ? 100 : 1);
      }
    }
    for (int32_t shape = 0; shape < HOOKE_BENDING_SHAPES; shape++) {
      add_triples(found, set, shape);
      add_triples(expected, set, shape);
      check_same(found, expected, 1);
    }
    add_tetrahedra(found, set);
    add_tetrahedra(expected, set);
    check_same(found, expected, 1);
  }
}

TEST(large_numbers_are_as_small_ones) {
  draw(&drawn);
  struct world expected, found;
  open_world(0, &expected);
  for (int k = 0; k < EDGES; k++) {
    open_world(edges[k] - WINDOW, &found);
    at_edge(&found, &expected);
    close_world(&found);
  }
  close_world(&expected);
}
