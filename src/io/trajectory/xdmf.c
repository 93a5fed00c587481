/* The companion of a trajectory for ParaView: XML that locates the arrays in the HDF5 file. */
#include "core/keep_errno.h"
#include "core/memory.h"
#include "core/number.h"
#include "core/os/os.h"
#include "core/os/os_file.h"
#include "core/print.h"
#include "core/status.h"
#include "hooke/trajectory.h"
#include "io/hdf5/array_h5.h"
#include "io/file/atomic_file.h"
#include "io/file/inputs.h"
#include "io/trajectory/record.h"
#include "io/file/text.h"

#include <ctype.h>
#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

struct companion {
  const hooke_record *record;
  char *file;                            /* name of the trajectory in the companion, as XML */
  long long particles, springs, planned; /* planned frames */
  int32_t has_rest_length;
  struct hk_text text;
};

static void add(struct hk_text *text, const char *format, ...) __attribute__((format(printf, 2, 3)));

static void add(struct hk_text *text, const char *format, ...) {
  char piece[512];
  va_list args;
  va_start(args, format);
  const int length = hk_print_list(piece, sizeof piece, format, args);
  va_end(args);
  hk_text_add(text, piece, length < (int)sizeof piece ? length : (int)sizeof piece - 1);
}

/* ---- elements ---- */

/* An array of the file: its path, and its size in the syntax of XDMF. */
static void add_array(struct companion *c, const char *type, int bytes, const char *size, const char *path) {
  add(&c->text, "<DataItem Format=\"HDF\" NumberType=\"%s\" Precision=\"%d\" Dimensions=\"%s\">", type, bytes,
      size);
  hk_text_say(&c->text, c->file);
  add(&c->text, ":%s</DataItem>", path);
}

/* One frame of an array of frames. VTK identifies frames by their first words here, so a comment with the
 * number makes these unique. */
static void add_slab(struct companion *c, int64_t frame, const char *path) {
  char size[96];
  snprintf(size, sizeof size, "%lld %lld 3", c->planned, c->particles);
  add(&c->text,
      "<DataItem ItemType=\"HyperSlab\" Dimensions=\"%lld 3\"><!-- frame %lld -->"
      "<DataItem Format=\"XML\" Dimensions=\"3 3\">%lld 0 0 1 1 1 1 %lld 3</DataItem>",
      c->particles, (long long)frame, (long long)frame, c->particles);
  add_array(c, "Float", 8, size, path);
  add(&c->text, "</DataItem>");
}

static void add_column(struct companion *c, const char *name, const char *center, const char *type, int bytes,
                       long long count, const char *path) {
  char size[32];
  snprintf(size, sizeof size, "%lld", count);
  add(&c->text, "  <Attribute Name=\"%s\" AttributeType=\"Scalar\" Center=\"%s\">", name, center);
  add_array(c, type, bytes, size, path);
  add(&c->text, "</Attribute>\n");
}

static void add_topology(struct companion *c) {
  char size[64];
  if (c->springs == 0) {
    add(&c->text, "  <Topology TopologyType=\"Polyvertex\" NumberOfElements=\"%lld\"/>\n", c->particles);
    return;
  }
  snprintf(size, sizeof size, "%lld 2", c->springs);
  add(&c->text, "  <Topology TopologyType=\"Polyline\" NodesPerElement=\"2\" NumberOfElements=\"%lld\">",
      c->springs);
  add_array(c, "Int", 4, size, "/connectivity/springs");
  add(&c->text, "</Topology>\n");
}

static void add_frame(struct companion *c, int64_t frame) {
  char time[HOOKE_NUMBER_SIZE];
  hk_number_print(c->record->time[frame], time);
  add(&c->text, "<Grid Name=\"springs\">\n  <Time Value=\"%s\"/>\n", time);
  add_topology(c);
  add(&c->text, "  <Geometry GeometryType=\"XYZ\">");
  add_slab(c, frame, "/particles/all/position/value");
  add(&c->text, "</Geometry>\n  <Attribute Name=\"velocity\" AttributeType=\"Vector\" Center=\"Node\">");
  add_slab(c, frame, "/particles/all/velocity/value");
  add(&c->text, "</Attribute>\n");
  add_column(c, "mass", "Node", "Float", 8, c->particles, "/particles/all/mass");
  add_column(c, "species", "Node", "Int", 4, c->particles, "/particles/all/species");
  if (c->has_rest_length && c->springs > 0)
    add_column(c, "rest_length", "Cell", "Float", 8, c->springs, "/hooke/rest_length");
  add(&c->text, "</Grid>\n");
}

static void add_all(struct companion *c) {
  add(&c->text, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<Xdmf Version=\"2.0\">\n<Domain>\n"
                "<Grid Name=\"trajectory\" GridType=\"Collection\" CollectionType=\"Temporal\">\n");
  for (int64_t k = 0; k < hooke_record_count(c->record, "frames"); k++)
    add_frame(c, k);
  add(&c->text, "</Grid>\n</Domain>\n</Xdmf>\n");
}

/* ---- names ---- */

/* `name` as XML. */
static char *quote(const char *name) {
  static const char special[] = "&<>\"'";
  const size_t longest = 6; /* &quot; */
  char *quoted = hk_new((int64_t)(longest * strlen(name)) + 1, 1), *at = quoted;
  for (; quoted && *name; name++) {
    if (strchr(special, *name))
      at += snprintf(at, longest + 1, "&#%d;", *name);
    else
      *at++ = *name;
  }
  return quoted;
}

/* The reader drops other bytes, interprets everything before the first colon as a file type, and trims
 * blanks. */
static int32_t check_name(const char *name) {
  int fits = !isspace((unsigned char)name[0]);
  for (const char *at = name; *at; at++)
    fits = fits && *at >= ' ' && *at <= '~' && *at != ':';
  return fits ? HOOKE_OK
              : hk_fail(HOOKE_BAD_VALUE, NULL,
                        "ParaView's reader of XDMF cannot take the name "
                        "of this trajectory; allowed: ASCII without colons");
}

/* Name of the trajectory in the companion at `path`: relative if both are in the same folder, else absolute.
 */
static int32_t find_name(struct companion *c, const char *path) {
  HOOKE_KEEP_ERRNO;
  const char *there = hk_record_path(c->record), *slash = hk_os_last_slash(there),
             *own = hk_os_last_slash(path);
  const int64_t folder = slash ? slash - there : -1;
  char *real = NULL;
  const char *name = slash ? slash + 1 : there;
  if (folder != (own ? own - path : -1) || (slash && strncmp(there, path, (size_t)folder) != 0)) {
    real = hk_os_real_path(there);
    if (real == NULL) return hk_file_fail(there, "follow the path", errno);
    name = real;
  }
  int32_t status = check_name(name);
  if (status == HOOKE_OK) c->file = quote(name);
  if (status == HOOKE_OK && c->file == NULL) status = HOOKE_NO_MEMORY;
  hk_os_free(real);
  return status;
}

/* The name beside the trajectory, which the caller frees. */
static int32_t name_beside(const char *there, char **name) {
  static const char *const endings[] = {".h5", ".hdf5", ".h5md"};
  const size_t length = strlen(there);
  size_t stem = length;
  for (size_t k = 0; k < sizeof endings / sizeof endings[0]; k++) {
    const size_t ending = strlen(endings[k]);
    if (length > ending && strcmp(there + length - ending, endings[k]) == 0) stem = length - ending;
  }
  char *begin = hk_copy_text(there);
  *name = NULL;
  if (begin == NULL) return HOOKE_NO_MEMORY;
  begin[stem] = '\0';
  const int32_t status = hk_file_beside(begin, ".xdmf", name);
  hk_free(begin);
  return status;
}

/* A default name replaces no file but an older companion. */
static int32_t check_replaced(const char *path) {
  static const char head[] = "<?xml";
  char begin[sizeof head] = {0};
  const int descriptor = hk_os_open(path);
  if (descriptor < 0) return errno == ENOENT ? HOOKE_OK : hk_file_fail(path, "look what is there", errno);
  const int64_t got = hk_os_read_at(descriptor, 0, sizeof head - 1, begin);
  const int error = errno;
  close(descriptor);
  if (got < 0) return hk_file_fail(path, "look what is there", error);
  return got == 0 || strcmp(begin, head) == 0
             ? HOOKE_OK
             : hk_fail(HOOKE_BAD_VALUE, NULL, "%s: is there already and is no XDMF; it is left as it is",
                       path);
}

/* ---- whole file ---- */

static int32_t read_size(const char *path, const char *dataset, long long *rows) {
  double *values = NULL;
  int64_t high = 0, wide = 0;
  const int32_t status = hk_array_read(path, dataset, 0, 0, &values, &high, &wide);
  hk_free(values);
  *rows = high;
  return status;
}

static int32_t read_sizes(struct companion *c) {
  const char *path = hk_record_path(c->record);
  long long lengths;
  c->planned = c->record->frames.frame_count;
  c->particles = c->record->frames.particle_count;
  if (c->planned < hooke_record_count(c->record, "frames") || c->particles < 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: its arrays of frames do not belong together", path);
  int32_t status = read_size(path, "/connectivity/springs", &c->springs);
  if (status != HOOKE_OK) return status;
  status = read_size(path, "/hooke/rest_length", &lengths);
  c->has_rest_length = status == HOOKE_OK;
  return status == HOOKE_NO_MEMORY ? status : HOOKE_OK;
}

int32_t hooke_record_write_xdmf(const hooke_record *record, const char *path) {
  const char *there = hk_record_path(record);
  struct companion c = {.record = record};
  if (hooke_record_count(record, "frames") == 0)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "%s: has no frames yet", there);
  char *beside = NULL;
  int32_t status = path ? HOOKE_OK : name_beside(there, &beside);
  const char *name = path ? path : beside;
  if (status == HOOKE_OK) status = path ? hk_input_refuse(there, name) : check_replaced(name);
  if (status == HOOKE_OK) status = find_name(&c, name);
  if (status == HOOKE_OK) status = read_sizes(&c);
  if (status == HOOKE_OK) {
    add_all(&c);
    status = c.text.status;
  }
  if (status == HOOKE_OK) status = hk_file_write(name, c.text.bytes, c.text.length);
  hk_text_release(&c.text);
  hk_free(c.file);
  hk_free(beside);
  return status;
}
