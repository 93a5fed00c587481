/* The tables of modes. */
#include "measure/modes/modes.h"

#include <stddef.h>

HOOKE_READER(double, share, struct hk_modes, it->mode[row / it->part_count].share[row % it->part_count])
HOOKE_READER(const char *, name, struct hk_modes, it->part[row % it->part_count].name)
HOOKE_READER(double, mass_x, struct hk_modes, it->mode[row].mass[0])
HOOKE_READER(double, mass_y, struct hk_modes, it->mode[row].mass[1])
HOOKE_READER(double, mass_z, struct hk_modes, it->mode[row].mass[2])
HOOKE_COUNTER(length, struct hk_modes, 3 * it->system->particle_count)
HOOKE_COUNTER(parts, struct hk_modes, it->part_count > 0 ? it->part_count : 1)
HOOKE_COUNTER(shares, struct hk_modes, it->count * it->part_count)

const struct hk_table hk_modes_tables[] = {
    {.name = "modes",
     .doc = "the state, and its motions without stiffness",
     .record = 1,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_modes, time, NUMBER, "s", "time of the state"),
         HOOKE_COLUMN(struct hk_modes, zero_modes, COUNT, "",
                      "modes without stiffness, which are not among the others; NaN where not all are known"),
         HOOKE_COLUMN(struct hk_modes, translations, COUNT, "",
                      "of those found, translations of a connected piece as a whole"),
         HOOKE_COLUMN(struct hk_modes, rotations, COUNT, "",
                      "of those found, rotations of a connected piece as a whole"),
         HOOKE_COLUMN(struct hk_modes, mechanisms, COUNT, "",
                      "of those found, motions that deform a piece, which no force opposes"),
         HOOKE_COLUMN(struct hk_modes, unstable, COUNT, "", "modes of those found that grow"),
         HOOKE_COLUMN(struct hk_modes, unknowns, COUNT, "", "modes that there are"),
         HOOKE_COLUMN(struct hk_modes, residual, NUMBER, "N",
                      "largest force on a free particle, or whole force on a body, with all at rest"),
         HOOKE_COLUMN(struct hk_modes, largest_force, NUMBER, "N", "largest force of a spring"))},
    {.name = "rows",
     .key = "modes",
     .doc = "the modes that have stiffness, the lowest first: those that grow, then by frequency; in an "
            "overdamped scene all by growth, the slowest to come back first",
     HOOKE_TABLE_ROWS(struct hk_modes, mode, count),
     .length = length,
     .series_in_json = 1,
     .lists = {{"effective_mass", "mass_x", "mass_y", "mass_z"}},
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN(struct hk_mode, omega, NUMBER, "rad/s",
                      "frequency without damping; NaN of a mode that grows, and in an overdamped scene"),
         HOOKE_COLUMN(struct hk_mode, frequency, NUMBER, "Hz", "the same over 2 pi"),
         HOOKE_COLUMN(struct hk_mode, damping_ratio, NUMBER, "",
                      "of the mode without damping, x.Cx/(2 omega x.Mx); 1: critical"),
         HOOKE_COLUMN(struct hk_mode, growth, NUMBER, "1/s",
                      "growth of one that is pushed away, without damping; in an overdamped scene of every "
                      "mode, below 0 of one that decays"),
         HOOKE_COLUMN_BY(mass_x, NUMBER, "kg", "effective mass along x, (x.M e)^2/x.Mx"),
         HOOKE_COLUMN_BY(mass_y, NUMBER, "kg", "effective mass along y"),
         HOOKE_COLUMN_BY(mass_z, NUMBER, "kg", "effective mass along z"),
         HOOKE_COLUMN(struct hk_mode, shape, SERIES, "",
                      "3n displacements, particle by particle, of largest length 1"))},
    {.name = "groups",
     .doc = "shares of groups and forces in each mode",
     .inside = "rows",
     .count = shares,
     .inner = parts,
     HOOKE_TABLE_COLUMNS(
         HOOKE_COLUMN_ALONG(INNER, name, name, TEXT, "",
                            "name of the group, or of the force that is in none; turning of bodies: what "
                            "forces on rigid bodies do to that"),
         HOOKE_COLUMN_BY(share, NUMBER, "",
                         "its part of the mode's stiffness over the sum of all magnitudes, -1 to 1: below 0 "
                         "where it pushes away"))},
    {.name = NULL}};
