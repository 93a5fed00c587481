"""The names that users of the Python package and of the Fortran module write, one a line, with the names of what they take:
name(needed, may_be_left_out=). What is in brackets is what the caller has to write itself, and no other."""

import inspect
import os
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
BUILD = Path(os.environ.get("HOOKE_BUILD_DIR", ROOT / "build/release"))
MADE = ("FirstOrder", "Integrator", "Scene", "SecondOrder", "System")  # classes whose objects users make

sys.path[:0] = [str(BUILD / "python"), str(ROOT / "bindings/generate"), str(ROOT / "tests/fortran")]

# ---- Python ----


def taken(thing, is_method):
    """The parameters of a function, without those that it takes by place alone, such as self."""
    words, kinds = [], inspect.Parameter
    for parameter in list(inspect.signature(thing).parameters.values())[is_method:]:
        if parameter.kind is kinds.KEYWORD_ONLY and not any(word[0] == "*" for word in words):
            words.append("*")
        stars = {kinds.VAR_POSITIONAL: "*any", kinds.VAR_KEYWORD: "**any"}.get(parameter.kind)
        words.append(stars or parameter.name + "=" * (parameter.default is not kinds.empty))
    return f"({', '.join(words)})"


def of_class(cls):
    """Its members and those of its bases that are of the package, each as the class has it."""
    own = [base for base in cls.__mro__ if base.__module__.split(".")[0] == "hooke"]
    members = {name for base in own for name in (*vars(base), *vars(base).get("__annotations__", ()))}
    begins = [vars(base).get(name) for base in own for name in ("__init__", "_read")]
    for begin in begins:  # what objects have from their beginning
        if inspect.isfunction(begin) and begin.__code__.co_filename.endswith(".py"):
            members.update(re.findall(r"self\.(\w+)(?=(?:, self\.\w+)*(?:: [^=]+)? = )", inspect.getsource(begin)))
    for member in sorted(members):
        if not member.startswith("_"):
            value = inspect.getattr_static(cls, member, None)
            is_bound = isinstance(value, (classmethod, staticmethod))
            yield member + (taken(getattr(cls, member), not is_bound) if is_bound or inspect.isfunction(value) else "")


def public(module):
    own = [name for name, thing in vars(module).items() if getattr(thing, "__module__", "") == module.__name__]
    return sorted(getattr(module, "__all__", [name for name in own if not name.startswith("_")]))


def of_python():
    import hooke

    modules = [thing for name in public(hooke) if inspect.ismodule(thing := getattr(hooke, name))]
    for module in (hooke, *modules):
        for name in public(module):
            thing = getattr(module, name)
            called = inspect.isfunction(thing) or (inspect.isclass(thing) and name in MADE)
            yield f"{module.__name__}.{name}" + (taken(thing, False) if called else "")
            if inspect.isclass(thing):
                yield from (f"{module.__name__}.{name}.{member}" for member in of_class(thing))


# ---- Fortran ----

INNER = {"give_up", "keep", "lend", "refresh", "share", "take"}  # what the module's own parts call of each other


class Module:
    """What a user can see of a module: its types, by their bodies, and the arguments of its procedures."""

    def __init__(self, lines):
        self.types, self.arguments, self.optional, inside = {}, {}, {}, None
        for line in lines:
            if match := re.fullmatch(r"type(?!\()(.*?)(?:::| )\s*(\w+)", line):
                inside = self.types.setdefault(match[2], [match[1]])
            elif line.startswith("end type"):
                inside = None
            elif inside is not None:
                inside.append(line)
            elif match := re.fullmatch(r"(?:[\w*():,= ]+ )?(?:function|subroutine) (\w+)(?:\((.*?)\))?.*", line):
                if not line.startswith("end "):
                    name = match[1]
                    self.arguments[name], self.optional[name] = re.findall(r"\w+", match[2] or ""), set()
            elif "::" in line and "optional" in line.split("::")[0]:
                self.optional[name].update(re.findall(r"(\w+)(?:\([^)]*\))?", line.split("::")[1]))

    def taken(self, name, own):
        return [word + "=" * (word in self.optional[name]) for word in self.arguments[name][own:]]


def of_type(name, modules):
    """Components and procedures of a type and of those that it extends; its own come last."""
    module = next(module for module in modules if name in module.types)
    head, *body = module.types[name]
    parent, found = re.search(r"extends\((\w+)\)", head), {}
    if parent:
        found.update(of_type(parent[1], modules))
    is_private = False
    for line in body:
        if line in ("private", "contains"):
            is_private = line == "private"
        elif match := re.fullmatch(r"procedure(?:\((\w+)\), deferred)? :: (\w+)(?: => (\w+))?", line):
            words = ", ".join(module.taken(match[1] or match[3] or match[2], 1))
            found.update({match[2]: f"[{words}]" if match[1] else f"({words})"} if match[2] not in INNER else {})
        elif not is_private and "::" in line and not re.match("procedure|generic|final", line):
            found.update(dict.fromkeys(re.findall(r"(\w+)(?:\([^)]*\))?(?: => null\(\))?", line.split("::")[1]), ""))
    return found


def of_fortran():
    import interfaces

    files = [ROOT / "bindings/fortran/base.f90", ROOT / "bindings/fortran/handles.f90", *(BUILD / "fortran").glob("*.f90")]
    parts = [re.split(r"^end module.*$", file.read_text(encoding="utf-8"), flags=re.MULTILINE) for file in files]
    modules = [Module(interfaces.statements(text)) for texts in parts for text in texts]
    lines = interfaces.statements((BUILD / "fortran/hooke.f90").read_text(encoding="utf-8"))
    inside = dict(names for line in lines if line.startswith("use ") for names in re.findall(r"(\w+) => (\w+)", line))
    for name in (name for line in lines if line.startswith("public ::") for name in re.findall(r"\w+", line)[1:]):
        known = inside.get(name, name)
        home = [module for module in modules if known in module.arguments]
        yield name + (f"({', '.join(home[0].taken(known, 0))})" if home else "")
        if any(known in module.types for module in modules):
            yield from (f"{name}%{member}{words}" for member, words in sorted(of_type(known, modules).items()))


# ---- what grows ----


def split(line):
    """(name, what it takes, None if that is not called)"""
    name, bracket, inside = line.partition("(")
    return name, inside[:-1].split(", ") if bracket else None


def by_place(words):
    return [word.rstrip("=") for word in words[: words.index("*") if "*" in words else None] if word[:1] != "*"]


def takes_less(old, new):
    """Whether a call that was right with the words `old` may be wrong with the words `new`."""
    needed = {word for word in new if word[-1:] != "=" and word[:1] != "*"}
    return (not {word.rstrip("=") for word in old} <= {word.rstrip("=") for word in new} or not needed <= set(old)
            or by_place(new)[: len(by_place(old))] != by_place(old))


def lost(old, new):
    """Lines of `old` that no line of `new` answers: a name is gone, or takes less, or needs more."""
    now = dict(map(split, new))
    kept = {name for name, words in map(split, old) if name in now and (
        words is None or (now[name] is not None and not takes_less(words, now[name])))}
    return [line for line in old if split(line)[0] not in kept]
