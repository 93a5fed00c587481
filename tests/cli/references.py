"""Scenes with solutions to 15 digits, from tests/data/*.inc, which hold them as initialisers of a C struct."""

import re
from pathlib import Path

DATA = Path(__file__).resolve().parents[1] / "data"
TOKEN = re.compile(r'"[^"]*"|\.[a-z]\w*|[{}=,]|-?\d[\d.]*(?:e[-+]?\d+)?')


def parse(text):
    """The initialisers in `text`: {".name": value} or a list, nested."""
    text = re.sub(r"/\*.*?\*/|\(const [^)]*\)", "", text, flags=re.DOTALL)
    tokens = TOKEN.findall(text)

    def members(at):
        found, names = [], []
        while at < len(tokens) and tokens[at] != "}":
            if tokens[at] == ",":
                at += 1
                continue
            if tokens[at].startswith("."):
                names.append(tokens[at][1:])
                assert tokens[at + 1] == "=", tokens[at : at + 3]
                at += 2
            if tokens[at] == "{":
                value, at = members(at + 1)
                assert tokens[at] == "}"
            else:
                value = tokens[at].strip('"') if tokens[at].startswith('"') else float(tokens[at])
            found.append(value)
            at += 1
        assert len(names) in (0, len(found)), names
        return (dict(zip(names, found)) if names else found), at

    value, end = members(0)
    assert end == len(tokens)
    return value


def triples(numbers):
    return [numbers[k : k + 3] for k in range(0, len(numbers), 3)]


class Reference:
    """One of them: `scene`, and `positions[time]`."""

    def __init__(self, name):
        data = parse((DATA / f"{name}.inc").read_text())
        mass = data["mass"]
        self.pinned = [int(index) for index in data["pinned"]]
        self.scene = {
            "hooke": 1,
            "particles": {
                "position": triples(data["position"]),
                "mass": mass[0] if len(mass) == 1 else mass,
                "pinned": self.pinned,
            },
            "springs": [self.group(group) for group in data["group"]],
        }
        if "gravity" in data:
            self.scene["gravity"] = data["gravity"]
        self.positions = {state["time"]: triples(state["position"]) for state in data["state"]}

    @staticmethod
    def group(group):
        ends = [int(end) for end in group["ends"]]
        rest = {} if group["rest_length"] < 0 else {"rest_length": group["rest_length"]}
        return {
            "name": group["name"],
            "between": [ends[k : k + 2] for k in range(0, len(ends), 2)],
            "law": group["law"],
            "stiffness": group["stiffness"],
            "damping": group["damping"],
            "rest_scale": group["rest_scale"],
            **rest,
        }

    def distance(self, time, positions):
        """Root mean square distance of the free particles from the solution [m]."""
        squares = [
            sum((a - b) ** 2 for a, b in zip(here, there))
            for k, (here, there) in enumerate(zip(positions, self.positions[time]))
            if k not in self.pinned
        ]
        return (sum(squares) / len(squares)) ** 0.5
