"""What is said of a scene that is calm, one that is chaotic and one that blows up is the same, word for word, in the words of
the program, its JSON, its pages and in Python."""

import json
import os
import subprocess

import pytest

import hooke

CLI = os.environ.get("HOOKE_CLI")
pytestmark = pytest.mark.skipif(CLI is None or not hooke.build_facts().get("chartjs", ""), reason="needs the program and its pages")

CALM = {
    "hooke": 1,
    "particles": {"position": [[0, 0, 0], [1.1, 0, 0], [2, 0.1, 0]], "mass": 1, "pinned": [0]},
    "springs": [{"name": "line", "between": [[0, 1], [1, 2]], "stiffness": 100, "damping": 0.5}],
    "gravity": [0, -9.81, 0],
    "run": {"method": "verlet", "step": 1e-3, "duration": 0.2, "every": 0.02},
}
# A double pendulum, thrown.
CHAOS = {
    "hooke": 1,
    "particles": {"position": [[0, 0, 0], [1, 0.5, 0], [2, 0.5, 0]], "mass": 1, "pinned": [0]},
    "springs": [{"between": [[0, 1], [1, 2]], "stiffness": 1000}],
    "gravity": [0, -9.81, 0],
    "run": {"method": "rk4", "step": 2e-3, "duration": 30, "every": 0.5},
}
BLOW_UP = {
    "hooke": 1,
    "particles": {"position": [[0, 0, 0], [1.1, 0, 0]], "mass": 1, "pinned": [0]},
    "springs": [{"between": [[0, 1]], "law": "length", "stiffness": 1000, "rest_length": 1}],
    "run": {"method": "symplectic-euler", "step": 0.1, "duration": 100, "every": 1},
}
CASES = {
    "study-calm": (CALM, "study", {"methods": "verlet,rk4", "want": 1e-3}),
    "compare-chaos": (CHAOS, "compare", {"methods": "rk4"}),
    "limit-calm": (CALM, "limit", {}),
    "needs-calm": (CALM, "needs", {"want": 1e-2}),
    "limit-blow-up": (BLOW_UP, "limit", {}),
    "why-blow-up": (BLOW_UP, "why", {}),
}


def of_python(scene, verb, options):
    found = hooke.Scene.parse(json.dumps(scene))
    if verb == "why":
        return hooke.why(hooke.run(found))
    return getattr(hooke, verb)(found, **options)


def without_clock(claims):
    """Of those that a clock has no part in: (key, text, of, by)."""
    assert claims
    return [tuple(claim) for claim in claims if tuple(claim)[3] != "clock"]


@pytest.mark.parametrize("name", CASES)
def test_all_say_the_same(tmp_path, name):
    scene, verb, options = CASES[name]
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    flags = [f"--{key}={value}" for key, value in options.items()]
    command = [CLI, verb, "scene.json", *flags, "--report", "page.html"]
    told, words = (subprocess.run([*command, *more], cwd=tmp_path, capture_output=True, text=True) for more in (["--json"], []))
    claims = without_clock([[claim[key] for key in ("key", "text", "of", "by")] for claim in json.loads(told.stdout)["claims"]])
    page = (tmp_path / "page.html").read_text("utf-8")
    start = page.index('id="data">') + len('id="data">')
    data = json.loads(page[start : page.index("</script>", start)])
    assert without_clock([[claim[key] for key in ("key", "text", "of", "by")] for claim in data["claims"]]) == claims
    found = of_python(scene, verb, options)
    assert without_clock(found.claims) == claims
    printed = " ".join(words.stdout.split())
    for _, text, of, _ in claims:
        assert " ".join(text.split()) in printed and text in str(found) and of in ("whole", "part", "unknown")
    quiet = subprocess.run([*command[:-2], "-q"], cwd=tmp_path, capture_output=True, text=True).stdout
    assert " ".join(claims[0][1].split()) in " ".join(quiet.split())
    assert all(" ".join(text.split()) not in " ".join(quiet.split()) for _, text, _, _ in claims[1:])


def test_a_run_says_the_same(tmp_path):
    (tmp_path / "scene.json").write_text(json.dumps(CALM))
    words, told = (subprocess.run([CLI, "run", "scene.json", *more], cwd=tmp_path, capture_output=True, text=True)
                   for more in ([], ["--json"]))
    result = hooke.run(hooke.Scene.parse(json.dumps(CALM)), estimate=True)
    texts = [claim["text"] for claim in json.loads(told.stdout)["claims"]]
    assert str(result).splitlines() == texts == [claim.text for claim in result.claims]
    assert texts[0].startswith("the error is at most ") and texts[0] in " ".join(words.stdout.split())
