/* Continues the run of a trajectory: finds the point, and opens the file for the missing frames. */
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "integrate/loop/run_loop.h"
#include "io/checkpoint/checkpoint_file.h"
#include "io/checkpoint/checkpoint_form.h"
#include "io/file/atomic_file.h"
#include "io/file/bytes.h"
#include "io/hdf5/array_h5.h"
#include "io/trajectory/record.h"
#include "io/trajectory/trajectory.h"
#include "model/callbacks.h"
#include "model/force/force.h"

#include <stdio.h>
#include <string.h>

int32_t hooke_trajectory_checkpoint(hooke_trajectory *trajectory, const hooke_integrator *integrator,
                                    const hooke_state *state) {
  char *path = NULL;
  int32_t status = hooke_trajectory_sync(trajectory);
  if (status == HOOKE_OK) status = hk_file_beside(trajectory->file.path, HOOKE_CHECKPOINT_ENDING, &path);
  if (status == HOOKE_OK) status = hooke_checkpoint_write(path, integrator, state, trajectory->run);
  hk_free(path);
  return status;
}

/* Working data. */
struct going {
  const char *path;
  hooke_record *record;
  const hooke_system *system;
  hooke_integrator *integrator;
  hooke_state *first; /* the first frame; NULL: the file has none */
  hooke_state *state; /* continues from here */
  hooke_trajectory *trajectory;
};

/* ---- match of file and run ---- */

static int32_t refuse(const struct going *going, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is of a run with other %s", going->path, what);
}

/* Compares an array of the file with the system's own, number by number. */
static int32_t check_array(const struct going *going, const char *what, const char *dataset, int64_t count,
                           const double *own) {
  double *there = NULL;
  int64_t rows = 0, columns = 0;
  int32_t status = hk_array_read(going->path, dataset, 0, 0, &there, &rows, &columns);
  if (status == HOOKE_OK &&
      (rows * columns != count || memcmp(there, own, (size_t)count * sizeof(double)) != 0))
    status = refuse(going, what);
  hk_free(there);
  return status;
}

static int32_t check_springs(const struct going *going) {
  const int64_t count = 2 * hooke_system_count(going->system, "springs");
  int64_t *ends = hk_new(count, sizeof *ends);
  double *numbers = hk_new(count, sizeof *numbers);
  int32_t status = ends && numbers ? hooke_system_members(going->system, "springs", ends, NULL, NULL, NULL)
                                   : HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++)
    numbers[k] = (double)ends[k];
  if (status == HOOKE_OK && count > 0)
    status = check_array(going, "springs", "/connectivity/springs", count, numbers);
  hk_free(numbers);
  hk_free(ends);
  return status;
}

static int32_t check_fit(const struct going *going) {
  if (hk_checkpoint_options(hooke_record_options(going->record)) !=
      hk_checkpoint_options(hooke_integrator_options(going->integrator)))
    return refuse(going, "options; only threads may be changed");
  int32_t status = hk_callbacks_check(hk_callbacks_find(hooke_record_text(going->record, "callbacks")),
                                      hk_system_calls_back(going->system));
  if (status != HOOKE_OK) return hk_fail_before(status, "%s: ", going->path);
  status = check_array(going, "mass", "/particles/all/mass", going->system->particle_count,
                       hooke_system_mass(going->system));
  return status == HOOKE_OK ? check_springs(going) : status;
}

/* ---- from a frame ---- */

/* Repeats the divergence checks of the run at its frames, which the file has at other places if it was made
 * again; the other numbers of the run are those of the start. */
static int32_t follow(const struct going *going, int64_t frames) {
  const struct hk_frame_file *file = &going->trajectory->frames;
  const int64_t bytes = hk_frame_bytes(file->particle_count, HOOKE_FRAME_POSITION);
  int error = 0;
  for (int64_t k = 1; k < frames && error == 0; k++) {
    error =
        hk_bytes_read(file->descriptor, file->at[HOOKE_FRAME_POSITION] + k * bytes, bytes, going->state->q);
    if (error == 0) hk_divergence_follow(going->integrator, going->state);
  }
  return error ? hk_file_fail(going->path, "read its frames", error) : HOOKE_OK;
}

static int32_t stand_at_start(struct going *going) {
  const int32_t status = hk_run_begin(going->integrator, going->state);
  if (status == HOOKE_OK) going->integrator->phase = HOOKE_AT_CHECKPOINT;
  return status;
}

/* 1 if some energy counts as that of gravity. */
static int32_t is_pulled(const hooke_system *system) {
  int32_t some = 0;
  for (int32_t k = 0; k < system->force_row_count; k++)
    some |= system->force_row[k]->add_pull != NULL;
  return some;
}

static int32_t stand_at_frame(struct going *going, int64_t frame) {
  hooke_integrator *it = going->integrator;
  int32_t status = hooke_state_copy(going->first, going->state);
  if (status == HOOKE_OK) status = hk_run_begin(it, going->state);
  if (status == HOOKE_OK && is_pulled(going->system)) status = follow(going, frame + 1);
  if (status == HOOKE_OK) status = hooke_record_read(going->record, frame, going->state);
  return status == HOOKE_OK ? hk_integrator_stand_at_frame(it, frame, going->first, going->state) : status;
}

/* `why`: the reason for not using the checkpoint. */
static int32_t go_on_at_frame(struct going *going, const char *why) {
  const int32_t adaptive = going->integrator->method->adaptive;
  int32_t status = hk_trajectory_reopen(going->path, going->system, going->integrator, 0, &going->trajectory);
  if (status != HOOKE_OK) return status;
  const int64_t there = going->first ? going->trajectory->there : 0;
  const int64_t frames = adaptive && there > 1 ? 1 : there;
  status = frames > 0 ? stand_at_frame(going, frames - 1) : stand_at_start(going);
  if (status != HOOKE_OK) return status;
  hk_trajectory_keep(going->trajectory, frames);
  hk_print(going->trajectory->origin, sizeof going->trajectory->origin, "%s at t = %.6g s: %s",
           frames > 1 ? "the last whole frame," : "the beginning,", *going->state->t, why);
  return HOOKE_OK;
}

/* ---- from a checkpoint ---- */

static int32_t go_on(struct going *going, const char *checkpoint) {
  char why[400];
  enum hk_checkpoint_finding finding;
  int32_t status = hk_checkpoint_take(checkpoint, hooke_record_text(going->record, "run"), going->integrator,
                                      going->state, &finding);
  if (status != HOOKE_OK && (finding == HOOKE_CHECKPOINT_OTHER || status == HOOKE_NO_MEMORY)) return status;
  if (status == HOOKE_OK) {
    status = hk_trajectory_reopen(going->path, going->system, going->integrator, going->integrator->frames,
                                  &going->trajectory);
    if (status == HOOKE_OK) {
      hk_recent_set_first(&going->integrator->recent, going->first);
      hk_print(going->trajectory->origin, sizeof going->trajectory->origin, "the checkpoint, at t = %.6g s",
               *going->state->t);
    }
    if (status != HOOKE_BAD_VALUE) return status;
    going->integrator->count = (struct hk_counts){0}; /* those of the checkpoint are of another point */
    going->integrator->wall_seconds = 0.0;
  }
  if (status != HOOKE_OK && finding == HOOKE_CHECKPOINT_ABSENT)
    snprintf(why, sizeof why, "there is no checkpoint");
  else
    snprintf(why, sizeof why, "%s", hooke_last_error());
  return go_on_at_frame(going, why);
}

/* ---- whole function ---- */

static int32_t read_first(struct going *going) {
  if (hooke_record_count(going->record, "frames") == 0) return HOOKE_OK;
  int32_t status = hk_state_create_sized(going->integrator->size, 1, &going->first);
  if (status == HOOKE_OK) status = hooke_record_read(going->record, 0, going->first);
  if (status != HOOKE_BAD_VALUE) return status;
  hooke_state_destroy(going->first); /* a damaged frame will be written again */
  going->first = NULL;
  return HOOKE_OK;
}

static int32_t resume(struct going *going) {
  char *place = NULL, *checkpoint = NULL;
  int32_t status = check_fit(going);
  if (status == HOOKE_OK) status = read_first(going);
  if (status == HOOKE_OK) status = hk_file_resolve(going->path, &place);
  if (status == HOOKE_OK) status = hk_file_beside(place, HOOKE_CHECKPOINT_ENDING, &checkpoint);
  if (status == HOOKE_OK) status = go_on(going, checkpoint);
  hk_free(checkpoint);
  hk_free(place);
  return status;
}

int32_t hooke_trajectory_resume(const char *path, const hooke_system *system, hooke_integrator *integrator,
                                hooke_state *state, hooke_trajectory **trajectory) {
  HOOKE_KEEP_ERRNO;
  *trajectory = NULL;
  if (integrator->system != system)
    return hk_fail(HOOKE_BAD_CALL, NULL, "the integrator is not one of this system");
  struct going going = {.path = path, .system = system, .integrator = integrator};
  int32_t status = hk_run_check_whole(integrator, state);
  if (status == HOOKE_OK) status = hooke_record_open(path, &going.record);
  if (status != HOOKE_OK) return status;
  status = hk_record_require_run(going.record);
  if (status != HOOKE_OK || strcmp(hooke_record_text(going.record, "status"), "finished") == 0) {
    hooke_record_close(going.record);
    return status;
  }
  status = hk_state_create_sized(state->size, 1, &going.state);
  if (status == HOOKE_OK) status = hooke_state_copy(state, going.state);
  if (status == HOOKE_OK) status = resume(&going);
  if (status == HOOKE_OK) {
    hooke_state_copy(going.state, state);
    *trajectory = going.trajectory;
  } else if (going.trajectory) {
    char message[512];
    snprintf(message, sizeof message, "%s", hooke_last_error());
    hooke_trajectory_close(going.trajectory, HOOKE_STOPPED);
    hk_fail(status, NULL, "%s", message);
  }
  hooke_state_destroy(going.first);
  hooke_state_destroy(going.state);
  hooke_record_close(going.record);
  return status;
}
