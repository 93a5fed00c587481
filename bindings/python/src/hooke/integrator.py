"""Methods, and the loop that runs them."""

from __future__ import annotations

import contextlib
import os
from typing import Any, Callable, NamedTuple, Optional

import numpy as np

from . import _callback
from ._keywords import RunKeywords
from ._library import lib
from ._look import WorkProgress
from ._memory import Asked, Closing, Handle, double_pointer, doubles, index_pointer, indices, text
from ._prototypes import OBSERVER, WARNING
from ._signature import Unpack, takes
from ._status import OUTCOMES, BadCall, NotBuilt, SolverFailed, Unsuited
from ._types import FloatArray, Path
from .options import Options
from .problems import FirstOrder, SecondOrder
from .state import State
from .system import System
from .why import Why

__all__ = ["FitWarning", "Integrator", "Method", "PassageWarning", "StepWarning", "methods"]

#: observer(step, state): receives the state after `step` steps and must not change it; returns None or 0 to go on.
Observer = Callable[[int, State], Optional[int]]

COUNTS = (
    "steps",
    "force_evaluations",
    "derivative_products",
    "nonlinear_iterations",
    "nonlinear_failures",
    "linear_iterations",
    "error_test_failures",
    "explicit_damping",
    "zero_passages",
    "coincident_springs",
    "memory_bytes",
)

#: Outcomes of a run that blew up.
BLOWN_UP = (2, 3, SolverFailed.status)
_LONG = 50_000  # numbers times steps that may take long enough for Ctrl-C to matter
_RUNNING = "this integrator is running; a callback or another thread needs one of its own"


class Method(NamedTuple):
    """A method: its name, a one-line description, whether it chooses its steps itself, whether this build has it, and
    whether it takes systems with rigid bodies, overdamped ones, and `FirstOrder` problems."""

    name: str
    summary: str
    adaptive: bool
    built: bool
    bodies: bool
    overdamped: bool
    first_order: bool


def methods() -> list[Method]:
    """All methods, in the library's order."""

    def method(name: bytes) -> Method:
        suited = [lib.hooke_method_is_suited(name, problem) for problem in (b"bodies", b"overdamped", b"first-order")]
        answers = lib.hooke_method_is_adaptive(name), lib.hooke_method_is_built(name), *suited
        return Method(text(name), text(lib.hooke_method_summary(name)), *(answer == 1 for answer in answers))

    return [method(lib.hooke_method_name(number)) for number in range(lib.hooke_method_count())]


class StepWarning(RuntimeWarning):
    """The step of a run is no longer certain to be stable; the text says where, when, and by how much."""


class PassageWarning(RuntimeWarning):
    """A spring passed through length zero, where its force turns round; the text says which, when, and what to do."""


class FitWarning(UserWarning):
    """The step, `every` or the duration of a run was chosen or adjusted, so that they fit one another; the text says how."""


class Integrator(Closing):
    """A method with its options, made for one system or first- or second-order problem; several may share a system.

    Options are those that ``hooke.describe("run")`` lists: method, step [s], duration [s], every [s], rtol, atol [m],
    atol_velocity [m/s], ...; keywords override `options`. The system is committed if it was not. An integrator and
    its state belong to one thread at a time. Other Python threads continue while it runs. `close`, or the end of a
    ``with`` block, releases its memory.
    """

    @takes(RunKeywords)
    def __init__(
        self, problem: System | FirstOrder | SecondOrder, options: Options | None = None, **keywords: Unpack[RunKeywords]
    ):
        chosen = (options.copy() if options is not None else Options.for_run()).set(**keywords)
        self._problem = problem  # its callbacks are called by the library
        self._handle = problem._integrator(chosen)
        self._numbers = 3 * problem.particle_count if isinstance(problem, System) else problem._size
        self._running = False
        self.outcome = 0  # the last outcome as the library's number
        self._title = ""  # of the scene that it runs
        self.message = ""  # the library's message about the last outcome that was not "finished"

    @property
    def options(self) -> Options:
        """The options of its runs, defaults filled in."""
        return Options(Handle(lib.hooke_integrator_options(self._handle), None, self._handle), read_only=True)

    def run(
        self,
        state: State,
        *,
        on_frame: Observer | None = None,
        on_step: tuple[int, Observer] | None = None,
        on_checkpoint: Observer | None = None,
    ) -> str:
        """Runs `duration` from the state's time on and leaves the final state in `state`.

        ``on_frame(step, state)`` is called at each frame, with ``on_step=(stride, f)`` ``f(step, state)`` after every
        `stride` steps, and ``on_checkpoint(step, state)`` at each checkpoint of the option `checkpoint`, where
        `write_checkpoint` can save the run. Returns "finished", "stopped" (a callback asked for it), "diverged" or
        "step-limit"; `message` then has the details. An exception of a callback ends the run and is raised again; so
        does Ctrl-C. A step that is not certain to be stable, and a scene that may mislead, give a `StepWarning`, springs
        that passed through length zero a `PassageWarning`.
        """
        return self._whole(lib.hooke_integrator_run, state, on_frame, on_step, on_checkpoint)

    def resume(
        self,
        state: State,
        *,
        on_frame: Observer | None = None,
        on_step: tuple[int, Observer] | None = None,
        on_checkpoint: Observer | None = None,
    ) -> str:
        """Continues a run to its end from where `read_checkpoint` placed the integrator and the state, or where a
        callback stopped a run with a fixed step. Bits and counts are those of an uninterrupted run. Frames that were
        reported are not reported again. The rest is as in `run`."""
        return self._whole(lib.hooke_integrator_resume, state, on_frame, on_step, on_checkpoint)

    def write_checkpoint(self, path: Path, state: State, run: str = "") -> None:
        """Writes a checkpoint of the run, with `state` as observers receive it, or as a stopped `run` left it. An
        error-controlled method writes the last of its checkpoints. The previous file stays as ``<path>.previous``;
        `run` (63 bytes at most) identifies the run."""
        lib.hooke_checkpoint_write(os.fsencode(path), self._handle, state._handle, run.encode())

    def read_checkpoint(self, path: Path, state: State, run: str | None = None) -> None:
        """Sets the integrator and `state` to the point that the file holds, or, if it is damaged or missing, the
        previous one, for `resume` or `step`. BadValue for files of another problem, other options (but for threads),
        or another `run`."""
        label = None if run is None else run.encode()
        lib.hooke_checkpoint_read(os.fsencode(path), label, self._handle, state._handle)

    def step(self, state: State, steps: int = 1) -> str:
        """Takes `steps` steps without frames, for time loops of your own; returns an outcome as `run`
        does."""
        return self._take(steps, lib.hooke_integrator_step, state._handle, steps)

    def begin(self, state: State, t0: float, step: int) -> str:
        """Begins a motion at `state` as the one after `step` fixed steps of a motion that began at time `t0` [s], with its
        times to the bit. Returns an outcome as `run` does, by the energy of earlier steps of the same motion."""
        return self._take(1, lib.hooke_integrator_begin, state._handle, t0, step)

    def advance(self, steps: int = 1) -> str:
        """Takes `steps` steps of the integrator's own motion, continuing from where the last call left it;
        ``step(state, 0)`` begins one at a state. It gives the same bits as `step` in less time: no state is read or
        written, and states are stale until `sync`. Returns an outcome as `run` does."""
        return self._take(steps, lib.hooke_integrator_advance, steps)

    def sync(self, state: State) -> str:
        """Writes time, positions and velocities of the motion into `state`; after "diverged", the last good ones.
        Returns "finished", or "diverged" if numbers of the motion are not finite."""
        return self._take(1, lib.hooke_integrator_sync, state._handle)

    def get(self, particles: Any) -> tuple[FloatArray, FloatArray]:
        """Positions [m] and velocities [m/s] of particles of the motion (a number or several): two arrays of the shape of
        `particles`, each with x y z in a last dimension."""
        shape, particles = (*np.shape(particles), 3), indices(particles, "particles")
        q, v = np.empty(shape), np.empty(shape)
        given = particles.size, index_pointer(particles), double_pointer(q), double_pointer(v)
        self._call(lib.hooke_integrator_get, given)
        return q, v

    def put(self, particles: Any, q: Any = None, v: Any = None) -> None:
        """Sets particles of the motion to positions `q` [m] and velocities `v` [m/s], shaped as in `get`; None leaves
        them. A pinned particle is held at the position set, a driven one keeps its prescribed motion, and only
        non-finite numbers count as divergence from then on. An error-controlled method restarts."""
        shape, particles = (*np.shape(particles), 3), indices(particles, "particles")
        given = ((None if values is None else doubles(values, name, shape)) for values, name in ((q, "q"), (v, "v")))
        pointers = [None if values is None else double_pointer(values) for values in given]
        self._call(lib.hooke_integrator_put, (particles.size, index_pointer(particles), *pointers))

    def _take(self, steps: int, function: Any, *arguments: Any) -> str:
        if self._problem._callbacks or (steps > 1 and steps * self._numbers > _LONG):
            with _callback.interruptible(self._handle):
                code = self._call(function, arguments)
        else:
            code = self._call(function, arguments)
        return self._outcome(code) if code or self.outcome else "finished"

    def _call(self, function: Any, arguments: tuple[Any, ...]) -> int:
        # called once a step in loops: nothing here that takes microseconds
        if self._running:
            raise BadCall(_RUNNING)
        self._running = True
        try:
            code: int = function(self._handle, *arguments)
        except SolverFailed as failure:
            self.outcome, self.message = failure.status or 0, str(failure)
            failure.integrator = self
            raise
        finally:
            self._running = False
        return code

    def why(self, budget: float | str | None = None, progress: WorkProgress | bool | None = None) -> Why:
        """Explains the last run, which has to have ended early: "diverged", "step-limit" or `SolverFailed`; with
        `budget` and `progress` as for `hooke.why`."""
        return Why(self._handle, self._problem, self._title, budget, progress)

    @property
    def diagnosis(self) -> str:
        """The cause of an early end of the last run, with place and time, in a sentence or two; "" if it did not end
        early. It repeats the last steps and tries suggestions, with as much work as the run took, or 2 s if that is more."""
        if self.outcome not in BLOWN_UP:
            return ""
        try:
            return self.why().sentence
        except (NotBuilt, Unsuited):
            return self.message

    def _whole(self, function: Any, state: State, on_frame: Any, on_step: Any, on_checkpoint: Any) -> str:
        if self._running:
            raise BadCall(_RUNNING)
        stride, step_observer = on_step or (1, None)
        watched = (
            (lib.hooke_integrator_on_frame, on_frame),
            (lib.hooke_integrator_on_step, step_observer, stride),
            (lib.hooke_integrator_on_checkpoint, on_checkpoint),
        )
        with contextlib.ExitStack() as during:
            for attach, observer, *how in watched:
                during.enter_context(_callback.attached(attach, self._handle, _observer(observer, state), *how))
            with contextlib.suppress(NotBuilt, Unsuited):
                during.enter_context(_callback.attached(lib.hooke_integrator_on_warning, self._handle, _WARN))
            during.enter_context(_callback.interruptible(self._handle))
            outcome = self._outcome(self._call(function, (state._handle,)))
        sentence = text(lib.hooke_integrator_text(self._handle, b"zero_passages"))
        if sentence and outcome not in ("diverged", "step-limit"):
            _callback.warn(sentence, PassageWarning)
        return outcome

    def _outcome(self, code: int) -> str:
        self.outcome = code
        self.message = text(lib.hooke_last_error()) if code else ""
        return OUTCOMES.get(code, f"outcome {code}")

    def _count(self, what: str) -> int:
        return int(lib.hooke_integrator_count(self._handle, what.encode()))

    def _number(self, what: bytes) -> float:
        return float(lib.hooke_integrator_number(self._handle, what))

    frame_count = Asked(_count, "Number of frames of a whole run, including the initial one.", "frames")
    stop_value = Asked(_count, "Value that the callback which stopped the run returned; 0 if none did.", "stop_value")
    wall_seconds = Asked(_number, "Time spent stepping [s], without observers and output.", b"wall_seconds")
    diverged_at = Asked(_number, "Time at which divergence was noticed [s]; NaN if it was not.", b"diverged_at")

    @property
    def counts(self) -> dict[str, int]:
        """Counts since the integrator was made: steps, force evaluations, solver iterations, ...; without those that
        are not known, as "zero_passages" of a run that went on from a file."""
        counts = {what: self._count(what) for what in COUNTS}
        return {what: count for what, count in counts.items() if count >= 0}

    def __repr__(self) -> str:
        return f"Integrator({self._problem!r}, {self.options!r})"


def _observer(function: Observer | None, state: State) -> Any:
    if not function:
        return OBSERVER()

    def observer(step: int, _state: int, _: Any) -> int:
        return _callback.guarded(function, step, state)

    return OBSERVER(observer)


def _warn(kind: bytes, sentence: bytes, *_: Any) -> int:
    category = FitWarning if kind in (b"step", b"every", b"duration") else StepWarning
    return _callback.guarded(_callback.warn, text(sentence), category)


_WARN = WARNING(_warn)


def fit(problem: Any, state: State, options: Options) -> None:
    """Has the step, `every` and the duration of a run of a system fit one another; each change is a `FitWarning`."""
    if isinstance(problem, System):
        place = lib.hooke_state_position(state._handle)
        lib.hooke_step_fit(problem._committed(), place, options._handle, _WARN, None)
