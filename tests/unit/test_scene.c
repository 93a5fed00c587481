/* The scene loader: the system of a valid scene, and the position of the fault in an invalid one. */
#include "check.h"
#include "run.h"

#include "core/memory.h"
#include "io/scene/json.h"
#include "io/scene/scene_file.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

/* Quotes are written ' in these texts. */
static char *json(const char *text) {
  char *copy = hk_copy_text(text);
  for (char *c = copy; *c; c++)
    if (*c == '\'') *c = '"';
  return copy;
}

#define TWO "'particles': {'position': [[0,0,0],[1,0,0]], 'mass': 1}"

/* ---- places, tokens, files ---- */

static void check_place(const char *path, int32_t key, int64_t line, int64_t column) {
  char *text =
      json("{ 'a': [1, {'b': 'x,}]'} ,\n  [2, 3]],\n\t'\xc3\xa4 k.y': { 'c[0]': null, 'c': [true] } }\n");
  char *opened = NULL;
  const char *at;
  int64_t found_line, found_column;
  check_ok(hk_json_open(text, (int64_t)strlen(text), &opened, &at));
  hk_json_line(text, text + (hk_json_find(opened, path, key) - opened), &found_line, &found_column);
  if (found_line != line || found_column != column)
    check_failed("%s is at %lld:%lld, not %lld:%lld", path, (long long)found_line, (long long)found_column,
                 (long long)line, (long long)column);
  hk_free(opened);
  hk_free(text);
}

TEST(paths_are_found) {
  check_place("", 0, 1, 1);
  check_place("a", 0, 1, 8);
  check_place("a", 1, 1, 3);
  check_place("a[0]", 0, 1, 9);
  check_place("a[1]", 0, 1, 12);
  check_place("a[1].b", 0, 1, 18);
  check_place("a[1].b", 1, 1, 13);
  check_place("a[2][1]", 0, 2, 7);
  check_place("\xc3\xa4 k.y", 0, 3, 11);
  check_place("\xc3\xa4 k.y", 1, 3, 2);
  check_place("\xc3\xa4 k.y.c[0]", 0, 3, 21);
  check_place("\xc3\xa4 k.y.c", 0, 3, 32);
}

/* A missing path has the position of its longest existing prefix. */
TEST(missing_paths_are_found_as_far_as_they_go) {
  check_place("b", 0, 1, 1);
  check_place("a[3]", 0, 1, 8);
  check_place("a[99999999999]", 0, 1, 8);
  check_place("a[2].x", 0, 2, 3);
  check_place("a[1].b.c", 0, 1, 18);
  check_place("a[1].c", 1, 1, 12);
}

static void check_tokens(const char *quoted, const char *message, int64_t column) {
  char *text = json(quoted), *opened = NULL;
  const char *at = NULL;
  check_status(hk_json_open(text, (int64_t)strlen(text), &opened, &at), message ? HOOKE_BAD_VALUE : HOOKE_OK);
  if (message) {
    check_message(message);
    assert_int_equal(at - text + 1, column);
    assert_null(opened);
  }
  hk_free(opened);
  hk_free(text);
}

TEST(numbers_that_would_change_are_refused) {
  check_tokens(
      "{'a': [1e-300, 0e-999, 9223372036854775807, -9223372036854775808, true, 'NaN 1e999 \\' 1e-999']}",
      NULL, 0);
  check_tokens("{'a': 1e-999}", "1e-999 would become 0", 7);
  check_tokens("{'a': [0, -0.00001E-320]}", "-0.00001E-320 would become 0", 11);
  check_tokens("{'a': 1e999}", "1e999 is beyond the largest number", 7);
  check_tokens("{'a': NaN}", "NaN is not JSON", 7);
  check_tokens("{'a': -Infinity}", "-Infinity is not JSON", 7);
  check_tokens("{'a': 0x10}", "0x10 is not JSON here", 7);
  check_tokens("{'a': 01}", "01 is not JSON", 7);
  check_tokens("{'a': .5}", ".5 is not JSON", 7);
  check_tokens("{'a': 9223372036854775808}", "9223372036854775808 is too large", 7);
  check_tokens("{'a': -9223372036854775809}", "-9223372036854775809 is too large", 7);
  check_tokens("{'a': True}", "True is not JSON", 7);
  check_tokens("{'a': 1, // one\n}", "a comment is not JSON", 10);
  check_tokens("{'a' = 1}", "= is not JSON", 6);
  check_tokens("{'a': \xc3\xa4}", "\xc3\xa4 is not JSON", 7);
}

/* What JSON says of texts: all escapes, and characters of one to four bytes, by their bytes. */
TEST(texts_are_decoded_where_they_are) {
  static const char text[] = "{\"\\u0061\\n\": [\"\", \"\\\"\\\\\\/\\b\\f\\r\\t\", "
                             "\"\\u00E9\\u20ac\\uD83D\\ude00\xc3\xa4\"], \"b\": -0.5e1 }";
  char *opened = NULL;
  const char *at;
  double number = 0;
  check_ok(hk_json_open(text, (int64_t)strlen(text), &opened, &at));
  const char *array = hk_json_get(opened, "a\n"), *item = hk_json_first(array);
  assert_int_equal(hk_json_count(array), 3);
  assert_string_equal(hk_json_text(item), "");
  item = hk_json_next(item);
  assert_string_equal(hk_json_text(item), "\"\\/\b\f\r\t");
  item = hk_json_next(item);
  assert_string_equal(hk_json_text(item), "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80\xc3\xa4");
  assert_null(hk_json_next(item));
  check_ok(hk_json_number(hk_json_get(opened, "b"), &number));
  check_close(number, -5.0, 0);
  assert_ptr_equal(hk_json_get(opened, "b") - opened, strstr(text, "-0.5") - text);
  assert_null(hk_json_get(opened, "c"));
  hk_free(opened);
  check_tokens("{'a': '\\x'}", "\\x", 8);
  check_tokens("{'a': '\\u12G4'}", "\\u12G4", 8);
  check_tokens("{'a': '\\ud83d'}", "\\ud83d", 8);
  check_tokens("{'a': '\\ud83d\\u0041'}", "\\ud83d", 8);
  check_tokens("{'a': '\\ude00'}", "\\ude00", 8);
  check_tokens("{'a': 'b\nc'}", "control character 0x0a in a text; allowed: \\u000a", 9);
  check_tokens("{'a': 'b\\u0000'}", "\\u0000 is not JSON here; allowed: an escape", 9);
}

/* Integers have a single 0; all other numbers are those of strtod(). */
TEST(numbers_are_read_to_the_bit) {
  static const char *const words[] = {"-0",
                                      "-0.0",
                                      "9223372036854775807",
                                      "0.1",
                                      "2.2250738585072011e-308",
                                      "1E+2",
                                      "123456789012345678901234567890.5"};
  const double wanted[] = {0.0,
                           -0.0,
                           9223372036854775807.0,
                           0.1,
                           2.2250738585072011e-308,
                           100.0,
                           123456789012345678901234567890.5};
  for (size_t k = 0; k < sizeof words / sizeof words[0]; k++) {
    char text[64], *opened = NULL;
    const char *at;
    double number = NAN;
    snprintf(text, sizeof text, "{\"a\":[%s]}", words[k]);
    check_ok(hk_json_open(text, (int64_t)strlen(text), &opened, &at));
    check_ok(hk_json_number(hk_json_first(hk_json_get(opened, "a")), &number));
    check_same_bits(1, &number, &wanted[k]);
    hk_free(opened);
  }
}

TEST(what_is_not_utf8_is_refused) {
  static const struct {
    const char *bytes;
    int64_t length, at; /* at -1: valid */
  } cases[] = {
      {"{\"\xc3\xa4\xe2\x82\xac\xf0\x9f\x98\x80\": 1}", 16, -1},
      {"{\n \"\xff\": 1}", 9, 4},
      {"{\"a\xc3\x28\"}", 7, 3},        /* truncated */
      {"{\"\xc0\xaf\"}", 6, 2},         /* overlong */
      {"{\"\xed\xa0\x80\"}", 7, 2},     /* a surrogate */
      {"{\"\xf4\x90\x80\x80\"}", 8, 2}, /* beyond Unicode */
      {"{\"a\xe2\x82", 5, 3},           /* ends within a character */
      {"\xef\xbb\xbf{}", 5, 0},         /* byte order mark */
      {"{\"a\": \0}", 8, 6},
      {"{\"a\0\": 1}", 9, 3},
      {" [1]", 4, 1},
      {" \n ", 3, 3},
      {"", 0, 0},
      {"{\"a\": tru", 9, 9}, /* may go on */
  };
  for (size_t k = 0; k < sizeof cases / sizeof cases[0]; k++) {
    char *opened = NULL;
    const char *at = cases[k].bytes;
    check_status(hk_json_open(cases[k].bytes, cases[k].length, &opened, &at),
                 cases[k].at >= 0 ? HOOKE_BAD_VALUE : HOOKE_OK);
    if (cases[k].at >= 0 && at != cases[k].bytes + cases[k].at)
      check_failed("case %zu: at %lld", k, (long long)(at - cases[k].bytes));
    hk_free(opened);
  }
}

TEST(brackets_are_counted_outside_of_texts) {
  char deep[64] = "{\"a\":\"[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[[\\\"[[[\"}", *opened = NULL;
  const char *at;
  check_ok(hk_json_open(deep, (int64_t)strlen(deep), &opened, &at));
  hk_free(opened);
  memset(deep + 5, '[', 32);
  check_status(hk_json_open(deep, (int64_t)strlen(deep), &opened, &at), HOOKE_BAD_VALUE);
  check_message("nested 33 levels deep; allowed: up to 32");
  assert_int_equal(at - deep, 36);
}

/* They are never valid, and a text that goes on with many of them must not be read to its end. */
TEST(empty_brackets_in_arrays_are_refused) {
  check_tokens("{'a': [], 'b': {}}", NULL, 0);
  check_tokens("{'a': [{'b': [ ]}, [1], '[', [']']]}", NULL, 0);
  check_tokens("{'a': [[ \n]]}", "nothing between", 11);
  check_tokens("{'a': [{}]}", "nothing between", 9);
  check_tokens("{'a': [1, [2, []", "nothing between", 16);
}

/* Cut anywhere, a valid text may still go on; with a fault well before its end no text is valid. */
TEST(hopeless_texts_are_known_by_their_beginning) {
  static const char text[] = "{\"hooke\": 1, \"\xe2\x82\xac\\ud83d\\ude00\": [-1.25e-3, true, "
                             "12345678901234567890123456789.5], \"b\": {\"c\": null}} ";
  char cut[sizeof text] = "";
  for (int64_t k = 1; k < (int64_t)sizeof text; k++) {
    memcpy(cut, text, (size_t)k);
    cut[k] = '\0';
    if (hk_json_is_hopeless(cut, k)) check_failed("cut at %lld: %s", (long long)k, hooke_last_error());
  }
  cut[8] = ' ';
  assert_int_equal(hk_json_is_hopeless(cut, (int64_t)strlen(cut)), 1);
}

static void touch(const char *folder, const char *name) {
  char path[512];
  snprintf(path, sizeof path, "%s/%s", folder, name);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fclose(file);
}

static void check_file(const char *folder, const char *file, const char *message) {
  char *path = NULL;
  check_status(hk_scene_find_file(folder, file, 0, &path), message ? HOOKE_BAD_VALUE : HOOKE_OK);
  if (message) {
    check_message(message);
    assert_null(path);
  } else {
    assert_non_null(path);
  }
  hk_free(path);
}

TEST(files_stay_in_the_folder_of_the_scene) {
  char outer[] = "hooke_scene_XXXXXX", folder[64], link[96];
  assert_non_null(mkdtemp(outer));
  snprintf(folder, sizeof folder, "%s/scene", outer);
  snprintf(link, sizeof link, "%s/link.h5", folder);
  assert_int_equal(mkdir(folder, 0700), 0);
  touch(outer, "secret.h5");
  touch(folder, "state.h5");
  touch(folder, "..odd.h5");
  assert_int_equal(symlink("../secret.h5", link), 0);
  check_file(folder, "state.h5", NULL);
  check_file(folder, "./state.h5", NULL);
  check_file(folder, "..odd.h5", NULL);
  check_file(folder, "../secret.h5", "allowed: a path inside the scene's folder");
  check_file(folder, "x/../state.h5", "allowed: a path inside the scene's folder");
  check_file(folder, "..", "allowed: a path inside the scene's folder");
  check_file(folder, "/etc/passwd", "allowed: a path inside the scene's folder");
  check_file(folder, "", "allowed: a path inside the scene's folder");
  check_file(folder, "link.h5", "\"link.h5\" leads out of the scene's folder");
  check_file(folder, "none.h5", "\"none.h5\" cannot be opened: No such file or directory");
  check_file(NULL, "state.h5", "this scene has no folder");
  const char *const names[] = {"scene/state.h5", "scene/..odd.h5", "scene/link.h5", "secret.h5"};
  for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", outer, names[k]);
    assert_int_equal(unlink(path), 0);
  }
  assert_int_equal(rmdir(folder), 0);
  assert_int_equal(rmdir(outer), 0);
}

/* ---- valid scenes ---- */

static hooke_scene *parse(const char *quoted) {
  char *text = json(quoted);
  hooke_scene *scene = NULL;
  check_ok(hooke_scene_parse(text, (int64_t)strlen(text), "test.json", NULL, NULL, &scene));
  assert_string_equal(hooke_scene_text(scene, "text"), text);
  hk_free(text);
  return scene;
}

TEST(a_whole_scene_becomes_a_system) {
  static const char text[] =
      "{'hooke': 1, 'title': 'net', 'gravity': [0, -9.81, 0], 'drag': 0.25,"
      " 'particles': {'position': [[0,0,0],[1,0,0.5],[2,0.25,0]], 'velocity': [[0,0,0],[1,2,3],[4,5,6]],"
      "               'mass': [1,2,4], 'pinned': [0]},"
      " 'springs': [{'name': 'a', 'between': [[0,1],[1,2]], 'stiffness': [100, 50], 'damping': 0.5,"
      "              'rest_length': 2, 'rest_scale': 0.5},"
      "             {'between': [[2,0]], 'law': 'length', 'stiffness': 7, 'rest_length': 0, 'compression': "
      "false}],"
      " 'run': {'method': 'forward-euler', 'step': 1e-3, 'every': 0.5}}";
  owned_scene *scene = parse(text);
  hooke_system *system = hooke_scene_system(scene);
  assert_string_equal(hooke_scene_text(scene, "title"), "net");
  assert_int_equal(hooke_system_is_committed(system), 0);
  check_ok(hooke_scene_commit(scene));
  assert_int_equal(hooke_system_particle_count(system), 3);
  assert_int_equal(hooke_system_count(system, "free"), 2);
  assert_int_equal(hooke_system_group_count(system, "springs"), 2);
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "a");
  assert_string_equal(hooke_system_group_name(system, "springs", 1), "");
  assert_int_equal(hooke_system_count(system, "forces"), 3);
  const double inverse[] = {0, 0.5, 0.25};
  check_same_bits(3, hooke_system_inverse_mass(system), inverse);

  int64_t ends[6];
  const int64_t wanted_ends[] = {0, 1, 1, 2, 2, 0};
  double kappa[3], gamma[3], length[3];
  const double wanted_kappa[] = {100, 50, 7}, wanted_gamma[] = {0.5, 0.5, 0}, wanted_length[] = {1, 1, 0};
  check_ok(hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  check_ok(hooke_system_members(system, "springs", NULL, kappa, gamma, length));
  assert_memory_equal(ends, wanted_ends, sizeof ends);
  check_same_bits(3, kappa, wanted_kappa);
  check_same_bits(3, gamma, wanted_gamma);
  check_same_bits(3, length, wanted_length);

  const double position[] = {0, 0, 0, 1, 0, 0.5, 2, 0.25, 0}, velocity[] = {0, 0, 0, 1, 2, 3, 4, 5, 6};
  owned_state *initial = start_state(system);
  check_same_bits(9, hooke_state_position(initial), position);
  check_same_bits(9, hooke_state_velocity(initial), velocity);

  hooke_options *run = hooke_scene_run_options(scene);
  assert_string_equal(hooke_options_text(run, "method"), "forward-euler");
  check_close(hooke_options_number(run, "step"), 1e-3, 0);
  assert_int_equal(hooke_options_is_set(run, "every"), 1);
  assert_int_equal(hooke_options_is_set(run, "duration"), 0);
  assert_int_equal(hooke_options_is_set(run, "rtol"), 0);
}

TEST(what_is_not_named_is_not_computed) {
  owned_scene *scene = parse("{'hooke': 1, " TWO "}");
  check_ok(hooke_scene_commit(scene));
  hooke_system *system = hooke_scene_system(scene);
  assert_int_equal(hooke_system_count(system, "forces"), 0);
  assert_int_equal(hooke_system_count(system, "springs"), 0);
  assert_int_equal(hooke_system_count(system, "free"), 2);
  assert_string_equal(hooke_scene_text(scene, "title"), "");
  assert_int_equal(hooke_options_is_set(hooke_scene_run_options(scene), "method"), 0);
  owned_state *initial = start_state(system);
  for (int k = 0; k < 6; k++)
    check_close(hooke_state_velocity(initial)[k], 0, 0);
}

/* Explicit particles come first, then those of parts in order; explicit springs first, then those of parts.
 */
TEST(parts_follow_what_is_listed) {
  owned_scene *scene = parse(
      "{'hooke': 1, " TWO ","
      " 'springs': [{'name': 'tie', 'between': [[1, ['line', 0]], [['line', 2], ['cloth1', 3]], [0, 5]], "
      "'stiffness': 1}],"
      " 'parts': [{'kind': 'rope', 'name': 'line', 'from': [2,0,0], 'to': [4,0,0], 'segments': 2, 'mass': 3,"
      "            'pinned': ['end', 0], 'stretch': {'stiffness': 10}, 'bend': {'stiffness': 5, "
      "'rest_scale': 0.5}},"
      "           {'kind': 'cloth', 'origin': [0,1,0], 'edges': [[1,0,0],[0,0,1]], 'size': [2,2], 'mass': 1,"
      "            'structural': {'stiffness': 20, 'compression': false}}]}");
  check_ok(hooke_scene_commit(scene));
  hooke_system *system = hooke_scene_system(scene);
  assert_int_equal(hooke_system_particle_count(system), 9);
  assert_int_equal(hooke_system_count(system, "free"), 7);
  assert_int_equal(hooke_system_group_count(system, "springs"), 4);
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "tie");
  assert_string_equal(hooke_system_group_name(system, "springs", 1), "line.stretch");
  assert_string_equal(hooke_system_group_name(system, "springs", 2), "line.bend");
  assert_string_equal(hooke_system_group_name(system, "springs", 3), "cloth1.structural");
  int64_t ends[20];
  const int64_t wanted[] = {1, 2, 4, 8, 0, 5, 2, 3, 3, 4, 2, 4, 5, 6, 7, 8, 5, 7, 6, 8};
  assert_int_equal(hooke_system_count(system, "springs"), 10);
  check_ok(hooke_system_members(system, "springs", ends, NULL, NULL, NULL));
  assert_memory_equal(ends, wanted, sizeof ends);
  double length[10];
  check_ok(hooke_system_members(system, "springs", NULL, NULL, NULL, length));
  check_close(length[5], 1.0, 1e-15);
  assert_true(hooke_system_inverse_mass(system)[2] == 0 && hooke_system_inverse_mass(system)[4] == 0);
  check_close(hooke_system_mass(system)[3], 1, 1e-15);
}

TEST(driven_particles_move) {
  owned_scene *scene =
      parse("{'hooke': 1, " TWO
            ", 'parts': [{'kind': 'rope', 'from': [0,1,0], 'to': [1,1,0], 'segments': 1, 'mass': 1}],"
            " 'driven': [{'particles': [1], 'motion': 'harmonic', 'amplitude': [0,2,0], 'frequency': 0.25,"
            "             'phase': 1.5707963267948966},"
            "            {'particles': [['rope0', 1]], 'motion': 'table', 'time': [0, 1, 2],"
            "             'position': [[0,0,0],[0,0,1],[0,0,2]]}]}");
  check_ok(hooke_scene_commit(scene));
  hooke_system *system = hooke_scene_system(scene);
  assert_int_equal(hooke_system_count(system, "free"), 2);
  owned_state *initial = start_state(system);
  check_close(hooke_state_position(initial)[4], 2, 1e-15);
  check_close(hooke_state_position(initial)[3], 1, 0);
}

/* ---- what a scene lists, added by its key ---- */

static void check_refused(hooke_system *system, const char *key, const char *table, int64_t count,
                          const char *message) {
  const int64_t particles[3] = {0, 1, 0};
  owned_options *options = NULL;
  check_ok(hooke_options_create(table, &options));
  check_status(hooke_system_add_members(system, key, NULL, count, particles, options), HOOKE_BAD_VALUE);
  check_message(message);
}

TEST(members_are_added_by_key) {
  const double place[6] = {0, 0, 0, 1, 0, 0};
  owned_system *system = NULL;
  owned_options *particles = NULL, *springs = NULL;
  check_ok(hooke_system_create(&system));
  check_ok(hooke_options_create("particles", &particles));
  check_ok(hooke_options_set_numbers(particles, "position", 6, place));
  check_status(hooke_system_add_members(system, "particles", NULL, 0, NULL, particles), HOOKE_BAD_VALUE);
  check_message("mass: is required but missing; allowed: one or more numbers > 0 [kg]");
  check_ok(hooke_options_set_number(particles, "mass", 2));
  check_ok(hooke_options_set_number(particles, "pinned", 2));
  check_status(hooke_system_add_members(system, "particles", NULL, 0, NULL, particles), HOOKE_BAD_VALUE);
  check_message("pinned[0]: there is no particle 2; allowed: 0 to 1");
  assert_int_equal(hooke_system_particle_count(system), 0);
  check_ok(hooke_options_set_number(particles, "pinned", 1));
  check_ok(hooke_system_add_members(system, "particles", NULL, 0, NULL, particles));
  check_ok(hooke_options_create("springs", &springs));
  check_ok(hooke_options_set_number(springs, "stiffness", 3));
  check_ok(hooke_system_add_members(system, "springs", "s", 2, (int64_t[]){0, 1}, springs));
  assert_string_equal(hooke_system_group_name(system, "springs", 0), "s");
  assert_int_equal(hooke_system_count(system, "springs"), 1);
  check_refused(system, "sprigns", "springs", 2, "unknown key \"sprigns\"; did you mean \"springs\"?");
  check_refused(system, "springs", "bending", 2, "options: are those of a bending; make them with");
  check_refused(system, "springs", "springs", 2, "stiffness: is required but missing");
  check_refused(system, "driven", "driven", 1, "motion: is required but missing");
  check_refused(system, "bodies", "bodies", 0, "particles: 0 of them");
  check_status(hooke_system_add_members(system, "springs", NULL, 3, (int64_t[]){0, 1, 0}, springs),
               HOOKE_BAD_VALUE);
  check_message("count: 3 is not allowed for springs; allowed: an array of pairs of particles");
  check_status(hooke_system_add_members(system, "particles", NULL, 1, (int64_t[]){0}, particles),
               HOOKE_BAD_VALUE);
  check_message("count: 1 is not allowed for particles; allowed: 0");
}

/* ---- invalid scenes: exact messages ---- */

static void refuse(const char *quoted, const char *message) {
  char *text = json(quoted), *wanted = json(message);
  hooke_scene *scene = (hooke_scene *)1;
  check_status(hooke_scene_parse(text, (int64_t)strlen(text), "t.json", NULL, NULL, &scene), HOOKE_BAD_VALUE);
  assert_string_equal(hooke_last_error(), wanted);
  assert_null(scene);
  hk_free(text);
  hk_free(wanted);
}

/* Whole messages; their parts for every key are in tests/cli/bad_scenes.py. */
TEST(messages_give_file_line_column_and_path) {
  refuse("{\n 'hooke': 1,\n 'particles': {'position': [[0,0,0],[1,0,0]],\n   'mass': [1,\n    -2]}}",
         "t.json:5:5: particles.mass[1]: -2 is not allowed; allowed: one or more numbers > 0 [kg]");
  refuse("{'hooke': 1, " TWO ",\n 'springs': [{'between': [[0,1]],\n  'stifness': 1}]}",
         "t.json:3:3: springs[0].stifness: unknown key 'stifness'; did you mean 'stiffness'? allowed: name, "
         "between, law, "
         "stiffness, curve, damping, damping_ratio, rest_length, rest_scale, stiffness_scale, compression");
}

TEST(files_need_a_folder) {
  refuse("{'hooke': 1,\n'particles': {'mass': 1, 'position': {'file': 'a.h5', 'dataset': '/q'}}}",
         "t.json:2:47: particles.position.file: 'a.h5' is not allowed; this scene has no folder to take "
         "files from");
  refuse("{'hooke': 1,\n'particles': {'mass': 1, 'position': {'file': 'a.h5', 'frame': 0}}}",
         "t.json:2:38: particles.position.dataset: is required but missing; allowed: a text");
}

TEST(files_that_are_none_are_bad_input) {
  hooke_scene *scene = NULL;
  check_status(hooke_scene_load("no/such/scene.json", NULL, &scene), HOOKE_BAD_VALUE);
  check_message("no/such/scene.json: cannot be opened: No such file or directory");
  check_status(hooke_scene_load("/", NULL, &scene), HOOKE_BAD_VALUE);
  check_message("/: is a directory");
  check_status(hooke_scene_load("/dev/null", NULL, &scene), HOOKE_BAD_VALUE);
  check_message("/dev/null: is not a regular file");
  check_status(hooke_scene_load(NULL, NULL, &scene), HOOKE_BAD_VALUE);
  check_status(hooke_scene_parse("{}", -1, NULL, NULL, NULL, &scene), HOOKE_BAD_VALUE);
  check_status(hooke_scene_parse("", 0, NULL, NULL, NULL, &scene), HOOKE_BAD_VALUE);
  check_message("scene:1:1: is empty");
  assert_null(scene);
  hooke_scene_destroy(NULL);
}

/* A file is read in pieces: its end is read at any length. */
TEST(files_of_every_length_are_read_whole) {
  static const char before[] = "{\"hooke\": 1,",
                    after[] = "\"particles\": {\"mass\": 1, \"position\": [[0, 0, 7]]}}";
  static const int64_t lengths[] = {200, 65534, 65535, 65536, 65537, 131070, 131071, 131072, 500000};
  char folder[] = "hooke_scene_XXXXXX", path[64];
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/scene.json", folder);
  for (size_t k = 0; k < sizeof lengths / sizeof lengths[0]; k++) {
    const int gap = (int)(lengths[k] - (int64_t)(sizeof before + sizeof after - 2));
    owned_scene *scene = NULL;
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_int_equal(fprintf(file, "%s%*s%s", before, gap, "", after), lengths[k]);
    assert_int_equal(fclose(file), 0);
    check_ok(hooke_scene_load(path, NULL, &scene));
    assert_int_equal(strlen(hooke_scene_text(scene, "text")), lengths[k]);
    assert_string_equal(hooke_scene_text(scene, "text") + lengths[k] - (int64_t)sizeof after + 1, after);
    check_ok(hooke_scene_commit(scene));
    assert_int_equal(hooke_system_particle_count(hooke_scene_system(scene)), 1);
  }
  assert_int_equal(unlink(path), 0);
  assert_int_equal(rmdir(folder), 0);
}

TEST(outputs_are_checked_before_any_work) {
  char folder[] = "hooke_scene_XXXXXX", path[64], other[64], none[64];
  owned_scene *scene = NULL;
  assert_non_null(mkdtemp(folder));
  snprintf(path, sizeof path, "%s/scene.json", folder);
  snprintf(other, sizeof other, "%s/out.h5", folder);
  snprintf(none, sizeof none, "%s/none/out.h5", folder);
  FILE *file = fopen(path, "w");
  assert_non_null(file);
  fputs("{\"hooke\": 1, \"particles\": {\"mass\": 1, \"position\": [[0, 0, 7]]}}", file);
  assert_int_equal(fclose(file), 0);
  check_ok(hooke_scene_load(path, NULL, &scene));
  check_ok(hooke_scene_check_output(scene, other));
  assert_int_equal(access(other, F_OK), -1);
  check_status(hooke_scene_check_output(scene, path), HOOKE_BAD_VALUE);
  check_message("is read, too, and would be replaced");
  check_status(hooke_scene_check_output(scene, none), HOOKE_IO_FAILED);
  check_message("none/out.h5: could not create the file");
  check_status(hooke_scene_check_output(scene, folder), HOOKE_IO_FAILED);
  check_message("is not a regular file, and only such are replaced");
  assert_int_equal(unlink(path), 0);
  assert_int_equal(rmdir(folder), 0); /* nothing is left there */
}

/* Every truncation and every changed byte of a valid scene gives a scene or a message, never a crash. */
TEST(damaged_scenes_are_survived) {
  char *text =
      json("{'hooke':1,'particles':{'position':[[0,0,0],[1,0,0]],'mass':[1,2],'pinned':[0]},"
           "'springs':[{'between':[[0,1]],'stiffness':1e2,'rest_length':'initial'}],'run':{'step':1e-3}}");
  static const char replacements[] = "{}[]\",:0-e.\\ x\x80";
  int64_t length = (int64_t)strlen(text), refused = 0;
  for (int64_t k = 0; k < length; k++) {
    hooke_scene *scene = NULL;
    check_status(hooke_scene_parse(text, k, "cut", NULL, NULL, &scene), HOOKE_BAD_VALUE);
    char kept = text[k];
    for (const char *c = replacements; *c; c++) {
      text[k] = *c;
      int32_t status = hooke_scene_parse(text, length, "damaged", NULL, NULL, &scene);
      if (status) {
        assert_int_equal(status, HOOKE_BAD_VALUE);
        assert_int_equal(strncmp(hooke_last_error(), "damaged:1:", 10), 0);
        refused++;
      }
      hooke_scene_destroy(scene);
      scene = NULL;
    }
    text[k] = kept;
  }
  check_between((double)refused, 1000, 2900);
  hk_free(text);
}
