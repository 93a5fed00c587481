/* Watched quantities over a run, in a file that is written while it goes: a line a time. A table in HDF5 has
 * room for every line from the start, so that a killed run leaves what it had written. */
#pragma once

#include "core/table/option.h"
#include "hooke/trajectory.h"
#include "io/file/atomic_file.h"
#include "io/file/text.h"
#include "measure/quantity/watched.h"

struct hooke_probes {
  struct hk_atomic_file file;
  struct hk_watched_list list;
  hooke_integrator *integrator;
  int32_t is_table;       /* 1: HDF5; 0: CSV */
  double *line;           /* the time and the values */
  struct hk_text text;    /* the same as CSV */
  int64_t planned, lines; /* lines of the whole run, lines written */
  int64_t begin, at;      /* where the lines begin in the file, where the next one goes */
  double last;            /* time of the last one [s] */
  char failure[512];      /* message of the write that failed; "" while all is well */
};

extern const struct hk_option_table hk_probes_options;

/* Makes an HDF5 file with a table of so many lines, all NaN, in `file`, which was just made, and tells where
 * they begin. HOOKE_IO_FAILED, HOOKE_NO_MEMORY, HOOKE_NOT_BUILT. */
int32_t hk_probes_make_table(const struct hk_watched_list *list, int64_t lines,
                             const struct hk_atomic_file *file, int64_t *begin);
