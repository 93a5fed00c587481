#include "core/memory.h"

#if HOOKE_HAVE_HDF5

#include "io/file/bytes.h"
#include "io/hdf5/copy_h5.h"
#include "io/hdf5/object_h5.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { NAME_SIZE = 256, BLOCK = 1 << 16 };

/* ---- attributes ---- */

static herr_t copy_value(hid_t attribute, hid_t to, const char *name, hid_t type, hid_t space) {
  void *value = hk_new((int64_t)H5Sget_simple_extent_npoints(space), H5Tget_size(type));
  if (value == NULL) return -1;
  herr_t result = H5Aread(attribute, type, value);
  if (result >= 0) {
    hid_t copied = H5Acreate2(to, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    result = copied < 0 ? -1 : H5Awrite(copied, type, value);
    hk_h5_drop(copied);
    H5Dvlen_reclaim(type, space, H5P_DEFAULT, value); /* texts */
  }
  hk_free(value);
  return result;
}

/* A reference would point into the old file. */
static herr_t copy_attribute(hid_t from, const char *name, const H5A_info_t *info, void *ctx) {
  (void)info;
  const hid_t *to = ctx;
  hid_t attribute = H5Aopen(from, name, H5P_DEFAULT);
  hid_t type = attribute < 0 ? -1 : H5Aget_type(attribute), space = type < 0 ? -1 : H5Aget_space(attribute);
  herr_t result = space < 0 ? -1 : 0;
  if (result >= 0 && H5Tget_class(type) != H5T_REFERENCE)
    result = copy_value(attribute, *to, name, type, space);
  hk_h5_drop(space);
  hk_h5_drop(type);
  hk_h5_drop(attribute);
  return result;
}

static herr_t copy_attributes(hid_t from, hid_t to) {
  return H5Aiterate2(from, H5_INDEX_NAME, H5_ITER_INC, NULL, copy_attribute, &to);
}

/* ---- arrays ---- */

static herr_t add_piece(struct hk_h5_copy *copy, hid_t from, hid_t to) {
  const hsize_t bytes = H5Dget_storage_size(from);
  const haddr_t here = H5Dget_offset(from), there = H5Dget_offset(to);
  if (bytes == 0) return 0;
  if (here == HADDR_UNDEF || there == HADDR_UNDEF || H5Dget_storage_size(to) != bytes) return -1;
  void *grown = copy->piece;
  if (hk_grow(&grown, copy->count, copy->count + 1, sizeof *copy->piece) != HOOKE_OK) return -1;
  copy->piece = grown;
  copy->piece[copy->count].from = (int64_t)here;
  copy->piece[copy->count].to = (int64_t)there;
  copy->piece[copy->count++].bytes = (int64_t)bytes;
  return 0;
}

static herr_t copy_array(hid_t from, hid_t where, const char *path, struct hk_h5_copy *copy) {
  const char *foreign = hk_h5_foreign(from);
  if (foreign) {
    snprintf(copy->guard->reason, sizeof copy->guard->reason, "dataset %.100s %s", path, foreign);
    return -1;
  }
  hid_t type = H5Dget_type(from), space = H5Dget_space(from), list = H5Dget_create_plist(from), to = -1;
  herr_t result = type < 0 || space < 0 || list < 0 ? -1 : H5Pset_obj_track_times(list, 0);
  if (result >= 0) to = H5Dcreate2(where, path, type, space, H5P_DEFAULT, list, H5P_DEFAULT);
  result = to < 0 ? -1 : copy_attributes(from, to);
  if (result >= 0) result = add_piece(copy, from, to);
  hk_h5_drop(to);
  hk_h5_drop(list);
  hk_h5_drop(space);
  hk_h5_drop(type);
  return result;
}

/* ---- groups ---- */

static herr_t copy_members(hid_t from_file, hid_t to_file, hid_t group, const char *path, const char *skip,
                           struct hk_h5_copy *copy) {
  H5G_info_t info;
  herr_t result = H5Gget_info(group, &info);
  for (hsize_t k = 0; result >= 0 && k < info.nlinks; k++) {
    char name[NAME_SIZE], inside[NAME_SIZE];
    const ssize_t length =
        H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, k, name, sizeof name, H5P_DEFAULT);
    if (length < 0 || length >= NAME_SIZE) return -1;
    if (skip && strcmp(name, skip) == 0) continue;
    if (snprintf(inside, sizeof inside, "%s/%s", path, name) >= NAME_SIZE) return -1;
    result = hk_h5_copy(from_file, to_file, inside, skip, copy);
  }
  return result;
}

herr_t hk_h5_copy(hid_t from, hid_t to, const char *path, const char *skip, struct hk_h5_copy *copy) {
  hid_t list = hk_h5_own_links(copy->guard), object = list < 0 ? -1 : H5Oopen(from, path, list);
  herr_t result = object < 0 ? -1 : 0;
  if (result >= 0 && H5Iget_type(object) == H5I_DATASET) {
    result = copy_array(object, to, path, copy);
  } else if (result >= 0) {
    hid_t group = H5Gcreate2(to, path, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    result = group < 0 ? -1 : copy_attributes(object, group);
    hk_h5_drop(group);
    if (result >= 0) result = copy_members(from, to, object, path, skip, copy);
  }
  hk_h5_drop(object);
  hk_h5_drop(list);
  return result;
}

/* ---- bytes ---- */

int hk_h5_copy_bytes(const struct hk_h5_copy *copy, int from, int to) {
  char *block = hk_reserve(BLOCK, 1);
  int error = block ? 0 : ENOMEM;
  for (int64_t k = 0; error == 0 && k < copy->count; k++)
    error =
        hk_bytes_copy(from, copy->piece[k].from, to, copy->piece[k].to, copy->piece[k].bytes, block, BLOCK);
  hk_free(block);
  return error;
}

void hk_h5_copy_release(struct hk_h5_copy *copy) {
  hk_free(copy->piece);
  *copy = (struct hk_h5_copy){0};
}

#endif
