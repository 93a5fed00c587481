"""The library and the program for Windows under wine: the bits of every method with a fixed step, the numbers of the program,
and files."""

import json
import os
import re
import signal
import subprocess
import time

import h5py
import numpy as np
from conftest import ROOT

import hooke

SCENES = ["cantilever", "cloth-16", "cloth-damped", "cloth-gentle", "curl", "drag-or-damping", "lattice", "mesh", "rope", "stiff-spring"]
STEPS = 40
CHANGES = ("wall_seconds", "output")


def native(scene, method):
    system = scene.system
    state = system.state()
    hooke.Integrator(system, method=method, step=scene.run_options["step"]).step(state, STEPS)
    return np.concatenate([state.q.ravel(), state.v.ravel()]).tobytes().hex()


def here(*words, folder=ROOT):
    return subprocess.run([os.environ["HOOKE_CLI"], *words], cwd=folder, capture_output=True, check=True, text=True)


def test_bits(wine):
    files = [f"examples/scenes/{name}.json" for name in SCENES]
    lines = [line.split() for line in wine("states.exe", STEPS, *files).stdout.splitlines()]
    methods = [m.name for m in hooke.methods() if not m.adaptive]
    assert [(file, method) for file, method, _ in lines] == [(file, method) for file in files for method in methods]
    assert len(methods) >= 6
    scenes = {file: hooke.Scene.load(ROOT / file) for file in files}
    for scene in scenes.values():
        scene.system.commit()
    different = [(file, method) for file, method, state in lines if state != native(scenes[file], method)]
    assert not different, different
    assert len({state for *_, state in lines}) > 0.9 * len(lines)  # methods differ, so that equal bits say something


def test_numbers_of_runs(wine):
    """Times, energies, momenta, and the estimate of the error."""
    for name in ("cloth-16", "curl", "rope"):
        words = ["run", f"examples/scenes/{name}.json", "--duration", "0.02", "--json", "--threads", "2"]
        one, two = json.loads(wine("hooke.exe", *words).stdout), json.loads(here(*words).stdout)
        assert {k: v for k, v in one.items() if k not in CHANGES} == {k: v for k, v in two.items() if k not in CHANGES}


def test_study_and_limit(wine):
    """SUNDIALS and LAPACK, of which the bits are not promised."""
    study = ("study", "examples/scenes/stiff-spring.json", "--duration", "0.05", "--methods", "symplectic-euler,rk4", "--json")
    errors = [{(row["method"], row["step"]): row["error"] for row in json.loads(run.stdout)["rows"]}
              for run in (wine("hooke.exe", *study), here(*study))]
    both = [key for key in errors[0] if errors[0][key] and errors[1].get(key)]
    assert len(both) >= 4
    for key in both:
        assert abs(errors[0][key] / errors[1][key] - 1) < 0.01 or errors[0][key] < 1e-9, key
    limit = ("limit", "examples/scenes/curl.json", "--methods", "rk4", "--predict", "--json")
    one, two = (json.loads(run.stdout)["rows"][0] for run in (wine("hooke.exe", *limit), here(*limit)))
    assert one["exact"] and abs(one["predicted"] / two["predicted"] - 1) < 1e-9


def test_files(wine, tmp_path):
    """Files are written as whole ones in the place of others, by paths of both kinds; lines end as everywhere."""
    (tmp_path / "inner").mkdir()
    make = ["make", "rope", "--from", "0,0,0", "--to", "1,0,0", "--segments", "6", "--mass", "1", "--stretch.stiffness"]
    for stiffness, name in (("50", "inner/rope.json"), ("60", "inner\\rope.json"), ("70", "inner\\rope.json")):
        wine("hooke.exe", *make, stiffness, "-o", name, folder=tmp_path)
        assert [path.name for path in (tmp_path / "inner").iterdir()] == ["rope.json"]
    written = (tmp_path / "inner/rope.json").read_bytes().decode()
    assert json.loads(written)["parts"] and "\r" not in written
    assert here(*make, "70").stdout == written == wine("hooke.exe", *make, "70", folder=tmp_path).stdout
    wine("hooke.exe", "run", "inner\\rope.json", "--duration", "0.01", "--step", "1e-4", folder=tmp_path)
    gone = wine("hooke.exe", "run", "inner\\none.json", folder=tmp_path, expect=3)
    assert "cannot be opened: No such file or directory" in gone.stderr
    refused = wine("hooke.exe", *make, "70", "-o", "inner", folder=tmp_path, expect=5)
    assert "is not a regular file" in refused.stderr


def assert_same_frames(one, other):
    with h5py.File(one) as one_file, h5py.File(other) as other_file:
        for name in ("position/value", "position/time", "velocity/value"):
            assert one_file["particles/all"][name][:].tobytes() == other_file["particles/all"][name][:].tobytes()


def test_trajectories(wine, tmp_path):
    """A trajectory has the bits of Linux, also in the place of another one."""
    words = ["run", str(ROOT / "examples/scenes/cloth-16.json"), "--duration", "0.02", "--every", "0.002"]
    for _ in range(2):
        wine("hooke.exe", *words, "-o", "there.h5", folder=tmp_path)
    here(*words, "-o", "here.h5", folder=tmp_path)
    assert_same_frames(tmp_path / "there.h5", tmp_path / "here.h5")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["here.h5", "here.xdmf", "there.h5", "there.xdmf"]


def killed(wine, folder, meanwhile):
    """A run that is killed after `meanwhile`; its words."""
    words = ["run", str(ROOT / "examples/scenes/cloth-16.json"), "--duration", "1", "--every", "0.01", "--step", "2e-6"]
    run, end = wine("hooke.exe", *words, "-o", "slow.h5", folder=folder, start=True), time.monotonic() + 60
    while not (folder / "slow.h5").exists():
        assert run.poll() is None and time.monotonic() < end
        time.sleep(0.02)
    meanwhile()
    assert run.poll() is None
    run.kill()
    run.wait()
    return words


def test_a_killed_run_goes_on(wine, tmp_path):
    words = killed(wine, tmp_path, lambda: None)
    wine("hooke.exe", "run", "--resume", "slow.h5", folder=tmp_path)
    here(*words, "-o", "here.h5", folder=tmp_path)
    assert_same_frames(tmp_path / "slow.h5", tmp_path / "here.h5")


def test_two_runs(wine, tmp_path):
    """A run locks its file against other runs, but not against readers."""
    def meanwhile():
        refused = wine("hooke.exe", "run", "--resume", "slow.h5", folder=tmp_path, expect=5)
        assert "another run is writing this file" in refused.stderr
    killed(wine, tmp_path, meanwhile)


def test_pages(wine, tmp_path):
    """A page has the scripts and the frames of one made on Linux; files and folders may have any name."""
    folder = tmp_path / "Größe ☃"
    folder.mkdir()
    words = ["run", str(ROOT / "examples/scenes/cloth-16.json"), "--duration", "0.02", "--every", "0.002", "-o", "Fäden.h5"]
    wine("hooke.exe", *words, folder=folder)
    wine("hooke.exe", "view", "Fäden.h5", "-o", "there.html", folder=folder)
    here("view", "Fäden.h5", "-o", "here.html", folder=folder)
    pages = [(folder / name).read_text(encoding="utf-8") for name in ("there.html", "here.html")]
    scripts, frames = ([re.findall(pattern, page, re.DOTALL) for page in pages] for pattern in ("<script>.*?</script>", "[A-Za-z0-9+/=]{400,}"))
    assert scripts[0] == scripts[1] and frames[0] == frames[1] and scripts[0] and frames[0]
    wine("hooke.exe", "limit", ROOT / "examples/scenes/curl.json", "--methods", "rk4", "--predict", "--report", "limit.html", folder=folder)
    assert "new Chart(" in (folder / "limit.html").read_text(encoding="utf-8")


def test_interrupt(wine, tmp_path):
    """Ctrl-C keeps what there is, and the run goes on from there."""
    words = ["run", str(ROOT / "examples/scenes/cloth-16.json"), "--duration", "1", "--every", "0.01", "--step", "2e-6", "-o", "slow.h5"]
    run, end = wine("hooke.exe", *words, folder=tmp_path, start=True), time.monotonic() + 60
    while not (tmp_path / "slow.h5").exists():
        assert run.poll() is None and time.monotonic() < end
        time.sleep(0.02)
    time.sleep(0.5)
    run.send_signal(signal.SIGINT)
    assert run.wait(timeout=60) == 130
    wine("hooke.exe", "verify", "slow.h5", "--bits", folder=tmp_path)
