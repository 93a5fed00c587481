"""The system: particles, springs and forces."""

from __future__ import annotations

import ctypes
import os
from typing import Any, Callable, Optional

import numpy as np

from . import _callback
from ._library import lib
from ._look import still
from ._memory import Handle, double_pointer, doubles, index_pointer, indices, rows, text
from ._prototypes import DRIVE, FORCE, FORCE_PRODUCT
from ._queries import Queries
from ._status import BadCall, BadValue, Unsuited
from ._types import FloatArray, IntArray, Path
from .options import Options, in_units
from .problems import Problem
from .state import State

__all__ = ["System"]

#: force(t, q, v, force): adds forces [N] to `force`; all arrays (n, 3), `q` and `v` read-only.
Force = Callable[[float, FloatArray, FloatArray, FloatArray], Optional[int]]
#: product(t, q, v, dq, dv, out): adds (df/dq) dq + (df/dv) dv to `out`; all arrays (n, 3).
ForceProduct = Callable[[float, FloatArray, FloatArray, FloatArray, FloatArray, FloatArray], Optional[int]]
#: drive(t, q, v): writes positions [m] and velocities [m/s] at time t, arrays (count, 3).
Drive = Callable[[float, FloatArray, FloatArray], Optional[int]]


class System(Queries):
    """Particles, springs and forces: built by calls that add to it, then committed and constant from then on.

    The first use that needs a finished system (a state, a run, a force or an energy) commits it; `commit()` does so
    at a moment of your choice. Units are SI. Particles and springs are numbered from 0 in the order in which they are
    added, springs of parts after all others.

    Callbacks receive new arrays in each call; those that you keep stay as they are at its end. They return None or 0 to
    go on; any other integer stops the run. An exception stops it too, and is raised again by the call that ran.
    """

    def __init__(self) -> None:
        handle = Handle.made(None, lib.hooke_system_create)
        self._adopt(handle, lambda: lib.hooke_system_commit(handle))

    def _adopt(self, handle: Handle, commit: Callable[[], Any], callbacks: Any = ()) -> System:
        self._handle = handle
        self._commit = commit
        self._final = False  # whether it is known to be committed
        self._callbacks: list[Any] = [*callbacks]  # the library calls them as long as the system is in use
        return self

    @classmethod
    def _of_scene(cls, scene: Handle) -> System:
        handle = Handle(lib.hooke_scene_system(scene), None, scene)
        return cls.__new__(cls)._adopt(handle, lambda: lib.hooke_scene_commit(scene))

    @classmethod
    def _committed_by(cls, handle: Handle, callbacks: list[Any]) -> System:
        """A system that the library made, with the callbacks of another."""
        return cls.__new__(cls)._adopt(handle, lambda: None, callbacks)

    def _with_force(self, force: Force) -> System:
        """The same system with this callback force, as long as the result is in use."""
        callback = _callback.on_arrays(FORCE, force, 2)
        given = self._committed(), callback, FORCE_PRODUCT(), None
        handle = Handle.made(self._handle, lib.hooke_system_with_force, *given)
        return System._committed_by(handle, [*self._callbacks, callback])

    def take(self, particles: Any) -> System:
        """The committed system of these particles, ascending, and of the members of forces all of whose particles are among
        them, with the same bits of forces where all that acts was taken. Unsuited with rigid bodies and callbacks."""
        handle = Handle.made(None, lib.hooke_system_take, self._committed(), *_numbered(particles))
        return System._committed_by(handle, [])

    # building

    def add_particles(self, position: Any, velocity: Any = None, *, mass: Any = ()) -> range:
        """Adds particles at `position` (n, 3) [m] with `velocity` (n, 3) [m/s], at rest if None, and
        `mass` [kg], one number for all or (n,), which an overdamped system without gravity needs not have. Returns
        their numbers."""
        first = self.particle_count
        if np.size(position):
            self._add("particles", None, "particles", (), particle_keys(position, velocity, mass))
        return range(first, self.particle_count)

    def pin(self, particles: Any) -> None:
        """Pins particles (a number or several)."""
        lib.hooke_system_pin(self._handle, *_numbered(particles))

    def add_springs(self, name: str | None, between: Any, **options: Any) -> None:
        """Adds a group of springs `between` pairs of particles (m, 2), with the options that
        ``hooke.describe("springs")`` lists: ``law`` "strain" or "length"; ``stiffness`` [N] or, in the
        length law, [N/m]; ``damping`` [N s] or [N s/m], or ``damping_ratio``; ``rest_length`` "initial"
        or [m]; ``rest_scale`` and ``stiffness_scale``, each a number or, if it follows time, a dict;
        ``compression``. Where several numbers are allowed it is one for all or (m,)."""
        self._add("springs", name, "between", between, options)

    def add_bending(self, name: str | None, triples: Any, coefficient: Any) -> None:
        """Adds bending on `triples` a, b, c of particles (m, 3): the energy c/2 |q_a - 2 q_b + q_c|^2 with the
        `coefficient` c [N/m], one number for all or (m,). A beam of stiffness B [N m^2] in pieces of length l
        has c = B/l^3."""
        self._add("bending", name, "triples", triples, {"coefficient": coefficient})

    def add_altitude(self, name: str | None, tetrahedra: Any, **options: Any) -> None:
        """Adds altitude springs on `tetrahedra` of particles (m, 4): the currently shortest altitude of each is a
        spring whose rest length is that altitude as added. Options are ``stiffness`` [N] and ``damping`` [N s], one
        for all or (m,), ``rest_scale`` and ``compression``."""
        numbers, chosen = _members("altitude", tetrahedra, "tetrahedra"), Options.for_altitude().set(**options)
        group = name.encode() if name else None, numbers.size // 4, index_pointer(numbers)
        lib.hooke_system_add_altitude(self._handle, *group, chosen._handle)

    def add_anchors(self, name: str | None, particles: Any, **options: Any) -> None:
        """Adds anchors, springs from `particles` (m,) to fixed points, with the options that
        ``hooke.describe("anchors")`` lists: ``points`` (m, 3) [m], or "initial" for the initial positions of the
        particles; ``stiffness`` [N/m], ``damping`` [N s/m] and ``rest_length`` [m], one for all or (m,)."""
        self._add("anchors", name, "particles", particles, options)

    def add_body(self, name: str | None, particles: Any, *, project: bool = False) -> None:
        """Makes `particles` (m,) one rigid body; members of forces inside it are dropped at commit. Initial velocities
        have to be those of a rigid motion, or with `project` become those of the nearest one."""
        self._add("bodies", name, "particles", particles, {"project": project})

    def add_obstacle(self, particles: Any = None, **options: Any) -> None:
        """Adds a plane, a sphere or a cylinder that pushes out `particles` (m,), None: all free ones, with the options
        that ``hooke.describe("obstacles")`` lists."""
        self._add("obstacles", None, "particles", particles, options)

    def _add(self, kind: str, name: str | None, what: str, members: Any, options: dict[str, Any]) -> None:
        """Adds what a scene has under the key `kind`, whose particles, None: all, are its key `what`."""
        chosen, every = Options._of(kind).set(**options), members is None and kind == "obstacles"
        numbers = _members(kind, () if every else members, what)
        given = kind.encode(), name.encode() if name else None, -1 if every else numbers.size, index_pointer(numbers)
        lib.hooke_system_add_members(self._handle, *given, chosen._handle)

    def add_part(self, kind: str, name: str | None = None, **options: Any) -> range:
        """Adds a part, such as a "rope", a "cloth", a "lattice" or a "mesh", with the options that
        ``hooke.describe(kind)`` lists (``from_`` stands for ``from``); a family of springs is a dict:
        ``structural={"stiffness": 50}``. A mesh takes ``vertices`` (n, 3) [m] and ``triangles`` (m, 3), or an OBJ
        ``file``. Returns the numbers of its particles."""
        return self._add_part(kind, name, part_options(kind, options.pop("file", None), options))

    def _add_part(self, kind: str, name: str | None, options: Options) -> range:
        first, count = ctypes.c_int64(), ctypes.c_int64()
        given = kind.encode(), name.encode() if name else None, options._handle
        lib.hooke_system_add_part(self._handle, *given, ctypes.byref(first), ctypes.byref(count))
        return range(first.value, first.value + count.value)

    def set_gravity(self, gravity: Any) -> None:
        """Acceleration of every free particle (3,) [m/s^2]."""
        lib.hooke_system_set_gravity(self._handle, double_pointer(doubles(gravity, "gravity", (3,))))

    def set_gravity_factor(self, factor: Any, first: int = 0, count: int | None = None) -> None:
        """Factor on gravity of `count` particles from number `first` on (None: all of them), weight less buoyancy over
        weight, of any sign: one number, or (count,)."""
        factor = doubles(factor, "factor").reshape(-1)
        count = self.particle_count - first if count is None else count
        lib.hooke_system_set_gravity_factor(self._handle, first, count, factor.size, double_pointer(factor))

    def start_at(self, position: Any, velocity: Any = None) -> None:
        """Where the motion starts, if not where the particles were given: `position` [m] and `velocity` [m/s] of all of
        them (n, 3); velocities None: those given. Rest lengths, bodies, clamps and anchors stay those of the given
        positions. Pinned particles keep their places, driven ones start where their motion says."""
        places = particle_keys(position, velocity, ())
        count, v = np.size(places["position"]) // 3, places.get("velocity")
        rows = double_pointer(places["position"]), None if v is None else double_pointer(v)
        lib.hooke_system_start_at(self._handle, count, *rows)

    def limit_memory(self, size: float) -> None:
        """Sets the maximum memory of the system [bytes]; 0: the machine's memory. From here on, additions that would
        need more are refused (NoMemory)."""
        lib.hooke_system_limit_memory(self._handle, size)

    @property
    def dynamics(self) -> str:
        """"inertial", or "overdamped": drag v = f without inertia. Masses then serve gravity alone, velocities and
        damping are refused, callback forces are given v = 0, and states have v = f/drag. To be set before particles
        without mass are added."""
        return text(lib.hooke_system_dynamics(self._handle))

    @dynamics.setter
    def dynamics(self, word: str) -> None:
        lib.hooke_system_set_dynamics(self._handle, word.encode())

    def set_drag(self, coefficient: float) -> None:
        """Ether drag f = -c v on every free particle, c >= 0 [N s/m]."""
        lib.hooke_system_set_drag(self._handle, coefficient)

    def set_force(self, force: Force, product: ForceProduct | None = None) -> None:
        """Gives the system a force of your own in all its runs: ``force(t, q, v, force)`` adds newtons to its last
        argument, ``product(t, q, v, dq, dv, out)`` the product with its derivative to `out`; without it difference
        quotients replace it."""
        callbacks = _callback.on_arrays(FORCE, force, 2), _callback.on_arrays(FORCE_PRODUCT, product, 4)
        lib.hooke_system_set_force(self._handle, *callbacks, None)
        self._callbacks.extend(callbacks)

    def add_loads(self, particles: Any, **options: Any) -> None:
        """Adds a force to each of `particles` (m,), with the options that ``hooke.describe("loads")`` lists: ``force``
        (3,) [N], constant, or with ``motion`` "harmonic" its amplitude, or with "table" (samples, 3) at ``time``."""
        self._add("loads", None, "particles", particles, options)

    def drive_harmonic(self, particles: Any, amplitude: Any, frequency: float, phase: float = 0.0) -> None:
        """Moves particles as q0 + amplitude sin(2 pi frequency t + phase): `amplitude` (3,) [m],
        `frequency` [Hz]."""
        amplitude = double_pointer(doubles(amplitude, "amplitude", (3,)))
        lib.hooke_system_drive_harmonic(self._handle, *_numbered(particles), amplitude, frequency, phase)

    def drive_table(self, particles: Any, time: Any, displacement: Any) -> None:
        """Moves particles along a smooth curve through `displacement` (samples, 3) [m] at ascending `time`
        (samples,) [s]."""
        curve = doubles(displacement, "displacement", (np.size(time), 3))
        self._add("driven", None, "particles", particles, {"motion": "table", "time": np.ravel(time), "position": curve})

    def drive_callback(self, particles: Any, drive: Drive) -> None:
        """Moves particles as ``drive(t, q, v)`` writes, which must depend on t alone."""
        callback = _callback.on_arrays(DRIVE, drive, 0)
        lib.hooke_system_drive_callback(self._handle, *_numbered(particles), callback, None)
        self._callbacks.append(callback)

    def part(self, name: str) -> range:
        """The numbers of the particles of a part."""
        of = self._handle, name.encode()
        before, count = (int(lib.hooke_system_part_count(*of, what)) for what in (b"before", b"particles"))
        if count < 0:
            raise BadValue(f'part: there is no part called "{name}"')
        return range(before, before + count)

    # copies

    @property
    def text(self) -> str:
        """The text of the scene that the system is to the bit, which it commits; a TypeError says why there is none."""
        return self._written()

    def _written(self, title: str = "", run: Options | None = None) -> str:
        """The text of the scene that the committed system is to the bit; a TypeError says why there is none."""
        if vars(self).get("_gone"):
            raise TypeError(vars(self)["_gone"])
        if vars(self).get("_kept") and not title and run is None:
            return str(vars(self)["_kept"])
        try:
            given = self._committed(), title.encode(), run and run._handle, None, None
            scene = Handle.made(None, lib.hooke_scene_of_system, *given)
            copy = System._of_scene(scene).state()
        except Unsuited as reason:
            raise TypeError(f"a {type(self).__name__} with callbacks cannot be copied or pickled: {reason}") from None
        if copy.x.tobytes() != self.state().x.tobytes():
            raise TypeError("a System with particles after its parts cannot be copied or pickled: a scene numbers them first")
        return text(lib.hooke_scene_text(scene, b"text"))

    def __reduce__(self) -> Any:
        gone = vars(self).get("_gone", "")
        return System._recalled, ("" if gone else self._written(), gone)

    @classmethod
    def _recalled(cls, kept: str, gone: str = "") -> System:
        """A system that is made of its text when it is used first, or then refuses for the reason `gone`."""
        system = cls.__new__(cls)
        vars(system).update(_kept=kept, _gone=gone)
        return system

    def __getattr__(self, name: str) -> Any:
        kept, gone = vars(self).get("_kept"), vars(self).get("_gone")
        if name not in ("_handle", "_commit", "_final", "_callbacks", "_shape") or kept is None:
            raise AttributeError(f"{type(self).__name__!r} object has no attribute {name!r}")
        if gone:
            raise BadCall(f"this system was not pickled with its result: {gone}")
        data = kept.encode()
        made = Handle.made(None, lib.hooke_scene_parse, data, len(data), b"pickle", None, None)
        vars(self).update(vars(System._of_scene(made).commit()))
        return vars(self)[name]

    def commit(self) -> System:
        """Checks the system as a whole and makes it constant; a second call is a BadCall. Returns the
        system."""
        self._commit()
        self._committed()
        return self

    # using

    def state(self) -> State:
        """The initial state: t = 0, positions and velocities as added."""
        return State._made(self._handle, lib.hooke_state_create, self._committed())

    def save(self, path: Path, title: str = "", **options: Any) -> None:
        """Writes the system as a scene file, with `options` of a run: parts and groups of springs by their options,
        the rest number by number. `Scene.load` then gives the same system to the bit, with the particles of parts
        after the others. Unsuited if it has callbacks."""
        write_scene(path, self, title, Options.for_run().set(**options))

    def _integrator(self, options: Options) -> Handle:
        return Handle.made(self._handle, lib.hooke_integrator_create, self._committed(), options._handle)

    def _committed(self) -> Handle:
        if not self._final:
            if not self.is_committed:
                self._commit()
            self._shape = (self.particle_count, 3)
            self._final = True
        return self._handle

    _repr_html_ = still

    def __repr__(self) -> str:
        return f"System({self.particle_count} particles, {self.spring_count} springs)"


class Posed(System):
    """A first- or second-order problem as a system, for measurements and the runs that they watch."""

    def __init__(self, problem: Problem):
        handle, callbacks = problem._posed()
        self._adopt(handle, lambda: None, callbacks)
        self.problem = problem

    def state(self) -> State:
        """The start, with the numbers of the problem."""
        return State._made(self._handle, lib.hooke_state_create, self._committed(), **self.problem._shown)


def part_options(kind: str, file: Path | None, values: dict[str, Any]) -> Options:
    """The options of a part, those of a mesh with what an OBJ file has."""
    part = Options.for_part(kind).set(**values)
    if file is not None:
        lib.hooke_mesh_read(os.fsencode(file), part._handle)
    return part


def write_scene(path: Path, system: System, title: str, run: Options) -> None:
    """Writes a system as a scene file, with the options of a run."""
    lib.hooke_scene_write(os.fsencode(path), system._committed(), title.encode(), run._handle)


def particle_keys(position: Any, velocity: Any, mass: Any, gravity_factor: Any = ()) -> dict[str, Any]:
    """The keys of a scene's particles, as copies of what the caller may change."""
    position, velocity, mass = (
        in_units("particles", key, value) for key, value in (("position", position), ("velocity", velocity), ("mass", mass))
    )
    q = np.atleast_2d(doubles(position, "position"))
    keys: dict[str, Any] = {"position": doubles(q, "position", (len(q), 3)).copy()}
    if velocity is not None:
        keys["velocity"] = rows(velocity, "velocity", len(q)).reshape(-1, 3).copy()
    for key, given in (("mass", mass), ("gravity_factor", gravity_factor)):
        each = doubles(given, key).reshape(-1)
        if each.size:
            keys[key] = each.copy() if each.size != 1 else float(each[0])
    return keys


def kept(problem: Problem) -> System:
    """The problem as a pickled result has it, which refuses use if a pickle cannot hold it."""
    try:
        if isinstance(problem, System):
            return System._recalled(problem._written())
        return System._recalled("", f"it was {problem._what}")
    except TypeError as reason:
        return System._recalled("", str(reason))


def posed(problem: Problem) -> System:
    """The problem as a system, for what takes first- and second-order problems, too."""
    return problem if isinstance(problem, System) else Posed(problem)


def system_of(problem: Problem, what: str) -> System:
    """The problem for `what`, which is for systems only."""
    if not isinstance(problem, System):
        raise BadValue(f"{what}: a system is needed, this is {problem._what}")
    return problem


def _numbered(particles: Any) -> tuple[int, Any]:
    """The count and the numbers of particles (one or several) as arguments."""
    numbers = indices(particles, "particles").reshape(-1)
    return numbers.size, index_pointer(numbers)


def _members(kind: str, members: Any, what: str) -> IntArray:
    """The numbers of the particles of members, in rows of as many as one has."""
    numbers, width = indices(members, what), lib.hooke_member_particles(kind.encode())
    if width > 1 and numbers.size and (numbers.ndim != 2 or numbers.shape[1] != width):
        doubles(numbers, what, (numbers.size // width, width))  # says what is allowed
    return numbers
