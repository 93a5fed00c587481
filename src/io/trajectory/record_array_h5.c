/* Whole arrays of a trajectory file, and the offsets of those that are too large to copy. */
#include "hooke/trajectory.h"

#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/array_h5.h"
#include "io/trajectory/frame_file.h"
#include "io/hdf5/object_h5.h"
#include "io/trajectory/record_h5.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- whole arrays ---- */

static int32_t find_dataset(const char *what, char *dataset, size_t capacity) {
  static const struct {
    const char *what, *dataset;
  } known[] = {{"time", "/particles/all/position/time"}, {"step", "/particles/all/position/step"},
               {"springs", "/connectivity/springs"},     {"mass", "/particles/all/mass"},
               {"species", "/particles/all/species"},    {"error", "/hooke/error"}};
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++) {
    if (strcmp(what, known[k].what) != 0) continue;
    snprintf(dataset, capacity, "%s", known[k].dataset);
    return HOOKE_OK;
  }
  for (int k = 0; k < HOOKE_OBSERVABLE_COUNT; k++) {
    if (strcmp(what, hk_observables[k].name) != 0) continue;
    snprintf(dataset, capacity, "/observables/%s/value", what);
    return HOOKE_OK;
  }
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "a trajectory has no \"%.80s\"; allowed: time, step, springs, mass, species, error, or a "
                 "quantity such as kinetic_energy",
                 what);
}

static void drop_kept(hooke_record *record) {
  hk_free(record->kept.value);
  record->kept.value = NULL;
}

/* Reads the array unless it is the cached one. */
static int32_t keep(hooke_record *record, const char *what) {
  char dataset[sizeof record->kept.dataset];
  const int32_t status = find_dataset(what, dataset, sizeof dataset);
  if (status != HOOKE_OK) return status;
  if (record->kept.value && strcmp(record->kept.dataset, dataset) == 0) return HOOKE_OK;
  drop_kept(record);
  snprintf(record->kept.dataset, sizeof record->kept.dataset, "%s", dataset);
  const int32_t read = hk_array_read(record->path, dataset, 0, 0, &record->kept.value, &record->kept.rows,
                                     &record->kept.columns);
  const int unknown = strcmp(what, "error") == 0 && !hooke_record_text(record, "error_by")[0] &&
                      !hooke_record_text(record, "error_reason")[0];
  for (int64_t k = 0; read == HOOKE_OK && unknown && k < record->kept.rows * record->kept.columns; k++)
    record->kept.value[k] = NAN;
  return read;
}

int32_t hooke_record_size(hooke_record *record, const char *what, int64_t *rows, int64_t *columns) {
  const int32_t status = keep(record, what);
  *rows = status == HOOKE_OK ? record->kept.rows : 0;
  *columns = status == HOOKE_OK ? record->kept.columns : 0;
  return status;
}

int32_t hooke_record_numbers(hooke_record *record, const char *what, double *values) {
  const int32_t status = keep(record, what);
  if (status != HOOKE_OK) return status;
  const size_t count = (size_t)(record->kept.rows * record->kept.columns);
  if (count > 0) memcpy(values, record->kept.value, count * sizeof(double));
  drop_kept(record);
  return HOOKE_OK;
}

/* ---- offsets ---- */

static int is_plain(hid_t data) {
  if (H5Iget_type(data) != H5I_DATASET || hk_h5_foreign(data)) return 0;
  hid_t type = H5Dget_type(data), list = H5Dget_create_plist(data), space = H5Dget_space(data);
  const int plain = type >= 0 && list >= 0 && space >= 0 && H5Tequal(type, H5T_NATIVE_DOUBLE) > 0 &&
                    H5Pget_layout(list) == H5D_CONTIGUOUS && H5Sget_simple_extent_ndims(space) == 3;
  hk_h5_drop(space);
  hk_h5_drop(list);
  hk_h5_drop(type);
  return plain;
}

void hk_record_find_places(hooke_record *record, hid_t file) {
  static const char *const name[HOOKE_PLACE_COUNT] = {"position", "velocity"};
  hid_t particles = hk_h5_open_own(file, "particles"), all = hk_h5_open_own(particles, "all");
  for (int k = 0; k < HOOKE_PLACE_COUNT; k++) {
    hid_t array = hk_h5_open_own(all, name[k]), data = hk_h5_open_own(array, "value");
    const haddr_t at = data >= 0 && is_plain(data) ? H5Dget_offset(data) : HADDR_UNDEF;
    record->place[k] = at == HADDR_UNDEF ? -1 : (int64_t)at;
    hk_h5_drop(data);
    hk_h5_drop(array);
  }
  hk_h5_drop(all);
  hk_h5_drop(particles);
}

int64_t hooke_record_place(const hooke_record *record, const char *what) {
  if (strcmp(what, "position") == 0) return record->place[HOOKE_PLACE_POSITION];
  return strcmp(what, "velocity") == 0 ? record->place[HOOKE_PLACE_VELOCITY] : -1;
}

#else

static int32_t refuse(void) {
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "reading trajectories needs HDF5, which this build of the library is without");
}

int32_t hooke_record_size(hooke_record *record, const char *what, int64_t *rows, int64_t *columns) {
  (void)record, (void)what;
  *rows = *columns = 0;
  return refuse();
}

int32_t hooke_record_numbers(hooke_record *record, const char *what, double *values) {
  (void)record, (void)what, (void)values;
  return refuse();
}

int64_t hooke_record_place(const hooke_record *record, const char *what) {
  (void)record, (void)what;
  return -1;
}

#endif
