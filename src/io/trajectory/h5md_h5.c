/* The constant parts of an H5MD file. */
#include "core/crc32.h"
#include "core/memory.h"
#include "core/status.h"

#if HOOKE_HAVE_HDF5

#include "io/file/bytes.h"
#include "core/os/os_file.h"
#include "core/print.h"
#include "io/trajectory/error_h5.h"
#include "io/trajectory/file_check_h5.h"
#include "io/trajectory/h5md_h5.h"
#include "io/hdf5/object_h5.h"
#include "io/file/atomic_file.h"
#include "model/callbacks.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

const char *const hk_error_number[HOOKE_ERROR_COUNT] = {"estimate",    "rms",        "known_until",
                                                        "energy_rise", "wanted",     "met",
                                                        "heat_excess", "last_piece", "last_from"};

static const char units[] =
    "SI: position m, velocity m/s, time s, mass kg, energy J, power W, momentum kg m/s, "
    "angular momentum kg m^2/s";

/* A group with attributes; the caller closes it. */
static hid_t new_group(hid_t where, const char *name) {
  return H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

static herr_t write_h5md(hid_t file) {
  const int32_t version[2] = {1, 1};
  hid_t h5md = new_group(file, "h5md");
  hid_t author = h5md < 0 ? -1 : new_group(h5md, "author");
  hid_t creator = author < 0 ? -1 : new_group(h5md, "creator");
  herr_t result = creator < 0 ? -1 : hk_h5_integer_attribute(h5md, "version", 2, version);
  if (result >= 0) result = hk_h5_text_attribute(author, "name", "unknown");
  if (result >= 0) result = hk_h5_text_attribute(creator, "name", "hooke");
  if (result >= 0) result = hk_h5_text_attribute(creator, "version", hooke_version());
  hk_h5_drop(creator);
  hk_h5_drop(author);
  hk_h5_drop(h5md);
  return result;
}

herr_t hk_h5md_write_options(hid_t where, const hooke_options *options) {
  hid_t group = new_group(where, "options");
  herr_t result = group < 0 ? -1 : 0;
  for (int64_t k = 0; result >= 0 && k < hooke_options_row_count(options); k++) {
    const char *name = hooke_options_row(options, k, "name");
    const char *text = hooke_options_text(options, name);
    const int64_t count = hooke_options_number_count(options, name);
    if (count > 0) {
      result = hk_h5_number_attribute(group, name, count, hooke_options_numbers(options, name));
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

/* The libraries that affect the bits of error-controlled methods. */
static herr_t write_facts(hid_t group) {
  static const char *const facts[] = {"sundials", "cholmod", "instructions", "machine"};
  herr_t result = 0;
  for (int k = 0; k < 4 && result >= 0; k++)
    result = hk_h5_text_attribute(group, facts[k], hooke_build_fact(facts[k]));
  return result;
}

herr_t hk_h5md_describe(hid_t file, const hooke_system *system, const char *method,
                        const hooke_options *options, const char *scene_text) {
  const int32_t abi = hooke_abi();
  herr_t result = write_h5md(file);
  hid_t group = result < 0 ? -1 : new_group(file, "hooke");
  if (group < 0) return -1;
  result = hk_h5_text_attribute(group, "version", hooke_version());
  if (result >= 0) result = hk_h5_integer_attribute(group, "abi", 1, &abi);
  if (result >= 0) result = hk_h5_text_attribute(group, "units", units);
  if (result >= 0) result = write_facts(group);
  if (result >= 0 && system)
    result = hk_h5_text_attribute(group, "callbacks", hk_callbacks_text(hk_system_calls_back(system)));
  if (result >= 0 && method) result = hk_h5_text_attribute(group, "method", method);
  if (result >= 0 && options) result = hk_h5md_write_options(group, options);
  if (result >= 0 && scene_text) result = write_text(group, "scene", (int64_t)strlen(scene_text), scene_text);
  if (result >= 0) result = write_text(group, "status", HOOKE_H5MD_STATUS, "running");
  hk_h5_drop(group);
  return result;
}

int32_t hk_h5md_new_run(uint32_t description, char run[HOOKE_RUN_SIZE]) {
  unsigned char random[HOOKE_RUN_RANDOM / 2];
  char reason[HOOKE_ERROR_SIZE];
  if (hk_os_random(random, sizeof random) != 0)
    return hk_fail(HOOKE_IO_FAILED, NULL, "could not take a random number for the run: %s",
                   hk_print_error(errno, reason));
  for (size_t k = 0; k < sizeof random; k++)
    snprintf(run + 2 * k, 3, "%02x", random[k]);
  snprintf(run + HOOKE_RUN_RANDOM, HOOKE_RUN_SIZE - HOOKE_RUN_RANDOM, "%08x",
           (unsigned)hk_crc32(description, run, HOOKE_RUN_RANDOM));
  return HOOKE_OK;
}

herr_t hk_h5md_write_run(hid_t file, const char *run) {
  hid_t group = H5Gopen2(file, "hooke", H5P_DEFAULT);
  herr_t result = group < 0 ? -1 : hk_h5_text_attribute(group, "run", run);
  hk_h5_drop(group);
  return result;
}

herr_t hk_h5md_make_room(hid_t file) {
  const hsize_t one = 1, count = HOOKE_ERROR_COUNT;
  const int64_t none = -1;
  const double unknown = NAN;
  hid_t group = H5Gopen2(file, "hooke", H5P_DEFAULT);
  hid_t beyond = group < 0 ? -1 : hk_h5_array(group, "beyond", H5T_NATIVE_INT64, 1, &one, &none);
  hid_t check = beyond < 0 ? -1 : hk_h5_array(group, "file_check", H5T_NATIVE_UINT32, 1, &one, NULL);
  hid_t error = check < 0 ? -1 : hk_h5_array(group, "error", H5T_IEEE_F64LE, 1, &count, &unknown);
  herr_t result =
      error < 0 ? -1 : hk_h5_text_attributes(error, "numbers", HOOKE_ERROR_COUNT, hk_error_number);
  if (result >= 0) result = write_text(group, "error_by", HOOKE_ERROR_BY, "");
  if (result >= 0) result = write_text(group, "error_reason", HOOKE_ERROR_REASON, "");
  hk_h5_drop(error);
  hk_h5_drop(check);
  hk_h5_drop(beyond);
  hk_h5_drop(group);
  return result;
}

/* A reference to the particles that the spring indices refer to. */
herr_t hk_h5md_refer(hid_t file, const char *group) {
  hobj_ref_t reference;
  hid_t particles = H5Gopen2(file, "particles", H5P_DEFAULT);
  hid_t springs = H5Dopen2(file, "connectivity/springs", H5P_DEFAULT);
  hid_t space = H5Screate(H5S_SCALAR);
  hid_t attribute = -1;
  herr_t result = particles < 0 || springs < 0 || space < 0 ? -1 : 0;
  if (result >= 0) result = H5Rcreate(&reference, particles, group, H5R_OBJECT, -1);
  if (result >= 0) {
    attribute = H5Acreate2(springs, "particles_group", H5T_STD_REF_OBJ, space, H5P_DEFAULT, H5P_DEFAULT);
    result = attribute < 0 ? -1 : H5Awrite(attribute, H5T_STD_REF_OBJ, &reference);
  }
  hk_h5_drop(attribute);
  hk_h5_drop(space);
  hk_h5_drop(springs);
  hk_h5_drop(particles);
  return result;
}

static herr_t write_rest_lengths(hid_t file, const hooke_system *system) {
  const hsize_t count = (hsize_t)hooke_system_count(system, "springs");
  double *rest_length = hk_new((int64_t)count, sizeof(double));
  herr_t result = rest_length == NULL ? -1 : 0;
  if (result >= 0 && hooke_system_members(system, "springs", NULL, NULL, NULL, rest_length) != HOOKE_OK)
    result = -1;
  if (result >= 0) {
    result =
        hk_h5_array_of(file, "hooke/rest_length", H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE, 1, &count, rest_length);
  }
  hk_free(rest_length);
  return result;
}

herr_t hk_h5md_connect(hid_t file, const hooke_system *system, const char *group) {
  const int64_t count = hooke_system_count(system, "springs");
  const hsize_t size[2] = {(hsize_t)count, 2};
  int64_t *ends = hk_new(2 * count, sizeof(int64_t));
  hid_t connectivity = ends ? new_group(file, "connectivity") : -1;
  herr_t result =
      connectivity < 0 || hooke_system_members(system, "springs", ends, NULL, NULL, NULL) != HOOKE_OK ? -1
                                                                                                      : 0;
  if (result >= 0)
    result = hk_h5_array_of(connectivity, "springs", H5T_STD_I32LE, H5T_NATIVE_INT64, 2, size, ends);
  if (result >= 0) result = hk_h5md_refer(file, group);
  hk_h5_drop(connectivity);
  hk_free(ends);
  return result < 0 ? result : write_rest_lengths(file, system);
}

herr_t hk_h5md_copy(hid_t from, hid_t to, struct hk_h5_copy *copy) {
  const char *const names[] = {"h5md", "hooke", "connectivity"};
  herr_t result = 0;
  for (int k = 0; result >= 0 && k < 3; k++)
    result = hk_h5_copy(from, to, names[k], "frame_check", copy);
  return result;
}

const char *hk_h5md_word(int32_t outcome) {
  switch (outcome) {
  case HOOKE_OK:
    return "finished";
  case HOOKE_STOPPED:
    return "stopped";
  case HOOKE_DIVERGED:
    return "diverged";
  case HOOKE_STEP_LIMIT:
    return "step-limit";
  case HOOKE_SOLVER_FAILED:
    return "solver-failed";
  case HOOKE_H5MD_RUNNING:
    return "running";
  default:
    return "failed";
  }
}

/* Offset of an array of so many bytes in the file; -1 if there is none. */
static int64_t place(hid_t group, const char *name, hsize_t bytes) {
  hid_t data = hk_h5_open_own(group, name);
  const int is_own = data >= 0 && H5Iget_type(data) == H5I_DATASET && !hk_h5_foreign(data);
  const haddr_t first = is_own ? H5Dget_offset(data) : HADDR_UNDEF;
  const int fits = first != HADDR_UNDEF && H5Dget_storage_size(data) == bytes;
  hk_h5_drop(data);
  return fits ? (int64_t)first : -1;
}

void hk_h5md_find(hid_t file, struct hk_h5md_places *at) {
  hid_t group = hk_h5_open_own(file, "hooke");
  at->status = place(group, "status", HOOKE_H5MD_STATUS);
  at->beyond = place(group, "beyond", sizeof(int64_t));
  at->check = place(group, "file_check", sizeof(uint32_t));
  at->error = place(group, "error", HOOKE_ERROR_COUNT * sizeof(double));
  at->error_by = place(group, "error_by", HOOKE_ERROR_BY);
  at->error_reason = place(group, "error_reason", HOOKE_ERROR_REASON);
  hk_h5_drop(group);
}

int hk_h5md_write_status(int descriptor, int64_t at, int32_t outcome) {
  char word[HOOKE_H5MD_STATUS] = {0};
  snprintf(word, sizeof word, "%s", hk_h5md_word(outcome));
  return hk_bytes_write(descriptor, at, sizeof word, word);
}

int32_t hk_h5md_is_end(const char *status) {
  return status && strcmp(status, "running") != 0 && strcmp(status, "failed") != 0;
}

int32_t hk_h5md_is_over(hid_t file) {
  char *word = NULL;
  hid_t group = hk_h5_open_own(file, "hooke");
  hk_h5_read_text(group, "status", &word);
  const int32_t is_over = hk_h5md_is_end(word);
  hk_free(word);
  hk_h5_drop(group);
  return is_over;
}

int hk_h5md_write(int descriptor, int64_t at, int64_t bytes, const void *data) {
  return at < 0 ? 0 : hk_bytes_write(descriptor, at, bytes, data);
}

herr_t hk_h5md_set_status(hid_t file, int32_t outcome) {
  hid_t dataset = H5Dopen2(file, "hooke/status", H5P_DEFAULT);
  herr_t result = dataset < 0 ? -1 : hk_h5_write_text(dataset, 0, hk_h5md_word(outcome));
  hk_h5_drop(dataset);
  return result;
}

#endif
