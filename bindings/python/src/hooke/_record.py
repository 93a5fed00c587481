"""Trajectory files, as the library reads them."""

from __future__ import annotations

import ctypes
import os

import numpy as np

from ._library import lib
from ._memory import Handle, double_pointer
from ._prototypes import RECORD
from ._types import FloatArray, Path
from .options import Options


def opened(path: Path) -> Handle:
    """A file, which closes with its last user."""
    return Handle.made(RECORD, lib.hooke_record_close, None, lib.hooke_record_open, os.fsencode(path))


def run_options(record: Handle) -> Options:
    """The options of its run, with defaults filled in."""
    return Options(Handle(lib.hooke_record_options(record), None, record), read_only=True)


def numbers(record: Handle, what: str) -> FloatArray:
    """A whole array of the file (rows,), or (rows, columns) if it has several columns."""
    rows, columns, name = ctypes.c_int64(), ctypes.c_int64(), what.encode()
    lib.hooke_record_size(record, name, ctypes.byref(rows), ctypes.byref(columns))
    found = np.empty((rows.value, columns.value))
    lib.hooke_record_numbers(record, name, double_pointer(found))
    return found[:, 0] if columns.value == 1 else found
