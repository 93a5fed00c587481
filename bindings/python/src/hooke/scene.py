"""Scenes: JSON files that describe a system and how to run it."""

from __future__ import annotations

import ctypes
import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ._library import lib
from ._memory import Handle, text
from ._prototypes import SCENE
from .options import Options
from .system import System, write_scene

if TYPE_CHECKING:
    from .results import Result


class Scene:
    """A scene: its `system` and its `run_options`.

    The system is still open after loading, so that a force callback can be added; the first use commits it,
    with messages that give the place in the file.
    """

    def __init__(self, handle: Handle):
        self._handle = handle
        self._system = System._of_scene(handle)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Scene:
        """Reads a scene file. BadValue says what is wrong where; IOFailed if it cannot be read."""
        pointer = SCENE()
        lib.hooke_scene_load(os.fsencode(path), ctypes.byref(pointer))
        return cls(Handle(pointer, lib.hooke_scene_destroy))

    @classmethod
    def parse(
        cls,
        scene: str | bytes | Mapping,
        name: str = "scene",
        folder: None | str | os.PathLike[str] = None,
    ) -> Scene:
        """Reads a scene from its text, or from a dict of the same shape. `name` stands for the file in
        messages; files named in the scene are looked up in `folder` (None: none are allowed)."""
        if isinstance(scene, Mapping):
            scene = json.dumps(scene)
        data = scene.encode() if isinstance(scene, str) else bytes(scene)
        where = None if folder is None else os.fsencode(folder)
        pointer = SCENE()
        lib.hooke_scene_parse(data, len(data), name.encode(), where, ctypes.byref(pointer))
        return cls(Handle(pointer, lib.hooke_scene_destroy))

    @property
    def system(self) -> System:
        """Its system."""
        return self._system

    @property
    def run_options(self) -> Options:
        """The options of a run that the scene gives; they may be changed."""
        return Options(Handle(lib.hooke_scene_run_options(self._handle), None, self._handle))

    @property
    def title(self) -> str:
        """Its title, "" if it has none."""
        return text(lib.hooke_scene_title(self._handle))

    @property
    def text(self) -> str:
        """The JSON text that was read."""
        return text(lib.hooke_scene_text(self._handle))

    def run(self, **options: Any) -> Result:
        """Runs the scene; see `hooke.run`."""
        from .results import run

        return run(self, **options)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the scene as it is now, its system and `run_options`, as a scene file; see `System.save`."""
        write_scene(path, self._system, self.title, self.run_options)

    def __repr__(self) -> str:
        return f"Scene({self.title!r}, {self._system!r})"


def scene_text(scene: Scene | None) -> bytes | None:
    return None if scene is None else lib.hooke_scene_text(scene._handle)
