/* Options of a run, and the schedule derived from them. */
#include "integrate/integrator.h"

#include "core/number.h"
#include "core/status.h"
#include "model/system.h"

#include <float.h>
#include <math.h>
#include <string.h>

static const struct hk_option_row run_rows[] = {
    HOOKE_OPTION("method", .type = HOOKE_OPTION_TEXT, "symplectic-euler",
                 "method, see docs/notes/methods.md"),
    HOOKE_OPTION("step", HOOKE_OPTION_POSITIVE("s"), NULL, "time step of a fixed-step method"),
    HOOKE_OPTION("duration", HOOKE_OPTION_POSITIVE("s"), NULL, "time to run, a whole multiple of step"),
    HOOKE_OPTION("every", HOOKE_OPTION_POSITIVE("s"), NULL,
                 "time between frames, a whole multiple of step; about "
                 "duration/100 if not given; the end is a frame, too"),
    HOOKE_OPTION(
        "checkpoint", HOOKE_OPTION_POSITIVE("s"), NULL,
        "time between checkpoints, from which a run can go on; error-controlled methods start anew at each"),
    HOOKE_OPTION("newton", HOOKE_OPTION_ONE_OF("converged one-iteration"), "converged",
                 "how backward-euler, tr-bdf2 and implicit-midpoint solve their equations: converged, or "
                 "one-iteration (linearised where they begin)"),
    HOOKE_OPTION("newton_tolerance", HOOKE_OPTION_UP_TO(NULL, 1.0), "0.02",
                 "error in the equations of a step of backward-euler, tr-bdf2 or implicit-midpoint at which "
                 "their iterations end, over the error that the step makes itself"),
    HOOKE_OPTION("verlet_damping", HOOKE_OPTION_ONE_OF("auto explicit implicit"), "auto",
                 "how verlet takes the damping of springs: at the predicted velocity (explicit), by solving "
                 "for it (implicit), or explicitly where that is stable for certain (auto)"),
    HOOKE_OPTION("rtol", HOOKE_OPTION_BETWEEN(1e-15, 0.1), "1e-6",
                 "relative tolerance of an error-controlled method"),
    HOOKE_OPTION("atol", HOOKE_OPTION_POSITIVE("m"), NULL,
                 "absolute tolerance of positions; 1e-3 rtol times the extent of the scene if not given"),
    HOOKE_OPTION("atol_velocity", HOOKE_OPTION_POSITIVE("m/s"), NULL,
                 "absolute tolerance of velocities; atol over the duration if not given"),
    HOOKE_OPTION("max_order", HOOKE_OPTION_WHOLE(1, 12), NULL,
                 "highest order that cvode-bdf (up to 5) or cvode-adams (up to 12) may use, or the order of "
                 "arkode-esdirk (3 to 5); if not given the highest, which cvode-bdf at rtol >= 1e-6 lowers "
                 "to 2 where stiff springs are weakly damped"),
    HOOKE_OPTION("linear_solver", HOOKE_OPTION_ONE_OF("auto direct blocks gmres"), "auto",
                 "how implicit methods solve their linear equations: by iterations after a sparse "
                 "factorisation (direct) or one of 3x3 blocks (blocks); by blocks, or with cvode-bdf and "
                 "arkode-esdirk as it pays (auto); with these two also by plain gmres"),
    HOOKE_OPTION("max_steps", HOOKE_OPTION_WHOLE(1, 9e15), NULL,
                 "steps that an error-controlled method may take in one run; no limit if not given"),
    HOOKE_OPTION("past_divergence", .type = HOOKE_OPTION_FLAG, "false",
                 "with a fixed step: goes on after the run diverged, to show how it blows up, until numbers "
                 "overflow or the duration is over; it counts as diverged all the same"),
    HOOKE_OPTION("frames_after", HOOKE_OPTION_WHOLE(0, 9e15), NULL,
                 "frames after the run diverged, at most; implies past_divergence"),
    HOOKE_OPTION(
        "threads", HOOKE_OPTION_WHOLE(1, 1024), "1",
        "most threads that may be used, as far as the scene is worth them; results do not depend on it"),
};

const struct hk_option_table hk_run_options = {"run", HOOKE_OPTION_ROWS(run_rows)};

int32_t hk_run_options_require(const hooke_options *options, const char *where) {
  return hk_options_require(options, &hk_run_options, where, "run");
}

/* ---- tolerances ---- */

static const double OF_EXTENT = 1e-3, LARGEST = 1e300;

int32_t hk_run_fill_tolerances(const hooke_system *system, hooke_options *options) {
  const double diagonal =
      system && !system->generalized ? hk_diagonal(system->particle_count, system->position) : 0.0;
  const double extent = diagonal > 0.0 ? diagonal : 1.0, rtol = hooke_options_number(options, "rtol");
  const double duration = hooke_options_number(options, "duration");
  double atol = hooke_options_number(options, "atol");
  int32_t status = HOOKE_OK;
  if (isnan(atol)) {
    atol = fmin(fmax(OF_EXTENT * rtol * extent, DBL_MIN), LARGEST);
    status = hooke_options_set_number(options, "atol", atol);
  }
  if (status != HOOKE_OK || hooke_options_is_set(options, "atol_velocity")) return status;
  const double per_second = isnan(duration) ? atol : atol / duration;
  return hooke_options_set_number(options, "atol_velocity", fmin(fmax(per_second, DBL_MIN), LARGEST));
}

/* ---- schedule ---- */

/* 1 if `value` is a whole multiple of `step` to 1e-9 relative, with the multiple in `count`. */
static int is_multiple(double value, double step, int64_t *count) {
  const double whole = round(value / step);
  *count = whole < (double)HOOKE_MOST_STEPS ? (int64_t)whole : 0;
  return whole >= 1.0 && whole < (double)HOOKE_MOST_STEPS && fabs(value - whole * step) <= 1e-9 * value;
}

/* The step nearest to `step`, from above or below, of which `value` and `other` (NaN: none) are whole
 * multiples; NaN if none is near. */
static double fitting_step(double value, double other, double step, int larger) {
  const double start = larger ? floor(value / step) : ceil(value / step);
  for (int64_t tries = 0; tries < 100000; tries++) {
    const double divisor = larger ? start - (double)tries : start + (double)tries;
    if (divisor < 1.0 || divisor > 9e15) break;
    int64_t count;
    if (isnan(other) || is_multiple(other, value / divisor, &count)) return value / divisor;
  }
  return NAN;
}

/* With all digits, since the steps are meant to be typed. */
static int32_t refuse_step(const char *name, double value, double other, double step) {
  char given[2][HOOKE_NUMBER_SIZE], low[HOOKE_NUMBER_SIZE], high[HOOKE_NUMBER_SIZE];
  hk_number_print(value, given[0]);
  hk_number_print(step, given[1]);
  if (!(value / step < (double)HOOKE_MOST_STEPS))
    return hk_fail(HOOKE_BAD_VALUE, name, "%s s takes too many steps of %s s; allowed: fewer than %lld",
                   given[0], given[1], (long long)HOOKE_MOST_STEPS);
  const double below = fitting_step(value, other, step, 0), above = fitting_step(value, other, step, 1);
  hk_number_print(isnan(below) ? above : below, low);
  hk_number_print(isnan(above) ? below : above, high);
  const int32_t none = isnan(above) && isnan(below), one = none || strcmp(low, high) == 0;
  return hk_fail(HOOKE_BAD_VALUE, name, "%s s is not a whole multiple of step %s s; %s%s%s%s", given[0],
                 given[1],
                 none  ? "no step near it fits"
                 : one ? "the nearest step that fits is "
                       : "the nearest steps that fit are ",
                 none ? "" : low, one ? "" : " and ", one ? "" : high);
}

static int32_t read_fixed(struct hk_schedule *s, double step) {
  if (isnan(step))
    return isnan(s->duration)
               ? hk_fail(
                     HOOKE_BAD_VALUE, "duration",
                     "is missing, and so is step; a run needs the time to run, > 0 [s], and single steps a step")
               : hk_fail(HOOKE_BAD_VALUE, "step", "is missing; this method needs a step > 0 [s]");
  if (!isnan(s->duration) && !is_multiple(s->duration, step, &s->steps)) {
    return refuse_step("duration", s->duration, s->every, step);
  }
  if (!isnan(s->every) && !is_multiple(s->every, step, &s->frame_steps)) {
    return refuse_step("every", s->every, s->duration, step);
  }
  return HOOKE_OK;
}

int64_t hk_schedule_frames(double duration, double every) {
  int64_t whole;
  if (is_multiple(duration, every, &whole)) return 1 + whole;
  return 1 + (int64_t)fmin(ceil(duration / every), (double)HOOKE_MOST_STEPS);
}

int32_t hk_schedule_has_frame(const struct hk_schedule *s, int64_t k) {
  return k % s->frame_steps == 0 || k == s->steps;
}

int64_t hk_schedule_frames_before(const struct hk_schedule *s, int64_t k) {
  return k / s->frame_steps + (k % s->frame_steps != 0);
}

static void count_frames(int32_t adaptive, struct hk_schedule *s) {
  /* NOLINTNEXTLINE(clang-analyzer-core.DivideZero): with a fixed step, every is a multiple of it, from 1
   * on */
  s->frames =
      adaptive ? hk_schedule_frames(s->duration, s->every) : 1 + hk_schedule_frames_before(s, s->steps);
}

static int32_t refuse_every(double every, double step) {
  char given[HOOKE_NUMBER_SIZE], of[HOOKE_NUMBER_SIZE], low[HOOKE_NUMBER_SIZE], high[HOOKE_NUMBER_SIZE];
  const double whole = floor(every / step);
  hk_number_print(every, given);
  hk_number_print(step, of);
  hk_number_print(whole * step, low);
  hk_number_print((whole + 1.0) * step, high);
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%s s is not a whole multiple of step %s s; the nearest %s %s%s%s s",
                 given, of, whole < 1.0 ? "is" : "are", whole < 1.0 ? "" : low, whole < 1.0 ? "" : " and ",
                 high);
}

int32_t hk_schedule_every(int32_t adaptive, double every, struct hk_schedule *s) {
  if (s->frames == 0)
    return hk_fail(HOOKE_BAD_VALUE, "duration", "is missing; give the time to run, > 0 [s]");
  if (isnan(every)) return HOOKE_OK;
  if (!adaptive && !is_multiple(every, s->step, &s->frame_steps)) return refuse_every(every, s->step);
  s->every = every;
  count_frames(adaptive, s);
  if (s->frames <= HOOKE_MOST_STEPS) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, NULL, "%g s gives %g times; allowed: up to 9e15", every,
                 s->duration / every);
}

int32_t hk_schedule_read(const struct hk_method *method, hooke_options *options, struct hk_schedule *s) {
  const double step = hooke_options_number(options, "step");
  *s = (struct hk_schedule){.step = step,
                            .duration = hooke_options_number(options, "duration"),
                            .every = hooke_options_number(options, "every"),
                            .checkpoint = hooke_options_number(options, "checkpoint")};
  s->every_given = !isnan(s->every);
  if (!method->adaptive) {
    const int32_t status = read_fixed(s, step);
    if (status != HOOKE_OK) return status;
    if (!isnan(s->checkpoint))
      s->checkpoint_steps = (int64_t)fmin(fmax(1.0, round(s->checkpoint / step)), 9e15);
  }
  if (isnan(s->duration)) return HOOKE_OK;
  if (isnan(s->every)) {
    s->frame_steps = isnan(step) ? 0 : (int64_t)fmax(1.0, round(s->duration / 100.0 / step));
    s->every = isnan(step) ? s->duration / 100.0 : (double)s->frame_steps * step;
    hooke_options_set_number(options, "every", s->every);
  }
  count_frames(method->adaptive, s);
  if (s->frames <= HOOKE_MOST_STEPS) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "every", "%.6g s gives %g frames; allowed: up to 9e15", s->every,
                 s->duration / s->every);
}
