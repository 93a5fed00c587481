/* The table of a view. */
#include "io/page/view/view.h"

#include <math.h>

struct line {
  double bytes, frames, frames_there, frame_stride, springs, springs_there, spring_stride, particles,
      particles_there, damaged, time_first, time_last, strain, strain_low, strain_high;
};

static double if_finite(double number) {
  return isfinite(number) ? number : (double)NAN;
}

static void read(const void *object, int64_t row, void *line) {
  const struct hk_view *view = object;
  (void)row;
  *(struct line *)line = (struct line){.bytes = view->bytes,
                                       .frames = (double)view->frames,
                                       .frames_there = (double)view->frames_there,
                                       .frame_stride = (double)view->frame_stride,
                                       .springs = (double)view->springs,
                                       .springs_there = (double)view->springs_there,
                                       .spring_stride = (double)view->spring_stride,
                                       .particles = (double)view->particles,
                                       .particles_there = (double)view->particles_there,
                                       .damaged = (double)view->damaged,
                                       .time_first = if_finite(view->time[0]),
                                       .time_last = if_finite(view->time[view->frame[view->frames - 1]]),
                                       .strain = if_finite(view->strain),
                                       .strain_low = if_finite(view->strain_low),
                                       .strain_high = if_finite(view->strain_high)};
}

#define COLUMN(member, kind, units, text) HOOKE_COLUMN(struct line, member, kind, units, text)

static const struct hk_column columns[] = {
    COLUMN(bytes, COUNT, "", "length of the page, once it is written"),
    COLUMN(frames, COUNT, "", "frames shown"),
    COLUMN(frames_there, COUNT, "", "frames of the trajectory"),
    COLUMN(frame_stride, COUNT, "", "k, where every k-th frame is shown"),
    COLUMN(springs, COUNT, "", "springs shown"),
    COLUMN(springs_there, COUNT, "", "springs of the trajectory"),
    COLUMN(spring_stride, COUNT, "", "k, where every k-th spring is shown"),
    COLUMN(particles, COUNT, "", "particles shown"),
    COLUMN(particles_there, COUNT, "", "particles of the trajectory"),
    COLUMN(damaged, COUNT, "", "damaged frames, which are skipped"),
    COLUMN(time_first, NUMBER, "s", "time of the first frame"),
    COLUMN(time_last, NUMBER, "s", "time of the last frame shown"),
    COLUMN(strain, NUMBER, "", "strain at the ends of the scale of colours"),
    COLUMN(strain_low, NUMBER, "", "lowest strain"),
    COLUMN(strain_high, NUMBER, "", "highest strain"),
};

const struct hk_table hk_view_table = {
    .name = "view",
    .doc = "what the page shows of the trajectory",
    .record = 1,
    HOOKE_TABLE_COLUMNS(columns, struct line),
    .read = read,
};
