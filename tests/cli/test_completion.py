"""Completion: the scripts run by their shells, which ask the program, compared with --help."""

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
hooke() { "$HOOKE_CLI" "$@"; }
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
        done = subprocess.run(["bash", "-c", DRIVER], cwd=folder, input=text, capture_output=True, text=True, timeout=60,
                              env={**os.environ, "HOOKE_CLI": CLI})  # fmt: skip
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


@pytest.mark.check
def test_values_are_words_files_or_nothing(complete):
    methods = set(listed("methods"))
    rows = {(flag, *row): words for words in TAKERS for flag, row in flags_of(words).items()}  # each of several verbs once
    asked = [(row, words, sign) for row, words in rows.items() for sign in ("", "=") if not sign or words in (["run"], ["make", "rope"])]
    answers = complete(*([*words, f"--{row[0]}", *sign, ""] for row, words, sign in asked))
    for ((flag, letter, text), words, sign), answer in zip(asked, answers, strict=True):
        value = re.match(r"([\w.,:]+)?", text).group() if text[:1].isupper() else ""
        choices = set(re.findall(r'"([\w-]+)"', text))
        if flag in ("method", "methods"):
            assert answer == methods, flag
        elif "true or false" in text:
            assert (answer == {"true", "false"}) == (sign == "="), flag
        elif value.startswith(("NUMBER", "CHOICE")):
            assert answer == choices, flag
        elif "." in value or value.startswith("FILE"):
            ending = value.partition(".")[2]
            everything = {"scene.json", "my scene.json", "out.h5", "page.html", "notes.txt", "hooke.bash", "scenes"}
            wanted = {name for name in everything if name == "scenes" or name.endswith(ending and f".{ending}")}
            assert answer == wanted, flag
            assert not letter or complete([*words, letter, ""]) == wanted
        elif value and flag != "file":
            assert answer == set(), flag
    assert {sign for *_, sign in asked} == {"", "="} and len(asked) > 150


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
    assert complete(["make", "cloth", "--gravity", "=", "-9"], ["make", "cloth", "--gravity", "-"]) == [set(), set()]


def test_no_word_is_offered_that_the_program_refuses(hooke, complete):
    for method in complete(["run", "--method", ""]):
        answer = hooke("run", "none.json", "--json", "--method", method)
        assert json.loads(answer.out)["error"]["exit"] in (3, 6)


# ---- the other shells ----


def script_of(shell):
    return subprocess.run([CLI, "--completion", shell], capture_output=True, text=True, check=True).stdout


def run_by(shell, folder, script, lines=()):
    """Answers of a shell to lines that it is given as $LINES_, parted by lines "=="."""
    if not shutil.which(shell[0]):
        pytest.skip(f"needs {shell[0]}")
    (folder / f"hooke.{shell[0]}").write_text(script_of(shell[0]))
    done = subprocess.run([*shell, "-c", script], cwd=folder, env={**os.environ, "LINES_": "\n".join(lines), "HOOKE_CLI": CLI},
                          capture_output=True, text=True, timeout=60)  # fmt: skip
    assert (done.returncode, done.stderr) == (0, "")
    return done.stdout.split("==\n")


LINES = [" ".join(words) for words in TAKERS]
FISH = r"""
function hooke; $HOOKE_CLI $argv; end
source hooke.fish
for line in (string split \n -- $LINES_); complete -C "hooke $line"; echo ==; end
"""


def test_fish_offers_the_same_options_words_and_files(folder):
    ends = [line + end for line in LINES for end in (" --", " --method=")]
    more = ["run --method rk", "compare --methods rk4,ver", "run -o ", "run ", "make ", "--completion z"]
    answers = run_by(["fish", "--no-config"], folder, FISH, ends + more)
    found = [{line.split("\t")[0] for line in answer.splitlines()} for answer in answers]
    for k, words in enumerate(TAKERS):
        assert found[2 * k] == {f"--{flag}" for flag in flags_of(words)}, words
        if "method" in flags_of(words):
            assert found[2 * k + 1] == {f"--method={method}" for method in listed("methods")}, words
    method, methods, output, scene, kinds, shell = found[len(ends) : -1]
    assert (method, methods, shell) == ({"rk4"}, {"rk4,verlet"}, {"zsh"}) and {*KINDS, "--help"} == kinds
    assert "out.h5" in output and {"scene.json", "my scene.json", "scenes/"} <= scene
    described = dict(line.split("\t") for line in answers[2 * LINES.index("run")].splitlines())
    assert described["--final"].startswith("prints the position")


# zsh completes at a prompt only: its functions say what they were given.
ZSH = r"""
compdef() { :; }
compset() { [[ $2 == '--*=' && $words[-1] == --*=* ]] }
_describe() { print -rl -- "${(@P)2}" "${@[3,-1]}" }
_files() { print -r -- files "$@" }
hooke() { "$HOOKE_CLI" "$@" }
source ./hooke.zsh
for line in "${(@f)LINES_}"; do
  words=(hooke "${(@s: :)line}"); CURRENT=$#words
  _hooke
  print -r -- "=="
done
"""


def test_zsh_offers_the_same_options_words_and_files(folder):
    more = ["run --method ", "compare --methods=rk4,", "run -o ", "run ", "run --newton", "verify ", "make mesh --file ", ""]
    answers = run_by(["zsh", "-f"], folder, ZSH, [*(line + " --" for line in LINES), *more])
    for words, text in zip(TAKERS, answers[: len(TAKERS)], strict=True):
        assert set(re.findall(r"^--([\w.-]+):", text, re.MULTILINE)) == set(flags_of(words)), words
    method, methods, output, scene, option, trajectory, mesh, first, _ = answers[len(TAKERS) :]
    assert re.findall("^(.*):$", method, re.MULTILINE) == listed("methods")
    assert "--methods=rk4,verlet:\n" in methods and methods.endswith("\n-S\n\n")
    assert (output, scene) == ("files -g *.(h5)\n", "files -g *.(json|h5)\n")
    assert (trajectory, mesh) == ("files -g *.(h5)\n", "files\n")
    assert r"equations\: converged" in option
    assert re.findall(r"^([\w-]+):", first, re.MULTILINE) == VERBS + re.findall(r"--\w+", help_of().split("in place of")[1])
