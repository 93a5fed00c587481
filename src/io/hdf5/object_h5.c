/* Attributes, arrays and texts. */
#include "core/memory.h"

#if HOOKE_HAVE_HDF5

#include "io/hdf5/object_h5.h"

#include <stdio.h>
#include <string.h>

void hk_h5_drop(hid_t id) {
  if (id >= 0) H5Idec_ref(id);
}

hid_t hk_h5_open_own(hid_t where, const char *name) {
  H5L_info_t link;
  const int is_own = where >= 0 && H5Lexists(where, name, H5P_DEFAULT) > 0 &&
                     H5Lget_info(where, name, &link, H5P_DEFAULT) >= 0 && link.type == H5L_TYPE_HARD;
  return is_own ? H5Oopen(where, name, H5P_DEFAULT) : -1;
}

hid_t hk_h5_group(hid_t where, const char *name) {
  return H5Lexists(where, name, H5P_DEFAULT) > 0
             ? H5Gopen2(where, name, H5P_DEFAULT)
             : H5Gcreate2(where, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
}

hid_t hk_h5_new_links(void) {
  hid_t list = H5Pcreate(H5P_LINK_CREATE);
  if (list >= 0 && H5Pset_create_intermediate_group(list, 1) >= 0) return list;
  hk_h5_drop(list);
  return -1;
}

static herr_t refuse_link(const char *from_file, const char *from, const char *to_file, const char *to,
                          unsigned *flags, hid_t access, void *ctx) {
  struct hk_h5_guard *guard = ctx;
  (void)from_file, (void)from, (void)to_file, (void)to, (void)flags, (void)access;
  snprintf(guard->reason, sizeof guard->reason,
           "a link in it leads to another file; allowed: what is in the file itself");
  return -1;
}

hid_t hk_h5_own_links(struct hk_h5_guard *guard) {
  hid_t list = H5Pcreate(H5P_DATASET_ACCESS);
  if (list >= 0 && H5Pset_elink_cb(list, refuse_link, guard) >= 0) return list;
  hk_h5_drop(list);
  return -1;
}

/* Filters that HDF5 would have to load, which the guard forbids. */
static int needs_code(hid_t list) {
  int needs = 0;
  for (int k = 0; !needs && k < H5Pget_nfilters(list); k++) {
    unsigned flags;
    size_t none = 0;
    const H5Z_filter_t filter = H5Pget_filter2(list, (unsigned)k, &flags, &none, NULL, 0, NULL, NULL);
    needs = filter < 0 || H5Zfilter_avail(filter) <= 0;
  }
  return needs;
}

const char *hk_h5_foreign(hid_t dataset) {
  hid_t list = H5Dget_create_plist(dataset);
  const char *what = NULL;
  if (list < 0)
    what = "cannot be read";
  else if (H5Pget_layout(list) == H5D_VIRTUAL || H5Pget_external_count(list) != 0)
    what = "keeps its numbers in another file; allowed: numbers in the file itself";
  else if (H5Pget_layout(list) == H5D_CHUNKED && needs_code(list))
    what = "is packed by a filter that HDF5 would have to load; allowed: its own, such as gzip and shuffle";
  hk_h5_drop(list);
  return what;
}

int64_t hk_h5_place(hid_t dataset, hid_t type, int64_t bytes) {
  if (dataset < 0 || H5Iget_type(dataset) != H5I_DATASET || hk_h5_foreign(dataset)) return -1;
  hid_t own = H5Dget_type(dataset), list = H5Dget_create_plist(dataset), file = H5Iget_file_id(dataset);
  hsize_t end = 0;
  int fits = own >= 0 && list >= 0 && H5Pget_layout(list) == H5D_CONTIGUOUS &&
             (type < 0 || H5Tequal(own, type) > 0) && H5Dget_storage_size(dataset) == (hsize_t)bytes;
  const haddr_t at = fits && bytes > 0 ? H5Dget_offset(dataset) : 0;
  fits = fits && at != HADDR_UNDEF && H5Fget_filesize(file, &end) >= 0 && at + (haddr_t)bytes <= end;
  hk_h5_drop(file);
  hk_h5_drop(list);
  hk_h5_drop(own);
  return fits ? (int64_t)at : -1;
}

/* Creates and writes an attribute; closes `space`. */
static herr_t write_attribute(hid_t object, const char *name, hid_t type, hid_t space, const void *data) {
  hid_t attribute = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  herr_t result = attribute < 0 ? -1 : H5Awrite(attribute, type, data);
  hk_h5_drop(attribute);
  hk_h5_drop(space);
  return result;
}

static hid_t line_space(int64_t count, int scalar) {
  const hsize_t size = (hsize_t)count;
  return scalar ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &size, NULL);
}

static herr_t write_text_attribute(hid_t object, const char *name, int64_t count, int scalar,
                                   const char *const *text) {
  hid_t type = H5Tcopy(H5T_C_S1);
  herr_t result = type < 0 ? -1 : H5Tset_size(type, H5T_VARIABLE);
  if (result >= 0) result = H5Tset_cset(type, H5T_CSET_UTF8);
  if (result >= 0) result = write_attribute(object, name, type, line_space(count, scalar), text);
  hk_h5_drop(type);
  return result;
}

herr_t hk_h5_text_attributes(hid_t object, const char *name, int64_t count, const char *const *text) {
  return write_text_attribute(object, name, count, 0, text);
}

herr_t hk_h5_text_attribute(hid_t object, const char *name, const char *text) {
  return write_text_attribute(object, name, 1, 1, &text);
}

herr_t hk_h5_attribute(hid_t object, const char *name, hid_t type, int64_t count, const void *value) {
  return write_attribute(object, name, type, line_space(count, count == 1), value);
}

hid_t hk_h5_array(hid_t where, const char *name, hid_t type, int rank, const hsize_t *size,
                  const void *fill) {
  hid_t list = H5Pcreate(H5P_DATASET_CREATE), links = hk_h5_new_links();
  hid_t space = rank > 0 ? H5Screate_simple(rank, size, NULL) : H5Screate(H5S_SCALAR);
  hid_t dataset = -1;
  herr_t result = list < 0 || links < 0 || space < 0 ? -1 : H5Pset_layout(list, H5D_CONTIGUOUS);
  if (result >= 0) result = H5Pset_alloc_time(list, H5D_ALLOC_TIME_EARLY);
  if (result >= 0) result = H5Pset_fill_time(list, fill ? H5D_FILL_TIME_ALLOC : H5D_FILL_TIME_NEVER);
  if (result >= 0 && fill) result = H5Pset_fill_value(list, type, fill);
  /* no dates: the same run gives the same bytes */
  if (result >= 0) result = H5Pset_obj_track_times(list, 0);
  if (result >= 0) dataset = H5Dcreate2(where, name, type, space, links, list, H5P_DEFAULT);
  hk_h5_drop(space);
  hk_h5_drop(links);
  hk_h5_drop(list);
  return dataset;
}

herr_t hk_h5_array_of(hid_t where, const char *name, hid_t type, hid_t memory, int rank, const hsize_t *size,
                      const void *data) {
  hid_t dataset = hk_h5_array(where, name, type, rank, size, NULL);
  herr_t result = dataset < 0 ? -1 : H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
  hk_h5_drop(dataset);
  return result;
}

hid_t hk_h5_texts(hid_t where, const char *name, int64_t count, int64_t length) {
  hid_t type = H5Tcopy(H5T_C_S1), dataset = -1;
  const hsize_t size = (hsize_t)count;
  herr_t result = type < 0 ? -1 : H5Tset_size(type, (size_t)(length > 0 ? length : 1));
  if (result >= 0) result = H5Tset_strpad(type, H5T_STR_NULLPAD);
  if (result >= 0) result = H5Tset_cset(type, H5T_CSET_UTF8);
  /* HDF5 fills a text of more than 1 MiB from beyond the buffer of that size */
  if (result >= 0) dataset = hk_h5_array(where, name, type, count < 0 ? 0 : 1, &size, NULL);
  hk_h5_drop(type);
  return dataset;
}

herr_t hk_h5_write_text(hid_t dataset, int64_t k, const char *text) {
  hid_t type = H5Dget_type(dataset), space = H5Dget_space(dataset), one = H5Screate(H5S_SCALAR);
  herr_t result = type < 0 || space < 0 || one < 0 ? -1 : 0;
  const size_t length = result < 0 ? 0 : H5Tget_size(type);
  char *padded = hk_new((int64_t)length, 1);
  if (padded == NULL) result = -1;
  if (result >= 0) {
    memcpy(padded, text, strlen(text) < length ? strlen(text) : length);
    if (H5Sget_simple_extent_ndims(space) == 1) {
      const hsize_t start = (hsize_t)k, count = 1;
      result = H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, NULL, &count, NULL);
    }
  }
  if (result >= 0) result = H5Dwrite(dataset, type, one, space, H5P_DEFAULT, padded);
  hk_free(padded);
  hk_h5_drop(one);
  hk_h5_drop(space);
  hk_h5_drop(type);
  return result;
}

/* ---- reading texts ---- */

static const hsize_t LONGEST_TEXT = (hsize_t)1 << 31;

/* 1 for one text of fixed length, stored in this very file. */
static int is_text_here(hid_t data) {
  if (H5Iget_type(data) != H5I_DATASET || hk_h5_foreign(data)) return 0;
  hid_t type = H5Dget_type(data), space = H5Dget_space(data), list = H5Dget_create_plist(data);
  const H5D_layout_t layout = list < 0 ? H5D_LAYOUT_ERROR : H5Pget_layout(list);
  const int fits = type >= 0 && space >= 0 && H5Tget_class(type) == H5T_STRING &&
                   H5Tis_variable_str(type) == 0 && H5Sget_simple_extent_npoints(space) == 1 &&
                   (layout == H5D_CONTIGUOUS || layout == H5D_COMPACT);
  hk_h5_drop(list);
  hk_h5_drop(space);
  hk_h5_drop(type);
  return fits;
}

int32_t hk_h5_read_text(hid_t group, const char *name, char **out) {
  int32_t status = HOOKE_OK;
  hid_t data = hk_h5_open_own(group, name);
  hid_t type = data < 0 || !is_text_here(data) ? -1 : H5Dget_type(data);
  const hsize_t length = type < 0 ? 0 : H5Tget_size(type), stored = type < 0 ? 0 : H5Dget_storage_size(data);
  char *text = NULL;
  if (type >= 0 && length == stored && length < LONGEST_TEXT) {
    text = hk_new((int64_t)length + 1, 1);
    if (text == NULL) status = HOOKE_NO_MEMORY;
  }
  if (text && H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) < 0) {
    hk_free(text);
    text = NULL;
  }
  hk_h5_drop(type);
  hk_h5_drop(data);
  *out = text;
  return status;
}

static int is_text(hid_t attribute) {
  hid_t type = H5Aget_type(attribute), space = H5Aget_space(attribute);
  const int fits = type >= 0 && space >= 0 && H5Sget_simple_extent_npoints(space) == 1 &&
                   H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) > 0;
  hk_h5_drop(space);
  hk_h5_drop(type);
  return fits;
}

char *hk_h5_attribute_text(hid_t attribute) {
  char *word = NULL;
  hid_t memory = is_text(attribute) ? H5Tcopy(H5T_C_S1) : -1;
  if (memory >= 0 && H5Tset_size(memory, H5T_VARIABLE) >= 0 && H5Tset_cset(memory, H5T_CSET_UTF8) >= 0 &&
      H5Aread(attribute, memory, &word) < 0)
    word = NULL;
  hk_h5_drop(memory);
  return word;
}

#endif
