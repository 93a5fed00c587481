"""Random scenes, and runs of them, by seed: every kind of scene that an independent solution can follow."""

from __future__ import annotations

import math
from dataclasses import dataclass
from random import Random
from typing import Any

EXPLICIT = ["symplectic-euler", "verlet", "shardlow", "heun", "rk4"]
IMPLICIT = ["backward-euler", "tr-bdf2", "implicit-midpoint"]
TOLERANT = ["cvode-bdf", "cvode-adams"]
FIRST_ORDER = ["forward-euler", "heun", "rk4", *IMPLICIT, *TOLERANT]  # of an overdamped scene
MOST_STEPS = 20000
MOST_TURNS, MANY_TURNS, FEW_TURNS = 5000, 1500, 150  # of the fastest motion [radians]: of what is chaotic later, few
RELAXED = 15  # the fastest rate times the duration of an overdamped scene, which does nothing later


@dataclass
class Scene:
    kind: str
    scene: dict[str, Any]
    fastest: float  # [1/s] at least the rate of its fastest motion, or of its fastest decay if it is overdamped
    turns: float = MANY_TURNS  # at most


def among(random: Random, low: float, high: float) -> float:
    """Log-uniform, of four digits."""
    return float(f"{math.exp(random.uniform(math.log(low), math.log(high))):.4g}")


def vector(random: Random, size: float) -> list[float]:
    return [round(random.uniform(-size, size), 4) for _ in range(3)]


def rate_of(masses: list[float], pairs: list[tuple[int, int]], kappa: list[float]) -> float:
    """A bound of the largest frequency of springs, by rows of the stiffness."""
    row = [0.0] * len(masses)
    for (i, j), k in zip(pairs, kappa):
        across = k / math.sqrt(masses[i] * masses[j])
        row[i] += k / masses[i] + across
        row[j] += k / masses[j] + across
    return math.sqrt(max(row))


# ---- nets ----


def net(random: Random, law: str, most: int = 12, least: int = 3, damping: float = 0.0, spread: float = 3.0) -> Scene:
    """Particles at random places, the first one pinned, joined to one before each of them and to a few others; every
    spring has its own stiffness, and its own damping."""
    count = random.randint(least, most)
    places = [vector(random, 1) for _ in range(count)]
    pairs = [(i, random.randrange(i)) for i in range(1, count)]
    pairs += [(i, j) for i in range(count) for j in range(i) if (i, j) not in pairs and random.random() < 0.25]
    masses = [among(random, 0.2, 2) for _ in range(count)]
    unit = among(random, 20, 2000)
    stiffness = [unit * among(random, 1 / spread, spread) for _ in pairs]
    kappa = [k / math.dist(places[i], places[j]) if law == "strain" else k for k, (i, j) in zip(stiffness, pairs)]
    fastest = rate_of(masses, pairs, kappa)
    group = {"name": "net", "between": pairs, "law": law, "stiffness": stiffness}
    if random.random() < 0.5:
        group["rest_scale"] = round(random.uniform(0.7, 1.1), 3)
    if damping:
        group["damping"] = [float(f"{2 * damping / fastest * k * random.uniform(0.5, 1):.4g}") for k in stiffness]
    particles = {"position": places, "mass": masses, "pinned": [0]}
    return Scene("net", {"hooke": 1, "particles": particles, "springs": [group]}, fastest, FEW_TURNS)


def moving(random: Random, one: Scene, speed: float) -> Scene:
    count = len(one.scene["particles"]["position"])
    one.scene["particles"]["velocity"] = [[0, 0, 0]] + [vector(random, speed) for _ in range(count - 1)]
    return one


def damped(random: Random) -> float:
    return random.choice([0, 0, 0.003, 0.05, 0.3])


def strain_net(random: Random) -> Scene:
    one = net(random, "strain", damping=damped(random))
    if random.random() < 0.6:
        one.scene["gravity"] = [0, -9.81, 0]
    return moving(random, one, random.choice([0.0, 1.0]))


def length_net(random: Random) -> Scene:
    return moving(random, net(random, "length", damping=damped(random)), 1.0)


def slack_net(random: Random) -> Scene:
    one = net(random, random.choice(["strain", "length"]), most=7, damping=damped(random))
    one.scene["springs"][0]["compression"] = False
    one.scene["gravity"] = [0, -9.81, 0]
    one.scene["drag"] = random.choice([0, 0.5])
    return moving(random, one, random.choice([0.0, 0.5]))


def dragged_net(random: Random) -> Scene:
    one = net(random, "strain")
    one.scene |= {"gravity": [0, -9.81, 0], "drag": among(random, 0.1, 5)}
    one.turns = MANY_TURNS
    return one


def stiff_net(random: Random) -> Scene:
    """Some springs are a thousand times as stiff."""
    one = net(random, "length", most=7, damping=0.05, spread=40)
    one.scene["drag"] = among(random, 0.5, 5)
    return moving(random, one, 0.5)


def heavy_net(random: Random) -> Scene:
    """Dampers as stiff as springs, or stiffer."""
    one = net(random, random.choice(["strain", "length"]), most=8, damping=random.choice([1.0, 3.0]))
    one.scene["gravity"] = [0, -9.81, 0]
    one.fastest *= 3
    return moving(random, one, random.choice([0.0, 1.0]))


def anchored_net(random: Random) -> Scene:
    one = net(random, random.choice(["strain", "length"]), most=6, damping=damped(random))
    count, unit = len(one.scene["particles"]["mass"]), one.fastest**2 * 0.1
    anchors: dict[str, Any] = {"particles": list(range(1, count)), "stiffness": float(f"{unit:.4g}")}
    if random.random() < 0.5:
        points = [vector(random, 1.5) for _ in range(1, count)]
        anchors |= {"rest_length": 0.2, "points": points, "damping": round(0.05 * unit / one.fastest, 4)}
    one.scene["anchors"] = [anchors]
    one.fastest *= math.sqrt(1.5)
    return moving(random, one, 0.5)


def table_net(random: Random) -> Scene:
    """A particle that a table moves."""
    one = net(random, "strain", damping=0.05, most=8)
    times = [round(0.15 * k * random.uniform(0.9, 1.1), 3) for k in range(random.randint(3, 9))]
    rows = [[0, 0, 0]] + [vector(random, 0.2) for _ in times[1:]]
    one.scene["driven"] = [{"particles": [1], "motion": "table", "time": times, "position": rows}]
    one.scene["gravity"] = [0, -9.81, 0]
    one.scene["drag"] = 1
    return one


def overdamped_net(random: Random) -> Scene:
    one = net(random, random.choice(["strain", "length"]), most=16)
    masses, drag = one.scene["particles"]["mass"], among(random, 0.5, 20)
    one.scene |= {"dynamics": "overdamped", "drag": drag, "gravity": random.choice([[0, -9.81, 0], [0, 0, 0]])}
    one.scene["springs"][0]["rest_scale"] = round(random.uniform(0.7, 1.2), 3)
    one.fastest, one.turns = one.fastest**2 * max(masses) / drag, RELAXED
    return one


def body_net(random: Random) -> Scene:
    """A rigid body, free or about a pinned point, that springs tie to particles and to anchors."""
    one = net(random, "length", damping=damped(random), most=10, least=7)
    rigid = [0, 2, 3, 4, 5] if random.random() < 0.4 else [2, 3, 4, 5]
    one.scene["bodies"] = [{"name": "body", "particles": rigid}]
    one.scene["anchors"] = [{"particles": [2, 5], "stiffness": round(0.05 * one.fastest**2, 2)}]
    if random.random() < 0.6:
        one.scene["gravity"] = [0, -9.81, 0]
    return one


# ---- parts ----


def rope(random: Random, **stretch: Any) -> Scene:
    segments, length, mass, stiffness = (
        random.randint(4, 24),
        among(random, 0.5, 3),
        among(random, 0.05, 1),
        among(random, 20, 2000),
    )
    fastest = 2 * math.sqrt(stiffness * segments / length / (mass / (segments + 1)))
    if ratio := damped(random):
        stretch["damping"] = float(f"{ratio * stiffness / fastest:.4g}")
    part = {"kind": "rope", "name": "rope", "from": [0, 0, 0], "to": [length, 0, 0], "segments": segments, "mass": mass,
            "stretch": {"stiffness": stiffness, **stretch}, "pinned": "start"}  # fmt: skip
    return Scene("rope", {"hooke": 1, "gravity": [0, -9.81, 0], "parts": [part]}, fastest, FEW_TURNS)


def pulling_rope(random: Random) -> Scene:
    return rope(random, compression=False)


def slack_rope(random: Random) -> Scene:
    one = rope(random, compression=False, rest_scale=round(random.uniform(1.02, 1.2), 3))
    one.scene["parts"][0]["pinned"] = ["start", "end"]
    one.scene["drag"] = random.choice([0, 0.2])
    return one


def taut_rope(random: Random) -> Scene:
    """Pinned at both ends and stretched: a string, which vibrates for many periods."""
    one = rope(random, rest_scale=round(random.uniform(0.6, 0.95), 3))
    one.scene["parts"][0]["pinned"] = ["start", "end"]
    one.turns = MANY_TURNS
    return one


def bending_rope(random: Random) -> Scene:
    one = rope(random)
    part = one.scene["parts"][0]
    spacing = part["to"][0] / part["segments"]
    part["bending"] = float(f"{0.02 * one.fastest**2 * part['mass'] / (part['segments'] + 1) * spacing**3:.4g}")
    part["pinned"] = [0, 1]
    one.fastest *= 1.2
    one.turns = MANY_TURNS
    return one


def driven_rope(random: Random) -> Scene:
    one = rope(random)
    one.scene["parts"][0]["pinned"] = []
    swing = {"amplitude": [0, round(random.uniform(0.02, 0.2), 3), 0.05], "frequency": among(random, 0.3, 4), "phase": 0.4}
    one.scene["driven"] = [{"particles": [["rope", 0]], "motion": "harmonic", **swing}]
    one.scene["drag"] = random.choice([0, 0.1])
    return one


def cloth(random: Random) -> Scene:
    size, stiffness, mass = [random.randint(3, 7), random.randint(3, 7)], among(random, 20, 1000), among(random, 0.05, 1)
    kappa, particle = stiffness * (max(size) - 1), mass / (size[0] * size[1])
    fastest = math.sqrt(10 * kappa / particle)
    structural: dict[str, Any] = {"stiffness": stiffness}
    if ratio := damped(random):
        structural["damping"] = float(f"{ratio * stiffness / fastest:.4g}")
    part = {"kind": "cloth", "name": "cloth", "edges": [[1, 0, 0], [0, 0, 1]], "size": size, "mass": mass, "pinned": "top-corners",
            "structural": structural, "shear": {"stiffness": round(stiffness / 4, 3)}}  # fmt: skip
    return Scene("cloth", {"hooke": 1, "gravity": [0, -9.81, 0], "parts": [part]}, fastest, FEW_TURNS)


def lattice(random: Random) -> Scene:
    size, stiffness = [random.randint(2, 3), random.randint(2, 3), random.randint(2, 4)], among(random, 100, 5000)
    mass = among(random, 0.2, 2)
    fastest = math.sqrt(14 * stiffness * 3 / (mass / math.prod(size)))
    part = {"kind": "lattice", "name": "block", "edges": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "size": size, "mass": mass,
            "pinned": "bottom", "structural": {"stiffness": stiffness}, "shear": {"stiffness": stiffness / 2}}  # fmt: skip
    return Scene("lattice", {"hooke": 1, "gravity": [0, -9.81, 0], "drag": random.choice([0, 0.5]), "parts": [part]}, fastest)


def strand(random: Random) -> Scene:
    """A curl with altitude springs, near its shape."""
    segments, mass, stiffness = random.randint(8, 20), among(random, 0.01, 0.1), among(random, 5, 50)
    families = {
        name: {"stiffness": round(stiffness * share, 3)}
        for name, share in (("stretch", 1), ("bend", 0.3), ("twist", 0.2), ("altitude", 0.1))
    }
    part = {"kind": "strand", "name": "curl", "from": [0, 0, 0], "to": [0, -0.5, 0], "segments": segments, "mass": mass, "curl": 0.05,
            "turns": round(segments / 8, 2), "pinned": [0, 1, 2], **families}  # fmt: skip
    fastest = math.sqrt(12 * stiffness * segments / 0.5 / (mass / segments))
    return Scene(
        "strand", {"hooke": 1, "gravity": [0, -1, 0], "drag": random.choice([0, 1e-3]), "parts": [part]}, fastest, FEW_TURNS
    )


# ---- small ones, for many periods ----


def oscillator(random: Random) -> Scene:
    mass, stiffness = among(random, 0.2, 5), among(random, 5, 500)
    spring: dict[str, Any] = {"between": [[0, 1]], "law": "length", "stiffness": stiffness, "rest_length": 1}
    fastest = math.sqrt(stiffness / mass)
    if ratio := damped(random):
        spring["damping"] = float(f"{2 * ratio * stiffness / fastest:.4g}")
    particles = {"position": [[0, 0, 0], [round(random.uniform(1.05, 1.5), 3), 0, 0]], "mass": mass, "pinned": [0]}
    scene = {"hooke": 1, "particles": particles, "springs": [spring]}
    if random.random() < 0.5:
        scene["gravity"] = [0, -0.5, 0]
    return Scene("oscillator", scene, fastest, MOST_TURNS)


def pendulum(random: Random) -> Scene:
    """On a stiff spring, which hardly swings itself."""
    mass, stiffness = among(random, 0.2, 5), among(random, 500, 50000)
    angle = random.uniform(0.2, 1.5)
    particles = {"position": [[0, 0, 0], [round(math.sin(angle), 6), round(-math.cos(angle), 6), 0]], "mass": mass, "pinned": [0]}
    spring = {"between": [[0, 1]], "law": "length", "stiffness": stiffness, "rest_length": 1}
    return Scene(
        "pendulum",
        {"hooke": 1, "gravity": [0, -9.81, 0], "particles": particles, "springs": [spring]},
        math.sqrt(stiffness / mass),
    )


def bouncer(random: Random) -> Scene:
    """A mass that falls on a stiff floor, a spring that only pushes: it only pulls, from above."""
    mass, stiffness = among(random, 0.2, 5), among(random, 200, 50000)
    particles = {"position": [[0, 10, 0], [0, round(random.uniform(0.1, 1), 3), 0]], "mass": mass, "pinned": [0]}
    spring = {"between": [[0, 1]], "law": "length", "stiffness": stiffness, "rest_length": 10, "compression": False,
              "damping": random.choice([0, 0.05]) * round(math.sqrt(stiffness * mass), 3)}  # fmt: skip
    fastest = math.sqrt(stiffness / mass)
    return Scene(
        "bouncer",
        {"hooke": 1, "gravity": [0, -9.81, 0], "particles": particles, "springs": [spring]},
        fastest,
        max(FEW_TURNS, 4 * fastest),
    )


def chain(random: Random) -> Scene:
    """Masses in a line between two walls."""
    count = random.randint(3, 10)
    places = [[i + (round(random.uniform(-0.1, 0.1), 3) if 0 < i < count - 1 else 0), 0, 0] for i in range(count)]
    stiffness, pairs = [among(random, 10, 100) for _ in range(count - 1)], [(i, i + 1) for i in range(count - 1)]
    masses = [among(random, 0.5, 2) for _ in range(count)]
    spring = {"between": pairs, "law": "length", "stiffness": stiffness, "rest_length": 1}
    scene = {"hooke": 1, "particles": {"position": places, "mass": masses, "pinned": [0, count - 1]}, "springs": [spring]}
    return Scene("chain", scene, rate_of(masses, pairs, stiffness))


KINDS = [strain_net, length_net, slack_net, dragged_net, stiff_net, heavy_net, anchored_net, table_net, overdamped_net, body_net, rope, pulling_rope,
         slack_rope, taut_rope, bending_rope, driven_rope, cloth, lattice, strand, oscillator, pendulum, bouncer, chain]  # fmt: skip


def scene_of(seed: int) -> Scene:
    """With its duration and its frames in `run`."""
    random = Random(f"scene {seed}")
    make = KINDS[seed % len(KINDS)]
    one = make(random)
    one.kind = make.__name__.replace("_", " ")
    turns = among(random, min(10, one.turns / 10), one.turns)
    frames = random.choice([5, 10, 20, 40, 250])
    every = float(f"{turns / one.fastest / frames:.3g}")
    one.scene["run"] = {"duration": frames * every, "every": every}
    return one


def methods_of(one: Scene) -> list[str]:
    if "dynamics" in one.scene:
        return FIRST_ORDER
    every = ["forward-euler", *EXPLICIT, *IMPLICIT, *TOLERANT]
    return [name for name in every if name != "shardlow" or "bodies" not in one.scene]


def step_of(random: Random, one: Scene, method: str) -> float:
    """[s] fits the frames; from coarse, often near the limit, to fine."""
    if method in IMPLICIT:
        turn = among(random, 0.02, 10)
    elif method == "forward-euler" and "dynamics" not in one.scene:
        turn = among(random, 0.001, 0.1)
    elif random.random() < 0.2:
        turn = random.uniform(1.5, 4 if method == "rk4" else 3)  # the fastest rate is a bound, and often half of it is true
    else:
        turn = among(random, 0.01, 1.5)
    every, duration = one.scene["run"]["every"], one.scene["run"]["duration"]
    return every / max(1, min(math.ceil(every * one.fastest / turn), int(MOST_STEPS * every / duration)))


def options_of(seed: int, one: Scene) -> list[str]:
    """The words of a run of that scene; one in nine leaves method and step to hooke."""
    random = Random(f"run {seed}")
    if seed % 9 == 0 and "dynamics" not in one.scene:
        return []
    method = random.choice(methods_of(one))
    if method in TOLERANT:
        rtol = among(random, 1e-9, 3e-2)
        atol = ["--atol", f"{rtol * among(random, 1e-3, 1):.3g}"] if random.random() < 0.5 else []
        return ["--method", method, "--rtol", repr(rtol), *atol]
    return ["--method", method, "--step", repr(step_of(random, one, method))]
