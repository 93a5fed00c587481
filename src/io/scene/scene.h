/* A scene: its text, and the system and run options made from it. */
#pragma once

#include "hooke/scene.h"

struct hooke_scene {
  char *name; /* of the file, for messages */
  char *text; /* ends with a NUL that `length` does not count */
  char *json; /* the text as hk_json_open() gives it; NULL once committed */
  int64_t length;
  hooke_system *system;
  hooke_options *run;
  char *title;
  double memory_limit; /* [bytes]; 0: the machine's memory */
  char *set;           /* lines PATH=VALUE that change the text; NULL: none */
  int32_t outside;     /* files that it names may be anywhere */
};

/* Fills system, run and title from `json`. `folder` may be NULL. The message of a failure has its place in
 * the text; that of HOOKE_BAD_VALUE has a line for each fault. */
int32_t hk_scene_build(hooke_scene *scene, const char *folder);

/* Changes the text by the lines of `set`. HOOKE_BAD_VALUE with the path of the line, HOOKE_NO_MEMORY. */
int32_t hk_scene_set(hooke_scene *scene);

/* Prefixes name, line and column to the last failure, whose place is a path in the text; `at_key` is 1 if the
 * fault is a key and not its value. Returns `status`. */
int32_t hk_scene_place(int32_t status, const hooke_scene *scene, int32_t at_key);

/* The scene to store with a run of `system` by the options `run`. `whole` is NULL if `text`, which may be
 * NULL, suffices. If `system` was read from files that it names, `whole` is a text with their numbers, which
 * the caller frees, so that the run can be continued and verified without the files. A system that no scene
 * can hold, such as one with callbacks, keeps its text. HOOKE_NO_MEMORY. */
int32_t hk_scene_make_whole(const char *text, const hooke_system *system, const hooke_options *run,
                            char **whole);
