"""The Fortran module has every public function of C, with the same arguments, and its types use every one of them."""

import os
import re
from pathlib import Path

import interfaces
import pytest

ROOT = Path(os.environ["HOOKE_SOURCE_DIR"])
FOLDER = ROOT / "bindings/fortran"
MADE = Path(os.environ["HOOKE_BUILD_DIR"]) / "fortran"
HEADERS = sorted((ROOT / "include/hooke").glob("*.h"))
MODULES = [FOLDER / "base.f90", FOLDER / "handles.f90", MADE / "hooke.f90"]


def read(files):
    return [f.read_text(encoding="utf-8") for f in files]


def wanted():
    return interfaces.of_headers(read(HEADERS))


def test_every_function_has_an_interface():
    have = interfaces.of_fortran((MADE / "c.f90").read_text())
    found = interfaces.complaints(have, wanted())
    assert not found, "\n".join(found)


def test_every_function_is_used():
    used = interfaces.called(read(MODULES))
    missing = [n for n in wanted() if interfaces.shortened(n) not in used]
    assert not missing, f"no procedure uses {', '.join(missing)}: bindings/generate/procedures.py writes none, so bindings/fortran needs one"


def test_statuses():
    header = (ROOT / "include/hooke/base.h").read_text()
    pairs = re.findall(r"#define (HOOKE_\w+) +\(?(-?\d+)\)?", header)
    statuses = {name.lower(): int(number) for name, number in pairs if name != "HOOKE_ABI"}
    module = re.findall(r"parameter :: (hooke_\w+) = (-?\d+)", (MADE / "c.f90").read_text())
    assert len(statuses) > 10 and {n: int(v) for n, v in module} == statuses
    users = (MADE / "hooke.f90").read_text()
    assert all(re.search(rf"^  public :: {name}$", users, re.MULTILINE) for name in statuses), "users have every status"


def order_complaints(sources, text_of):
    """Files of sources.txt that use a module before it was written, in a file before or above in their own."""
    found, known = [], set()
    for source in sources:
        module = None
        for line in interfaces.statements(text_of(source)):
            match = re.match(r"use (hooke_\w+)", line)
            if match and match.group(1) not in known:
                found.append(f"{source}: {match.group(1)} comes later or never")
            if match := re.fullmatch(r"module (\w+)", line):
                module = match.group(1)
            if line == "end module":
                known.add(module)
    return found


def test_order_of_sources():
    sources = (FOLDER / "sources.txt").read_text().split()
    there = {p.name for folder in (FOLDER, MADE) for p in folder.glob("*.f90")} - {"hooke.template.f90"}
    assert set(sources) == there and len(sources) == len(there), "sources.txt has every file once"
    assert order_complaints(sources, lambda s: next(f / s for f in (FOLDER, MADE) if (f / s).exists()).read_text()) == []


def test_planted_order():
    texts = {"a.f90": "module hooke_a\nuse hooke_b\nend module\n", "b.f90": "module hooke_b\nend module\n"}
    assert order_complaints(["b.f90", "a.f90"], texts.get) == []
    assert order_complaints(["a.f90", "b.f90"], texts.get)
    assert order_complaints(["c.f90"], lambda _: texts["b.f90"] + texts["a.f90"]) == []
    assert order_complaints(["c.f90"], lambda _: texts["a.f90"] + texts["b.f90"])
    assert order_complaints(["c.f90"], lambda _: "module hooke_c\nuse hooke_c\nend module\n")


HEADER = """
typedef struct hooke_a hooke_a;
typedef int32_t hooke_f(double t, void *ctx);
HOOKE_API int32_t hooke_a_go(hooke_a *a, const char *name, int64_t n, const double *q, double *out, hooke_a **b,
                             hooke_f *f, void *ctx);
HOOKE_API const double *hooke_a_mass(const hooke_a *a);
HOOKE_API void hooke_a_end(hooke_a *a);
"""
MODULE = """
integer(c_int32_t) function c_a_go(a, name, n, q, out, b, &
  f, ctx) bind(c, name="hooke_a_go") ! goes
  import
  type(c_ptr), value :: a, ctx
  character(kind=c_char), intent(in), optional :: name(*)
  integer(c_int64_t), value :: n
  real(c_double), intent(in), optional :: q(*)
  real(c_double), intent(inout), optional :: out(*)
  type(c_ptr), intent(out) :: b
  type(c_funptr), value :: f
end function
type(c_ptr) function c_a_mass(a) bind(c, name="hooke_a_mass")
  import
  type(c_ptr), value :: a
end function
subroutine c_a_end(a) bind(c, name="hooke_a_end")
  import
  type(c_ptr), value :: a
end subroutine
"""


def test_reading():
    assert interfaces.complaints(interfaces.of_fortran(MODULE), interfaces.of_headers([HEADER])) == []


@pytest.mark.parametrize(
    "right, wrong",
    [
        ("q, out, b", "q, b"),
        ("a, name, n", "name, a, n"),
        ("integer(c_int64_t), value", "integer(c_int32_t), value"),
        ("integer(c_int64_t), value", "integer(c_int64_t), intent(in), optional"),
        ("real(c_double), intent(in), optional :: q(*)", "real(c_double), value :: q"),
        ("real(c_double), intent(in), optional :: q(*)", "real(c_double), intent(inout), optional :: q(*)"),
        ("real(c_double), intent(in), optional :: q(*)", "real(c_double), intent(in), optional :: q"),
        ("real(c_double), intent(in), optional :: q(*)", "real(c_double), intent(in) :: q(*)"),
        ("real(c_double), intent(inout)", "integer(c_int64_t), intent(inout)"),
        ("type(c_ptr), intent(out) :: b", "type(c_ptr), value :: b"),
        ("type(c_funptr), value :: f", "type(c_ptr), value :: f"),
        ("type(c_ptr) function", "integer(c_int64_t) function"),
        ('name="hooke_a_mass"', 'name="hooke_a_masses"'),
        ("integer(c_int32_t) function", "integer(c_int64_t) function"),
    ],
)
def test_planted(right, wrong):
    assert right in MODULE
    have = interfaces.of_fortran(MODULE.replace(right, wrong))
    assert interfaces.complaints(have, interfaces.of_headers([HEADER]))


def test_planted_use():
    text = "use hooke_c_a, only: c_a_go, &\n  c_a_end\n! c_a_mass(a)\ncall accept(c_a_go(self%address()))\n"
    assert interfaces.called([text]) == {"c_a_go"}
