/* Options, parts and groups in words as "size=6,6 mass=0.1", values without spaces, in which printf() puts the rest
 * (options_with() of small.h). */
#ifndef TESTS_SUPPORT_WORDS_H
#define TESTS_SUPPORT_WORDS_H

#include "hooke.h"

/* Sets the options, which are no format; the status of the first that is refused. */
int32_t try_words(hooke_options *options, const char *words);

/* Adds a part to a system, NULL for a new one, and returns that. */
__attribute__((format(printf, 4, 5))) hooke_system *small_part(hooke_system *system, const char *kind,
                                                               const char *name, const char *words, ...);
/* Adds a group of "springs", "altitude" springs or "anchors". */
__attribute__((format(printf, 6, 7))) void small_group(hooke_system *system, const char *kind,
                                                       const char *name, int64_t count,
                                                       const int64_t *members, const char *words, ...);
/* Commits a system that falls at 9.81 m/s^2 along -y, and returns it. */
hooke_system *small_falling(hooke_system *system);

#endif
