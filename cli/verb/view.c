/* hooke view: writes a trajectory as a page that plays it. */
#include "output_file.h"
#include "print.h"
#include "report.h"
#include "setup.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>

/* The omitted part, "every 10th" of something; "" if nothing is omitted. */
static void describe_stride(const hooke_view *view, const char *what, char *text, size_t size) {
  static const char *const endings[] = {"th", "st", "nd", "rd"};
  const int stride = (int)hooke_view_number(view, what), last = stride / 10 % 10 == 1 ? 0 : stride % 10;
  text[0] = '\0';
  if (stride > 1) snprintf(text, size, ", every %d%s", stride, endings[last < 4 ? last : 0]);
}

static void print_words(const struct cli_arguments *arguments, const hooke_view *view, const char *output) {
  char frames[64], springs[64];
  describe_stride(view, "frame_stride", frames, sizeof frames);
  describe_stride(view, "spring_stride", springs, sizeof springs);
  cli_report_words(arguments, "%s: %.2f MB, %.0f of %.0f frames%s, %.0f of %.0f springs%s%s", output,
                   hooke_view_number(view, "bytes") / 1e6, hooke_view_number(view, "frames"),
                   hooke_view_number(view, "frames_there"), frames, hooke_view_number(view, "springs"),
                   hooke_view_number(view, "springs_there"), springs,
                   frames[0] || springs[0] ? "; --frames, --springs and --size allow more" : "");
}

static void print_json(const hooke_view *view, const hooke_record *record, const char *output) {
  static const char *const counts[] = {"bytes",         "frames",    "frames_there",
                                       "frame_stride",  "springs",   "springs_there",
                                       "spring_stride", "particles", "particles_there"};
  static const char *const numbers[] = {"time_first", "time_last", "strain", "strain_low", "strain_high"};
  struct cli_json json;
  cli_json_begin(&json, stdout);
  cli_json_text(&json, "output", output);
  cli_json_text(&json, "status", hooke_record_text(record, "status"));
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++)
    cli_json_count(&json, counts[k], (int64_t)hooke_view_number(view, counts[k]));
  for (size_t k = 0; k < sizeof numbers / sizeof numbers[0]; k++)
    cli_json_number(&json, numbers[k], hooke_view_number(view, numbers[k]));
  cli_json_end(&json);
}

static int write_page(const struct cli_arguments *arguments, const hooke_record *record, const char *output) {
  hooke_view *view = NULL;
  int32_t status = hooke_view_create(record, arguments->more, &view);
  if (status == HOOKE_OK) status = hooke_view_write(view, output, NULL);
  if (status == HOOKE_OK && arguments->json) print_json(view, record, output);
  if (status == HOOKE_OK && !arguments->quiet) print_words(arguments, view, output);
  hooke_view_destroy(view);
  return status == HOOKE_OK ? HOOKE_EXIT_DONE : cli_report_status(arguments, status);
}

static int do_view(const struct cli_arguments *arguments) {
  const char *output = cli_arguments_text(arguments, "output");
  if (!output) {
    return cli_report(arguments, HOOKE_EXIT_USAGE, "no page named; give one, such as -o page.html");
  }
  int code = cli_output_file_check(arguments, "-o", output);
  if (code != HOOKE_EXIT_DONE) return code;
  hooke_record *record = NULL;
  const int32_t status = hooke_record_open(arguments->scene, &record);
  if (status == HOOKE_OK)
    code = write_page(arguments, record, output);
  else if (status == HOOKE_IO_FAILED) /* no file, or no HDF5 */
    code = cli_report(arguments, HOOKE_EXIT_BAD_INPUT, "%s", hooke_last_error());
  else
    code = cli_report_status(arguments, status);
  hooke_record_close(record);
  return code;
}

static const struct cli_verb_row rows[] = {
    {"output", 'o', "FILE.html", "writes the page to FILE.html, replacing it"},
};

const struct cli_verb cli_verb_view = {
    .name = "view",
    .input = "OUT.h5",
    .summary = "writes one self-contained HTML page that plays a trajectory",
    .text =
        "Writes a trajectory of 'hooke run -o' as one page to open in a browser, offline: it plays the "
        "frames "
        "in space, springs coloured by strain, what is pinned and what is driven marked, energies below. "
        "What "
        "is left out, to keep the page small and quick, is said on it and here. A run that was killed shows "
        "the frames it has.",
    .example = "hooke view cloth.h5 -o cloth.html",
    HOOKE_VERB_ROWS(rows),
    .options = "view",
    .function = do_view,
};
