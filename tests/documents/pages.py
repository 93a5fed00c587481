"""The pages of the site as `make docs` writes them, those of the references among them."""

import atexit
import importlib.util
import os
import shutil
import tempfile
from pathlib import Path

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])



def script(name):
    spec = importlib.util.spec_from_file_location(name, ROOT / f"docs/{name}.py")
    found = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(found)
    return found


BUILD = Path(os.environ["HOOKE_BUILD_DIR"])
SITE = Path(tempfile.mkdtemp()) / "docs"
atexit.register(shutil.rmtree, SITE.parent, ignore_errors=True)
make_reference = script("make_reference")
make_reference.write(BUILD, SITE)
