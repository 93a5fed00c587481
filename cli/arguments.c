#include "arguments.h"
#include "describe.h"
#include "print.h"
#include "report.h"
#include "words.h"

#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FIRST_LONG = 1000 }; /* values of getopt_long() that are not letters */

static const struct cli_verb_row shared_rows[] = {
    {"json", 0, NULL, "prints one JSON object, with every digit, and nothing else"},
    {"quiet", 'q', NULL, "prints no progress and no notes; results and failures stay"},
    {"help", 'h', NULL, "prints the names of the options; --help all: all of this text"},
};
enum { SHARED_COUNT = sizeof shared_rows / sizeof shared_rows[0] };

int32_t cli_is_among(const char *words, const char *name) {
  const size_t length = strlen(name);
  for (const char *at = words; at && (at = strstr(at, name)) != NULL; at += length)
    if ((at == words || at[-1] == ' ') && (at[length] == ' ' || at[length] == '\0')) return 1;
  return 0;
}

static void add_own(struct cli_arguments *arguments, const struct cli_verb_row *row) {
  struct cli_argument *argument = &arguments->all[arguments->count++];
  argument->own = row;
  argument->name = row->name;
  snprintf(argument->flag, sizeof argument->flag, "%s", row->name);
}

const char *cli_arguments_flag(const char *name, char flag[HOOKE_FLAG_SIZE]) {
  snprintf(flag, HOOKE_FLAG_SIZE, "%s", name);
  for (char *at = flag; *at; at++) {
    if (*at == '_') *at = '-';
  }
  return flag;
}

static void add_option(struct cli_arguments *arguments, hooke_options *table, int64_t row) {
  struct cli_argument *argument = &arguments->all[arguments->count++];
  argument->name = hooke_options_row(table, row, "name");
  argument->table = table;
  argument->row = row;
  cli_arguments_flag(argument->name, argument->flag);
}

/* A family is no option itself: its members make it present. What may stand in place of a number in a family
 * is for scenes. */
static void add_table(struct cli_arguments *arguments, hooke_options *table, const char *without) {
  for (int64_t row = 0; table && row < hooke_options_row_count(table); row++) {
    if (strcmp(hooke_options_row(table, row, "type"), "family") == 0) continue;
    if (strchr(hooke_options_row(table, row, "family"), '.')) continue;
    if (!cli_is_among(without, hooke_options_row(table, row, "name"))) add_option(arguments, table, row);
  }
}

/* Requests the texts that allocate memory in advance, so that they exist whenever something is printed. */
static int32_t create_table(const char *name, hooke_options **table) {
  int32_t status = hooke_options_create(name, table);
  for (int64_t row = 0; status == HOOKE_OK && row < hooke_options_row_count(*table); row++)
    if (!hooke_options_row(*table, row, "allowed") || !hooke_options_row(*table, row, "units"))
      status = HOOKE_NO_MEMORY;
  return status;
}

int cli_arguments_collect(const struct cli_verb *verb, const char *kind, struct cli_arguments *arguments) {
  const struct {
    const char *name;
    hooke_options **table;
  } tables[] = {{kind, &arguments->of_kind},
                {verb->options, &arguments->more},
                {"run", &arguments->run},
                {verb->input || verb->takes_kind ? NULL : "limits", &arguments->limits}};
  int64_t count = verb->row_count + SHARED_COUNT;
  arguments->verb = verb;
  arguments->scene = kind;
  for (size_t k = 0; k < sizeof tables / sizeof tables[0]; k++) {
    if (!tables[k].name) continue;
    const int32_t status = create_table(tables[k].name, tables[k].table);
    if (status != HOOKE_OK) return cli_report_status(arguments, status);
    count += hooke_options_row_count(*tables[k].table);
  }
  arguments->all = calloc((size_t)count, sizeof *arguments->all);
  if (!arguments->all) return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  add_table(arguments, arguments->of_kind, NULL);
  add_table(arguments, arguments->more, verb->hidden);
  for (int32_t i = 0; i < verb->row_count; i++)
    add_own(arguments, &verb->rows[i]);
  for (int32_t i = 0; i < SHARED_COUNT; i++)
    add_own(arguments, &shared_rows[i]);
  if (!verb->input && !verb->takes_no_run) add_table(arguments, arguments->run, verb->without);
  add_table(arguments, arguments->limits, NULL);
  return HOOKE_EXIT_DONE;
}

/* ---- unknown options ---- */

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
static void list_verbs(const struct cli_verb *const *verbs, const char *flag, char list[HOOKE_DOC_SIZE]) {
  list[0] = '\0';
  for (int32_t k = 0; verbs[k]; k++) {
    struct cli_arguments other = {.verb = verbs[k]};
    const int code = cli_arguments_collect(verbs[k], NULL, &other);
    for (int32_t i = 0; code == HOOKE_EXIT_DONE && i < other.count; i++)
      if (strcmp(other.all[i].flag, flag) == 0)
        cli_append(list, HOOKE_DOC_SIZE, "%s%s", list[0] ? ", " : "", verbs[k]->name);
    cli_arguments_destroy(&other);
  }
}

/* Reports that the verb has no option `word` ("--stpe=1", "-x"), followed by `value` (NULL: nothing). */
static int report_unknown_option(const struct cli_arguments *arguments, const char *word, const char *value) {
  char flag[HOOKE_FLAG_SIZE], list[HOOKE_DOC_SIZE], verbs[HOOKE_DOC_SIZE] = "";
  const char *near = NULL;
  snprintf(flag, sizeof flag, "%s", word + strspn(word, "-"));
  flag[strcspn(flag, "=")] = '\0';
  list_verbs(arguments->verbs, flag, verbs); /* which have it whole */
  const int longer = !verbs[0] && strncmp(word, "--", 2) == 0 ? list_longer(arguments, flag, list, &near) : 0;
  const int family = near && near[strlen(flag)] == '.';
  if (longer > 1 && !family)
    return cli_report(arguments, HOOKE_EXIT_USAGE, "--%s is ambiguous: %s", flag, list);
  if (longer == 0 && !verbs[0]) near = cli_suggest(flag, next_flag, arguments);
  const int filled = family && value && value[0] != '-';
  return cli_report(
      arguments, HOOKE_EXIT_USAGE, "there is no option %s%s%s%s%s%s%s%s; 'hooke %s%s%s --help' lists them",
      word, verbs[0] ? ", which is one of " : "", verbs, near ? ", did you mean --" : "", near ? near : "",
      filled ? " " : "", filled ? value : "", near ? "?" : "", arguments->verb->name,
      arguments->of_kind ? " " : "", arguments->of_kind ? arguments->scene : "");
}

/* ---- parsing ---- */

int32_t cli_argument_is_flag(const struct cli_argument *argument) {
  return argument->own == NULL &&
         strcmp(hooke_options_row(argument->table, argument->row, "type"), "flag") == 0;
}

static int32_t has_rows(const struct cli_argument *argument) {
  return hooke_options_row_number(argument->table, argument->row, "columns") > 1.0;
}

int32_t cli_argument_adds_up(const struct cli_argument *argument) {
  return has_rows(argument) || hooke_options_row_number(argument->table, argument->row, "word_lists") == 1.0;
}

/* Takes the text as the value, or adds it there. */
static int read_value(const struct cli_arguments *arguments, struct cli_argument *argument) {
  const char *before = argument->value && cli_argument_adds_up(argument) ? argument->value : "";
  const char *type = hooke_options_row(argument->table, argument->row, "type");
  const char *between = before[0] == '\0'           ? ""
                        : has_rows(argument)        ? ";"
                        : strcmp(type, "text") == 0 ? "\n"
                                                    : ",";
  const size_t size = strlen(before) + strlen(argument->text) + 2;
  char *value = malloc(size);
  if (value) snprintf(value, size, "%s%s%s", before, between, argument->text);
  free(argument->value);
  argument->value = value;
  return value ? HOOKE_EXIT_DONE : cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
}

/* The report has the name of the option already, with which a message of the library begins. */
static int set_value(const struct cli_arguments *arguments, const struct cli_argument *argument) {
  const int32_t status = hooke_options_set_text(argument->table, argument->name, argument->value);
  if (status == HOOKE_OK) return HOOKE_EXIT_DONE;
  const int code = status == HOOKE_NO_MEMORY ? HOOKE_EXIT_BAD_INPUT : cli_refusal(arguments);
  const char *example = hooke_options_row(argument->table, argument->row, "example");
  const char *message = hooke_last_error();
  const size_t length = strlen(argument->name);
  if (strncmp(message, argument->name, length) == 0 && strncmp(message + length, ": ", 2) == 0)
    message += length + 2;
  return cli_report(arguments, code, "--%s %s: %s%s%s", argument->flag, argument->text, message,
                    example[0] ? ", such as " : "", example);
}

static int name_method(const struct cli_arguments *arguments, struct cli_argument *argument) {
  const char *name = hooke_method_meant(argument->text);
  if (hooke_method_is_adaptive(name) < 0)
    return cli_report_unknown_method(arguments, argument->flag, argument->text, strlen(argument->text));
  argument->text = name;
  return HOOKE_EXIT_DONE;
}

static int take(struct cli_arguments *arguments, struct cli_argument *argument, const char *text) {
  argument->text = text ? text : cli_argument_is_flag(argument) ? "true" : "";
  if (argument->own) return HOOKE_EXIT_DONE;
  const int answer =
      strcmp(argument->name, "method") == 0 ? name_method(arguments, argument) : HOOKE_EXIT_DONE;
  return answer == HOOKE_EXIT_DONE ? read_value(arguments, argument) : answer;
}

/* Some values need the whole command line. */
static int set_values(const struct cli_arguments *arguments) {
  int answer = HOOKE_EXIT_DONE;
  for (int32_t i = 0; i < arguments->count && answer == HOOKE_EXIT_DONE; i++)
    if (arguments->all[i].value) answer = set_value(arguments, &arguments->all[i]);
  return answer;
}

/* The argument for getopt_long() or one of its letters. */
static struct cli_argument *argument_of(struct cli_arguments *arguments, int code) {
  if (code == 0) return NULL;
  if (code >= FIRST_LONG) return &arguments->all[code - FIRST_LONG];
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_verb_row *own = arguments->all[i].own;
    if (own && own->letter == code) return &arguments->all[i];
  }
  return NULL;
}

const char *cli_arguments_operand(const struct cli_verb *verb) {
  return verb->takes_kind ? "KIND" : verb->input ? verb->input : "SCENE";
}

/* The word that is not an option, or several. */
static int take_operand(struct cli_arguments *arguments, int argc, char **argv) {
  const char *input = arguments->verb->input;
  const char *name = arguments->verb->for_scene, *instead = name ? cli_arguments_text(arguments, name) : NULL;
  if (instead) {
    arguments->scene = instead;
    if (optind >= argc) return HOOKE_EXIT_DONE;
    return cli_report(arguments, HOOKE_EXIT_USAGE, "--%s %s has a scene of its own; leave out '%s'", name,
                      instead, argv[optind]);
  }
  if (optind >= argc) {
    return cli_report(arguments, HOOKE_EXIT_USAGE, "no %s given; usage: hooke %s %s [options]%s",
                      input ? input : "scene", arguments->verb->name, cli_arguments_operand(arguments->verb),
                      input ? "" : "; - reads a scene from standard input");
  }
  arguments->more_scenes = argv + optind + 1;
  arguments->more_count = argc - optind - 1;
  if (arguments->more_count > 0 && !arguments->verb->several) {
    return cli_report(arguments, HOOKE_EXIT_USAGE, "one %s at a time: '%s' and '%s' were given",
                      input ? "file" : "scene", argv[optind], argv[optind + 1]);
  }
  arguments->scene = argv[optind];
  return HOOKE_EXIT_DONE;
}

static int parse_words(struct cli_arguments *arguments, int argc, char **argv, const char *letters,
                       const struct option *longs) {
  int code;
  opterr = 0;
  optind = 0; /* restarts, whatever was parsed before */
  while ((code = getopt_long(argc, argv, letters, longs, NULL)) != -1) {
    struct cli_argument *argument = argument_of(arguments, code == '?' || code == ':' ? optopt : code);
    const char *word = argv[optind - 1 - (optarg == argv[optind - 1])];
    const int one =
        code >= FIRST_LONG && word[2] && (!word[3] || word[3] == '='); /* letter of a long option */
    if (!argument || one) {
      char letter[3] = {'-', (char)optopt, '\0'}; /* 0: it was a long option */
      return report_unknown_option(arguments, argument || !optopt ? word : letter, argv[optind]);
    }
    if (code == ':')
      return cli_report(arguments, HOOKE_EXIT_USAGE, "--%s wants a value after it", argument->flag);
    if (code == '?') return cli_report(arguments, HOOKE_EXIT_USAGE, "--%s takes no value", argument->flag);
    int answer = take(arguments, argument, optarg);
    if (answer != HOOKE_EXIT_DONE) return answer;
  }
  arguments->help = cli_arguments_text(arguments, "help") != NULL;
  for (int i = optind; arguments->help && i < argc; i++)
    arguments->help += strcmp(argv[i], "all") == 0;
  if (arguments->help) return HOOKE_EXIT_DONE;
  int answer = set_values(arguments);
  if (answer != HOOKE_EXIT_DONE) return answer;
  if (arguments->verb->takes_kind) {
    if (optind + 1 >= argc) return HOOKE_EXIT_DONE;
    return cli_report(arguments, HOOKE_EXIT_USAGE, "'%s' is one word too many after the kind '%s'",
                      argv[optind + 1], arguments->scene);
  }
  return take_operand(arguments, argc, argv);
}

static const char *next_kind(int64_t i, const void *ctx) {
  (void)ctx;
  return hooke_part_kind(i, "name");
}

/* The kind comes first, since it determines the other options; NULL if there is none. */
static int find_kind(struct cli_arguments *arguments, int argc, char **argv, const char **kind) {
  const char *word = argc < 2 ? "-" : argv[1];
  *kind = NULL;
  if (!arguments->verb->takes_kind || strcmp(word, "--help") == 0 || strcmp(word, "-h") == 0)
    return HOOKE_EXIT_DONE;
  if (word[0] == '-') {
    return cli_report(
        arguments, HOOKE_EXIT_USAGE,
        "no kind given; it comes first: hooke %s KIND [options]; 'hooke %s --help' lists the kinds",
        arguments->verb->name, arguments->verb->name);
  }
  const char *near = cli_suggest(word, next_kind, NULL);
  if (near && strcmp(near, word) == 0) *kind = word;
  if (*kind) return HOOKE_EXIT_DONE;
  return cli_report(arguments, HOOKE_EXIT_USAGE, "there is no kind '%s'%s%s%s; 'hooke %s --help' lists them",
                    word, near ? ", did you mean '" : "", near ? near : "", near ? "'?" : "",
                    arguments->verb->name);
}

int cli_arguments_parse(const struct cli_verb *const *verbs, const struct cli_verb *verb, int argc,
                        char **argv, struct cli_arguments *arguments) {
  *arguments = (struct cli_arguments){.verbs = verbs, .verb = verb};
  /* parsed first, so that wrong usage is reported in the requested form */
  for (int i = 1; i < argc && strcmp(argv[i], "--") != 0; i++) {
    if (strcmp(argv[i], "--json") == 0) arguments->json = 1;
  }
  const char *kind;
  int answer = find_kind(arguments, argc, argv, &kind);
  if (answer == HOOKE_EXIT_DONE) answer = cli_arguments_collect(verb, kind, arguments);
  if (answer != HOOKE_EXIT_DONE) return answer;

  struct option *longs = calloc((size_t)arguments->count + 1, sizeof *longs);
  char *letters = calloc((size_t)arguments->count * 2 + 2, 1);
  if (longs && letters) {
    char *letter = letters;
    *letter++ = ':';
    for (int32_t i = 0; i < arguments->count; i++) {
      const struct cli_argument *argument = &arguments->all[i];
      int32_t wants = argument->own ? argument->own->value != NULL : 1;
      const int wanted = cli_argument_is_flag(argument) ? optional_argument
                         : wants                        ? required_argument
                                                        : no_argument;
      longs[i] = (struct option){argument->flag, wanted, NULL, FIRST_LONG + i};
      if (argument->own && argument->own->letter) {
        *letter++ = argument->own->letter;
        if (wants) *letter++ = ':';
      }
    }
    answer = parse_words(arguments, argc, argv, letters, longs);
    arguments->json = cli_arguments_text(arguments, "json") != NULL;
    arguments->quiet = cli_arguments_text(arguments, "quiet") != NULL;
  } else {
    answer = cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  }
  free(letters);
  free(longs);
  return answer;
}

void cli_arguments_destroy(struct cli_arguments *arguments) {
  for (int32_t i = 0; i < arguments->count; i++)
    free(arguments->all[i].value);
  free(arguments->all);
  hooke_options_destroy(arguments->run);
  hooke_options_destroy(arguments->more);
  hooke_options_destroy(arguments->limits);
  hooke_options_destroy(arguments->of_kind);
}

/* ---- queries ---- */

const char *cli_arguments_text(const struct cli_arguments *arguments, const char *name) {
  for (int32_t i = 0; i < arguments->count; i++) {
    if (strcmp(arguments->all[i].name, name) == 0) return arguments->all[i].text;
  }
  return NULL;
}

int32_t cli_arguments_asks(const struct cli_arguments *arguments, const char *name) {
  return hooke_options_number(arguments->more, name) == 1.0;
}

int32_t cli_arguments_has_run(const struct cli_arguments *arguments) {
  int32_t has = 0;
  for (int32_t i = 0; i < arguments->count; i++)
    has |= arguments->all[i].table == arguments->run && arguments->all[i].text != NULL;
  return has;
}

int32_t cli_arguments_apply(const struct cli_arguments *arguments, hooke_options *options) {
  for (int32_t i = 0; i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    if (argument->table != arguments->run || !argument->text) continue;
    int32_t status = hooke_options_set_text(options, argument->name, argument->value);
    if (status != HOOKE_OK) return status;
  }
  return HOOKE_OK;
}
