/* Which particles are watched. */
#include "measure/needs.h"

#include "core/memory.h"
#include "core/status.h"
#include "measure/naming.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int32_t refuse(const hooke_needs *needs, const char *text) {
  char known[256] = "";
  for (int64_t k = 0; k < needs->system->part_count + needs->system->group_count; k++) {
    const int64_t group = k - needs->system->part_count;
    const char *name = group < 0 ? needs->system->part[k].name : needs->system->group[group].name;
    const size_t used = strlen(known);
    if (name[0]) snprintf(known + used, sizeof known - used, "%s%s", used ? ", " : "", name);
  }
  return hooke_fail(
      HOOKE_BAD_VALUE, "watch",
      "\"%.60s\" is no part, group or list of particles; allowed: %s%s particle numbers such as "
      "0,7-9 (0 to %lld)",
      text, known, known[0] ? ", or" : "", (long long)needs->system->particle_count - 1);
}

/* The numbers of "0,7-9" as marks; -1 for what is no such list. */
static int mark_numbers(const char *text, int64_t count, uint8_t *mark) {
  while (*text) {
    char *end;
    if (*text < '0' || *text > '9') return -1;
    const long long first = strtoll(text, &end, 10);
    long long last = first;
    if (*end == '-') {
      if (end[1] < '0' || end[1] > '9') return -1;
      last = strtoll(end + 1, &end, 10);
    }
    if (last < first || last >= count) return -1;
    memset(mark + first, 1, (size_t)(last - first + 1));
    if (*end != ',' && *end != '\0') return -1;
    if (*end == ',' && end[1] == '\0') return -1;
    text = *end ? end + 1 : end;
  }
  return 0;
}

static int mark_part(const hooke_system *system, const char *text, uint8_t *mark) {
  for (int64_t k = 0; k < system->part_count; k++) {
    if (strcmp(system->part[k].name, text) != 0) continue;
    memset(mark + system->part[k].first, 1, (size_t)system->part[k].count);
    return 0;
  }
  return -1;
}

static int mark_group(const hooke_system *system, const char *text, uint8_t *mark) {
  int found = -1;
  int64_t first = 0;
  for (int64_t g = 0; g < system->group_count; first += system->group[g++].count) {
    if (strcmp(system->group[g].name, text) != 0) continue;
    found = 0;
    for (int64_t k = 0; k < system->group[g].count; k++) {
      const struct hooke_spring spring = hooke_naming_spring(system, first + k);
      mark[spring.head] = mark[spring.tail] = 1;
    }
  }
  return found;
}

int32_t hooke_needs_read_watch(hooke_needs *needs) {
  const hooke_system *system = needs->system;
  const char *text = hooke_options_text(needs->options, "watch");
  uint8_t *mark = hooke_new(system->particle_count, 1);
  if (mark == NULL) return HOOKE_NO_MEMORY;
  int32_t status = HOOKE_OK;
  if (text[0] == '\0') {
    for (int64_t p = 0; p < system->particle_count; p++)
      mark[p] = system->held[p] == 0;
  } else if (mark_part(system, text, mark) && mark_group(system, text, mark) &&
             mark_numbers(text, system->particle_count, mark)) {
    status = refuse(needs, text);
  }
  for (int64_t p = 0; p < system->particle_count; p++)
    needs->watch_count += mark[p];
  needs->watch = hooke_new(needs->watch_count, sizeof *needs->watch);
  if (status == HOOKE_OK && needs->watch == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && needs->watch_count == 0) {
    status = hooke_fail(HOOKE_BAD_VALUE, "watch",
                        "no particle of the scene is free, so there is nothing to watch");
  }
  int64_t at = 0;
  for (int64_t p = 0; p < system->particle_count && status == HOOKE_OK; p++) {
    if (mark[p]) needs->watch[at++] = p;
  }
  hooke_free(mark);
  return status;
}
