#include "words.h"

#include "describe.h"
#include "os.h"
#include "print.h"
#include "report.h"

#include <stdio.h>
#include <string.h>

enum { WORD_SIZE = 48 };

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
  static char found[HOOKE_DOC_SIZE];
  const char *slash = cli_os_last_slash(path), *name = slash ? slash + 1 : path;
  const int length = (int)(name - path);
  const int32_t is_there = cli_os_is_same_file(path, path);
  if (is_there || length >= HOOKE_DOC_SIZE - WORD_SIZE) return NULL;
  snprintf(found, sizeof found, "%.*s", length, path);
  const char *near = cli_suggest(name, next_file, length ? found : ".");
  snprintf(found + length, sizeof found - (size_t)length, "%s", near ? near : "");
  return near ? found : NULL;
}

/* ---- endings ---- */

int cli_words_check_ending(const struct cli_arguments *arguments, const char *file) {
  static const char *const others[][2] = {{".json", "'hooke make -o' writes a scene"},
                                          {".html", "'hooke view -o' writes a page"},
                                          {".h5", "'hooke run -o' writes a trajectory"},
                                          {".csv", "'hooke study -o' writes a table"},
                                          {".png.jpg.svg", "the page of 'hooke view' saves the picture"},
                                          {".mp4.webm.gif", "the page of 'hooke view' saves the film"}};
  const char *dot = strrchr(file, '.');
  for (int32_t i = 0; dot && i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    const char *own =
        argument->text && strcmp(argument->text, file) == 0 ? cli_describe_file(argument) : NULL;
    for (size_t k = 0; own && own[0] && k < sizeof others / sizeof others[0]; k++) {
      const char *found = strstr(others[k][0], dot), after = found ? found[strlen(dot)] : 'x';
      if ((after != '\0' && after != '.') || strcmp(own, dot + 1) == 0) continue;
      return cli_report(arguments, HOOKE_EXIT_USAGE, "--%s %s: its name has to end in .%s; %s",
                        argument->flag, file, own, others[k][1]);
    }
  }
  return HOOKE_EXIT_DONE;
}

/* ---- options ---- */

static const char *next_flag(int64_t i, const void *ctx) {
  const struct cli_arguments *arguments = ctx;
  return i < arguments->count ? arguments->all[i].flag : NULL;
}

/* Lists the options that begin with `flag`, each family once, and returns how many entries there are; `first`
 * is the first option. */
static int list_longer(const struct cli_arguments *arguments, const char *flag, char list[HOOKE_DOC_SIZE],
                       const char **first) {
  const size_t length = strlen(flag);
  int count = 0;
  size_t family = 0;
  const char *last = "";
  list[0] = '\0';
  for (int32_t i = 0; i < arguments->count; i++) {
    const char *name = arguments->all[i].flag;
    if (strncmp(name, flag, length) != 0 || (family && strncmp(name, last, family) == 0)) continue;
    const char *dot = strchr(name, '.');
    family = dot ? (size_t)(dot - name) + 1 : 0;
    last = name;
    if (count == 0) *first = name;
    cli_append(list, HOOKE_DOC_SIZE, "%s--%.*s%s", count++ ? ", " : "",
               (int)(dot ? dot - name : HOOKE_FLAG_SIZE), name, dot ? "..." : "");
  }
  return count;
}

/* The verbs that have the option: "study, limit, why, needs"; "" if none has. */
static void list_verbs(const char *flag, char list[HOOKE_DOC_SIZE]) {
  list[0] = '\0';
  for (int32_t k = 0; cli_verbs[k]; k++) {
    struct cli_arguments other = {.verb = cli_verbs[k]};
    const int code = cli_arguments_collect(cli_verbs[k], NULL, &other);
    for (int32_t i = 0; code == HOOKE_EXIT_DONE && i < other.count; i++)
      if (strcmp(other.all[i].flag, flag) == 0)
        cli_append(list, HOOKE_DOC_SIZE, "%s%s", list[0] ? ", " : "", cli_verbs[k]->name);
    cli_arguments_destroy(&other);
  }
}

int cli_report_unknown_option(const struct cli_arguments *arguments, const char *word, const char *value) {
  char flag[HOOKE_FLAG_SIZE], list[HOOKE_DOC_SIZE], verbs[HOOKE_DOC_SIZE] = "";
  const char *near = NULL;
  snprintf(flag, sizeof flag, "%s", word + strspn(word, "-"));
  flag[strcspn(flag, "=")] = '\0';
  const int longer = strncmp(word, "--", 2) == 0 ? list_longer(arguments, flag, list, &near) : 0;
  const int family = near && near[strlen(flag)] == '.';
  if (longer > 1 && !family)
    return cli_report(arguments, HOOKE_EXIT_USAGE, "--%s is ambiguous: %s", flag, list);
  if (longer == 0) list_verbs(flag, verbs);
  if (longer == 0 && !verbs[0]) near = cli_suggest(flag, next_flag, arguments);
  const int filled = family && value && value[0] != '-';
  return cli_report(
      arguments, HOOKE_EXIT_USAGE, "there is no option %s%s%s%s%s%s%s%s; 'hooke %s%s%s --help' lists them",
      word, verbs[0] ? ", which is one of " : "", verbs, near ? ", did you mean --" : "", near ? near : "",
      filled ? " " : "", filled ? value : "", near ? "?" : "", arguments->verb->name,
      arguments->of_kind ? " " : "", arguments->of_kind ? arguments->scene : "");
}
