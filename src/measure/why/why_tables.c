/* The tables of a diagnosis. */
#include "measure/limit/limit.h"
#include "measure/why/why.h"

#include <math.h>
#include <stddef.h>

/* ---- the cause ---- */

struct why_line {
  const char *cause, *sentence, *method, *left_out;
  double time, noticed, step, limit, particle;
};

static int64_t count_causes(const void *object) {
  return ((const struct hk_why *)object)->cause != NULL;
}

static void read_why(const void *object, int64_t row, void *line) {
  const struct hk_why *why = object;
  (void)row;
  *(struct why_line *)line = (struct why_line){.cause = why->cause,
                                               .sentence = why->sentence,
                                               .method = why->method,
                                               .time = why->time,
                                               .noticed = why->noticed,
                                               .step = why->step,
                                               .limit = why->limit,
                                               .particle = why->particle,
                                               .left_out = why->left_out[0] ? why->left_out : NULL};
}

static const struct hk_column why_columns[] = {
    HOOKE_COLUMN(
        struct why_line, cause, TEXT, "",
        "step-above-limit, never-stable, collapsed-spring, force-not-finite, solver-failed, overflow, "
        "model-gains-energy, or unknown (there was no time or memory to tell)"),
    HOOKE_COLUMN(struct why_line, sentence, TEXT, "",
                 "what happened, where and when, in one or two sentences"),
    HOOKE_COLUMN(struct why_line, method, TEXT, "", "method of the run"),
    HOOKE_COLUMN(struct why_line, time, NUMBER, "s", "time of the last step within all bounds"),
    HOOKE_COLUMN(struct why_line, noticed, NUMBER, "s", "time at which the run noticed"),
    HOOKE_COLUMN(struct why_line, step, NUMBER, "s", "step of the run; NaN if the method chose its own"),
    HOOKE_COLUMN(struct why_line, limit, NUMBER, "s",
                 "largest stable step, where the step was first seen above it"),
    HOOKE_COLUMN(struct why_line, particle, COUNT, "", "the particle concerned"),
    HOOKE_COLUMN(struct why_line, left_out, TEXT, "",
                 "what was not looked into for want of time or memory; none if nothing was"),
};

static const struct hk_table why_table = {
    .name = "why",
    .doc = "why the run ended early",
    .record = 1,
    HOOKE_TABLE_COLUMNS(why_columns, struct why_line),
    .count = count_causes,
    .read = read_why,
};

/* ---- limiting springs ---- */

static double if_spring(const struct hk_why_limiting *limiting, int64_t number) {
  return limiting->spring < 0 ? NAN : (double)number;
}

static void read_limiting(const void *object, int64_t row, void *line) {
  const struct hk_why_limiting *b = &((const struct hk_why *)object)->limiting[row];
  *(struct hk_limiting_line *)line = (struct hk_limiting_line){.number = if_spring(b, b->spring),
                                                               .first = if_spring(b, b->first),
                                                               .second = if_spring(b, b->second),
                                                               .group = b->group,
                                                               .share = b->share,
                                                               .force = b->force[0] ? b->force : NULL};
}

static const struct hk_table limiting_table = {
    .name = "blame",
    HOOKE_LIMITING_TABLE,
    HOOKE_TABLE_COUNT(struct hk_why, limiting_count),
    .read = read_limiting,
};

/* ---- advice ---- */

struct advice_line {
  const char *change, *option, *value;
};

static void read_advice(const void *object, int64_t row, void *line) {
  const struct hk_why_advice *advice = &((const struct hk_why *)object)->advice[row];
  *(struct advice_line *)line =
      (struct advice_line){.change = advice->change, .option = advice->option, .value = advice->value};
}

static const struct hk_column advice_columns[] = {
    HOOKE_COLUMN(struct advice_line, change, TEXT, "", "the change in words"),
    HOOKE_COLUMN(struct advice_line, option, TEXT, "",
                 "run option that is the point of it; empty where the scene is to be changed"),
    HOOKE_COLUMN(struct advice_line, value, TEXT, "", "its new value"),
};

static const struct hk_table advice_table = {
    .name = "advice",
    .doc = "what to do, the best first; hooke_why_advice_apply() makes the change",
    HOOKE_TABLE_COLUMNS(advice_columns, struct advice_line),
    HOOKE_TABLE_COUNT(struct hk_why, advice_count),
    .read = read_advice,
};

/* ---- the list ---- */

const struct hk_table *const hk_why_tables[HOOKE_WHY_TABLES] = {&why_table, &limiting_table, &advice_table};
