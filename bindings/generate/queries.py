"""Fortran procedures that only pass numbers, texts, lists, rows of particles, objects and callbacks, and make objects. A type
that extends hooke_system_queries has one for every C function hooke_system_<name>() with such arguments and results
that no hand-written procedure calls; functions without an object are procedures of the module
hooke_queries_of_library."""

import re

import callbacks
import guard
import headers

COUNTS = {"count", "size", "steps", "stride"}  # other whole numbers are indices, and count from 1 in Fortran
NUMBERS = ("_count", "_size", "_springs", "_find", "_particle")  # endings of functions whose results are default integers
STEPS = {"step", "advance"}  # procedures that take many steps
# Whole numbers that are not of the default kind, which a compiler may have made that of C's.
OF_KINDS = {"step": "integer(c_int64_t)", "steps": "integer(c_int32_t)"}
RESULTS = {"int32_t", "int64_t", "double", "const char *", "const double *", "void"}
# Types of Fortran that are another one in C: their functions are those with their names.
IN_C = {"hooke_estimate": "hooke_measurement", "hooke_view": "hooke_measurement"}
# Functions of C that belong to a type by another name than theirs, and their names there.
BELONG = {
    "hooke_checkpoint_read": ("hooke_integrator", "read_checkpoint"),
    "hooke_checkpoint_write": ("hooke_integrator", "write_checkpoint"),
    "hooke_mesh_read": ("hooke_options", "read_mesh"),
    "hooke_mesh_set": ("hooke_options", "set_mesh"),
    "hooke_needs_lean_particle": ("hooke_measurement", "lean_particle"),
    "hooke_options_copy": ("hooke_options", "copy_to"),
    "hooke_scene_options_apply": ("hooke_system", "apply"),
    "hooke_scene_write": ("hooke_system", "write_scene"),
    "hooke_state_copy": ("hooke_state", "copy_to"),
    "hooke_study_recommend": ("hooke_measurement", "recommend"),
    "hooke_verify_create": ("hooke_measurement", "create_verify"),
    "hooke_why_advice_apply": ("hooke_measurement", "advice_apply"),
    "hooke_why_create": ("hooke_measurement", "create_why"),
    "hooke_why_create_kept": ("hooke_measurement", "create_why_kept"),
}
ALSO = {("hooke_estimate", "hooke_measurement_on_progress")}  # and those that a type has of the other one
# Arrays of a row for every particle of a system, by the names of their parameters.
ROWS = {"q", "v", "dq", "dv", "force", "acceleration", "out", "position", "velocity", "displacement", "vertices"}
# Lists of members, by the names of their parameters, with the particles of each.
LISTS = {"ends": 2, "triples": 3, "tetrahedra": 4, "triangles": 3}
# Arrays that are allocated for results, with their sizes; whole numbers in them are indices.
OUTPUTS = {
    ("hooke_system_altitude_lengths", "length"): ['self%count("altitude")'],
    ("hooke_system_anchor_points", "points"): ["3", 'self%count("anchors")'],
    ("hooke_system_derivative_pattern", "column"): ['self%count("blocks")'],
    ("hooke_system_derivative_pattern", "row_start"): ["self%particle_count() + 1"],
    ("hooke_system_members", "damping"): ["max(self%count(force), 0)"],
    ("hooke_system_members", "particles"): ["int(c_member_particles(to_c(force)))", "max(self%count(force), 0)"],
    ("hooke_system_members", "rest_length"): ['merge(7, 1, force == "altitude")*max(self%count(force), 0)'],
    ("hooke_system_members", "stiffness"): ["max(self%count(force), 0)"],
}
# Of indices, or of other numbers: the kind in Fortran, that in C, and zero.
KINDS = {True: ("integer", "integer(c_int64_t)", "0_c_int64_t"), False: ("real(c_double)", "real(c_double)", "0.0_c_double")}
FIXED = {"gravity": 3, "amplitude": 3, "momentum": 3, "angular_momentum": 3}  # numbers of other arrays
# Parameters that are 0 where they are absent, with their types in Fortran; and how C is given them.
DEFAULTS = {"phase": "real(c_double)", "project": "logical"}
CONVERTED = {"double": "{}", "int32_t": "merge(1, 0, {})"}
# Parameters that other ones stand for.
BY_OTHERS = {("void *", "ctx"), ("int64_t", "length"), ("hooke_force_product *", "product")}
# Parameters that come behind the status.
AFTER_STATUS = {("hooke_scene_load", "limits"), ("hooke_scene_parse", "limits")}
ALSO_LAST = {("hooke_scene_of_system", "run"), ("hooke_scene_write", "run")}  # as texts that may be absent
SEVERAL = {"hooke_system_drive_callback"}  # callbacks that are kept beside those given before
# Parameters that have another name in Fortran.
RENAMED = {("hooke_checkpoint_read", "run"): "name", ("hooke_checkpoint_write", "run"): "name",
           ("hooke_method_name", "method"): "number", ("hooke_part_kind", "kind"): "number",
           **{(f"hooke_integrator_{name}", what): full for name in ("get", "put")
              for what, full in (("q", "position"), ("v", "velocity"))},
           ("hooke_options_set_numbers", "values"): "value", ("hooke_options_set_text", "text"): "value",
           ("hooke_state_copy", "to"): "other", ("hooke_system_with_force", "with"): "forced",
           ("hooke_system_acceleration", "acceleration"): "accelerations", ("hooke_system_force", "force"): "forces",
           ("hooke_system_derivative_product", "out"): "product"}
# Procedures of Fortran that ask a query of C for one word, or a table of one row for a column, by the names that they would
# have in C, with their results.
WORDS = {
    "hooke_system_spring_count": ("int64_t", "hooke_system_count", "springs"),
    "hooke_integrator_wall_seconds": ("double", "hooke_integrator_number", "wall_seconds"),
    "hooke_integrator_diverged_at": ("double", "hooke_integrator_number", "diverged_at"),
    "hooke_integrator_stop_value": ("int32_t", "hooke_integrator_count", "stop_value"),
    "hooke_estimate_number": ("double", "hooke_measurement_number", "estimate", "what"),
    "hooke_estimate_text": ("const char *", "hooke_measurement_text", "estimate", "what"),
    "hooke_view_number": ("double", "hooke_measurement_number", "view", "what"),
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


def counts(parameters):
    """{how many: the arrays that have so many} of the parameters of a function of C."""
    found, count = {}, None
    for kind, what in parameters:
        if kind == "int64_t":
            count = what if re.fullmatch(r"(\w+_)?count|samples", what) else None
        elif count and (kind == "const int64_t *" or kind.endswith("double *")) and what not in FIXED:
            found.setdefault(count, []).append(what)
    return found


class Parameter:
    """One of a function of C: its declaration in Fortran, what C is given for it, and what comes before the call and after.
    By `rank` those that may be absent come after the others."""

    def __init__(self, function, kind, what, own):
        name, type_ = function[1], object_of(kind)
        self.what, self.optional = RENAMED.get((name, what), what), guard.is_optional(name, what) or what in DEFAULTS
        self.locals, self.first, self.before, self.after = [], [], [], []
        self.object, self.rows, self.size = None, False, None
        self.passed, self.callback = self.what, callbacks.of_callback(type_ or "", name)
        if self.callback:
            self.of_callback()
        elif type_:
            self.of_object(name, kind, own)
        elif kind == "const char *":
            self.of_text(what == "text" and "length" in [other for _, other in function[2]])
        elif kind.endswith("*"):
            self.of_array(name, kind, what)
        else:
            self.of_number(kind, what)
        is_last = (self.optional and not self.callback and not self.object) or (name, what) in ALSO_LAST
        self.rank = 3 if (name, what) in AFTER_STATUS else 2 if self.first else int(is_last and own is not None)

    def declare(self, words, shape=""):
        self.declared = f"{words}{', optional' if self.optional else ''} :: {self.what}{shape}"

    def local(self, words, shape=""):
        """A variable of C's kind, which is passed on."""
        self.passed = f"c_{self.what}"
        self.locals = [f"{words} :: {self.passed}{shape}"]

    def of_callback(self):
        self.declare(f"class({self.callback}), target, intent(inout)")
        self.locals, self.passed = ["type(hooke_callback) :: callback"], "callback%function"
        self.before = [f"callback = callback_to(c_funloc(call_{self.callback[len('hooke_'):]}), {self.what})"]

    def of_object(self, name, kind, own):
        type_, intent = object_of(kind), "in" if kind.startswith("const") else "inout"
        self.optional = (guard.may_be_null(name, type_) and not name.startswith("hooke_system_add_")
                         and (intent == "in" or type_ != "hooke_options"))
        self.object = own if type_ == IN_C.get(own) else type_
        self.declare(f"class({self.object}_queries), intent({intent})")
        self.passed = f"address_or_null({self.what})" if self.optional else f"{self.what}%address()"

    def of_array(self, name, kind, what):
        if (name, what) in OUTPUTS:
            self.of_output(OUTPUTS[name, what], "int64" in kind)
        elif kind == "int64_t *":
            self.of_place(0 if what in COUNTS else 1)
        elif what in FIXED:
            self.declare("real(c_double), intent(in)", f"({FIXED[what]})")
        elif what in ROWS:
            intent = "in" if kind.startswith("const") else "inout"
            self.declare(f"real(c_double), intent({intent}), contiguous", "(:, :)")
            self.rows, self.size = True, f"size({self.what}, 2, c_int64_t)"
        elif what in LISTS:
            self.of_tuples(LISTS[what])
        else:
            self.of_list(*KINDS["int64" in kind][:2])

    def of_place(self, first):
        """The place for a number; `first` is the one that C calls 0."""
        self.declare("integer, intent(out)")
        self.local("integer(c_int64_t)", "(1)")
        self.first = [f"if (present({self.what})) {self.what} = 0", f"{self.passed} = {-first}"]
        self.after = [f"if (present({self.what})) {self.what} = int({self.passed}(1)){' + 1' * first}"]

    def of_output(self, sizes, are_indices):
        kind, in_c, zero = KINDS[are_indices]
        shape = f"({', '.join(':' * len(sizes))})"
        self.declare(f"{kind}, allocatable, intent(out)", shape)
        self.local(f"{in_c}, allocatable", shape)
        self.before = [f"allocate ({self.passed}({', '.join(sizes)}), source={zero})"]
        found = f"int({self.passed}) + 1" if are_indices else self.passed
        self.after = [f"{f'if (present({self.what})) ' * self.optional}{self.what} = {found}"]

    def of_text(self, is_as_it_is):
        self.declare("character(*), intent(in)")
        if self.optional:
            self.local("character(:), allocatable")
            self.before = [f"call to_c_if({self.what}, {self.passed})"]
        elif not is_as_it_is:
            self.passed = f"to_c({self.what})"

    def of_tuples(self, width):
        self.declare("integer, intent(in)", "(:, :)")
        refusal = f'  call refuse(hooke_bad_value, "{self.what} have the shape ({width}, n)", status)'
        self.before = [f"if (size({self.what}, 1) /= {width}) then", refusal, "  return", "end if"]
        self.passed, self.size = f"zero_based({self.what})", f"size({self.what}, 2, c_int64_t)"

    def of_list(self, kind, in_c):
        """One number or several."""
        self.declare(f"{kind}, intent(in)", "(..)")
        self.local(f"{in_c}, allocatable", "(:)")
        self.before, self.size = [f"call to_list({self.what}, {self.passed})"], f"ubound({self.passed}, 1, c_int64_t)"

    def of_number(self, kind, what):
        words = {"double": "real(c_double)", "int64_t": OF_KINDS.get(what, "integer")}.get(kind, DEFAULTS.get(what, "integer"))
        self.declare(f"{words}, intent(in)")
        if what in DEFAULTS:
            self.local(words if kind == "double" else "integer(c_int32_t)")
            self.before = [f"{self.passed} = 0", f"if (present({what})) {self.passed} = {CONVERTED[kind].format(what)}"]
        elif what == "frame":
            refusal = '  call refuse(hooke_bad_value, "frame 0: frames count from 1, from the end with -1", status)'
            self.before, self.passed = ["if (frame == 0) then", refusal, "  return", "end if"], "from_zero(frame)"
        elif words in ("integer", OF_KINDS["steps"]):
            is_number = kind == "int32_t" or what in COUNTS
            self.passed = f"int({self.what}, c_{kind})" if is_number else f"zero_based({self.what})"


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
        number = f"to_integer({{}}){' + 1' if name.endswith(('_find', '_particle')) else ''}"
        return ("integer", number) if name.endswith(NUMBERS) else ("integer(c_int64_t)", "{}")
    return ("logical", "{} == 1") if "_is_" in name else ("integer", "int({})")


def partial_call(function, whats, passed, absent):
    """A call without some of its arguments, after which the others go by name."""
    given = [what for what in whats if what not in absent]
    first = next((k for k, what in enumerate(whats) if what in absent), len(whats))
    return f"{function}({', '.join(passed[what] if whats.index(what) < first else f'{what}={passed[what]}' for what in given)})"


class Procedure:
    """A function of C as a procedure of the type `own`, or of none."""

    def __init__(self, function, own, every):
        self.result, self.name, parameters = function
        self.own, self.every, self.short = own, every, self.name[len("hooke_"):]
        last_kind, last = parameters[-1] if parameters else ("", "")
        mine = [(kind, what) for kind, what in parameters if own and object_of(kind) == IN_C.get(own, own)]
        self.self_, itself = mine[0] if mine else (None, None)
        self.makes = last_kind.endswith("**")
        self.takes_self = bool(mine or (own and not self.makes))
        # what is made or written is the object itself, another object, or the result of a function
        self.made = RENAMED.get((self.name, last), last) if self.makes and mine else "self"
        self.filled = last if self.result == "void" and last in FIXED else None
        told = counts(parameters)
        given = {what: Parameter(function, kind, what, own) for kind, what in parameters
                 if what not in {itself, self.filled, *told} and (kind, what) not in BY_OTHERS and not kind.endswith("**")}
        force = next((p for p in given.values() if p.callback), None)
        passed = {itself: "self%address()", **self.passing(given, told, force), last if self.makes else None: "made"}
        self.call_without = lambda absent: partial_call(f"c_{self.short}", [what for _, what in parameters], passed, absent)
        self.call = self.call_without([])
        self.fit = self.fitting(given, {what: passed[count] for count, arrays in told.items() for what in arrays})
        self.given = sorted(given.values(), key=lambda p: p.rank)
        place = 0 if self.name in SEVERAL else 10 + every.index(function)
        self.keep = f"call {self.made}%keep(callback, {place}, " if force else None

    def passing(self, given, told, force):
        """What C is given for each parameter but objects of its own type."""
        others = {"ctx": "callback%data", "length": "len(text, c_int64_t)", self.filled: "found"}
        if force:
            others["product"] = f"product_of_{force.callback[len('hooke_'):]}({force.what})"
        sizes = {count: given[arrays[0]].size for count, arrays in told.items()}
        return {**others, **sizes, **{what: p.passed for what, p in given.items()}}

    def fitting(self, given, count_of):
        """Lines that return where arrays of rows have not as many as they should: as a list, or one a particle."""
        status = ", status" if headers.is_status(self.result, self.name) else ""
        lines = []
        for what, p in given.items():
            count = count_of.get(what, "int(self%particle_count(), c_int64_t)")
            fits = f"if (.not. is_3_by({p.what}, {count}{status})) return"
            if p.rows:  # an array that is not there has no bounds
                lines += [f"if (present({p.what})) then", f"  {fits}", "end if"] if p.optional else [fits]
        return lines

    def taking(self):
        """Lines that take the object that is made."""
        objects = [(p.what, p.object) for p in self.given if p.object]
        owner = next((f", {what}" for what, type_ in [("self", self.own)] * self.takes_self + objects
                      if type_ != "hooke_options"), "")
        return [f"code = {self.call}", f"if (code == 0) call {self.made}%take(made, {ender(self.own, self.every)[0]}{owner})"]

    def body(self):
        """(locals, statements) of a procedure that returns a status."""
        needed = [*(["self"] if self.takes_self else []), *(p.what for p in self.given if p.object)]
        body = [line for p in self.given for line in p.first]
        body += [f"if (missing(status, {', '.join(needed)})) return"] if needed else []
        body += [line for p in self.given for line in p.before] + self.fit
        call, locals_ = self.call, []
        if self.makes:
            body += self.taking()
            call, locals_ = "code", ["type(c_ptr) :: made", "integer(c_int32_t) :: code"]
        body.append(f"{self.keep}{call}, status)" if self.keep else f"call accept({call}, status)")
        return locals_, body + [line for p in self.given for line in p.after]

    def lines(self):
        """The whole procedure."""
        whats, before = [p.what for p in self.given], [line for p in self.given for line in p.before]
        is_const = (self.self_ or "const").startswith("const") and (not self.makes or self.made != "self")
        head = [f"class({self.own}_queries), intent({'in' if is_const else 'inout'}) :: self"] if self.own else []
        head += [p.declared for p in self.given]
        first, kind, found = [line for p in self.given for line in p.locals], "subroutine", ""
        if self.made != "self":
            whats, head = [*whats, self.made], [*head, f"class({self.own}_queries), intent(inout) :: {self.made}"]
        if headers.is_status(self.result, self.name):
            locals_, body = self.body()
            place = sum(p.rank < 3 for p in self.given) + (self.made != "self")
            whats.insert(place, "status")
            head, first = [*head, "integer, intent(out), optional :: status"], [*first, *locals_]
        elif self.result == "void" and not self.filled:
            body = [*before, f"call {self.call}", *([f"{self.keep}0_c_int32_t)"] if self.keep else [])]
        else:
            of_result, made = answer("double" if self.filled else self.result, self.name, whats)
            is_series = self.result == "const double *"
            shape = f"({FIXED[self.filled]})" if self.filled else "(:)" * is_series
            kind, found, first = "function", " result(found)", [f"{of_result} :: found{shape}", *first]
            call = f"call {self.call}" if self.filled else f"found {'=>' if is_series else '='} {made.format(self.call)}"
            body = [*(["found = 0", *self.fit] if self.fit else []), *before, call]
        title = f"  {kind} {self.short}({', '.join([*(['self'] if self.own else []), *whats])}){found}"
        body = [one for line in body for one in self.by_presence(line)]
        return [*wrapped([title]), *(f"    {line}" for line in wrapped([*head, *first, *body])), f"  end {kind}", ""]

    def by_presence(self, line):
        """The line as it is for all rows that may be absent, present and absent: passed on, an absent array would have its
        bounds computed."""
        rows = [p.what for p in self.given if p.rows and p.optional]
        if self.call not in line or not rows:
            return [line]
        lines = []
        for there in [rows, *([one] for one in rows if len(rows) > 1)]:
            condition = " .and. ".join(f"present({what})" for what in there)
            absent = [what for what in rows if what not in there]
            lines += [f"{'else ' * bool(lines)}if ({condition}) then", "  " + line.replace(self.call, self.call_without(absent))]
        return [*lines, "else", "  " + line.replace(self.call, self.call_without(rows)), "end if"]


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
    """Lines that are too long for Fortran, in pieces."""
    for line in lines:
        while len(line) >= 120 and (comma := line.rfind(", ", 0, 110) + 1):
            yield f"{line[:comma]} &"
            line = f"  {line[comma + 1:]}"
        yield line


def of_word(name):
    """One procedure of WORDS as lines."""
    result, query, word, *asked = WORDS[name]
    short, of = name[len("hooke_"):], "_".join(name.split("_")[:2])
    kind, made = answer(result, name, asked)
    given = "".join(f', 0_c_int64_t, to_c({what})' for what in asked)
    call = f'c_{query[len("hooke_"):]}(self%address(), to_c("{word}"){given})'
    return [f"  function {short}({', '.join(['self', *asked])}) result(found)", f"    class({of}_queries), intent(in) :: self",
            *(f"    character(*), intent(in) :: {what}" for what in asked),
            f"    {kind} :: found", f"    found = {made.format(call)}", "  end function", ""]


def is_query(function, type_, types, by_hand):
    """Whether a function of C is made a procedure of `type_`, or of no type."""
    result, name, parameters = function
    arrays = {what for arrays in counts(parameters).values() for what in arrays}
    rows = ROWS if type_ == "hooke_system" else set()
    kinds = [kind for kind, what in parameters if what not in {"ctx", *arrays, *FIXED} and kind[-1] == "*"
             and not (kind.endswith("double *") and what in rows) and (name, what) not in OUTPUTS
             and not (kind == "int64_t *" and name.startswith("hooke_system_add_"))]
    makes = bool(kinds) and kinds[-1].endswith("**")
    made = makes and object_of(kinds.pop()[:-1]) == IN_C.get(type_, type_)
    known = {*types, *IN_C.values()}
    plain = all(kind == "const char *" or object_of(kind) in known or callbacks.of_callback(object_of(kind) or "")
                for kind in kinds)
    mine = belongs(name, types)[0] == type_ or (type_, name) in ALSO
    if type_ is None:
        mine = not any(object_of(kind) for kind in kinds)
    elif not makes:
        mine = mine and IN_C.get(type_, type_) in [object_of(kind) for kind in kinds]
    return (mine and plain and made == makes and result in RESULTS and name not in WORDS
            and not name.endswith(("_destroy", "_close")) and "c_" + name[len("hooke_"):] not in by_hand)


def bindings(name, short):
    """The procedure of a type as lines; of steps it has one for each kind of whole numbers."""
    if short not in STEPS:
        return [f"    procedure :: {short} => {name}"]
    return [f"    procedure, private :: {name}, {name}_long", f"    generic :: {short} => {name}, {name}_long"]


def of_long(lines, name):
    """A procedure that takes steps, as lines, for those that are too many for a default integer."""
    short = name[len("hooke_"):]
    text = "\n".join(lines).replace(f" {short}(", f" {short}_long(").replace("int(steps, c_int64_t)", "steps")
    return text.replace(f"{OF_KINDS['steps']}, intent(in) :: steps", "integer(c_int64_t), intent(in) :: steps").split("\n")


def of_type(type_, named, names, ended):
    """A type with its procedures, and the assignment that makes another reference to the same object."""
    bound = [line for name, short in names for line in bindings(name[len("hooke_"):], short)]
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
    procedures = [(f[1], Procedure(f, type_, every).lines()) for f in functions]
    procedures += [(name, of_long(lines, name)) for name, lines in procedures if belongs(name, types)[1] in STEPS]
    lines = [line for _, lines in procedures for line in lines]
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
            "  use hooke_base, only: accept, from_zero, hooke_bad_value, hooke_stopped, is_3_by, refuse, to_c, to_c_if, &",
            "    to_integer, to_list, to_number, to_series, to_text, zero_based", *uses,
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
