/* Making a diagnosis, and asking it. */
#include "measure/why.h"

#include "core/figure.h"
#include "core/handle.h"
#include "core/memory.h"
#include "core/print.h"
#include "core/status.h"
#include "integrate/integrator.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const double LEAST_SECONDS = 2.0;

static int ended_early(const hooke_integrator *run) {
  return run->outcome == HOOKE_DIVERGED || run->outcome == HOOKE_SOLVER_FAILED ||
         run->outcome == HOOKE_STEP_LIMIT;
}

static int32_t inquire(struct hooke_inquiry *inquiry) {
  int32_t status = hooke_state_create_sized(inquiry->run->size, 1, &inquiry->last);
  inquiry->excess.q = hooke_new(inquiry->run->size, sizeof(double));
  if (status == HOOKE_OK && inquiry->excess.q == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK) status = hooke_inquiry_replay(inquiry);
  if (status == HOOKE_OK) status = hooke_inquiry_judge(inquiry);
  if (status == HOOKE_OK) status = hooke_inquiry_advise(inquiry);
  if (status == HOOKE_OK && inquiry->patience.stopped) status = HOOKE_STOPPED;
  if (status == HOOKE_OK && inquiry->patience.spent)
    hooke_print(inquiry->why->left_out, sizeof inquiry->why->left_out,
                "not all was looked into: the time for it was up after %.3g s",
                inquiry->patience.until - inquiry->patience.begun);
  hooke_free(inquiry->excess.q);
  hooke_state_destroy(inquiry->last);
  return status;
}

/* [s] */
static double usual_time(const hooke_integrator *run) {
  return fmax(LEAST_SECONDS, run->wall_seconds);
}

int32_t hooke_why_create(const hooke_integrator *run, double seconds, hooke_progress *progress, void *ctx,
                         hooke_why **out) {
  if (run->system == NULL) {
    return hooke_fail(HOOKE_UNSUITED, NULL,
                      "a first-order problem has no springs to blame; its own message is all "
                      "there is");
  }
  if (!ended_early(run)) {
    return hooke_fail(HOOKE_BAD_CALL, NULL,
                      "the last run of this integrator did not blow up: there is nothing to explain");
  }
  if (!HOOKE_HAVE_LAPACK) {
    return hooke_fail(HOOKE_NOT_BUILT, NULL, "explanations need LAPACK, which this build is without");
  }
  if (run->recent.room == 0) {
    return hooke_fail(HOOKE_NO_MEMORY, NULL, "there was no memory for the last good state, to explain from");
  }
  struct hooke_why *why = hooke_handle_new("hooke_why", sizeof *why);
  if (why == NULL) return HOOKE_NO_MEMORY;
  why->time = why->limit = why->particle = why->step = NAN;
  why->noticed = run->outcome == HOOKE_DIVERGED ? run->diverged_at : run->t;
  if (!run->method->adaptive) why->step = run->schedule.step;
  snprintf(why->method, sizeof why->method, "%s", run->method->name);
  struct hooke_inquiry inquiry = {
      .run = run,
      .system = run->system,
      .why = why,
      .bad_particle = -1,
      .flipped = -1,
      .patience = hooke_patience_of(seconds > 0.0 ? seconds : usual_time(run), progress, ctx)};
  const int32_t status = inquire(&inquiry);
  if (status == HOOKE_OK)
    *out = why;
  else
    hooke_why_destroy(why);
  return status;
}

int32_t hooke_why_create_kept(const hooke_system *system, const hooke_options *run, const hooke_state *first,
                              const hooke_state *last, double seconds, hooke_progress *progress, void *ctx,
                              hooke_why **out) {
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  int32_t status = hooke_integrator_create(system, run, &integrator);
  if (status != HOOKE_OK) return status;
  status = hooke_state_create_sized(integrator->size, 1, &state);
  if (status == HOOKE_OK) status = hooke_state_copy(last, state);
  if (status == HOOKE_OK) {
    status = hooke_integrator_run_on(integrator, first, state);
    if (status == HOOKE_OK || ended_early(integrator))
      status = hooke_why_create(integrator, seconds, progress, ctx, out);
  }
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  return status;
}

void hooke_why_destroy(hooke_why *why) {
  if (why == NULL) return;
  for (int64_t k = 0; k < why->advice_count; k++)
    hooke_options_destroy(why->advice[k].run);
  hooke_handle_free(why);
}

const char *hooke_why_text(const hooke_why *why, const char *what) {
  if (strcmp(what, "cause") == 0) return why->cause;
  if (strcmp(what, "sentence") == 0) return why->sentence;
  if (strcmp(what, "left_out") == 0) return why->left_out;
  return strcmp(what, "method") == 0 ? why->method : NULL;
}

double hooke_why_number(const hooke_why *why, const char *what) {
  const struct hooke_figure numbers[] = {{"time", why->time},
                                         {"noticed", why->noticed},
                                         {"step", why->step},
                                         {"limit", why->limit},
                                         {"particle", why->particle}};
  return HOOKE_FIGURE(numbers, what);
}

int64_t hooke_why_blame_count(const hooke_why *why) {
  return why->blame_count;
}

double hooke_why_blame_number(const hooke_why *why, int64_t place, const char *what) {
  if (place < 0 || place >= why->blame_count) return NAN;
  const struct hooke_why_blame *blame = &why->blame[place];
  if (strcmp(what, "spring") == 0) return (double)blame->spring;
  if (strcmp(what, "first") == 0) return (double)blame->first;
  if (strcmp(what, "second") == 0) return (double)blame->second;
  return strcmp(what, "share") == 0 ? blame->share : (double)NAN;
}

const char *hooke_why_blame_text(const hooke_why *why, int64_t place, const char *what) {
  if (place < 0 || place >= why->blame_count || strcmp(what, "group") != 0) return NULL;
  return why->blame[place].group;
}

int64_t hooke_why_advice_count(const hooke_why *why) {
  return why->advice_count;
}

const char *hooke_why_advice_text(const hooke_why *why, int64_t place, const char *what) {
  if (place < 0 || place >= why->advice_count) return NULL;
  const struct hooke_why_advice *advice = &why->advice[place];
  if (strcmp(what, "change") == 0) return advice->change;
  if (strcmp(what, "option") == 0) return advice->option;
  return strcmp(what, "value") == 0 ? advice->value : NULL;
}

int32_t hooke_why_apply(const hooke_options *changes, hooke_options *run) {
  int32_t status = HOOKE_OK;
  for (int64_t k = 0; k < hooke_options_row_count(changes) && status == HOOKE_OK; k++) {
    const char *name = hooke_options_row(changes, k, "name");
    if (!hooke_options_is_set(changes, name)) continue;
    if (hooke_options_number_count(changes, name) > 0)
      status = hooke_options_set_number(run, name, hooke_options_number(changes, name));
    else
      status = hooke_options_set_text(run, name, hooke_options_text(changes, name));
  }
  return status;
}

int32_t hooke_why_advice_apply(const hooke_why *why, int64_t place, hooke_options *run) {
  if (place < 0 || place >= why->advice_count) {
    return hooke_fail(HOOKE_BAD_VALUE, "place", "there is no advice %lld; there are %lld", (long long)place,
                      (long long)why->advice_count);
  }
  const int32_t status = hooke_run_options_require(run, "run");
  if (status != HOOKE_OK) return status;
  const hooke_options *changes = why->advice[place].run;
  return changes ? hooke_why_apply(changes, run) : HOOKE_OK;
}
