/* Checkpoints, and a trajectory whose run was stopped and is continued. */
#include "scenarios.h"

#include <stdio.h>

enum { FRAMES = 5, FRAMES_BEFORE = 3, PATH_SIZE = 512 };

/* ---- a checkpoint alone ---- */

SCENARIO(checkpoint) {
  struct made m = {.system = make_rope(a, 6)};
  hooke_integrator *other = NULL;
  m.run = make_options(a, "run", "method=symplectic-euler step=1e-3 duration=4e-3 every=1e-3");
  if (m.run == NULL) goto end;
  TRY(a, hooke_integrator_create(m.system, m.run, &m.integrator));
  TRY(a, hooke_integrator_create(m.system, m.run, &other));
  TRY(a, hooke_state_create(m.system, &m.state));
  TRY(a, hooke_state_create(m.system, &m.other));
  TRY_ONCE(a, hooke_integrator_run(m.integrator, m.state));
  /* the second one keeps the first */
  TRY(a, hooke_checkpoint_write(path_of(a, "out.checkpoint"), m.integrator, m.state, "a run"));
  TRY(a, hooke_checkpoint_write(path_of(a, "out.checkpoint"), m.integrator, m.state, "a run"));
  TRY(a, hooke_checkpoint_read(path_of(a, "out.checkpoint"), "a run", other, m.other));
  take_state(a, m.other);
end:
  hooke_integrator_destroy(other);
  release(&m);
}

/* ---- continuing a run ---- */

/* A run and its trajectory. */
struct going {
  struct attempt *a;
  hooke_integrator *integrator;
  hooke_state *state;
  hooke_trajectory *trajectory;
  int64_t frames, stop_at; /* frames written so far; frame to stop at, 0: none */
  int32_t status;          /* of the frame that could not be written */
  char message[512];
};

static int32_t write_frame(int64_t step, const hooke_state *state, void *ctx) {
  struct going *going = ctx;
  going->status = hooke_trajectory_write(going->trajectory, step, state);
  if (going->status != HOOKE_OK) {
    snprintf(going->message, sizeof going->message, "%s", hooke_last_error());
    return 1;
  }
  going->a->committed = ++going->frames;
  return going->frames == going->stop_at;
}

static void prepare(struct going *going, const hooke_system *system, const hooke_options *run) {
  struct attempt *a = going->a;
  TRY(a, hooke_integrator_create(system, run, &going->integrator));
  TRY(a, hooke_integrator_on_frame(going->integrator, write_frame, going));
  TRY(a, hooke_state_create(system, &going->state));
end:
  return;
}

/* True if it returned `expected`. */
static int32_t has_run(struct going *going, int32_t status, int32_t expected) {
  struct attempt *a = going->a;
  if (going->status != HOOKE_OK)
    attempt_failed_saying(a, going->status, HOOKE_OK, "hooke_trajectory_write()", going->message);
  else if (!attempt_failed(a, status, expected, "the run"))
    return 1;
  a->gave_up = 1;
  return 0;
}

static int32_t end_trajectory(struct going *going, int32_t outcome) {
  hooke_trajectory *trajectory = going->trajectory;
  going->trajectory = NULL;
  return hooke_trajectory_close(trajectory, outcome);
}

static void release_going(struct going *going) {
  hooke_trajectory_close(going->trajectory, HOOKE_STOPPED);
  hooke_state_destroy(going->state);
  hooke_integrator_destroy(going->integrator);
}

static void stop_halfway(struct attempt *a, const char *path, const hooke_system *system,
                         const hooke_options *run) {
  struct going going = {.a = a, .stop_at = FRAMES_BEFORE};
  prepare(&going, system, run);
  if (a->gave_up) goto end;
  TRY(a, hooke_trajectory_create(path, system, going.integrator, "{ \"hooke\": 1 }", &going.trajectory));
  if (!has_run(&going, hooke_integrator_run(going.integrator, going.state), HOOKE_STOPPED)) goto end;
  TRY_ONCE(a, hooke_trajectory_checkpoint(going.trajectory, going.integrator, going.state));
  TRY_ONCE(a, end_trajectory(&going, HOOKE_STOPPED));
end:
  release_going(&going);
}

static void go_on(struct attempt *a, const char *path, const hooke_system *system, const hooke_options *run) {
  struct going going = {.a = a, .frames = FRAMES_BEFORE};
  prepare(&going, system, run);
  if (a->gave_up) goto end;
  TRY(a, hooke_trajectory_resume(path, system, going.integrator, going.state, &going.trajectory));
  attempt_text(a, hooke_trajectory_text(going.trajectory, "origin"));
  if (!has_run(&going, hooke_integrator_resume(going.integrator, going.state), HOOKE_OK)) goto end;
  take_state(a, going.state);
  TRY_ONCE(a, end_trajectory(&going, HOOKE_OK));
end:
  release_going(&going);
}

SCENARIO(stop_and_go_on) {
  char path[PATH_SIZE];
  struct made m = {.system = make_rope(a, 6)};
  m.run = make_options(a, "run", "method=verlet step=1e-3 duration=4e-3 every=1e-3"); /* FRAMES - 1 of them */
  snprintf(path, sizeof path, "%s", path_of(a, "out.h5"));
  if (m.run == NULL) goto end;
  a->planned = FRAMES;
  stop_halfway(a, path, m.system, m.run);
  if (!a->gave_up) go_on(a, path, m.system, m.run);
  if (!a->gave_up) read_back(a, path, m.system, FRAMES);
end:
  release(&m);
}

const struct scenario resuming[] = {
    {"write, checkpoint", checkpoint, NULL, 4, NULL, "out.checkpoint out.checkpoint.previous"},
    {"write, trajectory that goes on", stop_and_go_on, NULL, 10, "hdf5",
     "out.h5 out.h5.checkpoint out.h5.checkpoint.previous"},
    {NULL, NULL, NULL, 0, NULL, NULL},
};
