/* The keys of a scene that do not belong to a part, springs or a run. */
#include "io/scene/scene_file.h"
#include "core/table/option.h"
#include "core/status.h"
#include "hooke/scene.h"

#include <string.h>

static const struct hk_option_row scene_rows[] = {
    {.name = "title", .type = HOOKE_OPTION_TEXT, .doc = "free text"},
    {.name = "gravity", HOOKE_OPTION_VECTOR("m/s^2"), .doc = "acceleration of every free particle"},
    {.name = "drag", HOOKE_OPTION_NOT_NEGATIVE("N s/m"), .doc = "ether drag f = -c v on every free particle"},
    {.name = "dynamics",
     .type = HOOKE_OPTION_CHOICE,
     .words = "inertial overdamped",
     .fallback = "inertial",
     .doc = "overdamped: drag v = f, without inertia"},
};

static const struct hk_option_table scene_table = {"scene", HOOKE_OPTION_ROWS(scene_rows)};

static const struct hk_option_row particle_rows[] = {
    {.name = "position",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "m",
     .min_count = 3,
     .columns = 3,
     .required = 1,
     .doc = "one row a particle"},
    {.name = "velocity",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "m/s",
     .min_count = 3,
     .columns = 3,
     .doc = "one row a particle; without it all are at rest"},
    {.name = "mass",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "kg",
     .high = 1e300,
     .above_low = 1,
     .min_count = 1,
     .doc = "one number, or one a particle; without gravity an overdamped scene needs none"},
    {.name = "pinned",
     .type = HOOKE_OPTION_NUMBERS,
     .whole = 1,
     .high = 2147483647,
     .doc = "numbers of particles that are held still"},
};

static const struct hk_option_table particle_table = {"particles", HOOKE_OPTION_ROWS(particle_rows)};

static const struct hk_option_row drive_rows[] = {
    {.name = "motion",
     .type = HOOKE_OPTION_CHOICE,
     .words = "harmonic table",
     .required = 1,
     .doc = "kind of motion"},
    {.name = "amplitude", HOOKE_OPTION_VECTOR("m"), .doc = "harmonic: largest displacement"},
    {.name = "frequency", HOOKE_OPTION_NOT_NEGATIVE("Hz"), .doc = "harmonic: oscillations a second"},
    {.name = "phase", .type = HOOKE_OPTION_NUMBER, .unit = "rad", .doc = "harmonic: angle at time 0"},
    {.name = "time",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "s",
     .min_count = 2,
     .doc = "table: ascending times"},
    {.name = "position",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "m",
     .min_count = 6,
     .columns = 3,
     .doc = "table: displacement at each time"},
};

static const struct hk_option_table drive_table = {"driven", HOOKE_OPTION_ROWS(drive_rows)};

static const struct hk_option_row body_rows[] = {
    {.name = "project",
     HOOKE_OPTION_UNSET,
     .doc = "true: velocities become those of the nearest rigid motion"},
};

static const struct hk_option_table body_table = {"bodies", HOOKE_OPTION_ROWS(body_rows)};

static const struct hk_option_row bending_rows[] = {
    {.name = "coefficient",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "N/m",
     .low = 0.0,
     .high = 1e300,
     .min_count = 1,
     .required = 1,
     .doc = "c of the energy c/2 |q_a - 2 q_b + q_c|^2, one number or one for each triple"},
};

static const struct hk_option_table bending_table = {"bending", HOOKE_OPTION_ROWS(bending_rows)};

static const struct hk_option_row limit_rows[] = {
    {.name = "memory",
     HOOKE_OPTION_POSITIVE("GB"),
     .doc = "memory that the scene may need; what the machine has if not given"},
    {.name = "outside",
     HOOKE_OPTION_UNSET,
     .doc = "the scene may name files anywhere, and not in its folder alone"},
};

static const struct hk_option_table limit_table = {"limits", HOOKE_OPTION_ROWS(limit_rows)};

const struct hk_option_table *hk_scene_table(int64_t k) {
  static const struct hk_option_table *const tables[] = {
      &scene_table, &particle_table, &drive_table, &body_table, &bending_table, &limit_table, NULL};
  return tables[k];
}

int32_t hooke_scene_options_apply(const hooke_options *options, hooke_system *system) {
  if (options == NULL || hk_options_table(options) != &scene_table) {
    return hk_fail(
        HOOKE_BAD_VALUE, NULL,
        "the options are not those of a scene; make them with hooke_options_create(\"scene\", ...)");
  }
  int32_t status = HOOKE_OK;
  if (hooke_options_is_set(options, "gravity"))
    status = hooke_system_set_gravity(system, hooke_options_numbers(options, "gravity"));
  if (status == HOOKE_OK && hooke_options_is_set(options, "drag"))
    status = hooke_system_set_drag(system, hooke_options_number(options, "drag"));
  if (status == HOOKE_OK) status = hooke_system_set_dynamics(system, hooke_options_text(options, "dynamics"));
  return status;
}
