/* The tables of watched quantities and of ensembles. */
#include "measure/study/study.h"

#include <math.h>
#include <stddef.h>

/* ---- watched quantities ---- */

HOOKE_COUNTER(count_watched, struct hk_study, it->reference.frames.watched.list ? it->watched.count : 0)
HOOKE_COUNTER(trusted, struct hk_study, it->reference.trusted)
HOOKE_READER(const void *, find_watched, struct hk_study, &it->watched.item[row])
HOOKE_READER(const char *, watched_unit, struct hk_study, hk_watched_unit(&it->watched.item[row]))
HOOKE_READER(double, agreement, struct hk_study, it->reference.frames.watched.figure[row])
HOOKE_READER(const double *, watched_value, struct hk_study,
             hk_watched_series_of(&it->reference.frames.watched, row))

static const struct hk_column watched_columns[] = {
    HOOKE_COLUMN_AS(struct hk_watched, text, quantity, TEXT, "", "quantity, as it was written"),
    HOOKE_COLUMN_BY(watched_unit, unit, TEXT, "", "its unit"),
    HOOKE_COLUMN_BY(
        agreement, agreement, NUMBER, "of the quantity",
        "twice the largest difference in it between the two integrators of the reference, the floor "
        "of its errors"),
    HOOKE_COLUMN_BY(watched_value, value, SERIES, "of the quantity",
                    "the reference's values at every frame; of a period those of the quantity that it is of"),
};

const struct hk_table hk_study_watched_table = {
    .name = "watched",
    .doc = "the watched quantities",
    HOOKE_TABLE_COLUMNS(watched_columns),
    .count = count_watched,
    .row = find_watched,
    .length = trusted,
};

/* ---- their errors ---- */

static const struct hk_watched_series *series_of(const struct hk_study *study, int64_t row) {
  return &study->row[row / count_watched(study)].trial.watched;
}

HOOKE_COUNTER(count_errors, struct hk_study, it->row_count *count_watched(it))
HOOKE_READER(double, row_number, struct hk_study, (double)(row / count_watched(it)))
HOOKE_READER(const char *, error_quantity, struct hk_study, it->watched.item[row % count_watched(it)].text)
HOOKE_READER(double, error, struct hk_study, series_of(it, row)->figure[row % count_watched(it)])
HOOKE_READER(const double *, error_value, struct hk_study,
             hk_watched_series_of(series_of(it, row), row % count_watched(it)))

static const struct hk_column error_columns[] = {
    HOOKE_COLUMN_ALONG(OUTER, row_number, row, COUNT, "", "row of the table \"rows\""),
    HOOKE_COLUMN_ALONG(INNER, error_quantity, quantity, TEXT, "", "watched quantity"),
    HOOKE_COLUMN_BY(error, error, NUMBER, "of the quantity",
                    "the largest difference from the reference over the frames that are trusted; of a period "
                    "that of the two periods over these, NaN with fewer than two passages or four frames a "
                    "period"),
    HOOKE_COLUMN_BY(error_value, value, SERIES, "of the quantity", "its values at every frame"),
};

const struct hk_table hk_study_error_table = {
    .name = "watched_errors",
    .group = "watched",
    .doc = "the error of every row in every watched quantity",
    HOOKE_TABLE_COLUMNS(error_columns),
    .count = count_errors,
    .inner = count_watched,
    .length = trusted,
};

/* ---- the ensemble ---- */

HOOKE_READER(const void *, find_ensemble, struct hk_study, it->ensemble)
HOOKE_READER(double, seed, struct hk_study, hooke_options_number(it->options, "seed"))
HOOKE_COUNTER(count_ensembles, struct hk_study, it->ensemble != NULL)

static const struct hk_column ensemble_columns[] = {
    HOOKE_COLUMN(struct hk_ensemble, members, COUNT, "", "displaced runs of each method"),
    HOOKE_COLUMN(struct hk_ensemble, from, NUMBER, "s", "begin of the means over time"),
    HOOKE_COLUMN(struct hk_ensemble, until, NUMBER, "s", "end of the means over time"),
    HOOKE_COLUMN(struct hk_ensemble, noise, NUMBER, "m",
                 "root mean square displacement of a free particle at the start"),
    HOOKE_COLUMN_BY(seed, seed, COUNT, "", "seed of the noise"),
};

const struct hk_table hk_study_ensemble_table = {
    .name = "ensemble",
    .group = "statistics",
    .doc = "the displaced runs that statistics are of, for motion that cannot be judged to the end",
    .record = 1,
    HOOKE_TABLE_COLUMNS(ensemble_columns),
    .count = count_ensembles,
    .row = find_ensemble,
};

/* ---- statistics ---- */

HOOKE_COUNTER(count_quantities, struct hk_study, it->ensemble ? it->ensemble->quantities.count : 0)
HOOKE_COUNTER(count_statistics, struct hk_study,
              it->ensemble ? it->ensemble->source_count * it->ensemble->quantities.count : 0)

static const struct hk_ensemble_source *source_of(const struct hk_study *study, int64_t row) {
  return &study->ensemble->source[row / count_quantities(study)];
}

static const struct hk_watched *quantity_of(const struct hk_study *study, int64_t row) {
  return &study->ensemble->quantities.item[row % count_quantities(study)];
}

static struct hk_ensemble_sample sample_of(const struct hk_study *study, int64_t row) {
  const int64_t inner = count_quantities(study);
  return hk_ensemble_sample(study->ensemble, row / inner, row % inner);
}

static double bias_of(const struct hk_study *study, int64_t row) {
  const int64_t inner = count_quantities(study);
  return row < inner ? NAN : hk_ensemble_bias(study->ensemble, row / inner, row % inner);
}

static double setting_of(const struct hk_study *study, int64_t row, int32_t adaptive) {
  const struct hk_ensemble_source *source = source_of(study, row);
  return hk_study_setting(study, source->method, source->value, adaptive);
}

static const char *method_of(const struct hk_study *study, int64_t row) {
  const int32_t method = source_of(study, row)->method;
  return method < 0 ? "reference" : study->method[method];
}

HOOKE_READER(const void *, find_source, struct hk_study, source_of(it, row))
HOOKE_READER(const char *, statistic_method, struct hk_study, method_of(it, row))
HOOKE_READER(const char *, statistic_quantity, struct hk_study, quantity_of(it, row)->text)
HOOKE_READER(const char *, statistic_unit, struct hk_study, hk_watched_unit(quantity_of(it, row)))
HOOKE_READER(double, statistic_step, struct hk_study, setting_of(it, row, 0))
HOOKE_READER(double, statistic_rtol, struct hk_study, setting_of(it, row, 1))
HOOKE_READER(double, statistic_members, struct hk_study, (double)sample_of(it, row).members)
HOOKE_READER(double, mean, struct hk_study, sample_of(it, row).mean)
HOOKE_READER(double, spread, struct hk_study, sample_of(it, row).spread)
HOOKE_READER(double, bias, struct hk_study, bias_of(it, row))

static const struct hk_column statistic_columns[] = {
    HOOKE_COLUMN_ALONG(OUTER, statistic_method, method, TEXT, "", "method, the reference first"),
    HOOKE_COLUMN_ALONG(INNER, statistic_quantity, quantity, TEXT, "",
                       "kinetic, potential, energy, and what is watched"),
    HOOKE_COLUMN_ALONG(INNER, statistic_unit, unit, TEXT, "", "unit of the quantity"),
    HOOKE_COLUMN_BY(statistic_step, step, NUMBER, "s", "step of the runs"),
    HOOKE_COLUMN_BY(statistic_rtol, rtol, NUMBER, "", "relative tolerance of the runs"),
    HOOKE_COLUMN_BY(statistic_members, members, COUNT, "", "runs that have the quantity"),
    HOOKE_COLUMN(struct hk_ensemble_source, failed, COUNT, "",
                 "runs that did not come to their end; a method that has one has no statistics"),
    HOOKE_COLUMN_BY(mean, mean, NUMBER, "of the quantity", "mean over the runs of each run's mean over time"),
    HOOKE_COLUMN_BY(spread, spread, NUMBER, "of the quantity", "standard deviation of the runs"),
    HOOKE_COLUMN_BY(
        bias, bias, NUMBER, "",
        "the mean less the reference's, in standard errors of that difference; below 2 in size none "
        "is seen"),
};

const struct hk_table hk_study_statistic_table = {
    .name = "statistics",
    .doc = "means and spreads of an ensemble, by quantity and method",
    HOOKE_TABLE_COLUMNS(statistic_columns),
    .count = count_statistics,
    .inner = count_quantities,
    .row = find_source,
};
