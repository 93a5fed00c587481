/* What modes say of their results. */
#include "core/print.h"
#include "measure/limit/contact.h"
#include "measure/modes/lowest.h"
#include "measure/modes/modes.h"

/* A difference of the stiffness from its transpose that is not told. */
static const double SYMMETRIC = 1e-6;

static const char *ending(long long count) {
  return count == 1 ? "" : "s";
}

static void tell_growth(const struct hk_modes *modes, struct hk_claims *claims) {
  const int all = modes->unstable < modes->count || modes->count == modes->unknowns;
  if (modes->unstable > 0)
    hk_claim(claims, "unstable", HOOKE_OF_WHOLE, "eigenvalues",
             "%s%lld mode%s not pulled back but grow%s, the first by e in %.6g s: the state is no minimum of "
             "the energy",
             all ? "" : "at least ", (long long)modes->unstable, modes->unstable == 1 ? " is" : "s are",
             modes->unstable == 1 ? "s" : "", 1.0 / modes->mode[0].growth);
}

static void tell_frequencies(const struct hk_modes *modes, struct hk_claims *claims) {
  const struct hk_mode *first = modes->mode + modes->unstable, *last = modes->mode + modes->count - 1;
  const long long count = modes->count - modes->unstable;
  if (modes->count == 0) {
    hk_claim(claims, "frequencies", HOOKE_OF_WHOLE, "eigenvalues", "no mode with stiffness was found");
  } else if (count > 0 && modes->system->overdamped) {
    hk_claim(claims, "decay", HOOKE_OF_WHOLE, "eigenvalues",
             "the %lld slowest mode%s decay%s by e in %.6g%s%.6g s", count, ending(count),
             count == 1 ? "s" : "", -1.0 / first->growth, " to ", -1.0 / last->growth);
  } else if (count > 0) {
    hk_claim(claims, "frequencies", HOOKE_OF_WHOLE, "eigenvalues",
             "the lowest frequency is %.6g Hz (%.6g rad/s), and that of the last of %lld mode%s %.6g Hz",
             first->frequency, first->omega, count, ending(count), last->frequency);
  }
}

static void tell_zeros(const struct hk_modes *modes, struct hk_claims *claims) {
  const int64_t number[3] = {modes->translations, modes->rotations, modes->mechanisms};
  static const char *const name[3] = {"translation", "rotation", "mechanism"};
  char kinds[120] = "";
  for (int k = 0; k < 3; k++)
    if (number[k] > 0)
      hk_append(kinds, sizeof kinds, "%s%lld %s%s", kinds[0] ? ", " : ": ", (long long)number[k], name[k],
                ending((long long)number[k]));
  if (modes->zero_modes < 0)
    hk_claim(claims, "zero-modes", HOOKE_OF_UNKNOWN, "eigenvalues",
             "modes without stiffness were not all looked for; found: %lld%s", (long long)modes->zeros_found,
             kinds);
  else if (modes->zero_modes == 0)
    hk_claim(claims, "zero-modes", HOOKE_OF_WHOLE, "eigenvalues", "no mode is without stiffness");
  else
    hk_claim(claims, "zero-modes", HOOKE_OF_WHOLE, "eigenvalues",
             "%lld mode%s without stiffness, by a square of frequency within %g of a bound on all%s",
             (long long)modes->zero_modes, modes->zero_modes == 1 ? " is" : "s are", HOOKE_MODES_ZERO, kinds);
}

static void tell_state(const struct hk_modes *modes, struct hk_claims *claims) {
  if (!modes->at_rest)
    hk_claim(claims, "not-at-rest", HOOKE_OF_WHOLE, "forces",
             "the state is not at rest: a force of %.6g N is left where the largest of a spring is %.6g N; "
             "the modes are those of its stiffness all the same",
             modes->residual, modes->largest_force);
  if (modes->moves)
    hk_claim(claims, "velocities", HOOKE_OF_WHOLE, "state",
             "the velocities of the state count for damping alone: modes are those about its positions");
}

void hk_modes_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_modes *modes = measurement->object;
  if (measurement->outcome == HOOKE_STOPPED) {
    hk_claim(claims, "stopped", HOOKE_OF_UNKNOWN, "eigenvalues", "stopped before the modes were found");
    return;
  }
  tell_growth(modes, claims);
  tell_frequencies(modes, claims);
  tell_zeros(modes, claims);
  tell_state(modes, claims);
  if (modes->skew > SYMMETRIC)
    hk_claim(claims, "symmetric", HOOKE_OF_PART, "stiffness",
             "the stiffness is not that of an energy: it differs from its transpose by %.3g of its largest "
             "entry, and the modes are those of its symmetric part, which may miss a flutter",
             modes->skew);
  hk_claim_callback(claims, modes->system);
}
