"""Pictures of pages of `hooke view` as Chromium shows them."""

import shutil
import subprocess
import tempfile
from pathlib import Path

from PIL import Image  # comes with matplotlib

SHOWN = ["--headless", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
         "--force-color-profile=srgb", "--virtual-time-budget=4000"]  # fmt: skip


def photograph(page: Path, fragment: str, size: tuple[int, int], picture: Path) -> None:
    """Writes `page#fragment` in a window of `size` [pixels] as a PNG of at most 128 colours."""
    browser = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])))
    with tempfile.TemporaryDirectory() as name:
        shot = Path(name, "page.png")
        window = f"--window-size={size[0]},{size[1]}"
        subprocess.run([browser, *SHOWN, f"--user-data-dir={name}/profile", window, f"--screenshot={shot}",
                        f"file://{page}#{fragment}"], check=True, capture_output=True)  # fmt: skip
        Image.open(shot).convert("RGB").convert("P", palette=Image.Palette.ADAPTIVE, colors=128).save(picture, optimize=True)
