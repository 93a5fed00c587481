/* The full scene: its method and its step. */
#include "measure/needs/needs.h"

#include "core/print.h"
#include "core/status.h"
#include "measure/recommend/pick.h"

static const double LEAST_JUDGED = 0.05; /* of the duration: less is not significant */

int32_t hk_needs_tell_pick(double done, const char *what, void *ctx) {
  (void)what;
  return hk_needs_tell(ctx, done);
}

static int32_t refuse_pick(const struct hk_pick *pick) {
  if (pick->best.method == NULL)
    return hk_fail(HOOKE_UNSUITED, "method", "no method has a step that is stable here");
  return hk_fail(HOOKE_BAD_VALUE, "want", "%g m is not reached: the closest run, %s at %g, is %g m off",
                 pick->want, pick->best.method, pick->best.value, pick->best.error);
}

/* Without a method in the options of the run, chooses as 'run --want' would. */
static int32_t pick_method(struct hk_needs *needs) {
  struct hk_pick pick;
  if (hooke_options_is_set(needs->run, "method")) return HOOKE_OK;
  needs->under_way = "picking a method";
  int32_t status = hk_pick_run(&pick, needs->system, needs->run, HOOKE_NEEDS_STEP_SHARE * needs->want, 0,
                               NULL, hk_needs_tell_pick, needs);
  if (status == HOOKE_OK && !pick.met) status = refuse_pick(&pick);
  if (status == HOOKE_OK) status = hk_trial_set_value(needs->run, pick.best.method, pick.best.value);
  needs->method_picked = status == HOOKE_OK;
  hk_pick_release(&pick);
  return status == HOOKE_NOT_BUILT ? HOOKE_OK : status; /* then the default of the option */
}

static int32_t refuse_full(const struct hk_needs *needs) {
  return hk_fail(
      HOOKE_BAD_VALUE, "want",
      "%s, %g m: no step that was tried holds the full scene by %s to a tenth of it over a time worth "
      "judging; take a larger want, a shorter duration or another method",
      "the want", needs->want, hooke_options_text(needs->run, "method"));
}

static void say_how_it_moves(struct hk_needs *needs) {
  needs->moved = hk_needs_moved(needs, &needs->path);
  if (hk_needs_rests(needs)) {
    hk_print(needs->note, sizeof needs->note,
             "nothing moves: the watched positions stay within %.2g m of where they begin, under a "
             "thousandth of what is wanted; whether a motion needs what changes nothing here cannot be told",
             needs->moved);
  } else if (needs->moved <= needs->want) {
    hk_print(needs->note, sizeof needs->note,
             "the watched positions move by %.2g m in all, less than is wanted, so that a scene which "
             "stands still would do; take a smaller want to learn what moves them",
             needs->moved);
  }
}

int32_t hk_needs_run_full(struct hk_needs *needs) {
  if (needs->path.position) return HOOKE_OK;
  needs->pieces += 2;
  int32_t status = pick_method(needs);
  needs->pieces_done++;
  const struct hk_needs_trial trial = {needs->system, NULL};
  needs->under_way = "the full scene";
  if (status == HOOKE_OK) status = hk_needs_measure(needs, &trial, &needs->full, &needs->path);
  needs->pieces_done++;
  const double least = 1.0 + LEAST_JUDGED * (double)needs->frame_count;
  if (status == HOOKE_OK && (!needs->path.position || (double)needs->judged < least))
    status = refuse_full(needs);
  if (status == HOOKE_OK) {
    say_how_it_moves(needs);
  } else {
    hk_needs_path_release(&needs->path);
    hk_needs_path_release(&needs->displaced);
    needs->judged = needs->frame_count;
  }
  return status;
}
