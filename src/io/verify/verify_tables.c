/* The table of a verification. */
#include "io/verify/verify.h"

#include <math.h>
#include <stddef.h>

struct verify_line {
  const char *verdict, *difference, *run, *method, *balance, *parts;
  const char *version, *sundials, *cholmod, *instructions, *machine;
  const char *version_here, *sundials_here, *cholmod_here, *instructions_here, *machine_here;
  double frames, frames_checked, frame_first, frame_last, time_first, time_last, steps;
  double step, rtol, atol, step_limit, step_share;
  double work, energy_change, heat, residual, residual_refined, residual_bound, error_estimate;
  double check_scene, check_last;
};

/* Versions of the writer of the file, and of the verifying library. */
static void add_makers(const hooke_record *record, struct verify_line *line) {
  line->version = hooke_record_text(record, "version");
  line->sundials = hooke_record_text(record, "sundials");
  line->cholmod = hooke_record_text(record, "cholmod");
  line->instructions = hooke_record_text(record, "instructions");
  line->machine = hooke_record_text(record, "machine");
  line->version_here = hooke_version();
  line->sundials_here = hooke_build_fact("sundials");
  line->cholmod_here = hooke_build_fact("cholmod");
  line->instructions_here = hooke_build_fact("instructions");
  line->machine_here = hooke_build_fact("machine");
}

static void read_verify(const void *object, int64_t row, void *line) {
  const struct hk_verify *v = object;
  const hooke_options *run = hooke_record_options(v->record);
  const double step = v->fixed ? hooke_options_number(run, "step") : (double)NAN;
  (void)row;
  struct verify_line *made = line;
  *made = (struct verify_line){
      .verdict = v->verdict,
      .difference = v->difference,
      .run = hooke_record_text(v->record, "run"),
      .method = hooke_options_text(run, "method"),
      .balance = v->balance,
      .parts = v->parts,
      .frames = (double)hooke_record_count(v->record, "frames"),
      .frames_checked = (double)v->checked,
      .frame_first = (double)v->from,
      .frame_last = (double)v->to,
      .time_first = v->time_from,
      .time_last = v->time_to,
      .steps = v->steps,
      .step = step,
      .rtol = v->fixed ? (double)NAN : hooke_options_number(run, "rtol"),
      .atol = v->fixed ? (double)NAN : hooke_options_number(run, "atol"),
      .step_limit = v->limit,
      .step_share = step / v->limit,
      .work = v->work,
      .energy_change = v->energy_change,
      .heat = v->heat,
      .residual = v->residual,
      .residual_refined = v->residual_refined,
      .residual_bound = v->bound,
      .error_estimate = v->error,
      .check_scene = v->check_scene,
      .check_last = v->check_last,
  };
  add_makers(v->record, made);
}

static const struct hk_column columns[] = {
    HOOKE_COLUMN(struct verify_line, verdict, TEXT, "",
                 "agrees (to the bit), within-tolerance, disagrees or stopped; none before it was run"),
    HOOKE_COLUMN(struct verify_line, difference, TEXT, "", "message of a failure"),
    HOOKE_COLUMN(struct verify_line, run, TEXT, "", "name of the run"),
    HOOKE_COLUMN(struct verify_line, method, TEXT, "", "method of the run"),
    HOOKE_COLUMN(struct verify_line, balance, TEXT, "",
                 "holds, does-not-hold, unresolved (the step is too long to tell) or not-checked"),
    HOOKE_COLUMN(struct verify_line, parts, TEXT, "",
                 "scene, options, masses, springs, outcome and error by their check values: checked or "
                 "not-covered (an older file)"),
    HOOKE_COLUMN(struct verify_line, version, TEXT, "", "version of hooke that made the file"),
    HOOKE_COLUMN(struct verify_line, sundials, TEXT, "", "its SUNDIALS"),
    HOOKE_COLUMN(struct verify_line, cholmod, TEXT, "", "its CHOLMOD"),
    HOOKE_COLUMN(struct verify_line, instructions, TEXT, "", "its instruction set"),
    HOOKE_COLUMN(struct verify_line, machine, TEXT, "", "the machine that made the file"),
    HOOKE_COLUMN(struct verify_line, version_here, TEXT, "", "version of hooke that verifies it"),
    HOOKE_COLUMN(struct verify_line, sundials_here, TEXT, "", "its SUNDIALS"),
    HOOKE_COLUMN(struct verify_line, cholmod_here, TEXT, "", "its CHOLMOD"),
    HOOKE_COLUMN(struct verify_line, instructions_here, TEXT, "", "its instruction set"),
    HOOKE_COLUMN(struct verify_line, machine_here, TEXT, "", "this machine"),
    HOOKE_COLUMN(struct verify_line, frames, COUNT, "", "frames in the file"),
    HOOKE_COLUMN(struct verify_line, frames_checked, COUNT, "", "frames that have their check value"),
    HOOKE_COLUMN(struct verify_line, frame_first, COUNT, "", "first frame of the slice, counted from 0"),
    HOOKE_COLUMN(struct verify_line, frame_last, COUNT, "", "last frame of the slice"),
    HOOKE_COLUMN(struct verify_line, check_scene, COUNT, "", "CRC-32 of the text of the scene"),
    HOOKE_COLUMN(struct verify_line, check_last, COUNT, "",
                 "CRC-32 of positions and velocities of the last frame compared"),
    HOOKE_COLUMN(struct verify_line, steps, COUNT, "", "steps taken for the slice"),
    HOOKE_COLUMN(struct verify_line, time_first, NUMBER, "s", "time of the first frame of the slice"),
    HOOKE_COLUMN(struct verify_line, time_last, NUMBER, "s", "time of the last frame of the slice"),
    HOOKE_COLUMN(struct verify_line, step, NUMBER, "s", "step of a fixed-step method"),
    HOOKE_COLUMN(struct verify_line, rtol, NUMBER, "", "relative tolerance of an error-controlled method"),
    HOOKE_COLUMN(struct verify_line, atol, NUMBER, "m", "absolute tolerance of positions"),
    HOOKE_COLUMN(struct verify_line, step_limit, NUMBER, "s",
                 "largest stable step, predicted at the first frame"),
    HOOKE_COLUMN(struct verify_line, step_share, NUMBER, "", "step over the largest stable one"),
    HOOKE_COLUMN(struct verify_line, work, NUMBER, "J", "work of driven particles over the slice"),
    HOOKE_COLUMN(struct verify_line, energy_change, NUMBER, "J", "change of the energy over the slice"),
    HOOKE_COLUMN(struct verify_line, heat, NUMBER, "J", "energy that damping and drag turned into heat"),
    HOOKE_COLUMN(struct verify_line, residual, NUMBER, "J", "largest residual of the balance"),
    HOOKE_COLUMN(struct verify_line, residual_refined, NUMBER, "J",
                 "residual at the end of the slice with half the step"),
    HOOKE_COLUMN(struct verify_line, residual_bound, NUMBER, "J", "bound on the residual"),
    HOOKE_COLUMN(struct verify_line, error_estimate, NUMBER, "m",
                 "estimate of the error of any coordinate over the slice"),
};

static const struct hk_table table = {
    .name = "verify",
    .doc = "whether the trajectory reproduces from its scene, and what was compared",
    .record = 1,
    HOOKE_TABLE_COLUMNS(columns, struct verify_line),
    .read = read_verify,
};

const struct hk_table *const hk_verify_tables[HOOKE_VERIFY_TABLES] = {&table};
