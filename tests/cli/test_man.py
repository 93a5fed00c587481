"""The manual page: clean to the formatters, complete against --help, and with examples that run."""

import re
import shutil
import subprocess

import pytest
from conftest import CLI
from test_make import KINDS


@pytest.fixture(scope="module")
def page(tmp_path_factory):
    path = tmp_path_factory.mktemp("man") / "hooke.1"
    path.write_bytes(subprocess.run([CLI, "--man"], capture_output=True, check=True).stdout)
    return path


@pytest.fixture(scope="module")
def sections(page):
    """Text of the page without escapes, by section."""
    text = page.read_text()
    for escape, character in [("\\-", "-"), ("\\(aq", "'"), ("\\(ha", "^"), ("\\e", "\\")]:
        text = text.replace(escape, character)
    text = re.sub(r"\\f[BIR]", "", text)
    parts = re.split(r"^\.SH (.*)\n", text, flags=re.MULTILINE)
    return dict(zip(parts[1::2], parts[2::2]))


def items(text):
    """Head and text of each item of a list."""
    found = re.findall(r"^\.TP\n(.*)\n((?:[^.\n].*\n)*)", text, re.MULTILINE)
    return {head: " ".join(words.replace("\\&", "").split()) for head, words in found}


def help_rows(text):
    """Options of a help text: the head of an item, and the text after it."""
    found = re.findall(r"^  (-\w, |    )(--\S+(?: [\w,.:]+)?)(?:  +|\n +)(\S.*(?:\n {20,}.*)*)", text, re.MULTILINE)
    return {(letter.strip() + " " + flag).strip(): " ".join(doc.split()) for letter, flag, doc in found}


@pytest.mark.parametrize("command", [["mandoc", "-T", "lint", "-W", "style"], ["groff", "-ww", "-man", "-z"]])
def test_the_formatters_have_nothing_to_say(page, command):
    if not shutil.which(command[0]):
        pytest.skip(f"{command[0]} is not installed")
    done = subprocess.run([*command, page], capture_output=True, text=True)
    assert done.stdout + done.stderr == ""
    broken = page.with_name("broken.1")
    broken.write_text(page.read_text() + ".SX\n.TP\n")
    done = subprocess.run([*command, broken], capture_output=True, text=True)
    assert "SX" in done.stdout + done.stderr


def test_the_sections_are_those_of_a_manual_page(sections):
    wanted = "NAME, SYNOPSIS, DESCRIPTION, VERBS, OPTIONS, EXIT STATUS, FILES, EXAMPLES, SEE ALSO"
    assert ", ".join(sections) == wanted
    assert re.match(r"hooke - \w", sections["NAME"])


def test_every_verb_has_what_its_help_has(hooke, sections):
    general = hooke("--help").out
    verbs = re.findall(r"^  (\w+) +(.*)", general.split("\nverbs:\n")[1].split("\n\n")[0], re.MULTILINE)
    described = items(sections["DESCRIPTION"])
    shared = items(sections["OPTIONS"])
    headed = re.split(r"^\.SS hooke (.*) \[options\]\n", sections["VERBS"], flags=re.MULTILINE)
    headed = dict(zip(headed[1::2], headed[2::2]))
    used = {re.match(r"usage: hooke (\w+ \S+) \[options\]", hooke(verb, "--help").out)[1] for verb, _ in verbs}
    assert set(headed) == used | {f"make {kind}" for kind in KINDS} and {"make KIND", "run SCENE"} < used
    for verb, summary in verbs:
        assert described[verb] == summary
        assert f"hooke {verb} " in sections["SYNOPSIS"]
    for name, text in headed.items():
        words = name.split()[:1] if name in used else name.split()
        answer = hooke(*words, "--help", "all").out
        own = items(text)
        if words == ["make"]:  # the options of the scene, which all kinds have
            answer = hooke("make", KINDS[0], "--help", "all").out
            answer = answer.replace(answer.split("\noptions of a ")[1].split("\n\n")[0], "")
        for head, doc in help_rows(answer).items():
            if head in own:
                assert own[head] == doc, (name, head)
            elif len(words) == 1:
                assert shared[head] == doc, (name, head)
            else:
                assert head in shared or head in items(headed["make KIND"]), (name, head)
        assert set(own) <= set(help_rows(answer)), name


def test_methods_exit_codes_and_options_in_place_of_a_verb(hooke, sections):
    general = hooke("--help").out
    described = items(sections["DESCRIPTION"])
    for method, summary in re.findall(r"^  ([\w-]+) +(\S.*)", general.split("\nmethods:\n")[1].split("\n\n")[0], re.M):
        assert described[method] == summary.replace(" (not in this build)", "")
    codes = " ".join(general.split("exit codes: ")[1].split())
    assert codes == ", ".join(f"{code} {meaning}" for code, meaning in items(sections["EXIT STATUS"]).items())
    place = items(sections["OPTIONS"].split("\nAll verbs take:\n")[0])
    assert place == help_rows(general) and {"-h, --help", "--man"} <= set(place)


@pytest.mark.check
@pytest.mark.everything
def test_the_examples_run(sections, tmp_path):
    commands = re.findall(r"^\.EX\n(hooke (?:.*\\\n)*.*)\n\.EE", sections["EXAMPLES"], re.MULTILINE)
    assert len(commands) >= 8 and commands[0].startswith("hooke make ")
    for command in commands:
        words = ["bash", "-c", command.replace("hooke", f"'{CLI}'", 1)]
        done = subprocess.run(words, cwd=tmp_path, capture_output=True, text=True, timeout=120)
        assert done.returncode == 0, command + done.stderr


def test_the_date_is_that_of_the_source_if_it_is_known(page):
    done = subprocess.run([CLI, "--man"], capture_output=True, text=True, env={"SOURCE_DATE_EPOCH": "86400"})
    assert done.stdout.startswith(".TH HOOKE 1 1970-01-02 ")
    assert re.match(r"\.TH HOOKE 1 20\d\d-\d\d-\d\d ", page.read_text())
