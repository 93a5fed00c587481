"""Measured rows, as text and CSV."""

from __future__ import annotations

import csv
import math
import os
import platform
import subprocess
import sys
from datetime import datetime, timezone
from pathlib import Path
from typing import NamedTuple

NAN = math.nan


class Row(NamedTuple):
    scene: str
    peer: str
    version: str
    threads: int
    turns: int
    seconds_min: float  #: of a step, or of the whole run where there are tolerances [s]
    seconds_median: float
    springs: int = 0
    step: float = NAN  #: [s]
    rtol: float = NAN
    distance: float = NAN  #: to hooke, or to the reference [m]
    allowed: float = NAN  #: of it [m]

    def nanoseconds(self, seconds: float) -> float:
        """Time of a spring in a step."""
        return 1e9 * seconds / self.springs if self.springs else NAN


def machine() -> dict[str, str]:
    said = {}
    if Path("/proc/cpuinfo").exists():
        first = Path("/proc/cpuinfo").read_text().split("\n\n")[0]
        pairs = (line.partition(":") for line in first.splitlines())
        said = {key.strip(): value.strip() for key, _, value in pairs}
    name = said.get("model name", platform.machine())
    more = f", family {said['cpu family']} model {said['model']}" if "cpu family" in said else ""
    describe = ["git", "-C", str(Path(__file__).parent), "describe", "--always", "--dirty", "--exclude=*"]
    described = subprocess.run(describe, capture_output=True, text=True)
    return {
        "date": datetime.now(timezone.utc).strftime("%Y-%m-%dT%H:%M:%SZ"),
        "commit": described.stdout.strip() or "unknown",
        "cpu": name + more,
        "cores": str(os.cpu_count()),
        "python": platform.python_version(),
    }


class Printer:
    """Prints rows as they arrive: "text", "csv" or "markdown"."""

    TITLES = ("scene", "peer", "threads", "rtol", "ms min", "ms median", "ns min", "ns median", "against hooke",
              "distance m")
    WIDTHS = (23, 42, 8, 7, 10, 10, 8, 10, 14, 11)

    def __init__(self, form: str):
        self.form, self.machine = form, machine()
        self.writer = csv.writer(sys.stdout, lineterminator="\n")
        if form == "csv":
            self.writer.writerow([*self.machine, *Row._fields, "ns_min", "ns_median"])
            return
        print(f"{'- ' if form == 'markdown' else '# '}{self.machine['cpu']}, {self.machine['cores']} cores, commit "
              f"{self.machine['commit']}, Python {self.machine['python']}, {self.machine['date'][:10]}\n")
        self._cells(self.TITLES)
        if form == "markdown":
            self._cells(["---", "---", *["---:"] * (len(self.TITLES) - 2)])

    def show(self, rows: list[Row]) -> None:
        """Rows of one scene: all are compared with the first."""
        for row in rows:
            ns = [row.nanoseconds(s) for s in (row.seconds_min, row.seconds_median)]
            if self.form == "csv":
                words = ["" if isinstance(x, float) and math.isnan(x) else x for x in (*row, *ns)]
                self.writer.writerow([*self.machine.values(), *words])
            else:
                ratio = row.seconds_median / rows[0].seconds_median
                self._cells([
                    row.scene, f"{row.peer} {row.version}", row.threads, word(row.rtol, ".0e"),
                    word(1e3 * row.seconds_min), word(1e3 * row.seconds_median), word(ns[0], ".2f"), word(ns[1], ".2f"),
                    word(ratio, ".3g"), word(row.distance, ".1e"),
                ])
        sys.stdout.flush()

    def _cells(self, cells) -> None:
        if self.form == "markdown":
            print("| " + " | ".join(str(cell) for cell in cells) + " |")
        else:
            words = [str(cell) for cell in cells]
            print("".join(c.ljust(w) if k < 2 else c.rjust(w) for k, (c, w) in enumerate(zip(words, self.WIDTHS))))


def word(number: float, form: str = ".4g") -> str:
    return "-" if math.isnan(number) else format(number, form)
