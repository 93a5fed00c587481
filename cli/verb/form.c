#include "form.h"

#include "describe.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

enum { LINE = 76, COMMAND = 64, CODE_SIZE = 16 };

/* The line that is being printed. */
struct line {
  int32_t column, is_request, in_example;
  int32_t length, shown; /* of the word, in bytes and in columns */
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
  const char *name, *value, *doc, *words;
  const char *takes; /* what follows an option: a field that holds `words` */
  const char *table; /* that an option is from: a field */
  struct cli_arguments arguments;
  struct cli_description option;
  int code;
};

/* ---- printing ---- */

static void end_word(struct line *line) {
  if (line->length == 0) return;
  line->word[line->length] = '\0';
  if (line->column == 0) line->is_request = line->word[0] == '.';
  if (line->is_request && line->column == 0 && line->word[1] == 'E') line->in_example = line->word[2] == 'X';
  if (line->column > 0 && !line->is_request &&
      line->column + 1 + line->shown > (line->in_example ? COMMAND : LINE)) {
    fputs(line->in_example ? " \\e\n  " : "\n", stdout);
    line->column = 0;
  }
  if (line->column > 0) line->column += putchar(' ') == ' ';
  line->column += line->shown;
  fputs(line->word, stdout);
  line->length = line->shown = 0;
}

static void put(struct walk *w, char c) {
  struct line *line = w->line;
  if (!w->form->is_roff) {
    putchar(c);
  } else if (c == ' ' || c == '\n') {
    end_word(line);
    if (c == ' ') return;
    putchar(c);
    line->column = 0;
  } else if (line->length + 1 < HOOKE_DOC_SIZE) {
    line->word[line->length++] = c;
    line->shown += !line->in_example || c != '\\';
  }
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
  w->value = w->words = w->takes = w->table = "";
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
  return set(w, name, name ? hooke_method_summary(name) : NULL);
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
  return 1;
}

/* ---- fields ---- */

static int32_t is_named(const char *name, const char *tag, size_t length) {
  return strlen(name) == length && memcmp(name, tag, length) == 0;
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
                {"verb", verb->name},
                {"text", verb->text},
                {"input", verb->input},
                {"kind", w->kind},
                {"without", verb->without},
                {"takes_kind", verb->takes_kind ? "1" : ""},
                {"example", verb->example},
                {w->takes, w->words},
                {w->table, "1"},
                {"summary", w->program->summary},
                {"description", w->program->text}};
  if (is_named("operand", tag, length)) return cli_describe_operand(verb);
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
  if (tag[length] != ':') {
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

int cli_form_print(const struct cli_form *form, const struct cli_program *program) {
  struct line line = {.column = 0};
  struct walk walk = {.form = form, .program = program, .line = &line, .code = HOOKE_EXIT_DONE};
  set(&walk, "", "");
  fill(&walk, form->text, form->text + strlen(form->text));
  return walk.code;
}
