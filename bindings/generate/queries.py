"""Fortran procedures that only pass numbers, texts, lists of particles, objects and callbacks, and make objects. A type
that extends hooke_system_queries has one for every C function hooke_system_<name>() with such arguments and results
that no hand-written procedure calls; functions without an object are procedures of the module
hooke_queries_of_library."""

import re

import callbacks
import guard
import headers

COUNTS = {"count", "size", "steps", "stride"}  # other whole numbers are indices, and count from 1 in Fortran
SIMPLE = {"double", "int32_t", "int64_t", "const char *"}
RESULTS = {"int32_t", "int64_t", "double", "const char *", "void"}
# Types of Fortran that are another one in C: their functions are those with their names.
IN_C = {"hooke_estimate": "hooke_measurement", "hooke_view": "hooke_measurement"}
# Functions of C that belong to a type by another name than theirs, and their names there.
BELONG = {
    "hooke_checkpoint_read": ("hooke_integrator", "read_checkpoint"),
    "hooke_checkpoint_write": ("hooke_integrator", "write_checkpoint"),
    "hooke_mesh_read": ("hooke_options", "read_mesh"),
    "hooke_scene_options_apply": ("hooke_system", "apply"),
    "hooke_scene_write": ("hooke_system", "write_scene"),
    "hooke_study_recommend": ("hooke_measurement", "recommend"),
    "hooke_verify_create": ("hooke_measurement", "create_verify"),
    "hooke_why_advice_apply": ("hooke_measurement", "advice_apply"),
    "hooke_why_create": ("hooke_measurement", "create_why"),
    "hooke_why_create_kept": ("hooke_measurement", "create_why_kept"),
}
ALSO = {("hooke_estimate", "hooke_measurement_on_progress")}  # and those that a type has of the other one
NTH = ("first", "second", "third", "fourth", "fifth")
# Arrays of a row for every particle of a system, by the names of their parameters.
ROWS = {"q", "v", "dq", "dv", "force", "acceleration", "out"}
# Lists of members, whose number is the parameter `count`, by the names of their parameters, with the particles of each.
LISTS = {"ends": 2, "tetrahedra": 4, "particles": 1}
# Parameters that have another name in Fortran.
RENAMED = {("hooke_checkpoint_read", "run"): "name", ("hooke_checkpoint_write", "run"): "name",
           ("hooke_method_name", "method"): "number", ("hooke_part_kind", "kind"): "number",
           ("hooke_system_acceleration", "acceleration"): "accelerations", ("hooke_system_force", "force"): "forces",
           ("hooke_system_derivative_product", "out"): "product"}
# Procedures of Fortran that ask a query of C for one word, by the names that they would have in C, with their results.
WORDS = {
    "hooke_system_spring_count": ("int64_t", "hooke_system_count", "springs"),
    "hooke_integrator_wall_seconds": ("double", "hooke_integrator_number", "wall_seconds"),
    "hooke_integrator_diverged_at": ("double", "hooke_integrator_number", "diverged_at"),
    "hooke_integrator_stop_value": ("int32_t", "hooke_integrator_count", "stop_value"),
    "hooke_trajectory_run": ("const char *", "hooke_trajectory_text", "run"),
    "hooke_trajectory_origin": ("const char *", "hooke_trajectory_text", "origin"),
    "hooke_scene_title": ("const char *", "hooke_scene_text", "title"),
    "hooke_scene_text": ("const char *", "hooke_scene_text", "text"),
    "hooke_record_frame_count": ("int64_t", "hooke_record_count", "frames"),
    "hooke_record_good_frame_count": ("int64_t", "hooke_record_count", "good_frames"),
}


def called(texts):
    """C functions, as c_<name>, that the modules use outside of their use statements."""
    lines = re.sub(r"&\s*\n\s*", " ", re.sub(r"!.*", "", "\n".join(texts))).splitlines()
    return {name for line in lines if not line.strip().startswith("use ") for name in re.findall(r"\bc_\w+", line)}


def belongs(name, types):
    """(type, name there) of a function of C; None if it belongs to no type of Fortran."""
    if name in BELONG:
        return BELONG[name]
    mine = [type_ for type_ in types if name.startswith(type_ + "_")]
    return (max(mine, key=len), name[len(max(mine, key=len)) + 1:]) if mine else (None, None)


def object_of(kind):
    """The type of an object that is passed; None for other parameters."""
    match = re.fullmatch(r"(?:const )?(hooke_\w+) \*", kind)
    return match.group(1) if match else None


class Parameter:
    """One of a function of C: its declaration in Fortran, what C is given for it, and what comes before the call."""

    def __init__(self, function, kind, what, own):
        name = function[1]
        optional, what = guard.is_optional(name, what), RENAMED.get((name, what), what)
        self.last = optional and kind == "const char *"
        self.what, self.locals, self.before, self.object = what, [], [], object_of(kind)
        self.rows = kind.endswith("double *")
        self.callback = callbacks.of_callback(self.object) if self.object else None
        if self.callback:
            self.object, self.passed = None, "callback%function, callback%data"
            self.declared = f"class({self.callback}), target, intent(inout){', optional' if optional else ''} :: {what}"
            self.locals = ["type(hooke_callback) :: callback"]
            self.before = [f"callback = callback_to(c_funloc(call_{self.callback[len('hooke_'):]}), {what})"]
        elif self.object:
            type_ = own if self.object == IN_C.get(own) else self.object
            absent = (guard.may_be_null(name, self.object) and not name.startswith("hooke_system_add_")
                      and (kind.startswith("const") or self.object != "hooke_options"))
            intent, self.object = "in" if kind.startswith("const") else "inout", type_
            self.declared = f"class({type_}_queries), intent({intent}){', optional' if absent else ''} :: {what}"
            self.passed = f"address_or_null({what})" if absent else f"{what}%address()"
        elif self.rows:
            intent = "in" if kind.startswith("const") else "inout"
            self.declared, self.passed = f"real(c_double), intent({intent}), contiguous :: {what}(:, :)", what
        elif kind == "const int64_t *":
            width = LISTS[what]
            self.declared, self.passed = f"integer, intent(in) :: {what}({':, :' if width > 1 else ':'})", f"zero_based({what})"
            if width > 1:
                refusal = f'  call refuse(hooke_bad_value, "{what} have the shape ({width}, n)", status)'
                self.before = [f"if (size({what}, 1) /= {width}) then", refusal, "  return", "end if"]
        elif kind == "double":
            self.declared, self.passed = f"real(c_double), intent(in) :: {what}", what
        elif self.last:
            self.declared, self.passed = f"character(*), intent(in), optional :: {what}", f"c_{what}"
            self.locals, self.before = [f"character(:), allocatable :: c_{what}"], [f"call to_c_if({what}, c_{what})"]
        elif kind == "const char *":
            self.declared, self.passed = f"character(*), intent(in) :: {what}", f"to_c({what})"
        else:
            self.declared = f"integer, intent(in) :: {what}"
            self.passed = f"int({what}, c_{kind})" if kind == "int32_t" or what in COUNTS else f"zero_based({what})"


def answer(result, name, whats):
    """(type, conversion from C) of the result of a function."""
    if result == "const char *":
        return "character(:), allocatable", "to_text({})"
    if result == "double":
        named = [what for what in whats if what in ("what", "column")]
        return "real(c_double)", f"to_number({{}}, {named[0]})" if named else "{}"
    if result == "int64_t":
        return ("integer", "to_integer({})") if name.endswith(("_count", "_size", "_springs")) else ("integer(c_int64_t)", "{}")
    return ("logical", "{} == 1") if "_is_" in name else ("integer", "int({})")


class Procedure:
    """A function of C as a procedure of the type `own`, or of none."""

    def __init__(self, function, own, every):
        self.result, self.name, parameters = function
        self.own, self.every, self.short = own, every, self.name[len("hooke_"):]
        self.makes = bool(parameters) and parameters[-1][0].endswith("**")
        takes_self = own and not self.makes
        self.self_ = next((kind for kind, _ in parameters if takes_self and object_of(kind) == IN_C.get(own, own)), None)
        members = next((what for kind, what in parameters if kind == "const int64_t *"), None)
        self.given, passed = [], []
        for kind, what in parameters:
            if kind == self.self_ and "self%address()" not in passed:
                passed.append("self%address()")
            elif members and what == "count":
                passed.append(f"size({members}, {min(LISTS[members], 2)}, c_int64_t)")
            elif not kind.endswith("**") and what != "ctx":
                self.given.append(Parameter(function, kind, what, own))
                passed.append(self.given[-1].passed)
        self.call = f"c_{self.short}({', '.join([*passed, *(['made'] if self.makes else [])])})"
        rows = ", ".join(f"{nth}={p.what}" for nth, p in zip(NTH, (p for p in self.given if p.rows)))
        status = ", status" if headers.is_status(self.result, self.name) else ""
        self.fit = [f"if (.not. are_3_by(int(self%particle_count(), c_int64_t){status}, {rows})) return"] if rows else []
        self.objects = [p.what for p in self.given if p.object]
        if any(p.object and "optional" not in p.declared for p in self.given):
            self.given.sort(key=lambda p: p.last)
        kept = any(p.callback for p in self.given)
        self.keep = f"call self%keep(callback, {10 + every.index(function)}, " if kept else None

    def taking(self):
        """Lines that take the object that is made."""
        owner = next((f", {p.what}" for p in self.given if p.object and p.object != "hooke_options"), "")
        return [f"code = {self.call}", f"if (code == 0) call self%take(made, {ender(self.own, self.every)[0]}{owner})"]

    def body(self):
        """(locals, statements) of a procedure that returns a status."""
        needed = [*(["self"] if self.own and not self.makes else []), *self.objects]
        body = [f"if (missing(status, {', '.join(needed)})) return"] if needed else []
        body += [*self.fit, *(line for p in self.given for line in p.before)]
        call, locals_ = self.call, []
        if self.makes:
            body += self.taking()
            call, locals_ = "code", ["type(c_ptr) :: made", "integer(c_int32_t) :: code"]
        return locals_, [*body, f"{self.keep}{call}, status)" if self.keep else f"call accept({call}, status)"]

    def lines(self):
        """The whole procedure."""
        whats, before = [p.what for p in self.given], [line for p in self.given for line in p.before]
        intent = "inout" if self.makes or not (self.self_ or "const").startswith("const") else "in"
        head = [f"class({self.own}_queries), intent({intent}) :: self"] if self.own else []
        head += [p.declared for p in self.given]
        first, kind, found = [line for p in self.given for line in p.locals], "subroutine", ""
        if headers.is_status(self.result, self.name):
            locals_, body = self.body()
            whats, head, first = [*whats, "status"], [*head, "integer, intent(out), optional :: status"], [*first, *locals_]
        elif self.result == "void":
            body = [*before, f"call {self.call}", *([f"{self.keep}0_c_int32_t)"] if self.keep else [])]
        else:
            of_result, made = answer(self.result, self.name, whats)
            kind, found, first = "function", " result(found)", [f"{of_result} :: found", *first]
            body = [*(["found = 0", *self.fit] if self.fit else []), *before, f"found = {made.format(self.call)}"]
        title = f"  {kind} {self.short}({', '.join([*(['self'] if self.own else []), *whats])}){found}"
        return [title, *(f"    {line}" for line in wrapped([*head, *first, *body])), f"  end {kind}", ""]


def ender(own, every):
    """The procedure that releases objects of a type, and its lines if it is made here: where closing one may fail."""
    of_type = (f"{IN_C.get(own, own)}_destroy", f"{own}_close")
    result, name, parameters = next(f for f in every if f[1] in of_type)
    short = name[len("hooke_"):]
    if result == "void":
        return f"c_{short}", []
    outcome = ", int(hooke_stopped, c_int32_t)" if len(parameters) > 1 else ""
    return f"abandon_{own[len('hooke_'):]}", [
        f"  subroutine abandon_{own[len('hooke_'):]}(object) bind(c, name=\"\")", "    type(c_ptr), value :: object",
        "    integer(c_int32_t) :: code", f"    code = c_{short}(object{outcome})",
        "    if (code /= 0) return ! no status can be returned", "  end subroutine", ""]


def wrapped(lines):
    """Lines that are too long for Fortran, in two."""
    for line in lines:
        comma = line.rfind(", ", 0, 110) + 1
        yield line if len(line) < 120 else f"{line[:comma]} &\n      {line[comma + 1:]}"


def of_word(name):
    """One procedure of WORDS as lines."""
    result, query, word = WORDS[name]
    short, of = name[len("hooke_"):], "_".join(name.split("_")[:2])
    kind, made = answer(result, name, [])
    call = f'c_{query[len("hooke_"):]}(self%address(), to_c("{word}"))'
    return [f"  function {short}(self) result(found)", f"    class({of}_queries), intent(in) :: self",
            f"    {kind} :: found", f"    found = {made.format(call)}", "  end function", ""]


def is_query(function, type_, types, by_hand):
    """Whether a function of C is made a procedure of `type_`, or of no type."""
    result, name, parameters = function
    kinds = [kind for kind, what in parameters
             if what != "ctx" and not (type_ == "hooke_system" and kind.endswith("double *") and what in ROWS)
             and not (kind == "const int64_t *" and what in LISTS)]
    makes = bool(kinds) and kinds[-1].endswith("**")
    made = makes and object_of(kinds.pop()[:-1]) == IN_C.get(type_, type_)
    known = {*types, *IN_C.values()}
    plain = all(kind in SIMPLE or object_of(kind) in known or callbacks.of_callback(object_of(kind) or "") for kind in kinds)
    mine = belongs(name, types)[0] == type_ or (type_, name) in ALSO
    if type_ is None:
        mine = not any(object_of(kind) for kind in kinds)
    elif not makes:
        mine = mine and IN_C.get(type_, type_) in [object_of(kind) for kind in kinds]
    return (mine and plain and made == makes and result in RESULTS and name not in WORDS
            and not name.endswith(("_destroy", "_close")) and "c_" + name[len("hooke_"):] not in by_hand)


def of_type(type_, named, names, ended):
    """A type with its procedures, and the assignment that makes another reference to the same object."""
    bound = [f"    procedure :: {short} => {name[len('hooke_'):]}" for name, short in names]
    return [f"  public :: {', '.join([f'{type_}_queries', *ended])}", "",
            f"  type, extends(hooke_handle) :: {type_}_queries", "  contains", *bound,
            f"    procedure, private :: assign => assign_{named}", "    generic :: assignment(=) => assign", "  end type", "",
            "contains", "", f"  impure elemental subroutine assign_{named}(self, other)",
            f"    class({type_}_queries), intent(inout) :: self", f"    class({type_}_queries), intent(in) :: other",
            "    call self%share(other)", "  end subroutine", ""]


def module(type_, types, public, by_hand):
    """The module of one type, or of the functions without an object."""
    every = [f for text in public.values() for f in headers.declared(text)]
    found = {header: [f for f in headers.declared(text) if is_query(f, type_, types, by_hand)] for header, text in public.items()}
    functions = [f for fs in found.values() for f in fs]
    words = [name for name in WORDS if type_ and name.startswith(type_ + "_")]
    names = [(name, belongs(name, types)[1]) for _, name, _ in functions] + [(name, name[len(type_) + 1:]) for name in words]
    headers_used = [*(header for header, fs in found.items() if fs)]
    lines = [line for f in functions for line in Procedure(f, type_, every).lines()]
    lines += [line for name in words for line in of_word(name)]
    text = "\n".join(lines)
    home = [header for header, t in public.items() if re.search(rf" {IN_C.get(type_, type_)}_(destroy|close)\(", t)]
    lines += ender(type_, every)[1] if type_ else []
    uses = [f"  use hooke_c_{header[:-2]}" for header in dict.fromkeys([*headers_used, *(home if type_ else [])])]
    others = sorted(set(re.findall(r"class\((hooke_\w+)_queries\)", text)) - {type_})
    uses += [f"  use hooke_queries_of_{other[len('hooke_'):]}, only: {other}_queries" for other in others]
    uses += [f"  use hooke_{which}" for which, row in callbacks.TYPES.items() if any(f"class({name})" in text for name in row)]
    named = (type_ or "hooke_library")[len("hooke_"):]
    ended = re.findall(r"^  subroutine (abandon_\w+)", "\n".join(lines), re.MULTILINE)
    own = of_type(type_, named, names, ended)
    free = [*(f"  public :: {name[len('hooke_'):]}" for name, _ in names), "", "contains", ""]
    who = type_ or "the library"
    return ["", f"! What {who} does as the functions of C of the same names; numbers of things count from 1 here.",
            f"module hooke_queries_of_{named}",
            "  use, intrinsic :: iso_c_binding, only: c_double, c_funloc, c_int32_t, c_int64_t, c_ptr",
            "  use hooke_base, only: accept, are_3_by, hooke_bad_value, hooke_stopped, refuse, to_c, to_c_if, to_integer, &",
            "    to_number, to_text, zero_based", *uses,
            "  use hooke_handles, only: address_or_null, callback_to, hooke_callback, hooke_handle, missing", "  implicit none",
            "  private", *(own if type_ else free), *lines, "end module"]


def modules(public, texts):
    """The texts of queries.f90 and queries_of_runs.f90, from {header: text} and the hand-written {file: text} in their
    order: observers, which the latter need, are made for states, which need the former."""
    types = re.findall(r"extends\((hooke_\w+)_queries\)", "\n".join(texts.values()))
    early = re.findall(r"extends\((hooke_\w+)_queries\)", "\n".join(list(texts.values())[:list(texts).index("states.f90") + 1]))
    by_hand = dict.fromkeys(types, called(texts.values()))
    # what estimates and views call of a measurement, hooke_measurement still needs, and users, what types call of the library
    by_hand["hooke_measurement"] = called([text for text in texts.values() if "hooke_measurement_queries" in text])
    by_hand[None] = called([texts["base.f90"]])
    head = "! Made from the headers in include/hooke by bindings/generate/queries.py."
    return {name: "\n".join([head, *(line for type_ in some for line in module(type_, types, public, by_hand[type_]))]) + "\n"
            for name, some in (("queries.f90", early), ("queries_of_runs.f90", [*types[len(early):], None]))}
