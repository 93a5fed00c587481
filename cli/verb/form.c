#include "form.h"

#include "describe.h"
#include "report.h"

#include <ctype.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 76, COMMAND = 64, HELP = 100, CODE_SIZE = 16 };

/* The line that is being printed. */
struct line {
  FILE *file;
  int32_t column, in_example;   /* in_example: between .EX and .EE of roff */
  int32_t wraps, indent, fresh; /* fresh: no word stands before */
  int32_t length, shown;        /* of the word, in bytes and in columns */
  char word[HOOKE_DOC_SIZE];
};

/* NULL: empty */
struct fields {
  const char *verb, *kind, *summary, *sentence, *text, *operand, *input, *without, *example, *own_table;
  /* of the item of the innermost loop; not the first of it */
  const char *name, *letter, *value, *doc, *words, *missing, *later;
  /* of an option: what its family is, for the first one, else its name there; its units, if they are new */
  const char *family, *family_doc, *member, *units;
  /* answers: an option is the first of its table, the verb takes kinds, and there is none of them here */
  const char *first, *takes_kind, *bare;
};

#define FIELD(member)                                                                                        \
  { #member, offsetof(struct fields, member) }
static const struct {
  const char *name;
  size_t offset;
} field_rows[] = {FIELD(verb),    FIELD(kind),   FIELD(summary),    FIELD(sentence),   FIELD(text),
                  FIELD(operand), FIELD(input),  FIELD(without),    FIELD(example),    FIELD(own_table),
                  FIELD(name),    FIELD(letter), FIELD(value),      FIELD(doc),        FIELD(words),
                  FIELD(missing), FIELD(later),  FIELD(family),     FIELD(family_doc), FIELD(member),
                  FIELD(units),   FIELD(first),  FIELD(takes_kind), FIELD(bare)};

struct walk {
  const struct cli_form *form;
  const struct cli_program *program;
  struct line *line;
  const struct cli_verb *verb;
  struct fields is;
  const char *takes, *table; /* fields of an option: that of `words`, and one that its table has */
  char letter[2], code_text[CODE_SIZE], example[HOOKE_DOC_SIZE], words[HOOKE_DOC_SIZE];
  struct cli_arguments arguments;
  struct cli_description option;
  int code;
};

/* ---- printing ---- */

static void break_line(struct line *line) {
  fprintf(line->file, "%s\n%*s", line->in_example ? " \\e" : "", line->in_example ? 2 : line->indent, "");
  line->column = line->indent;
  line->fresh = 1;
}

static void end_word(const struct walk *w) {
  struct line *line = w->line;
  const int32_t width = line->in_example ? COMMAND : w->form->is_roff ? LINE : HELP;
  if (line->length == 0) return;
  line->word[line->length] = '\0';
  if (line->column == 0 && strncmp(line->word, ".E", 2) == 0) line->in_example = line->word[2] == 'X';
  if (!line->fresh && line->column + 1 + line->shown > width) break_line(line);
  fprintf(line->file, "%s%s", line->fresh ? "" : " ", line->word);
  line->column += line->shown + !line->fresh;
  line->length = line->shown = line->fresh = 0;
}

static void put(struct walk *w, char c) {
  struct line *line = w->line;
  if (line->wraps && (c == ' ' || c == '\n')) end_word(w);
  if (c == '\n') {
    fputc(c, line->file);
    line->column = line->indent = 0;
    line->wraps = w->form->is_roff;
    line->fresh = 1;
  } else if (!line->wraps) {
    fputc(c, line->file);
    line->column++;
  } else if (c != ' ' && line->length + 1 < HOOKE_DOC_SIZE) {
    line->word[line->length++] = c;
    line->shown += !line->in_example || c != '\\';
  }
}

static void pad(struct walk *w, int32_t column) {
  while (w->line->column < column)
    put(w, ' ');
}

/* From here on the line is broken at blanks, with the next one at column `indent`, to which this one goes on
 * unless it is empty. */
static void begin_text(struct walk *w, int32_t indent) {
  struct line *line = w->line;
  line->indent = indent;
  if (line->column + 2 > indent && line->column > 0) break_line(line);
  if (line->column > 0) pad(w, indent);
  line->wraps = line->fresh = 1;
}

static void put_all(struct walk *w, const char *text) {
  for (; *text; text++)
    put(w, *text);
}

/* With a backslash before every one of the `count` characters that are special. */
static void put_field(struct walk *w, const char *text, const char *special, size_t count) {
  for (const char *at = text; *at; at++) {
    const char *const *escape = w->form->escapes;
    while (*escape && **escape != *at)
      escape++;
    if (memchr(special, *at, count)) put(w, '\\');
    if (w->form->is_roff && *at == '.' && (at == text || at[-1] == ' ')) put_all(w, "\\&");
    if (*escape)
      put_all(w, *escape + 1);
    else
      put(w, *at);
  }
}

/* ---- loops: each sets the item `i`, and returns 0 past the last ---- */

static const char *answer(int32_t yes) {
  return yes ? "1" : NULL;
}

static int32_t set(struct walk *w, const char *name, char letter, const char *value, const char *doc) {
  w->letter[0] = letter;
  w->is.name = name;
  w->is.letter = w->letter;
  w->is.value = value;
  w->is.doc = doc;
  return name != NULL;
}

static void set_verb(struct walk *w, const struct cli_verb *verb) {
  w->verb = verb;
  w->is.verb = verb->name;
  w->is.summary = verb->summary;
  w->is.text = verb->text;
  w->is.operand = cli_describe_operand(verb);
  w->is.input = verb->input;
  w->is.without = verb->without;
  w->is.example = verb->example;
  w->is.own_table = verb->options;
  w->is.takes_kind = answer(verb->takes_kind);
}

static int32_t next_verb(struct walk *w, int64_t i) {
  const struct cli_verb *verb = w->program->verbs[i];
  if (verb) set_verb(w, verb);
  return verb && set(w, verb->name, '\0', NULL, verb->summary);
}

static int32_t next_row(struct walk *w, int64_t i) {
  const struct cli_program_row *row = &w->program->rows[i];
  w->is.words = row->words;
  return set(w, row->name, row->letter, row->value, row->doc);
}

static int32_t next_kind(struct walk *w, int64_t i) {
  w->is.kind = w->verb->takes_kind ? hooke_part_kind(i, "name") : NULL;
  return set(w, w->is.kind, '\0', NULL, hooke_part_kind(i, "summary"));
}

/* What has options: each kind of a verb that takes one, or else the verb. */
static int32_t next_taker(struct walk *w, int64_t i) {
  return w->verb->takes_kind ? next_kind(w, i) : i == 0;
}

/* A verb that has the common options only. */
static int32_t next_common(struct walk *w, int64_t i) {
  static const struct cli_verb common = {.name = "make"};
  set_verb(w, &common);
  return i == 0;
}

static int32_t next_method(struct walk *w, int64_t i) {
  const char *name = hooke_method_name(i);
  w->is.missing = answer(name && !hooke_method_is_built(name));
  return set(w, name, '\0', NULL, name ? hooke_method_summary(name) : NULL);
}

static int32_t next_exit(struct walk *w, int64_t i) {
  int32_t code = 0;
  const char *meaning = cli_describe_exit((int32_t)i, &code);
  snprintf(w->code_text, CODE_SIZE, "%d", (int)code);
  return set(w, meaning ? w->code_text : NULL, '\0', NULL, meaning);
}

static const char *table_of(const struct cli_arguments *arguments, const struct cli_argument *argument) {
  const struct cli_verb_row *own = argument->own, *rows = arguments->verb->rows;
  if (own) return rows && own >= rows && own < rows + arguments->verb->row_count ? "own" : "shared";
  if (argument->table == arguments->of_kind) return "part";
  if (argument->table == arguments->more) return "more";
  return argument->table == arguments->run ? "run" : "limits";
}

static void set_takes(struct walk *w, const struct cli_argument *argument) {
  const char *ending = cli_describe_file(argument);
  const int32_t takes = w->option.value[0] != '\0';
  int32_t many;
  w->is.words = cli_describe_words(argument, w->words, &many);
  if (w->words[0]) {
    w->takes = !takes ? "switch" : many ? "list" : "choice";
  } else {
    w->takes = !takes ? "" : !ending ? "open" : ending[0] ? "ending" : "file";
    w->is.words = ending && ending[0] ? ending : w->option.value;
  }
}

static const char *units_of(const struct cli_argument *argument) {
  return argument->table ? hooke_options_row(argument->table, argument->row, "units") : "";
}

/* Sets what only the first option has of its table, its family and those in its units. */
static void set_first(struct walk *w, int64_t i) {
  const struct cli_argument *all = w->arguments.all;
  const char *doc, *last = i > 0 ? cli_describe_family(&all[i - 1], &doc) : NULL;
  const char *family = cli_describe_family(&all[i], &w->is.family_doc);
  const int32_t again = family && last && strcmp(family, last) == 0;
  w->is.first = answer(i == 0 || all[i].table != all[i - 1].table);
  w->is.family = again ? NULL : family;
  w->is.member = again ? all[i].flag + strlen(last) : NULL;
  w->is.units = units_of(&all[i]);
  if (!w->is.units) w->code = cli_report(&w->arguments, cli_exit_code(HOOKE_NO_MEMORY), "out of memory");
  for (int64_t k = 0; k < i && w->is.units; k++)
    if (strcmp(units_of(&all[k]), w->is.units) == 0) w->is.units = NULL;
}

static int32_t next_option(struct walk *w, int64_t i) {
  if (i == 0) w->code = cli_arguments_collect(w->verb, w->is.kind, &w->arguments);
  if (w->code != HOOKE_EXIT_DONE || i >= w->arguments.count) return 0;
  const struct cli_argument *argument = &w->arguments.all[i];
  cli_describe(argument, &w->option);
  set(w, w->option.flag, w->option.letter, w->option.value, w->option.doc);
  w->table = table_of(&w->arguments, argument);
  set_takes(w, argument);
  set_first(w, i);
  return w->code == HOOKE_EXIT_DONE;
}

/* ---- fields ---- */

static int32_t is_named(const char *name, const char *tag, size_t length) {
  return strlen(name) == length && memcmp(name, tag, length) == 0;
}

static const char *find_field(struct walk *w, const char *tag, size_t length) {
  const char *text = NULL;
  if (is_named("command", tag, length)) return cli_describe_example(&w->arguments, w->example);
  if (is_named(w->takes, tag, length)) text = w->is.words;
  if (is_named(w->table, tag, length)) text = "1";
  for (size_t k = 0; k < sizeof field_rows / sizeof field_rows[0]; k++) {
    if (is_named(field_rows[k].name, tag, length))
      memcpy(&text, (const char *)&w->is + field_rows[k].offset, sizeof text);
  }
  return text ? text : "";
}

/* ---- the walk ---- */

static int32_t is_tag(const char *at) {
  return *at == '<' && (at[1] == '!' || isalpha((unsigned char)at[1]));
}

/* The > of a tag, from after its <. */
static const char *find_end(const char *at) {
  for (int32_t depth = 0; *at && (*at != '>' || depth > 0); at++)
    depth += is_tag(at) - (*at == '>');
  return at;
}

static void fill(struct walk *w, const char *at, const char *end);

static void repeat(struct walk *w, int32_t (*next)(struct walk *w, int64_t i), const char *body,
                   const char *end) {
  struct walk inner = *w;
  memset(&inner.arguments, 0, sizeof inner.arguments);
  for (int64_t i = 0; next(&inner, i) && inner.code == HOOKE_EXIT_DONE; i++) {
    inner.is.later = answer(i > 0);
    fill(&inner, body, end);
  }
  cli_arguments_destroy(&inner.arguments);
  w->code = inner.code;
}

static void fill_tag(struct walk *w, const char *tag, const char *end) {
  static const struct {
    const char *name;
    int32_t (*next)(struct walk *w, int64_t i);
  } loops[] = {{"verbs", next_verb},     {"rows", next_row},       {"kinds", next_kind},
               {"takers", next_taker},   {"options", next_option}, {"common", next_common},
               {"methods", next_method}, {"exits", next_exit}};
  const int32_t empty = *tag == '!';
  const size_t length = strcspn(tag += empty, ":/>");
  const char *body = tag + length + 1;
  for (size_t k = 0; k < sizeof loops / sizeof loops[0]; k++) {
    if (is_named(loops[k].name, tag, length)) {
      repeat(w, loops[k].next, body, end);
      return;
    }
  }
  const char *text = find_field(w, tag, length);
  if (is_named("to", tag, length)) {
    begin_text(w, (int32_t)strtol(body, NULL, 10));
  } else if (is_named("tab", tag, length)) {
    pad(w, (int32_t)strtol(body, NULL, 10));
  } else if (tag[length] != ':') {
    put_field(w, text, body, tag[length] == '/' ? (size_t)(end - body) : 0);
  } else if ((text[0] == '\0') == empty) {
    fill(w, body, end);
  }
}

static void fill(struct walk *w, const char *at, const char *end) {
  while (at < end && w->code == HOOKE_EXIT_DONE) {
    if (!is_tag(at)) {
      put(w, *at++);
      continue;
    }
    const char *stop = find_end(at + 1);
    fill_tag(w, at + 1, stop);
    at = stop + 1;
  }
}

int cli_form_print(FILE *file, const struct cli_form *form, const struct cli_program *program,
                   const struct cli_arguments *arguments) {
  struct line line = {.file = file, .wraps = form->is_roff, .fresh = 1};
  struct walk walk = {
      .form = form, .program = program, .line = &line, .takes = "", .table = "", .code = HOOKE_EXIT_DONE};
  char sentence[HOOKE_DOC_SIZE];
  if (arguments) set_verb(&walk, arguments->verb);
  if (program) walk.is.summary = program->summary;
  if (program) walk.is.text = program->text;
  if (walk.is.takes_kind) walk.is.kind = arguments->scene;
  walk.is.bare = answer(walk.is.takes_kind && !walk.is.kind);
  snprintf(sentence, sizeof sentence, "%c%s", toupper((unsigned char)walk.is.summary[0]),
           walk.is.summary + 1);
  walk.is.sentence = sentence;
  fill(&walk, form->text, form->text + strlen(form->text));
  return walk.code;
}
