/* Pages of trajectories and companions for ParaView: selection, packing, refusals. */
#include "check.h"
#include "io/page/view/view.h"
#include "run.h"
#include "small.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

static void check_text(const char *bytes, const char *expected) {
  owned(hk_text_release) struct hk_text text = {.bytes = NULL};
  const int64_t count = (int64_t)strlen(bytes);
  hk_base64_add(&text, (const uint8_t *)bytes, count);
  assert_int_equal(text.length, hk_base64_length(count));
  assert_int_equal(text.length, strlen(expected));
  if (text.length > 0) assert_memory_equal(text.bytes, expected, (size_t)text.length);
}

/* The examples of RFC 4648, and bytes from the end of the alphabet. */
TEST(bytes_as_text) {
  check_text("", "");
  check_text("f", "Zg==");
  check_text("fo", "Zm8=");
  check_text("foo", "Zm9v");
  check_text("foob", "Zm9vYg==");
  check_text("fooba", "Zm9vYmE=");
  check_text("foobar", "Zm9vYmFy");
  check_text("\xff\xfe\xfb\xf0", "//778A==");
}

/* Longer than one chunk of the text. */
TEST(long_text) {
  enum { LONG = 10000 };
  uint8_t *bytes = new_block(LONG, 1);
  owned(hk_text_release) struct hk_text text = {.bytes = NULL};
  memset(bytes, 0xaa, LONG);
  hk_base64_add(&text, bytes, LONG);
  assert_int_equal(text.length, hk_base64_length(LONG));
  for (int64_t k = 0; k + 4 < text.length; k++)
    assert_int_equal(text.bytes[k], 'q'); /* 101010 */
  assert_memory_equal(text.bytes + text.length - 4, "qg==", 4);
  free(bytes);
}

#if HOOKE_HAVE_HDF5 && HOOKE_HAVE_THREEJS && HOOKE_HAVE_CHARTJS

enum { PATH_SIZE = 256, PARTICLES = 4 };

struct fixture {
  char folder[PATH_SIZE / 2], path[PATH_SIZE], page[PATH_SIZE], companion[PATH_SIZE];
};

/* Springs of rest lengths 2, 0 and 1, the last shorter than that; `far` is the position of the last particle.
 */
static void write_file(const struct fixture *f, double far, double duration) {
  const double q[] = {0, 0, 0, 3, 0, 0, 3, 0.5, 0, 0, 0, far};
  owned_system *system = small_system(PARTICLES, q, NULL, 1.0, 1);
  small_springs(system, 1, (int64_t[]){0, 1}, (struct springs){.stiffness = 1e-6, .rest_length = 2});
  small_springs(system, 1, (int64_t[]){1, 2}, (struct springs){.law = "length", .stiffness = 1e-6});
  small_springs(system, 1, (int64_t[]){2, 1}, (struct springs){.stiffness = 1e-6, .rest_length = 1});
  check_ok(hooke_system_commit(system));
  owned_run(integrator, state, system, .method = "symplectic-euler", .step = 1e-3, .duration = duration,
            .every = 1e-3);
  hooke_trajectory *trajectory;
  check_ok(hooke_trajectory_create(f->path, system, integrator, NULL, &trajectory));
  for (int64_t k = 0; k < hooke_integrator_count(integrator, "frames"); k++) {
    hooke_state_set_time(state, 1e-3 * (double)k);
    check_ok(hooke_trajectory_write(trajectory, k, state));
  }
  check_ok(hooke_trajectory_close(trajectory, HOOKE_OK));
}

static int set_up(void **state) {
  struct fixture *f = new_block(1, sizeof *f);
  snprintf(f->folder, sizeof f->folder, "%s/hooke-view-XXXXXX", P_tmpdir);
  assert_non_null(mkdtemp(f->folder));
  snprintf(f->path, sizeof f->path, "%s/out.h5", f->folder);
  snprintf(f->page, sizeof f->page, "%s/out.html", f->folder);
  snprintf(f->companion, sizeof f->companion, "%s/out.xdmf", f->folder);
  *state = f;
  return 0;
}

static int tear_down(void **state) {
  struct fixture *f = *state;
  unlink(f->path);
  unlink(f->page);
  unlink(f->companion);
  const int result = rmdir(f->folder);
  free(f);
  return result;
}

static hooke_measurement *open_view(const struct fixture *f, double frames, hooke_record **record) {
  hooke_measurement *view;
  check_ok(hooke_record_open(f->path, record));
  owned_options *options = new_options("view");
  if (frames > 0) check_ok(hooke_options_set_number(options, "frames", frames));
  check_ok(hooke_view_create(*record, options, &view));
  return view;
}

static void close_view(hooke_measurement *view, hooke_record *record) {
  hooke_measurement_destroy(view);
  hooke_record_close(record);
}

static double coordinate(const uint8_t *bytes, const struct hk_view_box *box, int k) {
  const double share = (bytes[2 * k] + 256.0 * bytes[2 * k + 1]) / 65535.0;
  return (1.0 - share) * box->low[k % 3] + share * box->high[k % 3];
}

/* Coordinates to a 131070th of the extent; elongations 1, 0.5 and -0.5 as halves of floats. */
TEST(a_frame_is_packed) {
  const struct fixture *f = *prepared;
  const double far[] = {7.0, -1e-300, 1e308};
  for (int k = 0; k < 3; k++) {
    hooke_record *record;
    uint8_t bytes[6 * PARTICLES + 6];
    write_file(f, far[k], 1e-3);
    hooke_measurement *view = open_view(f, 0, &record);
    assert_int_equal(hk_view_frame_bytes(view->object), sizeof bytes);
    check_ok(hk_view_pack(view->object, 0, bytes));
    const struct hk_view_box box = ((const struct hk_view *)view->object)->box[0];
    const double q[] = {0, 0, 0, 3, 0, 0, 3, 0.5, 0, 0, 0, far[k]};
    for (int i = 0; i < 3 * PARTICLES; i++)
      check_close(coordinate(bytes, &box, i), q[i],
                  (box.high[i % 3] - box.low[i % 3]) / 131070.0 * (1 + 1e-9));
    assert_memory_equal(bytes + 6 * PARTICLES, "\x80\x3f\x00\x3f\x00\xbf", 6);
    check_close(hooke_measurement_number(view, "view", 0, "strain"), 0.5, 1e-15);
    close_view(view, record);
  }
}

TEST(numbers_as_floats) {
  assert_int_equal(hk_view_float(1.0), 0x3f800000);
  assert_int_equal(hk_view_float(1e308), 0x7f800000);
  assert_int_equal(hk_view_float(-1e308), 0xff800000);
  check_between(hk_view_float(NAN) & 0x7fffffff, 0x7f800001, 0x7fffffff);
}

TEST(frames_are_thinned) {
  const struct fixture *f = *prepared;
  write_file(f, 1.0, 0.1);
  const int most[] = {2, 3, 7, 34, 51, 100, 101, 1000};
  for (int k = 0; k < (int)(sizeof most / sizeof most[0]); k++) {
    hooke_record *record;
    hooke_measurement *view = open_view(f, most[k], &record);
    const struct hk_view *shown = view->object;
    const int64_t count = (int64_t)hooke_measurement_number(view, "view", 0, "frames");
    check_between((double)count, 2, most[k]);
    assert_int_equal(shown->frame[0], 0);
    assert_int_equal(shown->frame[count - 1], 100);
    assert_true(shown->frame[count - 2] < 100);
    if (most[k] > 100) assert_int_equal(count, 101);
    if (most[k] == 51) assert_int_equal(count, 51);
    close_view(view, record);
  }
}

TEST(views_are_refused_in_words) {
  const struct fixture *f = *prepared;
  hooke_record *record;
  hooke_options *options;
  hooke_measurement *view;
  write_file(f, 1.0, 0.01);
  check_ok(hooke_record_open(f->path, &record));
  check_ok(hooke_options_create("run", &options));
  check_status(hooke_view_create(record, options, &view), HOOKE_BAD_VALUE);
  assert_null(view);
  hooke_options_destroy(options);
  check_ok(hooke_options_create("view", &options));
  check_status(hooke_options_set_number(options, "frames", 1), HOOKE_BAD_VALUE);
  check_ok(hooke_options_set_number(options, "size", 0.5));
  check_status(hooke_view_create(record, options, &view), HOOKE_BAD_VALUE);
  check_message("size: 0.5 MB are too few");
  hooke_options_destroy(options);
  check_ok(hooke_view_create(record, NULL, &view));
  assert_true(isnan(hooke_measurement_number(view, "view", 0, "bytes")));
  assert_true(isnan(hooke_measurement_number(view, "view", 0, "colour")));
  check_ok(hooke_measurement_run(view, NULL));
  check_status(hooke_measurement_write(view, "/nowhere/page"), HOOKE_IO_FAILED);
  check_ok(hooke_measurement_label(view, "title", "one </script> \"two\""));
  check_ok(hooke_measurement_write(view, f->page));
  check_between(hooke_measurement_number(view, "view", 0, "bytes"), 1e6, 2e6);
  close_view(view, record);
  hooke_measurement_destroy(NULL);
}

/* Beside the trajectory it replaces an older companion, and nothing else. */
TEST(a_companion_is_written) {
  const struct fixture *f = *prepared;
  owned_record *record = NULL;
  write_file(f, 1.0, 0.01);
  check_ok(hooke_record_open(f->path, &record));
  FILE *file = fopen(f->companion, "w");
  assert_non_null(file);
  fputs("my notes", file);
  fclose(file);
  check_status(hooke_record_write_xdmf(record, NULL), HOOKE_BAD_VALUE);
  check_message("is no XDMF");
  check_ok(hooke_record_write_xdmf(record, f->companion));
  check_ok(hooke_record_write_xdmf(record, NULL));
  check_status(hooke_record_write_xdmf(record, "/nowhere/out.xdmf"), HOOKE_IO_FAILED);
}

TEST(names_that_paraview_cannot_take) {
  const struct fixture *f = *prepared;
  static const char *const names[] = {"a:b", "\xc3\xa9t\xc3\xa9", " a", "tab\t"};
  write_file(f, 1.0, 0.01);
  for (int k = 0; k < 4; k++) {
    char path[PATH_SIZE];
    owned_record *record = NULL;
    snprintf(path, sizeof path, "%s/%s.h5", f->folder, names[k]);
    assert_int_equal(rename(f->path, path), 0);
    check_ok(hooke_record_open(path, &record));
    check_status(hooke_record_write_xdmf(record, NULL), HOOKE_BAD_VALUE);
    check_message("ASCII without colons");
    assert_int_equal(rename(path, f->path), 0);
  }
}

AROUND_EACH(set_up, tear_down)

#else

TEST(views_are_not_in_this_build) {
  hooke_measurement *view;
  check_status(hooke_view_create(NULL, NULL, &view), HOOKE_BAD_CALL);
#if !HOOKE_HAVE_HDF5
  check_status(hooke_record_write_xdmf(NULL, "out.xdmf"), HOOKE_BAD_CALL);
#endif
}

#endif
