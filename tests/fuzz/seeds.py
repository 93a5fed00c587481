"""Initial inputs: every scene of the repository unchanged and reduced, keeping its faults; meshes. A scene that is
too large for an input is truncated, which adds a faulty one. `run.py --minimise` keeps those with more coverage than
the others."""

import json
import pathlib

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCENES = ["examples/scenes", "tests/cli/scenes"]
LONGEST = 4096


def smaller(value):
    """The same scene with fewer particles, if it can be read."""
    if isinstance(value, dict):
        few = {"segments": 5, "size": [4, 3, 3]}
        return {k: few[k][: len(v)] if k == "size" and isinstance(v, list) else few[k]
                if k == "segments" and isinstance(v, int) else smaller(v) for k, v in value.items()}
    return [smaller(v) for v in value] if isinstance(value, list) else value


def make(folder):
    """Writes folder/<target>/<name>."""
    for kind in "scene", "obj":
        (folder / kind).mkdir(parents=True, exist_ok=True)
    paths = [p for place in SCENES for p in sorted((ROOT / place).rglob("*.json"))]
    for path in paths:
        text = path.read_bytes()
        name = f"{path.parent.name}-{path.stem}"
        (folder / "scene" / name).write_bytes(text[:LONGEST])
        try:
            small = json.dumps(smaller(json.loads(text)), separators=(",", ":"), allow_nan=False).encode()
        except ValueError:
            continue
        (folder / "scene" / f"{name}-small").write_bytes(small[:LONGEST])
    for path in sorted((ROOT / "examples/scenes").glob("*.obj")):
        (folder / "obj" / path.stem).write_bytes(b"\0\0" + path.read_bytes())
