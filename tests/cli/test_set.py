"""--set PATH=VALUE: a scene with other values is the scene that has them in its file, and what it cannot have is refused."""

import copy

import pytest

SCENE = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [{"kind": "rope", "name": "line", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 4, "mass": 1,
               "pinned": "start", "stretch": {"stiffness": 100}}],
    "springs": [{"name": "tie", "between": [[0, 2]], "stiffness": 5}, {"name": "twin", "between": [[1, 3]], "stiffness": 5},
                {"name": "twin", "between": [[1, 4]], "stiffness": 5}],
    "run": {"method": "rk4", "step": 1e-3, "duration": 0.1},
}  # fmt: skip


def final(hooke, scene, *words):
    answer = hooke("run", scene, *words, "--no-estimate", "--final", "--json")
    assert answer.code == 0, answer.err
    return [answer.json[key] for key in ("method", "step", "steps", "energy", "final")]


def test_is_the_scene_with_these_values(hooke, write):
    other = copy.deepcopy(SCENE)
    other |= {"gravity": [0, -1, 0.5], "drag": 0.25}
    other["parts"][0]["stretch"] = {"stiffness": 2000, "damping": 0.5}
    other["springs"][0] |= {"stiffness": 7, "compression": False}
    other["run"]["step"] = 5e-4
    values = ["gravity=0,-1,0.5", "drag=0.25", "line.stretch.stiffness=2kN", "line.stretch.damping=0.5", "tie.stiffness=7"]
    values += ["tie.compression=false", "run.step=0.5ms"]
    words = [word for value in values for word in ("--set", value)]
    scene = write(SCENE)
    plain, changed = final(hooke, scene), final(hooke, scene, *words)
    assert final(hooke, scene, "--set", "run.step=1s", "--step", "1ms") == plain
    assert changed == final(hooke, write(other)) != plain
    shorter = {**SCENE, "run": {}}  # an object that is not there, and an empty one
    del shorter["gravity"]
    words = ["--set", "run.duration=0.1", "--set", "run.method=rk4", "--set", "run.step=1ms", "--set", "gravity=[0,-9.81,0]"]
    assert final(hooke, write(shorter), *words) == plain


@pytest.mark.parametrize(
    ("value", "told"),
    [
        ("line.strech.stiffness=1", 'parts[0].strech: unknown key "strech"; did you mean "stretch"?'),
        ("lime.stretch.stiffness=1", 'lime.stretch.stiffness: unknown key or name "lime"; did you mean "line"?'),
        ("grvity=0,0,0", 'did you mean "gravity"?'),
        ("run.step=1kg", "run.step: there is no unit 'kg' here"),
        ("line.stretch.stiffness=-1", "parts[0].stretch.stiffness: -1 is not allowed"),
        ("twin.stiffness=1", "2 groups have this name"),
        ("gravity.x=1", '"x" is no key of an object'),
        ("drag", "allowed: PATH=VALUE"),
        ('drag=1, "quadratic_drag": 1', 'drag: "1, "quadratic_drag": 1" is not allowed'),
    ],
)
def test_refuses_with_the_place_and_the_nearest_name(hooke, write, value, told):
    answer = hooke("check", write(SCENE), "--set", value, "--json")
    assert answer.code == 3 and told in answer.err, answer.err


@pytest.mark.everything
def test_a_file_and_a_command_have_the_values(hooke, write, tmp_path):
    scene, out = write({**SCENE, "run": {**SCENE["run"], "step": 0.1}}), str(tmp_path / "out.h5")
    words = ["--set", "run.duration=0.01", "--set", 'title=a "b"', "--set", "run.step=1ms"]
    assert hooke("run", scene, *words, "-o", out).code == 0
    assert hooke("verify", out, "--json").code == 0
    assert 'a "b"' in hooke("check", out).out
    for words in (["run", out], ["view", out], ["run", "--resume", out], ["why", out]):
        assert hooke(*words, "--set", "drag=1").code in (2, 3), words
    why = hooke("why", scene, "--set", "run.duration=20", "--set", "line.stretch.stiffness=1MN")
    assert "--set run.duration=20 --set line.stretch.stiffness=1MN" in why.out


def test_a_run_and_a_refusal_are_rows_with_their_values(hooke, write):
    values = ["drag=0.5", "gravity=0,-1,0", "run.step=1ms", 'title=a "b"=c', 'line.pinned=["start",4]', "run.every=null"]
    words = [word for value in values for word in ("--set", value)]
    row = {"drag": 0.5, "gravity": [0, -1, 0], "run.step": "1ms", "title": 'a "b"=c', "line.pinned": ["start", 4], "run.every": None}
    assert hooke("run", write(SCENE), *words, "--json", "--no-estimate").json["set"] == row
    refused = hooke("run", write(SCENE), *words, "--set", "tie.stifness=2", "--json")
    assert refused.json["set"] == {**row, "tie.stifness": 2} and refused.json["error"]["exit"] == 3
    assert "set" not in hooke("run", write(SCENE), "--json", "--no-estimate").json
    rows = {"[[1, 0], [0, 1]]": [[1, 0], [0, 1]], "[ ]": [], "true": True, '{"a": [1e-3]}': {"a": [0.001]}, '"\\n"': "\n"}
    texts = ["[[1,0],[0x1]]", "[1,]", "nan", "[" * 9000, "[1],", "[[]", '1, "a": 2', "1 2"]
    for value, shown in [*rows.items(), *zip(texts, texts)]:
        assert hooke("run", write(SCENE), "--set", f"tie.stifness={value}", "--json").json["set"] == {"tie.stifness": shown}
