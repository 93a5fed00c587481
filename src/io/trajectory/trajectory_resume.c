/* Continues the run of a trajectory: finds the point, and opens the file for the missing frames. */
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "integrate/loop/run_loop.h"
#include "io/checkpoint/checkpoint_file.h"
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

/* ---- the file, which must be, to the last array, the one that the run would have created ---- */

static int32_t refuse_file(const hooke_trajectory *old, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: %s; this run cannot go on in it", old->file.path, what);
}

static int32_t check_arrays(const hooke_trajectory *old, int64_t particles) {
  for (int k = 0; k < HOOKE_FRAME_ARRAY_COUNT; k++) {
    char path[HOOKE_FRAME_PATH], what[HOOKE_FRAME_PATH + 64];
    if (old->frames.at[k] >= 0 && (k < HOOKE_FRAME_POSITION || old->frames.particle_count == particles))
      continue;
    hk_frame_path("all", k, path);
    snprintf(what, sizeof what, "%s is not there as a run of this system makes it", path);
    return refuse_file(old, what);
  }
  return old->at[HOOKE_PART_STATUS] < 0 ? refuse_file(old, "it is no trajectory of hooke") : HOOKE_OK;
}

/* Takes over what a file says of its run. `good`: frames up to which a run goes on from it. */
static int32_t take_record(const hooke_system *system, hooke_trajectory *old, int64_t *good) {
  hooke_record *record;
  int32_t status = hooke_record_open(old->file.path, &record);
  if (status == HOOKE_OK) status = hk_file_is(old->file.path, old->file.descriptor);
  if (status == HOOKE_OK) {
    old->frames = record->frames;
    old->frames.system = system;
    old->frames.descriptor = old->file.descriptor;
    memcpy(old->at, record->at, sizeof old->at);
    old->description = record->description;
    snprintf(old->run, sizeof old->run, "%s", hooke_record_text(record, "run"));
    *good = record->good_count < record->frame_count ? record->good_count : record->frames.frame_count;
    if (strcmp(hooke_record_text(record, "status"), "finished") == 0)
      status = refuse_file(old, "another run has just finished it");
  }
  hooke_record_close(record);
  return status == HOOKE_OK ? check_arrays(old, hooke_system_particle_count(system)) : status;
}

/* Finds the whole frames, of which there must be `frames_kept`. */
static int32_t look(hooke_trajectory *old, int64_t good, int64_t frames_kept) {
  int32_t whole = 1;
  if (good < frames_kept) return refuse_file(old, "it has fewer frames than the run had written");
  while (whole && old->there < good) {
    const int error = hk_frame_look(&old->frames, old->there, &whole);
    if (error) return hk_file_fail(old->file.path, "read its frames", error);
    old->there += whole;
  }
  if (old->there >= frames_kept) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "frame %lld of %s is damaged or not there, and the "
                 "run had written %lld; it cannot go on in this file",
                 (long long)old->there, old->file.path, (long long)frames_kept);
}

static int32_t mark_running(hooke_trajectory *old, int64_t planned) {
  int32_t status = HOOKE_OK;
  if (old->frames.frame_count > planned) return refuse_file(old, "it was made for more frames");
  if (old->frames.frame_count < planned) status = hk_trajectory_remake(old, planned, old->there);
  if (status != HOOKE_OK) return status;
  const int error = hk_outcome_write_status(old->file.descriptor, old->at, HOOKE_OUTCOME_RUNNING);
  if (error) return hk_file_fail(old->file.path, "write that it is running again", error);
  return old->file.temporary ? hk_atomic_file_commit(&old->file, NULL) : HOOKE_OK;
}

/* Declares the first `frames` kept. */
static void keep_frames(hooke_trajectory *trajectory, int64_t frames) {
  trajectory->frames.written = trajectory->taken = frames;
}

int32_t hk_trajectory_reopen(const char *path, const hooke_system *system, const hooke_integrator *integrator,
                             int64_t frames_kept, hooke_trajectory **trajectory) {
  *trajectory = NULL;
  hooke_trajectory *made = hk_trajectory_new();
  if (made == NULL) return HOOKE_NO_MEMORY;
  int64_t good = 0;
  int32_t status = hk_atomic_file_lock(path, &made->file);
  if (status == HOOKE_OK) status = take_record(system, made, &good);
  if (status == HOOKE_OK) status = look(made, good, frames_kept);
  if (status == HOOKE_OK) status = mark_running(made, hooke_integrator_count(integrator, "frames"));
  if (status == HOOKE_OK) {
    keep_frames(made, frames_kept);
    *trajectory = made;
  } else {
    hk_trajectory_release(made);
  }
  return status;
}

/* ---- the point ---- */

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
  if (status == HOOKE_OK) status = hk_force_check(going->record->text + HOOKE_RECORD_FORCE, going->system);
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
  keep_frames(going->trajectory, frames);
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
