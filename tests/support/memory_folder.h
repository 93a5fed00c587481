/* A folder for files that only this machine and this run need. */
#pragma once

#include <stdio.h>
#include <unistd.h>

/* In memory if possible, where fsync costs nothing; an absolute path, so that links may name it. */
static inline const char *memory_folder(void) {
  return access("/dev/shm", W_OK) == 0 ? "/dev/shm" : P_tmpdir;
}
