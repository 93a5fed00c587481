/* The tables of a diagnosis. */
#include "measure/limit/limit.h"
#include "measure/why/why.h"

#include <stddef.h>

/* ---- the cause ---- */

HOOKE_READER(const char *, left_out, struct hk_why, it->left_out[0] ? it->left_out : NULL)
HOOKE_COUNTER(count_causes, struct hk_why, it->cause != NULL)

/* ---- advice ---- */

HOOKE_READER(const char *, command, struct hk_why, it->measurement->label[HOOKE_LABEL_COMMAND + row])

/* ---- the tables ---- */

const struct hk_table hk_why_tables[] = {
    {.name = "why",
     .doc = "why the run ended early",
     .record = 1,
     .count = count_causes,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_why, cause, TEXT, "",
                      "step-above-limit, never-stable, collapsed-spring, force-not-finite, solver-failed, "
                      "overflow, model-gains-energy, or unknown (there was no time or memory to tell)"),
         HOOKE_COLUMN(struct hk_why, sentence, TEXT, "",
                      "what happened, where and when, in one or two sentences"),
         HOOKE_COLUMN(struct hk_why, method, TEXT, "", "method of the run"),
         HOOKE_COLUMN(struct hk_why, time, NUMBER, "s", "time of the last step within all bounds"),
         HOOKE_COLUMN(struct hk_why, noticed, NUMBER, "s", "time at which the run noticed"),
         HOOKE_COLUMN(struct hk_why, step, NUMBER, "s", "step of the run; NaN if the method chose its own"),
         HOOKE_COLUMN(struct hk_why, limit, NUMBER, "s",
                      "largest stable step, where the step was first seen above it"),
         HOOKE_COLUMN(struct hk_why, particle, COUNT, "", "the particle concerned"),
         HOOKE_COLUMN_BY(left_out, TEXT, "",
                         "what was not looked into for want of time or memory; none if nothing was"))},
    {.name = "blame", HOOKE_LIMITING_TABLE, HOOKE_TABLE_ROWS(struct hk_why, limiting.row, limiting.count)},
    {.name = "advice",
     .doc = "what to do, the best first; hooke_why_advice_apply() makes the change",
     HOOKE_TABLE_ROWS(struct hk_why, advice, advice_count),
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_why_advice, change, TEXT, "", "the change in words"),
         HOOKE_COLUMN(struct hk_why_advice, option, TEXT, "",
                      "run option that is the point of it; empty where the scene is to be changed"),
         HOOKE_COLUMN(struct hk_why_advice, value, TEXT, "", "its new value"),
         HOOKE_COLUMN(struct hk_why_advice, want, NUMBER, "m",
                      "a want with which `needs` tells what error the change makes, where that is not known"),
         HOOKE_COLUMN_BY(command, TEXT, "", "its command line, where the caller gave one as a label"))},
    {.name = NULL}};
