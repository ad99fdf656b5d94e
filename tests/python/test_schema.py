"""The schema of grid files that `flap generate schema` prints, as validators of JSON schemas understand it."""

import functools
import json
import tomllib

import pytest
from jsonschema import Draft202012Validator
from pages import BLOCK, REPOSITORY, pages, text_of


@pytest.fixture(scope="module")
def validator(flap):
    """A function that returns the validator for a schema, from the arguments of `flap generate schema`."""

    @functools.cache
    def made(*arguments: str) -> Draft202012Validator:
        schema = json.loads(flap("generate", "schema", *arguments).stdout)
        Draft202012Validator.check_schema(schema)
        return Draft202012Validator(schema)

    return made


def mistakes(validator: Draft202012Validator, grid: str) -> list[str]:
    """Return the mistakes in a grid file: where each is, and its message."""
    errors = validator.iter_errors(tomllib.loads(grid))
    return ["".join(f"/{key}" for key in error.absolute_path) + f": {error.message}" for error in errors]


FORMS = [
    "[params]\nwing_area = 54e-6",
    '[params]\nwing_area = "54 mm^2"',
    '[params]\nwing_area = " 5.4e1mm²"',
    '[params]\nactuator_extension_ratio = "5 %"',
    '[params]\nactuator_extension_ratio = ".05"',
    '[params]\ndrive_frequency = "resonance"\n[resonance]\nof = "lift"\nfrom = "90 Hz"\ntolerance = 0.1',
    "[params]\ndrag_coefficient_max = 3.0",
    '[params]\nwing_area = { value = "54 mm^2", sd = 1e-6, source = "a photograph" }\nactuator_extension_ratio = { value = 0.3, relative_sd = "5 %" }\n[[correlation]]\nbetween = ["wing_area", "actuator_extension_ratio"]\ncoefficient = -0.5\n[sample]\nmethod = "sobol"\nn = 8\nof = "device"',
    "[axes]\ndrag_coefficient_max = [3.0, 4]",
    '[axes]\nwing_area = { from = "50 mm^2", to = 6e-5, n = 3, scale = "log" }',
    '[axes]\nwing_area = { from = "50 mm^2", to = "60 mm^2", step = "1 mm^2" }',
    '[sample]\nmethod = "file"\npath = "designs.csv"',
    '[sample]\nmethod = "random"\nn = 3\nseed = 0\n[sample.parameters]\nwing_area = [5e-5, 6e-5]\nwing_length = { relative_sd = 0.05, from = "10 mm" }',
    '[measure]\nown = "2 * lift_mean_mn"\n[output]\ncolumns = ["own", "lift_mean_mn", "cycles"]',
    '[gradient]\nof = ["lift_mean_mn"]\nwith_respect_to = ["wing_area", "drag_coefficient_max"]',
    "[solver]\nrtol = 1e-5\nmax_cycles = 10\nnewton = false",
]
MISTAKES = [
    ("[parms]\n", "", "'parms' was unexpected"),
    ("[params]\nwing_lenght = 1\n", "/params", "'wing_lenght' was unexpected"),
    ("[params]\ntransmission_ratio = 1\n", "/params", "'transmission_ratio' was unexpected"),
    ('[params]\ncentre_of_pressure = "fold"\n', "/params/centre_of_pressure", "'fold' is not one of"),
    ("[params]\nwing_length = 0\n", "/params/wing_length", "0 is less than or equal to the minimum of 0"),
    ('[params]\nwing_length = "54"\n', "/params/wing_length", "'54' does not match"),
    ('[params]\nwing_length = "mm"\n', "/params/wing_length", "'mm' does not match"),
    ("[params]\nwing_length = [1, 2]\n", "/params/wing_length", "[1, 2] is not of type"),
    (
        "[params]\nwing_length = { value = 0 }\n",
        "/params/wing_length/value",
        "0 is less than or equal to",
    ),
    ("[params]\nwing_length = { sd = 1 }\n", "/params/wing_length", "'value' is a required property"),
    ("[params]\nwing_length = { value = 1, rms = 1 }\n", "/params/wing_length", "'rms' was unexpected"),
    ("[correlation]\ncoefficient = 0.5\n", "/correlation", "is not of type 'array'"),
    (
        '[[correlation]]\nbetween = ["wing_length"]\ncoefficient = 0\n',
        "/correlation/0/between",
        "is too short",
    ),
    ('[axes]\nwing_length = "54 mm"\n', "/axes/wing_length", "is not of type 'array', 'object'"),
    ("[axes]\nwing_length = []\n", "/axes/wing_length", "non-empty"),
    (
        "[axes]\nwing_length = { from = 1, to = 2 }\n",
        "/axes/wing_length",
        "'step' is a required property",
    ),
    (
        "[axes]\nwing_length = { from = 1, to = 2, m = 3, n = 3 }\n",
        "/axes/wing_length",
        "'m' was unexpected",
    ),
    ('[axes]\ncentre_of_pressure = "folded"\n', "/axes/centre_of_pressure", "is not of type 'array'"),
    ("[zip]\nwing_length = [1, 2]\n", "/zip", "is not of type 'array'"),
    ('[sample]\nmethod = "sobol"\n', "/sample", "'n' is a required property"),
    (
        '[sample]\nmethod = "sobbol"\nn = 1\nparameters.wing_length = [1]\n',
        "/sample/method",
        "'sobbol' is not one of",
    ),
    ('[sample]\nmethod = "file"\npath = "a.csv"\nn = 3\n', "/sample", "'n' is not one of"),
    ('[derived]\ncentre_of_pressure = "1"\n', "/derived", "'centre_of_pressure' was unexpected"),
    ("[derived]\nwing_length = 3\n", "/derived/wing_length", "3 is not of type 'string'"),
    ("[where]\nsmall = true\n", "/where/small", "True is not of type 'string'"),
    ('[resonance]\nof = "drag"\n', "/resonance/of", "'drag' is not one of"),
    ('[gradient]\nof = ["lift_mean_mn"]\n', "/gradient", "'with_respect_to' is a required property"),
    ("[solver]\nrtol = 0.5\n", "/solver/rtol", "0.5 is greater than or equal to the maximum"),
    ("[solver]\nnewton = 1\n", "/solver/newton", "1 is not of type 'boolean'"),
    ('[output]\ncolumns = "lift_mean_mn"\n', "/output/columns", "is not of type 'array'"),
    ('[output]\ncolumns = ["lift_meen_mn"]\n', "/output/columns/0", "'lift_meen_mn' is not one of"),
]


def grids() -> list[tuple[str, str]]:
    """The grids of the examples and of the documents, with their names."""
    examples = [(path.name, text_of(path)) for path in sorted((REPOSITORY / "examples").glob("*.toml"))]
    return examples + [
        (page, block["body"])
        for page in pages()
        for block in BLOCK.finditer(text_of(REPOSITORY / page))
        if block["language"] == "toml" and block["body"].startswith(("preset", "device", "# mybee"))
    ]


def test_grids_of_the_examples_and_documents_satisfy_the_schema(validator):
    found = grids()
    assert len(found) > 30
    presets = {tomllib.loads(grid).get("preset", "jafferis2016") for _, grid in found}
    own = {preset: validator("--preset", preset) for preset in presets}
    every = validator()
    for name, grid in found:
        assert mistakes(every, grid) == [], name
        assert mistakes(own[tomllib.loads(grid).get("preset", "jafferis2016")], grid) == [], name


def test_every_form_of_a_value_satisfies_the_schema(validator):
    every = validator()
    for section in FORMS:
        assert mistakes(every, f'preset = "jafferis2016"\n{section}\n') == [], section


def test_mistakes_do_not_satisfy_the_schema(validator, flap, tmp_path):
    every = validator()
    for section, place, message in MISTAKES:
        grid = f'preset = "ozaki2018-large"\n{section}'
        found = mistakes(every, grid)
        assert any(line.startswith(f"{place}: ") and message in line for line in found), (section, found)
        assert len(found) <= 2, (section, found)
        # The check of grid files agrees.
        path = tmp_path / "grid.toml"
        path.write_text(grid, encoding="utf-8")
        flap("check", path, code=2)
    for wrong in ['"ozaki"', "[]", '["ozaki"]', "3"]:
        (found,) = mistakes(every, f"preset = {wrong}\n")
        assert found.startswith("/preset: ") and "is not valid under" in found, found
    for one in [every, validator("--preset", "ozaki2018-large")]:
        assert mistakes(one, "") == [": 'preset' is a required property"]
        (both,) = mistakes(one, 'preset = "ozaki2018-large"\ndevice = "mine.toml"\n')
        assert "should not be valid under" in both


def test_a_list_of_designs_has_the_rules_of_their_model(validator):
    every = validator()
    axes = "\n[axes]\ntransmission_ratio = [1, 2]\n"
    assert mistakes(every, f'preset = ["jafferis2016", "jafferis2016-improved"]{axes}') == []
    (other,) = mistakes(every, f'preset = ["ozaki2018-small"]{axes}')
    assert other.startswith("/axes: ")
    assert mistakes(every, 'device = ["a.toml", "b.toml"]\n') == []
    (empty,) = mistakes(every, "device = []\n")
    assert empty.startswith("/device: ")


def test_a_preset_chooses_the_model_of_a_device(validator):
    """Only a schema for one preset checks the parameters of a grid with a device."""
    grid = 'device = "mybee.toml"\n[params]\nwing_lenght = 1\n'
    assert mistakes(validator(), grid) == []
    (own,) = mistakes(validator("--preset", "jafferis2016"), grid)
    assert own.startswith("/params: ")
