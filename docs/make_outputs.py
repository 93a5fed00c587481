"""Writes the outputs in README.md and docs/ as hooke prints them: python docs/make_outputs.py BUILD [WORD]

BUILD is a build with the Python package, build/release say; only documents with WORD in their names are read. What the
test of the documents takes as equal stays as it is, times too. Lines that hooke does not print any more are named, for
a person to change.
"""

from __future__ import annotations

import os
import shutil
import sys
import tempfile
from pathlib import Path
from typing import Any

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT / "tests/documents"))
import blocks  # noqa: E402
import outputs  # noqa: E402


def merged(shown: str, words: list[Any], match: Any) -> str:
    """The printed lines, but for those that agree."""
    first = shown.rfind("\n", 0, words[0][0]) + 1
    old, new = shown[first:words[-1][1]].splitlines(), match[0].rstrip().splitlines()
    if len(old) != len(new):
        return "\n".join(new)
    pairs = [(word, printed) for word, printed in zip([word for word in words if word[2]], match.groups())]
    differs = {shown.count("\n", first, a) for (a, b, kind), printed in pairs if not outputs.is_close(shown[a:b], printed, kind)}
    return "\n".join(new[k] if k in differs else old[k] for k in range(len(old)))


def renewed(shown: str, printed: str, where: Any) -> str:
    for words, match, agrees in reversed(outputs.places(shown, printed)):
        first, last = words[0][0], words[-1][1]
        line = shown.rfind("\n", 0, first) + 1
        if match is None:
            print(f"{where}: hooke does not print\n{shown[line:last]}")
        elif not agrees:
            shown = shown[:line] + merged(shown, words, match) + shown[last:]
    return shown


def renew(document: Path, folder: Path) -> None:
    text = document.read_text("utf-8")
    for block in blocks.blocks(document.name, text):
        if block.kind not in ("console", "sh", "python"):
            continue
        if block.kind == "python":
            blocks.complaint(block, folder)
            continue
        old, new = block.text, block.text
        for command, _, shown in blocks.conversations(old):
            done = blocks.run_command(command, folder)
            printed = done.stdout + done.stderr
            if shown.strip() and not outputs.same(shown, printed):
                new = new.replace(shown, renewed(shown, printed, f"{block}: {command}"), 1)
        text = text.replace(old, new, 1)
    document.write_text(text, "utf-8")


def main(build: Path, word: str = "") -> None:
    os.environ["HOOKE_CLI"] = str(build.resolve() / "hooke")
    sys.path.insert(0, str(build.resolve() / "python"))
    for document in [ROOT / "README.md", *sorted((ROOT / "docs").rglob("*.md"))]:
        if word in document.name:
            with tempfile.TemporaryDirectory() as folder:
                for scenes in ("examples/scenes", "tests/cli/scenes/needs"):
                    shutil.copytree(ROOT / scenes, Path(folder, scenes))
                renew(document, Path(folder))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]), *sys.argv[2:])
