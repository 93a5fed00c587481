/* A thread that writes frames asynchronously: it holds a copy of one frame, and the next frame waits until
 * that is written. */
#ifndef HOOKE_IO_TRAJECTORY_FRAME_THREAD_H
#define HOOKE_IO_TRAJECTORY_FRAME_THREAD_H

#include "io/trajectory/frame_file.h"

struct hk_frame_thread;

/* Starts a thread for frames from `first` on. `file` must outlive it. NULL without memory or threads. */
struct hk_frame_thread *hk_frame_thread_create(const struct hk_frame_file *file, int64_t first);

/* Queues a frame. Returns the errno of an earlier failed write; after one, no frame is accepted. */
int hk_frame_thread_write(struct hk_frame_thread *thread, int64_t step, const hooke_state *state);

/* Waits for the queued frame; returns an errno, as above. */
int hk_frame_thread_wait(struct hk_frame_thread *thread);

/* Waits for the last frame and ends the thread. Returns the total number of written frames, and the errno of
 * a failure. */
int hk_frame_thread_end(struct hk_frame_thread *thread, int64_t *written);

#endif
