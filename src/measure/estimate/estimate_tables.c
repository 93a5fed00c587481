/* The table of an estimate. */
#include "measure/estimate/estimate.h"

#include <math.h>

/* States, and frames of times, energies and positions. */
static double memory_of(const struct hk_estimate *e) {
  if (e->options == NULL) return NAN;
  const double state = 2.0 * (double)e->kept.size + 1.0, frame = (double)e->kept.size + 2.0;
  return (double)sizeof(double) * (2.0 * state + (double)e->kept.count * frame);
}

HOOKE_READER(double, met, struct hk_estimate, hk_estimate_met(it))
HOOKE_READER(double, memory_bytes, struct hk_estimate, memory_of(it))

/* ---- what is watched ---- */

HOOKE_COUNTER(count_watched, struct hk_estimate, it->course.result ? it->watched.count : 0)
HOOKE_READER(const char *, quantity, struct hk_estimate, it->watched.item[row].text)
HOOKE_READER(const char *, unit, struct hk_estimate, hk_watched_unit(&it->watched.item[row]))
HOOKE_READER(double, from, struct hk_estimate, it->course.from)
HOOKE_READER(double, until, struct hk_estimate, it->course.until)

/* ---- what is wanted ---- */

HOOKE_COUNTER(count_wants, struct hk_estimate, it->options ? it->wants.count : 0)
HOOKE_READER(const char *, wanted_quantity, struct hk_estimate, it->wants.want[row].name)
HOOKE_READER(const char *, wanted_unit, struct hk_estimate, hk_want_unit(&it->wants, (int32_t)row))
HOOKE_READER(double, bound, struct hk_estimate, it->bound[row])
HOOKE_READER(double, wanted_error, struct hk_estimate, it->error[1 + row])
HOOKE_READER(double, meets, struct hk_estimate, hk_estimate_meets(it, (int32_t)row))

/* ---- the tables ---- */

const struct hk_table hk_estimate_tables[] = {
    {.name = "estimate",
     .doc = "the error of the run",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_AS(
             struct hk_estimate, error[0], estimate, NUMBER, "m",
             "error of the run: distance of the farthest free particle, at any frame, from where it should be"),
         HOOKE_COLUMN(struct hk_estimate, rms, NUMBER, "m",
                      "its root mean square over free particles, at the worst frame"),
         HOOKE_COLUMN(
             struct hk_estimate, known_until, NUMBER, "s",
             "time up to which that holds: the end of the run or, where the motion is not predictable "
             "that long, the time until which the reference can be trusted"),
         HOOKE_COLUMN(
             struct hk_estimate, by, TEXT, "",
             "half-step, tolerance (of runs of the method at other steps or tolerances), other-method or "
             "reference; none without an estimate"),
         HOOKE_COLUMN_AS(struct hk_estimate, wants.most, wanted, NUMBER, "m", "wanted error; 1 of a list"),
         HOOKE_COLUMN_BY(met, FLAG, "", "1 if the run meets it"),
         HOOKE_COLUMN_AS(
             struct hk_estimate, rise, energy_rise, NUMBER, "",
             "spontaneous rise of energy over the last half of the run, as a fraction of the energy of the scene"),
         HOOKE_COLUMN(
             struct hk_estimate, heat_excess, NUMBER, "",
             "energy that damping and drag dissipated, at the beginning or in the last slice, beyond the "
             "energy that was available, as such a fraction and as far as it is the heat of velocities "
             "that reverse at each step; unknown with callbacks or error control, or where there was no "
             "time to sum it"),
         HOOKE_COLUMN_AS(struct hk_estimate, last_error, last_piece, NUMBER, "m",
                         "where the error is not known: what the last piece of the run added to it at the "
                         "end, from a finer run of that piece"),
         HOOKE_COLUMN(struct hk_estimate, last_from, NUMBER, "s",
                      "start of that piece, whose end is that of the run"),
         HOOKE_COLUMN_AS(struct hk_estimate, spent, seconds, NUMBER, "s",
                         "time that picking and measuring took so far"),
         HOOKE_COLUMN_BY(memory_bytes, COUNT, "bytes",
                         "memory of the states that it keeps while the run goes on"),
         HOOKE_COLUMN(struct hk_estimate, reason, TEXT, "",
                      "why the error is not known, or why the wanted one is not met"),
         HOOKE_COLUMN(struct hk_estimate, reversal, TEXT, "",
                      "the times on this machine of the two best picks, where they would reverse the "
                      "choice by more than 2"))},
    {.name = "watched",
     .doc = "what is watched",
     .count = count_watched,
     HOOKE_TABLE_AT(struct hk_estimate, course.result),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY(quantity, TEXT, "", "quantity, as it was written"),
         HOOKE_COLUMN_BY(unit, TEXT, "", "its unit"),
         HOOKE_COLUMN(struct hk_watched_result, value, NUMBER, "of the quantity",
                      "its value at the end; of a period that over the frames"),
         HOOKE_COLUMN(
             struct hk_watched_result, minimum, NUMBER, "of the quantity",
             "its smallest value over all steps, between them that of a polynomial through five; with "
             "cvode-bdf and cvode-adams over eight parts of every step"),
         HOOKE_COLUMN(struct hk_watched_result, at_minimum, NUMBER, "s", "time of the smallest value"),
         HOOKE_COLUMN(struct hk_watched_result, maximum, NUMBER, "of the quantity",
                      "its largest value over all steps, likewise"),
         HOOKE_COLUMN(struct hk_watched_result, at_maximum, NUMBER, "s", "time of the largest value"),
         HOOKE_COLUMN_BY(from, NUMBER, "s", "time from which on smallest and largest values are known"),
         HOOKE_COLUMN_BY(until, NUMBER, "s",
                         "time until which they are known: the end of the run, or where it stopped"))},
    {.name = "wants",
     .doc = "what is wanted, one by one",
     .count = count_wants,
     HOOKE_TABLE_COLUMNS(HOOKE_COLUMN_BY_AS(wanted_quantity, quantity, TEXT, "",
                                            "quantity as written, or particles: all free ones"),
                         HOOKE_COLUMN_BY_AS(wanted_unit, unit, TEXT, "", "its unit"),
                         HOOKE_COLUMN_BY_AS(bound, wanted, NUMBER, "of the quantity",
                                            "largest error that is wanted, at any frame"),
                         HOOKE_COLUMN_BY_AS(wanted_error, error, NUMBER, "of the quantity", "its error"),
                         HOOKE_COLUMN_BY_AS(meets, met, FLAG, "", "1 if the run meets it"))},
    {.name = NULL}};
