"""hooke: simulation of mass-spring systems, and the accuracy of each integration method for its cost.

>>> import hooke
>>> scene = hooke.Scene(gravity=(0, -9.81, 0)).cloth(
...     size=(16, 16), edges=((1, 0, 0), (0, 0, 1)), mass=1, structural=dict(stiffness=50), pinned="top-corners")
>>> result = hooke.run(scene, method="symplectic-euler", step=1e-3, duration=2.0, output="cloth.h5")
>>> result.status, result.state.q.shape
('finished', (256, 3))
>>> film = hooke.open("cloth.h5").animate()

A scene is built (`Scene`, `System`) or read from a file (`Scene.load`) or from text (`Scene.parse`). `run` integrates
it, `open` reads the output of a run, `compare` compares several methods with a tight reference, `study` measures
error against cost and recommends, `limit` finds the largest stable steps, `rest` where a scene is at rest, `cost`
measures the cost of each ingredient, `check` tells what a scene is without running it, `needs` finds the
ingredients that a scene can do without, `why` explains a run that blew up, `sweep` runs a scene with many values,
`view` writes a page that plays a trajectory, `verify` checks that one reproduces from its scene, `convert` makes scenes
of other libraries' objects, `Integrator` is for time loops of your own. Units are SI, positions and velocities are NumPy
arrays (n, 3) over the library's own memory.
"""

from __future__ import annotations

import importlib
from typing import Any

try:
    import numpy as _numpy  # noqa: F401
except ModuleNotFoundError as missing:
    raise ModuleNotFoundError(
        "hooke needs NumPy, which this Python has not: pip install numpy (Debian: python3-numpy)", name=missing.name
    ) from None

from .why import Why  # isort: skip  # before the function that has the name of its module
from ._queries import Blocks, BodyMotion, Derived, Material, build_facts
from ._status import BadCall, BadValue, Error, Internal, IOFailed, NoMemory, NotBuilt, SolverFailed, Stopped, Unsuited
from .cost import Check, Cost, check, cost
from .files import Verification, verify, view, write_xdmf
from .integrator import FitWarning, Integrator, Method, PassageWarning, StepWarning, methods
from .limit import Limit, limit
from .modes import Modes, modes
from .needs import Needs, needs
from .options import Options, Row, describe, options_of, part_kind_summary, part_kinds
from .parts import Curve, Springs, Transform
from .problems import FirstOrder, SecondOrder
from .rest import Rest, rest
from .results import Frames, Result, RunError, resume, run, why
from .scene import Scene
from .state import State
from .study import Study, compare, study
from .sweep import Sweep, sweep
from .system import System
from .trajectory import Energy, Frame, Trajectory, open

__version__: str = build_facts()["version"]

__all__ = [
    "BadCall",
    "BadValue",
    "Blocks",
    "BodyMotion",
    "Check",
    "Cost",
    "Curve",
    "Derived",
    "Energy",
    "Error",
    "FirstOrder",
    "FitWarning",
    "Frame",
    "Frames",
    "IOFailed",
    "Integrator",
    "Internal",
    "Limit",
    "Material",
    "Method",
    "Modes",
    "Needs",
    "NoMemory",
    "NotBuilt",
    "Options",
    "PassageWarning",
    "Rest",
    "Result",
    "Row",
    "RunError",
    "Scene",
    "SecondOrder",
    "SolverFailed",
    "Springs",
    "State",
    "StepWarning",
    "Stopped",
    "Study",
    "Sweep",
    "System",
    "Trajectory",
    "Transform",
    "Unsuited",
    "Verification",
    "Why",
    "animation",
    "build_facts",
    "check",
    "compare",
    "convert",
    "cost",
    "describe",
    "limit",
    "methods",
    "modes",
    "needs",
    "open",
    "options_of",
    "part_kind_summary",
    "part_kinds",
    "plot",
    "rest",
    "resume",
    "run",
    "study",
    "sweep",
    "verify",
    "view",
    "why",
    "write_xdmf",
]


def __dir__() -> list[str]:
    return __all__


def __getattr__(name: str) -> Any:
    # matplotlib is an extra, and slow to import
    if name in ("plot", "animation", "convert"):
        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
