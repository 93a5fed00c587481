"""Fortran procedures that pass numbers, texts, lists, rows of particles, objects and callbacks on to the function of C of
the same name, or make objects. A type has those whose names begin with its own; the others are hooke_<name>()."""

import re
from collections import namedtuple

import callbacks
import guard
import headers

# Procedures that have another name than their function of C.
NAMES = {
    "checkpoint_read": "integrator_read_checkpoint", "checkpoint_write": "integrator_write_checkpoint",
    "io_own_process": "own_process", "mesh_read": "options_read_mesh", "mesh_set": "options_set_mesh",
    "system_take": "system_take_particles",
    "needs_lean": "measurement_lean", "needs_lean_particle": "measurement_lean_particle",
    "needs_lean_position": "measurement_lean_position", "needs_lean_run": "measurement_lean_run",
    "options_copy": "options_copy_to", "scene_options_apply": "system_apply", "scene_write": "system_write_scene",
    "state_copy": "state_copy_to", "step_bound": "system_step_bound", "study_recommend": "measurement_recommend",
    "verify_create": "measurement_create_verify",
    "verify_create_with": "measurement_create_verify_with", "why_advice_apply": "measurement_advice_apply",
    "why_create": "measurement_create_why", "why_create_kept": "measurement_create_why_kept",
}
# Further procedures of a function of C, and what they give it.
FURTHER = {
    "system_spring_count": ("system_count", {"what": "springs"}),
    "system_step_bounds": ("step_bound", {"method": None}),
    "integrator_wall_seconds": ("integrator_number", {"what": "wall_seconds"}),
    "integrator_diverged_at": ("integrator_number", {"what": "diverged_at"}),
    "integrator_stop_value": ("integrator_count", {"what": "stop_value"}),
    "estimate_number": ("measurement_number", {"table": "estimate", "row": 0}),
    "estimate_text": ("measurement_text", {"table": "estimate", "row": 0}),
    "estimate_watched": ("measurement_number", {"table": "watched"}),
    "estimate_on_progress": ("measurement_on_progress", {}),
    "view_number": ("measurement_number", {"table": "view", "row": 0}),
    "trajectory_run": ("trajectory_text", {"what": "run"}),
    "trajectory_origin": ("trajectory_text", {"what": "origin"}),
    "scene_title": ("scene_text", {"what": "title"}),
    "scene_text": ("scene_text", {"what": "text"}),
    "record_frame_count": ("record_count", {"what": "frames"}),
    "record_good_frame_count": ("record_count", {"what": "good_frames"}),
}
# Types of Fortran that are another one in C.
IN_C = {"hooke_estimate": "hooke_measurement", "hooke_view": "hooke_measurement"}
# Parameters that have another name in Fortran.
RENAMED = {
    "checkpoint_read.run": "name", "checkpoint_write.run": "name", "method_name.method": "number", "part_kind.kind": "number",
    "integrator_get.q": "position", "integrator_get.v": "velocity", "integrator_put.q": "position",
    "integrator_put.v": "velocity", "options_set_numbers.values": "value", "options_set_text.text": "value",
    "state_copy.to": "other", "system_with_force.with": "forced", "system_acceleration.acceleration": "accelerations",
    "system_force.force": "forces", "system_reaction.reaction": "reactions", "system_tension.tension": "tensions",
    "system_derivative_product.out": "product", "system_step_bounds.bound": "bounds",
    "estimate_number.column": "what", "estimate_watched.column": "what",
    "estimate_text.column": "what", "view_number.column": "what",
}
# Several results in one array.
PARTS = {"bound": "bound", "inertia": "mass inertia(3)", "motion": "point(3) quaternion(4) velocity(3) angular_momentum(3)",
         "place": "point(3) direction(3) radius"}
# Arrays that are allocated for results, with their sizes; whole numbers in them are indices, and C has rows of matrices.
MEMBERS = "max(self%count(force), 0)"
BLOCKS = ["3", "3", 'self%count("blocks")']
OUTPUTS = {
    "system_altitude_lengths.length": ['self%count("altitude")'], "system_anchor_points.points": ["3", 'self%count("anchors")'],
    "system_derivative_blocks.dfdq": BLOCKS, "system_derivative_blocks.dfdv": BLOCKS,
    "system_derivative_pattern.column": BLOCKS[2:], "system_derivative_pattern.row_start": ["self%particle_count() + 1"],
    "system_members.damping": [MEMBERS], "system_members.stiffness": [MEMBERS],
    "system_members.particles": ["int(c_member_particles(to_c(force)))", MEMBERS],
    "system_members.rest_length": [f'merge(7, 1, force == "altitude")*{MEMBERS}'],
    "system_step_bounds.bound": ["c_method_count()"], "system_compression.compression": ['self%count("springs")'],
    "system_tension.tension": ['self%count("springs")'],
}
WIDTHS = {"ends": 2, "triples": 3, "tetrahedra": 4, "triangles": 3}
# The forms of arrays by their names; others are lists.
ARRAYS = {
    **dict.fromkeys(["q", "v", "dq", "dv", "force", "acceleration", "reaction", "out", "position", "velocity", "displacement",
                     "vertices"], "rows"),
    **dict.fromkeys(headers.VECTORS, "vector"), **dict.fromkeys(WIDTHS, "members"), **dict.fromkeys(PARTS, "parts"),
}
# The forms of numbers; other whole numbers are indices, which count from 1 in Fortran.
DEFAULTS = ("phase", "project")
NEEDED = {("system_step_bound", "method")}  # although C takes NULL
NUMBERS = {**dict.fromkeys(["count", "size", "stride", "more", "rows", "columns"], "count"),
           **{what: what for what in ("frame", "step", "steps", *DEFAULTS)}}
# Endings of procedures whose results are default integers; the first two are indices.
DEFAULT_INTEGERS = ("_find", "_particle", "_count", "_size", "_springs", "_value", "_hold")
# Parameters that other ones stand for.
BY_OTHERS = {("void *", "ctx"), ("int64_t", "length"), ("hooke_force_product *", "product")}
SEVERAL = {"system_drive_callback"}  # callbacks that are kept beside those given before
RESULTS = {"int32_t", "int64_t", "double", "const char *", "const double *", "void"}


# How a parameter {w} is declared for users and, as {c}, inside; what comes before the call, after it, and first of all; what
# C is passed, and how many it has.
Form = namedtuple("Form", "declared inside before after first passed size", defaults=("", (), (), (), "", ""))


def refused(condition, message):
    return f"if ({condition}) then", f'  call refuse(hooke_bad_value, "{message}", status)', "  return", "end if"


ROW_COUNT = "size({w}, 2, c_int64_t)"
PLACE = "integer, intent(out){optional} :: {w}", "integer(c_int64_t) :: {c}(1)"
FORMS = {
    "callback": Form("class({type}), target, intent(inout){optional} :: {w}", "type(hooke_callback) :: callback",
                     ["callback = callback_to(c_funloc(call_{short}), {w})"], passed="callback%function"),
    "object": Form("class({type}), {intent} :: {w}", passed="{w}%address()"),
    "object?": Form("class({type}), {intent}, optional :: {w}", passed="address_or_null({w})"),
    "text": Form("character(*), intent(in) :: {w}", passed="to_c({w})"),
    "text?": Form("character(*), intent(in), optional :: {w}", "character(:), allocatable :: {c}",
                  ["if (present({w})) {c} = to_c({w})"]),
    "whole text": Form("character(*), intent(in) :: {w}"),
    "real": Form("real(c_double), intent(in) :: {w}"),
    "count": Form("integer, intent(in) :: {w}", passed="int({w}, c_{plain})"),
    "index": Form("integer, intent(in) :: {w}", passed="zero_based({w})"),
    "frame": Form("integer, intent(in) :: {w}", passed="int(merge({w} - 1, {w}, {w} > 0), c_int64_t)",
                  before=refused("{w} == 0", "frame 0: frames count from 1, from the end with -1")),
    # whole numbers that are not of the default kind, which a compiler may have made that of C's; there may be many steps
    "step": Form("integer(c_int64_t), intent(in) :: {w}"),
    "steps": Form("integer(c_{bits}_t), intent(in) :: {w}", passed="int({w}, c_int64_t)"),
    # numbers that are 0 where they are absent
    "phase": Form("real(c_double), intent(in), optional :: {w}", "real(c_double) :: {c}",
                  ["{c} = 0", "if (present({w})) {c} = {w}"]),
    "project": Form("logical, intent(in), optional :: {w}", "integer(c_int32_t) :: {c}",
                    ["{c} = 0", "if (present({w})) {c} = merge(1, 0, {w})"]),
    "vector": Form("real(c_double), intent(in) :: {w}(3)"),
    "list": Form("{kind}, intent(in) :: {w}(..)", "{in_c}, allocatable :: {c}(:)", ["call to_list({w}, {c})"],
                 size="ubound({c}, 1, c_int64_t)"),
    "members": Form("integer, intent(in) :: {w}(:, :)", passed="zero_based({w})", size=ROW_COUNT,
                    before=refused("size({w}, 1) /= {width}", "{w} have the shape ({width}, n)")),
    "rows": Form("real(c_double), {intent}, contiguous :: {w}(:, :)", size=ROW_COUNT),
    # passed on as a pointer to nothing: of an array that is not there the bounds would be computed
    "rows?": Form("real(c_double), {intent}, contiguous, target, optional :: {w}(:, :)",
                  "real(c_double), pointer, contiguous :: {c}(:, :)",
                  ["{c} => null()", "if (present({w})) {c} => {w}"], size=ROW_COUNT),
    "output": Form("{kind}, allocatable, intent(out){optional} :: {w}({colons})", "{in_c}, allocatable :: {c}({colons})",
                   ["allocate ({c}({sizes}), source={zero})"], ["{there}{w} = {found}"]),
    "count's place": Form(*PLACE, after=["{there}{w} = int({c}(1))"], first=["{there}{w} = 0", "{c} = 0"]),
    "index's place": Form(*PLACE, after=["{there}{w} = int({c}(1)) + 1"], first=["{there}{w} = 0", "{c} = -1"]),
}
# What forms say of whole numbers, and of others.
INDICES = {"kind": "integer", "in_c": "integer(c_int64_t)", "zero": "0_c_int64_t", "found": "int({c}) + 1"}
REALS = {"kind": "real(c_double)", "in_c": "real(c_double)", "zero": "0.0_c_double", "found": "{c}"}


def form_of_parts(parts):
    """(names, form) of several results in one array."""
    names, sizes = zip(*((name, int(size or 0)) for name, size in re.findall(r"([a-z_]+)(?:\((\d)\))?", parts)))
    ends = [sum(max(size, 1) for size in sizes[:k + 1]) for k in range(len(sizes))]
    after = [f"{name} = {{c}}({f'{end - size + 1}:' * bool(size)}{end})" for name, size, end in zip(names, sizes, ends)]
    return names, Form(f"real(c_double), intent(out) :: {', '.join(parts.split())}", f"real(c_double) :: {{c}}({ends[-1]})",
                       after=after, first=[f"{name} = 0" for name in [*names, "{c}"]])


class Parameter:
    """One of a procedure. By `rank` those that may be absent come after the others, and behind the status."""

    def __init__(self, of, kind, what):
        type_, sizes = headers.object_of(kind), OUTPUTS.get(f"{of.name}.{what}", ())
        self.kind, self.what = kind, RENAMED.get(f"{of.name}.{what}") or RENAMED.get(f"{of.c_name}.{what}", what)
        self.callback = callbacks.of_callback(type_ or "", of.c_name)
        self.object = None if self.callback else of.own if type_ and type_ == IN_C.get(of.own) else type_
        # NULL or 0 then
        self.optional = (guard.is_optional(f"hooke_{of.c_name}", what) or what in DEFAULTS) and (of.name, what) not in NEEDED
        if self.object:
            self.optional = (guard.may_be_null(f"hooke_{of.c_name}", type_) and not of.c_name.startswith("system_add_")
                             and (kind.startswith("const") or type_ != "hooke_options"))
        self.form = self.name_of_form(of, what, bool(sizes))
        self.names, form = form_of_parts(PARTS[what]) if self.form == "parts" else ([self.what], FORMS[self.form])
        type_ = self.callback or self.object or ""
        words = {**(INDICES if "int64" in kind else REALS), "w": self.what, "c": f"c_{self.what}", "type": type_,
                 "short": headers.short(type_), "plain": kind, "bits": of.bits, "width": WIDTHS.get(what),
                 "intent": f"intent({'in' if kind.startswith('const') else 'inout'})", "optional": ", optional" * self.optional,
                 "there": f"if (present({self.what})) " * self.optional, "colons": ", ".join(":" * len(sizes)),
                 "sizes": ", ".join(sizes)}
        words["found"] = ("reshape({c}, shape({c}), order=[2, 1, 3])" if len(sizes) == 3 else words["found"]).format(**words)
        self.declared, self.inside, self.before, self.after, self.first, self.passed, self.size = (
            part.format(**words) if isinstance(part, str) else [line.format(**words) for line in part] for part in form)
        self.passed = self.passed or (words["c"] if self.inside else self.what)
        is_last = of.own and self.optional and (not type_ or of.c_name.startswith("scene_"))
        self.rank = 3 if (of.own, what) == ("hooke_scene", "limits") else 2 if "place" in self.form else int(bool(is_last))

    def name_of_form(self, of, what, is_output):
        absent = "?" * self.optional
        if self.callback or self.object:
            return "callback" if self.callback else f"object{absent}"
        if self.kind == "const char *":
            return "whole text" if what == "text" and ("int64_t", "length") in of.parameters else f"text{absent}"
        if self.kind == "int64_t *" and not is_output:
            return "count's place" if what in NUMBERS else "index's place"
        if self.kind.endswith("*"):
            form = "output" if is_output else ARRAYS.get(what, "list")
            return f"rows{absent}" if form == "rows" else form
        return NUMBERS.get(what, "real" if self.kind == "double" else "index")


def answer(result, name, whats):
    """(type, conversion from C) of the result of a function."""
    if result == "const char *":
        return "character(:), allocatable", "to_text({})"
    if result == "const double *":
        return "real(c_double), pointer, contiguous", "to_series({}, int(self%particle_count(), c_int64_t))"
    if result == "double":
        named = [what for what in whats if what in ("what", "column")]
        return "real(c_double)", f"to_number({{}}, {named[0]})" if named else "{}"
    if result == "int64_t":
        number = f"to_integer({{}}){' + 1' if name.endswith(DEFAULT_INTEGERS[:2]) else ''}"
        return ("integer", number) if name.endswith(DEFAULT_INTEGERS) else ("integer(c_int64_t)", "{}")
    return ("logical", "{} == 1") if "_is_" in name else ("integer", "int({})")


class Procedure:
    """A function of C as a procedure of the type `own`, or of none; `given`: what C has for some parameters; `end`: what
    releases an object that is made; `bits`: the kind of many steps."""

    def __init__(self, name, own, function, given, place, end, bits):
        self.name, self.own, self.end, self.bits = name, own, end, bits
        self.result, self.c_name, self.parameters = function[0], headers.short(function[1]), function[2]
        self.is_status = headers.is_status(*function[:2])
        last_kind, last = self.parameters[-1] if self.parameters else ("", "")
        itself, self.is_const = next(((what, kind.startswith("const")) for kind, what in self.parameters
                                      if own and headers.object_of(kind) == IN_C.get(own, own)), (None, True))
        self.makes = last_kind.endswith("**")
        self.takes_self = bool(itself or (own and not self.makes))
        # what is made or written is the object itself, another object, or the result of a function
        self.made = RENAMED.get(f"{self.c_name}.{last}", last) if self.makes and itself else "self"
        self.filled = last if self.result == "void" and last in headers.VECTORS else None
        count_of = headers.counts(self.parameters)
        known = {itself, self.filled, *count_of.values(), *given}
        taken = {what: Parameter(self, kind, what) for kind, what in self.parameters
                 if what not in known and (kind, what) not in BY_OTHERS and not kind.endswith("**")}
        self.given = sorted(taken.values(), key=lambda p: p.rank)
        callback = next((p for p in self.given if p.callback), None)
        sizes = {count: taken[what].size for what, count in reversed(count_of.items()) if what in taken}
        passed = {"ctx": "callback%data", "length": "len(text, c_int64_t)", itself: "self%address()", self.filled: "found",
                  "product": callback and f"product_of_{headers.short(callback.callback)}({callback.what})", **sizes,
                  **{what: p.passed for what, p in taken.items()}, **{what: in_c(value) for what, value in given.items()}}
        passed.update({last: "made"} if self.makes else {})
        by_name = None in given.values()
        arguments = [f"{what}={passed[what]}" if by_name else passed[what] for _, what in self.parameters if passed[what]]
        self.call = f"c_{self.c_name}({', '.join(arguments)})"
        self.fit = [line for what, p in taken.items() if "rows" in p.form and own
                    for line in self.fitting(p, sizes.get(count_of.get(what)))]
        self.keep = f"call {self.made}%keep(callback, {0 if self.c_name in SEVERAL else place}, " if callback else None

    def fitting(self, p, count):
        """Lines that return where an array has not as many rows as it should: as a list, or one a particle."""
        status = ", status" if self.is_status else ""
        fits = f"if (.not. is_3_by({p.what}, {count or 'int(self%particle_count(), c_int64_t)'}{status})) return"
        return [f"if (present({p.what})) then", f"  {fits}", "end if"] if p.optional else [fits]

    def lines_of(self, part):
        return [line for p in self.given for line in getattr(p, part)]

    def with_status(self):
        """(variables, statements) of a procedure that returns a status."""
        needed = [*(["self"] if self.takes_self else []), *(p.what for p in self.given if p.object)]
        lines = [*self.lines_of("first"), *([f"if (missing(status, {', '.join(needed)})) return"] if needed else []),
                 *self.lines_of("before"), *self.fit]
        call, variables = self.call, []
        if self.makes:
            objects = [("self", self.own)] * self.takes_self + [(p.what, p.object) for p in self.given if p.object]
            owner = next((f", {what}" for what, type_ in objects if type_ != "hooke_options"), "")
            call, variables = "code", ["type(c_ptr) :: made", "integer(c_int32_t) :: code"]
            lines += [f"code = {self.call}", f"if (code == 0) call {self.made}%take(made, {self.end}{owner})"]
        lines.append(f"{self.keep}{call}, status)" if self.keep else f"call accept({call}, status)")
        return variables, lines + self.lines_of("after")

    def with_result(self, whats):
        """The same of a function."""
        of_result, made = answer("double" if self.filled else self.result, self.name, whats)
        is_series = self.result == "const double *"
        shape = "(3)" if self.filled else "(:)" * is_series
        call = f"call {self.call}" if self.filled else f"found {'=>' if is_series else '='} {made.format(self.call)}"
        unfit = ["found = 0", *self.fit] if self.fit else []
        return [f"{of_result} :: found{shape}"], [*unfit, *self.lines_of("before"), call]

    def lines(self):
        """The whole procedure."""
        whats, inside = self.lines_of("names"), [p.inside for p in self.given if p.inside]
        is_const = self.is_const and not (self.makes and self.made == "self")
        head = [f"class({self.own}), intent({'in' if is_const else 'inout'}) :: self"] * bool(self.own)
        head += [p.declared for p in self.given]
        if self.made != "self":
            whats, head = [*whats, self.made], [*head, f"class({self.own}), intent(inout) :: {self.made}"]
        kind, found = "subroutine", ""
        if self.is_status:
            variables, body = self.with_status()
            whats.insert(len(whats) - sum(p.rank == 3 for p in self.given), "status")
            head, inside = [*head, "integer, intent(out), optional :: status"], [*inside, *variables]
        elif self.result == "void" and not self.filled:
            body = [*self.lines_of("before"), f"call {self.call}", *([f"{self.keep}0_c_int32_t)"] if self.keep else [])]
        else:
            kind, found, (variables, body) = "function", " result(found)", self.with_result(whats)
            inside = [*variables, *inside]
        title = f"{kind} {'' if self.own else 'hooke_'}{self.name}({', '.join(['self'] * bool(self.own) + whats)}){found}"
        return written(kind, title, [*head, *inside, *body])


def in_c(value):
    """What C is given: a text, a number, or nothing."""
    return f'to_c("{value}")' if isinstance(value, str) else value if value is None else f"{value}_c_int64_t"


def written(kind, title, lines):
    """A procedure, of lines that are short enough."""
    return [*wrapped([f"  {title}"]), *(f"    {line}" for line in wrapped(lines)), f"  end {kind}", ""]


def wrapped(lines):
    """Lines that are too long for Fortran, in pieces."""
    for line in lines:
        while len(line) >= 116 and (comma := line.rfind(", ", 0, 110) + 1):
            yield f"{line[:comma]} &"
            line = f"  {line[comma + 1:]}"
        yield line


def borrowing(name, own, c_name, type_):
    """A procedure that hands out an object that another one has, if it has one."""
    what = headers.short(type_)
    return written("subroutine", f"subroutine {name}(self, {what}, status)", [
        f"class({own}), intent(in) :: self", f"class({type_}), intent(inout) :: {what}",
        "integer, intent(out), optional :: status", "type(c_ptr) :: there", "if (missing(status, self)) return",
        f"there = c_{c_name}(self%address())", f"if (c_associated(there)) call {what}%take(there, owner=self)",
        "call accept(int(merge(hooke_ok, hooke_bad_call, c_associated(there)), c_int32_t), status)"])


def refreshing(own, parts, functions):
    """The procedure that sets the objects that one of type `own` has as parts."""
    short = headers.short(own)
    of_part = {part: next(name for name in (f"{short}_{part}", f"{short}_{part}_options") if name in functions) for part in parts}
    return written("subroutine", f"subroutine {short}_refresh(self)", [
        f"class({own}), intent(inout) :: self", *(f"call self%{part}%destroy()" for part in parts),
        "if (.not. self%exists()) return",
        *(f"call self%{part}%take(c_{name}(self%address()), owner=self)" for part, name in of_part.items())])


def assigning(own):
    """The assignment that makes another reference to the same object."""
    name = f"assign_{headers.short(own)}"
    return written("subroutine", f"impure elemental subroutine {name}(self, other)", [
        f"class({own}), intent(inout) :: self", f"class({own}), intent(in) :: other", "call self%share(other)"])


def end_of(type_, functions):
    """The procedure that releases objects of a type; one by hand where closing one may fail."""
    names = (f"{headers.short(IN_C.get(type_, type_))}_destroy", f"{headers.short(type_)}_close")
    found = [f"c_{name}" for name in names if name in functions and functions[name][0] == "void"]
    return found[0] if found else f"abandon_{headers.short(type_)}"


def all_of(public, types, by_hand):
    """{type: {name: lines}} of the procedures that are made, from {header: text}, {type: its parts} and the names of those
    that are written by hand; None has those of no type."""
    functions = {headers.short(f[1]): f for text in public.values() for f in headers.declared(text)}
    places = {name: 10 + k for k, name in enumerate(functions)}
    found = {type_: {} for type_ in [*types, None]}
    asked = {NAMES.get(name, name): (name, {}) for name in functions if not name.endswith(("_destroy", "_close"))}
    for name, (c_name, given) in {**asked, **FURTHER}.items():
        result, _, parameters = functions[c_name]
        own = max((t for t in types if f"hooke_{name}".startswith(f"{t}_")), key=len, default=None)
        own = own if any("hooke_" in kind for kind, _ in parameters) else None
        if name not in by_hand and result in RESULTS:
            for bits in ("int32", "int64") if ("int64_t", "steps") in parameters else (None,):
                full, end = f"{name}_{bits}" if bits else name, own and end_of(own, functions)
                found[own][full] = Procedure(full, own, functions[c_name], given, places[c_name], end, bits).lines()
        elif name not in by_hand and headers.object_of(result) and c_name in NAMES:
            found[own][name] = borrowing(name, own, c_name, headers.object_of(result))
    for type_, parts in types.items():
        if parts:
            found[type_][f"{headers.short(type_)}_refresh"] = refreshing(type_, parts, functions)
    return found
