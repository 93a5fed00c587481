"""The pages of the site as `make docs` writes them, those of the references among them."""

import atexit
import importlib.util
import os
import shutil
import tempfile
from pathlib import Path

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])

spec = importlib.util.spec_from_file_location("make_reference", ROOT / "docs/make_reference.py")
make_reference = importlib.util.module_from_spec(spec)
spec.loader.exec_module(make_reference)

SITE = Path(tempfile.mkdtemp()) / "docs"
atexit.register(shutil.rmtree, SITE.parent, ignore_errors=True)
make_reference.write(Path(os.environ["HOOKE_BUILD_DIR"]), SITE)
