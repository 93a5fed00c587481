/* An entrant of a race: the library with a method and threads, or the plain loop. */
#pragma once

#include "hooke.h"

enum { MOST_TURNS = 400 };

struct entrant;

/* Returns a status; the caller destroys *entrant even if it failed. `system` must outlive it, `start` is
 * copied. */
int32_t entrant_create(const hooke_system *system, const hooke_state *start, const char *method,
                       int32_t threads, double step, struct entrant **entrant);
int32_t entrant_create_plain(const hooke_system *system, const hooke_state *start, const char *method,
                             double step, struct entrant **entrant);
void entrant_destroy(struct entrant *entrant); /* NULL is allowed */

int32_t entrant_step(struct entrant *entrant, int64_t steps);

/* Runs turns of about `seconds`; those after the warm-up are recorded, at most MOST_TURNS. Returns a status.
 */
int32_t entrant_warm_up(struct entrant *entrant, double seconds);
int32_t entrant_turn(struct entrant *entrant);

/* Over the recorded turns: their number, and the time of a step [s]. */
int32_t entrant_turns(const struct entrant *entrant);
double entrant_least(const struct entrant *entrant);
double entrant_median(const struct entrant *entrant);

const double *entrant_position(const struct entrant *entrant);

/* Force evaluations a step; NaN for a plain loop. */
double entrant_evaluations(const struct entrant *entrant);
