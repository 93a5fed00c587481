"""Compares all methods on a cloth and draws what came out.

    python demo.py HOOKE FOLDER

HOOKE is the program; FOLDER receives cloth-16.h5 (every run, the table, the error over time) and cloth-16.png. Within its
second the farthest particle is centimetres off by forward and backward Euler at their step, half a millimetre by verlet, and
micrometres or less by rk4 and CVODE.
"""

import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import h5py
import matplotlib.pyplot as plt
from matplotlib.ticker import MaxNLocator

import hooke.plot

SIZE = 16  # particles along an edge
SCENE = Path(__file__).resolve().parent / "scenes" / "cloth-16.json"
COLOURS = {
    "forward-euler": "tab:red",
    "symplectic-euler": "tab:orange",
    "verlet": "tab:purple",
    "rk4": "tab:brown",
    "backward-euler": "tab:pink",
    "tr-bdf2": "tab:olive",
    "implicit-midpoint": "tab:cyan",
    "cvode-bdf": "tab:blue",
    "cvode-adams": "tab:green",
}
MARKERS = dict(zip(COLOURS, "osvPX<>^D"))
DRAWN = "forward-euler"  # beside the reference


def weave_of(file, run):
    """Positions at the end of a run and the springs between neighbours; shear and bend would hide the picture."""
    springs = file["connectivity/springs"][:]
    apart = springs[:, 1] - springs[:, 0]
    return file[f"particles/{run}/position/value"][-1], springs[(apart == 1) | (apart == SIZE)]


def draw(path, picture):
    figure = plt.figure(figsize=(13, 5.5), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.25)
    with h5py.File(path) as file:
        reference = file["study/reference"].attrs["method"]
        space = figure.add_subplot(1, 2, 1, projection="3d")
        for run, label, colour in [("all", f"reference ({reference})", "0.25"), (DRAWN, DRAWN, COLOURS[DRAWN])]:
            reached = file[f"particles/{run}/position/time"][-1]
            label = f"{label}, t = {reached:g} s"
            hooke.plot.cloth(weave_of(file, run), space, color=colour, linewidth=0.9, label=label)
    space.set(title="The cloth at the end", xlabel="z [m]", ylabel="x [m]", zlabel="y [m]")
    space.zaxis.set_major_locator(MaxNLocator(3))
    space.view_init(elev=35, azim=-55)
    space.legend(loc="upper left")

    plane = figure.add_subplot(1, 2, 2)
    hooke.plot.error(path, plane)
    for line in plane.get_lines():
        method = line.get_label()
        line.set(color=COLOURS.get(method, "0.5"), marker=MARKERS.get(method, "x"), markersize=5)
        line.set_markevery(max(1, len(line.get_xdata()) // 12))
    plane.set_title(f"Root mean square distance to the reference ({reference})")
    plane.grid(alpha=0.3)
    plane.legend(loc="lower right")

    figure.savefig(picture, dpi=150)
    plt.close(figure)


def farthest(path):
    """By how much the farthest particle is off at any frame, by each method at its step or tolerance, the best one first."""
    with h5py.File(path) as file:
        table = file["study"]
        errors = dict(zip(table["method"].asstr()[:], table["error_max"][:]))
    order = sorted((error, method) for method, error in errors.items() if error == error)
    return "off by at most: " + ", ".join(f"{method} {1e3 * error:.2g} mm" for error, method in order)


def main(program, folder):
    folder = Path(folder)
    folder.mkdir(parents=True, exist_ok=True)
    data, picture = folder / "cloth-16.h5", folder / "cloth-16.png"
    done = subprocess.run([program, "compare", SCENE, "-o", data])
    if done.returncode != 0:
        return done.returncode
    draw(data, picture)
    print(f"{farthest(data)}\npicture: {picture}")
    return 0


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    sys.exit(main(*sys.argv[1:]))
