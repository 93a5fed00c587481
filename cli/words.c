#include "words.h"

#include "os.h"

#include <stdio.h>
#include <string.h>

enum { WORD_SIZE = 48, PATH_SIZE = 1024 };

static const struct {
  const char *typed, *meant;
} words[] = {
    {"dt", "step"},           {"s", "step"},      {"timestep", "step"},     {"time", "duration"},
    {"integrator", "method"}, {"V", "--version"}, {"version", "--version"}, {"list", "--help"},
    {"methods", "--help"},    {"plot", "view"},   {"simulate", "run"},
};

const char *cli_words_meant(const char *word) {
  const char *bare = word + strspn(word, "-");
  for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
    if (strcmp(words[k].typed, bare) == 0) return words[k].meant;
  }
  return word;
}

/* Edit distance: letters to change, insert or drop between two words. */
static size_t distance(const char *a, const char *b) {
  size_t row[WORD_SIZE + 1];
  size_t width = strlen(b);
  for (size_t j = 0; j <= width; j++)
    row[j] = j;
  for (size_t i = 0; a[i]; i++) {
    size_t diagonal = row[0];
    row[0] = i + 1;
    for (size_t j = 0; j < width; j++) {
      size_t change = diagonal + (a[i] != b[j]);
      size_t shorter = (row[j] < row[j + 1] ? row[j] : row[j + 1]) + 1;
      diagonal = row[j + 1];
      row[j + 1] = change < shorter ? change : shorter;
    }
  }
  return row[width];
}

const char *cli_suggest(const char *word, const char *(*next)(int64_t i, const void *ctx), const void *ctx) {
  static char best[WORD_SIZE + 1];
  const char *candidate, *meant = cli_words_meant(word);
  size_t least = strlen(word) / 3 + 2; /* more changes make it another word */
  best[0] = '\0';
  for (int64_t i = 0; (candidate = next(i, ctx)) != NULL; i++) {
    if (strlen(candidate) > WORD_SIZE || strlen(word) > WORD_SIZE) continue;
    const size_t changes = strcmp(candidate, meant) == 0 ? 0 : distance(word, candidate);
    if (changes >= least) continue;
    least = changes;
    snprintf(best, sizeof best, "%s", candidate);
  }
  return best[0] ? best : NULL;
}

/* ---- files ---- */

static const char *next_file(int64_t i, const void *folder) {
  return cli_os_next_file(i == 0 ? folder : NULL);
}

const char *cli_suggest_file(const char *path) {
  static char found[PATH_SIZE];
  const char *slash = cli_os_last_slash(path), *name = slash ? slash + 1 : path;
  const int length = (int)(name - path);
  if (cli_os_is_same_file(path, path) || length >= PATH_SIZE - WORD_SIZE) return NULL;
  snprintf(found, sizeof found, "%.*s", length, path);
  const char *near = cli_suggest(name, next_file, length ? found : ".");
  snprintf(found + length, sizeof found - (size_t)length, "%s", near ? near : "");
  return near ? found : NULL;
}
