/* Telling the files apart that a scene can come from. */
#ifndef HOOKE_IO_RECORD_H
#define HOOKE_IO_RECORD_H

#include "hooke/io.h"

/* 1 if the file begins as HDF5 files do. */
int32_t hooke_record_is_one(const char *path);

#endif
