/* The full system and the lean one on the page of what a scene needs: springs as lines, at the last frame
 * that is judged. */
#ifndef HOOKE_IO_PAGE_NEEDS_PICTURE_H
#define HOOKE_IO_PAGE_NEEDS_PICTURE_H

#include "io/file/text.h"

struct hk_needs;

/* Springs drawn at most: of the groups that fit whole, the first ones; of the first group evenly if none
 * does. */
enum { HOOKE_NEEDS_PICTURE_SPRINGS = 9000 };

/* Adds "picture": the watched particles in both systems, and the springs between them; nothing while there is
 * no lean system. Failures go to the text's status. */
void hk_needs_picture_add(struct hk_text *data, const struct hk_needs *needs);

#endif
