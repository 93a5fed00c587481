#include "measure/spectrum/naming.h"

#include "core/print.h"
#include "model/group.h"
#include "model/system.h"

void hk_begin_members(const hooke_system *system, double t, const double *q, const double *v,
                      struct hk_member_walk *at) {
  hk_begin_elements(system, t, q, v, &at->elements);
  at->elements.by_number = 1;
  at->force = NULL;
  at->group = -1;
  at->in_group = 0;
}

const struct hk_element *hk_next_member(struct hk_member_walk *at) {
  const struct hk_element *e = hk_next_element(&at->elements);
  if (e == NULL) return NULL;
  /* a member may have several elements, one walk over all members after the other */
  const hooke_system *system = at->elements.system;
  const struct hk_force_row *force = at->elements.force;
  const int64_t members = system->rest->member_count[hk_force_number(force)];
  const int again = force != at->force || (members > 0 && hk_element_number(&at->elements) % members == 0);
  if (again) at->group = force->members ? hk_system_first_group(system, force) : -1;
  if (again) at->in_group = 0;
  at->force = force;
  while (at->group >= 0 && at->in_group == system->group[at->group].count)
    at->group++, at->in_group = 0;
  at->in_group++;
  return e;
}

static const struct hk_group *group_of(const hooke_system *system, const struct hk_force_row *force,
                                       int64_t number) {
  int64_t g = hk_system_first_group(system, force), end = g + hk_system_groups_of(system, force);
  for (; g < end; number -= system->group[g++].count) {
    if (number < system->group[g].count) return &system->group[g];
  }
  return NULL;
}

const char *hk_naming_group(const hooke_system *system, const struct hk_force_row *force, int64_t number) {
  const struct hk_group *group = force->members ? group_of(system, force, number) : NULL;
  return group && group->name ? group->name : "";
}

/* "particles 1, 2 and 3" */
static void list_particles(const struct hk_element *e, char *text, size_t size) {
  hk_print(text, size, "particle%s ", e->count > 1 ? "s" : "");
  for (int j = 0; j < e->count; j++) {
    const char *before = j == e->count - 1 ? " and " : ", ";
    hk_append(text, size, "%s%d", j == 0 ? "" : before, (int)e->particle[j]);
  }
}

const char *hk_naming_words(const hooke_system *system, const struct hk_force_row *force, int64_t number,
                            char text[HOOKE_NAMING_SIZE]) {
  struct hk_element e;
  char particles[80];
  const char *group = hk_naming_group(system, force, number);
  force->elements(system, 0.0, system->position, NULL, number, 1, &e);
  list_particles(&e, particles, sizeof particles);
  if (force->title == NULL)
    hk_print(text, HOOKE_NAMING_SIZE, "spring %lld (%s%s%.80s)", (long long)number, particles,
             group[0] ? ", group " : "", group);
  else
    hk_print(text, HOOKE_NAMING_SIZE, "the %s of %s%s%.50s%s", force->title, particles,
             group[0] ? " (group " : "", group, group[0] ? ")" : "");
  return text;
}

/* Particle `particle` of an element; -1 if it has fewer. */
static int find_end(const struct hk_element *e, int64_t particle) {
  for (int j = 0; j < e->count; j++) {
    if (e->particle[j] == particle) return j;
  }
  return -1;
}

int64_t hk_naming_heaviest(const hooke_system *system, const struct hk_force_row *only, int64_t particle,
                           double h, const struct hk_force_row **force) {
  double most = -1.0;
  int64_t found = -1;
  struct hk_elements at;
  hk_begin_elements(system, system->moment, system->position, NULL, &at);
  at.by_number = 1;
  at.only = only;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    const int j = at.force->members ? find_end(e, particle) : -1;
    if (j < 0) continue;
    const double weight = e->weight[j] * e->weight[j] * (h * h * e->k_along + 2.0 * h * e->c_along);
    if (!(weight > most)) continue;
    most = weight;
    found = hk_element_number(&at);
    *force = at.force;
  }
  return found;
}

int64_t hk_naming_heaviest_words(const hooke_system *system, int64_t particle, double h,
                                 char text[HOOKE_NAMING_SIZE]) {
  const struct hk_force_row *force;
  const int64_t number = hk_naming_heaviest(system, NULL, particle, h, &force);
  text[0] = '\0';
  if (number < 0) return -1;
  hk_naming_words(system, force, number, text);
  return force->kind & HOOKE_LOOPED ? number : -1;
}
