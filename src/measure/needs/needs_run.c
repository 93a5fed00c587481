/* One run of a variant: the watched positions at every frame, and the cost. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/random.h"
#include "core/status.h"
#include "measure/trial/trial.h"
#include "model/coordinates/coordinates.h"

#include <math.h>
#include <string.h>

static const double DISPLACEMENT = 0.01; /* of the wanted error: who can live with that has no exact start */
static const uint64_t SEED = 1;          /* of the displaced start */
static const double RESTS = 1e-3;        /* of the wanted error: a smaller motion shows nothing */

int32_t hk_needs_tell(struct hk_needs *needs, double fraction) {
  if (needs->turn) return hk_turn_tell(fraction, needs->turn);
  return hk_stage_tell(fraction, &needs->stage);
}

int32_t hk_needs_rests(const struct hk_needs *needs) {
  return needs->moved <= RESTS * needs->want * needs->wants.length;
}

int32_t hk_needs_set_step(const struct hk_needs_cost *cost, hooke_options *run) {
  return hk_trial_set_value(run, hooke_options_text(run, "method"),
                            isnan(cost->step) ? cost->rtol : cost->step);
}

int32_t hk_needs_path_create(const struct hk_needs *needs, struct hk_needs_path *path) {
  path->recorded = 0;
  path->position = hk_new(needs->frame_count, (size_t)(3 * needs->watch_count + 1) * sizeof *path->position);
  const int32_t status = hk_watched_series_create(needs->wants.list, needs->frame_count, &path->values);
  path->values.time = needs->path_time;
  return path->position ? status : HOOKE_NO_MEMORY;
}

void hk_needs_path_release(struct hk_needs_path *path) {
  hk_free(path->position);
  hk_watched_series_release(&path->values);
  memset(path, 0, sizeof *path);
}

/* Largest distance of a watched position, of `a` at a frame and of `b` at another; NaN if one is. */
static double distance_at(const struct hk_needs *needs, const struct hk_needs_path *a, int64_t frame,
                          const struct hk_needs_path *b, int64_t other) {
  const int64_t size = 3 * needs->watch_count;
  const double *x = a->position + frame * size, *y = b->position + other * size;
  double most = 0.0;
  for (int64_t k = 0; k < size; k += 3) {
    const double dx = x[k] - y[k], dy = x[k + 1] - y[k + 1], dz = x[k + 2] - y[k + 2];
    const double square = (dx * dx + dy * dy) + dz * dz;
    if (!(square <= most)) most = square;
    if (isnan(most)) break;
  }
  return sqrt(most);
}

/* Relative wants are so of the full system, once that was run. */
static void find_bounds(const struct hk_needs *needs, const struct hk_needs_path *path,
                        double bound[HOOKE_WANTS]) {
  const struct hk_needs_path *full = needs->path.position ? &needs->path : path;
  hk_wants_bounds(&needs->wants, &full->values, full->recorded, bound);
}

static double error_at(const struct hk_needs *needs, const double bound[HOOKE_WANTS],
                       const struct hk_needs_path *a, const struct hk_needs_path *b, int64_t frame) {
  const double far = distance_at(needs, a, frame, b, frame);
  return needs->wants.list ? hk_wants_error(&needs->wants, bound, &a->values, &b->values, frame, far) : far;
}

double hk_needs_distance(const struct hk_needs *needs, const struct hk_needs_path *a,
                         const struct hk_needs_path *b) {
  double most = 0.0, bound[HOOKE_WANTS];
  find_bounds(needs, a, bound);
  for (int64_t f = 0; f < needs->judged && f < a->recorded && f < b->recorded; f++) {
    const double distance = error_at(needs, bound, a, b, f);
    if (!(distance <= most)) most = distance;
    if (isnan(most)) break;
  }
  return most;
}

void hk_needs_find_each(struct hk_needs *needs) {
  const struct hk_needs_path *lean = &needs->lean.path, *full = &needs->path;
  const int64_t frames = lean->recorded < needs->judged ? lean->recorded : needs->judged;
  double far = 0.0;
  for (int64_t f = 0; f < frames; f++)
    far = fmax(far, distance_at(needs, lean, f, full, f));
  hk_wants_find(&needs->wants, &lean->values, &full->values, full->recorded, frames, far, needs->own_error,
                needs->found);
}

double hk_needs_moved(const struct hk_needs *needs, const struct hk_needs_path *path) {
  double most = 0.0;
  for (int64_t f = 1; f < needs->judged && f < path->recorded; f++)
    most = fmax(most, distance_at(needs, path, 0, path, f));
  return most;
}

double hk_needs_time(const struct hk_needs *needs, int64_t frame) {
  return fmin((double)frame * needs->every, needs->duration);
}

int64_t hk_needs_agreed(const struct hk_needs *needs, const struct hk_needs_path *a,
                        const struct hk_needs_path *b, double bound) {
  int64_t frames = 0;
  double limit[HOOKE_WANTS];
  find_bounds(needs, a, limit);
  while (frames < needs->judged && frames < a->recorded && frames < b->recorded &&
         error_at(needs, limit, a, b, frames) <= bound) {
    frames++;
  }
  return frames;
}

/* ---- one run ---- */

static void note_forces(struct hk_needs *needs, int64_t frame, const hooke_state *state) {
  const struct hk_springs *springs = needs->m->system->springs;
  if (frame == 0) memset(needs->largest_force, 0, (size_t)springs->count * sizeof(double));
  struct hk_scaler scaler = {.t = hooke_state_time(state)};
  for (int64_t r = 0; r < springs->run_count; r++) {
    const struct hk_run *run = &springs->run[r];
    for (int64_t k = 0; k < run->count; k++) {
      const struct hk_spring spring = hk_run_spring_at(run, k, &scaler);
      struct hk_stretch stretch;
      hk_spring_stretch(&spring, hooke_state_position(state), hooke_state_velocity(state), &stretch);
      double *largest = &needs->largest_force[run->first + k];
      *largest = fmax(*largest, fabs(stretch.tension));
    }
  }
}

static int32_t see_frame(int64_t frame, int64_t step, const hooke_state *state, void *ctx) {
  struct hk_needs_recorder *recorder = ctx;
  const struct hk_needs *needs = recorder->needs;
  struct hk_needs_path *path = recorder->path;
  recorder->last_step = (double)step;
  if (recorder->judges) hk_soundness_see(&recorder->soundness, state);
  if (path == NULL || path->recorded >= needs->frame_count) return 0;
  if (recorder->trial->map == NULL && !recorder->displaced) note_forces(recorder->needs, frame, state);
  double *row = path->position + path->recorded++ * 3 * needs->watch_count;
  for (int64_t k = 0; k < needs->watch_count; k++) {
    const double *q = hooke_state_position(state);
    if (recorder->trial->map)
      hk_variant_place(recorder->trial->map, needs->watch[k], q, row + 3 * k);
    else
      memcpy(row + 3 * k, q + 3 * needs->watch[k], 3 * sizeof(double));
  }
  hk_needs_keep_values(needs, recorder->trial, &recorder->moved, state, path);
  return 0;
}

static int32_t see_progress(double fraction, void *ctx) {
  struct hk_needs_recorder *recorder = ctx;
  return hk_needs_tell(recorder->needs, recorder->share_begun + recorder->fraction * fraction);
}

/* All variants by the same, particle by particle of the full system. */
static void see_start(hooke_state *state, void *ctx) {
  const struct hk_needs_recorder *recorder = ctx;
  const hooke_system *full = recorder->needs->m->system, *own = recorder->trial->system;
  const struct hk_variant_map *map = recorder->trial->map;
  const double length = DISPLACEMENT * recorder->needs->want * recorder->needs->wants.length;
  uint64_t random = SEED;
  for (int64_t p = 0; p < full->particle_count && recorder->displaced; p++) {
    const int64_t to = map ? map->to[p] : p;
    for (int64_t a = 0; a < 3; a++) {
      const double way = length * hk_random_normal(&random);
      if (to >= 0 && own->inverse_mass[to] > 0.0) hooke_state_position(state)[3 * to + a] += way;
    }
  }
  if (recorder->displaced) hk_movers_renew(own, hooke_state_position(state), hooke_state_velocity(state));
}

static int32_t judge_begin(struct hk_needs_recorder *recorder, const hooke_options *options) {
  hooke_state *state = NULL;
  const char *method = hooke_options_text(options, "method");
  recorder->sound = 1;
  if (!recorder->judges) return HOOKE_OK;
  const double step = hooke_method_is_adaptive(method) ? NAN : hooke_options_number(options, "step");
  int32_t status = hooke_state_create(recorder->trial->system, &state);
  if (status == HOOKE_OK)
    status = hk_soundness_begin(&recorder->soundness, recorder->trial->system, method, step, state,
                                recorder->needs->frame_count);
  hooke_state_destroy(state);
  return status;
}

static int32_t judge_end(struct hk_needs_recorder *recorder, int32_t finished) {
  int32_t status = HOOKE_OK;
  if (recorder->judges && finished) status = hk_soundness_find_limits(&recorder->soundness, NULL);
  if (recorder->judges) recorder->sound = hk_soundness_holds(&recorder->soundness);
  hk_soundness_release(&recorder->soundness);
  return status;
}

int32_t hk_needs_run_once(struct hk_needs_recorder *recorder, const hooke_options *options, int32_t *finished,
                          struct hk_needs_cost *cost) {
  const struct hk_listener listener = {.on_progress = see_progress,
                                       .on_frame = see_frame,
                                       .on_start = see_start,
                                       .most_work = recorder->needs->most_work,
                                       .serial = recorder->needs->turn && recorder->needs->turn->serial,
                                       .ctx = recorder};
  struct hk_run_cost taken = {.wall_seconds = NAN, .force_evaluations = NAN, .work = NAN, .atol = NAN};
  struct hk_frames none = {.system = recorder->trial->system};
  if (recorder->path) recorder->path->recorded = 0;
  recorder->needs->runs++;
  *finished = 0;
  int32_t status = judge_begin(recorder, options);
  if (status == HOOKE_OK) status = hk_needs_move_watched(recorder->needs, recorder->trial, &recorder->moved);
  if (status == HOOKE_OK) status = hk_frames_run(&none, options, &listener, &taken);
  cost->wall_seconds = taken.wall_seconds;
  cost->force_evaluations = taken.force_evaluations;
  cost->work = taken.work;
  cost->atol = isnan(cost->rtol) ? NAN : taken.atol;
  cost->steps = recorder->last_step;
  hk_watched_release(&recorder->moved);
  *finished = status == HOOKE_OK && !taken.too_long;
  const int32_t judged = judge_end(recorder, *finished);
  if (judged != HOOKE_OK) return judged;
  return taken.too_long || hk_trial_gave_up(status) ? HOOKE_OK : status;
}

/* ---- pieces side by side ---- */

void hk_needs_name(struct hk_needs *own, const char *what) {
  if (own->shown) *own->shown = what;
}

struct pieces {
  struct hk_needs *own; /* a copy for each */
  struct hk_stage *stage;
  int64_t first;
  hk_needs_piece *piece;
};

static int32_t run_piece(struct hk_turn *turn, void *ctx) {
  const struct pieces *pieces = ctx;
  struct hk_needs *own = &pieces->own[turn->number];
  own->turn = turn;
  own->shown = turn->worker == 0 ? &pieces->stage->what : NULL;
  return pieces->piece(own, pieces->first + turn->number);
}

int32_t hk_needs_run_pieces(struct hk_needs *needs, int64_t first, int64_t count, hk_needs_piece *piece,
                            double most, int64_t *counted) {
  struct pieces pieces = {hk_new(count, sizeof *needs), &needs->stage, first, piece};
  int64_t k;
  if (pieces.own == NULL) return HOOKE_NO_MEMORY;
  for (k = 0; k < count; k++) {
    pieces.own[k] = *needs;
    pieces.own[k].runs = 0;
    pieces.own[k].trial_work = 0.0;
  }
  const int32_t status =
      hk_run_side_by_side(needs->m, 0, count, run_piece, &pieces, hk_stage_tell, &needs->stage);
  for (k = 0; k < count && needs->trial_work < most; k++) {
    needs->runs += pieces.own[k].runs;
    needs->trial_work += pieces.own[k].trial_work;
    needs->spread = fmax(needs->spread, pieces.own[k].spread);
  }
  if (counted) *counted = k;
  hk_free(pieces.own);
  return status;
}
