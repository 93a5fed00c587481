"""The sources of the package: types, and a docstring on every public object."""

import ast
import importlib
import inspect
import os
import pkgutil
import re
import subprocess
import sys

import pytest
from conftest import PACKAGES, ROOT

import hooke

CONFIGURATION = ROOT / "pyproject.toml"


def run(*command):
    environment = {**os.environ, "MYPYPATH": str(PACKAGES)}
    return subprocess.run(
        [sys.executable, "-m", *map(str, command)], cwd=PACKAGES, env=environment, capture_output=True, text=True
    )


@pytest.fixture(scope="module")
def mypy(tmp_path_factory):
    """The sources of NumPy and matplotlib are checked once a build."""
    build = os.environ.get("HOOKE_BUILD_DIR")
    cache = f"{build}/mypy" if build else tmp_path_factory.mktemp("mypy")
    return ("mypy", "--strict", "--config-file", CONFIGURATION, "--cache-dir", cache)


def test_types(mypy):
    checked = run(*mypy, "hooke")
    assert checked.returncode == 0, checked.stdout + checked.stderr
    assert "Success" in checked.stdout


def test_types_as_a_user_sees_them(tmp_path, mypy):
    """Correct code passes, wrong code does not."""
    (tmp_path / "right.py").write_text(
        """
import numpy as np
import hooke

scene = hooke.Scene(gravity=(0, -9.81, 0)).cloth(
    size=(12, 12), edges=((1, 0, 0), (0, 0, 1)), mass=1,
    structural=dict(stiffness=50, damping=0.01), pinned="top-corners")
scene.springs(between=[[0, 1], [("cloth0", 2), 3]], stiffness=np.ones(2)).run_defaults(step=1e-3)
result: hooke.Result = hooke.run(scene, duration=0.3, output="o.h5", progress=lambda fraction, state: None)
with hooke.open("o.h5") as out:
    energy: float = float(out.energy.total[-1])
    q: "np.ndarray[tuple[int, ...], np.dtype[np.float64]]" = out[-1].q
scene.run(step="1 ms", watch=["1.x"]).claims
hooke.study(scene, want="1mm", steps=[1e-3, 5e-4], newton="converged").recommend("1 cm")
"""
    )
    (tmp_path / "wrong.py").write_text(
        """
import hooke

hooke.Scene().cloth(size=(2, 2), edges=((1, 0, 0), (0, 0, 1)), structural=dict(stifness=50))
hooke.Scene().rope(from_=(0, 0, 0), to=(1, 0, 0), segments="many")
hooke.open("o.h5")["last"]
hooke.run("a.json", stepp=1)
hooke.Scene().run(stepp=1)
hooke.limit("a.json", newton="twice")
"""
    )
    checked = run(*mypy, tmp_path / "right.py", tmp_path / "wrong.py")
    errors = re.findall(r"(\w+\.py):(\d+): error", checked.stdout)
    assert errors == [("wrong.py", line) for line in "456789"], checked.stdout


def test_the_package_is_marked_as_typed():
    assert (PACKAGES / "hooke/py.typed").exists()


def imports(module, known):
    """The modules of the package that one imports, also for type checkers only, and those inside functions."""
    found, inside = set(), set()

    def look(node, function):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            names = {node.module} if node.module else {name.name for name in node.names}
            (inside if function else found).update(names & known)
        for child in ast.iter_child_nodes(node):
            look(child, function or isinstance(node, ast.FunctionDef))

    look(ast.parse(module), False)
    return found, inside


UP = {"problems": {"results", "rest"}}  # the types of what a problem's run() and rest() return, which are above all problems


def circle(modules):
    """Modules of {name: source} left when those that import none of the others are taken away again and again."""
    left = {name: set.union(*imports(source, set(modules))) - UP.get(name, set()) for name, source in modules.items()}
    while free := [name for name, used in left.items() if not used & left.keys()]:
        for name in free:
            del left[name]
    return set(left)


def test_modules_have_a_direction():
    modules = {path.stem: path.read_text() for path in (PACKAGES / "hooke").glob("*.py") if path.stem != "__init__"}
    assert len(modules) > 20 and circle(modules) == set()
    inside = {name: imports(source, set(modules))[1] for name, source in modules.items()}
    assert not any(inside.values()), inside


def test_a_planted_circle_is_seen():
    late = "def f():\n    from .a import x\n"
    assert circle({"a": "from .b import f", "b": late, "c": "from .a import f"}) == {"a", "b", "c"}
    assert circle({"a": "from . import b", "b": "if TYPE_CHECKING:\n    from .a import x\n"}) == {"a", "b"}
    assert circle({"results": "from . import problems", "problems": "from .results import Result"}) == set()
    assert imports(late, {"a"}) == (set(), {"a"})


FOLDERS = {"animation", "notebook", "plot"}  # of the package; their modules are over its core


def imported(path, level):
    """The first words of what a module imports from its own folder (1), the one above (2), or elsewhere (0)."""
    nodes = [node for node in ast.walk(ast.parse(path.read_text())) if isinstance(node, (ast.Import, ast.ImportFrom))]
    there = [node for node in nodes if getattr(node, "level", 0) == level]
    names = {getattr(node, "module", None) or name.name for node in there for name in node.names}
    return {name.partition(".")[0] for name in names} - set(sys.stdlib_module_names)


def test_folders_use_what_is_public_and_the_core_needs_numpy_alone():
    public = {*hooke.__all__, "_signature", "_status", "_types"}  # keywords, texts for people, and names of types
    for folder in FOLDERS:
        for path in (PACKAGES / "hooke" / folder).glob("*.py"):
            assert imported(path, 2) <= public, path
    core = [path for path in (PACKAGES / "hooke").glob("*.py") if path.stem not in ("_prototypes", "__main__")]
    assert set.union(*(imported(path, 0) for path in core)) - {"typing_extensions"} == {"numpy"}  # which type checkers bring
    above = {path.stem: imported(path, 1) & FOLDERS for path in core}
    assert above.pop("trajectory") == {"plot"} and not any(above.values()), above  # for type checkers alone


def test_dir_shows_public_names_only():
    assert dir(hooke) == sorted(hooke.__all__)


# docstrings


def public_modules():
    names = {name for _, name, _ in pkgutil.iter_modules(hooke.__path__) if not name.startswith("_")} - {"libhooke"}
    return [hooke, *(importlib.import_module(f"hooke.{name}") for name in sorted(names))]


def public_things():
    """Every public name of the package with the methods and properties that it defines."""
    for module in public_modules():
        yield module.__name__, module
        for name, thing in vars(module).items():
            where = getattr(thing, "__module__", "")
            own = where.startswith("hooke") if module is hooke else where == module.__name__
            if name.startswith("_") or not own or not (inspect.isclass(thing) or inspect.isfunction(thing)):
                continue
            yield f"{module.__name__}.{name}", thing
            if not inspect.isclass(thing):
                continue
            fields = getattr(thing, "_fields", ())
            for base in thing.__mro__:
                if not base.__module__.startswith("hooke"):
                    continue  # NumPy's and Python's own
                for member, value in vars(base).items():
                    if member.startswith("_") or member in fields:
                        continue
                    if isinstance(value, (property, classmethod, staticmethod)) or inspect.isfunction(value):
                        yield f"{thing.__qualname__}.{member}", value


THINGS = dict(public_things())


def test_the_docstring_test_sees_the_package():
    assert {"Scene.cloth", "Scene.load", "Trajectory.q", "State.q", "hooke.run", "hooke.plot.cloth"} <= set(THINGS)
    assert len(THINGS) > 200


@pytest.mark.parametrize("name", sorted(THINGS))
def test_a_public_thing_says_what_it_is(name):
    text = inspect.getdoc(THINGS[name])
    assert text and len(text) > 8, f"{name} has no docstring"
    assert not text.startswith(f"{name.rsplit('.', 1)[-1]}("), f"{name} has only the docstring that it was born with"


@pytest.mark.parametrize(
    "cls", [thing for name, thing in THINGS.items() if inspect.isclass(thing) and hasattr(thing, "_fields")]
)
def test_a_named_tuple_names_its_fields(cls):
    text = cls.__doc__
    assert not text.startswith(f"{cls.__name__}("), "has only the docstring that it was born with"


def gives_an_array(thing):
    return isinstance(thing, property) and "Array" in str(inspect.signature(thing.fget).return_annotation)


@pytest.mark.parametrize("name", [name for name, thing in THINGS.items() if gives_an_array(thing)])
def test_an_array_has_its_shape_in_the_docstring(name):
    assert re.search(r"\(\w+(, \w+)*,?\)", inspect.getdoc(THINGS[name])), f"{name}: what shape?"
