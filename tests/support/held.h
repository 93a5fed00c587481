/* Number of open files of this process. */
#pragma once

#include <stdint.h>

/* -1 if the system does not tell. */
int64_t open_files(void);
int64_t thread_count(void);
