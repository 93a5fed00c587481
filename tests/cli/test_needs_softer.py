"""How soft `needs` says that the stiff springs of twenty random scenes may be, against an independent integrator
(tests/data/softer.json has its numbers and says which one)."""

import json
from pathlib import Path

import numpy as np
import pytest

DATA = json.loads((Path(__file__).parents[1] / "data" / "softer.json").read_text())
CASES = [pytest.param(case, id=str(k), marks=[pytest.mark.check] if k > 1 else []) for k, case in enumerate(DATA["scenes"])]


@pytest.mark.parametrize("case", CASES)
def test_offered_factors_keep_the_want_and_the_next_ones_break_it(hooke, write, case):
    answer = hooke("needs", write(case["scene"]), "--want", case["want"], "--json")
    assert answer.code == 0, answer.err
    offered = {row["quantity"]: row for row in answer.json["degrees"]}
    for group, table in case["softer"].items():
        row, (times, change) = offered[f"{group}.stiffness"], np.log(table).T

        def true(factor, times=times, change=change):
            return np.exp(np.interp(-np.log(factor), times, change))

        assert times[0] < -np.log(row["factor"]) and -np.log(row["beyond"]) < times[-1], (group, row)
        for factor, error in ((row["factor"], row["error"]), (row["beyond"], row["error_beyond"])):
            assert error == pytest.approx(true(factor), abs=0.1 * case["want"]), (group, row)
        assert true(row["factor"]) <= case["want"] < true(row["beyond"]), (group, row)
