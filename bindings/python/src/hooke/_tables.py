"""Rows that the library tells number by number, as one structured array."""

from __future__ import annotations

from typing import Any, Callable

import numpy as np

from ._memory import text
from ._types import Table


def read_rows(
    handle: Any, count: int, dtype: np.dtype, text_of: Callable[..., Any], number_of: Callable[..., Any]
) -> Table:
    """`count` rows, read-only: fields of text from ``text_of(handle, row, name)``, the others from `number_of`."""
    rows = np.empty(count, dtype)
    for name in dtype.names or ():
        column = rows[name]
        for row in range(count):
            if column.dtype.kind == "U":
                column[row] = text(text_of(handle, row, name.encode()))
            else:
                column[row] = number_of(handle, row, name.encode())
    rows.flags.writeable = False
    return rows
