/* The parser of scenes: from text in memory to a committed system, and back to text and to an equal system.
 *
 * Lines of: src/io/scene/scene*.c src/io/scene/json_*.c src/parts/[cglr]*.c src/parts/material.c
 *           src/parts/part.c src/parts/strand.c
 * Longest input: 4096, mostly 320 */
#include "fuzz.h"

#include "hooke/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* A small memory limit, so that too large scenes are refused and not built. */
enum { PAGE = 4096, PAGES = 24 };

long __wrap_sysconf(int name);
long __real_sysconf(int name);
long __wrap_sysconf(int name) {
  return name == _SC_PHYS_PAGES ? PAGES : name == _SC_PAGESIZE ? PAGE : __real_sysconf(name);
}

/* The first function that is called for a text that is JSON. */
int32_t __wrap_hooke_system_create(hooke_system **system);
int32_t __real_hooke_system_create(hooke_system **system);
int32_t __wrap_hooke_system_create(hooke_system **system) {
  hooke_fuzz_is_past_syntax();
  return __real_hooke_system_create(system);
}

/* ---- failures ---- */

/* "scene:LINE:COLUMN: " before the message is a position in the text, or the one after its last character. */
static void require_place(const char *message, const char *text, size_t size) {
  char *after;
  hooke_fuzz_require(strncmp(message, "scene:", 6) == 0, "a message begins with the name of the scene");
  const long line = strtol(message + 6, &after, 10);
  hooke_fuzz_require(line >= 1 && *after == ':', "a message has a line");
  const long column = strtol(after + 1, &after, 10);
  hooke_fuzz_require(column >= 1 && strncmp(after, ": ", 2) == 0, "a message has a column");
  const char *end = text + size, *at = text;
  for (long k = 1; k < line; k++) {
    at = at < end ? memchr(at, '\n', (size_t)(end - at)) : NULL;
    hooke_fuzz_require(at != NULL, "the line of a message is one of the text");
    at++;
  }
  long columns = 1;
  for (; at < end && *at != '\n'; at++)
    columns += ((unsigned char)*at & 0xC0) != 0x80;
  hooke_fuzz_require(column <= columns, "the column of a message is one of its line");
}

static void require_failure(int32_t status, const char *text, size_t size) {
  hooke_fuzz_require(status == HOOKE_BAD_VALUE || status == HOOKE_NO_MEMORY || status == HOOKE_NOT_BUILT,
                     "a scene that is refused is a bad value, or too large");
  hooke_fuzz_require_lines(HOOKE_FUZZ_FAULTS);
  for (const char *line = hooke_last_error(); status == HOOKE_BAD_VALUE && line; line = strchr(line, '\n')) {
    line += *line == '\n';
    if (strncmp(line, "and ", 4) != 0) require_place(line, text, size); /* "and 3 more" */
  }
}

/* ---- systems ---- */

static void require_equal_bits(const double *a, const double *b, int64_t count, const char *what) {
  hooke_fuzz_require(count == 0 || memcmp(a, b, (size_t)count * sizeof *a) == 0, what);
}

static void require_equal_springs(const hooke_system *a, const hooke_system *b) {
  const int64_t count = hooke_system_count(a, "springs");
  hooke_fuzz_require(hooke_system_count(b, "springs") == count,
                     "written and read again: the number of springs");
  owned_wholes *ends = calloc((size_t)(4 * count + 1), sizeof *ends);
  owned_doubles *value = calloc((size_t)(6 * count + 1), sizeof *value);
  if (ends && value) {
    hooke_system_members(a, "springs", ends, NULL, NULL, NULL);
    hooke_system_members(b, "springs", ends + 2 * count, NULL, NULL, NULL);
    hooke_fuzz_require(memcmp(ends, ends + 2 * count, (size_t)(2 * count) * sizeof *ends) == 0,
                       "written and read again: ends of springs");
    hooke_system_members(a, "springs", NULL, value, value + count, value + 2 * count);
    hooke_system_members(b, "springs", NULL, value + 3 * count, value + 4 * count, value + 5 * count);
    require_equal_bits(value, value + 3 * count, 3 * count, "written and read again: material of springs");
  }
}

static void require_equal_forces(const hooke_system *a, const hooke_system *b) {
  hooke_state *state[2] = {NULL, NULL};
  const int64_t count = 3 * hooke_system_particle_count(a);
  owned_doubles *f = calloc((size_t)(2 * count + 1), sizeof *f);
  if (f && hooke_state_create(a, &state[0]) == HOOKE_OK && hooke_state_create(b, &state[1]) == HOOKE_OK) {
    const double *q = hooke_state_position(state[0]), *v = hooke_state_velocity(state[0]);
    require_equal_bits(q, hooke_state_position(state[1]), count, "written and read again: positions");
    require_equal_bits(v, hooke_state_velocity(state[1]), count, "written and read again: velocities");
    const int32_t status = hooke_system_force(a, 0.25, q, v, f);
    hooke_fuzz_require(hooke_system_force(b, 0.25, q, v, f + count) == status,
                       "written and read again: whether there are forces");
    require_equal_bits(f, f + count, count, "written and read again: forces");
  }
  hooke_state_destroy(state[0]);
  hooke_state_destroy(state[1]);
}

static void require_equal(const hooke_system *a, const hooke_system *b) {
  const int64_t count = hooke_system_particle_count(a);
  hooke_fuzz_require(hooke_system_particle_count(b) == count,
                     "written and read again: the number of particles");
  require_equal_bits(hooke_system_mass(a), hooke_system_mass(b), count, "written and read again: masses");
  require_equal_bits(hooke_system_inverse_mass(a), hooke_system_inverse_mass(b), count,
                     "written and read again: what is free");
  hooke_fuzz_require(hooke_system_count(a, "bending") == hooke_system_count(b, "bending") &&
                         hooke_system_count(a, "altitude") == hooke_system_count(b, "altitude"),
                     "written and read again: the number of triples and tetrahedra");
  require_equal_springs(a, b);
  require_equal_forces(a, b);
}

static void go_around(hooke_scene *scene) {
  owned_scene *again = NULL;
  const hooke_system *system = hooke_scene_system(scene);
  hooke_fuzz_require(hooke_scene_of_system(system, hooke_scene_text(scene, "title"),
                                           hooke_scene_run_options(scene), "again", NULL, &again) == HOOKE_OK,
                     "what was read can be written and read again");
  hooke_fuzz_require(hooke_scene_commit(again) == HOOKE_OK, "what was committed can be committed again");
  hooke_fuzz_require(strcmp(hooke_scene_text(scene, "title"), hooke_scene_text(again, "title")) == 0,
                     "written and read again: the title");
  require_equal(system, hooke_scene_system(again));
}

/* ---- one input ---- */

/* A scene in a file, which is scanned in chunks, is accepted or refused like the same text in memory. */
static void load(const char *text, size_t size) {
  owned_scene *scene = NULL, *loaded = NULL;
  const char *path = hooke_fuzz_file(text, size), *message = "";
  char wanted[4096] = "";
  const int32_t status = hooke_scene_parse(text, (int64_t)size, path, "/proc/self/fd", NULL, &scene);
  if (status != HOOKE_OK) snprintf(wanted, sizeof wanted, "%s", hooke_last_error());
  hooke_fuzz_require(hooke_scene_load(path, NULL, &loaded) == status, "a file gives what its text gives");
  if (status != HOOKE_OK) message = hooke_last_error();
  hooke_fuzz_require(strcmp(message, wanted) == 0 || status == HOOKE_NO_MEMORY || strstr(wanted, "is empty"),
                     "a file is refused for what its text is refused for");
}

/* The folder of the files that scenes may name: beside the program, for a program copied to another machine,
 * or among the sources. */
static const char *files(void) {
  static char path[PAGE];
  if (path[0]) return path;
  const ssize_t length = readlink("/proc/self/exe", path, sizeof path - sizeof "files");
  char *name = length > 0 ? strrchr(path, '/') : NULL;
  if (name) memcpy(name + 1, "files", sizeof "files");
  if (name == NULL || access(path, R_OK) != 0)
    snprintf(path, sizeof path, HOOKE_SOURCE_DIR "/tests/fuzz/files");
  hooke_fuzz_require(access(path, R_OK) == 0, "the files that scenes may name are there");
  return path;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  const char *text = size ? (const char *)data : "";
  owned_scene *scene = NULL;
  hooke_fuzz_begin();
  int32_t status = hooke_scene_parse(text, (int64_t)size, "scene", files(), NULL, &scene);
  hooke_fuzz_require((status == HOOKE_OK) == (scene != NULL), "a scene comes with success alone");
  if (status == HOOKE_OK) status = hooke_scene_commit(scene);
  if (status == HOOKE_OK) {
    hooke_fuzz_is_accepted();
    if (hooke_fuzz_is_chosen(text, size, 8)) go_around(scene); /* takes as long as everything else */
  } else {
    require_failure(status, text, size);
  }
  if (hooke_fuzz_is_chosen(text, size, 256)) load(text, size);
  return 0;
}
