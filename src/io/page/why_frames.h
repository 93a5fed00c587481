/* The steps around the trouble on the page of an explanation. */
#ifndef HOOKE_IO_PAGE_WHY_FRAMES_H
#define HOOKE_IO_PAGE_WHY_FRAMES_H

#include "io/file/text.h"
#include "measure/why/why.h"

/* Adds, where steps can be taken again, "energy" (of every step around the trouble), "picture" (springs, and
 * the mode that grows), "frames" (steps to play), "advised" (the same by the first advice with a fixed step)
 * and "limits" (of the method, along the way). Failures go to the text's status. */
void hk_why_frames_add(struct hk_text *data, const struct hk_why *why, const hooke_options *run);

#endif
