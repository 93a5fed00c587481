#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/measurement/motions_h5.h"
#include "io/trajectory/h5md_h5.h"
#include "measure/study/study.h"

int32_t hk_motions_create(const hooke_measurement *m, struct hk_motions *motions) {
  const struct hk_study *study = m->kind == &hk_study_kind && m->outcome == HOOKE_OK ? m->object : NULL;
  const int64_t count = study && study->once ? study->row_count + 1 : 0;
  *motions = (struct hk_motions){m, count, hk_new(count, sizeof *motions->writer)};
  return motions->writer ? HOOKE_OK : HOOKE_NO_MEMORY;
}

static int64_t frames_of(const struct hk_study *study, int64_t k) {
  return k == 0 ? study->reference.frames.recorded : study->row[k - 1].trial.frames;
}

herr_t hk_motions_make(struct hk_motions *motions, hid_t file) {
  const hooke_system *system = motions->m->system;
  herr_t result = 0;
  for (int64_t k = 0; result >= 0 && k < motions->count; k++) {
    const struct hk_study *study = motions->m->object;
    const char *group = k == 0 ? "all" : study->method[study->row[k - 1].method];
    hk_frame_arrays_plan(system, group, frames_of(study, k), &motions->writer[k]);
    result = hk_frame_arrays_create(file, &motions->writer[k]);
  }
  return result >= 0 && motions->count > 0 ? hk_h5md_connect(file, system, "all") : result;
}

/* ---- running ---- */

struct run {
  const struct hk_motions *motions;
  int64_t number;
  int error; /* errno of a write */
  int32_t stopped;
};

static int32_t write_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  struct run *run = ctx;
  struct hk_frame_file *writer = &run->motions->writer[run->number];
  if (frame >= writer->frame_count) return 1;
  run->error = hk_frame_write(writer, writer->written, step, state);
  writer->written += run->error == 0;
  return run->error != 0;
}

static int32_t tell(double fraction, void *ctx) {
  struct run *run = ctx;
  const double done = ((double)run->number + fraction) / (double)run->motions->count;
  run->stopped = hk_measurement_tell(run->motions->m, done, run->motions->writer[run->number].group);
  return run->stopped;
}

static int32_t run_again(struct run *run, const char *path) {
  const struct hk_study *study = run->motions->m->object;
  const struct hk_frame_file *writer = &run->motions->writer[run->number];
  const struct hk_listener listener = {.on_progress = tell, .on_frame = write_frame, .ctx = run};
  struct hk_frames frames = {.system = study->system}; /* none: they go into the file */
  hooke_options *options = NULL;
  int32_t status = hk_study_run_options(study, run->number - 1, &options);
  if (status == HOOKE_OK) status = hk_frames_run(&frames, options, &listener, NULL);
  hooke_options_destroy(options);
  if (run->error) return hk_file_fail(path, "write a frame", run->error);
  if (run->stopped || status == HOOKE_NO_MEMORY) return status;
  if (writer->written == writer->frame_count) return HOOKE_OK;
  return hk_fail(HOOKE_IO_FAILED, NULL, "%s: the run of %s came to %lld frames and now to %lld", path,
                 writer->group, (long long)writer->frame_count, (long long)writer->written);
}

int32_t hk_motions_write(struct hk_motions *motions, const struct hk_atomic_file *file) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; status == HOOKE_OK && k < motions->count; k++) {
    struct run run = {.motions = motions, .number = k};
    motions->writer[k].descriptor = file->descriptor;
    status = run_again(&run, file->path);
  }
  return status;
}

#endif
