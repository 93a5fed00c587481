/* What a rest says of its results. */
#include "core/print.h"
#include "measure/rest/rest.h"

static void tell_rest(const struct hk_resting *r, struct hk_claims *claims) {
  const struct hk_rest *rest = &r->rest;
  char share[80] = "";
  if (rest->largest_force > 0.0)
    hk_append(share, sizeof share, ", %.3g of the largest force along a spring",
              rest->residual / rest->largest_force);
  hk_claim(claims, "rest", HOOKE_OF_WHOLE, "forces",
           "forces are in equilibrium to %.3g N%s; the farthest particle has moved %.6g m", rest->residual,
           share, rest->moved);
}

static void tell_lack(const struct hk_resting *r, struct hk_claims *claims) {
  const struct hk_rest *rest = &r->rest;
  if (rest->lack == HOOKE_FALLS)
    hk_claim(
        claims, "rest", HOOKE_OF_WHOLE, "forces",
        "there is no rest: the scene falls along %.3g %.3g %.3g, where a force of %.6g N remains after %.3g m",
        rest->fall[0], rest->fall[1], rest->fall[2], rest->residual, rest->moved);
  else if (rest->lack == HOOKE_TOO_LONG)
    hk_claim(claims, "rest", HOOKE_OF_UNKNOWN, "forces",
             "no rest was found, and there may be one: after %lld steps, %lld that failed, and %lld "
             "evaluations of all forces a force of %.6g N is left, along %.3g %.3g %.3g",
             (long long)rest->steps, (long long)rest->failures, (long long)rest->force_evaluations,
             rest->residual, rest->fall[0], rest->fall[1], rest->fall[2]);
  else
    hk_claim(
        claims, "rest", HOOKE_OF_UNKNOWN, "forces",
        "no rest was found, and there may be one: the search ended %s, with a force of %.6g N along %.3g %.3g "
        "%.3g",
        rest->lack == HOOKE_NO_WAY_ON ? "where no step led on" : "before its end", rest->residual,
        rest->fall[0], rest->fall[1], rest->fall[2]);
}

static void tell_minimum(const struct hk_resting *r, struct hk_claims *claims) {
  char growth[48] = "";
  if (r->modes.unstable > 0)
    hk_append(growth, sizeof growth, ", and grows at %.6g 1/s", r->modes.mode[0].growth);
  if (r->minimum == 1)
    hk_claim(claims, "minimum", HOOKE_OF_WHOLE, "eigenvalues", "no small displacement lowers the energy%s",
             r->modes.zero_modes == 0 ? ", and each raises it" : "");
  else if (r->minimum == 0)
    hk_claim(claims, "minimum", HOOKE_OF_WHOLE, "eigenvalues",
             "the rest is not stable: a small displacement lowers the energy%s", growth);
  else
    hk_claim(
        claims, "minimum", HOOKE_OF_UNKNOWN, "eigenvalues", "whether the energy is least here is not known%s",
        !r->rest.has_energy ? ": some force has no energy"
        : hk_rest_is_large(r)
            ? ": modes of scenes of this size are not looked for, and a factor of its stiffness has too many numbers"
            : "");
  if (r->modes.zero_modes > 0)
    hk_claim(claims, "zero-modes", HOOKE_OF_WHOLE, "eigenvalues",
             "%lld free %s no stiffness: along %s any place is as good", (long long)r->modes.zero_modes,
             r->modes.zero_modes == 1 ? "motion has" : "motions have",
             r->modes.zero_modes == 1 ? "it" : "them");
}

/* What the scene does in motion and not here. */
static void tell_left_out(const struct hk_resting *r, struct hk_claims *claims) {
  if (r->had_friction)
    hk_claim(claims, "friction", HOOKE_OF_WHOLE, "scene",
             "friction is left out: in this model it holds nothing that is at rest");
  if (hk_system_takes_work(r->m->system))
    hk_claim(claims, "time", HOOKE_OF_WHOLE, "scene",
             "what the scene prescribes in time is held at its value at the start");
}

void hk_rest_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_resting *r = measurement->object;
  if (r->position == NULL) return;
  if (r->rest.lack == HOOKE_RESTS) {
    tell_rest(r, claims);
    tell_minimum(r, claims);
  } else {
    tell_lack(r, claims);
  }
  tell_left_out(r, claims);
}
