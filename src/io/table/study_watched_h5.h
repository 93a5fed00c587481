/* What is watched in a study, and its statistics, in its HDF5 file. */
#ifndef HOOKE_IO_TABLE_STUDY_WATCHED_H5_H
#define HOOKE_IO_TABLE_STUDY_WATCHED_H5_H

#include "hooke/study.h"

#include <hdf5.h>

/* The groups "watched" and "statistics" of the group of a study, where there is something to write. */
herr_t hk_h5_write_watched(hid_t study_group, const hooke_study *study);
herr_t hk_h5_write_statistics(hid_t study_group, const hooke_study *study);
/* Bytes that they need, about. */
double hk_h5_watched_bytes(const hooke_study *study);

#endif
