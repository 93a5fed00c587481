/* A scene: its text, and the system and run options that were made from it. */
#ifndef HOOKE_IO_SCENE_SCENE_H
#define HOOKE_IO_SCENE_SCENE_H

#include "hooke/scene.h"

struct hooke_scene {
  char *name; /* of the file, for messages */
  char *text; /* ends with a NUL that `length` leaves out */
  int64_t length;
  hooke_system *system;
  hooke_options *run;
  char *title;
  double memory_limit; /* [bytes], 0: what the machine has */
  int32_t outside;     /* files that it names may be anywhere */
};

/* Fills system, run and title from the text, which passed the guard and the check of its tokens. On failure
 * the place of the message is a path in the text; `at_key` is set to 1 if the trouble is a key and not its
 * value, and `line` is not 0 for a syntax error, which has no path. `folder` may be NULL. */
struct hk_scene_trouble {
  int32_t at_key;
  int64_t line, column;
};
int32_t hk_scene_build(hooke_scene *scene, const char *folder, struct hk_scene_trouble *trouble);

/* Whether a text is a scene that names files, and if so its title, for the caller to free.
 * HOOKE_NO_MEMORY. */
int32_t hk_scene_names_files(const char *text, int32_t *names, char **title);

/* The scene to keep with a run of `system` by the options `run`. `whole` is NULL where `text`, which may be
 * NULL, will do; where it names files, a text for the caller to free that has their numbers in it, so that
 * the run can go on and be verified where they are not. A system that no scene can hold, such as one with
 * callbacks, keeps its text. HOOKE_NO_MEMORY. */
int32_t hk_scene_make_whole(const char *text, const hooke_system *system, const hooke_options *run,
                            char **whole);

#endif
