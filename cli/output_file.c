#include "output_file.h"

#include "os.h"
#include "report.h"
#include "setup.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

enum { FOLDER_SIZE = 4096 };

int cli_output_file_check(const struct cli_arguments *arguments, const char *flag, const char *file) {
  char folder[FOLDER_SIZE] = ".";
  const char *slash = cli_os_last_slash(file);
  if (slash) snprintf(folder, sizeof folder, "%.*s", (int)(slash - file + 1), file);
  if (cli_os_may_write(folder) != 0) {
    return cli_report(arguments, HOOKE_EXIT_IO, "%s %s: cannot write there: %s", flag, file, strerror(errno));
  }
  if (cli_os_is_other_than_file(file)) {
    return cli_report(arguments, HOOKE_EXIT_IO, "%s %s: is not a regular file; name another", flag, file);
  }
  return cli_setup_check_other_file(arguments, file);
}

int cli_output_file_check_report(const struct cli_arguments *arguments, const char *report) {
  if (!report) return HOOKE_EXIT_DONE;
  const char *library = hooke_build_fact("chartjs");
  if (!library || !library[0]) {
    return cli_report(
        arguments, HOOKE_EXIT_NOT_BUILT,
        "--report %s: this build of hooke has no Chart.js (on Debian: libjs-chart.js) and writes no "
        "reports; run without --report",
        report);
  }
  return cli_output_file_check(arguments, "--report", report);
}
