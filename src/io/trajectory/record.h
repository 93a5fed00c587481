/* Identifies the kinds of files that hold a scene, and internal queries of a record. */
#ifndef HOOKE_IO_TRAJECTORY_RECORD_H
#define HOOKE_IO_TRAJECTORY_RECORD_H

#include "hooke/trajectory.h"

/* 1 if the file begins with the HDF5 signature. */
int32_t hk_record_is_one(const char *path);

/* Path that it was opened by; valid as long as the record. */
const char *hk_record_path(const hooke_record *record);

/* Time [s] of an existing frame, without checking the frame. */
double hk_record_time(const hooke_record *record, int64_t frame);

/* HOOKE_BAD_VALUE unless a finished run has the frames that its options ask for. */
int32_t hk_record_check_count(const hooke_record *record);
/* What its check values say of everything but the frames: "checked", or "not-covered" in older files. A
 * damaged file is not opened. */
const char *hk_record_parts(const hooke_record *record);

/* 0 for a file of several runs, such as a comparison or a study. */
int32_t hk_record_is_run(const hooke_record *record);

/* HOOKE_BAD_VALUE for such a file. */
int32_t hk_record_require_run(const hooke_record *record);

#endif
