/* Meshes from files. */
#pragma once

#include "hooke/scene.h"

/* HOOKE_BAD_VALUE where options that name a file have vertices or triangles, too. */
int32_t hk_mesh_check_source(const hooke_options *options);

/* hooke_mesh_read() of a file called `name` in messages, with at most `memory_limit` bytes (0: the machine's
 * memory), after that check. */
int32_t hk_mesh_read_as(const char *path, const char *name, double memory_limit, hooke_options *options);

/* The same from `length` bytes of text. */
int32_t hk_mesh_parse(const char *text, int64_t length, const char *name, double memory_limit,
                      hooke_options *options);
