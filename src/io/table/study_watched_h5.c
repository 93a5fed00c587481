/* The groups of what is watched. */
#include "core/memory.h"

#if HOOKE_HAVE_HDF5

#include "io/table/study_watched_h5.h"

#include "io/hdf5/object_h5.h"
#include "measure/study/study.h"

#include <string.h>

enum { LEAST_LENGTH = 32 };

static hid_t new_group(hid_t where, const char *name) {
  return H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

static int64_t longest(const struct hk_watched_list *list) {
  size_t length = LEAST_LENGTH;
  for (int64_t k = 0; k < list->count; k++) {
    const size_t own = strlen(list->item[k].text) + 1;
    length = own > length ? own : length;
  }
  return (int64_t)length;
}

/* "quantity" and "unit" */
static herr_t write_names(hid_t group, const struct hk_watched_list *list) {
  hid_t name = hk_h5_texts(group, "quantity", list->count, longest(list));
  hid_t unit = hk_h5_texts(group, "unit", list->count, LEAST_LENGTH);
  herr_t result = name < 0 || unit < 0 ? -1 : 0;
  for (int64_t k = 0; result >= 0 && k < list->count; k++) {
    result = hk_h5_write_text(name, k, list->item[k].text);
    if (result >= 0) result = hk_h5_write_text(unit, k, hk_watched_unit(&list->item[k]));
  }
  hk_h5_drop(unit);
  hk_h5_drop(name);
  return result;
}

static herr_t write_table(hid_t group, const char *name, int64_t rows, int64_t columns, const double *table) {
  const hsize_t size[2] = {(hsize_t)rows, (hsize_t)columns};
  return hk_h5_array_of(group, name, H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, columns > 0 ? 2 : 1, size, table);
}

herr_t hk_h5_write_watched(hid_t study_group, const hooke_study *study) {
  const struct hk_watched_list *list = &study->watched;
  const struct hk_watched_series *reference = &study->reference.frames.watched;
  if (list->count == 0 || reference->list == NULL) return 0;
  const int64_t rows = study->row_count;
  double *table = hk_new(rows * list->count, sizeof *table);
  hid_t group = table ? new_group(study_group, "watched") : -1;
  herr_t result = group < 0 ? -1 : write_names(group, list);
  for (int64_t k = 0; table && k < rows * list->count; k++)
    table[k] = study->row[k / list->count].trial.watched.figure[k % list->count];
  if (result >= 0) result = write_table(group, "agreement", list->count, 0, reference->figure);
  if (result >= 0 && rows > 0) result = write_table(group, "error", rows, list->count, table);
  hk_h5_drop(group);
  hk_free(table);
  return result;
}

/* ---- statistics ---- */

static const char *source_name(const hooke_study *study, int64_t source) {
  const int32_t method = study->ensemble->source[source].method;
  return method < 0 ? "reference" : study->method[method];
}

static herr_t write_sources(hid_t group, const hooke_study *study) {
  const int64_t count = study->ensemble->source_count;
  hid_t name = hk_h5_texts(group, "method", count, LEAST_LENGTH);
  herr_t result = name < 0 ? -1 : 0;
  for (int64_t k = 0; result >= 0 && k < count; k++)
    result = hk_h5_write_text(name, k, source_name(study, k));
  hk_h5_drop(name);
  return result;
}

static herr_t write_figures(hid_t group, const hooke_study *study) {
  static const char *const figures[] = {"step", "rtol", "members", "failed", "mean", "spread", "bias"};
  const struct hk_ensemble *e = study->ensemble;
  const int64_t columns = e->quantities.count;
  double *table = hk_new(e->source_count * columns, sizeof *table);
  herr_t result = table ? 0 : -1;
  for (size_t f = 0; result >= 0 && f < sizeof figures / sizeof figures[0]; f++) {
    for (int64_t k = 0; k < e->source_count * columns; k++)
      table[k] = hooke_study_statistic(study, source_name(study, k / columns),
                                       e->quantities.item[k % columns].text, figures[f]);
    result = write_table(group, figures[f], e->source_count, columns, table);
  }
  hk_free(table);
  return result;
}

herr_t hk_h5_write_statistics(hid_t study_group, const hooke_study *study) {
  const struct hk_ensemble *e = study->ensemble;
  if (e == NULL || e->source_count == 0) return 0;
  const char *const names[] = {"from", "until", "noise"};
  const double numbers[] = {e->from, e->until, e->noise};
  const int32_t members = (int32_t)e->members;
  hid_t group = new_group(study_group, "statistics");
  herr_t result = group < 0 ? -1 : hk_h5_integer_attribute(group, "members", 1, &members);
  for (int k = 0; result >= 0 && k < 3; k++)
    result = hk_h5_number_attribute(group, names[k], 1, &numbers[k]);
  if (result >= 0) result = write_names(group, &e->quantities);
  if (result >= 0) result = write_sources(group, study);
  if (result >= 0) result = write_figures(group, study);
  hk_h5_drop(group);
  return result;
}

double hk_h5_watched_bytes(const hooke_study *study) {
  const struct hk_ensemble *e = study->ensemble;
  const double watched = (double)study->watched.count, rows = (double)study->row_count;
  const double figures = e ? 56.0 * (double)e->source_count * (double)e->quantities.count : 0.0;
  return watched * (8.0 * rows + (double)longest(&study->watched) + 64.0) + figures +
         (e ? (double)longest(&e->quantities) * (double)e->quantities.count + 65536.0 : 0.0);
}

#endif
