"""Random scenes with every force that acts on particles, or on pieces of ropes and surfaces."""

import numpy as np

import hooke


def network(seed, count=100, dynamics="inertial"):
    draw = np.random.default_rng(seed)
    inertial = dynamics == "inertial"
    damped = {"damping": 0.01} if inertial else {}
    medium = {"drag": 0.03, "quadratic_drag": 0.01, "wind": (1, 0.5, 0)} if inertial else {"drag": 1.0}
    scene = hooke.Scene(gravity=(0.3, -9.81, 0.1), dynamics=dynamics, **medium)
    q = draw.uniform(0, 1, (count, 3)) * [3, 1, 1]
    held = np.isin(np.arange(count), [0, 5, 6, 7, 9, 11])[:, None]
    moving = {"velocity": np.where(held, 0, draw.uniform(-1, 1, (count, 3)))} if inertial else {}
    scene.particles(q, mass=draw.uniform(0.01, 0.03, count), pinned=[0, 7, 11], **moving)
    near = np.argwhere(np.triu(np.linalg.norm(q[:, None] - q[None], axis=2) < 0.35, 1))
    draw.shuffle(near)
    one, two, three = np.array_split(near, 3)
    each = {"damping": draw.uniform(0, 0.05, len(one))} if inertial else {}
    scene.springs("each", between=one, law="length", stiffness=draw.uniform(5, 40, len(one)), compression=False, **each)
    scene.springs("all", between=two[:, ::-1], stiffness=20, rest_scale=0.9, **damped)
    curve = {"elongation": [-0.1, 0, 0.1], "force": [-2, 0, 5]}
    scene.springs("curve", between=three, law="length", curve=curve, **damped)
    of_rope = {"fluid_drag": dict(diameter=0.01, density=2, normal=1.2, tangential=0.02)} if inertial else {}
    of_cloth = {"fluid_drag": dict(density=1, coefficient=2)} if inertial else {}
    scene.rope("rope", from_=(0, 1.2, 0), to=(3, 1.2, 0.2), segments=40, mass=0.3, pinned="start", clamped="start",
               stretch=dict(stiffness=80, **damped), bending=1e-3, **of_rope)
    scene.cloth("cloth", size=(8, 8), edges=((1, 0, 0), (0, 0.1, 1)), mass=0.2, pinned="top-corners",
                structural=dict(stiffness=100, **damped), bending=1e-4, **of_cloth)
    tied = [[k, ("rope", k)] for k in range(0, 40, 7)] + [[("cloth", k), 50 + k] for k in range(0, 64, 9)]
    scene.springs("tie", between=tied, stiffness=3, law="length", compression=False)
    scene.strand("hair", from_=(0, 0, 0), to=(0, -0.2, 0), segments=30, curl=0.02, turns=5, mass=0.02, pinned=[0, 1, 2],
                 stretch=dict(stiffness=100), bend=dict(stiffness=10), twist=dict(stiffness=5),
                 altitude=dict(stiffness=1, rest_scale=0.99))
    anchored = draw.choice(np.arange(20, count), 40, replace=False)
    scene.anchors("anchors", particles=anchored, stiffness=draw.uniform(1, 9, 40), points=draw.uniform(0, 1, (40, 3)))
    scene.loads(particles=[30, 40, 50], force=(0.1, 0, 0))
    scene.loads(particles=[31, 41], motion="harmonic", force=(0, 0.2, 0), frequency=5.0)
    scene.obstacles(shape="plane", point=(0, 0.1, 0), normal=(0, 1, 0), stiffness=100)
    scene.driven([5, 6], motion="harmonic", amplitude=(0, 0.1, 0.05), frequency=7)
    scene.driven([9], motion="table", time=[0, 0.01, 0.02], position=[[0, 0, 0], [0, 0.05, 0], [0.02, 0.05, 0]])
    return scene.run_defaults(method="symplectic-euler", step=2e-4, duration=0.02, every=0.004) or scene


def drape(size=8):
    """A cloth whose motion is smooth."""
    scene = hooke.Scene(gravity=(0, -9.81, 0)).cloth(
        size=(size, size), edges=((1, 0, 0), (0, 0, 1)), mass=0.3, pinned="top-corners",
        structural=dict(stiffness=50, damping=0.001), shear=dict(stiffness=20, damping=0.001))
    return scene.run_defaults(method="symplectic-euler", step=1e-3, duration=0.4, every=0.02) or scene
