#include "core/table/option.h"

#include "core/handle.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/table/option_value.h"
#include "core/status.h"
#include "core/table/unit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { DOTTED_SIZE = 64, NAME_SIZE = 128, TEXT_SIZE = 512 };

/* One row of the table or of one of its families, flattened: a family is followed by its members. */
struct slot {
  const struct hk_option_row *row;
  int64_t family;        /* slot of its family; -1: none */
  const char *name;      /* with dots: the row's own, or `dotted` */
  char *allowed, *units; /* NULL until first requested */
  char dotted[DOTTED_SIZE];
  int32_t is_set;
  struct hk_option_value value, fallback;
};

struct hooke_options {
  const struct hk_option_table *table;
  int64_t slot_count;
  struct slot *slot;
};

static int64_t count_rows(const struct hk_option_table *table) {
  int64_t count = table->row_count;
  for (int32_t k = 0; k < table->row_count; k++)
    if (table->rows[k].family) count += count_rows(table->rows[k].family);
  return count;
}

static int32_t fill_slots(hooke_options *options, const struct hk_option_table *table, int64_t family) {
  for (int32_t k = 0; k < table->row_count; k++) {
    const struct hk_option_row *row = &table->rows[k];
    const int64_t at = options->slot_count++;
    struct slot *slot = &options->slot[at];
    slot->row = row;
    slot->family = family;
    slot->name = family < 0 ? row->name : slot->dotted;
    if (family >= 0) hk_print(slot->dotted, DOTTED_SIZE, "%s.%s", options->slot[family].name, row->name);
    int32_t status = HOOKE_OK;
    if (row->fallback) status = hk_option_value_from_text(row, slot->name, row->fallback, &slot->fallback);
    if (status == HOOKE_OK && row->family) status = fill_slots(options, row->family, at);
    if (status) return status;
  }
  return HOOKE_OK;
}

int32_t hk_options_create(const struct hk_option_table *table, hooke_options **options) {
  *options = NULL;
  hooke_options *made = hk_handle_new("hooke_options", sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  made->table = table;
  made->slot = hk_new(count_rows(table), sizeof *made->slot);
  int32_t status = made->slot ? fill_slots(made, table, -1) : HOOKE_NO_MEMORY;
  return HOOKE_HAND_OVER(status, made, options, hooke_options_destroy);
}

void hooke_options_destroy(hooke_options *options) {
  if (options == NULL) return;
  for (int64_t k = 0; options->slot && k < options->slot_count; k++) {
    struct slot *slot = &options->slot[k];
    hk_option_value_clear(&slot->value);
    hk_option_value_clear(&slot->fallback);
    hk_free(slot->allowed);
    hk_free(slot->units);
  }
  hk_free(options->slot);
  hk_handle_free(options);
}

const struct hk_option_table *hk_options_table(const hooke_options *options) {
  return options->table;
}

#define MAKER "hooke_options_create(\"%s\", ...)"

int32_t hk_options_require(const hooke_options *options, const struct hk_option_table *table,
                           const char *where, const char *name) {
  if (options && options->table == table) return HOOKE_OK;
  if (options == NULL) return hk_fail(HOOKE_BAD_VALUE, where, "are missing; make them with " MAKER, name);
  return hk_fail(HOOKE_BAD_VALUE, where, "are those of a %s; make them with " MAKER, options->table->name,
                 name);
}

/* The row named by the beginning of `name`, up to the end or a dot. */
static const struct hk_option_row *find_first(const struct hk_option_table *table, const char *name,
                                              const char **rest) {
  size_t length = strcspn(name, ".");
  *rest = name[length] ? name + length + 1 : NULL;
  for (int32_t k = 0; k < table->row_count; k++)
    if (strncmp(table->rows[k].name, name, length) == 0 && table->rows[k].name[length] == '\0')
      return &table->rows[k];
  return NULL;
}

const struct hk_option_row *hk_options_find(const struct hk_option_table *table, const char *name) {
  while (table && name) {
    const struct hk_option_row *row = find_first(table, name, &name);
    if (row == NULL || name == NULL) return row;
    table = row->family;
  }
  return NULL;
}

/* Reports which part of a dotted name is unknown, and the names that exist there. */
static int32_t fail_unknown(const hooke_options *options, const char *name) {
  const struct hk_option_table *table = options->table;
  const char *part = name;
  for (const char *rest = NULL;; part = rest) {
    const struct hk_option_row *row = find_first(table, part, &rest);
    if (row == NULL) break;
    if (row->family == NULL || rest == NULL)
      return hk_fail(HOOKE_BAD_VALUE, name, "%s has no members", row->name);
    table = row->family;
  }
  char wanted[NAME_SIZE];
  snprintf(wanted, sizeof wanted, "%.*s", (int)strcspn(part, "."), part);
  return hk_option_unknown(table, NULL, table->name, "option", wanted);
}

static struct slot *find_slot(const hooke_options *options, const char *name) {
  if (options == NULL || name == NULL) return NULL;
  for (int64_t k = 0; k < options->slot_count; k++)
    if (options->slot[k].name[0] == name[0] && strcmp(options->slot[k].name, name) == 0)
      return &options->slot[k];
  return NULL;
}

static int32_t require_slot(const hooke_options *options, const char *name, struct slot **slot) {
  *slot = find_slot(options, name);
  if (*slot) return HOOKE_OK;
  if (options == NULL || name == NULL) return hk_fail(HOOKE_BAD_VALUE, NULL, "no options or no name given");
  return fail_unknown(options, name);
}

static void clear(struct slot *slot) {
  hk_option_value_clear(&slot->value);
  slot->is_set = 0;
}

static void clear_members(hooke_options *options, const struct slot *slot) {
  const int64_t family = slot - options->slot;
  for (int64_t k = family + 1; k < options->slot_count && options->slot[k].family >= family; k++)
    clear(&options->slot[k]);
}

/* Takes ownership of `value`, and makes the enclosing families present. A number in place of a family, and
 * the reverse: the last one counts. */
static void put(hooke_options *options, struct slot *slot, const struct hk_option_value *value) {
  clear(slot);
  if (slot->row->type != HOOKE_OPTION_FAMILY && slot->row->family) clear_members(options, slot);
  slot->value = *value;
  slot->is_set = 1;
  for (int64_t family = slot->family; family >= 0; family = options->slot[family].family) {
    hk_option_value_clear(&options->slot[family].value);
    options->slot[family].is_set = 1;
  }
}

/* Copies the values that are set among `count` slots from `of` on. */
static int32_t copy_slots(hooke_options *options, struct slot *to, const struct slot *of, int64_t count) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < count && status == HOOKE_OK; k++) {
    struct hk_option_value value;
    if (!of[k].is_set) continue;
    status = hk_option_value_copy(&of[k].value, &value);
    if (status == HOOKE_OK) put(options, &to[k], &value);
  }
  return status;
}

int32_t hk_options_set_from(hooke_options *options, const hooke_options *from) {
  return copy_slots(options, options->slot, from->slot, from->slot_count);
}

int32_t hk_options_set_value(hooke_options *options, const char *name, const hooke_options *from,
                             const char *named) {
  struct slot *to = find_slot(options, name);
  const int64_t members = to->row->family ? count_rows(to->row->family) : 0;
  return copy_slots(options, to, find_slot(from, named), 1 + members);
}

int32_t hooke_options_copy(const hooke_options *options, hooke_options **copy) {
  int32_t status = hk_options_create(options->table, copy);
  if (status == HOOKE_OK) status = hk_options_set_from(*copy, options);
  if (status) {
    hooke_options_destroy(*copy);
    *copy = NULL;
  }
  return status;
}

int32_t hk_options_set_in_unit(hooke_options *options, const char *name, int64_t count, const double *values,
                               const char *unit) {
  struct slot *slot;
  if (require_slot(options, name, &slot)) return HOOKE_BAD_VALUE;
  if (count < 0 || (count > 0 && values == NULL))
    return hk_fail(HOOKE_BAD_VALUE, name, "no numbers given (count %lld)", (long long)count);
  struct hk_option_value value;
  int32_t status = hk_option_value_from_numbers(slot->row, slot->name, count, values, &value);
  value.unit = unit;
  if (status == HOOKE_OK) put(options, slot, &value);
  return status;
}

int32_t hooke_options_set_numbers(hooke_options *options, const char *name, int64_t count,
                                  const double *values) {
  return hk_options_set_in_unit(options, name, count, values, NULL);
}

int32_t hooke_options_set_number(hooke_options *options, const char *name, double value) {
  return hooke_options_set_numbers(options, name, 1, &value);
}

int32_t hooke_options_set_text(hooke_options *options, const char *name, const char *text) {
  struct slot *slot;
  if (require_slot(options, name, &slot)) return HOOKE_BAD_VALUE;
  if (text == NULL) return hk_fail(HOOKE_BAD_VALUE, name, "no text given");
  struct hk_option_value value;
  int32_t status = hk_option_value_from_text(slot->row, slot->name, text, &value);
  if (status == HOOKE_OK) put(options, slot, &value);
  return status;
}

int32_t hk_options_add_word(hooke_options *options, const char *name, const char *word) {
  struct slot *slot;
  if (require_slot(options, name, &slot)) return HOOKE_BAD_VALUE;
  size_t length = strlen(word);
  if (!slot->row->word_lists || !hk_option_has_word(slot->row->words, word, (int64_t)length)) {
    char shown[HOOKE_OPTION_SHOWN], allowed[HOOKE_OPTION_ALLOWED];
    hk_option_show(word, (int64_t)length, shown);
    return hk_fail(HOOKE_BAD_VALUE, slot->name, "\"%s\" is not allowed; allowed: %s", shown,
                   hk_option_allowed(slot->row, allowed));
  }
  size_t used = slot->value.words ? strlen(slot->value.words) : 0;
  char *words = hk_new((int64_t)(used + length + 2), 1);
  if (words == NULL) return HOOKE_NO_MEMORY;
  if (used) {
    memcpy(words, slot->value.words, used);
    words[used++] = ' ';
  }
  memcpy(words + used, word, length);
  struct hk_option_value value = slot->value;
  hk_free(value.words);
  value.words = words;
  memset(&slot->value, 0, sizeof slot->value);
  put(options, slot, &value);
  return HOOKE_OK;
}

int32_t hooke_options_unset(hooke_options *options, const char *name) {
  struct slot *slot;
  if (require_slot(options, name, &slot)) return HOOKE_BAD_VALUE;
  clear(slot);
  clear_members(options, slot);
  return HOOKE_OK;
}

int32_t hooke_options_is_set(const hooke_options *options, const char *name) {
  const struct slot *slot = find_slot(options, name);
  return slot ? slot->is_set : 0;
}

static int32_t is_family(const struct slot *slot) {
  return slot->row->family && slot->is_set && slot->value.count == 0;
}

int32_t hk_options_has_family(const hooke_options *options, const char *name) {
  const struct slot *slot = find_slot(options, name);
  return slot && is_family(slot);
}

static const struct hk_option_value *value_of(const hooke_options *options, const char *name) {
  static const struct hk_option_value nothing;
  const struct slot *slot = find_slot(options, name);
  if (slot == NULL) return &nothing;
  return slot->is_set ? &slot->value : &slot->fallback;
}

int64_t hooke_options_number_count(const hooke_options *options, const char *name) {
  return value_of(options, name)->count;
}

const double *hooke_options_numbers(const hooke_options *options, const char *name) {
  return hk_option_value_numbers(value_of(options, name));
}

double hooke_options_number(const hooke_options *options, const char *name) {
  const struct hk_option_value *value = value_of(options, name);
  return value->count ? value->one : NAN;
}

const char *hooke_options_text(const hooke_options *options, const char *name) {
  const char *words = value_of(options, name)->words;
  return words ? words : "";
}

const char *hk_options_unit_given(const hooke_options *options, const char *name) {
  return value_of(options, name)->unit;
}

/* The choice that an option belongs to: in its table or family, by name or the first. */
static const struct slot *choice_of(const hooke_options *options, const struct slot *slot) {
  const struct slot *choice = &options->slot[slot->family + 1];
  while (slot->row->by && (choice->family != slot->family || strcmp(choice->row->name, slot->row->by) != 0))
    choice++;
  return choice;
}

static const char *chosen_for(const hooke_options *options, const struct slot *slot) {
  return hooke_options_text(options, choice_of(options, slot)->name);
}

static int belongs(const hooke_options *options, const struct slot *slot) {
  if (slot->row->only == NULL) return 1;
  const char *chosen = chosen_for(options, slot);
  return hk_option_has_word(slot->row->only, chosen, (int64_t)strlen(chosen));
}

static int32_t refuse_elsewhere(const hooke_options *options, const struct slot *slot) {
  const struct slot *choice = choice_of(options, slot);
  const char *chosen = chosen_for(options, slot);
  if (chosen[0] == '\0')
    return hk_fail(HOOKE_BAD_VALUE, slot->name, "belongs to %s \"%s\", which is missing", choice->row->name,
                   slot->row->only);
  char list[TEXT_SIZE] = "";
  for (int64_t k = 0; k < options->slot_count; k++) {
    const struct slot *other = &options->slot[k];
    const int alike = other->family == slot->family && other->row->only;
    if (alike && choice_of(options, other) == choice && belongs(options, other))
      hk_append(list, sizeof list, "%s%s", list[0] ? ", " : "", other->row->name);
  }
  return hk_fail(HOOKE_BAD_VALUE, slot->name, "belongs to %s \"%s\"; allowed with \"%s\": %s",
                 choice->row->name, slot->row->only, chosen, list[0] ? list : "nothing more");
}

int32_t hk_options_check_required(const hooke_options *options) {
  for (int64_t k = 0; k < options->slot_count; k++) {
    const struct slot *slot = &options->slot[k];
    char with[NAME_SIZE] = "";
    if (!belongs(options, slot)) {
      if (slot->is_set) return refuse_elsewhere(options, slot);
      continue;
    }
    if (slot->row->only)
      hk_print(with, sizeof with, " with %s \"%s\"", choice_of(options, slot)->row->name,
               chosen_for(options, slot));
    if (!slot->row->required || slot->is_set || slot->row->fallback) continue;
    if (slot->family >= 0 && !is_family(&options->slot[slot->family])) continue;
    char allowed[HOOKE_OPTION_ALLOWED];
    return hk_fail(HOOKE_BAD_VALUE, slot->name, "is required%s but missing; allowed: %s", with,
                   hk_option_allowed(slot->row, allowed));
  }
  return HOOKE_OK;
}

int64_t hooke_options_row_count(const hooke_options *options) {
  return options->slot_count;
}

/* Allowed values, or units, of a slot, in words. They are rarely needed, so the text is made on first use. */
static const char *words_of(const struct hk_option_row *row, char **words, int32_t of_units) {
  char text[TEXT_SIZE];
  if (*words) return *words;
  if (of_units)
    hk_unit_list(row->unit, text, sizeof text);
  else
    hk_option_describe(row, text, sizeof text);
  return *words = hk_copy_text(text);
}

const char *hooke_options_row(const hooke_options *options, int64_t row, const char *property) {
  if (row < 0 || row >= options->slot_count || property == NULL) return NULL;
  struct slot *slot = &options->slot[row];
  const struct hk_option_row *of = slot->row;
  static const char *const type[] = {"number", "numbers", "flag", "choice", "text", "family"};
  if (strcmp(property, "allowed") == 0) return words_of(of, &slot->allowed, 0);
  if (strcmp(property, "units") == 0) return words_of(of, &slot->units, 1);
  const struct {
    const char *name, *text;
  } known[] = {
      {"name", slot->name},     {"type", type[of->type]},
      {"unit", of->unit},       {"default", of->fallback},
      {"doc", of->doc},         {"words", of->words},
      {"only", of->only},       {"family", slot->family >= 0 ? options->slot[slot->family].name : NULL},
      {"example", of->example}, {"by", of->by},
  };
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
    if (strcmp(known[k].name, property) == 0) return known[k].text ? known[k].text : "";
  return NULL;
}

double hooke_options_row_number(const hooke_options *options, int64_t row, const char *property) {
  if (row < 0 || row >= options->slot_count || property == NULL) return NAN;
  const struct hk_option_row *of = options->slot[row].row;
  const int bounded = of->low < of->high, counted = of->type == HOOKE_OPTION_NUMBERS;
  const struct {
    const char *name;
    double value;
  } known[] = {
      {"low", bounded ? of->low : NAN},
      {"high", bounded ? of->high : NAN},
      {"above_low", of->above_low},
      {"whole", of->whole},
      {"required", of->required},
      {"min_count", counted && of->min_count > 0 ? (double)of->min_count : NAN},
      {"max_count", counted && of->max_count != 0 ? (double)of->max_count : NAN},
      {"columns", of->columns > 0 ? (double)of->columns : NAN},
      {"flat", of->flat},
      {"word_lists", of->word_lists},
  };
  for (size_t k = 0; k < sizeof known / sizeof known[0]; k++)
    if (strcmp(known[k].name, property) == 0) return known[k].value;
  return NAN;
}
