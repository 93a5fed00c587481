/* The tables of a check, and what it says. */
#include "core/print.h"
#include "measure/check/check.h"
#include "model/derived.h"

#include <math.h>
#include <stddef.h>

/* Memory that grows with the number of springs, for each; and the rest, for each particle [bytes]. NaN
 * without any. */
static double per_spring(const struct hk_check *check) {
  return (double)hooke_system_count(check->m->system, "spring_memory") /
         (double)hooke_system_count(check->m->system, "springs");
}

static double per_particle(const struct hk_check *check) {
  if (check->counted < 0) return NAN;
  return (double)(check->counted - hooke_system_count(check->m->system, "spring_memory")) /
         (double)hooke_system_particle_count(check->m->system);
}

/* ---- columns ---- */

#define COUNT_OF(name, what)                                                                                 \
  HOOKE_READER(double, name, struct hk_check, (double)hooke_system_count(it->m->system, what))
COUNT_OF(free_particles, "free")
COUNT_OF(springs, "springs")
COUNT_OF(triples, "bending")
COUNT_OF(tetrahedra, "altitude")
COUNT_OF(bodies, "bodies")
COUNT_OF(inside_bodies, "inside_bodies")
COUNT_OF(dropped_springs, "dropped_springs")
COUNT_OF(idle_particles, "idle")
HOOKE_READER(double, particles, struct hk_check, (double)it->m->system->particle_count)
HOOKE_READER(double, bytes_per_particle, struct hk_check, per_particle(it))
HOOKE_READER(double, bytes_per_spring, struct hk_check, per_spring(it))

static const struct hk_group *group_of(const struct hk_check *check, const char *force, int64_t row) {
  return &check->m->system->group[hk_system_first_group(check->m->system, hk_force_find(force)) + row];
}

HOOKE_READER(const void *, derived_row, struct hk_check, &it->m->system->rest->derived[row])
HOOKE_COUNTER(derived_count, struct hk_check, hooke_system_count(it->m->system, "derived"))
HOOKE_READER(const char *, force_name, struct hk_check, hooke_system_force_name(it->m->system, row))
HOOKE_COUNTER(force_count, struct hk_check, hooke_system_count(it->m->system, "forces"))
HOOKE_READER(const char *, method, struct hk_check, it ? hooke_method_name(row) : NULL)
HOOKE_READER(double, seconds, struct hk_check, it->bound[row])
HOOKE_COUNTER(method_count, struct hk_check, it ? hooke_method_count() : 0)

/* The groups of a force, with the number of its members by the name they have. */
#define GROUPS(force, members)                                                                               \
  HOOKE_READER(const void *, members##_group, struct hk_check, group_of(it, #force, row))                    \
  HOOKE_COUNTER(members##_groups, struct hk_check, hooke_system_group_count(it->m->system, #force))
GROUPS(springs, springs)
GROUPS(bending, triples)
GROUPS(altitude, tetrahedra)
#define GROUP_TABLE(title, members)                                                                          \
  {                                                                                                          \
    .name = #title, .doc = "the groups of " #members, .count = members##_groups, .row = members##_group,     \
    HOOKE_TABLE_COLUMNS(                                                                                     \
        HOOKE_COLUMN(struct hk_group, name, TEXT, "", "name of the group; empty if it has none"),            \
        HOOKE_COLUMN_AS(struct hk_group, count, members, COUNT, "", "its " #members))                        \
  }

/* ---- the tables ---- */

const struct hk_table hk_check_tables[] = {
    {.name = "check",
     .doc = "the whole scene",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY(particles, COUNT, "", "particles of the scene"),
         HOOKE_COLUMN_BY_AS(free_particles, free, COUNT, "", "those that are neither pinned nor driven"),
         HOOKE_COLUMN_BY(springs, COUNT, "", "springs that act"),
         HOOKE_COLUMN_BY(triples, COUNT, "", "triples of bending"),
         HOOKE_COLUMN_BY(tetrahedra, COUNT, "", "tetrahedra of altitude springs"),
         HOOKE_COLUMN_BY(bodies, COUNT, "", "rigid bodies"),
         HOOKE_COLUMN_BY(inside_bodies, COUNT, "", "members of forces inside them, left out"),
         HOOKE_COLUMN_BY(dropped_springs, COUNT, "", "springs without stiffness and damping, left out"),
         HOOKE_COLUMN_BY(idle_particles, COUNT, "", "pinned particles that nothing touches"),
         HOOKE_COLUMN_AS(struct hk_check, most, memory_bytes, COUNT, "B", "memory at the peak of a run"),
         HOOKE_COLUMN_AS(struct hk_check, written, memory_bytes_output, COUNT, "B",
                         "that of a run that writes its frames"),
         HOOKE_COLUMN_AS(struct hk_check, factor, memory_bytes_factor, COUNT, "B",
                         "that with a factor of the equations, which an implicit method makes where that "
                         "pays; NaN if it makes none"),
         HOOKE_COLUMN_BY(bytes_per_particle, NUMBER, "B",
                         "memory of the model for each particle; NaN without any"),
         HOOKE_COLUMN_BY(bytes_per_spring, NUMBER, "B", "the same for each spring"))},
    GROUP_TABLE(groups, springs),
    GROUP_TABLE(bending_groups, triples),
    GROUP_TABLE(altitude_groups, tetrahedra),
    {.name = "derived",
     .doc = "the numbers that parts made of their materials",
     .count = derived_count,
     .row = derived_row,
     HOOKE_TABLE_COLUMNS(HOOKE_COLUMN(struct hk_derived, part, TEXT, "", "name of the part"),
                         HOOKE_COLUMN(struct hk_derived, family, TEXT, "",
                                      "its family of springs; none for the part as a whole"),
                         HOOKE_COLUMN(struct hk_derived, name, TEXT, "", "what the number is"),
                         HOOKE_COLUMN(struct hk_derived, value, NUMBER, "", "in the unit of the row"),
                         HOOKE_COLUMN(struct hk_derived, unit, TEXT, "", "its unit"))},
    {.name = "forces",
     .doc = "the forces that the scene has",
     .value = "name",
     .count = force_count,
     HOOKE_TABLE_COLUMNS(HOOKE_COLUMN_BY_AS(force_name, name, TEXT, "", "name of the force"))},
    {.name = "step_limit",
     .doc = "the step up to which each method is certain to be stable at the start",
     .by = "method",
     .value = "seconds",
     .count = method_count,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_BY(method, TEXT, "", "name of the method"),
         HOOKE_COLUMN_BY(seconds, NUMBER, "s", "hooke_step_bound(): 0: at no step, infinity: at any"))},
    {.name = "warnings",
     .doc = "what is allowed but seldom meant; they are the first claims",
     .value = "text",
     HOOKE_TABLE_ROWS(struct hk_check, warnings.claim, warnings.count),
     HOOKE_TABLE_COLUMNS(HOOKE_COLUMN_AS(struct hk_claim, key, kind, TEXT, "", "what it warns of"),
                         HOOKE_COLUMN(struct hk_claim, text, TEXT, "", "the sentence"))},
    {.name = NULL}};

/* ---- claims ---- */

static void tell_memory(const struct hk_check *check, struct hk_claims *claims) {
  const double most = 1e-6 * (double)check->most, written = 1e-6 * (double)check->written;
  char more[256] = "";
  if (check->factor > 0)
    hk_append(more, sizeof more, "; %.3g MB more where its method finds that a factor of its equations pays",
              1e-6 * (double)check->factor - most);
  if (check->m->system->particle_count > 0)
    hk_append(more, sizeof more, "; the model takes %.1f bytes a particle", per_particle(check));
  if (hooke_system_count(check->m->system, "springs") > 0)
    hk_append(more, sizeof more, " and %.1f a spring", per_spring(check));
  hk_claim(claims, "memory", HOOKE_OF_WHOLE, "count",
           "%.3g MB at the peak of a run%s, %.3g MB if it writes its frames%s", most,
           !hooke_options_is_set(check->m->options, "process") ? " beside the program's own" : "", written,
           more);
}

static void tell_cost(const struct hk_check *check, struct hk_claims *claims) {
  const char *method = hooke_options_text(check->m->run, "method");
  const double steps =
      round(hooke_options_number(check->m->run, "duration") / hooke_options_number(check->m->run, "step"));
  if (hooke_method_is_adaptive(method) == 0 && !isnan(steps))
    hk_claim(claims, "cost", HOOKE_OF_WHOLE, "count", "%s: %.6g steps, %.3g spring-steps", method, steps,
             steps * (double)hooke_system_count(check->m->system, "springs"));
}

static void tell_left_out(const struct hk_check *check, struct hk_claims *claims) {
  const long long dropped = (long long)hooke_system_count(check->m->system, "dropped_springs"),
                  idle = (long long)hooke_system_count(check->m->system, "idle");
  if (dropped > 0)
    hk_claim(claims, "dropped", HOOKE_OF_WHOLE, "scene", "%lld %s neither stiffness nor damping", dropped,
             dropped == 1 ? "spring that has" : "springs that have");
  if (idle > 0)
    hk_claim(claims, "idle", HOOKE_OF_WHOLE, "scene", "%lld pinned %s that nothing touches", idle,
             idle == 1 ? "particle" : "particles");
}

void hk_check_claim(const hooke_measurement *measurement, struct hk_claims *claims) {
  const struct hk_check *check = measurement->object;
  for (int32_t k = 0; k < check->warnings.count; k++) {
    const struct hk_claim *warning = &check->warnings.claim[k];
    hk_claim(claims, warning->key, warning->of, warning->by, "%s", warning->text);
  }
  tell_memory(check, claims);
  tell_cost(check, claims);
  tell_left_out(check, claims);
}
