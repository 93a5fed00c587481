/* hooke.h - mass-spring systems: everything.
 *
 *   base.h        statuses, messages, facts about the build
 *   options.h     named options with units, bounds and defaults
 *   system.h      particles, springs, forces, energies, derivatives
 *   parts.h       generated parts: rope, cloth, lattice, mesh, strand
 *   state.h       time, positions, velocities
 *   integrator.h  methods and the run loop, and a warning before a run blows up
 *   measurement.h studies, limits, needs, costs, causes, verifications
 *   estimate.h    the error of a run, and the cheapest run for a wanted one
 *   scene.h       scene files and meshes
 *   trajectory.h  trajectories: writing, reading, viewing
 *   checkpoint.h  checkpoints, from which a run continues */
#ifndef HOOKE_H
#define HOOKE_H

#include "hooke/base.h"
#include "hooke/options.h"
#include "hooke/system.h"
#include "hooke/parts.h"
#include "hooke/state.h"
#include "hooke/integrator.h"
#include "hooke/measurement.h"
#include "hooke/estimate.h"
#include "hooke/scene.h"
#include "hooke/trajectory.h"
#include "hooke/checkpoint.h"

#endif
