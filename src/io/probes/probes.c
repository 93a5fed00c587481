#include "io/probes/probes.h"

#include "core/handle.h"
#include "core/keep_errno.h"
#include "core/named_number.h"
#include "core/number.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "integrate/integrator.h"
#include "io/file/bytes.h"
#include "io/file/inputs.h"

#include <math.h>
#include <stdio.h>

static const struct hk_option_row rows[] = {
    HOOKE_OPTION("probe", .type = HOOKE_OPTION_TEXT, NULL,
                 "quantities to write at every time, in the grammar of watched ones, without periods",
                 .required = 1, .example = "tip.y,energy"),
    HOOKE_OPTION(
        "probe_every", HOOKE_OPTION_POSITIVE("s"), NULL,
        "time between two lines of probes, with a fixed step a whole multiple of it; that between two "
        "frames if not given"),
};

const struct hk_option_table hk_probes_options = {"probes", HOOKE_OPTION_ROWS(rows)};

static int64_t line_bytes(const struct hooke_probes *probes) {
  return (probes->list.count + 1) * (int64_t)sizeof(double);
}

/* Marks the file bad. */
static int32_t fail(hooke_probes *probes, int error) {
  const int32_t status = hk_file_fail(probes->file.path, "write its lines", error);
  snprintf(probes->failure, sizeof probes->failure, "%s", hooke_last_error());
  return status;
}

static int32_t add(hooke_probes *probes, const void *bytes, int64_t count) {
  const int error = hk_bytes_write(probes->file.descriptor, probes->at, count, bytes);
  if (error) return fail(probes, error);
  probes->at += count;
  return HOOKE_OK;
}

static int32_t add_text(hooke_probes *probes) {
  hk_text_say(&probes->text, "\n");
  if (probes->text.status != HOOKE_OK) return fail(probes, ENOMEM);
  const int32_t status = add(probes, probes->text.bytes, probes->text.length);
  probes->text.length = 0;
  return status;
}

static int32_t add_names(hooke_probes *probes) {
  hk_text_say(&probes->text, "time");
  for (int64_t k = 0; k < probes->list.count; k++) {
    hk_text_say(&probes->text, ",");
    hk_text_cell(&probes->text, probes->list.item[k].text);
  }
  return add_text(probes);
}

/* Numbers that are not finite are left out. */
static int32_t add_numbers(hooke_probes *probes) {
  for (int64_t k = 0; k <= probes->list.count; k++) {
    char number[HOOKE_NUMBER_SIZE] = "";
    if (isfinite(probes->line[k])) hk_number_print(probes->line[k], number);
    if (k > 0) hk_text_say(&probes->text, ",");
    hk_text_say(&probes->text, number);
  }
  return add_text(probes);
}

static int32_t see(int64_t step, const hooke_state *state, void *ctx) {
  HOOKE_KEEP_ERRNO;
  (void)step;
  hooke_probes *probes = ctx;
  const double t = *state->t;
  if (hk_atomic_file_require_own(&probes->file) != HOOKE_OK) return 1;
  probes->line[0] = t;
  hk_watched_values(&probes->list, t, state->q, state->v, probes->line + 1);
  for (int64_t k = 1; k <= probes->list.count; k++)
    if (!isfinite(probes->line[k])) probes->line[k] = NAN;
  const int32_t status =
      probes->is_table ? add(probes, probes->line, line_bytes(probes)) : add_numbers(probes);
  if (status != HOOKE_OK) return 1;
  probes->lines++;
  probes->last = t;
  return 0;
}

/* ---- making ---- */

static int32_t read_format(const char *path, hooke_probes *probes) {
  probes->is_table = hk_file_ends_in(path, ".h5") || hk_file_ends_in(path, ".hdf5");
  if (probes->is_table || hk_file_ends_in(path, ".csv")) return HOOKE_OK;
  return hk_fail(HOOKE_BAD_VALUE, "probes", "%s: allowed are names that end in .csv, .h5 or .hdf5", path);
}

/* Has its times from the integrator. */
static int32_t attach(hooke_probes *probes, double every) {
  const int32_t status = hk_integrator_on_sample(probes->integrator, every, see, probes);
  if (status == HOOKE_OK) probes->planned = probes->integrator->sampling.frames;
  return status == HOOKE_BAD_VALUE && hk_fail_where()[0] == '\0' ? hk_fail_within(status, "probe_every")
                                                                 : status;
}

static int32_t make_file(const char *path, hooke_probes *probes) {
  int32_t status = hk_inputs_refuse(probes->list.system, path);
  if (status == HOOKE_OK) status = hk_atomic_file_make_locked(path, 0, &probes->file);
  if (status != HOOKE_OK) return status;
  status = probes->is_table
               ? hk_probes_make_table(&probes->list, probes->planned, &probes->file, &probes->begin)
               : add_names(probes);
  if (probes->is_table) probes->at = probes->begin;
  return status == HOOKE_OK ? hk_atomic_file_commit(&probes->file, NULL) : status;
}

static void release(hooke_probes *probes) {
  hk_atomic_file_release(&probes->file);
  hk_watched_release(&probes->list);
  hk_text_release(&probes->text);
  hk_free(probes->line);
  hk_handle_free(probes);
}

static int32_t make(const hooke_options *options, const char *path, hooke_probes *probes) {
  int32_t status = read_format(path, probes);
  if (status == HOOKE_OK)
    status = hk_watched_read_over_time(&probes->list, "probe", hooke_options_text(options, "probe"));
  if (status != HOOKE_OK) return status;
  probes->line = hk_new(probes->list.count + 1, sizeof *probes->line);
  if (probes->line == NULL) return HOOKE_NO_MEMORY;
  status = attach(probes, hooke_options_number(options, "probe_every"));
  if (status != HOOKE_OK) return status;
  status = make_file(path, probes);
  if (status != HOOKE_OK) probes->integrator->on_sample.observer = NULL;
  return status;
}

int32_t hooke_probes_create(hooke_integrator *integrator, const hooke_options *options, const char *path,
                            hooke_probes **probes) {
  HOOKE_KEEP_ERRNO;
  *probes = NULL;
  int32_t status = hk_options_require(options, &hk_probes_options, "options", "probes");
  if (status == HOOKE_OK) status = hk_options_check_required(options);
  if (status == HOOKE_OK)
    status = hk_integrator_require_particles(integrator, "integrator", "has no quantities to probe");
  if (status != HOOKE_OK) return status;
  hooke_probes *made = hk_handle_new("hooke_probes", sizeof *made);
  if (made == NULL) return HOOKE_NO_MEMORY;
  made->file = HOOKE_NO_ATOMIC_FILE;
  made->list.system = integrator->system;
  made->integrator = integrator;
  made->last = NAN;
  status = make(options, path, made);
  return HOOKE_HAND_OVER(status, made, probes, release);
}

double hooke_probes_number(const hooke_probes *probes, const char *what) {
  const struct hk_named_number numbers[] = {{"lines", (double)probes->lines}, {"time", probes->last}};
  return HOOKE_NAMED_NUMBER(numbers, what);
}

/* ---- closing ---- */

/* Makes the table of a run that ended early again, with exactly its lines. */
static int32_t shorten(hooke_probes *probes) {
  struct hk_atomic_file made = HOOKE_NO_ATOMIC_FILE;
  char block[4096];
  int64_t begin = 0;
  int32_t status = hk_file_is(probes->file.path, probes->file.descriptor);
  if (status == HOOKE_OK) status = hk_atomic_file_make_locked(probes->file.path, 1, &made);
  if (status == HOOKE_OK) status = hk_probes_make_table(&probes->list, probes->lines, &made, &begin);
  const int error = status == HOOKE_OK
                        ? hk_bytes_copy(probes->file.descriptor, probes->begin, made.descriptor, begin,
                                        probes->lines * line_bytes(probes), block, sizeof block)
                        : 0;
  if (error) status = hk_file_fail(made.path, "copy its lines", error);
  if (status == HOOKE_OK) {
    made.older = probes->file.descriptor;
    probes->file.descriptor = -1;
    status = hk_atomic_file_commit(&made, NULL);
    hk_atomic_file_release(&probes->file);
    probes->file = made;
    return status;
  }
  hk_atomic_file_release(&made);
  return status;
}

static int32_t finish(hooke_probes *probes) {
  if (probes->failure[0]) {
    if (!probes->is_table)
      (void)hk_os_set_length(probes->file.descriptor, probes->at); /* whole lines, unless that fails, too */
    return hk_fail(HOOKE_IO_FAILED, NULL, "%s", probes->failure);
  }
  const int32_t status = probes->is_table && probes->lines < probes->planned ? shorten(probes) : HOOKE_OK;
  return status == HOOKE_OK ? hk_atomic_file_finish(&probes->file) : status;
}

int32_t hooke_probes_close(hooke_probes *probes) {
  if (probes == NULL) return HOOKE_OK;
  HOOKE_KEEP_ERRNO;
  int32_t status = hk_atomic_file_require_own(&probes->file);
  if (probes->integrator->on_sample.ctx == probes)
    probes->integrator->on_sample = (struct hk_watch){.stride = 1};
  if (status == HOOKE_OK) status = finish(probes);
  release(probes);
  return status;
}
