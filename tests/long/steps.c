/* Very many steps of a small scene: steps STATE_FILE METHOD whole|pieces STEPS. A free chain of eight
 * particles is symmetric about the origin. Exact invariants: the symmetry, and with it a momentum of 0, and
 * the same numbers whether one integrator takes all steps ("whole") or new ones take pieces of them. Bounded
 * quantities: the energy, the angular momentum, and the memory of the process. Progress is stored in
 * STATE_FILE, from which a later call continues; a line is printed at every tenth of the steps. */
#include "check.h"
#include "hash.h"
#include "run.h"
#include "small.h"

#include <inttypes.h>
#include <malloc.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { COUNT = 8, SIZE = 3 * COUNT, TENTHS = 10 };
static const double STEP = 2e-3;      /* s; the fastest mode takes about 50 of them */
static const int64_t SAMPLE = 100000; /* steps between two checks */
static const int64_t LEAST =
    20000000; /* twenty checks a tenth, so that the energies of both are those of the motion */

/* Data stored between calls. */
struct place {
  int64_t steps;            /* taken so far */
  double energy_off[2];     /* largest |E - E(0)|/E(0) in the first and in the last tenth */
  double spin_off;          /* largest |L - L(0)|/|L(0)| */
  double numbers[2 * SIZE]; /* q, v */
};

static struct {
  const char *file, *method;
  int32_t pieces;
  int64_t steps;
} asked;

static hooke_system *chain(void) {
  double q[SIZE], v[SIZE];
  const double mass = 0.01;
  int64_t ends[2 * (COUNT - 1)];
  hooke_system *system = NULL;
  for (int p = 0; p < COUNT / 2; p++) {
    const double along = p - 0.5 * (COUNT - 1);
    const double place[] = {0.1 * along, 0.02 * along * along * along * 0.1, 0.01 * along};
    const double speed[] = {0.05 * along, -0.3 * along, 0.2 * along * along};
    for (int a = 0; a < 3; a++) {
      q[3 * p + a] = place[a], q[3 * (COUNT - 1 - p) + a] = -place[a];
      v[3 * p + a] = speed[a], v[3 * (COUNT - 1 - p) + a] = -speed[a];
    }
  }
  for (int64_t k = 0; k < COUNT - 1; k++)
    ends[2 * k] = k, ends[2 * k + 1] = k + 1;
  check_ok(hooke_system_create(&system));
  check_ok(hooke_system_add_particles(system, COUNT, q, v, 1, &mass, NULL));
  owned_options *options = options_with("springs", "stiffness=1 rest_length=0.1");
  check_ok(hooke_system_add_springs(system, NULL, COUNT - 1, ends, options));
  return committed(system);
}

/* ---- the file ---- */

static int32_t go_on(struct place *place) {
  FILE *file = fopen(asked.file, "rb");
  if (file == NULL) return 0;
  const size_t read = fread(place, sizeof *place, 1, file);
  fclose(file);
  return read == 1;
}

static void keep(const struct place *place) {
  char other[4096];
  snprintf(other, sizeof other, "%s.new", asked.file);
  FILE *file = fopen(other, "wb");
  assert_non_null(file);
  assert_int_equal(fwrite(place, sizeof *place, 1, file), 1);
  assert_int_equal(fflush(file), 0);
  assert_int_equal(fsync(fileno(file)), 0);
  assert_int_equal(fclose(file), 0);
  assert_int_equal(rename(other, asked.file), 0);
}

/* ---- checks ---- */

static int64_t resident(void) {
  long long pages = 0;
  FILE *file = fopen("/proc/self/statm", "r");
  assert_non_null(file);
  assert_int_equal(fscanf(file, "%*d %lld", &pages), 1);
  fclose(file);
  return pages * sysconf(_SC_PAGESIZE);
}

static void look(const hooke_system *system, struct place *place, const double start[2]) {
  const double *q = place->numbers, *v = q + SIZE;
  double spin[3], *off = NULL;
  for (int p = 0; p < COUNT / 2; p++) {
    for (int a = 0; a < 3; a++) {
      const int here = 3 * p + a, there = 3 * (COUNT - 1 - p) + a;
      if (q[here] == -q[there] && v[here] == -v[there]) continue;
      check_failed("step %" PRId64 ": particle %d is not the image of particle %d", place->steps, p,
                   COUNT - 1 - p);
    }
  }
  if (place->steps <= asked.steps / TENTHS) off = &place->energy_off[0];
  if (place->steps > asked.steps - asked.steps / TENTHS) off = &place->energy_off[1];
  if (off != NULL) *off = fmax(*off, fabs(hooke_system_energy(system, "total", q, v) / start[0] - 1.0));
  hooke_system_angular_momentum(system, q, v, spin);
  place->spin_off = fmax(place->spin_off, fabs(hypot(hypot(spin[0], spin[1]), spin[2]) / start[1] - 1.0));
}

/* ---- the steps ---- */

struct runner {
  const hooke_system *system;
  hooke_integrator *integrator;
  hooke_state *state;
};

static void begin(struct runner *runner, const struct place *place) {
  runner->integrator = start_with(runner->system, .method = asked.method, .step = STEP);
  runner->state = start_state(runner->system);
  memcpy(hooke_state_position(runner->state), place->numbers, SIZE * sizeof(double));
  memcpy(hooke_state_velocity(runner->state), place->numbers + SIZE, SIZE * sizeof(double));
}

static void end(struct runner *runner) {
  hooke_integrator_destroy(runner->integrator);
  hooke_state_destroy(runner->state);
}

static void take(struct runner *runner, struct place *place, int64_t count) {
  check_ok(hooke_integrator_step(runner->integrator, runner->state, count));
  memcpy(place->numbers, hooke_state_position(runner->state), SIZE * sizeof(double));
  memcpy(place->numbers + SIZE, hooke_state_velocity(runner->state), SIZE * sizeof(double));
}

/* Steps between two checks; in pieces of odd lengths, each with an integrator of its own. */
static void take_sample(struct runner *runner, struct place *place) {
  static const int64_t lengths[] = {1, 999, 1000, 1001, 31337};
  if (!asked.pieces) {
    take(runner, place, SAMPLE);
  } else {
    int64_t done = 0;
    for (size_t k = 0; done < SAMPLE; k = (k + 1) % (sizeof lengths / sizeof lengths[0])) {
      const int64_t count = lengths[k] < SAMPLE - done ? lengths[k] : SAMPLE - done;
      begin(runner, place);
      take(runner, place, count);
      end(runner);
      done += count;
    }
  }
  place->steps += SAMPLE;
}

static void test_steps(void **unused) {
  (void)unused;
  struct place place = {0};
  struct runner runner = {.system = chain()};
  hooke_state *first = start_state(runner.system);
  const double *q = hooke_state_position(first), *v = hooke_state_velocity(first);
  double spin[3];
  hooke_system_angular_momentum(runner.system, q, v, spin);
  const double start[] = {hooke_system_energy(runner.system, "total", q, v),
                          hypot(hypot(spin[0], spin[1]), spin[2])};
  memcpy(place.numbers, q, SIZE * sizeof(double));
  memcpy(place.numbers + SIZE, v, SIZE * sizeof(double));
  hooke_state_destroy(first);
  if (go_on(&place)) printf("going on from step %" PRId64 "\n", place.steps);
  if (!asked.pieces) begin(&runner, &place);

  const int64_t tenth = asked.steps / TENTHS;
  int64_t warm = 0, rss = 0;
  size_t heap = 0, warm_heap = 0;
  while (place.steps < asked.steps) {
    take_sample(&runner, &place);
    look(runner.system, &place, start);
    if (++warm == 20) rss = resident(), warm_heap = mallinfo2().uordblks;
    heap = mallinfo2().uordblks;
    if (warm > 20 && heap > warm_heap)
      check_failed("step %" PRId64 ": the heap has grown from %zu to %zu bytes", place.steps, warm_heap,
                   heap);
    if (warm > 20 && resident() > rss + (1 << 18))
      check_failed("step %" PRId64 ": the process has grown from %" PRId64 " to %" PRId64 " bytes",
                   place.steps, rss, resident());
    if (place.steps % (100 * SAMPLE) == 0) keep(&place);
    if (place.steps % tenth == 0) {
      printf("step %" PRId64 " hash %016" PRIx64 "\n", place.steps,
             hash_doubles(2 * SIZE, place.numbers, HASH_START));
      fflush(stdout);
    }
  }
  keep(&place);
  printf("done: energy off by %.3g in the first tenth, %.3g in the last; angular momentum by %.3g; heap %zu "
         "bytes\n",
         place.energy_off[0], place.energy_off[1], place.spin_off, heap);
  printf("final hash %016" PRIx64 "\n", hash_doubles(2 * SIZE, place.numbers, HASH_START));
  check_between(place.energy_off[1], 0.2 * place.energy_off[0], 1.5 * place.energy_off[0]);
  check_between(place.energy_off[0], 1e-9, 0.1);
  check_between(place.spin_off, 0.0, 1e-15 * sqrt((double)asked.steps) + 1e-13);
  if (!asked.pieces) end(&runner);
  hooke_system_destroy((hooke_system *)(uintptr_t)runner.system);
}

int main(int argc, char **argv) {
  const struct CMUnitTest tests[] = {cmocka_unit_test(test_steps)};
  if (argc != 5) return fprintf(stderr, "steps STATE_FILE METHOD whole|pieces STEPS\n"), 2;
  asked.file = argv[1];
  asked.method = argv[2];
  asked.pieces = strcmp(argv[3], "pieces") == 0;
  asked.steps = strtoll(argv[4], NULL, 10);
  if (asked.steps < LEAST || asked.steps % (TENTHS * SAMPLE) != 0)
    return fprintf(stderr, "STEPS is a multiple of %" PRId64 ", from %" PRId64 " on\n", TENTHS * SAMPLE,
                   LEAST),
           2;
  return cmocka_run_group_tests(tests, NULL, NULL);
}
