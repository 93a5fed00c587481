#include "measure/naming.h"

#include <stdio.h>

const char *hooke_naming_group(const hooke_system *system, int64_t spring) {
  int64_t end = 0;
  for (int64_t g = 0; g < system->group_count; g++) {
    end += system->group[g].count;
    if (spring < end) return system->group[g].name ? system->group[g].name : "";
  }
  return "";
}

struct hooke_spring hooke_naming_spring(const hooke_system *system, int64_t spring) {
  int64_t low = 0, high = system->springs.run_count - 1;
  while (low < high) {
    const int64_t middle = low + (high - low + 1) / 2;
    if (system->springs.run[middle].first <= spring)
      low = middle;
    else
      high = middle - 1;
  }
  const struct hooke_run *run = &system->springs.run[low];
  return hooke_run_spring(run, spring - run->first);
}

const char *hooke_naming_words(const hooke_system *system, int64_t spring, char text[HOOKE_NAMING_SIZE]) {
  const struct hooke_spring found = hooke_naming_spring(system, spring);
  const char *group = hooke_naming_group(system, spring);
  snprintf(text, HOOKE_NAMING_SIZE, "spring %lld (particles %lld and %lld%s%.80s)", (long long)spring,
           (long long)found.head, (long long)found.tail, group[0] ? ", group " : "", group);
  return text;
}

int64_t hooke_naming_heaviest(const hooke_system *system, int64_t particle, double h) {
  double most = -1.0;
  int64_t found = -1;
  for (int64_t r = 0; r < system->springs.run_count; r++) {
    const struct hooke_run *run = &system->springs.run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hooke_spring spring = hooke_run_spring(run, k);
      if (spring.head != particle && spring.tail != particle) continue;
      const double weight = h * h * spring.kappa + 2.0 * h * spring.gamma;
      if (!(weight > most)) continue;
      most = weight;
      found = run->first + k;
    }
  }
  return found;
}
