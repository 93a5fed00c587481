/* A limit on the size of files, as a full disk has one. */
#ifndef TESTS_SUPPORT_FILE_LIMIT_H
#define TESTS_SUPPORT_FILE_LIMIT_H

#include <stdint.h>

/* Files may not grow beyond `size` bytes from here on; a write that tries fails, and ends no process. */
void limit_files(int64_t size);
void lift_file_limit(void);

#endif
