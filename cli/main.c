/* The command line of hooke: picks the verb, hands it its options, and answers the shell. */
#include "arguments.h"
#include "print.h"
#include "report.h"
#include "usage.h"

#include <stdio.h>
#include <string.h>

/* A new verb is one file and one row here. */
static const struct hooke_verb *const verbs[] = {&hooke_verb_run,   &hooke_verb_compare, &hooke_verb_study,
                                                 &hooke_verb_limit, &hooke_verb_why,     &hooke_verb_needs,
                                                 &hooke_verb_check, &hooke_verb_view,    NULL};

static const char *next_verb(int64_t i, const void *ctx) {
  (void)ctx;
  return verbs[i] ? verbs[i]->name : NULL;
}

static const struct hooke_verb *find_verb(const char *name) {
  for (int64_t i = 0; verbs[i]; i++) {
    if (strcmp(verbs[i]->name, name) == 0) return verbs[i];
  }
  return NULL;
}

static int unknown_verb(const char *word) {
  const char *near = hooke_suggest(word, next_verb, NULL);
  fputs("hooke: there is no ", stderr);
  fputs(word[0] == '-' ? "option '" : "verb '", stderr);
  hooke_print_text(stderr, word);
  fputs("'", stderr);
  if (near) fprintf(stderr, ", did you mean '%s'?", near);
  fputs("; 'hooke --help' lists the verbs\n", stderr);
  return HOOKE_EXIT_USAGE;
}

static int do_verb(const struct hooke_verb *verb, int argc, char **argv) {
  struct hooke_arguments arguments;
  int answer = hooke_arguments_parse(verb, argc, argv, &arguments);
  if (answer == HOOKE_EXIT_DONE) {
    if (arguments.help) {
      hooke_usage_print_verb(stdout, &arguments);
    } else {
      answer = verb->function(&arguments);
    }
  }
  hooke_arguments_destroy(&arguments);
  return answer;
}

static int do_words(int argc, char **argv) {
  if (argc < 2) {
    hooke_usage_print_all(stderr, verbs);
    return HOOKE_EXIT_USAGE;
  }
  if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
    hooke_usage_print_all(stdout, verbs);
    return HOOKE_EXIT_DONE;
  }
  if (strcmp(argv[1], "--version") == 0) {
    hooke_usage_print_version(stdout);
    return HOOKE_EXIT_DONE;
  }
  const struct hooke_verb *verb = find_verb(argv[1]);
  return verb ? do_verb(verb, argc - 1, argv + 1) : unknown_verb(argv[1]);
}

int main(int argc, char **argv) {
  (void)hooke_io_own_process(); /* nothing to keep HDF5 from in a build without it */
  int answer = do_words(argc, argv);
  if (fflush(stdout) != 0 || ferror(stdout)) {
    fputs("hooke: could not write to standard output\n", stderr);
    if (answer == HOOKE_EXIT_DONE) answer = HOOKE_EXIT_IO;
  }
  return answer;
}
