/* What a study says of its results. */
#include "measure/study/study.h"

#include "core/print.h"

#include "model/generalized.h"
#include "model/particles.h"

#include <math.h>

enum { SETTING_SIZE = 96 };

/* Differences that grow more than this are called chaotic if the two runs part. */
static const double CHAOTIC = 1e3;

struct teller {
  const struct hk_study *study;
  struct hk_claims *claims;
  double until;        /* the time up to which errors are known [s] */
  int32_t all;         /* 1: that is the whole run */
  enum hk_claim_of of; /* what claims of the recommendation are true of, else of errors */
  char where[48];      /* " up to 9 s" where that is a part */
  const char *m;       /* after a length, and */
  const char *want;    /* after what is wanted */
  const char *forces;  /* that are evaluated */
};

#define say(teller, key, of, by, ...) hk_claim((teller)->claims, key, of, by, __VA_ARGS__)

/* Errors are known up to this time. */
static void stand_until(struct teller *t, double until) {
  t->until = until;
  t->all = until >= t->study->duration * (1.0 - 1e-9);
  t->of = t->all ? HOOKE_OF_WHOLE : HOOKE_OF_PART;
  t->where[0] = '\0';
  if (!t->all && !isnan(until)) hk_print(t->where, sizeof t->where, " up to %.6g s", until);
}

/* ---- the recommendation ---- */

/* "verlet in steps of 0.001 s", "cvode-bdf with rtol 1e-06" */
static const char *name_run(const struct hk_study *study, char text[SETTING_SIZE]) {
  const struct hk_study_recommendation *r = &study->recommendation;
  const int adaptive = hk_study_is_adaptive(study, r->method);
  hk_print(text, SETTING_SIZE, adaptive ? "%s with rtol %.6g" : "%s in steps of %.6g s",
           study->method[r->method], r->value);
  return text;
}

static void tell_time(const struct teller *t) {
  const struct hk_study_recommendation *r = &t->study->recommendation;
  say(t, "time", HOOKE_OF_WHOLE, "clock", "it took %.3g s on this machine, the median of its runs %.3g s",
      r->wall_seconds, r->wall_median);
}

static void tell_each(const struct teller *t) {
  hk_wants_claim(&t->study->wants, t->study->recommendation.found, t->of, "reference", t->where, t->claims);
}

static void tell_closest(const struct teller *t) {
  const struct hk_study_recommendation *r = &t->study->recommendation;
  char run[SETTING_SIZE];
  say(t, "recommendation", isnan(r->error) ? HOOKE_OF_UNKNOWN : t->of, "reference",
      "no run is recommended for an error of at most %.6g%s%s: %s", r->want, t->want, t->where, r->note);
  if (r->method < 0) return;
  say(t, "closest", t->of, "reference",
      "the closest is %s: its error%s is %.3g%s%s, with %.0f evaluations of the %s", name_run(t->study, run),
      t->where, r->error, t->want, r->error <= r->want ? ", but nothing is known of its margin" : "",
      r->force_evaluations, t->forces);
  tell_each(t);
  tell_time(t);
}

static void tell_change(const struct teller *t, const char *key, const char *change,
                        enum hk_study_change which) {
  const struct hk_study_margin *margin = &t->study->recommendation.margin;
  const double held = margin->holds[which], error = margin->error[which];
  if (isnan(held))
    say(t, key, HOOKE_OF_UNKNOWN, "reference", "%s: not known%s", change,
        t->study->budget_spent ? " in this time" : "");
  else if (isnan(error))
    say(t, key, HOOKE_OF_UNKNOWN, "reference",
        "%s: no longer, a run did not come to its end or was not judged", change);
  else
    say(t, key, t->of, "reference", "%s: %s, its error%s is %.3g%s then", change,
        held == 1.0 ? "still at most that" : "no longer", t->where, error, t->want);
}

static void tell_margin(const struct teller *t) {
  const struct hk_study_recommendation *r = &t->study->recommendation;
  const double fraction = r->margin.limit_share;
  say(t, "margin", t->of, "reference",
      "that error%s lies between %.3g and %.3g%s, by what the reference is known to", t->where,
      hk_study_least_error(t->study), r->error + t->study->reference.wanted_agreement, t->want);
  if (t->study->m->system->generalized) return;
  if (fraction > 0.0 && !isinf(fraction))
    say(t, "stability", HOOKE_OF_PART, "limit", "its step is %.2g of the largest stable one at the start",
        fraction);
  tell_change(t, "stiffness", "with a stiffness 10 % more or less", HOOKE_STUDY_STIFFNESS);
  tell_change(t, "start", "with all started faster or slower along (1, 1, 1) by 10 % of the largest speed",
              HOOKE_STUDY_START);
}

/* Its error may be known for less than that of the rows. */
static void tell_recommendation(const struct teller *errors) {
  const struct hk_study_recommendation *r = &errors->study->recommendation;
  struct teller recommended = *errors, *t = &recommended;
  char run[SETTING_SIZE];
  if (!hk_study_recommends(t->study)) return;
  if (!isnan(r->until)) stand_until(t, r->until);
  if (!r->met) {
    tell_closest(t);
    return;
  }
  say(t, "recommendation", t->of, "reference",
      "the cheapest run found whose error is at most %.6g%s%s is %s: its error is %.3g%s, with %.0f evaluations of "
      "the %s%s",
      r->want, t->want, t->all ? " over the whole run" : t->where, name_run(t->study, run), r->error, t->want,
      r->force_evaluations, t->forces, t->all ? "" : "; of what comes later nothing is known");
  tell_each(t);
  tell_time(t);
  if (r->note[0]) say(t, "machine", HOOKE_OF_WHOLE, "clock", "%s", r->note);
  tell_margin(t);
}

/* ---- the reference ---- */

/* Why errors are not judged over the whole run. */
static const char *why_not_all(const struct hk_study *study) {
  const struct hk_reference *r = &study->reference;
  if (r->trusted >= r->checked) return "there was no time to check the reference beyond that";
  if (r->hurried) return "at the tolerances or steps that there was time for, its two runs part after that";
  if (study->once) return "its two runs part after that, at the tolerances or steps of a first look";
  if (hk_reference_is_halved(r))
    return "its two runs part after that, even in the shortest steps that it takes";
  if (r->growth_seen > CHAOTIC)
    return "this motion is chaotic: small differences grow so much that its two runs part after that even "
           "where rounding alone sets them apart, and what comes later cannot be computed to the wanted digits";
  return "its two runs part after that, although differences do not grow much: rounding keeps them "
         "from the wanted digits even at their tightest tolerances";
}

static void tell_growth(const struct teller *t) {
  const struct hk_reference *r = &t->study->reference;
  if (isnan(r->growth_seen)) return;
  if (isnan(r->growth))
    say(t, "growth", HOOKE_OF_UNKNOWN, "displaced runs",
        "a displacement of the start grows %.3g times; others may grow more", r->growth_seen);
  else if (r->growth_probability == 1.0)
    say(t, "growth", HOOKE_OF_WHOLE, "displaced runs",
        "a small displacement of the start grows at most %.3g times", r->growth);
  else
    say(t, "growth", HOOKE_OF_WHOLE, "displaced runs",
        "a small displacement of the start grows at most %.3g times, with a probability of 1 - 1e-%.0f; random "
        "ones grow %.3g times",
        r->growth, (double)r->displacements, r->growth_seen);
}

static void tell_floor(const struct teller *t) {
  const struct hk_reference *r = &t->study->reference;
  const double step = 2.0 * hk_reference_setting(r, r->method, r->rtol);
  char check[160], energy[64] = "";
  if (hk_reference_is_halved(r))
    hk_print(check, sizeof check,
             "itself in steps of %.6g s, twice as long: an error that both make alike is not seen", step);
  else
    hk_print(check, sizeof check, "%s, which shares nothing with it but the %s", r->check, t->forces);
  if (!isnan(r->energy_agreement))
    hk_print(energy, sizeof energy, ", and no energy drift below %.3g J", r->energy_agreement);
  say(t, "floor", t->of, "reference",
      "no error below %.3g%s means anything%s%s: to that the reference, by %s, agrees with %s", r->agreement,
      t->m, t->where, energy, r->method, check);
}

static void tell_reference(const struct teller *t) {
  const struct hk_study *study = t->study;
  const struct hk_reference *r = &study->reference;
  if (r->frames.count == 0) {
    say(t, "reference", HOOKE_OF_UNKNOWN, "reference",
        "the reference is not finished, so there is nothing to measure against");
    return;
  }
  if (isnan(r->agreement))
    say(t, "reference", HOOKE_OF_UNKNOWN, "reference",
        "no error is known: the two runs of the reference, by %s and %s, part before the first frame after "
        "the start",
        r->method, r->check);
  else if (t->all)
    say(t, "reference", HOOKE_OF_WHOLE, "reference", "errors are known over the whole run, %.6g s",
        study->duration);
  else
    say(t, "reference", HOOKE_OF_PART, "reference", "%s known up to %.6g s of %.6g s: %s",
        study->m->system->generalized ? "errors are" : "errors and energy drift are", t->until,
        study->duration, why_not_all(study));
  if (!isnan(r->agreement)) tell_floor(t);
  tell_growth(t);
  if (r->frames.zero_passages[0])
    say(t, "passages", HOOKE_OF_WHOLE, "reference", "%s", r->frames.zero_passages);
}

/* ---- the rest ---- */

static void tell_ensemble(const struct teller *t) {
  const struct hk_ensemble *e = t->study->ensemble;
  const int asked = hooke_options_number(t->study->m->options, "ensemble") > 0.0;
  if (e && isnan(e->from))
    say(t, "statistics", HOOKE_OF_UNKNOWN, "ensemble",
        "there are no statistics: of %d runs of each method none "
        "came to its end",
        (int)e->members);
  else if (e)
    say(t, "statistics", HOOKE_OF_PART, "ensemble",
        "statistics are of means over %.6g s to %.6g s, beyond the frames whose errors are known, of %d runs of each "
        "method, whose starts differ by noise of %.3g m",
        e->from, e->until, (int)e->members, e->noise);
  else if (asked && t->all)
    say(t, "statistics", HOOKE_OF_WHOLE, "reference",
        "no statistics are needed: errors are known over the whole run");
}

static void tell_cut(const struct teller *t) {
  char list[256] = "";
  for (int32_t m = 0; m < t->study->method_count; m++)
    if (t->study->cut[m]) hk_append(list, sizeof list, "%s%s", list[0] ? ", " : "", t->study->method[m]);
  if (list[0])
    say(t, "cut", HOOKE_OF_WHOLE, "count",
        "rows are left out where they would take five times the work of a run that meets the want, or would "
        "by their order not come to it with less: %s",
        list);
}

void hk_study_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_study *study = measurement->object;
  const hooke_system *system = measurement->system;
  struct teller t = {.study = study,
                     .claims = claims,
                     .m = hk_metres(system),
                     .want = hk_wants_unit(&study->wants, system),
                     .forces = hk_is_first_order(system) ? "rate" : "forces"};
  stand_until(&t, hk_study_trusted_until(study));
  tell_recommendation(&t);
  tell_reference(&t);
  if (study->budget_spent)
    say(&t, "budget", HOOKE_OF_PART, "clock", "the budget is spent: what it left no time for is missing");
  tell_cut(&t);
  tell_ensemble(&t);
}
