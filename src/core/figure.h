/* Numbers that are asked for by name. */
#ifndef HOOKE_CORE_FIGURE_H
#define HOOKE_CORE_FIGURE_H

#include <math.h>
#include <stddef.h>
#include <string.h>

struct hk_figure {
  const char *name;
  double value;
};

/* The value of that name among `count`, NaN where there is none. */
static inline double hk_figure_find(const struct hk_figure *figure, size_t count, const char *name) {
  for (size_t k = 0; k < count; k++) {
    if (strcmp(figure[k].name, name) == 0) return figure[k].value;
  }
  return NAN;
}

/* The same in an array. */
#define HOOKE_FIGURE(figures, name) hk_figure_find((figures), sizeof(figures) / sizeof((figures)[0]), (name))

#endif
