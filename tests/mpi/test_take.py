"""Some particles of a system as a system, and motions that begin midway: the bits of the whole."""

import numpy as np
import pytest
from random_scenes import drape, network

import hooke


def taken_at_random(seed):
    """(system, the particles taken, those all of whose neighbours were), of a half on one side of a rough cut."""
    system, draw = network(seed).system, np.random.default_rng(seed)
    state = system.state()
    q, blocks = state.q, system.derivative_blocks(state.q, state.v)
    chosen = np.flatnonzero(q[:, 0] + draw.uniform(-0.1, 0.1, len(q)) < np.median(q[:, 0]))
    rows = np.split(blocks.column, blocks.row_start[1:-1])
    return system, chosen, [p for p in chosen if np.isin(rows[p], chosen).all()]


@pytest.mark.parametrize("seed", range(1))
def test_forces_have_the_same_bits(seed):
    system, chosen, inner = taken_at_random(seed)
    part, state = system.take(chosen), system.state()
    draw = np.random.default_rng(seed)
    q, v = (x + draw.normal(0, 0.05, x.shape) for x in (state.q, state.v))
    whole, mine = system.force(q, v, t=0.013), part.force(q[chosen], v[chosen], t=0.013)
    at = np.searchsorted(chosen, inner)
    assert 20 < len(inner) < len(chosen) < len(q)
    assert whole[inner].tobytes() == mine[at].tobytes()
    assert not np.array_equal(whole[chosen], mine), "the others lack forces"
    assert np.array_equal(part.state().q, state.q[chosen]) and np.array_equal(part.state().v, state.v[chosen])
    assert np.array_equal(system.acceleration(q, v, t=0.013)[inner], part.acceleration(q[chosen], v[chosen], t=0.013)[at])


def test_all_of_them():
    system = network(1).system
    part = system.take(np.arange(system.particle_count))
    state = system.state()
    assert np.array_equal(system.force(state.q, state.v), part.force(state.q, state.v))
    assert part.spring_count == system.spring_count
    assert system.take([]).particle_count == 0


def test_refusals():
    system = drape(3).system
    for wrong in ([2, 1], [1, 1], [9], [-1]):
        with pytest.raises(hooke.BadValue, match="particles"):
            system.take(wrong)
    body = hooke.System()
    body.add_particles(np.eye(3), mass=1.0)
    body.add_body("rod", [0, 1])
    with pytest.raises(hooke.Unsuited, match='rigid body "rod"'):
        body.take([2])
    called = hooke.System()
    called.add_particles(np.eye(3), mass=1.0)
    called.drive_callback([0], lambda t, q, v: None)
    with pytest.raises(hooke.Unsuited, match=r"callbacks \(drive\)"):
        called.take([2])


def test_a_motion_begins_midway():
    """At times whose last bits a motion from the time of that step does not have."""
    system, options = network(3).system, dict(method="symplectic-euler", step=1e-4 / 3)
    state = system.state()
    state.t = 0.1
    integrator = hooke.Integrator(system, **options)
    integrator.step(state, 37)
    other = state.copy()
    late, anew = hooke.Integrator(system, **options), hooke.Integrator(system, **options)
    assert late.begin(other, 0.1, 37) == "finished"
    restarted = state.copy()
    times = []
    for _ in range(50):
        for end, run in ((state, integrator), (other, late), (restarted, anew)):
            run.step(end)
        times.append((state.t, other.t, restarted.t))
    assert all(here == begun for here, begun, _ in times) and any(here != begun for here, _, begun in times)
    assert other.q.tobytes() == state.q.tobytes() and other.v.tobytes() == state.v.tobytes()
    with pytest.raises(hooke.BadValue, match="state: is at"):
        late.begin(state, 0.1, 37)
    with pytest.raises(hooke.Unsuited, match="fixed step"):
        hooke.Integrator(system, method="cvode-adams").begin(state, 0.0, 0)


def test_energy_of_one_motion():
    """Beyond what its start allows a later step has diverged, and the first one of another motion has not."""
    system = drape(4).system
    first = system.state()
    fast = first.copy()
    fast.v[-1] = 1e3
    fast.t = 0.01
    integrator = hooke.Integrator(system, method="rk4", step=1e-3)
    assert integrator.begin(first, 0.0, 0) == "finished"
    assert integrator.begin(fast, 0.0, 10) == "diverged"
    assert hooke.Integrator(system, method="rk4", step=1e-3).begin(fast, 0.0, 10) == "finished"
