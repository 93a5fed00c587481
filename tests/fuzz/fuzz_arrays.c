/* Arrays that a scene names in HDF5 files: for any container, the result is its numbers or a message.
 *
 * Lines of: src/io/hdf5/array_h5.c src/io/hdf5/dataset_h5.c src/io/trajectory/frame_check_h5.c
 *           src/io/scene/scene_json_array.c src/io/hdf5/object_h5.c
 * Longest input: 148 */
#include "container.h"
#include "fuzz.h"

#include "hooke.h"

#include "core/memory.h"
#include "core/status.h"
#include "io/hdf5/array_h5.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed);

static struct container container;

/* ---- the reader itself ---- */

struct wanted {
  const char *dataset;
  int64_t frame;
  int32_t has_frame;
};

/* Frames before the first without a time, or of a run that is over all, as the reader's header has it. */
static int64_t frames_there(const char *dataset, int64_t frames) {
  char name[256];
  int32_t rank;
  int64_t size[4];
  snprintf(name, sizeof name, "%.*stime", (int)(strrchr(dataset, '/') - dataset) + 1, dataset);
  owned_doubles *time = container_read(&container, name, &rank, size);
  if (time && rank == 1 && size[0] == frames && !container_is_over(&container)) {
    for (int64_t k = 0; k < frames; k++) {
      if (isnan(time[k])) frames = k;
    }
  }
  return frames;
}

static void check_numbers(const struct wanted *wanted, const double *numbers, int64_t rows, int64_t columns) {
  int32_t rank;
  int64_t size[4], at = 0;
  owned_doubles *whole = container_read(&container, wanted->dataset, &rank, size);
  if (whole == NULL) return;
  hooke_fuzz_require(rank >= 1 && rank <= 3, "an array of so many dimensions");
  const int framed = rank == 3;
  hooke_fuzz_require(rows == size[framed] && columns == (rank == 1 ? 1 : size[framed + 1]),
                     "rows and columns");
  if (framed) {
    const int64_t frames = frames_there(wanted->dataset, size[0]),
                  frame = wanted->has_frame ? wanted->frame : -1;
    at = frame < 0 ? frames + frame : frame;
    hooke_fuzz_require(at >= 0 && at < frames, "a frame that is not there");
  }
  for (int64_t k = 0; k < rows * columns; k++) {
    const double found = numbers[k], expected = whole[at * rows * columns + k];
    hooke_fuzz_require(memcmp(&found, &expected, sizeof found) == 0 || (isnan(found) && isnan(expected)),
                       "a number");
  }
}

static void read_array(const struct wanted *wanted, int by_hdf5) {
  double *numbers = NULL;
  int64_t rows = -1, columns = -1;
  const int32_t status = hk_array_read(container.path, wanted->dataset, wanted->frame, wanted->has_frame,
                                       &numbers, &rows, &columns);
  hooke_fuzz_require(status <= HOOKE_OK, "an outcome of a run");
  if (status != HOOKE_OK) {
    hooke_fuzz_require_message();
    hooke_fuzz_require(numbers == NULL, "numbers besides a failure");
    return;
  }
  hooke_fuzz_is_accepted();
  hooke_fuzz_require(numbers != NULL && rows >= 0 && columns >= 0, "no numbers");
  double sum = 0.0;
  for (int64_t k = 0; k < rows * columns; k++) {
    hooke_fuzz_require(numbers[k] != SECRET_NUMBER, "a number of another file");
    sum += numbers[k];
  }
  hooke_fuzz_require(sum == sum || sum != sum, "all of them can be read");
  if (by_hdf5) check_numbers(wanted, numbers, rows, columns);
  hk_free(numbers);
}

/* ---- through a scene ---- */

#define FOUR "'particles': {'mass': 1, 'position': [[0,0,0],[1,0,0],[0,2,0],[0,0,3]]"

/* Scenes with ' for ", @ for the array and # for a particle, or their replacements. */
static const char *const scenes[] = {
    "'particles': {'position': @, 'mass': 1}",
    FOUR ", 'velocity': @}",
    "'particles': {'position': [[0,0,0],[1,0,0],[0,2,0],[0,0,3]], 'mass': @}",
    FOUR ", 'pinned': @}",
    FOUR "}, 'springs': [{'between': @, 'stiffness': 5}]",
    FOUR "}, 'springs': [{'between': [[0,1],[1,2],[0,3]], 'stiffness': @, 'rest_length': 1}]",
    "'parts': [{'kind': 'mesh', 'vertices': @, 'triangles': [[0,1,2]], 'mass': 1, 'structural': "
    "{'stiffness': 5}}]",
    FOUR "}, 'driven': [{'particles': [0], 'motion': 'table', 'time': [0, 1, 2, 3], 'position': @}]",
    FOUR "}, 'driven': [{'particles': [0], 'motion': 'table', 'time': @, 'position': [[0,0,0],[1,0,0]]}]",
    "'parts': [{'kind': 'rope', 'name': 'p', 'from': [0,0,0], 'to': [1,0,0], 'segments': 3, 'mass': 1}], "
    "'particles': {'position': @, 'mass': 1}, 'springs': [{'between': [[0, #]], 'stiffness': 5}]",
    FOUR "}, 'springs': [{'between': [[0, 1], #], 'stiffness': @}]",
    FOUR ", 'velocity': @, 'pinned': [0, #]}",
    "'particles': {'position': [[0,0,0], #], 'mass': @}",
    "'particles': {'position': [[0,0,#]], 'mass': @}",
};
static const char *const particles[] = {
    "1",     "7",          "['p', 2]", "['p', 9]", "['p', -1]", "['q', 0]",
    "['p']", "['p', 1.5]", "[0, 1]",   "1.5",      "'p'",       "{}",
};

static void print_scene(const uint8_t head[EDIT_HEAD], const char *array, char *scene, size_t size) {
  const char *from = scenes[head[2] % (sizeof scenes / sizeof scenes[0])];
  const char *particle = particles[head[3] % (sizeof particles / sizeof particles[0])];
  size_t used = (size_t)snprintf(scene, size, "{'hooke': 1, ");
  for (; *from; from++) {
    const char one[] = {*from, '\0'};
    used += (size_t)snprintf(scene + used, size - used, "%s",
                             *from == '@'   ? array
                             : *from == '#' ? particle
                                            : one);
  }
  snprintf(scene + used, size - used, "}");
  for (char *c = scene; *c; c++)
    if (*c == '\'') *c = '"';
}

static void load_scene(const uint8_t head[EDIT_HEAD], const struct wanted *wanted) {
  char source[512], frame[48] = "", whole[1024];
  if (wanted->has_frame) snprintf(frame, sizeof frame, ", 'frame': %lld", (long long)wanted->frame);
  snprintf(source, sizeof source, "{'file': '%s', 'dataset': '%s'%s}", head[2] == 255 ? "other.h5" : "c.h5",
           wanted->dataset, frame);
  print_scene(head, source, whole, sizeof whole);
  owned_scene *scene = NULL;
  const int32_t status =
      hooke_scene_parse(whole, (int64_t)strlen(whole), "scene", container.folder, NULL, &scene);
  hooke_fuzz_require(status <= HOOKE_OK && (status == HOOKE_OK) == (scene != NULL), "a scene or a failure");
  hooke_fuzz_require(status != HOOKE_IO_FAILED, "a file of a scene is the scene's fault");
  if (status == HOOKE_OK) {
    hooke_fuzz_is_accepted();
    hooke_scene_commit(scene);
  }
}

/* The first byte selects the dataset, the second the frame and the call. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  struct edits edits;
  hooke_fuzz_begin();
  if (container.names == 0) container_begin(&container);
  edits_decode(data, size, &edits);
  container_edit(&container, &edits);
  const struct wanted wanted = {container.name[edits.head[0] % container.names], edits.head[1] % 16 - 8,
                                (edits.head[1] & 16) != 0};
  hooke_fuzz_is_past_syntax(); /* the container is valid HDF5 */
  const int64_t open = container_open_objects();
  const int32_t by_scene = (edits.head[1] & 32) != 0, by_hdf5 = !by_scene && (edits.head[1] & 192) == 192;
  container_others_opened();
  if (by_scene)
    load_scene(edits.head, &wanted);
  else
    read_array(&wanted, by_hdf5);
  hooke_fuzz_require(!container_others_opened() || by_hdf5 || (by_scene && edits.head[2] == 255),
                     "another file was opened");
  hooke_fuzz_require(container_open_objects() == open, "objects of HDF5 left open");
  return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t most, unsigned seed) {
  return edits_mutate(data, size, most, seed);
}
