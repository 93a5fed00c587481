/* The page of a limit: what it shows, as JSON. */
#include "core/status.h"
#include "hooke/io.h"
#include "io/page/limit_picture.h"
#include "io/page/report.h"
#include "measure/limit/limit.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* Points on a quarter of a curve; the corners of regions are at half of it. */
enum { QUARTER = 180 };
/* Where nothing limits, a curve ends well outside of its diagram. */
static const double FAR = 100.0;
static const double RIGHT_ANGLE = 1.5707963267948966;

struct request {
  const hooke_limit *limit;
  const hooke_state *state;
};

#define COUNT_OF(list) ((int)(sizeof(list) / sizeof((list)[0])))

/* ---- regions ---- */

static void add_point(struct hk_text *data, double x, double y) {
  hk_text_number(data, NULL, x);
  hk_text_number(data, NULL, y);
}

/* The edge of the region of h lambda, above the real axis, from the imaginary one to the left. */
static void add_region(struct hk_text *data, const char *method) {
  hk_text_open(data, "region", '[');
  for (int k = 0; k <= QUARTER; k++) {
    const double damping = sin(RIGHT_ANGLE * k / QUARTER), swing = cos(RIGHT_ANGLE * k / QUARTER);
    const double reach = hooke_limit_of_mode(method, 1.0, damping);
    add_point(data, -reach * damping, reach * swing);
  }
  hk_text_close(data, ']');
}

/* The edge of what is stable by h times frequency and h times decay. */
static void add_reach(struct hk_text *data, const char *method) {
  hk_text_open(data, "reach", '[');
  for (int k = 0; k <= QUARTER; k++) {
    const double decay = sin(RIGHT_ANGLE * k / QUARTER), frequency = cos(RIGHT_ANGLE * k / QUARTER);
    const double reach = fmin(FAR, hooke_limit_of_mode(method, frequency, decay));
    add_point(data, reach * frequency, reach * decay);
  }
  hk_text_close(data, ']');
}

/* ---- rows ---- */

static void add_row(struct hk_text *data, const hooke_limit *limit, int64_t row) {
  static const char *const steps[] = {"bound", "predicted", "measured", "smallest"};
  static const char *const numbers[] = {"ratio", "steps_run", "smallest_time", "exact", "never_stable"};
  const char *method = hooke_limit_text(limit, row, "method");
  const double alone = hooke_limit_of_mode(method, 1.0, 0.5);
  hk_text_open(data, NULL, '{');
  hk_text_word(data, "method", method);
  hk_text_word(data, "note", hooke_limit_text(limit, row, "note"));
  for (int k = 0; k < COUNT_OF(steps); k++)
    hk_report_add_step(data, steps[k], hooke_limit_number(limit, row, steps[k]));
  for (int k = 0; k < COUNT_OF(numbers); k++)
    hk_text_number(data, numbers[k], hooke_limit_number(limit, row, numbers[k]));
  if (isfinite(alone)) add_reach(data, method);
  if (isfinite(alone) && hooke_limit_number(limit, row, "by_eigenvalue") == 1.0) add_region(data, method);
  hk_text_close(data, '}');
}

static void add_rows(struct hk_text *data, const hooke_limit *limit) {
  hk_text_open(data, "rows", '[');
  for (int64_t row = 0; row < hooke_limit_row_count(limit); row++)
    add_row(data, limit, row);
  hk_text_close(data, ']');
}

/* ---- modes, and what they hang on ---- */

static void add_modes(struct hk_text *data, const hooke_limit *limit) {
  static const char *const numbers[] = {"real", "imaginary", "frequency", "decay"};
  hk_text_open(data, "modes", '{');
  for (int k = 0; k < COUNT_OF(numbers); k++) {
    hk_text_open(data, numbers[k], '[');
    for (int64_t mode = 0; mode < hooke_limit_mode_count(limit); mode++)
      hk_text_number(data, NULL, hooke_limit_mode_number(limit, mode, numbers[k]));
    hk_text_close(data, ']');
  }
  hk_text_close(data, '}');
}

static void add_blame(struct hk_text *data, const hooke_limit *limit) {
  static const char *const of_spring[] = {"spring", "first", "second", "share"};
  static const char *const of_particle[] = {"particle", "share", "mass"};
  hk_text_open(data, "blame", '[');
  for (int64_t place = 0; place < hooke_limit_blame_count(limit); place++) {
    if (hooke_limit_blame_text(limit, place, "force")[0]) continue; /* the remedy tells of it */
    hk_text_open(data, NULL, '{');
    for (int k = 0; k < COUNT_OF(of_spring); k++)
      hk_text_number(data, of_spring[k], hooke_limit_blame_number(limit, place, of_spring[k]));
    hk_text_word(data, "group", hooke_limit_blame_text(limit, place, "group"));
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
  hk_text_open(data, "movers", '[');
  for (int64_t place = 0; place < hooke_limit_mover_count(limit); place++) {
    hk_text_open(data, NULL, '{');
    for (int k = 0; k < COUNT_OF(of_particle); k++)
      hk_text_number(data, of_particle[k], hooke_limit_mover_number(limit, place, of_particle[k]));
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
  hk_text_word(data, "remedy", hooke_limit_remedy_text(limit, "sentence"));
}

/* ---- the page ---- */

/* The step that the scene names, for a method that takes it. */
static double own_step(const hooke_limit *limit) {
  if (limit->run == NULL || !hooke_options_is_set(limit->run, "step")) return NAN;
  if (hooke_method_is_adaptive(hooke_options_text(limit->run, "method")) != 0) return NAN;
  return hooke_options_number(limit->run, "step");
}

static void add_data(struct hk_text *data, const void *ctx) {
  static const char *const figures[] = {"frequency_max", "rate_max", "clamped"};
  const struct request *request = ctx;
  const hooke_limit *limit = request->limit;
  const struct hk_limit_row *blamed = hk_limit_blamed(limit);
  hk_text_number(data, "time", hooke_state_time(request->state));
  hk_text_number(data, "step", own_step(limit));
  hk_text_word(data, "method", limit->run ? hooke_options_text(limit->run, "method") : NULL);
  hk_text_word(data, "blamed", blamed ? blamed->method : NULL);
  for (int k = 0; k < COUNT_OF(figures); k++)
    hk_text_number(data, figures[k], hooke_limit_figure(limit, figures[k]));
  add_rows(data, limit);
  add_modes(data, limit);
  add_blame(data, limit);
  hk_limit_picture_add(data, limit, hooke_state_position((hooke_state *)request->state));
}

int32_t hooke_limit_write_report(const hooke_limit *limit, const hooke_state *state, const char *path,
                                 const char *scene) {
  const struct request request = {limit, state};
  const struct hk_report report = {"limit", scene, add_data, &request};
  if (isnan(hooke_limit_figure(limit, "frequency_max")))
    return hk_fail(HOOKE_BAD_CALL, NULL, "there is nothing to report before the limits were found");
  if (hooke_state_size(state) != 3 * hooke_system_particle_count(limit->system))
    return hk_fail(HOOKE_BAD_VALUE, "state", "is of another system than the limits");
  return hk_report_write(&report, path);
}
