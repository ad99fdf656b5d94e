"""The reference data in tests/data are those that their generators compute, and both notice each other's changes."""

import csv
import dataclasses
import importlib
import shutil
from pathlib import Path

import pytest

DATA = Path(__file__).parents[1] / "data"
VECTORS = {
    "bimorph": "bimorph/rhs_vectors.csv",
    "direct_drive": "direct-drive/rhs_vectors.csv",
    "four_bar": "four-bar/rhs_vectors.csv",
}
#: Parameters that only orbits depend on: the chord of blade elements, and the capacitance of the actuator.
ONLY_IN_ORBITS = {("direct_drive", "legendre"), ("four_bar", "eps_r")}


@pytest.fixture(autouse=True)
def paths(monkeypatch):
    monkeypatch.syspath_prepend(DATA / "generate")


def read(path):
    with path.open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def copy(path, folder, rows=None):
    """A copy of a table, of its first rows if a number is given."""
    target = folder / path
    target.parent.mkdir(parents=True, exist_ok=True)
    shutil.copy(DATA / path, target)
    if rows is not None:
        lines = target.read_text(encoding="utf-8").splitlines(keepends=True)
        target.write_text("".join(lines[: rows + 1]), encoding="utf-8")
    return target


def test_every_table_has_a_generator_and_is_described():
    from reference.tables import TABLES

    files = {str(path.relative_to(DATA)) for path in DATA.rglob("*.csv")}
    # The files of wings on a moving body have no generator here.
    assert {table.path for table in TABLES} == {path for path in files if not path.startswith("body/")}
    text = (DATA / "README.md").read_text(encoding="utf-8")
    missing = [path for path in files if f"`{Path(path).name}`" not in text]
    assert not missing, missing


def test_some_rows_of_each_table_are_recomputed(capsys):
    from reference import command

    status = command.main(["--check", "--quick"])
    told = capsys.readouterr().out
    assert status == 0, told
    assert told.count(" rows, ") == 19, told


@pytest.mark.parametrize(
    ("path", "column"),
    [
        ("bimorph/rhs_vectors.csv", "i2_A"),
        ("bimorph/taper_gains.csv", "G"),
        ("direct-drive/derived_constants.csv", "large"),
        ("direct-drive/rhs_vectors.csv", "psiddot"),
        ("direct-drive/steady_cases.csv", "lift_mean_N"),
        ("four-bar/kinematics_vectors.csv", "delta_p"),
        ("four-bar/rhs_vectors.csv", "M22"),
    ],
)
def test_a_changed_number_in_a_table_is_found(path, column, tmp_path, capsys):
    from reference import command
    from reference.tables import TABLES

    target = copy(path, tmp_path)
    rows = read(target)
    [table] = [table for table in TABLES if table.path == path]
    changed = rows[table.quick[-1]]
    changed[column] = repr(float(changed[column]) * (1.0 + 1e-7))
    with target.open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, rows[0])
        writer.writeheader()
        writer.writerows(rows)
    assert command.main(["--check", "--quick", "--data", str(tmp_path), path]) == 1
    told = capsys.readouterr()
    assert [line.split()[0] for line in told.out.splitlines() if "ABOVE" in line] == [column]
    assert told.err == f"Differences above their bounds in {path}.\n"


def changes(value):
    """A number changed by a millionth, or each number of a tuple."""
    if isinstance(value, tuple):
        return [(*value[:i], one, *value[i + 1 :]) for i, old in enumerate(value) for one in changes(old)]
    return [value * (1.0 + 1e-6)] if isinstance(value, float) and value else []


@pytest.mark.parametrize("model", VECTORS)
def test_a_changed_parameter_of_a_generator_is_found(model, monkeypatch, capsys):
    from reference import command

    module = importlib.import_module(f"reference.{model}")
    base = {"bimorph": "TABLE_1", "direct_drive": "SMALL", "four_bar": "SYS75"}[model]
    sets = {"bimorph": "SETS", "direct_drive": "TYPES", "four_bar": "SYSTEMS"}[model]
    parameters = getattr(module, base)
    count = 0
    for field in dataclasses.fields(parameters):
        if (model, field.name) in ONLY_IN_ORBITS:
            continue
        for value in changes(getattr(parameters, field.name)):
            changed = dataclasses.replace(parameters, **{field.name: value})
            with monkeypatch.context() as patch:
                patch.setattr(module, base, changed)
                named = {name: changed if p is parameters else p for name, p in getattr(module, sets).items()}
                patch.setattr(module, sets, named)
                assert command.main(["--check", VECTORS[model]]) == 1, (field.name, value)
            count += 1
    assert count > 30
    assert command.main(["--check", VECTORS[model]]) == 0
    capsys.readouterr()


@pytest.mark.parametrize(
    ("path", "rows"),
    [("bimorph/taper_gains.csv", None), ("four-bar/rhs_vectors.csv", None), ("direct-drive/steady_cases.csv", 1)],
)
def test_a_table_that_is_written_anew_is_the_same(path, rows, tmp_path, capsys):
    from reference import command
    from reference.tables import TABLES

    target = copy(path, tmp_path, rows)
    before = read(target)
    assert command.main(["--data", str(tmp_path), path]) == 0
    after = read(target)
    [table] = [table for table in TABLES if table.path == path]
    assert list(after[0]) == list(before[0]) and len(after) == len(before)
    for old, new in zip(before, after, strict=True):
        assert [new[name] for name in table.inputs] == [old[name] for name in table.inputs]
        for name in table.second:
            # Another solver agrees with the new numbers as it did with the committed ones.
            assert 0.0 < abs(float(new[name])) < 5e-8, name
    assert command.main(["--check", "--data", str(tmp_path), path]) == 0
    capsys.readouterr()


def test_a_file_that_is_not_there_is_refused(capsys):
    from reference import command

    for arguments, reason in [(["--check", "bimorph/rows.csv"], "no file or folder"), (["--quick"], "needs --check")]:
        with pytest.raises(SystemExit) as ended:
            command.main(arguments)
        assert ended.value.code == 2
        assert reason in capsys.readouterr().err


def test_a_motion_that_crosses_a_surface_and_turns_back_has_two_crossings():
    from reference.motion import Motion, run

    # A parabola that is above zero for less than one step.
    crossings = (0.995, 1.004)
    motion = Motion(lambda t, y, sides: [sum(crossings) - 2.0 * t], [lambda t, y: y[0]], scale=(1.0,))
    found = run(motion, 0.0, 2.0, [-crossings[0] * crossings[1]], integrands=lambda t, y, sides: [sides[0]])
    assert [t for _, t, _ in found.crossings] == pytest.approx(crossings, abs=1e-9)
    # The side is 1 for 9 ms, and -1 else.
    assert found.integrals[0] == pytest.approx(2.0 * 0.009 - 2.0, abs=1e-9)
