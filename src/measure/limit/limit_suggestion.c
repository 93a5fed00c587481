/* Gain of changing the few springs or particles that determine a limit. */
#include "core/memory.h"
#include "core/print.h"
#include "core/utf8.h"
#include "integrate/method.h"
#include "measure/limit/limit_participation.h"
#include "measure/limit/limit_predict.h"
#include "model/force/spring.h"
#include "model/medium.h"

#include <math.h>
#include <string.h>

/* A set needs that share of the mode, and must be at most that share of the scene. */
static const double MOST_OF_THE_MODE = 0.9, SMALL = 0.1;
/* Threshold for a negligible share of a spring's stiffness, or of a particle's motion. */
static const double NOTHING = 1e-6;
/* A set with a smaller cost is not mentioned. */
static const double LEAST_COST = 1.1;
static const double ACCURACY = 1e-3;

/* A set to change: springs, or particles. */
struct set {
  int springs;
  int64_t count, of;
  double share, stiffness_share; /* of the whole mode */
  double odd;                    /* deviation of the first one from the ordinary, as a factor */
};

static int is_small(int64_t count, int64_t of) {
  return count > 0 && of > 1 && (double)count <= fmax(1.0, SMALL * (double)of);
}

static struct set spring_set(const hooke_system *system, const struct hk_participation *participation) {
  struct set set = {.springs = 1, .of = system->springs->count};
  while (set.share < MOST_OF_THE_MODE && set.count < participation->spring_count) {
    set.share += participation->spring[set.count].share;
    set.stiffness_share += participation->spring[set.count++].stiffness_share;
  }
  if (set.share < MOST_OF_THE_MODE) set.count = 0;
  return set;
}

/* None with particles of bodies: each changes the mass and the inertia of all of its body. */
static struct set particle_set(const hooke_system *system, const struct hk_participation *participation) {
  struct set set = {.of = system->particle_count - system->constrained_count};
  int32_t in_body = 0;
  while (set.share < MOST_OF_THE_MODE && set.count < participation->particle_count) {
    in_body |= hk_is_carried(system, participation->particle[set.count].particle);
    set.share += participation->particle[set.count++].share;
  }
  if (set.share < MOST_OF_THE_MODE || in_body) set.count = 0;
  return set;
}

/* ---- deviation from the ordinary ---- */

/* By geometric means: a few outliers hardly affect them. */
static void find_oddness(const hooke_system *system, const struct hk_participation *participation,
                         struct set *springs, struct set *particles) {
  const struct hk_springs *all = system->springs;
  const double kappa = hk_springs_find(all, participation->spring[0].spring, system->moment).kappa,
               mean = hk_springs_mean(all, 0, all->count, system->moment);
  double sum = 0.0;
  springs->odd = kappa > 0.0 ? log(kappa / mean) : 0.0;
  for (int64_t p = 0; p < system->particle_count; p++)
    sum += system->constrained[p] ? 0.0 : log(system->inertia[p]);
  particles->odd = sum / (double)particles->of - log(participation->particle[0].mass);
}

/* ---- effect of a change ---- */

/* The limit with the set changed by `factor`: stiffness and damping divided by it, or masses multiplied by
 * it. */
static int32_t limit_with(const hooke_system *system, const double *q, const char *method,
                          const struct hk_participation *participation, const struct set *set, double factor,
                          double *limit) {
  const int64_t size = set->springs ? system->springs->count : system->particle_count;
  double *scale = hk_new(size, sizeof(double));
  if (scale == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < size; k++)
    scale[k] = 1.0;
  for (int64_t k = 0; k < set->count; k++) {
    if (set->springs)
      scale[participation->spring[k].spring] = 1.0 / factor;
    else
      scale[participation->particle[k].particle] = factor;
  }
  const int32_t status = hk_limit_predict_within(system, q, NULL, method, set->springs ? scale : NULL,
                                                 set->springs ? NULL : scale, ACCURACY, participation->memory,
                                                 participation->budget, limit);
  hk_free(scale);
  return status;
}

/* Factor by which the given mode would be slower: the positive root g of g^2 k + g c = m, all over the whole.
 */
static double perturbed(const struct hk_participation *participation, const struct set *set, double factor) {
  const double cut = set->springs ? 1.0 - 1.0 / factor : 0.0;
  const double k = participation->stiffness_share - cut * set->stiffness_share;
  const double c = (1.0 - participation->stiffness_share) - cut * (set->share - set->stiffness_share);
  const double m = set->springs ? 1.0 : 1.0 - set->share + factor * set->share;
  return 2.0 * m / (c + sqrt(c * c + 4.0 * k * m));
}

/* The factor that makes the set as slow as the rest, for a step `gain` times larger: g^2 k + g c of its own k
 * and c. */
static double fitting_factor(const struct hk_participation *participation, const struct set *set,
                             double gain) {
  const double stiff = set->springs ? set->stiffness_share / set->share : participation->stiffness_share;
  const double factor = gain * gain * stiff + gain * (1.0 - stiff);
  const double unit = pow(10.0, floor(log10(factor)) - 1.0);
  return ceil(factor / unit * (1.0 - 1e-9)) * unit;
}

/* ---- in words ---- */

/* Two digits, without exponent up to a million: "3.5", "72", "5100". */
static const char *figure(double value, char text[24]) {
  const double unit = value >= 10.0 && value < 1e6 ? pow(10.0, floor(log10(value)) - 1.0) : 0.0;
  if (unit > 0.0)
    hk_print(text, 24, "%.0f", round(value / unit) * unit);
  else
    hk_print(text, 24, "%.2g", value);
  return text;
}

/* ", group `hem`" if all are of one named group; a single one by its number otherwise. */
static void add_place(const struct hk_participation *participation, const struct set *set, char *text,
                      size_t size) {
  if (!set->springs) {
    if (set->count == 1)
      hk_append(text, size, ", number %lld,", (long long)participation->particle[0].particle);
    return;
  }
  const char *group = participation->spring[0].group;
  int one = group[0] != '\0';
  for (int64_t k = 0; k < set->count; k++)
    one &= participation->spring[k].group == group;
  if (set->count == 1) hk_append(text, size, ", number %lld,", (long long)participation->spring[0].spring);
  if (one) hk_append(text, size, "%s group `%.60s`,", set->count == 1 ? "" : ",", group);
}

static void tell(const hooke_system *system, const struct hk_participation *participation,
                 const struct set *set, struct hk_suggestion *suggestion) {
  char *text = suggestion->sentence;
  const size_t size = sizeof suggestion->sentence;
  const int one = set->count == 1;
  char cost[24], factor[24], gain[24];
  figure(suggestion->cost, cost);
  figure(suggestion->factor, factor);
  figure(suggestion->gain, gain);
  hk_append(text, size, "%lld of %lld %s", (long long)set->count, (long long)set->of,
            set->springs ? "springs" : "free particles");
  add_place(participation, set, text, size);
  hk_append(text, size, " %s a factor %s in step; ", one ? "costs" : "cost", cost);
  int32_t damped = 0;
  for (int64_t k = 0; k < set->count && set->springs; k++)
    damped |= hk_springs_find(system->springs, participation->spring[k].spring, HOOKE_AS_GIVEN).gamma > 0.0;
  if (set->springs)
    hk_append(text, size, "softening %s%s by %s", one ? "it" : "them",
              damped ? one ? ", and its damping," : ", and their damping," : "", factor);
  else
    hk_append(text, size, "making %s %s times heavier", one ? "it" : "them", factor);
  hk_append(text, size, " allows a step %s times larger", gain);
}

/* "group 2", or "group 0 of triples" */
static void add_number(const hooke_system *system, int64_t group, char *text, size_t size) {
  const struct hk_force_row *force = system->group[group].force;
  const int springs = force->kind & HOOKE_LOOPED;
  hk_append(text, size, "group %lld%s%s", (long long)(group - hk_system_first_group(system, force)),
            springs ? "" : " of ", springs ? "" : force->members);
}

/* No small set: shares by group, the largest first. */
static void tell_groups(const hooke_system *system, const struct hk_participation *participation,
                        struct hk_suggestion *suggestion) {
  char *text = suggestion->sentence;
  const size_t size = sizeof suggestion->sentence;
  const int32_t force = hk_participation_force(participation);
  const struct hk_force_row *row = hk_force_table(force);
  if (row && !row->members) {
    hk_append(text, size, "%s limits the step, with %.0f %% of the limiting mode", row->title,
              100.0 * participation->force_share[force]);
    return;
  }
  if (!(participation->stiffness_share > 0.0) && participation->spring_count == 0) {
    hk_append(text, size, "no spring limits the step");
    return;
  }
  if (system->springs->count == 1) {
    hk_append(text, size, "the only spring limits the step");
    return;
  }
  hk_append(text, size,
            "no few springs or particles limit the step: the limiting mode is spread over the scene");
  double before = INFINITY;
  for (int k = 0; k < 3; k++) {
    int64_t best = -1;
    for (int64_t g = 0; g < participation->group_count; g++) {
      if (participation->group_share[g] < before &&
          (best < 0 || participation->group_share[g] > participation->group_share[best]))
        best = g;
    }
    if (best < 0 || participation->group_share[best] < 0.01) break;
    before = participation->group_share[best];
    hk_append(text, size, k == 0 ? " (" : ", ");
    if (hk_participation_group_name(system, best)[0] != '\0')
      hk_append(text, size, "group `%.60s`", hk_participation_group_name(system, best));
    else
      add_number(system, best, text, size);
    hk_append(text, size, " has %.0f %% of it", 100.0 * before);
  }
  if (isfinite(before)) hk_append(text, size, ")");
}

/* ---- drag and damping ---- */

/* The limit without drag, or without any damping. The latter is that of verlet, which has no limit by
 * damping, times the ratio of the two where nothing is damped. */
static int32_t limit_without(const hooke_system *system, const double *q, const char *method,
                             const struct hk_participation *participation, int32_t drag, double *limit) {
  const struct hk_stability *stability = hk_method_stability(method);
  hooke_system without = *system;
  struct hk_medium none = {.blows = 0};
  without.brake = 0.0;
  without.medium = &none;
  if (drag)
    return hk_limit_predict_within(&without, q, NULL, method, NULL, NULL, ACCURACY, participation->memory,
                                   participation->budget, limit);
  *limit = participation->undamped;
  if (stability->kind == HOOKE_STABLE_BY_POLYNOMIAL) *limit *= sqrt(stability->axis / 4.0);
  return HOOKE_OK;
}

static int32_t tell_force(const hooke_system *system, const double *q, const char *method, double limit,
                          const struct hk_participation *participation, int32_t force,
                          struct hk_suggestion *suggestion) {
  double without = 0.0;
  const int32_t drag = hk_participation_is_drag(force), bodies = system->mover_count > 0;
  int32_t status = HOOKE_OK;
  /* no method has no limit by the damping of bodies */
  if ((drag && !hk_force_table(force)->members) || (!drag && !bodies))
    status = limit_without(system, q, method, participation, drag, &without);
  if (status != HOOKE_OK) return status;
  hk_append(suggestion->sentence, sizeof suggestion->sentence, "%s%s limits the step",
            suggestion->kind ? "; " : "", drag ? "drag" : "damping");
  if (without > LEAST_COST * limit && isfinite(without)) {
    hk_append(suggestion->sentence, sizeof suggestion->sentence,
              ": without it %s would be stable up to %.6g s", method, without);
  } else if (isinf(without)) {
    hk_append(suggestion->sentence, sizeof suggestion->sentence,
              ": without it nothing would limit that of %s", method);
  }
  if (!bodies && !hk_system_is_not_linear(system))
    hk_append(suggestion->sentence, sizeof suggestion->sentence,
              "; verlet takes %s implicitly, and has no limit by it", drag ? "drag" : "damping");
  suggestion->force = 1;
  if (without > LEAST_COST * limit) suggestion->without = force;
  return HOOKE_OK;
}

/* ---- whole ---- */

const struct hk_suggestion hk_no_suggestion = {
    .cost = NAN, .factor = NAN, .gain = NAN, .gain_predicted = NAN, .without = -1, .price = {NAN, NAN}};

/* Fills in the suggestion if changing the set gains anything; otherwise `kind` stays NULL. */
static int32_t try_set(const hooke_system *system, const double *q, const char *method, double limit,
                       const struct hk_participation *participation, const struct set *set,
                       struct hk_suggestion *suggestion) {
  double without, changed;
  int32_t status = limit_with(system, q, method, participation, set, 1.0 / NOTHING, &without);
  if (status != HOOKE_OK) return status;
  if (!isfinite(without) || !(without > LEAST_COST * limit)) return HOOKE_OK;
  const double factor = fitting_factor(participation, set, without / limit);
  status = limit_with(system, q, method, participation, set, factor, &changed);
  if (status != HOOKE_OK || !(changed > LEAST_COST * limit)) return status;
  suggestion->kind = set->springs ? "soften" : "heavier";
  suggestion->count = set->count;
  suggestion->cost = without / limit;
  suggestion->factor = factor;
  suggestion->gain = changed / limit;
  suggestion->gain_predicted = perturbed(participation, set, factor);
  tell(system, participation, set, suggestion);
  return HOOKE_OK;
}

int32_t hk_suggestion_find(const hooke_system *system, const double *q, const char *method, double limit,
                           const struct hk_participation *participation, struct hk_suggestion *suggestion) {
  *suggestion = hk_no_suggestion;
  struct set first = spring_set(system, participation), second = particle_set(system, participation);
  const int springs = is_small(first.count, first.of), particles = is_small(second.count, second.of);
  if (springs && particles) find_oddness(system, participation, &first, &second);
  /* one particle and all of its springs, or one spring and its two particles: the smaller set is the outlier
   */
  if (particles &&
      (!springs || second.count < first.count || (second.count == first.count && second.odd > first.odd))) {
    const struct set other = first;
    first = second;
    second = other;
  }
  int32_t status = HOOKE_OK;
  if (limit > 0.0 && isfinite(limit)) {
    if (springs || particles) status = try_set(system, q, method, limit, participation, &first, suggestion);
    if (status == HOOKE_OK && suggestion->kind == NULL && springs && particles)
      status = try_set(system, q, method, limit, participation, &second, suggestion);
  }
  const int32_t force = hk_participation_force(participation);
  if (status == HOOKE_OK && (hk_participation_is_drag(force) || force == HOOKE_PARTICIPATION_DAMPING))
    status = tell_force(system, q, method, limit, participation, force, suggestion);
  else if (status == HOOKE_OK && suggestion->kind == NULL)
    tell_groups(system, participation, suggestion);
  hk_utf8_make_plain(suggestion->sentence);
  return status;
}

/* ---- its price ---- */

/* What is advised, or what is left out. */
static void change(const struct hk_participation *participation, const struct hk_suggestion *suggestion,
                   int32_t leaves_out, struct hk_variant *variant) {
  for (int64_t k = 0; k < suggestion->count && !leaves_out; k++) {
    if (strcmp(suggestion->kind, "heavier") == 0)
      variant->mass[participation->particle[k].particle] = suggestion->factor;
    for (int n = HOOKE_KAPPA; n <= HOOKE_GAMMA && strcmp(suggestion->kind, "soften") == 0; n++)
      variant->single[n][participation->spring[k].spring] = 1.0 / suggestion->factor;
  }
  if (!leaves_out) return;
  if (hk_participation_is_drag(suggestion->without))
    variant->without[suggestion->without] = 1;
  else
    variant->damping = 1;
}

int32_t hk_suggestion_price(const hooke_system *system, const hooke_options *run, const char *method,
                            double limit, const struct hk_participation *participation,
                            struct hk_budget *budget, struct hk_suggestion *suggestion) {
  const int32_t drag = hk_participation_is_drag(suggestion->without);
  const int32_t softer = suggestion->kind && strcmp(suggestion->kind, "soften") == 0;
  const char *const how[] = {softer ? "softened so," : "made heavier so,",
                             drag ? "without drag" : "without damping"};
  const int32_t told[] = {suggestion->kind != NULL, suggestion->without >= 0};
  int32_t status = HOOKE_OK;
  for (int k = 1; k >= 0 && status == HOOKE_OK; k--) {
    struct hk_variant variant;
    if (!told[k] || (status = hk_variant_create(system, &variant)) != HOOKE_OK) continue;
    change(participation, suggestion, k, &variant);
    status = hk_price_find(system, run, method, limit, &variant, budget, &suggestion->price);
    hk_variant_release(&variant);
    hk_append(suggestion->sentence, sizeof suggestion->sentence, "; %s ", how[k]);
    if (isnan(suggestion->price.error))
      hk_append(suggestion->sentence, sizeof suggestion->sentence, "the error of the run is not known");
    else
      hk_append(suggestion->sentence, sizeof suggestion->sentence, "the run is %.2g m off (tried)",
                suggestion->price.error);
  }
  return status;
}
