"""Fills the tables of docs/notes/validation.md: python docs/make_validation.py [--check]

This takes a few seconds. With --check nothing is written; rows that differ are printed.
"""

from __future__ import annotations

import re
import sys
import warnings
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/notes/validation.md"
SCENES = ROOT / "examples/scenes"
MARK = re.compile(r"(<!-- table: (?P<name>\w+) -->\n).*?(<!-- end -->)", re.DOTALL)
NUMBER = re.compile(r"-?\d+\.?\d*(?:e[-+]\d+)?")
ROUNDING = 1e-12  # smaller numbers are rounding

sys.path.append(str(ROOT / "build/release/python"))

import hooke  # noqa: E402


def numbers(name: str) -> list[float]:
    """The numbers of one block of a file in tests/data."""
    return [float(word) for word in NUMBER.findall(name)]


def orders() -> list[list[str]]:
    """Largest error of a coordinate of six particles at 1 s, against numbers computed without this library."""
    text = (ROOT / "tests/data/six_particles.inc").read_text("utf-8")
    state = text.split(".time = 1.0,")[1]
    exact = np.array(numbers(re.search(r"\.position = \(const double\[\]\)\{(.*?)\}", state, re.DOTALL)[1])).reshape(-1, 3)
    known = (ROOT / "tests/data/fixed_step_errors.inc").read_text("utf-8")
    rows = [["method", *(f"h = 1/{50 << k} s" for k in range(5)), "order of the last two", "the same, computed elsewhere"]]
    word = r'(?:NULL|"([\w-]+)")'
    row = rf'\{{"([\w-]+)", {word}, {word}, \S+, \{{(.*?)\}}\}}'
    for method, newton, damping, published in re.findall(row, known):
        options = {"newton": newton} if newton else {"verlet_damping": damping} if damping else {}
        error = [np.abs(hooke.run(SCENES / "six-particles.json", method=method, step=1 / (50 << k), duration=1, every=1,
                                  **options).state.q - exact).max() for k in range(5)]
        rows.append([f"`{method}`{f', `{newton or damping}`' if newton or damping else ''}", *(f"{e:.3e}" for e in error),
                     f"{np.log2(error[3] / error[4]):.2f}", f"{numbers(published)[4]:.3e}"])
    return rows


def contacts() -> list[list[str]]:
    """Orders over contacts: 13 particles bounce once on a floor of 1000 N/m, without damping and with it."""
    orders = []
    for damping in (0, 10):
        scene = hooke.Scene(gravity=(0, -9.8, 0)).rope(from_=(0, 0.2, 0), to=(1, 0.4, 0), segments=12, mass=13)
        scene.obstacles(shape="plane", point=(0, 0, 0), normal=(0, 1, 0), stiffness=1000, damping=damping)
        study = hooke.study(scene, steps=[0.004, 0.002, 0.001, 0.0005], duration=0.4, every=0.2)
        orders.append({method: f"{found.order:.2f}" for method, found in study.orders.items()})
    rows = [["method", "order of the method", "floor without damping", "floor of 10 N s/m"]]
    for method, found in study.orders.items():
        rows.append([f"`{method}`", f"{found.theory:g}", *(order[method] for order in orders)])
    return rows


def limits() -> list[list[str]]:
    rows = [["scene", "method", "predicted [s]", "measured [s]", "measured / predicted"]]
    for scene in ("oscillator", "stiff-spring", "cloth-gentle"):
        for row in hooke.limit(SCENES / f"{scene}.json", methods=["symplectic-euler", "verlet", "rk4"]).rows:
            rows.append([f"`{scene}`", f"`{row['method']}`", f"{row['predicted']:.4g}", f"{row['measured']:.4g}",
                         f"{row['ratio']:.4f}"])
    return rows


def conservation() -> list[list[str]]:
    """Changes of momentum and energy of a freely turning cloth in one second, relative to the start."""
    rows = [["method", "momentum", "angular momentum", "energy"]]
    for method in ("symplectic-euler", "verlet", "rk4", "backward-euler", "cvode-adams"):
        system = hooke.System()
        system.add_part("cloth", origin=[0, 0, 0], edges=[[1, 0, 0], [0, 0, 1]], size=[8, 8], mass=1,
                        structural={"stiffness": 100}, shear={"stiffness": 100})
        state = system.state()
        state.v = [1, 2, 3] + np.cross([0, 3, 0], state.q - state.q.mean(axis=0))
        before = conserved(system, state)
        hooke.Integrator(system, method=method, step=1e-3, duration=1).run(state)
        after = conserved(system, state)
        change = [np.linalg.norm(b - a) / np.linalg.norm(a) for a, b in zip(before, after)]
        rows.append([f"`{method}`", *(f"{one:.1e}" for one in change)])
    return rows


def conserved(system: hooke.System, state: hooke.State) -> list[np.ndarray]:
    return [system.momentum(state.v), system.angular_momentum(state.q, state.v),
            np.array([system.energy(state.q, state.v)])]


def bending() -> list[list[str]]:
    """Deflection of the tip of a beam of 1 m under its weight, against w L^4/(8 B)."""
    rows = [["pieces", "tip sinks by [m]", "w L^4/(8 B) [m]", "ratio"]]
    density, stiffness = 0.1, 0.1 * 9.81 / (8 * 1e-3)
    for pieces in (8, 16, 32):
        length = 1 / (pieces - 0.5)
        system = hooke.System()
        system.add_part("rope", from_=[-length / 2, 0, 0], to=[1, 0, 0], segments=pieces, density=density, pinned=[0, 1],
                        bending=stiffness, stretch={"stiffness": 100.0})
        system.set_gravity([0, -9.81, 0])
        system.set_drag(5.0)
        tip = -hooke.run(system, method="backward-euler", step=0.1, duration=20).state.q[-1, 1]  # damps to rest
        rows.append([str(pieces), f"{tip:.4e}", "1.0000e-03", f"{tip / 1e-3:.4f}"])
    return rows


TABLES = {"orders": orders, "contacts": contacts, "limits": limits, "conservation": conservation, "bending": bending}


def table(rows: list[list[str]]) -> str:
    return "\n".join("| " + " | ".join(row) + " |" for row in [rows[0], ["---"] * len(rows[0]), *rows[1:]]) + "\n"


def made() -> str:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", hooke.StepWarning)
        tables = {name: table(make()) for name, make in TABLES.items()}
    return MARK.sub(lambda match: match[1] + tables[match["name"]] + match[3], PAGE.read_text("utf-8"))


def agree(a: str, b: str) -> bool:
    """Whether two lines agree: numbers to one per cent, or both below rounding."""
    if NUMBER.sub("", a) != NUMBER.sub("", b):
        return False
    pairs = zip(numbers(a), numbers(b))
    return all(abs(x - y) <= 0.01 * max(abs(x), abs(y)) or max(abs(x), abs(y)) <= ROUNDING for x, y in pairs)


def differences(page: str, other: str) -> list[str]:
    one, two = page.splitlines(), other.splitlines()
    if len(one) != len(two):
        return ["a table has other rows"]
    return [f"the page has {a}\nmeasured is  {b}" for a, b in zip(one, two) if not agree(a, b)]


if __name__ == "__main__":
    text = made()
    if "--check" in sys.argv:
        found = differences(PAGE.read_text("utf-8"), text)
        print(*found, sep="\n")
        sys.exit(1 if found else 0)
    PAGE.write_text(text, "utf-8")
