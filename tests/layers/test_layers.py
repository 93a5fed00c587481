"""Includes, third-party fences, sizes and names, on the whole tree; each rule also on a bad example."""

import os
from pathlib import Path

import pytest
import rules

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
FOLDERS = ["include", "src", "cli", "bench", "bindings", "examples", "tests"]


def tree(*endings):
    for folder in FOLDERS:
        for path in sorted((ROOT / folder).rglob("*")):
            if path.suffix in endings and path.is_file():
                yield path.relative_to(ROOT).as_posix(), path.read_text(encoding="utf-8")


def test_includes():
    complaints = [c for path, text in tree(".c", ".h") for c in rules.include_complaints(path, text)]
    assert not complaints, "\n".join(complaints)


def test_calls():
    complaints = [c for path, text in tree(".c", ".h") for c in rules.call_complaints(path, text)]
    assert not complaints, "\n".join(complaints)


def test_planted_call():
    call = "extern void dsyev_(const char *job);\n"
    assert rules.call_complaints("src/measure/spectrum/eigen/dominant_mode.c", call)
    assert rules.call_complaints("src/measure/spectrum/eigen/dense_lapack.c", call) == []


def test_numbers_are_printed_in_no_locale():
    complaints = [c for path, text in tree(".c", ".h") for c in rules.locale_complaints(path, text)]
    assert not complaints, "\n".join(complaints)


def test_planted_number():
    call = 'snprintf(text, size, "%d of %.3g",\n  k, value);\n'
    assert rules.locale_complaints("src/io/file/text.c", call)
    assert rules.locale_complaints("src/io/file/text.c", call.replace("%.3g", "%s")) == []
    assert rules.locale_complaints("src/io/file/text.c", "hk_print" + call[8:]) == []


def test_systems_are_fenced():
    complaints = [c for path, text in tree(".c", ".h") for c in rules.system_complaints(path, text)]
    assert not complaints, "\n".join(complaints)


def test_planted_system():
    line = "#if defined(__APPLE__)\n"
    assert rules.system_complaints("src/io/file/bytes.c", line) and rules.system_complaints("cli/main.c", line)
    assert rules.system_complaints("src/core/os/os_file_posix.c", line) == []


def test_sources_of_the_program_need_one_another_in_no_circle():
    complaints = rules.circle_complaints({path: text for path, text in tree(".c") if path.startswith("cli/")})
    assert not complaints, "\n".join(complaints)


def test_planted_circle():
    files = {"cli/a.c": "int cli_a(int k) {\n  return cli_b(k);\n}\n",
             "cli/b.c": 'int cli_b(int k) {\n  return puts("cli_a");\n}\n',
             "cli/c.c": "const struct row cli_rows[] = {{cli_a}};\n"}
    assert rules.circle_complaints(files) == []
    assert len(rules.circle_complaints(files | {"cli/b.c": "int cli_b(int k) {\n  return cli_rows[k](k);\n}\n"})) == 3


def test_fences_do_not_leak():
    complaints = rules.leak_complaints(dict(tree(".c", ".h")))
    assert not complaints, "\n".join(complaints)


def test_sizes_and_names():
    complaints = [c for path, text in tree(".c", ".h", ".py", ".f90", ".cmake") for c in rules.shape_complaints(path, text)]
    assert not complaints, "\n".join(complaints)


def test_every_layer_and_public_header_is_known():
    folders = {p.name for p in (ROOT / "src").iterdir() if p.is_dir()}
    assert folders == set(rules.LAYERS)
    headers = {p.relative_to(ROOT / "include").as_posix() for p in (ROOT / "include/hooke").glob("*.h")}
    assert headers == set(rules.PUBLIC)


@pytest.mark.parametrize(
    "path, line",
    [
        ("src/core/status.c", '#include "kernel/spring/spring_loops.h"'),
        ("src/core/status.c", '#include "hooke/system.h"'),
        ("src/kernel/spring/spring_loops.c", '#include "model/system.h"'),
        ("src/model/system.c", '#include "integrate/method.h"'),
        ("src/integrate/loop/run.c", '#include "parts/rope.h"'),
        ("src/integrate/loop/run.c", '#include "hooke/parts.h"'),
        ("src/parts/rope.c", '#include "integrate/method.h"'),
        ("src/measure/energy.c", '#include "io/scene/scene.h"'),
        ("bench/speed.c", '#include "measure/counted_work/work.h"'),
        ("src/measure/energy.c", '  #  include "hooke/scene.h"'),
        ("src/measure/energy.c", '#include "hooke.h"'),
        ("src/measure/energy.c", '#include "energy.h"'),
        ("src/measure/energy.c", '#include "../core/status.h"'),
        ("src/kernel/spring/spring_loops.c", '#include "kernel/body.c"'),
        ("src/extra/new.c", '#include "core/status.h"'),
        ("src/io/table/csv.c", "#include <jansson.h>"),
        ("src/io/scene/scene_json.c", "#include <jansson.h>"),
        ("src/io/scene/scene_json.c", "#include <hdf5.h>"),
        ("src/io/trajectory/trajectory_h5.c", "#include <jansson.h>"),
        ("src/integrate/loop/run.c", "#include <cvode/cvode.h>"),
        ("src/integrate/solve/unknowns.c", "#include <nvector/nvector_serial.h>"),
        ("src/integrate/method/rk8pd_gsl.c", "#include <arkode/arkode_arkstep.h>"),
        ("src/integrate/method/arkode.c", "#include <gsl/gsl_odeiv2.h>"),
        ("src/integrate/method/rk8pd.c", "#include <gsl/gsl_odeiv2.h>"),
        ("src/integrate/solve/factor.c", "#include <cholmod.h>"),
        ("src/integrate/solve/factor_cholmod.h", "#include <cholmod.h>"),
        ("src/measure/study/order_gsl.c", "#include <gsl/gsl_fit.h>"),
        ("src/measure/spectrum/eigen/dominant_mode.c", "#include <lapack.h>"),
        ("src/model/system.c", "#include <mpi.h>"),
        ("src/model/system.c", "#include <cmocka.h>"),
        ("src/io/file/bytes.c", "#include <sys/stat.h>"),
        ("cli/watch.c", "#include <fcntl.h>"),
        ("cli/os/os_posix.c", "#include <windows.h>"),
        ("include/hooke/trajectory.h", "#include <hdf5.h>"),
        ("include/hooke/base.h", "#include <stdbool.h>"),
        ("include/hooke/base.h", '#include "core/status.h"'),
        ("cli/main.c", '#include "core/status.h"'),
        ("cli/main.c", "#include <jansson.h>"),
        ("tests/fuzz/fuzz_scene.c", "#include <jansson.h>"),
        ("src/core/status.c", "#include <hooke.h>"),
        ("tests/physics/test_order.c", '#include "model/system.h"'),
    ],
)
def test_planted_include(path, line):
    assert rules.include_complaints(path, "/* a */\n" + line + "\n")


def test_planted_leak():
    files = {"src/io/hdf5/file_h5.h": "#include <hdf5.h>\n", "src/io/hdf5/group_h5.c": '#include "io/hdf5/file_h5.h"\n'}
    assert rules.leak_complaints(files) == []
    assert rules.leak_complaints(files | {"src/io/page/report.c": '#include "io/hdf5/file_h5.h"\n'})


@pytest.mark.parametrize(
    "path, line",
    [
        ("src/io/trajectory/trajectory_h5.c", "#include <hdf5.h>"),
        ("src/integrate/method/cvode_linear.c", "#include <sunlinsol/sunlinsol_spgmr.h>"),
        ("src/integrate/method/arkode.c", "#include <arkode/arkode_arkstep.h>"),
        ("src/integrate/solve/sundials_problem.h", "#include <nvector/nvector_serial.h>"),
        ("src/integrate/method/rk8pd_gsl.c", "#include <gsl/gsl_odeiv2.h>"),
        ("src/integrate/solve/factor_cholmod.c", "#include <cholmod.h>"),
        ("src/measure/spectrum/eigen/dense_lapack.c", "#include <lapacke.h>"),
        ("src/io/page/report.c", '#include "parts/rope.h"'),
        ("src/measure/energy.c", '#include "hooke/integrator.h"'),
        ("src/core/status.c", '/* #include "io/scene/scene.h" */'),
        ("tests/unit/test_status.c", '#include "core/status.h"'),
        ("bench/costs.c", '#include "measure/counted_work/work.h"'),
        ("tests/fuzz/mutate_scene.c", "#include <jansson.h>"),
        ("cli/main.c", '#include "hooke.h"'),
        ("cli/main.c", "#include <hooke.h>"),
    ],
)
def test_allowed_include(path, line):
    assert rules.include_complaints(path, line + "\n") == []


@pytest.mark.parametrize(
    "path, text",
    [
        ("src/model/system.c", "\n" * 801),
        ("src/core/utils.c", "\n"),
        ("src/core/string_helpers.h", "\n"),
        ("src/core/status.c", "/* TO" "DO: later */\n"),
    ],
)
def test_planted_shape(path, text):
    assert rules.shape_complaints(path, text)
