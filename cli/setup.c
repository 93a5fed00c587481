#include "setup.h"
#include "os.h"
#include "report.h"
#include "watch.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { READ_SIZE = 1 << 16 };

static int32_t load_text(FILE *file, const hooke_options *limits, hooke_scene **scene) {
  char *text = NULL;
  size_t length = 0, size = 0, got;
  int32_t status = HOOKE_OK;
  do {
    if (size - length < READ_SIZE) {
      char *larger = realloc(text, size = 2 * size + READ_SIZE);
      if (!larger) status = HOOKE_NO_MEMORY;
      text = larger ? larger : text;
    }
    got = status == HOOKE_OK ? fread(text + length, 1, size - length, file) : 0;
    length += got;
  } while (got > 0);
  if (status == HOOKE_OK)
    status = hooke_scene_parse(text, (int64_t)length, "standard input", ".", limits, scene);
  free(text);
  return status;
}

/* "-" is standard input, so that the output of `make` can be piped; files that it names are looked up in the
 * current folder. */
static int32_t load(const struct cli_arguments *arguments, hooke_scene **loaded) {
  return strcmp(arguments->scene, "-") == 0 ? load_text(stdin, arguments->limits, loaded)
                                            : hooke_scene_load(arguments->scene, arguments->limits, loaded);
}

int cli_setup_check_read(const struct cli_arguments *arguments, const struct cli_setup *setup,
                         const char *output) {
  const int32_t status = output ? hooke_scene_check_output(setup->read, output) : HOOKE_OK;
  if (status == HOOKE_OK) return HOOKE_EXIT_DONE;
  if (status != HOOKE_BAD_VALUE) return cli_report_status(arguments, status);
  return cli_report(arguments, HOOKE_EXIT_USAGE, "%s", hooke_last_error());
}

int32_t cli_setup_is_scene(const char *path) {
  char first = '\0';
  if (strcmp(path, "-") == 0) return 1;
  if (cli_os_is_other_than_file(path)) return 0; /* a pipe would wait for a writer */
  FILE *file = fopen(path, "rb");
  const int32_t is = file && fscanf(file, " %c", &first) == 1 && first == '{';
  if (file) fclose(file);
  return is;
}

/* ---- a start at rest ---- */

void cli_setup_take_rest(struct cli_setup *setup, const hooke_measurement *rest) {
  const double *q = hooke_measurement_series(rest, "rest", 0, "position", NULL);
  const size_t bytes = (size_t)hooke_state_size(setup->state) * sizeof *q;
  if (q) memcpy(hooke_state_position(setup->state), q, bytes);
  memset(hooke_state_velocity(setup->state), 0, bytes);
}

int32_t cli_setup_scene_at_state(const struct cli_setup *setup, hooke_scene **scene) {
  const int32_t status =
      hooke_scene_of_state(setup->system, setup->state, hooke_scene_text(setup->scene, "title"),
                           setup->options, NULL, NULL, scene);
  return status == HOOKE_OK ? hooke_scene_commit(*scene) : status;
}

static int32_t replace_scene(struct cli_setup *setup) {
  const int32_t status = cli_setup_scene_at_state(setup, &setup->scene);
  setup->options = hooke_scene_run_options(setup->scene);
  setup->system = hooke_scene_system(setup->scene);
  hooke_state_destroy(setup->state);
  setup->state = NULL;
  return status == HOOKE_OK ? hooke_state_create(setup->system, &setup->state) : status;
}

static int start_from_rest(const struct cli_arguments *arguments, struct cli_setup *setup) {
  hooke_measurement *rest = NULL;
  int code = HOOKE_EXIT_DONE;
  int32_t status = hooke_measurement_create("rest", setup->system, NULL, NULL, &rest);
  if (status == HOOKE_OK) status = cli_watch_run(arguments, rest, NULL);
  const char *found = status == HOOKE_OK ? hooke_measurement_text(rest, "rest", 0, "status") : NULL;
  if (status == HOOKE_STOPPED) {
    code = cli_report(arguments, HOOKE_EXIT_INTERRUPTED, "interrupted before the scene was at rest");
  } else if (found && strcmp(found, "at rest") != 0) {
    code = cli_report(arguments, HOOKE_EXIT_NOT_MET, "--from-rest: %s",
                      hooke_measurement_text(rest, "claims", 0, "text"));
  } else if (found) {
    cli_setup_take_rest(setup, rest);
    status = replace_scene(setup);
  }
  hooke_measurement_destroy(rest);
  return status == HOOKE_OK || code != HOOKE_EXIT_DONE ? code : cli_report_status(arguments, status);
}

int cli_setup_load(const struct cli_arguments *arguments, struct cli_setup *setup) {
  memset(setup, 0, sizeof *setup);
  int32_t status = load(arguments, &setup->read);
  if (ferror(stdin)) return cli_report(arguments, HOOKE_EXIT_IO, "standard input could not be read");
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  setup->scene = setup->read;
  setup->options = hooke_scene_run_options(setup->scene);
  int code = cli_force_open(arguments, hooke_scene_system(setup->scene), &setup->force);
  if (code != HOOKE_EXIT_DONE) return code;
  status = cli_arguments_apply(arguments, setup->options);
  if (status == HOOKE_OK) status = hooke_scene_commit(setup->scene);
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  code = cli_setup_check_read(arguments, setup, cli_arguments_text(arguments, "output"));
  if (code == HOOKE_EXIT_DONE)
    code = cli_setup_check_read(arguments, setup, cli_arguments_text(arguments, "report"));
  if (code != HOOKE_EXIT_DONE) return code;
  cli_os_give_back_memory(); /* of loading, so that a run does not hold it besides its own */
  setup->system = hooke_scene_system(setup->scene);
  status = hooke_state_create(setup->system, &setup->state);
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  return cli_arguments_text(arguments, "from-rest") ? start_from_rest(arguments, setup) : HOOKE_EXIT_DONE;
}

void cli_setup_destroy(struct cli_setup *setup) {
  hooke_state_destroy(setup->state);
  if (setup->scene != setup->read) hooke_scene_destroy(setup->scene);
  hooke_scene_destroy(setup->read);
  free(setup->force.file);
}

const char *cli_setup_title(const struct cli_arguments *arguments, const struct cli_setup *setup) {
  const char *title = hooke_scene_text(setup->scene, "title");
  return title && title[0] ? title : arguments->scene;
}

int cli_setup_require(const struct cli_arguments *arguments, const struct cli_setup *setup,
                      const char *method) {
  const int duration = hooke_options_number_count(setup->options, "duration") == 0;
  const int step = method && hooke_method_is_adaptive(method) == 0 &&
                   hooke_options_number_count(setup->options, "step") == 0;
  if (method && hooke_method_is_adaptive(method) < 0) { /* a value given as an option was refused before */
    return cli_report(arguments, HOOKE_EXIT_BAD_INPUT,
                      "%s: run.method: there is no method '%s'; 'hooke --help' lists them", arguments->scene,
                      method);
  }
  if (method && !hooke_method_is_built(method)) {
    return cli_report(arguments, HOOKE_EXIT_NOT_BUILT,
                      "%s is not in this build of hooke; 'hooke --version' says what it was built with",
                      method);
  }
  if (!duration && !step) return HOOKE_EXIT_DONE;
  return cli_report(
      arguments, HOOKE_EXIT_USAGE, "%s%s%s%s%s: the scene's run names none; give %s in seconds, such as%s%s",
      duration ? "no duration" : "", duration && step ? " and " : "", step ? "no step, which " : "",
      step ? method : "", step ? " takes" : "", duration && step ? "them" : "one",
      duration ? " --duration 1" : "", step ? " --step 1e-3" : "");
}

static int32_t tell(const char *kind, const char *sentence, double t, double limit, int64_t spring,
                    int64_t particle, void *ctx) {
  const struct cli_arguments *const *arguments = ctx;
  (void)kind, (void)t, (void)limit, (void)spring, (void)particle;
  if (!(*arguments)->quiet) cli_report_words(*arguments, "%s", sentence);
  return 0;
}

int cli_setup_fit(const struct cli_arguments *arguments, struct cli_setup *setup, int32_t may_lack) {
  if (cli_arguments_text(arguments, "strict")) return HOOKE_EXIT_DONE;
  const double *q = hooke_state_position(setup->state);
  const int32_t status = hooke_step_fit(setup->system, q, setup->options, tell, &arguments);
  if (status == HOOKE_OK || (status == HOOKE_UNSUITED && may_lack)) return HOOKE_EXIT_DONE;
  if (status != HOOKE_UNSUITED) return cli_report_status(arguments, status);
  return cli_report(arguments, HOOKE_EXIT_USAGE, "%s", hooke_last_error());
}

int cli_setup_check_apart(const struct cli_arguments *arguments, const char *input, const char *what,
                          const char *output) {
  if (output && cli_os_is_same_file(input, output)) {
    return cli_report(arguments, HOOKE_EXIT_USAGE, "%s is %s itself; name another file for the output",
                      output, what);
  }
  return HOOKE_EXIT_DONE;
}

int cli_setup_check_output(const struct cli_arguments *arguments, const char *output) {
  const char *hdf5 = hooke_build_fact("hdf5");
  if (output && (!hdf5 || !hdf5[0])) {
    return cli_report(arguments, HOOKE_EXIT_NOT_BUILT,
                      "-o %s: this build of hooke has no HDF5 and writes no "
                      "trajectories; run without -o, or build hooke with HDF5",
                      output);
  }
  return HOOKE_EXIT_DONE;
}

int cli_setup_check_ending(const struct cli_arguments *arguments, const char *flag, const char *file) {
  static const char *const others[][2] = {
      {".json", "'hooke make -o' writes a scene"},
      {".html", "'hooke view -o' writes a page"},
      {".h5", "'hooke run -o' writes a trajectory"},
      {".csv", "'hooke run --probes' writes values over time, and 'hooke study -o' a table"},
      {".png.jpg.svg", "the page of 'hooke view' saves the picture"},
      {".mp4.webm.gif", "the page of 'hooke view' saves the film"}};
  const char *slash = file ? cli_os_last_slash(file) : NULL,
             *dot = file ? strrchr(slash ? slash : file, '.') : NULL;
  if (file && (file[0] == '\0' || (slash && slash[1] == '\0')))
    return cli_report(arguments, HOOKE_EXIT_USAGE, "%s '%s': allowed: the name of a file", flag, file);
  for (int32_t i = 0; dot && i < arguments->count; i++) {
    const struct cli_argument *argument = &arguments->all[i];
    const char *own =
        argument->text && strcmp(argument->text, file) == 0 ? cli_describe_file(argument) : NULL;
    const int of_hdf5 = own && strcmp(own, "h5") == 0;
    if (of_hdf5 && (dot[1] == '\0' || cli_is_among("h5 hdf5 h5md", dot + 1))) continue;
    for (size_t k = 0; own && own[0] && k < sizeof others / sizeof others[0]; k++) {
      const char *found = strstr(others[k][0], dot), after = found ? found[strlen(dot)] : 'x';
      if ((after != '\0' && after != '.') || strcmp(own, dot + 1) == 0) continue;
      return cli_report(arguments, HOOKE_EXIT_USAGE, "%s %s: its name has to end in .%s; %s", flag, file, own,
                        others[k][1]);
    }
    if (of_hdf5)
      return cli_report(arguments, HOOKE_EXIT_USAGE,
                        "%s %s: a file of HDF5 has a name that ends in .h5, .hdf5 or .h5md, or has no ending",
                        flag, file);
  }
  return HOOKE_EXIT_DONE;
}

int cli_setup_check_report(const struct cli_arguments *arguments) {
  const char *report = cli_arguments_text(arguments, "report");
  if (!report) return HOOKE_EXIT_DONE;
  const char *library = hooke_build_fact("chartjs");
  if (!library || !library[0]) {
    return cli_report(arguments, HOOKE_EXIT_NOT_BUILT,
                      "--report %s: this build of hooke has no Chart.js (on Debian: libjs-chart.js) and "
                      "writes no reports; run without --report",
                      report);
  }
  return cli_setup_check_ending(arguments, "--report", report);
}

int cli_setup_write_report(const struct cli_arguments *arguments, const struct cli_setup *setup,
                           hooke_measurement *measurement, int code) {
  const char *report = cli_arguments_text(arguments, "report");
  if (!report) return code;
  int32_t status = hooke_measurement_label(measurement, "title", cli_setup_title(arguments, setup));
  if (status == HOOKE_OK) status = hooke_measurement_write(measurement, report);
  if (status == HOOKE_OK) return code;
  cli_report_words(arguments, "%s", hooke_last_error());
  return cli_exit_code(status);
}
