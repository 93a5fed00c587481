#include "probes.h"

#include "os.h"

#include <string.h>

/* Sets an option from the text that was given. */
static int set(const struct cli_run *run, const char *flag, const char *name) {
  const char *text = cli_arguments_text(run->arguments, flag);
  if (!text || hooke_options_set_text(run->probe_options, name, text) == HOOKE_OK) return HOOKE_EXIT_DONE;
  return cli_report(run->arguments, HOOKE_EXIT_USAGE, "--%s %s: %s", flag, text,
                    strchr(hooke_last_error(), ' ') + 1);
}

int cli_probes_read(struct cli_run *run) {
  const struct cli_arguments *arguments = run->arguments;
  const char *probe = cli_arguments_text(arguments, "probe");
  run->probes_file = cli_arguments_text(arguments, "probes");
  if (!probe && !run->probes_file && !cli_arguments_text(arguments, "probe-every")) return HOOKE_EXIT_DONE;
  if (!probe || !run->probes_file)
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "--probe names quantities and --probes the file that they go into: give both, such as "
                      "--probe energy --probes energy.csv");
  if (run->output &&
      (strcmp(run->output, run->probes_file) == 0 || cli_os_is_same_file(run->output, run->probes_file)))
    return cli_report(arguments, HOOKE_EXIT_USAGE, "--probes %s is the file of -o, too; name another",
                      run->probes_file);
  const int32_t status = hooke_options_create("probes", &run->probe_options);
  int code = status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(arguments, status);
  if (code == HOOKE_EXIT_DONE) code = set(run, "probe", "probe");
  return code == HOOKE_EXIT_DONE ? set(run, "probe-every", "probe_every") : code;
}

int32_t cli_probes_begin(struct cli_run *run) {
  if (!run->probe_options) return HOOKE_OK;
  return hooke_probes_create(run->integrator, run->probe_options, run->probes_file, &run->probes);
}

int32_t cli_probes_end(struct cli_run *run) {
  if (!run->probes) return HOOKE_OK;
  run->lines = (int64_t)hooke_probes_number(run->probes, "lines");
  run->last_line = hooke_probes_number(run->probes, "time");
  const int32_t status = hooke_probes_close(run->probes);
  run->probes = NULL;
  return status;
}
