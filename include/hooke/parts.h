/* hooke/parts.h - parts: pieces of a scene that are generated rather than listed.
 *
 *   rope   `segments` springs from `from` to `to`: stretch (neighbours), bend (two apart)
 *   cloth  nu x nv particles over two edges: structural (neighbours along u, then v), shear (both
 *          diagonals of each cell), bend (two apart along u, then v)
 *   lattice  nx x ny x nz particles over three edges: structural (neighbours along x, y, z), shear (all
 *          diagonals of the faces and the body of each cell), bend (two apart along x, y, z)
 *   mesh   particles at the vertices of a surface of triangles: structural (every edge once), bend (the two
 *          vertices opposite to each other across every edge of two triangles)
 *   strand a hair (Selle, Lentine and Fedkiw 2008) about the axis from `from` to `to`: stretch
 *          (neighbours), bend (two apart), twist (three apart), altitude (hooke_system_add_altitude() on
 *          every four consecutive particles); straight, with an extra particle in each of its `segments`,
 *          `offset` segments off the axis, or a helix of radius `curl` with `turns`
 *
 * Rope and cloth have bending along their lines of particles (option `bending`, hooke_system_add_bending()),
 * as a group "<name>.bending". Each part has either the option `mass` (shared equally; in a mesh by area) or
 * `density` (by the piece that each particle represents).
 *
 * A family that is not named has no springs. Springs follow the strain law, so a finer part of the same
 * material stretches equally. Each family has one rest length per direction, computed from the edges and not
 * from rounded positions. */
#ifndef HOOKE_PARTS_H
#define HOOKE_PARTS_H

#include "system.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Returns "name" ("rope", "cloth", "lattice", "mesh", "strand") or "summary" (one line) of part kind `kind`;
 * NULL past the last kind and for another word. */
HOOKE_API const char *hooke_part_kind(int64_t kind, const char *what);

/* Adds a part's particles, springs, triples and tetrahedra. Groups are named "<name>.<family>"; with `name`
 * NULL or "" a part gets its kind and its number among the parts as its name. `first` and `count`, if not
 * NULL, receive its particles. HOOKE_BAD_VALUE, HOOKE_BAD_CALL after commit, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_system_add_part(hooke_system *system, const char *kind, const char *name,
                                        const hooke_options *options, int64_t *first, int64_t *count);

/* Of the part called `part`: its "particles", or those "before" it, which is the number of its first one; -1
 * if there is no such part, and for another word. */
HOOKE_API int64_t hooke_system_part_count(const hooke_system *system, const char *part, const char *what);

/* Sets the options `vertices` (3 vertex_count, rows of x y z [m]) and `triangles` (3 triangle_count, rows of
 * three different vertices, counted from 0) of a mesh. Vertices at the same position become one particle, the
 * first of them (see the option `weld`); particles are numbered in the order of their first appearance.
 * Adding the part checks the mesh: it refuses triangles without area, edges of more than two triangles,
 * repeated triangles and vertices of no triangle. HOOKE_BAD_VALUE, HOOKE_NO_MEMORY. Files: hooke_mesh_read()
 * in scene.h. */
HOOKE_API int32_t hooke_mesh_set(hooke_options *options, int64_t vertex_count, const double *vertices,
                                 int64_t triangle_count, const int64_t *triangles);

#ifdef __cplusplus
}
#endif
#endif
