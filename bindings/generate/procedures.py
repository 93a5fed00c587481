"""Fortran procedures that pass numbers, texts, lists, rows of particles, objects and callbacks on to the function of C of
the same name, or make objects. A type has those whose names begin with its own; the others are hooke_<name>()."""

import re
from types import SimpleNamespace

import callbacks
import guard
import headers

# Procedures that have another name than their function of C.
NAMES = {
    "checkpoint_read": "integrator_read_checkpoint", "checkpoint_write": "integrator_write_checkpoint",
    "io_own_process": "own_process", "mesh_read": "options_read_mesh", "mesh_set": "options_set_mesh",
    "needs_lean": "measurement_lean", "needs_lean_particle": "measurement_lean_particle",
    "needs_lean_position": "measurement_lean_position", "needs_lean_run": "measurement_lean_run",
    "options_copy": "options_copy_to", "scene_options_apply": "system_apply", "scene_write": "system_write_scene",
    "state_copy": "state_copy_to", "step_bound": "system_step_bound", "study_recommend": "measurement_recommend",
    "verify_create": "measurement_create_verify", "why_advice_apply": "measurement_advice_apply",
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
    "system_force.force": "forces", "system_derivative_product.out": "product", "system_step_bounds.bound": "bounds",
    "estimate_number.column": "what", "estimate_text.column": "what", "view_number.column": "what",
}
# What arrays have, by the names of their parameters: a row for every particle, so many numbers, a list of members with so
# many particles.
ROWS = {"q", "v", "dq", "dv", "force", "acceleration", "out", "position", "velocity", "displacement", "vertices"}
FIXED = {"gravity": 3, "amplitude": 3, "momentum": 3, "angular_momentum": 3}
LISTS = {"ends": 2, "triples": 3, "tetrahedra": 4, "triangles": 3}
# Several results in one array.
PARTS = {"bound": "bound", "inertia": "mass inertia(3)", "motion": "point(3) quaternion(4) velocity(3) angular_momentum(3)"}
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
    "system_step_bounds.bound": ["c_method_count()"],
}
COUNTS = {"count", "size", "steps", "stride", "rows", "columns"}  # other whole numbers are indices, and count from 1 in Fortran
# Endings of procedures whose results are default integers; the first two are indices.
NUMBERS = ("_find", "_particle", "_count", "_size", "_springs", "_value", "_hold")
# Whole numbers that are not of the default kind, which a compiler may have made that of C's; there may be many steps.
OF_KINDS = {"step": "integer(c_int64_t)", "steps": "integer(c_int32_t)"}
# Of indices, or of other numbers: the kind in Fortran, that in C, and zero.
KINDS = {True: ("integer", "integer(c_int64_t)", "0_c_int64_t"), False: ("real(c_double)", "real(c_double)", "0.0_c_double")}
# Parameters that are 0 where they are absent: their types, and how C is given them.
DEFAULTS = {"phase": ("real(c_double)", "real(c_double)", "phase"), "project": ("logical", "integer(c_int32_t)", "merge(1, 0, project)")}
# Parameters that other ones stand for.
BY_OTHERS = {("void *", "ctx"), ("int64_t", "length"), ("hooke_force_product *", "product")}
SEVERAL = {"hooke_system_drive_callback"}  # callbacks that are kept beside those given before
RESULTS = {"int32_t", "int64_t", "double", "const char *", "const double *", "void"}


def object_of(kind):
    """The type of an object that is passed or returned; None for other types."""
    match = re.fullmatch(r"(?:const )?(hooke_\w+) \*", kind)
    return match.group(1) if match else None


class Parameter(SimpleNamespace):
    """One of a procedure: its names, what is declared for users and inside, what C is given for it, what comes first, before
    the call and after. By `rank` those that may be absent come after the others, and behind the status."""

    def __init__(self, of, kind, what):
        self.key, self.kind, self.type = f"{of.c_name}.{what}", kind, object_of(kind)
        key = f"{of.name}.{what}"
        self.what = RENAMED.get(key) or RENAMED.get(self.key, what)
        super().__init__(names=[self.what], inside=[], first=[], before=[], after=[], object=None, rows=False, size=None,
                         passed=self.what, callback=callbacks.of_callback(self.type or "", of.c_name))
        self.optional = what in DEFAULTS or guard.is_optional(f"hooke_{of.c_name}", what) and key != "system_step_bound.method"
        self.sizes = OUTPUTS.get(key)
        self.intent = f"intent({'in' if kind.startswith('const') else 'inout'})"
        if self.callback:
            self.of_callback()
        elif self.type:
            self.of_object(of)
        elif kind == "const char *":
            self.of_text(is_as_it_is=what == "text" and of.has("length"))
        elif kind.endswith("*"):
            self.of_array(what)
        else:
            self.of_number(what)
        self.rank = (3 if (of.own, what) == ("hooke_scene", "limits") else 2 if self.first and self.optional
                     else int(self.optional and not self.callback and not self.object and of.own is not None))

    def declare(self, words, shape=""):
        self.declared = [f"{words}{', optional' if self.optional else ''} :: {self.what}{shape}"]

    def pass_on(self, words, shape=""):
        """A variable of C's kind."""
        self.passed = f"c_{self.what}"
        self.inside = [f"{words} :: {self.passed}{shape}"]

    def of_callback(self):
        self.declare(f"class({self.callback}), target, intent(inout)")
        self.inside, self.passed = ["type(hooke_callback) :: callback"], "callback%function"
        self.before = [f"callback = callback_to(c_funloc(call_{self.callback[len('hooke_'):]}), {self.what})"]

    def of_object(self, of):
        self.optional = (guard.may_be_null(f"hooke_{of.c_name}", self.type) and not of.c_name.startswith("system_add_")
                         and (self.intent == "intent(in)" or self.type != "hooke_options"))
        self.object = of.own if self.type == IN_C.get(of.own) else self.type
        self.declare(f"class({self.object}), {self.intent}")
        self.passed = f"address_or_null({self.what})" if self.optional else f"{self.what}%address()"

    def of_text(self, is_as_it_is):
        self.declare("character(*), intent(in)")
        if self.optional:
            self.pass_on("character(:), allocatable")
            self.before = [f"call to_c_if({self.what}, {self.passed})"]
        elif not is_as_it_is:
            self.passed = f"to_c({self.what})"

    def of_array(self, what):
        indices = "int64" in self.kind
        if self.sizes:
            self.of_output(*KINDS[indices])
        elif self.kind == "int64_t *":
            self.of_place(0 if what in COUNTS else 1)
        elif what in PARTS:
            self.of_parts(PARTS[what])
        elif what in FIXED:
            self.declare("real(c_double), intent(in)", f"({FIXED[what]})")
        elif what in ROWS:
            self.of_rows()
        elif what in LISTS:
            self.declare("integer, intent(in)", "(:, :)")
            self.before = self.refused(f"size({self.what}, 1) /= {LISTS[what]}", f"{what} have the shape ({LISTS[what]}, n)")
            self.passed, self.size = f"zero_based({self.what})", f"size({self.what}, 2, c_int64_t)"
        else:  # one number or several
            self.declare(f"{KINDS[indices][0]}, intent(in)", "(..)")
            self.pass_on(f"{KINDS[indices][1]}, allocatable", "(:)")
            self.before, self.size = [f"call to_list({self.what}, {self.passed})"], f"ubound({self.passed}, 1, c_int64_t)"

    def refused(self, condition, message):
        return [f"if ({condition}) then", f'  call refuse(hooke_bad_value, "{message}", status)', "  return", "end if"]

    def of_rows(self):
        """Rows of particles. An absent array is passed on as a pointer to nothing: of the array the bounds would be computed."""
        self.rows, self.size = True, f"size({self.what}, 2, c_int64_t)"
        self.declare(f"real(c_double), {self.intent}, contiguous{', target' if self.optional else ''}", "(:, :)")
        if self.optional:
            self.pass_on("real(c_double), pointer, contiguous", "(:, :)")
            self.before = [f"{self.passed} => null()", f"if (present({self.what})) {self.passed} => {self.what}"]

    def of_place(self, first):
        """The place for a number; `first` is the one that C calls 0."""
        self.declare("integer, intent(out)")
        self.pass_on("integer(c_int64_t)", "(1)")
        there = f"if (present({self.what})) " * self.optional
        self.first = [f"{there}{self.what} = 0", f"{self.passed} = {-first}"]
        self.after = [f"{there}{self.what} = int({self.passed}(1)){' + 1' * first}"]

    def of_parts(self, parts):
        names, sizes = zip(*((name, int(size or 1)) for name, size in re.findall(r"(\w+)(?:\((\d)\))?", parts)))
        self.declared, self.names = [f"real(c_double), intent(out) :: {', '.join(parts.split())}"], names
        self.pass_on("real(c_double)", f"({sum(sizes)})")
        self.first = [f"{name} = 0" for name in [*names, self.passed]]
        for k, (name, size) in enumerate(zip(names, sizes)):
            start = sum(sizes[:k]) + 1
            part = f"{start}:{start + size - 1}" if f"{name}(" in parts else f"{start}"
            self.after.append(f"{name} = {self.passed}({part})")

    def of_output(self, kind, in_c, zero):
        shape = f"({', '.join(':' * len(self.sizes))})"
        self.declare(f"{kind}, allocatable, intent(out)", shape)
        self.pass_on(f"{in_c}, allocatable", shape)
        self.before = [f"allocate ({self.passed}({', '.join(self.sizes)}), source={zero})"]
        found = f"int({self.passed}) + 1" if kind == "integer" else self.passed
        found = found if len(self.sizes) < 3 else f"reshape({found}, shape({found}), order=[2, 1, 3])"
        self.after = [f"{f'if (present({self.what})) ' * self.optional}{self.what} = {found}"]

    def of_number(self, what):
        if what in DEFAULTS:
            words, in_c, given = DEFAULTS[what]
            self.pass_on(in_c)
            self.before = [f"{self.passed} = 0", f"if (present({what})) {self.passed} = {given}"]
        else:
            words = "real(c_double)" if self.kind == "double" else OF_KINDS.get(what, "integer")
        self.declare(f"{words}, intent(in)")
        if what == "frame":
            self.before = self.refused("frame == 0", "frame 0: frames count from 1, from the end with -1")
            self.passed = "from_zero(frame)"
        elif words == "integer" or what == "steps":
            is_number = self.kind == "int32_t" or what in COUNTS
            self.passed = f"int({self.what}, c_{self.kind})" if is_number else f"zero_based({self.what})"


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
        number = f"to_integer({{}}){' + 1' if name.endswith(NUMBERS[:2]) else ''}"
        return ("integer", number) if name.endswith(NUMBERS) else ("integer(c_int64_t)", "{}")
    return ("logical", "{} == 1") if "_is_" in name else ("integer", "int({})")


class Procedure:
    """A function of C as a procedure of the type `own`, or of none; `given`: what C has for some parameters."""

    def __init__(self, name, own, function, given, place, ends):
        self.name, self.own, self.result, self.c_name = name, own, function[0], function[1][len("hooke_"):]
        self.parameters, self.ends = function[2], ends
        last_kind, last = self.parameters[-1] if self.parameters else ("", "")
        itself, self.is_const = next(((what, kind.startswith("const")) for kind, what in self.parameters
                                      if own and object_of(kind) == IN_C.get(own, own)), (None, True))
        self.makes = last_kind.endswith("**")
        self.takes_self = bool(itself or (own and not self.makes))
        # what is made or written is the object itself, another object, or the result of a function
        self.made = RENAMED.get(f"{self.c_name}.{last}", last) if self.makes and itself else "self"
        self.filled = last if self.result == "void" and last in FIXED else None
        count_of = headers.counts(self.parameters, FIXED)
        known = {itself, self.filled, *count_of.values(), *given}
        taken = {what: Parameter(self, kind, what) for kind, what in self.parameters
                 if what not in known and (kind, what) not in BY_OTHERS and not kind.endswith("**")}
        self.given = sorted(self.ranked(taken.values()), key=lambda p: p.rank)
        force = next((p for p in self.given if p.callback), None)
        passed = {itself: "self%address()", "ctx": "callback%data", "length": "len(text, c_int64_t)", self.filled: "found",
                  last if self.makes else None: "made",
                  "product": force and f"product_of_{force.callback[len('hooke_'):]}({force.what})",
                  **{count: taken[what].size for what, count in reversed(count_of.items()) if what in taken},
                  **{what: p.passed for what, p in taken.items()}, **{what: in_c(value) for what, value in given.items()}}
        by_name = None in given.values()
        self.call = f"c_{self.c_name}({', '.join(f'{what}={passed[what]}' if by_name else passed[what] for _, what in self.parameters if passed[what])})"
        self.fit = [line for what, p in taken.items() if p.rows and own for line in self.fitting(p, passed.get(count_of.get(what, "")))]
        self.keep = f"call {self.made}%keep(callback, {0 if function[1] in SEVERAL else place}, " if force else None

    def has(self, name):
        return name in [what for _, what in self.parameters]

    @staticmethod
    def ranked(parameters):
        """Options that may be absent stay behind a text that may be."""
        last = 0
        for p in parameters:
            p.rank = max(p.rank, last) if p.object and p.optional else p.rank
            last = max(last, p.rank) if p.kind == "const char *" else last
        return parameters

    def fitting(self, p, count):
        """Lines that return where an array has not as many rows as it should: as a list, or one a particle."""
        status = ", status" if self.is_status() else ""
        fits = f"if (.not. is_3_by({p.what}, {count or 'int(self%particle_count(), c_int64_t)'}{status})) return"
        return [f"if (present({p.what})) then", f"  {fits}", "end if"] if p.optional else [fits]

    def is_status(self):
        return headers.is_status(self.result, f"hooke_{self.c_name}")

    def body(self):
        """(variables, statements) of a procedure that returns a status."""
        needed = [*(["self"] if self.takes_self else []), *(p.what for p in self.given if p.object)]
        lines = [line for p in self.given for line in p.first]
        lines += [f"if (missing(status, {', '.join(needed)})) return"] if needed else []
        lines += [line for p in self.given for line in p.before] + self.fit
        call, variables = self.call, []
        if self.makes:
            objects = [("self", self.own)] * self.takes_self + [(p.what, p.object) for p in self.given if p.object]
            owner = next((f", {what}" for what, type_ in objects if type_ != "hooke_options"), "")
            call, variables = "code", ["type(c_ptr) :: made", "integer(c_int32_t) :: code"]
            lines += [f"code = {self.call}", f"if (code == 0) call {self.made}%take(made, {self.ends[self.own]}{owner})"]
        lines.append(f"{self.keep}{call}, status)" if self.keep else f"call accept({call}, status)")
        return variables, lines + [line for p in self.given for line in p.after]

    def lines(self):
        """The whole procedure."""
        whats, before = [what for p in self.given for what in p.names], [line for p in self.given for line in p.before]
        is_const = self.is_const and not (self.makes and self.made == "self")
        head = [f"class({self.own}), intent({'in' if is_const else 'inout'}) :: self"] * bool(self.own)
        head += [line for p in self.given for line in p.declared]
        inside, kind, found = [line for p in self.given for line in p.inside], "subroutine", ""
        if self.made != "self":
            whats, head = [*whats, self.made], [*head, f"class({self.own}), intent(inout) :: {self.made}"]
        if self.is_status():
            variables, body = self.body()
            behind = sum(p.rank == 3 for p in self.given)
            whats.insert(len(whats) - behind, "status")
            head, inside = [*head, "integer, intent(out), optional :: status"], [*inside, *variables]
        elif self.result == "void" and not self.filled:
            body = [*before, f"call {self.call}", *([f"{self.keep}0_c_int32_t)"] if self.keep else [])]
        else:
            of_result, made = answer("double" if self.filled else self.result, self.name, whats)
            is_series = self.result == "const double *"
            shape = f"({FIXED[self.filled]})" if self.filled else "(:)" * is_series
            kind, found, inside = "function", " result(found)", [f"{of_result} :: found{shape}", *inside]
            call = f"call {self.call}" if self.filled else f"found {'=>' if is_series else '='} {made.format(self.call)}"
            body = [*(["found = 0", *self.fit] if self.fit else []), *before, call]
        name = self.name if self.own else f"hooke_{self.name}"
        title = f"{kind} {name}({', '.join([*(['self'] if self.own else []), *whats])}){found}"
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
    what = type_[len("hooke_"):]
    return written("subroutine", f"subroutine {name}(self, {what}, status)", [
        f"class({own}), intent(in) :: self", f"class({type_}), intent(inout) :: {what}",
        "integer, intent(out), optional :: status", "type(c_ptr) :: there", "if (missing(status, self)) return",
        f"there = c_{c_name}(self%address())", f"if (c_associated(there)) call {what}%take(there, owner=self)",
        "call accept(int(merge(hooke_ok, hooke_bad_call, c_associated(there)), c_int32_t), status)"])


def refreshing(own, parts, functions):
    """The procedure that sets the objects that one of type `own` has as parts."""
    short = own[len("hooke_"):]
    of_part = {part: next(name for name in (f"{short}_{part}", f"{short}_{part}_options") if name in functions) for part in parts}
    return written("subroutine", f"subroutine {short}_refresh(self)", [
        f"class({own}), intent(inout) :: self", *(f"call self%{part}%destroy()" for part in parts),
        "if (.not. self%exists()) return",
        *(f"call self%{part}%take(c_{name}(self%address()), owner=self)" for part, name in of_part.items())])


def assigning(own):
    """The assignment that makes another reference to the same object."""
    name = f"assign_{own[len('hooke_'):]}"
    return written("subroutine", f"impure elemental subroutine {name}(self, other)", [
        f"class({own}), intent(inout) :: self", f"class({own}), intent(in) :: other", "call self%share(other)"])


def all_of(public, types, by_hand):
    """{type: {name: lines}} of the procedures that are made, from {header: text}, {type: its parts} and the names of those
    that are written by hand; None has those of no type."""
    functions = {f[1][len("hooke_"):]: f for text in public.values() for f in headers.declared(text)}
    places = {name: 10 + k for k, name in enumerate(functions)}
    ends = {type_: f"abandon_{type_[len('hooke_'):]}" for type_ in types}
    ends.update((type_, f"c_{name}") for type_ in types for name, (result, *_) in functions.items() if result == "void"
                and f"hooke_{name}" in (f"{IN_C.get(type_, type_)}_destroy", f"{type_}_close"))
    found = {type_: {} for type_ in [*types, None]}
    asked = {NAMES.get(name, name): (name, {}) for name in functions if not name.endswith(("_destroy", "_close"))}
    for name, (c_name, given) in {**asked, **FURTHER}.items():
        own = max((t for t in types if f"hooke_{name}".startswith(f"{t}_")), key=len, default=None)
        result, _, parameters = functions[c_name]
        own = own if any("hooke_" in kind for kind, _ in parameters) else None
        if name in by_hand:
            continue
        if object_of(result) and NAMES.get(c_name, c_name) in asked and c_name in NAMES:
            found[own][name] = borrowing(name, own, c_name, object_of(result))
        elif result in RESULTS:
            lines = Procedure(name, own, functions[c_name], given, places[c_name], ends).lines()
            many = any(what == "steps" for _, what in parameters)
            for bits in ("_int32", "_int64") if many else ("",):
                text = "\n".join(lines).replace(f" {name}(", f" {name}{bits}(")
                found[own][name + bits] = text.replace("(c_int32_t), intent(in) :: steps", f"(c{bits}_t), intent(in) :: steps").split("\n")
    for type_, parts in types.items():
        if parts:
            found[type_][f"{type_[len('hooke_'):]}_refresh"] = refreshing(type_, parts, functions)
    return found
