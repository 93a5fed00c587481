#include "output_file.h"

#include "report.h"

int cli_output_file_check(const struct cli_arguments *arguments, const char *flag, const char *file) {
  return cli_setup_check_other_file(arguments, flag, file);
}

int cli_output_file_check_report(const struct cli_arguments *arguments, const char *report) {
  if (!report) return HOOKE_EXIT_DONE;
  const char *library = hooke_build_fact("chartjs");
  if (!library || !library[0]) {
    return cli_report(arguments, HOOKE_EXIT_NOT_BUILT,
                      "--report %s: this build of hooke has no Chart.js (on Debian: libjs-chart.js) and "
                      "writes no reports; run without --report",
                      report);
  }
  return cli_output_file_check(arguments, "--report", report);
}

int cli_output_file_write_report(const struct cli_arguments *arguments, const struct cli_setup *setup,
                                 hooke_measurement *measurement, const char *command, int code) {
  const char *report = cli_arguments_text(arguments, "report");
  if (!report) return code;
  int32_t status = hooke_measurement_label(measurement, "title", cli_setup_title(arguments, setup));
  if (status == HOOKE_OK) status = hooke_measurement_label(measurement, "command", command);
  if (status == HOOKE_OK) status = hooke_measurement_write(measurement, report);
  if (status == HOOKE_OK) return code;
  cli_report_words(arguments, "%s", hooke_last_error());
  return cli_exit_code(status);
}
