/* A limit on the size of files, like that of a full disk. */
#ifndef TESTS_SUPPORT_FILE_LIMIT_H
#define TESTS_SUPPORT_FILE_LIMIT_H

#include <stdint.h>

/* From here on a write beyond `size` bytes fails, without ending the process. */
void limit_files(int64_t size);
void lift_file_limit(void);

#endif
