/* A thread that writes frames while steps go on: one is copied and on its way, and the next waits until it is
 * there. */
#ifndef HOOKE_IO_TRAJECTORY_FRAME_THREAD_H
#define HOOKE_IO_TRAJECTORY_FRAME_THREAD_H

#include "io/trajectory/frame_file.h"

struct hk_frame_thread;

/* For frames from `first` on. `file` has to stay. NULL without memory or threads. */
struct hk_frame_thread *hk_frame_thread_create(const struct hk_frame_file *file, int64_t first);

/* Hands the next frame over. The system's error of one before it, after which none is taken. */
int hk_frame_thread_write(struct hk_frame_thread *thread, int64_t step, const hooke_state *state);

/* Waits for the frame on its way; the system's error, as above. */
int hk_frame_thread_wait(struct hk_frame_thread *thread);

/* Waits for the last frame and ends the thread: how many frames are there in all, and the error, if there was
 * one. */
int hk_frame_thread_end(struct hk_frame_thread *thread, int64_t *written);

#endif
