/* The table of an estimate. */
#include "measure/estimate/estimate.h"

#include <math.h>

struct line {
  double estimate, rms, known_until;
  const char *by;
  double wanted, met, energy_rise, heat_excess, last_piece, last_from, seconds, memory_bytes;
  const char *reason, *reversal;
};

/* States, and frames of times, energies and positions. */
static double memory_of(const struct hk_estimate *e) {
  if (e->options == NULL) return NAN;
  const double state = 2.0 * (double)e->kept.size + 1.0, frame = (double)e->kept.size + 2.0;
  return (double)sizeof(double) * (2.0 * state + (double)e->kept.count * frame);
}

static void read(const void *object, int64_t row, void *line) {
  const struct hk_estimate *e = object;
  (void)row;
  *(struct line *)line = (struct line){.estimate = e->error,
                                       .rms = e->rms,
                                       .known_until = e->known_until,
                                       .by = e->by,
                                       .wanted = e->want,
                                       .met = hk_estimate_met(e),
                                       .energy_rise = e->rise,
                                       .heat_excess = e->heat_excess,
                                       .last_piece = e->last_error,
                                       .last_from = e->last_from,
                                       .seconds = e->spent,
                                       .memory_bytes = memory_of(e),
                                       .reason = e->reason,
                                       .reversal = e->reversal};
}

#define COLUMN(member, kind, units, text) HOOKE_COLUMN(struct line, member, kind, units, text)

static const struct hk_column columns[] = {
    COLUMN(estimate, NUMBER, "m",
           "error of the run: distance of the farthest free particle, at any frame, from where it should be"),
    COLUMN(rms, NUMBER, "m", "its root mean square over free particles, at the worst frame"),
    COLUMN(known_until, NUMBER, "s",
           "time up to which that holds: the end of the run or, where the motion is not predictable that "
           "long, the time until which the reference can be trusted"),
    COLUMN(by, TEXT, "",
           "half-step, tolerance (of runs of the method at other steps or tolerances), other-method or "
           "reference; none without an estimate"),
    COLUMN(wanted, NUMBER, "m", "wanted error"),
    COLUMN(met, FLAG, "", "1 if the run meets it"),
    COLUMN(
        energy_rise, NUMBER, "",
        "spontaneous rise of energy over the last half of the run, as a fraction of the energy of the scene"),
    COLUMN(
        heat_excess, NUMBER, "",
        "energy that damping and drag dissipated, at the beginning or in the last slice, beyond the energy "
        "that was available, as such a fraction and as far as it is the heat of velocities that reverse at "
        "each step; unknown with callbacks or error control, or where there was no time to sum it"),
    COLUMN(
        last_piece, NUMBER, "m",
        "where the error is not known: what the last piece of the run added to it at the end, from a finer "
        "run of that piece"),
    COLUMN(last_from, NUMBER, "s", "start of that piece, whose end is that of the run"),
    COLUMN(seconds, NUMBER, "s", "time that picking and measuring took so far"),
    COLUMN(memory_bytes, COUNT, "bytes", "memory of the states that it keeps while the run goes on"),
    COLUMN(reason, TEXT, "", "why the error is not known, or why the wanted one is not met"),
    COLUMN(reversal, TEXT, "",
           "the times on this machine of the two best picks, where they would reverse the choice by more "
           "than 2"),
};

static const struct hk_table table = {
    .name = "estimate",
    .doc = "the error of the run",
    .record = 1,
    HOOKE_TABLE_COLUMNS(columns, struct line),
    .read = read,
};

const struct hk_table *const hk_estimate_tables[1] = {&table};
