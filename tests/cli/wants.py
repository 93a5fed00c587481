"""Requirements on a run that states its error, or that a wanted error is met: the statement is true."""

import json
import math
from pathlib import Path

DATA = Path(__file__).resolve().parents[1] / "data/wants.json"
WANTS = {"1cm": 1e-2, "1mm": 1e-3, "10um": 1e-5}
FLOOR = 1e-12  # [m] below which errors are rounding
WITHIN = 0.1  # of a want: how well the solution has to be known for a claim
IMPLICIT = ("backward-euler", "tr-bdf2", "implicit-midpoint", "cvode-bdf")
SOLVE = 50  # evaluations of forces that a solve counts for: 20 to 80 in scenes as small as these


def cost(method, evaluations):
    """In evaluations of forces; implicit methods solve after each."""
    return evaluations * (1 + SOLVE * (method in IMPLICIT))


def distance(free, a, b):
    """The largest distance of a free particle [m]; 3n numbers each."""
    return max(math.dist(a[3 * p : 3 * p + 3], b[3 * p : 3 * p + 3]) for p in free)


def at_end(time, end):
    """Steps do not add up to the last digit."""
    return abs(time - end) <= 1e-9 * end


class End:
    """Final positions of the particles of a scene, from tests/data/wants.json."""

    def __init__(self, data):
        self.data = data
        self.scene = Path(__file__).resolve().parents[2] / data["scene"]

    def error(self, value):
        """Of a run with --final."""
        assert at_end(value["time"], self.data["time"])
        found = [x for row in value["final"]["position"] for x in row]
        return distance(self.data["free"], found, self.data["position"])

    def best(self, asked):
        """The minimum cost of the want."""
        return min(cost(method, evaluations) for method, evaluations in self.data["best"][asked].items())


ENDS = {Path(one["scene"]).stem: End(one) for one in json.loads(DATA.read_text())}


def complaints(code, value, known, error, want):
    """For a run with a want [m], whose error at the end is `error` if it is `known`: None if the solution took too
    long, False if it depends on the last digits."""
    if code not in (0, 7):
        return [f"exit {code}"]
    met, found = value.get("want", {}).get("met"), []
    if (code == 0) != (met is True):
        found.append(f"exit {code} with met {met}")
    if code == 0 and known and not error <= want:
        found.append(f"claims {want} m, but is off by {error:.3g} m")
    if code == 0 and known is False:
        found.append("claims what nobody can know")
    return found + estimate_complaints(value, error if known else math.nan)


def is_of_the_end(value):
    """Whether the error is known up to the end."""
    estimate, until = (value.get("error", {}).get(key) for key in ("estimate", "known_until"))
    return estimate is not None and at_end(until, value["time"])


def estimate_complaints(value, error):
    """The error at the end is at most that of all frames."""
    if not is_of_the_end(value) or math.isnan(error):
        return []
    estimate = value["error"]["estimate"]
    if error <= estimate or error <= FLOOR:
        return []
    return [f"is estimated as {estimate:.3g} m by {value['error']['by']}, but is {error:.3g} m"]


def study_complaints(code, value, again, error, want, known=True):
    """For a study with a want, whose recommended run, repeated, ended with the code `again` and has the error
    `error`, if that is `known`."""
    met = value["recommendation"]["met"]
    whole = value["reference"]["trusted_until"] >= value["duration"] * (1 - 1e-9)
    found = [] if (code == 0) == (met is True) and code in (0, 7) else [f"exit {code} with met {met}"]
    if met and again != 0:
        found.append(f"the recommended run ends with exit {again}")
    if met and not whole:
        found.append("recommends for all of the run what is trusted for a part of it")
    if not whole:
        return found  # its recommendation holds for the time until then
    if met and again == 0 and known is False:
        found.append("recommends what nobody can know")
    elif met and again == 0 and known and not error <= want:
        found.append(f"recommends for {want} m what is off by {error:.3g} m")
    return found
