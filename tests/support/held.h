/* Number of open files of this process. */
#ifndef TESTS_SUPPORT_HELD_H
#define TESTS_SUPPORT_HELD_H

#include <stdint.h>

/* -1 if the system does not tell. */
int64_t open_files(void);
int64_t thread_count(void);

#endif
