/* A trajectory file opened for reading. */
#ifndef HOOKE_IO_TRAJECTORY_RECORD_H5_H
#define HOOKE_IO_TRAJECTORY_RECORD_H5_H

#include "hooke/trajectory.h"
#include "io/trajectory/h5md_h5.h"

enum hooke_record_place { HOOKE_PLACE_POSITION, HOOKE_PLACE_VELOCITY, HOOKE_PLACE_COUNT };

enum { HOOKE_RECORD_FACTS = 6 };

struct hooke_record {
  char *fact[HOOKE_RECORD_FACTS]; /* versions of the writer, and callbacks: "" where the file does not say */
  char *path, *scene, *status, *run, *error_by, *error_reason;
  hooke_options *options;          /* of a run, as stored */
  int32_t is_run, is_covered;      /* by check values: everything but the frames */
  uint32_t description, outcome;   /* their check values */
  struct hk_h5md_places at;        /* where they are */
  int64_t frame_count, good_count; /* frames, and those before divergence */
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
