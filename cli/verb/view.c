/* hooke view: writes a trajectory as a page that plays it. */
#include "os.h"
#include "output_file.h"
#include "print.h"
#include "report.h"
#include "run_results.h"
#include "table.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static double number_of(const hooke_measurement *view, const char *what) {
  return hooke_measurement_number(view, "view", 0, what);
}

/* The omitted part, "every 10th" of something; "" if nothing is omitted. */
static void describe_stride(const hooke_measurement *view, const char *what, char *text, size_t size) {
  static const char *const endings[] = {"th", "st", "nd", "rd"};
  const int stride = (int)number_of(view, what), last = stride / 10 % 10 == 1 ? 0 : stride % 10;
  text[0] = '\0';
  if (stride > 1) snprintf(text, size, ", every %d%s", stride, endings[last < 4 ? last : 0]);
}

static void print_words(const struct cli_arguments *arguments, const hooke_measurement *view,
                        const char *output) {
  char frames[64], springs[64];
  describe_stride(view, "frame_stride", frames, sizeof frames);
  describe_stride(view, "spring_stride", springs, sizeof springs);
  cli_report_words(arguments, "%s: %.2f MB, %.0f of %.0f frames%s, %.0f of %.0f springs%s%s", output,
                   number_of(view, "bytes") / 1e6, number_of(view, "frames"), number_of(view, "frames_there"),
                   frames, number_of(view, "springs"), number_of(view, "springs_there"), springs,
                   frames[0] || springs[0] ? "; --frames, --springs and --size allow more" : "");
  const double damaged = number_of(view, "damaged");
  if (damaged > 0.0)
    cli_report_words(arguments, "%.0f damaged frame%s skipped: the numbers are not those that were written",
                     damaged, damaged == 1.0 ? " is" : "s are");
}

static void print_json(const hooke_measurement *view, const hooke_record *record, const char *output) {
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "output", output);
  cli_json_text(&json, "status", hooke_record_text(record, "status"));
  cli_table_print_row(&json, view, "view", 0);
  cli_json_end(&json);
}

static int write_page(const struct cli_arguments *arguments, const hooke_record *record, const char *output) {
  hooke_measurement *view = NULL;
  int32_t status = hooke_view_create(record, arguments->more, &view);
  if (status == HOOKE_OK) status = hooke_measurement_write(view, output);
  if (status == HOOKE_OK && arguments->json) print_json(view, record, output);
  if (status == HOOKE_OK && !arguments->quiet) print_words(arguments, view, output);
  hooke_measurement_destroy(view);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(arguments, status);
}

/* ---- where the page goes ---- */

/* FILE of -o, or the input's name with .html for its ending, for free(). NULL: no memory. */
static char *output_of(const struct cli_arguments *arguments) {
  const char *given = cli_arguments_text(arguments, "output"), *input = arguments->scene;
  if (given) return strdup(given);
  if (strcmp(input, "-") == 0) input = "scene";
  const char *slash = cli_os_last_slash(input), *dot = strrchr(slash ? slash : input, '.');
  const size_t length = dot ? (size_t)(dot - input) : strlen(input);
  char *path = malloc(length + sizeof ".html");
  if (path) snprintf(path, length + sizeof ".html", "%.*s.html", (int)length, input);
  return path;
}

static void open_page(const struct cli_arguments *arguments, const char *page) {
  if (cli_os_show_page(page)) return;
  cli_report_words(arguments, "there is no program to open it with; open %s in a browser", page);
}

/* ---- what is shown ---- */

/* 1 if an option of a run, or --want, was given: then the scene of a trajectory is run anew. */
static int is_to_run(const struct cli_arguments *arguments) {
  for (int32_t k = 0; k < arguments->count; k++) {
    if (arguments->all[k].table == arguments->run && arguments->all[k].text) return 1;
  }
  return cli_arguments_text(arguments, "want") != NULL;
}

static int show_trajectory(const struct cli_arguments *arguments, const char *path, const char *output) {
  hooke_record *record = NULL;
  const int32_t status = hooke_record_open(path, &record);
  int code;
  if (status == HOOKE_OK)
    code = write_page(arguments, record, output);
  else if (status == HOOKE_IO_FAILED) /* no file, or no HDF5 */
    code = cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "%s", hooke_last_error());
  else
    code = cli_report_status(arguments, status);
  hooke_record_close(record);
  return code;
}

/* By way of a trajectory beside the page. */
static int run_and_show(const struct cli_arguments *arguments, const char *output) {
  const size_t size = strlen(output) + 32;
  char *path = malloc(size);
  int32_t outcome = HOOKE_OK;
  if (!path) return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  snprintf(path, size, "%s.%ld.h5", output, (long)getpid());
  int code = cli_run_to_show(arguments, path, &outcome);
  if (code == HOOKE_EXIT_DONE) code = show_trajectory(arguments, path, output);
  unlink(path);
  free(path);
  return code == HOOKE_EXIT_DONE ? cli_exit_code(outcome) : code;
}

/* Anything but a scene: its own message tells what is wrong with it. */
static int is_scene(const char *path) {
  char first = '\0';
  FILE *file = strcmp(path, "-") == 0 ? stdin : fopen(path, "rb");
  if (file == stdin) return 1;
  const int same = file && fscanf(file, " %c", &first) == 1 && first == '{';
  if (file) fclose(file);
  return same;
}

static int do_view(const struct cli_arguments *arguments) {
  char *output = output_of(arguments);
  if (!output) return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  int code = cli_output_file_check(arguments, "-o", output);
  if (code == HOOKE_EXIT_DONE) {
    const int runs = is_scene(arguments->scene) || is_to_run(arguments);
    code = runs ? run_and_show(arguments, output) : show_trajectory(arguments, arguments->scene, output);
    const int written = code == HOOKE_EXIT_DONE || code == HOOKE_EXIT_DIVERGED;
    if (written && cli_arguments_text(arguments, "open")) open_page(arguments, output);
  }
  free(output);
  return code;
}

static const struct cli_verb_row rows[] = {
    {"output", 'o', "FILE.html",
     "writes the page to FILE.html, replacing it; the name of the input with .html if not given"},
    {"open", 0, NULL, "opens the page in the browser ($BROWSER, or what the system has)"},
    {"want", 0, "LENGTH", "of a scene: picks a method and its step, as 'hooke run --want' does"},
};

const struct cli_verb cli_verb_view = {
    .name = "view",
    .summary = "writes one self-contained HTML page that plays a trajectory",
    .text = "Writes a trajectory of 'hooke run -o' as one page to open in a browser, offline: cloth, meshes "
            "and lattices as "
            "surfaces, ropes and strands as tubes, other springs as lines, strain as colour, what is pinned "
            "and what is driven "
            "marked, energies below. A scene is run first; its trajectory is not kept. What is left out, to "
            "keep the page small "
            "and quick, is said on it and here. A run that was killed shows the frames it has.",
    .example = "hooke view cloth.h5 -o cloth.html",
    HOOKE_VERB_ROWS(rows),
    .options = "view",
    .without = "checkpoint",
    .function = do_view,
};
