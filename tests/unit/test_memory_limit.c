/* Memory limit: too large scenes are refused before anything is allocated, at the limits of 32-bit numbers
 * and of memory; stated needs are compared with the memory used. */
#include "hooke.h"
#include "check.h"
#include "run.h"
#include "small.h"
#include "sanitized.h"

#include "core/memory.h"
#include "core/memory_limit.h"
#include "model/system.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

static const double LITTLE = 1e6; /* bytes, too few for any scene at the limits */

static hooke_system *limited_system(double limit) {
  hooke_system *system = new_system();
  check_ok(hooke_system_limit_memory(system, limit));
  return system;
}

/* ---- parts ---- */

static hooke_options *part_options(const char *kind, int64_t size[3]) {
  const double a = (double)size[0], b = (double)size[1], c = (double)size[2];
  if (strcmp(kind, "cloth") == 0)
    return options_with(kind, "mass=1 edges=1,0,0,0,1,0 size=%.17g,%.17g", a, b);
  if (strcmp(kind, "lattice") == 0)
    return options_with(kind, "mass=1 edges=1,0,0,0,1,0,0,0,1 size=%.17g,%.17g,%.17g", a, b, c);
  return options_with(kind, "mass=1 from=0,0,0 to=1,0,0 segments=%.17g", a);
}

/* Up to 2^31 - 1 of everything memory is the limit, beyond it the numbers. */
static void check_part(const char *kind, const char *family, int64_t a, int64_t b, int64_t c,
                       int32_t expected, const char *count) {
  owned_system *system = limited_system(LITTLE);
  int64_t size[3] = {a, b, c};
  owned_options *options = part_options(kind, size);
  if (family) check_ok(hooke_options_set_number(options, family, 1.0));
  check_status(hooke_system_add_part(system, kind, "", options, NULL, NULL), expected);
  check_message("of memory");
  check_message(count);
  assert_int_equal(hooke_system_particle_count(system), 0);
}

TEST(parts_stop_at_the_edge_of_32_bits) {
  check_part("rope", NULL, 2147483645, 0, 0, HOOKE_NO_MEMORY, "601 GB");
  check_part("rope", NULL, 2147483646, 0, 0, HOOKE_NO_MEMORY, "601 GB");
  check_part("rope", NULL, 2147483647, 0, 0, HOOKE_BAD_VALUE, "2147483648 particles");
  check_part("rope", "bending", 2147483646, 0, 0, HOOKE_NO_MEMORY, "730 GB");
  check_part("cloth", NULL, 2, 1073741823, 0, HOOKE_NO_MEMORY, "601 GB");
  check_part("cloth", NULL, 2, 1073741824, 0, HOOKE_BAD_VALUE, "2147483648 particles");
  check_part("cloth", NULL, 1073741825, 2, 0, HOOKE_BAD_VALUE, "2147483650 particles");
  check_part("cloth", NULL, 2147483647, 2147483647, 0, HOOKE_BAD_VALUE, "4.611686014e+18 particles");
  check_part("cloth", "structural.stiffness", 2, 715827883, 0, HOOKE_NO_MEMORY, "GB");
  check_part("cloth", "structural.stiffness", 2, 715827884, 0, HOOKE_BAD_VALUE, "2147483650 springs");
  check_part("cloth", "shear.stiffness", 32769, 32769, 0, HOOKE_BAD_VALUE, "2147483648 springs");
  check_part("cloth", "shear.stiffness", 32768, 32769, 0, HOOKE_NO_MEMORY, "GB");
  check_part("lattice", NULL, 2, 2, 536870911, HOOKE_NO_MEMORY, "601 GB");
  check_part("lattice", NULL, 2, 536870912, 2, HOOKE_BAD_VALUE, "2147483648 particles");
  check_part("lattice", NULL, 2147483647, 2147483647, 2147483647, HOOKE_BAD_VALUE, "9.9035203e+27 particles");
  check_part("lattice", "shear.stiffness", 599, 599, 600, HOOKE_NO_MEMORY, "GB");
  check_part("lattice", "shear.stiffness", 600, 600, 600, HOOKE_BAD_VALUE, "springs");
  check_part("strand", NULL, 1073741822, 0, 0, HOOKE_NO_MEMORY, "601 GB");
}

TEST(a_mesh_stops_at_the_edge_of_32_bits) {
  const double vertex[3] = {0};
  const int64_t triangle[3] = {0};
  owned_options *options = new_options("mesh");
  const int64_t counts[] = {2147483648, 2147483649, INT64_MAX / 3 + 1, INT64_MAX};
  for (size_t k = 0; k < sizeof counts / sizeof counts[0]; k++) {
    check_status(hooke_mesh_set(options, counts[k], vertex, 1, triangle), HOOKE_BAD_VALUE);
    check_status(hooke_mesh_set(options, 1, vertex, counts[k], triangle), HOOKE_BAD_VALUE);
  }
}

/* ---- systems by hand ---- */

static hooke_options *spring_options(void) {
  hooke_options *options = options_with("springs", "stiffness=1");
  return options;
}

static hooke_options *altitude_options(void) {
  hooke_options *options = options_with("altitude", "stiffness=1");
  return options;
}

/* The arrays have one element: nothing of them is read. */
TEST(systems_stop_at_the_edge_of_32_bits) {
  owned_system *system = limited_system(LITTLE);
  owned_options *spring = spring_options(), *altitude = altitude_options();
  const double one = 1.0, place[12] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int64_t ends[4] = {0, 1, 2, 3};
  check_ok(hooke_system_add_particles(system, 4, place, NULL, 1, &one, NULL));
  const struct {
    int64_t count;
    int32_t expected;
  } cases[] = {
      {INT32_MAX - 5, HOOKE_NO_MEMORY}, {INT32_MAX - 4, HOOKE_NO_MEMORY}, {2147483646, HOOKE_NO_MEMORY},
      {2147483647, HOOKE_NO_MEMORY},    {2147483648, HOOKE_BAD_VALUE},    {2147483649, HOOKE_BAD_VALUE},
      {INT64_MAX / 3, HOOKE_BAD_VALUE}, {INT64_MAX, HOOKE_BAD_VALUE},     {-1, HOOKE_BAD_VALUE},
      {INT64_MIN, HOOKE_BAD_VALUE}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    const int64_t count = cases[k].count;
    const int32_t expected = cases[k].expected;
    check_status(hooke_system_add_particles(system, count, place, NULL, 1, &one, NULL),
                 count > INT32_MAX - 4 ? HOOKE_BAD_VALUE : expected);
    check_status(hooke_system_add_springs(system, "", count, ends, spring), expected);
    check_status(hooke_system_add_bending(system, "", count, ends, 1, &one), expected);
    check_status(hooke_system_add_altitude(system, "", count, ends, altitude), expected);
    if (count < 0 || count > INT32_MAX)
      check_status(hooke_system_drive_harmonic(system, count, ends, place, 1.0, 0.0), HOOKE_BAD_VALUE);
  }
  /* existing members count, in numbers and in memory */
  check_ok(hooke_system_limit_memory(system, INFINITY));
  for (int k = 0; k < HOOKE_FORCES; k++)
    system->rest->member_total[k] = INT32_MAX - 1;
  check_ok(hooke_system_add_springs(system, "", 1, ends, spring));
  check_ok(hooke_system_add_bending(system, "", 1, ends, 1, &one));
  check_ok(hooke_system_add_altitude(system, "", 1, ends, altitude));
  check_status(hooke_system_add_springs(system, "", 1, ends, spring), HOOKE_BAD_VALUE);
  check_message("2147483648 springs");
  check_status(hooke_system_add_bending(system, "", 1, ends, 1, &one), HOOKE_BAD_VALUE);
  check_status(hooke_system_add_altitude(system, "", 1, ends, altitude), HOOKE_BAD_VALUE);
  check_ok(hooke_system_limit_memory(system, LITTLE));
  check_status(hooke_system_add_particles(system, 1, place, NULL, 1, &one, NULL), HOOKE_NO_MEMORY);
  check_status(hooke_system_limit_memory(system, -1.0), HOOKE_BAD_VALUE);
  check_status(hooke_system_limit_memory(system, (double)NAN), HOOKE_BAD_VALUE);
}

/* A part that fails leaves the counts unchanged. */
TEST(what_is_taken_back_does_not_count) {
  owned_system *system = limited_system(0.0);
  int64_t size[3] = {10, 10, 0};
  owned_options *options = part_options("cloth", size);
  check_ok(hooke_options_set_number(options, "structural.stiffness", 1.0));
  check_ok(hooke_options_set_number(options, "bending", 1.0));
  check_ok(hooke_system_add_part(system, "cloth", "", options, NULL, NULL));
  const double before = hk_system_needed_bytes(system, (struct hk_more){0});
  assert_int_equal(system->rest->member_total[hk_force_number(&hk_force_springs)], 180);
  assert_int_equal(system->rest->member_total[hk_force_number(&hk_force_bending)], 160);
  check_ok(hooke_options_set_number(options, "pinned", 100.0));
  check_status(hooke_system_add_part(system, "cloth", "", options, NULL, NULL), HOOKE_BAD_VALUE);
  check_close(hk_system_needed_bytes(system, (struct hk_more){0}), before, 0.0);
}

/* ---- stated needs ---- */

static double peak(void) {
  struct rusage use;
  getrusage(RUSAGE_SELF, &use);
  return 1024.0 * (double)use.ru_maxrss;
}

/* Builds, commits and runs one step; returns the fraction of the stated memory that was used. */
static double share_used(const char *kind, int64_t a, int64_t b, int64_t c, const char *const *families) {
  const double before = peak();
  owned_system *system = limited_system(0.0);
  owned_integrator *integrator = NULL;
  int64_t size[3] = {a, b, c};
  owned_options *options = part_options(kind, size);
  for (; *families; families++)
    check_ok(hooke_options_set_number(options, *families, 1e-3));
  check_ok(hooke_system_add_part(system, kind, "", options, NULL, NULL));
  const double needed = hk_system_needed_bytes(system, (struct hk_more){0});
  check_ok(hooke_system_commit(system));
  owned_state *state = start_state(system);
  owned_options *run = options_with("run", "method=symplectic-euler step=1e-9 duration=1e-9");
  check_ok(hooke_integrator_create(system, run, &integrator));
  check_ok(hooke_integrator_run(integrator, state));
  return (peak() - before) / needed;
}

static const struct {
  const char *kind;
  int64_t size[3];
  const char *families[5];
} scenes[] = {
    {"cloth", {400, 400, 0}, {NULL}},
    {"cloth", {400, 400, 0}, {"structural.stiffness", NULL}},
    {"cloth", {400, 400, 0}, {"structural.stiffness", "shear.stiffness", "bend.stiffness", NULL}},
    {"cloth", {400, 400, 0}, {"structural.stiffness", "bending", NULL}},
    {"lattice", {45, 45, 45}, {"structural.stiffness", "shear.stiffness", "bend.stiffness", NULL}},
    {"rope", {150000, 0, 0}, {"stretch.stiffness", "bending", NULL}},
    {"strand",
     {70000, 0, 0},
     {"stretch.stiffness", "bend.stiffness", "twist.stiffness", "altitude.stiffness", NULL}},
};

/* Each in its own process, since a peak stays. */
TEST(a_scene_takes_what_it_is_said_to_need) {
  if (short_of_time()) return; /* and memory is counted differently there */
  for (size_t k = 0; k < sizeof scenes / sizeof scenes[0]; k++) {
    const pid_t child = fork();
    if (child == 0) {
      const double share = share_used(scenes[k].kind, scenes[k].size[0], scenes[k].size[1], scenes[k].size[2],
                                      scenes[k].families);
      _exit((int)fmin(255.0, 100.0 * share));
    }
    int status = 0;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    const int percent = WEXITSTATUS(status);
    if (getenv("HOOKE_SHOW")) fprintf(stderr, "scene %zu: %d %%\n", k, percent);
    if (percent < 40 || percent > 100)
      check_failed("scene %zu took %d %% of what it was said to need", k, percent);
  }
}

TEST(bytes_are_shown_in_three_digits) {
  char shown[HOOKE_BYTES_SHOWN];
  const struct {
    double bytes;
    const char *text;
  } cases[] = {{0, "0 bytes"},    {999, "999 bytes"},     {1000, "1 kB"},   {4.12e11, "412 GB"},
               {999.6e9, "1 TB"}, {2.5e25, "2.5e+07 EB"}, {1.5e6, "1.5 MB"}};
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++)
    assert_string_equal(hk_show_bytes(cases[k].bytes, shown), cases[k].text);
  check_ok(hk_memory_require(100.0, 100.0, "it"));
  check_status(hk_memory_require(100.0, 101.0, "it"), HOOKE_NO_MEMORY);
  assert_string_equal(
      hooke_last_error(),
      "it needs 101 bytes of memory; there are 100 bytes (the limit that was set); allowed: less "
      "than that, or a higher limit set by the caller");
}

/* The limit on the address space is read each time. */
TEST(a_limit_on_the_address_space_counts) {
  struct rlimit before;
  const char *which = NULL;
  assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
  const double all = hk_memory_limit(&which);
  assert_true(all > 1e6);
  if (HOOKE_SANITIZED) return; /* which reserves a large part of it */
  struct rlimit less = before;
  less.rlim_cur = (rlim_t)(all / 2.0);
  if (setrlimit(RLIMIT_AS, &less) != 0) return;
  struct rlimit now;
  assert_int_equal(getrlimit(RLIMIT_AS, &now), 0);
  if (now.rlim_cur != less.rlim_cur) return; /* an emulator without such limits */
  check_close(hk_memory_limit(&which), (double)less.rlim_cur, 0.0);
  assert_string_equal(which, "the limit on the address space");
  assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
}

/* ---- the text of a scene ---- */

static hooke_options *limits(double gigabytes, int32_t outside) {
  hooke_options *options = new_options("limits");
  if (gigabytes > 0.0) check_ok(hooke_options_set_number(options, "memory", gigabytes));
  check_ok(hooke_options_set_number(options, "outside", outside));
  return options;
}

static void check_parse(const char *text, double gigabytes, int32_t expected, const char *message) {
  owned_scene *scene = NULL;
  owned_options *options = limits(gigabytes, 0);
  check_status(hooke_scene_parse(text, (int64_t)strlen(text), "s", NULL, options, &scene), expected);
  if (message) check_message(message);
}

TEST(scenes_that_are_too_large_are_refused) {
  check_parse("{\"hooke\":1,\"parts\":[{\"kind\":\"cloth\",\"size\":[100000,100000],"
              "\"edges\":[[1,0,0],[0,1,0]],\"mass\":1}]}",
              0.0, HOOKE_BAD_VALUE,
              "s:1:44: parts[0].size: a cloth of 100000 x 100000 particles needs 2.8 TB of memory");
  /* each part fits, all together do not */
  const char *parts = "{\"hooke\":1,\"parts\":["
                      "{\"kind\":\"rope\",\"from\":[0,0,0],\"to\":[1,0,0],\"segments\":1000,\"mass\":1},"
                      "{\"kind\":\"rope\",\"from\":[0,0,0],\"to\":[1,0,0],\"segments\":1000,\"mass\":1}]}";
  check_parse(parts, 1e-3, HOOKE_OK, NULL);
  check_parse(parts, 5e-4, HOOKE_NO_MEMORY, "s:1:144: parts[1].segments: a rope of 1000 segments needs");
  /* lists of numbers, before they are parsed */
  char many[4096] = "{\"hooke\":1,\"title\":[";
  for (int k = 0; k < 1000; k++)
    strcat(many, "0,");
  strcat(many, "0]}");
  check_parse(many, 2e-5, HOOKE_BAD_VALUE, "title");
  check_parse(many, 1e-5, HOOKE_NO_MEMORY, "s: this scene needs");
}

TEST(equal_names_are_found_among_many) {
  enum { PARTS = 3000 };
  char *text = new_block(PARTS * 128 + 256, 1), *at = text;
  at += sprintf(at, "{\"hooke\":1,\"parts\":[");
  for (int k = 0; k < PARTS; k++)
    at += sprintf(
        at, "%s{\"name\":\"%x\",\"kind\":\"rope\",\"from\":[0,0,0],\"to\":[1,0,0],\"segments\":1,\"mass\":1}",
        k ? "," : "", (unsigned)k * 7919u % (PARTS + 1));
  char *end = at;
  sprintf(end, "],\"springs\":[{\"between\":[[[\"0\",0],[\"%x\",1]]],\"stiffness\":1}]}",
          (PARTS - 1u) * 7919u % (PARTS + 1));
  check_parse(text, 0.0, HOOKE_OK, NULL);
  sprintf(end, "],\"springs\":[{\"between\":[[[\"0\",0],[\"no\",1]]],\"stiffness\":1}]}");
  check_parse(text, 0.0, HOOKE_BAD_VALUE, "there is no part \"no\"; allowed: 0, ");
  sprintf(end,
          ",{\"name\":\"0\",\"kind\":\"rope\",\"from\":[0,0,0],\"to\":[1,0,0],\"segments\":1,\"mass\":1}]}");
  check_parse(text, 0.0, HOOKE_BAD_VALUE, "parts[3000].name: \"0\" is the name of part 0 already");
  free(text);
}

/* ---- files ---- */

static void write_text(const char *path, const char *text) {
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs(text, file);
  fclose(file);
}

static void check_load(const char *path, int32_t outside, int32_t expected, const char *message) {
  owned_scene *scene = NULL;
  owned_options *options = limits(0.0, outside);
  check_status(hooke_scene_load(path, options, &scene), expected);
  if (message) check_message(message);
}

/* The pipe has no writer: the alarm ends a process that waits for it. */
TEST(nothing_waits_for_a_pipe) {
  char folder[] = "/tmp/hooke-room-XXXXXX";
  assert_non_null(mkdtemp(folder));
  const int back = open(".", O_RDONLY);
  assert_int_equal(chdir(folder), 0);
  assert_int_equal(mkfifo("pipe", 0600), 0);
  alarm(20);
  write_text("mesh.json", "{\"hooke\":1,\"parts\":[{\"kind\":\"mesh\",\"file\":\"pipe\",\"mass\":1}]}");
  write_text("array.json",
             "{\"hooke\":1,\"particles\":{\"mass\":1,\"position\":{\"file\":\"pipe\",\"dataset\":\"/a\"}}}");
  check_load("pipe", 0, HOOKE_BAD_VALUE, "is not a regular file");
  check_load("mesh.json", 0, HOOKE_BAD_VALUE, "parts[0].file: pipe: is not a regular file");
  check_load("array.json", 0, HOOKE_HAVE_HDF5 ? HOOKE_BAD_VALUE : HOOKE_NOT_BUILT, "pipe");
  check_load("/dev/zero", 0, HOOKE_BAD_VALUE, "is not a regular file");
  hooke_record *record = NULL;
  check_status(hooke_record_open("pipe", &record), HOOKE_HAVE_HDF5 ? HOOKE_IO_FAILED : HOOKE_NOT_BUILT);
  alarm(0);
  unlink("pipe");
  unlink("mesh.json");
  unlink("array.json");
  assert_int_equal(fchdir(back), 0);
  close(back);
  rmdir(folder);
}

static const char triangle[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

static void check_named(const char *file, int32_t outside, int32_t expected, const char *message) {
  char text[512];
  snprintf(text, sizeof text, "{\"hooke\":1,\"parts\":[{\"kind\":\"mesh\",\"file\":\"%s\",\"mass\":1}]}",
           file);
  write_text("inside/scene.json", text);
  check_load("inside/scene.json", outside, expected, message);
}

TEST(files_stay_in_the_folder_unless_allowed) {
  char folder[] = "/tmp/hooke-room-XXXXXX", absolute[128];
  assert_non_null(mkdtemp(folder));
  const int back = open(".", O_RDONLY);
  assert_int_equal(chdir(folder), 0);
  assert_int_equal(mkdir("inside", 0700), 0);
  assert_int_equal(mkdir("inside-too", 0700), 0);
  write_text("out.obj", triangle);
  write_text("inside-too/out.obj", triangle);
  write_text("inside/in.obj", triangle);
  assert_int_equal(symlink("../out.obj", "inside/link.obj"), 0);
  assert_int_equal(symlink("../inside-too", "inside/folder"), 0);
  assert_int_equal(symlink("in.obj", "inside/fine.obj"), 0);
  assert_int_equal(symlink("loop.obj", "inside/loop.obj"), 0);
  snprintf(absolute, sizeof absolute, "%s/out.obj", folder);
  const char *const out[] = {"../out.obj",   "link.obj", "folder/out.obj",
                             "./../out.obj", absolute,   "../inside-too/out.obj"};
  for (size_t k = 0; k < sizeof out / sizeof out[0]; k++) {
    check_named(out[k], 0, HOOKE_BAD_VALUE, "parts[0].file");
    check_named(out[k], 1, HOOKE_OK, NULL);
  }
  check_named("in.obj", 0, HOOKE_OK, NULL);
  check_named("./in.obj", 0, HOOKE_OK, NULL);
  check_named("fine.obj", 0, HOOKE_OK, NULL);
  check_named("loop.obj", 0, HOOKE_BAD_VALUE, "cannot be opened");
  check_named("/proc/self/environ", 0, HOOKE_BAD_VALUE, "relative and without ..");
  check_named("/dev/zero", 1, HOOKE_BAD_VALUE, "is not a regular file");
  check_named("none.obj", 1, HOOKE_BAD_VALUE, "cannot be opened");
  const char *const files[] = {"out.obj",         "inside-too/out.obj", "inside/in.obj", "inside/link.obj",
                               "inside/fine.obj", "inside/loop.obj",    "inside/folder", "inside/scene.json"};
  for (size_t k = 0; k < sizeof files / sizeof files[0]; k++)
    unlink(files[k]);
  rmdir("inside");
  rmdir("inside-too");
  assert_int_equal(fchdir(back), 0);
  close(back);
  rmdir(folder);
}

static int32_t no_rate(int64_t n, double time, const double *x, double *rate, void *ctx) {
  (void)n, (void)time, (void)x, (void)rate, (void)ctx;
  return 0;
}

static int32_t no_force(int64_t n, double time, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)time, (void)q, (void)v, (void)force, (void)ctx;
  return 0;
}

/* Problems without particles have as many numbers as systems may have, and sizes that overflow are
 * refused. */
TEST(problems_stop_where_systems_do) {
  const int64_t most = 3 * (int64_t)INT32_MAX,
                bad[] = {INT64_MIN, -1, 0, most + 1, INT64_C(1) << 62, INT64_MAX};
  const double mass = 1.0;
  owned_options *run = options_with("run", "method=rk4 step=0.1");
  for (size_t k = 0; k < sizeof bad / sizeof bad[0]; k++) {
    hooke_state *state = NULL;
    hooke_integrator *made = NULL;
    check_status(hooke_state_create_first_order(bad[k], &state), HOOKE_BAD_VALUE);
    check_message("1 to 6442450941 are");
    check_status(hooke_state_create_second_order(bad[k], &state), HOOKE_BAD_VALUE);
    check_status(hooke_integrator_create_first_order(bad[k], no_rate, NULL, run, &made), HOOKE_BAD_VALUE);
    check_message("1 to 6442450941 are");
    check_status(hooke_integrator_create_second_order(bad[k], no_force, NULL, NULL, 1, &mass, run, &made),
                 HOOKE_BAD_VALUE);
    assert_true(state == NULL && made == NULL);
  }
  check_status(hk_size_check(most, 1 << 24), HOOKE_NO_MEMORY);
  check_ok(hk_size_check(1, 7));
}

/* No allocator has that much, and that of a sanitizer is not asked. */
TEST(a_failed_allocation_keeps_errno) {
  errno = EDOM;
  assert_null(hk_new(HOOKE_SANITIZED ? INT64_MAX / 4 : INT64_MAX / 64, sizeof(double)));
  assert_int_equal(errno, EDOM);
}
