#define _CRT_RAND_S
#include "core/os/os_file.h"

#include "core/os/os.h"

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <stdlib.h>
#include <string.h>
#include <windows.h>

/* The errno of the last failure of Windows. */
static int fail(void) {
  static const struct {
    DWORD code;
    int error;
  } table[] = {{ERROR_FILE_NOT_FOUND, ENOENT},      {ERROR_PATH_NOT_FOUND, ENOENT},
               {ERROR_INVALID_NAME, ENOENT},        {ERROR_BAD_NETPATH, ENOENT},
               {ERROR_ACCESS_DENIED, EACCES},       {ERROR_SHARING_VIOLATION, EACCES},
               {ERROR_LOCK_VIOLATION, EACCES},      {ERROR_FILE_EXISTS, EEXIST},
               {ERROR_ALREADY_EXISTS, EEXIST},      {ERROR_DISK_FULL, ENOSPC},
               {ERROR_HANDLE_DISK_FULL, ENOSPC},    {ERROR_NOT_ENOUGH_MEMORY, ENOMEM},
               {ERROR_OUTOFMEMORY, ENOMEM},         {ERROR_INVALID_HANDLE, EBADF},
               {ERROR_TOO_MANY_OPEN_FILES, EMFILE}, {ERROR_FILENAME_EXCED_RANGE, ENAMETOOLONG},
               {ERROR_INVALID_PARAMETER, EINVAL},   {ERROR_NOT_SUPPORTED, ENOSYS},
               {ERROR_INVALID_FUNCTION, ENOSYS},    {ERROR_WRITE_PROTECT, EROFS}};
  const DWORD code = GetLastError();
  errno = EIO;
  for (size_t k = 0; k < sizeof table / sizeof table[0]; k++) {
    if (table[k].code == code) errno = table[k].error;
  }
  return -1;
}

/* ---- names ---- */

const char *hk_os_last_slash(const char *path) {
  const char *forward = strrchr(path, '/'), *back = strrchr(path, '\\');
  return back > forward ? back : forward;
}

/* Also "C:file", which is relative to the folder of a drive. */
int32_t hk_os_is_absolute(const char *path) {
  return path[0] == '/' || path[0] == '\\' || (path[0] != '\0' && path[1] == ':');
}

/* For hk_os_free(); NULL with errno. */
static wchar_t *widen(const char *path) {
  const int length = MultiByteToWideChar(CP_UTF8, MB_ERR_INVALID_CHARS, path, -1, NULL, 0);
  wchar_t *wide = length > 0 ? hk_os_allocate(0, (size_t)length * sizeof *wide) : NULL;
  if (wide)
    MultiByteToWideChar(CP_UTF8, 0, path, -1, wide, length);
  else
    errno = length > 0 ? ENOMEM : ENOENT;
  return wide;
}

/* Without the prefix of long paths, with forward slashes. */
static char *narrow(const wchar_t *wide) {
  if (wcsncmp(wide, L"\\\\?\\", 4) == 0 && wide[5] == L':') wide += 4;
  const int length = WideCharToMultiByte(CP_UTF8, 0, wide, -1, NULL, 0, NULL, NULL);
  char *path = hk_os_allocate(0, (size_t)length + 1);
  if (path == NULL) errno = ENOMEM;
  if (path) WideCharToMultiByte(CP_UTF8, 0, wide, -1, path, length, NULL, NULL);
  for (char *at = path; at && *at; at++) {
    if (*at == '\\') *at = '/';
  }
  return path;
}

/* Other programs, and this one, may open, rename and remove the file meanwhile, as POSIX has it. */
static HANDLE open_handle(const char *path, DWORD access, DWORD how) {
  const DWORD share = FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE;
  wchar_t *wide = widen(path);
  if (wide == NULL) return INVALID_HANDLE_VALUE;
  HANDLE handle = CreateFileW(wide, access, share, NULL, how, FILE_FLAG_BACKUP_SEMANTICS, NULL);
  if (handle == INVALID_HANDLE_VALUE) fail();
  hk_os_free(wide);
  return handle;
}

enum { LONGEST = 32768 }; /* characters of a path */

char *hk_os_real_path(const char *path) {
  HANDLE handle = open_handle(path, 0, OPEN_EXISTING);
  if (handle == INVALID_HANDLE_VALUE) return NULL;
  wchar_t *wide = hk_os_allocate(0, LONGEST * sizeof *wide);
  char *real = NULL;
  if (wide == NULL)
    errno = ENOMEM;
  else if (GetFinalPathNameByHandleW(handle, wide, LONGEST, 0) == 0)
    fail();
  else
    real = narrow(wide);
  hk_os_free(wide);
  CloseHandle(handle);
  return real;
}

char *hk_os_new_path(const char *path) {
  wchar_t *from = widen(path), *wide = from ? hk_os_allocate(0, LONGEST * sizeof *wide) : NULL;
  char *whole = NULL;
  if (from && wide == NULL)
    errno = ENOMEM;
  else if (from && GetFullPathNameW(from, LONGEST, wide, NULL) == 0)
    fail();
  else if (from)
    whole = narrow(wide);
  hk_os_free(wide);
  hk_os_free(from);
  return whole;
}

/* ---- what there is ---- */

/* Without the number of the volume: wine does not know it of a file that was renamed while it is open. */
static int look(HANDLE handle, struct hk_os_file *file) {
  BY_HANDLE_FILE_INFORMATION there;
  if (!GetFileInformationByHandle(handle, &there)) return fail();
  const int32_t folder = (there.dwFileAttributes & FILE_ATTRIBUTE_DIRECTORY) != 0;
  *file = (struct hk_os_file){.number = (uint64_t)there.nFileIndexHigh << 32 | there.nFileIndexLow,
                              .bytes = (int64_t)((uint64_t)there.nFileSizeHigh << 32 | there.nFileSizeLow),
                              .is_regular = !folder && GetFileType(handle) == FILE_TYPE_DISK,
                              .is_folder = folder};
  return 0;
}

int hk_os_look(const char *path, struct hk_os_file *file) {
  HANDLE handle = open_handle(path, FILE_READ_ATTRIBUTES, OPEN_EXISTING);
  if (handle == INVALID_HANDLE_VALUE) return -1;
  const int result = look(handle, file);
  CloseHandle(handle);
  return result;
}

static HANDLE handle_of(int descriptor) {
  return (HANDLE)_get_osfhandle(descriptor);
}

int hk_os_look_open(int descriptor, struct hk_os_file *file) {
  return look(handle_of(descriptor), file);
}

int32_t hk_os_is_same(const struct hk_os_file *one, const struct hk_os_file *other) {
  return one->device == other->device && one->number == other->number;
}

int32_t hk_os_may_write(const char *path) {
  wchar_t *wide = widen(path);
  const int32_t may = wide && _waccess(wide, 2) == 0;
  hk_os_free(wide);
  return may;
}

/* ---- descriptors ---- */

static int open_descriptor(const char *path, DWORD access, DWORD how, int flags) {
  HANDLE handle = open_handle(path, access, how);
  if (handle == INVALID_HANDLE_VALUE) return -1;
  const int descriptor = _open_osfhandle((intptr_t)handle, flags | _O_BINARY | _O_NOINHERIT);
  if (descriptor < 0) CloseHandle(handle);
  return descriptor;
}

int hk_os_open(const char *path) {
  return open_descriptor(path, GENERIC_READ, OPEN_EXISTING, _O_RDONLY);
}

int hk_os_open_to_change(const char *path) {
  return open_descriptor(path, GENERIC_READ | GENERIC_WRITE, OPEN_EXISTING, _O_RDWR);
}

FILE *hk_os_fopen(const char *path) {
  const int descriptor = hk_os_open(path);
  FILE *file = descriptor < 0 ? NULL : _fdopen(descriptor, "rb");
  if (descriptor >= 0 && file == NULL) _close(descriptor);
  return file;
}

/* Access is inherited from the folder. */
int hk_os_create(const char *path, const char *older) {
  (void)older;
  return open_descriptor(path, GENERIC_READ | GENERIC_WRITE, CREATE_NEW, _O_RDWR);
}

static OVERLAPPED place_of(int64_t at) {
  return (OVERLAPPED){.Offset = (DWORD)at, .OffsetHigh = (DWORD)((uint64_t)at >> 32)};
}

enum { MOST_AT_ONCE = 1 << 30 };

int64_t hk_os_read_at(int descriptor, int64_t at, int64_t count, void *bytes) {
  OVERLAPPED place = place_of(at);
  DWORD done = 0;
  const DWORD wanted = (DWORD)(count < MOST_AT_ONCE ? count : MOST_AT_ONCE);
  if (ReadFile(handle_of(descriptor), bytes, wanted, &done, &place)) return done;
  return GetLastError() == ERROR_HANDLE_EOF ? 0 : fail();
}

int64_t hk_os_write_at(int descriptor, int64_t at, int64_t count, const void *bytes) {
  OVERLAPPED place = place_of(at);
  DWORD done = 0;
  const DWORD wanted = (DWORD)(count < MOST_AT_ONCE ? count : MOST_AT_ONCE);
  return WriteFile(handle_of(descriptor), bytes, wanted, &done, &place) ? (int64_t)done : fail();
}

int hk_os_set_length(int descriptor, int64_t bytes) {
  FILE_END_OF_FILE_INFO end = {.EndOfFile.QuadPart = bytes};
  return SetFileInformationByHandle(handle_of(descriptor), FileEndOfFileInfo, &end, sizeof end) ? 0 : fail();
}

int hk_os_reserve_disk(int descriptor, int64_t bytes) {
  struct hk_os_file now;
  if (hk_os_look_open(descriptor, &now) != 0) return errno;
  return now.bytes >= bytes || hk_os_set_length(descriptor, bytes) == 0 ? 0 : errno;
}

int hk_os_sync(int descriptor) {
  return FlushFileBuffers(handle_of(descriptor)) ? 0 : fail();
}

/* ---- locks ---- */

/* Windows keeps others from reading what is locked, so the lock is on the last byte that there could be,
 * which no file has. HDF5's readers lock all bytes before it. */
static const int64_t locked_byte = -1;

static int take(int descriptor, DWORD kind) {
  OVERLAPPED place = place_of(locked_byte);
  return LockFileEx(handle_of(descriptor), kind | LOCKFILE_FAIL_IMMEDIATELY, 0, 1, 0, &place) ? 0 : fail();
}

/* Whoever looks for the lock has it for a moment, shared. */
int hk_os_lock(int descriptor) {
  enum { ATTEMPTS = 100 };
  int result = take(descriptor, LOCKFILE_EXCLUSIVE_LOCK);
  for (int k = 0; result != 0 && k < ATTEMPTS && !hk_os_is_locked(descriptor); k++)
    result = take(descriptor, LOCKFILE_EXCLUSIVE_LOCK);
  return result;
}

void hk_os_unlock(int descriptor) {
  OVERLAPPED place = place_of(locked_byte);
  UnlockFileEx(handle_of(descriptor), 0, 1, 0, &place);
}

int32_t hk_os_is_locked(int descriptor) {
  if (take(descriptor, 0) != 0) return GetLastError() == ERROR_LOCK_VIOLATION;
  hk_os_unlock(descriptor);
  return 0;
}

void hk_os_let_readers_in(const char *path, int descriptor) {
  (void)path, (void)descriptor;
}

/* ---- folders ---- */

int hk_os_open_folder(const char *path, int *folder) {
  (void)path;
  *folder = -1;
  return 0;
}

int hk_os_sync_folder(int folder) {
  (void)folder;
  return 0;
}

void hk_os_close_folder(int folder) {
  (void)folder;
}

static int move(const char *from, const char *to, DWORD flags) {
  wchar_t *wide_from = widen(from), *wide_to = wide_from ? widen(to) : NULL;
  const int result = wide_to == NULL ? -1 : MoveFileExW(wide_from, wide_to, flags) ? 0 : fail();
  hk_os_free(wide_from);
  hk_os_free(wide_to);
  return result;
}

/* Also replaces a file that is open, which MoveFileExW() does not; Windows 10 and later can. */
static int replace(const char *from, const char *to) {
  enum { RENAME_INFO_EX = 22, REPLACE_IF_EXISTS = 1, POSIX_SEMANTICS = 2 };
  struct {
    DWORD flags;
    HANDLE root;
    DWORD bytes;
    wchar_t name[LONGEST];
  } *info = hk_os_allocate(0, sizeof *info);
  HANDLE handle = open_handle(from, DELETE | SYNCHRONIZE, OPEN_EXISTING);
  int done = 0;
  if (info && handle != INVALID_HANDLE_VALUE) {
    memset(info, 0, sizeof *info);
    info->flags = REPLACE_IF_EXISTS | POSIX_SEMANTICS;
    const int length = MultiByteToWideChar(CP_UTF8, 0, to, -1, info->name, LONGEST);
    info->bytes = (DWORD)(length > 0 ? length - 1 : 0) * (DWORD)sizeof *info->name;
    done = length > 0 &&
           SetFileInformationByHandle(handle, (FILE_INFO_BY_HANDLE_CLASS)RENAME_INFO_EX, info, sizeof *info);
  }
  if (handle != INVALID_HANDLE_VALUE) CloseHandle(handle);
  hk_os_free(info);
  return done;
}

/* A reader, or a program that looks for viruses, may have the older file open for a moment. */
int hk_os_rename(const char *from, const char *to, int *older) {
  enum { ATTEMPTS = 100, MILLISECONDS = 20 };
  if (replace(from, to)) return 0;
  if (*older >= 0) _close(*older);
  *older = -1;
  int result = move(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH);
  for (int k = 0; result != 0 && errno == EACCES && k < ATTEMPTS; k++) {
    Sleep(MILLISECONDS);
    result = move(from, to, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH);
  }
  return result;
}

int hk_os_rename_if_free(const char *from, const char *to) {
  return move(from, to, MOVEFILE_WRITE_THROUGH);
}

int hk_os_link(const char *from, const char *to) {
  wchar_t *wide_from = widen(from), *wide_to = wide_from ? widen(to) : NULL;
  int result = wide_to == NULL ? -1 : CreateHardLinkW(wide_to, wide_from, NULL) ? 0 : fail();
  if (result != 0 && wide_to && errno != ENOENT && errno != EEXIST) {
    int none = -1;
    result = hk_os_rename(from, to, &none);
  }
  hk_os_free(wide_from);
  hk_os_free(wide_to);
  return result;
}

int hk_os_remove(const char *path) {
  wchar_t *wide = widen(path);
  const int result = wide == NULL ? -1 : DeleteFileW(wide) ? 0 : fail();
  hk_os_free(wide);
  return result;
}

/* ---- randomness ---- */

int hk_os_random(void *bytes, size_t count) {
  unsigned char *at = bytes;
  for (size_t k = 0; k < count; k++) {
    unsigned number;
    if (rand_s(&number) != 0) return -1;
    at[k] = (unsigned char)number;
  }
  return 0;
}
