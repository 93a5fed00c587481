/* A scene: its text, and the system and run options that were made from it. */
#ifndef HOOKE_IO_SCENE_H
#define HOOKE_IO_SCENE_H

#include "hooke/io.h"

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
struct hooke_scene_trouble {
  int32_t at_key;
  int64_t line, column;
};
int32_t hooke_scene_build(hooke_scene *scene, const char *folder, struct hooke_scene_trouble *trouble);

#endif
