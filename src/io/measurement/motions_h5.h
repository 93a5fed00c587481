/* The motions in the file of a study that ran each method once: the reference in the group "all", each method
 * in one of its name (frames_h5.h). Only the numbers of frames are kept from the study, so every
 * run is made again. */
#ifndef HOOKE_IO_MEASUREMENT_MOTIONS_H5_H
#define HOOKE_IO_MEASUREMENT_MOTIONS_H5_H

#include "io/file/atomic_file.h"
#include "io/trajectory/frames_h5.h"
#include "measure/measurement.h"

struct hk_motions {
  const hooke_measurement *m;
  int64_t count; /* 0 for other measurements, and for a study that was stopped */
  struct hk_frame_file *writer;
};

/* Finds them; the caller frees `writer`. HOOKE_NO_MEMORY. */
int32_t hk_motions_create(const hooke_measurement *m, struct hk_motions *motions);
/* Makes room for them in the file. Negative on failure. */
herr_t hk_motions_make(struct hk_motions *motions, hid_t file);
/* Writes them by the descriptor, once HDF5 has closed the file. The progress of the measurement is called.
 * HOOKE_STOPPED; HOOKE_IO_FAILED, also if a run takes another course than before. */
int32_t hk_motions_write(struct hk_motions *motions, const struct hk_atomic_file *file);

#endif
