#include "file_limit.h"

#include "check.h"

#include <signal.h>
#include <sys/resource.h>

static void set_limit(rlim_t size) {
  struct rlimit limit;
  assert_int_equal(getrlimit(RLIMIT_FSIZE, &limit), 0);
  limit.rlim_cur = size;
  signal(SIGXFSZ, SIG_IGN);
  assert_int_equal(setrlimit(RLIMIT_FSIZE, &limit), 0);
}

void limit_files(int64_t size) {
  set_limit((rlim_t)size);
}

void lift_file_limit(void) {
  set_limit(RLIM_INFINITY);
}
