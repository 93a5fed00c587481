/* The table of a verification. */
#include "io/verify/verify.h"

#include <math.h>
#include <stddef.h>

/* An option of the run, which only methods of a fixed step have, or only the others. */
static double option_of(const struct hk_verify *verify, const char *name, int32_t fixed) {
  return verify->fixed == fixed ? hooke_options_number(hooke_record_options(verify->record), name) : NAN;
}

HOOKE_READER(const char *, run, struct hk_verify, hooke_record_text(it->record, "run"))
HOOKE_READER(const char *, method, struct hk_verify,
             hooke_options_text(hooke_record_options(it->record), "method"))
HOOKE_READER(double, frames, struct hk_verify, (double)hooke_record_count(it->record, "frames"))
HOOKE_READER(double, step, struct hk_verify, option_of(it, "step", 1))
HOOKE_READER(double, rtol, struct hk_verify, option_of(it, "rtol", 0))
HOOKE_READER(double, atol, struct hk_verify, option_of(it, "atol", 0))
HOOKE_READER(double, step_share, struct hk_verify, option_of(it, "step", 1) / it->limit)

/* ---- the tables ---- */

const struct hk_table hk_verify_tables[] = {
    {.name = "verify",
     .doc = "whether the trajectory reproduces from its scene, and what was compared",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_verify, verdict, TEXT, "",
                      "agrees (to the bit), within-tolerance, disagrees or stopped; none before it was run"),
         HOOKE_COLUMN(struct hk_verify, difference, TEXT, "", "message of a failure"),
         HOOKE_COLUMN_BY(run, TEXT, "", "name of the run"),
         HOOKE_COLUMN_BY(method, TEXT, "", "method of the run"),
         HOOKE_COLUMN(struct hk_verify, balance, TEXT, "",
                      "holds, does-not-hold, unresolved (the step is too long to tell) or not-checked"),
         HOOKE_COLUMN(struct hk_verify, parts, TEXT, "",
                      "scene, options, masses, springs, outcome and error by their check values: checked "
                      "or not-covered (an older file)"),
         HOOKE_COLUMN_AS(struct hk_verify, made_by[0], version, TEXT, "",
                         "version of hooke that made the file"),
         HOOKE_COLUMN_AS(struct hk_verify, made_by[1], sundials, TEXT, "", "its SUNDIALS"),
         HOOKE_COLUMN_AS(struct hk_verify, made_by[2], cholmod, TEXT, "", "its CHOLMOD"),
         HOOKE_COLUMN_AS(struct hk_verify, made_by[3], instructions, TEXT, "", "its instruction set"),
         HOOKE_COLUMN_AS(struct hk_verify, made_by[4], machine, TEXT, "", "the machine that made the file"),
         HOOKE_COLUMN_AS(struct hk_verify, made_by[5], blas, TEXT, "", "its BLAS"),
         HOOKE_COLUMN_AS(struct hk_verify, here[0], version_here, TEXT, "",
                         "version of hooke that verifies it"),
         HOOKE_COLUMN_AS(struct hk_verify, here[1], sundials_here, TEXT, "", "its SUNDIALS"),
         HOOKE_COLUMN_AS(struct hk_verify, here[2], cholmod_here, TEXT, "", "its CHOLMOD"),
         HOOKE_COLUMN_AS(struct hk_verify, here[3], instructions_here, TEXT, "", "its instruction set"),
         HOOKE_COLUMN_AS(struct hk_verify, here[4], machine_here, TEXT, "", "this machine"),
         HOOKE_COLUMN_AS(struct hk_verify, here[5], blas_here, TEXT, "", "its BLAS"),
         HOOKE_COLUMN_BY(frames, COUNT, "", "frames in the file"),
         HOOKE_COLUMN_AS(struct hk_verify, checked, frames_checked, COUNT, "",
                         "frames that have their check value"),
         HOOKE_COLUMN_AS(struct hk_verify, from, frame_first, COUNT, "",
                         "first frame of the slice, counted from 0"),
         HOOKE_COLUMN_AS(struct hk_verify, to, frame_last, COUNT, "", "last frame of the slice"),
         HOOKE_COLUMN(struct hk_verify, check_scene, COUNT, "", "CRC-32 of the text of the scene"),
         HOOKE_COLUMN(struct hk_verify, check_last, COUNT, "",
                      "CRC-32 of positions and velocities of the last frame compared"),
         HOOKE_COLUMN(struct hk_verify, steps, COUNT, "", "steps taken for the slice"),
         HOOKE_COLUMN_AS(struct hk_verify, time_from, time_first, NUMBER, "s",
                         "time of the first frame of the slice"),
         HOOKE_COLUMN_AS(struct hk_verify, time_to, time_last, NUMBER, "s",
                         "time of the last frame of the slice"),
         HOOKE_COLUMN_BY(step, NUMBER, "s", "step of a fixed-step method"),
         HOOKE_COLUMN_BY(rtol, NUMBER, "", "relative tolerance of an error-controlled method"),
         HOOKE_COLUMN_BY(atol, NUMBER, "m", "absolute tolerance of positions"),
         HOOKE_COLUMN_AS(struct hk_verify, limit, step_limit, NUMBER, "s",
                         "largest stable step, predicted at the first frame"),
         HOOKE_COLUMN_BY(step_share, NUMBER, "", "step over the largest stable one"),
         HOOKE_COLUMN(struct hk_verify, work, NUMBER, "J", "work of driven particles over the slice"),
         HOOKE_COLUMN(struct hk_verify, energy_change, NUMBER, "J", "change of the energy over the slice"),
         HOOKE_COLUMN(struct hk_verify, heat, NUMBER, "J", "energy that damping and drag turned into heat"),
         HOOKE_COLUMN(struct hk_verify, residual, NUMBER, "J", "largest residual of the balance"),
         HOOKE_COLUMN(struct hk_verify, residual_refined, NUMBER, "J",
                      "residual at the end of the slice with half the step"),
         HOOKE_COLUMN_AS(struct hk_verify, bound, residual_bound, NUMBER, "J", "bound on the residual"),
         HOOKE_COLUMN_AS(struct hk_verify, error, error_estimate, NUMBER, "m",
                         "estimate of the error of any coordinate over the slice"))},
    {.name = NULL}};
