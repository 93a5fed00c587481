/* Many systems in threads: ropes of eight stiffnesses, each made, run and destroyed by whichever thread is
 * free. Objects of different systems share nothing, and a committed system may be shared, so no locks are
 * needed but the one that hands out the work. Done again in one thread, every rope ends up in the same bits.
 */
#include <hooke.h>

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { ROPES = 8, THREADS = 4 };

struct work {
  pthread_mutex_t lock;
  int next;
  double end[ROPES][3]; /* where each rope's free end was last [m] */
  char message[ROPES][200];
};

static int32_t build(double stiffness, hooke_system *system) {
  hooke_options *rope = NULL;
  int32_t status = hooke_options_create("rope", &rope);
  if (!status) status = hooke_options_set_text(rope, "from", "0,0,0");
  if (!status) status = hooke_options_set_text(rope, "to", "1,0,0");
  if (!status) status = hooke_options_set_number(rope, "segments", 32);
  if (!status) status = hooke_options_set_number(rope, "mass", 0.2); /* kg */
  if (!status) status = hooke_options_set_text(rope, "pinned", "start");
  if (!status) status = hooke_options_set_number(rope, "stretch.stiffness", stiffness); /* N */
  if (!status) status = hooke_options_set_number(rope, "stretch.damping", 0.02);
  if (!status) status = hooke_system_add_part(system, "rope", NULL, rope, NULL, NULL);
  if (!status) status = hooke_system_set_gravity(system, (double[]){0, -9.81, 0});
  if (!status) status = hooke_system_commit(system);
  hooke_options_destroy(rope);
  return status;
}

static int32_t swing(const hooke_system *system, double end[3]) {
  hooke_options *run = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int32_t status = hooke_options_create("run", &run);
  if (!status) status = hooke_options_set_text(run, "method", "rk4");
  if (!status) status = hooke_options_set_number(run, "step", 1e-4); /* s; off by less than 1e-5 m */
  if (!status) status = hooke_options_set_number(run, "duration", 1);
  if (!status) status = hooke_integrator_create(system, run, &integrator);
  if (!status) status = hooke_state_create(system, &state);
  if (!status) status = hooke_integrator_run(integrator, state);
  if (!status) memcpy(end, hooke_state_position(state) + hooke_state_size(state) - 3, 3 * sizeof(double));
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(run);
  return status;
}

static void *take_ropes(void *ctx) {
  struct work *work = ctx;
  for (;;) {
    pthread_mutex_lock(&work->lock);
    const int k = work->next++;
    pthread_mutex_unlock(&work->lock);
    if (k >= ROPES) return NULL;
    hooke_system *system = NULL;
    int32_t status = hooke_system_create(&system);
    if (!status) status = build(50.0 * (1 << k), system);
    if (!status) status = swing(system, work->end[k]);
    /* the message is this thread's own */
    if (status) snprintf(work->message[k], sizeof work->message[k], "%s", hooke_last_error());
    hooke_system_destroy(system);
  }
}

static void run_all(int threads, struct work *work) {
  pthread_t thread[THREADS];
  memset(work, 0, sizeof *work);
  pthread_mutex_init(&work->lock, NULL);
  for (int k = 0; k < threads; k++) {
    if (pthread_create(&thread[k], NULL, take_ropes, work) != 0) exit(1);
  }
  for (int k = 0; k < threads; k++)
    pthread_join(thread[k], NULL);
  pthread_mutex_destroy(&work->lock);
}

int main(void) {
  static struct work side_by_side, alone;
  run_all(THREADS, &side_by_side);
  run_all(1, &alone);
  for (int k = 0; k < ROPES; k++) {
    const double *end = side_by_side.end[k];
    if (side_by_side.message[k][0]) {
      fprintf(stderr, "rope %d: %s\n", k, side_by_side.message[k]);
      return 1;
    }
    printf("%5d N: the end is at %7.4f %7.4f m\n", 50 * (1 << k), end[0], end[1]);
  }
  const int same = memcmp(side_by_side.end, alone.end, sizeof alone.end) == 0;
  printf("%s bits as in one thread\n", same ? "the same" : "other");
  return !same;
}
