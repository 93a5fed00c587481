/* What an estimate says of the error of a run. */
#include "measure/estimate/estimate.h"

#include "core/print.h"
#include "model/generalized.h"
#include "model/particles.h"

#include <math.h>
#include <string.h>

/* Fractions of the energy of the scene, above which energy grows by itself, or more heat is dissipated than
 * there is. */
static const double MOST_RISE = 0.01, MOST_EXCESS = 0.01;

static const char *source_of(const char *by) {
  static const char *const sources[][2] = {
      {"half-step", "from runs of the method at other steps"},
      {"tolerance", "from runs of the method at other tolerances"},
      {"other-method", "from a run by another method"},
      {"reference", "against a reference that was checked by another"},
  };
  int k = 0;
  while (strcmp(by, sources[k][0]) != 0)
    k++;
  return sources[k][1];
}

static enum hk_claim_of of_known(const struct hk_estimate *e) {
  return hk_estimate_knows_all(e) ? HOOKE_OF_WHOLE : HOOKE_OF_PART;
}

static void tell_error(const struct hk_estimate *e, struct hk_claims *claims) {
  if (e->only_watches) return;
  const char *m = hk_metres(e->system), *what = e->system->generalized ? "number" : "particle";
  char at[64] = "";
  if (e->compared < e->frames && hk_estimate_knows_all(e))
    hk_print(at, sizeof at, " at %lld of %lld frames", (long long)e->compared, (long long)e->frames);
  if (e->by)
    hk_claim(claims, "error", of_known(e), e->by,
             "the error is at most %.3g%s until t = %.6g s, of any %s%s (root mean square %.2g%s), %s",
             e->error[0], m, e->known_until, what, at, e->rms, m, source_of(e->by));
  else
    hk_claim(claims, "error", HOOKE_OF_UNKNOWN, "", "the error is not known: %s", e->reason);
}

/* Each of a list. */
static void tell_each(const struct hk_estimate *e, struct hk_claims *claims) {
  struct hk_want_found found[HOOKE_WANTS];
  for (int32_t k = 0; k < e->wants.count; k++)
    found[k] = (struct hk_want_found){e->wants.want[k].name, hk_want_unit(&e->wants, k), e->bound[k],
                                      e->error[1 + k], NAN};
  if (e->by) hk_wants_claim(&e->wants, found, of_known(e), e->by, " until then", claims);
}

static void tell_want(const struct hk_estimate *e, struct hk_claims *claims) {
  const double met = hk_estimate_met(e);
  const char *by = e->by ? e->by : "", *reason = e->by ? e->reason : "", *joint = reason[0] ? ": " : "";
  char want[32] = "quantities";
  if (e->wants.count == 0) return;
  if (!e->wants.list) hk_print(want, sizeof want, "%.6g%s", e->wants.most, hk_metres(e->system));
  if (met == 1.0)
    hk_claim(claims, "want", HOOKE_OF_WHOLE, by, "that is within the wanted %s", want);
  else if (met == 0.0)
    hk_claim(claims, "want", HOOKE_OF_WHOLE, by, "the wanted %s are not met%s%s", want, joint, reason);
  else
    hk_claim(claims, "want", HOOKE_OF_UNKNOWN, by,
             "nobody knows for all of the run whether the wanted %s are met%s%s", want, joint, reason);
}

/* Energy that no part of the scene accounts for. */
static void tell_energy(const struct hk_estimate *e, struct hk_claims *claims) {
  if (e->rise > MOST_RISE)
    hk_claim(
        claims, "energy-rise", HOOKE_OF_PART, "energy",
        "energy rose by itself, over the last half of the run by %.3g %% of what the scene has: this step is "
        "too large, or the method does not suit the scene",
        100.0 * e->rise);
  if (e->heat_excess > MOST_EXCESS)
    hk_claim(
        claims, "heat-excess", HOOKE_OF_PART, "energy",
        "damping and drag took more energy than there was to take, by %.3g %% of what the scene has: velocities "
        "reverse at each step, which is too large for the damping",
        100.0 * e->heat_excess);
}

/* Extremes of a run that stopped, diverged or was continued. */
static void tell_watched(const struct hk_estimate *e, struct hk_claims *claims) {
  if (e->course.result == NULL || hk_estimate_saw_all(e)) return;
  if (e->course.follows && e->course.until > e->course.from)
    hk_claim(
        claims, "watched", HOOKE_OF_PART, "",
        "smallest and largest values are those from t = %.6g s until t = %.6g s: of the rest of the run they "
        "are not known",
        e->course.from, e->course.until);
  else
    hk_claim(
        claims, "watched", HOOKE_OF_UNKNOWN, "",
        "smallest and largest values are not known: no steps of the run were seen that are known to be good");
}

void hk_estimate_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_estimate *e = measurement->object;
  tell_error(e, claims);
  tell_each(e, claims);
  tell_want(e, claims);
  if (!isnan(e->last_error))
    hk_claim(
        claims, "last-piece", HOOKE_OF_PART, "half-step",
        "%.2g%s more or less at the end was made from t = %.6g s on: a part of an error that is not known",
        e->last_error, hk_metres(e->system), e->last_from);
  tell_energy(e, claims);
  tell_watched(e, claims);
  if (e->reversal[0]) hk_claim(claims, "machine", HOOKE_OF_PART, "clock", "picked %s", e->reversal);
}
