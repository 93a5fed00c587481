"""Fortran types for the callbacks of C: an abstract type of each kind, which users extend, and the function by which C
calls its procedure."""

import textwrap
from itertools import chain

import headers

FORCE = "Called with every q and v that a method tries, never concurrently for one integrator."
PRODUCT = "with its derivative, which replaces difference quotients: adds (df/dq) dq + (df/dv) dv to `out`."
# By type: the type that it extends, the callback of C, the procedure, the shape of arrays, the intent of
# results, and what it is.
TYPES = {
    "hooke_force": (None, "hooke_force", "add", "3, n", "inout",
                    f"A force on all particles: adds newtons to `force`. {FORCE}"),
    "hooke_force_with_product": ("hooke_force", "hooke_force_product", "add_product", "3, n", "inout", f"A force {PRODUCT}"),
    "hooke_coordinate_force": (None, "hooke_force", "add", "n", "inout",
                               f"A force f of q'' = W f(t, q, v): adds it to `force`, which is zero. {FORCE}"),
    "hooke_coordinate_force_with_product": ("hooke_coordinate_force", "hooke_force_product", "add_product", "n", "inout",
                                            f"A force f {PRODUCT}"),
    "hooke_drive": (None, "hooke_drive", "move", "3, n", "out",
                    "A prescribed motion: sets position [m] and velocity [m/s] of the driven particles, by t alone."),
    "hooke_rate": (None, "hooke_rate", "evaluate", "n", "out", "The right-hand side of x' = phi(t, x)."),
    "hooke_observer": (None, "hooke_observer", "see", "", "",
                       "Receives the state after `step` steps; must not change it, nor keep it."),
    "hooke_progress": (None, "hooke_progress", "tell", "", "",
                       "Receives progress: the fraction done (0..1) and the name of the running task."),
    "hooke_warning": (None, "hooke_warning", "warn", "", "",
                      'Receives a warning that the step is no longer safe: "near-limit", "above-limit" or "never-stable"; '
                      "the bound [s]; and what determines it, 0 for no spring."),
}


def of_callback(callback, function=""):
    """The type that stands for a callback of C in procedures that are made; None if there is no such type."""
    names = [name for name, row in TYPES.items() if row[1] == callback]
    return next((name for name in names if "coordinate" in name or "second_order" not in function), None)


def product_of(parent, name):
    """The function that finds what C calls for the product of a force, as lines."""
    of, call = f"product_of_{headers.short(parent)}", f"call_{headers.short(name)}"
    return [f"  type(c_funptr) function {of}(force)", f"    class({parent}), intent(in), optional :: force",
            f"    {of} = c_null_funptr", "    if (.not. present(force)) return", "    select type (force)",
            f"    class is ({name})", f"      {of} = c_funloc({call})", "    end select", "  end function", ""]


# Of parameters that are no arrays: the type for users, that for C, and what is passed on.
SCALARS = {"const hooke_state *": ("type(hooke_state)", "type(c_ptr)", "seen"),
           "const char *": ("character(*)", "type(c_ptr)", "to_text({})"), "double": ("real(c_double)", "real(c_double)", "{}"),
           "int64_t": ("integer", "integer(c_int64_t)", "int({}) + 1"), "count": ("integer", "integer(c_int64_t)", "int({})"),
           "step": ("integer(hooke_long)", "integer(c_int64_t)", "{}")}


def argument(kind, what, shape, intent):
    """(declaration for users, declaration for C, what is passed on) of one parameter of a callback."""
    if kind in SCALARS:
        outside, inside, passed = SCALARS.get({"n": "count"}.get(what, what), SCALARS[kind])
        return f"{outside}, intent(in) :: {what}", f"{inside}, value :: {what}", passed.format(what)
    array = f"real(c_double), intent({'in' if kind.startswith('const') else intent}) :: {what}({shape})"
    return array, array, what


def pieces(name, row, parameters):
    """The type, the interface of its procedure, and the function for C, each as lines."""
    parent, _, procedure, shape, intent, doc = row
    parameters = [(kind, "n" if what == "count" else what) for kind, what in parameters if what != "ctx"]
    arguments = [argument(kind, what, shape, intent) for kind, what in parameters]
    whats, short = ", ".join(what for _, what in parameters), headers.short(name)
    seen = "const hooke_state *" in [kind for kind, _ in parameters]
    type_ = [*textwrap.wrap(doc, 108, initial_indent="  ! ", subsequent_indent="  ! "),
             f"  type, abstract{f', extends({parent})' if parent else ''} :: {name}", "  contains",
             f"    procedure({short}_{procedure}), deferred :: {procedure}", "  end type", ""]
    interface = [f"    subroutine {short}_{procedure}(self, {whats}, stop_value)", "      import",
                 f"      class({name}), intent(inout) :: self", *(f"      {a[0]}" for a in arguments),
                 "      integer, intent(inout) :: stop_value", "    end subroutine", ""]
    call = [f"  integer(c_int32_t) function call_{short}({whats}, ctx) bind(c, name=\"\")", *(f"    {a[1]}" for a in arguments),
            "    type(c_ptr), value :: ctx", "    type(called_object), pointer :: called", "    integer :: stop_value",
            *(["    type(hooke_state) :: seen"] if seen else []), "    call c_f_pointer(ctx, called)", "    stop_value = 0",
            *(["    call seen%lend(state)"] if seen else []), "    select type (it => called%it)", f"    class is ({name})",
            f"      call it%{procedure}({', '.join(a[2] for a in arguments)}, stop_value)", "    end select",
            *(["    call seen%lend(c_null_ptr)"] if seen else []), f"    call_{short} = int(stop_value, c_int32_t)",
            "  end function", ""]
    return type_, interface, call


def module(public):
    """(types, interfaces, procedures) of the module as lines, from {header: text}."""
    found = {name: parameters for _, name, parameters in headers.declared("".join(public.values()), "typedef")}
    types, interfaces, calls = zip(*(pieces(name, row, found[row[1]]) for name, row in TYPES.items()))
    products = [product_of(row[0], name) for name, row in TYPES.items() if row[0]]
    declared = ["  abstract interface", *[*chain(*interfaces)][:-1], "  end interface"]
    return [*chain(*types)], declared, [*chain(*calls, *products)]
