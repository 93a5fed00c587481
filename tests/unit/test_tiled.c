/* Systems whose springs form a tiled batch, or strided batches if they are listed particle by particle: sums
 * and steps have the bits of the plain order, for any numbering of particles and springs,
 * with the loops of every instruction set. */
#include "agree.h"
#include "check.h"
#include "loops.h"
#include "small.h"
#include "workers.h"
#include "random.h"

#include "model/sum/motion.h"
#include "model/sum/spring_batch.h"
#include "model/sum/tiled.h"

#include <string.h>

/* Sides of sheets; only the springs of a large one are stored by the law that they follow. */
enum { SMALL = 30, LARGE = 220, MOST_PARTICLES = LARGE * LARGE, MOST_SPRINGS = 5 * MOST_PARTICLES };

/* Parameters of a scene: a sheet, in regular or random numbering, divided into groups. */
enum { AS_BUILT, SPRINGS_IN_NO_ORDER, ALL_IN_NO_ORDER };
enum { ONE_LENGTH, LENGTHS, STRAIN, OF_ITS_OWN, MATERIALS };

struct sheet {
  int64_t side, particles, springs, ends[2 * MOST_SPRINGS], number[MOST_PARTICLES];
  double q[3 * MOST_PARTICLES], v[3 * MOST_PARTICLES], mass[MOST_PARTICLES];
  double gravity[3];
};

static void swap(int64_t *a, int64_t *b) {
  const int64_t kept = *a;
  *a = *b;
  *b = kept;
}

/* Every particle with some of its neighbours, and now and then with the same one twice. */
static void join(struct random_source *source, struct sheet *sheet) {
  static const int step[5][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}, {0, 2}};
  sheet->springs = 0;
  for (int64_t p = 0; p < sheet->particles; p++) {
    for (int k = 0; k < 5; k++) {
      const int64_t side = sheet->side, row = p / side + step[k][0], column = p % side + step[k][1];
      if (row >= side || column < 0 || column >= side || random_whole(source, 0, 3) == 0) continue;
      const int64_t other =
          random_whole(source, 0, 60) == 0 ? (p + 1) % sheet->particles : row * side + column;
      const int turned = random_whole(source, 0, 1) == 0;
      int64_t *ends = sheet->ends + 2 * sheet->springs++;
      ends[turned] = sheet->number[p];
      ends[!turned] = sheet->number[other];
    }
  }
}

static void draw_sheet(struct random_source *source, int order, struct sheet *sheet) {
  for (int64_t p = 0; p < sheet->particles; p++)
    sheet->number[p] = p;
  for (int64_t p = sheet->particles - 1; p > 0 && order == ALL_IN_NO_ORDER; p--)
    swap(&sheet->number[p], &sheet->number[random_whole(source, 0, p)]);
  join(source, sheet);
  for (int64_t s = sheet->springs - 1; s > 0 && order != AS_BUILT; s--) {
    const int64_t other = random_whole(source, 0, s);
    swap(&sheet->ends[2 * s], &sheet->ends[2 * other]);
    swap(&sheet->ends[2 * s + 1], &sheet->ends[2 * other + 1]);
  }
  for (int64_t p = 0; p < sheet->particles; p++) {
    double *q = sheet->q + 3 * sheet->number[p];
    q[0] = 0.1 * (double)(p % sheet->side) + random_between(source, 0.0, 0.03);
    q[1] = random_between(source, 0.0, 0.03);
    q[2] = 0.1 * (double)(p / sheet->side) + random_between(source, 0.0, 0.03);
    sheet->mass[p] = random_between(source, 0.5, 2.0);
  }
  for (int64_t k = 0; k < 3 * sheet->particles; k++)
    sheet->v[k] = random_between(source, -1.0, 1.0);
  memcpy(sheet->q + 3 * sheet->number[7], sheet->q + 3 * sheet->number[8], 3 * sizeof(double));
}

static void add_group(struct random_source *source, const struct sheet *sheet, hooke_system *system,
                      int64_t from, int64_t count, int material) {
  owned_options *options = new_options("springs");
  owned_doubles *kappa = new_doubles(count), *gamma = new_doubles(count), *length = new_doubles(count);
  const int pulls = random_whole(source, 0, 3) == 0, damped = random_whole(source, 0, 3) > 0;
  for (int64_t k = 0; k < count; k++) {
    const int own = k == 0 || material == OF_ITS_OWN;
    kappa[k] = own ? random_between(source, 1.0, 100.0) : kappa[0];
    gamma[k] = !damped ? 0.0 : own ? random_between(source, 0.0, 1.0) : gamma[0];
    length[k] = k == 0 || material != ONE_LENGTH ? random_between(source, 0.05, 0.2) : length[0];
  }
  check_ok(hooke_options_set_text(options, "law", material == STRAIN ? "strain" : "length"));
  check_ok(hooke_options_set_numbers(options, "stiffness", count, kappa));
  check_ok(hooke_options_set_numbers(options, "damping", count, gamma));
  check_ok(hooke_options_set_numbers(options, "rest_length", count, length));
  check_ok(hooke_options_set_text(options, "compression", pulls ? "false" : "true"));
  check_ok(hooke_system_add_springs(system, pulls ? "pull" : "push", count, sheet->ends + 2 * from, options));
}

static hooke_system *build(struct random_source *source, struct sheet *sheet, int groups, int material,
                           double *drag) {
  hooke_system *system = new_system();
  const int64_t pinned[] = {3, sheet->particles - 1};
  for (int a = 0; a < 3; a++)
    sheet->v[3 * pinned[0] + a] = sheet->v[3 * pinned[1] + a] = 0.0;
  check_ok(hooke_system_add_particles(system, sheet->particles, sheet->q, sheet->v, sheet->particles,
                                      sheet->mass, NULL));
  check_ok(hooke_system_pin(system, 2, pinned));
  for (int g = 0; g < groups; g++) {
    const int64_t from = g * sheet->springs / groups, to = (g + 1) * sheet->springs / groups;
    add_group(source, sheet, system, from, to - from, material);
  }
  sheet->gravity[1] = random_whole(source, 0, 1) ? -9.81 : 0.0;
  *drag = random_whole(source, 0, 1) ? 0.25 : 0.0;
  check_ok(hooke_system_set_gravity(system, sheet->gravity));
  check_ok(hooke_system_set_drag(system, *drag));
  return committed(system);
}

/* The system returns the given springs, and stores no more than the law needs. */
static void check_material(const hooke_system *system, const struct canonical *c, int groups, int material,
                           int64_t side) {
  const struct hk_tiled *tiled = system->tiled;
  const int of_its_own =
      material == OF_ITS_OWN || groups > HOOKE_TILED_KINDS || (material == STRAIN && side == SMALL);
  assert_int_equal(tiled->kappa != NULL, of_its_own);
  assert_int_equal(tiled->rest_length != NULL, of_its_own || material != ONE_LENGTH);
  assert_in_range(tiled->kinds, 1, of_its_own ? 2 : groups);
  assert_int_equal(system->springs->stored.mixed, 0);
  for (int64_t s = 0; s < c->spring_count; s++)
    assert_true(c->kappa[s] > 0.0 && c->rest_length[s] >= 0.05);
}

static void check_numbering(const struct hk_tiled *tiled, int order) {
  if (order != ALL_IN_NO_ORDER) {
    assert_null(tiled->order);
    return;
  }
  assert_non_null(tiled->order);
  unsigned char *seen = new_block(tiled->particles, 1);
  for (int64_t p = 0; p < tiled->particles; p++) {
    assert_in_range(tiled->order[p], 0, tiled->particles - 1);
    assert_false(seen[tiled->order[p]]++);
  }
  free(seen);
  assert_in_range(tiled->rows, HOOKE_TILE,
                  tiled->particles < 1000 ? 3 * HOOKE_TILE : tiled->particles / 8); /* neighbours are near */
}

/* ---- thread pools ---- */

static void compare(uint64_t seed, int64_t side, int order, int groups, int material) {
  struct random_source source = {seed};
  struct sheet *sheet = new_block(1, (int64_t)sizeof *sheet);
  sheet->side = side;
  sheet->particles = side * side;
  draw_sheet(&source, order, sheet);
  owned_canonical c;
  double drag;
  owned_system *system = build(&source, sheet, groups, material, &drag);
  const int listed = system->strided->count > 0;
  assert_int_equal(system->tiled->particles, listed ? 0 : sheet->particles);
  if (order != AS_BUILT || groups <= 3) assert_int_equal(listed, order == AS_BUILT);
  canonical_create(system, &c);
  c.gravity = sheet->gravity[1] != 0.0 ? sheet->gravity : NULL;
  c.drag = drag;
  if (!listed) {
    check_material(system, &c, groups, material, sheet->side);
    check_numbering(system->tiled, order);
  }
  check_agrees(system, &c, sheet->q, sheet->v);
  if (seed % 3 == 0) check_members(system, sheet->q, sheet->v);
  free(sheet);
}

TEST(test_same_bits) {
  static const int groups[] = {1, 3, 20};
  for (int32_t set = 0; use_loops(set); set++) {
    uint64_t seed = (uint64_t)set;
    for (int order = AS_BUILT; order <= ALL_IN_NO_ORDER; order++) {
      for (int g = 0; g < 3; g++) {
        for (int material = 0; material < MATERIALS; material++) {
          if (++seed % 2) compare(seed, SMALL, order, groups[g], material);
        }
      }
    }
  }
}

TEST(test_same_bits_by_law) {
  compare(101, LARGE, ALL_IN_NO_ORDER, 1, STRAIN);
  compare(102, LARGE, SPRINGS_IN_NO_ORDER, 3, STRAIN);
  compare(104, LARGE, AS_BUILT, 3, STRAIN);
  compare(103, LARGE, ALL_IN_NO_ORDER, 3, LENGTHS);
}

/* So many springs between neighbours that indices into the ring need more than 16 bits. */
TEST(test_wide) {
  enum { CHAIN = 300, EACH = 150, COUNT = (CHAIN - 1) * EACH };
  struct random_source source = {5};
  double q[3 * CHAIN], v[3 * CHAIN], mass[CHAIN];
  owned_wholes *ends = new_block(2 * COUNT, (int64_t)sizeof *ends);
  for (int p = 0; p < CHAIN; p++) {
    mass[p] = random_between(&source, 100.0, 200.0);
    for (int a = 0; a < 3; a++) {
      q[3 * p + a] = (a == 0 ? 0.1 * p : 0.0) + random_between(&source, 0.0, 0.02);
      v[3 * p + a] = random_between(&source, -1.0, 1.0);
    }
  }
  for (int64_t s = 0; s < COUNT; s++) {
    const int64_t low = (s * 7919) % (CHAIN - 1), turned = random_whole(&source, 0, 1);
    ends[2 * s + turned] = low;
    ends[2 * s + 1 - turned] = low + 1;
  }
  for (int32_t set = 0; use_loops(set); set++) {
    owned_system *system = new_system();
    check_ok(hooke_system_add_particles(system, CHAIN, q, v, CHAIN, mass, NULL));
    small_group(system, "springs", "net", COUNT, ends, "stiffness=3 damping=0.01");
    check_ok(hooke_system_commit(system));
    assert_int_equal(system->tiled->particles, CHAIN);
    assert_true(system->tiled->wide);
    owned_canonical c;
    canonical_create(system, &c);
    check_agrees(system, &c, q, v);
  }
}

enum { FEW = 6, PAIRS = FEW * (FEW - 1) / 2 };

/* A spring for every pair of particles, from the last to the first. */
static hooke_system *join_all(const double *q, const double *v, int64_t *ends) {
  int64_t *end = ends;
  for (int64_t p = FEW - 1; p > 0; p--) {
    for (int64_t other = 0; other < p; other++) {
      *end++ = p;
      *end++ = other;
    }
  }
  hooke_system *system = small_system(FEW, q, v, 1.0, 0);
  small_group(system, "springs", "pairs", PAIRS, ends, "stiffness=50 damping=0.1");
  return committed(system);
}

/* All that iterates over the springs of a small system keeps their order. */
TEST(test_small) {
  struct random_source source = {15};
  double q[3 * FEW], v[3 * FEW];
  int64_t ends[2 * PAIRS];
  for (int k = 0; k < 3 * FEW; k++) {
    q[k] = random_between(&source, -1.0, 1.0);
    v[k] = random_between(&source, -1.0, 1.0);
  }
  owned_system *system = join_all(q, v, ends);
  assert_int_equal(system->tiled->particles, FEW);
  owned_canonical c;
  canonical_create(system, &c);
  check_agrees(system, &c, q, v);
  struct hk_spring_batch batch;
  hk_begin_batches(HOOKE_AS_GIVEN, &batch);
  assert_true(hk_next_batch(system, &batch));
  assert_int_equal(batch.count, PAIRS);
  for (int64_t k = 0; k < PAIRS; k++) {
    assert_int_equal(batch.head[k], ends[2 * k]);
    assert_int_equal(batch.tail[k], ends[2 * k + 1]);
    assert_true(batch.kappa[k] == c.kappa[k] && batch.gamma[k] == c.gamma[k]);
  }
}
