/* Scenes over 1, 2, 3 and 5 ranks of one launch, split by bisection and at random, by every method that runs
 * over ranks, against one process: trial STEPS SCENE... The first scene is then run with a planted fault:
 * every rank takes each ghost for the next one. It prints how many runs there were, and how many had the same
 * bits. */
#include "split.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int64_t steps;
static int fault, runs, equal;

static void check(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s: %s\n", hooke_status_name(status), hooke_last_error());
  MPI_Abort(MPI_COMM_WORLD, 1);
}

static hooke_state *start_of(const hooke_system *system) {
  hooke_state *state;
  check(hooke_state_create(system, &state));
  return state;
}

/* Positions and velocities after the steps, 6n, at rank 0. */
static void run_split(MPI_Comm all, const hooke_system *whole, const hooke_options *options, int depth,
                      unsigned seed, double *rows) {
  struct split s;
  hooke_integrator *integrator;
  hooke_state *initial = start_of(whole);
  check(split_make(all, whole, hooke_state_position(initial), depth, seed, &s));
  hooke_state_destroy(initial);
  for (int64_t k = 0; fault && k + 1 < s.gets; k++)
    s.get[k] = s.get[k + 1];
  hooke_state *state = start_of(s.system);
  double *own = split_zeros(6 * s.own, sizeof *own);
  check(hooke_integrator_create(s.system, options, &integrator));
  check(hooke_integrator_begin(integrator, state, 0.0, 0));
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < steps; k++)
    status = split_step(&s, integrator, status);
  if (status == HOOKE_OK) status = hooke_integrator_get(integrator, s.own, s.mine, own, own + 3 * s.own);
  split_collect(&s, own, rows);
  split_collect(&s, own + 3 * s.own, rows + 3 * s.n);
  free(own);
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  split_release(&s);
}

static void compare(const char *name, int ranks, const hooke_state *right, const double *rows) {
  const size_t bytes = (size_t)hooke_state_size(right) * sizeof(double);
  const int same =
      memcmp(hooke_state_position((hooke_state *)right), rows, bytes) == 0 &&
      memcmp(hooke_state_velocity((hooke_state *)right), rows + hooke_state_size(right), bytes) == 0;
  runs++;
  equal += same;
  if (!same && !fault) printf("%s on %d ranks: other bits\n", name, ranks);
}

static void try_method(const hooke_system *whole, hooke_options *options, const char *method) {
  static const int sizes[] = {1, 2, 3, 5};
  int rank;
  hooke_integrator *serial;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  check(hooke_options_set_text(options, "method", method));
  check(hooke_options_set_text(options, "verlet_damping", "auto"));
  check(hooke_integrator_create(whole, options, &serial));
  const int depth = split_depth(serial);
  if (hooke_integrator_count(serial, "explicit_damping") == 1)
    check(hooke_options_set_text(options, "verlet_damping", "explicit"));
  hooke_state *right = start_of(whole);
  if (rank == 0) check(hooke_integrator_step(serial, right, steps));
  double *rows = split_zeros(2 * hooke_state_size(right), sizeof *rows);
  for (size_t k = fault ? 2 : 0; k < sizeof sizes / sizeof *sizes && depth > 0; k++) {
    MPI_Comm some;
    MPI_Comm_split(MPI_COMM_WORLD, rank < sizes[k] ? 0 : MPI_UNDEFINED, rank, &some);
    for (unsigned seed = 0; seed < 2 && rank < sizes[k]; seed++) {
      run_split(some, whole, options, depth, seed, rows);
      if (rank == 0) compare(method, sizes[k], right, rows);
    }
    if (rank < sizes[k]) MPI_Comm_free(&some);
    split_agree(MPI_COMM_WORLD, HOOKE_OK); /* the others wait here without a core */
  }
  free(rows);
  hooke_state_destroy(right);
  hooke_integrator_destroy(serial);
}

static void try_scene(const char *path) {
  static const char *const methods[] = {"forward-euler", "symplectic-euler", "verlet", "heun", "rk4"};
  hooke_scene *scene;
  check(hooke_scene_load(path, NULL, &scene));
  check(hooke_scene_commit(scene));
  const hooke_system *whole = hooke_scene_system(scene);
  const int overdamped = strcmp(hooke_system_dynamics(whole), "overdamped") == 0;
  for (size_t m = 0; m < (fault ? 2 : sizeof methods / sizeof *methods); m++)
    if (hooke_method_is_suited(methods[m], overdamped ? "overdamped" : "second-order"))
      try_method(whole, hooke_scene_run_options(scene), methods[m]);
  hooke_scene_destroy(scene);
}

static void tell(int rank, const char *what) {
  if (rank == 0) printf("%s%d of %d equal\n", what, equal, runs);
  equal = runs = 0;
}

int main(int argc, char **argv) {
  int rank;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  steps = atoi(argv[1]);
  for (int k = 2; k < argc; k++)
    try_scene(argv[k]);
  tell(rank, "");
  fault = 1;
  try_scene(argv[2]);
  tell(rank, "with a fault: ");
  MPI_Finalize();
  return 0;
}
