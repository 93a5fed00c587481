/* References, whichever methods make them in this build: no further from solutions to 15 digits than they
 * say, and ended early no closer than their method can be. */
#include "check.h"
#include "measure/trial/reference.h"
#include "reference.h"

#include <math.h>

/* Largest distance of a free particle at the last frame from the solution [m]. */
static double error_of(const struct hk_reference *r, const struct reference_state *expected) {
  double largest;
  (void)hk_frames_distance(&r->frames, r->frames.count - 1, expected->position, &largest);
  return largest;
}

static void make(const hooke_system *system, double duration, double digits, struct hk_reference *r) {
  owned_options *run = run_options((struct run){.duration = duration, .every = duration / 20.0});
  const struct hk_reference_request request = {
      .run = run, .frame_count = 21, .digits = digits, .enough = !isnan(digits), .budget = INFINITY};
  check_ok(hk_reference_create(system, &request, r));
  assert_int_equal(r->trusted, 21);
  assert_int_equal(r->coarse, 0);
}

TEST(references_are_as_close_as_they_say) {
  for (int k = 0; k < REFERENCE_COUNT; k++) {
    const struct reference_state *expected = &references[k].state[0];
    owned_system *system = build_reference(&references[k]);
    owned(hk_reference_release) struct hk_reference r;
    make(system, expected->time, NAN, &r);
    check_between(r.agreement, 1e-16, 1e-8 * r.extent);
    if (!(error_of(&r, expected) <= r.agreement))
      check_failed("%s: %.3g m off, said to be %.3g m at most", references[k].name, error_of(&r, expected),
                   r.agreement);
  }
}

/* Runs by rk4 in steps and half steps are 15 errors of the finer one apart, of which the agreement is twice.
 */
TEST(halved_steps_have_the_order_of_rk4) {
  const struct reference *reference = find_reference("six-particles");
  owned_system *system = build_reference(reference);
  for (double digits = 1e-4; digits > 1e-8; digits *= 0.1) {
    struct hk_reference r;
    make(system, reference->state[0].time, digits, &r);
    if (!hk_reference_is_halved(&r)) {
      hk_reference_release(&r);
      skip();
    }
    assert_string_equal(r.method, "rk4");
    assert_string_equal(r.check, "rk4");
    const double parts = r.longest / hk_reference_setting(&r, "rk4", r.rtol);
    check_close(log2(parts), round(log2(parts)), 1e-12);
    check_close(hk_reference_setting(&r, "rk4", 16.0 * r.rtol), 2.0 * hk_reference_setting(&r, "rk4", r.rtol),
                1e-12);
    check_between(r.agreement, 1e-4 * digits, digits);
    check_between(r.agreement / error_of(&r, &reference->state[0]), 20.0, 60.0);
    hk_reference_release(&r);
  }
}
