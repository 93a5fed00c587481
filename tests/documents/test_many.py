"""The blocks of docs/many.md that stand on programs and packages of others, where those are there."""

import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import blocks
import pytest
from pages import ROOT, SITE

FOUND = blocks.blocks("many.md", (SITE / "many.md").read_text(encoding="utf-8"))
PREPARE = "export PATH=$HOOKE_FOLDER:$PATH SLURM_ARRAY_TASK_ID=2\nprintf '10\\n100\\n1000\\n' > values.txt\nsrun() { \"$@\"; }\n"


@pytest.fixture
def folder(tmp_path, monkeypatch):
    shutil.copytree(ROOT / "examples/scenes", tmp_path / "examples/scenes")
    monkeypatch.setenv("HOOKE_FOLDER", str(Path(os.environ["HOOKE_CLI"]).parent))
    return tmp_path


def execute(command, folder):
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.check
@pytest.mark.parametrize("block", [block for block in FOUND if block.word], ids=lambda block: block.word)
def test_executors(block, folder):
    if importlib.util.find_spec(block.word) is None or (block.word == "mpi4py" and shutil.which("mpirun") is None):
        pytest.skip(f"there is no {block.word}")
    (folder / "many.py").write_text(block.text)
    mpi = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", "3", sys.executable, "-m", "mpi4py.futures"]
    told = execute([*(mpi if block.word == "mpi4py" else [sys.executable]), "many.py"], folder)
    assert "Sweep(2 rows: 2 finished)" in told


def block_of(word):
    return next(block.text for block in FOUND if word in block.text)


def test_xargs_and_a_job_of_an_array_write_a_row_a_run(folder):
    execute(["bash", "-ec", PREPARE + block_of("xargs")], folder)
    rows = (folder / "rows.jsonl").read_text().splitlines()
    assert len(rows) == 3 and all(row.startswith('{"set": {"rope.stretch.stiffness": 1') for row in rows)
    row = (folder / "row-100.json").read_text()
    execute(["bash", "-ec", PREPARE + block_of("#SBATCH")], folder)
    assert (folder / "row-2.json").read_text().split('"wall')[0] == row.split('"wall')[0]


@pytest.mark.check
@pytest.mark.skipif(shutil.which("parallel") is None, reason="there is no GNU parallel")
def test_parallel_runs_nothing_twice(folder):
    for _ in range(2):
        execute(["bash", "-ec", PREPARE + block_of("parallel")], folder)
        assert len((folder / "rows.jsonl").read_text().splitlines()) == 6


@pytest.mark.check
@pytest.mark.skipif(importlib.util.find_spec("snakemake") is None, reason="there is no Snakemake")
def test_snakemake(folder):
    (folder / "Snakefile").write_text(block_of("rule all"))
    execute(["bash", "-ec", PREPARE + f"{sys.executable} -m snakemake -j 2"], folder)
    assert len(list(folder.glob("row-*.json"))) == 3
