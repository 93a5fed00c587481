/* The page of a study: its contents as JSON. */
#include "io/page/report.h"

#include <math.h>
#include <stdio.h>

/* A curve over time has at most this many points; each is the maximum of the frames that it represents. */
enum { MOST_POINTS = 240 };

/* ---- curves over time ---- */

static int64_t point_count(int64_t frames) {
  return frames < MOST_POINTS ? frames : MOST_POINTS;
}

/* The first frame of a point; those of the last point end with the last frame. */
static int64_t first_frame(int64_t frames, int64_t point) {
  return point * frames / point_count(frames);
}

static void add_curve(struct hk_text *text, const hooke_measurement *m, const char *table, int64_t row,
                      const char *column) {
  int64_t frames;
  const double *value = hooke_measurement_series(m, table, row, column, &frames);
  hk_text_open(text, column, '[');
  for (int64_t k = 0; value && k < point_count(frames); k++) {
    double largest = NAN;
    for (int64_t f = first_frame(frames, k); f < first_frame(frames, k + 1); f++)
      largest = fmax(largest, fabs(value[f]));
    hk_text_number(text, NULL, largest);
  }
  hk_text_close(text, ']');
}

/* ---- the page ---- */

int32_t hk_study_page_add(struct hk_text *data, const hooke_measurement *m) {
  add_curve(data, m, "reference", 0, "time"); /* which rises: of each point the last */
  hk_text_open(data, "curves", '[');
  for (int64_t row = 0; row < hooke_measurement_row_count(m, "rows"); row++) {
    hk_text_open(data, NULL, '{');
    add_curve(data, m, "rows", row, "error_max_at");
    add_curve(data, m, "rows", row, "energy_drift_at");
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
  return HOOKE_OK;
}
