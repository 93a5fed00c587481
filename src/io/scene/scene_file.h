/* Reading the file of a scene, and finding the files that it names. */
#ifndef HOOKE_IO_SCENE_SCENE_FILE_H
#define HOOKE_IO_SCENE_SCENE_FILE_H

#include "core/table/option.h"
#include "io/scene/json_scan.h"

/* The tables "scene", "particles", "driven" and "limits": number `k`, NULL past the last. */
const struct hk_option_table *hk_scene_table(int64_t k);

/* Reads a whole file, checking it on the way, so that a hopeless one is refused early (a guard of NULL takes
 * any bytes). `text` is the caller's to free and ends with a NUL. HOOKE_BAD_VALUE if there is no such file or
 * the guard refuses it, HOOKE_IO_FAILED if reading breaks off, HOOKE_NO_MEMORY. The message is without the
 * name of the file. */
int32_t hk_scene_read_file(const char *path, struct hk_json_guard *guard, char **text, int64_t *length);

/* The folder that a path is in; NULL if there is no memory. */
char *hk_scene_folder(const char *path);

/* The real path of `file`, which a scene in `folder` names; the caller frees it. Refused, HOOKE_BAD_VALUE, if
 * it does not exist or is not inside the folder, through links neither. */
int32_t hk_scene_find_file(const char *folder, const char *file, char **path);

/* The same where the caller lets the scene name any file; whether it exists is seen when it is opened. */
int32_t hk_scene_find_any(const char *folder, const char *file, char **path);

#endif
