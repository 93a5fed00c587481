/* Runs inputs without libFuzzer: files, and all files of folders. A missing folder has none. */
#include "fuzz.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { PATH_SIZE = 4096 };

static long inputs;

/* Function of libFuzzer that a mutator in the file of a target refers to; nothing here calls it. */
size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
__attribute__((weak)) size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size) {
  (void)data;
  return size < max_size ? size : max_size;
}

/* The block is as long as the input, so that a read past it is detected. */
static int replay_file(const char *path, size_t size) {
  FILE *file = fopen(path, "rb");
  uint8_t *data = malloc(size);
  const int read = file && (data || size == 0) && fread(data, 1, size, file) == size;
  if (read) {
    LLVMFuzzerTestOneInput(data, size);
    inputs++;
  } else {
    fprintf(stderr, "cannot be read: %s\n", path);
  }
  if (file) fclose(file);
  free(data);
  return !read;
}

static int replay(const char *path) {
  struct stat what;
  if (stat(path, &what) != 0) return 0;
  if (!S_ISDIR(what.st_mode)) return replay_file(path, (size_t)what.st_size);
  DIR *folder = opendir(path);
  if (folder == NULL) return 1;
  int failed = 0;
  for (const struct dirent *entry; (entry = readdir(folder));) {
    char inner[PATH_SIZE];
    snprintf(inner, sizeof inner, "%s/%s", path, entry->d_name);
    if (entry->d_name[0] != '.') failed |= replay(inner);
  }
  closedir(folder);
  return failed;
}

int main(int argc, char **argv) {
  int failed = 0;
  for (int k = 1; k < argc; k++)
    failed |= replay(argv[k]);
  printf("%ld inputs\n", inputs);
  return failed || inputs == 0;
}
