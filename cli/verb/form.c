#include "form.h"

#include "describe.h"
#include "report.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

enum { LINE = 76, COMMAND = 64, HELP = 100, CODE_SIZE = 16 };

/* The line that is being printed. */
struct line {
  FILE *file;
  int32_t column, is_request, in_example;
  int32_t wraps, indent, fresh; /* fresh: no word stands before */
  int32_t length, shown;        /* of the word, in bytes and in columns */
  char word[HOOKE_DOC_SIZE];
};

struct walk {
  const struct cli_form *form;
  const struct cli_program *program;
  struct line *line;
  const struct cli_verb *verb;
  const char *kind;
  /* the item of the innermost loop */
  int64_t index;
  char letter[2], code_text[CODE_SIZE], example[HOOKE_DOC_SIZE], choices[HOOKE_DOC_SIZE];
  const char *name, *value, *doc, *words, *missing;
  /* of an option: the field that holds `words`, and one for its table */
  const char *takes, *table;
  /* what its family is, for the first one, or else its name there; its units, where they are new */
  const char *family, *family_doc, *member, *units;
  int32_t first; /* of its table */
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
  if (w->form->is_roff && line->column == 0) {
    line->is_request = line->word[0] == '.';
    if (strncmp(line->word, ".E", 2) == 0) line->in_example = line->word[2] == 'X';
  }
  if (!line->fresh && !line->is_request && line->column + 1 + line->shown > width) break_line(line);
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

static int32_t set(struct walk *w, const char *name, const char *doc) {
  w->name = name;
  w->doc = doc;
  w->value = w->words = w->takes = w->table = w->missing = w->member = "";
  w->letter[0] = '\0';
  return name != NULL;
}

static int32_t next_verb(struct walk *w, int64_t i) {
  w->verb = w->program->verbs[i];
  return w->verb && set(w, w->verb->name, w->verb->summary);
}

static int32_t next_row(struct walk *w, int64_t i) {
  const struct cli_program_row *row = &w->program->rows[i];
  if (!set(w, row->name, row->doc)) return 0;
  w->letter[0] = row->letter;
  if (row->value) w->value = row->value;
  if (row->words) w->words = row->words;
  return 1;
}

static int32_t next_kind(struct walk *w, int64_t i) {
  w->kind = w->verb->takes_kind ? hooke_part_kind(i, "name") : NULL;
  return set(w, w->kind, hooke_part_kind(i, "summary"));
}

/* What has options: each kind of a verb that takes one, or else the verb. */
static int32_t next_taker(struct walk *w, int64_t i) {
  return w->verb->takes_kind ? next_kind(w, i) : i == 0;
}

/* A verb that has the common options only. */
static int32_t next_common(struct walk *w, int64_t i) {
  static const struct cli_verb common = {.name = "make"};
  w->verb = &common;
  return i == 0;
}

static int32_t next_method(struct walk *w, int64_t i) {
  const char *name = hooke_method_name(i);
  if (!set(w, name, name ? hooke_method_summary(name) : NULL)) return 0;
  if (!hooke_method_is_built(name)) w->missing = "1";
  return 1;
}

static int32_t next_exit(struct walk *w, int64_t i) {
  int32_t code = 0;
  const char *meaning = cli_describe_exit((int32_t)i, &code);
  snprintf(w->code_text, CODE_SIZE, "%d", (int)code);
  return set(w, meaning ? w->code_text : NULL, meaning);
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
  int32_t many;
  w->words = cli_describe_words(argument, w->choices, &many);
  if (w->words[0]) {
    w->takes = !w->value[0] ? "switch" : many ? "list" : "choice";
  } else if (w->value[0]) {
    w->takes = !ending ? "open" : ending[0] ? "ending" : "file";
    w->words = ending && ending[0] ? ending : w->value;
  }
}

static const char *units_of(const struct cli_argument *argument) {
  return argument->table ? hooke_options_row(argument->table, argument->row, "units") : "";
}

/* Sets what only the first option has of its table, its family and those in its units. */
static void set_first(struct walk *w, int64_t i) {
  const struct cli_argument *all = w->arguments.all;
  const char *doc, *last = i > 0 ? cli_describe_family(&all[i - 1], &doc) : NULL;
  w->first = i == 0 || all[i].table != all[i - 1].table;
  w->family = cli_describe_family(&all[i], &w->family_doc);
  if (w->family && last && strcmp(w->family, last) == 0) {
    w->member = all[i].flag + strlen(last);
    w->family = NULL;
  }
  w->units = units_of(&all[i]);
  if (!w->units) w->code = cli_report(&w->arguments, cli_exit_code(HOOKE_NO_MEMORY), "out of memory");
  for (int64_t k = 0; k < i && w->units; k++)
    if (strcmp(units_of(&all[k]), w->units) == 0) w->units = NULL;
}

static int32_t next_option(struct walk *w, int64_t i) {
  if (i == 0) w->code = cli_arguments_collect(w->verb, w->kind, &w->arguments);
  if (w->code != HOOKE_EXIT_DONE || i >= w->arguments.count) return 0;
  const struct cli_argument *argument = &w->arguments.all[i];
  cli_describe(argument, &w->option);
  set(w, w->option.flag, w->option.doc);
  w->letter[0] = w->option.letter;
  w->value = w->option.value;
  w->table = table_of(&w->arguments, argument);
  set_takes(w, argument);
  set_first(w, i);
  return w->code == HOOKE_EXIT_DONE;
}

/* ---- fields ---- */

static int32_t is_named(const char *name, const char *tag, size_t length) {
  return strlen(name) == length && memcmp(name, tag, length) == 0;
}

/* The summary, with a capital. */
static const char *as_sentence(struct walk *w) {
  const char *words = w->verb ? w->verb->summary : w->program->summary;
  snprintf(w->choices, sizeof w->choices, "%c%s", toupper((unsigned char)words[0]), words + 1);
  return w->choices;
}

static const char *find_field(struct walk *w, const char *tag, size_t length) {
  static const struct cli_verb none;
  const struct cli_verb *verb = w->verb ? w->verb : &none;
  const struct {
    const char *name, *text;
  } fields[] = {{"name", w->name},
                {"letter", w->letter},
                {"value", w->value},
                {"doc", w->doc},
                {"words", w->words},
                {"later", w->index > 0 ? "1" : ""},
                {"missing", w->missing},
                {"first", w->first ? "1" : ""},
                {"family", w->family},
                {"family_doc", w->family_doc},
                {"member", w->member},
                {"units", w->units},
                {"options_of", verb->takes_kind ? "scene" : verb->name},
                {"own_table", verb->options},
                {"verb", verb->name},
                {"text", w->verb ? verb->text : w->program->text},
                {"summary", w->verb ? verb->summary : w->program->summary},
                {"bare", verb->takes_kind && !w->kind ? "1" : ""},
                {"input", verb->input},
                {"kind", w->kind},
                {"without", verb->without},
                {"takes_kind", verb->takes_kind ? "1" : ""},
                {"example", verb->example},
                {w->takes, w->words},
                {w->table, "1"}};
  if (is_named("operand", tag, length)) return cli_describe_operand(verb);
  if (is_named("sentence", tag, length)) return as_sentence(w);
  if (is_named("command", tag, length)) return cli_describe_example(&w->arguments, w->example);
  for (size_t k = 0; k < sizeof fields / sizeof fields[0]; k++) {
    if (is_named(fields[k].name, tag, length)) return fields[k].text ? fields[k].text : "";
  }
  return "";
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
  for (inner.index = 0; next(&inner, inner.index) && inner.code == HOOKE_EXIT_DONE; inner.index++)
    fill(&inner, body, end);
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
  struct walk walk = {.form = form, .program = program, .line = &line, .code = HOOKE_EXIT_DONE};
  if (arguments) walk.verb = arguments->verb;
  if (arguments && walk.verb->takes_kind) walk.kind = arguments->scene;
  set(&walk, "", "");
  fill(&walk, form->text, form->text + strlen(form->text));
  return walk.code;
}
