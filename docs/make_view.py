"""Makes docs/images/view-cloth.png: the page of `hooke view` for a cloth, as Chromium shows it.

    python docs/make_view.py build/release/hooke
"""

import subprocess
import sys
import tempfile
from pathlib import Path

from chromium import photograph

ROOT = Path(__file__).resolve().parents[1]
PICTURE = ROOT / "docs/images/view-cloth.png"
SCENE = ROOT / "examples/scenes/cloth-64.json"
FRAME = 32


def main(program):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        subprocess.run([program, "run", SCENE, "-o", folder / "cloth.h5", "--quiet"], check=True)
        subprocess.run([program, "view", folder / "cloth.h5", "-o", folder / "cloth.html"], check=True)
        photograph(folder / "cloth.html", f"frame={FRAME}", (1000, 800), PICTURE)
    print(f"{PICTURE}: {PICTURE.stat().st_size} bytes")


if __name__ == "__main__":
    main(Path(sys.argv[1]).resolve())
