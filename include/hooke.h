/* hooke.h - mass-spring systems: everything.
 *
 *   base.h        statuses, messages, facts about the build
 *   options.h     named options with units, bounds and defaults
 *   system.h      particles, springs, forces, energies, derivatives
 *   build.h       generated parts: rope, cloth
 *   state.h       time, positions, velocities
 *   integrator.h  methods and the run loop
 *   measurement.h studies: the trade of error against cost, orders, recommendation
 *   measure.h     step bounds and comparisons
 *   limit.h       the largest stable step of each method, and what it hangs on
 *   cost.h        what each ingredient of a scene costs on this machine
 *   why.h         a warning before a run blows up, and why it did
 *   io.h          scene files and trajectories
 *   checkpoint.h  places from which a run goes on */
#ifndef HOOKE_H
#define HOOKE_H

#include "hooke/base.h"
#include "hooke/options.h"
#include "hooke/system.h"
#include "hooke/build.h"
#include "hooke/state.h"
#include "hooke/integrator.h"
#include "hooke/measurement.h"
#include "hooke/measure.h"
#include "hooke/estimate.h"
#include "hooke/limit.h"
#include "hooke/cost.h"
#include "hooke/why.h"
#include "hooke/io.h"
#include "hooke/checkpoint.h"

#endif
