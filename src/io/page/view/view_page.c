/* Trajectories as pages: the page, and several as one. */
#include "io/page/view/view.h"

#include "core/memory.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "io/file/atomic_file.h"
#include "io/file/inputs.h"
#include "io/page/form.h"
#include "io/trajectory/record.h"
#include "io/page/report.h"
#include "model/particles.h"

#include <math.h>
#include <string.h>

/* ---- words ---- */

/* Title and upward direction of the scene; none if the scene can no longer be read. */
static void add_scene(struct hk_text *data, const struct hk_view *view, char *const *label) {
  hooke_scene *scene = NULL;
  const char *path = hk_record_path(view->record), *title = label[HOOKE_LABEL_TITLE];
  const char *name = label[HOOKE_LABEL_SCENE] ? label[HOOKE_LABEL_SCENE] : path,
             *slash = hk_os_last_slash(name);
  const double none[3] = {0.0, 0.0, 0.0}, *gravity = none;
  int32_t status =
      hooke_record_text(view->record, "scene")[0] ? hooke_scene_load(path, NULL, &scene) : HOOKE_BAD_VALUE;
  if (status == HOOKE_OK) status = hooke_scene_commit(scene);
  if (status == HOOKE_NO_MEMORY || status == HOOKE_IO_FAILED) data->status = status;
  if (status == HOOKE_OK) {
    gravity = hooke_scene_system(scene)->fall;
    hk_view_add_bodies(data, hooke_scene_system(scene));
    hk_view_add_obstacles(data, view, hooke_scene_system(scene));
    hk_view_add_springs(data, view, hooke_scene_system(scene));
    if (title == NULL && hooke_scene_text(scene, "title")[0]) title = hooke_scene_text(scene, "title");
  }
  if (slash) name = slash + 1;
  hk_text_word(data, "title", title ? title : name);
  hk_text_word(data, "file", name);
  hk_text_word(data, "why", label[HOOKE_LABEL_COMMAND]);
  hk_text_numbers(data, "gravity", 3, gravity);
  hooke_scene_destroy(scene);
}

static void add_run(struct hk_text *data, const struct hk_view *view) {
  static const char *const numbers[] = {"step", "rtol", "atol", "duration"};
  const hooke_options *run = hooke_record_options(view->record);
  const char *method = hooke_options_text(run, "method");
  const int adaptive = hooke_method_is_adaptive(method) == 1;
  hk_text_word(data, "method", method);
  hk_text_word(data, "status", hooke_record_text(view->record, "status"));
  for (int k = 0; k < 4; k++) {
    const int applies = adaptive ? k > 0 : k == 0 || k == 3;
    if (applies && hooke_options_number_count(run, numbers[k]) > 0)
      hk_text_number(data, numbers[k], hooke_options_number(run, numbers[k]));
  }
}

static void add_counts(struct hk_text *data, const struct hk_view *view) {
  hk_text_number(data, "loose_there", (double)view->loose_there);
  hk_text_number(data, "loose_stride", (double)view->loose_stride);
  hk_text_number(data, "good_frames", (double)view->good_frames);
  hk_text_number(data, "time_good",
                 view->good_frames > 0 ? view->record->time[view->good_frames - 1] : (double)NAN);
  hk_text_flag(data, "by_first_frame", view->by_first_frame);
  hk_text_wholes(data, "frame", view->frames, view->frame);
  if (view->particles < view->particles_there)
    hk_text_wholes(data, "particle", view->particles, view->particle);
}

static void add_column(struct hk_text *data, const struct hk_view *view, const char *key,
                       const double *column) {
  hk_text_open(data, key, '[');
  for (int64_t k = 0; k < view->frames; k++)
    hk_text_number(data, NULL, column[view->frame[k]]);
  hk_text_close(data, ']');
}

static void add_boxes(struct hk_text *data, const struct hk_view *view) {
  hk_text_open(data, "box", '[');
  for (int64_t k = 0; k < view->frames; k++) {
    hk_text_open(data, NULL, '[');
    for (int axis = 0; axis < 6; axis++)
      hk_text_number(data, NULL, axis < 3 ? view->box[k].low[axis] : view->box[k].high[axis - 3]);
    hk_text_close(data, ']');
  }
  hk_text_close(data, ']');
}

/* ---- contents ---- */

static int32_t add_data(struct hk_text *data, const hooke_measurement *m) {
  const struct hk_view *view = m->object;
  hk_text_open(data, NULL, '{');
  add_scene(data, view, m->label);
  add_run(data, view);
  hk_measurement_add_row(data, m, "view", 0);
  add_counts(data, view);
  hk_view_add_floats(data, "rest_length", view, view->rest_length);
  add_column(data, view, "time", view->record->time);
  for (int k = 0; k < HOOKE_VIEW_ENERGIES; k++)
    add_column(data, view, hk_view_energy[k], view->energy[k]);
  hk_view_add_watched(data, view);
  add_boxes(data, view);
  hk_report_add_facts(data);
  hk_text_close(data, '}');
  return data->status;
}

/* Indices of the two ends of each spring, as 32-bit little-endian numbers, then the marks of the particles.
 */
static int32_t add_fixed(struct hk_text *text, const struct hk_view *view) {
  const int64_t count = 8 * view->springs + view->particles;
  uint8_t *bytes = hk_new(count, 1), *at = bytes;
  if (bytes == NULL) return HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < 2 * view->springs; k++) {
    for (int shift = 0; shift < 32; shift += 8)
      *at++ = (uint8_t)(view->end[k] >> shift & 255);
  }
  if (view->particles > 0) memcpy(at, view->mark, (size_t)view->particles);
  hk_base64_add(text, bytes, count);
  hk_free(bytes);
  return text->status;
}

/* Frames have equal lengths, so that the page can access one by its number. */
static int32_t add_frames(struct hk_text *text, struct hk_view *view) {
  const int64_t count = hk_view_frame_bytes(view);
  uint8_t *bytes = hk_new(count, 1);
  int32_t status = bytes ? HOOKE_OK : HOOKE_NO_MEMORY;
  for (int64_t k = 0; k < view->frames && status == HOOKE_OK; k++) {
    status = hk_view_pack(view, k, bytes);
    hk_base64_add(text, bytes, status == HOOKE_OK ? count : 0);
  }
  hk_free(bytes);
  return status == HOOKE_OK ? text->status : status;
}

static int32_t add_part(const char *name, struct hk_text *text, void *ctx) {
  const hooke_measurement *m = ctx;
  if (strcmp(name, "data") == 0) return add_data(text, m);
  return strcmp(name, "fixed") == 0 ? add_fixed(text, m->object) : add_frames(text, m->object);
}

static int32_t add_page(const hooke_measurement *m, struct hk_text *text) {
  struct hk_view *view = m->object;
  const int64_t before = text->length;
  const int32_t status = hk_form_fill("view.html", add_part, (void *)(uintptr_t)m, text);
  view->bytes = (double)(text->length - before);
  return status;
}

/* ---- several trajectories as one page, the page of each in a frame of its own ---- */

/* As texts in an array. */
static int32_t add_pages(const char *name, struct hk_text *list, void *ctx) {
  const hooke_measurement *m = ctx;
  const struct hk_view *view = m->object;
  int32_t status = HOOKE_OK;
  (void)name;
  hk_text_open(list, NULL, '[');
  for (int32_t k = 0; k <= view->beside_count && status == HOOKE_OK; k++) {
    struct hk_text page = {.bytes = NULL};
    status = add_page(k == 0 ? m : view->beside[k - 1], &page);
    hk_text_add(&page, "", 1); /* ends it */
    if (status == HOOKE_OK) status = page.status;
    if (status == HOOKE_OK) hk_text_word(list, NULL, page.bytes);
    hk_text_release(&page);
  }
  hk_text_close(list, ']');
  return status;
}

int32_t hooke_view_add(hooke_measurement *m, const hooke_measurement *other) {
  if (m->kind != &hk_view_kind || other->kind != &hk_view_kind)
    return hk_fail(HOOKE_BAD_VALUE, "view", "a %s beside a %s; allowed: views", other->kind->name,
                   m->kind->name);
  struct hk_view *view = m->object;
  if (view->beside_count == HOOKE_VIEW_MOST_BESIDE)
    return hk_fail(HOOKE_BAD_VALUE, "other", "is one too many; allowed: %d beside the first",
                   HOOKE_VIEW_MOST_BESIDE);
  view->beside[view->beside_count++] = other;
  return HOOKE_OK;
}

int32_t hk_view_write(const hooke_measurement *m, const char *path) {
  struct hk_text text = {.bytes = NULL};
  const struct hk_view *view = m->object;
  int32_t status = hk_input_refuse(hk_record_path(view->record), path);
  for (int32_t k = 0; status == HOOKE_OK && k < view->beside_count; k++)
    status = hk_input_refuse(hk_record_path(((const struct hk_view *)view->beside[k]->object)->record), path);
  if (status == HOOKE_OK)
    status = view->beside_count > 0 ? hk_form_fill("views.html", add_pages, (void *)(uintptr_t)m, &text)
                                    : add_page(m, &text);
  if (status == HOOKE_OK) status = hk_file_write(path, text.bytes, text.length);
  hk_text_release(&text);
  return status;
}
