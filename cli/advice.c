#include "advice.h"
#include "print.h"
#include "report.h"

#include <math.h>
#include <stdlib.h>

enum { HANDY_TRIES = 9 };

static int32_t fits(double step, double whole) {
  double count = whole / step;
  return isnan(whole) || fabs(count - round(count)) <= 1e-9 * count;
}

double hooke_advice_step(double step, double limit, double every, double duration) {
  static const int factors[] = {5, 2, 1};
  int exponent = (int)floor(log10(limit));
  for (int i = 0; i < HANDY_TRIES; i++) {
    char text[HOOKE_NUMBER_SIZE];
    snprintf(text, sizeof text, "%de%d", factors[i % 3], exponent - i / 3);
    double handy = strtod(text, NULL);
    if (handy <= limit && fits(handy, every) && fits(handy, duration)) return handy;
  }
  return step / ceil(step / limit);
}

/* The bound of a method at the initial state; NaN if there is none to be had. */
static double bound_of(const struct hooke_setup *setup, const char *method, const double *q) {
  double bound;
  return hooke_step_bound(setup->system, method, q, &bound) == HOOKE_OK ? bound : (double)NAN;
}

/* A method that can do what this one cannot: one with a stable step, else one that chooses its own. */
static const char *other_method(const struct hooke_setup *setup, const double *q, double *bound) {
  const char *adaptive = NULL;
  for (int64_t i = 0; i < hooke_method_count(); i++) {
    const char *name = hooke_method_name(i);
    if (!hooke_method_is_built(name)) continue;
    if (hooke_method_is_adaptive(name) != 0) {
      adaptive = name;
      continue;
    }
    *bound = bound_of(setup, name, q);
    if (*bound > 0.0) return name;
  }
  return adaptive;
}

static void print_command(FILE *file, const struct hooke_arguments *arguments, const char *method,
                          const char *step) {
  const struct hooke_setting settings[] = {{"method", method}, {"step", step}, {NULL, NULL}};
  fputs("  ", file);
  hooke_report_command(file, arguments, arguments->verb->name, settings);
  fputc('\n', file);
}

static void advise_fixed(FILE *file, const struct hooke_arguments *arguments, const struct hooke_setup *setup,
                         const hooke_integrator *integrator, const double *q) {
  const hooke_options *options = hooke_integrator_options(integrator);
  const char *method = hooke_options_text(options, "method");
  const char *other = NULL;
  double step = hooke_options_number(options, "step");
  double duration = hooke_options_number(options, "duration");
  double every =
      hooke_options_is_set(setup->options, "every") ? hooke_options_number(options, "every") : (double)NAN;
  double bound = bound_of(setup, method, q);
  double limit = 0.5 * step;
  char text[HOOKE_NUMBER_SIZE];
  if (bound == 0.0) {
    fprintf(file, "%s is stable at no step for this scene; another method is:\n", method);
    other = other_method(setup, q, &bound);
    if (other && hooke_method_is_adaptive(other) != 0) {
      print_command(file, arguments, other, NULL);
      return;
    }
    limit = bound < step ? bound : step;
  } else if (bound < step) {
    fprintf(file, "at the start %s is certain to be stable up to a step of %s s; this run took ", method,
            hooke_format_number(bound, text));
    fprintf(file, "%s s. A smaller step:\n", hooke_format_number(step, text));
    limit = bound;
  } else {
    fprintf(file, "a smaller step may help:\n");
  }
  hooke_format_number(hooke_advice_step(step, limit, every, duration), text);
  print_command(file, arguments, other, text);
}

void hooke_advice_print(FILE *file, const struct hooke_arguments *arguments, const struct hooke_setup *setup,
                        const hooke_integrator *integrator, int32_t outcome) {
  const char *method = hooke_options_text(hooke_integrator_options(integrator), "method");
  hooke_state *start = NULL;
  if (hooke_method_is_adaptive(method) == 0) {
    if (hooke_state_create(setup->system, &start) == HOOKE_OK) {
      advise_fixed(file, arguments, setup, integrator, hooke_state_position(start));
    }
    hooke_state_destroy(start);
  } else if (outcome == HOOKE_STEP_LIMIT) {
    fprintf(file, "allow more steps with --max-steps, or ask for less with a larger --rtol and --atol\n");
  } else {
    fprintf(
        file,
        "the forces of this scene may be too steep for double precision at these tolerances: try a larger "
        "--rtol and --atol, or 'hooke check' on the scene\n");
  }
}
