/* The grammar of watched quantities. */
#include "measure/quantity/watched.h"

#include "core/memory.h"
#include "core/status.h"
#include "measure/spectrum/naming.h"
#include "model/force/drive.h"
#include "model/part_record.h"
#include "model/system.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { NAMES_SIZE = 256, TEXT_SIZE = 512 };

/* Parser state: for messages the option and the original text. */
struct reading {
  const hooke_system *system;
  const char *where, *whole;
};

/* ---- words ---- */

static const struct hk_watched_word words[] = {
    {"x", "m", HOOKE_WATCHED_PARTICLE, HOOKE_WATCHED_COORDINATE, 0},
    {"y", "m", HOOKE_WATCHED_PARTICLE, HOOKE_WATCHED_COORDINATE, 1},
    {"z", "m", HOOKE_WATCHED_PARTICLE, HOOKE_WATCHED_COORDINATE, 2},
    {"reaction", "N", HOOKE_WATCHED_SUPPORT, HOOKE_WATCHED_REACTION, -1},
    {"reaction_x", "N", HOOKE_WATCHED_SUPPORT, HOOKE_WATCHED_REACTION, 0},
    {"reaction_y", "N", HOOKE_WATCHED_SUPPORT, HOOKE_WATCHED_REACTION, 1},
    {"reaction_z", "N", HOOKE_WATCHED_SUPPORT, HOOKE_WATCHED_REACTION, 2},
    {"length", "m", HOOKE_WATCHED_SPRING, HOOKE_WATCHED_LENGTH, -1},
    {"strain", "", HOOKE_WATCHED_SPRING, HOOKE_WATCHED_STRAIN, -1},
    {"tension", "N", HOOKE_WATCHED_SPRING, HOOKE_WATCHED_TENSION, -1},
    {"energy", "J", HOOKE_WATCHED_SCENE, HOOKE_WATCHED_ENERGY, -1},
    {"kinetic", "J", HOOKE_WATCHED_SCENE, HOOKE_WATCHED_KINETIC, -1},
    {"potential", "J", HOOKE_WATCHED_SCENE, HOOKE_WATCHED_POTENTIAL, -1},
};
enum { WORDS = sizeof words / sizeof words[0] };

int32_t hk_watched_is_of_scene(const char *text) {
  int k = 0;
  while (k < WORDS && (words[k].of != HOOKE_WATCHED_SCENE || strcmp(words[k].word, text) != 0))
    k++;
  return k < WORDS;
}

/* How messages name what a word is of. */
static const struct holder {
  const char *before, *after;
} holders[HOOKE_WATCHED_HOLDERS] = {
    [HOOKE_WATCHED_PARTICLE] = {"0.", " (a particle, or its name, or part:0)"},
    [HOOKE_WATCHED_SUPPORT] = {"0.", " (the support of a pinned or driven particle)"},
    [HOOKE_WATCHED_SPRING] = {"group:0.", " (a spring; over the group: group:max or group:min)"},
    [HOOKE_WATCHED_SCENE] = {"", ""},
};

/* NULL if there is none, of the scene or of anything else. */
static const struct hk_watched_word *find_word(const char *text, int32_t of_scene) {
  for (int k = 0; k < WORDS; k++)
    if ((words[k].of == HOOKE_WATCHED_SCENE) == of_scene && strcmp(text, words[k].word) == 0)
      return &words[k];
  return NULL;
}

/* ---- names ---- */

static const char *part_name(const hooke_system *system, int64_t part) {
  return part < system->part_count ? system->part[part].name : NULL;
}

static const char *group_name(const hooke_system *system, int64_t group) {
  if (group >= hk_system_groups_of(system, &hk_force_springs)) return NULL;
  return system->group[group].name ? system->group[group].name : "";
}

static const char *particle_name(const hooke_system *system, int64_t number) {
  return number < system->rest->name_count ? system->rest->name[number].text : NULL;
}

typedef const char *name_of(const hooke_system *system, int64_t number);

/* Appends the names to a text, each once, as far as there is space. */
static void list_names(const hooke_system *system, name_of *name, char text[NAMES_SIZE]) {
  for (int64_t k = 0; name(system, k); k++) {
    const size_t used = strlen(text), length = strlen(name(system, k));
    int64_t first = 0;
    while (strcmp(name(system, first), name(system, k)) != 0)
      first++;
    if (length == 0 || first < k) continue;
    if (used + length + sizeof ", ..." > NAMES_SIZE) {
      snprintf(text + used, NAMES_SIZE - used, ", ...");
      return;
    }
    snprintf(text + used, NAMES_SIZE - used, "%s%s", used ? ", " : "", name(system, k));
  }
}

/* The part of that name; NULL if there is none. */
static const struct hk_part_record *find_part(const hooke_system *system, const char *name) {
  for (int64_t k = 0; k < system->part_count; k++)
    if (strcmp(system->part[k].name, name) == 0) return &system->part[k];
  return NULL;
}

/* ---- numbers ---- */

/* The number that `text` begins with, and its end; -1 for none, or one past 64 bits. */
static int64_t read_number(const char *text, const char **end) {
  int64_t number = 0;
  const char *at = text;
  for (; *at >= '0' && *at <= '9'; at++) {
    if (number > (INT64_MAX - 9) / 10) return -1;
    number = 10 * number + (*at - '0');
  }
  *end = at;
  return at > text ? number : -1;
}

/* The index of "name:index", with the text truncated after the name; -1 if there is none. */
static int64_t cut_index(char *text) {
  char *colon = strrchr(text, ':');
  const char *end;
  if (colon == NULL) return -1;
  const int64_t index = read_number(colon + 1, &end);
  if (index < 0 || *end) return -1;
  *colon = '\0';
  return index;
}

/* ---- failures ---- */

static int32_t refuse(const struct reading *reading) {
  char shown[HOOKE_OPTION_SHOWN], allowed[TEXT_SIZE] = "";
  hk_option_show(reading->whole, (int64_t)strlen(reading->whole), shown);
  for (int k = 0; k < WORDS; k++) {
    const int first = k == 0 || words[k - 1].of != words[k].of;
    const int last = k + 1 == WORDS || words[k + 1].of != words[k].of;
    const struct holder *of = &holders[words[k].of];
    const size_t used = strlen(allowed);
    snprintf(allowed + used, sizeof allowed - used, "%s%s%s%s%s", k > 0 ? ", " : "", first ? of->before : "",
             first || of->before[0] == '\0' ? "" : ".", words[k].word, last ? of->after : "");
  }
  return hk_fail(HOOKE_BAD_VALUE, reading->where,
                 "\"%s\" is nothing to watch; allowed: %s, and period:0.y (of any of these); "
                 "indices begin at 0",
                 shown, allowed);
}

/* With what is wrong, and what is allowed. */
static int32_t refuse_that(const struct reading *reading, const char *why, const char *allowed) {
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(reading->whole, (int64_t)strlen(reading->whole), shown);
  return hk_fail(HOOKE_BAD_VALUE, reading->where, "\"%s\": %s; allowed: %s", shown, why, allowed);
}

static int32_t refuse_name(const struct reading *reading, const char *what, name_of *name) {
  char shown[HOOKE_OPTION_SHOWN], known[NAMES_SIZE] = "";
  hk_option_show(reading->whole, (int64_t)strlen(reading->whole), shown);
  list_names(reading->system, name, known);
  return hk_fail(HOOKE_BAD_VALUE, reading->where, "\"%s\": there is no %s of that name; allowed: %s", shown,
                 what, known[0] ? known : "none, since the scene names none");
}

static int32_t refuse_index(const struct reading *reading, const char *of, const char *what, int64_t count) {
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(reading->whole, (int64_t)strlen(reading->whole), shown);
  if (count == 0) {
    return hk_fail(HOOKE_BAD_VALUE, reading->where, "\"%s\": %.80s has no %ss", shown, of, what);
  }
  return hk_fail(HOOKE_BAD_VALUE, reading->where, "\"%s\": %.80s has the %ss 0 to %lld", shown, of, what,
                 (long long)count - 1);
}

/* ---- one quantity ---- */

/* "57", "tip" or "line:0" */
static int32_t read_particle(const struct reading *reading, char *text, struct hk_watched *watched) {
  const hooke_system *system = reading->system;
  const char *end;
  const int64_t number = read_number(text, &end);
  watched->particle = number;
  if (number >= 0 && *end == '\0') {
    if (number < system->particle_count) return HOOKE_OK;
    return refuse_index(reading, "the scene", "particle", system->particle_count);
  }
  const int64_t index = cut_index(text);
  watched->particle = hooke_system_named_particle(system, text);
  if (index < 0 && watched->particle >= 0) return HOOKE_OK;
  if (index < 0 && number < 0 && particle_name(system, 0))
    return refuse_name(reading, "particle", particle_name);
  if (index < 0) return refuse(reading);
  const struct hk_part_record *part = find_part(system, text);
  if (part == NULL) return refuse_name(reading, "part", part_name);
  if (index >= part->count) return refuse_index(reading, text, "particle", part->count);
  watched->particle = part->first + index;
  return HOOKE_OK;
}

/* Refuses groups with dropped springs: their indices are not those that the user knows. */
static int32_t refuse_gaps(const struct reading *reading, const struct hk_group *group) {
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(reading->whole, (int64_t)strlen(reading->whole), shown);
  return hk_fail(HOOKE_BAD_VALUE, reading->where,
                 "\"%s\": %lld springs of %.80s have neither stiffness nor damping and "
                 "are left out, so the others have no index; give those another group",
                 shown, (long long)group->dropped, group->name);
}

static int32_t refuse_strain(const struct reading *reading) {
  return refuse_that(reading, "a spring of rest length 0 has no strain", "length, tension");
}

static double rest_length(const hooke_system *system, int64_t spring) {
  return hk_springs_find(system->springs, spring, HOOKE_AS_GIVEN).rest_length;
}

/* "line.stretch:max"; 1 if it ends like this, with the text truncated after the name. */
static int cut_extreme(char *text, int32_t *smallest) {
  char *colon = strrchr(text, ':');
  if (colon == NULL) return 0;
  *smallest = strcmp(colon, ":min") == 0;
  if (!*smallest && strcmp(colon, ":max") != 0) return 0;
  *colon = '\0';
  return 1;
}

static int32_t check_extreme(const struct reading *reading, const char *name, struct hk_watched *watched) {
  const hooke_system *system = reading->system;
  int64_t count = 0, known = 0, unstrained = 0;
  for (int64_t g = 0, first = 0; g < hk_system_groups_of(system, &hk_force_springs);
       first += system->group[g++].count) {
    if (name[0] == '\0' || strcmp(group_name(system, g), name) != 0) continue;
    watched->group = system->group[g].name;
    known = 1;
    for (int64_t k = first; k < first + system->group[g].count; k++, count++)
      unstrained += rest_length(system, k) == 0.0;
  }
  if (!known) return refuse_name(reading, "group of springs", group_name);
  if (count == 0) return refuse_index(reading, name, "spring", 0);
  return watched->what->kind == HOOKE_WATCHED_STRAIN && unstrained ? refuse_strain(reading) : HOOKE_OK;
}

/* "line.stretch:3"; groups that share a name are counted as one. */
static int32_t read_spring(const struct reading *reading, char *text, struct hk_watched *watched) {
  const hooke_system *system = reading->system;
  if (cut_extreme(text, &watched->smallest)) return check_extreme(reading, text, watched);
  int64_t index = cut_index(text), first = 0, count = 0, known = 0;
  if (index < 0) return refuse(reading);
  const int64_t asked = index;
  for (int64_t g = 0; g < hk_system_groups_of(system, &hk_force_springs); first += system->group[g++].count) {
    const struct hk_group *group = &system->group[g];
    if (text[0] == '\0' || strcmp(group_name(system, g), text) != 0) continue;
    if (group->dropped > 0 && group->count > 0) return refuse_gaps(reading, group);
    known = 1;
    count += group->count;
    if (index >= 0 && index < group->count) watched->spring = first + index;
    index -= group->count;
  }
  if (!known) return refuse_name(reading, "group of springs", group_name);
  if (asked >= count) return refuse_index(reading, text, "spring", count);
  const int strained =
      watched->what->kind != HOOKE_WATCHED_STRAIN || rest_length(system, watched->spring) > 0.0;
  return strained ? HOOKE_OK : refuse_strain(reading);
}

static const struct hk_drive_group *find_drive(const hooke_system *system, int64_t particle) {
  for (int64_t d = 0; d < system->drive_count; d++)
    for (int64_t k = 0; k < system->drive[d].count; k++)
      if (system->drive[d].particle[k] == particle) return &system->drive[d];
  return NULL;
}

static int32_t read_support(const struct reading *reading, char *text, struct hk_watched *watched) {
  const hooke_system *system = reading->system;
  const int32_t status = read_particle(reading, text, watched);
  if (status != HOOKE_OK) return status;
  const int64_t p = watched->particle;
  if (!system->constrained[p]) {
    char held[NAMES_SIZE] = "none, since the scene holds none";
    if (system->constrained_count > 0)
      snprintf(held, sizeof held, "a pinned or driven one, such as %d", (int)system->constrained_particle[0]);
    return refuse_that(reading, "the particle is free, and nothing supports it", held);
  }
  if (system->bodies->count > 0 && system->bodies->of[p] >= 0)
    return refuse_that(reading, "the particle is part of a rigid body, whose inner forces are not known",
                       "particles of no body");
  const struct hk_drive_group *drive = find_drive(system, p);
  if (drive && drive->callback && !system->overdamped)
    return refuse_that(reading, "the particle is driven by a callback, whose acceleration is not known",
                       "particles that are pinned, or driven by a sine or a table");
  watched->course = drive && !system->overdamped ? &drive->course : NULL;
  return HOOKE_OK;
}

/* `text` is modified. */
static int32_t read_quantity(const struct reading *reading, char *text, struct hk_watched *watched) {
  static int32_t (*const read[])(const struct reading *, char *,
                                 struct hk_watched *) = {read_particle, read_support, read_spring};
  static const char period[] = "period:";
  if (strncmp(text, period, sizeof period - 1) == 0) {
    watched->is_period = 1;
    text += sizeof period - 1;
    if (strncmp(text, period, sizeof period - 1) == 0) return refuse(reading);
  }
  watched->what = find_word(text, 1);
  if (watched->what) return HOOKE_OK;
  char *dot = strrchr(text, '.');
  watched->what = dot ? find_word(dot + 1, 0) : NULL;
  if (watched->what == NULL) return refuse(reading);
  *dot = '\0';
  return read[watched->what->of](reading, text, watched);
}

/* ---- lists ---- */

int64_t hk_watched_find(const struct hk_watched_list *list, const char *text) {
  for (int64_t k = 0; k < list->count; k++) {
    if (strcmp(list->item[k].text, text) == 0) return k;
  }
  return -1;
}

static int32_t add(struct hk_watched_list *list, const char *where, const char *text) {
  const struct reading reading = {list->system, where, text};
  struct hk_watched watched = {.particle = -1};
  if (hk_watched_find(list, text) >= 0) return HOOKE_OK;
  char *pieces = hk_copy_text(text);
  watched.text = hk_copy_text(text);
  int32_t status = pieces && watched.text ? HOOKE_OK : HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = read_quantity(&reading, pieces, &watched);
  if (status == HOOKE_OK)
    status = hk_grow((void **)&list->item, list->count, list->count + 1, sizeof watched);
  hk_free(pieces);
  if (status == HOOKE_OK)
    list->item[list->count++] = watched;
  else
    hk_free(watched.text);
  return status;
}

int32_t hk_watched_read(struct hk_watched_list *list, const char *where, const char *text) {
  const int64_t had = list->count;
  int32_t status = HOOKE_OK;
  for (const char *at = text; status == HOOKE_OK && at;) {
    const char *comma = strchr(at, ',');
    at += strspn(at, " ");
    size_t length = comma > at ? (size_t)(comma - at) : comma ? 0 : strlen(at);
    while (length > 0 && at[length - 1] == ' ')
      length--;
    char one[TEXT_SIZE];
    const struct reading reading = {list->system, where, at};
    if (length < sizeof one) {
      memcpy(one, at, length);
      one[length] = '\0';
      status = add(list, where, one);
    } else {
      status = refuse(&reading);
    }
    at = comma ? comma + 1 : NULL;
  }
  while (status != HOOKE_OK && list->count > had)
    hk_free(list->item[--list->count].text);
  return status;
}

int32_t hk_watched_read_over_time(struct hk_watched_list *list, const char *where, const char *text) {
  const int32_t status = hk_watched_read(list, where, text);
  for (int64_t k = 0; status == HOOKE_OK && k < list->count; k++) {
    const char *one = list->item[k].text;
    if (list->item[k].is_period)
      return hk_fail(HOOKE_BAD_VALUE, where, "%.80s is one number of a whole run; over time there is %.80s",
                     one, strchr(one, ':') + 1);
  }
  return status;
}

void hk_watched_release(struct hk_watched_list *list) {
  for (int64_t k = 0; k < list->count; k++)
    hk_free(list->item[k].text);
  hk_free(list->item);
  memset(list, 0, sizeof *list);
}

/* ---- particles only ---- */

/* The particle whose name comes next, and its end; -1 for none. */
static int64_t read_name(const hooke_system *system, const char *text, const char **end) {
  char name[TEXT_SIZE];
  const size_t length = strcspn(text, ",");
  snprintf(name, sizeof name, "%.*s", (int)length, text);
  const int64_t particle = length < sizeof name ? hooke_system_named_particle(system, name) : -1;
  if (particle >= 0) *end = text + length;
  return particle;
}

/* Marks the particles of "0,7-9,tip"; -1 if it is no such list. */
static int mark_list(const hooke_system *system, const char *text, uint8_t *mark) {
  while (*text) {
    const int64_t named = read_name(system, text, &text);
    const int64_t first = named < 0 ? read_number(text, &text) : named;
    const int64_t last = first >= 0 && *text == '-' ? read_number(text + 1, &text) : first;
    if (first < 0 || last < first || last >= system->particle_count) return -1;
    memset(mark + first, 1, (size_t)(last - first + 1));
    if (*text != ',' && *text != '\0') return -1;
    if (*text == ',' && text[1] == '\0') return -1;
    text += *text == ',';
  }
  return 0;
}

static int mark_group(const hooke_system *system, const char *text, uint8_t *mark) {
  int found = -1;
  int64_t first = 0;
  for (int64_t g = 0; g < hk_system_groups_of(system, &hk_force_springs); first += system->group[g++].count) {
    if (strcmp(group_name(system, g), text) != 0) continue;
    found = 0;
    for (int64_t k = 0; k < system->group[g].count; k++) {
      const struct hk_spring spring = hk_springs_find(system->springs, first + k, HOOKE_AS_GIVEN);
      mark[spring.head] = mark[spring.tail] = 1;
    }
  }
  return found;
}

int32_t hk_watched_mark_particles(const hooke_system *system, const char *where, const char *text,
                                  uint8_t *mark) {
  char known[NAMES_SIZE] = "";
  const struct hk_part_record *part = find_part(system, text);
  if (part) memset(mark + part->first, 1, (size_t)part->count);
  if (part || mark_group(system, text, mark) == 0) return HOOKE_OK;
  if (mark_list(system, text, mark) == 0) return HOOKE_OK;
  list_names(system, part_name, known);
  list_names(system, group_name, known);
  list_names(system, particle_name, known);
  return hk_fail(HOOKE_BAD_VALUE, where,
                 "\"%.60s\" is no part, group or list of particles; "
                 "allowed: %s%s particle numbers such as 0,7-9 (0 to %lld)",
                 text, known, known[0] ? ", or" : "", (long long)system->particle_count - 1);
}
