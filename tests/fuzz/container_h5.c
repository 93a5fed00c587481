/* Containers: created once for each list of structures and cached, their numbers patched for each input.
 *
 * Opening a file takes HDF5 longer than all work of hooke on it, so images stay open: hooke opens the image
 * once more as the file, unless its headers were patched, which HDF5 would not read again. */
#include "container.h"

#include "container_edit_h5.h"

#include "hooke.h"

#include "core/crc32.h"
#include "io/trajectory/frame_file.h"
#include "io/trajectory/h5md_h5.h"
#include "memory_folder.h"

#include <hdf5.h>

#include <fcntl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <unistd.h>

enum { MOST_NAMES = 192, KEPT = 4096, OPEN = 512, LARGEST_IMAGE = 1 << 20, FRAMES = 4 };

/* Location of the numbers or characters of an object; `known` 0: not looked up yet. */
struct place {
  int32_t known, rank, width, is_text;
  uint64_t data, stored, header, header_size;
  uint64_t size[4];
};

struct image {
  uint64_t hash;
  uint8_t *bytes;
  size_t size;
  struct place *place; /* by name */
};

/* An image that HDF5 has open, and its bytes. */
struct opened {
  uint64_t hash;
  hid_t file;
  uint8_t *bytes;
};

static struct {
  char *name[MOST_NAMES];
  int32_t names;
  uint8_t *base, *patched;
  size_t base_size;
  struct place place[MOST_NAMES]; /* in the base */
  struct image image[KEPT];
  struct opened opened[OPEN];
  const char *path;
  const struct image *now;
  hid_t warm; /* replaces the file at `path`; -1: that is opened itself */
  int descriptor, watch;
} own = {.warm = -1};

hid_t __wrap_H5Fopen(const char *path, unsigned flags, hid_t list);
hid_t __real_H5Fopen(const char *path, unsigned flags, hid_t list);
hid_t __wrap_H5Fopen(const char *path, unsigned flags, hid_t list) {
  const int stands = own.warm >= 0 && flags == H5F_ACC_RDONLY && strcmp(path, own.path) == 0;
  return stands ? H5Freopen(own.warm) : __real_H5Fopen(path, flags, list);
}

_Noreturn static void give_up(const char *what) {
  fprintf(stderr, "container: %s: %s\n", what, hooke_last_error());
  abort();
}

/* Blocks are many and short-lived, and most of them HDF5's. */
const char *__asan_default_options(void);
const char *__asan_default_options(void) {
  return "malloc_context_size=6:quarantine_size_mb=8";
}

/* HDF5 1.10.8 leaks the headers of objects that it creates. Objects that hooke leaves open are counted
 * separately. */
const char *__lsan_default_suppressions(void);
const char *__lsan_default_suppressions(void) {
  return "leak:libhdf5";
}

/* ---- the trajectory ---- */

static const char scene[] =
    "{\"hooke\": 1, \"title\": \"small\", \"gravity\": [0, -9.81, 0], \"drag\": 0.1,\n"
    " \"particles\": {\"position\": [[0,0,0],[1,0,0],[2,0,0.5],[0,1,0]], \"mass\": [1, 0.5, 0.25, 1], "
    "\"pinned\": [0]},\n"
    " \"springs\": [{\"between\": [[0,1],[1,2],[0,3]], \"stiffness\": 10, \"damping\": 0.1}],\n"
    " \"run\": {\"method\": \"symplectic-euler\", \"step\": 0.01, \"every\": 0.02, \"duration\": 0.06}}\n";

static int32_t keep_frame(int64_t step, const hooke_state *state, void *ctx) {
  return hooke_trajectory_write(ctx, step, state) == HOOKE_OK ? 0 : 1;
}

static void run_trajectory(const char *path) {
  hooke_scene *made = NULL;
  hooke_integrator *integrator = NULL;
  hooke_state *state = NULL;
  hooke_trajectory *trajectory = NULL;
  if (hooke_scene_parse(scene, (int64_t)strlen(scene), "small", NULL, NULL, &made) ||
      hooke_scene_commit(made) ||
      hooke_integrator_create(hooke_scene_system(made), hooke_scene_run_options(made), &integrator) ||
      hooke_state_create(hooke_scene_system(made), &state) ||
      hooke_trajectory_create(path, hooke_scene_system(made), integrator, hooke_scene_text(made, "text"),
                              &trajectory) ||
      hooke_integrator_on_frame(integrator, keep_frame, trajectory) ||
      hooke_integrator_run(integrator, state) || hooke_trajectory_close(trajectory, HOOKE_OK))
    give_up("the trajectory");
  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_scene_destroy(made);
}

static uint8_t *read_file(const char *path, size_t *size) {
  struct stat there;
  uint8_t *bytes = NULL;
  const int descriptor = open(path, O_RDONLY);
  if (descriptor >= 0 && fstat(descriptor, &there) == 0) bytes = malloc((size_t)there.st_size);
  if (bytes == NULL || read(descriptor, bytes, (size_t)there.st_size) != there.st_size) give_up(path);
  *size = (size_t)there.st_size;
  close(descriptor);
  return bytes;
}

static herr_t add_name(hid_t file, const char *name, const H5L_info_t *link, void *ctx) {
  (void)file, (void)link, (void)ctx;
  char *kept = own.names < MOST_NAMES ? malloc(strlen(name) + 2) : NULL;
  if (kept == NULL) return -1;
  sprintf(kept, "/%s", name);
  own.name[own.names++] = kept;
  return 0;
}

/* Data that no reader of the container may reach. */
static void write_secret(const char *path) {
  const hsize_t size[3] = {4, 4, 3};
  double number[48];
  for (int k = 0; k < 48; k++)
    number[k] = SECRET_NUMBER;
  char text[64] = SECRET_TEXT;
  hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  hid_t space = H5Screate_simple(3, size, NULL), type = H5Tcopy(H5T_C_S1), one = H5Screate(H5S_SCALAR);
  H5Tset_size(type, sizeof text);
  hid_t numbers = H5Dcreate2(file, "numbers", H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  hid_t texts = H5Dcreate2(file, "text", type, one, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (H5Dwrite(numbers, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, number) < 0 ||
      H5Dwrite(texts, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, text) < 0)
    give_up(path);
  H5Dclose(texts), H5Dclose(numbers), H5Sclose(one), H5Tclose(type), H5Sclose(space);
  if (H5Fclose(file) < 0) give_up(path);
}

/* Plain numbers, for external storage. */
static void write_raw(const char *path) {
  FILE *file = fopen(path, "wb");
  const double number = SECRET_NUMBER;
  for (int k = 0; k < 64 && file; k++)
    fwrite(k < 32 ? (const void *)&number : (const void *)SECRET_TEXT,
           k < 32 ? sizeof number : sizeof SECRET_TEXT, 1, file);
  if (file == NULL || fclose(file) != 0) give_up(path);
}

static char folder_to_remove[64];

static void remove_folder(void) {
  static const char *const file[] = {
      "c.h5", "other.h5", "raw.bin", "x.xdmf", "c.xdmf", "c.h5.checkpoint", "c.h5.checkpoint.previous"};
  char path[96];
  for (size_t k = 0; k < sizeof file / sizeof file[0]; k++) {
    snprintf(path, sizeof path, "%s/%s", folder_to_remove, file[k]);
    unlink(path);
  }
  rmdir(folder_to_remove);
}

/* HDF5 allocates half a megabyte for each file that it opens; it may keep them. */
static void keep_memory(void) {
  const int limit = 1 << 26;
  H5set_free_list_limits(limit, limit, limit, limit, limit, limit);
}

void container_begin(struct container *container) {
  char path[96];
  keep_memory();
  snprintf(container->folder, sizeof container->folder, "%s/hooke-fuzz-XXXXXX", memory_folder());
  if (mkdtemp(container->folder) == NULL) give_up(container->folder);
  memcpy(folder_to_remove, container->folder, sizeof folder_to_remove);
  atexit(remove_folder);
  snprintf(container->path, sizeof container->path, "%s/c.h5", container->folder);
  run_trajectory(container->path);
  own.base = read_file(container->path, &own.base_size);
  own.patched = malloc(LARGEST_IMAGE);
  hid_t file = H5Fopen(container->path, H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0 || H5Lvisit(file, H5_INDEX_NAME, H5_ITER_INC, add_name, NULL) < 0) give_up("names");
  H5Fclose(file);
  container->name = (const char *const *)own.name;
  container->names = own.names;
  snprintf(path, sizeof path, "%s/other.h5", container->folder);
  write_secret(path);
  snprintf(path, sizeof path, "%s/raw.bin", container->folder);
  write_raw(path);
  own.path = container->path;
  own.descriptor = open(container->path, O_RDWR);
  if (own.descriptor < 0) give_up(container->path);
  own.watch = inotify_init1(IN_NONBLOCK);
  snprintf(path, sizeof path, "%s/other.h5", container->folder);
  inotify_add_watch(own.watch, path, IN_OPEN);
  snprintf(path, sizeof path, "%s/raw.bin", container->folder);
  inotify_add_watch(own.watch, path, IN_OPEN);
  H5Eset_auto2(H5E_DEFAULT, NULL, NULL);
}

/* ---- images ---- */

/* HDF5 identifies two images of one name. */
static hid_t open_image(uint64_t name, const void *bytes, size_t size, unsigned flags) {
  char path[32];
  snprintf(path, sizeof path, "image-%llx", (unsigned long long)name);
  hid_t list = H5Pcreate(H5P_FILE_ACCESS), file = -1;
  if (H5Pset_fapl_core(list, 1 << 16, 0) >= 0 && H5Pset_fclose_degree(list, H5F_CLOSE_STRONG) >= 0 &&
      H5Pset_file_image(list, (void *)(uintptr_t)bytes, size) >= 0)
    file = __real_H5Fopen(path, flags, list);
  H5Pclose(list);
  return file;
}

static void make_image(const struct container *container, const struct edits *edits, struct image *image) {
  hid_t file = open_image(0, own.base, own.base_size, H5F_ACC_RDWR);
  if (file < 0) give_up("the base");
  /* as in an older file, of which what was changed is taken for what was written */
  if (edits->count % 2 == 1 && H5Lexists(file, "hooke/file_check", H5P_DEFAULT) > 0)
    H5Ldelete(file, "hooke/file_check", H5P_DEFAULT);
  for (int32_t k = 0; k < edits->count; k++) {
    if (edits->edit[k].kind < EDIT_STRUCTURES) container_edit_structure(file, container, &edits->edit[k]);
  }
  H5Fflush(file, H5F_SCOPE_GLOBAL);
  const ssize_t size = H5Fget_file_image(file, NULL, 0);
  image->bytes = size > 0 && size <= LARGEST_IMAGE ? malloc((size_t)size) : NULL;
  if (image->bytes) {
    image->size = (size_t)H5Fget_file_image(file, image->bytes, (size_t)size);
  } else {
    image->bytes = malloc(own.base_size);
    memcpy(image->bytes, own.base, own.base_size);
    image->size = own.base_size;
  }
  image->place = calloc(MOST_NAMES, sizeof *image->place);
  H5Fclose(file);
}

static uint64_t hash_of(const struct edits *edits) {
  uint64_t hash = UINT64_C(0xcbf29ce484222325);
  for (int32_t k = 0; k < edits->count && edits->edit[k].kind < EDIT_STRUCTURES; k++) {
    const struct edit *edit = &edits->edit[k];
    const uint64_t words[] = {edit->kind, edit->where, edit->what, edit->how, edit->value};
    for (int w = 0; w < 5; w++)
      hash = (hash ^ words[w]) * UINT64_C(0x9e3779b97f4a7c15), hash ^= hash >> 29;
  }
  return hash | 1;
}

/* The core driver keeps the image in a block of its own. */
static struct opened *find_opened(const struct image *image) {
  struct opened *opened = &own.opened[image->hash % OPEN];
  void **bytes = NULL;
  if (opened->hash == image->hash) return opened;
  if (opened->hash) H5Fclose(opened->file);
  *opened =
      (struct opened){image->hash, open_image(image->hash, image->bytes, image->size, H5F_ACC_RDONLY), NULL};
  if (opened->file < 0 || H5Fget_vfd_handle(opened->file, H5P_DEFAULT, (void **)&bytes) < 0)
    give_up("an image");
  opened->bytes = *bytes;
  return opened;
}

/* ---- numbers ---- */

static void look_up(const struct image *image, int32_t number, struct place *place) {
  hid_t data = H5Dopen2(find_opened(image)->file, own.name[number], H5P_DEFAULT);
  place->known = 1;
  if (data >= 0) {
    H5O_info_t info;
    hid_t space = H5Dget_space(data), type = H5Dget_type(data);
    const haddr_t at = H5Dget_offset(data);
    place->rank = H5Sget_simple_extent_ndims(space);
    if (place->rank > 0 && place->rank <= 4) H5Sget_simple_extent_dims(space, (hsize_t *)place->size, NULL);
    place->width = (int32_t)H5Tget_size(type);
    place->is_text = H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0;
    place->stored = H5Dget_storage_size(data);
    place->data = at;
    if (at == HADDR_UNDEF || at + place->stored > image->size) place->stored = 0;
    if (H5Oget_info2(data, &info, H5O_INFO_BASIC | H5O_INFO_HDR) >= 0 && info.hdr.nchunks == 1 &&
        info.addr + info.hdr.space.total <= image->size) {
      place->header = info.addr;
      place->header_size = info.hdr.space.total;
    }
    H5Tclose(type), H5Sclose(space), H5Dclose(data);
  }
}

/* True if an edit concerns the object of that name, or a group on its path. */
static int is_edited(const char *name, const struct edits *edits) {
  for (int32_t k = 0; k < edits->count && edits->edit[k].kind < EDIT_STRUCTURES; k++) {
    const char *edited = own.name[edits->edit[k].where % own.names];
    const size_t length = strlen(edited);
    if (strncmp(name, edited, length) == 0 && (name[length] == '\0' || name[length] == '/')) return 1;
  }
  return 0;
}

/* Objects without edits keep their location. */
static void take_places(const struct edits *edits, struct image *image) {
  for (int32_t k = 0; k < own.names; k++) {
    if (!is_edited(own.name[k], edits)) image->place[k] = own.place[k];
  }
}

static struct image *find_image(const struct container *container, const struct edits *edits) {
  const uint64_t hash = hash_of(edits);
  struct image *image = &own.image[hash % KEPT];
  if (image->hash == hash) return image;
  free(image->bytes);
  free(image->place);
  *image = (struct image){.hash = hash};
  make_image(container, edits, image);
  take_places(edits, image);
  return image;
}

/* Over all names; an image without edits is the base. */
static void find_places(const struct container *container) {
  const struct edits none = {.count = 0};
  struct image *base = find_image(container, &none);
  for (int32_t k = 0; k < own.names; k++)
    look_up(base, k, &own.place[k]);
  memcpy(base->place, own.place, sizeof own.place);
}

static void patch_value(const struct place *place, const struct edit *edit) {
  const uint64_t width = (uint64_t)place->width, numbers = width ? place->stored / width : 0;
  if (numbers == 0) return;
  memcpy(own.patched + place->data + (edit->what + 256u * (edit->how & 3u)) % numbers * width, &edit->value,
         width < sizeof edit->value ? width : sizeof edit->value);
}

/* Replaces one character, by few others: texts have fuzz targets of their own, and arbitrary texts would hide
 * the rest of a container. */
static void patch_text(const struct place *place, const struct edit *edit) {
  static const char characters[] = "\0 \n\"{}[],:-09.e\\\xff";
  if (place->stored == 0) return;
  own.patched[place->data + (edit->what + 256u * (edit->how & 3u)) % place->stored] =
      (uint8_t)characters[edit->value % (sizeof characters - 1)];
}

static void replace_words(uint8_t *message, size_t size, uint64_t from, uint64_t to) {
  for (size_t at = 0; at + 8 <= size; at++) {
    if (memcmp(message + at, &from, 8) == 0) memcpy(message + at, &to, 8);
  }
}

/* Patches both the extent and the allocated size, so that they agree; or one of them. The rest of the header
 * is HDF5's business: HDF5 File Format Specification 3.0, IV.A.1.a, messages 0x0001 and 0x0008. */
static void patch_extent(const struct place *place, const struct edit *edit) {
  enum { PREFIX = 16, MESSAGE = 8, DATASPACE = 0x0001, LAYOUT = 0x0008 };
  const uint8_t *header = own.patched + place->header;
  if (place->rank < 1 || place->rank > 4 || place->header_size == 0 || header[0] != 1) return;
  const uint64_t old = place->size[edit->what % place->rank];
  for (uint64_t at = PREFIX; at + MESSAGE <= place->header_size;) {
    uint16_t type, size;
    memcpy(&type, header + at, sizeof type), memcpy(&size, header + at + 2, sizeof size);
    uint8_t *message = own.patched + place->header + at + MESSAGE;
    at += MESSAGE + size;
    if (at > place->header_size) return;
    if (type == DATASPACE && (edit->how & 1)) replace_words(message, size, old, edit->value);
    if (type == LAYOUT && (edit->how & 2) && old > 0 && message[1] == H5D_CONTIGUOUS)
      replace_words(message, size, place->stored, place->stored / old * edit->value);
  }
}

/* ---- check values ---- */

static const struct place *place_of(const struct image *image, const char *name) {
  for (int32_t k = 0; k < own.names; k++) {
    if (strcmp(own.name[k], name) != 0) continue;
    if (!image->place[k].known) look_up(image, k, &image->place[k]);
    return &image->place[k];
  }
  return NULL;
}

/* Row `frame` of an array of the run; NULL if its location or form has changed. */
static uint8_t *row_of(const struct image *image, int array, int64_t frame) {
  char name[HOOKE_FRAME_PATH];
  hk_frame_path("all", array, name);
  const struct place *place = place_of(image, name);
  const uint64_t bytes = (uint64_t)hk_frame_bytes(4, array), begin = (uint64_t)frame * bytes;
  if (place == NULL || begin + bytes > place->stored) return NULL;
  return own.patched + place->data + begin;
}

static void patch_check(const struct image *image, int64_t frame) {
  uint32_t check = 0;
  for (int k = 0; k < HOOKE_FRAME_CHECK; k++) {
    const uint8_t *row = row_of(image, k, frame);
    if (row) check = hk_crc32(check, row, hk_frame_bytes(4, k));
  }
  uint8_t *row = row_of(image, HOOKE_FRAME_CHECK, frame);
  if (row) memcpy(row, &check, sizeof check);
}

void container_edit(struct container *container, const struct edits *edits) {
  if (!own.place[0].known) find_places(container);
  struct image *image = find_image(container, edits);
  int32_t headers = 0, texts = 0;
  memcpy(own.patched, image->bytes, image->size);
  container->structures = 0;
  for (int32_t k = 0; k < edits->count; k++) {
    const struct edit *edit = &edits->edit[k];
    container->structures += edit->kind < EDIT_STRUCTURES;
    struct place *place = &image->place[edit->where % own.names];
    if (edit->kind < EDIT_STRUCTURES) continue;
    if (!place->known) look_up(image, edit->where % own.names, place);
    if (edit->kind == EDIT_CHECK) patch_check(image, edit->what % 4);
    if (edit->kind == EDIT_VALUE && !place->is_text) patch_value(place, edit);
    if (edit->kind == EDIT_VALUE && place->is_text && texts++ == 0) patch_text(place, edit);
    if (edit->kind == EDIT_EXTENT) patch_extent(place, edit), headers++;
  }
  const struct opened *opened = find_opened(image);
  memcpy(opened->bytes, headers ? image->bytes : own.patched, image->size);
  own.warm = headers ? -1 : opened->file;
  own.now = image;
  if (pwrite(own.descriptor, own.patched, image->size, 0) != (ssize_t)image->size ||
      ftruncate(own.descriptor, (off_t)image->size) != 0)
    give_up(container->path);
}

void container_kill_after(int64_t frames) {
  static const char running[] = "running";
  const double none = NAN;
  const struct place *status = place_of(own.now, "/hooke/status");
  own.warm = -1;
  if (frames > FRAMES) return;
  if (status && status->stored >= sizeof running)
    pwrite(own.descriptor, running, sizeof running, (off_t)status->data);
  for (int64_t k = frames; k < FRAMES; k++) {
    const uint8_t *row = row_of(own.now, HOOKE_FRAME_TIME, k);
    if (row) pwrite(own.descriptor, &none, sizeof none, row - own.patched);
  }
}

/* ---- queries ---- */

double *container_read(const struct container *container, const char *dataset, int32_t *rank,
                       int64_t size[4]) {
  enum { MOST_NUMBERS = 100000 };
  double *numbers = NULL;
  hid_t list = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fclose_degree(list, H5F_CLOSE_STRONG);
  hid_t file = H5Fopen(container->path, H5F_ACC_RDONLY, list), data = -1, space = -1;
  H5Pclose(list);
  if (file >= 0) data = H5Dopen2(file, dataset, H5P_DEFAULT);
  if (data >= 0) space = H5Dget_space(data);
  *rank = space < 0 ? -1 : H5Sget_simple_extent_ndims(space);
  const hssize_t count = space < 0 ? -1 : H5Sget_simple_extent_npoints(space);
  if (*rank >= 0 && *rank <= 4 && count >= 0 && count <= MOST_NUMBERS) {
    hsize_t extent[4] = {0};
    H5Sget_simple_extent_dims(space, extent, NULL);
    for (int k = 0; k < 4; k++)
      size[k] = (int64_t)extent[k];
    numbers = calloc((size_t)count + 1, sizeof *numbers);
    if (H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, numbers) < 0) {
      free(numbers);
      numbers = NULL;
    }
  }
  if (space >= 0) H5Sclose(space);
  if (data >= 0) H5Dclose(data);
  if (file >= 0) H5Fclose(file);
  return numbers;
}

int32_t container_is_over(const struct container *container) {
  hid_t file = H5Fopen(container->path, H5F_ACC_RDONLY, H5P_DEFAULT);
  const int32_t is_over = file >= 0 && hk_h5md_is_over(file);
  if (file >= 0) H5Fclose(file);
  return is_over;
}

int32_t container_others_opened(void) {
  char events[4096];
  int32_t opened = 0;
  while (read(own.watch, events, sizeof events) > 0)
    opened = 1;
  return opened;
}

int64_t container_open_objects(void) {
  static const H5I_type_t kind[] = {H5I_FILE,    H5I_GROUP, H5I_DATATYPE,   H5I_DATASPACE,
                                    H5I_DATASET, H5I_ATTR,  H5I_GENPROP_LST};
  int64_t sum = 0;
  for (size_t k = 0; k < sizeof kind / sizeof kind[0]; k++) {
    hsize_t members = 0;
    if (H5Itype_exists(kind[k]) > 0) H5Inmembers(kind[k], &members);
    sum += (int64_t)members;
  }
  return sum;
}
