"""Fuzzing, driven.

    run.py --seconds 5 [TARGET...]         each target for so long, two side by side: the part of `make check`
    run.py --executions 1e7 [TARGET...]    a counted campaign; interrupted, it goes on where it was. With --quiet 60 it
                                           goes on after that until no new edge came for so many minutes of processor
    run.py --coverage [TARGET...]          lines of each target's own files that its inputs reach
    run.py --minimise [TARGET...]          inputs that a campaign came across into the archive, the fewest that reach as much

A target is tests/fuzz/fuzz_<name>.c. Its comment says which files are its own and how long inputs are at most. Committed are
<name>.dict, words of its inputs, and inputs/<name>.tar.xz (inputs.py), which holds corpus/, inputs to begin with, and found/,
inputs that were findings once. Where a target takes long for an input, campaign/ has more, which reach what the others leave
out and which campaigns alone begin with; --minimise then replaces these. What is reached in the sources of uncounted.txt is
not looked at.

A campaign works in build/fuzz: inputs in <name>/corpus, findings in <name>/found, and state.json. Two programs take turns:
one with all sanitizers, and one that is faster, without the one for addresses.
"""

import argparse
import fcntl
import glob
import itertools
import json
import os
import pathlib
import re
import shutil
import signal
import struct
import subprocess
import sys
import threading
import time

import inputs
import seeds

ROOT = pathlib.Path(__file__).resolve().parents[2]
HERE = ROOT / "tests" / "fuzz"
BUILD = ROOT / "build" / "fuzz"
STATE = BUILD / "state.json"
FIGURES = BUILD / "figures.json"
WARNINGS = "-Wno-pass-failed"
# Another folder of the preset with other flags; the preset's own has all sanitizers.
FLAGS = {
    "fuzz": None,
    "fuzz-fast": "-O2 -gline-tables-only -fsanitize-coverage=inline-8bit-counters,pc-table "
    f"-fsanitize-coverage-ignorelist={HERE / 'uncounted.txt'} -fsanitize=undefined,float-cast-overflow -fsanitize-trap=all {WARNINGS}",
    "fuzz-coverage": f"-O1 -fprofile-instr-generate -fcoverage-mapping {WARNINGS}",
}
# [s] of a turn, which begins with all inputs found before.
CHUNK = {"fuzz": 60, "fuzz-fast": 240}
TURNS = 4  # one of them with all sanitizers
SANITIZERS = {
    "ASAN_OPTIONS": "allocator_may_return_null=1:malloc_context_size=5:quarantine_size_mb=8:detect_stack_use_after_return=0",
    "UBSAN_OPTIONS": "print_stacktrace=1",
}


def build(folder):
    """The programs of a preset's folder; prints the compiler's errors."""
    if shutil.which("clang") is None:
        sys.exit("fuzzing is left out: there is no clang. On Debian:\n  apt-get install clang libclang-rt-dev")
    configure = ["cmake", "--preset", "fuzz", "-B", ROOT / "build" / folder]
    if FLAGS[folder]:
        # the loops as in a release, in one of the builds: sanitizers prevent vectorisation
        loops = "-O3;-fno-sanitize=all" if folder == "fuzz-fast" else "-O2"
        configure += [f"-DCMAKE_C_FLAGS={FLAGS[folder]}", f"-DHOOKE_KERNEL_OPTIMISATION={loops}", "-DHOOKE_KERNEL_COPIES=ON"]
    if folder == "fuzz-fast":  # libFuzzer does not intercept comparisons of libraries
        configure += ["-DCMAKE_EXE_LINKER_FLAGS=-Wl,--exclude-libs,ALL"]
    library, uncounted = ROOT / "build" / folder / "libhooke.a", HERE / "uncounted.txt"
    # clang does not tell the build which list it read
    anew = library.exists() and library.stat().st_mtime < uncounted.stat().st_mtime
    make = ["cmake", "--build", ROOT / "build" / folder, "--target", "hooke_fuzz"] + ["--clean-first"] * anew
    for command in configure, make:
        done = subprocess.run(command, cwd=ROOT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        if done.returncode:
            sys.exit(done.stdout[-8000:])


def all_targets():
    return sorted(path.stem.removeprefix("fuzz_") for path in HERE.glob("fuzz_*.c"))


class Target:
    def __init__(self, name):
        self.name = name
        source = HERE / f"fuzz_{name}.c"
        text = re.sub(r"\n \*", " ", source.read_text(encoding="utf-8"))
        lines = re.search(r"Lines of:([^:]*?)(?:Longest|\*/)", text)
        longest = re.search(r"Longest input: (\d+)(?:, mostly (\d+))?", text)
        self.files = sorted({f for p in (lines.group(1).split() if lines else []) for f in glob.glob(p, root_dir=ROOT)})
        self.longest = int(longest.group(1)) if longest else 4096
        self.mostly = int(longest.group(2)) if longest and longest.group(2) else self.longest
        self.words, self.work = HERE / f"{name}.dict", BUILD / name
        self.corpus, self.found, self.campaign = (inputs.unpack(name) / kind for kind in ("corpus", "found", "campaign"))

    def inputs(self):
        return [str(folder) for folder in (self.corpus, self.found) if folder.is_dir()]

    def campaign_inputs(self):
        return [str(self.work / "corpus"), *self.inputs(), *([str(self.campaign)] if self.campaign.is_dir() else [])]

    def program(self, folder):
        kind = "replay" if folder == "fuzz-coverage" else "fuzz"
        return str(ROOT / "build" / folder / "tests" / "fuzz" / f"{kind}_{self.name}")

    def command(self, folder, *more):
        (self.work / "found").mkdir(parents=True, exist_ok=True)
        words = [f"-dict={self.words}"] if self.words.exists() else []
        longest = self.mostly if folder == "fuzz-fast" else self.longest
        return [self.program(folder), f"-max_len={longest}", "-timeout=600", "-rss_limit_mb=2560", "-print_funcs=0", "-print_pcs=1", "-reload=0",
                f"-entropic={int(folder == 'fuzz')}",  # which favours rare features, and costs time
                f"-artifact_prefix={self.work / 'found'}/", "-print_final_stats=1", *words, *more]


class Tally:
    """Counters of a program in a file: executions, those past the syntax, accepted ones; and seconds of processor."""

    def __init__(self, path):
        self.path = path

    def look(self):
        try:
            *counts, nanoseconds = struct.unpack("4Q", self.path.read_bytes())
        except (OSError, struct.error):
            return [0, 0, 0, 0.0]
        return [*counts, nanoseconds / 1e9]

    def take(self):
        """The counters; resets them."""
        counted = self.look()
        self.path.unlink(missing_ok=True)
        return counted


def start(command, tally, **variables):
    environment = {**os.environ, **SANITIZERS, "HOOKE_FUZZ_TALLY": str(tally.path), **variables}
    return subprocess.Popen(command, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True,
                            errors="replace")


def findings(target):
    return sorted(str(p) for p in (target.work / "found").glob("*") if not p.name.startswith("slow-unit"))


# ---- a short run ----


def run_short(target, seconds, results):
    target.work.mkdir(parents=True, exist_ok=True)
    tally = Tally(target.work / "tally-short")
    tally.take()
    scratch = target.work / "short"
    shutil.rmtree(scratch, ignore_errors=True)
    scratch.mkdir(parents=True)
    process = start(target.command("fuzz", f"-max_total_time={seconds}", str(scratch), *target.inputs()), tally)
    _, log = process.communicate()
    code = process.returncode
    *counts, seconds_used = tally.take()
    edges = [int(m) for m in re.findall(r" cov: (\d+)", log)]
    results[target.name] = (code, log)
    share = 100 * counts[1] / max(counts[0], 1)
    print(f"fuzz/{target.name:10} {counts[0]:9} executions in {seconds_used:4.1f} s of processor, {share:3.0f} % past the syntax, "
          f"{edges[-1] if edges else 0} edges: {'finding' if code else 'nothing found'}", flush=True)


def short(targets, seconds):
    build("fuzz")
    results, waiting, lock = {}, list(targets), threading.Lock()

    def work():
        while True:
            with lock:
                if not waiting:
                    return
                target = waiting.pop(0)
            run_short(target, seconds, results)

    workers = [threading.Thread(target=work) for _ in range(2)]
    for worker in workers:
        worker.start()
    for worker in workers:
        worker.join()
    failed = {name: log for name, (code, log) in results.items() if code}
    for name, log in failed.items():
        print(f"\n== fuzz/{name}: a finding; keep its input: tests/fuzz/inputs.py add {name} FILE found/NAME\n{log[-6000:]}")
    return 1 if failed else 0


# ---- a counted campaign ----


def load_state():
    try:
        return json.loads(STATE.read_text())
    except (OSError, ValueError):
        return {}


class Campaign:
    def __init__(self, targets, executions, quiet, workers, limit):
        self.targets, self.wanted, self.quiet, self.workers = targets, executions, quiet, workers
        self.until = time.monotonic() + limit if limit else None
        self.state, self.lock, self.stop, self.commit = load_state(), threading.Lock(), False, commit()
        self.processes, self.tallies, self.turn = set(), {}, itertools.count()
        self.last_turn = time.monotonic()  # when it ended
        for target in targets:
            self.of(target)
            for left in target.work.glob("tally-*"):  # of a campaign that was interrupted
                self.add(target, "fuzz-fast" if "fast" in left.name else "fuzz", Tally(left).take())

    def of(self, target):
        return self.state.setdefault(target.name, {
            "executions": 0, "past_syntax": 0, "accepted": 0, "seconds": 0.0, "findings": [], "commits": {},
            "counting": {"seconds": 0.0, "wall_seconds": 0.0}, "edges": {}, "last_edge": {"executions": 0, "seconds": 0.0},
            "by_build": {b: {"executions": 0, "seconds": 0.0} for b in ("fuzz", "fuzz-fast")}})

    def save(self):
        new = STATE.with_suffix(".new")
        new.write_text(json.dumps(self.state, indent=1))
        new.replace(STATE)

    def add(self, target, folder, counted):
        state, now = self.of(target), time.monotonic()
        if state["executions"] < self.wanted(target):
            state["counting"]["seconds"] += counted[3]
            state["counting"]["wall_seconds"] += now - self.last_turn
        self.last_turn = now
        for name, count in zip(("executions", "past_syntax", "accepted", "seconds"), counted):
            state[name] += count
        state["by_build"][folder]["executions"] += counted[0]
        state["commits"][self.commit] = state["commits"].get(self.commit, 0) + counted[0]
        state["by_build"][folder]["seconds"] += counted[3]
        state["findings"] = findings(target)

    def see_edges(self, target, folder, edges, new):
        state = self.of(target)
        state["edges"][folder] = max(edges, state["edges"].get(folder, 0))
        if new:
            at_work = [tally.look() for tally, its in self.tallies.items() if its is target]
            state["last_edge"] = {"executions": state["executions"] + sum(look[0] for look in at_work),
                                  "seconds": state["seconds"] + sum(look[3] for look in at_work), "at": ", ".join(new[:4])}

    def is_done(self, target):
        return self.of(target)["executions"] >= self.wanted(target) and since_edge(self.of(target)) >= self.quiet

    def next(self):
        """The target that is furthest behind: in its count, then in the time without a new edge."""
        late = self.until is not None and time.monotonic() > self.until
        ahead = [t for t in self.targets if not self.is_done(t) and not self.of(t)["findings"]]
        if self.stop or late or not ahead:
            return None
        return min(ahead, key=lambda t: (min(1.0, self.of(t)["executions"] / self.wanted(t)), since_edge(self.of(t))))

    def follow(self, target, folder, process):
        """Reads the output of libFuzzer; returns its end. An edge is new if none of the initial inputs reached it."""
        tail, new = [], []
        for line in process.stderr:
            tail = [*tail[-200:], line]
            place = re.match(r"\s*NEW_PC: (.*)", line)
            if place:
                new.append(os.path.basename(place.group(1)))
            match = re.match(r"#\d+\s+\w+\s.*?cov: (\d+)", line)
            if match:
                with self.lock:
                    self.see_edges(target, folder, int(match.group(1)), new)
                new = []
        return "".join(tail)

    def work(self, number):
        while True:
            with self.lock:
                target = self.next()
                if target is None:
                    return
                turn = next(self.turn)
                folder = "fuzz" if turn % TURNS == 0 else "fuzz-fast"
                (target.work / "corpus").mkdir(parents=True, exist_ok=True)
                left = int(self.wanted(target) - self.of(target)["executions"])
                runs = left // self.workers + 10_000 if left > 0 else -1  # the others do as many
                tally = Tally(target.work / f"tally-{folder}-{number}")
                process = start(target.command(folder, f"-max_total_time={CHUNK[folder]}", f"-runs={runs}",
                                               *target.campaign_inputs()), tally, HOOKE_FUZZ_WHOLE="0")
                self.processes.add(process)
                self.tallies[tally] = target
            log = self.follow(target, folder, process)
            code = process.wait()
            with self.lock:
                self.processes.discard(process)
                del self.tallies[tally]
                self.add(target, folder, tally.take())
                self.save()
                if code and not self.stop:
                    print(f"== fuzz/{target.name}: a finding, or it broke off ({code})\n{log[-6000:]}", flush=True)
                    self.of(target)["findings"] = findings(target) or [f"exit code {code}"]
                    self.save()
                self.say(target)

    def say(self, target):
        state = self.of(target)
        print(f"{target.name:10} {state['executions']:>12} executions, {share(state):3.0f} % past the syntax, "
              f"{max(state['edges'].values(), default=0)} edges, the last new one "
              f"{since_edge(state):.0f} s ago at {state['last_edge'].get('at', 'an input to begin with')}", flush=True)

    def run(self):
        def interrupt(*_):
            self.stop = True
            for process in list(self.processes):
                process.terminate()

        signal.signal(signal.SIGINT, interrupt)
        signal.signal(signal.SIGTERM, interrupt)
        threads = [threading.Thread(target=self.work, args=(k,)) for k in range(self.workers)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()


def commit():
    """Digest of the sources, which the results name."""
    told = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=ROOT, capture_output=True, text=True).stdout
    return told.strip() or "unknown"


def since_edge(state):
    """Seconds of processor since the last new edge, over finished turns."""
    return max(0.0, state["seconds"] - state["last_edge"]["seconds"])


def share(state):
    return 100 * state["past_syntax"] / max(state["executions"], 1)


def campaign(targets, executions, quiet, workers, limit):
    BUILD.mkdir(parents=True, exist_ok=True)
    lock = (BUILD / "lock").open("w")  # until this returns
    try:
        fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        sys.exit("a campaign is at work already, and what it keeps in build/fuzz is for one at a time: start this one after it")
    for folder in "fuzz", "fuzz-fast":
        build(folder)
    many = Campaign(targets, lambda target: executions * (10 if target.name == "scene" else 1), quiet, workers, limit)
    many.run()
    for target in targets:  # everything found on the way, with every sanitizer
        once = subprocess.run(target.command("fuzz", "-runs=0", *target.campaign_inputs()),
                              env={**os.environ, **SANITIZERS}, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
        if once.returncode and not many.stop:
            many.of(target)["findings"] = findings(target) or ["the inputs gathered do not replay"]
    done = all(many.of(t)["executions"] >= many.wanted(t) for t in targets)
    found = [f for t in targets for f in many.of(t)["findings"]]
    write_figures(targets, many, {} if many.stop else coverage(targets))
    return 1 if found else 0 if done else 3


def write_figures(targets, many, lines):
    """Entry for docs/notes/reliability.md."""
    try:
        figures = json.loads(FIGURES.read_text())
    except (OSError, ValueError):
        figures = {"targets": {}}
    for target in targets:
        of = many.of(target)
        rates = {b: round(v["executions"] / v["seconds"]) for b, v in of["by_build"].items() if v["seconds"]}
        figures["targets"][target.name] = {
            "date": time.strftime("%Y-%m-%d"), "executions": of["executions"], "wanted": many.wanted(target), "past_syntax_percent": round(share(of), 1),
            "accepted_percent": round(100 * of["accepted"] / max(of["executions"], 1), 1), "edges": of["edges"],
            "seconds": round(of["counting"]["wall_seconds"]), "processor_seconds": round(of["counting"]["seconds"]),
            "executions_per_second": rates,
            "commits": of["commits"], "seconds_since_last_edge": round(since_edge(of)),
            "executions_since_last_edge": of["executions"] - of["last_edge"]["executions"],
            "findings": len(of["findings"]), "lines": lines.get(target.name, {})}
    FIGURES.write_text(json.dumps(figures, indent=1))
    print(FIGURES)


# ---- lines reached ----


def coverage(targets):
    """Lines of each target's own files: {target: {"covered": n, "count": n, "percent": p, "files": {...}}}."""
    build("fuzz-coverage")
    result = {}
    for target in targets:
        target.work.mkdir(parents=True, exist_ok=True)
        raw, data = target.work / "lines.profraw", target.work / "lines.profdata"
        subprocess.run([target.program("fuzz-coverage"), *target.campaign_inputs()], env={**os.environ, "LLVM_PROFILE_FILE": str(raw)},
                       check=True, stdout=subprocess.DEVNULL)
        tools = [shutil.which(f"{tool}-14") or tool for tool in ("llvm-profdata", "llvm-cov")]
        subprocess.run([tools[0], "merge", "-sparse", str(raw), "-o", str(data)], check=True)
        told = subprocess.run([tools[1], "export", "-summary-only", f"-instr-profile={data}", target.program("fuzz-coverage")],
                              check=True, capture_output=True, text=True).stdout
        summary = {os.path.relpath(ROOT / "build" / "fuzz-coverage" / f["filename"], ROOT): f["summary"]["lines"]
                   for f in json.loads(told)["data"][0]["files"]}
        files = {f: summary[f] for f in target.files if f in summary}
        covered, count = (sum(f[key] for f in files.values()) for key in ("covered", "count"))
        result[target.name] = {"covered": covered, "count": count, "percent": round(100 * covered / max(count, 1), 1),
                               "files": {f: round(s["percent"], 1) for f, s in files.items()}}
    return result


def tell_coverage(targets):
    for name, lines in coverage(targets).items():
        print(f"{name}: {lines['covered']} of {lines['count']} lines, {lines['percent']} %")
        for file, percent in lines["files"].items():
            print(f"  {percent:6.1f} %  {file}")
    return 0


# ---- the committed inputs ----


def merge(target, folder, into, *sources, **variables):
    """Copies inputs that reach code which those in `into` do not; small ones come first."""
    subprocess.run(target.command(folder, "-merge=1", "-use_counters=0", str(into), *(str(f) for f in sources if f.is_dir())),
                   check=True, env={**os.environ, **SANITIZERS, **variables}, stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)


def minimise(targets):
    """The fewest inputs with the same coverage."""
    build("fuzz")
    seeds.make(BUILD / "seeds")
    for target in targets:
        new, kept = target.work / "minimised", "corpus"
        shutil.rmtree(new, ignore_errors=True)
        new.mkdir(parents=True)
        if target.campaign.is_dir():
            old = [file for folder in target.inputs() for file in pathlib.Path(folder).iterdir()]
            for file in old:
                shutil.copy(file, new)
            for folder in "fuzz", "fuzz-fast":  # whose kernels have other edges
                build(folder)
                merge(target, folder, new, target.campaign, target.work / "corpus", HOOKE_FUZZ_WHOLE="0")
            for file in old:
                (new / file.name).unlink()
            kept = "campaign"
        else:
            merge(target, "fuzz", new, BUILD / "seeds" / target.name, target.corpus, target.work / "corpus")
        others = {name: data for name, data in inputs.read(target.name).items() if not name.startswith(f"{kept}/")}
        inputs.write(target.name, others | {f"{kept}/{file.name}": file.read_bytes() for file in new.iterdir()})
    return 0


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("targets", nargs="*", metavar="TARGET")
    parser.add_argument("--seconds", type=int)
    parser.add_argument("--executions", type=float, help="of each target, ten times as many of scene")
    parser.add_argument("--quiet", type=float, default=0.0, help="minutes of processor without a new edge, besides")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--minutes", type=float, help="stop a campaign after so long, to go on another time")
    parser.add_argument("--coverage", action="store_true")
    parser.add_argument("--minimise", action="store_true")
    asked = parser.parse_args()
    unknown = set(asked.targets) - set(all_targets())
    if unknown:
        parser.error(f"no such target: {', '.join(sorted(unknown))}; there are {', '.join(all_targets())}")
    targets = [Target(name) for name in asked.targets or all_targets()]
    if asked.coverage:
        return tell_coverage(targets)
    if asked.minimise:
        return minimise(targets)
    if asked.executions:
        return campaign(targets, asked.executions, 60 * asked.quiet, asked.workers, asked.minutes and 60 * asked.minutes)
    return short(targets, asked.seconds or 5)


if __name__ == "__main__":
    sys.exit(main())
