"""Names for the types that several modules of the package use."""

from __future__ import annotations

import os
from collections.abc import Sequence
from typing import Any, Union

import numpy as np
import numpy.typing as npt

Path = Union[str, os.PathLike[str]]
Numbers = npt.ArrayLike
FloatArray = npt.NDArray[np.float64]
IntArray = npt.NDArray[np.int64]
ComplexArray = npt.NDArray[np.complex128]
#: Structured rows, or numbers of more than one kind.
Table = npt.NDArray[Any]
#: Pinned particles of a part: numbers within it, words such as "top-corners", or both.
Pins = Union[str, int, Sequence[Union[str, int]], Table]
#: A particle of a scene: its number, or the name of a part and the number within it.
Particle = Union[int, tuple[str, int], list[Any]]
