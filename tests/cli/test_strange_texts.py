"""Every string of a scene, of a trajectory and of a checkpoint, in turn and together, with characters that steer a
terminal or end the script of a page, in front of every verb: none of them comes out raw, none makes a line of its own,
and none is markup in a page."""

import copy
import json
import re
import shutil
import subprocess
import zlib
from concurrent.futures import ThreadPoolExecutor

import h5py
import pytest
from conftest import CLI, STIFF_PAIR
from pages import VERSION

pytestmark = pytest.mark.everything

STRANGE = "\x1b]0;owned\x07\nforged\x9b2J\u202e</script><b>"
RAW = re.compile("[\0-\x09\x0b-\x1f\x7f-\x9f\u202e]|^ *forged", re.M)

VERBS = re.search("verbs:\n(.*?)\n\n", subprocess.run([CLI, "--help"], capture_output=True, text=True).stdout, re.S)[1]
VERBS = [line.split()[0] for line in VERBS.splitlines() if line.split()[0] != "make"]  # which reads no file
HELP = {verb: subprocess.run([CLI, verb, "--help"], capture_output=True, text=True).stdout for verb in VERBS}
PAGES = {**{verb: "--report" for verb in VERBS if "--report" in HELP[verb]}, "view": "-o"}
WRITES = not re.search(r"\.js +not in this build", VERSION)  # pages
WORDS = {
    "run": ["--no-why"],
    "compare": ["--methods", "verlet"],
    "study": ["--methods", "verlet", "--points", "6"],
    "limit": ["--methods", "verlet", "--predict"],
    "needs": ["--want", "1m"],
}

SCENE = {
    "hooke": 1,
    "title": "a pair",
    "dynamics": "inertial",
    "particles": {"position": [[0, 0, 0], [1.1, 0, 0], [2, 0, 0]], "mass": 1},
    "springs": [{"name": "tie", "between": [[0, 1]], "law": "length", "stiffness": 1000, "rest_length": "initial"}],
    "bending": [{"name": "rib", "triples": [[0, 1, 2]], "coefficient": 1}],
    "anchors": [{"name": "wall", "particles": [1], "points": "initial", "stiffness": 1}],
    "parts": [{"kind": "rope", "name": "line", "from": [0, 1, 0], "to": [1, 1, 0], "segments": 2, "mass": 1,
               "pinned": ["start"], "stretch": {"stiffness": 10}}],
    "bodies": [{"name": "stick", "particles": [1, 2]}],
    "driven": [{"particles": [0], "motion": "harmonic", "amplitude": [0, 0.01, 0], "frequency": 1}],
    "run": {"method": "verlet", "step": 0.005, "duration": 0.02, "every": 0.01},
}
FREE = {"title", "name"}  # keys whose texts may be anything


def call(folder, verb, file, *words):
    words = [*WORDS.get(verb, ()), *words]
    page = folder / f"{verb}{len(words)}-{file}.html"
    words += [PAGES[verb], page.name] if verb in PAGES else []
    done = subprocess.run([CLI, verb, file, *words], cwd=folder, capture_output=True, timeout=240)
    assert done.returncode >= 0, (verb, done.stderr)
    for text in (done.stdout.decode(), done.stderr.decode()):
        assert not RAW.search(text), (verb, file, words, text)
    if page.exists():
        shown = page.read_text("utf-8")
        assert not [tag for tag in ("</script><", "<b>") if tag in shown], (verb, file, words)
    return done


def pages_that_show_it(folder):
    return [page.name for page in folder.glob("*.html") if "owned" in page.read_text("utf-8")]


def each(calls):
    with ThreadPoolExecutor(2) as pool:
        return list(pool.map(lambda one: call(*one), calls))


def strings(node, path=()):
    """The places of all strings of a scene."""
    if isinstance(node, str):
        yield path
    inside = node.items() if isinstance(node, dict) else enumerate(node) if isinstance(node, list) else ()
    for key, value in inside:
        yield from strings(value, (*path, key))


def with_strange(node, path, key=False):
    node = copy.deepcopy(node)
    at = node
    for step in path[:-1]:
        at = at[step]
    if key:
        at[path[-1] + STRANGE] = at.pop(path[-1])
    else:
        at[path[-1]] += STRANGE
    return node


def test_scenes(tmp_path):
    named, calls = SCENE, []
    for k, path in enumerate(strings(SCENE)):
        if path[-1] in FREE:
            named = with_strange(named, path)
            continue
        (tmp_path / f"{k}.json").write_text(json.dumps(with_strange(SCENE, path)))
        calls.append((tmp_path, "check", f"{k}.json", *["--json"][: k % 2]))
        if isinstance(path[-1], str):
            (tmp_path / f"key{k}.json").write_text(json.dumps(with_strange(SCENE, path, key=True)))
            calls.append((tmp_path, "run", f"key{k}.json"))
    assert len(calls) > 12
    assert {done.returncode for done in each(calls)} == {3}
    (tmp_path / "named.json").write_text(json.dumps(named))
    calls = [(tmp_path, verb, "named.json", *words) for words in ([], ["--json"]) for verb in VERBS]
    calls.append((tmp_path, "why", "named.json", "--step", "0.2", "--every", "0.2", "--duration", "20"))
    done = each(calls)
    checked = [done[k].stdout for k in (VERBS.index("check"), len(VERBS) + VERBS.index("check"))]
    assert checked[0].count(b"?]0;owned?") > 3 and checked[1].count(rb"\u001b]0;owned\u0007") > 2
    assert {re.match("[a-z]+", page)[0] for page in pages_that_show_it(tmp_path)} == set(PAGES) or not WRITES


def texts(path):
    """Every string attribute and dataset of an HDF5 file."""
    found = []
    with h5py.File(path) as file:
        def see(name, thing):
            found.extend((name, key) for key, value in thing.attrs.items() if isinstance(value, str))
            if isinstance(thing, h5py.Dataset) and thing.dtype.kind in "SO":
                found.append((name, None))

        file.visititems(see)
    return found


def put(path, places):
    with h5py.File(path, "r+") as file:
        file.pop("hooke/file_check", None)
        for name, key in places:
            if key:
                file[name].attrs[key] += STRANGE
            elif name.endswith("/scene"):
                file[name][()] = file[name][()].replace(b"a pair", STRANGE.encode()[:6])
            else:
                text = file[name][()] + STRANGE.encode()
                del file[name]
                file[name] = text[:200]


def make_trajectories(folder):
    """whole.h5, and k.h5 with the k-th string changed; the places of all strings."""
    (folder / "scene.json").write_text(json.dumps({**SCENE, "bodies": []}))
    assert call(folder, "run", "scene.json", "-o", "whole.h5").returncode == 0
    places = texts(folder / "whole.h5")
    assert {("hooke", "method"), ("hooke", "run"), ("hooke/options", "method"), ("hooke/status", None)} <= set(places)
    for k, place in enumerate(places):
        put(shutil.copy(folder / "whole.h5", folder / f"{k}.h5"), [place])
    return places


def test_trajectories(tmp_path):
    places = make_trajectories(tmp_path)
    calls = [(tmp_path, "verify", f"{k}.h5") for k in range(len(places))]
    views = [(tmp_path, "view", f"{k}.h5") for k in range(len(places))]
    put(shutil.copy(tmp_path / "whole.h5", tmp_path / "all.h5"), places)
    put(shutil.copy(tmp_path / "whole.h5", tmp_path / "facts.h5"), [place for place in places if place[0] != "hooke/options"])
    for verb in VERBS:
        calls += [(tmp_path, verb, "all.h5"), (tmp_path, verb, "facts.h5"), (tmp_path, verb, "facts.h5", "--json")]
    calls += [(tmp_path, "run", "--resume", name) for name in ("all.h5", "facts.h5")]
    done = each(calls + views)
    assert {"view0"} == {page[:5] for page in pages_that_show_it(tmp_path)} or not WRITES
    first = dict(zip(places, done))
    assert b"sundials" in first["hooke", "sundials"].stdout.lower() and b"owned" in first["hooke", "sundials"].stdout
    assert b"owned" in first["hooke/options", "method"].stdout + first["hooke/options", "method"].stderr


@pytest.mark.check
def test_two_trajectories(tmp_path):
    places = make_trajectories(tmp_path)
    each([(tmp_path, "view", f"{k}.h5", "whole.h5") for k in range(len(places))])
    assert pages_that_show_it(tmp_path) or not WRITES


def test_checkpoints(tmp_path):
    scene = {**copy.deepcopy(STIFF_PAIR), "run": {"method": "verlet", "step": 1e-5, "duration": 100, "every": 10}}
    (tmp_path / "scene.json").write_text(json.dumps(scene))
    command = [CLI, "run", "scene.json", "-o", "out.h5", "--checkpoint", "0.1", "--quiet"]
    process = subprocess.Popen(command, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    path = tmp_path / "out.h5.checkpoint"
    while not path.exists():
        assert process.poll() is None
    process.kill()
    process.wait()
    whole, file = path.read_bytes(), (tmp_path / "out.h5").read_bytes()
    run = re.search(rb"[0-9a-f]{32}", whole)[0]
    for text in (b"verlet", run, b"hookeCKP"):
        for sealed in (True, False)[text == b"hookeCKP" :]:
            (tmp_path / "out.h5").write_bytes(file)
            (tmp_path / "out.h5.checkpoint.previous").unlink(missing_ok=True)
            changed = whole.replace(text, (3 * STRANGE.encode())[: len(text)])
            assert changed != whole and len(changed) == len(whole)
            path.write_bytes(changed[:-4] + zlib.crc32(changed[:-4]).to_bytes(4, "little") if sealed else changed)
            done = subprocess.Popen([CLI, "run", "--resume", "out.h5"], cwd=tmp_path, stdout=subprocess.PIPE,
                                    stderr=subprocess.PIPE)
            said = done.stderr.readline()
            done.kill()
            rest = b"".join(done.communicate())
            assert b"checkpoint" in said and not RAW.search((said + rest).decode()), said
