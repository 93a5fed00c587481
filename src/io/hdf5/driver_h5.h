/* The driver by which HDF5 makes files of ours. HDF5 does not bear that a write fails: in 1.10 a file that
 * could not be closed crashes the process when it is closed again, or at exit. So here no write ever fails as
 * HDF5 sees it: after the first that does, the rest is left out, and the file's maker asks for the error when
 * HDF5 is done. */
#ifndef HOOKE_IO_HDF5_DRIVER_H5_H
#define HOOKE_IO_HDF5_DRIVER_H5_H

#include <hdf5.h>

/* An access list for the new, empty file of `descriptor`, by this driver, whatever name HDF5 is told. The
 * descriptor stays the caller's; the first error, as errno has it, comes to be in `error`; both have to stay
 * until the file is closed. So has the list: with the last of its lists the driver goes, which H5Fclose()
 * still looks at. Give `error` any number to have nothing written any more. Negative on failure. */
hid_t hk_h5_access_list(int descriptor, int *error);

#endif
