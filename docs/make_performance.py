"""Fills the tables of docs/notes/performance.md:

    python docs/make_performance.py BUILD [--seconds S] [--threads N,...] [--no-peers]

BUILD is a build folder with the programs of bench/, such as build/release. The peers have to be in build/peers, where
bench/peers/run.py --install puts them. This takes half an hour, on a machine that does nothing else.
"""

from __future__ import annotations

import argparse
import re
import subprocess
import sys
from pathlib import Path

PAGE = Path(__file__).with_name("notes") / "performance.md"
ROOT = PAGE.parents[1]
MARK = re.compile(r"(<!-- table: (?P<name>\w+) -->\n).*?(<!-- end -->)", re.DOTALL)


def output(*command: object) -> str:
    done = subprocess.run([str(word) for word in command], stdout=subprocess.PIPE, text=True)
    if done.returncode:
        sys.exit(f"{command[0]} ended with {done.returncode}\n{done.stdout}")
    return done.stdout


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("--seconds", default="3", help="for the turns of each row")
    parser.add_argument("--threads", default="1,2", help="of the first table")
    parser.add_argument("--no-peers", action="store_true", help="leave the second table as it is")
    wanted = parser.parse_args()
    both = ["--markdown", "--seconds", wanted.seconds]
    tables = {"speed": output(wanted.build / "bench/speed", *both, "--threads", wanted.threads)}
    if not wanted.no_peers:
        library = (wanted.build / "libhooke.so").resolve()
        tables["peers"] = output(sys.executable, ROOT / "bench/peers/run.py", *both, "--slow", "--library", library)
    page = MARK.sub(lambda m: m[1] + tables[m["name"]] + m[3] if m["name"] in tables else m[0], PAGE.read_text("utf-8"))
    PAGE.write_text(page, "utf-8")


if __name__ == "__main__":
    main()
