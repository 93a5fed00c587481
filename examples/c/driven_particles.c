/* Driven particles: the upper end of a rope goes round in a circle, by a callback; a second rope is shaken at
 * one end, as a sine. A driven particle has no mass to be moved by: it is where its motion says. */
#include <hooke.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static void check(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s: %s\n", hooke_status_name(status), hooke_last_error());
  exit(1);
}

struct circle {
  double radius, turns; /* [m], [1/s] */
};

static int32_t go_round(int64_t count, double t, double *q, double *v, void *ctx) {
  const struct circle *circle = ctx;
  const double rate = 2 * 3.14159265358979323846 * circle->turns, a = rate * t;
  for (int64_t k = 0; k < count; k++) {
    q[3 * k] = circle->radius * cos(a), v[3 * k] = -rate * circle->radius * sin(a);
    q[3 * k + 1] = 0, v[3 * k + 1] = 0;
    q[3 * k + 2] = circle->radius * sin(a), v[3 * k + 2] = rate * circle->radius * cos(a);
  }
  return 0;
}

static int64_t add_rope(hooke_system *system, const char *name, const char *from, const char *to) {
  hooke_options *rope;
  int64_t first;
  check(hooke_options_create("rope", &rope));
  check(hooke_options_set_text(rope, "from", from)); /* m */
  check(hooke_options_set_text(rope, "to", to));
  check(hooke_options_set_number(rope, "segments", 20));
  check(hooke_options_set_number(rope, "mass", 0.1)); /* kg */
  check(hooke_options_set_number(rope, "stretch.stiffness", 200));
  check(hooke_options_set_number(rope, "stretch.damping", 0.05));
  check(hooke_system_add_part(system, "rope", name, rope, &first, NULL));
  hooke_options_destroy(rope);
  return first;
}

int main(void) {
  const double step = 1e-4; /* s; at a quarter of it the printed digits are the same */
  struct circle circle = {0.2, 1.5};
  hooke_system *system;
  hooke_options *run;
  hooke_integrator *integrator;
  hooke_state *state;
  check(hooke_system_create(&system));
  check(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  check(hooke_system_set_drag(system, 5e-4)); /* N s/m on each particle */
  const int64_t lasso = add_rope(system, "lasso", "0.2,0,0", "0.2,-1,0");
  const int64_t shaken = add_rope(system, "shaken", "2,0,0", "3,0,0"), held = shaken + 20;
  check(hooke_system_drive_callback(system, 1, &lasso, go_round, &circle));
  check(hooke_system_drive_harmonic(system, 1, &shaken, (double[]){0, 0.05, 0}, 3, 0)); /* m, Hz, rad */
  check(hooke_system_pin(system, 1, &held));
  check(hooke_system_commit(system));

  check(hooke_options_create("run", &run));
  check(hooke_options_set_text(run, "method", "verlet"));
  check(hooke_options_set_number(run, "step", step));
  check(hooke_integrator_create(system, run, &integrator));
  check(hooke_state_create(system, &state));
  const double *end = hooke_state_position(state) + 3 * (lasso + 20),
               *hand = hooke_state_position(state) + 3 * shaken;
  for (int quarter = 1; quarter <= 4; quarter++) {
    check(hooke_integrator_step(integrator, state, (int64_t)round(0.25 / step)));
    printf("t = %g s: the end of the lasso is %.2f m from its axis and %.2f m down; the hand is at y = %+.3f "
           "m\n",
           hooke_state_time(state), hypot(end[0], end[2]), -end[1], hand[1]);
  }

  hooke_state_destroy(state);
  hooke_integrator_destroy(integrator);
  hooke_options_destroy(run);
  hooke_system_destroy(system);
  return 0;
}
