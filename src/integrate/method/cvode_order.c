/* BDF of order 1 and 2 damps every mode that steps do not resolve. Order 3 and above amplifies weakly damped
 * ones, at omega h of order one, until the error control limits the step there although the motion does not
 * require it.
 *
 * So if steps are longer than LONG/omega, with omega and the damping ratio of the fastest modes, and that
 * ratio is below the stable one of order 3, order 2 becomes the highest, before those modes have grown. If
 * steps then stay shorter than SHORT/omega, accuracy limits them, and the higher orders return. CVODE keeps
 * its history in the current order, so each change is a start from order 1; hence the budget. */
#if HOOKE_HAVE_SUNDIALS

#include "integrate/method/cvode_order.h"

#include "core/memory.h"

#include <math.h>

enum {
  WINDOW = 50, /* steps of the mean, with all orders and with the low ones */
  LOW_WINDOW = 100,
  LOW_START = 200, /* steps before the first check with the low orders */
  BUDGET = 10,     /* successive windows of short steps before the higher orders return */
  QUIET = 500,  /* steps before the next check with all orders; 4 times as many each time that they return */
  REFRESH = 10, /* windows before the fastest modes are computed again */
  ITERATIONS = 15
};
static const double LOOSE_RTOL = 1e-6, LONG = 2.0, SHORT = 1.0;
/* Cosine of 86.03 degrees: Hairer and Wanner, Solving Ordinary Differential Equations II (1996), section
 * V.2. */
static const double DAMPING_OF_ORDER_3 = 0.0692;

int32_t hk_order_choice_create(hooke_integrator *it) {
  struct hk_sundials *own = it->own;
  if (!hk_unknowns_have_products(it) || own->unknowns.free_count == 0 || !own->unknowns.has_v ||
      !isnan(hooke_options_number(it->options, "max_order")) ||
      hooke_options_number(it->options, "rtol") < LOOSE_RTOL)
    return HOOKE_OK;
  own->choice = hk_new(1, sizeof *own->choice);
  if (own->choice == NULL) return HOOKE_NO_MEMORY;
  own->choice->scratch = hk_new(2 * own->unknowns.size, sizeof(double));
  it->own_memory += 2 * own->unknowns.size * (int64_t)sizeof(double);
  return own->choice->scratch ? HOOKE_OK : HOOKE_NO_MEMORY;
}

void hk_order_choice_release(struct hk_order_choice *choice) {
  if (choice == NULL) return;
  hk_free(choice->scratch);
  hk_free(choice);
}

void hk_order_choice_begin(struct hk_order_choice *c, double t) {
  *c = (struct hk_order_choice){.window_begun = t, .quiet_next = QUIET, .scratch = c->scratch};
}

/* ---- the fastest modes ---- */

/* Both over the unknowns that are velocities; x and p are scratch. */
static double product_of(const hooke_integrator *it, const struct hk_unknowns *u, const double *x,
                         const double *p) {
  double sum = 0.0;
  for (int a = 0; a < 3; a++) {
    for (int64_t k = 0; k < u->stretch_count; k++) {
      const struct hk_stretch_of_free *s = &u->stretch[k];
      const double *mass = it->system->inertia + s->particle;
      const int64_t from = a * u->free_count + s->unknown;
      for (int64_t j = 0; j < s->count; j++)
        sum += mass[j] * x[from + j] * p[from + j];
    }
  }
  return sum;
}

/* Power iterations with the derivative of the forces by the positions, from pseudo-random numbers; then the
 * damping of the result. A few are enough: the mean over the fastest modes is needed. Frequency 0 if nothing
 * is stiff. */
static int32_t find_fastest_modes(hooke_integrator *it, struct hk_order_choice *c, const double *y) {
  struct hk_unknowns *u = &((struct hk_sundials *)it->own)->unknowns;
  const int64_t half = u->size / 2;
  c->frequency = c->damping = 0.0;
  double *x = c->scratch, *p = x + u->size, squared = 0.0;
  uint64_t number = 1;
  if (hk_unknowns_linearise(it, u, it->t, y) != HOOKE_SLOPE_FINE) return HOOKE_STOPPED;
  for (int64_t k = 0; k < half; k++) {
    number = number * 6364136223846793005u + 1442695040888963407u; /* Knuth's MMIX */
    x[k] = (double)(number >> 40) / 8388608.0 - 1.0;
    x[half + k] = 0.0;
  }
  for (int i = 0; i < ITERATIONS; i++) {
    if (hk_unknowns_product(it, u, it->t, x, p) != HOOKE_SLOPE_FINE) return HOOKE_STOPPED;
    const double size = product_of(it, u, x, x), grown = product_of(it, u, p + half, p + half);
    squared = sqrt(grown / size);
    if (!(squared > 0.0) || !isfinite(squared)) return HOOKE_OK;
    for (int64_t k = 0; k < half; k++)
      x[k] = p[half + k] / sqrt(grown);
  }
  for (int64_t k = 0; k < half; k++) {
    x[half + k] = x[k];
    x[k] = 0.0;
  }
  if (hk_unknowns_product(it, u, it->t, x, p) != HOOKE_SLOPE_FINE) return HOOKE_STOPPED;
  const double rate = -product_of(it, u, x + half, p + half) / product_of(it, u, x + half, x + half);
  if (!isfinite(rate)) return HOOKE_OK;
  c->frequency = sqrt(squared);
  c->damping = rate / (2.0 * c->frequency);
  return HOOKE_OK;
}

/* ---- the choice ---- */

int32_t hk_order_choice_is_due(struct hk_order_choice *c, double t) {
  c->steps++;
  if (++c->window_steps < (c->low ? LOW_WINDOW : WINDOW)) return 0;
  if (c->steps >= (c->low ? LOW_START : c->quiet_until)) return 1;
  c->window_steps = 0;
  c->window_begun = t;
  return 0;
}

static void change(struct hk_order_choice *c, int32_t low) {
  c->low = low;
  c->steps = c->looks = c->short_windows = 0;
  c->quiet_until = low ? 0 : c->quiet_next;
  if (!low && c->quiet_next < INT64_MAX / 8) c->quiet_next *= 4;
}

int32_t hk_order_choice_look(hooke_integrator *it, const double *y) {
  struct hk_order_choice *c = ((struct hk_sundials *)it->own)->choice;
  const double step = (it->t - c->window_begun) / (double)c->window_steps;
  c->window_steps = 0;
  c->window_begun = it->t;
  if (c->low || c->looks++ % REFRESH == 0 || step * c->frequency > LONG) {
    const int32_t status = find_fastest_modes(it, c, y);
    if (status != HOOKE_OK) return status;
  }
  if (c->low) {
    c->short_windows = step * c->frequency < SHORT ? c->short_windows + 1 : 0;
    if (c->short_windows >= BUDGET) change(c, 0);
  } else if (step * c->frequency > LONG) {
    if (c->damping < DAMPING_OF_ORDER_3)
      change(c, 1);
    else
      c->quiet_until = c->steps + QUIET;
  }
  return HOOKE_OK;
}

#else
typedef int hk_cvode_order_is_not_built;
#endif
