/* A force of one's own: a cloth is held up by a ball, which pushes particles out by 2000 N/m of depth. The
 * second callback gives the derivative of the force, so that implicit methods need no difference quotients.
 */
#include <hooke.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

struct ball {
  double centre[3], radius, stiffness; /* [m], [N/m] */
};

static void check(int32_t status) {
  if (status == HOOKE_OK) return;
  fprintf(stderr, "%s: %s\n", hooke_status_name(status), hooke_last_error());
  exit(1);
}

/* How deep a particle is in the ball [m], negative outside; `out` is the unit vector away from the centre. */
static double depth(const struct ball *ball, const double *q, double out[3]) {
  double r = 0;
  for (int c = 0; c < 3; c++)
    r += (q[c] - ball->centre[c]) * (q[c] - ball->centre[c]);
  r = sqrt(r);
  for (int c = 0; c < 3; c++)
    out[c] = (q[c] - ball->centre[c]) / r;
  return ball->radius - r;
}

static int32_t push(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  const struct ball *ball = ctx;
  (void)t, (void)v;
  for (int64_t k = 0; k < n; k++) {
    double out[3], d = depth(ball, q + 3 * k, out);
    for (int c = 0; c < 3 && d > 0; c++)
      force[3 * k + c] += ball->stiffness * d * out[c];
  }
  return 0; /* anything else stops the run */
}

/* d(d out) = -out (out . dq) + d/r (dq - out (out . dq)) */
static int32_t push_product(int64_t n, double t, const double *q, const double *v, const double *dq,
                            const double *dv, double *product, void *ctx) {
  const struct ball *ball = ctx;
  (void)t, (void)v, (void)dv;
  for (int64_t k = 0; k < n; k++) {
    double out[3], d = depth(ball, q + 3 * k, out);
    if (d <= 0) continue;
    const double *x = dq + 3 * k, along = out[0] * x[0] + out[1] * x[1] + out[2] * x[2];
    for (int c = 0; c < 3; c++)
      product[3 * k + c] +=
          ball->stiffness * (d / (ball->radius - d) * (x[c] - along * out[c]) - along * out[c]);
  }
  return 0;
}

static hooke_system *cloth_over(struct ball *ball) {
  hooke_system *system;
  hooke_options *cloth;
  check(hooke_system_create(&system));
  check(hooke_system_set_gravity(system, (double[]){0, -9.81, 0}));
  check(hooke_options_create("cloth", &cloth));
  check(hooke_options_set_text(cloth, "origin", "-0.5,0.31,-0.5"));
  check(hooke_options_set_numbers(cloth, "edges", 6, (double[]){1, 0, 0, 0, 0, 1})); /* m */
  check(hooke_options_set_text(cloth, "size", "14,14"));
  check(hooke_options_set_number(cloth, "mass", 0.2)); /* kg */
  check(hooke_options_set_number(cloth, "structural.stiffness", 50));
  check(hooke_options_set_number(cloth, "structural.damping", 0.01));
  check(hooke_options_set_number(cloth, "shear.stiffness", 20));
  check(hooke_options_set_number(cloth, "shear.damping", 0.01));
  check(hooke_system_add_part(system, "cloth", "cloth", cloth, NULL, NULL));
  check(hooke_system_set_drag(system, 5e-4)); /* N s/m on each particle */
  check(hooke_system_set_force(system, push, push_product, ball));
  check(hooke_system_commit(system));
  hooke_options_destroy(cloth);
  return system;
}

static double deepest(const struct ball *ball, const hooke_state *state) {
  double found = -INFINITY, out[3];
  for (int64_t k = 0; k < hooke_state_size(state); k += 3)
    found = fmax(found, depth(ball, hooke_state_position(state) + k, out));
  return found;
}

int main(void) {
  struct ball ball = {{0, 0, 0}, 0.3, 2000};
  hooke_system *system = cloth_over(&ball);
  const char *methods[] = {"symplectic-euler", "backward-euler"};
  const double step[] = {1e-4, 5e-4}; /* s; at a quarter of it the printed digits are the same */
  for (int m = 0; m < 2; m++) {
    hooke_options *run;
    hooke_integrator *integrator;
    hooke_state *state;
    check(hooke_options_create("run", &run));
    check(hooke_options_set_text(run, "method", methods[m]));
    check(hooke_options_set_number(run, "step", step[m]));
    check(hooke_options_set_number(run, "duration", 0.5));
    check(hooke_integrator_create(system, run, &integrator));
    check(hooke_state_create(system, &state));
    check(hooke_integrator_run(integrator, state));
    printf("%-16s %5lld steps: the cloth is %.1f mm in the ball at most\n", methods[m],
           (long long)hooke_integrator_count(integrator, "steps"), 1e3 * deepest(&ball, state));
    hooke_state_destroy(state);
    hooke_integrator_destroy(integrator);
    hooke_options_destroy(run);
  }
  hooke_system_destroy(system);
  return 0;
}
