/* What a verification says of a file. */
#include "core/print.h"
#include "io/verify/verify.h"

#include <math.h>
#include <string.h>

enum { KNOWN = 48 };

/* "0.0015 J", or that nobody knows. */
static const char *known(double value, const char *unit, int digits, char text[KNOWN]) {
  hk_print(text, KNOWN, "%.*g %s", digits, value, unit);
  return isnan(value) ? "an unknown amount" : text;
}

/* Of the whole file, if no frame is outside of the slice. */
static enum hk_claim_of of_slice(const struct hk_verify *verify) {
  const int64_t last = hooke_record_count(verify->record, "frames") - 1;
  return verify->from == 0 && verify->to == last ? HOOKE_OF_WHOLE : HOOKE_OF_PART;
}

static void tell_verdict(const struct hk_verify *verify, struct hk_claims *claims) {
  const char *verdict = verify->verdict;
  if (strcmp(verdict, "stopped") == 0) {
    hk_claim(claims, "verdict", HOOKE_OF_UNKNOWN, "runs", "the work was stopped before all was compared");
  } else if (strcmp(verdict, "disagrees") == 0) {
    const int moved = strcmp(verify->balance, "does-not-hold") == 0;
    hk_claim(claims, "verdict", HOOKE_OF_WHOLE, moved ? "half-step" : "bits",
             "the file disagrees with its scene");
  } else {
    const int same = strcmp(verdict, "agrees") == 0;
    hk_claim(claims, "verdict", of_slice(verify), same ? "bits" : "half-step",
             "the file agrees with its scene %s from %.6g s to %.6g s",
             same ? "to the bit"
                  : "within the error of the method, as of another version, library or machine,",
             verify->time_from, verify->time_to);
  }
}

/* What of the run was taken again, which ends at the first fault. */
static void tell_slice(const struct hk_verify *verify, struct hk_claims *claims) {
  const int disagrees = strcmp(verify->verdict, "disagrees") == 0;
  char beside[16] = "";
  if (verify->from > 0) hk_print(beside, sizeof beside, "0 and ");
  if (disagrees && isnan(verify->steps))
    hk_claim(claims, "run-again", HOOKE_OF_UNKNOWN, "runs",
             "nothing was run again: the file does not hold as it is");
  else if (disagrees)
    hk_claim(claims, "run-again", HOOKE_OF_PART, "runs",
             "of frames %s%lld to %lld as many were run again as agree, in %.0f steps", beside,
             (long long)verify->from, (long long)verify->to, verify->steps);
  else if (strcmp(verify->verdict, "stopped") != 0)
    hk_claim(claims, "run-again", of_slice(verify), "runs",
             "frames %s%lld to %lld, %.6g s to %.6g s, were run again in %.0f steps", beside,
             (long long)verify->from, (long long)verify->to, verify->time_from, verify->time_to,
             verify->steps);
  if (strcmp(verify->parts, "not-covered") == 0)
    hk_claim(claims, "not-covered", HOOKE_OF_UNKNOWN, "check-values",
             "the file is older than check values of scene, options, masses and springs");
}

static void tell_balance(const struct hk_verify *verify, struct hk_claims *claims) {
  static const char *const verdicts[][2] = {
      {"holds", "the balance of energy holds"},
      {"does-not-hold", "the balance of energy does not hold"},
      {"unresolved", "the steps are too long to tell if energy balances"}};
  const int fixed = verify->fixed, told = strcmp(verify->balance, "unresolved") != 0;
  char one[KNOWN], two[KNOWN], three[KNOWN], left[KNOWN], fine[KNOWN], bound[KNOWN];
  for (size_t k = 0; k < sizeof verdicts / sizeof verdicts[0]; k++) {
    if (strcmp(verify->balance, verdicts[k][0]) != 0) continue;
    hk_claim(
        claims, "energy", told ? of_slice(verify) : HOOKE_OF_UNKNOWN, "half-step",
        "%s from %.6g s to %.6g s: work in %s, change %s, heat %s; up to %s are left over, %s at the end with half the "
        "step%s; bound %s",
        verdicts[k][1], verify->time_from, verify->time_to, known(verify->work, "J", 6, one),
        known(verify->energy_change, "J", 6, two), known(verify->heat, "J", 6, three),
        known(verify->residual, "J", 3, left), known(verify->residual_refined, "J", 3, fine),
        fixed ? "" : " (tolerances a hundredth)", known(verify->bound, "J", 3, bound));
    hk_claim(claims, "error", isnan(verify->error) ? HOOKE_OF_UNKNOWN : of_slice(verify), "half-step",
             "the error of a coordinate is about %s from %.6g s to %.6g s", known(verify->error, "m", 2, one),
             verify->time_from, verify->time_to);
  }
}

void hk_verify_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_verify *verify = measurement->object;
  if (verify->verdict == NULL) return;
  tell_verdict(verify, claims);
  tell_balance(verify, claims);
  tell_slice(verify, claims);
}
