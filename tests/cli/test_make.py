"""hooke make: every kind with every option, refused values, and the written scene."""

import functools
import json
import re
import subprocess

import pytest
from conftest import CLI

pytestmark = pytest.mark.everything


@functools.cache
def run_help(*words):
    return subprocess.run([CLI, "make", *words, "--help", "all"], capture_output=True, text=True, check=True).stdout


def kinds():
    return re.findall(r"^  ([\w-]+) +\S", run_help().split("\nkinds:\n")[1].split("\n\n")[0], re.MULTILINE)


def options_of(kind):
    """Flag, argument and text of every option of a kind, from its --help."""
    rows = run_help(kind).split(f"\noptions of a {kind}:\n")[1].split("\n\n")[0]
    found = re.findall(r"^      --([\w.-]+)(?: ([A-Z]+))?\s+(\S.*(?:\n {20,}.*)*)", rows, re.MULTILINE)
    return [(flag, value, " ".join(text.split())) for flag, value, text in found]


def base_of(kind):
    """The example of a kind as a dict from flag to value."""
    words = run_help(kind).split("\nexample:\n  ")[1].split("\n")[0].replace("'", "").split()
    assert words[:3] == ["hooke", "make", kind]
    return dict(zip((word[2:] for word in words[3::2]), words[4::2]))


def command(options):
    return [word for flag, value in options.items() for word in (f"--{flag}", value)]


SQUARE = "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 9 9 0\nf 1 2 3\nf 2 4 3\n"  # of the examples that name a file
ROWS = {"vertices": "0,0,0;9,0,0;0,9,0", "triangles": "0,1,2"}  # instead of it


@pytest.fixture(autouse=True)
def mesh(tmp_path):
    (tmp_path / "mesh.obj").write_text(SQUARE)


def files(tmp_path):
    return {file.name for file in tmp_path.iterdir()} - {"mesh.obj"}


KINDS = kinds()
CLOTH = ["cloth", "--size", "4x3", "--edges", "1,0,0;0,0,1", "--mass", "1"]
SPRINGS = ["--structural.stiffness", "50"]


def value_for(word, text):
    """An allowed value that is not the default."""
    if "true or false" in text:
        return "false" if "default: true" in text else "true"
    if '"' in text:  # the first of its words that is not the default
        return re.search(r'"([\w-]+)"', text).group(1)
    count = re.search(r"; (\d+) numbers", text)
    if count:
        return ",".join(str(k + 0.25) for k in range(int(count.group(1))))
    return "2" if "whole" in text else "0.375"


def plain(value):
    """Numbers and words of a JSON value, flat."""
    if isinstance(value, list):
        return [item for part in value for item in plain(part)]
    return [value]


def check_value(found, given):
    flat = plain(found)
    for item, text in zip(flat, re.split("[,;x]" if re.match(r"[\d.,;x-]+$", given) else ",", given), strict=True):
        assert item == (json.loads(text) if re.match(r"-?[\d.]+$|true$|false$", text) else text)


def needed_value(text):
    """The example of the options that make a family present."""
    found = re.search(r"needed for any [\w-]+, such as (\S+)", text)
    return found and found.group(1)


def check_option(part, flag, given):
    """Checks that a part has the given value for the option of this flag; a file was read, and is not named."""
    family, _, member = flag.rpartition(".")
    if flag == "file":
        assert len(plain(part["triangles"])) == 6 and "file" not in part
    else:
        check_value((part[family.replace("-", "_")] if family else part)[member.replace("-", "_")], given)


def part_of(scene):
    (part,) = json.loads(scene)["parts"]
    return part


def test_the_list_of_kinds(hooke):
    assert {"rope", "cloth", "lattice", "mesh"} <= set(KINDS)
    nothing, asked = hooke("make"), hooke("make", "--help")
    assert (nothing.code, nothing.out) == (2, "") and (asked.code, asked.err) == (0, "")
    assert nothing.err == asked.out


@pytest.mark.parametrize("kind", KINDS)
def test_the_example_of_a_kind_comes_back_as_it_was_made(hooke, kind, tmp_path):
    made = hooke("make", kind, *command(base_of(kind)), "-o", "part.json", "--json")
    assert (made.code, files(tmp_path)) == (0, {"part.json"}), made.err
    read = hooke("check", "part.json", "--predict", "--json").json
    assert made.json["springs"] == read["springs"] > 0
    assert made.json["particles"] == read["particles"] > 0
    part = part_of((tmp_path / "part.json").read_text())
    assert part["kind"] == part["name"] == made.json["kind"] == kind
    for flag, value in base_of(kind).items():
        check_option(part, flag, value)
    assert "limit part.json --predict" in made.err


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize("other", [False, True], ids=["one", "other"])
def test_every_option_of_every_kind(hooke, kind, other):
    """All at once, except alternatives: of these the `other` ones the second time."""
    first = {"mass", "damping", "file", "offset"}
    left_out = first if other else {"density", "damping-ratio", "vertices", "triangles", "curl", "turns"}
    options = base_of(kind)
    for flag, word, text in options_of(kind):
        if flag != "fluid-drag.density" and flag.rpartition(".")[2] in left_out:
            options.pop(flag, None)
        elif flag not in options:
            options[flag] = ROWS.get(flag) or needed_value(text) or value_for(word, text)
    made = hooke("make", kind, *(f"--{flag}={value}" for flag, value in options.items()))
    assert made.code == 0, made.err
    part = part_of(made.out)
    for flag, value in options.items():
        check_option(part, flag, value)
    given = {flag.partition(".")[0].replace("-", "_") for flag in options} - {"file"}
    assert set(part) - {"kind", "name", "vertices", "triangles"} == given - {"vertices", "triangles"}


@pytest.mark.parametrize("kind", KINDS)
def test_bad_values_of_every_kind_name_the_option(hooke, kind, tmp_path):
    tried = set()
    for flag, word, text in options_of(kind):
        below = re.search(r" >=? ?0", text) is not None
        if word == "TEXT" or (word, below) in tried:
            continue
        tried.add((word, below))
        bad = "-1" if below else "nonsense"
        made = hooke("make", kind, *command(base_of(kind)), f"--{flag}={bad}", "-o", "part.json")
        assert (made.code, made.out) == (3, "")
        assert re.match(rf"hooke make: --{re.escape(flag)} .*{bad}.*allowed: ", made.err), made.err
    assert len(tried) >= 3 and not files(tmp_path)


@pytest.mark.parametrize("kind", KINDS)
def test_what_is_missing_is_named_with_unit_and_example(hooke, kind, tmp_path):
    required = [(flag, text) for flag, _, text in options_of(kind) if "; required" in text]
    example = base_of(kind)
    made = hooke("make", kind, "-o", "part.json")
    assert made.code == (2 if required else 3)
    for flag, text in required:
        unit = re.match(r"\[.*?\]", text)
        assert f"--{flag} (" in made.err and (not unit or unit.group() in made.err)
        assert re.search(rf"such as --{flag} '?{re.escape(example[flag])}'?[;\n]", made.err)
    del example["mass"]
    made = hooke("make", kind, *command(example), "-o", "part.json")
    assert made.code == 3 and "kg" in made.err and f"for example: hooke make {kind}" in made.err
    assert not files(tmp_path)


def test_values_as_people_write_them(hooke):
    one = hooke("make", *CLOTH)
    for other in [
        ["cloth", "--size", "4,3", "--edges", "1,0,0,0,0,1", "--mass", "1"],
        ["cloth", "--size=4x3", "--edges", "1m,0,0;0,0,100cm", "--mass=1"],
        ["cloth", "--edges", "1,0,0", "--size", "4x3", "--edges", "0,0,1", "--mass", "1"],
        ["cloth", "--mass", "2", "--size", "4x3", "--edges", "1,0,0;0,0,1", "--mass", "1"],
    ]:
        made = hooke("make", *other)
        assert (made.code, made.out) == (0, one.out), made.err
    assert part_of(hooke("make", *CLOTH, "--pinned", "top", "--pinned", "9,11").out)["pinned"] == ["top", 9, 11]


def test_keys_of_the_scene_and_of_its_run(hooke, tmp_path):
    words = ["--gravity", "0,-9.81,0", "--drag", "0.01", "--title", 'a "cloth"', "--name", "flag"]
    run = ["--method", "verlet", "--step", "1ms", "--duration", "0.1", "--every=0.02", "--atol-velocity", "1e-4"]
    made = hooke("make", *CLOTH, *SPRINGS, *words, *run, "-o", "cloth.json")
    assert made.code == 0 and "limit" not in made.err
    scene = json.loads((tmp_path / "cloth.json").read_text())
    assert list(scene) == ["hooke", "title", "gravity", "drag", "parts", "run"]
    assert (scene["title"], scene["gravity"], scene["drag"]) == ('a "cloth"', [0, -9.81, 0], 0.01)
    assert scene["run"] == {
        "method": "verlet", "step": 0.001, "duration": 0.1, "every": 0.02, "atol_velocity": 1e-4,
    }  # fmt: skip
    assert scene["parts"][0]["name"] == "flag"
    assert hooke("run", "cloth.json", "--json").json["status"] == "finished"
    assert "run" not in json.loads(hooke("make", *CLOTH).out)


def test_a_pipe_takes_the_scene(hooke):
    scene = hooke("make", *CLOTH, *SPRINGS, "--quiet")
    assert (scene.code, scene.err) == (0, "")
    assert hooke("make", *CLOTH, *SPRINGS, "-o", "-").out == scene.out
    read = hooke("check", "-", "--predict", "--json", input=scene.out)
    assert (read.json["particles"], read.json["springs"]) == (12, 17)
    wrong = hooke("check", "-", input=scene.out.replace("50", "-50"))
    assert wrong.code == 3 and "standard input:" in wrong.err and "-50" in wrong.err
    assert hooke("check", "-", input="").code == 3


@pytest.mark.parametrize(
    "words, code, wanted",
    [
        (["clth"], 2, "did you mean 'cloth'?"),
        (["--size", "4x3"], 2, "it comes first"),
        ([*CLOTH, "more.json"], 2, "'more.json'"),
        ([*CLOTH, "--strutural.stiffness", "1"], 2, "did you mean --structural.stiffness?"),
        ([*CLOTH, "--structural.damping", "1"], 2, "missing: --structural.stiffness ("),
        ([*CLOTH, "--density", "1"], 3, "--density: mass and density are both given"),
        ([*CLOTH, "--pinned", "12"], 3, "--pinned[0]: the part has no particle 12; allowed: 0 to 11"),
        ([*CLOTH, "--edges", "0,1,0"], 3, "--edges 0,1,0: 3 rows given; allowed: 2 rows"),
        (["cloth", "--edges", "1,0;0,0,0,1"], 3, "--edges 1,0;0,0,0,1: row [0] has 2 numbers"),
        (["cloth", "--edges", "1,0,0;"], 3, "row [1] has 0 numbers"),
        (["cloth", "--edges", "1px,0,0"], 3, "no unit 'px'"),
        ([*CLOTH, "--gravity", "9.81"], 3, "--gravity 9.81: 1 number given; allowed: 3 numbers"),
        ([*CLOTH, "--method", "verlot"], 3, "did you mean verlet?"),
        ([*CLOTH, "--step", "0.1", "--duration", "0.25"], 3, "--duration: 0.25 s is not a whole multiple"),
        ([*CLOTH, *SPRINGS, "--structural.damping=1", "--structural.damping-ratio=1"], 3, "--structural.damping-ratio"),
        (["cloth", "--size", "4x3", "--edges", "0,0,0;0,0,1", "--mass", "1", *SPRINGS], 3, "--structural: "),
        (["mesh", "--file", "none.obj", "--mass", "1"], 3, "--file none.obj: cannot be opened"),
        (["mesh", "--file", "mesh.obj", "--vertices", "0,0,0;1,0,0;0,1,0", "--mass", "1"], 3, "--vertices: belongs to"),
        (["mesh", "--mass", "1"], 3, "--vertices: is missing; allowed: a file"),
        (["cloth", "--size", "99999x99999", "--edges", "1,0,0;0,0,1", "--mass", "1"], 3, "--size: "),
    ],
)
def test_what_is_refused(hooke, tmp_path, words, code, wanted):
    (tmp_path / "cloth.json").write_text("older")
    made = hooke("make", *words, "-o", "cloth.json", "--json")
    assert made.code == made.json["error"]["exit"] == code
    assert wanted in made.err and wanted in made.json["error"]["message"]
    assert files(tmp_path) == {"cloth.json"} and (tmp_path / "cloth.json").read_text() == "older"


def test_a_file_that_cannot_be_written_is_5(hooke, tmp_path):
    (tmp_path / "folder").mkdir()
    assert hooke("make", *CLOTH, "-o", "folder").code == 5
    assert hooke("make", *CLOTH, "-o", "none/cloth.json").code == 5
    (tmp_path / "cloth.json").write_text("older")
    assert hooke("make", *CLOTH, "-o", "cloth.json").code == 0
    assert part_of((tmp_path / "cloth.json").read_text())["size"] == [4, 3]
