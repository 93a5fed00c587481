/* A trajectory file opened for reading. */
#ifndef HOOKE_IO_TRAJECTORY_RECORD_H5_H
#define HOOKE_IO_TRAJECTORY_RECORD_H5_H

#include "hooke/trajectory.h"

#include <hdf5.h>

enum hooke_record_place { HOOKE_PLACE_POSITION, HOOKE_PLACE_VELOCITY, HOOKE_PLACE_COUNT };

enum { HOOKE_RECORD_FACTS = 6 };

struct hooke_record {
  char *fact[HOOKE_RECORD_FACTS]; /* versions of the writer, and callbacks: "" where the file does not say */
  char *path, *scene, *status, *run, *error_by, *error_reason;
  hooke_options *options; /* of a run, as stored */
  int32_t is_run;
  int32_t is_covered, is_error_damaged; /* by check values: everything but the frames; and the error is not */
  int64_t frame_count, good_count;      /* frames, and those before divergence */
  double *time;
  int64_t place[HOOKE_PLACE_COUNT]; /* offsets of frames in the file [bytes]; -1: not contiguous */
  struct {
    char dataset[64];
    double *value;
    int64_t rows, columns;
  } kept; /* cached numbers, whose size was requested */
};

void hk_record_find_places(hooke_record *record, hid_t file);

#endif
