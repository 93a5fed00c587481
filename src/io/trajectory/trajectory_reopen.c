/* Reopens the file of an unfinished run. It must be, to the last array, the file that the run would have
 * created. */
#include "core/status.h"
#include "io/trajectory/record.h"
#include "io/trajectory/trajectory.h"

#include <stdio.h>
#include <string.h>

static int32_t refuse(const hooke_trajectory *old, const char *what) {
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: %s; this run cannot go on in it", old->file.path, what);
}

static int32_t check_arrays(const hooke_trajectory *old, int64_t particles) {
  for (int k = 0; k < HOOKE_FRAME_ARRAY_COUNT; k++) {
    char path[HOOKE_FRAME_PATH], what[HOOKE_FRAME_PATH + 64];
    if (old->frames.at[k] >= 0 && (k < HOOKE_FRAME_POSITION || old->frames.particle_count == particles))
      continue;
    hk_frame_path("all", k, path);
    snprintf(what, sizeof what, "%s is not there as a run of this system makes it", path);
    return refuse(old, what);
  }
  return old->at[HOOKE_PART_STATUS] < 0 ? refuse(old, "it is no trajectory of hooke") : HOOKE_OK;
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
      status = refuse(old, "another run has just finished it");
  }
  hooke_record_close(record);
  return status == HOOKE_OK ? check_arrays(old, hooke_system_particle_count(system)) : status;
}

/* Finds the whole frames, of which there must be `frames_kept`. */
static int32_t look(hooke_trajectory *old, int64_t good, int64_t frames_kept) {
  int32_t whole = 1;
  if (good < frames_kept) return refuse(old, "it has fewer frames than the run had written");
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

static int32_t go_on(hooke_trajectory *old, int64_t planned) {
  int32_t status = HOOKE_OK;
  if (old->frames.frame_count > planned) return refuse(old, "it was made for more frames");
  if (old->frames.frame_count < planned) status = hk_trajectory_remake(old, planned, old->there);
  if (status != HOOKE_OK) return status;
  const int error = hk_outcome_write_status(old->file.descriptor, old->at, HOOKE_OUTCOME_RUNNING);
  if (error) return hk_file_fail(old->file.path, "write that it is running again", error);
  return old->file.temporary ? hk_atomic_file_commit(&old->file, NULL) : HOOKE_OK;
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
  if (status == HOOKE_OK) status = go_on(made, hooke_integrator_count(integrator, "frames"));
  if (status == HOOKE_OK) {
    hk_trajectory_keep(made, frames_kept);
    *trajectory = made;
  } else {
    hk_trajectory_release(made);
  }
  return status;
}

void hk_trajectory_keep(hooke_trajectory *trajectory, int64_t frames) {
  trajectory->frames.written = trajectory->taken = frames;
}
