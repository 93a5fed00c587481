/* The driver by which HDF5 writes our files. HDF5 does not survive a failed write: in 1.10 a file that could
 * not be closed crashes the process when it is closed again, or at exit. So with this driver no write ever
 * fails as HDF5 sees it: after the first failure it ignores the others, and the creator of the file reads the
 * error after HDF5 has closed it. */
#ifndef HOOKE_IO_HDF5_DRIVER_H5_H
#define HOOKE_IO_HDF5_DRIVER_H5_H

#include <hdf5.h>

/* An access list for the new file of `descriptor`, with this driver, for any name given to HDF5. The
 * caller keeps the descriptor; `error` receives the errno of the first failure; both must outlive the open
 * file. So must the list: the driver, which H5Fclose() still uses, is released with the last of its lists.
 * Set `error` to any number to suppress all further writes. Negative on failure. */
hid_t hk_h5_access_list(int descriptor, int *error);

#endif
