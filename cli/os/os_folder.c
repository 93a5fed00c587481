/* The same for all systems. */
#include "os.h"

#include <dirent.h>
#include <stddef.h>

const char *cli_os_next_file(const char *folder) {
  static DIR *open;
  if (folder) open = opendir(folder);
  const struct dirent *entry = open ? readdir(open) : NULL;
  if (entry) return entry->d_name;
  if (open) closedir(open);
  open = NULL;
  return NULL;
}
