/* Telling the files apart that a scene can come from, and what is known of one inside the library. */
#ifndef HOOKE_IO_TRAJECTORY_RECORD_H
#define HOOKE_IO_TRAJECTORY_RECORD_H

#include "hooke/trajectory.h"

/* 1 if the file begins as HDF5 files do. */
int32_t hk_record_is_one(const char *path);

/* Where it was opened; valid as long as the record. */
const char *hk_record_path(const hooke_record *record);

/* [s] of a frame that there is, as the file has it: its check value is not looked at. */
double hk_record_time(const hooke_record *record, int64_t frame);

/* 0 for a file of several runs, a comparison or a study. */
int32_t hk_record_is_run(const hooke_record *record);

/* HOOKE_BAD_VALUE for such a file. */
int32_t hk_record_require_run(const hooke_record *record);

#endif
