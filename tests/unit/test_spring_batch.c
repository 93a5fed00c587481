/* Batches contain every spring once, with its material to the bit, by runs or by the tiles of a tiled batch;
 * sums over them equal those over single springs. */
#include "check.h"
#include "small.h"
#include "model/sum/spring_batch.h"
#include "model/sum/tiled.h"
#include "random.h"

#include <string.h>

struct one {
  int64_t low, high;
  double kappa, gamma, rest_length;
  int64_t pull_only;
};

static int by_ends(const void *a, const void *b) {
  return memcmp(a, b, sizeof(struct one));
}

static struct one one_of(const struct hk_spring *spring) {
  const int ascending = spring->head < spring->tail;
  return (struct one){ascending ? spring->head : spring->tail,
                      ascending ? spring->tail : spring->head,
                      spring->kappa,
                      spring->gamma,
                      spring->rest_length,
                      spring->pull_only};
}

static void check_batches(const hooke_system *system) {
  const int64_t count = hooke_system_count(system, "springs");
  struct one *wanted = new_block(count, (int64_t)sizeof *wanted),
             *found = new_block(count, (int64_t)sizeof *found);
  int64_t at = 0, damped = 0;
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    for (int64_t k = 0; k < system->springs->run[r].count; k++) {
      const struct hk_spring spring = hk_run_spring(&system->springs->run[r], k);
      wanted[at++] = one_of(&spring);
      damped += spring.gamma != 0.0;
    }
  }
  assert_int_equal(at, count);
  at = 0;
  struct hk_spring_batch batch;
  for (hk_begin_batches(HOOKE_AS_GIVEN, &batch); hk_next_batch(system, &batch);) {
    for (int64_t k = 0; k < batch.count; k++) {
      const struct hk_spring spring = hk_batch_spring(&batch, k);
      assert_true(at < count);
      assert_true(batch.damped || spring.gamma == 0.0);
      damped -= spring.gamma != 0.0;
      found[at++] = one_of(&spring);
    }
  }
  assert_int_equal(at, count);
  assert_int_equal(damped, 0);
  qsort(wanted, (size_t)count, sizeof *wanted, by_ends);
  qsort(found, (size_t)count, sizeof *found, by_ends);
  assert_memory_equal(wanted, found, (size_t)count * sizeof *wanted);
  free(wanted);
  free(found);
}

/* Energy and heat, spring by spring. */
static void check_sums(const hooke_system *system, const double *q, const double *v) {
  long double energy = 0.0L, heat = 0.0L;
  for (int64_t r = 0; r < system->springs->run_count; r++) {
    for (int64_t k = 0; k < system->springs->run[r].count; k++) {
      const struct hk_spring spring = hk_run_spring(&system->springs->run[r], k);
      struct hk_stretch s;
      hk_spring_stretch(&spring, q, v, &s);
      energy += 0.5L * s.elastic * (s.length - spring.rest_length);
      heat += ((long double)s.tension - s.elastic) * s.rate;
    }
  }
  assert_true(energy > 0.0L && heat > 0.0L);
  check_close(hooke_system_energy(system, "springs", q, NULL), (double)energy, 1e-14 * (double)energy);
  check_close(hooke_system_dissipated_power(system, q, v), (double)heat, 1e-13 * (double)heat);
}

struct sheet {
  int64_t side, particles, *number, *ends;
  double *q, *v, *stiffness;
};

static void draw_sheet(int64_t side, int shuffled, struct sheet *sheet) {
  struct random_source source = {5};
  const int64_t n = side * side;
  *sheet = (struct sheet){side,
                          n,
                          new_block(n, (int64_t)sizeof(int64_t)),
                          new_block(2 * n, (int64_t)sizeof(int64_t)),
                          new_doubles(3 * n),
                          new_doubles(3 * n),
                          new_doubles(n)};
  for (int64_t p = 0; p < n; p++) {
    const int64_t other = shuffled ? random_whole(&source, 0, p) : p;
    sheet->number[p] = sheet->number[other];
    sheet->number[other] = p;
    sheet->stiffness[p] = random_between(&source, 10.0, 20.0);
  }
  for (int64_t p = 0; p < n; p++) {
    const double place[3] = {(double)(p % side), 0.0, (double)(p / side)};
    for (int a = 0; a < 3; a++) {
      sheet->q[3 * sheet->number[p] + a] = place[a] + random_between(&source, -0.1, 0.1);
      sheet->v[3 * sheet->number[p] + a] = random_between(&source, -1.0, 1.0);
    }
  }
}

/* Springs along rows, along columns, which only pull, and along diagonals, which are not damped. */
static void add_group(const struct sheet *sheet, int group, int lawful, hooke_system *system) {
  const int64_t side = sheet->side, ahead[] = {1, side, side + 1};
  int64_t count = 0;
  for (int64_t p = 0; p < sheet->particles; p++) {
    if ((group != 1 && p % side + 1 == side) || (group != 0 && p / side + 1 == side)) continue;
    sheet->ends[2 * count] = sheet->number[p];
    sheet->ends[2 * count++ + 1] = sheet->number[p + ahead[group]];
  }
  owned_options *options = new_options("springs");
  check_ok(hooke_options_set_numbers(options, "stiffness", lawful ? 1 : count, sheet->stiffness));
  check_ok(hooke_options_set_number(options, "damping", group == 2 ? 0.0 : 0.5));
  check_ok(hooke_options_set_number(options, "rest_scale", 0.98));
  if (group == 1) check_ok(hooke_options_set_text(options, "compression", "false"));
  check_ok(hooke_system_add_springs(system, "net", count, sheet->ends, options));
}

static void test_sheet(int64_t side, int shuffled, int lawful) {
  struct sheet sheet;
  draw_sheet(side, shuffled, &sheet);
  hooke_system *system = small_system(sheet.particles, sheet.q, sheet.v, 1.0, 0);
  for (int group = 0; group < 3; group++)
    add_group(&sheet, group, lawful, system);
  check_ok(hooke_system_commit(system));
  assert_int_equal(system->tiled->particles > 0, shuffled);
  check_batches(system);
  for (int64_t k = 0; k < 3 * sheet.particles; k++)
    sheet.q[k] *= 1.01;
  check_sums(system, sheet.q, sheet.v);
  hooke_system_destroy(system);
  free(sheet.number);
  free(sheet.ends);
  free(sheet.q);
  free(sheet.v);
  free(sheet.stiffness);
}

TEST(test_runs) {
  test_sheet(30, 0, 1);
  test_sheet(30, 0, 0);
}

/* The large one has materials by a law, and none stored by spring. */
TEST(test_tiled) {
  test_sheet(30, 1, 1);
  test_sheet(30, 1, 0);
  test_sheet(220, 1, 1);
}
