/* The bytes of files. */
#pragma once

#include <stddef.h>

/* The current bytes, which a kill would leave; fails the test on error. */
void copy_file(const char *from, const char *to);
/* All bytes of a file; release them with free(). Fails the test on error. */
char *bytes_of(const char *path, size_t *count);
