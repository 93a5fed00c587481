#include "io/file/inputs.h"

#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/os/os_file.h"
#include "core/status.h"
#include "io/file/atomic_file.h"
#include "model/system.h"

int32_t hk_inputs_note(hooke_system *system, const char *path, int32_t is_scene) {
  HOOKE_KEEP_ERRNO;
  struct hk_os_file there;
  if (hk_os_look(path, &there) != 0) return HOOKE_OK; /* whoever reads it tells */
  void *grown = system->rest->input;
  const int32_t status =
      hk_grow(&grown, system->rest->input_count, system->rest->input_count + 1, sizeof there);
  if (status != HOOKE_OK) return status;
  system->rest->input = grown;
  system->rest->input[system->rest->input_count++] = there;
  system->rest->has_scene = is_scene;
  return HOOKE_OK;
}

static int32_t refuse(int64_t count, const struct hk_os_file *input, const char *output) {
  struct hk_os_file there;
  const int exists = count > 0 && hk_os_look(output, &there) == 0;
  for (int64_t k = 0; exists && k < count; k++) {
    if (!hk_os_is_same(&there, &input[k])) continue;
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is read, too, and would be replaced; name another file",
                   output);
  }
  return HOOKE_OK;
}

int32_t hk_inputs_refuse(const hooke_system *system, const char *output) {
  HOOKE_KEEP_ERRNO;
  static const char *const endings[] = {"", ".checkpoint", ".checkpoint.previous"};
  int32_t status = HOOKE_OK;
  for (int k = 0; status == HOOKE_OK && k < 3; k++) {
    char *beside = NULL;
    status = hk_file_beside(output, endings[k], &beside);
    if (status == HOOKE_OK) status = refuse(system->rest->input_count, system->rest->input, beside);
    hk_free(beside);
  }
  return status;
}

int32_t hk_inputs_refuse_save(const hooke_system *system, const char *output) {
  HOOKE_KEEP_ERRNO;
  return refuse(system->rest->input_count - system->rest->has_scene, system->rest->input, output);
}

int32_t hk_input_refuse(const char *input, const char *output) {
  HOOKE_KEEP_ERRNO;
  struct hk_os_file there;
  return hk_os_look(input, &there) == 0 ? refuse(1, &there, output) : HOOKE_OK;
}
