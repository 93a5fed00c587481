#include "file_copy.h"

#include "check.h"

#include <stdio.h>

void copy_file(const char *from, const char *to) {
  char block[4096];
  FILE *in = fopen(from, "rb"), *out = fopen(to, "wb");
  assert_non_null(in);
  assert_non_null(out);
  for (size_t n; (n = fread(block, 1, sizeof block, in)) > 0;)
    assert_int_equal(fwrite(block, 1, n, out), n);
  fclose(in);
  assert_int_equal(fclose(out), 0);
}
