"""Keywords that are options: what signatures and help say of them, and how a run chooses its step."""

import inspect
import json
import pydoc
import subprocess
import warnings

import pytest
from conftest import BUILD, ROOT, SIX_PARTICLES, build_oscillator

import hooke

OF_RUN = {row.name for row in hooke.options_of("run").rows}
KINDS = ("study", "limit", "cost", "check", "needs", "rest", "modes")


@pytest.mark.parametrize("name", [*KINDS, "view", "verify", "run"])
def test_signatures_have_every_option(name):
    function = getattr(hooke, name)
    parameters = inspect.signature(function).parameters
    own = {row.name for row in hooke.options_of(name).rows}
    assert own | (OF_RUN if name in KINDS else set()) <= set(parameters)
    assert inspect.Parameter.VAR_KEYWORD not in {parameter.kind for parameter in parameters.values()}
    words = pydoc.plain(pydoc.render_doc(function))
    assert all(f"`{row}`" in words for row in own | (OF_RUN if name in KINDS else set()) if row not in ("methods", "want", "count"))
    assert max(map(len, words.splitlines()[4:])) <= 130, "beside the signature"


def test_methods_have_them_too():
    assert OF_RUN <= set(inspect.signature(hooke.Scene().run).parameters)
    assert OF_RUN <= set(inspect.signature(hooke.Integrator).parameters) & set(inspect.signature(hooke.Scene.run_defaults).parameters)
    assert {"watch", "at"} <= set(inspect.signature(hooke.Scene.rest).parameters)


@pytest.mark.parametrize("call, of, nearest", [
    (lambda scene: hooke.run(scene, wnat="1mm"), "run", "want"), (lambda scene: scene.run(stepp=1), "run", "step"),
    (lambda scene: hooke.limit(scene, methds="rk4"), "limit", "methods"),
    (lambda scene: hooke.resume("x.h5", progres=True), "resume", "progress"),
    (lambda scene: hooke.Integrator(scene.system, stepp=1), "Integrator", "step"),
    (lambda scene: hooke.Scene(gravty=(0, 0, 0)), "Scene", "gravity"),
    (lambda scene: hooke.Scene().rope(segmnts=4), "rope", "segments"),
    (lambda scene: hooke.sweep(scene, {}, executr=None), "sweep", "executor"),
    (lambda scene: hooke.convert.from_meshio(None, stifness=1), "from_meshio", "stiffness"),
    (lambda scene: hooke.convert.from_meshio(None, mass_=1), "from_meshio", "mass"),
])  # fmt: skip
def test_unknown_keywords_name_the_nearest(call, of, nearest):
    with pytest.raises(TypeError, match=f'^{of}: unknown keyword ".*"; did you mean "{nearest}"') as told:
        call(hooke.Scene.parse(SIX_PARTICLES))
    assert isinstance(told.value, hooke.BadValue)


@pytest.mark.parametrize("call, words", [
    (lambda: hooke.Scene().obstacles(kind="plane"), '^obstacles: unknown keyword "kind"; allowed: shape, '),
    (lambda: hooke.limit(SIX_PARTICLES, methods="rk4", predict=True).plot(nosuch=1), '^limit: unknown keyword "nosuch"; allowed: ax'),
    (lambda: hooke.view([], "page.html"), "^trajectory: there is none"),
    (lambda: hooke.sweep(SIX_PARTICLES, {}, only=1), "^only: 1 is no slice"),
    (lambda: hooke.Scene.parse(SIX_PARTICLES, set="run.step=1"), "^set: 'run.step=1' is no mapping"),
])  # fmt: skip
def test_what_is_none_is_refused_in_words(call, words):
    with pytest.raises(hooke.BadValue, match=words):
        call()


def test_a_document_is_a_scene_and_other_things_are_none():
    assert (hooke.run(SIX_PARTICLES).state.q == hooke.Scene.parse(SIX_PARTICLES).run().state.q).all()
    for thing in (None, [1], 3):
        with pytest.raises(TypeError, match="a scene, its path or document, or a system is needed"):
            hooke.run(thing)
    with pytest.raises(hooke.BadValue, match="^duration: is missing"):
        hooke.run({**SIX_PARTICLES, "run": {"method": "rk4"}})


@pytest.mark.parametrize("options", [{"every": 0.05}, {"step": 1.02e-3, "every": 0.05}, {"step": 3e-3, "duration": 0.4, "every": 0.01}])
def test_a_run_fits_its_step_as_the_program_does(tmp_path, options):
    scene = hooke.Scene.parse({**SIX_PARTICLES, "run": {"method": "verlet", "duration": 0.5}})
    scene.save(tmp_path / "scene.json")
    words = [word for name, value in options.items() for word in (f"--{name}", str(value))]
    command = [BUILD / "hooke", "run", tmp_path / "scene.json", *words, "--json", "--no-estimate"]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    with pytest.warns(hooke.FitWarning) as told:
        result = scene.run(estimate=False, **options)
    found = json.loads(done.stdout)
    assert (result.options["step"], result.state.t) == (found["step"], found["time"])
    assert [str(one.message) for one in told] == [line.partition(": ")[2] for line in done.stderr.splitlines()]
    assert all(one.filename == __file__ for one in told)
    with pytest.raises(hooke.BadValue):
        scene.run(strict=True, **options)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(hooke.FitWarning):
            scene.run(estimate=False, **options)


def test_others_fit_their_steps(tmp_path):
    oscillator = build_oscillator()
    with pytest.warns(hooke.FitWarning):
        assert hooke.why(oscillator, method="verlet", duration=1) is None
    with pytest.raises(hooke.Unsuited, match="give one"):
        hooke.run(oscillator, method="forward-euler", duration=1)


def test_units_where_scenes_accept_them():
    rows = [["1 cm", 0, 0], [1, 0, "2mm"]]
    scene = hooke.Scene(gravity=(0, "-981 cm/s^2", 0)).particles(rows, [["1 cm/s", 0, 0], [0, 0, 0]], mass=["200 g", 1])
    scene.driven([1], motion="table", time=["0 s", "100 ms"], position=[[0, 0, 0], ["1 cm", 0, 0]])
    scene.loads([0], force=[["1 kN", 0, 0]])
    state = scene.system.state()
    assert (state.q == [[0.01, 0, 0], [1, 0, 0.002]]).all() and state.v[0, 0] == 0.01 and scene.system.masses[0] == 0.2
    assert scene.run(step="1 ms", duration="0.1 s", method="verlet", estimate=False).state.q[1, 0] == pytest.approx(1.01)


def test_options_of_functions_are_those_of_the_tables():
    import keywords
    import schema

    written = (ROOT / "bindings/generate/options.json").read_text()
    assert written == schema.laid_out(keywords.tables()) + "\n", "python bindings/generate/schema.py writes it"
