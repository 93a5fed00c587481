/* v and f with all forms of corners, negative numbers and polygons; continued lines; any line ends.
 * Statements that do not concern the surface are ignored; those whose loss would change it are refused. */
#include "io/scene/obj.h"

#include "core/memory.h"
#include "core/number.h"
#include "core/table/option.h"
#include "core/status.h"

#include <string.h>

static const char allowed[] =
    "allowed: v and f; vt, vn, vp, g, o, s, mg, usemtl, mtllib and comments are passed over";

struct reader {
  const char *at, *end;
  int64_t line;
  struct hk_obj *obj;
};

/* A word of a line. */
struct word {
  const char *text;
  int64_t length;
};

/* ---- words ---- */

/* Characters of the end of a line at a place: LF, CR LF or CR; 0 if none is there. */
static int64_t line_end(const char *at, const char *end) {
  if (at >= end || (*at != '\n' && *at != '\r')) return 0;
  return *at == '\r' && at + 1 < end && at[1] == '\n' ? 2 : 1;
}

/* The same of a blank, which a backslash at the end of a line is, too, as it continues the line. */
static int64_t blank(const struct reader *reader) {
  if (reader->at == reader->end) return 0;
  if (*reader->at == ' ' || *reader->at == '\t') return 1;
  const int64_t after = *reader->at == '\\' ? line_end(reader->at + 1, reader->end) : 0;
  return after > 0 ? 1 + after : 0;
}

static void skip(struct reader *reader, int64_t count) {
  reader->line += count > 1;
  reader->at += count;
}

/* The next word of the line; 0 at its end, or at a comment. */
static int next_word(struct reader *reader, struct word *word) {
  while (blank(reader))
    skip(reader, blank(reader));
  word->text = reader->at;
  while (reader->at < reader->end && !line_end(reader->at, reader->end) && !blank(reader) &&
         *word->text != '#')
    reader->at++;
  word->length = reader->at - word->text;
  return word->length > 0;
}

/* A comment ends with its line, even after a backslash. */
static void skip_line(struct reader *reader) {
  const int comment = reader->at < reader->end && *reader->at == '#';
  while (reader->at < reader->end && !line_end(reader->at, reader->end))
    skip(reader, !comment && blank(reader) ? blank(reader) : 1);
}

static int is(const struct word *word, const char *words) {
  return hk_option_has_word(words, word->text, word->length);
}

static int32_t refuse(const struct word *word, const char *what) {
  char shown[HOOKE_OPTION_SHOWN];
  hk_option_show(word->text, word->length, shown);
  return hk_fail(HOOKE_BAD_VALUE, NULL, "\"%s\" is not allowed; %s", shown, what);
}

/* ---- growing lists ---- */

/* Adds a row of `size` bytes and its line; `what` there are too many of beyond `most`. */
static int32_t add_row(void **rows, int32_t **lines, int64_t *count, int64_t *capacity, const void *row,
                       size_t size, int64_t line, int64_t most, const char *what) {
  if (*count == most)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "one %s too many; allowed: up to %lld", what, (long long)most);
  if (*count == *capacity) {
    const int64_t wanted = *capacity > 0 ? 2 * *capacity : 1024;
    int32_t status = hk_grow(rows, *count, wanted, size);
    if (status == HOOKE_OK) status = hk_grow((void **)lines, *count, wanted, sizeof **lines);
    if (status != HOOKE_OK) return status;
    *capacity = wanted;
  }
  memcpy((char *)*rows + (size_t)*count * size, row, size);
  (*lines)[(*count)++] = (int32_t)line;
  return HOOKE_OK;
}

static int32_t add_triangle(struct hk_obj *obj, int64_t a, int64_t b, int64_t c, int64_t line) {
  const int64_t corner[3] = {a, b, c};
  return add_row((void **)&obj->triangle, &obj->triangle_line, &obj->triangle_count, &obj->triangle_capacity,
                 corner, sizeof corner, line, INT32_MAX / 3, "triangle");
}

/* ---- elements ---- */

/* Three coordinates; a weight and a colour may follow. */
static int32_t read_vertex(struct reader *reader, int64_t line) {
  double number[7];
  int count = 0;
  for (struct word word; next_word(reader, &word); count++) {
    if (count == 7) return refuse(&word, "allowed: x y z, which a weight and a colour may follow");
    const enum hk_number_result result = hk_number_parse(word.text, word.length, &number[count]);
    if (result == HOOKE_NUMBER_NO_MEMORY) return HOOKE_NO_MEMORY;
    if (result != HOOKE_NUMBER_FINE) return refuse(&word, "allowed: a finite decimal number");
  }
  if (count < 3)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "a vertex of %d numbers; allowed: x y z, three numbers", count);
  struct hk_obj *obj = reader->obj;
  return add_row((void **)&obj->vertex, &obj->vertex_line, &obj->vertex_count, &obj->vertex_capacity, number,
                 3 * sizeof *number, line, INT32_MAX, "vertex");
}

/* The vertex of a corner v, v/vt, v//vn or v/vt/vn; negative numbers count back from the last vertex so
 * far. */
static int32_t read_corner(const struct reader *reader, const struct word *word, int64_t *vertex) {
  static const char form[] = "allowed: v, v/vt, v//vn or v/vt/vn, whole numbers";
  const int64_t count = reader->obj->vertex_count;
  int64_t k = 0, number = 0, digits = 0, slashes = 0;
  const int negative = word->text[0] == '-';
  for (k = negative; k < word->length && word->text[k] >= '0' && word->text[k] <= '9'; k++, digits++) {
    if (number < (int64_t)1 << 40) number = 10 * number + (word->text[k] - '0');
  }
  for (int64_t rest = k; rest < word->length; rest++) {
    slashes += word->text[rest] == '/';
    if (memchr("0123456789-/", word->text[rest], 12) == NULL || word->text[k] != '/')
      return refuse(word, form);
  }
  if (digits == 0 || slashes > 2) return refuse(word, form);
  *vertex = negative ? count - number : number - 1;
  if (number > 0 && number <= count) return HOOKE_OK;
  if (count == 0) return refuse(word, "there is no vertex before this line");
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "there is no vertex %s%lld yet; allowed: 1 to %lld, or -1 to -%lld from the last one back",
                 negative ? "-" : "", (long long)number, (long long)count, (long long)count);
}

static int32_t read_face(struct reader *reader, int64_t line) {
  int64_t first = 0, before = 0, vertex = 0, corners = 0;
  int32_t status = HOOKE_OK;
  for (struct word word; status == HOOKE_OK && next_word(reader, &word); corners++) {
    status = read_corner(reader, &word, &vertex);
    if (status != HOOKE_OK) return status;
    if (corners == 0) first = vertex;
    if (corners >= 2) status = add_triangle(reader->obj, first, before, vertex, line);
    before = vertex;
  }
  if (status == HOOKE_OK && corners < 3)
    return hk_fail(HOOKE_BAD_VALUE, NULL, "a face of %lld corners; allowed: three or more",
                   (long long)corners);
  return status;
}

static int32_t read_line(struct reader *reader) {
  struct word word;
  int32_t status = HOOKE_OK;
  const int found = next_word(reader, &word);
  const int64_t line = reader->line;
  if (found && is(&word, "v"))
    status = read_vertex(reader, line);
  else if (found && is(&word, "f"))
    status = read_face(reader, line);
  else if (found && !is(&word, "vt vn vp g o s mg usemtl mtllib"))
    status = refuse(&word, allowed);
  if (status != HOOKE_OK) reader->line = line;
  skip_line(reader);
  return status;
}

int32_t hk_obj_parse(const char *text, int64_t length, struct hk_obj *obj, int64_t *line) {
  struct reader reader = {.at = text, .end = text + length, .line = 1, .obj = obj};
  *obj = (struct hk_obj){.vertex_count = 0};
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK && reader.at < reader.end) {
    status = read_line(&reader);
    if (status == HOOKE_OK && reader.at < reader.end) {
      reader.at += line_end(reader.at, reader.end);
      reader.line++;
    }
  }
  *line = reader.line;
  if (status != HOOKE_OK || obj->triangle_count > 0) return status;
  return hk_fail(HOOKE_BAD_VALUE, NULL,
                 "the file ends with %lld vertices and no face; allowed: faces, lines \"f 1 2 3\"",
                 (long long)obj->vertex_count);
}

/* A vertex takes a line; a triangle takes at least a blank before its last corner. */
double hk_obj_bytes(const char *text, int64_t length) {
  static const double per_vertex = 200.0, per_triangle = 340.0;
  double vertices = 0.0, triangles = 0.0;
  int in_face = 0;
  for (int64_t k = 0; k < length; k++) {
    const int starts = k == 0 || line_end(text + k - 1, text + length) > 0;
    const int blank = text[k] == ' ' || text[k] == '\t' || text[k] == '\\';
    if (starts && !(k > 1 && memchr(text + (k > 2 ? k - 3 : 0), '\\', (size_t)(k > 2 ? 3 : k))) && !blank)
      in_face = text[k] == 'f';
    if (starts && blank) in_face = 1; /* in the worst case */
    vertices += text[k] == 'v';
    triangles += in_face && blank;
  }
  return per_vertex * vertices + per_triangle * triangles + 3.0 * (double)length;
}

void hk_obj_release(struct hk_obj *obj) {
  hk_free(obj->vertex);
  hk_free(obj->triangle);
  hk_free(obj->vertex_line);
  hk_free(obj->triangle_line);
  *obj = (struct hk_obj){.vertex_count = 0};
}
