"""Files and standard output that cannot be written, for every verb that writes: exit code 5, the file and the reason,
no claim of success, the older file unchanged, no other file left."""

import json
import os
import re
import resource
import shutil
import signal
import subprocess

import pytest
from conftest import CLI, SIX_PARTICLES

pytestmark = pytest.mark.everything

# Under sanitizers a few are taken, and with HOOKE_LONG=1 all.
FEW = os.environ.get("HOOKE_PRESET") == "asan" and os.environ.get("HOOKE_LONG") != "1"

SHORT = ["--duration", "0.002", "--every", "0.001"]
STUDY = ["study", "scene.json", *SHORT, "--methods", "verlet", "--points", "6", "--quiet"]
NEEDS = ["needs", "scene.json", *SHORT, "--want", "1cm", "--quiet"]
LIMIT = ["limit", "scene.json", "--predict", "--methods", "verlet", "--quiet"]
MAKE = ["make", "rope", "--from", "0,0,0", "--to", "1,0,0", "--segments", "4", "--mass", "1", "--quiet"]

# By name: the words before the file, the file's ending, and the standard output of a success only.
WRITERS = {
    "run": (["run", "scene.json", *SHORT, "--checkpoint", "0.001", "--json", "--quiet", "-o"], ".h5", "finished"),
    "run that diverges": (["run", "stiff.json", "--json", "--quiet", "-o"], ".h5", "diagnosis"),
    "compare": (["compare", "scene.json", *SHORT, "--methods", "verlet", "--quiet", "-o"], ".h5", "output:"),
    "study table": ([*STUDY, "-o"], ".csv", "output:"),
    "study": ([*STUDY, "-o"], ".h5", "output:"),
    "study report": ([*STUDY, "--report"], ".html", None),
    "limit report": ([*LIMIT, "--report"], ".html", None),
    "needs": ([*NEEDS, "-o"], ".json", "hooke run out"),
    "needs report": ([*NEEDS, "--report"], ".html", None),
    "make": ([*MAKE, "--json", "-o"], ".json", "kind"),
    "view": (["view", "seen.h5", "--json", "--quiet", "-o"], ".html", "frame_stride"),
}
TAKEN = ["run", "study", "view"] if FEW else list(WRITERS)


@pytest.fixture(name="scenes", scope="module")
def fixture_scenes(tmp_path_factory):
    """A folder with the input of the verbs; not to be written in."""
    folder = tmp_path_factory.mktemp("scenes")
    (folder / "scene.json").write_text(json.dumps(SIX_PARTICLES))
    stiff = {**SIX_PARTICLES, "run": {"method": "forward-euler", "step": 1, "duration": 20, "every": 1}}
    (folder / "stiff.json").write_text(json.dumps(stiff))
    subprocess.run([CLI, "run", "scene.json", *SHORT, "-o", "seen.h5", "--quiet"], cwd=folder, check=True, capture_output=True)
    return folder


@pytest.fixture(name="folder")
def fixture_folder(scenes, tmp_path):
    for path in scenes.iterdir():
        shutil.copy(path, tmp_path)
    return tmp_path


def start(folder, words, preexec=None, out=subprocess.PIPE, before=()):
    done = subprocess.run(
        [*before, CLI, *words], cwd=folder, stdout=out, stderr=subprocess.PIPE, text=True, timeout=240, preexec_fn=preexec, check=False
    )
    assert "Sanitizer" not in done.stderr, done.stderr
    return done


def check(answer, writer, name, reason):
    claim = WRITERS[writer][2]
    assert answer.returncode == 5, answer.stderr
    assert name in answer.stderr and reason in answer.stderr, answer.stderr
    assert claim is None or claim not in answer.stdout.replace(json.dumps(answer.stderr)[1:-1], "")


@pytest.mark.parametrize("writer", WRITERS)
@pytest.mark.parametrize("place", ["/dev/full", "missing/out", "scene.json/out", "/proc/out"])
def test_places_that_take_no_file(folder, writer, place):
    words, ending, _ = WRITERS[writer]
    if writer.startswith(("study", "compare")) and place == "/dev/full":
        pytest.skip("the ending of its file says what is written")
    there = sorted(os.listdir(folder))
    name = place + ("" if place == "/dev/full" else ending)
    check(start(folder, [*words, name]), writer, name, "")
    assert sorted(os.listdir(folder)) == there


@pytest.mark.parametrize("writer", TAKEN)
@pytest.mark.parametrize("ignored", [False, True], ids=["default", "ignored"])
def test_a_limit_on_file_sizes(folder, writer, ignored):
    """Whether the signal of such a write is ignored when the program starts, or kills."""

    def limit_files():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN if ignored else signal.SIG_DFL)
        resource.setrlimit(resource.RLIMIT_FSIZE, (64, resource.RLIM_INFINITY))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    words, ending, _ = WRITERS[writer]
    (folder / ("out" + ending)).write_text("precious")
    there = sorted(os.listdir(folder))
    check(start(folder, [*words, "out" + ending], preexec=limit_files), writer, "out" + ending, "File too large")
    assert (folder / ("out" + ending)).read_text() == "precious"
    assert sorted(os.listdir(folder)) == there


# ---- separate file systems ----

# The folder "disk" with the older file is mounted by the first words; its remaining files go to "left".
MOUNTED = """
%s
name=$1; shift
"$@"; code=$?
mkdir left && cp disk/* left
exit $code
"""
FULL = MOUNTED % """
mount -t tmpfs -o size=32k none disk && printf precious >disk/$1 || exit 99
dd if=/dev/zero of=disk/filler bs=4k 2>/dev/null"""
READ_ONLY = MOUNTED % """
printf precious >disk/$1
mount --bind disk disk && mount -o remount,bind,ro disk || exit 99"""


def namespace():
    """The words that give a command its own mounts; None if that is not allowed."""
    for flags in ["-rm", "-m"]:
        words = ["unshare", flags]
        try:
            if subprocess.run([*words, "mount", "-t", "tmpfs", "none", "/mnt"], capture_output=True, check=False).returncode == 0:
                return words
        except OSError:
            break
    return None


@pytest.fixture(name="alone", scope="module")
def fixture_alone():
    words = namespace()
    if words is None:
        pytest.skip("this system lets nobody mount a folder, by unshare(1)")
    return words


@pytest.mark.check
@pytest.mark.parametrize("script, reason", [(FULL, "No space left"), (READ_ONLY, "Read-only")], ids=["full", "read-only"])
@pytest.mark.parametrize("writer", TAKEN)
def test_a_disk(folder, alone, writer, script, reason):
    words, ending, _ = WRITERS[writer]
    name = "out" + ending
    (folder / "disk").mkdir()
    answer = start(folder, [*words, f"disk/{name}"], before=[*alone, "sh", "-c", script, "sh", name])
    assert answer.returncode != 99, answer.stderr
    check(answer, writer, f"disk/{name}", reason)
    left = folder / "left"
    assert sorted(os.listdir(left)) in [["filler", name], [name]]
    assert (left / name).read_text() == "precious"


# ---- standard output ----

SPEAKERS = {
    "run": ["run", "scene.json", *SHORT, "--json"],
    "run in words": ["run", "scene.json", *SHORT, "--final"],
    "compare": ["compare", "scene.json", *SHORT, "--methods", "verlet"],
    "study": [*STUDY, "--json"],
    "limit": [*LIMIT, "--json"],
    "why": ["why", "stiff.json"],
    "needs": NEEDS,
    "check": ["check", "scene.json"],
    "make": MAKE,
    "verify": ["verify", "seen.h5"],
    "view": ["view", "seen.h5", "-o", "page.html", "--json"],
    "--help": ["--help"],
    "--version": ["--version"],
    "--man": ["--man"],  # more than is buffered
    "--completion": ["--completion", "bash"],
    "a verb's --help": ["run", "--help"],
}


@pytest.mark.parametrize("words", list(SPEAKERS.values())[:: 5 if FEW else 1], ids=list(SPEAKERS)[:: 5 if FEW else 1])
def test_standard_output_that_is_full(folder, words):
    with open("/dev/full", "w", encoding="utf-8") as full:
        answer = start(folder, words, out=full)
    assert answer.returncode == 5
    assert "could not write to standard output: No space left on device" in answer.stderr


def test_a_file_is_whole_where_standard_output_is_full(folder):
    with open("/dev/full", "w", encoding="utf-8") as full:
        assert start(folder, ["run", "scene.json", *SHORT, "-o", "out.h5"], out=full).returncode == 5
    assert start(folder, ["verify", "out.h5"]).returncode == 0
    assert not [name for name in os.listdir(folder) if name.endswith((".part", ".checkpoint"))]


# ---- the order of calls ----

PART = "hooke-%016x.part"


def calls_of(folder, words):
    """(call, flags, mode, path, other) of every call that has to do with names of files; numbers in temporary names count
    up, each twice."""
    log = folder.parent / "calls"
    log.unlink(missing_ok=True)
    loaded = ["env", f"LD_PRELOAD={os.environ['HOOKE_CRASH']}", f"HOOKE_CRASH_CALLS={log}"]
    answer = start(folder, words, before=["timeout", "-s", "KILL", "20", *loaded])
    assert answer.returncode in (0, 4), answer.stderr
    rows = [line.split("\t") for line in log.read_text().splitlines() if ".gcda" not in line]
    return [(call, int(flags), int(mode), *map(os.path.basename, names)) for call, flags, mode, *names in rows]


def check_calls(folder, calls, older):
    """Every file that the call leaves is made under a name of its own, which no other file has and no link leads away
    from, and is on the disk before it takes its name, as is the name at the end. Until then nobody else may read it who
    could not read the file of before."""
    made = [(k, path) for k, (call, flags, _, path, _) in enumerate(calls) if call == "open" and flags & os.O_CREAT]
    taken = {other: k for k, (call, _, _, path, other) in enumerate(calls) if call == "rename"}
    assert taken and all(re.fullmatch(r"hooke-\w{16}\.part", path) for _, path in made), calls
    for name, at in taken.items():
        part = calls[at][3]
        begun = max(k for k, path in made if path == part and k < at)  # a name is free again after its file took another
        assert calls[begun][1] & (os.O_EXCL | os.O_NOFOLLOW) == os.O_EXCL | os.O_NOFOLLOW, name
        own = [(call, k) for k, (call, _, _, path, _) in enumerate(calls[begun:at]) if path == part and call in ("write", "fsync")]
        assert own and own[-1][0] == "fsync", (name, own)
        assert calls[at + 1][::3] == ("fsync", folder.name), name
        modes = [mode for call, _, mode, path, _ in calls[begun:at] if path == part and call in ("open", "fchmod")]
        assert name not in older or all(mode & ~older[name] == 0 for mode in modes), (name, modes)
    return set(taken)


@pytest.mark.skipif("HOOKE_CRASH" not in os.environ, reason="with a sanitizer no library may be loaded before it")
@pytest.mark.parametrize("writer", WRITERS)
def test_a_file_is_made_in_the_order_that_keeps_it(folder, writer):
    words, ending, _ = WRITERS[writer]
    (folder / "precious").write_text("precious")
    (folder / (PART % 0)).symlink_to("precious")
    (folder / (PART % 1)).symlink_to("nowhere")
    first = check_calls(folder, calls_of(folder, [*words, "out" + ending]), {})
    assert "out" + ending in first
    for name in first & set(os.listdir(folder)):
        (folder / name).chmod(0o600)
    older = dict.fromkeys(first & set(os.listdir(folder)), 0o600)
    assert check_calls(folder, calls_of(folder, [*words, "out" + ending]), older) == first
    assert all((folder / name).stat().st_mode & 0o777 == 0o600 for name in older)
    assert (folder / "precious").read_text() == "precious" and not (folder / "nowhere").exists()
