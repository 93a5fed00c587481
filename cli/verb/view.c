/* hooke view: writes a trajectory as a page that plays it. */
#include "blow_up.h"
#include "os.h"
#include "print.h"
#include "report.h"
#include "measured.h"
#include "run_results.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_VIEWS = 8 };

/* The omitted part, "every 10th" of something; "" if nothing is omitted. */
static void describe_stride(const hooke_measurement *view, const char *what, char *text, size_t size) {
  static const char *const endings[] = {"th", "st", "nd", "rd"};
  const int stride = (int)cli_number(view, "view", what), last = stride / 10 % 10 == 1 ? 0 : stride % 10;
  text[0] = '\0';
  if (stride > 1) snprintf(text, size, ", every %d%s", stride, endings[last < 4 ? last : 0]);
}

/* What is shown, on one page. */
struct shown {
  const struct cli_arguments *arguments;
  const char *output;
  int32_t count, ready; /* of them, in their order, are there to be shown */
  const char *path[MOST_VIEWS];
  const struct cli_run *run[MOST_VIEWS]; /* that made it; NULL: it was there */
  hooke_record *record[MOST_VIEWS];
  hooke_measurement *view[MOST_VIEWS];
};

/* The input of that number. */
static const char *name_of(const struct shown *shown, int32_t k) {
  return shown->run[k] ? shown->run[k]->arguments->scene : shown->path[k];
}

static void print_words(const struct cli_arguments *arguments, const hooke_measurement *view,
                        const char *name) {
  char frames[64], springs[64];
  const double damaged = cli_number(view, "view", "damaged");
  const int all = cli_number(view, "view", "frames") + damaged == cli_number(view, "view", "frames_there") &&
                  cli_number(view, "view", "springs") == cli_number(view, "view", "springs_there");
  describe_stride(view, "frame_stride", frames, sizeof frames);
  describe_stride(view, "spring_stride", springs, sizeof springs);
  cli_report_words(arguments, "%s: %.2f MB, %.0f of %.0f frames%s, %.0f of %.0f springs%s%s", name,
                   cli_number(view, "view", "bytes") / 1e6, cli_number(view, "view", "frames"),
                   cli_number(view, "view", "frames_there"), frames, cli_number(view, "view", "springs"),
                   cli_number(view, "view", "springs_there"), springs,
                   all ? "" : "; --frames, --springs, --size and --beyond allow more");
  if (damaged > 0.0)
    cli_report_words(arguments, "%.0f damaged frame%s skipped: the numbers are not those that were written",
                     damaged, damaged == 1.0 ? " is" : "s are");
}

static int32_t print_json(const struct shown *shown, const char *output) {
  int32_t status = HOOKE_OK;
  cli_print_json(shown->count == 1 ? "{'output': %s, " : "{'output': %s, 'views': [", output);
  for (int32_t k = 0; k < shown->count; k++) {
    if (shown->count > 1)
      cli_print_json(k ? ", {'trajectory': %s, " : "{'trajectory': %s, ", name_of(shown, k));
    cli_print_json("'status': %s", hooke_record_text(shown->record[k], "status"));
    const int32_t printed = cli_print_members(", ", shown->view[k], "view", 0);
    if (printed != HOOKE_OK) status = printed;
    cli_print_json("}");
  }
  cli_print_json(shown->count == 1 ? "\n" : "]}\n");
  return status;
}

static int write_page(const struct shown *shown) {
  const struct cli_arguments *arguments = shown->arguments;
  const char *output = shown->output;
  int32_t status = HOOKE_OK;
  for (int32_t k = 1; k < shown->count && status == HOOKE_OK; k++)
    status = hooke_view_add(shown->view[0], shown->view[k]);
  if (status == HOOKE_OK) status = hooke_measurement_write(shown->view[0], output);
  if (status == HOOKE_BAD_VALUE) return cli_report(arguments, HOOKE_EXIT_USAGE, "%s", hooke_last_error());
  if (status != HOOKE_OK) return cli_report_status(arguments, status);
  if (arguments->json) status = print_json(shown, output);
  for (int32_t k = 0; k < shown->count && !arguments->quiet; k++)
    print_words(arguments, shown->view[k], shown->count == 1 ? output : name_of(shown, k));
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_missing_words(arguments);
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

/* ---- what is shown ---- */

/* 1 if an option of a run, --want or --set was given: then the scene of a trajectory is run anew. */
static int is_to_run(const struct cli_arguments *arguments) {
  return cli_arguments_has_run(arguments) || cli_arguments_text(arguments, "want") ||
         cli_arguments_text(arguments, "set");
}

static int open_trajectory(const struct cli_arguments *arguments, struct shown *shown, int32_t k) {
  int32_t status = hooke_record_open(shown->path[k], &shown->record[k]);
  if (status == HOOKE_IO_FAILED) /* no file, or no HDF5 */
    return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "%s", hooke_last_error());
  if (status == HOOKE_OK) status = hooke_view_create(shown->record[k], arguments->more, &shown->view[k]);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(arguments, status);
}

/* What was run for the page is called by its scene, as its trajectory is removed. */
static int label(const struct cli_run *run, hooke_measurement *view) {
  struct cli_string why = {.bytes = NULL};
  cli_blow_up_add_why(&why, run);
  int32_t status = why.status;
  if (status == HOOKE_OK) status = hooke_measurement_label(view, "scene", run->arguments->scene);
  if (status == HOOKE_OK) status = hooke_measurement_label(view, "command", why.bytes);
  free(why.bytes);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(run->arguments, status);
}

static int show_trajectories(struct shown *shown) {
  const struct cli_arguments *arguments = shown->arguments;
  int code = HOOKE_EXIT_DONE;
  struct cli_watch watch;
  cli_watch_start(&watch, arguments);
  for (int32_t k = 0; k < shown->count && code == HOOKE_EXIT_DONE; k++) {
    code = cli_watch_check(arguments, open_trajectory(arguments, shown, k));
    if (code == HOOKE_EXIT_DONE && shown->run[k]) code = label(shown->run[k], shown->view[k]);
  }
  if (code == HOOKE_EXIT_DONE) code = write_page(shown);
  for (int32_t k = 0; k < shown->count; k++) {
    hooke_measurement_destroy(shown->view[k]);
    hooke_record_close(shown->record[k]);
  }
  return code;
}

/* Anything else is loaded as a scene, whose message tells what is wrong with it. */
static int is_trajectory(const char *path) {
  hooke_record *record = NULL;
  const int32_t status = strcmp(path, "-") == 0 ? HOOKE_BAD_VALUE : hooke_record_open(path, &record);
  hooke_record_close(record);
  return status == HOOKE_OK || status == HOOKE_NO_MEMORY;
}

/* Nor is one run anew that is there and cannot be opened now. */
static int is_shown_as_it_is(const char *path) {
  const char *dot = strrchr(path, '.');
  FILE *file = dot && strcmp(dot, ".h5") == 0 ? fopen(path, "rb") : NULL;
  if (file) fclose(file);
  return file || is_trajectory(path);
}

static int show(struct shown *shown);

static int show_run(const struct cli_run *run, void *context) {
  struct shown *shown = context;
  shown->path[shown->ready] = run->output;
  shown->run[shown->ready++] = run;
  return show(shown);
}

/* By way of a trajectory beside the page. */
static int run_and_show(struct shown *shown) {
  static const char name[] = "hooke-XXXXXX";
  struct cli_arguments arguments = *shown->arguments;
  arguments.scene = shown->path[shown->ready];
  const char *slash = cli_os_last_slash(shown->output);
  const int folder = slash ? (int)(slash - shown->output) + 1 : 0;
  char *path = malloc((size_t)folder + sizeof name);
  if (!path) return cli_report(&arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  snprintf(path, (size_t)folder + sizeof name, "%.*s%s", folder, shown->output, name);
  const double beyond = hooke_options_number(arguments.more, "beyond");
  const int code = cli_run_to_show(&arguments, path, shown->output, beyond, show_run, shown);
  free(path);
  return code;
}

/* Once all scenes among them have been run, one within the other, so that each trajectory is there as long.
 */
static int show(struct shown *shown) {
  const int anew = shown->count == 1 && !shown->ready && is_to_run(shown->arguments);
  while (!anew && shown->ready < shown->count && is_shown_as_it_is(shown->path[shown->ready]))
    shown->ready++;
  return shown->ready < shown->count ? run_and_show(shown) : show_trajectories(shown);
}

/* Several have a page of another name than theirs, and no trajectory is run anew. */
static int check_several(const struct cli_arguments *arguments) {
  if (arguments->more_count == 0) return HOOKE_EXIT_DONE;
  if (arguments->more_count >= MOST_VIEWS)
    return cli_report(arguments, HOOKE_EXIT_USAGE, "%d inputs at once; allowed: up to %d",
                      (int)arguments->more_count + 1, MOST_VIEWS);
  if (!cli_arguments_text(arguments, "output"))
    return cli_report(arguments, HOOKE_EXIT_USAGE, "several inputs need -o, the name of their page");
  if (is_to_run(arguments))
    return cli_report(arguments, HOOKE_EXIT_USAGE,
                      "several inputs are shown as they are; leave out the options of a run");
  return HOOKE_EXIT_DONE;
}

/* That one of several can be opened and, as a scene, run, which is known before the first is run. */
static int check_input(const struct cli_arguments *arguments, const char *path) {
  struct cli_arguments one = *arguments;
  struct cli_setup setup;
  one.scene = path;
  if (one.more_count == 0 || strcmp(path, "-") == 0 || is_trajectory(path)) return HOOKE_EXIT_DONE;
  int code = cli_setup_load(&one, &setup);
  if (code == HOOKE_EXIT_DONE)
    code = cli_setup_require(&one, &setup, hooke_options_text(setup.options, "method"));
  cli_setup_destroy(&setup);
  return code;
}

static int write_view(const struct cli_arguments *arguments, const char *output) {
  struct shown shown = {arguments, output, .count = 1 + arguments->more_count, .path = {arguments->scene}};
  int code = check_input(arguments, arguments->scene);
  for (int32_t k = 1; k < shown.count && code == HOOKE_EXIT_DONE; k++)
    code = check_input(arguments, shown.path[k] = arguments->more_scenes[k - 1]);
  return code == HOOKE_EXIT_DONE ? show(&shown) : code;
}

static int do_view(const struct cli_arguments *arguments) {
  int code = check_several(arguments);
  if (code != HOOKE_EXIT_DONE) return code;
  char *output = output_of(arguments);
  if (!output) return cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "out of memory");
  code = cli_setup_check_ending(arguments, "-o", output);
  if (code == HOOKE_EXIT_DONE) {
    code = write_view(arguments, output);
    const int written = code == HOOKE_EXIT_DONE || code == HOOKE_EXIT_DIVERGED;
    if (written && cli_arguments_text(arguments, "open") && !cli_os_show_page(output))
      cli_report_words(arguments, "there is no program to open it with; open %s in a browser", output);
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
            "and lattices as surfaces, ropes and strands as tubes, other springs as lines, strain as colour, "
            "what is pinned and what is driven marked, energies below. A scene is run first; its trajectory "
            "is not kept. What is left out, to keep the page small and quick, is said on it and here. A run "
            "that was killed shows the frames it has. Several play on one page, side by side or over one "
            "another, at the same time and seen from the same angle, with what is between them.",
    .several = 1,
    .example = "hooke view cloth.h5 -o cloth.html",
    HOOKE_VERB_ROWS(rows),
    .options = "view",
    .without = "checkpoint past_divergence frames_after",
    .function = do_view,
};
