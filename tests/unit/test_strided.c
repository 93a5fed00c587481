/* Systems whose springs form strided batches: sums and steps have the bits of the plain order, for any
 * batches, with the loops of every instruction set. */
#include "agree.h"
#include "canonical.h"
#include "check.h"
#include "loops.h"
#include "small.h"
#include "workers.h"
#include "random.h"

#include "model/system.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { PARTICLES = 1500, MOST_STRETCH = 700 };

/* One group: stretches of springs of one offset whose lower ends ascend, with gaps between them. */
static void add_group(struct random_source *source, hooke_system *system, int64_t particles, int group,
                      int sparse) {
  const int mixed = random_whole(source, 0, 3) == 0, damped = random_whole(source, 0, 1) == 0;
  const int pulls = random_whole(source, 0, 3) == 0, turned = random_whole(source, 0, 1) == 0;
  const int64_t offset = random_whole(source, 1, random_whole(source, 0, 1) ? 3 : particles / 4);
  int64_t *ends = malloc((size_t)(2 * particles) * sizeof *ends), count = 0;
  owned_doubles *kappa = new_doubles(particles), *gamma = new_doubles(particles),
                *rest = new_doubles(particles);
  for (int64_t l = random_whole(source, 0, 20); l + 8 + offset < particles;
       l += sparse ? 90 : random_whole(source, 1, random_whole(source, 0, 1) ? 12 : 300)) {
    const int64_t most = !sparse      ? MOST_STRETCH
                         : count == 0 ? particles / 5
                                      : 20; /* a run of two blocks, too */
    const int64_t length = random_whole(source, 8, most < 8 ? 8 : most);
    for (int64_t k = 0; k < length && l + offset < particles; k++, l++, count++) {
      ends[2 * count] = turned ? l + offset : l;
      ends[2 * count + 1] = turned ? l : l + offset;
    }
  }
  for (int64_t k = 0; k < count; k++) {
    kappa[k] = k == 0 || mixed ? random_between(source, 1.0, 100.0) : kappa[0];
    gamma[k] = !damped ? 0.0 : k == 0 || mixed ? random_between(source, 0.0, 1.0) : gamma[0];
    rest[k] = k == 0 || mixed ? random_between(source, 0.0, 2.0) : rest[0];
  }
  char name[32];
  snprintf(name, sizeof name, "%s%d", pulls ? "pull" : "push", group);
  owned_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", count, kappa));
  check_ok(hooke_options_set_numbers(options, "damping", count, gamma));
  check_ok(hooke_options_set_numbers(options, "rest_length", count, rest));
  check_ok(hooke_options_set_text(options, "compression", pulls ? "false" : "true"));
  check_ok(hooke_system_add_springs(system, name, count, ends, options));
  free(ends);
}

/* Triples of two offsets or of one, in stretches that ascend or go back, with a coefficient each or one. */
static void add_bends(struct random_source *source, hooke_system *system, int64_t particles) {
  const int64_t offset[2] = {random_whole(source, 1, 3), random_whole(source, 1, particles / 8)};
  int64_t *triples = malloc((size_t)(6 * particles) * sizeof *triples), count = 0;
  owned_doubles *coefficient = new_doubles(2 * particles);
  const int own = random_whole(source, 0, 1) == 0, back = random_whole(source, 0, 3) == 0;
  for (int64_t l = random_whole(source, 0, 20), d = 0; d < 2; l = back ? l / 2 : 0, d++) {
    for (; l + 2 * offset[d] < particles; l += random_whole(source, 0, 9) ? 1 : 9, count++) {
      for (int64_t e = 0; e < 3; e++)
        triples[3 * count + e] = l + e * offset[d];
      coefficient[count] = own || count == 0 ? random_between(source, 1.0, 9.0) : coefficient[0];
    }
  }
  check_ok(hooke_system_add_bending(system, "bends", count, triples, count, coefficient));
  free(triples);
}

static hooke_system *build(struct random_source *source, int64_t particles, int groups, int sparse, double *q,
                           double *v, double *gravity, double *drag) {
  hooke_system *system = new_system();
  for (int64_t p = 0; p < particles; p++) {
    const int copy = p > 0 && random_whole(source, 0, 30) == 0; /* coincides with its neighbour */
    for (int a = 0; a < 3; a++) {
      q[3 * p + a] = copy ? q[3 * p + a - 3] : random_between(source, -1.0, 1.0);
      v[3 * p + a] = random_between(source, -1.0, 1.0);
    }
  }
  double *mass = new_doubles(particles);
  for (int64_t p = 0; p < particles; p++)
    mass[p] = random_between(source, 0.5, 2.0);
  const int64_t pinned[] = {3, particles - 1};
  for (int a = 0; a < 3; a++)
    v[3 * pinned[0] + a] = v[3 * pinned[1] + a] = 0.0;
  check_ok(hooke_system_add_particles(system, particles, q, v, particles, mass, NULL));
  check_ok(hooke_system_pin(system, 2, pinned));
  for (int g = 0; g < groups; g++)
    add_group(source, system, particles, g, sparse);
  if (groups % 2) add_bends(source, system, particles);
  gravity[1] = random_whole(source, 0, 1) ? -9.81 : 0.0;
  check_ok(hooke_system_set_gravity(system, gravity));
  *drag = random_whole(source, 0, 1) ? 0.25 : 0.0;
  check_ok(hooke_system_set_drag(system, *drag));
  check_ok(hooke_system_commit(system));
  free(mass);
  return system;
}

static void compare(uint64_t seed, int *in_strided, int *most, int *bent) {
  struct random_source source = {seed};
  const int64_t particles = random_whole(&source, 70, PARTICLES);
  double *q = new_doubles(3 * particles), *v = new_doubles(3 * particles), gravity[3] = {0.0, 0.0, 0.0}, drag;
  hooke_system *system =
      build(&source, particles, (int)random_whole(&source, 1, 9), seed % 5 == 0, q, v, gravity, &drag);
  *in_strided += system->strided->count > 0;
  *bent += system->strided->bent > 0;
  if (system->strided->count > *most) *most = system->strided->count;
  owned_canonical c;
  canonical_create(system, &c);
  c.gravity = gravity[1] != 0.0 ? gravity : NULL;
  c.drag = drag;
  check_agrees(system, &c, q, v);
  if (system->strided->count > 0 && seed % 4 == 0) check_members(system, q, v);
  hooke_system_destroy(system);
  free(q);
  free(v);
}

TEST(test_same_bits) {
  for (int32_t set = 0; use_loops(set); set++) {
    int in_strided = 0, most = 0, bent = 0;
    for (uint64_t seed = 1; seed <= 200; seed++)
      compare(seed, &in_strided, &most, &bent);
    assert_in_range(in_strided, 150, 170); /* sparse ones go by runs */
    assert_true(most > 6);                 /* more than are summed at once */
    assert_in_range(bent, 60, in_strided);
  }
}

/* What is infinite at one rope stays there: springs and triples that are not between ropes have no force. */
TEST(test_absent_of_infinite) {
  enum { LONG = 45, TWO = 2 * LONG };
  owned_doubles *f = new_doubles(3 * TWO), *q = new_doubles(3 * TWO), *v = new_doubles(3 * TWO);
  for (int p = 0; p < TWO; p++)
    q[3 * p] = 0.1 * p + 0.01 * (p % 3);
  owned_system *system = small_system(TWO, q, NULL, 1.0, 0);
  for (int64_t rope = 0; rope < 2; rope++) {
    int64_t ends[2 * LONG], triples[3 * LONG];
    for (int64_t k = 0; k < 3 * LONG; k++) {
      triples[k] = rope * LONG + k / 3 + k % 3;
      if (k < 2 * LONG) ends[k] = rope * LONG + k / 2 + k % 2;
    }
    small_group(system, "springs", NULL, LONG - 1, ends, "stiffness=10");
    check_ok(hooke_system_add_bending(system, NULL, LONG - 2, triples, 1, (double[]){2.0}));
  }
  check_ok(hooke_system_commit(system));
  assert_int_equal(system->strided->bent, 1);
  for (int32_t set = 0; use_loops(set); set++) {
    for (int p = LONG - 2; p <= LONG; p += 2) {
      const double kept = q[3 * p];
      q[3 * p] = INFINITY;
      check_ok(hooke_system_force(system, 0.0, q, v, f));
      q[3 * p] = kept;
      for (int k = 0; k < 3 * TWO; k++)
        assert_int_equal(!(fabs(f[k]) < INFINITY) && (k / 3 < LONG) != (p < LONG), 0);
      assert_false(fabs(f[3 * p]) < INFINITY);
    }
  }
}

static int64_t spring_count(const hooke_system *system, int32_t k) {
  int64_t count = 0;
  for (int64_t p = 0; p < system->particle_count; p++)
    count += system->strided->batch[k].present[p / HOOKE_STRIDED_UNIT] >> p % HOOKE_STRIDED_UNIT & 1;
  return count;
}

/* Parallel ropes are two strided batches, not two a rope; springs of the same offset that follow later are a
 * third. */
TEST(test_lanes_of_ropes) {
  double q[3 * 90];
  int64_t ends[2 * 29];
  const double stiffness = 10.0, mass = 1.0;
  for (int p = 0; p < 90; p++)
    q[3 * p] = 0.1 * p, q[3 * p + 1] = 0.01 * (p % 7), q[3 * p + 2] = 0.0;
  owned_system *system = small_system(90, q, NULL, mass, 0);
  hooke_options *options = new_options("springs");
  check_ok(hooke_options_set_numbers(options, "stiffness", 1, &stiffness));
  for (int group = 0; group < 7; group++) {
    const int rope = group / 2 % 3, offset = group % 2 + 1;
    for (int k = 0; k < 30 - offset; k++)
      ends[2 * k] = 30 * rope + k, ends[2 * k + 1] = 30 * rope + k + offset;
    check_ok(hooke_system_add_springs(system, NULL, 30 - offset, ends, options));
  }
  hooke_options_destroy(options);
  check_ok(hooke_system_commit(system));
  assert_int_equal(system->strided->count, 3);
  assert_int_equal(spring_count(system, 0), 3 * 29);
  assert_int_equal(spring_count(system, 1), 3 * 28);
  assert_int_equal(spring_count(system, 2), 29);
}

/* Ropes of one material are a strided batch that reads no parameters, those of several one that does. */
static void check_materials(int ropes, int materials, int32_t shape) {
  double *q = new_doubles(3 * 30 * ropes), mass = 1.0;
  int64_t ends[2 * 29];
  for (int p = 0; p < 30 * ropes; p++)
    q[3 * p] = 0.1 * p, q[3 * p + 1] = 0.01 * (p % 7);
  owned_system *system = small_system(30 * ropes, q, NULL, mass, 0);
  hooke_options *options = options_with("springs", "rest_length=0.09");
  for (int rope = 0; rope < ropes; rope++) {
    for (int k = 0; k < 29; k++)
      ends[2 * k] = 30 * rope + k, ends[2 * k + 1] = 30 * rope + k + 1;
    check_ok(hooke_options_set_number(options, "stiffness", 10.0 + rope % materials));
    check_ok(hooke_options_set_number(options, "damping", rope % materials == 1 ? 0.1 : 0.0));
    check_ok(hooke_system_add_springs(system, NULL, 29, ends, options));
  }
  hooke_options_destroy(options);
  check_ok(hooke_system_commit(system));
  assert_int_equal(system->strided->count, 1);
  assert_int_equal(system->strided->batch[0].shape, shape);
  struct canonical c;
  owned_doubles *v = new_doubles(3 * 30 * ropes);
  canonical_create(system, &c);
  check_agrees(system, &c, q, v);
  canonical_destroy(&c);
  free(q);
}

TEST(test_lanes_of_materials) {
  check_materials(30, 1, 0);
  check_materials(30, 30, HOOKE_RUN_MIXED | HOOKE_RUN_DAMPED);
  check_materials(60, 2, HOOKE_RUN_MIXED | HOOKE_RUN_DAMPED);
}

/* ---- springs listed particle by particle ---- */

enum { SIDE = 13, MOST_SHEETS = 5, STEPS = 6, MOST_LISTED = MOST_SHEETS * SIDE * SIDE };

/* Order of the springs of a particle: the same everywhere, reversed at one particle, or random. */
enum order { SAME, ONE_OPPOSITE, RANDOM };
enum { AT_REST, STIFFNESS_OF_ITS_OWN, ALL_OF_ITS_OWN, LISTED_MATERIALS };

struct listing {
  int sheets, material, holes;
  enum order order;
};

static void order_steps(struct random_source *source, enum order order, int64_t p, int step[STEPS]) {
  for (int k = 0; k < STEPS; k++) {
    const int64_t other = order == RANDOM ? random_whole(source, 0, k) : k;
    step[k] = step[other];
    step[other] = k;
  }
  for (int k = 0; k < STEPS && order == ONE_OPPOSITE && p == 3 * SIDE + 5; k++)
    step[k] = STEPS - 1 - k;
}

static int64_t list(struct random_source *source, const struct listing *listing, int64_t *ends) {
  static const int step[STEPS][2] = {{0, 1}, {1, 0}, {1, 1}, {1, -1}, {0, 2}, {2, 0}};
  int64_t count = 0;
  for (int64_t p = 0; p < listing->sheets * SIDE * SIDE; p++) {
    const int64_t in_sheet = p % (SIDE * SIDE);
    int order[STEPS];
    order_steps(source, listing->order, p, order);
    for (int k = 0; k < STEPS; k++) {
      const int64_t row = in_sheet / SIDE + step[order[k]][0], column = in_sheet % SIDE + step[order[k]][1];
      if (row >= SIDE || column < 0 || column >= SIDE) continue;
      if (listing->holes && random_whole(source, 0, 4) == 0) continue;
      const int64_t turned = random_whole(source, 0, 1);
      ends[2 * count + turned] = p;
      ends[2 * count++ + 1 - turned] = p - in_sheet + row * SIDE + column;
    }
  }
  return count;
}

/* Random numbers up to `most`, or `most`. */
static void set_each(struct random_source *source, hooke_options *options, const char *name, int64_t count,
                     double most, int own) {
  owned_doubles *value = new_doubles(count);
  for (int64_t k = 0; k < count; k++)
    value[k] = own ? random_between(source, 0.1, 1.0) * most : most;
  check_ok(hooke_options_set_numbers(options, name, own ? count : 1, value));
}

/* Rest lengths of flat sheets are those of rounded positions. */
static hooke_system *build_listed(struct random_source *source, const struct listing *listing, double *q,
                                  double *v) {
  static int64_t ends[2 * STEPS * MOST_LISTED];
  const int64_t particles = listing->sheets * SIDE * SIDE, count = list(source, listing, ends);
  for (int64_t p = 0; p < particles; p++) {
    q[3 * p] = (double)(p % SIDE) / 7.0;
    q[3 * p + 1] = 0.0;
    q[3 * p + 2] = (double)(p / SIDE) / 7.0;
    for (int a = 0; a < 3; a++)
      v[3 * p + a] = random_between(source, -1.0, 1.0);
  }
  hooke_system *system = small_system(particles, q, v, 1.0, 0);
  hooke_options *options = new_options("springs");
  set_each(source, options, "stiffness", count, 80.0, listing->material >= STIFFNESS_OF_ITS_OWN);
  set_each(source, options, "damping", count, 0.1, listing->material == ALL_OF_ITS_OWN);
  check_ok(hooke_system_add_springs(system, NULL, count, ends, options));
  hooke_options_destroy(options);
  check_ok(hooke_system_commit(system));
  return system;
}

/* As many strided batches as there are offsets, and another one where one particle has its springs in another
 * order; springs in random order form no strided batches. */
static void check_listing(uint64_t seed, struct listing listing) {
  struct random_source source = {seed};
  owned_doubles *q = new_doubles(3 * MOST_LISTED), *v = new_doubles(3 * MOST_LISTED);
  owned_system *system = build_listed(&source, &listing, q, v);
  const int32_t strided = system->strided->count;
  if (listing.order == SAME) assert_int_equal(strided, STEPS);
  if (listing.order == ONE_OPPOSITE) assert_in_range(strided, STEPS + 1, 2 * STEPS);
  if (listing.order == RANDOM) assert_int_equal(strided, 0);
  struct canonical c;
  canonical_create(system, &c);
  check_agrees(system, &c, q, v);
  check_members(system, q, v);
  canonical_destroy(&c);
}

TEST(test_listed_by_particle) {
  uint64_t seed = 0;
  for (int sheets = 1; sheets <= MOST_SHEETS; sheets += 2) {
    for (int material = 0; material < LISTED_MATERIALS; material++) {
      for (int holes = 0; holes <= 1; holes++) {
        check_listing(++seed, (struct listing){sheets, material, holes, SAME});
        check_listing(++seed, (struct listing){sheets, material, 0, ONE_OPPOSITE});
        check_listing(++seed, (struct listing){sheets, material, holes, RANDOM});
      }
    }
  }
}

/* A chain whose springs to the second next particles come first, and then every second one to the next: in a
 * single strided batch ends would have to precede beginnings at one particle, and follow them at another. */
TEST(test_every_second_first) {
  enum { CHAIN = 150 };
  double q[3 * CHAIN] = {0.0}, v[3 * CHAIN];
  int64_t ends[4 * CHAIN], count = 0;
  struct random_source source = {31};
  for (int k = 0; k < 3 * CHAIN; k++) {
    q[k] = random_between(&source, 0.0, 0.1) + (k % 3 ? 0.0 : 0.1 * (k / 3.0));
    v[k] = random_between(&source, -1.0, 1.0);
  }
  for (; count + 2 < CHAIN; count++)
    ends[2 * count] = count, ends[2 * count + 1] = count + 2;
  for (int64_t odd = 0; odd < 2; odd++) {
    for (int64_t p = odd; p + 1 < CHAIN; p += 2, count++)
      ends[2 * count] = p, ends[2 * count + 1] = p + 1;
  }
  owned_system *system = small_system(CHAIN, q, v, 1.0, 0);
  small_group(system, "springs", NULL, count, ends, "stiffness=10 rest_length=0.09");
  check_ok(hooke_system_commit(system));
  assert_int_equal(system->strided->count, 3);
  struct canonical c;
  canonical_create(system, &c);
  check_agrees(system, &c, q, v);
  canonical_destroy(&c);
}

/* Rest lengths of rounded positions take a fraction of 24 bytes a spring, and are equal to the bit. */
TEST(test_rounded_lengths) {
  enum { EDGE = 24, EACH = EDGE * EDGE * EDGE };
  owned_doubles *q = new_doubles(3 * EACH), *length = new_doubles(3 * EACH);
  int64_t *ends = new_block(6 * EACH, (int64_t)sizeof *ends), count = 0;
  for (int64_t p = 0; p < EACH; p++) {
    const int64_t at[3] = {p % EDGE, p / EDGE % EDGE, p / EDGE / EDGE}, next[3] = {1, EDGE, EDGE * EDGE};
    for (int a = 0; a < 3; a++) {
      q[3 * p + a] = (double)at[a] / (EDGE - 1.0);
      if (at[a] + 1 == EDGE) continue;
      ends[2 * count] = p;
      ends[2 * count++ + 1] = p + next[a];
    }
  }
  owned_system *system = small_system(EACH, q, NULL, 1.0, 0);
  small_group(system, "springs", NULL, count, ends, "stiffness=10");
  check_ok(hooke_system_commit(system));
  assert_int_equal(system->strided->count, 3);
  assert_true(system->strided->batch[0].shape & HOOKE_RUN_MIXED);
  assert_in_range(system->strided->memory, 1, 4 * count);
  check_ok(hooke_system_members(system, "springs", NULL, NULL, NULL, length));
  for (int64_t s = 0; s < count; s++) {
    const double *a = q + 3 * ends[2 * s], *b = q + 3 * ends[2 * s + 1];
    const double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2], r = sqrt((x * x + y * y) + z * z);
    check_same_bits(1, &length[s], &r);
  }
  free(ends);
}

/* Springs of a long sheet with holes, of one material but for their rest lengths, none of which is another's.
 * Stiffness and rest lengths are the same for any `scale`, a power of two: stored without it, and scaled. */
static hooke_system *build_own_lengths(int64_t particles, int64_t width, const double *q, const double *v,
                                       double scale) {
  struct random_source source = {91};
  int64_t *ends = new_block(4 * particles, (int64_t)sizeof *ends), count = 0;
  owned_doubles *rest = new_doubles(2 * particles);
  for (int64_t p = 0; p < particles; p++) {
    for (int k = 0; k < 2; k++) {
      const int64_t other = p + (k ? width : 1);
      if (other >= particles - 3 || p < 20 || random_whole(&source, 0, 9) == 0) continue;
      ends[2 * count] = p, ends[2 * count + 1] = other;
      rest[count++] = random_between(&source, 0.1, 1.0) / scale;
    }
  }
  hooke_system *system = small_system(particles, q, v, 1.0, 0);
  owned_options *options = options_with("springs", "law=length damping=0.1");
  check_ok(hooke_options_set_number(options, "stiffness", 80.0 / scale));
  check_ok(hooke_options_set_numbers(options, "rest_length", count, rest));
  static const char *const what[] = {"stiffness_scale", "rest_scale"};
  for (int k = 0; k < 2 && scale != 1.0; k++) {
    char name[32];
    snprintf(name, sizeof name, "%s.motion", what[k]);
    check_ok(hooke_options_set_text(options, name, "table"));
    snprintf(name, sizeof name, "%s.time", what[k]);
    check_ok(hooke_options_set_numbers(options, name, 2, (double[]){-1.0, 1.0}));
    snprintf(name, sizeof name, "%s.value", what[k]);
    check_ok(hooke_options_set_numbers(options, name, 2, (double[]){scale, scale}));
  }
  check_ok(hooke_system_add_springs(system, NULL, count, ends, options));
  check_ok(hooke_system_commit(system));
  free(ends);
  assert_int_equal(system->strided->count, 2);
  assert_true(system->strided->material[0].lean && system->strided->material[1].lean);
  owned_doubles *stored = new_doubles(3 * count), *given = new_doubles(3 * count);
  for (int64_t k = 0; k < count; k++) {
    given[k] = 80.0 / scale;
    given[count + k] = 0.1;
    given[2 * count + k] = rest[k];
  }
  check_ok(hooke_system_members(system, "springs", NULL, stored, stored + count, stored + 2 * count));
  check_same_bits(3 * count, stored, given);
  return system;
}

TEST(test_rest_lengths_of_their_own) {
  enum { WIDTH = 77, EACH = 7003 };
  struct random_source source = {92};
  owned_doubles *q = new_doubles(3 * EACH), *v = new_doubles(3 * EACH), *f = new_doubles(3 * EACH),
                *g = new_doubles(3 * EACH);
  for (int64_t k = 0; k < 3 * EACH; k++) {
    q[k] = random_between(&source, 0.0, 3.0);
    v[k] = random_between(&source, -1.0, 1.0);
  }
  for (int32_t set = 0; use_loops(set); set++) {
    owned_system *system = build_own_lengths(EACH, WIDTH, q, v, 1.0),
                 *scaled = build_own_lengths(EACH, WIDTH, q, v, 2.0);
    struct canonical c;
    canonical_create(system, &c);
    check_agrees(system, &c, q, v);
    check_members(system, q, v);
    canonical_destroy(&c);
    check_ok(hooke_system_force(system, 0.0, q, v, f));
    check_ok(hooke_system_force(scaled, 0.0, q, v, g));
    check_same_bits(3 * EACH, f, g);
  }
}

/* One run of more than a block among many particles, whose springs differ: the tensions of its neighbours are
 * what pulls at a particle. */
TEST(test_each_spring_of_a_run_has_its_own_numbers) {
  enum { SPRINGS = 300, LAST = SPRINGS - 1, EACH = 4000 };
  owned_doubles *q = new_doubles(3 * EACH), *v = new_doubles(3 * EACH), *f = new_doubles(3 * EACH);
  owned_doubles *number = new_doubles(3 * SPRINGS), *tension = new_doubles(SPRINGS + 1);
  int64_t ends[2 * SPRINGS];
  for (int64_t p = 0; p < EACH; p++)
    q[3 * p] = 1.5 * (double)p, v[3 * p] = 0.25 * (double)p;
  for (int64_t k = 0; k < SPRINGS; k++) {
    ends[2 * k] = k < LAST ? k : EACH - 2, ends[2 * k + 1] = ends[2 * k] + 1; /* the last is far away */
    const double *n = number + 3 * k;
    number[3 * k] = 1.0 + (double)k, number[3 * k + 1] = 0.5 + (double)(k % 7),
               number[3 * k + 2] = 1.0 + 0.001 * (double)k;
    tension[k] = n[0] * (1.5 - n[2]) + n[1] * 0.25;
  }
  for (int32_t set = 0; use_loops(set); set++) {
    hooke_options *options;
    owned_system *system = small_system(EACH, q, NULL, 1.0, 0);
    check_ok(hooke_options_create("springs", &options));
    check_ok(hooke_options_set_text(options, "law", "length"));
    static const char *const names[] = {"stiffness", "damping", "rest_length"};
    for (int k = 0; k < 3; k++) {
      double column[SPRINGS];
      for (int64_t s = 0; s < SPRINGS; s++)
        column[s] = number[3 * s + k];
      check_ok(hooke_options_set_numbers(options, names[k], SPRINGS, column));
    }
    check_ok(hooke_system_add_springs(system, "chain", SPRINGS, ends, options));
    hooke_options_destroy(options);
    check_ok(hooke_system_commit(system));
    assert_int_equal(system->strided->count, 0);
    assert_int_equal(system->springs->run_count, 2);
    check_ok(hooke_system_force(system, 0.0, q, v, f));
    for (int64_t p = 0; p <= LAST; p++) {
      const double pull = (p < LAST ? tension[p] : 0.0) - (p > 0 ? tension[p - 1] : 0.0);
      assert_true(fabs(f[3 * p] - pull) <= 1e-11 * SPRINGS);
    }
  }
}
