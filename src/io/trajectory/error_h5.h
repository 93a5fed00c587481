/* The error of a run in its trajectory file. */
#ifndef HOOKE_IO_TRAJECTORY_ERROR_H5_H
#define HOOKE_IO_TRAJECTORY_ERROR_H5_H

/* Bytes of the texts, and columns of the numbers in the table of an estimate. */
enum { HOOKE_ERROR_BY = 16, HOOKE_ERROR_REASON = 256, HOOKE_ERROR_COUNT = 9 };
extern const char *const hk_error_number[HOOKE_ERROR_COUNT];

#endif
