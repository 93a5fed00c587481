/* Continuing from a point that another run reached, or this one before it was stopped. */
#include "integrate/loop/run_loop.h"

#include "core/status.h"

#include <math.h>
#include <string.h>

int32_t hk_integrator_stand(hooke_integrator *it, const struct hk_standing *standing, hooke_state *state) {
  struct hk_standing s = *standing;
  const struct hk_standing before = it->standing;
  it->count = s.count; /* a method continues counting from here */
  it->wall_seconds = s.wall_seconds;
  const int32_t status = hk_run_begin_later(it, state);
  if (status != HOOKE_OK) {
    it->count = before.count;
    it->wall_seconds = before.wall_seconds;
    return status;
  }
  s.t = it->t;
  s.count = it->count;
  it->standing = s;
  it->recent.step[it->recent.newest] = s.k;
  if (!it->method->adaptive || isnan(it->schedule.checkpoint)) return HOOKE_OK;
  it->point = hk_run_first_after(it->t0, it->schedule.checkpoint, it->t);
  it->restart.standing = it->standing;
  return HOOKE_OK;
}

int32_t hk_integrator_stand_at_frame(hooke_integrator *it, int64_t frame, const hooke_state *first,
                                     hooke_state *state) {
  const struct hk_schedule *s = &it->schedule;
  const int64_t k = it->method->adaptive ? 0 : frame == s->frames - 1 ? s->steps : frame * s->frame_steps;
  struct hk_standing standing = it->standing; /* with the energies at the first frame */
  standing.t0 = *first->t;
  standing.t = *state->t;
  standing.k = standing.count.steps = k;
  standing.frames = frame + 1;
  if (frame > 0) standing.count.zero_passages = -1;
  const double t = standing.t0 + (double)k * s->step;
  if (frame > 0 && memcmp(&t, &standing.t, sizeof t) != 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "frame %lld is not at the time of this run's, %.17g s",
                   (long long)frame, t);
  const int32_t status = hk_integrator_stand(it, &standing, state);
  if (status != HOOKE_OK) return status;
  hk_recent_set_first(&it->recent, first);
  it->phase = HOOKE_AT_CHECKPOINT;
  return HOOKE_OK;
}

int32_t hk_integrator_place(hooke_integrator *to, const hooke_integrator *from, int64_t step,
                            hooke_state *state) {
  struct hk_standing standing = from->standing;
  standing.k = step;
  standing.frames = 0;
  standing.count = to->count;
  standing.wall_seconds = to->wall_seconds;
  return hk_integrator_stand(to, &standing, state);
}

int32_t hk_integrator_run_on(hooke_integrator *it, const hooke_state *first, hooke_state *state) {
  hooke_state *start = NULL;
  int32_t status = hk_run_check_whole(it, state);
  if (status == HOOKE_OK) status = hk_state_create_sized(hooke_state_size(first), first->has_v, &start);
  if (status != HOOKE_OK) return status;
  hooke_state_copy(first, start);
  status = hk_run_begin(it, start);
  if (status == HOOKE_OK) {
    const int fixed = !it->method->adaptive;
    const int64_t step = fixed ? (int64_t)llround((*state->t - *start->t) / it->schedule.step) : 0;
    status = hk_integrator_place(it, it, step, state);
    hk_recent_set_first(&it->recent, start);
  }
  hooke_state_destroy(start);
  if (status == HOOKE_OK) status = hk_run_to_end(it, state);
  return hk_run_end(it, state, status);
}

/* At a checkpoint, or where a fixed-step run was stopped. */
static int can_go_on(const hooke_integrator *it, const hooke_state *state) {
  const int stopped = !it->method->adaptive && it->outcome == HOOKE_STOPPED;
  const int ready = it->phase == HOOKE_AT_CHECKPOINT || (it->phase == HOOKE_BEGUN && stopped);
  return ready && memcmp(&it->t, state->t, sizeof it->t) == 0;
}

/* The frame of this very time, if the run was stopped before it was reported. */
static int is_frame_missing(const hooke_integrator *it) {
  if (it->method->adaptive) return it->frames == 0;
  return hk_schedule_has_frame(&it->schedule, it->k) &&
         it->frames == hk_schedule_frames_before(&it->schedule, it->k);
}

int32_t hooke_integrator_resume(hooke_integrator *it, hooke_state *state) {
  int32_t status = hk_run_check_whole(it, state);
  if (status == HOOKE_OK && !can_go_on(it, state)) {
    status = hk_fail(HOOKE_BAD_CALL, NULL,
                     "there is no run to go on with: neither was a checkpoint "
                     "read, nor a run with a fixed step stopped at this state");
  }
  if (status != HOOKE_OK) return status;
  status = hk_integrator_stand(it, &it->standing, state);
  if (status == HOOKE_OK && it->k == 0 && it->frames == 0) status = hk_divergence_check(it, state, 1);
  if (status == HOOKE_OK && is_frame_missing(it)) status = hk_run_report(it, state);
  if (status == HOOKE_OK) status = hk_run_to_end(it, state);
  return hk_run_beyond(it, state, hk_run_end(it, state, status));
}
