#include "measure/spectrum/naming.h"

#include <stdio.h>

const char *hk_naming_group(const hooke_system *system, int64_t spring) {
  int64_t end = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    end += system->group[g].count;
    if (spring < end) return system->group[g].name ? system->group[g].name : "";
  }
  return "";
}

struct hk_spring hk_naming_spring(const hooke_system *system, int64_t spring) {
  int64_t low = 0, high = system->springs.run_count - 1;
  while (low < high) {
    const int64_t middle = low + (high - low + 1) / 2;
    if (system->springs.run[middle].first <= spring)
      low = middle;
    else
      high = middle - 1;
  }
  const struct hk_run *run = &system->springs.run[low];
  return hk_run_spring(run, spring - run->first);
}

const char *hk_naming_words(const hooke_system *system, int64_t spring, char text[HOOKE_NAMING_SIZE]) {
  const struct hk_spring found = hk_naming_spring(system, spring);
  const char *group = hk_naming_group(system, spring);
  snprintf(text, HOOKE_NAMING_SIZE, "spring %lld (particles %lld and %lld%s%.80s)", (long long)spring,
           (long long)found.head, (long long)found.tail, group[0] ? ", group " : "", group);
  return text;
}

/* "the bending of particles 1, 2 and 3 (group hem)" */
static void triple_words(const hooke_system *system, int64_t number, const struct hk_triple *triple,
                         char text[HOOKE_NAMING_SIZE]) {
  const char *name = "";
  int64_t group = 0;
  while (number >= system->bending_group[group].count)
    number -= system->bending_group[group++].count;
  if (system->bending_group[group].name) name = system->bending_group[group].name;
  snprintf(text, HOOKE_NAMING_SIZE, "the bending of particles %lld, %lld and %lld%s%.80s%s",
           (long long)triple->particle[0], (long long)triple->particle[1], (long long)triple->particle[2],
           name[0] ? " (group " : "", name, name[0] ? ")" : "");
}

/* "the altitude springs of particles 1, 2, 3 and 4 (group hair.altitude)" */
static void tetrahedron_words(const hooke_system *system, int64_t number, char text[HOOKE_NAMING_SIZE]) {
  const int32_t *p = system->altitudes.tetrahedron[number].particle;
  int64_t group = 0;
  while (number >= system->altitude_group[group].count)
    number -= system->altitude_group[group++].count;
  const char *name = system->altitude_group[group].name;
  snprintf(text, HOOKE_NAMING_SIZE, "the altitude springs of particles %d, %d, %d and %d%s%.60s%s", (int)p[0],
           (int)p[1], (int)p[2], (int)p[3], name[0] ? " (group " : "", name, name[0] ? ")" : "");
}

int64_t hk_naming_heaviest_words(const hooke_system *system, int64_t particle, double h,
                                 char text[HOOKE_NAMING_SIZE]) {
  int64_t spring = hk_naming_heaviest(system, particle, h);
  double most = 0.0;
  text[0] = '\0';
  if (spring >= 0) {
    const struct hk_spring found = hk_naming_spring(system, spring);
    most = h * h * found.kappa + 2.0 * h * found.gamma;
    hk_naming_words(system, spring, text);
  }
  struct hk_triple triple;
  struct hk_triples at = {&system->bending, 0, 0};
  for (int64_t k = 0; hk_next_triple(&at, &triple); k++) {
    for (int e = 0; e < 3; e++) {
      const double factor = hk_triple_factor(e), weight = h * h * triple.coefficient * (factor * factor);
      if (triple.particle[e] != particle || !(weight > most)) continue;
      most = weight;
      spring = -1;
      triple_words(system, k, &triple, text);
    }
  }
  for (int64_t k = 0; k < 4 * system->altitudes.count; k++) {
    const struct hk_tetrahedron *t = &system->altitudes.tetrahedron[k / 4];
    const double weight = h * h * hk_tetrahedron_kappa(t) + 2.0 * h * hk_tetrahedron_gamma(t);
    if (t->particle[k % 4] != particle || !(weight > most)) continue;
    most = weight;
    spring = -1;
    tetrahedron_words(system, k / 4, text);
  }
  return spring;
}

int64_t hk_naming_heaviest(const hooke_system *system, int64_t particle, double h) {
  double most = -1.0;
  int64_t found = -1;
  for (int64_t r = 0; r < system->springs.run_count; r++) {
    const struct hk_run *run = &system->springs.run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring(run, k);
      if (spring.head != particle && spring.tail != particle) continue;
      const double weight = h * h * spring.kappa + 2.0 * h * spring.gamma;
      if (!(weight > most)) continue;
      most = weight;
      found = run->first + k;
    }
  }
  return found;
}
