"""Tables: columns, and what they become elsewhere."""

import dataclasses
import json
import pickle

import flapwing
import numpy as np
import pandas
import polars
import pyarrow
import pytest
from grids import GRID
from pyarrow import parquet


@pytest.fixture(scope="module")
def table():
    return flapwing.sweep(GRID)


def test_columns_have_types_units_and_meanings(table):
    kinds = {name: table[name].dtype.kind for name in table}
    assert kinds["lift_mean_mn"] == "f" and kinds["cycles"] == "u" and table.periodic["stable"].dtype.kind == "b"
    assert kinds["status"] == kinds["lift_sign"] == "U"
    assert table.units["lift_mean_mn"] == "mN" and table.units["drive_frequency"] == "Hz"
    assert table.units["status"] == ""
    assert table.docs["lift_mean_mn"] == flapwing.measures("direct-drive")["lift_mean_mn"].doc
    assert all(table.docs.values())
    assert table.keys() == table.columns == list(table)
    assert "lift_mean_mn" in table and "lift" not in table
    with pytest.raises(KeyError, match="^there is no column `lift`.*\nthere are point, .* and [0-9]+ more$"):
        table["lift"]


def test_unknown_flags_are_nan(table):
    unknown = table["status"] != "periodic"
    strong = table["strong"]
    assert 0 < unknown.sum() < len(table)
    np.testing.assert_array_equal(np.isnan(strong), unknown)
    assert set(strong[~unknown].tolist()) <= {0.0, 1.0}
    assert table.periodic["strong"].dtype == np.bool_
    np.testing.assert_array_equal(strong[~unknown] == 1, table.periodic["strong"])
    # Rows with an unknown flag are in neither part.
    assert len(table[strong == 1]) + len(table[strong == 0]) == len(table.periodic)
    with pytest.raises(TypeError, match='compare it: table\\[table\\["stable"\\] == 1\\]'):
        table[strong]
    # In a Dataset, points without a row and rows with an unknown flag.
    data = table.to_xarray()["strong"]
    assert np.isnan(data.sel(drive_frequency=100)).all() and int(np.isnan(data).sum()) == data.size - len(
        table.periodic
    )


def test_derivatives_of_a_grid_have_units(flap, tmp_path):
    grid = {
        "preset": "jafferis2016",
        "gradient": {"of": ["lift_mean_mn", "strain_surface_max"], "with_respect_to": ["hinge_stiffness"]},
    }
    units = flapwing.sweep(grid).units
    assert units["d_lift_mean_mn_per_pct_hinge_stiffness"] == "mN/%"
    assert units["d_strain_surface_max_per_pct_hinge_stiffness"] == "1/%"
    path = tmp_path / "rows.csv"
    flapwing.sweep(grid, out=path)
    assert flapwing.read(path).units == units
    described = flap("describe", path).stdout
    line = next(line for line in described.splitlines() if "d_lift_mean_mn_per_pct_hinge_stiffness" in line)
    assert "mN/%" in line
    # Without the sidecar, the name says it.
    (tmp_path / "rows.csv.meta.toml").unlink()
    assert "mN/%" in flap("describe", path).stdout


def test_numbers_are_not_copied(table):
    lift = table["lift_mean_mn"]
    assert np.shares_memory(lift, table["lift_mean_mn"])
    assert lift.flags.c_contiguous
    buffer = table.to_arrow().column("cycles").chunk(0).buffers()[1]
    assert buffer.address == table["cycles"].ctypes.data
    # In pandas too.
    assert np.shares_memory(table.to_pandas()["rhs_evals"].to_numpy(), table["rhs_evals"])


def test_rows_are_chosen_by_masks_slices_and_indices(table):
    periodic = table.periodic
    assert periodic.counts == {"periodic": table.counts["periodic"]}
    assert len(periodic) < len(table)
    assert periodic.units == table.units
    assert table[2:4]["point"].tolist() == table["point"][2:4].tolist()
    assert table[[3, 1]]["point"].tolist() == table["point"][[3, 1]].tolist()
    with pytest.raises(TypeError, match="one dimension"):
        table[3]
    with pytest.raises(IndexError):
        table[np.ones(3, dtype=bool)]
    mask = np.ma.masked_array(table["status"] == "periodic", np.arange(len(table)) == 1)
    with pytest.raises(ValueError, match=f"has 1 masked of {len(table)} values\nleave out rows"):
        table[mask]
    assert len(table[mask.filled(False)]) == (table["status"] == "periodic").sum() - (table["status"][1] == "periodic")


def test_a_table_is_not_made_by_hand():
    with pytest.raises(TypeError, match="is returned by sweep"):
        flapwing.Table()


def test_pandas(table):
    frame = table.to_pandas()
    assert list(frame) == table.columns and len(frame) == len(table)
    assert isinstance(frame["status"].dtype, pandas.CategoricalDtype)
    assert frame["strong"].dtype == "boolean"
    assert frame["strong"].isna().tolist() == np.isnan(table["lift_mean_mn"]).tolist()
    assert frame.attrs["units"]["lift_mean_mn"] == "mN"
    assert frame.groupby("status", observed=True).size().to_dict() == table.counts
    plain = pandas.DataFrame(dict(table))
    np.testing.assert_array_equal(plain["lift_mean_mn"], table["lift_mean_mn"])


def test_arrow_and_polars(table):
    arrow = table.to_arrow()
    assert arrow.schema.field("lift_mean_mn").metadata[b"unit"] == b"mN"
    unknown = int(np.isnan(table["lift_mean_mn"]).sum())
    assert unknown > 0
    assert arrow["lift_mean_mn"].null_count == arrow["strong"].null_count == unknown
    assert arrow["status"].to_pylist() == table["status"].tolist()
    frame = table.to_polars()
    assert frame["lift_mean_mn"].null_count() == unknown
    assert frame["status"].to_list() == table["status"].tolist()
    # Without naming either.
    assert pyarrow.table(table).equals(arrow)
    assert polars.DataFrame(table).equals(frame)


def test_xarray_has_the_axes_of_the_grid(table):
    data = table.to_xarray()
    assert dict(data.sizes) == {"drive_voltage_pp": 2, "lift_sign": 2, "drive_frequency": 7}
    lift = data["lift_mean_mn"]
    assert lift.dims == ("drive_voltage_pp", "lift_sign", "drive_frequency")
    assert lift.attrs == {"units": "mN", "long_name": "lift mean", "description": table.docs["lift_mean_mn"]}
    assert data["drive_frequency"].attrs["units"] == "Hz"
    one = table[
        (table["drive_voltage_pp"] == 80) & (table["lift_sign"] == "printed") & (table["drive_frequency"] == 95)
    ]
    assert lift.sel(drive_voltage_pp=80, lift_sign="printed", drive_frequency=95).item() == one["lift_mean_mn"][0]
    # Excluded points are holes.
    assert np.isnan(lift.sel(drive_frequency=100)).all()
    assert (data["status"].sel(drive_frequency=100) == "").all()
    assert data.attrs["preset"] == "ozaki2018-large"


def test_xarray_of_other_tables():
    motion = flapwing.trajectory("ozaki2018-large", cycles=1, samples=10).to_xarray()
    assert dict(motion.sizes) == {"time_s": 11} and motion["stroke_deg"].attrs["units"] == "deg"
    assert (
        motion["time_s"].attrs["units"] == "s"
        and float(motion["stroke_deg"].sel(time_s=0.0)) == motion["stroke_deg"][0]
    )
    curve = flapwing.respond("ozaki2018-large", start=100, stop=110, step=5, tolerance=5).to_xarray()
    assert dict(curve.sizes) == {"row": 6} and set(curve.coords) == {"curve", "branch", "drive_frequency"}
    assert curve["lift_mean_mn"].where(curve["branch"] == "up", drop=True).sizes["row"] == 3
    zipped = flapwing.sweep(
        {"preset": "jafferis2016", "zip": [{"wing_area": [5e-5, 6e-5], "wing_length": [0.015, 0.016]}]}
    ).to_xarray()
    assert zipped["wing_length"].dims == ("wing_area",)
    sampled = flapwing.sweep(
        {
            "preset": "jafferis2016",
            "sample": {"method": "random", "n": 3, "seed": 1, "parameters": {"wing_area": {"from": 5e-5, "to": 6e-5}}},
        }
    ).to_xarray()
    assert sampled["wing_area"].dims == ("sample",) and sampled.sizes["sample"] == 3


def test_a_table_shows_itself(table):
    assert repr(table).startswith(f"<flapwing.Table of {len(table)} rows (")
    assert len(repr(table)) < 300 and repr(table).endswith(", …>")
    html = table._repr_html_()
    assert f"{len(table)} rows" in html and "<th>lift_mean_mn (mN)</th>" in html
    assert html.count("<tr>") == 11


@pytest.mark.parametrize("compression", ["snappy", "zstd", "none"])
def test_parquet_that_others_wrote_is_read(table, tmp_path, compression):
    path = tmp_path / "others.parquet"
    parquet.write_table(table.to_arrow(), path, compression=compression)
    found = flapwing.read(path)
    for name in table.columns:
        np.testing.assert_array_equal(found[name], table[name], strict=True)


def test_parquet_of_pandas_is_read(tmp_path):
    frame = pandas.DataFrame(
        {
            "name": ["a", "b"],
            "count": [1, 2],
            "small": np.array([-3, 4], np.int32),
            "half": np.array([0.5, np.nan], np.float32),
            "ok": [True, False],
        }
    )
    frame.to_parquet(tmp_path / "frame.parquet")
    found = flapwing.read(tmp_path / "frame.parquet")
    assert found["name"].tolist() == ["a", "b"] and found["count"].tolist() == [1, 2]
    assert found["small"].tolist() == [-3, 4] and found["half"][0] == 0.5 and np.isnan(found["half"][1])
    assert found["ok"].tolist() == [True, False]


@pytest.mark.parametrize("compression", ["gzip", "brotli", "lz4"])
def test_other_compressions_are_named(table, tmp_path, compression):
    path = tmp_path / "others.parquet"
    parquet.write_table(table.to_arrow(), path, compression=compression)
    with pytest.raises(ValueError, match=f"(?i)compressed with {compression}.*: flap reads .* Zstandard, Snappy or no"):
        flapwing.read(path)


@pytest.mark.parametrize(
    "cells",
    [
        *(pandas.to_datetime(["2020-01-01"]).as_unit(unit) for unit in ("ms", "us", "ns")),
        [b"bytes"],
        [[1.0, 2.0]],
        [{"key": 1.0}],
        np.array([3], dtype=np.int8),
        np.array([3], dtype=np.float16),
    ],
    ids=lambda cells: str(getattr(cells, "dtype", type(cells[0]).__name__)),
)
@pytest.mark.parametrize("rows", [0, 1])
def test_columns_of_other_kinds_are_named(tmp_path, cells, rows):
    frame = pandas.DataFrame({"good": [1.0], "other": cells})
    table = pyarrow.Table.from_pandas(frame)
    try:
        parquet.write_table(table.slice(0, rows), tmp_path / "other.parquet")
    except pyarrow.ArrowNotImplementedError:
        pytest.skip("this pyarrow cannot write the column")
    with pytest.raises(ValueError, match="column other cannot be read: cells are whole numbers"):
        flapwing.read(tmp_path / "other.parquet")


def test_parquet_without_its_sidecar_has_units_and_axes(table, tmp_path):
    path = tmp_path / "rows.parquet"
    flapwing.sweep(GRID, out=path)
    (tmp_path / "rows.parquet.meta.toml").unlink()
    found = flapwing.read(path)
    assert found.units == table.units and found.docs == table.docs
    assert found.meta.pop("verified") is False
    assert found.meta == {key: table.meta[key] for key in found.meta} and found.meta["preset"] == "ozaki2018-large"
    assert found.to_xarray().sizes == table.to_xarray().sizes


def test_parquet_of_a_lost_file_of_points_has_units(tmp_path):
    points = tmp_path / "points.csv"
    points.write_text("drive_frequency\n100\n105\n")
    grid = {"preset": "ozaki2018-large", "sample": {"method": "file", "path": str(points)}}
    path = tmp_path / "rows.parquet"
    table = flapwing.sweep(grid, out=path)
    points.unlink()
    (tmp_path / "rows.parquet.meta.toml").unlink()
    found = flapwing.read(path)
    assert found.units == table.units and found.axes == []


def test_files_that_others_wrote_are_read(flap, tmp_path):
    flap("run", "ozaki2018-large", "--trajectory", tmp_path / "motion.csv")
    motion = flapwing.read(tmp_path / "motion.csv")
    assert motion.units["stroke_deg"] == "deg" and motion.axes == [] and len(motion) > 100
    same = flapwing.trajectory("ozaki2018-large", cycles=2, samples=200)
    np.testing.assert_array_equal(same["stroke_rad"], motion["stroke_rad"])
    text = "name,size,ok,all\na,1.5,true,1\nb,,,2\n"
    (tmp_path / "table.csv").write_text(text)
    table = flapwing.read(tmp_path / "table.csv")
    assert [table[name].dtype.kind for name in table] == ["U", "f", "f", "u"]
    assert table["ok"][0] == 1.0 and np.isnan(table["ok"][1])
    assert table.to_pandas()["ok"].isna().tolist() == [False, True]
    (tmp_path / "ragged.csv").write_text("a,b\n1,2\n3\n")
    with pytest.raises(ValueError, match="ragged.csv: line 3: 1 cells, but 2 headings"):
        flapwing.read(tmp_path / "ragged.csv")
    with pytest.raises(FileNotFoundError, match="no.csv"):
        flapwing.read(tmp_path / "no.csv")


def test_columns_are_read_only(table):
    for part in (table, table[1:4], table[[0, 2]], table.periodic, table[["lift_mean_mn", "status"]]):
        for name in part:
            assert not part[name].flags.writeable, name
    with pytest.raises(ValueError, match="read-only"):
        table["lift_mean_mn"][0] = 1.0
    copy = table["lift_mean_mn"].copy()
    copy[0] = 1.0
    frame = table.to_pandas().copy()
    frame.loc[0, "lift_mean_mn"] = 1.0
    assert table["lift_mean_mn"][0] != 1.0


def test_columns_are_chosen_by_lists(table):
    for names in (["drive_frequency", "lift_mean_mn"], ("drive_frequency", "lift_mean_mn")):
        part = table[names]
        assert part.columns == list(names) and len(part) == len(table) and part.units["lift_mean_mn"] == "mN"
        np.testing.assert_array_equal(part["lift_mean_mn"], table["lift_mean_mn"])
    with pytest.raises(KeyError, match="there is no column `lift_mean`, did you mean `lift_mean_"):
        table[["drive_frequency", "lift_mean"]]
    assert len(table[[]]) == 0 and table[[]].columns == table.columns
    whole = table[["point", "lift_mean_mn"]].to_xarray()
    assert whole["lift_mean_mn"].dims == ("drive_voltage_pp", "lift_sign", "drive_frequency")
    with pytest.raises(
        ValueError, match="gives the places of the rows along the axis of drive_voltage_pp\nkeep `point` or"
    ):
        table[["lift_mean_mn"]].to_xarray()


def test_rows_without_their_points_are_placed_by_the_parameters_of_the_axes():
    table = flapwing.sweep(
        {
            "preset": "ozaki2018-large",
            "axes": {"lift_sign": ["corrected", "printed"], "drive_frequency": [100, 105, 110]},
            "zip": [{"wing_length": [0.03, 0.031], "air_density": [1.2, 1.1]}],
        }
    )
    axes = ["wing_length", "lift_sign", "drive_frequency"]
    lift = table.to_xarray()["lift_mean_mn"]
    for rows in (table[::-1], table[np.random.default_rng(1).permutation(len(table))]):
        np.testing.assert_array_equal(rows[[*axes, "lift_mean_mn"]].to_xarray()["lift_mean_mn"], lift)
        with pytest.raises(ValueError, match="along the axis of drive_frequency"):
            rows[["wing_length", "lift_sign", "lift_mean_mn"]].to_xarray()
    some = table[2:5][[*axes, "lift_mean_mn"]].to_xarray()["lift_mean_mn"].to_numpy().ravel()
    np.testing.assert_array_equal(some[2:5], table["lift_mean_mn"][2:5])
    assert np.isnan(np.delete(some, [2, 3, 4])).all()
    assert np.isnan(table[:0][axes + ["lift_mean_mn"]].to_xarray()["lift_mean_mn"]).all()


def test_parts_share_nothing_that_can_be_changed(table):
    part, columns = table[1:], table[["point", "lift_mean_mn"]]
    for each in (table, part, columns, pickle.loads(pickle.dumps(table))):
        with pytest.raises(ValueError, match="read-only"):
            each.axes[0]["drive_voltage_pp"][0] = -1
    rtol = table.meta["solver"]["rtol"]
    part.meta["solver"]["rtol"] = columns.meta["solver"]["rtol"] = 9.0
    part.meta["counts"]["periodic"] = -1
    assert table.meta["solver"]["rtol"] == rtol and table.meta["counts"]["periodic"] > 0


def test_the_origin_is_in_xarray_and_pandas():
    table = flapwing.evaluate(
        "ozaki2018-large", {"drive_frequency": [100.0, 105.0]}, drive_voltage_pp="80 V", rtol=np.float32(1e-5)
    )
    curve = flapwing.respond("ozaki2018-large", start=100, stop=110, step=5, drive_voltage_pp="80 V")
    for told in (table, curve):
        for attributes in (told.to_xarray().attrs, told.to_pandas().attrs):
            assert {key: attributes[key] for key in ("build", "model", "preset", "grid")} == {
                key: told.meta[key] for key in ("build", "model", "preset", "grid")
            }
            assert json.loads(attributes["keywords"])["drive_voltage_pp"] == "80 V"
            assert json.loads(attributes["solver"]) == told.meta["solver"]
    assert json.loads(table.to_xarray().attrs["keywords"])["rtol"] == float(np.float32(1e-5))
    assert curve.to_xarray().attrs["parameter"] == "drive_frequency"
    assert json.loads(curve.to_xarray().attrs["verdicts"]) == [
        dataclasses.asdict(verdict) for verdict in curve.verdicts
    ]


def test_the_origin_in_a_frame_is_kept_by_parquet(table, tmp_path):
    table.to_pandas().to_parquet(tmp_path / "frame.parquet")
    assert pandas.read_parquet(tmp_path / "frame.parquet").attrs["build"] == table.meta["build"]


def test_the_origin_stays_with_parts(table):
    part = table.periodic[["status", "lift_mean_mn"]]
    for key in ("flap", "build", "model", "preset", "solver", "grid"):
        assert part.meta[key] == table.meta[key]
    assert part.meta["rows"] == len(part) and part.meta["counts"] == {"periodic": len(part)}
    assert table.meta["rows"] == len(table) and len(table.meta["counts"]) > 1
    part.meta["note"] = "mine"
    assert "note" not in table.meta


def test_the_origin_is_in_arrow_and_parquet(table, tmp_path):
    origin = table.to_arrow().schema.metadata
    assert origin[b"flapwing.preset"] == b"ozaki2018-large" and origin[b"flapwing.grid"].decode() == table.meta["grid"]
    assert json.loads(origin[b"flapwing.solver"]) == table.meta["solver"]
    parquet.write_table(table.to_arrow(), tmp_path / "rows.parquet")
    assert parquet.read_schema(tmp_path / "rows.parquet").metadata[b"flapwing.build"].decode() == table.meta["build"]
