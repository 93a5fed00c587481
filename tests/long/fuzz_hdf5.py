"""The counted campaign of the targets that read HDF5 files: see fuzz.py."""

import fuzz

PART = fuzz.part("fuzz_hdf5", {"record": 4600, "arrays": 2000})
