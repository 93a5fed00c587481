"""The browser of the tests of pages, which asks for the program."""

import os
import sys
from pathlib import Path

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
CLI, MINIMAL = os.environ["HOOKE_CLI"], False
sys.path.insert(0, str(ROOT / "tests/cli"))
