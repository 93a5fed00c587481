#include "measure/limit/contact.h"

#include "core/print.h"
#include "model/callbacks.h"
#include "model/system.h"

#include <math.h>

static void claim(struct hk_claims *claims, const hooke_system *system, double t, int64_t number,
                  int64_t particle) {
  const struct hk_obstacle *o = &system->rest->obstacles.obstacle[number];
  const double w = system->inverse_mass[particle], *g = system->fall;
  const double weight = sqrt((g[0] * g[0] + g[1] * g[1]) + g[2] * g[2]);
  char braked[64] = "", slides[96] = "";
  if (o->damping > 0.0) hk_print(braked, sizeof braked, ", braked at %.6g 1/s", o->damping * w);
  if (o->friction > 0.0 && weight > 0.0)
    hk_print(slides, sizeof slides, "; friction under its weight brakes at %.6g 1/s",
             o->friction * weight / o->friction_speed);
  hk_claim(
      claims, "contact", HOOKE_OF_PART, "the lightest particle",
      "at t = %.6g s nothing touches obstacle %lld, and no bound on the step knows of it: with particle %lld, the "
      "lightest, contact is a motion of %.6g rad/s%s%s",
      t, (long long)number, (long long)particle, sqrt(o->stiffness * w), braked, slides);
}

void hk_claim_callback(struct hk_claims *claims, const hooke_system *system) {
  char name[512];
  if (system->force)
    hk_claim(claims, "callback", HOOKE_OF_PART, "stiffness", "the stiffness and damping of %s are left out",
             hk_force_called(system, name, sizeof name));
}

void hk_claim_contacts(struct hk_claims *claims, const hooke_system *system, double t, const double *q) {
  for (int64_t number = 0, particle; (particle = hk_obstacles_untouched(system, t, q, &number)) >= 0;
       number++)
    claim(claims, system, t, number, particle);
}
