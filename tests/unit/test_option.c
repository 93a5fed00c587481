/* Option tables: accepted values, refusals and their messages, defaults, families, copies. */
#include "check.h"

#include "core/number.h"
#include "core/table/option.h"

#include <locale.h>
#include <math.h>
#include <string.h>

static const struct hk_option_row family_rows[] = {
    {.name = "stiffness",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "N",
     .high = 1e300,
     .min_count = 1,
     .required = 1},
    {.name = "damping",
     .type = HOOKE_OPTION_NUMBERS,
     .unit = "N s",
     .high = 1e300,
     .min_count = 1,
     .fallback = "0"},
    {.name = "compression", .type = HOOKE_OPTION_FLAG, .fallback = "true"},
};
static const struct hk_option_table family = {"springs", HOOKE_OPTION_ROWS(family_rows)};

static const struct hk_option_row rows[] = {
    {.name = "step",
     .type = HOOKE_OPTION_NUMBER,
     .unit = "s",
     .high = 10,
     .above_low = 1,
     .doc = "length of a step",
     .example = "0.1"},
    {.name = "law", .type = HOOKE_OPTION_CHOICE, .words = "strain length", .fallback = "strain"},
    {.name = "gravity", .type = HOOKE_OPTION_NUMBERS, .unit = "m/s^2", .min_count = 3, .max_count = 3},
    {.name = "rest_length",
     .type = HOOKE_OPTION_NUMBERS,
     .high = 1e300,
     .min_count = 1,
     .words = "initial",
     .fallback = "initial"},
    {.name = "edges", .type = HOOKE_OPTION_NUMBERS, .min_count = 6, .max_count = 6, .columns = 3},
    {.name = "pinned",
     .type = HOOKE_OPTION_NUMBERS,
     .whole = 1,
     .high = 2147483647,
     .words = "start end",
     .word_lists = 1},
    {.name = "order", .type = HOOKE_OPTION_NUMBER, .whole = 1, .low = 1, .high = 12, .fallback = "5"},
    {.name = "title", .type = HOOKE_OPTION_TEXT},
    {.name = "quick", .type = HOOKE_OPTION_FLAG},
    {.name = "structural", .type = HOOKE_OPTION_FAMILY, .family = &family},
    {.name = "shear", .type = HOOKE_OPTION_FAMILY, .family = &family},
    {.name = "size",
     .type = HOOKE_OPTION_NUMBERS,
     .whole = 1,
     .low = 1,
     .high = 99,
     .min_count = 2,
     .max_count = 3},
    {.name = "velocity", .type = HOOKE_OPTION_NUMBERS, .unit = "m/s", .min_count = 2, .columns = 2},
};
static const struct hk_option_table table = {"thing", HOOKE_OPTION_ROWS(rows)};

static int setup(void **state) {
  return hk_options_create(&table, (hooke_options **)state);
}

static int teardown(void **state) {
  hooke_options_destroy(*state);
  return 0;
}

/* ---- numbers as text ---- */

static enum hk_number_result parse(const char *text, double *value) {
  return hk_number_parse(text, (int64_t)strlen(text), value);
}

TEST(decimal_numbers_are_read) {
  static const struct {
    const char *text;
    double value;
  } good[] = {
      {"0", 0},
      {"-0.0", -0.0},
      {"1", 1},
      {"+1.5", 1.5},
      {".5", .5},
      {"5.", 5},
      {"1e-3", 1e-3},
      {"-9.81E+0", -9.81},
      {"1e308", 1e308},
      {"4.94e-324", 5e-324},
      {"1e-310", 1e-310},
      {"0e-99999", 0},
      {"0.1000000000000000055511151231257827021181583404541015625000000000000000000000000000000000000001",
       0.1}};
  for (size_t k = 0; k < sizeof good / sizeof good[0]; k++) {
    double value = 7;
    assert_int_equal(parse(good[k].text, &value), HOOKE_NUMBER_FINE);
    check_same_bits(1, &value, &good[k].value);
  }
}

TEST(other_texts_are_no_numbers) {
  static const char *const junk[] = {"",    "-",   ".",    "e5",       "1e",    "1e+",   "nan",
                                     "NaN", "inf", "-inf", "infinity", "0x10",  "1,5",   "1.2.3",
                                     "1 ",  " 1",  "1f",   "--1",      "1e5.5", "1_000", "0x1p3"};
  double value = 7;
  for (size_t k = 0; k < sizeof junk / sizeof junk[0]; k++)
    if (parse(junk[k], &value) != HOOKE_NUMBER_JUNK) check_failed("\"%s\" was read as a number", junk[k]);
  assert_int_equal(parse("1e309", &value), HOOKE_NUMBER_TOO_LARGE);
  assert_int_equal(parse("-1e999", &value), HOOKE_NUMBER_TOO_LARGE);
  assert_int_equal(parse("1e-999", &value), HOOKE_NUMBER_TOO_SMALL);
  assert_int_equal(parse("-0.01e-400", &value), HOOKE_NUMBER_TOO_SMALL);
  assert_true(value == 7);
}

TEST(printed_numbers_read_back) {
  static const double values[] = {
      0.1, 1.0 / 3, 1e22, 123456789012345680, 5e-324, -2.5, 1.7976931348623157e308};
  char text[HOOKE_NUMBER_SIZE];
  for (size_t k = 0; k < sizeof values / sizeof values[0]; k++) {
    double value = 0;
    hk_number_print(values[k], text);
    assert_int_equal(parse(text, &value), HOOKE_NUMBER_FINE);
    check_same_bits(1, &value, &values[k]);
  }
  hk_number_print(0.1, text);
  assert_string_equal(text, "0.1");
}

/* With a comma locale, if the machine has one, nothing changes. */
TEST(locale_does_not_matter) {
  static const char *const names[] = {"de_DE.UTF-8", "de_DE.utf8", "de_DE", "fr_FR.UTF-8", "nl_NL.UTF-8"};
  const char *found = NULL;
  for (size_t k = 0; !found && k < sizeof names / sizeof names[0]; k++)
    found = setlocale(LC_NUMERIC, names[k]);
  double value = 0;
  char text[HOOKE_NUMBER_SIZE];
  enum hk_number_result result = parse("-2.5e-1", &value);
  enum hk_number_result comma = parse("2,5", &value);
  hk_number_print(-0.25, text);
  setlocale(LC_NUMERIC, "C");
  assert_int_equal(result, HOOKE_NUMBER_FINE);
  assert_int_equal(comma, HOOKE_NUMBER_JUNK);
  assert_true(value == -0.25);
  assert_string_equal(text, "-0.25");
}

/* ---- values ---- */

TEST(defaults_are_there_and_unset) {
  hooke_options *o = *prepared;
  assert_string_equal(hooke_options_text(o, "law"), "strain");
  assert_string_equal(hooke_options_text(o, "rest_length"), "initial");
  assert_int_equal(hooke_options_number_count(o, "rest_length"), 0);
  assert_true(hooke_options_numbers(o, "rest_length") == NULL);
  check_close(hooke_options_number(o, "order"), 5, 0);
  assert_true(isnan(hooke_options_number(o, "step")));
  assert_int_equal(hooke_options_is_set(o, "order"), 0);
  assert_int_equal(hooke_options_is_set(o, "nothing"), 0);
  check_ok(hooke_options_set_number(o, "order", 2));
  check_close(hooke_options_number(o, "order"), 2, 0);
  assert_int_equal(hooke_options_is_set(o, "order"), 1);
  check_ok(hooke_options_unset(o, "order"));
  check_close(hooke_options_number(o, "order"), 5, 0);
  assert_int_equal(hooke_options_is_set(o, "order"), 0);
  check_status(hooke_options_unset(o, "ordr"), HOOKE_BAD_VALUE);
}

TEST(texts_set_every_type) {
  hooke_options *o = *prepared;
  check_ok(hooke_options_set_text(o, "step", "1e-3"));
  check_close(hooke_options_number(o, "step"), 1e-3, 0);
  check_ok(hooke_options_set_text(o, "gravity", "0,-9.81, 0"));
  assert_int_equal(hooke_options_number_count(o, "gravity"), 3);
  check_close(hooke_options_numbers(o, "gravity")[1], -9.81, 0);
  check_ok(hooke_options_set_text(o, "gravity", "1 2 3"));
  check_close(hooke_options_numbers(o, "gravity")[2], 3, 0);
  check_ok(hooke_options_set_text(o, "law", "length"));
  assert_string_equal(hooke_options_text(o, "law"), "length");
  check_ok(hooke_options_set_text(o, "title", "a, b \xc3\xa9"));
  assert_string_equal(hooke_options_text(o, "title"), "a, b \xc3\xa9");
  check_ok(hooke_options_set_text(o, "quick", "true"));
  check_close(hooke_options_number(o, "quick"), 1, 0);
  check_ok(hooke_options_set_text(o, "quick", "false"));
  check_close(hooke_options_number(o, "quick"), 0, 0);
}

TEST(a_text_may_name_units) {
  hooke_options *o = *prepared;
  static const struct {
    const char *text;
    double step;
  } times[] = {{"3ms", 3e-3},  {"3 ms", 3e-3}, {"+.7E1 us", .7e-5},    {"7.e-1ms", 0.7e-3},
               {"0.1 s", 0.1}, {"3ns", 3e-9},  {"1e-3min", 1e-3 * 60}, {"1e-5\th", 1e-5 * 3600}};
  for (size_t k = 0; k < sizeof times / sizeof times[0]; k++) {
    check_ok(hooke_options_set_text(o, "step", times[k].text));
    check_close(hooke_options_number(o, "step"), times[k].step, 0);
  }
  check_ok(hooke_options_set_text(o, "gravity", "1,-981 cm/s^2 2 mm/s^2"));
  check_close(hooke_options_numbers(o, "gravity")[0], 1, 0);
  check_close(hooke_options_numbers(o, "gravity")[1], -9.81, 0);
  check_close(hooke_options_numbers(o, "gravity")[2], 2e-3, 0);
  check_ok(hooke_options_set_text(o, "shear.damping", "2 kN s, 3, 4 mN s"));
  check_close(hooke_options_numbers(o, "shear.damping")[0], 2000, 0);
  check_close(hooke_options_numbers(o, "shear.damping")[2], 4e-3, 0);
  assert_string_equal(hk_options_unit_given(o, "shear.damping"), "N s");
  check_ok(hooke_options_set_text(o, "shear.damping", "2"));
  assert_null(hk_options_unit_given(o, "shear.damping"));
}

TEST(rows_and_sizes_have_signs_of_their_own) {
  hooke_options *o = *prepared;
  static const double edges[] = {1, 0, 0, 0, 0.5, 1}, velocities[] = {1000, 2, 3e-3, 4}, sizes[] = {16, 3, 4};
  check_ok(hooke_options_set_text(o, "edges", "1,0,0; 0 0.5 1"));
  check_same_bits(6, hooke_options_numbers(o, "edges"), edges);
  check_ok(hooke_options_set_text(o, "velocity", "1 km/s,2;3mm/s,4 m/s"));
  check_same_bits(4, hooke_options_numbers(o, "velocity"), velocities);
  check_ok(hooke_options_set_text(o, "size", "16x 3,4"));
  check_same_bits(3, hooke_options_numbers(o, "size"), sizes);
}

TEST(a_word_and_numbers_replace_each_other) {
  hooke_options *o = *prepared;
  const double lengths[] = {1, 2};
  check_ok(hooke_options_set_numbers(o, "rest_length", 2, lengths));
  assert_string_equal(hooke_options_text(o, "rest_length"), "");
  check_ok(hooke_options_set_text(o, "rest_length", "initial"));
  assert_int_equal(hooke_options_number_count(o, "rest_length"), 0);
  assert_string_equal(hooke_options_text(o, "rest_length"), "initial");
  check_status(hooke_options_set_text(o, "rest_length", "initial, 2"), HOOKE_BAD_VALUE);
  assert_string_equal(hooke_options_text(o, "rest_length"), "initial");
}

TEST(words_and_numbers_mix_where_allowed) {
  hooke_options *o = *prepared;
  check_ok(hooke_options_set_text(o, "pinned", "start, 3 end"));
  assert_string_equal(hooke_options_text(o, "pinned"), "start end");
  assert_int_equal(hooke_options_number_count(o, "pinned"), 1);
  check_close(hooke_options_number(o, "pinned"), 3, 0);
  check_ok(hooke_options_set_number(o, "pinned", 7));
  assert_string_equal(hooke_options_text(o, "pinned"), "");
  check_ok(hk_options_add_word(o, "pinned", "end"));
  check_ok(hk_options_add_word(o, "pinned", "start"));
  assert_string_equal(hooke_options_text(o, "pinned"), "end start");
  check_close(hooke_options_number(o, "pinned"), 7, 0);
  check_status(hk_options_add_word(o, "pinned", "star"), HOOKE_BAD_VALUE);
  check_status(hk_options_add_word(o, "rest_length", "initial"), HOOKE_BAD_VALUE);
  check_ok(hooke_options_set_numbers(o, "pinned", 0, NULL));
  assert_int_equal(hooke_options_is_set(o, "pinned"), 1);
  assert_int_equal(hooke_options_number_count(o, "pinned"), 0);
  assert_string_equal(hooke_options_text(o, "pinned"), "");
}

TEST(large_arrays_are_copied) {
  hooke_options *o = *prepared;
  enum { COUNT = 1000000 };
  owned_doubles *values = new_doubles(COUNT);
  for (int k = 0; k < COUNT; k++)
    values[k] = 1 + k;
  check_ok(hooke_options_set_numbers(o, "rest_length", COUNT, values));
  values[COUNT - 1] = -1;
  check_close(hooke_options_numbers(o, "rest_length")[COUNT - 1], COUNT, 0);
  check_status(hooke_options_set_numbers(o, "rest_length", COUNT, values), HOOKE_BAD_VALUE);
  check_message("rest_length[999999]: -1 is not allowed");
  check_close(hooke_options_numbers(o, "rest_length")[COUNT - 1], COUNT, 0);
}

/* ---- refusals ---- */

static void refuse_text(hooke_options *o, const char *name, const char *text, const char *message) {
  check_status(hooke_options_set_text(o, name, text), HOOKE_BAD_VALUE);
  assert_string_equal(hooke_last_error(), message);
}

TEST(refusals_give_value_and_allowed) {
  hooke_options *o = *prepared;
  refuse_text(o, "step", "0", "step: 0 is not allowed; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "10.5", "step: 10.5 is not allowed; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "fast", "step: \"fast\" is not allowed; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "nan", "step: \"nan\" is not allowed; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "1e-999",
              "step: 1e-999 is so small that it would become 0; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "1e999",
              "step: 1e999 is beyond the largest number, 1.8e308; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "3 km/h",
              "step: there is no unit 'km/h' here; allowed: s, ms, us, ns, ps, fs, min, h; a number without "
              "one is in s");
  refuse_text(o, "step", "ms", "step: \"ms\" is not allowed; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "3ms2ms",
              "step: there is no unit 'ms2ms' here; allowed: s, ms, us, ns, ps, fs, min, h; a number without "
              "one is in s");
  refuse_text(o, "step", "1e400ms",
              "step: 1e400ms is beyond the largest number, 1.8e308; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "step", "1min", "step: 60 is not allowed; allowed: a number > 0 and <= 10 [s]");
  refuse_text(o, "order", "5s", "order: \"5s\" is not allowed; allowed: a whole number >= 1 and <= 12");
  refuse_text(o, "law", "cubic", "law: \"cubic\" is not allowed; allowed: \"strain\" or \"length\"");
  refuse_text(o, "order", "2.5", "order: 2.5 is not allowed; allowed: a whole number >= 1 and <= 12");
  refuse_text(o, "quick", "yes", "quick: \"yes\" is not allowed; allowed: true or false");
  refuse_text(o, "gravity", "1,2", "gravity: 2 numbers given; allowed: 3 numbers [m/s^2]");
  refuse_text(o, "gravity", "1,two,3", "gravity[1]: \"two\" is not allowed; allowed: 3 numbers [m/s^2]");
  refuse_text(o, "gravity", "1,,3", "gravity[1]: \"\" is not allowed; allowed: 3 numbers [m/s^2]");
  refuse_text(o, "gravity", "1,2,3,", "gravity: \"1,2,3,\" is not allowed; allowed: 3 numbers [m/s^2]");
  refuse_text(o, "edges", "1,0;0,0,0,1", "edges: row [0] has 2 numbers; allowed: 2 rows of 3 numbers each");
  refuse_text(o, "edges", "1,0,0;1", "edges: row [1] has 1 number; allowed: 2 rows of 3 numbers each");
  refuse_text(o, "edges", "1,0,0,0,0,1;", "edges: row [0] has 6 numbers; allowed: 2 rows of 3 numbers each");
  refuse_text(o, "edges", "1,0,0;", "edges: row [1] has 0 numbers; allowed: 2 rows of 3 numbers each");
  refuse_text(o, "edges", "1x0", "edges[0][0]: \"1x0\" is not allowed; allowed: 2 rows of 3 numbers each");
  refuse_text(o, "gravity", "1;2;3", "gravity: \"1;2;3\" is not allowed; allowed: 3 numbers [m/s^2]");
  refuse_text(o, "size", "4xx4",
              "size[1]: \"\" is not allowed; allowed: 2 to 3 whole numbers >= 1 and <= 99");
  refuse_text(
      o, "pinned", "1x2",
      "pinned: \"1x2\" is not allowed; allowed: any number of whole numbers >= 0 and <= 2147483647, or any of \"start\" or \"end\"");
  refuse_text(o, "rest_length", "-1",
              "rest_length: -1 is not allowed; allowed: one or more numbers >= 0 or \"initial\"");
  refuse_text(o, "structural", "strong",
              "structural: \"strong\" is not allowed; allowed: an object of stiffness, damping, compression");
  refuse_text(o, "structural.stiffness", "1 -2",
              "structural.stiffness[1]: -2 is not allowed; allowed: one or more numbers >= 0 [N]");
  assert_int_equal(hk_options_has_family(o, "structural"), 0);
}

TEST(numbers_are_checked_like_texts) {
  hooke_options *o = *prepared;
  const double gravity[] = {0, NAN, 0};
  check_status(hooke_options_set_numbers(o, "gravity", 3, gravity), HOOKE_BAD_VALUE);
  check_message("gravity[1]: ");
  const double edges[] = {1, 0, 0, 0, INFINITY, 0};
  check_status(hooke_options_set_numbers(o, "edges", 6, edges), HOOKE_BAD_VALUE);
  check_message("edges[1][1]: inf is not allowed; allowed: 2 rows of 3 numbers each");
  check_status(hooke_options_set_number(o, "quick", 2), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(o, "law", 1), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(o, "title", 1), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(o, "structural", 1), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_number(o, "pinned", 1e300), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_numbers(o, "pinned", -1, gravity), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_text(o, "step", NULL), HOOKE_BAD_VALUE);
  check_status(hooke_options_set_text(NULL, "step", "1"), HOOKE_BAD_VALUE);
}

TEST(a_refused_value_changes_nothing) {
  hooke_options *o = *prepared;
  check_ok(hooke_options_set_text(o, "step", "0.5"));
  check_status(hooke_options_set_text(o, "step", "-1"), HOOKE_BAD_VALUE);
  check_close(hooke_options_number(o, "step"), 0.5, 0);
  check_status(hooke_options_set_text(o, "pinned", "start, -3"), HOOKE_BAD_VALUE);
  assert_int_equal(hooke_options_is_set(o, "pinned"), 0);
}

TEST(unknown_names_are_answered_with_names) {
  hooke_options *o = *prepared;
  check_status(hooke_options_set_number(o, "setp", 1), HOOKE_BAD_VALUE);
  assert_string_equal(
      hooke_last_error(),
      "thing: unknown option \"setp\"; did you mean \"step\"? allowed: step, law, gravity, rest_length, "
      "edges, pinned, order, title, quick, structural, shear, size, velocity");
  check_status(hooke_options_set_number(o, "structural.stifness", 1), HOOKE_BAD_VALUE);
  check_message(
      "unknown option \"stifness\"; did you mean \"stiffness\"? allowed: stiffness, damping, compression");
  check_status(hooke_options_set_number(o, "velocity_of_light", 1), HOOKE_BAD_VALUE);
  assert_null(strstr(hooke_last_error(), "did you mean"));
  check_status(hooke_options_set_number(o, "step.size", 1), HOOKE_BAD_VALUE);
  check_message("step.size: step has no members");
  check_status(hooke_options_set_number(o, "\x1b[2J", 1), HOOKE_BAD_VALUE);
  assert_null(strchr(hooke_last_error(), '\x1b'));
}

/* ---- families, required, copies, reference ---- */

TEST(a_member_makes_its_family_present) {
  hooke_options *o = *prepared;
  assert_int_equal(hk_options_has_family(o, "structural"), 0);
  check_ok(hooke_options_set_number(o, "structural.stiffness", 50));
  assert_int_equal(hk_options_has_family(o, "structural"), 1);
  assert_int_equal(hk_options_has_family(o, "shear"), 0);
  check_close(hooke_options_number(o, "structural.compression"), 1, 0);
  check_ok(hooke_options_set_text(o, "shear", ""));
  assert_int_equal(hk_options_has_family(o, "shear"), 1);
  check_ok(hooke_options_unset(o, "structural"));
  assert_int_equal(hk_options_has_family(o, "structural"), 0);
  assert_int_equal(hooke_options_is_set(o, "structural.stiffness"), 0);
  assert_int_equal(hk_options_has_family(o, "shear"), 1);
}

TEST(required_members_are_missed_only_where_present) {
  hooke_options *o = *prepared;
  check_ok(hk_options_check_required(o));
  check_ok(hooke_options_set_text(o, "shear", ""));
  check_status(hk_options_check_required(o), HOOKE_BAD_VALUE);
  assert_string_equal(hooke_last_error(),
                      "shear.stiffness: is required but missing; allowed: one or more numbers >= 0 [N]");
  check_ok(hooke_options_set_number(o, "shear.stiffness", 1));
  check_ok(hk_options_check_required(o));
}

TEST(a_copy_is_equal_and_separate) {
  hooke_options *o = *prepared, *copy = NULL;
  const double stiffness[] = {1, 2, 3};
  check_ok(hooke_options_set_numbers(o, "structural.stiffness", 3, stiffness));
  check_ok(hooke_options_set_text(o, "pinned", "end, 4"));
  check_ok(hooke_options_copy(o, &copy));
  check_ok(hooke_options_set_number(o, "structural.stiffness", 9));
  check_ok(hooke_options_unset(o, "pinned"));
  check_same_bits(3, hooke_options_numbers(copy, "structural.stiffness"), stiffness);
  assert_string_equal(hooke_options_text(copy, "pinned"), "end");
  check_close(hooke_options_number(copy, "pinned"), 4, 0);
  assert_int_equal(hk_options_has_family(copy, "structural"), 1);
  assert_int_equal(hooke_options_is_set(copy, "step"), 0);
  hooke_options_destroy(copy);
}

TEST(the_table_describes_itself) {
  hooke_options *o = *prepared;
  assert_int_equal(hooke_options_row_count(o), 19);
  assert_string_equal(hooke_options_row(o, 0, "name"), "step");
  assert_string_equal(hooke_options_row(o, 0, "type"), "number");
  assert_string_equal(hooke_options_row(o, 0, "unit"), "s");
  assert_string_equal(hooke_options_row(o, 0, "default"), "");
  assert_string_equal(hooke_options_row(o, 0, "allowed"), "a number > 0 and <= 10");
  assert_string_equal(hooke_options_row(o, 0, "doc"), "length of a step");
  assert_string_equal(hooke_options_row(o, 1, "default"), "strain");
  assert_string_equal(hooke_options_row(o, 9, "name"), "structural");
  assert_string_equal(hooke_options_row(o, 9, "type"), "family");
  assert_string_equal(hooke_options_row(o, 10, "name"), "structural.stiffness");
  assert_string_equal(hooke_options_row(o, 16, "name"), "shear.compression");
  assert_null(hooke_options_row(o, 19, "name"));
  assert_null(hooke_options_row(o, -1, "name"));
  assert_null(hooke_options_row(o, 0, "colour"));
  assert_string_equal(hooke_options_row(o, 1, "words"), "strain length");
  assert_string_equal(hooke_options_row(o, 0, "words"), "");
  assert_string_equal(hooke_options_row(o, 0, "family"), "");
  assert_string_equal(hooke_options_row(o, 9, "family"), "");
  assert_string_equal(hooke_options_row(o, 16, "family"), "shear");
  assert_string_equal(hooke_options_row(o, 0, "example"), "0.1");
  assert_string_equal(hooke_options_row(o, 1, "example"), "");
}

TEST(the_table_tells_its_numbers) {
  hooke_options *o = *prepared;
  check_close(hooke_options_row_number(o, 0, "low"), 0, 0);
  check_close(hooke_options_row_number(o, 0, "high"), 10, 0);
  check_close(hooke_options_row_number(o, 0, "above_low"), 1, 0);
  check_close(hooke_options_row_number(o, 0, "required"), 0, 0);
  check_close(hooke_options_row_number(o, 10, "required"), 1, 0);
  check_close(hooke_options_row_number(o, 6, "whole"), 1, 0);
  check_close(hooke_options_row_number(o, 4, "min_count"), 6, 0);
  check_close(hooke_options_row_number(o, 4, "max_count"), 6, 0);
  check_close(hooke_options_row_number(o, 4, "columns"), 3, 0);
  check_close(hooke_options_row_number(o, 5, "word_lists"), 1, 0);
  assert_true(isnan(hooke_options_row_number(o, 1, "low")));
  assert_true(isnan(hooke_options_row_number(o, 2, "columns")));
  assert_true(isnan(hooke_options_row_number(o, 3, "max_count")));
  assert_true(isnan(hooke_options_row_number(o, 0, "min_count")));
  assert_true(isnan(hooke_options_row_number(o, 0, "colour")));
  assert_true(isnan(hooke_options_row_number(o, 19, "low")));
}

TEST(a_wrong_default_is_noticed) {
  static const struct hk_option_row bad_rows[] = {
      {.name = "step", .type = HOOKE_OPTION_NUMBER, .high = 1, .fallback = "2"}};
  static const struct hk_option_table bad = {"bad", HOOKE_OPTION_ROWS(bad_rows)};
  hooke_options *options = (hooke_options *)1;
  check_status(hk_options_create(&bad, &options), HOOKE_BAD_VALUE);
  assert_null(options);
}

static void check_shown(const char *text, const char *wanted) {
  char shown[HOOKE_OPTION_SHOWN];
  memset(shown, 'x', sizeof shown);
  hk_option_show(text, (int64_t)strlen(text), shown);
  assert_string_equal(shown, wanted);
}

#define TWENTY "aaaaaaaaaaaaaaaaaaaa"

/* Text from a file may be anything; messages stay printable. */
TEST(what_is_shown_is_text) {
  check_shown("", "");
  check_shown("a\nb\x1b[2J\x7f", "a?b?[2J?");
  check_shown("\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80", "\xc3\xa9\xe2\x82\xac\xf0\x9f\x98\x80");
  check_shown("\x89HDF", "?HDF");
  check_shown("\xc3", "?");
  check_shown("\xe2\x82", "??");
  check_shown("\xc0\xaf\xed\xa0\x80\xf4\x90\x80\x80\xff", "??????????");
  check_shown("\xe0\x80\x80\xf0\x80\x80\x80", "???????");
  check_shown(TWENTY TWENTY TWENTY, TWENTY TWENTY TWENTY);
  check_shown(TWENTY TWENTY TWENTY "a", TWENTY TWENTY TWENTY "...");
  check_shown(TWENTY TWENTY TWENTY "\xc3\xa9", TWENTY TWENTY TWENTY "...");
  check_shown(TWENTY TWENTY "aaaaaaaaaaaaaaaaaaa\xc3\xa9", TWENTY TWENTY "aaaaaaaaaaaaaaaaaaa...");
}

AROUND_EACH(setup, teardown)
