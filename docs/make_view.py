"""Makes docs/images/view-cloth.png: the page of `hooke view` for a cloth, as Chromium shows it.

    python docs/make_view.py build/release/hooke
"""

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

from PIL import Image  # comes with matplotlib

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs/images/view-cloth.png"
SCENE = ROOT / "examples/scenes/cloth-64.json"
FRAME = 32


def main(program):
    browser = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])))
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([program, "run", SCENE, "-o", folder / "cloth.h5", "--quiet"], check=True)
        subprocess.run([program, "view", folder / "cloth.h5", "-o", folder / "cloth.html"], check=True)
        subprocess.run([browser, "--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
                        "--hide-scrollbars", "--force-color-profile=srgb", f"--user-data-dir={folder}/profile",
                        "--window-size=1000,800", "--virtual-time-budget=4000", f"--screenshot={folder}/page.png",
                        f"file://{folder}/cloth.html#frame={FRAME}"], check=True, capture_output=True)
        page = Image.open(folder / "page.png").convert("RGB")
        page.convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(PICTURE, optimize=True)
    print(f"{PICTURE}: {PICTURE.stat().st_size} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
