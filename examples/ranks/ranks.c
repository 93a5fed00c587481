/* ranks.c: runs a scene over MPI ranks by an explicit method, with the bits of one process.
 *
 *   mpirun -n 4 ranks SCENE [-o OUT.h5 | --resume OUT.h5] [--energy] [--owners SEED] [--method NAME] [--step
 * TIME] ...
 *
 * Rank 0 has the whole scene as well, and writes frames by hooke's own trajectory, so the file is that of a
 * run of one process. After a kill --resume goes on from its last frame, on any number of ranks. A run ends
 * with exit code 4 on numbers that are not finite, and with --energy also by the rule of energy that a run of
 * one process has, at frames. --owners deals the particles out at random, to try what a bad split costs. */
#include "split.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

struct run {
  const char *scene, *output, *resumed;
  int energy;
  unsigned owners;

  hooke_scene *loaded;
  hooke_system *whole;
  hooke_integrator *serial; /* of the whole; at rank 0 it stands for the run */
  hooke_state *state;       /* of the whole */
  hooke_trajectory *trajectory;
  struct split split;
  hooke_integrator *integrator; /* of this rank */
  double *own;                  /* positions and velocities of what it owns: 6 own */
  double t0, h;
  int64_t step, steps, frame_steps;
};

/* ---- the run that is asked for ---- */

static int32_t read_arguments(int argc, char **argv, struct run *run) {
  if (argc > 1) run->scene = argv[1];
  for (int k = 2; k < argc; k++) {
    const char *name = argv[k], *value = k + 1 < argc ? argv[k + 1] : "";
    if (strcmp(name, "--energy") == 0) {
      run->energy = 1;
      continue;
    }
    k++;
    if (strcmp(name, "-o") == 0)
      run->output = value;
    else if (strcmp(name, "--resume") == 0)
      run->resumed = value;
    else if (strcmp(name, "--owners") == 0)
      run->owners = (unsigned)atoi(value);
    else {
      const int32_t status = hooke_options_set_text(hooke_scene_run_options(run->loaded), name + 2, value);
      if (status != HOOKE_OK) return status;
    }
  }
  return HOOKE_OK;
}

/* What verlet does with damping depends on the whole system, and so does the choice of `every`. */
static int32_t fill_options(struct run *run) {
  hooke_options *options = hooke_scene_run_options(run->loaded);
  int32_t status = hooke_integrator_create(run->whole, options, &run->serial);
  if (status != HOOKE_OK) return status;
  const hooke_options *filled = hooke_integrator_options(run->serial);
  run->h = hooke_options_number(filled, "step");
  run->steps = llround(hooke_options_number(filled, "duration") / run->h);
  run->frame_steps = llround(hooke_options_number(filled, "every") / run->h);
  if (hooke_integrator_count(run->serial, "explicit_damping") == 1)
    status = hooke_options_set_text(options, "verlet_damping", "explicit");
  return status;
}

/* ---- before the first step ---- */

static int32_t open_trajectory(struct run *run) {
  if (run->split.rank != 0) return HOOKE_OK;
  if (run->resumed) {
    const int32_t status =
        hooke_trajectory_resume(run->resumed, run->whole, run->serial, run->state, &run->trajectory);
    run->step =
        run->trajectory ? hooke_integrator_count(run->serial, "steps") : run->steps; /* it has finished */
    return status;
  }
  if (run->output == NULL) return HOOKE_OK;
  const char *text = hooke_scene_text(run->loaded, "text");
  const int32_t status =
      hooke_trajectory_create(run->output, run->whole, run->serial, text, &run->trajectory);
  return status == HOOKE_OK ? hooke_trajectory_write(run->trajectory, 0, run->state) : status;
}

/* Rank 0's state of the whole, of which each rank takes its part. */
static int32_t begin(struct run *run) {
  struct split *s = &run->split;
  hooke_state *local = NULL;
  int32_t status = hooke_integrator_create(s->system, hooke_scene_run_options(run->loaded), &run->integrator);
  if (status == HOOKE_OK) status = hooke_state_create(s->system, &local);
  double *rows[] = {hooke_state_position(run->state), hooke_state_velocity(run->state)};
  MPI_Bcast(&run->step, 1, MPI_INT64_T, 0, s->all);
  for (int a = 0; a < 2; a++)
    MPI_Bcast(rows[a], (int)s->n, s->row, 0, s->all);
  for (int64_t k = 0; k < s->count && status == HOOKE_OK; k++) {
    memcpy(hooke_state_position(local) + 3 * k, rows[0] + 3 * s->global[k], 3 * sizeof(double));
    memcpy(hooke_state_velocity(local) + 3 * k, rows[1] + 3 * s->global[k], 3 * sizeof(double));
  }
  if (status == HOOKE_OK) {
    hooke_state_set_time(local, run->t0 + (double)run->step * run->h);
    status = hooke_integrator_begin(run->integrator, local, run->t0, run->step);
  }
  hooke_state_destroy(local);
  run->own = split_zeros(6 * s->own, sizeof(double));
  return status;
}

static int32_t prepare(MPI_Comm all, int argc, char **argv, struct run *run) {
  hooke_state *initial = NULL;
  int32_t status = hooke_scene_load(argc > 1 ? argv[1] : "", NULL, &run->loaded);
  if (status == HOOKE_OK) status = read_arguments(argc, argv, run);
  if (status == HOOKE_OK) status = hooke_scene_commit(run->loaded);
  if (status == HOOKE_OK) {
    run->whole = hooke_scene_system(run->loaded);
    status = hooke_state_create(run->whole, &initial);
  }
  if (status == HOOKE_OK) status = hooke_state_create(run->whole, &run->state);
  if (status == HOOKE_OK) status = fill_options(run);
  if ((status = split_agree(all, status)) != HOOKE_OK) return status;
  const int depth = split_depth(run->serial);
  if (depth == 0) {
    int rank;
    MPI_Comm_rank(all, &rank);
    if (rank == 0)
      fprintf(stderr,
              "method: does not run over ranks; allowed: forward-euler, symplectic-euler, heun, rk4, and "
              "verlet where it does not solve for damping\n");
    return HOOKE_UNSUITED;
  }
  run->t0 = hooke_state_time(initial);
  status = split_make(all, run->whole, hooke_state_position(initial), depth, run->owners, &run->split);
  if (status == HOOKE_OK && run->split.rank == 0 && run->energy && !run->resumed)
    status = hooke_integrator_begin(run->serial, initial, run->t0, 0);
  hooke_state_destroy(initial);
  if ((status = split_agree(all, status)) != HOOKE_OK) return status;
  if ((status = split_agree(all, open_trajectory(run))) != HOOKE_OK) return status;
  return split_agree(all, begin(run));
}

/* ---- the run ---- */

/* Rank 0 also judges the energy of the whole. */
static int32_t write_frame(struct run *run) {
  hooke_state_set_time(run->state, run->t0 + (double)run->step * run->h);
  int32_t status = HOOKE_OK;
  if (run->energy) status = hooke_integrator_begin(run->serial, run->state, run->t0, run->step);
  return status == HOOKE_OK && run->trajectory
             ? hooke_trajectory_write(run->trajectory, run->step, run->state)
             : status;
}

static int32_t finish_frame(struct run *run, int32_t status) {
  struct split *s = &run->split;
  double *own[] = {run->own, run->own + 3 * s->own};
  if (status == HOOKE_OK) status = hooke_integrator_get(run->integrator, s->own, s->mine, own[0], own[1]);
  if (status == HOOKE_OK && !split_is_finite(6 * s->own, run->own)) status = HOOKE_DIVERGED;
  if ((status = split_agree(s->all, status)) != HOOKE_OK) return status;
  split_collect(s, own[0], hooke_state_position(run->state));
  split_collect(s, own[1], hooke_state_velocity(run->state));
  return split_agree(s->all, s->rank == 0 ? write_frame(run) : HOOKE_OK);
}

static int32_t go(struct run *run) {
  int32_t status = HOOKE_OK;
  while (run->step < run->steps) {
    status = split_step(&run->split, run->integrator, status);
    run->step++;
    if (run->step % run->frame_steps != 0 && run->step < run->steps) continue;
    if ((status = finish_frame(run, status)) != HOOKE_OK) break;
  }
  return status;
}

static void report(const struct run *run, int64_t steps, double wall, int32_t status) {
  const struct split *s = &run->split;
  double own[] = {wall, s->stepping, s->trading, (double)s->count}, most[4];
  MPI_Reduce(own, most, 4, MPI_DOUBLE, MPI_MAX, 0, s->all);
  const double ms = 1e3 / (double)(steps > 0 ? steps : 1);
  if (s->rank == 0)
    printf(
        "%s after %lld steps on %d ranks: at most %.4g ms a step, %.4g of it stepping, %.4g in exchange; a rank has up "
        "to %.0f of %lld particles\n",
        hooke_status_name(status), (long long)run->step, s->ranks, ms * most[0], ms * most[1], ms * most[2],
        most[3], (long long)s->n);
}

static void release(struct run *run) {
  free(run->own);
  if (run->integrator) hooke_integrator_destroy(run->integrator);
  if (run->split.ranks > 0) split_release(&run->split);
  if (run->state) hooke_state_destroy(run->state);
  if (run->serial) hooke_integrator_destroy(run->serial);
  hooke_scene_destroy(run->loaded);
}

int main(int argc, char **argv) {
  struct run run = {.owners = 0};
  MPI_Init(&argc, &argv);
  int32_t status = prepare(MPI_COMM_WORLD, argc, argv, &run), closed = HOOKE_OK;
  if (status == HOOKE_OK) {
    const int64_t begun = run.step;
    const double wall = MPI_Wtime();
    status = go(&run);
    report(&run, run.step - begun, MPI_Wtime() - wall, status);
  }
  if (run.trajectory) closed = hooke_trajectory_close(run.trajectory, status > 0 ? status : HOOKE_OK);
  closed = split_agree(MPI_COMM_WORLD, closed);
  release(&run);
  MPI_Finalize();
  return status < 0 || closed < 0 ? 3 : status > 0 ? 4 : 0;
}
