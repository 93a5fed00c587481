"""Completion in bash: the script run by bash, compared with --help."""

import functools
import json
import os
import re
import shutil
import subprocess

import pytest
from conftest import CLI
from test_make import KINDS

# One line of words a call, the last of them being completed; answers one line of candidates each.
DRIVER = r"""
source ./hooke.bash
while IFS= read -r line; do
  IFS=$'\x1f' read -r -a COMP_WORDS <<< "$line"
  [[ $line == *$'\x1f' ]] && COMP_WORDS+=("")
  COMP_CWORD=$((${#COMP_WORDS[@]} - 1))
  COMPREPLY=(left over)
  _hooke hooke "${COMP_WORDS[COMP_CWORD]}" "${COMP_WORDS[COMP_CWORD - 1]}"
  (IFS=$'\x1f'; printf '%s\n' "${COMPREPLY[*]}")
done
"""


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("completion")
    script = subprocess.run([CLI, "--completion", "bash"], capture_output=True, text=True, check=True).stdout
    (path / "hooke.bash").write_text(script)
    for name in ["scene.json", "my scene.json", "out.h5", "page.html", "notes.txt"]:
        (path / name).touch()
    (path / "scenes").mkdir()
    (path / "scenes/rope.json").touch()
    return path


@pytest.fixture(scope="module")
def complete(folder):
    """Candidates for lists of words, each after "hooke", all by one bash."""

    def ask(*lines):
        text = "".join("\x1f".join(["hooke", *words]) + "\n" for words in lines)
        done = subprocess.run(["bash", "-c", DRIVER], cwd=folder, input=text, capture_output=True, text=True, timeout=60)
        assert (done.returncode, done.stderr) == (0, "")
        answers = done.stdout.split("\n")[:-1]
        assert len(answers) == len(lines)
        found = [set(answer.split("\x1f")) - {""} for answer in answers]
        return found[0] if len(found) == 1 else found

    return ask


@functools.cache
def help_of(*words):
    return subprocess.run([CLI, *words, "--help", *(["all"] if words else [])], capture_output=True, text=True, check=True).stdout


def listed(title):
    return re.findall(r"^  ([\w-]+) ", help_of().split(f"\n{title}:\n")[1].split("\n\n")[0], re.MULTILINE)


VERBS = listed("verbs")
TAKERS = [[verb] for verb in VERBS if verb != "make"] + [["make", kind] for kind in KINDS]


def flags_of(words):
    """Options of a help text; with their descriptions."""
    rows = re.findall(r"^  (?:(-\w), |    )--([\w.-]+)(.*(?:\n {20,}.*)*)", help_of(*words), re.MULTILINE)
    return {flag: (letter, " ".join(text.split())) for letter, flag, text in rows}


def test_the_script_is_clean_bash(folder):
    subprocess.run(["bash", "-n", "hooke.bash"], cwd=folder, check=True)
    script = "set -u; source ./hooke.bash; complete -p hooke"
    done = subprocess.run(["bash", "-c", script], cwd=folder, capture_output=True, text=True, check=True)
    assert done.stdout == "complete -F _hooke hooke\n"


def test_the_first_word(complete):
    options = re.findall(r"--\w+", help_of().split("\nin place of a verb:\n")[1].split("\n\n")[0])
    assert complete([""]) == {*VERBS, *options} and len(options) == 5
    assert complete(["li"]) == {"limit"}
    assert complete(["--completion", ""]) == {"bash", "zsh", "fish"}
    assert complete(["make", ""]) == {*KINDS, "--help"}
    assert complete(["make", "ro"]) == {kind for kind in KINDS if kind.startswith("ro")}


@pytest.mark.parametrize("words", TAKERS, ids=" ".join)
def test_options_of_every_verb_are_those_of_its_help(complete, words):
    flags = flags_of(words)
    wanted = {f"--{flag}" for flag in flags} | {letter for letter, _ in flags.values() if letter}
    assert complete([*words, "-"], [*words, "--js"]) == [wanted, {"--json"}]


@pytest.mark.parametrize("words", TAKERS, ids=" ".join)
def test_values_are_words_files_or_nothing(complete, words):
    methods = set(listed("methods"))
    flags = flags_of(words)
    lines = [[*words, f"--{flag}", *sign, ""] for flag in flags for sign in ([], ["="])]
    answers = complete(*lines)
    for (flag, (letter, text)), plain, signed in zip(flags.items(), answers[::2], answers[1::2], strict=True):
        value = re.match(r"([\w.,:]+)?", text).group() if text[:1].isupper() else ""
        choices = set(re.findall(r'"([\w-]+)"', text))
        if flag in ("method", "methods"):
            assert plain == signed == methods, flag
        elif "true or false" in text:
            assert signed == {"true", "false"} and plain != signed, flag
        elif value.startswith(("NUMBER", "CHOICE")):
            assert plain == signed == choices, flag
        elif "." in value or value.startswith("FILE"):
            ending = value.partition(".")[2]
            everything = {"scene.json", "my scene.json", "out.h5", "page.html", "notes.txt", "hooke.bash", "scenes"}
            wanted = {name for name in everything if name == "scenes" or name.endswith(ending and f".{ending}")}
            assert plain == signed == wanted, flag
            assert not letter or complete([*words, letter, ""]) == wanted
        elif value and flag != "file":
            assert plain == signed == set(), flag


def test_scenes_are_files(complete):
    for verb in (verb for verb in VERBS if verb != "make"):
        takes_scenes = f"usage: hooke {verb} SCENE " in help_of(verb)
        wanted = {"out.h5", "scenes", *({"scene.json", "my scene.json"} if takes_scenes else ())}
        assert complete([verb, ""]) == wanted, verb
    assert complete(["run", "scenes/"]) == {"scenes/rope.json"}
    assert complete(["run", "my"]) == {"my scene.json"}
    assert complete(["run", "--step", "1e-3", "sc"]) == {"scene.json", "scenes"}


def test_lists_go_on_after_a_comma(complete):
    assert complete(["compare", "x.json", "--methods", "rk4,ver"]) == {"rk4,verlet"}
    assert complete(["make", "cloth", "--pinned", "top,cor"]) == {"top,corners"}
    assert complete(["run", "x.json", "--method", "rk4,ver"]) == set()


def test_no_word_is_offered_that_the_program_refuses(hooke, complete):
    for method in complete(["run", "--method", ""]):
        answer = hooke("run", "none.json", "--json", "--method", method)
        assert json.loads(answer.out)["error"]["exit"] in (3, 6)


# ---- the other shells ----


def script_of(shell):
    return subprocess.run([CLI, "--completion", shell], capture_output=True, text=True, check=True).stdout


@pytest.mark.parametrize("words", TAKERS, ids=" ".join)
def test_fish_offers_the_same_options(folder, complete, words):
    if not shutil.which("fish"):
        pytest.skip("needs fish")
    (folder / "hooke.fish").write_text(script_of("fish"))
    ask = f"source hooke.fish; complete -C 'hooke {' '.join(words)} --'; complete -C 'hooke {' '.join(words)} --method='"
    done = subprocess.run(["fish", "--no-config", "-c", ask], cwd=folder, capture_output=True, text=True, timeout=60)
    found = {line.split("\t")[0] for line in done.stdout.splitlines()}
    assert done.stderr == ""
    assert {word for word in found if "=" not in word} == {f"--{flag}" for flag in flags_of(words)}
    if "method" in flags_of(words):
        assert {f"--method={method}" for method in listed("methods")} <= found


# _arguments is asked what it was given, since zsh completes at a prompt only.
ZSH = r"""
compdef() { :; }
_arguments() { print -rl -- "$@"; return 1; }
source ./hooke.zsh
for line in "${(@f)LINES_}"; do
  words=(hooke ${=line} ""); CURRENT=$#words
  _hooke
  print -r -- "=="
done
"""


def test_zsh_offers_the_same_options(folder):
    if not shutil.which("zsh"):
        pytest.skip("needs zsh")
    (folder / "hooke.zsh").write_text(script_of("zsh"))
    lines = "\n".join(" ".join(words) for words in TAKERS)
    done = subprocess.run(["zsh", "-f", "-c", ZSH], cwd=folder, env={**os.environ, "LINES_": lines},
                          capture_output=True, text=True, timeout=60)  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    for words, text in zip(TAKERS, done.stdout.split("==\n"), strict=False):
        assert set(re.findall(r"^--([\w.-]+)=?\[", text, re.M)) == set(flags_of(words)), words
    assert f":value:({' '.join(listed('methods'))})" in done.stdout
