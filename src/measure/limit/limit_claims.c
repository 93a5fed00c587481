/* What a limit says of its results: of the state that it was taken at, and with "along" of a run's frames. */
#include "core/print.h"
#include "core/utf8.h"
#include "measure/limit/limit.h"

#include <math.h>
#include <string.h>

enum { TEXT = 1024 };

struct teller {
  const struct hk_limit *limit;
  struct hk_claims *claims;
  const char *by;
};

static void say(const struct teller *t, const char *key, enum hk_claim_of of, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* A claim about that state. */
static void say(const struct teller *t, const char *key, enum hk_claim_of of, const char *format, ...) {
  char text[TEXT];
  va_list args;
  va_start(args, format);
  hk_print_list(text, sizeof text, format, args);
  va_end(args);
  hk_utf8_make_plain(text);
  hk_claim(t->claims, key, of, t->by, "at t = %.6g s, %s", t->limit->time, text);
}

/* ---- the limit of the method that the limiting springs are of ---- */

static void tell_along(const struct teller *t, const struct hk_limit_row *row) {
  if (isfinite(row->smallest))
    hk_claim(t->claims, "along", HOOKE_OF_PART, t->by,
             "at the frames up to t = %.6g s the smallest limit of %s is %.6g s, at t = %.6g s",
             t->limit->time, row->method, row->smallest, row->smallest_time);
}

static void tell_none(const struct teller *t) {
  int32_t known = 1;
  for (int32_t k = 0; k < t->limit->row_count; k++)
    known &= !isnan(t->limit->row[k].predicted);
  if (known)
    say(t, "limit", HOOKE_OF_PART, "nothing limits the step of any of these methods");
  else
    say(t, "limit", HOOKE_OF_UNKNOWN, "no limit of the step is known for these methods");
}

static void tell_limit(const struct teller *t, const struct hk_limit_row *row) {
  char predicted[96] = "at no step", measured[64] = "";
  if (row->predicted > 0.0 && row->exact)
    hk_print(predicted, sizeof predicted, "up to %.6g s", row->predicted);
  else if (row->predicted > 0.0)
    hk_print(predicted, sizeof predicted, "up to a step between %.6g and %.6g s", row->bound, row->predicted);
  if (isinf(row->measured))
    hk_print(measured, sizeof measured, ", by runs at every step");
  else if (!isnan(row->measured))
    hk_print(measured, sizeof measured, row->measured > 0.0 ? ", by runs up to %.6g s" : ", by runs at none",
             row->measured);
  say(t, "limit", HOOKE_OF_PART, "%s is stable %s%s", row->method, predicted, measured);
}

static void tell_cause(const struct teller *t) {
  const struct hk_suggestion *suggestion = &t->limit->suggestion;
  char groups[320] = "";
  if (suggestion->sentence[0]) say(t, "changes", HOOKE_OF_PART, "%s", suggestion->sentence);
  if (!suggestion->kind && !suggestion->force) return; /* it says them itself */
  hk_suggestion_add_groups(t->limit->system, &t->limit->participation, groups, sizeof groups);
  if (groups[0]) say(t, "groups", HOOKE_OF_PART, "by shares of the limiting mode: %s", groups);
}

/* ---- the rest ---- */

static void tell_left_out(const struct teller *t) {
  const long long springs = t->limit->clamped, bodies = t->limit->tipping;
  if (springs > 0)
    say(t, "compressed", HOOKE_OF_PART,
        "%lld %s compressed: what pushes %s sideways is growth by physics, and left out", springs,
        springs == 1 ? "spring is" : "springs are", springs == 1 ? "its ends" : "their ends");
  if (bodies > 0)
    say(t, "tipping", HOOKE_OF_PART,
        "%lld rigid %s tipped over by gravity or tensions: that is growth by physics, and left out", bodies,
        bodies == 1 ? "body is" : "bodies are");
}

/* 1 if a number of the row was asked for and not found. */
static int lacks(const struct hk_limit_row *row) {
  return isnan(row->predicted) || row->unknown > 0 || (!isnan(row->steps_run) && isnan(row->measured));
}

static int is_noted_before(const struct hk_limit *limit, int32_t row) {
  for (int32_t k = 0; k < row; k++)
    if (strcmp(limit->row[k].note, limit->row[row].note) == 0) return 1;
  return 0;
}

/* One claim for all methods with the same note. */
static void tell_notes(const struct teller *t) {
  const struct hk_limit *limit = t->limit;
  for (int32_t k = 0; k < limit->row_count; k++) {
    char names[256] = "";
    int32_t unknown = 0;
    if (!limit->row[k].note[0] || is_noted_before(limit, k)) continue;
    for (int32_t j = k; j < limit->row_count; j++) {
      if (strcmp(limit->row[j].note, limit->row[k].note) != 0) continue;
      hk_append(names, sizeof names, "%s%s", names[0] ? ", " : "", limit->row[j].method);
      unknown |= lacks(&limit->row[j]);
    }
    hk_claim(t->claims, "note", unknown ? HOOKE_OF_UNKNOWN : HOOKE_OF_PART, t->by, "%s at t = %.6g s: %s",
             names, limit->time, limit->row[k].note);
  }
}

void hk_limit_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_limit *limit = measurement->object;
  const struct hk_limit_row *row = limit->found ? hk_limit_limiting_row(limit) : NULL;
  const int32_t measured = row && !isnan(row->measured);
  const struct teller t = {limit, claims, measured ? "eigenvalues and runs" : "eigenvalues"};
  if (!limit->found) {
    hk_claim(claims, "limit", HOOKE_OF_UNKNOWN, t.by, "no limit is known: the search for it was stopped");
    return;
  }
  if (row) tell_along(&t, row);
  if (row)
    tell_limit(&t, row);
  else
    tell_none(&t);
  tell_cause(&t);
  tell_left_out(&t);
  tell_notes(&t);
}
