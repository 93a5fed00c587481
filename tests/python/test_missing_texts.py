"""A NULL text is refused by every function that takes one, or counts as an unknown word, in every build."""

import ctypes
import json
import math

import guard
import headers
import pytest
from conftest import SIX_PARTICLES

from hooke import _prototypes as p
from hooke._library import lib

RUN = {"step": 1e-3, "duration": 0.01, "every": 0.005}
TEXTS = [
    (name, place)
    for name, (_, *arguments) in p.PROTOTYPES.items()
    for place, kind in enumerate(arguments)
    if kind is p.TEXT
]


PARAMETERS = {
    name: [what for _, what in parameters]
    for text in headers.public().values()
    for _, name, parameters in headers.declared(text)
}


def made(kind, create, *arguments):
    handle = kind()
    getattr(lib, create)(*arguments, ctypes.byref(handle))
    return handle


@pytest.fixture(scope="module")
def alive(tmp_path_factory):
    """An object of every type that this build can make."""
    path = str(tmp_path_factory.mktemp("texts") / "out.h5").encode()
    text = json.dumps(SIX_PARTICLES).encode()
    scene = made(p.SCENE, "hooke_scene_parse", text, len(text), b"x.json", b".", None)
    lib.hooke_scene_commit(scene)
    system = lib.hooke_scene_system(scene)
    run = made(p.OPTIONS, "hooke_options_create", b"run")
    for name, value in RUN.items():
        lib.hooke_options_set_number(run, name.encode(), value)
    state = made(p.STATE, "hooke_state_create", system)
    integrator = made(p.INTEGRATOR, "hooke_integrator_create", system, run)
    objects = {p.SCENE: scene, p.SYSTEM: system, p.OPTIONS: run, p.STATE: state, p.INTEGRATOR: integrator}

    def add(kind, create, *arguments):
        try:
            objects[kind] = made(kind, create, *arguments)
        except Exception:
            objects[kind] = None

    add(p.TRAJECTORY, "hooke_trajectory_create", path, system, integrator, text)
    if objects[p.TRAJECTORY]:
        lib.hooke_trajectory_write(objects[p.TRAJECTORY], 0, state)
    add(p.RECORD, "hooke_record_open", path)
    add(p.MEASUREMENT, "hooke_measurement_create", b"study", system, run, None)
    add(p.MEASUREMENT, "hooke_measurement_create", b"limit", system, run, None)
    add(p.MEASUREMENT, "hooke_measurement_create", b"cost", system, run, None)
    for name, value in {"step": 0.5, "duration": 500.0, "every": 50.0}.items():
        lib.hooke_options_set_number(run, name.encode(), value)
    lib.hooke_options_set_text(run, b"method", b"forward-euler")
    diverged = made(p.INTEGRATOR, "hooke_integrator_create", system, run)
    assert lib.hooke_integrator_run(diverged, state) == 2
    add(p.MEASUREMENT, "hooke_why_create", diverged, None)
    return objects


def argument(kind, alive):
    if kind in alive:
        return alive[kind]
    if kind is p.TEXT:
        return b"verlet"
    if kind in (p.DOUBLES, p.INTEGERS):
        return ctypes.cast((ctypes.c_double * 100)(), kind)
    if kind in (p.INT32, p.INT64, p.DOUBLE):
        return 0
    return None if kind is p.ADDRESS else ctypes.byref(kind._type_())


@pytest.mark.parametrize("name, place", TEXTS)
def test_no_text(name, place, alive, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    result, *kinds = p.PROTOTYPES[name]
    what = PARAMETERS[name][place]
    if guard.is_optional(name, what):
        return
    if any(kind in alive and alive[kind] is None for kind in kinds):
        pytest.skip("this build cannot make one")
    arguments = [argument(kind, alive) for kind in kinds]
    function = ctypes.CFUNCTYPE(p.INT32 if result is p.STATUS else result, *kinds)((name, ctypes.CDLL(lib.path)))
    answer = function(*arguments[:place], None, *arguments[place + 1 :])
    if result is p.STATUS:
        assert answer == -2 and lib.hooke_last_error().startswith(f"no {what} given; {name}()".encode())
        return
    unknown = function(*arguments[:place], b"no such word", *arguments[place + 1 :])
    if result is p.DOUBLE:
        assert math.isnan(answer) and math.isnan(unknown)
    elif result is p.DOUBLES:
        assert not answer and not unknown
    else:
        assert answer == unknown and answer in (None, b"", 0, -1)
