/* Derives the cause from the observations of the steps, and describes it. */
#include "measure/why/why.h"

#include "core/memory.h"
#include "core/print.h"
#include "core/utf8.h"
#include "measure/limit/limit.h"
#include "measure/spectrum/naming.h"
#include "model/callbacks.h"
#include "model/force/altitude.h"
#include "model/force/spring.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const double COLLAPSED = 1e-3; /* of the rest length */

/* Composes the cause: what the run did after its last good state, and why. */
static void say(struct hk_inquiry *inquiry, const char *cause, const char *format, ...)
    __attribute__((format(printf, 3, 4)));

static void say(struct hk_inquiry *inquiry, const char *cause, const char *format, ...) {
  struct hk_why *why = inquiry->why;
  const int32_t outcome = inquiry->run->outcome;
  const char *how = outcome == HOOKE_DIVERGED        ? "the run diverged"
                    : outcome == HOOKE_SOLVER_FAILED ? "the solver gave up"
                                                     : "the run ran out of steps";
  va_list args;
  why->cause = cause;
  int used = hk_print(why->sentence, sizeof why->sentence, "%s after t = %.6g s: ", how, why->time);
  va_start(args, format);
  hk_print_list(why->sentence + used, sizeof why->sentence - (size_t)used, format, args);
  va_end(args);
  hk_utf8_make_plain(why->sentence);
  why->cause_length = (int32_t)strlen(why->sentence);
}

/* Adds the failure itself, at the time of the failed step, or at the time it was noticed if the repeated
 * steps did not fail. */
static void tell_failure(struct hk_inquiry *inquiry) {
  const int32_t diverged = inquiry->run->outcome == HOOKE_DIVERGED;
  const double t = inquiry->reproduced && diverged ? inquiry->bad_time : inquiry->why->noticed;
  char *text = inquiry->why->sentence;
  const size_t size = sizeof inquiry->why->sentence;
  if (diverged && inquiry->bad_particle < 0)
    hk_append(text, size, "; it was noticed at t = %.6g s", t);
  else if (diverged)
    hk_append(text, size, "; at t = %.6g s particle %lld is the fastest and %s", t,
              (long long)inquiry->bad_particle,
              isfinite(inquiry->bad_size) ? "the energy is beyond 100 times what the scene had"
                                          : "numbers are no longer finite");
  else if (t > inquiry->why->time)
    hk_append(text, size, "; at t = %.6g s it ended", t);
}

/* ---- causes ---- */

static void judge_bad_value(struct hk_inquiry *inquiry) {
  const struct hk_bad_value *bad_value = &inquiry->bad_value;
  char name[512];
  inquiry->why->particle = (double)bad_value->particle;
  if (bad_value->of_drive) {
    say(inquiry, "force-not-finite",
        "the drive callback moves particle %lld with numbers that are not finite "
        "at t = %.6g s; whatever pulls at it then has a force that is not finite",
        (long long)bad_value->particle, bad_value->time);
  } else {
    say(inquiry, "force-not-finite",
        "%s gives particle %lld a force that is not "
        "finite at t = %.6g s, while all positions and velocities are",
        hk_force_called(inquiry->system, name, sizeof name), (long long)bad_value->particle, bad_value->time);
  }
}

/* ---- what limits the step ---- */

static void take_participation(struct hk_inquiry *inquiry, const struct hk_participation *participation) {
  hk_limiting_take(participation, &inquiry->why->limiting);
  inquiry->force = hk_participation_force(participation);
  inquiry->heaviest = participation->heaviest;
  inquiry->group = hk_participation_group(participation);
  inquiry->group_share = inquiry->group < 0 ? 0.0 : participation->group_share[inquiry->group];
  if (inquiry->violation.particle < 0 && participation->particle_count > 0)
    inquiry->violation.particle = participation->particle[0].particle;
}

static int32_t look(struct hk_inquiry *inquiry, struct hk_limit *limit) {
  limit->budget = &inquiry->budget;
  limit->memory = inquiry->memory_limit - inquiry->memory_used;
  const int32_t status = hk_limit_look(limit, inquiry->violation.q, NULL, inquiry->violation.time);
  if (limit->found) take_participation(inquiry, &limit->participation);
  const struct hk_suggestion *suggestion = &limit->suggestion;
  if (status == HOOKE_OK && (suggestion->kind || suggestion->force))
    snprintf(inquiry->suggestion, sizeof inquiry->suggestion, "%s", suggestion->sentence);
  return status;
}

/* By the limiting mode, where the step was first found above the limit. */
static int32_t ask_limit(struct hk_inquiry *inquiry) {
  const hooke_integrator *run = inquiry->run;
  hooke_options *options = NULL;
  int32_t status = hk_options_create(hk_limit_kind.options, &options);
  if (status == HOOKE_OK) status = hooke_options_set_text(options, "methods", run->method->name);
  if (status == HOOKE_OK)
    status =
        hk_measurement_create(&hk_limit_kind, NULL, inquiry->system, run->options, options, &inquiry->limit);
  if (status == HOOKE_OK) status = look(inquiry, inquiry->limit->object);
  hooke_options_destroy(options);
  return status;
}

/* Finds the limiting springs and force of a violation, and a suggestion. */
static int32_t find_limiting(struct hk_inquiry *inquiry) {
  const struct hk_violation *violation = &inquiry->violation;
  int32_t status = HOOKE_OK;
  if (violation->has_participation) take_participation(inquiry, &violation->participation);
  if (!inquiry->large) {
    hk_budget_lend(&inquiry->budget, 0.5);
    status = ask_limit(inquiry);
    hk_inquiry_end_part(inquiry, "what determines the limit");
  }
  if (status == HOOKE_NO_MEMORY) return status;
  /* without a mode, the particle at which the bound showed it */
  if (inquiry->why->limiting.count == 0) {
    const struct hk_force_row *force;
    hk_limiting_add(inquiry->system,
                    hk_naming_heaviest(inquiry->system, &hk_force_springs, violation->particle,
                                       inquiry->run->schedule.step, &force),
                    NAN, &inquiry->why->limiting);
  }
  return HOOKE_OK;
}

/* A smaller share of the motion that grows is not where it is most of all. */
static const double LEAST_SHARE = 0.05;

/* The element with the largest share, or its group where that share is small. */
static void name_heaviest(const struct hk_inquiry *inquiry, char text[2 * HOOKE_NAMING_SIZE]) {
  const char *damping = inquiry->force == HOOKE_PARTICIPATION_DAMPING ? "the damping of " : "";
  const struct hk_group *group = &inquiry->system->group[inquiry->group];
  char element[HOOKE_NAMING_SIZE];
  if (inquiry->heaviest.share >= LEAST_SHARE)
    snprintf(text, 2 * HOOKE_NAMING_SIZE, "%s%s", damping,
             hk_naming_words(inquiry->system, hk_force_table(inquiry->heaviest.force),
                             inquiry->heaviest.number, element));
  else
    hk_print(text, 2 * HOOKE_NAMING_SIZE, "%s%s %.80s (%.0f %% of that motion, first at particle %lld)",
             damping, group->name ? "group" : "the", group->name ? group->name : group->force->members,
             100.0 * inquiry->group_share, (long long)inquiry->violation.particle);
}

/* The elements that determine the limit. */
static void name_limiting(const struct hk_inquiry *inquiry, char text[2 * HOOKE_NAMING_SIZE]) {
  const struct hk_why *why = inquiry->why;
  const int64_t particle = inquiry->violation.particle;
  const int damping = inquiry->force == HOOKE_PARTICIPATION_DAMPING;
  const struct hk_force_row *force = hk_force_table(inquiry->force);
  char spring[HOOKE_NAMING_SIZE] = "no spring";
  const int64_t first = inquiry->force >= 0;
  if (first < why->limiting.count)
    hk_naming_words(inquiry->system, &hk_force_springs, why->limiting.row[first].spring, spring);
  if (inquiry->force == HOOKE_PARTICIPATION_GEOMETRIC)
    snprintf(text, 2 * HOOKE_NAMING_SIZE, "the turning of particle %lld's body by gravity and tensions",
             (long long)particle);
  else if (force && !force->members)
    snprintf(text, 2 * HOOKE_NAMING_SIZE, "the %s of particle %lld", force->title, (long long)particle);
  else if (inquiry->heaviest.share > 0.0)
    name_heaviest(inquiry, text);
  else if (force)
    hk_naming_heaviest_words(inquiry->system, particle, inquiry->run->schedule.step, text);
  else
    snprintf(text, 2 * HOOKE_NAMING_SIZE, "%s%s", damping ? "the damping of " : "", spring);
}

static int32_t judge_violation(struct hk_inquiry *inquiry) {
  const struct hk_violation *violation = &inquiry->violation;
  const char *method = inquiry->run->method->name;
  char where[2 * HOOKE_NAMING_SIZE];
  inquiry->why->limit = violation->limit;
  const int32_t status = find_limiting(inquiry);
  inquiry->why->particle = violation->particle >= 0 ? (double)violation->particle : NAN;
  name_limiting(inquiry, where);
  if (violation->at_most == 0.0) {
    inquiry->why->limit = 0.0;
    say(inquiry, "never-stable",
        "%s is stable at no step for this scene: motion without damping grows by it at any step, slowly at a "
        "small one, and here the step is %.6g s",
        method, inquiry->why->step);
  } else if (isnan(violation->limit)) {
    say(inquiry, "step-above-limit",
        "the step %.6g s is above the largest stable one of %s at t = %.6g s, which is between %.6g and %.6g s",
        inquiry->why->step, method, violation->time, violation->bound, violation->at_most);
  } else {
    say(inquiry, "step-above-limit",
        "the step %.6g s is above %.6g s, the largest stable one of %s at t = %.6g s", inquiry->why->step,
        violation->limit, method, violation->time);
  }
  hk_append(inquiry->why->sentence, sizeof inquiry->why->sentence,
            "; motion grows in every step, most of all in %s", where);
  hk_utf8_make_plain(inquiry->why->sentence);
  return status;
}

/* The element with the largest acceleration: the stiffest for the mass of one of its particles. */
struct steepest {
  const struct hk_force_row *force; /* NULL: none */
  int64_t number, particle;
  double stiffness;
};

static struct steepest find_steepest(const hooke_system *system) {
  struct steepest found = {.force = NULL};
  double most = -1.0;
  struct hk_elements at;
  hk_begin_elements(system, system->moment, system->position, NULL, &at);
  at.by_number = 1;
  for (const struct hk_element *e; (e = hk_next_element(&at)) != NULL;) {
    for (int j = 0; j < e->count && at.force->members; j++) {
      const double square = e->weight[j] * e->weight[j];
      const double steepness = square * (e->k_along + e->c_along) * system->inverse_mass[e->particle[j]];
      if (!(steepness > most)) continue;
      most = steepness;
      found = (struct steepest){at.force, hk_element_number(&at), e->particle[j], e->k_along};
    }
  }
  return found;
}

static void judge_overflow(struct hk_inquiry *inquiry) {
  const hooke_system *system = inquiry->system;
  const struct steepest steepest = find_steepest(system);
  char where[HOOKE_NAMING_SIZE], what[HOOKE_NAMING_SIZE + 80] = "", step[64] = "", limit[64] = "";
  if (steepest.force && steepest.force->kind & HOOKE_LOOPED)
    hk_limiting_add(inquiry->system, steepest.number, NAN, &inquiry->why->limiting);
  if (inquiry->violation.found) inquiry->why->limit = inquiry->violation.limit;
  if (inquiry->bad_particle >= 0) inquiry->why->particle = (double)inquiry->bad_particle;
  if (!isnan(inquiry->why->step)) hk_print(step, sizeof step, ", with a step of %.6g s", inquiry->why->step);
  if (inquiry->why->limit > 0.0)
    hk_print(limit, sizeof limit, ", where %.6g s is the largest stable one", inquiry->why->limit);
  if (steepest.force)
    hk_print(what, sizeof what, ": the steepest is %s, %.6g N/m on %.6g kg",
             hk_naming_words(system, steepest.force, steepest.number, where), steepest.stiffness,
             system->inertia[steepest.particle]);
  say(inquiry, "overflow", "numbers leave the range of double precision within a few steps%s%s%s", what, step,
      limit);
}

static void judge_collapse(struct hk_inquiry *inquiry, int64_t spring, const char *what) {
  char where[HOOKE_NAMING_SIZE];
  hk_limiting_add(inquiry->system, spring, 1.0, &inquiry->why->limiting);
  hk_naming_words(inquiry->system, &hk_force_springs, spring, where);
  say(inquiry, "collapsed-spring",
      "%s %s, where a spring loses its direction and its force turns round from one step to the next", where,
      what);
}

/* ---- squares ---- */

/* Lengths and speeds above this have no finite square. */
static const double HAS_SQUARE = 1e154;

/* The particle of a state with the largest number whose square overflows, and that number; -1 if there is
 * none. */
static int64_t largest_unsquared(const hooke_system *system, const double *x, double *most) {
  int64_t found = -1;
  *most = HAS_SQUARE;
  for (int64_t k = 0; k < 3 * system->particle_count; k++) {
    if (!(fabs(x[k]) > *most) || system->constrained[k / 3]) continue;
    *most = fabs(x[k]);
    found = k / 3;
  }
  return found;
}

/* 1 if a spring, or the motion of a step, is too long for its square, or a speed too large. */
static int32_t judge_squares(struct hk_inquiry *inquiry, double t, const double *q, const double *v) {
  const char *const words[] = {"is at a speed of", "is at a distance of"}, *const units[] = {"m/s", "m"};
  const double *const x[] = {v, q};
  for (int k = 0; k < 2; k++) {
    double most;
    const int64_t particle = x[k] ? largest_unsquared(inquiry->system, x[k], &most) : -1;
    if (particle < 0) continue;
    inquiry->why->particle = (double)particle;
    inquiry->squares = k == 0 ? 1e-4 * HAS_SQUARE / most : 0.0;
    say(inquiry, "overflow",
        "particle %lld %s %.3g %s at t = %.6g s, and squares of "
        "numbers above 1.3e154 leave the range of double precision",
        (long long)particle, words[k], most, units[k], t);
    return 1;
  }
  return 0;
}

/* At the initial state already; if that is not known, at the last state. */
static int32_t judge_start(struct hk_inquiry *inquiry) {
  const hooke_integrator *run = inquiry->run;
  const hooke_state *known = run->recent.first ? run->recent.first : hk_inquiry_last(inquiry);
  if (run->recent.first == NULL && run->t0 == 0.0)
    return judge_squares(inquiry, 0.0, inquiry->system->position, inquiry->system->velocity);
  return judge_squares(inquiry, *known->t, known->q, known->v);
}

/* ---- solvers ---- */

/* The spring nearest to zero length: its length over its rest length, at the last state and at the end of the
 * next step. */
static int64_t shortest_spring(const struct hk_inquiry *inquiry, double *ratio) {
  const hooke_state *state = hk_inquiry_last(inquiry);
  const double ahead = inquiry->run->method->adaptive ? 0.0 : inquiry->run->schedule.step;
  const struct hk_springs *springs = inquiry->system->springs;
  int64_t found = -1;
  *ratio = INFINITY;
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t k = 0; k < springs->run[r].count; k++) {
      const struct hk_spring s = hk_run_spring(&springs->run[r], k);
      double square = 0.0, cosine = 0.0;
      for (int a = 0; a < 3; a++) {
        const int64_t i = 3 * s.head + a, j = 3 * s.tail + a;
        const double d = state->q[i] - state->q[j], dv = state->v[i] - state->v[j];
        square += d * d;
        cosine += d * (d + ahead * dv);
      }
      const double here = cosine < 0.0 ? 0.0 : sqrt(square) / s.rest_length;
      if (!(s.rest_length > 0.0) || !(here < *ratio)) continue;
      *ratio = here;
      found = springs->run[r].first + k;
    }
  }
  return found;
}

static int32_t is_beyond_numbers(const struct hk_inquiry *inquiry, int32_t *beyond) {
  const hooke_state *last = hk_inquiry_last(inquiry);
  const int64_t size = last->size;
  const double h = inquiry->run->method->adaptive ? 1.0 : inquiry->run->schedule.step;
  double *a = hk_new(size, sizeof(double));
  if (a == NULL) return HOOKE_NO_MEMORY;
  const int32_t status = hooke_system_acceleration(inquiry->system, *last->t, last->q, last->v, a);
  *beyond = 0;
  for (int64_t k = 0; k < size && status == HOOKE_OK; k++) {
    const double gain = fmax(1.0, h) * fabs(a[k]);
    *beyond |= !(gain < 1e100) || !(h * gain < 1e100);
  }
  hk_free(a);
  return status;
}

static int32_t judge_solver(struct hk_inquiry *inquiry) {
  double ratio;
  int32_t beyond = 0;
  const int32_t status = is_beyond_numbers(inquiry, &beyond);
  if (status != HOOKE_OK) return status;
  const int64_t shortest = shortest_spring(inquiry, &ratio);
  if (judge_start(inquiry)) return HOOKE_OK;
  if (beyond) {
    judge_overflow(inquiry);
  } else if (inquiry->run->outcome == HOOKE_SOLVER_FAILED && shortest >= 0 && ratio < COLLAPSED) {
    judge_collapse(inquiry, shortest, "is pressed to no length");
  } else {
    inquiry->why->limit = INFINITY;
    const char *message = inquiry->run->message, *rest = strstr(message, "; "); /* what to try */
    say(inquiry, "solver-failed", "%.*s", (int)(rest ? rest - message : (ptrdiff_t)strlen(message)), message);
  }
  return HOOKE_OK;
}

/* ---- */

/* Failures that no step or tolerance cures. */
static const char *altitude_words(const struct hk_inquiry *inquiry) {
  return inquiry->system->altitudes->count == 0 ? ""
                                                : ", or altitude springs gave it energy, "
                                                  "which they do far from rest wherever "
                                                  "another altitude comes to be the shortest";
}

/* 1 if the step exceeded the limit for longer than a sudden failure: forces that rise faster than in
 * proportion, such as a callback's, end in a leap, too. */
static int grew_before(const struct hk_inquiry *inquiry) {
  const double h = inquiry->run->method->adaptive ? 0.0 : inquiry->run->schedule.step;
  return inquiry->violation.found && inquiry->violation.time < inquiry->bad_time - 3.5 * h;
}

static void judge_gain(struct hk_inquiry *inquiry) {
  say(inquiry, "model-gains-energy",
      "the model gains energy by itself, with %s as well; altitude springs do so wherever another altitude of a "
      "tetrahedron comes to be the shortest, far from rest",
      inquiry->run->method->adaptive ? "far tighter tolerances" : "16 times smaller steps");
}

/* There was no time or memory for the check. */
static void judge_unknown(struct hk_inquiry *inquiry) {
  const struct hk_violation *violation = &inquiry->violation;
  if (isnan(violation->bound))
    say(inquiry, "unknown", "why is not known: the steps that led to it were not all looked at");
  else
    say(inquiry, "unknown",
        "the step %.6g s is above %.6g s, up to which %s is certain to be stable, but whether it is above the "
        "limit itself is not known",
        inquiry->why->step, violation->bound, inquiry->run->method->name);
}

static int32_t judge_divergence(struct hk_inquiry *inquiry) {
  char what[120];
  int32_t gains = 0;
  if (judge_start(inquiry)) return HOOKE_OK;
  const int32_t status = hk_inquiry_gains(inquiry, &gains);
  if (status != HOOKE_OK) return status;
  if (gains) {
    judge_gain(inquiry);
  } else if (inquiry->sudden && !grew_before(inquiry)) {
    judge_overflow(inquiry);
  } else if (inquiry->violation.found) {
    return judge_violation(inquiry);
  } else if (inquiry->flips > 0) {
    inquiry->why->particle = NAN;
    hk_print(what, sizeof what, "went through no length (springs did so %lld times, last at t = %.6g s)",
             (long long)inquiry->flips, inquiry->flip_time);
    judge_collapse(inquiry, inquiry->flipped, what);
  } else if (judge_squares(inquiry, *hk_inquiry_last(inquiry)->t, hk_inquiry_last(inquiry)->q,
                           hk_inquiry_last(inquiry)->v)) {
    return HOOKE_OK;
  } else if (inquiry->last == NULL || inquiry->cut) {
    judge_unknown(inquiry);
  } else if (inquiry->run->method->adaptive) {
    say(inquiry, "solver-failed",
        "no spring collapsed and no callback failed, but the tolerances (rtol "
        "%.3g) let errors grow until they were larger than the motion%s",
        hooke_options_number(inquiry->run->options, "rtol"), altitude_words(inquiry));
  } else {
    say(inquiry, "step-above-limit",
        "the step %.6g s is too large for how quickly this motion changes%s; no step was seen above "
        "the limit of the motion frozen at one moment, no spring collapsed and no callback failed",
        inquiry->why->step, altitude_words(inquiry));
  }
  return HOOKE_OK;
}

/* Adds to the sentence that springs had coincident ends at the start, or particles were at a centre. */
static void tell_coincident(struct hk_inquiry *inquiry) {
  const hooke_integrator *run = inquiry->run;
  char *text = inquiry->why->sentence;
  const double *q = run->recent.first ? run->recent.first->q
                    : run->t0 == 0.0  ? inquiry->system->position
                                      : NULL;
  const int64_t count = q ? hooke_system_coincident_springs(inquiry->system, q) : 0;
  if (count > 0)
    hk_append(text, sizeof inquiry->why->sentence,
              "; %lld springs or contacts began at one place, without a direction", (long long)count);
}

static void tell_falling(struct hk_inquiry *inquiry) {
  const hooke_state *last = hk_inquiry_last(inquiry);
  const struct hk_curved curved = hk_springs_curved(inquiry->system->springs, *last->t, last->q);
  if (curved.fall > 0)
    hk_append(
        inquiry->why->sentence, sizeof inquiry->why->sentence,
        "; %lld springs have a curve that falls, and %lld were there: that is negative stiffness, by which "
        "motion grows at any step",
        (long long)curved.fall, (long long)curved.falling);
}

int32_t hk_inquiry_judge(struct hk_inquiry *inquiry) {
  inquiry->why->time = *hk_inquiry_last(inquiry)->t;
  int32_t status = HOOKE_OK;
  if (inquiry->bad_value.found)
    judge_bad_value(inquiry);
  else
    status = inquiry->run->outcome == HOOKE_DIVERGED ? judge_divergence(inquiry) : judge_solver(inquiry);
  tell_failure(inquiry);
  tell_coincident(inquiry);
  tell_falling(inquiry);
  return status;
}

/* ---- claims ---- */

void hk_why_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  static const char by[] = "the last steps of the run";
  const struct hk_why *why = measurement->object;
  if (why->cause == NULL) return;
  const int32_t known = strcmp(why->cause, "unknown") != 0;
  hk_claim(claims, "cause", known ? HOOKE_OF_PART : HOOKE_OF_UNKNOWN, by, "%.*s", (int)why->cause_length,
           why->sentence);
  if (why->sentence[why->cause_length])
    hk_claim(claims, "course", HOOKE_OF_PART, by, "%s", why->sentence + why->cause_length + strlen("; "));
  if (why->left_out[0]) hk_claim(claims, "left-out", HOOKE_OF_UNKNOWN, by, "%s", why->left_out);
}
