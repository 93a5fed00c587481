"""What holds for the error that a run prints: it is not below the true one, and where it is not known, the output says why."""

LOW = 3.0  # allowed factor by which a printed error may be below the true one
ABOVE = 10.0  # and above it, where a case names no other


def farthest(a, b):
    """The largest distance of two rows of three [m]."""
    return max(sum((x - y) ** 2 for x, y in zip(one, other)) ** 0.5 for one, other in zip(a, b, strict=True))


def complaints(printed, error, above=float("inf")):
    """For `printed`, the key "error" of a run, and its true largest error [m]."""
    figure = printed["estimate"]
    if figure is None:
        return [] if printed.get("reason") else ["is not known, and nothing says why"]
    found = [f"is printed as {figure:.3g} m, but is {error:.3g} m"] if error > LOW * figure else []
    return found + ([f"is printed as {figure:.3g} m, but is only {error:.3g} m"] if figure > above * error else [])


def covers(printed, error, known=0.0):
    """Whether it is not below an error that is known to within `known`; an error that is not known claims nothing."""
    return printed["estimate"] is None or error <= printed["estimate"] + known
