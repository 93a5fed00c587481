/* Watched quantities over the frames that a view shows, by the scene of the trajectory. */
#include "core/status.h"
#include "io/page/view/view.h"
#include "io/trajectory/record.h"
#include "model/state.h"

int32_t hk_view_watch(struct hk_view *view) {
  const char *text = hooke_options_text(view->options, "watch"), *path = hk_record_path(view->record);
  if (text[0] == '\0') return HOOKE_OK;
  if (hooke_record_text(view->record, "scene")[0] == '\0')
    return hk_fail(HOOKE_BAD_VALUE, "watch", "%s holds no scene, which quantities are read by", path);
  int32_t status = hooke_scene_load(path, NULL, &view->scene);
  if (status == HOOKE_OK) status = hooke_scene_commit(view->scene);
  if (status != HOOKE_OK) return status;
  view->watched.system = hooke_scene_system(view->scene);
  return hk_watched_read_over_time(&view->watched, "watch", text);
}

int32_t hk_view_find_watched(struct hk_view *view) {
  if (view->watched.count == 0) return HOOKE_OK;
  hooke_state *state = NULL;
  int32_t status = hooke_state_create(view->watched.system, &state);
  if (status == HOOKE_OK) status = hk_watched_series_create(&view->watched, view->frames, &view->course);
  for (int64_t f = 0; f < view->frames && status == HOOKE_OK; f++) {
    status = hooke_record_read(view->record, view->frame[f], state);
    if (status == HOOKE_OK) hk_watched_series_keep(&view->course, f, *state->t, state->q, state->v);
  }
  hooke_state_destroy(state);
  return status;
}

void hk_view_add_watched(struct hk_text *data, const struct hk_view *view) {
  hk_text_open(data, "watched", '[');
  for (int64_t k = 0; k < view->watched.count; k++) {
    hk_text_open(data, NULL, '{');
    hk_text_word(data, "name", view->watched.item[k].text);
    hk_text_word(data, "unit", hk_watched_unit(&view->watched.item[k]));
    hk_text_numbers(data, "values", view->frames, hk_watched_series_of(&view->course, k));
    hk_text_close(data, '}');
  }
  hk_text_close(data, ']');
}
