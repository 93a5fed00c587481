/* The tables of a limit. */
#include "measure/limit/limit.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* ---- the limit ---- */

/* The step of the run, for a method that takes it. */
static double step_of(const hooke_options *run) {
  if (run == NULL || !hooke_options_is_set(run, "step")) return NAN;
  if (hooke_method_is_adaptive(hooke_options_text(run, "method")) != 0) return NAN;
  return hooke_options_number(run, "step");
}

static const struct hk_limit_row *blamed_row(const struct hk_limit *limit) {
  return limit->found ? hk_limit_limiting_row(limit) : NULL;
}

HOOKE_READER(const char *, own_method, struct hk_limit,
             it->run ? hooke_options_text(it->run, "method") : NULL)
HOOKE_READER(double, own_step, struct hk_limit, step_of(it->run))
HOOKE_READER(double, frequency_max, struct hk_limit, it->found ? it->frequency : NAN)
HOOKE_READER(double, rate_max, struct hk_limit, it->found ? it->decay : NAN)
HOOKE_READER(double, mode_count, struct hk_limit, it->found ? (double)it->mode_count : NAN)
HOOKE_READER(double, clamped, struct hk_limit, it->found ? (double)it->clamped : NAN)
HOOKE_READER(double, tipping, struct hk_limit, it->found ? (double)it->tipping : NAN)
HOOKE_READER(double, products, struct hk_limit, it->found ? (double)it->products : NAN)
HOOKE_READER(const char *, blamed, struct hk_limit, blamed_row(it) ? blamed_row(it)->method : NULL)
HOOKE_READER(const double *, shape, struct hk_limit, blamed_row(it) ? it->shape : NULL)
HOOKE_COUNTER(length, struct hk_limit, 3 * it->system->particle_count)

/* ---- rows ---- */

static double ratio_of(const struct hk_limit_row *row) {
  const int comparable = row->predicted > 0.0 && isfinite(row->predicted) && isfinite(row->measured);
  return comparable ? row->measured / row->predicted : NAN;
}

HOOKE_READER(double, ratio, struct hk_limit, ratio_of(&it->row[row]))
HOOKE_READER(double, exact, struct hk_limit, it->found ? (double)it->row[row].exact : NAN)
HOOKE_READER(double, never_stable, struct hk_limit, it->found ? (double)it->row[row].never_stable : NAN)
HOOKE_READER(double, by_eigenvalue, struct hk_limit, hk_limit_rule_needs_all(it->row[row].method))

/* ---- limiting springs ---- */

const struct hk_column hk_limiting_columns[HOOKE_LIMITING_COLUMNS] = {
    HOOKE_COLUMN_AS(struct hk_limiting, spring, number, COUNT, "", "number of the spring; NaN of a force"),
    HOOKE_COLUMN(struct hk_limiting, first, COUNT, "", "particle at its first end"),
    HOOKE_COLUMN(struct hk_limiting, second, COUNT, "", "particle at its second end"),
    HOOKE_COLUMN(struct hk_limiting, group, TEXT, "", "name of its group or part; empty if that has none"),
    HOOKE_COLUMN(
        struct hk_limiting, share, NUMBER, "",
        "share of h^2 K + 2 h C in the limiting mode, 0 to 1; bending, altitude springs and drag are part "
        "of the whole; NaN if it cannot be told"),
    HOOKE_COLUMN(
        struct hk_limiting, force, TEXT, "",
        "drag, quadratic_drag, fluid_drag, damping, bending or altitude, where no spring but that force is meant; geometric: "
        "gravity and tensions, which turn rigid bodies"),
};

/* ---- participation ---- */

/* ---- the suggestion ---- */

/* The count of what is to change, if that is of the kind. */
static double count_of(const struct hk_suggestion *suggestion, const char *kind) {
  return suggestion->kind && strcmp(suggestion->kind, kind) == 0 ? (double)suggestion->count : NAN;
}

HOOKE_READER(double, springs, struct hk_limit, count_of(&it->suggestion, "soften"))
HOOKE_READER(double, particles, struct hk_limit, count_of(&it->suggestion, "heavier"))
HOOKE_READER(const char *, command, struct hk_limit, it->measurement->label[HOOKE_LABEL_COMMAND])
HOOKE_COUNTER(count_suggestions, struct hk_limit, it->suggestion.sentence[0] != '\0')

/* ---- modes ---- */

/* ---- the tables ---- */

const struct hk_table hk_limit_tables[] = {
    {.name = "limit",
     .doc = "the scene linearised at one state",
     .record = 1,
     .length = length,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_limit, time, NUMBER, "s", "time of the state that was looked at last"),
         HOOKE_COLUMN_BY_AS(own_method, method, TEXT, "", "method of the run"),
         HOOKE_COLUMN_BY_AS(own_step, step, NUMBER, "s",
                            "step that the run names; NaN if it names none or the method chooses its own"),
         HOOKE_COLUMN_BY(frequency_max, NUMBER, "rad/s", "largest frequency of the undamped modes"),
         HOOKE_COLUMN_BY(rate_max, NUMBER, "1/s", "largest eigenvalue of M^-1 C"),
         HOOKE_COLUMN_BY(mode_count, COUNT, "", "modes that are known"),
         HOOKE_COLUMN_BY(clamped, COUNT, "",
                         "springs under compression whose transverse stiffness was left out"),
         HOOKE_COLUMN_BY(tipping, COUNT, "",
                         "rigid bodies that gravity or tensions would tip over, which was left out"),
         HOOKE_COLUMN_BY(products, COUNT, "", "products with K and C that it took"),
         HOOKE_COLUMN_BY(
             blamed, TEXT, "",
             "method whose limiting mode the limiting springs, participations and suggestion are of: that "
             "of the run, or the first that has a limit"),
         HOOKE_COLUMN_BY(shape, SERIES, "",
                         "that mode: 3n displacements, particle by particle, of largest length 1"))},
    {.name = "rows",
     .doc = "the largest stable step of each method",
     HOOKE_TABLE_ROWS(struct hk_limit, row, row_count),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_limit_row, method, TEXT, "", "method"),
         HOOKE_COLUMN(struct hk_limit_row, bound, NUMBER, "s", "hooke_step_bound(): certain to be stable"),
         HOOKE_COLUMN(struct hk_limit_row, predicted, NUMBER, "s",
                      "the sharp limit, or where only part of the spectrum is known the limit over the modes "
                      "found; infinity: nothing limits the step, 0: no step is stable"),
         HOOKE_COLUMN(struct hk_limit_row, measured, NUMBER, "s", "largest step that was seen to be stable"),
         HOOKE_COLUMN_BY(ratio, NUMBER, "", "measured over predicted"),
         HOOKE_COLUMN(struct hk_limit_row, steps_run, COUNT, "", "steps taken to measure"),
         HOOKE_COLUMN(struct hk_limit_row, smallest, NUMBER, "s", "smallest prediction met along the run"),
         HOOKE_COLUMN(struct hk_limit_row, smallest_time, NUMBER, "s", "its time"),
         HOOKE_COLUMN_BY(exact, FLAG, "", "0: the limit lies between bound and predicted"),
         HOOKE_COLUMN_BY(never_stable, FLAG, "", "no step is stable"),
         HOOKE_COLUMN_BY(by_eigenvalue, FLAG, "",
                         "stable where step times lambda is within one region for every eigenvalue lambda"),
         HOOKE_COLUMN(
             struct hk_limit_row, note, TEXT, "",
             "what to know about the row: what limits a method without a limit, or why prediction and "
             "measurement differ; empty if nothing"))},
    {.name = "blame", HOOKE_LIMITING_TABLE, HOOKE_TABLE_ROWS(struct hk_limit, limiting.row, limiting.count)},
    {.name = "participation",
     .doc = "participation of particles in the limiting mode, at most 100, the largest share first",
     HOOKE_TABLE_ROWS(struct hk_limit, participation.particle, participation.particle_count),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_limiting_particle, particle, COUNT, "", "number of the particle"),
         HOOKE_COLUMN(struct hk_limiting_particle, share, NUMBER, "",
                      "share of the kinetic energy of the mode, 0 to 1"),
         HOOKE_COLUMN(struct hk_limiting_particle, mass, NUMBER, "kg", "its mass"))},
    {.name = "changes",
     .doc = "suggestion: what changing the limiting springs, or the particles, would gain",
     .record = 1,
     HOOKE_TABLE_IN(struct hk_limit, suggestion),
     .count = count_suggestions,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_suggestion, kind, TEXT, "",
                      "soften (springs) or heavier (particles); none where no small set limits the step"),
         HOOKE_COLUMN_BY(springs, COUNT, "", "springs to change, the first limiting springs"),
         HOOKE_COLUMN_BY(particles, COUNT, "", "particles to change, those that participate most"),
         HOOKE_COLUMN(struct hk_suggestion, factor, NUMBER, "", "factor by which to change them"),
         HOOKE_COLUMN(struct hk_suggestion, cost, NUMBER, "", "factor of the step without them"),
         HOOKE_COLUMN(struct hk_suggestion, gain, NUMBER, "",
                      "factor of the step, computed again with the change made"),
         HOOKE_COLUMN(struct hk_suggestion, gain_predicted, NUMBER, "",
                      "factor of the step by first-order perturbation"),
         HOOKE_COLUMN_AS(struct hk_suggestion, price.error, error, NUMBER, "m",
                         "error that it makes over the run, by two runs; none where it is not known"),
         HOOKE_COLUMN_AS(struct hk_suggestion, price.want, want, NUMBER, "m",
                         "a want with which `needs` tells the error where it is not known"),
         HOOKE_COLUMN_BY(command, TEXT, "", "the command line of that, where the caller gave one as a label"),
         HOOKE_COLUMN(struct hk_suggestion, sentence, TEXT, "", "the suggestion in words"))},
    {.name = "modes",
     .doc = "eigenvalues lambda of lambda^2 M + lambda C + K that are known, the largest first; one of a "
            "conjugate pair, none that is 0",
     HOOKE_TABLE_ROWS(struct hk_limit, mode, mode_count),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_limit_mode, real, NUMBER, "1/s", "real part of the eigenvalue"),
         HOOKE_COLUMN(struct hk_limit_mode, imaginary, NUMBER, "1/s", "its imaginary part"),
         HOOKE_COLUMN(
             struct hk_limit_mode, frequency, NUMBER, "rad/s",
             "frequency of x'' + 2 decay x' + frequency^2 x = 0, of which it is a root (with damping out "
             "of proportion, of k = u.Ku and c = u.Cu of its mode u)"),
         HOOKE_COLUMN(struct hk_limit_mode, decay, NUMBER, "1/s", "decay of that equation"))},
    {.name = NULL}};
