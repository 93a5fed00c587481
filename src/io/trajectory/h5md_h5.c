/* The constant parts of an H5MD file. */
#include "core/crc32.h"
#include "core/memory.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/object_h5.h"
#include "io/trajectory/h5md_h5.h"
#include "io/trajectory/record.h"
#include "model/callbacks.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char units[] =
    "SI: position m, velocity m/s, time s, mass kg, energy J, power W, momentum kg m/s, "
    "angular momentum kg m^2/s";

static herr_t write_h5md(hid_t file) {
  const int32_t version[2] = {1, 1};
  hid_t h5md = hk_h5_group(file, "h5md"), author = hk_h5_group(h5md, "author"),
        creator = hk_h5_group(h5md, "creator");
  herr_t result = hk_h5_attribute(h5md, "version", H5T_NATIVE_INT32, 2, version);
  if (result >= 0) result = hk_h5_text_attribute(author, "name", "unknown");
  if (result >= 0) result = hk_h5_text_attribute(creator, "name", "hooke");
  if (result >= 0) result = hk_h5_text_attribute(creator, "version", hooke_version());
  hk_h5_drop(creator);
  hk_h5_drop(author);
  hk_h5_drop(h5md);
  return result;
}

herr_t hk_h5md_write_options(hid_t where, const hooke_options *options) {
  hid_t group = hk_h5_group(where, "options");
  herr_t result = group < 0 ? -1 : 0;
  for (int64_t k = 0; result >= 0 && k < hooke_options_row_count(options); k++) {
    const char *name = hooke_options_row(options, k, "name");
    const char *text = hooke_options_text(options, name);
    const int64_t count = hooke_options_number_count(options, name);
    if (count > 0) {
      result = hk_h5_attribute(group, name, H5T_NATIVE_DOUBLE, count, hooke_options_numbers(options, name));
    } else if (text[0]) {
      result = hk_h5_text_attribute(group, name, text);
    }
  }
  hk_h5_drop(group);
  return result;
}

/* A single text of any length: a dataset, since attributes are limited to 64 KiB. */
static herr_t write_text(hid_t where, const char *name, int64_t length, const char *text) {
  hid_t dataset = hk_h5_texts(where, name, -1, length);
  herr_t result = dataset < 0 ? -1 : hk_h5_write_text(dataset, 0, text);
  hk_h5_drop(dataset);
  return result;
}

herr_t hk_h5md_describe(hid_t file, const hooke_system *system, const char *method,
                        const hooke_options *options, const char *scene_text) {
  const int32_t abi = hooke_abi();
  herr_t result = write_h5md(file);
  hid_t group = result < 0 ? -1 : hk_h5_group(file, "hooke");
  if (group < 0) return -1;
  result = hk_h5_text_attribute(group, "version", hooke_version());
  if (result >= 0) result = hk_h5_attribute(group, "abi", H5T_NATIVE_INT32, 1, &abi);
  if (result >= 0) result = hk_h5_text_attribute(group, "units", units);
  /* what affects the bits of error-controlled methods */
  for (int k = HOOKE_RECORD_FACT; k < HOOKE_RECORD_CALLBACKS && result >= 0; k++)
    result = hk_h5_text_attribute(group, hk_record_texts[k], hooke_build_fact(hk_record_texts[k]));
  if (result >= 0 && system)
    result = hk_h5_text_attribute(group, "callbacks", hk_callbacks_text(hk_system_calls_back(system)));
  char *const *from = system ? hk_force_from(system) : NULL;
  for (int k = 0; from && k < HOOKE_FORCE_TEXTS && result >= 0; k++)
    result = hk_h5_text_attribute(group, hk_force_texts[k], from[k]);
  if (result >= 0 && method) result = hk_h5_text_attribute(group, "method", method);
  if (result >= 0 && options) result = hk_h5md_write_options(group, options);
  if (result >= 0 && scene_text) result = write_text(group, "scene", (int64_t)strlen(scene_text), scene_text);
  if (result >= 0) result = write_text(group, "status", HOOKE_OUTCOME_STATUS, "running");
  hk_h5_drop(group);
  return result;
}

herr_t hk_h5md_make_room(hid_t file) {
  const hsize_t one = 1, count = HOOKE_ERROR_COUNT;
  const int64_t none = -1;
  const uint32_t no_check = 0;
  const double unknown = NAN;
  hid_t group = hk_h5_group(file, "hooke");
  hid_t beyond = hk_h5_array(group, "beyond", H5T_NATIVE_INT64, 1, &one, &none);
  hid_t check = hk_h5_array(group, "file_check", H5T_NATIVE_UINT32, 1, &one, &no_check);
  hid_t error = hk_h5_array(group, "error", H5T_IEEE_F64LE, 1, &count, &unknown);
  herr_t result = beyond < 0 || check < 0 ? -1 : 0;
  if (result >= 0) result = hk_h5_text_attributes(error, "numbers", HOOKE_ERROR_COUNT, hk_error_number);
  if (result >= 0) result = write_text(group, "error_by", HOOKE_ERROR_BY, "");
  if (result >= 0) result = write_text(group, "error_reason", HOOKE_ERROR_REASON, "");
  hk_h5_drop(error);
  hk_h5_drop(check);
  hk_h5_drop(beyond);
  hk_h5_drop(group);
  return result;
}

/* A reference to the particles that the spring indices refer to. */
static herr_t refer(hid_t file, const char *group) {
  static const char name[] = "particles_group";
  hobj_ref_t reference;
  hid_t particles = H5Gopen2(file, "particles", H5P_DEFAULT);
  hid_t springs = H5Dopen2(file, "connectivity/springs", H5P_DEFAULT);
  hid_t space = H5Screate(H5S_SCALAR);
  herr_t result = H5Rcreate(&reference, particles, group, H5R_OBJECT, -1);
  if (result >= 0 && H5Aexists(springs, name) > 0) result = H5Adelete(springs, name);
  hid_t attribute =
      result < 0 ? -1 : H5Acreate2(springs, name, H5T_STD_REF_OBJ, space, H5P_DEFAULT, H5P_DEFAULT);
  if (result >= 0) result = H5Awrite(attribute, H5T_STD_REF_OBJ, &reference);
  hk_h5_drop(attribute);
  hk_h5_drop(space);
  hk_h5_drop(springs);
  hk_h5_drop(particles);
  return result;
}

herr_t hk_h5md_connect(hid_t file, const hooke_system *system, const char *group) {
  const hsize_t size[2] = {(hsize_t)hooke_system_count(system, "springs"), 2};
  int64_t *ends = hk_new(2 * (int64_t)size[0], sizeof *ends);
  double *rest_length = hk_new((int64_t)size[0], sizeof *rest_length);
  herr_t result = ends && rest_length &&
                          hooke_system_members(system, "springs", ends, NULL, NULL, rest_length) == HOOKE_OK
                      ? 0
                      : -1;
  if (result >= 0)
    result = hk_h5_array_of(file, "connectivity/springs", H5T_STD_I32LE, H5T_NATIVE_INT64, 2, size, ends);
  if (result >= 0) result = refer(file, group);
  if (result >= 0)
    result =
        hk_h5_array_of(file, "hooke/rest_length", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, size, rest_length);
  hk_free(rest_length);
  hk_free(ends);
  return result;
}

/* Some versions of HDF5 do not survive a write that fails here; with our driver none does. */
herr_t hk_h5md_copy(hid_t from, hid_t to, struct hk_frame_file *frames) {
  static const char *const names[] = {"h5md", "hooke", "connectivity", "box", "species", "mass"};
  hid_t links = hk_h5_new_links();
  herr_t result = links < 0 ? -1 : 0;
  for (int k = 0; result >= 0 && k < 6; k++) {
    char path[32];
    snprintf(path, sizeof path, "%s%s", k < 3 ? "" : "particles/all/", names[k]);
    result = H5Ocopy(from, path, to, path, H5P_DEFAULT, links);
  }
  hk_h5_drop(links);
  if (result >= 0) result = H5Ldelete(to, "hooke/frame_check", H5P_DEFAULT);
  if (result >= 0) result = hk_frame_arrays_make(to, frames);
  return result < 0 ? result : refer(to, "all");
}

void hk_h5md_find(hid_t file, int64_t at[HOOKE_PART_COUNT]) {
  hid_t group = hk_h5_open_own(file, "hooke");
  for (int k = 0; k < HOOKE_PART_COUNT; k++) {
    hid_t data = hk_h5_open_own(group, hk_outcome_parts[k].name);
    at[k] = hk_h5_place(data, -1, hk_outcome_parts[k].bytes);
    hk_h5_drop(data);
  }
  hk_h5_drop(group);
}

int32_t hk_h5md_is_over(hid_t file) {
  char *word = NULL;
  hid_t group = hk_h5_open_own(file, "hooke");
  hk_h5_read_text(group, "status", &word);
  const int32_t is_over = hk_outcome_is_end(word);
  hk_free(word);
  hk_h5_drop(group);
  return is_over;
}

herr_t hk_h5md_set_status(hid_t file, int32_t outcome) {
  hid_t dataset = H5Dopen2(file, "hooke/status", H5P_DEFAULT);
  herr_t result = dataset < 0 ? -1 : hk_h5_write_text(dataset, 0, hk_outcome_word(outcome));
  hk_h5_drop(dataset);
  return result;
}

/* ---- check values ---- */

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

static int32_t add_array(struct hk_h5_guard *guard, const char *name, uint32_t *value) {
  double *numbers;
  int64_t rows, columns;
  const int32_t status = hk_array_read_open(guard, name, 0, 0, 0, &numbers, &rows, &columns);
  if (status == HOOKE_OK) *value = hk_crc32(*value, numbers, rows * columns * (int64_t)sizeof *numbers);
  hk_free(numbers);
  return status;
}

int32_t hk_file_check_description(struct hk_h5_guard *guard, const char *scene, uint32_t *value) {
  static const char *const arrays[] = {"/particles/all/mass", "/particles/all/species",
                                       "/connectivity/springs", "/hooke/rest_length"};
  hid_t group = hk_h5_open_own(guard->file, "hooke"), options = hk_h5_open_own(group, "options");
  *value = 0;
  herr_t result = add_attributes(value, group);
  if (result >= 0) result = add_attributes(value, options);
  hk_h5_drop(options);
  hk_h5_drop(group);
  int32_t status =
      result < 0 || guard->reason[0] ? hk_h5_fail(guard, "read what it says of its run") : HOOKE_OK;
  for (size_t k = 0; k < sizeof arrays / sizeof arrays[0] && status == HOOKE_OK; k++)
    status = add_array(guard, arrays[k], value);
  if (scene) *value = hk_crc32(*value, scene, (int64_t)strlen(scene));
  return status;
}

int32_t hk_file_check_read(struct hk_h5_guard *guard, uint32_t *value, int32_t *there) {
  struct hk_dataset data;
  int32_t status = hk_dataset_open(guard, "/hooke/file_check", 1, &data);
  *there = status == HOOKE_OK && data.id >= 0;
  if (*there && (data.rank != 1 || data.size[0] != 1))
    status = hk_dataset_refuse(&data, "is not one check value");
  else if (*there && H5Dread(data.id, H5T_NATIVE_UINT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) < 0)
    status = hk_h5_fail(guard, "read its check value");
  hk_h5_drop(data.id);
  return status;
}

#endif
