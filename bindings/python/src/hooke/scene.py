"""Scenes: a system and how to run it, built in Python or read from JSON files."""

from __future__ import annotations

import json
import operator
import os
from collections.abc import Mapping
from typing import Any, Callable

import numpy as np

from ._keywords import RunKeywords
from ._library import lib
from ._look import still
from ._memory import Asked, Handle, indices, text
from ._signature import Unpack, takes
from ._status import BadCall, BadValue, placed
from ._types import IntArray, Numbers, Path
from .options import Options, option_name
from .parts import Parts
from .problems import Problem
from .system import System, part_options, particle_keys, write_scene

__all__ = ["Scene"]


class Scene(Parts, Problem):
    """A scene: its `system` and its `run_options`.

    Built by calls that can be chained, with the keywords of the scene format; arrays may be NumPy's::

        scene = hooke.Scene(gravity=(0, -9.81, 0)).cloth(
            size=(12, 12), edges=((1, 0, 0), (0, 0, 1)), mass=1,
            structural=dict(stiffness=50, damping=0.01), pinned="top-corners")

    or read with `load` and `parse`, and then added to in the same way. Each call checks its arguments and raises
    `BadValue` with the place (``cloth.structural.stiffness: ...``), leaving the scene unchanged. Particles are
    numbered from 0: those of `particles` first, then those of parts in their order. The first use that needs a
    finished system (a run, a state, `save`) commits it; after that nothing can be added. Until then ``scene.system``
    also accepts additions that the format cannot express, such as a force of your own.

    `gravity` (3,) [m/s^2]; `drag` [N s/m], ``f = -c (v - u)``, and `quadratic_drag` [kg/m],
    ``f = -c |v - u| (v - u)``, one number or one a particle; `wind` u (3,) [m/s], or a dict of `time` (samples,) [s] and
    `velocity` (samples, 3); `start`, a dict of `position` (n, 3) [m] and, unless at rest, `velocity` (n, 3) [m/s]: where
    all particles start, if not undeformed; `dynamics` is "inertial" or "overdamped" (see `System.dynamics`); `run` are
    defaults for runs of the scene, see `run_defaults`.
    """

    @takes()
    def __init__(
        self,
        title: str = "",
        *,
        gravity: Numbers | None = None,
        drag: Numbers | None = None,
        quadratic_drag: Numbers | None = None,
        wind: Numbers | Mapping[str, Numbers] | None = None,
        start: Mapping[str, Numbers] | None = None,
        dynamics: str | None = None,
        run: Mapping[str, Any] | None = None,
    ):
        self._system = System()
        self._run = Options.for_run()
        self._title = title
        self._text: str | None = None  # None: to be made from the document
        self._origin: dict[str, Any] = {}
        self._document: dict[str, Any] = {"hooke": 1}
        own = Options.for_scene().set(
            title=title or None, dynamics=dynamics, drag=drag, gravity=gravity, quadratic_drag=quadratic_drag, wind=wind,
            start=start,
        )
        lib.hooke_scene_options_apply(own._handle, self._system._handle)
        self._document.update((name, own[name]) for name in own if own.is_set(name) and "." not in name)
        for name, given in (("wind", wind), ("start", start)):
            if isinstance(given, Mapping):
                self._document[name] = {key: np.array(value) for key, value in given.items()}
        if run:
            self.run_defaults(**run)

    @classmethod
    def _made(cls, set: Any, origin: dict[str, Any], function: Callable[..., Any], *given: Any) -> Scene:
        """The scene that a function of the library makes; `origin` is what `parse` needs beside its text to make it again."""
        handle = Handle.made(None, function, *given, limits_of(origin["memory"], origin["outside"], set))
        scene = cls.__new__(cls)
        scene._origin = origin
        scene._system = System._of_scene(handle)
        scene._run = Options(Handle(lib.hooke_scene_run_options(handle), None, handle))
        scene._title = text(lib.hooke_scene_text(handle, b"title"))
        scene._text = text(lib.hooke_scene_text(handle, b"text"))
        return scene

    @classmethod
    def load(
        cls, path: Path, *, memory: float | None = None, outside: bool = False, set: Mapping[str, Any] | None = None
    ) -> Scene:
        """Reads a scene file, or the scene of a trajectory file with the options of its run. `memory` [GB] is the
        maximum memory of the scene, None: the machine's; with `outside` it may name files outside its folder;
        `set` has values by paths such as "run.step" or "cloth.structural.stiffness", which replace those of a scene file.
        BadValue describes a fault and its place; IOFailed if the file cannot be read."""
        origin = {"folder": os.path.dirname(os.path.abspath(path)), "memory": memory, "outside": outside}
        return cls._made(set, origin, lib.hooke_scene_load, os.fsencode(path))

    @classmethod
    def parse(
        cls,
        scene: str | bytes | Mapping[str, Any],
        name: str = "scene",
        folder: Path | None = None,
        *,
        memory: float | None = None,
        outside: bool = False,
        set: Mapping[str, Any] | None = None,
    ) -> Scene:
        """Reads a scene from its text, or from a dict of the same shape, which may hold NumPy arrays.

        `name` replaces the file name in messages; files named in the scene are looked up in `folder` (None: none are
        allowed); `memory`, `outside` and `set` are those of load().
        """
        if isinstance(scene, Mapping):
            scene = _dump(scene)
        data = scene.encode() if isinstance(scene, str) else bytes(scene)
        origin = {"folder": None if folder is None else os.path.abspath(folder), "memory": memory, "outside": outside}
        where = None if folder is None else os.fsencode(folder)
        return cls._made(set, origin, lib.hooke_scene_parse, data, len(data), name.encode(), where)

    # building

    @takes()
    def particles(
        self, position: Numbers, velocity: Numbers | None = None, *, mass: Numbers = (), pinned: Numbers | None = None,
        gravity_factor: Numbers = ()
    ) -> Scene:
        """Adds particles at `position` (n, 3) [m] with `velocity` (n, 3) [m/s], at rest if None, and `mass` [kg], one
        number for all or (n,), which an overdamped scene without gravity needs not have; `pinned` are the numbers of
        the pinned ones, `gravity_factor` is that of `System.set_gravity_factor`, one number or (n,).

        A scene has one such block, given before its parts, since it is numbered first. Returns the scene.
        """
        with placed("particles"):
            if "particles" in self._opened():
                raise BadCall("the scene has its particles already; give them all in one call")
            if self._system.particle_count:
                raise BadCall("they are numbered before those of parts, so give them before the first part")
            piece = particle_keys(position, velocity, mass, gravity_factor)
            if pinned is not None and np.size(pinned):
                piece["pinned"] = indices(pinned, "pinned").reshape(-1).copy()
                _require_rest(piece)
            self._system._add("particles", None, "particles", (), piece)
        self._changed()["particles"] = piece
        return self

    def names(self, names: Mapping[str, Any]) -> Scene:
        """Names particles: ``{"tip": 57, "fairlead": ("line", 0)}``. A name takes the place of a number wherever a
        scene has particles, and in what is watched (``watch="tip.y"``). It is no number, not that of a part or of a
        group, and has no ".", ":" or blank. Returns the scene."""
        with placed("names"):
            for name, particle in names.items():
                number = self._resolved(particle, name)
                lib.hooke_system_name_particle(self._system._handle, name.encode(), operator.index(number))
                self._changed().setdefault("names", {})[name] = operator.index(number)
        return self

    @takes(RunKeywords)
    def run_defaults(self, **options: Unpack[RunKeywords]) -> Scene:
        """Sets default options of runs of the scene, and returns the scene."""
        with placed("run"):
            self._run.copy().set(**options)  # all of them or none
        self._run.set(**options)
        self._changed()
        return self

    def _group(self, kind: str, what: str, given: dict[str, Any]) -> Scene:
        """Adds a group to the system, and to the document as it was given; its particles are its key `what`."""
        keys, name, part = _keys(given, "name", "part", what), given.get("name"), given.get("part")
        with placed(f"{kind}[{len(self._opened().get(kind, ()))}]"):
            if "part" in given:
                if (given[what] is None) == (part is None):
                    raise BadValue(f"{what}: allowed: {what}, or the name of a part")
                given[what] = given[what] if part is None else list(self._in_part(part, "part"))
            if given[what] is None and kind == "obstacles":  # of all free particles
                numbers = None
            else:
                numbers = self._numbers(given[what], what)
                numbers = numbers.reshape(-1) if what == "particles" else numbers
            self._system._add(kind, name, what, numbers, keys)
        known = {"name": name or None, what: numbers}
        return self._note(kind, {**{key: value for key, value in known.items() if value is not None}, **keys})

    def _part(self, kind: str, given: dict[str, Any]) -> Scene:
        keys = _keys(given, "name", "file")
        name, file, names = given["name"], given.get("file"), self._part_names()
        with placed(kind):
            called = name or f"{kind}{len(names)}"
            if called in names:
                raise BadValue(f'name: "{called}" is the name of another part; allowed: a name of its own')
            options: Any = part_options(kind, file, keys)
            if file is not None:
                keys.update((key, options[key].reshape(-1, 3)) for key in ("vertices", "triangles"))
            self._system._add_part(kind, called, options)
        return self._note("parts", {"kind": kind, **({"name": name} if name else {}), **keys})

    # using

    system = Asked[System](operator.attrgetter("_system"), "Its system.")
    run_options = Asked[Options](operator.attrgetter("_run"), "The run options of the scene, which may be changed.")
    title = Asked[str](operator.attrgetter("_title"), 'Its title; "" if it has none.')

    @property
    def text(self) -> str:
        """The scene as JSON text, as read or built."""
        if self._text is not None:
            return self._text
        run = {name: self._run[name] for name in self._run if self._run.is_set(name)}
        return _dump({**self._opened(), **({"run": run} if run else {})})

    def save(self, path: Path) -> None:
        """Writes the current scene, its system and `run_options`, as a scene file; see `System.save`."""
        write_scene(path, self._system, self.title, self.run_options)

    def __reduce__(self) -> Any:
        return Scene.parse, (self._system._written(self.title, self.run_options),)

    _repr_html_ = still

    def __repr__(self) -> str:
        return f"Scene({self.title!r}, {self._system!r})"

    # the document

    def _opened(self) -> dict[str, Any]:
        if not hasattr(self, "_document"):
            self._document = json.loads(self._text or "{}")
        return self._document

    def _changed(self) -> dict[str, Any]:
        document = self._opened()
        self._text = None
        return document

    def _note(self, key: str, piece: dict[str, Any]) -> Scene:
        self._changed().setdefault(key, []).append(piece)
        return self

    def _part_names(self) -> list[str]:
        return [part.get("name") or f"{part['kind']}{k}" for k, part in enumerate(self._opened().get("parts", ()))]

    def _numbers(self, particles: Any, name: str) -> IntArray:
        """Particles as numbers, with names and particles of named parts resolved."""
        if isinstance(particles, np.ndarray):
            return np.array(indices(particles, name))  # the caller's may change
        return indices(self._resolved(particles, name), name)

    def _resolved(self, particles: Any, name: str) -> Any:
        if isinstance(particles, str):
            return self._named(particles, name)
        if not isinstance(particles, (list, tuple)):
            return particles
        if len(particles) == 2 and isinstance(particles[0], str) and not isinstance(particles[1], str):
            return self._number_in_part(particles[0], particles[1], name)
        return [self._resolved(particle, f"{name}[{place}]") for place, particle in enumerate(particles)]

    def _named(self, particle: str, name: str) -> int:
        number = int(lib.hooke_system_named_particle(self._system._handle, particle.encode()))
        if number < 0:
            known = ", ".join(self._opened().get("names", ())) or "there are none"
            raise BadValue(f'{name}: there is no particle called "{particle}"; allowed: {known}')
        return number

    def _in_part(self, part: str, name: str) -> range:
        if part not in self._part_names():
            known = ", ".join(f'"{other}"' for other in self._part_names()) or "there are none"
            raise BadValue(f'{name}: there is no part called "{part}"; allowed: {known}')
        return self._system.part(part)

    def _number_in_part(self, part: str, number: Any, name: str) -> int:
        particles = self._in_part(part, name)
        if not isinstance(number, (int, np.integer)) or not 0 <= number < len(particles):
            raise BadValue(f'{name}: "{part}" has no particle {number}; allowed: 0 to {len(particles) - 1}')
        return particles[int(number)]


def limits_of(memory: float | None, outside: bool, values: Mapping[str, Any] | None = None) -> Handle:
    """Options of hooke_scene_load()."""
    if values is not None and not isinstance(values, Mapping):
        raise BadValue(f'set: {values!r} is no mapping; allowed: values by paths, such as {{"run.step": 0.001}}')
    lines = "\n".join(f"{path}={_dump(value)}" for path, value in (values or {}).items())
    return Options.for_scene("limits").set(memory=memory, outside=outside, set=lines or None)._handle


def _require_rest(piece: dict[str, Any]) -> None:
    """Commit would refuse it, too, and the scene could not be used."""
    velocity = piece.get("velocity", np.zeros((0, 3)))
    moving = np.flatnonzero(velocity.any(axis=1) & np.isin(np.arange(len(velocity)), piece["pinned"]))
    if moving.size:
        row = velocity[moving[0]].tolist()
        raise BadValue(f"velocity[{moving[0]}]: {row} is not allowed, the particle is pinned; allowed: 0")


def _keys(given: dict[str, Any], *others: str) -> dict[str, Any]:
    """The arguments of a method that are keys, without `others`, as copies of what the caller may change."""
    return {
        option_name(key): value.copy() if isinstance(value, np.ndarray) else value
        for key, value in given.items()
        if value is not None and key not in ("self", *others)
    }


def _dump(document: Any) -> str:
    return json.dumps(document, default=lambda value: value.tolist() if hasattr(value, "tolist") else list(value))
