#include "model/force/scaling.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "model/force/spring.h"

#include <string.h>

/* ---- options ---- */

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("motion", HOOKE_OPTION_ONE_OF("harmonic table"), NULL, "how it follows time", .required = 1,
                 .example = "harmonic"),
    HOOKE_OPTION("mean", .type = HOOKE_OPTION_NUMBER, "1", "value that it oscillates about",
                 .only = "harmonic"),
    HOOKE_OPTION("amplitude", .type = HOOKE_OPTION_NUMBER, NULL, "largest difference from it", .required = 1,
                 .only = "harmonic", .example = "0.1"),
    HOOKE_COURSE_OPTIONS(NULL, "1", "0,10"),
    HOOKE_OPTION("value", HOOKE_OPTION_COUNTED(2, 0), NULL,
                 "factor at each time, monotone between and held beyond", .required = 1, .only = "table",
                 .example = "1,0.5"),
};

const struct hk_option_table hk_scale_options = {"factor in time", HOOKE_OPTION_ROWS(rows)};

double hk_scale_number(const hooke_options *options, const char *name) {
  return hk_options_has_family(options, name) ? 1.0 : hooke_options_number(options, name);
}

static int32_t check_range(const struct hk_course *course, const char *name, int32_t above_zero) {
  double low, high;
  const int64_t k = hk_course_range(course, &low, &high);
  const char *bound = above_zero ? ">" : ">=";
  if ((above_zero ? low > 0.0 : low >= 0.0) && high <= 1e300) return HOOKE_OK;
  hk_fail(HOOKE_BAD_VALUE, NULL, "the factor reaches %g; allowed: %s 0 up to 1e300 at all times",
          high <= 1e300 ? low : high, bound);
  if (k < 0) return hk_fail_within(HOOKE_BAD_VALUE, "%s.amplitude", name);
  return hk_fail_within(HOOKE_BAD_VALUE, "%s.value[%lld]", name, (long long)k);
}

static int32_t read(const hooke_options *options, const char *name, int32_t above_zero,
                    struct hk_course *course) {
  char prefix[64];
  *course = (struct hk_course){.width = 1, .mean = {1.0}};
  if (!hk_options_has_family(options, name)) return HOOKE_OK;
  hk_print(prefix, sizeof prefix, "%s.mean", name);
  course->mean[0] = hooke_options_number(options, prefix);
  hk_print(prefix, sizeof prefix, "%s.", name);
  const int32_t status =
      hk_course_from_options(course, options, prefix, "amplitude", "value", hk_monotone_slopes);
  return status == HOOKE_OK ? check_range(course, name, above_zero) : status;
}

int32_t hk_scaling_create(const hooke_options *options, int32_t strain, struct hk_scaling **scaling) {
  *scaling = NULL;
  if (!hk_options_has_family(options, "rest_scale") && !hk_options_has_family(options, "stiffness_scale"))
    return HOOKE_OK;
  struct hk_scaling *made = *scaling = hk_new(1, sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  made->strain = strain;
  const int32_t status = read(options, "rest_scale", 1, &made->rest);
  return status == HOOKE_OK ? read(options, "stiffness_scale", 0, &made->stiffness) : status;
}

int32_t hk_scaling_copy(const struct hk_scaling *from, struct hk_scaling **copy) {
  *copy = from ? hk_new(1, sizeof **copy) : NULL;
  if (*copy == NULL) return from ? HOOKE_NO_MEMORY : HOOKE_OK;
  (*copy)->strain = from->strain;
  const int32_t status = hk_course_copy(&from->rest, &(*copy)->rest);
  return status == HOOKE_OK ? hk_course_copy(&from->stiffness, &(*copy)->stiffness) : status;
}

void hk_scaling_release(struct hk_scaling *scaling) {
  if (scaling == NULL) return;
  hk_course_release(&scaling->rest);
  hk_course_release(&scaling->stiffness);
  hk_free(scaling);
}

int64_t hk_scaling_memory(const struct hk_scaling *scaling) {
  if (scaling == NULL) return 0;
  const int64_t samples = scaling->rest.samples + scaling->stiffness.samples;
  return (int64_t)sizeof *scaling + 3 * samples * (int64_t)sizeof(double);
}

void hk_scaling_check(const struct hk_scaling *scaling, uint32_t *value) {
  hk_course_check(&scaling->rest, value);
  hk_course_check(&scaling->stiffness, value);
}

/* ---- factors ---- */

void hk_scaler_find(struct hk_scaler *scaler, const struct hk_scaling *scaling) {
  double s = 1.0, r = 1.0, ds = 0.0, dr = 0.0;
  scaler->of = scaling;
  if (isinf(scaler->t)) { /* the stiffest */
    double other;
    hk_course_range(&scaling->rest, &r, &other);
    hk_course_range(&scaling->stiffness, &other, &s);
  } else if (!isnan(scaler->t)) {
    hk_course_at(&scaling->stiffness, scaler->t, &s, &ds);
    hk_course_at(&scaling->rest, scaler->t, &r, &dr);
  }
  scaler->force = s;
  scaler->force_rate = ds;
  const double divisor = scaling->strain ? r : 1.0, shrinking = scaling->strain ? dr / r : 0.0;
  scaler->by = (struct hk_material){s / divisor, 1.0 / divisor, r};
  scaler->rate = (struct hk_material){(ds - s * shrinking) / divisor, -shrinking / divisor, dr};
}

/* ---- runs ---- */

void hk_begin_runs(const struct hk_springs *springs, double t, struct hk_run_walk *walk) {
  walk->springs = springs;
  walk->next = walk->done = 0;
  walk->scaler = (struct hk_scaler){.t = t};
}

static void scale_shared(const struct hk_run *run, struct hk_run_walk *walk) {
  const struct hk_material m = hk_scaled(hk_run_material(run, 0), run->scaling, &walk->scaler);
  walk->run = *run;
  walk->run.kappa = m.kappa;
  walk->run.gamma = m.gamma;
  walk->run.rest_length = m.rest_length;
  walk->run.scale = run->scale * walk->scaler.force;
}

static void scale_piece(const struct hk_run *run, int64_t done, int64_t count, struct hk_run_walk *walk) {
  for (int64_t k = 0; k < count; k++) {
    const struct hk_material m = hk_scaled(hk_run_material(run, done + k), run->scaling, &walk->scaler);
    walk->kappa[k] = m.kappa;
    walk->gamma[k] = m.gamma;
    walk->rest_length[k] = m.rest_length;
  }
  walk->run = *run;
  walk->run.first += done;
  walk->run.count = count;
  walk->run.start += (int32_t)done;
  if (run->head) walk->run.head += done, walk->run.tail += done;
  walk->run.kappas = walk->kappa;
  walk->run.gammas = walk->gamma;
  walk->run.rest_lengths = walk->rest_length;
  walk->run.scale = run->scale * walk->scaler.force;
  walk->run.slot = NULL;
  walk->run.batch = NULL;
}

const struct hk_run *hk_next_run(struct hk_run_walk *walk) {
  if (walk->next == walk->springs->run_count) return NULL;
  const struct hk_run *run = &walk->springs->run[walk->next];
  const int64_t left = run->count - walk->done;
  const int mixed = (run->shape & HOOKE_RUN_MIXED) != 0;
  if (run->scaling && !mixed) scale_shared(run, walk);
  if (run->scaling && mixed && left > HOOKE_RUN_PIECE) {
    scale_piece(run, walk->done, HOOKE_RUN_PIECE, walk);
    walk->done += HOOKE_RUN_PIECE;
    return &walk->run;
  }
  if (run->scaling && mixed) scale_piece(run, walk->done, left, walk);
  walk->next++;
  walk->done = 0;
  return run->scaling ? &walk->run : run;
}
