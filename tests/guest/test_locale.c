/* Numbers have a decimal point in every locale of the process or of the thread: input gives the same bits,
 * and output the same bytes, under a locale with a comma as in C. */
#include "check.h"
#include "run.h"
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

enum { ROOM = 1 << 22 };
struct output {
  char *text; /* everything */
  size_t length;
};

static void add(struct output *out, const char *text) {
  const size_t length = strlen(text ? text : "(none)");
  if (out->length + length + 2 > ROOM) check_failed("too much output");
  memcpy(out->text + out->length, text ? text : "(none)", length);
  out->length += length;
  out->text[out->length++] = '\n';
  out->text[out->length] = '\0';
}

static void add_bits(struct output *out, int64_t count, const double *value) {
  char text[32];
  for (int64_t k = 0; k < count; k++) {
    uint64_t bits;
    memcpy(&bits, &value[k], sizeof bits);
    snprintf(text, sizeof text, "%016llx", (unsigned long long)bits);
    add(out, text);
  }
}

static void add_file(struct output *out, const char *path) {
  FILE *file = fopen(path, "rb");
  if (file == NULL) check_failed("no file %s", path);
  out->length += fread(out->text + out->length, 1, ROOM - out->length - 1, file);
  out->text[out->length] = '\0';
  fclose(file);
  remove(path);
}

static void refusals(struct output *out) {
  const double q[] = {0, 0, 0}, bad[] = {0.5, NAN, 1.5};
  hooke_options *options = new_options("run");
  check_status(hooke_options_set_text(options, "step", "-1.25e-3"), HOOKE_BAD_VALUE);
  add(out, hooke_last_error());
  check_status(hooke_options_set_text(options, "step", "1,5"), HOOKE_BAD_VALUE);
  add(out, hooke_last_error());
  check_status(hooke_options_set_number(options, "rtol", 0.25), HOOKE_BAD_VALUE);
  add(out, hooke_last_error());
  check_ok(hooke_options_set_text(options, "step", "1.25e-3"));
  add_bits(out, 1, hooke_options_numbers(options, "step"));
  check_ok(hooke_options_set_number(options, "atol", 0.125));
  add(out, hooke_options_text(options, "atol"));
  for (int64_t row = 0; row < hooke_options_row_count(options); row++) {
    add(out, hooke_options_row(options, row, "default"));
    add(out, hooke_options_row(options, row, "allowed"));
  }
  hooke_options_destroy(options);
  owned_system *system = new_system();
  check_status(hooke_system_set_drag(system, -0.5), HOOKE_BAD_VALUE);
  add(out, hooke_last_error());
  check_status(hooke_system_add_particles(system, 1, bad, NULL, 1, q, NULL), HOOKE_BAD_VALUE);
  add(out, hooke_last_error());
}

static void divergence(struct output *out) {
  owned_system *system = small_oscillator(100.0);
  hooke_integrator *integrator =
      start_run(system, (struct run){.method = "forward-euler", .step = 0.0625, .duration = 100.0});
  owned_state *state = start_state(system);
  check_status(hooke_integrator_run(integrator, state), HOOKE_DIVERGED);
  add(out, hooke_last_error());
#if HOOKE_HAVE_LAPACK
  hooke_measurement *why;
  check_ok(explain_run(integrator, &why));
  add(out, hooke_measurement_text(why, "why", 0, "sentence"));
  for (int64_t k = 0; k < hooke_measurement_row_count(why, "advice"); k++) {
    add(out, hooke_measurement_text(why, "advice", k, "change"));
    add(out, hooke_measurement_text(why, "advice", k, "value"));
  }
  hooke_measurement_destroy(why);
#endif
  hooke_integrator_destroy(integrator);
}

#if HOOKE_HAVE_LAPACK && HOOKE_HAVE_SUNDIALS && HOOKE_HAVE_HDF5

static const char scene_text[] =
    "{\"hooke\": 1, \"gravity\": [0, -9.81, 0], \"drag\": 1.5e-3, \"particles\": {\"position\": [[0.1, "
    "2.5e-1, -3e2]],"
    " \"mass\": 0.3}, \"parts\": [{\"kind\": \"rope\", \"from\": [0, 0, 0], \"to\": [1, 0, 0.25], "
    "\"segments\": 6,"
    " \"mass\": 0.1, \"pinned\": \"start\", \"stretch\": {\"stiffness\": 50.5, \"damping\": 1e-2}}],"
    " \"run\": {\"method\": \"verlet\", \"step\": 0.0005, \"duration\": 0.05, \"every\": 0.01}}";

static void scenes(struct output *out) {
  hooke_scene *scene, *copy;
  check_status(hooke_scene_parse("{\"hooke\": 1, \"drag\": -0.75}", 27, "bad", NULL, NULL, &scene),
               HOOKE_BAD_VALUE);
  add(out, hooke_last_error());
  check_status(hooke_scene_parse("{\"hooke\": 1, \"drag\": 0,75}", 26, "bad", NULL, NULL, &scene),
               HOOKE_BAD_VALUE);
  add(out, hooke_last_error());
  check_ok(hooke_scene_parse(scene_text, (int64_t)strlen(scene_text), "scene", NULL, NULL, &scene));
  check_ok(hooke_scene_commit(scene));
  hooke_system *system = hooke_scene_system(scene);
  hooke_options *run = hooke_scene_run_options(scene), *options;
  hooke_state *state = start_state(system);
  add_bits(out, hooke_state_size(state), hooke_state_position(state));
  add_bits(out, 1, hooke_options_numbers(run, "step"));
  add_bits(out, hooke_system_particle_count(system), hooke_system_mass(system));
  check_ok(hooke_scene_of_system(system, "of a system", run, "copy", NULL, &copy));
  add(out, hooke_scene_text(copy, "text"));
  hooke_scene_destroy(copy);
  check_ok(hooke_scene_write("guest_locale.json", system, "written", run));
  add_file(out, "guest_locale.json");

  hooke_measurement *limit;
  options = options_with("limit", "predict=1");
  check_ok(hooke_measurement_create("limit", system, run, options, &limit));
  check_ok(hooke_measurement_run(limit, state));
  for (int64_t row = 0; row < hooke_measurement_row_count(limit, "rows"); row++)
    add(out, hooke_measurement_text(limit, "rows", row, "note"));
  add(out, hooke_measurement_text(limit, "changes", 0, "sentence"));
  hooke_measurement_destroy(limit);
  hooke_options_destroy(options);

  hooke_measurement *study;
  options = options_with("study", "methods=verlet steps=0.0005,0.00025");
  check_ok(hooke_measurement_create("study", system, run, options, &study));
  check_ok(hooke_measurement_run(study, NULL));
  check_ok(hooke_study_recommend(study, 1e-13));
  add(out, hooke_measurement_text(study, "recommendation", 0, "note"));
  check_ok(hooke_measurement_write(study, "guest_locale.csv"));
  /* some of its columns are times: only their number is compared */
  FILE *table = fopen("guest_locale.csv", "r");
  char line[1024];
  assert_non_null(table);
  while (fgets(line, sizeof line, table)) {
    char columns[16];
    int64_t commas = 0;
    for (const char *c = line; *c; c++)
      commas += *c == ',';
    snprintf(columns, sizeof columns, "%d columns", (int)commas);
    add(out, columns);
  }
  fclose(table);
  remove("guest_locale.csv");
  hooke_measurement_destroy(study);
  hooke_options_destroy(options);

  hooke_integrator *integrator =
      start_run(system, (struct run){.method = "verlet", .step = 0.0005, .duration = 0.001});
  hooke_trajectory *trajectory;
  hooke_record *record;
  check_ok(hooke_trajectory_create("guest_locale.h5", system, integrator, scene_text, &trajectory));
  check_ok(hooke_trajectory_write(trajectory, 0, state));
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
  check_ok(hooke_record_open("guest_locale.h5", &record));
  check_ok(hooke_record_write_xdmf(record, "guest_locale.xdmf"));
  add_file(out, "guest_locale.xdmf");
  add_bits(out, 1, hooke_options_numbers(hooke_record_options(record), "step"));
#if HOOKE_HAVE_CHARTJS && HOOKE_HAVE_THREEJS
  hooke_measurement *view;
  check_ok(hooke_view_create(record, NULL, &view));
  check_ok(hooke_measurement_label(view, "title", "title"));
  check_ok(hooke_measurement_write(view, "guest_locale.html"));
  add_file(out, "guest_locale.html");
  hooke_measurement_destroy(view);
#endif
  hooke_record_close(record);
  remove("guest_locale.h5");
  hooke_integrator_destroy(integrator);
  hooke_state_destroy(state);
  hooke_scene_destroy(scene);
}

#else

static void scenes(struct output *out) {
  (void)out, (void)add_file;
}

#endif

static struct output everything(void) {
  struct output out = {.text = new_block(ROOM, 1)};
  refusals(&out);
  divergence(&out);
  scenes(&out);
  return out;
}

static void check_same_output(const struct output *found, const struct output *expected) {
  size_t k = 0;
  while (k < found->length && k < expected->length && found->text[k] == expected->text[k])
    k++;
  if (k == found->length && k == expected->length) return;
  const size_t from = k > 60 ? k - 60 : 0;
  check_failed("other bytes under a locale with a comma:\n  %.100s\ninstead of\n  %.100s", found->text + from,
               expected->text + from);
}

TEST(test_locale_of_the_process) {
  const struct output expected = everything();
  if (setlocale(LC_NUMERIC, name) == NULL) {
    free(expected.text);
    print_message("there is no localedef to make a locale with a comma\n");
    skip();
  }
  assert_true(has_comma());
  const struct output found = everything();
  assert_true(has_comma());
  setlocale(LC_NUMERIC, "C");
  check_same_output(&found, &expected);
  free(found.text);
  free(expected.text);
}

TEST(test_locale_of_the_thread) {
  const locale_t comma = newlocale(LC_NUMERIC_MASK, name, (locale_t)0);
  if (comma == (locale_t)0) skip();
  const struct output expected = everything();
  uselocale(comma);
  assert_true(has_comma());
  const struct output found = everything();
  assert_true(has_comma());
  uselocale(LC_GLOBAL_LOCALE);
  freelocale(comma);
  check_same_output(&found, &expected);
  free(found.text);
  free(expected.text);
}

AROUND_ALL(make_locale, remove_locale)
