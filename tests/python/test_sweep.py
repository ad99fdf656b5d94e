"""Sweeps: rows equal to the command's, in memory and in files."""

import copy
import csv
import math
import os
import pickle
import threading

import flapwing
import numpy as np
import pytest
from flapwing import analysis
from grids import GRID

QUICK = 'preset = "ozaki2018-large"\n[axes]\ndrive_frequency = { from = 95, to = 120, n = 26 }\n'


def assert_same_bits(table, path):
    """Every cell of the table is the one in the file."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(table) == len(rows)
    assert table.columns == list(rows[0])
    frame = table.to_pandas()
    for name in table.columns:
        kind = table[name].dtype.kind
        for cell, value in zip((row[name] for row in rows), frame[name]):
            # Flags of which some are unknown are float64 in a table, and nullable in pandas.
            if kind == "f" and frame[name].dtype != "boolean":
                assert math.isnan(value) if cell == "" else float(cell).hex() == float(value).hex(), (name, cell)
            elif kind in "bf":
                assert cell == ("" if value is None or value is frame[name].dtype.na_value else str(value).lower())
            else:
                assert cell == str(value)


@pytest.mark.parametrize(
    "text",
    [
        GRID,
        'preset = "jafferis2016"\n[axes]\ndrive_frequency = { from = 60, to = 200, n = 15 }\n',
        'preset = "arabagi2013-30hz"\n[sample]\nmethod = "sobol"\nn = 16\nseed = 3\n'
        "[sample.parameters]\ndrive_frequency = { from = 20, to = 40 }\n[output]\ncolumns = ['lift_mean_mn', 'stroke_pp_deg']\n",
        'preset = "ozaki2018-small"\n[params]\ndrive_frequency = "resonance"\n[resonance]\nfrom = 150\nto = 250\n'
        "[axes]\ndrive_voltage_pp = [20, 30]\n",
    ],
)
def test_rows_are_those_of_the_command_bit_for_bit(flap, tmp_path, text):
    path = tmp_path / "grid.toml"
    path.write_text(text, encoding="utf-8")
    flap("sweep", "--grid", path, "--out", tmp_path / "rows.csv")
    assert_same_bits(flapwing.sweep(path), tmp_path / "rows.csv")


@pytest.mark.parametrize("name", ["rows.csv", "rows.csv.zst", "rows.parquet"])
def test_files_are_those_of_the_command_byte_for_byte(flap, grid, tmp_path, name):
    (tmp_path / "a").mkdir()
    flap("sweep", "--grid", grid, "--out", tmp_path / "a" / name)
    table = flapwing.sweep(grid, out=tmp_path / name, threads=1)
    assert (tmp_path / name).read_bytes() == (tmp_path / "a" / name).read_bytes()
    assert not (tmp_path / (name + ".journal")).exists()
    assert 'state = "complete"' in (tmp_path / (name + ".meta.toml")).read_text()
    in_memory = flapwing.sweep(grid)
    assert table.columns == in_memory.columns
    for column in table.columns:
        np.testing.assert_array_equal(table[column], in_memory[column], strict=True)
    assert table.units == in_memory.units and table.docs == in_memory.docs
    assert [list(dim) for dim in table.axes] == [list(dim) for dim in in_memory.axes]
    assert table.meta["grid"] == in_memory.meta["grid"] == GRID
    # Rows of another grid are not overwritten unasked; those of the same grid are there already.
    with pytest.raises(FileExistsError, match="the grid file differs; line .*: choose another file, or .*restart=True"):
        flapwing.sweep(GRID + "\n", out=tmp_path / name)
    assert len(flapwing.sweep(grid, out=tmp_path / name)) == len(table)
    flapwing.sweep(grid, out=tmp_path / name, restart=True)
    # Nothing is left to run.
    assert len(flapwing.sweep(grid, out=tmp_path / name)) == len(table)


def test_rows_in_a_file_are_read_when_they_are_asked_for(tmp_path, monkeypatch):
    """A night's run may be larger than the memory."""
    monkeypatch.chdir(tmp_path)
    table = flapwing.sweep(QUICK, out="rows.csv")
    (tmp_path / "rows.csv").rename(tmp_path / "elsewhere.csv")
    assert table.meta["counts"] == {"periodic": 26} and list(table.axes[0]) == ["drive_frequency"]
    with pytest.raises(FileNotFoundError, match="cannot read .*rows.csv: there is no such file$"):
        table["lift_mean_mn"]
    assert repr(table).startswith("<flapwing.Table, whose rows cannot be read: FileNotFoundError: cannot read ")
    (tmp_path / "elsewhere.csv").rename(tmp_path / "rows.csv")
    monkeypatch.chdir("/")
    assert len(table["lift_mean_mn"]) == 26
    (tmp_path / "rows.csv").unlink()
    assert len(table) == 26


def test_rows_in_a_file_are_those_of_the_table(tmp_path):
    path = tmp_path / "rows.csv"
    table = flapwing.sweep(QUICK, out=path)
    flapwing.sweep(QUICK.replace("to = 120", "to = 130"), out=path, restart=True)
    with pytest.raises(ValueError, match="rows.csv does not have the rows of this table: grid in `meta`.*\\n.*another"):
        table["lift_mean_mn"]
    # An interrupted repetition of the same sweep has some of the rows.
    grid = QUICK.replace("n = 26", "n = 20001") + "[solver]\nrtol = 1e-3\nmax_cycles = 2\n"
    again = flapwing.sweep(grid, out=path, restart=True)
    path.unlink()
    (tmp_path / "rows.csv.meta.toml").unlink()

    def stop(done, _):
        if done >= 8:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        flapwing.sweep(grid, out=path, threads=1, progress=stop)
    with pytest.warns(UserWarning, match="rows.csv is unfinished") as warned:
        assert 0 < len(again) < 20001
    assert warned[0].filename == __file__


def test_meta_tells_what_the_rows_are():
    table = flapwing.sweep(GRID)
    meta = table.meta
    assert (meta["flap"], meta["model"], meta["preset"]) == (flapwing.__version__, "direct-drive", "ozaki2018-large")
    assert meta["solver"]["max_cycles"] == 24
    assert meta["excluded"] == 4 and meta["unsatisfied"] == {"not_hundred": 4}
    assert len(table) == 28 - 4
    assert meta["counts"] == table.counts
    # Points that fail are rows.
    assert set(table.counts) >= {"periodic", "unsettled", "invalid"}
    assert np.isnan(table["lift_mean_mn"][table["status"] == "unsettled"]).all()


@pytest.mark.parametrize("name", ["rows.csv", "rows.parquet"])
def test_reasons_of_invalid_rows_are_read_from_a_file(tmp_path, name):
    table = flapwing.sweep(GRID, out=tmp_path / name)
    assert len(table.meta["invalid"]) == table.counts["invalid"] > 0
    assert flapwing.read(tmp_path / name).meta["invalid"] == table.meta["invalid"]


def test_where_grids_go_wrong():
    with pytest.raises(flapwing.GridError):
        flapwing.sweep({"preset": "ozaki"})
    with pytest.raises(ValueError, match="`measures` is empty\nleave it out for all measures"):
        flapwing.sweep(QUICK, measures=[])
    with pytest.raises(ValueError, match="give out"):
        flapwing.sweep(QUICK, restart=True)
    with pytest.raises(ValueError, match="`threads` must be from 1"):
        flapwing.sweep(QUICK, threads=0)
    with pytest.raises(TypeError, match="`threads` must be a whole number, not str"):
        flapwing.sweep(QUICK, threads="2")


def test_where_files_go_wrong(tmp_path):
    with pytest.raises(FileNotFoundError):
        flapwing.sweep(QUICK, out=tmp_path / "no" / "rows.csv")
    with pytest.raises(ValueError, match="the file name must end in .csv, .csv.zst or .parquet"):
        flapwing.sweep(QUICK, out=tmp_path / "rows.xlsx")
    (tmp_path / "other.csv").write_text("something else\n")
    with pytest.raises(FileExistsError, match="other.csv exists already"):
        flapwing.sweep(QUICK, out=tmp_path / "other.csv")
    flapwing.sweep(QUICK, out=tmp_path / "rows.csv")
    with pytest.raises(FileExistsError, match="the grid file differs; line 3 of the grid was"):
        flapwing.sweep(QUICK.replace("26", "27"), out=tmp_path / "rows.csv")


def test_inputs_are_not_overwritten(tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("drive_frequency\n60\n70\n")
    grid = tmp_path / "grid.toml"
    grid.write_text('preset = "ozaki2018-large"\n[sample]\nmethod = "file"\npath = "points.csv"\n')
    (tmp_path / "link.csv").hardlink_to(grid)
    for out, what in [(points, "the file of points"), (tmp_path / "link.csv", "the grid file")]:
        with pytest.raises(ValueError, match=f"would overwrite {what}"):
            flapwing.sweep(grid, out=out, restart=True)
    assert points.read_text() == "drive_frequency\n60\n70\n"


def test_progress_ends_with_all_points(tmp_path):
    told = []

    def tell(done, points):
        told.append((done, points))

    assert len(flapwing.sweep(QUICK, progress=tell)) == 26
    assert told[-1] == (26, 26) and told == sorted(told) and all(points == 26 for _, points in told)
    told.clear()
    flapwing.sweep(QUICK, out=tmp_path / "rows.csv", progress=tell)
    assert told[-1] == (26, 26)
    told.clear()
    flapwing.sweep(QUICK, out=tmp_path / "rows.csv", progress=tell)
    assert told == [(26, 26)]


def test_a_bar_is_shown(capsys):
    flapwing.sweep(QUICK, progress=True)
    last = capsys.readouterr().err.rsplit("\r", 1)[-1]
    assert "100%" in last and "26.0/26.0" in last and "points" in last


def test_a_table_of_a_file_can_be_pickled(tmp_path):
    out = tmp_path / "rows.csv"
    table = flapwing.sweep(QUICK, out=out)
    stored = pickle.dumps(table)
    out.unlink()
    for copied in (pickle.loads(stored), copy.deepcopy(table)):
        assert copied.units == table.units and copied.meta == table.meta
        assert [list(dim) for dim in copied.axes] == [list(dim) for dim in table.axes]
        for column in table.columns:
            np.testing.assert_array_equal(copied[column], table[column], strict=True)


def test_an_exception_in_progress_ends_the_sweep(tmp_path):
    def stop(done, points):
        raise RuntimeError("enough")

    big = QUICK.replace("n = 26", "n = 80000")
    with pytest.raises(RuntimeError, match="enough"):
        flapwing.sweep(big, progress=stop)
    out = tmp_path / "rows.csv"
    with pytest.raises(RuntimeError, match="enough"):
        flapwing.sweep(big, out=out, progress=stop)
    assert 'state = "interrupted"' in (tmp_path / "rows.csv.meta.toml").read_text()


def test_an_interrupted_sweep_goes_on_to_the_same_bytes(tmp_path):
    def stop(done, points):
        if done >= 600:
            raise RuntimeError("enough")

    grid = QUICK.replace("n = 26", "n = 20001")
    out = tmp_path / "rows.csv"
    with pytest.raises(RuntimeError):
        flapwing.sweep(grid, out=out, threads=1, progress=stop)
    assert len(flapwing.sweep(grid, out=out)) == 20001
    flapwing.sweep(grid, out=tmp_path / "whole.csv")
    assert out.read_bytes() == (tmp_path / "whole.csv").read_bytes()


def test_other_threads_sweep_at_the_same_time():
    expected = flapwing.sweep(QUICK)
    tables = []
    threads = [threading.Thread(target=lambda: tables.append(flapwing.sweep(QUICK, threads=2))) for _ in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(tables) == 8
    for table in tables:
        for column in table.columns:
            np.testing.assert_array_equal(table[column], expected[column], strict=True)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="fork")
@pytest.mark.filterwarnings("ignore:.*multi-threaded, use of fork.*:DeprecationWarning")
def test_a_forked_process_sweeps_too():
    """As the workers of multiprocessing do, whose parent may have swept before."""
    flapwing.sweep(QUICK, threads=2)
    child = os.fork()
    if child == 0:
        os._exit(0 if len(flapwing.sweep(QUICK, threads=2)) == 26 else 1)
    assert os.waitpid(child, 0)[1] == 0


@pytest.mark.parametrize("ending", ["csv", "csv.zst", "parquet"])
def test_damaged_results_are_refused(tmp_path, ending):
    path = tmp_path / f"rows.{ending}"
    table = flapwing.sweep(QUICK, out=path)
    assert flapwing.read(path).meta["verified"] is True
    sound = path.read_bytes()
    path.write_bytes(sound[:100] + bytes([sound[100] ^ 1]) + sound[101:])
    with pytest.raises(ValueError, match=f"rows.{ending} is damaged: .*ignore_damage=True"):
        flapwing.read(path)
    with pytest.raises(ValueError, match="is damaged"):
        table["lift_mean_mn"]
    with pytest.raises(ValueError, match="is damaged: .*restart=True"):
        flapwing.sweep(QUICK, out=path)
    path.write_bytes(sound)
    assert len(table["lift_mean_mn"]) == 26


def test_damage_is_ignored_with_a_warning(tmp_path):
    path = tmp_path / "rows.csv"
    flapwing.sweep(QUICK, out=path)
    lines = path.read_text().splitlines(keepends=True)
    path.write_text("".join(lines[:3] + ["9," + lines[3]] + lines[4:]))
    with pytest.warns(UserWarning) as warned:
        table = flapwing.read(path, ignore_damage=True)
    texts = [str(warning.message) for warning in warned]
    assert "rows 1 to 26 have changed since they were written" in texts[0] and "1 line is not a row" in texts[1]
    assert len(table) == 25 and table.meta["verified"] is False

    alone = tmp_path / "alone.csv"
    alone.write_text("".join(lines))
    assert flapwing.read(alone).meta["verified"] is False


def test_damage_of_unfinished_results_is_noticed(tmp_path):
    """Rows that the journal records are gone, or the sidecar is that of another sweep."""

    def stop(done, _):
        if done >= 600:
            raise KeyboardInterrupt

    for name, points in [("rows.csv", "n = 20001"), ("other.csv", "n = 20002")]:
        with pytest.raises(KeyboardInterrupt):
            flapwing.sweep(QUICK.replace("n = 26", points), out=tmp_path / name, threads=1, progress=stop)
    path, sidecar = tmp_path / "rows.csv", tmp_path / "rows.csv.meta.toml"
    own = sidecar.read_bytes()
    sidecar.write_bytes((tmp_path / "other.csv.meta.toml").read_bytes())
    with pytest.raises(
        ValueError, match="rows.csv is damaged: its sidecar belongs to another sweep: the grid file differs"
    ):
        flapwing.read(path)
    with pytest.warns(UserWarning) as caught:
        table = flapwing.read(path, ignore_damage=True)
    assert any("its sidecar belongs to another sweep" in str(warning.message) for warning in caught)
    assert "grid" not in table.meta and len(table) > 0

    sidecar.write_bytes(own)
    with pytest.warns(UserWarning, match=r"rows.csv is unfinished: \d+ points done so far"):
        unfinished = flapwing.read(path)
    assert len(unfinished) == len(table) and unfinished.meta["verified"] is False
    # The warning names the line of the user's call, also if another function of the package reads the file.
    with pytest.warns(UserWarning, match="rows.csv is unfinished") as caught:
        analysis.describe(path, "lift_mean_mn")
    assert [warning.filename for warning in caught] == [__file__]
    path.write_bytes(path.read_bytes()[:-1])
    with pytest.raises(ValueError, match=r"rows.csv is damaged: it lacks \d+ rows? that its journal records"):
        flapwing.read(path)


def test_another_implementation_reads_parquet(tmp_path):
    parquet = pytest.importorskip("pyarrow.parquet")
    path = tmp_path / "rows.parquet"
    table = flapwing.sweep(QUICK, out=path)
    read = parquet.read_table(path)
    np.testing.assert_array_equal(read["lift_mean_mn"].to_numpy(), table["lift_mean_mn"])
    assert read["status"].to_pylist() == table["status"].tolist()
