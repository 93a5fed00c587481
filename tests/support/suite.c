#include "check.h"

enum { MOST_TESTS = 100 };

/* In the order of the file; cmocka passes over places that are empty. */
static struct CMUnitTest tests[MOST_TESTS];
static CMFixtureFunction before_each, after_each, before_all, after_all;

void check_add_test(int32_t place, const char *name, CMUnitTestFunction test) {
  if (place >= MOST_TESTS) check_failed("%s is one test too many for a program", name);
  tests[place] = (struct CMUnitTest){.name = name, .test_func = test};
}

void check_around_each(CMFixtureFunction set_up, CMFixtureFunction tear_down) {
  before_each = set_up;
  after_each = tear_down;
}

void check_around_all(CMFixtureFunction set_up, CMFixtureFunction tear_down) {
  before_all = set_up;
  after_all = tear_down;
}

int check_run_tests(void) {
  for (int k = 0; k < MOST_TESTS; k++) {
    tests[k].setup_func = before_each;
    tests[k].teardown_func = after_each;
  }
  return cmocka_run_group_tests(tests, before_all, after_all);
}
