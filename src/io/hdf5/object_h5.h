/* Helpers for small HDF5 objects: attributes, arrays of known size, texts. Functions that return herr_t or
 * hid_t give a negative number on failure, like HDF5's own. */
#pragma once

#include "io/hdf5/file_h5.h"

#include <stdint.h>

#include <hdf5.h>

/* Releases a handle of any kind but a file; negative ones are ignored. */
void hk_h5_drop(hid_t id);

/* The object of that name in a group (or a file; negative: none) by a hard link, so one in this very file;
 * negative if there is none, which sets no HDF5 error. */
hid_t hk_h5_open_own(hid_t where, const char *name);

/* An access list, for links and datasets, that refuses links to other files and makes that the guard's
 * reason; negative without memory. */
hid_t hk_h5_own_links(struct hk_h5_guard *guard);

/* The group of that name, which is created if it is not there; negative on failure. */
hid_t hk_h5_group(hid_t where, const char *name);

/* A list for new links that creates the groups on their paths; negative without memory. */
hid_t hk_h5_new_links(void);

/* NULL if the data of a dataset are in this very file and HDF5 can read them by itself; otherwise words for
 * what it is. Call it before querying the dataspace: HDF5 opens the sources of a virtual dataset for that. */
const char *hk_h5_foreign(hid_t dataset);

/* Offset in the file of an array that is one block of so many bytes of `type` (negative: any), 0 if it is
 * empty; -1 if it is something else, or negative itself. */
int64_t hk_h5_place(hid_t dataset, hid_t type, int64_t bytes);

herr_t hk_h5_text_attributes(hid_t object, const char *name, int64_t count, const char *const *text);
herr_t hk_h5_text_attribute(hid_t object, const char *name, const char *text);
/* One number, or a line of them. */
herr_t hk_h5_attribute(hid_t object, const char *name, hid_t type, int64_t count, const void *value);

/* An array of `rank` dimensions and `type` on disk, with the groups on its path, allocated at once and filled
 * with `fill` (of the type `type`; NULL: bytes are undefined until they are written). Returns the dataset, or
 * a negative number. */
hid_t hk_h5_array(hid_t where, const char *name, hid_t type, int rank, const hsize_t *size, const void *fill);

/* The same, filled with `data` of the type `memory`, and closed. */
herr_t hk_h5_array_of(hid_t where, const char *name, hid_t type, hid_t memory, int rank, const hsize_t *size,
                      const void *data);

/* Room for fixed-length texts of `length` bytes, undefined until they are written: `count` < 0 for a single
 * one. Returns the dataset. */
hid_t hk_h5_texts(hid_t where, const char *name, int64_t count, int64_t length);
/* Writes text number `k` of such a dataset in place, padded with zeros; longer texts are truncated. */
herr_t hk_h5_write_text(hid_t dataset, int64_t k, const char *text);

/* A dataset that is one text of fixed length, stored in this very file, for hk_free(); NULL if it is
 * something else or there is none. HOOKE_NO_MEMORY. */
int32_t hk_h5_read_text(hid_t group, const char *name, char **text);

/* An attribute that is one text of variable length, for H5free_memory(); NULL if it is something else or
 * cannot be read. */
char *hk_h5_attribute_text(hid_t attribute);
