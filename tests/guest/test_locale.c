/* Numbers have a decimal point in every locale of the process or of the thread: input gives the same bits,
 * and output the same bytes, under a locale with a comma as in C, in every scenario of tests/fault and in
 * messages. */
#include "check.h"
#include "scenarios.h"
#include "small.h"

#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- a locale with a comma, created here: a machine need not have one ---- */

static const char folder[] = "guest_locale", name[] = "comma.UTF-8";
static const char source[] =
    "LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \".\"\ngrouping 3;3\nEND LC_NUMERIC\n";

static int make_locale(void **unused) {
  (void)unused;
  char command[256];
  snprintf(command, sizeof command, "mkdir -p %s", folder);
  if (system(command) != 0) return 0;
  snprintf(command, sizeof command, "%s/comma", folder);
  FILE *file = fopen(command, "w");
  if (file == NULL) return 0;
  fputs(source, file);
  fclose(file);
  snprintf(command, sizeof command, "localedef -c -i %s/comma -f UTF-8 ./%s/%s >%s/log 2>&1", folder, folder,
           name, folder);
  const int ignored = system(command); /* 1 for the categories that are missing */
  (void)ignored;
  setenv("LOCPATH", folder, 1);
  return 0;
}

static int remove_locale(void **unused) {
  (void)unused;
  char command[64];
  snprintf(command, sizeof command, "rm -r %s", folder);
  return system(command) != 0;
}

static int has_comma(void) {
  char text[8];
  snprintf(text, sizeof text, "%.1f", 0.5);
  return strcmp(text, "0,5") == 0;
}

/* ---- all input and output ---- */

static char scenes[128]; /* folder of the scenarios */

static int prepare(void **prepared) {
  return make_locale(prepared) || open_folder(scenes);
}

static int clear(void **prepared) {
  return close_folder(scenes) || remove_locale(prepared);
}

static void add_file(struct attempt *a, const char *output) {
  FILE *file = fopen(path_of(a, output), "rb");
  if (file == NULL) return;
  for (int c; (c = fgetc(file)) != EOF;)
    attempt_number(a, c);
  fclose(file);
  remove(path_of(a, output));
}

/* A scenario, and the files that it wrote in which there are no times: the others are read by it. What a cost
 * has depends on the clock. */
static uint64_t result_of(const struct scenario *scenario) {
  if (scenario->share > 20 || strncmp(scenario->name, "cost", 4) == 0) return 0;
  struct attempt a = scenario_attempt(scenes);
  scenario->run(&a, scenario->with);
  if (a.wrong[0]) check_failed("%s: %s", scenario->name, a.wrong);
  add_file(&a, "out.xdmf");
  add_file(&a, "out.json");
  if (scenario->files && strcmp(scenario->name, "write, page") == 0) add_file(&a, "out.html");
  return a.hash;
}

/* What is refused, and what options tell. */
static uint64_t messages(void) {
  struct attempt a = scenario_attempt(scenes);
  const double q[] = {0, 0, 0}, bad[] = {0.5, NAN, 1.5};
  owned_options *options = new_options("run");
  owned_system *system = new_system();
  const char *const steps[] = {"-1.25e-3", "1,5"};
  for (int k = 0; k < 2; k++) {
    check_status(hooke_options_set_text(options, "step", steps[k]), HOOKE_BAD_VALUE);
    attempt_text(&a, hooke_last_error());
  }
  check_status(hooke_options_set_number(options, "rtol", 0.25), HOOKE_BAD_VALUE);
  attempt_text(&a, hooke_last_error());
  check_ok(hooke_options_set_text(options, "step", "1.25e-3"));
  check_close(hooke_options_number(options, "step"), 1.25e-3, 0.0);
  check_ok(hooke_options_set_number(options, "atol", 0.125));
  attempt_number(&a, hooke_options_number(options, "atol"));
  for (int64_t row = 0; row < hooke_options_row_count(options); row++) {
    attempt_text(&a, hooke_options_row(options, row, "default"));
    attempt_text(&a, hooke_options_row(options, row, "allowed"));
  }
  check_status(hooke_system_set_drag(system, -0.5), HOOKE_BAD_VALUE);
  assert_non_null(strstr(hooke_last_error(), "-0.5"));
  check_status(hooke_system_add_particles(system, 1, bad, NULL, 1, q, NULL), HOOKE_BAD_VALUE);
  attempt_text(&a, hooke_last_error());
  return a.hash;
}

enum { MOST = 200 };

static void take_all(uint64_t result[MOST]) {
  const struct scenario *scenario;
  for (int32_t k = 0; (scenario = scenario_at(k)) != NULL; k++) {
    assert_true(k + 1 < MOST);
    result[k] = result_of(scenario);
  }
  result[MOST - 1] = messages();
}

/* With a locale that has a comma now, and `expected` of the locale C. */
static void check_all(const uint64_t expected[MOST]) {
  uint64_t found[MOST] = {0};
  assert_true(has_comma());
  take_all(found);
  assert_true(has_comma());
  for (int k = 0; k < MOST; k++) {
    if (found[k] != expected[k])
      check_failed("%s: another result under a locale with a comma",
                   k + 1 < MOST ? scenario_at(k)->name : "messages");
  }
}

TEST(test_locale_of_the_process) {
  uint64_t expected[MOST] = {0};
  take_all(expected);
  if (setlocale(LC_NUMERIC, name) == NULL) {
    print_message("there is no localedef to make a locale with a comma\n");
    skip();
  }
  check_all(expected);
  setlocale(LC_NUMERIC, "C");
}

TEST(test_locale_of_the_thread) {
  const locale_t comma = newlocale(LC_NUMERIC_MASK, name, (locale_t)0);
  uint64_t expected[MOST] = {0};
  if (comma == (locale_t)0) skip();
  take_all(expected);
  uselocale(comma);
  check_all(expected);
  uselocale(LC_GLOBAL_LOCALE);
  freelocale(comma);
}

AROUND_ALL(prepare, clear)
