#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "core/crc32.h"
#include "io/hdf5/dataset_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/trajectory/file_check_h5.h"

#include <string.h>

static void add_text(uint32_t *value, const char *text) {
  *value = hk_crc32(*value, text, (int64_t)strlen(text) + 1);
}

static herr_t add_numbers(uint32_t *value, hid_t attribute) {
  hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
  const H5T_class_t class = type < 0 ? H5T_NO_CLASS : H5Tget_class(type);
  const hssize_t count = space < 0 ? -1 : H5Sget_simple_extent_npoints(space);
  herr_t result = count < 0 ? -1 : 0;
  if (result >= 0 && (class == H5T_FLOAT || class == H5T_INTEGER)) {
    double *number = hk_new(count, sizeof *number);
    result = number == NULL ? -1 : H5Aread(attribute, H5T_NATIVE_DOUBLE, number);
    if (result >= 0) *value = hk_crc32(*value, number, count * (int64_t)sizeof *number);
    hk_free(number);
  }
  hk_h5_drop(space);
  hk_h5_drop(type);
  return result;
}

static herr_t add_attribute(hid_t group, const char *name, const H5A_info_t *info, void *value) {
  (void)info;
  if (strcmp(name, "run") == 0) return 0; /* alike for equal runs */
  hid_t attribute = H5Aopen(group, name, H5P_DEFAULT);
  herr_t result = attribute < 0 ? -1 : 0;
  char *text = result < 0 ? NULL : hk_h5_attribute_text(attribute);
  add_text(value, name);
  if (text)
    add_text(value, text);
  else if (result >= 0)
    result = add_numbers(value, attribute);
  if (text) H5free_memory(text);
  hk_h5_drop(attribute);
  return result;
}

static herr_t add_attributes(uint32_t *value, hid_t group) {
  return group < 0 ? 0 : H5Aiterate2(group, H5_INDEX_NAME, H5_ITER_INC, NULL, add_attribute, value);
}

static int32_t add_array(struct hk_h5_guard *guard, hid_t file, const char *path, const char *name,
                         uint32_t *value) {
  double *numbers = NULL;
  int64_t rows, columns;
  const int32_t status = hk_array_read_open(guard, file, path, name, 0, 0, 0, &numbers, &rows, &columns);
  if (status == HOOKE_OK) *value = hk_crc32(*value, numbers, rows * columns * (int64_t)sizeof *numbers);
  hk_free(numbers);
  return status;
}

int32_t hk_file_check_description(struct hk_h5_guard *guard, hid_t file, const char *path, const char *scene,
                                  uint32_t *value) {
  static const char *const arrays[] = {"/particles/all/mass", "/particles/all/species",
                                       "/connectivity/springs", "/hooke/rest_length"};
  hid_t group = hk_h5_open_own(file, "hooke"), options = hk_h5_open_own(group, "options");
  *value = 0;
  herr_t result = add_attributes(value, group);
  if (result >= 0) result = add_attributes(value, options);
  hk_h5_drop(options);
  hk_h5_drop(group);
  int32_t status =
      result < 0 || guard->reason[0] ? hk_h5_fail(guard, path, "read what it says of its run") : HOOKE_OK;
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0] && status == HOOKE_OK; k++)
    status = add_array(guard, file, path, arrays[k], value);
  if (scene) *value = hk_crc32(*value, scene, (int64_t)strlen(scene));
  return status;
}

int32_t hk_file_check_read(struct hk_h5_guard *guard, hid_t file, const char *path, uint32_t *value,
                           int32_t *there) {
  static const char name[] = "/hooke/file_check";
  struct hk_dataset data;
  int32_t status = hk_dataset_find(guard, file, path, name, &data);
  *there = status == HOOKE_OK && data.id >= 0;
  if (*there && (data.rank != 1 || data.size[0] != 1))
    status = hk_dataset_refuse(path, name, "is not one check value");
  else if (*there && H5Dread(data.id, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0)
    status = hk_h5_fail(guard, path, "read its check value");
  hk_h5_drop(data.id);
  return status;
}

#endif
