/* hooke/scene.h - scene files (JSON) and meshes: reading them, and writing a system as a scene.
 *
 * They need a build with jansson; without it these functions return HOOKE_NOT_BUILT. */
#ifndef HOOKE_SCENE_H
#define HOOKE_SCENE_H

#include "parts.h"
#include "integrator.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hooke_scene hooke_scene;

/* Reads a scene file (format: docs/scene.md). The system is built but not committed, so that a callback may
 * still be added; the caller owns the scene. HOOKE_BAD_VALUE with "file:line:column: path: what is wrong,
 * what is allowed", also for a file that cannot be opened, the scene's or one that it names; HOOKE_IO_FAILED
 * if reading breaks off; HOOKE_NO_MEMORY; HOOKE_NOT_BUILT.
 * A trajectory file stands for the scene that it was made from, with the options of its run; files that the
 * scene names are then looked for beside the trajectory. HOOKE_BAD_VALUE if it holds no scene.
 *
 * `limits` are options "limits": "memory" [GB] that the scene may need, without it what the machine has or its
 * limit on the address space; "outside", 1: the scene may name files anywhere. NULL: the defaults, which hold
 * for anybody's scene. HOOKE_NO_MEMORY says what a scene that is too large would need; it comes before anything
 * is allocated. */
HOOKE_API int32_t hooke_scene_load(const char *path, const hooke_options *limits, hooke_scene **scene);

/* The same from `length` bytes of text; `name` stands for the file in messages (NULL: "scene"), `folder` is
 * where files named in the scene are looked up (NULL: none are allowed). */
HOOKE_API int32_t hooke_scene_parse(const char *text, int64_t length, const char *name, const char *folder,
                                    const hooke_options *limits, hooke_scene **scene);

/* Commits the system of the scene; like hooke_system_commit(), with messages that give the place in the file.
 */
HOOKE_API int32_t hooke_scene_commit(hooke_scene *scene);

/* Gives the system what options of a "scene" say of it: all but the title. HOOKE_BAD_VALUE, HOOKE_BAD_CALL
 * after commit. */
HOOKE_API int32_t hooke_scene_options_apply(const hooke_options *options, hooke_system *system);

/* Writes a committed system as a scene file: parts and spring groups by the options that they were made from,
 * the rest number by number, so that loading it gives the same system to the bit. Particles of parts come
 * after the others there. `title` and `run` (options of a run) may be NULL. An older file is replaced when
 * the new one is complete. HOOKE_UNSUITED for a system with callbacks, HOOKE_BAD_CALL before commit,
 * HOOKE_IO_FAILED, HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_scene_write(const char *path, const hooke_system *system, const char *title,
                                    const hooke_options *run);

/* The same as a scene of its own: its text is what would be written, its system is made from that and not
 * committed. `name` and `folder` are as in hooke_scene_parse(); the caller owns the scene. Failures are those
 * of both, but for the file's. */
HOOKE_API int32_t hooke_scene_of_system(const hooke_system *system, const char *title,
                                        const hooke_options *run, const char *name, const char *folder,
                                        hooke_scene **scene);

/* Releases the scene, its system and its options. NULL is allowed. */
HOOKE_API void hooke_scene_destroy(hooke_scene *scene);

/* What it holds; owned by the scene. The options are those of `run` and may be changed. */
HOOKE_API hooke_system *hooke_scene_system(hooke_scene *scene);
HOOKE_API hooke_options *hooke_scene_run_options(hooke_scene *scene);
HOOKE_API const char *hooke_scene_title(const hooke_scene *scene);
HOOKE_API const char *hooke_scene_text(const hooke_scene *scene);

/* ---- meshes ---- */

/* Reads an OBJ file into the options of a mesh, as hooke_mesh_set() does: its vertices `v` and its faces `f`,
 * those of more than three corners cut into triangles from their first corner. Texture, normals, names and
 * materials are passed over. The mesh is then checked with the `transform` and `weld` that the options have,
 * so set these before: HOOKE_BAD_VALUE says what is wrong with "file:line: ", its vertices counted from 1 as
 * in the file. Any build can; no library is needed. HOOKE_IO_FAILED if reading breaks off,
 * HOOKE_NO_MEMORY. */
HOOKE_API int32_t hooke_mesh_read(const char *path, hooke_options *options);

#ifdef __cplusplus
}
#endif
#endif
