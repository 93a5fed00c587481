/* The keys of a scene that do not belong to a part, springs or a run. */
#include "io/scene/scene_file.h"
#include "core/table/option.h"
#include "core/status.h"
#include "hooke/scene.h"
#include "model/course.h"
#include "model/medium.h"

#include <string.h>

static const struct hk_option_row wind_rows[] = {
    HOOKE_OPTION("time", HOOKE_OPTION_COUNTED(2, 0), NULL, "ascending times", .unit = "s", .required = 1),
    HOOKE_OPTION("velocity", HOOKE_OPTION_VECTORS("m/s", 2, 0), NULL, "velocity at each time", .required = 1),
};

static const struct hk_option_table wind_table = {"wind", HOOKE_OPTION_ROWS(wind_rows)};

static const struct hk_option_row start_rows[] = {
    HOOKE_OPTION("position", HOOKE_OPTION_VECTORS("m", 1, 0), NULL, "one row a particle, those of parts, too",
                 .required = 1),
    HOOKE_OPTION("velocity", HOOKE_OPTION_VECTORS("m/s", 1, 0), NULL,
                 "one row a particle; without it those of the particles"),
};

static const struct hk_option_table start_table = {"start", HOOKE_OPTION_ROWS(start_rows)};

static const struct hk_option_row scene_rows[] = {
    HOOKE_OPTION("title", .type = HOOKE_OPTION_TEXT, NULL, "free text"),
    HOOKE_OPTION("gravity", HOOKE_OPTION_VECTOR("m/s^2"), NULL, "acceleration of every free particle"),
    HOOKE_OPTION("drag", HOOKE_OPTION_EACH("N s/m"), NULL,
                 "drag f = -c (v - u) on every free particle, u the wind; one number, or one a particle"),
    HOOKE_OPTION("quadratic_drag", HOOKE_OPTION_EACH("kg/m"), NULL,
                 "drag f = -c |v - u| (v - u) on every free particle; one number, or one a particle"),
    HOOKE_OPTION("wind", HOOKE_OPTION_VECTOR("m/s"), NULL,
                 "velocity of the medium in all kinds of drag; constant, or a table", .family = &wind_table),
    HOOKE_OPTION("dynamics", HOOKE_OPTION_ONE_OF("inertial overdamped"), "inertial",
                 "overdamped: drag v = f, without inertia"),
    HOOKE_OPTION("start", .type = HOOKE_OPTION_FAMILY, NULL, "where the motion starts, if not undeformed",
                 .family = &start_table),
};

static const struct hk_option_table scene_table = {"scene", HOOKE_OPTION_ROWS(scene_rows)};

static const struct hk_option_row particle_rows[] = {
    HOOKE_OPTION("position", HOOKE_OPTION_VECTORS("m", 1, 0), NULL, "one row a particle", .required = 1),
    HOOKE_OPTION("velocity", HOOKE_OPTION_VECTORS("m/s", 1, 0), NULL,
                 "one row a particle; without it all are at rest"),
    HOOKE_OPTION("mass", HOOKE_OPTION_EACH_POSITIVE("kg"), NULL,
                 "one number, or one a particle; without gravity an overdamped scene needs none"),
    HOOKE_OPTION("pinned", HOOKE_OPTION_WHOLES(0, INT32_MAX, 0, 0), NULL,
                 "numbers or names of particles that are held still", .particles = 1),
    HOOKE_OPTION("gravity_factor", HOOKE_OPTION_COUNTED(1, 0), NULL,
                 "factor on gravity, weight less buoyancy over weight: one number, or one a particle"),
};

static const struct hk_option_table particle_table = {"particles", HOOKE_OPTION_ROWS(particle_rows)};

static const struct hk_option_row drive_rows[] = {
    HOOKE_OPTION("motion", HOOKE_OPTION_ONE_OF("harmonic table"), NULL, "kind of motion", .required = 1),
    HOOKE_OPTION("amplitude", HOOKE_OPTION_VECTOR("m"), NULL, "largest displacement along each axis",
                 .required = 1, .only = "harmonic"),
    HOOKE_COURSE_OPTIONS(NULL, NULL, NULL),
    HOOKE_OPTION("position", HOOKE_OPTION_VECTORS("m", 2, 0), NULL, "displacement at each time",
                 .required = 1, .only = "table"),
};

static const struct hk_option_table drive_table = {"driven", HOOKE_OPTION_ROWS(drive_rows)};

static const struct hk_option_row body_rows[] = {
    HOOKE_OPTION("project", .type = HOOKE_OPTION_FLAG, "false",
                 "true: velocities become those of the nearest rigid motion"),
};

static const struct hk_option_table body_table = {"bodies", HOOKE_OPTION_ROWS(body_rows)};

static const struct hk_option_row bending_rows[] = {
    HOOKE_OPTION("coefficient", HOOKE_OPTION_EACH("N/m"), NULL,
                 "c of the energy c/2 |q_a - 2 q_b + q_c|^2, one number or one for each triple",
                 .required = 1),
};

static const struct hk_option_table bending_table = {"bending", HOOKE_OPTION_ROWS(bending_rows)};

static const struct hk_option_row limit_rows[] = {
    HOOKE_OPTION("memory", HOOKE_OPTION_POSITIVE("GB"), NULL,
                 "memory that the scene may need; what the machine has if not given"),
    HOOKE_OPTION("outside", .type = HOOKE_OPTION_FLAG, "false",
                 "the scene may name files anywhere, and not in its folder alone"),
    HOOKE_OPTION(
        "set", .type = HOOKE_OPTION_TEXT, NULL,
        "PATH=VALUE: sets a key of the scene, or of a part, group, anchor or body by its name; several",
        .word_lists = 1, .example = "run.step=1ms"),
};

static const struct hk_option_table limit_table = {"limits", HOOKE_OPTION_ROWS(limit_rows)};

const struct hk_option_table *hk_scene_table(int64_t k) {
  static const struct hk_option_table *const tables[] = {
      &scene_table, &particle_table, &drive_table, &body_table, &bending_table, &limit_table, NULL};
  return tables[k];
}

static int32_t apply_wind(const hooke_options *options, hooke_system *system) {
  const double *constant = hooke_options_numbers(options, "wind");
  if (constant) return hk_medium_set_wind(system, 0, NULL, constant);
  const int64_t samples = hooke_options_number_count(options, "wind.time"),
                rows = hooke_options_number_count(options, "wind.velocity") / 3;
  if (samples == 0 || rows != samples)
    return hk_fail(HOOKE_BAD_VALUE, "wind",
                   "%lld times and %lld velocities given; allowed: one for each time", (long long)samples,
                   (long long)rows);
  return hk_medium_set_wind(system, samples, hooke_options_numbers(options, "wind.time"),
                            hooke_options_numbers(options, "wind.velocity"));
}

static int32_t apply_start(const hooke_options *options, hooke_system *system) {
  const int64_t count = hooke_options_number_count(options, "start.position") / 3,
                moving = hooke_options_number_count(options, "start.velocity") / 3;
  if (moving > 0 && moving != count)
    return hk_fail(HOOKE_BAD_VALUE, "start.velocity",
                   "%lld velocities for %lld places; allowed: one for each", (long long)moving,
                   (long long)count);
  return hooke_system_start_at(system, count, hooke_options_numbers(options, "start.position"),
                               hooke_options_numbers(options, "start.velocity"));
}

int32_t hooke_scene_options_apply(const hooke_options *options, hooke_system *system) {
  int32_t status = hk_options_require(options, &scene_table, "options", "scene");
  if (status == HOOKE_OK && hooke_options_is_set(options, "gravity"))
    status = hooke_system_set_gravity(system, hooke_options_numbers(options, "gravity"));
  if (status == HOOKE_OK && hooke_options_is_set(options, "drag"))
    status = hk_medium_set_drag(system, hooke_options_number_count(options, "drag"),
                                hooke_options_numbers(options, "drag"));
  if (status == HOOKE_OK && hooke_options_is_set(options, "quadratic_drag"))
    status = hk_medium_set_quadratic_drag(system, hooke_options_number_count(options, "quadratic_drag"),
                                          hooke_options_numbers(options, "quadratic_drag"));
  if (status == HOOKE_OK && hooke_options_is_set(options, "wind")) status = apply_wind(options, system);
  if (status == HOOKE_OK) status = hooke_system_set_dynamics(system, hooke_options_text(options, "dynamics"));
  if (status == HOOKE_OK && hk_options_has_family(options, "start")) status = apply_start(options, system);
  return status;
}
