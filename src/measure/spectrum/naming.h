/* Springs and particles in words: "spring 12 (particles 3 and 7, group hem)". */
#ifndef HOOKE_MEASURE_SPECTRUM_NAMING_H
#define HOOKE_MEASURE_SPECTRUM_NAMING_H

#include "model/system.h"

/* Name of the group or part that a spring is of, "" if it has none. */
const char *hk_naming_group(const hooke_system *system, int64_t spring);

/* The spring of that number, whatever run it is in. */
struct hk_spring hk_naming_spring(const hooke_system *system, int64_t spring);

/* Writes the words into `text` and returns it. */
enum { HOOKE_NAMING_SIZE = 160 };
const char *hk_naming_words(const hooke_system *system, int64_t spring, char text[HOOKE_NAMING_SIZE]);

/* The spring, the bending or the altitude spring that weighs most on a particle in a step h, in words ("" if
 * there is none); returns the spring, -1 where it is none. */
int64_t hk_naming_heaviest_words(const hooke_system *system, int64_t particle, double h,
                                 char text[HOOKE_NAMING_SIZE]);

/* The spring that weighs most on a particle in a step h, by h^2 kappa + 2 h gamma; -1 if it has none. */
int64_t hk_naming_heaviest(const hooke_system *system, int64_t particle, double h);

#endif
