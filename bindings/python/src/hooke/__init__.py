"""hooke: mass-spring systems, how they move, and how much accuracy each method buys for its cost.

>>> import hooke
>>> result = hooke.run("cloth.json", method="symplectic-euler", step=1e-3, duration=2.0)
>>> result.status, result.state.q.shape
('finished', (256, 3))

A scene comes from a file (`Scene.load`), from text (`Scene.parse`), or is built (`System`). `run` integrates
it, `compare` sets several methods against a tight reference, `study` measures error against cost and
recommends, `limit` finds the largest stable steps, `cost` tells what each ingredient costs, `needs` finds what a
scene can do without, `why` explains a run that blew up, `view` makes a page that plays a trajectory, `Integrator` gives you the loop. Units are SI, positions and
velocities are NumPy arrays (n, 3) over the library's own memory.
"""

from __future__ import annotations

import importlib
from typing import Any

from ._queries import Blocks, Derived, Material, build_facts
from ._status import BadCall, BadValue, Error, IOFailed, NoMemory, NotBuilt, SolverFailed, Stopped, Unsuited
from .comparison import Comparison, compare
from .cost import Cost, cost
from .first_order import FirstOrder
from .integrator import Integrator, Method, StepWarning, methods
from .limit import Limit, limit
from .needs import Needs, needs
from .options import Options, describe, part_kinds
from .results import Frames, Result, run
from .scene import Scene
from .state import State
from .study import Study, study
from .system import System
from .view import view, write_xdmf
from .why import Why, why

__version__ = "0.1.0"

__all__ = [
    "BadCall",
    "BadValue",
    "Blocks",
    "Comparison",
    "Cost",
    "Derived",
    "Error",
    "FirstOrder",
    "Frames",
    "IOFailed",
    "Integrator",
    "Limit",
    "Material",
    "Method",
    "Needs",
    "NoMemory",
    "NotBuilt",
    "Options",
    "Result",
    "Scene",
    "SolverFailed",
    "State",
    "StepWarning",
    "Stopped",
    "Study",
    "System",
    "Unsuited",
    "Why",
    "build_facts",
    "compare",
    "cost",
    "describe",
    "limit",
    "methods",
    "needs",
    "part_kinds",
    "plot",
    "run",
    "study",
    "view",
    "why",
    "write_xdmf",
]


def __getattr__(name: str) -> Any:
    # matplotlib is an extra, and slow to import
    if name == "plot":
        return importlib.import_module(".plot", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
