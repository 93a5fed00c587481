/* Repeats the last steps of a run, one by one, with its callbacks under observation. */
#include "measure/why/why.h"

#include "core/memory.h"
#include "model/force/drive.h"
#include "model/force/spring.h"

#include <math.h>
#include <string.h>

static const double WHOLE_RUN =
    3e7; /* particles and springs times steps, up to which the whole run is repeated */
static const double MOST_LOOKS = 400;            /* number of checks of the step along it */
static const double MOST_TURNS = 3e8;            /* springs times steps that are checked for reversal */
static const int64_t MOST_INTERNAL_STEPS = 2000; /* of an error-controlled method */
/* Of the last steps, where the failure is, every third is checked. */
enum { BEFORE = 3, LAST_STEPS = 1200, LAST_STRIDE = 3 };

/* ---- callbacks under observation ---- */

struct spied_drive {
  struct probe *probe;
  const struct hk_drive_group *real;
};

struct probe {
  const hooke_system *real;
  hooke_system system; /* the same, with other callbacks */
  struct hk_drive_group *drive;
  struct spied_drive *drive_ctx;
  struct hk_bad_value *bad_value;
};

static int is_sensible(int64_t count, const double *value) {
  for (int64_t k = 0; k < count; k++) {
    if (!(fabs(value[k]) <= HOOKE_SENSIBLE)) return 0;
  }
  return 1;
}

static int64_t first_wild(int64_t count, const double *value) {
  for (int64_t k = 0; k < count; k++) {
    if (!isfinite(value[k])) return k;
  }
  return -1;
}

static int32_t probe_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  struct probe *probe = ctx;
  const hooke_system *real = probe->real;
  const int meant = is_sensible(3 * n, q) && is_sensible(3 * n, v) && first_wild(3 * n, force) < 0;
  const int32_t value = real->force(n, t, q, v, force, real->force_ctx);
  const int64_t wild = first_wild(3 * n, force);
  if (meant && wild >= 0 && !probe->bad_value->found)
    *probe->bad_value = (struct hk_bad_value){.found = 1, .time = t, .particle = wild / 3};
  return value;
}

static int32_t probe_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                             const double *dv, double *out, void *ctx) {
  const hooke_system *real = ((const struct probe *)ctx)->real;
  return real->force_product(n, t, q, v, dq, dv, out, real->force_ctx);
}

static int32_t probe_drive(int64_t count, double t, double *q, double *v, void *ctx) {
  const struct spied_drive *own = ctx;
  struct hk_bad_value *bad_value = own->probe->bad_value;
  const int32_t value = own->real->callback(count, t, q, v, own->real->ctx);
  const int64_t wild_q = first_wild(3 * count, q), wild_v = first_wild(3 * count, v);
  const int64_t wild = wild_q >= 0 ? wild_q : wild_v;
  if (wild >= 0 && !bad_value->found) {
    *bad_value = (struct hk_bad_value){
        .found = 1, .of_drive = 1, .time = t, .particle = own->real->particle[wild / 3]};
  }
  return value;
}

static int32_t probe_create(const hooke_system *system, struct hk_bad_value *bad_value, struct probe *probe) {
  *probe = (struct probe){.real = system, .system = *system, .bad_value = bad_value};
  probe->drive = hk_new(system->drive_count, sizeof *probe->drive);
  probe->drive_ctx = hk_new(system->drive_count, sizeof *probe->drive_ctx);
  if (probe->drive == NULL || probe->drive_ctx == NULL) return HOOKE_NO_MEMORY;
  for (int64_t g = 0; g < system->drive_count; g++) {
    probe->drive[g] = system->drive[g];
    if (!system->drive[g].callback) continue;
    probe->drive_ctx[g] = (struct spied_drive){probe, &system->drive[g]};
    probe->drive[g].callback = probe_drive;
    probe->drive[g].ctx = &probe->drive_ctx[g];
  }
  probe->system.drive = probe->drive;
  if (system->force) probe->system.force = probe_force;
  if (system->force_product) probe->system.force_product = probe_product;
  probe->system.force_ctx = probe;
  return HOOKE_OK;
}

static void probe_release(struct probe *probe) {
  hk_free(probe->drive);
  hk_free(probe->drive_ctx);
}

/* ---- observations of a step ---- */

/* Springs that have reversed: in between, their length passed through zero. */
static void watch_turns(struct hk_inquiry *inquiry, const double *before, const hooke_state *state) {
  const struct hk_springs *springs = inquiry->system->springs;
  for (int64_t r = 0; r < springs->run_count; r++) {
    for (int64_t k = 0; k < springs->run[r].count; k++) {
      const struct hk_spring s = hk_run_spring(&springs->run[r], k);
      if (!(s.rest_length > 0.0)) continue;
      double cosine = 0.0;
      for (int a = 0; a < 3; a++) {
        const int64_t i = 3 * s.head + a, j = 3 * s.tail + a;
        cosine += (before[i] - before[j]) * (state->q[i] - state->q[j]);
      }
      if (!(cosine < 0.0)) continue;
      inquiry->flips++;
      inquiry->flipped = springs->run[r].first + k;
      inquiry->flip_time = *state->t;
    }
  }
}

static double largest_of(const hooke_state *state) {
  double most = 0.0;
  for (int64_t k = 0; k < 2 * state->size; k++)
    most = fmax(most, fabs(state->q[k]));
  return most;
}

/* The fastest particle of the failed step, which is still in the integrator, and the size of its numbers. */
static void look_at_damage(struct hk_inquiry *inquiry, const hooke_integrator *again) {
  const struct hk_motion *motion = again->motion;
  double most = -1.0, size = 0.0;
  for (int64_t p = 0; p < motion->n; p++) {
    double speed = 0.0;
    for (int a = 0; a < 3; a++) {
      const double v = fabs(motion->v[a][p]), q = fabs(motion->q[a][p]);
      speed = isfinite(v) && isfinite(q) ? fmax(speed, v) : (double)INFINITY;
      size = isfinite(v) && isfinite(q) ? fmax(size, fmax(q, v)) : (double)INFINITY;
    }
    const int64_t number = motion->order ? motion->order[p] : p;
    if (inquiry->system->constrained[number] || !(speed >= most)) continue;
    if (speed == most && number > inquiry->bad_particle) continue;
    most = speed;
    inquiry->bad_particle = number;
  }
  inquiry->bad_size = size;
}

/* ---- repeated steps ---- */

struct replay {
  struct hk_inquiry *inquiry;
  hooke_integrator *again;
  struct hk_node_blocks blocks;
  double *before;          /* positions one step ago */
  double size[BEFORE + 1]; /* largest number of the last steps, the newest first */
  int64_t stride;          /* steps between checks of the step */
  double work;             /* counted so far [s] */
};

static int32_t take_step(struct replay *replay, hooke_state *state) {
  const int64_t numbers = state->size;
  memcpy(replay->before, state->q, (size_t)numbers * sizeof(double));
  return hooke_integrator_step(replay->again, state, 1);
}

static void note_size(struct replay *replay, const hooke_state *state) {
  memmove(replay->size + 1, replay->size, BEFORE * sizeof(double));
  replay->size[0] = largest_of(state);
}

static int32_t walk(struct replay *replay, hooke_state *state, int64_t steps) {
  struct hk_inquiry *inquiry = replay->inquiry;
  const double springs = (double)inquiry->system->springs->count;
  int32_t status = HOOKE_OK;
  for (int k = 0; k <= BEFORE; k++)
    replay->size[k] = largest_of(state);
  replay->work = hk_why_work_of(replay->again);
  for (int64_t k = 0; k < steps && status == HOOKE_OK; k++) {
    inquiry->cut = hk_budget_ends(&inquiry->budget, "the last steps again");
    if (inquiry->cut) return HOOKE_OK;
    if (k % (steps - k > LAST_STEPS ? replay->stride : LAST_STRIDE) == 0)
      status = hk_inquiry_consider(inquiry, &replay->blocks, state);
    if (status != HOOKE_OK) return status;
    status = take_step(replay, state);
    hk_inquiry_spend(inquiry, replay->again, &replay->work);
    if (status != HOOKE_OK) break;
    note_size(replay, state);
    if (springs * (double)k <= MOST_TURNS) watch_turns(inquiry, replay->before, state);
  }
  /* on divergence the last good state is kept, and the last chance to find the step above the limit */
  if (status == HOOKE_DIVERGED) {
    inquiry->violation.tries = 0;
    inquiry->violation.pause = 0;
    const int32_t looked = hk_inquiry_consider(inquiry, &replay->blocks, state);
    if (looked != HOOKE_OK) return looked;
  }
  inquiry->reproduced = status == HOOKE_DIVERGED || status == HOOKE_SOLVER_FAILED;
  if (status == HOOKE_DIVERGED) {
    look_at_damage(inquiry, replay->again);
    inquiry->bad_time = replay->again->diverged_at;
    inquiry->size = replay->size[BEFORE - 1];
    inquiry->sudden = inquiry->size < HOOKE_SENSIBLE && !(inquiry->bad_size < 1e100);
  }
  return inquiry->reproduced ? HOOKE_OK : status;
}

/* From the last kept state; or from the first if that is cheap. */
static int32_t start(struct replay *replay, hooke_state *state, int64_t *steps) {
  struct hk_inquiry *inquiry = replay->inquiry;
  const hooke_integrator *run = inquiry->run;
  int64_t from = 0;
  const hooke_state *kept = hk_recent_state(&run->recent, 0, &from);
  const double size = (double)(inquiry->system->particle_count + hk_system_members_of(inquiry->system, NULL));
  if (!run->method->adaptive && run->recent.first && (double)run->k * size <= WHOLE_RUN) {
    kept = run->recent.first;
    from = 0;
  }
  *steps =
      run->method->adaptive ? MOST_INTERNAL_STEPS : run->k - from + (run->outcome == HOOKE_SOLVER_FAILED);
  replay->stride = 1 + (int64_t)((double)*steps / MOST_LOOKS);
  int32_t status = hooke_state_copy(kept, state);
  if (status == HOOKE_OK) status = hk_integrator_place(replay->again, run, from, state);
  return status;
}

static int32_t replay_with(struct replay *replay, const hooke_system *observed) {
  struct hk_inquiry *inquiry = replay->inquiry;
  const hooke_integrator *run = inquiry->run;
  int64_t steps = 0;
  int32_t status = hooke_integrator_create(observed, run->options, &replay->again);
  if (status != HOOKE_OK) return status;
  replay->again->thorough = 1;
  status = hk_node_blocks_begin(inquiry->system, &replay->blocks);
  replay->blocks.budget = &inquiry->budget;
  replay->before = hk_new(run->size, sizeof(double));
  if (status == HOOKE_OK && replay->before == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = start(replay, inquiry->last, &steps);
  if (status == HOOKE_OK && replay->again->recent.step[0] > 0)
    status = hk_inquiry_survey(inquiry, &replay->blocks);
  if (status == HOOKE_OK && run->outcome != HOOKE_STEP_LIMIT) status = walk(replay, inquiry->last, steps);
  hk_recent_state(&replay->again->recent, 0, &inquiry->last_step);
  /* a restarted error-controlled method takes other steps */
  if (status == HOOKE_OK && run->method->adaptive)
    status = hooke_state_copy(hk_recent_state(&run->recent, 0, NULL), inquiry->last);
  return status;
}

int32_t hk_inquiry_replay(struct hk_inquiry *inquiry) {
  struct probe probe;
  struct replay replay = {.inquiry = inquiry};
  int32_t status = probe_create(inquiry->system, &inquiry->bad_value, &probe);
  if (status == HOOKE_OK) status = replay_with(&replay, &probe.system);
  hk_node_blocks_release(&replay.blocks);
  hooke_integrator_destroy(replay.again);
  hk_free(replay.before);
  probe_release(&probe);
  return status;
}
