"""Texts of files reach a terminal by the functions of cli/print.h alone, which let nothing through that steers it, and are
no markup in pages."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[2]
SOURCES = [path for path in sorted((ROOT / "cli").rglob("*.c")) if path.name != "print.c"]
CALL = re.compile(r"\b(?:printf|fprintf|fputs|puts|fwrite)\((?:[^;\"]|\"(?:[^\"\\]|\\.)*\")*;")
TEXT = re.compile(r"\b(?:\w*text(?:_of)?|hooke_\w*_name|\w*method_of|cli_run_method|reference_of|hooke_last_error)\(|->scene\b")
FINE = re.compile(r"strcmp\((?:[^()]|\([^()]*\))*\)|hooke_(?:part_kind|method|system_force|status)_\w*name\([^()]*\)"
                  r"|hooke_scene_text\(make->scene, \"text\"\)"
                  r"|hooke_record_text\(record, \"scene\"\), file")  # names of hooke's own, JSON, a file to read from


def raw(source):
    """Calls that print a text of the library, without those of names in its own tables."""
    return [call for call in CALL.findall(source) if TEXT.search(FINE.sub("", call))]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: path.name)
def test_texts_are_cleaned(path):
    assert raw(path.read_text(encoding="utf-8")) == []


def test_raw_ones_are_found():
    assert raw('printf("%-13s %s", "method", text(verify, "method"));') and raw("fputs(hooke_last_error(), stderr);")
    assert raw('printf("a;b %s",\n  hooke_record_text(it, "run"));')
    assert not raw('printf("%s\\n", strcmp(text(verify, "verdict"), "agrees") == 0 ? " to the bit" : "");')


SCRIPTS = [*ROOT.glob("src/io/page/assets/**/*.js"), *ROOT.glob("bindings/browser/*.js")]
MARKUP = re.compile(r"(?:inner|outer|set|insertAdjacent)HTML|document\.write|DOMParser|ContextualFragment|\bsrcdoc\b|\beval\(|Function\(")


@pytest.mark.parametrize("path", SCRIPTS, ids=lambda path: path.name)
def test_scripts_of_pages_make_no_markup_of_texts(path):
    """Those of views alone make frames of whole pages, which escape their own."""
    assert MARKUP.findall(path.read_text(encoding="utf-8")) == ["srcdoc"] * (path.name == "views.js")
