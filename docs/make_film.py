"""Makes docs/images/blow-up.gif, the moving picture of README.md: one cloth by two steps, as the pages of `hooke view`
show it in Chromium, frame by frame. In two minutes: python docs/make_film.py build/release/hooke
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import matplotlib
from chromium import photograph
from PIL import Image, ImageDraw, ImageFont

ROOT = Path(__file__).resolve().parents[1]
FILM = ROOT / "docs/images/blow-up.gif"
SCENE = ROOT / "examples/scenes/cloth-16.json"
EVERY, SHOWN = 9.5e-4, [*range(0, 66, 6), *range(68, 98)]  # [s], frames
RUNS = {"a step of 0.95 ms, above the limit": EVERY, "a step of 0.475 ms, below the limit": EVERY / 2}
WINDOW, SIZE, HEAD = (720, 450), (432, 270), 30
FONT = ImageFont.truetype(str(Path(matplotlib.get_data_path(), "fonts/ttf/DejaVuSans.ttf")), 16)


def shoot(program: Path, folder: Path, step: float) -> list[Image.Image]:
    """The frames of the run with this step, each photographed."""
    name = f"{step:g}"
    run = ["--step", f"{step:.17g}", "--every", f"{EVERY:.17g}", "--duration", "0.1", "--past-divergence", "--no-why", "--quiet"]
    subprocess.run([program, "run", SCENE, *run, "-o", folder / f"{name}.h5"], capture_output=True)  # one diverges
    page = folder / f"{name}.html"
    subprocess.run([program, "view", folder / f"{name}.h5", "-o", page], check=True, capture_output=True)
    with ThreadPoolExecutor(2) as pool:
        pictures = [(folder / f"{name}-{k}.png", k) for k in SHOWN]
        list(pool.map(lambda one: photograph(page, f"frame={one[1]}&bare", WINDOW, one[0]), pictures))
    return [Image.open(picture).convert("RGB").resize(SIZE, Image.Resampling.LANCZOS) for picture, _ in pictures]


def joined(sides: tuple[Image.Image, ...], time: float) -> Image.Image:
    whole = Image.new("RGB", (len(sides) * SIZE[0], SIZE[1] + HEAD), "white")
    pen = ImageDraw.Draw(whole)
    for k, (side, words) in enumerate(zip(sides, RUNS)):
        whole.paste(side, (k * SIZE[0], HEAD))
        pen.text((k * SIZE[0] + 12, 6), words, "black", FONT)
    pen.text((whole.width - 12, whole.height - 10), f"t = {time:.3f} s", "black", FONT, anchor="rs")
    return whole


def main(program: Path) -> None:
    with tempfile.TemporaryDirectory() as name:
        sides = [shoot(program, Path(name), step) for step in RUNS.values()]
    frames = [joined(pair, k * EVERY) for k, pair in zip(SHOWN, zip(*sides))]
    frames = [frame.quantize(96, dither=Image.Dither.NONE) for frame in frames]
    pauses = [140] * (len(frames) - 1) + [1500]  # [ms]
    frames[0].save(FILM, save_all=True, append_images=frames[1:], duration=pauses, loop=0, optimize=True)
    print(f"{FILM}: {FILM.stat().st_size} bytes, {len(frames)} frames")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
