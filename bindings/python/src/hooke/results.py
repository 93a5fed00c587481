"""Running a scene in one call. `hooke.open` reads the files of `output`."""

from __future__ import annotations

import contextlib
import copy
import ctypes
import itertools
import math
import os
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import Any, Callable, NamedTuple, Optional, Union

import numpy as np

from ._callback import hearing, stop_value
from ._keywords import RunKeywords
from ._library import lib
from ._look import WorkProgress, draw, shown
from ._measurement import Claim, Measurement, Record, said
from ._prototypes import PROBES, TRAJECTORY
from ._signature import Unpack, takes
from ._status import BadCall, BadValue, Error, SolverFailed, Unsuited
from ._types import FloatArray, Path, Table
from .files import numbers, opened, read_probes, run_options, view, write_companion
from .integrator import BLOWN_UP, Integrator, Observer, fit
from .options import Options
from .problems import FirstOrder, SecondOrder
from .problems import Problem as Base
from .scene import Scene
from .state import State
from .system import Force, System, kept, posed, system_of
from .why import Why

__all__ = ["Frames", "Result", "RunError", "resume", "run", "why"]

#: Problems that are no scene: a system, or a first- or second-order problem.
Problem = Union[System, FirstOrder, SecondOrder]
#: Problems that can be run: those, a scene, or the path or the document of one.
Runnable = Union[Path, Mapping[str, Any], Scene, Problem]
#: progress(fraction, state): called at each frame; `fraction` goes from 0 to 1.
Progress = Callable[[float, State], Optional[int]]
#: A length: a number [m], or text with a unit, such as "1mm".
Length = Union[float, str]
_CHOSEN = ("step", "rtol", "atol", "atol_velocity")
_STOPPED = 1


class Frames(NamedTuple):
    """The frames of a run: times (k,) [s], positions (k, n, 3) [m], velocities (k, n, 3) [m/s]; of a
    first-order problem `q` is (k, size) and `v` None, of a second-order problem both are (k, size)."""

    t: FloatArray
    q: Table
    v: FloatArray | None


class RunError(Record, table="estimate.estimate", without=("seconds", "memory_bytes", "reversal"), none=("by",)):
    """The error of a run; a number that is not known is NaN. `met` is None if that is unknown or no error was wanted."""


@dataclass
class Judged:
    """The error of a run, and what is said of it, if they were `found`; the same run with these `options` finds them."""

    found: tuple[RunError | None, tuple[Claim, ...]] | None = None
    options: dict[str, Any] = field(default_factory=dict)

    def of(self, problem: Problem) -> tuple[RunError | None, tuple[Claim, ...]]:
        """Both, of the problem that was run."""
        if self.found is None:
            with hearing():  # the first run gave its warnings
                again = run(problem, estimate=True, strict=True, **self.options)
            self.found = again.error, again.claims
        return self.found


@dataclass(frozen=True)
class Result:
    """The result of a run.

    `status` is "finished", "stopped", "diverged" or "step-limit"; the state is then the last good one, `message` has the
    details and `diverged_at` the time at which it was noticed [s] (NaN if not). `stop_value` is the value returned by the
    callback that stopped the run, `output` the file that was written, `probes_file` that of probes. `integrator` is kept
    if the run blew up, for `hooke.why`. `error` is the error of the run, None if there is no estimate, and `claims` what
    is said of it, which ``print(result)`` shows; both are found when they are first asked for. `watched` is a table of
    what was watched, a row a quantity, with the columns `quantity`, `unit`, `value` (at the end), `minimum`,
    `at_minimum`, `maximum`, `at_maximum`, and `from` and `until`: the time [s] that smallest and largest are known for,
    the whole run unless it ended early. `wants` is a table of what was wanted: `quantity`,
    `unit`, `wanted`, `error`, `met`.
    """

    status: str
    message: str
    state: State
    problem: Problem
    options: Options
    counts: dict[str, int]
    wall_seconds: float
    diverged_at: float
    stop_value: int
    frames: Frames | None = None
    output: Path | None = None
    integrator: Integrator | None = field(default=None, repr=False, compare=False)
    judged: Judged | None = field(default=None, repr=False, compare=False)
    probes_file: Path | None = None
    watched: Table | None = None
    wants: Table | None = None

    @property
    def error(self) -> RunError | None:
        """The error of the run, as runs at other steps or tolerances tell it, which are made now; None without an estimate."""
        return self.judged.of(self.problem)[0] if self.judged is not None else None

    @property
    def claims(self) -> tuple[Claim, ...]:
        """What is said of the run, the most important first."""
        return self.judged.of(self.problem)[1] if self.judged is not None else ()

    @property
    def diagnosis(self) -> str:
        """The cause of an early end of the run, with place and time, in a sentence or two; "" if it did not end
        early. ``hooke.why(result)`` has the rest."""
        return "" if self.integrator is None else self.integrator.diagnosis

    @property
    def probes(self) -> Table:
        """What was probed, from the file that was written: a structured array with the field "time" [s] and one for each
        quantity, a row a time. An HDF5 file needs h5py."""
        if self.probes_file is None:
            raise BadValue('probes: nothing was probed; run with probe="energy", probes="energy.csv"')
        return read_probes(self.probes_file)

    def to_pandas(self) -> Any:
        """The probes as a pandas data frame; pandas has to be installed."""
        return draw("notebook.data_frame", self.probes)

    @property
    def system(self) -> System:
        """The system that was run."""
        try:
            return system_of(self.problem, "system")
        except BadValue as missing:
            raise AttributeError(str(missing)) from None

    def __getstate__(self) -> dict[str, Any]:
        problem, judged = kept(self.problem), self.judged
        if judged is not None and judged.found is None and vars(problem)["_gone"]:
            judged = None
        return {**vars(self), "problem": problem, "judged": judged, "integrator": None}

    def __copy__(self) -> Result:
        return replace(self)

    def __deepcopy__(self, memo: Any) -> Result:
        return replace(self, state=self.state.copy(), frames=copy.deepcopy(self.frames, memo))

    def __str__(self) -> str:
        return said(self.claims) or repr(self)

    def __repr__(self) -> str:
        return (
            f"Result({self.status}, {self.options['method']}, t={self.state.t!r}, "
            f"steps={self.counts['steps']}, wall_seconds={self.wall_seconds:.3g})"
        )

    def _repr_html_(self) -> str | None:
        if self.output is None and self.integrator is not None:
            return self.integrator.why()._repr_html_()
        words: str = draw("notebook.paragraphs", self.diagnosis or said(self.claims))
        return (words + (draw("notebook.embed", lambda page: view(self, page)) if self.output is not None else "")) or None


def run(
    problem: Runnable,
    *,
    state: State | None = None,
    output: Path | None = None,
    frames: bool = False,
    force: Force | None = None,
    progress: Progress | bool | None = None,
    on_frame: Observer | None = None,
    on_step: tuple[int, Observer] | None = None,
    want: Length | None = None,
    estimate: bool | None = None,
    strict: bool = False,
    watch: str | Iterable[str] | None = None,
    probe: str | Iterable[str] | None = None,
    probe_every: float | str | None = None,
    probes: Path | None = None,
    **options: Unpack[RunKeywords],
) -> Result:
    """Runs a scene (or the path of one), a system, or a first- or second-order problem, and returns the `Result`.

    The keywords `options`, listed below, override the scene's own. A missing step is chosen, and step, `every` and
    duration that do not fit one another are adjusted, as ``hooke run`` does, each with a `FitWarning`, unless the run
    is `strict`. Numbers may have units: ``step="1 ms"``. `state` is the start (it is changed; by default the initial
    state), `output` the HDF5 file to write (with its ``.xdmf`` companion for ParaView; with `checkpoint` also
    ``<output>.checkpoint``, until the run has finished, for `hooke.resume`), ``frames=True`` keeps all frames in
    memory, `force` is the callback force of this run (see `System.set_force`), ``progress(fraction, state)`` is called
    at each frame, ``progress=True`` shows a bar (with tqdm); for `on_frame` and `on_step` see `Integrator.run`.

    ``want="1mm"`` (or a number [m]) picks a method and its step or tolerance such that no frame has a larger error,
    runs, measures the error, and refines if the wanted error is not met; a given `method` restricts the choice. A list,
    ``want="tip=2mm,line:max.tension=1%,energy=0.1J"``, bounds the errors of watched quantities, also in % of their
    largest value. The result's `error` holds it. Without `want` it is estimated when it is first asked for, with a few
    times the work of the run; ``estimate=True`` does it at once, and writes it into `output`, ``estimate=False`` never.
    A run from a `state` has none, and one with callbacks for forces or drives not without ``estimate=True``.

    ``watch="1.y,0.reaction,rope:max.tension"`` tells the values of quantities at the end, and the smallest and the
    largest over all steps, in the result's `watched`.

    ``probe="57.y,energy"`` writes these quantities, in the grammar of `watch`, into the file `probes` (.csv or .h5)
    while the run goes: a line every `probe_every` [s], which is that of frames if None. The result's `probes` reads
    them.
    """
    scene, problem, wanted = resolve(problem, force, options)
    once = _Once(problem, scene, output, frames, progress, on_frame, on_step, probe, probe_every, probes)
    start = problem.state() if state is None else state
    asked = want is not None or bool(estimate)
    if want is None and not strict:
        fit(problem, start, wanted)
    later = estimate is None and state is None and isinstance(problem, System) and not problem._callbacks
    if not asked and watch is None:
        return _judged_later(once.run(wanted, start), wanted, None) if later else once.run(wanted, start)
    if asked and state is not None:
        raise BadValue("state: want and estimate are for a system from its own initial state; leave it out")
    if output is not None:
        system_of(problem, "output")
    system = posed(problem) if watch is None else system_of(problem, "watch")
    wish = want.strip() if isinstance(want, str) else want
    chosen = Options._of("estimate").set(want=wish, callbacks=True, watch=watch, error=asked)
    measurement = Measurement.create("estimate", system, None, chosen)
    if not asked:
        result = once.run(wanted, start, measurement, judged=False)
        return _judged_later(result, wanted, watch) if later else result
    return _run_to_want(once, measurement, system, wanted, options, want, strict)


def _settled(problem: Problem, options: Options) -> Integrator:
    """An integrator of a whole run, which takes damping explicitly where the start of the system allows it."""
    chosen = options.copy()
    if isinstance(problem, System):
        lib.hooke_step_settle(problem._committed(), chosen._handle)
    return Integrator(problem, chosen)


@dataclass(frozen=True)
class _Once:
    """The unchanged parts of repeated runs."""

    problem: Problem
    scene: Scene | None
    output: Path | None
    frames: bool
    progress: Progress | bool | None
    on_frame: Observer | None
    on_step: tuple[int, Observer] | None
    probe: str | Iterable[str] | None
    probe_every: float | str | None
    probes: Path | None

    def run(self, options: Options, state: State, estimate: Measurement | None = None, judged: bool = True) -> Result:
        integrator = _settled(self.problem, options)
        integrator._title = self.scene.title if self.scene is not None else ""
        watchers: list[Observer] = [] if self.on_frame is None else [self.on_frame]
        recorder = _Recorder(integrator.frame_count, state) if self.frames else None
        if recorder is not None:
            watchers.append(recorder)
        if estimate is not None:
            lib.hooke_estimate_begin(estimate.handle, integrator._handle, state._handle)
            lib.hooke_estimate_follow(estimate.handle, integrator._handle)
            seen = estimate.handle
            watchers.append(lambda step, state: lib.hooke_estimate_see(step, state._handle, seen))
        with shown(self.progress, fills=False) as tell:  # a run may end early
            if tell is not None:
                last, numbers = max(integrator.frame_count - 1, 1), itertools.count()
                watchers.append(lambda step, state: tell(next(numbers) / last, state))
            with self._probing(integrator):
                status = self._integrate(integrator, state, watchers)
        frames = recorder.frames() if recorder else None
        result = _result(status, integrator, state, self.output, frames=frames, probes_file=self.probes)
        if estimate is None:
            return result
        lib.hooke_estimate_follow(None, integrator._handle)
        estimate.run(None, state)
        found = estimate.one(RunError, "estimate") if judged else None, tuple(estimate.each(Claim, "claims"))
        result = replace(result, judged=Judged(found))
        if judged and self.output is not None and status == "finished":
            lib.hooke_estimate_write_h5(estimate.handle, os.fsencode(self.output))
        watched, wants = (estimate.rows(table) if estimate.count(table) > 0 else None for table in ("watched", "wants"))
        return replace(result, watched=watched, wants=wants)

    @contextlib.contextmanager
    def _probing(self, integrator: Integrator) -> Iterator[None]:
        """Writes probes meanwhile; why that failed precedes what came of it."""
        if self.probe is None and self.probe_every is None and self.probes is None:
            yield
            return
        if self.probe is None or self.probes is None:
            raise BadValue("probe: names quantities, and probes the file that they go into; give both")
        options, file = Options._of("probes").set(probe=self.probe, probe_every=self.probe_every), PROBES()
        path = os.fsencode(self.probes)
        lib.hooke_probes_create(integrator._handle, options._handle, path, ctypes.byref(file))
        try:
            yield
        finally:
            lib.hooke_probes_close(file)

    def _integrate(self, integrator: Integrator, state: State, watchers: list[Observer]) -> str:
        if self.output is None:
            return integrator.run(state, on_frame=_all(watchers) if watchers else None, on_step=self.on_step)
        path, file, system = os.fsencode(self.output), TRAJECTORY(), system_of(self.problem, "output")
        text = None if self.scene is None else self.scene.text.encode()
        lib.hooke_trajectory_create(path, system._handle, integrator._handle, text, ctypes.byref(file))
        return _run_to_file(path, file, integrator.run, integrator, state, watchers, self.on_step)


def _judged_later(result: Result, options: Options, watch: str | Iterable[str] | None) -> Result:
    """The result with its error, which is found when it is asked for."""
    given = {"watch": watch, **{name: options[name] for name in options if options.is_set(name)}}
    return replace(result, judged=Judged(options=given)) if result.status == "finished" else result


def _run_to_want(
    once: _Once, estimate: Measurement, system: System, options: Options, given: RunKeywords, want: Length | None, strict: bool
) -> Result:
    """Runs; with a wanted error, picks a method and its step or tolerance, keeping a method that is among those `given`,
    and repeats until the error is met or nothing finer is known to help."""
    if want is not None:
        named = [name for name in _CHOSEN if given.get(name) is not None]
        if named:
            raise BadValue(f"want picks the step or the tolerance; leave out {' and '.join(named)}, or want")
        method = given.get("method")
        with estimate.listening(None):
            lib.hooke_estimate_pick(estimate.handle, None if method is None else method.encode(), options._handle)
        if not strict:
            fit(system, system.state(), options)
    watched = replace(once, problem=system)
    while True:
        result = watched.run(options, system.state(), estimate)
        if system is not once.problem:  # its states are those of the problem, too
            result = replace(result, problem=once.problem, state=result.state.copy())
        met = result.error is None or result.error.met
        if want is None or result.status != "finished" or met:
            return result
        try:
            lib.hooke_estimate_refine(estimate.handle, options._handle)
        except Unsuited:
            return result


@takes()
def resume(
    output: Path,
    problem: Runnable | None = None,
    *,
    threads: int | None = None,
    force: Force | None = None,
    progress: Progress | bool | None = None,
    on_frame: Observer | None = None,
    on_step: tuple[int, Observer] | None = None,
) -> Result:
    """Continues the run of the file `output`, which was stopped or killed: the file, the final state and the counts
    are then those of an uninterrupted run, to the bit. For a finished run the `Result` has the last frame, the one
    count in the file, "steps", and NaN for the time of the run.

    The options are those of the run, except `threads`. The scene is that of the run, too, unless `problem` is given,
    which is required if the run was not made from a scene, or used callbacks other than its `force`. Unsuited if
    callbacks of the run are missing. The run continues from the checkpoint beside the file; without one, from the last
    frame, and with error control from the beginning. The rest is as in `run`.
    """
    scene, record = Scene.load(output) if problem is None else None, opened(output)
    _, problem, _ = resolve(scene if problem is None else problem, force, {})  # type: ignore[arg-type]
    system, options = system_of(problem, "problem"), run_options(record).copy().set(threads=threads)
    del record  # the file is opened for writing
    integrator, state, file = Integrator(system, options), system.state(), TRAJECTORY()
    first, duration = state.t, float(integrator.options["duration"])  # type: ignore[arg-type]
    lib.hooke_trajectory_resume(
        os.fsencode(output), system._handle, integrator._handle, state._handle, ctypes.byref(file)
    )
    if not file:
        integrator.message = f"the run of {os.fsdecode(output)} had finished"
        record = opened(output)
        lib.hooke_record_read(record, -1, state._handle)
        counts = {"steps": int(numbers(record, "step")[lib.hooke_record_count(record, b"frames") - 1])}
        return replace(_result("finished", integrator, state, output), counts=counts, wall_seconds=np.nan)
    watchers: list[Observer] = [] if on_frame is None else [on_frame]
    with shown(progress, fills=False) as tell:
        if tell is not None:
            watchers.append(lambda step, state: tell((state.t - first) / duration, state))
        status = _run_to_file(os.fsencode(output), file, integrator.resume, integrator, state, watchers, on_step)
    return _result(status, integrator, state, output)


@takes(RunKeywords)
def why(
    what: Runnable | Result | SolverFailed,
    budget: float | str | None = None,
    progress: WorkProgress | bool | None = None,
    **options: Unpack[RunKeywords],
) -> Why | None:
    """Explains a run that blew up: the `Result` of one, the `SolverFailed` that it raised, or anything that
    `hooke.run` takes, which is then run with `options`. None if the run did not blow up.

    The last steps are repeated and suggestions are tried, so callbacks are called again; within `budget` [s] of wall
    time, or as much counted work as the run took (2 s if that is less), however busy the machine is.
    """
    if isinstance(what, (Result, SolverFailed)):
        if what.integrator is None and getattr(what, "status", None) not in ("finished", "stopped"):
            raise BadCall("this run was not pickled with its result, run it again: hooke.why(scene, **result.options)")
        return what.integrator.why(budget, progress) if what.integrator is not None else None
    scene, problem, wanted = resolve(what, None, options)
    state = problem.state()
    fit(problem, state, wanted)
    integrator = _settled(problem, wanted)
    integrator._title = scene.title if scene is not None else ""
    with contextlib.suppress(SolverFailed):
        integrator.run(state)
    return integrator.why(budget, progress) if integrator.outcome in BLOWN_UP else None


def _result(status: str, integrator: Integrator, state: State, output: Path | None, **others: Any) -> Result:
    names = ("message", "options", "counts", "wall_seconds", "diverged_at", "stop_value")
    return Result(
        status=status,
        state=state,
        problem=integrator._problem,
        output=output,
        integrator=integrator if integrator.outcome in BLOWN_UP else None,
        **others,
        **{name: getattr(integrator, name) for name in names},
    )


def resolve(
    problem: Runnable, force: Force | None, options: Mapping[str, object]
) -> tuple[Scene | None, Problem, Options]:
    """The scene (if there is one), the problem, and the options of a run of it."""
    scene, given = None, Options.for_run()
    if isinstance(problem, (str, os.PathLike)):
        problem = Scene.load(problem)
    elif isinstance(problem, Mapping):
        problem = Scene.parse(problem)
    elif not isinstance(problem, Base):
        raise TypeError(f"a scene, its path or document, or a system is needed, this is {problem!r}")
    if isinstance(problem, Scene):
        scene, given = problem, problem.run_options.copy()
        problem = scene.system
    if force is not None:
        problem = system_of(problem, "force")._with_force(force)
    return scene, problem, given.set(**options)


def measured(
    kind: str, problem: Runnable, keywords: Mapping[str, object], progress: Any, at: Any = None, force: Force | None = None
) -> tuple[Measurement, Scene | None, System, int]:
    """A measurement of a kind, done `at` a state of a system, with its scene, its system and the status. The keywords
    are options of the kind, or of its runs, which may be in several threads."""
    chosen, given = Options._of(kind), dict(keywords)
    chosen.set(**{name: given.pop(name) for name in list(given) if name in chosen})
    scene, found, options = resolve(problem, force, given)
    system, threads = posed(found) if kind == "study" else system_of(found, kind), options["threads"]
    if system._callbacks and isinstance(threads, int) and threads > 1:
        raise BadValue(f"threads: {threads} is not allowed with callbacks in Python; leave it at 1")
    state = at and at(system)
    if kind == "check":
        with contextlib.suppress(Unsuited):
            fit(system, state or system.state(), options)
    made = Measurement.create(kind, system, options, chosen)
    return made, scene, system, made.run(progress, state)


def _all(watchers: list[Observer]) -> Observer:
    """All of them, up to one that stops the run."""
    return lambda step, state: next(filter(None, (stop_value(watcher(step, state)) for watcher in watchers)), None)


def _run_to_file(
    path: bytes,
    file: Any,
    run: Callable[..., str],
    integrator: Integrator,
    state: State,
    watchers: list[Observer],
    on_step: tuple[int, Observer] | None,
) -> str:
    if not watchers:  # existing frames are reported to the observer
        lib.hooke_trajectory_write_behind(file)

    def write(step: int, state: State) -> None:
        if not math.isnan(integrator.diverged_at):
            lib.hooke_trajectory_mark_diverged(file)
        lib.hooke_trajectory_write(file, step, state._handle)

    def keep(step: int, state: State) -> None:
        lib.hooke_trajectory_checkpoint(file, integrator._handle, state._handle)

    try:
        status = run(state, on_frame=_all([write, *watchers]), on_step=on_step, on_checkpoint=keep)
        if status == "stopped":
            _keep_place(keep, state)
    except BaseException as exception:
        outcome = getattr(exception, "status", None)
        with contextlib.suppress(Error):  # the exception takes precedence
            _keep_place(keep, state)
        with contextlib.suppress(BadCall):  # in a fork
            lib.hooke_trajectory_close(file, outcome if isinstance(outcome, int) else _STOPPED)
        raise
    lib.hooke_trajectory_close(file, integrator.outcome)
    write_companion(path)
    return status


def _keep_place(keep: Callable[[int, State], None], state: State) -> None:
    """A point to continue from, if the method has one: non-finite numbers, and error control without checkpoints,
    give none."""
    with contextlib.suppress(Unsuited, BadValue, BadCall):
        keep(0, state)


class _Recorder:
    def __init__(self, frame_count: int, state: State):
        self._count = 0
        self._kept = [np.empty((frame_count, *array.shape), array.dtype) for array in _arrays(state)]

    def __call__(self, step: int, state: State) -> None:
        for rows, array in zip(self._kept, _arrays(state)):
            rows[self._count] = array
        self._count += 1

    def frames(self) -> Frames:
        t, q, *v = (kept[: self._count] for kept in self._kept)
        return Frames(t, q, v[0] if v else None)


def _arrays(state: State) -> list[Table]:
    """Time, positions and velocities, or time and the unknowns of a first-order problem."""
    return [np.asarray(state.t), *([state.x] if state._v is None else [state.q, state.v])]


run = Base.run = takes(RunKeywords)(run)
