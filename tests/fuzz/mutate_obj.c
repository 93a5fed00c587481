/* Mutates OBJ files line by line: lines are created, doubled, dropped, moved, and their words changed. The
 * first two bytes, which select options, are kept or changed separately. */
#include "fuzz.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed);

enum { MOST_LINES = 256, LINE_SIZE = 128, HEAD = 2 };

static uint64_t chance;

static uint64_t draw(uint64_t below) {
  chance ^= chance << 13;
  chance ^= chance >> 7;
  chance ^= chance << 17;
  return (chance >> 16) % below;
}

struct lines {
  size_t count;
  struct {
    const char *text;
    size_t length;
  } line[MOST_LINES + 1];
};

static void split(const char *text, size_t size, struct lines *lines) {
  const char *end = text + size;
  for (lines->count = 0; text < end && lines->count < MOST_LINES; lines->count++) {
    const char *stop = memchr(text, '\n', (size_t)(end - text));
    const size_t length = (size_t)((stop ? stop : end) - text);
    lines->line[lines->count].text = text;
    lines->line[lines->count].length = length;
    text += length + 1;
  }
}

static size_t join(const struct lines *lines, char *out, size_t max_size) {
  size_t used = 0;
  for (size_t k = 0; k < lines->count; k++) {
    if (used + lines->line[k].length + 1 > max_size) break;
    memcpy(out + used, lines->line[k].text, lines->line[k].length);
    used += lines->line[k].length;
    out[used++] = '\n';
  }
  return used;
}

static int64_t count_vertices(const struct lines *lines, size_t before) {
  int64_t vertices = 0;
  for (size_t k = 0; k < before; k++)
    vertices += lines->line[k].length > 2 && memcmp(lines->line[k].text, "v ", 2) == 0;
  return vertices;
}

/* ---- one line ---- */

static void write_vertex(char *line) {
  static const char *const form[] = {
      "v %d %d %d",     "v %d.5 %d %d e", "v %de-3 %d.25 %d", "v\t%d  %d %d 1.0", "v %d %d %d 0.1 0.2 0.3 # ",
      "v %d \\\n%d %d", "v +%d. .%d %d",  "v 1e%d %d %d"};
  const uint64_t which = draw(16);
  snprintf(line, LINE_SIZE, form[which < 8 ? which : 0], (int)draw(4), (int)draw(4), (int)draw(4));
}

static void write_face(char *line, int64_t vertices) {
  static const char *const form[] = {" %lld", " %lld/%lld", " %lld//%lld", " %lld/%lld/%lld"};
  const uint64_t corners = draw(8) ? 3 + (draw(4) == 0) : draw(7);
  const char *corner = form[draw(3) ? 0 : draw(4)];
  size_t used = (size_t)snprintf(line, LINE_SIZE, "f");
  for (uint64_t k = 0; k < corners && used + 40 < LINE_SIZE; k++) {
    long long number = (long long)draw((uint64_t)vertices + (draw(16) == 0) + (vertices == 0)) + 1;
    if (draw(8) == 0) number = -number;
    used += (size_t)snprintf(line + used, LINE_SIZE - used, corner, number, (long long)draw(9),
                             (long long)draw(9));
  }
}

static void write_other(char *line) {
  static const char *const other[] = {"",
                                      "# x \\",
                                      "g",
                                      "o a b",
                                      "vn 0 0 1",
                                      "vt 0.5 0.5",
                                      "s off",
                                      "usemtl x",
                                      "mtllib a.mtl",
                                      "mg 1",
                                      "vp 1",
                                      "l 1 2",
                                      "curv 1",
                                      "f",
                                      "v",
                                      "v 1 2",
                                      "v nan 0 0",
                                      "f 1 2 2147483648",
                                      "f 99999999999999999999 1 2",
                                      "f 0 1 2",
                                      "v 1e999 0 0",
                                      "v 1e-999 0 0",
                                      "f 1/2/3/4 1 2",
                                      "f -9223372036854775808 1 2",
                                      "v 0x10 0 0",
                                      "f 1.0 2 3",
                                      "\r",
                                      "v 0 0 0 1 1 1 1 1"};
  snprintf(line, LINE_SIZE, "%s", other[draw(sizeof other / sizeof other[0])]);
}

static void write_line(char *line, int64_t vertices) {
  const uint64_t what = draw(16);
  if (what < 7)
    write_vertex(line);
  else if (what < 15)
    write_face(line, vertices);
  else
    write_other(line);
}

static void change_lines(struct lines *lines, char *made) {
  const size_t at = draw(lines->count + 1), other = lines->count ? draw(lines->count) : 0;
  const uint64_t what = lines->count ? draw(8) : 7;
  if (what <= 1 && at < lines->count) { /* dropped */
    lines->count--;
    memmove(&lines->line[at], &lines->line[at + 1], (lines->count - at) * sizeof lines->line[0]);
  } else if (what == 2 && at < lines->count) { /* changed places */
    lines->line[MOST_LINES] = lines->line[at];
    lines->line[at] = lines->line[other];
    lines->line[other] = lines->line[MOST_LINES];
  } else if (lines->count < MOST_LINES) { /* created, or doubled */
    const int64_t vertices = count_vertices(lines, at);
    memmove(&lines->line[at + 1], &lines->line[at], (lines->count - at) * sizeof lines->line[0]);
    lines->count++;
    if (what == 3) {
      lines->line[at] = lines->line[other + (other >= at)];
      return;
    }
    write_line(made, vertices);
    lines->line[at].text = made;
    lines->line[at].length = strlen(made);
  }
}

/* ---- whole files ---- */

static char pool[MOST_LINES][LINE_SIZE];
static size_t pooled;

static char *new_text(void) {
  return pool[pooled++ % MOST_LINES];
}

static void append(struct lines *lines, const char *text) {
  if (lines->count >= MOST_LINES) return;
  lines->line[lines->count].text = text;
  lines->line[lines->count++].length = strlen(text);
}

static int has_only(const char *text, size_t length, const char *letters) {
  for (size_t k = 0; k < length; k++)
    if (strchr(letters, text[k]) == NULL || text[k] == '\0') return 0;
  return 1;
}

static void copy_line(const struct lines *lines, size_t k, char *text) {
  const size_t length = lines->line[k].length < LINE_SIZE - 1 ? lines->line[k].length : LINE_SIZE - 1;
  memcpy(text, lines->line[k].text, length);
  text[length] = '\0';
}

static int is_vertex(const char *text) {
  double x, y, z;
  return strncmp(text, "v ", 2) == 0 && has_only(text + 2, strlen(text + 2), "0123456789.- ") &&
         sscanf(text + 2, "%lf %lf %lf", &x, &y, &z) == 3;
}

static int is_face(const char *text, int64_t vertices, uint8_t *used) {
  long long v[3];
  if (strncmp(text, "f ", 2) != 0 || !has_only(text + 2, strlen(text + 2), "0123456789 ") ||
      sscanf(text + 2, "%lld %lld %lld", &v[0], &v[1], &v[2]) != 3)
    return 0;
  for (int k = 0; k < 3; k++)
    if (v[k] < 1 || v[k] > vertices) return 0;
  for (int k = 0; k < 3; k++)
    used[v[k]] = 1;
  return 1;
}

static char *new_face(long long a, long long b, long long c) {
  char *text = new_text();
  snprintf(text, LINE_SIZE, "f %lld %lld %lld", a, b, c);
  return text;
}

/* The rest is a file without faulty lines: plain vertices, then triangles, every vertex in one. */
static void tidy(struct lines *lines) {
  static struct lines tidied;
  static uint8_t used[MOST_LINES + 1];
  char text[LINE_SIZE];
  int64_t vertices = 0;
  tidied.count = 0;
  memset(used, 0, sizeof used);
  for (size_t k = 0; k < lines->count; k++) {
    copy_line(lines, k, text);
    if (is_vertex(text)) tidied.line[tidied.count++] = lines->line[k], vertices++;
  }
  for (; vertices < 3; vertices++) {
    char *vertex = new_text();
    snprintf(vertex, LINE_SIZE, "v %d %d %d", (int)vertices, (int)draw(3), (int)(vertices * vertices));
    append(&tidied, vertex);
  }
  for (size_t k = 0; k < lines->count && tidied.count < MOST_LINES; k++) {
    copy_line(lines, k, text);
    if (is_face(text, vertices, used)) tidied.line[tidied.count++] = lines->line[k];
  }
  for (int64_t v = 1; v <= vertices; v++) {
    if (!used[v]) append(&tidied, new_face(v, v % vertices + 1, (v + 1) % vertices + 1));
    if (!used[v]) used[v] = used[v % vertices + 1] = used[(v + 1) % vertices + 1] = 1;
  }
  *lines = tidied;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed) {
  static struct lines lines;
  chance = (uint64_t)seed * UINT64_C(0x9e3779b97f4a7c15) + 1;
  draw(2);
  if (size < HEAD || max_size < 64 || draw(16) == 0) return LLVMFuzzerMutate(data, size, max_size);
  if (draw(4) == 0) data[draw(HEAD)] = (uint8_t)draw(256);
  char made[4][LINE_SIZE], *out = malloc(max_size);
  if (out == NULL) return size;
  split((const char *)data + HEAD, size - HEAD, &lines);
  for (uint64_t k = draw(4) + 1; k > 0; k--)
    change_lines(&lines, made[k - 1]);
  if (draw(3)) tidy(&lines);
  const size_t length = join(&lines, out, max_size - HEAD);
  memcpy(data + HEAD, out, length);
  free(out);
  return HEAD + length;
}
