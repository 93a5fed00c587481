"""Reading trajectory files without h5py: the output of a run, as arrays. The files are H5MD 1.1 (HDF5), so that h5py
and other programs read them, too."""

from __future__ import annotations

import math
import os
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any, Callable, NamedTuple, TypeVar, overload

import numpy as np

from ._library import lib
from ._look import draw
from ._memory import Asked, Closing, text
from ._status import BadValue, plain
from ._types import FloatArray, IntArray, Path
from .files import numbers, opened, run_options, view, view_of
from .results import Frames, RunError
from .scene import Scene
from .state import State
from .system import System

if TYPE_CHECKING:
    from .plot._pictures import FuncAnimation

__all__ = ["Energy", "Frame", "Trajectory", "open"]


K = TypeVar("K")
#: The numbers of an error in their order in a file.
_ERROR = (
    "estimate", "rms", "known_until", "energy_rise", "wanted", "met", "heat_excess", "last_piece", "last_from",
)


class Frame(NamedTuple):
    """One frame: the number of its step, its time [s], positions (n, 3) [m] and velocities (n, 3) [m/s]."""

    step: int
    t: float
    q: FloatArray
    v: FloatArray


class Energy(NamedTuple):
    """Energies [J] and dissipated power [W] at every frame, each (frames,)."""

    kinetic: FloatArray
    potential: FloatArray
    total: FloatArray
    dissipated_power: FloatArray


class Trajectory(Closing):
    """The output file of a run, see `open`.

    ``len(trajectory)`` is the number of written frames, which is less than planned if the run was killed.
    ``trajectory[k]`` is a `Frame`, ``trajectory[a:b]`` the `Frames` of a slice, and a loop goes over frames.
    Positions and velocities are mapped from the file, not read: only the pages accessed are loaded into memory.
    """

    def __init__(self, path: Path):
        self.path: str = os.fsdecode(path)  #: the file
        self._handle = opened(path)
        self._kept: dict[Any, Any] = {}
        self._count: int = lib.hooke_record_count(self._handle, b"frames")

    def __reduce__(self) -> Any:
        assert self._handle  # which is a BadCall once it is closed
        return type(self), (os.path.abspath(self.path),)

    def _keep(self, what: Any, read: Callable[[], K]) -> K:
        """What was read before, or is now."""
        if what not in self._kept:
            self._kept[what] = read()
            if isinstance(self._kept[what], np.ndarray):
                self._kept[what].flags.writeable = False
        kept: K = self._kept[what]
        return kept

    def _numbers(self, what: str) -> FloatArray:
        return self._keep(what, lambda: numbers(self._handle, what))

    def _integers(self, what: str) -> IntArray:
        return self._keep((what, int), lambda: self._numbers(what).astype(np.int64))

    def _rows(self, what: str) -> FloatArray:
        return self._keep(what, lambda: self._mapped(what))

    def _mapped(self, what: str) -> FloatArray:
        shape = (self._count, len(self.mass), 3)
        place = lib.hooke_record_place(self._handle, what.encode())
        if 0 in shape:
            return np.empty(shape)
        if place >= 0:
            mapped = np.memmap(self.path, np.float64, "r", offset=place, shape=shape)
            return mapped.view(np.ndarray)
        return self._copied(what, shape)

    def _copied(self, what: str, shape: tuple[int, int, int]) -> FloatArray:
        """Frames that another program has stored in another layout, such as compressed."""
        state, frames = State._of_particles(shape[1]), np.empty(shape)
        for frame in range(self._count):
            lib.hooke_record_read(self._handle, frame, state._handle)
            frames[frame] = state.q if what == "position" else state.v
        return frames

    def _text(self, what: bytes) -> str:
        return text(lib.hooke_record_text(self._handle, what))

    def _of_frames(self, what: str) -> FloatArray:
        return self._numbers(what)[: self._count]

    def _of_species(self, number: int) -> IntArray:
        return np.flatnonzero(self._numbers("species") == number)

    t = Asked(_of_frames, "Times of the frames (frames,) [s].", "time")
    q = Asked(_rows, "Positions (frames, n, 3) [m], read-only, mapped from the file.", "position")
    v = Asked(_rows, "Velocities (frames, n, 3) [m/s], read-only, mapped from the file.", "velocity")
    momentum = Asked(_of_frames, "Momentum of the free particles (frames, 3) [kg m/s].", "momentum")
    angular_momentum = Asked(
        _of_frames,
        "Angular momentum of the free particles about the origin (frames, 3) [kg m^2/s].",
        "angular_momentum",
    )
    mass = Asked(_numbers, "Mass of every particle (n,) [kg].", "mass")
    pinned = Asked(_of_species, "Numbers of the pinned particles (k,).", 1)
    driven = Asked(_of_species, "Numbers of the driven particles (k,).", 2)
    steps = Asked[IntArray](lambda file: file._integers("step")[: len(file)], "Numbers of the steps at the frames (frames,).")
    springs = Asked[IntArray](
        lambda file: file._integers("springs").reshape(-1, 2),
        "The particles at both ends of every spring (m, 2), in spring order.",
    )
    options = Asked(lambda file: run_options(file._handle), "The options of the run, with defaults filled in.")
    status = Asked(
        _text,
        'How the run ended: "finished", "stopped", "diverged", "step-limit", "solver-failed" or "failed"; "running" while '
        "it lasts, or if it was killed.",
        b"status",
    )
    run = Asked(_text, "Identifier of the run: 32 hexadecimal digits, unique to the run.", b"run")
    callbacks = Asked(
        _text,
        'The callbacks of the run: "none", "force", "force with derivative", "drive", "force and drive", "force with '
        'derivative and drive"; "" in files of earlier versions. The file cannot hold them: who gives them again can '
        "`resume`.",
        b"callbacks",
    )

    @property
    def energy(self) -> Energy:
        """Energies at every frame: `kinetic`, `potential`, `total` [J], `dissipated_power` [W], each (frames,)."""
        names = ("kinetic_energy", "potential_energy", "total_energy", "dissipated_power")
        return Energy(*map(self._of_frames, names))

    @property
    def beyond(self) -> slice:
        """The frames after the run diverged, which ``past_divergence`` adds and which are no physics, as a slice; an empty
        one where there are none."""
        return slice(int(lib.hooke_record_count(self._handle, b"good_frames")), self._count)

    # what was run

    @property
    def error(self) -> RunError | None:
        """The error of the run, as estimated after it; None if it was not estimated."""
        by, reason = self._text(b"error_by"), self._text(b"error_reason")
        if not (by or reason) or len(self._numbers("error")) != len(_ERROR):
            return None  # not estimated, or by an earlier version, which knew parts alone
        found = dict(zip(_ERROR, self._numbers("error").tolist()))
        met = None if math.isnan(found["met"]) else found["met"] == 1.0
        return RunError(**{**found, "met": met, "by": by, "reason": reason})

    @property
    def scene(self) -> Scene | None:
        """The scene of the run, with its options; None if the run was not made from one."""
        if not self._text(b"scene"):
            return None
        return self._keep("scene", lambda: Scene.load(self.path))

    @property
    def system(self) -> System:
        """The system of the scene, without callbacks for a force or a drive."""
        if self.scene is None:
            raise BadValue(f"{self.path}: holds no scene: the run was not made from one")
        return self.scene.system

    def check(self, frame: int | None = None) -> None:
        """Compares the numbers of a frame, or of all frames, with their check values. BadValue names a damaged frame.
        `state` makes this check itself; data that are mapped or read as a whole column, such as `q` and `energy`, are
        not checked."""
        for k in range(self._count) if frame is None else [frame]:
            lib.hooke_record_check(self._handle, k)

    def state(self, frame: int = -1) -> State:
        """The state at a frame, a copy, to continue from or for queries of the system; needs the scene. BadValue if
        the frame is damaged."""
        state = self.system.state()
        lib.hooke_record_read(self._handle, frame, state._handle)
        return state

    def strain(self, frame: int = -1) -> FloatArray:
        """Strain of every spring at a frame (m,): length over rest length, minus 1; infinite or NaN where the rest
        length is 0. Needs the scene."""
        rest = self.system.spring_material.rest_length
        q, ends = self[frame].q, self.springs
        length = np.linalg.norm(q[ends[:, 0]] - q[ends[:, 1]], axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            strain: FloatArray = length / rest - 1
        return strain

    def tension(self, frame: int = -1) -> FloatArray:
        """Tension of every spring at a frame (m,) [N], see `System.tension`. Needs the scene."""
        state = self.state(frame)
        return self.system.tension(state.q, state.v, state.t)

    def reaction(self, frame: int = -1) -> FloatArray:
        """Force of the support of every particle at a frame (n, 3) [N], see `System.reaction`. Needs the scene. BadValue
        for a run with a callback for a force, which no file holds."""
        if "force" in self.callbacks:
            raise BadValue(f"{self.path}: the forces of its callback are not known; take `System.reaction` of its system")
        state = self.state(frame)
        return self.system.reaction(state.q, state.v, state.t)

    def watched(self, watch: str | Iterable[str]) -> dict[str, tuple[str, FloatArray]]:
        """Quantities at every frame, in the grammar of ``hooke.run(watch=...)``: of each the unit and the values (frames,).
        Needs the scene."""
        found = view_of(self.path, None, {"watch": watch, "springs": 1, "size": 2000, "beyond": 10**9})
        rows = [(found.series("watched", row, "value"), row) for row in range(found.count("watched"))]
        of, unit = ([found.text("watched", row, what) for _, row in rows] for what in ("quantity", "unit"))
        return {name: (of_it, series) for name, of_it, (series, _) in zip(of, unit, rows) if series is not None}

    # pictures

    def plot(self, ax: Any = None, *, frame: int = -1, **options: Any) -> Any:
        """Draws the springs at a frame in space and returns the axes; see `hooke.plot.cloth`."""
        return draw("plot.cloth", self, ax=ax, frame=frame, **options)

    def animate(self, **options: Any) -> FuncAnimation:
        """A film of the frames, for a notebook, for `save`, or for ``matplotlib.pyplot.show``; see
        `hooke.animation.animate`."""
        film: FuncAnimation = draw("animation.animate", self, **options)
        return film

    # as a sequence

    def __len__(self) -> int:
        """The number of frames."""
        return self._count

    @overload
    def __getitem__(self, frame: int) -> Frame: ...

    @overload
    def __getitem__(self, frame: slice) -> Frames: ...

    def __getitem__(self, frame: int | slice) -> Frame | Frames:
        """A `Frame`, negative numbers from the end; the `Frames` of a slice."""
        if isinstance(frame, slice):
            return Frames(self.t[frame], self.q[frame], self.v[frame])
        if not -self._count <= frame < self._count:
            raise IndexError(f"frame {frame}: {plain(self.path)} has {self._count} frames")
        return Frame(int(self.steps[frame]), float(self.t[frame]), self.q[frame], self.v[frame])

    def __iter__(self) -> Iterator[Frame]:
        """The frames in order."""
        return (self[frame] for frame in range(self._count))

    def __repr__(self) -> str:
        return f"Trajectory({self.path!r}, {self._count} frames)"

    def _repr_html_(self) -> str:
        shown: str = draw("notebook.embed", lambda page: view(self.path, page))
        return shown

    def close(self) -> None:
        """Closes the file; arrays obtained from it stay valid. A second call does nothing."""
        self._kept.clear()
        super().close()


def open(path: Path) -> Trajectory:
    """Opens the output file of a run, finished or not, as a `Trajectory`::

        with hooke.open("out.h5") as out:
            print(len(out), out.t[-1], out.energy.total[-1])
            out.animate().save("out.gif")

    IOFailed if it cannot be read, BadValue if hooke did not write it.
    """
    return Trajectory(path)
