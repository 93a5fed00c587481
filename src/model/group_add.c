/* Adding a group: what a call gives is checked alike for every force that has members. */
#include "core/print.h"
#include "core/status.h"
#include "model/system.h"

/* "between[3][0]", or "particles[3]" where members have one particle. */
static int32_t fail_at(const struct hk_force_row *force, int64_t k, int end) {
  return force->member_particles > 1
             ? hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld][%d]", force->place, (long long)k, end)
             : hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld]", force->place, (long long)k);
}

static int32_t refuse_repeated(const struct hk_force_row *force, const int64_t *particle, int64_t k) {
  static const char *const numbers[] = {"no", "one", "two", "three", "four"};
  const int last = force->member_particles - 1;
  char list[128] = "";
  for (int e = 0; e <= last; e++)
    hk_append(list, sizeof list, "%s%lld", e == 0 ? "" : e == last ? " and " : ", ", (long long)particle[e]);
  hk_fail(HOOKE_BAD_VALUE, NULL, "particles %s; a %s has %s different ones", list, force->member,
          numbers[last + 1]);
  return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld]", force->place, (long long)k);
}

/* 1, with a message, for a particle that does not move freely and has to. */
static int refuse_held(const hooke_system *system, int64_t particle) {
  const uint8_t how = system->constrained[particle];
  if (how == 0) return 0;
  hk_fail(HOOKE_BAD_VALUE, NULL, "particle %lld is %s; allowed: particles that are neither pinned nor driven",
          (long long)particle, how == HOOKE_IS_PINNED ? "pinned" : "driven");
  return 1;
}

int32_t hk_groups_check_free(const hooke_system *system) {
  for (int64_t g = 0; g < system->group_count; g++) {
    const struct hk_group *group = &system->group[g];
    for (int64_t k = 0; k < group->count && group->force->on_free; k++) {
      if (!refuse_held(system, group->particle[0][k])) continue;
      fail_at(group->force, k, 0);
      return hk_fail_within(HOOKE_BAD_VALUE, "%s[%lld]", group->force->name,
                            (long long)(g - hk_system_first_group(system, group->force)));
    }
  }
  return HOOKE_OK;
}

static int32_t check_particles(const hooke_system *system, const struct hk_addition *added) {
  const struct hk_force_row *force = added->force;
  const int ends = force->member_particles;
  for (int64_t k = 0; k < added->count; k++) {
    const int64_t *particle = added->particles + ends * k;
    for (int e = 0; e < ends; e++) {
      const int exists = particle[e] >= 0 && particle[e] < system->particle_count;
      if (exists && !(force->on_free && refuse_held(system, particle[e]))) continue;
      if (!exists) hk_fail_index(NULL, "there is no particle", (double)particle[e], system->particle_count);
      return fail_at(force, k, e);
    }
    for (int e = 1; e < ends && !force->is_drag; e++) { /* a segment repeats its end */
      for (int other = 0; other < e; other++)
        if (particle[e] == particle[other]) return refuse_repeated(force, particle, k);
    }
  }
  return HOOKE_OK;
}

/* One number, or one row of `columns` for each member. */
static int32_t check_counts(const struct hk_addition *added) {
  const struct hk_option_table *table = added->force->options;
  const int each_has = added->force->width[HOOKE_KAPPA] > 0;
  for (int32_t r = 0; table && each_has && r < table->row_count; r++) {
    const struct hk_option_row *row = &table->rows[r];
    const int64_t each = row->columns > 0 ? row->columns : 1;
    if (row->type != HOOKE_OPTION_NUMBERS) continue;
    const int64_t given = hooke_options_number_count(added->options, row->name);
    if (given == 0 || given == each * added->count || (given == 1 && each == 1)) continue;
    return hk_fail(HOOKE_BAD_VALUE, row->name, "%lld values for %lld %s; allowed: %s", (long long)given,
                   (long long)added->count, added->force->members,
                   each > 1 ? "three for each" : "one, or one for each");
  }
  return HOOKE_OK;
}

static int32_t check(const hooke_system *system, const struct hk_addition *added) {
  const struct hk_force_row *force = added->force;
  int32_t status = hk_system_require_open(system);
  if (status == HOOKE_OK && force->options)
    status = hk_options_require(added->options, force->options, "options", force->name);
  if (status == HOOKE_OK && force->options) status = hk_options_check_required(added->options);
  if (status == HOOKE_OK && added->count < 0)
    status = hk_fail(HOOKE_BAD_VALUE, force->place, "%lld %s; 0 or more are allowed", (long long)added->count,
                     force->members);
  if (status != HOOKE_OK) return status;
  status = hk_system_check_more(system, force, added->count);
  if (status != HOOKE_OK) return hk_fail_within(status, "%s", force->place);
  status = check_particles(system, added);
  return status == HOOKE_OK ? check_counts(added) : status;
}

int32_t hk_group_begin(const hooke_system *system, const struct hk_addition *added, struct hk_group *group) {
  *group = (struct hk_group){.force = added->force,
                             .count = added->count,
                             .from_part = added->from_part,
                             .part = (int32_t)system->part_count - 1};
  int32_t status = check(system, added);
  if (status == HOOKE_OK) status = hk_group_allocate(group, added->name);
  const int ends = added->force->member_particles;
  for (int e = 0; e < ends && status == HOOKE_OK; e++)
    for (int64_t k = 0; k < group->count; k++)
      group->particle[e][k] = (int32_t)added->particles[ends * k + e];
  return status;
}

const char *const hk_group_names[] = {"stiffness", "damping", "rest_length", "points"};

void hk_group_fill(struct hk_group *group, const hooke_options *options) {
  for (int what = 0; what < 3; what++) {
    const int64_t given =
        group->force->width[what] == 1 ? hooke_options_number_count(options, hk_group_names[what]) : 0;
    const double *value = given > 0 ? hooke_options_numbers(options, hk_group_names[what]) : NULL;
    for (int64_t k = 0; k < group->count && value; k++)
      group->number[what][k] = value[given > 1 ? k : 0];
  }
}

int32_t hk_group_end(hooke_system *system, int32_t status, struct hk_group *group) {
  if (status == HOOKE_OK) return hk_system_add_group(system, group);
  hk_group_release(group);
  return status;
}
