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

from .why import *  # isort: skip  # before the function that has the name of its module
from ._queries import *
from ._status import *
from .cost import *
from .files import *
from .integrator import *
from .limit import *
from .modes import *
from .needs import *
from .options import *
from .parts import *
from .problems import *
from .rest import *
from .results import *
from .scene import *
from .state import *
from .study import *
from .sweep import *
from .system import *
from .trajectory import *

_MODULES = ("animation", "convert", "plot")  # matplotlib is an extra, and slow to import

__version__: str = build_facts()["version"]
_HERE = f"{__name__}."
__all__ = [*_MODULES, *(name for name, one in globals().items() if str(getattr(one, "__module__", "")).startswith(_HERE))]


def __dir__() -> list[str]:
    return sorted(__all__)


def __getattr__(name: str) -> Any:
    if name in _MODULES:
        return importlib.import_module(f".{name}", __name__)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
