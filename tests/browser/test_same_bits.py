"""The library as WebAssembly gives the bits of the native one: ten scenes by every method with a fixed step, in pieces."""

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

pytestmark = pytest.mark.skipif(not SCRIPT.exists(), reason="the playground is not built (`make playground`)")


def runs():
    methods = [m.name for m in hooke.methods() if not m.adaptive]
    return [{"scene": f"{name}.json", "method": method, "pieces": PIECES,
             "step": hooke.Scene.load(ROOT / f"examples/scenes/{name}.json").run_options["step"]}
            for name in SCENES for method in methods]


def native(run):
    scene = hooke.Scene.load(ROOT / "examples/scenes" / run["scene"])
    system = scene.system
    system.commit()
    state = system.state()
    hooke.Integrator(system, method=run["method"], step=run["step"]).step(state, sum(run["pieces"]))
    return np.concatenate([state.q.ravel(), state.v.ravel()]).tobytes().hex()


def test_final_states():
    wanted = runs()
    done = subprocess.run(["node", ROOT / "tests/browser/run_scenes.js", SCRIPT], input=json.dumps(wanted), capture_output=True,
                          text=True, check=True)
    told = json.loads(done.stdout)
    assert told["methods"] == [m.name for m in hooke.methods() if not m.adaptive]
    assert len(wanted) == len(told["results"]) == 10 * len(told["methods"]) and len(told["methods"]) >= 6
    different = [run for run, result in zip(wanted, told["results"]) if not result["whole"] or result["state"] != native(run)]
    assert not different, different
    states = {result["state"] for result in told["results"]}
    assert len(states) > 0.9 * len(wanted)  # methods differ, so that equal bits say something
