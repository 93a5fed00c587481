"""Options by name, from the tables of the library."""

import re

import numpy as np
import pytest
from conftest import ROOT

import hooke


def test_the_tables_are_those_of_the_library():
    assert {"method", "step", "duration", "every", "rtol", "atol", "atol_velocity"} <= set(
        hooke.Options.for_run()
    )
    of_springs = ("law", "stiffness", "damping", "damping_ratio", "curve", "rest_length", "rest_scale", "stiffness_scale", "compression")
    assert set(of_springs) == {name for name in hooke.Options.for_springs() if "." not in name}
    assert {"rope", "cloth", "lattice", "mesh"} <= set(hooke.part_kinds())
    step = next(row for row in hooke.Options.for_run().rows if row.name == "step")
    assert step.unit == "s" and step.type == "number" and step.doc
    for what, options in [
        ("run", hooke.Options.for_run()),
        ("study", hooke.Options.for_study()),
        ("springs", hooke.Options.for_springs()),
        ("rope", hooke.Options.for_part("rope")),
        ("cloth", hooke.Options.for_part("cloth")),
    ]:
        text = hooke.describe(what)
        assert len(text.splitlines()) == len(options) and all(name in text for name in options)


def units_of_data():
    """{base: {unit: its value in the base}}"""
    lines = (ROOT / "tests/data/units.txt").read_text().splitlines()
    rows = [dict(pair.split(" = ") for pair in line.split(", ")) for line in lines if line[0] != "#"]
    return {next(iter(row)): {unit: float(value) for unit, value in row.items()} for row in rows}


def tables():
    """Names of all tables of options, from the message that lists them."""
    with pytest.raises(hooke.BadValue) as refused:
        hooke.options_of("no such table")
    return re.search("there are those for (.*)", str(refused.value))[1].split(", ")


def test_every_unit_of_every_table_is_what_it_is_elsewhere():
    known, read = units_of_data(), set()
    for table in tables():
        options = hooke.options_of(table)
        for row in options.rows:
            bases = [base.split(" (")[0] for base in row.unit.split(", ") if base]
            assert row.units == [unit for base in bases for unit in known[base]], (table, row.name)
            for base, unit in ((b, unit) for b in bases for unit in known[b]):
                options[row.name] = ", ".join([f"0.25 {unit}"] * (row.min_count or 1))
                found = np.ravel(options[row.name])
                assert found == pytest.approx(np.full(len(found), 0.25 * known[base][unit]), rel=1e-14, abs=0), (table, row.name, unit)
                read.add((base, unit))
    assert read == {(base, unit) for base, units in known.items() for unit in units}


def test_numbers_of_a_part_may_name_units():
    square = {"size": (4, 4), "edges": [[1, 0, 0], [0, -1, 0]]}
    plain = hooke.Scene().cloth(mass=0.2, structural={"stiffness": 2e3, "damping": 1e-3}, **square).system
    named = hooke.Scene().cloth(mass="200g", structural={"stiffness": "2kN", "damping": "1 mN s"}, **square).system
    assert all(np.array_equal(a, b) for a, b in zip(plain.spring_material, named.spring_material))
    assert np.array_equal(plain.inverse_masses, named.inverse_masses)
    with pytest.raises(hooke.BadValue, match="mass: there is no unit 'mg/m' here; allowed: kg, t, g, mg, ug, lb;"):
        hooke.Scene().cloth(mass="200 mg/m", structural={"stiffness": "2kN"}, **square).system


def test_a_row_says_all_that_the_library_knows():
    def row(what, name):
        return next(row for row in hooke.options_of(what).rows if row.name == name)

    size, pinned, stiffness = (row("cloth", name) for name in ("size", "pinned", "shear.stiffness"))
    assert (size.min_count, size.max_count, size.low, size.whole, size.required) == (2, 2, 2, True, True)
    assert row("cloth", "edges").columns == 3 and size.columns is None
    assert pinned.words == ["corners", "top", "top-corners"] and pinned.word_lists and not pinned.required
    assert (pinned.min_count, pinned.max_count) == (None, None)
    assert (stiffness.family, stiffness.low, stiffness.above_low, stiffness.required) == ("shear", 0, False, True)
    assert row("run", "step").above_low and row("run", "newton").words == ["converged", "one-iteration"]
    assert row("springs", "law").low is None
    assert {row.name for row in hooke.options_of("scene").rows} == {
        "title", "gravity", "drag", "quadratic_drag", "wind", "wind.time", "wind.velocity", "dynamics", "start", "start.position", "start.velocity"}
    assert row("particles", "position").required and row("driven", "frequency").unit == "Hz"
    for kind in hooke.part_kinds():
        assert hooke.part_kind_summary(kind)
        assert all(row.example for row in hooke.options_of(kind).rows if row.required), kind
    with pytest.raises(hooke.BadValue, match="no options for"):
        hooke.options_of("wheel")


def test_numbers_words_flags_and_arrays():
    options = hooke.Options.for_springs()
    assert options["law"] == "strain" and options["damping"] == 0 and options["stiffness"] is None
    assert options["compression"] is True and options["rest_length"] == "initial"
    options.set(
        law="length", stiffness=[1, 2.5, 3], damping=np.float32(0.5), compression=False, rest_length=0
    )
    assert options["law"] == "length" and options["compression"] is False and options["rest_length"] == 0
    np.testing.assert_array_equal(options["stiffness"], [1, 2.5, 3])
    assert options["damping"] == 0.5 and isinstance(options["damping"], float)
    run = hooke.Options.for_run().set(max_order=5)
    assert run["max_order"] == 5 and isinstance(run["max_order"], int)


def test_values_are_taken_back():
    options = hooke.Options.for_run()
    options["rtol"] = 1e-3
    assert options.is_set("rtol")
    del options["rtol"]
    assert not options.is_set("rtol") and options["rtol"] == 1e-6
    options["rtol"] = 1e-4
    options["rtol"] = None
    assert options["rtol"] == 1e-6


def test_families_are_dicts():
    options = hooke.Options.for_part("cloth").set(
        origin=[0, 0, 0],
        edges=[[1, 0, 0], [0, 0, 1]],
        size=[3, 4],
        structural={"stiffness": 50, "damping": 0.5},
    )
    assert options["structural.stiffness"] == 50 and options["structural.damping"] == 0.5
    assert options["size"].tolist() == [3, 4] and options["size"].dtype == np.int64
    options["pinned"] = ["top-corners", 5]
    assert options["pinned"] == ["top-corners", 5]


def test_a_python_keyword_as_a_name():
    options = hooke.Options.for_part("rope").set(from_=[0, 0, 0], to=[1, 0, 0])
    assert options["from"].tolist() == [0, 0, 0]


def test_copies_are_separate():
    options = hooke.Options.for_run().set(step=0.5)
    other = options.copy()
    other["step"] = 0.25
    assert options["step"] == 0.5 and "step=0.5" in repr(options)


@pytest.mark.parametrize(
    "name, value",
    [
        ("stiffness", -1),
        ("stiffness", float("nan")),
        ("stiffness", "soft"),
        ("stiffness", object()),
        ("stiffness", [1, None]),
        ("stiffness", 1j),
        ("law", "hooke"),
        ("law", 3),
        ("compression", 2),
        ("stifness", 1),
    ],
)
def test_bad_values_name_the_option(name, value):
    options = hooke.Options.for_springs()
    with pytest.raises(hooke.BadValue, match=name):
        options[name] = value
    assert not any(options.is_set(known) for known in options)


def test_reading_an_unknown_name_is_a_key_error():
    options = hooke.Options.for_run()
    with pytest.raises(KeyError):
        options["stepp"]
    with pytest.raises(KeyError):
        del options["stepp"]
    assert "stepp" not in options and options.get("stepp") is None


def test_an_unknown_keyword_of_a_run_is_refused(system):
    with pytest.raises(hooke.BadValue, match="stepp"):
        hooke.run(system, stepp=1)


def test_the_options_of_an_integrator_are_complete_and_fixed(system):
    integrator = hooke.Integrator(system, method="forward-euler", step=1e-3, duration=0.5)
    assert integrator.options["every"] == pytest.approx(0.005)
    extent = np.linalg.norm(np.ptp(system.state().q, axis=0))
    assert integrator.options["atol"] == pytest.approx(1e-9 * extent, rel=1e-14, abs=0)
    assert integrator.options["atol_velocity"] == pytest.approx(integrator.options["atol"] / 0.5, rel=1e-14, abs=0)
    with pytest.raises(hooke.BadCall):
        integrator.options["step"] = 1


def test_lists_of_words():
    study = hooke.Options.for_study()
    study["methods"] = (word for word in ("rk4", "verlet"))
    study["watch"] = ["energy", "57.y"]
    assert (study["methods"], study["watch"]) == ("rk4,verlet", "energy,57.y")
    scene = hooke.Options.for_scene()
    for wrong in (5, b"ab", (1, 2), {"a": 1}):
        with pytest.raises(hooke.BadValue):
            scene["title"] = wrong


def test_a_number_or_what_follows_time():
    springs = hooke.Options.for_springs().set(stiffness=3, rest_scale={"motion": "harmonic", "amplitude": 0.2, "frequency": 1})
    assert springs["rest_scale"] is None and springs["rest_scale.amplitude"] == 0.2 and springs["rest_scale.mean"] == 1
    springs["rest_scale"] = 0.9  # the last one counts
    assert springs["rest_scale"] == 0.9 and not springs.is_set("rest_scale.motion")
    springs["rest_scale.motion"] = "table"
    assert springs["rest_scale"] is None and springs.is_set("rest_scale")
    with pytest.raises(hooke.BadValue, match=r"rest_scale\.frequency.*>= 0"):
        springs["rest_scale"] = {"motion": "harmonic", "amplitude": 0.2, "frequency": -1}
