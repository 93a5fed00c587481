/* Files as systems have them: os_file_posix.c is for POSIX, os_file_windows.c for Windows, where paths are
 * UTF-8 and both slashes separate folders. Functions that return int return 0, or -1 with errno, unless said
 * otherwise. Descriptors are those of <unistd.h>; bytes are never translated, and no other program inherits
 * them. */
#pragma once

#include <stdint.h>
#include <stdio.h>

/* ---- names ---- */

/* The last slash of a path; NULL if it has none. */
const char *hk_os_last_slash(const char *path);

int32_t hk_os_is_absolute(const char *path);

/* The absolute path of an existing file, without links; of one that will be created, where a dangling link
 * names it. For hk_os_free(); NULL with errno. */
char *hk_os_real_path(const char *path);
char *hk_os_new_path(const char *path);

enum { HOOKE_OS_NAME_MAX = 255 }; /* bytes of a name in a folder */

/* ---- what there is ---- */

struct hk_os_file {
  uint64_t device, number; /* which together are of this file alone */
  int64_t bytes;
  int32_t is_regular, is_folder;
};

/* Look at the file that has the path, through links, or at an open one. */
int hk_os_look(const char *path, struct hk_os_file *file);
int hk_os_look_open(int descriptor, struct hk_os_file *file);

int32_t hk_os_is_same(const struct hk_os_file *one, const struct hk_os_file *other);

int32_t hk_os_may_write(const char *path);

/* ---- descriptors ---- */

/* Opens without waiting for the writer of a pipe. Returns a descriptor, or -1 with errno. */
int hk_os_open(const char *path);
int hk_os_open_to_change(const char *path);

/* Opens a file for reading as a stream; NULL with errno. */
FILE *hk_os_fopen(const char *path);

/* Creates a file for reading and writing; EEXIST if there is one. If it will replace the file `older` it gets
 * its mode, and its owner and group as far as the process may set them. */
int hk_os_create(const char *path, const char *older);

/* Read and write at an offset; return the number of bytes, as pread() and pwrite() do. */
int64_t hk_os_read_at(int descriptor, int64_t at, int64_t count, void *bytes);
int64_t hk_os_write_at(int descriptor, int64_t at, int64_t count, const void *bytes);

int hk_os_set_length(int descriptor, int64_t bytes);

/* Takes room on the disk for this length. Returns 0 or an errno; 0 where the file system cannot. */
int hk_os_reserve_disk(int descriptor, int64_t bytes);

/* Flushes what was written to the disk. */
int hk_os_sync(int descriptor);

/* ---- locks ---- */

/* A lock is on the whole file, belongs to the open descriptor and ends with the process; another descriptor,
 * also of the same process, does not share it. Reading needs none. -1 if another descriptor has it, or the
 * file system has no locks. */
int hk_os_lock(int descriptor);
void hk_os_unlock(int descriptor);

/* 1 if another descriptor has the lock of hk_os_lock(). */
int32_t hk_os_is_locked(int descriptor);

/* Gives up the lock if it keeps out the readers of HDF5. `path`: the file's name. */
void hk_os_let_readers_in(const char *path, int descriptor);

/* ---- folders ---- */

/* The folder of a path, opened so that its names can be flushed to the disk; where the system flushes them by
 * itself, these do nothing. hk_os_sync_folder() succeeds on file systems that cannot. */
int hk_os_open_folder(const char *path, int *folder);
int hk_os_sync_folder(int folder);
void hk_os_close_folder(int folder);

/* Renames, replacing a file of that name, of which `older` (-1: none) is a descriptor: it is closed, and set
 * to -1, where no open file can be replaced. The second function fails with EEXIST if there is a file, and
 * with EINVAL or ENOSYS where that cannot be had. */
int hk_os_rename(const char *from, const char *to, int *older);
int hk_os_rename_if_free(const char *from, const char *to);

/* A second name for a file: a hard link or, where there are none, the only name from then on. */
int hk_os_link(const char *from, const char *to);

int hk_os_remove(const char *path);

/* ---- randomness ---- */

/* Random bytes of the system, at most 256. */
int hk_os_random(void *bytes, size_t count);
