"""Public headers: each compiles alone as C99 and C++17, and their signatures keep to the plain language of the ABI."""

import os
import re
import subprocess
from pathlib import Path

import headers
import pytest

INCLUDE = Path(os.environ["HOOKE_SOURCE_DIR"]) / "include"
FILES = sorted(p.relative_to(INCLUDE).as_posix() for p in INCLUDE.rglob("*.h"))
COMPILERS = {
    "c99": (os.environ["HOOKE_CC"], "-xc", "-std=c99"),
    "c++17": (os.environ.get("HOOKE_CXX"), "-xc++", "-std=c++17"),
}


def compile_alone(language, include, header):
    compiler, *flags = COMPILERS[language]
    if not compiler:
        pytest.skip(f"no compiler for {language}")
    source = f'#include "{header}"\n#include "{header}"\nint main() {{ return 0; }}\n'.replace(
        "main()", "main(void)" if language == "c99" else "main()"
    )
    command = [compiler, *flags, "-Wall", "-Wextra", "-pedantic", "-Werror", "-fsyntax-only", f"-I{include}", "-"]
    return subprocess.run(command, input=source, capture_output=True, text=True)


@pytest.mark.parametrize("language", COMPILERS)
@pytest.mark.parametrize("header", FILES)
def test_compiles_alone(header, language):
    result = compile_alone(language, INCLUDE, header)
    assert result.returncode == 0, result.stderr


@pytest.mark.parametrize(
    "language, text",
    [
        ("c99", "int32_t hooke_x(void);"),  # includes nothing that declares int32_t
        ("c99", "extern int hooke_x[0];"),
        ("c++17", "int hooke_x(int class);"),
        ("c++17", "void *hooke_x(void);\nenum { A = 1, };\nstatic inline int *f(void) { return hooke_x(); }"),
    ],
)
def test_planted_header(tmp_path, language, text):
    (tmp_path / "bad.h").write_text(text + "\n")
    assert compile_alone(language, tmp_path, "bad.h").returncode != 0


def signature_complaints(text, opaque, callbacks):
    """Statements of a header that are not part of the allowed language: numbers by value, and pointers."""
    pointed = "|".join(sorted({"void", "char", *headers.NUMBERS, *opaque, *callbacks}))
    value = rf"(?:{'|'.join(headers.NUMBERS)}|(?:const )?(?:{pointed}) ?\*(?: ?\*)?)"
    parameters = rf"void|{value} ?\w+(?:, {value} ?\w+)*"
    name = headers.NAME
    allowed = rf"typedef struct ({name}) \1|(?:HOOKE_API|typedef) (?:void|{value}) ?{name} ?\((?:{parameters})\)"
    return [f"line {line}: `{words}` is not an opaque struct, a callback or a function with HOOKE_API, or has other types"
            for line, words in headers.statements(text) if not re.fullmatch(allowed, words)]


def known_types():
    text = "".join((INCLUDE / f).read_text() for f in FILES)
    return headers.opaque_types(text), headers.callback_types(text)


@pytest.mark.parametrize("header", FILES)
def test_signatures(header):
    complaints = signature_complaints((INCLUDE / header).read_text(), *known_types())
    assert not complaints, "\n".join(complaints)


@pytest.mark.parametrize(
    "text",
    [
        "HOOKE_API long hooke_x(void);",
        "HOOKE_API int hooke_x(void);",
        "HOOKE_API int32_t hooke_x(size_t n);",
        "HOOKE_API int32_t hooke_x(_Bool flag);",
        "HOOKE_API int32_t hooke_x(unsigned int n);",
        "HOOKE_API int32_t hooke_x(float x);",
        "HOOKE_API int32_t hooke_x(char c);",
        "HOOKE_API int32_t hooke_x(hooke_system system);",
        "HOOKE_API int32_t hooke_x(hooke_force force);",
        "HOOKE_API int32_t hooke_x(struct point p);",
        "HOOKE_API int32_t hooke_x(enum kind k);",
        "HOOKE_API int32_t hooke_x(const json_t *json);",
        "HOOKE_API int32_t hooke_x(int (*f)(int));",
        "HOOKE_API int32_t hooke_x();",
        "HOOKE_API int32_t other_x(void);",
        "int32_t hooke_x(void);",
        "HOOKE_API int32_t hooke_x;",
        "typedef struct hooke_pair { double a, b; } hooke_pair;",
        "typedef enum { HOOKE_A } hooke_kind;",
        "typedef int32_t hooke_done(long n, void *ctx);",
    ],
)
def test_planted_signature(text):
    assert signature_complaints(text, {"hooke_system"}, {"hooke_force"})


def test_allowed_signatures():
    text = """
    typedef struct hooke_system hooke_system;
    typedef int32_t hooke_force(int64_t n, const double *q, void *ctx);
    HOOKE_API const char *hooke_a(void);
    HOOKE_API void hooke_b(hooke_system *system, hooke_force *force, char **text, hooke_system **out);
    """
    assert signature_complaints(text, {"hooke_system"}, {"hooke_force"}) == []
