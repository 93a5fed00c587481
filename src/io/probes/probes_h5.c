/* The table of probes: /probes, one row a line, with a column for the time and one for each quantity. */
#include "core/status.h"
#include "io/probes/probes.h"

#if HOOKE_HAVE_HDF5

#include "core/memory.h"
#include "io/hdf5/object_h5.h"

#include <math.h>

static hid_t row_type(const struct hk_watched_list *list) {
  hid_t type = H5Tcreate(H5T_COMPOUND, ((size_t)list->count + 1) * sizeof(double));
  herr_t result = type < 0 ? -1 : H5Tinsert(type, "time", 0, H5T_NATIVE_DOUBLE);
  for (int64_t k = 0; k < list->count && result >= 0; k++)
    result = H5Tinsert(type, list->item[k].text, ((size_t)k + 1) * sizeof(double), H5T_NATIVE_DOUBLE);
  if (result >= 0) return type;
  hk_h5_drop(type);
  return -1;
}

static herr_t write_units(hid_t dataset, const struct hk_watched_list *list) {
  const char **units = hk_new(list->count + 1, sizeof *units);
  if (units == NULL) return -1;
  units[0] = "s";
  for (int64_t k = 0; k < list->count; k++)
    units[k + 1] = hk_watched_unit(&list->item[k]);
  const herr_t result = hk_h5_text_attributes(dataset, "units", list->count + 1, units);
  hk_free(units);
  return result;
}

/* Returns the offset of the lines; -1 on failure. */
static int64_t make_table(hid_t file, const struct hk_watched_list *list, int64_t lines) {
  const hsize_t size = (hsize_t)lines;
  double *fill = hk_new(list->count + 1, sizeof *fill);
  hid_t type = fill ? row_type(list) : -1, dataset = -1;
  for (int64_t k = 0; fill && k <= list->count; k++)
    fill[k] = NAN;
  if (type >= 0) dataset = hk_h5_array(file, "probes", type, 1, &size, fill);
  const herr_t result = dataset < 0 ? -1 : write_units(dataset, list);
  const int64_t bytes = lines * (list->count + 1) * (int64_t)sizeof(double);
  const int64_t begin = result < 0 ? -1 : hk_h5_place(dataset, type, bytes);
  hk_h5_drop(dataset);
  hk_h5_drop(type);
  hk_free(fill);
  return begin;
}

int32_t hk_probes_make_table(const struct hk_watched_list *list, int64_t lines,
                             const struct hk_atomic_file *atomic, int64_t *begin) {
  struct hk_h5_file file;
  const double bytes = (double)lines * (double)(list->count + 1) * (double)sizeof(double);
  int32_t status = hk_h5_file_create(bytes, atomic, &file);
  if (status == HOOKE_OK && (*begin = make_table(file.guard.file, list, lines)) < 0)
    status = hk_h5_fail(&file.guard, "make room for all lines");
  return hk_h5_file_settle(&file, status);
}

#else

int32_t hk_probes_make_table(const struct hk_watched_list *list, int64_t lines,
                             const struct hk_atomic_file *file, int64_t *begin) {
  (void)list, (void)lines, (void)begin;
  return hk_fail(HOOKE_NOT_BUILT, NULL,
                 "%s: probes in HDF5 need HDF5, which this build is without; a .csv does not", file->path);
}

#endif
