#include "measure/quantity/wants.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "core/table/option_value.h"
#include "model/generalized.h"
#include "model/system.h"

#include <math.h>
#include <string.h>

static const double LEAST = 1e-3;    /* of the size of a scene: what a list without a length stands for */
static const double FAR_BELOW = 0.1; /* of a largest value: if no more is known, it is an error */

/* ---- reading ---- */

/* A number > 0 with a unit, or in % where it is no length of all particles. */
static int32_t read_bound(const char *text, const char *unit, struct hk_want *want) {
  struct hk_option_row row = {.name = "want", HOOKE_OPTION_POSITIVE(unit[0] ? unit : NULL)};
  char number[HOOKE_WANT_NAME];
  struct hk_option_value value;
  const size_t length = strlen(text);
  want->relative = want->width > 0 && length > 0 && text[length - 1] == '%';
  if (want->relative) row.unit = NULL;
  hk_print(number, sizeof number, "%.*s", (int)(length - (size_t)want->relative), text);
  const int32_t status = hk_option_value_from_text(&row, "want", number, &value);
  if (status == HOOKE_OK) want->bound = want->relative ? value.one / 100.0 : value.one;
  return status;
}

/* The quantity, or the three of a particle. */
static int32_t read_name(struct hk_watched_list *list, struct hk_want *want) {
  char axis[HOOKE_WANT_NAME + 2];
  want->width = 1;
  int32_t status = hk_watched_read(list, "want", want->name);
  want->at[0] = hk_watched_find(list, want->name);
  if (status != HOOKE_BAD_VALUE) return status;
  for (want->width = 0; want->width < 3; want->width++) {
    hk_print(axis, sizeof axis, "%s.%c", want->name, "xyz"[want->width]);
    status = hk_watched_read(list, "want", axis);
    if (status != HOOKE_OK) /* of a number, the message says which there are */
      return status == HOOKE_BAD_VALUE && want->name[strspn(want->name, "0123456789")]
                 ? hk_watched_read(list, "want", want->name)
                 : status;
    want->at[want->width] = hk_watched_find(list, axis);
  }
  return HOOKE_OK;
}

/* Ends a text before the blanks before `end`. */
static void trim(char *text, char *end) {
  while (end > text && end[-1] == ' ')
    end--;
  *end = '\0';
}

/* "energy=0.1J", or a length; the text is modified. */
static int32_t read_want(struct hk_watched_list *list, char *text, struct hk_want *want) {
  trim(text, text + strlen(text));
  char *value = strrchr(text, '=');
  hk_print(want->name, sizeof want->name, "%s", value ? text : "particles");
  if (text[0] == '\0')
    return hk_fail(HOOKE_BAD_VALUE, "want",
                   "nothing stands before or after a comma; allowed: QUANTITY=VALUE,...");
  if (value == NULL && text[strlen(text) - 1] == '%')
    return hk_fail(
        HOOKE_BAD_VALUE, "want",
        "%s of what? allowed: a length of all particles, such as 1mm, or a part of a quantity, such as "
        "tip=%s",
        text, text);
  if (value == NULL) return read_bound(text, "m", want);
  trim(want->name, want->name + (value - text));
  const int32_t status = read_name(list, want);
  if (status != HOOKE_OK) return status;
  return read_bound(value + 1 + strspn(value + 1, " "), hk_watched_unit(&list->item[want->at[0]]), want);
}

static int32_t read_list(struct hk_wants *wants, struct hk_watched_list *list, const char *text) {
  const hooke_system *system = list->system;
  int32_t status = hk_system_require_scene(system, "want", "a list ");
  const double size = hk_diagonal(system->particle_count, system->position);
  wants->list = list;
  wants->most = 1.0;
  wants->length = LEAST * (size > 0.0 ? size : 1.0);
  for (const char *at = text; status == HOOKE_OK && at;) {
    char one[HOOKE_WANT_NAME];
    at += strspn(at, " ");
    const size_t length = strcspn(at, ",");
    if (wants->count == HOOKE_WANTS || length >= sizeof one)
      return hk_fail(HOOKE_BAD_VALUE, "want", "is too much; allowed: %d quantities, each in %d characters",
                     HOOKE_WANTS, HOOKE_WANT_NAME - 1);
    hk_print(one, sizeof one, "%.*s", (int)length, at);
    struct hk_want *want = &wants->want[wants->count++];
    status = read_want(list, one, want);
    if (status == HOOKE_OK && want->width == 0) wants->length = want->bound;
    if (status == HOOKE_OK && want->width > 0) wants->whole |= list->item[want->at[0]].is_period;
    at = at[length] ? at + length + 1 : NULL;
  }
  return status;
}

int32_t hk_wants_read(struct hk_wants *wants, struct hk_watched_list *list, const hooke_options *options) {
  const double length = hooke_options_number(options, "want");
  const char *text = hooke_options_text(options, "want");
  *wants = (struct hk_wants){.most = length, .length = 1.0};
  if (text[0]) return read_list(wants, list, text);
  if (isnan(length)) return HOOKE_OK;
  wants->want[wants->count++] = (struct hk_want){.name = "particles", .bound = length};
  return HOOKE_OK;
}

int32_t hk_wants_of_each(struct hk_wants *wants, struct hk_watched_list *list, const char *text) {
  const int32_t status = hk_watched_read(list, "watch", text);
  const double bound = wants->most;
  *wants = (struct hk_wants){.list = list, .most = 1.0, .length = bound};
  for (int64_t k = 0; status == HOOKE_OK && k < list->count; k++) {
    const char *unit = hk_watched_unit(&list->item[k]);
    struct hk_want *want = &wants->want[wants->count++];
    if (strcmp(unit, "m") != 0 || wants->count == HOOKE_WANTS)
      return hk_fail(HOOKE_BAD_VALUE, "watch", "%s is in %s, which no length bounds; want %s=a number [%s]",
                     list->item[k].text, unit, list->item[k].text, unit);
    *want = (struct hk_want){.width = 1, .at = {k}, .bound = bound};
    hk_print(want->name, sizeof want->name, "%s", list->item[k].text);
  }
  return status;
}

const char *hk_wants_unit(const struct hk_wants *wants, const hooke_system *system) {
  return hk_wants_is_list(wants) ? " of what is wanted" : hk_metres(system);
}

int32_t hk_want_is_place(const struct hk_wants *wants, int32_t number) {
  const struct hk_want *want = &wants->want[number];
  const struct hk_watched *item = want->width > 0 ? &wants->list->item[want->at[0]] : NULL;
  return !item || (item->what->of == HOOKE_WATCHED_PARTICLE && !item->is_period);
}

const char *hk_want_unit(const struct hk_wants *wants, int32_t number) {
  const struct hk_want *want = &wants->want[number];
  return want->width > 0 ? hk_watched_unit(&wants->list->item[want->at[0]]) : "m";
}

/* ---- errors ---- */

static int32_t is_period(const struct hk_wants *wants, const struct hk_want *want) {
  return want->width > 0 && wants->list->item[want->at[0]].is_period;
}

void hk_wants_forget_periods(const struct hk_wants *wants, double most[1 + HOOKE_WANTS]) {
  for (int32_t k = 0; k < wants->count; k++)
    if (is_period(wants, &wants->want[k])) most[1 + k] = NAN;
}

/* Of every frame, or of every other one. */
static double period_of(const struct hk_watched_series *series, const struct hk_want *want, int64_t frames,
                        int64_t apart) {
  const double *value = hk_watched_series_of(series, want->at[0]);
  const int64_t count = (frames + apart - 1) / apart;
  double *part = hk_new(2 * count, sizeof *part), period = NAN;
  for (int64_t f = 0; part && f < count; f++) {
    part[f] = series->time[apart * f];
    part[count + f] = value[apart * f];
  }
  if (part) period = hk_watched_period(count, part, part + count);
  hk_free(part);
  return period;
}

/* The distance of a frame from that of another run (NULL: from 0). */
static double distance(const struct hk_want *want, const struct hk_watched_series *a, int64_t i,
                       const struct hk_watched_series *b, int64_t j) {
  double sum = 0.0, way = 0.0;
  for (int32_t k = 0; k < want->width; k++) {
    const double x = hk_watched_series_of(a, want->at[k])[i];
    way = b ? x - hk_watched_series_of(b, want->at[k])[j] : x;
    sum += way * way;
  }
  return want->width == 1 ? fabs(way) : sqrt(sum);
}

void hk_wants_bounds(const struct hk_wants *wants, const struct hk_watched_series *series, int64_t frames,
                     double bound[HOOKE_WANTS]) {
  for (int32_t k = 0; k < wants->count; k++) {
    const struct hk_want *want = &wants->want[k];
    double most = 0.0;
    for (int64_t f = 0; want->relative && f < frames && !is_period(wants, want); f++)
      most = fmax(most, distance(want, series, f, want->width == 3 ? series : NULL, 0));
    if (want->relative && is_period(wants, want)) most = period_of(series, want, frames, 1);
    bound[k] = want->relative ? want->bound * most : want->bound;
  }
}

int32_t hk_wants_require_values(const struct hk_wants *wants, const struct hk_watched_series *series,
                                int64_t frames, int64_t known) {
  double all[HOOKE_WANTS], first[HOOKE_WANTS];
  hk_wants_bounds(wants, series, frames, all);
  hk_wants_bounds(wants, series, known, first);
  for (int32_t k = 0; k < wants->count; k++)
    if (wants->want[k].relative && !(first[k] > FAR_BELOW * all[k]))
      return hk_fail(
          HOOKE_BAD_VALUE, "want",
          "%s: no run tells whether it is within %g %% of its largest value over the run: it has "
          "none (a period takes eight frames), or that is 0 or itself an error; want it as a number "
          "with a unit",
          wants->want[k].name, 100.0 * wants->want[k].bound);
  return HOOKE_OK;
}

void hk_wants_spread(const struct hk_wants *wants, const struct hk_watched_series *a, int64_t i,
                     const struct hk_watched_series *b, int64_t j, double far, double most[1 + HOOKE_WANTS]) {
  if (!(far <= most[0])) most[0] = far;
  for (int32_t k = 0; k < wants->count; k++) {
    const struct hk_want *want = &wants->want[k];
    double way = want->width == 0 ? far : 0.0;
    if (want->width > 0 && !is_period(wants, want)) way = distance(want, a, i, b, j);
    if (is_period(wants, want) && i == a->frames - 1 && j == b->frames - 1)
      way = fabs(period_of(b, want, b->frames, 1) - period_of(a, want, a->frames, 1));
    if (!(way <= most[1 + k]) && !isnan(most[1 + k])) most[1 + k] = way;
  }
}

const struct hk_column hk_want_columns[HOOKE_WANT_COLUMNS] = {
    HOOKE_COLUMN_AS(struct hk_want_found, name, quantity, TEXT, "", "quantity; particles: all free ones"),
    HOOKE_COLUMN(struct hk_want_found, unit, TEXT, "", "its unit"),
    HOOKE_COLUMN(struct hk_want_found, wanted, NUMBER, "of the quantity", "largest error that is wanted"),
    HOOKE_COLUMN(struct hk_want_found, error, NUMBER, "of the quantity",
                 "its error, NaN where it is not known"),
    HOOKE_COLUMN(struct hk_want_found, met, FLAG, "", "1 if it is within that; NaN where it is not known")};

void hk_wants_find(const struct hk_wants *wants, const struct hk_watched_series *a,
                   const struct hk_watched_series *b, int64_t recorded, int64_t frames, double far,
                   double own, struct hk_want_found found[HOOKE_WANTS]) {
  double bound[HOOKE_WANTS], error[1 + HOOKE_WANTS] = {0.0};
  hk_wants_bounds(wants, b, recorded, bound);
  for (int64_t f = 0; f < frames; f++)
    hk_wants_spread(wants, a, f, b, f, far, error);
  if (frames < b->frames) hk_wants_forget_periods(wants, error);
  for (int32_t k = 0; k < wants->count; k++) {
    const double most = error[1 + k] + own * (wants->list ? bound[k] : 1.0);
    found[k] = (struct hk_want_found){wants->want[k].name, hk_want_unit(wants, k), bound[k], most,
                                      isnan(most) ? NAN : most <= bound[k]};
  }
}

void hk_wants_claim(const struct hk_wants *wants, const struct hk_want_found found[HOOKE_WANTS],
                    enum hk_claim_of of, const char *by, const char *where, struct hk_claims *claims) {
  for (int32_t k = 0; k < wants->count && wants->list; k++) {
    const char *unit = found[k].unit, *blank = unit[0] ? " " : "";
    if (isnan(found[k].error))
      hk_claim(claims, "error", HOOKE_OF_UNKNOWN, by,
               "of %s it is not known: other runs do not tell it, or its value (a period takes eight frames)",
               found[k].name);
    else
      hk_claim(claims, "error", of, by, "of %s it is at most %.3g%s%s%s, where %.3g%s%s are wanted",
               found[k].name, found[k].error, blank, unit, where, found[k].wanted, blank, unit);
  }
}

/* From every other frame a period has about sixteen times the error of interpolation. */
double hk_want_doubt(const struct hk_wants *wants, int32_t number, const struct hk_watched_series *series) {
  const struct hk_want *want = &wants->want[number];
  if (!is_period(wants, want)) return 0.0;
  return fabs(period_of(series, want, series->frames, 2) - period_of(series, want, series->frames, 1));
}

double hk_wants_error(const struct hk_wants *wants, const double bound[HOOKE_WANTS],
                      const struct hk_watched_series *a, const struct hk_watched_series *b, int64_t frame,
                      double far) {
  double way[1 + HOOKE_WANTS] = {0.0}, most = 0.0;
  hk_wants_spread(wants, a, frame, b, frame, far, way);
  for (int32_t k = 0; k < wants->count && !isnan(most); k++)
    if (!(way[1 + k] <= most * bound[k])) most = way[1 + k] / bound[k];
  return wants->most * most;
}
