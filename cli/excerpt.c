#include "excerpt.h"
#include "hooke.h"
#include "print.h"

#include <stdlib.h>
#include <string.h>

enum { WIDTH = 90, LEFT = 60, LONGEST_CHARACTER = 4 };

/* The numbers after the path; 0 if they are not there. */
static int find_place(const char *path, const char *message, long *line, long *column) {
  const size_t length = strlen(path);
  if (strncmp(message, path, length) != 0 || message[length] != ':') return 0;
  char *end;
  *line = strtol(message + length + 1, &end, 10);
  if (*end != ':') return 0;
  *column = strtol(end + 1, &end, 10);
  return *line > 0 && *column > 0 && *end == ':';
}

static int is_continuation(int byte) {
  return (byte & 0xc0) == 0x80; /* of a character of UTF-8 */
}

static void skip_lines(FILE *from, long count) {
  for (int byte; count > 0 && (byte = getc(from)) != EOF;)
    count -= byte == '\n';
}

/* The characters `first` (from 1) to first + WIDTH - 1 of a line. */
static void read_line(FILE *from, long first, char *text) {
  long character = 0;
  for (int byte; (byte = getc(from)) != EOF && byte != '\n' && byte != '\r' && byte != '\0';) {
    character += !is_continuation(byte);
    if (character >= first + WIDTH) break;
    if (character >= first) *text++ = (char)(byte == '\t' ? ' ' : byte);
  }
  *text = '\0';
}

/* Of a trajectory, the text of its scene. */
static FILE *open_source(const char *path) {
  hooke_record *record;
  if (hooke_record_open(path, &record) != HOOKE_OK) return fopen(path, "rb");
  FILE *file = tmpfile();
  if (file) fputs(hooke_record_text(record, "scene"), file);
  if (file) rewind(file);
  hooke_record_close(record);
  return file;
}

void cli_excerpt_print(FILE *file, const char *path, const char *message) {
  char text[LONGEST_CHARACTER * WIDTH + 1];
  long line, column;
  if (!find_place(path, message, &line, &column)) return;
  FILE *from = open_source(path);
  if (!from) return;
  const long first = column > LEFT ? column - LEFT : 1;
  skip_lines(from, line - 1);
  read_line(from, first, text);
  fclose(from);
  fprintf(file, "%6ld | ", line);
  cli_print_text(file, text);
  fprintf(file, "\n       | %*s", (int)(column - first), "");
  cli_print_styled(file, HOOKE_GREEN, "^");
  fputc('\n', file);
}
