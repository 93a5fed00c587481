/* Meshes from OBJ files: reading, welding, building.
 *
 * The first two bytes select `weld` and `transform.scale`, the rest is the file.
 *
 * Lines of: src/io/scene/obj.c src/io/scene/mesh.c src/parts/mesh.c src/parts/surface.c src/parts/weld.c
 * Longest input: 2048, mostly 512 */
#include "fuzz.h"

#include "hooke/scene.h"
#include "io/scene/mesh.h"

#include <stdlib.h>
#include <string.h>

struct hk_surface;
struct hk_surface_lines;

/* The first function that is called for a file in which every line was valid. */
int32_t __wrap_hk_surface_create(const hooke_options *options, struct hk_surface_lines *lines,
                                 struct hk_surface *surface);
int32_t __real_hk_surface_create(const hooke_options *options, struct hk_surface_lines *lines,
                                 struct hk_surface *surface);
int32_t __wrap_hk_surface_create(const hooke_options *options, struct hk_surface_lines *lines,
                                 struct hk_surface *surface) {
  hooke_fuzz_is_past_syntax();
  return __real_hk_surface_create(options, lines, surface);
}

/* ---- failures ---- */

static int64_t count_lines(const char *text, int64_t length) {
  int64_t lines = 1;
  for (int64_t k = 0; k < length; k++)
    lines += text[k] == '\n' || (text[k] == '\r' && (k + 1 == length || text[k + 1] != '\n'));
  return lines;
}

/* "mesh.obj:LINE: " if a line is at fault. */
static void require_failure(int32_t status, const char *text, int64_t length) {
  hooke_fuzz_require(status == HOOKE_BAD_VALUE || status == HOOKE_NO_MEMORY,
                     "a file that is refused is a bad value");
  hooke_fuzz_require_message();
  if (status != HOOKE_BAD_VALUE) return;
  const char *message = hooke_last_error();
  hooke_fuzz_require(strncmp(message, "mesh.obj:", 9) == 0, "a message begins with the name of the file");
  if (message[9] == ' ') return;
  char *after;
  const long line = strtol(message + 9, &after, 10);
  hooke_fuzz_require(line >= 1 && line <= count_lines(text, length) && strncmp(after, ": ", 2) == 0,
                     "a message has a line of the file");
}

/* ---- the mesh ---- */

static void set(hooke_options *options, const char *name, const char *text) {
  if (text[0]) hooke_fuzz_require(hooke_options_set_text(options, name, text) == HOOKE_OK, name);
}

static hooke_options *choose_options(uint8_t weld, uint8_t scale) {
  static const char *const welds[] = {"", "0", "1e-3", "0.5", "1", "1e-300", "1e300", "100"};
  static const char *const scales[] = {"", "1", "1e-3", "1e-200", "1e200", "-1", "3", "0.1"};
  hooke_options *options = NULL;
  hooke_fuzz_require(hooke_options_create("mesh", &options) == HOOKE_OK, "a mesh has options");
  set(options, "weld", welds[weld % 8]);
  if (strncmp(scales[scale % 8], "-1", 2) != 0) set(options, "transform.scale", scales[scale % 8]);
  if (scale & 8) set(options, "transform.translate", "0.5,-1e3,7");
  set(options, scale & 16 ? "density" : "mass", "1");
  set(options, "structural.stiffness", "50");
  if (scale & 32) set(options, "bend.stiffness", "5");
  if (scale & 64) set(options, "structural.damping_ratio", "0.1");
  if (scale & 128) set(options, "pinned", "0");
  return options;
}

/* A surface that passed the checks can be built, unless masses or springs overflow. */
static void build(const hooke_options *options) {
  owned_system *system = NULL;
  int64_t first = -1, count = -1;
  hooke_fuzz_require(hooke_system_create(&system) == HOOKE_OK, "a system can be made");
  int32_t status = hooke_system_add_part(system, "mesh", NULL, options, &first, &count);
  if (status == HOOKE_OK) {
    hooke_fuzz_require(first == 0 && count >= 3 && count == hooke_system_particle_count(system) &&
                           count <= hooke_options_number_count(options, "vertices") / 3,
                       "a mesh has as many particles as it says");
    status = hooke_system_commit(system);
  }
  if (status == HOOKE_OK)
    hooke_fuzz_is_accepted();
  else
    hooke_fuzz_require_message();
}

/* A file gives the same result as its text. */
static void read_file(const uint8_t *data, size_t size, int32_t wanted) {
  owned_options *options = choose_options(data[0], data[1]);
  const int32_t status = hooke_mesh_read(hooke_fuzz_file(data + 2, size - 2), options);
  hooke_fuzz_require(status == wanted, "a file gives what its text gives");
  hooke_fuzz_require(hooke_options_is_set(options, "triangles") == (status == HOOKE_OK),
                     "what cannot be read leaves no triangles behind");
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  hooke_fuzz_begin();
  if (size < 2) return 0;
  owned_options *options = choose_options(data[0], data[1]);
  const char *text = (const char *)data + 2;
  const int64_t length = (int64_t)size - 2;
  const int32_t status = hk_mesh_parse(text, length, "mesh.obj", 0.0, options);
  if (status == HOOKE_OK)
    build(options);
  else
    require_failure(status, text, length);
  if (hooke_fuzz_is_chosen(data, size, 64)) read_file(data, size, status);
  return 0;
}
