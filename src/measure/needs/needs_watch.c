/* The watched particles. */
#include "measure/needs/needs.h"

#include "core/memory.h"
#include "core/status.h"
#include "measure/quantity/watched.h"

int32_t hk_needs_read_watch(struct hk_needs *needs) {
  const hooke_system *system = needs->system;
  const char *text = hooke_options_text(needs->options, "watch");
  uint8_t *mark = hk_new(system->particle_count, 1);
  if (mark == NULL) return HOOKE_NO_MEMORY;
  int32_t status = HOOKE_OK;
  if (text[0] == '\0') {
    for (int64_t p = 0; p < system->particle_count; p++)
      mark[p] = system->constrained[p] == 0;
  } else {
    status = hk_watched_mark_particles(system, "watch", text, mark);
  }
  for (int64_t p = 0; p < system->particle_count; p++)
    needs->watch_count += mark[p];
  needs->watch = hk_new(needs->watch_count, sizeof *needs->watch);
  if (status == HOOKE_OK && needs->watch == NULL) status = HOOKE_NO_MEMORY;
  if (status == HOOKE_OK && needs->watch_count == 0) {
    status =
        hk_fail(HOOKE_BAD_VALUE, "watch", "no particle of the scene is free, so there is nothing to watch");
  }
  int64_t at = 0;
  for (int64_t p = 0; p < system->particle_count && status == HOOKE_OK; p++) {
    if (mark[p]) needs->watch[at++] = p;
  }
  hk_free(mark);
  return status;
}
