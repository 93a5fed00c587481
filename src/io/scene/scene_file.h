/* Reads the file of a scene, and resolves the files that it names. */
#pragma once

#include "core/table/option.h"
#include "hooke/system.h"

/* The tables "scene", "particles", "driven" and "limits": number `k`, NULL past the last. */
const struct hk_option_table *hk_scene_table(int64_t k);
/* The table of a name of hooke_options_create(); NULL, with HOOKE_BAD_VALUE recorded, if there is none. */
const struct hk_option_table *hk_options_named(const char *name);

/* The particles of a scene, and the arrays whose objects have particles, in the order of reading; the last
 * has no key. */
extern const struct hk_scene_list {
  const char *key;       /* also the name of their options */
  const char *others;    /* keys beside those of the options, each between blanks */
  const char *particles; /* key of those that a member has; NULL: one object, which adds particles */
  int32_t columns;       /* of a row of particles */
  const char *strength;  /* key of the first number of a member, if they are groups of a force */
  const char *allowed;
  int32_t (*add)(hooke_system *system, const char *name, int64_t count, const int64_t *particles,
                 const hooke_options *options);
  int32_t may_be_all; /* 1: without particles it is for all, with -1 as their count */
} hk_scene_lists[];

/* HOOKE_NO_MEMORY if a scene of `length` bytes of text may need more than `limit` (0: the machine's memory).
 */
int32_t hk_scene_require_memory(double limit, int64_t length);

/* Reads a whole file, or of a scene, which has a memory limit, the beginning that shows that it is not JSON.
 * `text` ends with a NUL; the caller frees it. HOOKE_BAD_VALUE if there is no such file, HOOKE_IO_FAILED if
 * reading fails midway, HOOKE_NO_MEMORY. The message does not name the file. */
int32_t hk_scene_read_file(const char *path, const double *memory_limit, char **text, int64_t *length);

/* The folder of a path; NULL without memory. */
char *hk_scene_folder(const char *path);

/* Resolved path of `file`, which a scene in `folder` names; the caller frees it. HOOKE_BAD_VALUE if it does
 * not exist or is outside the folder, also through links, unless the scene may name any file (`outside`),
 * whose opening shows whether it exists. */
int32_t hk_scene_find_file(const char *folder, const char *file, int32_t outside, char **path);
