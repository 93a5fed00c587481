/* OBJ files: every form that is read, and every fault with its line. */
#include "check.h"
#include "small.h"

#include "io/scene/obj.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static int32_t parse(const char *text, struct hk_obj *obj, int64_t *line) {
  /* without a NUL at its end, so that a sanitizer detects reading too far */
  const size_t length = strlen(text);
  owned_text *copy = malloc(length ? length : 1);
  assert_non_null(copy);
  memcpy(copy, text, length);
  return hk_obj_parse(copy, (int64_t)length, obj, line);
}

static void check_faces(const char *text, int64_t count, const int64_t *triangle) {
  owned(hk_obj_release) struct hk_obj obj;
  int64_t line;
  check_ok(parse(text, &obj, &line));
  assert_int_equal(obj.triangle_count, count);
  for (int64_t k = 0; k < 3 * count; k++)
    assert_int_equal(obj.triangle[k], triangle[k]);
}

#define FOUR "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"

TEST(faces_come_in_many_forms) {
  const int64_t one[] = {0, 1, 2}, quad[] = {0, 1, 2, 0, 2, 3}, back[] = {3, 2, 1};
  check_faces(FOUR "f 1 2 3\n", 1, one);
  check_faces(FOUR "f 1 2 3", 1, one);
  check_faces(FOUR "f 1/4 2/5 3/6\n", 1, one);
  check_faces(FOUR "f 1//1 2//1 3//1\n", 1, one);
  check_faces(FOUR "f 1/1/1 2/2/1 3/3/1\n", 1, one);
  check_faces(FOUR "f 1/-1/-1 2/-2/-1 3/-3/-1\n", 1, one);
  check_faces(FOUR "f -1 -2 -3\n", 1, back);
  check_faces(FOUR "  f\t1  2\t\t3   \n", 1, one);
  check_faces(FOUR "f 1 2 3 4\n", 2, quad);
  check_faces(FOUR "f 1 2 3 # a comment\n", 1, one);
  check_faces(FOUR "f 1 2 \\\n3\n", 1, one);
  check_faces(FOUR "f 1 \\\r\n2 3\r\n", 1, one);
}

TEST(five_corners_make_three_triangles) {
  const int64_t fan[] = {4, 0, 1, 4, 1, 2, 4, 2, 3};
  check_faces(FOUR "v -1 0.5 0\nf 5 1 2 3 4\n", 3, fan);
}

/* Lines are counted in the same way for all line ends. */
TEST(lines_end_in_three_ways) {
  static const char *const ends[] = {"\n", "\r\n", "\r"};
  for (int k = 0; k < 3; k++) {
    char text[512];
    owned(hk_obj_release) struct hk_obj obj;
    int64_t line;
    snprintf(text, sizeof text,
             "# made \\%smtllib a.mtl%so thing%s%sv 1.5 -2 3e-1%svt 0 0%svn 0 0 1%sv +1 .5 1. 1%s"
             "v 0 1 0 0.1 0.2 0.3%susemtl a%ss off%sg b%sf 3 2 1%s",
             ends[k], ends[k], ends[k], ends[k], ends[k], ends[k], ends[k], ends[k], ends[k], ends[k],
             ends[k], ends[k], ends[k]);
    check_ok(parse(text, &obj, &line));
    assert_int_equal(obj.vertex_count, 3);
    assert_int_equal(obj.triangle_count, 1);
    check_same_bits(9, obj.vertex, ((double[]){1.5, -2, 0.3, 1, 0.5, 1, 0, 1, 0}));
    assert_int_equal(obj.vertex_line[0], 5);
    assert_int_equal(obj.vertex_line[2], 9);
    assert_int_equal(obj.triangle_line[0], 13);
  }
}

/* More than the first blocks hold. */
TEST(lists_grow) {
  enum { COUNT = 5000 };
  char *text = malloc(64 * COUNT), *at = text;
  owned(hk_obj_release) struct hk_obj obj;
  int64_t line;
  assert_non_null(text);
  for (int k = 0; k < COUNT; k++)
    at += sprintf(at, "v %d 0.%04d %d\n", k, k, -k);
  for (int k = 2; k < COUNT; k++)
    at += sprintf(at, "f %d %d %d\n", k - 1, k, k + 1);
  check_ok(parse(text, &obj, &line));
  assert_int_equal(obj.vertex_count, COUNT);
  assert_int_equal(obj.triangle_count, COUNT - 2);
  check_same_bits(3, obj.vertex + 3 * 4321, ((double[]){4321, 0.4321, -4321}));
  assert_int_equal(obj.triangle[3 * 4000 + 2], 4002);
  assert_int_equal(obj.triangle_line[4000], COUNT + 4001);
  free(text);
}

TEST(faults_have_their_line) {
  static const struct {
    const char *text;
    int64_t line;
    const char *message;
  } faults[] = {
      {"", 1, "0 vertices and no face"},
      {FOUR, 5, "4 vertices and no face; allowed: faces"},
      {FOUR "f 1 2 5\n", 5, "there is no vertex 5 yet; allowed: 1 to 4"},
      {FOUR "f 1 2 -5\n", 5, "there is no vertex -5 yet; allowed: 1 to 4, or -1 to -4"},
      {FOUR "f 1 2 0\n", 5, "there is no vertex 0"},
      {FOUR "f 1 2 99999999999999999999999\n", 5, "there is no vertex"},
      {"f 1 2 3\n", 1, "\"1\" is not allowed; there is no vertex before this line"},
      {FOUR "\nf 1 2\n", 6, "a face of 2 corners; allowed: three or more"},
      {FOUR "f\n", 5, "a face of 0 corners"},
      {FOUR "f 1 2 3x\n", 5, "\"3x\" is not allowed; allowed: v, v/vt, v//vn or v/vt/vn"},
      {FOUR "f 1 2 1.5\n", 5, "\"1.5\""},
      {FOUR "f 1 2 3/1/1/1\n", 5, "\"3/1/1/1\""},
      {FOUR "f 1 2 -\n", 5, "\"-\""},
      {FOUR "f 1 2 /1\n", 5, "\"/1\""},
      {FOUR "f 1 2 \\\n \\\n3 x\n", 5, "\"x\""},
      {"v 0 0\n", 1, "a vertex of 2 numbers; allowed: x y z"},
      {"v 0 0 1 2 3 4 5 6\n", 1, "\"6\" is not allowed; allowed: x y z"},
      {"v 0 0 nan\n", 1, "\"nan\" is not allowed; allowed: a finite decimal number"},
      {"v 0 0 inf\n", 1, "\"inf\""},
      {"v 0 0 1e999\n", 1, "\"1e999\""},
      {"v 0 0 0x10\n", 1, "\"0x10\""},
      {"v 0 0 1,5\n", 1, "\"1,5\""},
      {FOUR "l 1 2\n", 5, "\"l\" is not allowed; allowed: v and f"},
      {FOUR "p 1\n", 5, "\"p\""},
      {FOUR "curv 0 1 1 2\n", 5, "\"curv\""},
      {"solid ascii\n", 1, "\"solid\""},
      {"\x89HDF\r\n", 1, "is not allowed; allowed: v and f"},
  };
  for (size_t k = 0; k < sizeof faults / sizeof faults[0]; k++) {
    owned(hk_obj_release) struct hk_obj obj;
    int64_t line = -1;
    check_status(parse(faults[k].text, &obj, &line), HOOKE_BAD_VALUE);
    check_message(faults[k].message);
    if (line != faults[k].line)
      check_failed("fault %zu is in line %lld, not %lld: %s", k, (long long)line, (long long)faults[k].line,
                   hooke_last_error());
  }
}

/* ---- files ---- */

static int32_t read_file(const char *text, double weld, hooke_options **options) {
  char path[] = "/tmp/hooke-mesh-XXXXXX";
  const int descriptor = mkstemp(path);
  assert_true(descriptor >= 0);
  assert_int_equal(write(descriptor, text, strlen(text)), (ssize_t)strlen(text));
  close(descriptor);
  check_ok(hooke_options_create("mesh", options));
  check_ok(hooke_options_set_number(*options, "weld", weld));
  const int32_t status = hooke_mesh_read(path, *options);
  unlink(path);
  return status;
}

TEST(a_file_is_its_numbers) {
  owned_options *options = NULL;
  check_ok(read_file(FOUR "f 1 2 3 4\n", 0.0, &options));
  assert_int_equal(hooke_options_number_count(options, "vertices"), 12);
  check_same_bits(6, hooke_options_numbers(options, "triangles"), ((double[]){0, 1, 2, 0, 2, 3}));
  assert_false(hooke_options_is_set(options, "file"));
  check_status(hooke_mesh_read("other.obj", options), HOOKE_BAD_VALUE);
  check_message("a file, or vertices and triangles");
}

TEST(faults_of_the_surface_have_their_line) {
  static const struct {
    const char *text;
    const char *message;
    double weld;
  } faults[] = {
      {FOUR "f 1 2 3\n", ":4: vertex 4 is in no face", 0},
      {FOUR "f 1 2 3\nf 1 3 1\n", ":6: vertex 1 is two of its corners", 0},
      {FOUR "f 1 2 3\nv 0 0 0\n\nf 1 3 5 4\n", ":8: its corners 5 and 1 become one particle", 0},
      {FOUR "v 0.5 0 0\nf 1 2 3\nf 3 4 1\nf 1 5 2\n", ":8: the triangle of vertices 1, 5 and 2 has no area",
       0},
      {FOUR "v 0 0 1\nf 1 2 3\nf 1 3 4\nf 1 3 5\n",
       ":8: the edge of vertices 1 and 3 has a third face here, after those of line 6 and line 7", 0},
      {FOUR "f 1 2 3\nf 1 3 4\n\nf 3 1 2\n", ":8: a second face on vertices 1, 2 and 3, after that of line 5",
       0},
      {FOUR "f 1 2 3 4\n", "its corners", 1.0},
  };
  for (size_t k = 0; k < sizeof faults / sizeof faults[0]; k++) {
    owned_options *options = NULL;
    check_status(read_file(faults[k].text, faults[k].weld, &options), HOOKE_BAD_VALUE);
    check_message(faults[k].message);
    check_message("/tmp/hooke-mesh-");
    assert_false(hooke_options_is_set(options, "vertices"));
  }
}

TEST(a_file_has_to_be_there) {
  owned_options *options = new_options("mesh");
  check_status(hooke_mesh_read("/tmp/hooke-no-such.obj", options), HOOKE_BAD_VALUE);
  check_message("/tmp/hooke-no-such.obj: cannot be opened: No such file");
  check_status(hooke_mesh_read("/tmp", options), HOOKE_BAD_VALUE);
  check_message("directory");
  check_status(hooke_mesh_read(NULL, options), HOOKE_BAD_VALUE);
}
