/* Mutates options line by line: a line gets a value that some option accepts, is dropped, or is added. */
#include "fuzz.h"

#include "random.h"

#include <stdio.h>
#include <string.h>

size_t LLVMFuzzerMutate(uint8_t *data, size_t size, size_t max_size);
size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed);

enum { HEAD = 2, VALUE_SIZE = 64 };

/* Without a line break. */
static void draw_value(struct random_source *state, char value[VALUE_SIZE]) {
  static const char *const texts[] = {"1",       "2",         "0.5",    "1e-3",  "0",       "3",
                                      "true",    "false",     "verlet", "rk4",   "strain",  "length",
                                      "1,2",     "0,-9.81,0", "start",  "end",   "start,3", "0,1,2",
                                      "regular", "",          "none",   "2,3,4", "#",       "?"};
  static const char *const units[] = {"", "", "", "mm", "ms", " cm", " m", "s", "us", " h", "in"};
  const uint64_t kind = random_bits(state) % 4;
  const double number = (double)(random_bits(state) % 2000) / (double)(1 + random_bits(state) % 100);
  const char *unit = units[random_bits(state) % (sizeof units / sizeof units[0])];
  if (kind == 0)
    snprintf(value, VALUE_SIZE, "%.*g%s", (int)(1 + random_bits(state) % 17), number, unit);
  else if (kind == 1)
    snprintf(value, VALUE_SIZE, "%g,%g,%g", number, 0.5 * number, 1.0 + number);
  else
    snprintf(value, VALUE_SIZE, "%s", texts[random_bits(state) % (sizeof texts / sizeof texts[0])]);
}

/* Replaces the bytes from `begin` to `end` by a line with the first byte of the old one, or another; 0 if it
 * is too long. */
static size_t put_line(struct random_source *state, uint8_t *data, size_t size, size_t begin, size_t end,
                       size_t most) {
  char line[VALUE_SIZE + 1];
  draw_value(state, line + 1);
  line[0] = begin < end && random_bits(state) % 4 ? (char)data[begin] : (char)(32 + random_bits(state) % 96);
  const size_t length = strlen(line + 1) + 1;
  if (size - (end - begin) + length > most) return 0;
  memmove(data + begin + length, data + end, size - end);
  memcpy(data + begin, line, length);
  return size - (end - begin) + length;
}

size_t LLVMFuzzerCustomMutator(uint8_t *data, size_t size, size_t max_size, unsigned int seed) {
  struct random_source state = {seed};
  if (size < HEAD + 1 || random_bits(&state) % 3 == 0) return LLVMFuzzerMutate(data, size, max_size);
  if (random_bits(&state) % 8 == 0) data[random_bits(&state) % HEAD] = (uint8_t)random_bits(&state);
  size_t begin = HEAD + random_bits(&state) % (size - HEAD), end;
  while (begin > HEAD && data[begin - 1] != '\n')
    begin--;
  const uint8_t *found = memchr(data + begin, '\n', size - begin);
  end = found ? (size_t)(found - data) : size;
  if (random_bits(&state) % 4 == 0 && found) { /* the line is dropped */
    memmove(data + begin, data + end + 1, size - end - 1);
    return size - (end + 1 - begin);
  }
  if (random_bits(&state) % 4 == 0 && size < max_size) { /* one in front of it */
    memmove(data + begin + 1, data + begin, size - begin);
    data[begin] = '\n';
    size++;
    end = begin;
  }
  const size_t length = put_line(&state, data, size, begin, end, max_size);
  return length > 0 ? length : LLVMFuzzerMutate(data, size, max_size);
}
