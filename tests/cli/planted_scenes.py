"""Scenes in which an ingredient does nothing, by name."""

import json
from pathlib import Path


def scene(title, run, falls=True, **pieces):
    method, duration, every = run
    weight = {"gravity": [0, -9.81, 0]} if falls else {}
    return {"hooke": 1, "title": title, **weight, **pieces, "run": {"method": method, "duration": duration, "every": every}}


def rope(to=(1, 0, 0), segments=16, **pieces):
    return {"kind": "rope", "name": "rope", "from": [0, 0, 0], "to": list(to), "segments": segments, "mass": 0.1, **pieces}


def particles(position, mass, **pieces):
    return {"position": position, "mass": mass, **pieces}


def group(name, stiffness, between=((0, 1),), **pieces):
    return [{"name": name, "between": [list(pair) for pair in between], "stiffness": stiffness, **pieces}]


def curtain(name, size, at=(0, 0, 0), **families):
    return {"kind": "cloth", "name": name, "origin": list(at), "edges": [[1, 0, 0], [0, -1, 0]], "size": [size, size],
            "mass": 0.1, "pinned": "top", **families}


HELD = {"pinned": "start"}
SHEET = [5 * j + i for j in range(5) for i in range(5)]
SCENES = {
    "flat-cloth": scene(
        "a stiff cloth that hangs flat: bending springs do nothing", ("rk4", 0.5, 0.01),
        parts=[curtain("cloth", 7, structural={"stiffness": 200, "damping": 0.3}, shear={"stiffness": 60},
                       bend={"stiffness": 1})]),
    "only-falls": scene(
        "a rope that only falls: damping and springs do nothing", ("verlet", 0.5, 0.01),
        parts=[rope(stretch={"stiffness": 100, "damping": 0.1}, bend={"stiffness": 1})]),
    "far-away": scene(
        "a rope that swings, and a cloth far away", ("rk4", 0.5, 0.01),
        parts=[rope(segments=8, **HELD, stretch={"stiffness": 100, "damping": 0.05}),
               curtain("curtain", 6, at=(10, 0, 0), structural={"stiffness": 50}, shear={"stiffness": 20})]),
    "faint-drag": scene(
        "a pendulum in thin air", ("rk4", 2, 0.02), drag=1e-5,
        particles=particles([[0, 0, 0], [1, 0, 0]], 1, pinned=[0]), springs=group("rod", 1000)),
    "short-beat": scene(
        "a stiff pair that beats too briefly for gravity", ("verlet", 0.02, 5e-4),
        particles=particles([[0, 0, 0], [1.05, 0, 0]], 0.01), springs=group("pair", 2e4, rest_length=1)),
    "taut-chain": scene(
        "a chain under tension never pushes", ("rk4", 0.4, 0.01),
        parts=[rope((0, -1, 0), 10, **HELD, stretch={"stiffness": 200, "damping": 0.2})]),
    "idle-net": scene(
        "a loaded chain, and a frame of pinned particles whose springs never move", ("rk4", 0.5, 0.01),
        particles=particles([[0.1 * i, 0, j] for j in (0, 1) for i in range(8)], 0.02, pinned=[0, *range(7, 16)]),
        springs=group("net", 60, [(k, k + 1) for k in range(15) if k != 7], damping=0.02)),
    "pinned-marks": scene(
        "a pendulum among pinned marks that touch nothing", ("verlet", 1, 0.02),
        particles=particles([[x, 0, 0] for x in (0, 0.5, 2, 3, 4)], 0.5, pinned=[0, 2, 3, 4]), springs=group("rod", 500)),
    "smooth-rope": scene(
        "a rope that hangs and stretches evenly: half its resolution does", ("rk4", 0.5, 0.01),
        parts=[rope((0, -1, 0), 40, **HELD, stretch={"stiffness": 50, "damping": 0.05})]),
    "damped-mass": scene(
        "a mass on a damper, where the damping is what counts and the drag is not", ("rk4", 2, 0.02), falls=False, drag=1e-4,
        particles=particles([[0, 0, 0], [1.3, 0, 0]], 1, pinned=[0]), springs=group("damper", 40, damping=4, rest_length=1)),
    "shaken-rope": scene(
        "a rope shaken at one end, in free space: faint springs two apart, and a twin that nobody looks at",
        ("rk4", 0.6, 0.02), falls=False,
        parts=[rope(segments=10, stretch={"stiffness": 80, "damping": 0.05}, bend={"stiffness": 0.01}),
               {**rope((1, 0, 5), 10, stretch={"stiffness": 80}), "name": "twin", "from": [0, 0, 5]}],
        driven=[{"particles": [["rope", 0]], "motion": "harmonic", "amplitude": [0, 0.05, 0], "frequency": 2}]),
    "free-sheet": scene(
        "a sheet thrown through empty space: nothing holds it, nothing stretches it", ("symplectic-euler", 0.4, 0.01),
        falls=False, drag=1e-7,
        particles=particles([[0.1 * (k % 5), 0.1 * (k // 5), 0] for k in SHEET], 0.01, velocity=25 * [[1, 2, 0]]),
        springs=group("u", 10, [(k, k + 1) for k in SHEET if k % 5 < 4], damping=0.01)
        + group("v", 10, [(k, k + 5) for k in SHEET if k < 20])),
    "pinned-cloth": scene(
        "a cloth that is pinned all over but at one corner: nearly all springs are between pinned particles",
        ("symplectic-euler", 0.5, 0.02),
        parts=[{**curtain("cloth", 8, structural={"stiffness": 40, "damping": 0.01}, shear={"stiffness": 10}),
                "edges": [[1, 0, 0], [0, 0, 1]], "pinned": [k for k in range(62) if k not in (54, 55)]}]),
}
SCENES["pinned-cloth"]["run"]["step"] = 1e-3
FOLDER = Path(__file__).parent / "scenes" / "needs"  # of those that the documents show
for shown in ("hung-plate", "balanced-mass"):
    SCENES[shown] = json.loads((FOLDER / f"{shown}.json").read_text())
