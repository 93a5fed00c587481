#include "small.h"

#include "check.h"
#include "random.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static void set_words(hooke_options *options, const char *words, va_list arguments) {
  char all[1024], *next = all;
  const int size = vsnprintf(all, sizeof all, words, arguments);
  assert_in_range(size, 0, sizeof all - 1);
  while (next != NULL && *next != '\0') {
    char *name = next;
    if ((next = strchr(name, ' ')) != NULL) *next++ = '\0';
    char *value = strchr(name, '=');
    assert_non_null(value);
    *value++ = '\0';
    check_ok(hooke_options_set_text(options, name, value));
  }
}

hooke_options *new_options(const char *table) {
  hooke_options *options = NULL;
  check_ok(hooke_options_create(table, &options));
  return options;
}

hooke_options *options_with(const char *table, const char *words, ...) {
  hooke_options *options = new_options(table);
  va_list arguments;
  va_start(arguments, words);
  set_words(options, words, arguments);
  va_end(arguments);
  return options;
}

void set_options(hooke_options *options, const char *words, ...) {
  va_list arguments;
  va_start(arguments, words);
  set_words(options, words, arguments);
  va_end(arguments);
}

hooke_system *small_part(hooke_system *system, const char *kind, const char *name, const char *words, ...) {
  owned_options *options = new_options(kind);
  va_list arguments;
  va_start(arguments, words);
  set_words(options, words, arguments);
  va_end(arguments);
  if (system == NULL) system = new_system();
  check_ok(hooke_system_add_part(system, kind, name, options, NULL, NULL));
  return system;
}

void small_group(hooke_system *system, const char *kind, const char *name, int64_t count,
                 const int64_t *members, const char *words, ...) {
  owned_options *options = new_options(kind);
  va_list arguments;
  va_start(arguments, words);
  set_words(options, words, arguments);
  va_end(arguments);
  const int anchors = strcmp(kind, "anchors") == 0, altitude = strcmp(kind, "altitude") == 0;
  check_ok((anchors    ? hooke_system_add_anchors
            : altitude ? hooke_system_add_altitude
                       : hooke_system_add_springs)(system, name, count, members, options));
}

hooke_system *small_falling(hooke_system *system) {
  const double down[] = {0, -9.81, 0};
  check_ok(hooke_system_set_gravity(system, down));
  return committed(system);
}

int32_t try_words(hooke_options *options, const char *words) {
  char name[64], value[128];
  int length;
  int32_t status = HOOKE_OK;
  while (status == HOOKE_OK) {
    const int number = errno; /* which sscanf() changes */
    const int found = sscanf(words, " %63[^=]=%127s%n", name, value, &length);
    errno = number;
    if (found != 2) break;
    status = hooke_options_set_text(options, name, value);
    words += length;
  }
  return status == HOOKE_OK && words[strspn(words, " ")] != '\0' ? HOOKE_BAD_VALUE : status;
}

hooke_system *new_system(void) {
  hooke_system *system = NULL;
  check_ok(hooke_system_create(&system));
  return system;
}

hooke_system *committed(hooke_system *system) {
  check_ok(hooke_system_commit(system));
  return system;
}

hooke_system *small_system(int64_t count, const double *position, const double *velocity, double mass,
                           int32_t pin_first) {
  hooke_system *system = new_system();
  const int64_t first = 0;
  check_ok(hooke_system_add_particles(system, count, position, velocity, 1, &mass, NULL));
  if (pin_first) check_ok(hooke_system_pin(system, 1, &first));
  return system;
}

void small_springs(hooke_system *system, int64_t count, const int64_t *ends, struct springs springs) {
  owned_options *options =
      options_with("springs", "law=%s stiffness=%.17g damping=%.17g",
                   springs.law != NULL ? springs.law : "strain", springs.stiffness, springs.damping);
  if (springs.rest_length >= 0.0)
    check_ok(hooke_options_set_number(options, "rest_length", springs.rest_length));
  if (springs.pull_only) check_ok(hooke_options_set_number(options, "compression", 0.0));
  check_ok(hooke_system_add_springs(system, "springs", count, ends, options));
}

hooke_system *small_net(uint64_t seed, double damping, double speed, int32_t pin_first) {
  enum { PARTICLES = SMALL_NET_PARTICLES, SPRINGS = SMALL_NET_SPRINGS };
  struct random_source source = {seed};
  double q[3 * PARTICLES], v[3 * PARTICLES] = {0}, stiffness[SPRINGS], gamma[SPRINGS];
  int64_t ends[2 * SPRINGS];
  for (int k = 0; k < 3 * PARTICLES; k++) {
    q[k] = random_between(&source, -1.0, 1.0);
    if (speed > 0.0 && !(pin_first && k < 3)) v[k] = random_between(&source, -speed, speed);
  }
  hooke_system *system = small_system(PARTICLES, q, v, 0.1, pin_first);
  for (int k = 0; k < SPRINGS; k++) {
    ends[2 * k] = random_whole(&source, 0, PARTICLES - 1);
    ends[2 * k + 1] = (ends[2 * k] + random_whole(&source, 1, PARTICLES - 1)) % PARTICLES;
    stiffness[k] = pow(10.0, random_between(&source, 0.0, 3.0));
    gamma[k] = damping * pow(10.0, random_between(&source, -1.0, 1.0));
  }
  owned_options *options = options_with("springs", "law=length");
  check_ok(hooke_options_set_numbers(options, "stiffness", SPRINGS, stiffness));
  check_ok(hooke_options_set_numbers(options, "damping", SPRINGS, gamma));
  check_ok(hooke_system_add_springs(system, "net", SPRINGS, ends, options));
  return committed(system);
}

hooke_system *small_oscillator(double omega) {
  const double position[] = {0, 0, 0, 1, 0, 0}, velocity[] = {0, 0, 0, 0, 0.5, 0};
  const int64_t ends[] = {0, 1};
  hooke_system *system = small_system(2, position, velocity, 2.0, 1);
  springs_with(system, 1, ends, .law = "length", .stiffness = 2.0 * omega * omega);
  return committed(system);
}

hooke_system *small_crumpling_cloth(int64_t side) {
  return small_falling(
      small_part(NULL, "cloth", NULL,
                 "origin=0,0,0 edges=1,0.05,0,0,0,1 size=%d,%d mass=1 pinned=0 structural.stiffness=500 "
                 "shear.stiffness=300 bend.stiffness=20",
                 (int)side, (int)side));
}

hooke_system *small_cloth(int64_t side, double stiffness, double damping) {
  return small_falling(small_part(
      NULL, "cloth", NULL,
      "origin=0,0,0 edges=1,0,0,0,0,1 size=%d,%d mass=0.2 pinned=top-corners "
      "structural.stiffness=%.17g shear.stiffness=%.17g structural.damping=%.17g shear.damping=%.17g",
      (int)side, (int)side, stiffness, stiffness, damping, damping));
}

int32_t idle_force(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)n, (void)t, (void)q, (void)v, (void)force, (void)ctx;
  return 0;
}

double volume_of(const double *q, const int64_t *p) {
  double e[3][3];
  for (int k = 0; k < 3; k++) {
    for (int a = 0; a < 3; a++)
      e[k][a] = q[3 * p[k + 1] + a] - q[3 * p[0] + a];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}
