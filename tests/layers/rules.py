"""The project's rules on includes, as functions from a file to a list of complaints."""

import re

# Folders of src/, and what each may include besides itself.
LAYERS = {
    "core": set(),
    "kernel": {"core"},
    "model": {"core", "kernel"},
    "parts": {"core", "kernel", "model"},
    "integrate": {"core", "kernel", "model"},
    "measure": {"core", "kernel", "model", "integrate"},
    "io": {"core", "kernel", "model", "parts", "integrate", "measure"},
    "guard": {"core", "kernel", "model", "parts", "integrate", "measure", "io"},
}

# The layer to which each public header belongs.
PUBLIC = {
    "hooke/base.h": "core",
    "hooke/options.h": "core",
    "hooke/system.h": "model",
    "hooke/state.h": "model",
    "hooke/parts.h": "parts",
    "hooke/integrator.h": "integrate",
    "hooke/measurement.h": "measure",
    "hooke/estimate.h": "measure",
    "hooke/scene.h": "io",
    "hooke/trajectory.h": "io",
    "hooke/checkpoint.h": "io",
}

# Third-party headers, and the only files that may include them, directly or through a header of their own.
FENCES = [
    (r"jansson\.h", r"tests/fuzz/mutate_\w+\.c"),
    (r"(hdf5(_hl)?|H5\w+)\.h", r"src/io/\w+/\w+_h5\.[ch]|tests/fuzz/\w+_h5\.[ch]"),
    (r"(arkode|cvode|nvector|sundials|sunlinsol|sunmatrix|sunnonlinsol)/.*",
     r"src/integrate/\w+/(arkode|cvode|sundials)\w*\.[ch]|examples/ranks/cvode_ranks\.c"),
    (r"mpi\.h", r"(examples/ranks|tests/mpi)/\w+\.[ch]"),
    (r"cholmod\.h", r"src/integrate/solve/\w+_cholmod\.c"),
    (r"lapacke?\w*\.h", r"src/measure/spectrum/eigen/\w+_lapack\.c"),
    (r"gsl/.*", r"src/integrate/method/\w+_gsl\.c|tests/(physics|support)/\w+\.c"),
    (r"execinfo\.h", r"tests/fault/(process_faults|places)\.c"),  # of glibc
    (r"sys/syscall\.h", r"tests/crash/crash\.c"),  # of Linux
    (r"malloc\.h", r"cli/os/os_posix\.c|src/core/os/os_windows\.c|tests/physics/test_scale\.c|tests/long/\w+\.c"),
    (r"(io|psapi|shellapi|windows)\.h", r"(src/core|cli)/os/os_\w*windows\.c"),
    (r"(dirent|dlfcn|fcntl|langinfo|spawn|sys/\w+|termios)\.h",
     r"(src/core|cli)/os/os_\w*(posix|windows|folder)\.c|(?!src/|cli/).*"),
    (r"cmocka\.h", r"tests/(support|unit|physics|determinism|guest|fault)/\w+\.[ch]"),
]

# Fortran functions, which need no header, and the only files that may call them.
CALLS = [(r"\b[dz](ge|st|sy|he|or)\w+_\s*\(", r"src/measure/spectrum/eigen/\w+_lapack\.c")]

# Headers of C17, POSIX, Linux and the compiler.
STANDARD = set(
    "assert complex ctype errno fenv float inttypes iso646 limits locale math setjmp signal stdalign stdarg stdatomic "
    "stdbool stddef stdint stdio stdlib stdnoreturn string tgmath threads time uchar wchar wctype "
    "dirent dlfcn fcntl langinfo libgen pthread sched strings termios unistd "
    "sys/file sys/inotify sys/ioctl sys/mman sys/random sys/resource sys/stat sys/time sys/types sys/utsname sys/wait "
    "getopt spawn cpuid immintrin".split()
)

# Folders that use the library like a user.
OUTSIDE = ("cli/", "bench/", "examples/", "tests/cli/", "tests/crash/", "tests/physics/", "tests/determinism/", "tests/guest/",
           "tests/fault/", "tests/support/", "tests/abi/", "tests/fortran/", "bindings/")
# The one file there that measures the insides.
INSIDE = "bench/costs.c"

LINE_LIMIT = 800
INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^">]+)[">]', re.MULTILINE)
LAZY_NAME = re.compile(r"(^|_)(util|utils|misc|common|helper|helpers)(_|\.|$)")


def without_comments(text):
    """The text with comments blanked out, line numbers kept. Strings that look like comments do not occur."""
    return re.sub(r"/\*.*?\*/|//[^\n]*", lambda m: re.sub(r"[^\n]", " ", m.group()), text, flags=re.DOTALL)


def includes(text):
    clean = without_comments(text)
    for match in INCLUDE.finditer(clean):
        yield clean.count("\n", 0, match.start()) + 1, match.group(1) == "<", match.group(2)


def angle_complaint(path, name):
    for pattern, allowed in FENCES:
        if re.fullmatch(pattern, name):
            return None if re.fullmatch(allowed, path) else f"<{name}> is fenced into {allowed}"
    if name.removesuffix(".h") in STANDARD and name.endswith(".h"):
        return None
    return f"<{name}> is neither a standard header nor behind a fence"


def library_complaint(path, name):
    """`path` in src/, `name` between quotes."""
    layer = path.split("/")[1]
    allowed = LAYERS.get(layer)
    if allowed is None:
        return f"src/{layer} is not a layer"
    if name in PUBLIC:
        other = PUBLIC[name]
    elif name.startswith("hooke"):
        return f'"{name}" is not a public header that the library may include'
    else:
        other = name.split("/")[0]
        if "/" not in name or other not in LAYERS:
            return f'"{name}" should name its folder in src/, as in "core/status.h"'
    if other != layer and other not in allowed:
        return f'"{name}" is of layer {other}, which {layer} may not see'
    return None


def outside_complaint(path, name):
    if name == "hooke.h" or name in PUBLIC:
        return None
    if "/" not in name:  # a neighbour, or a header of tests/support
        return None
    return f'"{name}": only include/ may be seen from here'


def public_complaint(name):
    return None if "hooke/" + name in PUBLIC else f'"{name}": a public header includes its siblings alone'


def include_complaints(path, text):
    """Faults in the includes of the file at `path`, relative to the project."""
    found = []
    for line, angle, name in includes(text):
        if path.startswith("tests/") and re.fullmatch(r"\.\./data/\w+\.inc", name):
            complaint = None
        elif ".." in name or name.endswith(".c"):
            complaint = f'"{name}": no parent folders and no .c files'
        elif path.startswith("include/"):
            if angle:
                complaint = None if name == "stdint.h" else f"<{name}>: a public header needs <stdint.h> alone"
            elif path == "include/hooke.h":
                complaint = None if name in PUBLIC else f'"{name}" is not a public header'
            else:
                complaint = public_complaint(name)
        elif angle and not (path.startswith(OUTSIDE) and (name == "hooke.h" or name in PUBLIC)):
            complaint = angle_complaint(path, name)
        elif path.startswith("src/"):
            complaint = library_complaint(path, name)
        elif path.startswith(OUTSIDE) and path != INSIDE:
            complaint = outside_complaint(path, name)
        else:  # INSIDE, tests/unit and tests/fuzz see everything
            complaint = None
        if complaint:
            found.append(f"{path}:{line}: {complaint}")
    return found


def call_complaints(path, text):
    """Calls past a fence that no header guards."""
    clean = without_comments(text)
    return [f"{path}: {call.group()} is fenced into {allowed}"
            for pattern, allowed in CALLS if path.startswith(("src/", "cli/")) and not re.fullmatch(allowed, path)
            for call in re.finditer(pattern, clean)]


# Numbers with a fraction are printed by functions that ignore the caller's locale.
PRINTED = re.compile(r'\b(?:v?s(?:n)?printf|fprintf)\s*\((?:[^;"]|"(?:[^"\\]|\\.)*")*?;', re.DOTALL)
FRACTION = re.compile(r"%[-+ 0#]*(?:\d+|\*)?(?:\.(?:\d+|\*))?l?[aefg]")


def locale_complaints(path, text):
    """Numbers printed in the caller's locale; `path` in src/."""
    if not path.startswith("src/") or path in ("src/core/print.c", "src/core/number.c"):
        return []
    clean = without_comments(text)
    return [f"{path}:{clean.count(chr(10), 0, call.start()) + 1}: take hk_print() for numbers with a fraction"
            for call in PRINTED.finditer(clean) if FRACTION.search(call.group().replace("%%", ""))]


# What asks which system or C library this is.
SYSTEM = re.compile(r"\b(_GNU_SOURCE|_WIN32|WIN32|__MINGW\w+|_MSC_VER|__APPLE__|__linux__|__unix__|__GLIBC__|__EMSCRIPTEN__)\b")


def system_complaints(path, text):
    """Files of the library and the program that differ between systems, past the fence around those."""
    if not path.startswith(("src/", "cli/")) or re.fullmatch(r"(src/core|cli)/os/os_\w*(posix|windows|folder)\.c", path):
        return []
    clean = without_comments(text)
    return [f"{path}:{clean.count(chr(10), 0, word.start()) + 1}: {word.group()} belongs into src/core/os or cli/os"
            for word in SYSTEM.finditer(clean)]


def leak_complaints(files):
    """Headers that bring a third-party header to a file outside its fence; `files` is {path: text}."""
    found = []
    for header, text in files.items():
        if not header.startswith("src/") or not header.endswith(".h"):
            continue
        for fence in {f for _, angle, name in includes(text) if angle for p, f in FENCES if re.fullmatch(p, name)}:
            for path, other in files.items():
                sees = any("src/" + name == header for _, angle, name in includes(other) if not angle)
                if sees and not re.fullmatch(fence, path):
                    found.append(f'{path}: "{header[4:]}" is fenced into {fence}')
    return found


# What the program shares between its files: at the left edge, with a body or a value.
SHARED = re.compile(r"^(?!static|extern|typedef)\w[\w *]*?\b(cli_\w+)(?=[\[(]| =)[^;{]*\{", re.MULTILINE)


def circle_complaints(files):
    """Sources of the program of which each needs the others; `files` is {path: text}."""
    clean = {path: re.sub(r'"(?:[^"\\\n]|\\.)*"', '""', without_comments(text)) for path, text in files.items()}
    home = {name: path for path, text in clean.items() for name in SHARED.findall(text)}
    needs = {path: {home.get(name, path) for name in re.findall(r"\bcli_\w+", text)} - {path} for path, text in clean.items()}
    while aside := [path for path in needs if not needs[path] or path not in set().union(*needs.values())]:
        needs = {path: others.difference(aside) for path, others in needs.items() if path not in aside}
    return [f"{path} is in a circle, or between two, by {', '.join(sorted(others))}" for path, others in sorted(needs.items())]


def shape_complaints(path, text):
    """Faults in a file's size, name or leftovers."""
    found = []
    lines = text.count("\n")
    if lines > LINE_LIMIT:
        found.append(f"{path}: {lines} lines, more than {LINE_LIMIT}: split it")
    if LAZY_NAME.search(path.rsplit("/", 1)[-1]):
        found.append(f"{path}: the name does not say what is in it")
    for number, line in enumerate(text.splitlines(), 1):
        if re.search(r"\b(TO" r"DO|FIX" r"ME)\b", line):
            found.append(f"{path}:{number}: unfinished")
    return found
