/* The check value of files compared with its definition, bit by bit, and with the published value. */
#include "core/crc32.h"

#include "check.h"
#include "random.h"

static uint32_t by_definition(uint32_t start, const unsigned char *bytes, int64_t count) {
  uint32_t rest = ~start;
  for (int64_t k = 0; k < count; k++) {
    rest ^= bytes[k];
    for (int bit = 0; bit < 8; bit++)
      rest = rest & 1 ? rest >> 1 ^ 0xedb88320u : rest >> 1;
  }
  return ~rest;
}

TEST(agrees_with_the_definition) {
  enum { MOST = 300 };
  struct random_source random = {1};
  unsigned char bytes[MOST + 8];
  assert_int_equal(hk_crc32(0, "123456789", 9), 0xcbf43926u);
  assert_int_equal(hk_crc32(0, "", 0), 0);
  for (int k = 0; k < MOST + 8; k++)
    bytes[k] = (unsigned char)random_whole(&random, 0, 255);
  for (int64_t count = 0; count <= MOST; count++) {
    const int64_t place = count % 8; /* at every distance from a multiple of 8 */
    assert_int_equal(hk_crc32(0, bytes + place, count), by_definition(0, bytes + place, count));
  }
}

TEST(goes_on_where_it_stopped) {
  enum { COUNT = 100 };
  unsigned char bytes[COUNT];
  for (int k = 0; k < COUNT; k++)
    bytes[k] = (unsigned char)(k * k + 3);
  const uint32_t whole = hk_crc32(0, bytes, COUNT);
  for (int64_t cut = 0; cut <= COUNT; cut++)
    assert_int_equal(hk_crc32(hk_crc32(0, bytes, cut), bytes + cut, COUNT - cut), whole);
}
