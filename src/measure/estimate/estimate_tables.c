/* The table of an estimate. */
#include "measure/estimate/estimate.h"

struct line {
  double estimate, known_from, known_until;
  const char *by;
  double wanted, met, energy_rise, heat_excess, seconds;
  const char *note;
};

static void read(const void *object, int64_t row, void *line) {
  const struct hk_estimate *e = object;
  (void)row;
  *(struct line *)line = (struct line){.estimate = e->error,
                                       .known_from = e->known_from,
                                       .known_until = e->known_until,
                                       .by = e->by,
                                       .wanted = e->want,
                                       .met = hk_estimate_met(e),
                                       .energy_rise = e->rise,
                                       .heat_excess = e->heat_excess,
                                       .seconds = e->spent,
                                       .note = e->note};
}

#define COLUMN(member, kind, units, text) HOOKE_COLUMN(struct line, member, kind, units, text)

static const struct hk_column columns[] = {
    COLUMN(
        estimate, NUMBER, "m",
        "root mean square error over free particles: with a wanted error the largest over frames, otherwise "
        "that at the end"),
    COLUMN(known_from, NUMBER, "s", "start of the time that the error holds for"),
    COLUMN(known_until, NUMBER, "s",
           "its end: that of the run or, where the motion is not predictable that long, the time until which "
           "the reference can be trusted"),
    COLUMN(by, TEXT, "",
           "half-step, tolerance, slice (of a run at half the step or a hundredth of the tolerance) or "
           "reference; "
           "none without an estimate"),
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
    COLUMN(seconds, NUMBER, "s", "time that picking and measuring took so far"),
    COLUMN(note, TEXT, "", "why the error is not known, or why the wanted one is not met"),
};

static const struct hk_table table = {
    .name = "estimate",
    .doc = "the error of the run",
    .record = 1,
    HOOKE_TABLE_COLUMNS(columns, struct line),
    .read = read,
};

const struct hk_table *const hk_estimate_tables[1] = {&table};
