/* The table of a view. */
#include "io/page/view/view.h"

#include <math.h>

static double time_of(const struct hk_view *view, int64_t frame) {
  return isfinite(view->time[frame]) ? view->time[frame] : (double)NAN;
}

HOOKE_READER(double, time_first, struct hk_view, time_of(it, 0))
HOOKE_READER(double, time_last, struct hk_view, time_of(it, it->frame[it->frames - 1]))

const struct hk_table hk_view_tables[] = {
    {.name = "view",
     .doc = "what the page shows of the trajectory",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_view, bytes, COUNT, "", "length of the page, once it is written"),
         HOOKE_COLUMN(struct hk_view, frames, COUNT, "", "frames shown"),
         HOOKE_COLUMN(struct hk_view, frames_there, COUNT, "", "frames of the trajectory"),
         HOOKE_COLUMN(struct hk_view, frame_stride, COUNT, "", "k, where every k-th frame is shown"),
         HOOKE_COLUMN(struct hk_view, springs, COUNT, "", "springs shown"),
         HOOKE_COLUMN(struct hk_view, springs_there, COUNT, "", "springs of the trajectory"),
         HOOKE_COLUMN(struct hk_view, spring_stride, COUNT, "", "k, where every k-th spring is shown"),
         HOOKE_COLUMN(struct hk_view, particles, COUNT, "", "particles shown"),
         HOOKE_COLUMN(struct hk_view, particles_there, COUNT, "", "particles of the trajectory"),
         HOOKE_COLUMN(struct hk_view, damaged, COUNT, "", "damaged frames, which are skipped"),
         HOOKE_COLUMN_BY(time_first, NUMBER, "s", "time of the first frame"),
         HOOKE_COLUMN_BY(time_last, NUMBER, "s", "time of the last frame shown"),
         HOOKE_COLUMN(struct hk_view, strain, NUMBER, "", "strain at the ends of the scale of colours"),
         HOOKE_COLUMN(struct hk_view, strain_low, NUMBER, "", "lowest strain"),
         HOOKE_COLUMN(struct hk_view, strain_high, NUMBER, "", "highest strain"))},
    {.name = NULL}};
