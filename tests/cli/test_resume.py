"""Interrupted runs continue with --resume and end as if uninterrupted: the same results, the same file."""

import json
import os
import random
import signal
import time

import pytest
from conftest import SIX_PARTICLES, STIFF_PAIR, hanging_cloth, interrupt

np = pytest.importorskip("numpy")
h5py = pytest.importorskip("h5py")
pytestmark = pytest.mark.everything

CLOTH = {
    **hanging_cloth(16, {"stiffness": 50, "damping": 0.02}, shear={"stiffness": 20}),
    "drag": 1e-4,
    "driven": [{"particles": [120], "motion": "harmonic", "amplitude": [0, 0.1, 0], "frequency": 2}],
}

# Some tenths of a second of work each.
RUNS = {
    "symplectic-euler": {"step": 1e-5, "duration": 0.5, "every": 0.005},
    "rk4 with checkpoints": {"method": "rk4", "step": 5e-5, "duration": 0.5, "every": 0.005, "checkpoint": 0.012},
    "backward-euler": {"method": "backward-euler", "step": 1e-3, "duration": 0.1, "every": 0.005},
    "cvode-adams": {"method": "cvode-adams", "rtol": 1e-8, "duration": 0.3, "every": 0.005, "checkpoint": 0.012},
    "cvode-bdf from the beginning": {"method": "cvode-bdf", "rtol": 1e-5, "duration": 0.1, "every": 0.005},
}

if os.environ.get("HOOKE_PRESET") == "asan" and not os.environ.get("HOOKE_LONG"):  # where work takes ten times as long
    RUNS = {name: RUNS[name] for name in ["symplectic-euler", "cvode-bdf from the beginning"]}


def contents(path):
    """Every number of a file, except the identifier of the run."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(
            lambda name, thing: found.__setitem__(name, thing[()]) if isinstance(thing, h5py.Dataset) else None
        )
    return {name: value.tobytes() if isinstance(value, np.ndarray) else value for name, value in found.items()}


def results(out, **changed):
    value = {**json.loads(out), **changed}
    for name in ("error", "claims"):
        value.pop(name, None)  # no error is estimated for a continued run
    del value["wall_seconds"]
    del value["zero_passages"]  # not known of a continued run
    return value


def signalled(process, seconds, number):
    """Its output, and whether it was stopped; None, and True, if the signal came before it began."""
    time.sleep(seconds)
    process.send_signal(number)
    out, err = process.communicate(timeout=120)
    assert process.returncode in (0, 130, -number), err
    assert b"Sanitizer" not in err, err
    if process.returncode < 0:
        return None, True
    if process.returncode == 0:
        return out, False
    assert b"to go on:\n  hooke run --resume 'out name.h5'\n" in err
    assert json.loads(out)["status"] == "stopped"
    return out, True


@pytest.mark.parametrize("name", RUNS)
def test_interrupted_anywhere(hooke, start, write, tmp_path, name):
    source = random.Random(name)
    scene = write(CLOTH, **RUNS[name])
    begun = time.monotonic()
    whole = hooke("run", scene, "-o", "whole.h5", "--no-estimate", "--json", "--final")
    took = time.monotonic() - begun
    assert whole.code == 0
    stopped = 0
    for attempt in range(6):
        if stopped and not os.environ.get("HOOKE_LONG"):
            break
        words = ["run", scene, "-o", "out name.h5", "--no-estimate"]
        for _ in range(3):
            process = start(*words, "--json", "--final", "--threads", source.choice([1, 2]))
            number = source.choice([signal.SIGINT, signal.SIGTERM])
            out, more = signalled(process, source.uniform(0.02, 0.7 / (1 + attempt)) * took, number)
            if not more:
                break
            if out is not None:
                stopped += 1
                words = ["run", "--resume", "out name.h5"]
        else:
            out = hooke(*words, "--json", "--final").out
        assert results(out) == results(whole.out, output="out name.h5")
        found, whole_found = contents(tmp_path / "out name.h5"), contents(tmp_path / "whole.h5")
        assert whole_found.pop("hooke/error_reason") == b""
        assert (b"the run was continued" in found.pop("hooke/error_reason")) == ("--resume" in words)
        for each in (found, whole_found):
            del each["hooke/file_check"]  # of threads and of the error, too
        assert found == whole_found
        left = {path.name for path in tmp_path.iterdir()}
        assert left == {scene, "whole.h5", "whole.xdmf", "out name.h5", "out name.xdmf"}
    if not stopped:
        pytest.skip("this machine is too busy: every signal came before the beginning or after the end")


def interrupted(start, write, tmp_path, **run):
    process = start("run", write(CLOTH, step=1e-6, duration=2, every=2e-5, **run), "-o", "out.h5")
    while not (tmp_path / "out.h5").exists():
        assert process.poll() is None, process.communicate()
        time.sleep(0.01)
    interrupt(process, 0.1)
    _, err = process.communicate(timeout=60)
    assert process.returncode == 130
    return err.decode()


def gone_on(start):
    """What a run says that goes on from the last whole frame, and is interrupted once it has said so."""
    process, said = start("run", "--resume", "out.h5"), b""
    while b"goes on from the last whole frame, at t = " not in said:
        line = process.stderr.readline()
        assert line, said
        said += line
    interrupt(process, 0.1)
    _, rest = process.communicate(timeout=60)
    assert process.returncode == 130
    return (said + rest).decode()


def test_only_what_changes_no_bit_may_be_given(hooke, start, write, tmp_path):
    interrupted(start, write, tmp_path)
    for words, message in [
        (["scene.json"], "leave out 'scene.json'"),
        (["--step", "1e-3"], "leave out --step"),
        (["--method", "rk4"], "leave out --method"),
        (["--checkpoint", "1"], "leave out --checkpoint"),
        (["-o", "other.h5"], "leave out --output"),
        (["--want", "1mm"], "leave out --want"),
    ]:
        hooke("run", "--resume", "out.h5", *words, code=2, err=message)
    assert hooke("run", "--resume").code == 2
    hooke("run", "scene.json", "--checkpoint", "0.1", code=2, err="-o")


def test_a_damaged_checkpoint_gives_way_to_the_last_frame(hooke, start, write, tmp_path):
    interrupted(start, write, tmp_path)
    frames = len(h5py.File(tmp_path / "out.h5")["particles/all/position/time"])
    whole = (tmp_path / "out.h5.checkpoint").read_bytes()
    (tmp_path / "out.h5.checkpoint").write_bytes(whole[:1000] + bytes([whole[1000] ^ 0xFF]) + whole[1001:])
    assert "is damaged" in gone_on(start)
    with h5py.File(tmp_path / "out.h5") as file:
        times = file["particles/all/position/time"][:]
        assert len(times) >= frames and np.array_equal(times, 0.0 + np.arange(len(times)) * 20 * 1e-6)


def test_one_of_another_run_is_not_taken(hooke, start, write, tmp_path):
    interrupted(start, write, tmp_path)
    old = (tmp_path / "out.h5.checkpoint").read_bytes()
    interrupted(start, write, tmp_path, checkpoint=1.5)
    (tmp_path / "out.h5.checkpoint").write_bytes(old)
    assert "is of another run" in gone_on(start)


@pytest.mark.parametrize("method", [{}, {"method": "cvode-adams", "rtol": 1e-8}], ids=["a fixed step", "error control"])
def test_of_a_run_that_has_finished_it_tells_what_the_file_has(hooke, write, tmp_path, method):
    scene = write(SIX_PARTICLES, checkpoint=0.1, **method)
    first = hooke("run", scene, "-o", "out.h5", "--json", "--final")
    assert first.code == 0 and not (tmp_path / "out.h5.checkpoint").exists()
    before = (tmp_path / "out.h5").read_bytes()
    again = hooke("run", "--resume", "out.h5", "--json", "--final")
    assert again.code == 0 and "had finished" in again.err
    assert results(again.out) == results(first.out, force_evaluations=None)  # which no file has
    assert again.json["wall_seconds"] is None and again.json["zero_passages"] is None
    words = hooke("run", "--resume", "out.h5", "--final", "--quiet")
    assert words.err == "" and f"steps                 {first.json['steps']}\n" in words.out
    assert "wall time" not in words.out and words.out.count("\n5 ") == 1
    assert (tmp_path / "out.h5").read_bytes() == before


def test_a_run_that_diverged_does_so_again(hooke, write, tmp_path):
    scene = write(STIFF_PAIR, checkpoint=0.3)
    first = hooke("run", scene, "-o", "out.h5", "--json", "--final")
    assert first.code == 4 and (tmp_path / "out.h5.checkpoint").exists()
    frames = contents(tmp_path / "out.h5")
    again = hooke("run", "--resume", "out.h5", "--json", "--final")
    assert again.code == 4 and results(again.out) == results(first.out)
    assert contents(tmp_path / "out.h5") == frames


def test_what_is_no_trajectory(hooke, write, tmp_path):
    (tmp_path / "text.h5").write_text("no such thing")
    assert hooke("run", "--resume", "text.h5").code == 3
    assert hooke("run", "--resume", "nothing.h5").code == 3
    assert hooke("run", "--resume", write(SIX_PARTICLES)).code == 5
    assert hooke("compare", "scene.json", "--methods", "rk4", "-o", "several.h5").code == 0
    several = (tmp_path / "several.h5").read_bytes()
    hooke("run", "--resume", "several.h5", code=3, err="several.h5: is of several runs")
    assert (tmp_path / "several.h5").read_bytes() == several
