#include "fit.h"

#include "report.h"

static int32_t tell(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  const struct cli_arguments *const *arguments = ctx;
  (void)kind, (void)t, (void)limit, (void)spring, (void)particle;
  if (!(*arguments)->quiet) cli_report_words(*arguments, "%s", sentence);
  return 0;
}

int cli_fit_run(const struct cli_arguments *arguments, struct cli_setup *setup, int32_t may_lack) {
  if (cli_arguments_text(arguments, "strict")) return HOOKE_EXIT_DONE;
  const double *q = hooke_state_position(setup->state);
  const int32_t status = hooke_step_fit(setup->system, q, setup->options, tell, &arguments);
  if (status == HOOKE_OK || (status == HOOKE_UNSUITED && may_lack)) return HOOKE_EXIT_DONE;
  if (status != HOOKE_UNSUITED) return cli_report_status(arguments, status);
  return cli_report(arguments, HOOKE_EXIT_USAGE, "%s", hooke_last_error());
}
