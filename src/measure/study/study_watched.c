/* The tables of watched quantities and of ensembles. */
#include "measure/study/study.h"

#include <math.h>
#include <stddef.h>

/* ---- watched quantities ---- */

struct quantity_line {
  const char *quantity, *unit;
  double agreement;
  struct hk_series value;
};

static int64_t count_watched(const void *object) {
  const struct hk_study *study = object;
  return study->reference.frames.watched.list ? study->watched.count : 0;
}

static void read_watched(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_watched_series *series = &study->reference.frames.watched;
  const struct hk_watched *item = &study->watched.item[row];
  *(struct quantity_line *)line =
      (struct quantity_line){.quantity = item->text,
                             .unit = hk_watched_unit(item),
                             .agreement = series->figure[row],
                             .value = {hk_watched_series_of(series, row), study->reference.trusted}};
}

static const struct hk_column watched_columns[] = {
    HOOKE_COLUMN(struct quantity_line, quantity, TEXT, "", "quantity, as it was written"),
    HOOKE_COLUMN(struct quantity_line, unit, TEXT, "", "its unit"),
    HOOKE_COLUMN(struct quantity_line, agreement, NUMBER, "of the quantity",
                 "twice the largest difference in it between the two integrators of the reference, the floor "
                 "of its errors"),
    HOOKE_COLUMN(struct quantity_line, value, SERIES, "of the quantity",
                 "the reference's values at every frame; of a period those of the quantity that it is of"),
};

const struct hk_table hk_study_watched_table = {
    .name = "watched",
    .doc = "the watched quantities",
    HOOKE_TABLE_COLUMNS(watched_columns, struct quantity_line),
    .count = count_watched,
    .read = read_watched,
};

/* ---- their errors ---- */

struct error_line {
  double row;
  const char *quantity;
  double error;
  struct hk_series value;
};

static int64_t count_errors(const void *object) {
  return ((const struct hk_study *)object)->row_count * count_watched(object);
}

static void read_error(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const int64_t inner = count_watched(study), k = row % inner;
  const struct hk_watched_series *series = &study->row[row / inner].trial.watched;
  *(struct error_line *)line =
      (struct error_line){.row = (double)(row / inner),
                          .quantity = study->watched.item[k].text,
                          .error = series->figure[k],
                          .value = {hk_watched_series_of(series, k), study->reference.trusted}};
}

static const struct hk_column error_columns[] = {
    HOOKE_COLUMN_ALONG(OUTER, struct error_line, row, COUNT, "", "row of the table \"rows\""),
    HOOKE_COLUMN_ALONG(INNER, struct error_line, quantity, TEXT, "", "watched quantity"),
    HOOKE_COLUMN(struct error_line, error, NUMBER, "of the quantity",
                 "the largest difference from the reference over the frames that are trusted; of a period "
                 "that of the two periods over these, NaN with fewer than two passages or four frames a "
                 "period"),
    HOOKE_COLUMN(struct error_line, value, SERIES, "of the quantity", "its values at every frame"),
};

const struct hk_table hk_study_error_table = {
    .name = "watched_errors",
    .group = "watched",
    .doc = "the error of every row in every watched quantity",
    HOOKE_TABLE_COLUMNS(error_columns, struct error_line),
    .count = count_errors,
    .inner = count_watched,
    .read = read_error,
};

/* ---- the ensemble ---- */

struct ensemble_line {
  double members, from, until, noise, seed;
};

static int64_t count_ensembles(const void *object) {
  return ((const struct hk_study *)object)->ensemble != NULL;
}

static void read_ensemble(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_ensemble *e = study->ensemble;
  (void)row;
  *(struct ensemble_line *)line =
      (struct ensemble_line){.members = (double)e->members,
                             .from = e->from,
                             .until = e->until,
                             .noise = e->noise,
                             .seed = hooke_options_number(study->options, "seed")};
}

static const struct hk_column ensemble_columns[] = {
    HOOKE_COLUMN(struct ensemble_line, members, COUNT, "", "displaced runs of each method"),
    HOOKE_COLUMN(struct ensemble_line, from, NUMBER, "s", "begin of the means over time"),
    HOOKE_COLUMN(struct ensemble_line, until, NUMBER, "s", "end of the means over time"),
    HOOKE_COLUMN(struct ensemble_line, noise, NUMBER, "m",
                 "root mean square displacement of a free particle at the start"),
    HOOKE_COLUMN(struct ensemble_line, seed, COUNT, "", "seed of the noise"),
};

const struct hk_table hk_study_ensemble_table = {
    .name = "ensemble",
    .group = "statistics",
    .doc = "the displaced runs that statistics are of, for motion that cannot be judged to the end",
    .record = 1,
    HOOKE_TABLE_COLUMNS(ensemble_columns, struct ensemble_line),
    .count = count_ensembles,
    .read = read_ensemble,
};

/* ---- statistics ---- */

struct statistic_line {
  const char *method, *quantity, *unit;
  double step, rtol, members, failed, mean, spread, bias;
};

static int64_t count_quantities(const void *object) {
  const struct hk_ensemble *e = ((const struct hk_study *)object)->ensemble;
  return e ? e->quantities.count : 0;
}

static int64_t count_statistics(const void *object) {
  const struct hk_ensemble *e = ((const struct hk_study *)object)->ensemble;
  return e ? e->source_count * e->quantities.count : 0;
}

static void read_statistic(const void *object, int64_t row, void *line) {
  const struct hk_study *study = object;
  const struct hk_ensemble *e = study->ensemble;
  const int64_t source = row / e->quantities.count, q = row % e->quantities.count;
  const struct hk_ensemble_source *s = &e->source[source];
  const int adaptive = s->method < 0 || hk_study_is_adaptive(study, s->method);
  const struct hk_ensemble_sample sample = hk_ensemble_sample(e, source, q);
  *(struct statistic_line *)line = (struct statistic_line){
      .method = s->method < 0 ? "reference" : study->method[s->method],
      .quantity = e->quantities.item[q].text,
      .unit = hk_watched_unit(&e->quantities.item[q]),
      .step = adaptive ? NAN : s->value,
      .rtol = adaptive ? s->value : NAN,
      .members = (double)sample.members,
      .failed = (double)s->failed,
      .mean = sample.mean,
      .spread = sample.spread,
      .bias = source > 0 ? hk_ensemble_bias(e, source, q) : NAN,
  };
}

static const struct hk_column statistic_columns[] = {
    HOOKE_COLUMN_ALONG(OUTER, struct statistic_line, method, TEXT, "", "method, the reference first"),
    HOOKE_COLUMN_ALONG(INNER, struct statistic_line, quantity, TEXT, "",
                       "kinetic, potential, energy, and what is watched"),
    HOOKE_COLUMN_ALONG(INNER, struct statistic_line, unit, TEXT, "", "unit of the quantity"),
    HOOKE_COLUMN(struct statistic_line, step, NUMBER, "s", "step of the runs"),
    HOOKE_COLUMN(struct statistic_line, rtol, NUMBER, "", "relative tolerance of the runs"),
    HOOKE_COLUMN(struct statistic_line, members, COUNT, "", "runs that have the quantity"),
    HOOKE_COLUMN(struct statistic_line, failed, COUNT, "",
                 "runs that did not come to their end; a method that has one has no statistics"),
    HOOKE_COLUMN(struct statistic_line, mean, NUMBER, "of the quantity",
                 "mean over the runs of each run's mean over time"),
    HOOKE_COLUMN(struct statistic_line, spread, NUMBER, "of the quantity", "standard deviation of the runs"),
    HOOKE_COLUMN(struct statistic_line, bias, NUMBER, "",
                 "the mean less the reference's, in standard errors of that difference; below 2 in size none "
                 "is seen"),
};

const struct hk_table hk_study_statistic_table = {
    .name = "statistics",
    .doc = "means and spreads of an ensemble, by quantity and method",
    HOOKE_TABLE_COLUMNS(statistic_columns, struct statistic_line),
    .count = count_statistics,
    .inner = count_quantities,
    .read = read_statistic,
};
