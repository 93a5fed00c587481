"""--force: a force that a shared library brings, from C and from Fortran."""

import copy
import hashlib
import os
import shutil
import subprocess
from pathlib import Path

import pytest

pytestmark = pytest.mark.everything

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
ROPE = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [{"kind": "rope", "name": "rope", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 8, "mass": 0.2,
               "pinned": "start", "stretch": {"stiffness": 100, "damping": 0.05}}],
    "run": {"method": "rk4", "step": 1e-3, "duration": 0.2, "every": 0.02},
}
# Of the examples of C and Fortran.
TETHER = {"particles": [8], "points": [[0.5, 0.4, -0.2]], "stiffness": 20, "rest_length": 0.3}
SOURCE = """
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#ifdef ABI
const int32_t hooke_own_force_abi = ABI;
#endif
int32_t NAME(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  (void)ctx;
  force[3 * n - 1] += sin(40 * t) - 0.1 * v[3 * n - 1] - q[3 * n - 1];
  if (getenv("WILD") && t > 0.1) force[3 * n - 1] = NAN;
  return getenv("STOP") && t > 0.1 ? 3 : 0;
}
"""


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    """Builds each library once."""
    folder, made = tmp_path_factory.mktemp("built"), {}
    (folder / "source.c").write_text(SOURCE)

    def make(*words, source="source.c", compiler=os.environ["HOOKE_CC"]):
        key, to = (*words, source), folder / f"{len(made)}.so"
        if key not in made:
            subprocess.run([compiler, "-O1", "-ffp-contract=off", "-shared", "-fPIC", f"-I{ROOT}/include", *words, source,
                            "-o", to, "-lm"], check=True, cwd=folder)
        return made.setdefault(key, to)

    return make


@pytest.fixture
def build(built, tmp_path):
    def copied(name, *words, **options):
        shutil.copy(built(*words, **options), tmp_path / name)
        return name

    return copied


@pytest.fixture
def wave(build):
    return build("wave.so", "-DABI=1", "-DNAME=hooke_own_force")


@pytest.mark.parametrize("language", ["c", "fortran"])
def test_the_examples_are_an_anchor_to_the_bit(hooke, write, build, tmp_path, language):
    compiler = {"c": os.environ["HOOKE_CC"], "fortran": os.environ["HOOKE_FORTRAN"]}[language]
    if not compiler:
        pytest.skip("there is no Fortran compiler")
    library = build("tether.so", source=next((ROOT / "examples" / language).glob("tether.*")), compiler=compiler)
    plain, tethered = write(ROPE, "rope.json"), write({**ROPE, "anchors": [TETHER]}, "tethered.json")
    for method in ["symplectic-euler", "rk4"]:
        words = ["--method", method, "--final", "--json", "--no-estimate"]
        own = hooke("run", plain, "--force", library, *words).json
        assert own["final"] == hooke("run", tethered, *words).json["final"]
        assert own["final"] != hooke("run", plain, *words).json["final"]
        digest = hashlib.sha256((tmp_path / library).read_bytes()).hexdigest()
        assert [own[f"force_{what}"] for what in ("file", "name", "sha256")] == [f"./{library}", "hooke_own_force", digest]


@pytest.mark.parametrize("size", [0, 55, 56, 63])
def test_the_digest_of_a_file_of_any_length(hooke, write, wave, tmp_path, size):
    """After the end of a library there may be anything."""
    library = tmp_path / wave
    whole = library.read_bytes()
    library.write_bytes(whole + bytes(size - len(whole) % 64 + 64))
    assert hashlib.sha256(library.read_bytes()).hexdigest() in hooke("check", write(ROPE), "--force", wave).err


def test_a_file_names_its_force_and_takes_no_other(hooke, write, wave, tmp_path):
    scene, other = write(ROPE), "other.so"
    (tmp_path / other).write_bytes((tmp_path / wave).read_bytes() + b"0")
    assert hooke("run", scene, "--force", wave, "-o", "whole.h5").code == 0
    stopped = hooke("run", scene, "--force", wave, "-o", "out.h5", env={**os.environ, "STOP": "1"})
    assert stopped.code == 3 and "the force of ./wave.so returned 3" in stopped.err and "6 frames in out.h5" in stopped.err
    digests = [hashlib.sha256((tmp_path / name).read_bytes()).hexdigest() for name in (wave, other)]
    for words in [("run", "--resume", "out.h5"), ("verify", "whole.h5"), ("why", "whole.h5")]:
        without, foreign = hooke(*words), hooke(*words, "--force", other)
        assert without.code == foreign.code == 3
        assert digests[0] in without.err and "wave.so" in without.err
        assert digests[0] in foreign.err and digests[1] in foreign.err
    assert hooke("run", "--resume", "out.h5", "--force", f"./{wave}").code == 0
    for name in ["whole.h5", "out.h5"]:
        verified = hooke("verify", name, "--all", "--force", wave, "--json").json
        assert verified["verdict"] == "agrees" and verified["balance"] == "holds"
    whole, resumed = (hooke("run", "--resume", name, "--force", wave, "--final", "--json").json["final"]
                      for name in ["whole.h5", "out.h5"])
    assert whole == resumed


@pytest.mark.parametrize("words, given, message", [
    (["-DNAME=hooke_own_force"], "f.so", "has no symbol 'hooke_own_force_abi'"),
    (["-DABI=1", "-DNAME=gust"], "f.so", "has no symbol 'hooke_own_force'"),
    (["-DABI=1", "-DNAME=gust"], "f.so:gale", "has no symbol 'gale'"),
    (["-DABI=0", "-DNAME=hooke_own_force"], "f.so", "is for the ABI 0, by its hooke_own_force_abi, and this hooke has 1"),
    (["-DABI=1", "-DNAME=gust"], "none.so:gust", "--force ./none.so: is no library to load: it cannot be read"),
    (["-DABI=1", "-DNAME=gust"], "scene.json", "is no library to load"),
    (["-DABI=1", "-DNAME=gust"], ".", "it cannot be read"),
])
def test_what_is_no_force_is_refused(hooke, write, build, words, given, message):
    build("f.so", *words)
    hooke("check", write(ROPE), "--force", given, code=3, err=message)


def test_a_force_that_is_not_finite_is_named(hooke, write, build):
    library = build("f.so", "-DABI=1", "-DNAME=gust")
    answer = hooke("run", write(ROPE), "--force", f"{library}:gust", env={**os.environ, "WILD": "1"})
    assert answer.code == 4 and "the force of ./f.so gives particle 8 a force that is not finite" in answer.err
    assert "--force f.so:gust --duration" in answer.err


def test_it_depends_on_its_arguments_alone(hooke, write, wave):
    answer = hooke("run", write(ROPE), "--force", wave, "--want", "1mm", "--json")
    assert answer.code == 0 and answer.json["want"]["met"] and answer.json["error"]["estimate"] < 1e-3
    rope = copy.deepcopy(ROPE)
    rope["run"].update(method="symplectic-euler", step=0.02, duration=2)
    why = hooke("why", write(rope), "--force", wave, "--json").json
    assert why["cause"] == "step-above-limit" and f"--force {wave}" in why["advice"][0]["command"]


def test_the_verbs_take_it(hooke, write, wave):
    scene = write(ROPE)
    for words in [["limit", scene, "--predict"], ["check", scene], ["needs", scene, "--want", "1cm"],
                  ["compare", scene, "--methods", "rk4,verlet"], ["study", scene, "--want", "1cm", "--methods", "rk4"]]:
        found = hooke(*words, "--force", wave, "--json").json
        assert found["force_file"] == f"./{wave}" and len(found["force_sha256"]) == 64, words
        left_out = [claim["text"] for claim in found["claims"] if claim["key"] == "callback"]
        assert left_out == ["the stiffness and damping of the force of ./wave.so are left out"] * (words[0] in ("limit", "check"))
    for words in [["needs", scene, "--want", "1cm", "-o", "lean.json"], ["study", scene, "--from-rest"]]:
        assert hooke(*words, "--force", wave).code == 2
    assert hooke("rest", scene, "--force", wave).code == 2
