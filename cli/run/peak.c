#include "peak.h"

#include "os.h"
#include "report.h"

struct cli_peak cli_peak_look(void) {
  struct cli_peak peak = {0, 0};
  cli_os_memory(&peak.now, &peak.most);
  return peak;
}

/* Memory of the estimate of the error, whose other runs take that of the method after this one. */
static int32_t count_estimate(const struct cli_setup *setup, const hooke_integrator *integrator,
                              int64_t *bytes) {
  hooke_measurement *estimate = NULL;
  int32_t status = hooke_measurement_create("estimate", setup->system, NULL, NULL, &estimate);
  if (status == HOOKE_OK) status = hooke_estimate_begin(estimate, integrator, setup->state);
  if (status == HOOKE_OK) *bytes = (int64_t)hooke_measurement_number(estimate, "estimate", 0, "memory_bytes");
  hooke_measurement_destroy(estimate);
  return status;
}

/* The pages of libhdf5 and its buffers, and a queued frame, as measured on cloths. */
static int64_t count_output(const struct cli_setup *setup) {
  return 4800000 + 150 * hooke_system_particle_count(setup->system);
}

/* As in `hooke run`: warnings are observed unless it is quiet. */
static int32_t count_method(const struct cli_arguments *arguments, const struct cli_setup *setup,
                            int64_t *bytes, int64_t *kept, int64_t *factor) {
  hooke_integrator *integrator = NULL;
  char warnings[HOOKE_WARNINGS_SIZE] = ""; /* which check tells by itself */
  int32_t status = hooke_integrator_create(setup->system, setup->options, &integrator);
  if (status == HOOKE_OK && !arguments->quiet)
    status = hooke_integrator_on_warning(integrator, cli_warnings_hear, warnings);
  if (status == HOOKE_OK) *bytes = hooke_integrator_count(integrator, "memory_bytes");
  if (status == HOOKE_OK) *factor = hooke_integrator_count(integrator, "factor_bytes");
  if (*factor < 0) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && hooke_integrator_count(integrator, "frames") > 0)
    status = count_estimate(setup, integrator, kept);
  hooke_integrator_destroy(integrator);
  return status;
}

int cli_peak_of_run(const struct cli_arguments *arguments, const struct cli_setup *setup,
                    struct cli_peak loaded, struct cli_foretold *foretold) {
  const char *method = hooke_options_text(setup->options, "method");
  const int32_t adaptive = hooke_method_is_adaptive(method);
  const int32_t can_run = !(adaptive >= 0 && !hooke_method_is_built(method)) &&
                          !(adaptive == 0 && hooke_options_number_count(setup->options, "step") == 0);
  const int64_t model = hooke_system_count(setup->system, "memory") +
                        (2 * hooke_state_size(setup->state) + 1) * (int64_t)sizeof(double);
  int64_t of_method = 0, of_factor = 0, kept = 0;
  const int32_t status = can_run ? count_method(arguments, setup, &of_method, &kept, &of_factor) : HOOKE_OK;
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  const int64_t running = (loaded.now > 0 ? loaded.now : model) + of_method + kept;
  foretold->most = running > loaded.most ? running : loaded.most;
  foretold->written = foretold->most + count_output(setup);
  if (of_factor > 0)
    foretold->factor = running + of_factor > foretold->most ? running + of_factor : foretold->most;
  foretold->counted = model + of_method;
  return HOOKE_EXIT_DONE;
}
