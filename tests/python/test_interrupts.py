"""Ctrl-C works during the library's work, between frames and within long loops too, and keeps the results so far."""

import os
import signal
import subprocess
import sys

import numpy as np
import pytest
from conftest import PACKAGES, build_oscillator

import hooke

# Prints the time from the signal to the end of the work, and its results; `due` [s]: time of the signal.
SCRIPT = """
import os, signal, sys, threading, time
import numpy as np
import hooke

def cloth(n):
    system = hooke.System()
    number = np.arange(n * n).reshape(n, n)
    place = np.stack(np.divmod(np.arange(n * n), n) + (np.zeros(n * n),), axis=1) / n
    system.add_particles(place, mass=1e-3)
    pairs = [(number[:-1], number[1:]), (number[:, :-1], number[:, 1:])]
    ends = np.concatenate([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in pairs])
    system.add_springs(None, ends, stiffness=500, damping=1e-3)
    system.pin([0, n - 1])
    system.set_gravity([0, -9.81, -1])
    return system

system = cloth(30)
state = system.state()

def soon(due=0.5):
    threading.Timer(due, lambda: (sent.append(time.monotonic()), os.kill(os.getpid(), signal.SIGINT))).start()

def blown_up():
    integrator = hooke.Integrator(system, method="symplectic-euler", step=5e-3, duration=100, every=1)
    assert integrator.run(state) == "diverged"
    return integrator

sent, work = [], {
    "run": lambda: hooke.run(system, method="symplectic-euler", step=1e-6, duration=1e3, every=1e3),
    "step": lambda: hooke.Integrator(system, method="verlet", step=1e-6).step(state, 10**12),
    "implicit": lambda: hooke.Integrator(system, method="backward-euler", step=1e-2).step(state, 10**12),
    "cvode": lambda: hooke.Integrator(system, method="cvode-bdf", duration=1e6, every=1e6).run(state),
    "limit": lambda: hooke.limit(system, accuracy=1e-4, budget=300),
    "along": lambda: hooke.limit(system, along=True, method="verlet", step=1e-6, duration=1e3, every=1e3),
    "why": lambda: failed.why(300),
    "study": lambda: hooke.study(system, duration=10, budget=300),
    "needs": lambda: hooke.needs(system, 1e-3, duration=10, every=1),
    "want": lambda: hooke.run(system, want=1e-3, duration=10),
}
name = sys.argv[1]
failed = blown_up() if name == "why" else None
soon()
try:
    work[name]()
    print("ended by itself")
except KeyboardInterrupt:
    heard = time.monotonic() - sent[0]
    assert np.isfinite(state.q).all() and np.isfinite(state.v).all()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    print(heard, state.t)
"""


@pytest.mark.check
@pytest.mark.parametrize("work", ["run", "step", "implicit", "cvode", "limit", "along", "why", "study", "needs", "want"])
def test_ctrl_c_is_heard(work):
    environment = {**os.environ, "PYTHONPATH": str(PACKAGES), "PYTHONWARNINGS": "ignore"}
    call = [sys.executable, "-c", SCRIPT, work]
    done = subprocess.run(call, env=environment, capture_output=True, text=True, timeout=60)
    if "NotBuilt" in done.stderr:
        pytest.skip("a part that is not built")
    assert done.returncode == 0, done.stderr
    heard, t = map(float, done.stdout.split())
    assert heard < 3  # on a busy machine; half a second, and a step or a factorisation
    assert t > 0 or work not in ("step", "cvode")


def test_what_a_handler_of_your_own_raises_comes_out():
    class Enough(Exception):
        pass

    def give_up(*_):
        raise Enough

    before = signal.signal(signal.SIGINT, give_up)
    system = build_oscillator()
    state = system.state()
    try:
        child = subprocess.Popen(
            [sys.executable, "-c", f"import os, time; time.sleep(0.2); os.kill({os.getpid()}, {int(signal.SIGINT)})"]
        )
        with pytest.raises(Enough):
            hooke.Integrator(system, method="verlet", step=1e-6).step(state, 10**12)
        assert signal.getsignal(signal.SIGINT) is give_up
        child.wait()
    finally:
        signal.signal(signal.SIGINT, before)
    assert state.t > 0 and np.isfinite(state.q).all()
