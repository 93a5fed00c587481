#include "held.h"

#include <dirent.h>
#include <stddef.h>

static int64_t count_entries(const char *folder) {
  DIR *all = opendir(folder);
  if (all == NULL) return -1;
  int64_t count = 0;
  for (const struct dirent *entry; (entry = readdir(all)) != NULL;)
    count += entry->d_name[0] != '.';
  closedir(all);
  return count;
}

int64_t open_files(void) {
  const int64_t with_folder = count_entries("/proc/self/fd");
  return with_folder < 0 ? -1 : with_folder - 1;
}

int64_t thread_count(void) {
  return count_entries("/proc/self/task");
}
