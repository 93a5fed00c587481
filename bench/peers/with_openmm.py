"""OpenMM: HarmonicBondForce on the CPU platform. Its Verlet is leapfrog: velocities that start half a step early."""

from __future__ import annotations

import numpy as np
import openmm

from cloth import GRAVITY, Cloth
from peer import Motion, Stepper


def start(cloth: Cloth, step: float, threads: int) -> Motion:
    system, bonds = openmm.System(), openmm.HarmonicBondForce()
    gravity = openmm.CustomExternalForce(f"{cloth.mass[0] * GRAVITY:.17g}*y")
    for p, w in enumerate(cloth.inverse_mass.tolist()):
        system.addParticle(1.0 / w if w > 0 else 0.0)  # no mass: fixed
        gravity.addParticle(p, [])
    for (i, j), length, kappa in zip(cloth.ends.tolist(), cloth.rest_length.tolist(), cloth.kappa.tolist()):
        bonds.addBond(i, j, length, kappa)
    system.addForce(bonds)
    system.addForce(gravity)
    integrator = openmm.VerletIntegrator(step)
    platform = openmm.Platform.getPlatformByName("CPU")
    context = openmm.Context(system, integrator, platform, {"Threads": str(threads)})
    context.setPositions(cloth.q)
    context.setVelocities(np.zeros_like(cloth.q))

    def positions() -> np.ndarray:
        return context.getState(getPositions=True).getPositions(asNumpy=True)._value

    return Motion(integrator.step, positions)


LEAPFROG = Stepper("OpenMM CPU", lambda: openmm.__version__, "symplectic-euler", False, True, start)
