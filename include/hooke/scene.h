/* hooke/scene.h - scene files (JSON) and meshes: reads them, and writes a system as a scene. */
#ifndef HOOKE_SCENE_H
#define HOOKE_SCENE_H

#include "parts.h"
#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_scene hooke_scene;

/* Reads a scene file (format: docs/scene.md). The system is built but not committed, so that the caller can
 * still add a callback; the caller owns the scene. HOOKE_BAD_VALUE with "file:line:column: path: what is
 * wrong, what is allowed", also if the scene file or a file that it names cannot be opened; HOOKE_IO_FAILED
 * if reading fails midway; HOOKE_NO_MEMORY; HOOKE_NOT_BUILT.
 * A trajectory file loads the scene that it was made from, with the options of its run; files that the scene
 * names are then looked up beside the trajectory. HOOKE_BAD_VALUE if it holds no scene. Callbacks of the run
 * are missing in it, and nothing runs (HOOKE_UNSUITED) until they are given again.
 *
 * `limits` are options "limits": "memory" is the maximum memory [GB] that the scene may need, by default the
 * machine's memory or its limit on the address space; "outside" 1 lets the scene name files anywhere;
 * "set" changes the text before it is read, by lines PATH=VALUE (docs/scene.md), and is refused for a
 * trajectory. NULL: the defaults, which are safe for scenes from any source. The message of HOOKE_NO_MEMORY
 * says how much memory too large a scene would need; it is returned before anything is allocated. */
HOOKE_API int32_t hooke_scene_load(const char *path, const hooke_options *limits, hooke_scene **scene);

/* The same from `length` bytes of text; `name` replaces the file name in messages (NULL: "scene"), `folder`
 * is where files named in the scene are looked up (NULL: none are allowed). */
HOOKE_API int32_t hooke_scene_parse(const char *text, int64_t length, const char *name, const char *folder,
                                    const hooke_options *limits, hooke_scene **scene);

/* Commits the system of the scene like hooke_system_commit(), with messages that give the place in the file.
 */
HOOKE_API int32_t hooke_scene_commit(hooke_scene *scene);

/* Applies options of a "scene", all but the title, to the system. HOOKE_BAD_VALUE, HOOKE_BAD_CALL after
 * commit. */
HOOKE_API int32_t hooke_scene_options_apply(const hooke_options *options, hooke_system *system);

/* Adds what a scene has under `key`, with options of that name: a group of "springs", "bending" or "anchors",
 * one of "bodies", "driven" particles, "loads" or one of "obstacles" (a count of -1: for all free particles),
 * each with `count` numbers of particles, those of one spring or triple after the other; or "particles" with
 * all that they have, and a count of 0. `name` may be NULL. HOOKE_BAD_VALUE, HOOKE_BAD_CALL after commit,
 * HOOKE_NO_MEMORY; the system is then as it was. */
HOOKE_API int32_t hooke_system_add_members(hooke_system *system, const char *key, const char *name,
                                           int64_t count, const int64_t *particles,
                                           const hooke_options *options);

/* Writes a committed system as a scene file: parts and spring groups by their options, the rest number by
 * number. Loading it gives the same system to the bit. Particles of parts come after the others in it.
 * `title` and `run` (options of a run) may be NULL. An older file is replaced when the new one is complete.
 * HOOKE_BAD_VALUE for a file that its scene names.
 * HOOKE_UNSUITED for a system with callbacks, HOOKE_BAD_CALL before commit, HOOKE_IO_FAILED, HOOKE_NO_MEMORY.
 */
HOOKE_API int32_t hooke_scene_write(const char *path, const hooke_system *system, const char *title,
                                    const hooke_options *run);

/* The same as a scene object: its text is the text that would be written, and its system is made from that
 * text and not committed. `title` may be NULL; `name` and `folder`, or NULL, are as in hooke_scene_parse().
 * The caller owns the scene. Failures are those of both functions, except those of files. */
HOOKE_API int32_t hooke_scene_of_system(const hooke_system *system, const char *title,
                                        const hooke_options *run, const char *name, const char *folder,
                                        hooke_scene **scene);

/* The same for the scene that starts at a state of the system (`start` in the format), such as one at rest;
 * NULL: where it starts. `title`, `name` and `folder` may be NULL as there. */
HOOKE_API int32_t hooke_scene_of_state(const hooke_system *system, const hooke_state *state,
                                       const char *title, const hooke_options *run, const char *name,
                                       const char *folder, hooke_scene **scene);

/* HOOKE_BAD_VALUE if `path` is, by any name, one of the files that the scene was read from: its own, meshes,
 * arrays. What writes results of its system refuses such a file, too. HOOKE_IO_FAILED if no file could be
 * written there: in a folder that is not there, over a device, over a file that a run is writing.
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_scene_check_output(const hooke_scene *scene, const char *path);

/* Releases the scene, its system and its options. NULL is allowed. */
HOOKE_API void hooke_scene_destroy(hooke_scene *scene);

/* Contents of the scene, which owns them. The options are those of `run` and may be changed. The texts are
 * its "title", "" if it has none, and the "text" that it was read from; NULL for another word. */
HOOKE_API hooke_system *hooke_scene_system(hooke_scene *scene);
HOOKE_API hooke_options *hooke_scene_run_options(hooke_scene *scene);
HOOKE_API const char *hooke_scene_text(const hooke_scene *scene, const char *what);

/* ---- meshes ---- */

/* Reads the vertices `v` and faces `f` of an OBJ file into the options of a mesh, as hooke_mesh_set() does;
 * faces of more than three corners are cut into triangles from their first corner. Texture, normals, names
 * and materials are ignored. It then checks the mesh with the `transform` and `weld` of the options, so set
 * these before. The message of HOOKE_BAD_VALUE begins with "file:line: " and counts vertices from 1 as in the
 * file. It needs no optional library. HOOKE_IO_FAILED if reading fails midway,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_mesh_read(const char *path, hooke_options *options);

#ifdef __cplusplus
}
#endif
#endif
