/* hooke.h - mass-spring systems: everything.
 *
 *   base.h        statuses, messages, facts about the build
 *   options.h     named options with units, bounds and defaults
 *   system.h      particles, springs, forces, energies, derivatives
 *   build.h       generated parts: rope, cloth
 *   state.h       time, positions, velocities
 *   integrator.h  methods and the run loop, and a warning before a run blows up
 *   measurement.h studies, limits, needs, costs, comparisons, causes, verifications: options, a run, tables
 *   measure.h     bounds on stable steps
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
#include "hooke/io.h"
#include "hooke/checkpoint.h"

#endif
