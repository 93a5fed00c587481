/* The page of a limit: its contents as JSON. */
#include "core/status.h"
#include "io/page/picture.h"
#include "io/page/report.h"
#include "measure/limit/limit.h"

#include <math.h>

/* Points on a quarter of a curve; the corners of regions are at half of it. */
enum { QUARTER = 180 };
/* If nothing limits, a curve ends well outside of its diagram. */
static const double FAR = 100.0;
static const double RIGHT_ANGLE = 1.5707963267948966;

/* ---- regions ---- */

/* The boundary of what is stable, as x, y in turn, from a motion without damping to one without frequency. By
 * `lambda` the region of h lambda above the real axis, from the imaginary one to the left. */
static void add_boundary(struct hk_text *data, const char *key, const hooke_system *system,
                         const char *method, int by_lambda) {
  hk_text_open(data, key, '[');
  for (int k = 0; k <= QUARTER; k++) {
    const double decay = sin(RIGHT_ANGLE * k / QUARTER), swing = cos(RIGHT_ANGLE * k / QUARTER);
    const double reach = fmin(FAR, hk_limit_of_mode_in(system, method, by_lambda ? 1.0 : swing, decay));
    hk_text_number(data, NULL, reach * (by_lambda ? -decay : swing));
    hk_text_number(data, NULL, reach * (by_lambda ? swing : decay));
  }
  hk_text_close(data, ']');
}

void hk_limit_page_add_reach(struct hk_text *data, const hooke_system *system, const char *method) {
  if (isfinite(hk_limit_of_mode_in(system, method, 1.0, 0.5))) add_boundary(data, "reach", system, method, 0);
}

/* ---- rows ---- */

/* Columns with infinite numbers: nothing limits that step. */
static void add_unlimited(struct hk_text *data, const hooke_measurement *m, const struct hk_table *table,
                          int64_t row) {
  hk_text_open(data, "unlimited", '[');
  for (int32_t k = 0; k < table->column_count; k++) {
    const char *name = table->columns[k].name;
    if (isinf(hooke_measurement_number(m, table->name, row, name))) hk_text_word(data, NULL, name);
  }
  hk_text_close(data, ']');
}

static void add_row(struct hk_text *data, const hooke_measurement *m, const struct hk_table *table,
                    int64_t row) {
  const char *method = hooke_measurement_text(m, table->name, row, "method");
  const double alone = hk_limit_of_mode_in(m->system, method, 1.0, 0.5);
  hk_text_open(data, NULL, '{');
  hk_measurement_add_row(data, m, table->name, row);
  add_unlimited(data, m, table, row);
  hk_limit_page_add_reach(data, m->system, method);
  if (isfinite(alone) && hooke_measurement_number(m, table->name, row, "by_eigenvalue") == 1.0)
    add_boundary(data, "region", m->system, method, 1);
  hk_text_close(data, '}');
}

/* ---- the picture ---- */

/* First the limiting springs. */
static void choose(struct hk_picture *p, const struct hk_limit *limit) {
  for (int64_t k = 0; k < limit->participation.spring_count; k++)
    hk_picture_take(p, limit->participation.spring[k].spring);
  if (hk_picture_take_families(p, HOOKE_PICTURE_SPRINGS)) return;
  for (int64_t k = 0; k < limit->participation.particle_count; k++)
    hk_picture_show(p, limit->participation.particle[k].particle);
  hk_picture_show_evenly(p);
}

/* At the analysed positions. */
static int32_t add_picture(struct hk_text *data, const struct hk_limit *limit) {
  struct hk_picture p;
  const int32_t status = hk_picture_create(limit->system, &p);
  if (status == HOOKE_OK) {
    const double *move = hk_limit_limiting_row(limit) ? limit->shape : NULL;
    choose(&p, limit);
    hk_text_open(data, "picture", '{');
    hk_picture_add(data, &p);
    hk_picture_add_vectors(data, "position", limit->q, p.list, p.shown_count);
    hk_picture_add_vectors(data, "move", move, p.list, p.shown_count);
    hk_text_close(data, '}');
  }
  hk_picture_release(&p);
  return status;
}

int32_t hk_limit_page_add(struct hk_text *data, const hooke_measurement *m) {
  const struct hk_table *rows = hk_measurement_table(m->kind, "rows");
  if (isnan(hooke_measurement_number(m, "limit", 0, "frequency_max")))
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is nothing to report before the limits were found");
  hk_text_open(data, "rows", '[');
  for (int64_t row = 0; row < hk_measured_rows(m, rows); row++)
    add_row(data, m, rows, row);
  hk_text_close(data, ']');
  return add_picture(data, m->object);
}
