/* What a limit says of its results: of the state that it was taken at, and with "along" of a run's frames. */
#include "core/print.h"
#include "measure/limit/contact.h"
#include "measure/limit/limit.h"
#include "model/force/spring.h"
#include "model/particles.h"

#include <math.h>
#include <string.h>

struct teller {
  const struct hk_limit *limit;
  struct hk_claims *claims;
  const char *by;
};

/* A claim about that state. */
#define say(t, key, of, format, ...)                                                                         \
  hk_claim((t)->claims, key, of, (t)->by, "at t = %.6g s, " format, (t)->limit->time, __VA_ARGS__)

/* Of the method that the limiting springs are of. */
static void tell_limit(const struct teller *t, const struct hk_limit_row *row) {
  char predicted[96] = "at no step", measured[64] = "";
  if (row->predicted > 0.0 && row->exact)
    hk_print(predicted, sizeof predicted, "up to %.6g s", row->predicted);
  else if (row->predicted > 0.0)
    hk_print(predicted, sizeof predicted, "up to a step between %.6g and %.6g s", fmax(row->bound, 0.0),
             row->predicted);
  if (isinf(row->measured))
    hk_print(measured, sizeof measured, ", by runs at every step");
  else if (!isnan(row->measured))
    hk_print(measured, sizeof measured, row->measured > 0.0 ? ", by runs up to %.6g s" : ", by runs at none",
             row->measured);
  say(t, "limit", HOOKE_OF_PART, "%s is stable %s%s", row->method, predicted, measured);
}

/* The first row has the method of the run, or the first one asked for. */
static void tell_along(const struct teller *t, const struct hk_limit_row *row) {
  char frames[64] = "that were reached";
  if (row == NULL || !isfinite(row->smallest)) return;
  if (!isnan(t->limit->time)) hk_print(frames, sizeof frames, "up to t = %.6g s", t->limit->time);
  hk_claim(t->claims, "along", HOOKE_OF_PART, t->by,
           "at the frames %s the smallest limit of %s is %.6g s, at t = %.6g s", frames, row->method,
           row->smallest, row->smallest_time);
}

static void tell_none(const struct teller *t) {
  int32_t known = 1;
  for (int32_t k = 0; k < t->limit->row_count; k++)
    known &= isinf(t->limit->row[k].predicted) != 0;
  say(t, "limit", known ? HOOKE_OF_PART : HOOKE_OF_UNKNOWN, "%s",
      known ? "nothing limits the step of any of these methods"
            : "no limit of the step of these methods is known");
}

static void tell_left_out(const struct teller *t) {
  if (t->limit->clamped > 0)
    say(t, "compressed", HOOKE_OF_PART,
        "springs under compression: %lld; what pushes their ends sideways is growth by physics, and left out",
        (long long)t->limit->clamped);
  if (t->limit->tipping > 0)
    say(t, "tipping", HOOKE_OF_PART,
        "rigid bodies tipped over by gravity or tensions: %lld; that is growth by physics, and left out",
        (long long)t->limit->tipping);
  const struct hk_curved curved = hk_springs_curved(t->limit->system->springs, t->limit->time, t->limit->q);
  if (curved.fall > 0)
    say(t, "falling", HOOKE_OF_PART,
        "springs with a curve that falls: %lld, and there now: %lld; that is negative stiffness, by which motion "
        "grows at any step, and left out",
        (long long)curved.fall, (long long)curved.falling);
  if (curved.unbounded > 0)
    say(t, "curves", HOOKE_OF_PART,
        "springs whose curve has no largest stiffness: %lld; limits and bounds are those of this state",
        (long long)curved.unbounded);
}

/* 1 if a number of the row was asked for and not found. */
static int lacks(const struct hk_limit_row *row) {
  return isnan(row->predicted) || row->unknown > 0 || (!isnan(row->steps_run) && isnan(row->measured));
}

/* Of row `first` and those after it with the same note. */
static void tell_note(const struct teller *t, int32_t first) {
  const struct hk_limit_row *row = t->limit->row;
  char names[256] = "";
  int32_t unknown = 0;
  for (int32_t k = first; k < t->limit->row_count; k++) {
    if (strcmp(row[k].note, row[first].note) != 0) continue;
    hk_append(names, sizeof names, "%s%s", names[0] ? ", " : "", row[k].method);
    unknown |= lacks(&row[k]);
  }
  hk_claim(t->claims, "note", unknown ? HOOKE_OF_UNKNOWN : HOOKE_OF_PART, t->by, "%s at t = %.6g s: %s",
           names, t->limit->time, row[first].note);
}

void hk_limit_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_limit *limit = measurement->object;
  const struct hk_limit_row *row = hk_limit_limiting_row(limit);
  const struct teller t = {limit, claims,
                           row && !isnan(row->measured) ? "eigenvalues and runs" : "eigenvalues"};
  tell_along(&t, row ? row : limit->row_count > 0 ? limit->row : NULL);
  if (!limit->found)
    hk_claim(claims, "limit", HOOKE_OF_UNKNOWN, t.by, "the search for limits was stopped before its end");
  if (!limit->found) return;
  if (row)
    tell_limit(&t, row);
  else
    tell_none(&t);
  if (limit->suggestion.sentence[0]) say(&t, "changes", HOOKE_OF_PART, "%s", limit->suggestion.sentence);
  tell_left_out(&t);
  hk_claim_callback(claims, limit->system);
  hk_claim_contacts(claims, limit->system, limit->time, limit->q);
  for (int32_t k = 0; k < limit->row_count; k++) {
    int32_t first = 0;
    while (strcmp(limit->row[first].note, limit->row[k].note) != 0)
      first++;
    if (first == k && limit->row[k].note[0]) tell_note(&t, k);
  }
}
