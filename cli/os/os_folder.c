/* Names in a folder, which mingw-w64 tells as POSIX has it. */
#include "os.h"

#include <dirent.h>

const char *cli_os_next_file(const char *folder) {
  static DIR *open;
  if (folder) open = opendir(folder);
  const struct dirent *entry = open ? readdir(open) : NULL;
  if (entry) return entry->d_name;
  if (open) closedir(open);
  open = NULL;
  return NULL;
}
