/* What an inquiry may still take of time and memory. */
#include "measure/why/why.h"

#include "core/print.h"
#include "measure/counted_work/work.h"
#include "model/callbacks.h"

#include <string.h>

/* Counted work of an evaluation with a callback [s]: a script takes about so long, and nobody knows. */
static const double CALLBACK = 5e-5;

const hooke_state *hk_inquiry_last(const struct hk_inquiry *inquiry) {
  return inquiry->last ? inquiry->last : hk_recent_state(&inquiry->run->recent, 0, NULL);
}

/* Appends to a list of skipped work. */
static void leave_out(char *list, size_t size, const char *what) {
  if (strstr(list, what) == NULL) hk_append(list, size, "%s%s", list[0] ? ", " : "", what);
}

int32_t hk_inquiry_has_memory(struct hk_inquiry *inquiry, double bytes, const char *what) {
  if (bytes <= inquiry->memory_limit - inquiry->memory_used) return 1;
  leave_out(inquiry->no_space, sizeof inquiry->no_space, what);
  return 0;
}

double hk_why_work_of(const hooke_integrator *run) {
  const double callback = hk_system_calls_back(run->system) ? CALLBACK : 0.0;
  return hk_work_of(run) + callback * (double)run->count.force_evaluations;
}

void hk_inquiry_spend(struct hk_inquiry *inquiry, const hooke_integrator *run, double *before) {
  const double now = hk_why_work_of(run);
  hk_budget_spend(&inquiry->budget, now - *before);
  *before = now;
}

void hk_inquiry_end_part(struct hk_inquiry *inquiry, const char *what) {
  if (hk_budget_take_back(&inquiry->budget)) leave_out(inquiry->no_time, sizeof inquiry->no_time, what);
}
