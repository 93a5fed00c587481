"""The library as WebAssembly gives the bits of the native one, ten scenes by every method with a fixed step, in pieces; and
its predictions."""

import json
import os
import subprocess
from pathlib import Path

import numpy as np
import pytest

import hooke

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
SCRIPT = ROOT / "build/playground/hooke.js"
SCENES = ["cantilever", "cloth-16", "cloth-damped", "cloth-gentle", "curl", "drag-or-damping", "lattice", "mesh", "rope", "stiff-spring"]
PIECES = [1, 2, 7, 30]
LIMITS = ["symplectic-euler", "rk4"]

pytestmark = pytest.mark.skipif(not SCRIPT.exists(), reason="the playground is not built (`make playground`)")


def runs():
    methods = [m.name for m in hooke.methods() if not m.adaptive]
    return [{"scene": f"{name}.json", "method": method, "pieces": PIECES, "limit": method in LIMITS,
             "step": hooke.Scene.load(ROOT / f"examples/scenes/{name}.json").run_options["step"]}
            for name in SCENES for method in methods]


def native(run):
    scene = hooke.Scene.load(ROOT / "examples/scenes" / run["scene"])
    system = scene.system
    system.commit()
    state = system.state()
    hooke.Integrator(system, method=run["method"], step=run["step"]).step(state, sum(run["pieces"]))
    return np.concatenate([state.q.ravel(), state.v.ravel()]).tobytes().hex()


@pytest.fixture(scope="module")
def told():
    done = subprocess.run(["node", ROOT / "tests/browser/run_scenes.js", SCRIPT], input=json.dumps(runs()), capture_output=True,
                          text=True, check=True)
    return json.loads(done.stdout)


def test_final_states(told):
    wanted = runs()
    assert told["methods"] == [m.name for m in hooke.methods() if not m.adaptive]
    assert len(wanted) == len(told["results"]) == 10 * len(told["methods"]) and len(told["methods"]) >= 6
    different = [run for run, result in zip(wanted, told["results"]) if not result["whole"] or result["state"] != native(run)]
    assert not different, different
    states = {result["state"] for result in told["results"]}
    assert len(states) > 0.9 * len(wanted)  # methods differ, so that equal bits say something


def test_limits(told):
    """LAPACK here, f2c's LAPACK there."""
    there = {(run["scene"], run["method"]): result["limit"] for run, result in zip(runs(), told["results"]) if result["limit"]}
    if not there:
        pytest.skip("this build of the playground has no LAPACK")
    compared = 0
    for name in SCENES:
        here = hooke.limit(ROOT / f"examples/scenes/{name}.json", methods=LIMITS, predict=True)
        for method in LIMITS:
            told_there = there[f"{name}.json", method]
            if told_there["exact"] and here[method]["exact"]:
                assert told_there["predicted"] == pytest.approx(here[method]["predicted"], rel=1e-6, abs=0.0), (name, method)
                compared += 1
    assert compared >= 15
