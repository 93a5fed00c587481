/* Of every program that has no main() of its own. */
#include "check.h"

int main(void) {
  return check_run_tests();
}
