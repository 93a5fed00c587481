#include "output_file.h"

#include "report.h"

#include <string.h>

int cli_output_file_check(const struct cli_arguments *arguments, const char *flag, const char *file) {
  static const char *const others[][2] = {{".json", "'hooke make -o' writes a scene"},
                                          {".html", "'hooke view -o' writes a page"},
                                          {".h5", "'hooke run -o' writes a trajectory"},
                                          {".csv", "'hooke study -o' writes a table"},
                                          {".png.jpg.svg", "the page of 'hooke view' saves the picture"},
                                          {".mp4.webm.gif", "the page of 'hooke view' saves the film"}};
  const char *dot = file ? strrchr(file, '.') : NULL;
  for (int32_t i = 0; dot && i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    const char *own =
        argument->text && strcmp(argument->text, file) == 0 ? cli_describe_file(argument) : NULL;
    for (size_t k = 0; own && own[0] && k < sizeof others / sizeof others[0]; k++) {
      const char *found = strstr(others[k][0], dot), after = found ? found[strlen(dot)] : 'x';
      if ((after != '\0' && after != '.') || strcmp(own, dot + 1) == 0) continue;
      return cli_report(arguments, HOOKE_EXIT_USAGE, "%s %s: its name has to end in .%s; %s", flag, file, own,
                        others[k][1]);
    }
  }
  return HOOKE_EXIT_DONE;
}

int cli_output_file_check_report(const struct cli_arguments *arguments) {
  const char *report = cli_arguments_text(arguments, "report");
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
                                 hooke_measurement *measurement, int code) {
  const char *report = cli_arguments_text(arguments, "report");
  if (!report) return code;
  int32_t status = hooke_measurement_label(measurement, "title", cli_setup_title(arguments, setup));
  if (status == HOOKE_OK) status = hooke_measurement_write(measurement, report);
  if (status == HOOKE_OK) return code;
  cli_report_words(arguments, "%s", hooke_last_error());
  return cli_exit_code(status);
}
