/* The tables of a limit. */
#include "measure/limit/limit.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/* ---- the limit ---- */

struct limit_line {
  const char *method, *blamed;
  double time, step, frequency_max, rate_max, mode_count, clamped, tipping, products;
  struct hk_series shape;
};

/* The step of the run, for a method that takes it. */
static double own_step(const struct hk_limit *limit) {
  if (limit->run == NULL || !hooke_options_is_set(limit->run, "step")) return NAN;
  if (hooke_method_is_adaptive(hooke_options_text(limit->run, "method")) != 0) return NAN;
  return hooke_options_number(limit->run, "step");
}

static double if_found(const struct hk_limit *limit, int64_t count) {
  return limit->found ? (double)count : NAN;
}

static void read_limit(const void *object, int64_t row, void *line) {
  const struct hk_limit *limit = object;
  const struct hk_limit_row *blamed = limit->found ? hk_limit_limiting_row(limit) : NULL;
  (void)row;
  *(struct limit_line *)line =
      (struct limit_line){.time = limit->time,
                          .method = limit->run ? hooke_options_text(limit->run, "method") : NULL,
                          .step = own_step(limit),
                          .frequency_max = limit->found ? limit->frequency : NAN,
                          .rate_max = limit->found ? limit->decay : NAN,
                          .mode_count = if_found(limit, limit->mode_count),
                          .clamped = if_found(limit, limit->clamped),
                          .tipping = if_found(limit, limit->tipping),
                          .products = if_found(limit, limit->products),
                          .blamed = blamed ? blamed->method : NULL,
                          .shape = {blamed ? limit->shape : NULL, 3 * limit->system->particle_count}};
}

static const struct hk_column limit_columns[] = {
    HOOKE_COLUMN(struct limit_line, time, NUMBER, "s", "time of the state that was looked at last"),
    HOOKE_COLUMN(struct limit_line, method, TEXT, "", "method of the run"),
    HOOKE_COLUMN(struct limit_line, step, NUMBER, "s",
                 "step that the run names; NaN if it names none or the method chooses its own"),
    HOOKE_COLUMN(struct limit_line, frequency_max, NUMBER, "rad/s",
                 "largest frequency of the undamped modes"),
    HOOKE_COLUMN(struct limit_line, rate_max, NUMBER, "1/s", "largest eigenvalue of M^-1 C"),
    HOOKE_COLUMN(struct limit_line, mode_count, COUNT, "", "modes that are known"),
    HOOKE_COLUMN(struct limit_line, clamped, COUNT, "",
                 "springs under compression whose transverse stiffness was left out"),
    HOOKE_COLUMN(struct limit_line, tipping, COUNT, "",
                 "rigid bodies that gravity or tensions would tip over, which was left out"),
    HOOKE_COLUMN(struct limit_line, products, COUNT, "", "products with K and C that it took"),
    HOOKE_COLUMN(
        struct limit_line, blamed, TEXT, "",
        "method whose limiting mode the limiting springs, participations and suggestion are of: that "
        "of the run, or the first that has a limit"),
    HOOKE_COLUMN(struct limit_line, shape, SERIES, "",
                 "that mode: 3n displacements, particle by particle, of largest length 1"),
};

static const struct hk_table limit_table = {
    .name = "limit",
    .doc = "the scene linearised at one state",
    .record = 1,
    HOOKE_TABLE_COLUMNS(limit_columns, struct limit_line),
    .read = read_limit,
};

/* ---- rows ---- */

struct row_line {
  const char *method, *note;
  double bound, predicted, measured, ratio, steps_run, smallest, smallest_time;
  double exact, never_stable, by_eigenvalue;
};

static void read_row(const void *object, int64_t row, void *line) {
  const struct hk_limit *limit = object;
  const struct hk_limit_row *r = &limit->row[row];
  const int comparable = r->predicted > 0.0 && isfinite(r->predicted) && isfinite(r->measured);
  *(struct row_line *)line = (struct row_line){.method = r->method,
                                               .bound = r->bound,
                                               .predicted = r->predicted,
                                               .measured = r->measured,
                                               .ratio = comparable ? r->measured / r->predicted : NAN,
                                               .steps_run = r->steps_run,
                                               .smallest = r->smallest,
                                               .smallest_time = r->smallest_time,
                                               .exact = if_found(limit, r->exact),
                                               .never_stable = if_found(limit, r->never_stable),
                                               .by_eigenvalue = (double)hk_limit_rule_needs_all(r->method),
                                               .note = r->note};
}

static const struct hk_column row_columns[] = {
    HOOKE_COLUMN(struct row_line, method, TEXT, "", "method"),
    HOOKE_COLUMN(struct row_line, bound, NUMBER, "s", "hooke_step_bound(): certain to be stable"),
    HOOKE_COLUMN(
        struct row_line, predicted, NUMBER, "s",
        "the sharp limit, or where only part of the spectrum is known the limit over the modes found; "
        "infinity: nothing limits the step, 0: no step is stable"),
    HOOKE_COLUMN(struct row_line, measured, NUMBER, "s", "largest step that was seen to be stable"),
    HOOKE_COLUMN(struct row_line, ratio, NUMBER, "", "measured over predicted"),
    HOOKE_COLUMN(struct row_line, steps_run, COUNT, "", "steps taken to measure"),
    HOOKE_COLUMN(struct row_line, smallest, NUMBER, "s", "smallest prediction met along the run"),
    HOOKE_COLUMN(struct row_line, smallest_time, NUMBER, "s", "its time"),
    HOOKE_COLUMN(struct row_line, exact, FLAG, "", "0: the limit lies between bound and predicted"),
    HOOKE_COLUMN(struct row_line, never_stable, FLAG, "", "no step is stable"),
    HOOKE_COLUMN(struct row_line, by_eigenvalue, FLAG, "",
                 "stable where step times lambda is within one region for every eigenvalue lambda"),
    HOOKE_COLUMN(struct row_line, note, TEXT, "",
                 "what to know about the row: what limits a method without a limit, or why prediction and "
                 "measurement differ; empty if nothing"),
};

static const struct hk_table row_table = {
    .name = "rows",
    .doc = "the largest stable step of each method",
    HOOKE_TABLE_COLUMNS(row_columns, struct row_line),
    HOOKE_TABLE_COUNT(struct hk_limit, row_count),
    .read = read_row,
};

/* ---- limiting springs ---- */

/* 1 if a force comes first. */
static int64_t has_force_row(const struct hk_limit *limit) {
  return hk_participation_force(&limit->participation) >= 0;
}

static int64_t count_limiting(const void *object) {
  const struct hk_limit *limit = object;
  return limit->participation.spring_count + has_force_row(limit);
}

static void read_limiting(const void *object, int64_t row, void *line) {
  const struct hk_limit *limit = object;
  const int32_t force = row == 0 ? hk_participation_force(&limit->participation) : -1;
  if (force >= 0) {
    *(struct hk_limiting_line *)line =
        (struct hk_limiting_line){.number = NAN,
                                  .first = NAN,
                                  .second = NAN,
                                  .group = "",
                                  .share = limit->participation.force_share[force],
                                  .force = hk_participation_force_name(force)};
    return;
  }
  const struct hk_limiting_spring *s = &limit->participation.spring[row - has_force_row(limit)];
  *(struct hk_limiting_line *)line =
      (struct hk_limiting_line){.number = (double)s->spring,
                                .first = (double)s->first,
                                .second = (double)s->second,
                                .group = hooke_system_group_name(limit->system, "springs", s->group),
                                .share = s->share};
}

const struct hk_column hk_limiting_columns[HOOKE_LIMITING_COLUMNS] = {
    HOOKE_COLUMN(struct hk_limiting_line, number, COUNT, "", "number of the spring; NaN of a force"),
    HOOKE_COLUMN(struct hk_limiting_line, first, COUNT, "", "particle at its first end"),
    HOOKE_COLUMN(struct hk_limiting_line, second, COUNT, "", "particle at its second end"),
    HOOKE_COLUMN(struct hk_limiting_line, group, TEXT, "",
                 "name of its group or part; empty if that has none"),
    HOOKE_COLUMN(
        struct hk_limiting_line, share, NUMBER, "",
        "share of h^2 K + 2 h C in the limiting mode, 0 to 1; bending, altitude springs and drag are "
        "part of the whole; NaN if it cannot be told"),
    HOOKE_COLUMN(struct hk_limiting_line, force, TEXT, "",
                 "drag, damping, bending or altitude, where no spring but that force is meant; geometric: "
                 "gravity and tensions, which turn rigid bodies"),
};

static const struct hk_table limiting_table = {
    .name = "blame",
    HOOKE_LIMITING_TABLE,
    .count = count_limiting,
    .read = read_limiting,
};

/* ---- participation ---- */

struct particle_line {
  double particle, share, mass;
};

static void read_particle(const void *object, int64_t row, void *line) {
  const struct hk_limiting_particle *p = &((const struct hk_limit *)object)->participation.particle[row];
  *(struct particle_line *)line =
      (struct particle_line){.particle = (double)p->particle, .share = p->share, .mass = p->mass};
}

static const struct hk_column particle_columns[] = {
    HOOKE_COLUMN(struct particle_line, particle, COUNT, "", "number of the particle"),
    HOOKE_COLUMN(struct particle_line, share, NUMBER, "", "share of the kinetic energy of the mode, 0 to 1"),
    HOOKE_COLUMN(struct particle_line, mass, NUMBER, "kg", "its mass"),
};

static const struct hk_table particle_table = {
    .name = "movers",
    .doc = "participation of particles in the limiting mode, at most 100, the largest share first",
    HOOKE_TABLE_COLUMNS(particle_columns, struct particle_line),
    HOOKE_TABLE_COUNT(struct hk_limit, participation.particle_count),
    .read = read_particle,
};

/* ---- the suggestion ---- */

struct suggestion_line {
  const char *kind, *sentence;
  double springs, particles, factor, cost, gain, gain_predicted;
};

static int64_t count_suggestions(const void *object) {
  return ((const struct hk_limit *)object)->suggestion.sentence[0] != '\0';
}

static void read_suggestion(const void *object, int64_t row, void *line) {
  const struct hk_suggestion *r = &((const struct hk_limit *)object)->suggestion;
  const int soften = r->kind && strcmp(r->kind, "soften") == 0;
  (void)row;
  *(struct suggestion_line *)line =
      (struct suggestion_line){.kind = r->kind,
                               .springs = soften ? (double)r->count : NAN,
                               .particles = r->kind && !soften ? (double)r->count : NAN,
                               .factor = r->factor,
                               .cost = r->cost,
                               .gain = r->gain,
                               .gain_predicted = r->gain_predicted,
                               .sentence = r->sentence};
}

static const struct hk_column suggestion_columns[] = {
    HOOKE_COLUMN(struct suggestion_line, kind, TEXT, "",
                 "soften (springs) or heavier (particles); none where no small set limits the step"),
    HOOKE_COLUMN(struct suggestion_line, springs, COUNT, "", "springs to change, the first limiting springs"),
    HOOKE_COLUMN(struct suggestion_line, particles, COUNT, "",
                 "particles to change, those that participate most"),
    HOOKE_COLUMN(struct suggestion_line, factor, NUMBER, "", "factor by which to change them"),
    HOOKE_COLUMN(struct suggestion_line, cost, NUMBER, "", "factor of the step without them"),
    HOOKE_COLUMN(struct suggestion_line, gain, NUMBER, "",
                 "factor of the step, computed again with the change made"),
    HOOKE_COLUMN(struct suggestion_line, gain_predicted, NUMBER, "",
                 "factor of the step by first-order perturbation"),
    HOOKE_COLUMN(struct suggestion_line, sentence, TEXT, "", "the suggestion in words"),
};

static const struct hk_table suggestion_table = {
    .name = "remedy",
    .doc = "suggestion: what changing the limiting springs, or the particles, would gain",
    .record = 1,
    HOOKE_TABLE_COLUMNS(suggestion_columns, struct suggestion_line),
    .count = count_suggestions,
    .read = read_suggestion,
};

/* ---- modes ---- */

static void read_mode(const void *object, int64_t row, void *line) {
  *(struct hk_limit_mode *)line = ((const struct hk_limit *)object)->mode[row];
}

static const struct hk_column mode_columns[] = {
    HOOKE_COLUMN(struct hk_limit_mode, real, NUMBER, "1/s", "real part of the eigenvalue"),
    HOOKE_COLUMN(struct hk_limit_mode, imaginary, NUMBER, "1/s", "its imaginary part"),
    HOOKE_COLUMN(
        struct hk_limit_mode, frequency, NUMBER, "rad/s",
        "frequency of x'' + 2 decay x' + frequency^2 x = 0, of which it is a root (with damping out of "
        "proportion, of k = u.Ku and c = u.Cu of its mode u)"),
    HOOKE_COLUMN(struct hk_limit_mode, decay, NUMBER, "1/s", "decay of that equation"),
};

static const struct hk_table mode_table = {
    .name = "modes",
    .doc = "eigenvalues lambda of lambda^2 M + lambda C + K that are known, the largest first; one of a "
           "conjugate pair, none that is 0",
    HOOKE_TABLE_COLUMNS(mode_columns, struct hk_limit_mode),
    HOOKE_TABLE_COUNT(struct hk_limit, mode_count),
    .read = read_mode,
};

/* ---- the list ---- */

const struct hk_table *const hk_limit_tables[HOOKE_LIMIT_TABLES] = {
    &limit_table, &row_table, &limiting_table, &particle_table, &suggestion_table, &mode_table};
