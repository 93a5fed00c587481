"""`python -m hooke` and the command that pip installs: the program, with its exit codes and signals."""

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from conftest import PACKAGES, ROOT

COMMANDS = {"module": [sys.executable, "-m", "hooke"],
            "command": [sys.executable, "-c", "import sys; from hooke_program import main; sys.exit(main())"]}  # fmt: skip

ENVIRONMENT = os.environ | {"PYTHONPATH": str(PACKAGES)}


@pytest.fixture(params=COMMANDS)
def hooke(request):
    def start(*arguments):
        return subprocess.Popen([*COMMANDS[request.param], *arguments], env=ENVIRONMENT, text=True,
                                stdout=subprocess.PIPE, stderr=subprocess.PIPE)  # fmt: skip

    return start


def is_running(process):
    """Whether the program has taken the place of Python, and handles the signal."""
    if Path(os.readlink(f"/proc/{process.pid}/exe")).name != "hooke":
        return False
    caught = re.search(r"SigCgt:\s*(\w+)", Path(f"/proc/{process.pid}/status").read_text()).group(1)
    return int(caught, 16) >> (signal.SIGINT - 1) & 1


def test_it_answers(hooke):
    running = hooke("--version")
    assert running.communicate()[0].startswith("hooke 0.") and running.returncode == 0


def test_exit_codes_pass_through(hooke):
    running = hooke("nothing")
    assert "there is no verb 'nothing'" in running.communicate()[1] and running.returncode == 2


def test_it_may_be_interrupted(hooke):
    running = hooke("run", ROOT / "examples/scenes/rope.json", "--duration", "1e9")
    while not is_running(running):
        time.sleep(0.05)
    running.send_signal(signal.SIGINT)
    assert running.wait(timeout=20) == 130


def test_a_reader_may_go_away(hooke):
    running = hooke("--man")
    running.stdout.close()
    running.wait(timeout=20)
    assert running.returncode == -signal.SIGPIPE and running.stderr.read() == ""


def test_a_package_without_its_program_says_so(tmp_path):
    (tmp_path / "hooke").mkdir()
    (tmp_path / "hooke/__init__.py").touch()
    done = subprocess.run(COMMANDS["command"], env=os.environ | {"PYTHONPATH": f"{tmp_path}:{PACKAGES}"}, capture_output=True, text=True)
    assert done.returncode == 1 and "there is no program hooke in" in done.stderr


def test_examples_have_the_bits_that_every_machine_gives():
    done = subprocess.run([sys.executable, ROOT / "tests/wheel/bits.py"], env=ENVIRONMENT, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr
