/* A trajectory file opened for reading. */
#pragma once

#include "hooke/trajectory.h"
#include "io/trajectory/frame_file.h"
#include "io/trajectory/outcome.h"
#include "model/callbacks.h"

/* Texts of the group /hooke: arrays, then attributes. */
enum { HOOKE_RECORD_SCENE, HOOKE_RECORD_STATUS, HOOKE_RECORD_BY, HOOKE_RECORD_REASON, HOOKE_RECORD_ARRAYS };
enum {
  HOOKE_RECORD_RUN = HOOKE_RECORD_ARRAYS,
  HOOKE_RECORD_FACT = HOOKE_RECORD_RUN + 2, /* of the build, after its version */
  HOOKE_RECORD_CALLBACKS = 11,
  HOOKE_RECORD_FORCE, /* where it is from */
  HOOKE_RECORD_TEXTS = HOOKE_RECORD_FORCE + HOOKE_FORCE_TEXTS
};
extern const char *const hk_record_texts[HOOKE_RECORD_TEXTS];

struct hooke_record {
  char *path, *text[HOOKE_RECORD_TEXTS]; /* NULL: the file has no such array */
  hooke_options *options;                /* of a run, as stored */
  int32_t is_run;                        /* 0: of several runs, such as a comparison or a study */
  int32_t is_covered;                    /* by check values: everything but the frames; 0 in older files */
  uint32_t description, outcome;         /* their check values */
  int64_t at[HOOKE_PART_COUNT];
  struct hk_frame_file frames;
  int64_t frame_count, good_count; /* frames that are there, and those before divergence */
  double *time;
  struct {
    char dataset[64];
    double *value;
    int64_t rows, columns;
  } kept; /* cached numbers, whose size was requested */
};

/* Reads all but frames from the file of `path`. HOOKE_IO_FAILED, HOOKE_BAD_VALUE, HOOKE_NO_MEMORY,
 * HOOKE_NOT_BUILT, as the others. */
int32_t hk_record_load(hooke_record *record);
/* Compares frame `at` with its check value, and reads it, of `size` numbers, unless q and v are NULL;
 * hk_free() releases these in any case. */
int32_t hk_record_read_frame(const hooke_record *record, int64_t at, int64_t size, double **q, double **v);

/* 1 if the file begins with the HDF5 signature. */
int32_t hk_record_is_one(const char *path);

/* Path that it was opened by; valid as long as the record. */
const char *hk_record_path(const hooke_record *record);

/* HOOKE_BAD_VALUE unless a finished run has the frames that its options ask for. */
int32_t hk_record_check_count(const hooke_record *record);

/* HOOKE_BAD_VALUE for a file of several runs. */
int32_t hk_record_require_run(const hooke_record *record);
