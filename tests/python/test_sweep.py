"""Sweeps: rows with the same bits on every executor, whole or absent, never run twice, whatever ends them."""

import contextlib
import functools
import json
import os
import random
import signal
import subprocess
import sys
import time
import warnings
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor

import numpy as np
import pytest
from conftest import SIX_PARTICLES

import hooke

VARY = {"edges.stiffness": np.geomspace(10, 1000, 3), "run.step": ["1ms", 5e-4]}
ROPE = {
    "hooke": 1,
    "gravity": [0, -9.81, 0],
    "parts": [{"kind": "rope", "name": "line", "from": [0, 0, 0], "to": [1, 0, 0], "segments": 4, "mass": 1, "pinned": "start",
               "stretch": {"stiffness": 100}}],
    "run": {"method": "rk4", "step": 1e-3, "duration": 0.01},
}  # fmt: skip


@pytest.fixture
def path(tmp_path):
    """A scene file."""
    (tmp_path / "scene.json").write_text(json.dumps(SIX_PARTICLES))
    return tmp_path / "scene.json"


def timeless(rows):
    return [{name: value for name, value in row.items() if "seconds" not in name} for row in rows]


def test_a_row_is_the_run_with_its_values(path):
    rows = hooke.sweep(path, VARY, watch="2.y,energy", error=True)
    assert [(row["edges.stiffness"], row["run.step"]) for row in rows] == [(k, h) for k in VARY["edges.stiffness"] for h in VARY["run.step"]]
    for row in rows[::5]:
        scene = hooke.Scene.load(path, set={name: row[name] for name in VARY})
        result = scene.run(watch="2.y,energy", estimate=True)
        assert row["status"] == "finished" and row["reason"] == "" and row["time"] == result.state.t
        assert row["step"] == scene.run_options["step"] and row["steps"] == result.counts["steps"]
        assert row["2.y"] == result.state.q[2, 1] and row["energy.maximum"] == result.watched["maximum"][1]
        assert row["error.estimate"] == result.error.estimate
    assert "error.estimate" not in hooke.sweep(path, {"run.step": "1ms"})[0]


def test_the_same_bits_everywhere(path):
    rows = timeless(hooke.sweep(path, VARY, watch="2.y"))
    assert len({row["2.y"] for row in rows}) == 6
    scene = hooke.Scene.load(path)
    for pool in (ThreadPoolExecutor(3), ProcessPoolExecutor(2)):
        with pool:
            assert timeless(hooke.sweep(scene, VARY, watch="2.y", executor=pool)) == rows


@pytest.mark.check
@pytest.mark.parametrize("name", ["loky", "distributed"])
def test_the_same_bits_on_executors_of_others(path, name):
    module = pytest.importorskip(name)
    with contextlib.ExitStack() as stack:
        if name == "distributed":
            pool = stack.enter_context(module.Client(n_workers=2, threads_per_worker=1, dashboard_address=None)).get_executor()
        else:
            pool = module.get_reusable_executor(2)
        assert timeless(hooke.sweep(path, VARY, watch="2.y", executor=pool)) == timeless(hooke.sweep(path, VARY, watch="2.y"))
        pool.shutdown()


def test_what_is_in_the_file_is_not_run_again(path, tmp_path):
    output = tmp_path / "rows.jsonl"

    def run(scene, **options):
        run.asked.append(scene.run_options["step"])
        return {"x": len(run.asked), "y": np.float64("nan"), "z": np.arange(2)}

    run.asked = asked = []

    def sweep(**more):
        return hooke.sweep(path, VARY, output=output, run=run, **more)

    parts = [sweep(only=slice(k, None, 4)) for k in range(4)]
    assert [len(part) for part in parts] == [2, 2, 1, 1] and len(asked) == 6
    rows = sweep()
    assert len(asked) == 6 and [row["x"] for row in rows] == [1, 3, 5, 6, 2, 4] and rows[0]["y"] is None and rows[0]["z"] == [0, 1]
    assert [list(rows[k : k + 5 : 4]) for k in range(4)] == [list(part) for part in parts]
    whole = output.read_bytes()
    two = whole.rstrip(b"\n").rindex(b"\n") - 5
    for end, lost in ((-1, 0), (-3, 1), (two, 2)):  # the line feed, a piece of the last row, and of the one before it
        output.write_bytes(whole[:end])
        before = len(asked)
        assert len(sweep()) == 6 and len(asked) == before + lost
        assert len(rows_of(output)) == 6
    before = len(asked)
    sweep(threads=2)
    assert len(asked) == before + 6, "another question"


def test_rows_that_do_not_finish_have_a_reason(tmp_path):
    output = tmp_path / "rows.jsonl"
    values = [{"line.stretch.stiffness": -1}, {"lime.mass": 1}, {"run.step": 0.01, "line.stretch.stiffness": 1e7, "run.duration": 5},
              {"gravity": [0, -1, 0]}]  # fmt: skip
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rows = hooke.sweep(ROPE, values, output=output, watch="4.y")
    assert "above" in rows[2]["warnings"] and rows[3]["warnings"] == ""
    assert [row["status"] for row in rows] == ["refused", "refused", "diverged", "finished"]
    assert "stretch.stiffness: -1 is not allowed" in rows[0]["reason"] and 'did you mean "line"' in rows[1]["reason"]
    assert rows[2]["reason"] and rows[2]["time"] < 5 and "4.y" in rows[2] and rows[3]["gravity"] == [0, -1, 0]
    assert repr(rows) == "Sweep(4 rows: 2 refused, 1 diverged, 1 finished)"

    def absent(scene):
        raise FileNotFoundError("mesh")

    for _ in range(2):
        assert hooke.sweep(hooke.Scene.parse(ROPE), values[-1:], output=output, run=absent)[0]["status"] == "unavailable"
    assert len(output.read_text().splitlines()) == 4, "what the machine lacked is not kept"


def stiffer(factor, scene):
    return {"x": factor}


def test_a_function_is_known_by_what_it_is(path, tmp_path):
    asked = [functools.partial(stiffer, factor) for factor in (1, 1, 2)]
    rows = [hooke.sweep(path, {"run.step": 1e-3}, run=run, output=tmp_path / "rows.jsonl")[0]["x"] for run in asked]
    assert rows == [1, 1, 2] and len(rows_of(tmp_path / "rows.jsonl")) == 2


def test_measurements_are_rows():
    found = hooke.sweep(hooke.Scene.parse(ROPE), {"line.stretch.stiffness": [100, 1000]}, run=hooke.limit, predict=True, methods="rk4")
    limits = [hooke.limit(hooke.Scene.parse(ROPE, set={"line.stretch.stiffness": k}), predict=True, methods="rk4") for k in (100, 1000)]
    assert [row["frequency_max"] for row in found] == [limit.frequency_max for limit in limits]
    assert [row["claims"] for row in found] == [str(limit) for limit in limits]
    assert [row["rk4.predicted"] for row in found] == [limit["rk4"]["predicted"] for limit in limits]
    modes, each = hooke.sweep(ROPE, {"drag": 0.1}, run=hooke.modes)[0], hooke.modes(hooke.Scene.parse(ROPE, set={"drag": 0.1}))
    assert [modes[f"{k}.frequency"] for k in range(len(each.rows))] == each.rows["frequency"].tolist()
    study = hooke.sweep(hooke.Scene.parse(ROPE), {"run.duration": 0.02}, run=hooke.study, methods="verlet", points=6, want=1e-3)[0]
    assert study["recommendation.method"] == "verlet" and study["recommendation.error"] <= 1e-3


def test_mistakes_of_the_call_are_not_rows(path, tmp_path):
    for options, kind in (({"stepp": 1}, TypeError), ({"step": 1e-3}, hooke.BadValue), ({"run": hooke.limit, "methds": "step"}, TypeError)):
        with pytest.raises(kind, match="step|methods"):
            hooke.sweep(path, VARY, output=tmp_path / "rows.jsonl", **options)
    assert not (tmp_path / "rows.jsonl").exists()
    scene = hooke.Scene.parse(ROPE)
    hooke.sweep(scene, {"run.step": 1e-3})
    scene = hooke.Scene(run=ROPE["run"]).particles([[0, 0, 0], [1, 0, 0]], mass=1)
    scene.system.add_springs(None, [(0, 1)], stiffness=1)
    with pytest.raises(hooke.BadValue, match="cannot hold"):
        hooke.sweep(scene, {"run.step": 1e-3})
    with pytest.raises(FileNotFoundError):
        hooke.sweep(tmp_path / "none.json", {})


def test_what_writes_a_table_is_missed_before_the_runs(path, tmp_path, monkeypatch):
    pandas, ran = pytest.importorskip("pandas"), []

    def missing(*_, **__):
        raise ImportError("no pyarrow")

    monkeypatch.setattr(pandas.DataFrame, "to_parquet", missing)
    with pytest.raises(ImportError, match="pyarrow"):
        hooke.sweep(path, VARY, output=tmp_path / "rows.parquet", run=lambda scene: ran.append(scene))
    assert not ran


def test_a_scene_keeps_the_folder_of_its_files(tmp_path):
    (tmp_path / "scene").mkdir()
    (tmp_path / "scene" / "tri.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    part = {"kind": "mesh", "file": "tri.obj", "mass": 1, "pinned": [0], "structural": {"stiffness": 10}}
    (tmp_path / "scene" / "scene.json").write_text(json.dumps({**ROPE, "parts": [part]}))
    rows = [hooke.sweep(scene, {"drag": [0, 1]}, watch="2.y") for scene in (
        tmp_path / "scene" / "scene.json", hooke.Scene.load(tmp_path / "scene" / "scene.json"),
        hooke.Scene.parse({**ROPE, "parts": [part]}, folder=tmp_path / "scene"))]  # fmt: skip
    assert timeless(rows[0]) == timeless(rows[1]) == timeless(rows[2]) and rows[0][0]["status"] == "finished"


def test_tables(path, tmp_path):
    pandas = pytest.importorskip("pandas")
    rows = hooke.sweep(path, VARY, watch="2.y", output=tmp_path / "rows.csv")
    table = pandas.read_csv(tmp_path / "rows.csv")
    assert table["2.y"].tolist() == pytest.approx([row["2.y"] for row in rows], rel=1e-14)
    assert rows.to_pandas()["2.y"].tolist() == [row["2.y"] for row in rows]
    assert len(rows_of(tmp_path / "rows.csv.jsonl")) == 6 and sorted(os.listdir(tmp_path)) == ["rows.csv", "rows.csv.jsonl", "scene.json"]
    again = hooke.sweep(path, rows.to_pandas()[list(VARY)], watch="2.y")
    assert timeless(again) == timeless(rows)
    pytest.importorskip("xarray")
    assert rows.to_xarray()["2.y"].sel({"run.step": "1ms"}).values.tolist() == [row["2.y"] for row in rows[::2]]


def test_few_rows_wait_in_an_executor():
    class Counting(ThreadPoolExecutor):
        waiting = most = 0

        def submit(self, function, *arguments):
            self.waiting += 1
            self.most = max(self.most, self.waiting)
            future = super().submit(function, *arguments)
            future.add_done_callback(lambda _: setattr(self, "waiting", self.waiting - 1))
            return future

    with Counting(2) as pool:
        rows = hooke.sweep(hooke.Scene.parse(ROPE), {"drag": np.arange(50)}, run=lambda scene: {}, executor=pool)
        assert [row["drag"] for row in rows] == list(range(50)) and 2 <= pool.most <= 8
        hooke.sweep(hooke.Scene.parse(ROPE), {"drag": np.arange(50)}, run=lambda scene: time.sleep(0.001) or {}, executor=pool, ahead=20)
        assert 8 < pool.most <= 20


@pytest.mark.check
def test_a_row_costs_at_most_two_milliseconds_beside_its_run():
    """Of this process, and of a worker beside the run and the scene, which it reads in any case."""
    scene, values = hooke.Scene.parse(ROPE), {"line.stretch.stiffness": np.linspace(1, 100, 1000)}
    with ProcessPoolExecutor(2) as pool:
        assert pool.submit(int).result() == 0
        begun = time.process_time()
        rows = hooke.sweep(scene, values, executor=pool, watch="4.y")
        assert len(rows) == 1000 and time.process_time() - begun < 2.0
    begun = time.process_time()
    for stiffness in values["line.stretch.stiffness"]:
        hooke.Scene.parse(scene.text, set={"line.stretch.stiffness": float(stiffness)}).run(watch="4.y", estimate=False)
    alone = time.process_time() - begun
    begun = time.process_time()
    hooke.sweep(scene, values, watch="4.y")
    assert time.process_time() - begun < alone + 2.0


def test_progress_tells_and_ends(path):
    seen = []
    rows = hooke.sweep(path, VARY, progress=lambda fraction, what: seen.append(fraction) or len(seen) == 3)
    assert seen == [1 / 6, 2 / 6, 3 / 6] and len(rows) == 3


ROWS = 300
SWEEP = """
import sys, time, hooke
from concurrent.futures import ProcessPoolExecutor

def run(scene, **options):
    with open(sys.argv[2], "ab", buffering=0) as file:
        file.write(b"%r\\n" % float(scene.run_options["step"]))
    time.sleep(0.004)
    return hooke.run(scene, **options)

if __name__ == "__main__":
    with ProcessPoolExecutor(2) as pool:
        hooke.sweep(sys.argv[1], {"run.step": [1e-3 / (k + 1) for k in range(int(sys.argv[4]))]}, run=run, output=sys.argv[3], executor=pool,
                    duration=1e-3, every=1e-3)
"""


@pytest.mark.check
def test_kills_lose_and_double_nothing(tmp_path, path):
    """Of a worker, and of all processes at once, at 20 moments."""
    (tmp_path / "sweep.py").write_text(SWEEP)
    output, begun, chance, broken = tmp_path / "rows.jsonl", tmp_path / "begun", random.Random(1), 0
    command = [sys.executable, "sweep.py", "scene.json", begun, output, str(ROWS)]
    for kill in range(20):
        before = rows_of(output)
        begun.write_bytes(b"")
        started = subprocess.Popen(command, cwd=tmp_path, start_new_session=True, stderr=subprocess.PIPE)
        while not begun.read_bytes():
            time.sleep(0.01)
        time.sleep(0.3 * chance.random())
        workers = subprocess.run(["pgrep", "-P", str(started.pid)], capture_output=True, text=True).stdout.split()
        if kill % 2:
            os.killpg(started.pid, signal.SIGKILL)
        elif workers:
            os.kill(int(chance.choice(workers)), signal.SIGKILL)
        told = started.communicate(timeout=60)[1].decode()
        broken += "the same call with another executor does the rest" in told
        after = rows_of(output)
        assert after[: len(before)] == before and not {row["run.step"] for row in before} & set(map(float, begun.read_text().split()))
        if len(after) == ROWS:
            output.unlink()
    assert broken > 3
    subprocess.run(command, cwd=tmp_path, check=True)
    assert sorted(row["run.step"] for row in rows_of(output)) == sorted(1e-3 / (k + 1) for k in range(ROWS))


def rows_of(output):
    """The whole rows in the file; all lines are but those that a kill cut off."""
    lines = output.read_text().splitlines() if output.exists() else []
    return [json.loads(line) for line in lines if line.endswith("}")]


def test_a_function_is_another_with_other_values(path, tmp_path):
    def made(gain):
        return lambda scene, **options: {"gain": gain}

    rows = [hooke.sweep(path, {"run.step": [1e-3]}, run=made(gain), output=tmp_path / "rows")[0] for gain in (1, 2, 1)]
    assert [row["gain"] for row in rows] == [1, 2, 1] and len((tmp_path / "rows").read_text().splitlines()) == 2


def test_rows_begin_at_one_state(path):
    state = hooke.Scene.load(path).system.state()
    rows = hooke.sweep(path, {"edges.stiffness": [10, 20]}, state=state, duration=0.1)
    assert [row["time"] for row in rows] == [0.1, 0.1] and state.t == 0


def test_one_file_of_all_rows_is_refused(path, tmp_path):
    with pytest.raises(hooke.BadValue, match="probes"):
        hooke.sweep(path, {"run.step": [1e-3, 5e-4]}, probe="2.y", probes=str(tmp_path / "all.csv"))
    assert hooke.sweep(path, {"run.step": [1e-3]}, estimate=True, duration=0.1)[0]["error.estimate"] > 0
