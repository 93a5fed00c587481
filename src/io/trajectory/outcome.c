#include "io/trajectory/outcome.h"

#include "core/crc32.h"
#include "core/os/os_file.h"
#include "core/print.h"
#include "core/status.h"
#include "io/file/bytes.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

const char *const hk_error_number[HOOKE_ERROR_COUNT] = {"estimate",    "rms",        "known_until",
                                                        "energy_rise", "wanted",     "met",
                                                        "heat_excess", "last_piece", "last_from"};

const struct hk_outcome_part_row hk_outcome_parts[HOOKE_PART_COUNT] = {
    {"status", HOOKE_OUTCOME_STATUS}, {"beyond", sizeof(int64_t)},
    {"file_check", sizeof(uint32_t)}, {"error", HOOKE_ERROR_COUNT * sizeof(double)},
    {"error_by", HOOKE_ERROR_BY},     {"error_reason", HOOKE_ERROR_REASON}};

int hk_outcome_write(int descriptor, const int64_t at[HOOKE_PART_COUNT], int part, const void *data) {
  return at[part] < 0 ? 0 : hk_bytes_write(descriptor, at[part], hk_outcome_parts[part].bytes, data);
}

/* ---- status ---- */

const char *hk_outcome_word(int32_t outcome) {
  static const struct {
    int32_t outcome;
    const char *word;
  } rows[] = {{HOOKE_OK, "finished"},
              {HOOKE_STOPPED, "stopped"},
              {HOOKE_DIVERGED, "diverged"},
              {HOOKE_STEP_LIMIT, "step-limit"},
              {HOOKE_SOLVER_FAILED, "solver-failed"},
              {HOOKE_OUTCOME_RUNNING, "running"}};
  for (size_t k = 0; k < sizeof rows / sizeof rows[0]; k++)
    if (rows[k].outcome == outcome) return rows[k].word;
  return "failed";
}

int hk_outcome_write_status(int descriptor, const int64_t at[HOOKE_PART_COUNT], int32_t outcome) {
  char word[HOOKE_OUTCOME_STATUS] = {0};
  snprintf(word, sizeof word, "%s", hk_outcome_word(outcome));
  return hk_outcome_write(descriptor, at, HOOKE_PART_STATUS, word);
}

int32_t hk_outcome_is_end(const char *status) {
  return status && strcmp(status, "running") != 0 && strcmp(status, "failed") != 0;
}

/* ---- check values ---- */

/* A text in a room of `bytes`, filled with zeros. */
static uint32_t add_padded(uint32_t value, const char *text, size_t bytes) {
  char padded[HOOKE_ERROR_REASON] = {0};
  memcpy(padded, text, strnlen(text, bytes));
  return hk_crc32(value, padded, (int64_t)bytes);
}

uint32_t hk_outcome_check(uint32_t description, const char *status, int64_t beyond, int64_t frames) {
  const uint32_t value = add_padded(description, status, HOOKE_OUTCOME_STATUS);
  return hk_crc32(hk_crc32(value, &beyond, sizeof beyond), &frames, sizeof frames);
}

uint32_t hk_outcome_check_error(uint32_t outcome, const double *numbers, const char *by, const char *reason) {
  const uint32_t value = hk_crc32(outcome, numbers, HOOKE_ERROR_COUNT * sizeof *numbers);
  return add_padded(add_padded(value, by, HOOKE_ERROR_BY), reason, HOOKE_ERROR_REASON);
}

/* ---- name of the run ---- */

static void print_check(uint32_t description, const char *run,
                        char digits[HOOKE_RUN_SIZE - HOOKE_RUN_RANDOM]) {
  snprintf(digits, HOOKE_RUN_SIZE - HOOKE_RUN_RANDOM, "%08x",
           (unsigned)hk_crc32(description, run, HOOKE_RUN_RANDOM));
}

int32_t hk_outcome_new_run(uint32_t description, char run[HOOKE_RUN_SIZE]) {
  unsigned char random[HOOKE_RUN_RANDOM / 2];
  char reason[HOOKE_ERROR_SIZE];
  if (hk_os_random(random, sizeof random) != 0)
    return hk_fail(HOOKE_IO_FAILED, NULL, "could not take a random number for the run: %s",
                   hk_print_error(errno, reason));
  for (size_t k = 0; k < sizeof random; k++)
    snprintf(run + 2 * k, 3, "%02x", random[k]);
  print_check(description, run, run + HOOKE_RUN_RANDOM);
  return HOOKE_OK;
}

int32_t hk_outcome_check_run(uint32_t description, const char *run) {
  char digits[HOOKE_RUN_SIZE - HOOKE_RUN_RANDOM];
  if (strlen(run) != HOOKE_RUN_SIZE - 1) return 0;
  print_check(description, run, digits);
  return strcmp(run + HOOKE_RUN_RANDOM, digits) == 0;
}
