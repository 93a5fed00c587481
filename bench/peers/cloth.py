"""The cloth that all peers step: hooke's own, with its arrays for the others."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

import hooke

GRAVITY = 9.81  # [m/s^2], along -y
FAMILIES = ("structural", "shear", "bend")


@dataclass
class Cloth:
    size: int  #: particles of a side
    damped: bool
    system: hooke.System
    q: np.ndarray  # initial positions (n, 3) [m], at rest
    ends: np.ndarray  # ends of its springs (m, 2), in hooke's order
    family: np.ndarray  # index into FAMILIES of every spring (m,)
    kappa: np.ndarray  #: [N/m] (m,)
    gamma: np.ndarray  #: [N s/m] (m,)
    rest_length: np.ndarray  #: [m] (m,)
    mass: np.ndarray  #: [kg] (n,)
    inverse_mass: np.ndarray  #: [1/kg], 0 where pinned (n,)

    @property
    def spacing(self) -> float:
        return 1.0 / (self.size - 1)

    def shaken(self) -> Cloth:
        """Moves free particles by up to a hundredth of the spacing: at rest lengths, motions would agree whatever the
        springs do."""
        amount = np.random.default_rng(1).uniform(-0.01, 0.01, self.q.shape) * self.spacing
        self.q = self.q + amount * (self.inverse_mass > 0)[:, None]
        return self

    def state(self) -> hooke.State:
        state = self.system.state()
        state.q[:] = self.q
        return state

    def stable_step(self, method: str, share: float = 0.5) -> float:
        return share * self.system.step_bound(method, self.q)


def make(size: int, stiffness: float = 50.0, damping: float = 0.0) -> Cloth:
    """A square metre of `size` x `size` particles and 1 kg, level, pinned at two corners; stiffness [N], damping [N
    s]."""
    system = hooke.System()
    system.set_gravity([0, -GRAVITY, 0])
    family = {"stiffness": stiffness, "damping": damping}
    system.add_part("cloth", "cloth", origin=[0, 0, 0], edges=[1, 0, 0, 0, 0, 1], size=[size, size], mass=1,
                    pinned="top-corners", **dict.fromkeys(FAMILIES, family))
    counts = dict(system.groups)
    material = system.spring_material
    return Cloth(
        size, damping > 0, system, system.state().q.copy(), system.spring_ends,
        np.repeat(range(len(FAMILIES)), [counts[f"cloth.{name}"] for name in FAMILIES]),
        *material, system.masses.copy(), system.inverse_masses.copy(),
    )
