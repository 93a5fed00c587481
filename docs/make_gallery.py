"""Makes the pictures of docs/gallery.md with their list there, and the picture blow-up of README.md:
python docs/make_gallery.py [NAME ...]

It takes about a minute. Scenes of the table that are not in examples/scenes are left out.
"""

from __future__ import annotations

import re
import sys
import tempfile
import warnings
from pathlib import Path
from typing import Any, Callable, NamedTuple

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from chromium import photograph
from matplotlib.collections import LineCollection

import hooke

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/gallery.md"
MARK = re.compile(r"(<!-- pictures -->\n).*?(<!-- end -->)", re.DOTALL)
COLOURS = plt.get_cmap("viridis")


class Picture(NamedTuple):
    scene: str  # in examples/scenes
    draw: float | Callable[[hooke.Result, Any], Any]  # the fraction of the duration at which the viewer shows it, or a diagram
    words: str  # text in place of the picture


def at(result: hooke.Result, count: int) -> np.ndarray:
    """Evenly spaced frames, including the first and the last."""
    return np.linspace(0, len(result.frames.t) - 1, count).round().astype(int)


def strain(result: hooke.Result, q: np.ndarray) -> np.ndarray:
    """Strain of every spring; 0 where its rest length is 0."""
    ends, rest = result.system.spring_ends, result.system.spring_material.rest_length
    length = np.linalg.norm(q[ends[:, 0]] - q[ends[:, 1]], axis=1)
    return np.divide(length - rest, rest, out=np.zeros_like(rest), where=rest > 0)


def side(result: hooke.Result, figure: Any, across: int = 0) -> None:
    """Draws side views at several times on top of each other."""
    ax = figure.add_subplot()
    for share, frame in zip(np.linspace(0, 0.9, 6), at(result, 6)):
        segments = result.frames.q[frame][:, (across, 1)][result.system.spring_ends]
        ax.add_collection(LineCollection(segments, colors=[COLOURS(share)], linewidths=1.2,
                                         label=f"{result.frames.t[frame]:.3g} s"))
    ax.autoscale_view()
    ax.set(xlabel=f"{'xyz'[across]} [m]", ylabel="y [m]", aspect="equal")
    ax.legend(fontsize="small", loc="center left", bbox_to_anchor=(1, 0.5))


def apart(result: hooke.Result, figure: Any) -> None:
    """Draws x and y at the end, on axes with different scales."""
    ax = figure.add_subplot()
    q = result.frames.q[-1]
    ax.add_collection(LineCollection(q[:, :2][result.system.spring_ends], colors="tab:blue", linewidths=1))
    ax.plot(q[:, 0], q[:, 1], ".", color="tab:red", markersize=3)
    ax.set(xlabel="x [m]", ylabel="y [m]", title=f"t = {result.frames.t[-1]:.3g} s")


def from_the_edge(result: hooke.Result, figure: Any) -> None:
    side(result, figure, across=2)


def beam(result: hooke.Result, figure: Any) -> None:
    side(result, figure)
    figure.axes[0].set(aspect="auto")


def lengths(result: hooke.Result, ax: Any) -> None:
    for (a, b), (name, _) in zip(result.system.spring_ends, result.system.groups):
        ax.plot(result.frames.t, np.linalg.norm(result.frames.q[:, a] - result.frames.q[:, b], axis=1), label=name)
    ax.set(ylabel="length [m]")
    ax.legend(fontsize="small")


def oscillation(result: hooke.Result, figure: Any) -> None:
    """Draws the length of a spring and the energy over time."""
    length, energy = figure.subplots(2, sharex=True)
    lengths(result, length)
    energy.plot(result.frames.t, [result.system.energy(*pair) for pair in zip(result.frames.q, result.frames.v)], color="0.3")
    energy.set(xlabel="t [s]", ylabel="energy [J]")


def fall(result: hooke.Result, figure: Any) -> None:
    """Draws the lengths of springs over their heights."""
    length, height = figure.subplots(2, sharex=True)
    lengths(result, length)
    for a, _ in result.system.spring_ends:
        height.plot(result.frames.t, result.frames.q[:, a, 1])
    height.set(xlabel="t [s]", ylabel="y [m]")


def blow_up() -> None:
    """Draws a cloth from the front, just before it diverges and at the same time with a step below the limit."""
    figure, axes = plt.subplots(1, 2, figsize=(8, 4), layout="constrained", sharey=True)
    time = np.inf
    for ax, step, words in zip(axes, (5e-3, 4e-3), ("above", "below")):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", hooke.StepWarning)
            result = hooke.run(ROOT / "examples/scenes/cloth-gentle.json", step=step, every=step, duration=0.4, frames=True)
        time = min(time, result.frames.t[-1])
        frame = np.searchsorted(result.frames.t, time + step / 2) - 1
        q = result.frames.q[frame]
        lines = LineCollection(q[:, :2][result.system.spring_ends], cmap="coolwarm", norm=plt.Normalize(-25, 25), linewidths=1.5)
        lines.set_array(100 * strain(result, q))
        ax.add_collection(lines)
        ax.autoscale_view()
        ax.set(xlabel="x [m]", aspect="equal",
               title=f"step {1e3 * step:g} ms, {words} the limit: {result.status}\nt = {result.frames.t[frame]:.3g} s")
    axes[0].set(ylabel="y [m]")
    figure.colorbar(lines, ax=axes, label="strain [%]")
    figure.savefig(ROOT / "docs/images/blow-up.png", dpi=80)
    plt.close(figure)


PICTURES = [
    Picture("rope", side, "A rope at six times, from horizontal to swinging past the vertical."),
    Picture("cloth-16", 0.5, "A sagging cloth, pinned at two corners."),
    Picture("cloth-damped", from_the_edge, "A heavily damped cloth, pinned at its upper edge, from its side at six times."),
    Picture("cloth-gentle", 0.5, "A soft cloth, pinned at its upper edge, in the middle of its swing."),
    Picture("oscillator", oscillation, "The length of a spring, a dying oscillation, and the energy, which falls."),
    Picture("rope-resolution", apart, "Eight hanging bands: four of equal length, four of growing length."),
    Picture("drag-or-damping", fall, "The lengths of two springs that fall, and how high they are."),
    Picture("cantilever", beam, "A beam that bends under its own weight, at six times."),
    Picture("curl", 1, "A hanging curl."),
    Picture("lattice", 1, "A block that hangs from one end."),
    Picture("buoy", 0.6, "A buoy on three slack lines; four springs that end in driven points lift it."),
    Picture("tissue", 1, "A sheet of cells."),
    Picture("mesh", 1, "A ball that hangs from its highest point."),
]


def make(picture: Picture) -> None:
    scene, image = ROOT / f"examples/scenes/{picture.scene}.json", ROOT / f"docs/images/gallery-{picture.scene}.png"
    if callable(picture.draw):
        figure = plt.figure(figsize=(6, 4), layout="constrained")
        picture.draw(hooke.run(scene, frames=True), figure)
        figure.savefig(image, dpi=90)
        plt.close(figure)
        return
    with tempfile.TemporaryDirectory() as folder:
        hooke.run(scene, output=Path(folder, "out.h5"))
        page, last = hooke.view(Path(folder, "out.h5")), len(hooke.open(Path(folder, "out.h5")).t) - 1
        photograph(page, f"frame={round(picture.draw * last)}&bare", (540, 400), image)


def entry(picture: Picture) -> str:
    scene = hooke.Scene.load(ROOT / f"examples/scenes/{picture.scene}.json")
    title = scene.title[0].upper() + scene.title[1:]
    return (f"## {picture.scene}\n\n{title}: [`{picture.scene}.json`](../examples/scenes/{picture.scene}.json).\n\n"
            f"![{picture.words}](images/gallery-{picture.scene}.png)\n\n")


def main(names: list[str]) -> None:
    there = [picture for picture in PICTURES if (ROOT / f"examples/scenes/{picture.scene}.json").exists()]
    for picture in there:
        if not names or picture.scene in names:
            make(picture)
    if not names or "blow-up" in names:
        blow_up()
    text = "\n" + "".join(map(entry, there))
    PAGE.write_text(MARK.sub(lambda match: match[1] + text + match[2], PAGE.read_text("utf-8")), "utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
