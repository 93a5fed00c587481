"""Calls of the library release Python's lock: other threads continue, so that two runs use two cores. A force written
in C waits inside the call until another Python thread has answered. If the lock were held, nobody could answer, and
the force would time out."""

import ctypes
import os
import subprocess
import threading
import time

import numpy as np
import pytest

import hooke
from hooke._library import lib
from hooke._prototypes import FORCE, FORCE_PRODUCT

FORCE_IN_C = """
#include <stdint.h>
#include <unistd.h>

int32_t wait_for_answer(int64_t n, double t, const double *q, const double *v, double *force, void *ctx) {
  volatile int64_t *slot = ctx;
  (void)n, (void)t, (void)q, (void)v, (void)force;
  slot[0] = 1; /* in the library */
  for (int k = 0; k < 20000 && slot[1] == 0; k++)
    usleep(1000);
  slot[2] = slot[1];
  return 0;
}
"""


@pytest.fixture(scope="module")
def force(tmp_path_factory):
    folder = tmp_path_factory.mktemp("force")
    source, library = folder / "force.c", folder / "libforce.so"
    source.write_text(FORCE_IN_C)
    compiler = os.environ.get("HOOKE_CC") or "cc"
    subprocess.run([compiler, "-shared", "-fPIC", "-o", library, source], check=True)
    return ctypes.CDLL(str(library)).wait_for_answer


def one_particle():
    system = hooke.System()
    system.add_particles([[0, 0, 0]], mass=1)
    return system


RUN = {"method": "symplectic-euler", "step": 0.5, "duration": 1, "every": 0.5}
CALLS = {
    "run": lambda system: hooke.run(system, **RUN),
    "step": lambda system: hooke.Integrator(system, **RUN).step(system.state()),
    "acceleration": lambda system: system.acceleration([[0, 0, 0]], [[0, 0, 0]]),
    "study": lambda system: hooke.study(system, ["verlet"], steps=[0.5], duration=1, every=0.5),
}


@pytest.mark.parametrize("call", CALLS)
def test_another_thread_answers_while_a_call_lasts(call, force):
    system, slot = one_particle(), (ctypes.c_int64 * 3)()
    callback = FORCE(ctypes.cast(force, ctypes.c_void_p).value)
    lib.hooke_system_set_force(system._handle, callback, FORCE_PRODUCT(), ctypes.addressof(slot))

    def answer():
        while slot[0] == 0:
            time.sleep(0.001)
        slot[1] = 1

    other = threading.Thread(target=answer)
    other.start()
    try:
        CALLS[call](system)
    finally:
        slot[0] = 1
        other.join()
    assert slot[2] == 1


def test_runs_in_threads_share_a_system():
    scene = hooke.Scene(gravity=(0, -9.81, 0)).cloth(
        size=(8, 8), edges=((1, 0, 0), (0, 0, 1)), mass=1, structural={"stiffness": 50}, pinned="top-corners"
    )
    system, results = scene.system, {}
    system.commit()

    def work(number):
        results[number] = hooke.run(system, method="verlet", step=1e-3, duration=0.2 + 0.1 * number).state.q

    threads = [threading.Thread(target=work, args=(number,)) for number in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    for number, q in results.items():
        alone = hooke.run(system, method="verlet", step=1e-3, duration=0.2 + 0.1 * number).state.q
        assert np.array_equal(q, alone)
    assert len(results) == 4
