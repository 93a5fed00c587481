/* A limit on the size of files, like that of a full disk. */
#pragma once

#include <stdint.h>

/* From here on a write beyond `size` bytes fails, without ending the process. */
void limit_files(int64_t size);
void lift_file_limit(void);
