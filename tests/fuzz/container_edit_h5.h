/* Edits of the objects of a container. */
#pragma once

#include "container.h"

#include <hdf5.h>

/* Edits that HDF5 refuses have no effect. */
void container_edit_structure(hid_t file, const struct container *container, const struct edit *edit);
