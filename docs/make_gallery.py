"""Makes the pictures of docs/gallery.md, by the viewer, and the list there: python docs/make_gallery.py [NAME ...]

It takes about a minute. Scenes of the table that are not in examples/scenes are left out.
"""

from __future__ import annotations

import re
import sys
import tempfile
from pathlib import Path
from typing import NamedTuple

from chromium import photograph

import hooke

ROOT = Path(__file__).resolve().parents[1]
PAGE = ROOT / "docs/gallery.md"
MARK = re.compile(r"(<!-- pictures -->\n).*?(<!-- end -->)", re.DOTALL)


class Picture(NamedTuple):
    scene: str  # in examples/scenes
    share: float  # of the duration, at which the viewer shows it
    words: str  # text in place of the picture
    duration: float | None = None  # [s], of the run if it is not the scene's


PICTURES = [
    Picture("rope", 0.2, "A rope that swings down."),
    Picture("cloth-16", 0.5, "A sagging cloth, pinned at two corners."),
    Picture("cloth-64", 0.5, "A fine cloth that sags between two corners."),
    Picture("three-cloths", 1, "Three cloths side by side; the squares of the left one are skewed."),
    Picture("cloth-damped", 0.5, "A heavily damped cloth, pinned at its upper edge."),
    Picture("cloth-gentle", 0.5, "A soft cloth, pinned at its upper edge, in the middle of its swing."),
    Picture("cloth-stiff", 0.5, "A stiff cloth, pinned at its upper edge."),
    Picture("oscillator", 0.1, "A stretched spring between two particles."),
    Picture("six-particles", 0.3, "Six particles that are all joined."),
    Picture("stiff-spring", 0.5, "A chain of eight particles."),
    Picture("rope-resolution", 1, "Eight hanging bands: four of equal length, four of growing length."),
    Picture("drag-or-damping", 0.5, "Two springs that fall.", 0.3),
    Picture("cantilever", 1, "A beam that bends under its own weight."),
    Picture("curl", 1, "A hanging curl."),
    Picture("lattice", 1, "A block that hangs from one end."),
    Picture("buoy", 0.6, "A buoy on three slack lines; four springs that end in driven points lift it."),
    Picture("ball-under-cloth", 1, "A cloth that hangs over a ball."),
    Picture("mooring", 1, "A line that rises from the sea bed."),
    Picture("flag", 0.6, "A flag in the wind, held at its left edge."),
    Picture("crane", 0.6, "A crane with a crate on its rope, above the ground."),
    Picture("tissue", 1, "A sheet of cells."),
    Picture("mesh", 1, "A ball that hangs from its highest point."),
]


def make(picture: Picture) -> None:
    scene, image = ROOT / f"examples/scenes/{picture.scene}.json", ROOT / f"docs/images/gallery-{picture.scene}.png"
    with tempfile.TemporaryDirectory() as folder:
        options = {"duration": picture.duration, "every": picture.duration / 10} if picture.duration else {}
        hooke.run(scene, output=Path(folder, "out.h5"), **options)
        page, last = hooke.view(Path(folder, "out.h5")), len(hooke.open(Path(folder, "out.h5")).t) - 1
        photograph(page, f"frame={round(picture.share * last)}&bare", (540, 400), image)


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
    text = "\n" + "".join(map(entry, there))
    PAGE.write_text(MARK.sub(lambda match: match[1] + text + match[2], PAGE.read_text("utf-8")), "utf-8")


if __name__ == "__main__":
    main(sys.argv[1:])
