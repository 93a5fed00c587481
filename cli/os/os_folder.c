/* Folders and files as mingw-w64 tells of them, too, as POSIX has it. */
#include "os.h"

#include <dirent.h>
#include <sys/stat.h>

const char *cli_os_next_file(const char *folder) {
  static DIR *open;
  if (folder) open = opendir(folder);
  const struct dirent *entry = open ? readdir(open) : NULL;
  if (entry) return entry->d_name;
  if (open) closedir(open);
  open = NULL;
  return NULL;
}

int32_t cli_os_is_other_than_file(const char *path) {
  struct stat there;
  return stat(path, &there) == 0 && !S_ISREG(there.st_mode);
}
