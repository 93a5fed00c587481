/* The command line of hooke: selects the verb, passes its options, and returns the exit code. */
#include "arguments.h"
#include "os.h"
#include "pages.h"
#include "print.h"
#include "report.h"
#include "results.h"
#include "words.h"

#include <stdio.h>
#include <string.h>

/* A new verb is one file and one row here. */
static const struct cli_verb *const verbs[] = {&cli_verb_make,
                                               &cli_verb_run,
                                               &cli_verb_compare,
                                               &cli_verb_study,
                                               &cli_verb_limit,
                                               &cli_verb_why,
                                               &cli_verb_needs,
                                               &cli_verb_rest,
                                               &cli_verb_modes,
                                               &cli_verb_check,
                                               &cli_verb_view,
                                               &cli_verb_verify,
                                               NULL};

static int print_help(const struct cli_program *program, const char *value) {
  (void)value;
  cli_usage_print(stdout, program);
  return HOOKE_EXIT_DONE;
}

static int print_methods(const struct cli_program *program, const char *value) {
  static const char *const problems[] = {"bodies", "overdamped", "first-order"};
  (void)program, (void)value;
  printf("%-17s %11s %11s %11s\n", "method", problems[0], problems[1], problems[2]);
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    printf("%-17s", hooke_method_name(i));
    for (int k = 0; k < 3; k++)
      printf(" %11s", hooke_method_is_suited(hooke_method_name(i), problems[k]) == 1 ? "yes" : "no");
    printf("\n");
  }
  return HOOKE_EXIT_DONE;
}

static const struct cli_program_row rows[] = {
    {{"help", 'h', NULL, "verbs and methods; after a verb, its options with units and defaults"},
     NULL,
     print_help},
    {{"methods", 0, NULL,
      "methods, and which of them take rigid bodies, overdamped scenes and x' = phi(t, x)"},
     NULL,
     print_methods},
    {{"version", 0, NULL, "the version, and what it was built with"}, NULL, cli_version_print},
    {{"completion", 0, "SHELL",
      "a script that completes commands in bash, zsh or fish; it is installed with the program"},
     "bash zsh fish",
     cli_completion_print},
    {{"man", 0, NULL, "this program's manual page"}, NULL, cli_man_print},
    {{NULL, 0, NULL, NULL}, NULL, NULL},
};

static const struct cli_program program = {
    .verbs = verbs,
    .rows = rows,
    .summary = "integrates mass-spring systems and says how accurate each method is for what it costs",
    .text = "Particles joined by springs, such as ropes and cloths, with gravity, damping and driven "
            "particles, are described by a scene. hooke integrates it by one of several methods and measures "
            "the trade: how far each method is from a reference that checks itself, and what it costs. All "
            "units are SI. Results go to standard output, words for a person to standard error.",
};

static const char *next_verb(int64_t i, const void *ctx) {
  (void)ctx;
  return verbs[i] ? verbs[i]->name : NULL;
}

static const struct cli_verb *find_verb(const char *name) {
  for (int64_t i = 0; verbs[i]; i++) {
    if (strcmp(verbs[i]->name, name) == 0) return verbs[i];
  }
  return NULL;
}

/* The verb of words in the wrong order: one that follows, or that of a file in its place; NULL: none. */
static const char *misplaced_verb(char **words) {
  for (char **word = words; *word; word++) {
    if (find_verb(*word)) return *word;
  }
  const char *ending = strrchr(words[0], '.');
  if (ending && strcmp(ending, ".json") == 0) return cli_verb_run.name;
  return ending && strcmp(ending, ".h5") == 0 ? cli_verb_view.name : NULL;
}

/* `words` end with NULL; the first is no verb. */
static int unknown_verb(char **words) {
  const char *verb = misplaced_verb(words), *near = verb ? NULL : cli_suggest(words[0], next_verb, NULL);
  fputs("hooke: there is no ", stderr);
  fputs(words[0][0] == '-' ? "option '" : "verb '", stderr);
  cli_print_text(stderr, words[0]);
  fputs("'", stderr);
  if (near) fprintf(stderr, ", did you mean '%s'?", near);
  if (verb) fprintf(stderr, ", did you mean: hooke %s", verb);
  for (; verb && *words; words++) {
    if (strcmp(*words, verb) == 0) continue;
    fputc(' ', stderr);
    cli_print_quoted(stderr, *words);
  }
  fputs(verb ? "\n" : "; 'hooke --help' lists the verbs\n", stderr);
  return HOOKE_EXIT_USAGE;
}

static int do_verb(const struct cli_verb *verb, int argc, char **argv) {
  struct cli_arguments arguments = {.verb = verb};
  if (verb->takes_kind && argc == 1) {
    cli_usage_print_verb(stderr, &arguments);
    return HOOKE_EXIT_USAGE;
  }
  int answer = cli_arguments_parse(verbs, verb, argc, argv, &arguments);
  if (answer == HOOKE_EXIT_DONE && arguments.help)
    cli_usage_print_verb(stdout, &arguments);
  else if (answer == HOOKE_EXIT_DONE)
    answer = verb->function ? verb->function(&arguments) : cli_results_make(&arguments, verb);
  cli_arguments_destroy(&arguments);
  return answer;
}

static const struct cli_program_row *find_row(const char *word) {
  for (const struct cli_program_row *row = rows; row->is.name; row++) {
    const char letter[3] = {'-', row->is.letter, '\0'};
    if (strcmp(strncmp(word, "--", 2) == 0 ? word + 2 : word, row->is.name) == 0) return row;
    if (row->is.letter && strcmp(word, letter) == 0) return row;
  }
  return NULL;
}

static int do_row(const struct cli_program_row *row, const char *value) {
  const int code = row->is.value && !value ? HOOKE_EXIT_USAGE : row->print(&program, value);
  if (code == HOOKE_EXIT_USAGE)
    fprintf(stderr, "hooke: --%s wants a word after it, one of: %s\n", row->is.name, row->words);
  return code;
}

/* hooke help [VERB [KIND] [all]] */
static int do_help(int argc, char **argv) {
  static char flag[] = "--help";
  const struct cli_verb *verb = argc > 0 ? find_verb(argv[0]) : NULL;
  if (argc == 0) return print_help(&program, NULL);
  if (!verb) return unknown_verb(argv);
  char *words[] = {argv[0], argc > 1 ? argv[1] : flag, argc > 2 ? argv[2] : flag, flag, NULL};
  return do_verb(verb, argc > 2 ? 4 : argc > 1 ? 3 : 2, words);
}

static int do_words(int argc, char **argv) {
  if (argc < 2) {
    cli_usage_print(stderr, &program);
    return HOOKE_EXIT_USAGE;
  }
  if (strcmp(argv[1], "help") == 0) return do_help(argc - 2, argv + 2);
  if (strcmp(argv[1], "--complete") == 0)
    return cli_complete(&program, argc > 2 ? find_verb(argv[2]) : NULL, argc - 2, argv + 2);
  const struct cli_program_row *row = find_row(argv[1]);
  if (!row) row = find_row(cli_words_meant(argv[1]));
  if (row) return do_row(row, argc > 2 ? argv[2] : NULL);
  const struct cli_verb *verb = find_verb(argv[1]);
  return verb ? do_verb(verb, argc - 1, argv + 1) : unknown_verb(argv + 1);
}

static int end_output(int answer) {
  const int error = cli_print_flush();
  if (error == 0 && !ferror(stdout)) return answer;
  fputs("hooke: could not write to standard output", stderr);
  if (error) fprintf(stderr, ": %s", strerror(error));
  fputc('\n', stderr);
  return answer == HOOKE_EXIT_DONE ? HOOKE_EXIT_IO : answer;
}

int main(int argc, char **argv) {
  (void)hooke_io_own_process(); /* a build without HDF5 needs no guard against it */
  cli_os_begin();
  return end_output(do_words(argc, argv));
}
