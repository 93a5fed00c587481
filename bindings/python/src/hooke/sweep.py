"""Sweeps: many runs of a scene with other values, on any executor, a row each, whole or absent, never run twice."""

from __future__ import annotations

import collections
import contextlib
import hashlib
import inspect
import io
import itertools
import json
import os
import pickle
import queue
from collections.abc import Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future
from dataclasses import dataclass
from pathlib import Path as File
from typing import Any, Callable, Union, overload

import numpy as np

from ._callback import hearing
from ._keywords import RunKeywords
from ._look import WorkProgress, draw, shown
from ._measurement import Found
from ._queries import build_facts
from ._signature import Unpack, refuse_unknown
from ._status import BadValue, Error, SolverFailed
from ._types import Path, Table
from .results import Length, Result
from .results import run as run_scene
from .scene import Scene
from .state import State
from .system import Force

__all__ = ["Sweep", "sweep"]

#: Values by paths such as "run.step" or "cloth.structural.stiffness": their combinations, or those of each row.
Vary = Union[Mapping[str, Iterable[Any]], Iterable[Mapping[str, Any]], Any]


class Sweep(Sequence[dict[str, Any]]):
    """The rows of a sweep that are there, in the order of what is varied: a dict each, with the values by their `paths`,
    `status`, `reason` (why a run did not finish), and what came of it. What is not known is None."""

    def __init__(self, paths: list[str], lines: list[bytes]):
        self.paths = paths
        self._lines = lines  # as JSON they take a tenth of the memory

    def __len__(self) -> int:
        return len(self._lines)

    def __getitem__(self, place: Any) -> Any:
        if isinstance(place, slice):
            return Sweep(self.paths, self._lines[place])
        row = json.loads(self._lines[place])
        del row["key"]
        return row

    def to_pandas(self) -> Any:
        """The rows as a pandas data frame; pandas has to be installed."""
        return draw("notebook.data_frame", list(self))

    def to_xarray(self) -> Any:
        """The rows as an xarray dataset with a dimension a path; xarray and pandas have to be installed."""
        frame = self.to_pandas()
        for path in self.paths:  # a vector is no coordinate
            frame[path] = [json.dumps(value) if isinstance(value, list) else value for value in frame[path]]
        return frame.set_index(self.paths).to_xarray()

    def __repr__(self) -> str:
        counts = collections.Counter(row["status"] for row in self)
        return f"Sweep({len(self)} rows: {', '.join(f'{count} {status}' for status, count in counts.items())})"


@dataclass(frozen=True)
class _Work:
    """What is done for every row, in this process or another one."""

    text: bytes
    origin: dict[str, Any]
    run: Callable[..., Any]
    options: dict[str, Any]

    def __call__(self, values: dict[str, Any]) -> dict[str, Any]:
        own = {name: value.copy() if isinstance(value, State) else value for name, value in self.options.items()}
        with hearing() as heard:
            try:
                told = _told(self.run(Scene.parse(self.text, set=values, **self.origin), **own))
            except (OSError, MemoryError) as error:
                told = {"status": "unavailable", "reason": str(error)}
            except TypeError:  # a mistake of the call
                raise
            except Error as error:
                told = {"status": "failed" if isinstance(error, SolverFailed) else "refused", "reason": str(error)}
        told.setdefault("warnings", "\n".join(dict.fromkeys(heard)))
        return told

    def keys(self, rows: list[dict[str, Any]]) -> list[str]:
        """What each row depends on, as a number."""
        start = _dump([self.run, self.options, build_facts()["version"]], _known)
        start = hashlib.sha256(self.text + start).digest()
        return [hashlib.sha256(start + _dump(values)).hexdigest()[:20] for values in rows]


def _told(found: Any) -> dict[str, Any]:
    """The row of a run or a measurement: numbers, texts, and those of its records."""
    if found is None or isinstance(found, Mapping):
        return {"status": "finished", "reason": "", **(found or {})}
    if not isinstance(found, (Result, Found)):
        raise TypeError(f"run: it returned {found!r}; allowed: a result, a measurement, a dict, or None")
    if not isinstance(found, Result):
        values = {**vars(found), "recommendation": getattr(found, "recommendation", None), "claims": str(found)}
        return {"status": values.pop("outcome"), "reason": "", **_flat(values), **_table(found.rows)}
    told = {name: found.options[name] for name in ("method", "step")}
    told |= {"time": found.state.t, **found.counts, "wall_seconds": found.wall_seconds, **_flat({"error": found.error})}
    for watched in () if found.watched is None else found.watched:
        name = str(watched["quantity"])
        told[name] = float(watched["value"])
        told |= {f"{name}.{which}": float(watched[which]) for which in ("minimum", "maximum")}
    return {"status": found.status, "reason": "" if found.status == "finished" else found.message, **told}


def _table(rows: Table) -> dict[str, Any]:
    """The numbers of a table by the names in its first column or, without names, by the numbers of its rows; none of a study,
    which has several rows a method."""
    columns = rows.dtype.names or ()
    named = bool(columns) and rows.dtype[0].kind == "U"
    names = rows[columns[0]].tolist() if named else range(len(rows))
    if len(set(names)) < len(names):
        return {}
    return {f"{name}.{column}": row[column].item() for name, row in zip(names, rows) for column in columns[named:]}


def _flat(values: Mapping[str, Any]) -> dict[str, Any]:
    told = {}
    for name, value in values.items():
        if isinstance(value, (str, bool, int, float)):
            told[name] = value
        elif hasattr(value, "_fields"):
            told.update(_flat({f"{name}.{field}": getattr(value, field) for field in value._fields}))
        elif name == "watched" and isinstance(value, Mapping):
            told.update(_flat(value))
    return {name: value for name, value in told.items() if name[0] != "_"}


def _dump(document: Any, other: Callable[[Any], str] = str) -> bytes:
    """A line of JSON, with null for numbers that are not finite."""
    text = json.dumps(document, default=lambda value: value.tolist() if hasattr(value, "tolist") else other(value))
    return json.dumps(json.loads(text, parse_constant=lambda _: None)).encode()


def _known(thing: Any) -> str:
    """What tells a function, with what it holds, or an object from another one, in every process; what cannot be told is
    another one in each."""
    try:
        if not inspect.isfunction(thing) and not inspect.ismethod(thing):
            return repr(pickle.dumps(thing))
        function: Any = getattr(thing, "__func__", thing)
        held = [cell.cell_contents for cell in function.__closure__ or () if cell.cell_contents is not thing]
        held += [function.__defaults__, function.__kwdefaults__, getattr(thing, "__self__", None)]
        return f"{inspect.getsource(thing)} {_dump(held, _known).decode()}"
    except Exception:
        return repr(thing)


@contextlib.contextmanager
def _kept(path: Path | None) -> Iterator[tuple[dict[str, bytes], Callable[[bytes], None]]]:
    """The lines of a file by their keys, and what adds one, on a line of its own also after one that was cut off."""
    done: dict[str, bytes] = {}
    if path is None:
        yield done, lambda line: None
        return
    with open(path, "ab", buffering=0) as file, open(path, "rb") as old:
        line = b"\n"
        for line in old:
            with contextlib.suppress(ValueError, TypeError, KeyError):  # of a process that was killed meanwhile
                done[json.loads(line)["key"]] = line
        if not line.endswith(b"\n"):
            file.write(b"\n")

        def add(line: bytes) -> None:
            if file.write(line) != len(line):
                raise OSError(f"{os.fspath(path)}: a row was not written; the disk is full")

        yield done, add
        os.fsync(file.fileno())


def _rows(vary: Vary) -> list[dict[str, Any]]:
    if hasattr(vary, "to_dict"):  # a data frame
        vary = vary.to_dict("records")
    if not isinstance(vary, Mapping):
        return [json.loads(_dump(row)) for row in vary]
    columns = ([value] if isinstance(value, str) or not np.iterable(value) else list(value) for value in vary.values())
    return [dict(zip(vary, values)) for values in itertools.product(*(json.loads(_dump(column)) for column in columns))]


def _text(scene: Scene | Mapping[str, Any] | Path) -> tuple[bytes, dict[str, Any]]:
    """Its text, and what `Scene.parse` needs beside it."""
    if isinstance(scene, Mapping):
        scene = Scene.parse(scene)
    if not isinstance(scene, Scene):
        path = File(scene).absolute()
        return path.read_bytes(), {"folder": str(path.parent)}
    if pickle.dumps(Scene.parse(scene.text, **scene._origin)) != pickle.dumps(scene):
        raise BadValue("scene: it has what a scene file cannot hold; allowed: a scene that its text makes again, or a path")
    return scene.text.encode(), scene._origin


def _finished(
    executor: Executor | None, work: _Work, rows: Mapping[str, dict[str, Any]], ahead: int | None
) -> Iterator[tuple[str, dict[str, Any]]]:
    """What came of rows, by their keys, as they finish; few of them are submitted ahead."""
    if executor is None:
        yield from ((key, work(values)) for key, values in rows.items())
        return
    most = ahead or 4 * (getattr(executor, "_max_workers", None) or os.cpu_count() or 1)
    waiting, done = iter(rows.items()), queue.SimpleQueue[Any]()
    under_way: dict[Future[dict[str, Any]], str] = {}
    try:
        while True:
            for key, values in itertools.islice(waiting, most - len(under_way)):
                try:
                    future: Future[dict[str, Any]] = executor.submit(work, values)
                except BrokenExecutor as broken:  # after the rows that are done
                    future = Future()
                    future.set_exception(broken)
                under_way[future] = key
                future.add_done_callback(done.put)
            if not under_way:
                return
            future = done.get()
            yield under_way.pop(future), future.result()
    finally:
        for future in under_way:
            future.cancel()


class SweepKeywords(RunKeywords, total=False):
    """Keywords of `hooke.sweep` and of its runs."""

    watch: str | Iterable[str] | None
    output: Path | None
    executor: Executor | None
    only: slice
    error: bool
    ahead: int | None
    progress: WorkProgress | bool | None
    state: State | None
    force: Force | None
    want: Length | None
    estimate: bool | None
    strict: bool


@overload
def sweep(scene: Scene | Mapping[str, Any] | Path, vary: Vary, **options: Unpack[SweepKeywords]) -> Sweep: ...


@overload
def sweep(scene: Scene | Mapping[str, Any] | Path, vary: Vary, *, run: Callable[..., Any], **options: Any) -> Sweep: ...


def sweep(
    scene: Scene | Mapping[str, Any] | Path,
    vary: Vary,
    *,
    watch: str | Iterable[str] | None = None,
    output: Path | None = None,
    executor: Executor | None = None,
    only: slice = slice(None),
    run: Callable[..., Any] = run_scene,
    error: bool = False,
    ahead: int | None = None,
    progress: WorkProgress | bool | None = None,
    **options: Any,
) -> Sweep:
    """Runs a scene (or the path of one) with other values, and returns the `Sweep`, a row a run.

    `vary` has values by paths, as `Scene.load` takes them ("cloth.structural.stiffness", "run.step"): a mapping stands for
    all combinations, a list of mappings or a data frame for its rows. `watch` are quantities as in `hooke.run`, ``error=True``
    asks for the error of every run, and `options` are further keywords of `hooke.run`.

    `executor` is anything with the interface of `concurrent.futures`: processes, Dask, MPI, Ray; without one, rows run here.
    Their numbers have the same bits everywhere. `ahead` rows are submitted and not yet done, four a worker if None.
    ``progress(fraction, what)`` receives progress (``progress=True`` shows a bar, with tqdm) and ends it, with the rows so
    far, by returning a non-zero number.

    `output` is a file that keeps each row as a line of JSON, as soon as it is done. Rows that are in it are not run again,
    if scene, values, options, function and version are the same, so after whatever ended a sweep, the same call completes it.
    Of a name that ends in ``.csv`` or ``.parquet``, a table is written at the end, and the lines are in ``<output>.jsonl``. Files
    that a scene names are known by their names alone. ``only=slice(k, None, tasks)`` makes the k-th of that many tasks.

    A run that diverges or is refused is a row with its `reason`; one that lacks a file or memory is `unavailable`, and
    runs again. `run` is the function, such as `hooke.study` or `hooke.needs`, or one of your own: ``run(scene, **options)``
    returns a result, a measurement, or a dict.
    """
    if not isinstance(only, slice):
        raise BadValue(f"only: {only!r} is no slice; allowed: slice(k, None, tasks)")
    rows = _rows(vary)
    paths = list(dict.fromkeys(itertools.chain.from_iterable(rows)))
    for path in paths:
        if path.startswith("run.") and path[4:] in options:
            raise BadValue(f"{path}: it is varied, and an option of all runs; give one of them")
    if error and run is not run_scene:
        raise BadValue("error: it is that of hooke.run; leave it out where another function runs")
    if options.get("probes") is not None and len(rows) > 1:
        raise BadValue("probes: all rows would write one file; allowed: watch, or a function of your own")
    options |= {"watch": watch} if watch is not None else {}
    taken = inspect.signature(run).parameters
    if not any(parameter.kind is parameter.VAR_KEYWORD for parameter in taken.values()):
        refuse_unknown("sweep", options, {**inspect.signature(sweep).parameters, **taken})
    if run is run_scene:
        options.setdefault("estimate", error)
    work = _Work(*_text(scene), run, options)
    mine = list(zip(work.keys(rows), rows))[only]
    table = File(output) if output is not None and File(output).suffix in (".csv", ".parquet") else None
    if table:  # what it needs is missed before the runs
        getattr(Sweep(paths, []).to_pandas(), f"to_{table.suffix[1:]}")(io.BytesIO())
    with _kept(f"{table}.jsonl" if table else output) as (done, keep), shown(progress) as tell:
        todo = {key: values for key, values in mine if key not in done}
        last, count = len(todo), itertools.count(1)
        try:
            for key, found in _finished(executor, work, todo, ahead):
                done[key] = line = _dump({**todo[key], **found, **todo[key], "key": key}) + b"\n"
                if found["status"] != "unavailable":
                    keep(line)
                if tell is not None and tell(next(count) / last, "rows"):
                    break
        except BrokenExecutor as broken:
            known = sum(key in done for key, _ in mine)
            done_so_far = f"a worker was ended; {known} of {len(mine)} rows are done"
            raise Error(f"{done_so_far}, and the same call with another executor does the rest") from broken
    made = Sweep(paths, [done[key] for key, _ in mine if key in done])
    if table:
        part = table.with_suffix(".part")
        getattr(made.to_pandas(), f"to_{table.suffix[1:]}")(part, index=False)
        os.replace(part, table)
    return made
