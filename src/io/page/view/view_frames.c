/* Frames of a page as bytes. */
#include "io/page/view/view.h"

#include "core/memory.h"
#include "core/status.h"
#include "io/hdf5/array_h5.h"
#include "io/trajectory/record.h"
#include "model/vector3.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Sample sizes and fractions for the colour scale: so many springs of each frame; so many of these, and of
 * the frames so many, have a strain within the scale. For a run that blew up only frames before that count
 * which are not much wider than the first, since later ones leave no colours for the others. */
enum { LOOKED_AT = 4096, WIDEST = 65535 };
static const double SPRING_SHARE = 0.98, FRAME_SHARE = 0.9, WIDENED = 8.0;

static const char position[] = "/particles/all/position/value";

int32_t hk_view_read(const struct hk_view *view, const char *dataset, int64_t frame, int64_t *rows,
                     int64_t columns, double **values) {
  int64_t there, wide;
  const char *path = hk_record_path(view->record);
  const int32_t status = hk_array_read(path, dataset, frame, frame >= 0, values, &there, &wide);
  if (status != HOOKE_OK) return status;
  if (there >= *rows && (wide == columns || there == 0)) {
    if (*rows < 0) *rows = there;
    return HOOKE_OK;
  }
  hk_free(*values);
  *values = NULL;
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "%s: dataset %s has %lld rows of %lld numbers, which do not fit the other datasets", path,
                 dataset, (long long)there, (long long)wide);
}

int64_t hk_view_frame_bytes(const struct hk_view *view) {
  return 6 * view->particles + 2 * view->springs;
}

static double elongation_of(const struct hk_view *view, const double *q, int64_t k) {
  const double *a = q + 3 * view->particle[view->end[2 * k]];
  const double *b = q + 3 * view->particle[view->end[2 * k + 1]];
  return hk_distance3(a, b) - view->rest_length[k * view->spring_stride];
}

/* NaN if it has no rest length. */
static double strain_of(const struct hk_view *view, const double *q, int64_t k) {
  const double rest = view->rest_length[k * view->spring_stride];
  return rest > 0.0 ? elongation_of(view, q, k) / rest : (double)NAN;
}

/* ---- the box ---- */

static void find_box(const struct hk_view *view, const double *q, struct hk_view_box *box) {
  for (int axis = 0; axis < 3; axis++) {
    double low = INFINITY, high = -INFINITY;
    for (int64_t k = 0; k < view->particles; k++) {
      const double x = q[3 * view->particle[k] + axis];
      if (!isfinite(x)) continue;
      low = fmin(low, x);
      high = fmax(high, x);
    }
    box->low[axis] = low <= high ? low : 0.0;
    box->high[axis] = low <= high ? high : 0.0;
  }
}

/* ---- the scale of colours ---- */

static int compare(const void *a, const void *b) {
  const double x = *(const double *)a, y = *(const double *)b;
  return (x > y) - (x < y);
}

/* Value of the given quantile. */
static double quantile(double *values, int64_t count, double fraction) {
  if (count == 0) return 0.0;
  qsort(values, (size_t)count, sizeof *values, compare);
  return values[(int64_t)(fraction * (double)(count - 1))];
}

/* 1, 2 or 5 times a power of ten, not below `value`. Only powers without a negative exponent are exact. */
static double round_up(double value) {
  const double exponent = floor(log10(value)), power = pow(10.0, fabs(exponent));
  const double head = exponent < 0.0 ? value * power : value / power;
  const double digit = head <= 1.0 ? 1.0 : head <= 2.0 ? 2.0 : head <= 5.0 ? 5.0 : 10.0;
  return exponent < 0.0 ? digit / power : digit * power;
}

static double largest_of_most(struct hk_view *view, const double *q, double *sizes) {
  const int64_t stride = 1 + (view->springs - 1) / LOOKED_AT;
  int64_t count = 0;
  for (int64_t k = 0; k < view->springs; k++) {
    const double strain = strain_of(view, q, k);
    if (!isfinite(strain)) continue;
    view->strain_low = fmin(view->strain_low, strain);
    view->strain_high = fmax(view->strain_high, strain);
    if (k % stride == 0) sizes[count++] = fabs(strain);
  }
  return quantile(sizes, count, SPRING_SHARE);
}

static int blew_up(const struct hk_view *view) {
  const char *status = hooke_record_text(view->record, "status");
  return strcmp(status, "finished") != 0 && strcmp(status, "stopped") != 0 && strcmp(status, "running") != 0;
}

/* Strains of one frame, if it is whole. */
struct strains {
  double *sizes, *largest, widest;
  int64_t count;
};

static void take_frame(struct hk_view *view, const double *q, int64_t k, int64_t frame, struct strains *s) {
  const struct hk_view_box *box = &view->box[k];
  const double most = largest_of_most(view, q, s->sizes);
  double extent = 0.0;
  find_box(view, q, &view->box[k]);
  for (int axis = 0; axis < 3; axis++)
    extent = fmax(extent, box->high[axis] - box->low[axis]);
  if (k == 0 && extent > 0.0 && blew_up(view)) s->widest = WIDENED * extent;
  if (k == 0 || (extent <= s->widest && frame < view->good_frames)) s->largest[s->count++] = most;
}

static int32_t look_at_frames(struct hk_view *view, struct strains *s) {
  int64_t whole = 0;
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < view->frames && status == HOOKE_OK; k++) {
    double *q = NULL;
    status = hk_view_read(view, position, view->frame[k], &view->particles_there, 3, &q);
    if (status == HOOKE_OK) {
      take_frame(view, q, whole, view->frame[k], s);
      view->frame[whole++] = view->frame[k];
    } else if (status == HOOKE_BAD_VALUE &&
               hooke_record_check(view->record, view->frame[k]) == HOOKE_BAD_VALUE) {
      view->damaged++;
      status = HOOKE_OK;
    }
    hk_free(q);
  }
  if (status == HOOKE_OK && whole == 0) /* with the message on the last of them */
    status = hooke_record_check(view->record, view->frame[view->frames - 1]);
  view->frames = whole;
  return status;
}

int32_t hk_view_find_strain(struct hk_view *view) {
  struct strains s = {.widest = INFINITY};
  s.sizes = hk_new(LOOKED_AT + 1, sizeof *s.sizes);
  s.largest = hk_new(view->frames, sizeof *s.largest);
  view->box = hk_new(view->frames, sizeof *view->box);
  int32_t status = s.sizes && s.largest && view->box ? HOOKE_OK : HOOKE_NO_MEMORY;
  view->strain_low = view->strain_high = NAN; /* which fmin() and fmax() pass over */
  if (status == HOOKE_OK) status = look_at_frames(view, &s);
  if (status == HOOKE_OK) {
    const double most = quantile(s.largest, s.count, FRAME_SHARE);
    const double any = fmax(-view->strain_low, view->strain_high); /* where most springs are slack */
    view->strain = most > 0.0 ? round_up(most) : any > 0.0 ? round_up(any) : 1.0;
  }
  hk_free(s.largest);
  hk_free(s.sizes);
  return status;
}

/* ---- packing ---- */

/* Halves, since the whole may overflow. */
static uint32_t place_in(double x, double low, double high) {
  const double span = 0.5 * high - 0.5 * low;
  if (!(span > 0.0) || !isfinite(x)) return 0;
  const double fraction = (0.5 * x - 0.5 * low) / span * WIDEST + 0.5;
  return fraction >= WIDEST ? WIDEST : fraction > 0.0 ? (uint32_t)fraction : 0;
}

static uint8_t *put(uint8_t *bytes, uint32_t word) {
  *bytes++ = (uint8_t)(word & 255);
  *bytes++ = (uint8_t)(word >> 8 & 255);
  return bytes;
}

uint32_t hk_view_float(double value) {
  const float narrow =
      fabs(value) > FLT_MAX ? copysignf(INFINITY, signbit(value) ? -1.0F : 1.0F) : (float)value;
  uint32_t word;
  memcpy(&word, &narrow, sizeof word);
  return word;
}

/* The upper half of a float, rounded to even: 8 significant bits. */
static uint32_t upper_half(double value) {
  const uint32_t word = hk_view_float(value);
  return isnan(value) ? word >> 16 : (word + 0x7fff + (word >> 16 & 1)) >> 16;
}

int32_t hk_view_pack(struct hk_view *view, int64_t at, uint8_t *bytes) {
  const struct hk_view_box *box = &view->box[at];
  double *q = NULL;
  const int32_t status = hk_view_read(view, position, view->frame[at], &view->particles_there, 3, &q);
  if (status != HOOKE_OK) return status;
  for (int64_t k = 0; k < 3 * view->particles; k++)
    bytes = put(bytes, place_in(q[3 * view->particle[k / 3] + k % 3], box->low[k % 3], box->high[k % 3]));
  for (int64_t k = 0; k < view->springs; k++)
    bytes = put(bytes, upper_half(elongation_of(view, q, k)));
  hk_free(q);
  return HOOKE_OK;
}

/* ---- bytes as text ---- */

enum { TRIPLES = 1024 }; /* at a time */

static const char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

int64_t hk_base64_length(int64_t bytes) {
  return (bytes + 2) / 3 * 4;
}

/* Three bytes are four digits; missing bytes give no digits. */
void hk_base64_add(struct hk_text *text, const uint8_t *bytes, int64_t count) {
  char piece[4 * TRIPLES];
  for (int64_t at = 0; at < count;) {
    int64_t length = 0;
    for (; at < count && length < (int64_t)sizeof piece; at += 3) {
      uint32_t word = 0;
      for (int k = 0; k < 3; k++)
        word = word << 8 | (at + k < count ? bytes[at + k] : 0);
      for (int k = 0; k < 4; k++)
        piece[length++] = at + k <= count ? digits[word >> (18 - 6 * k) & 63] : '=';
    }
    hk_text_add(text, piece, length);
  }
}
